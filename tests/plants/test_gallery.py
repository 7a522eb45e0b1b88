from pathlib import Path

from cadplants.presets.taste import ALL_FAMILIES

GALLERY = Path(__file__).parents[2] / "docs" / "devices"


def test_every_family_is_in_the_gallery_and_no_other_picture():
    pictures = {f"{name.replace('/', '_').replace(' ', '_').replace('&', 'and')}.webp" for name in ALL_FAMILIES}
    assert {path.name for path in GALLERY.glob("*.webp")} == pictures


def test_every_picture_is_shown_on_a_page_that_the_index_names():
    index = (GALLERY / "index.md").read_text(encoding="utf-8")
    for page in GALLERY.glob("*.md"):
        if page.name != "index.md":
            assert f"({page.name})" in index
    shown = "".join(page.read_text(encoding="utf-8") for page in GALLERY.glob("*.md"))
    assert all(f"({path.name})" in shown for path in GALLERY.glob("*.webp"))
