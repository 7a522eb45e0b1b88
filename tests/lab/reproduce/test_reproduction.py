import re
from dataclasses import replace

import pytest
from PIL import Image

from cadgraph.errors import OutputError
from cadlab.reproduce import LABELINGS, reproduce
from cadlab.reproduce.experiment import subject_of, try_out
from cadlab.reproduce.page import _inside
from cadlab.reproduce.paper import STRUCTURES
from cadplants import make

pytestmark = pytest.mark.slow

PICTURE = re.compile(r"!\[[^]]+\]\(([^)]+)\)")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    target = tmp_path_factory.mktemp("docs")
    assert reproduce(target, quick=True) == target / "reproduction.md"
    return target


@pytest.fixture(scope="module")
def page(folder):
    return (folder / "reproduction.md").read_text(encoding="utf-8")


def row(page, title):
    return [cell.strip() for line in page.splitlines() if line.startswith(f"| {title} |") for cell in line.split("|")]


def test_the_page_says_what_cannot_be_compared(page):
    assert "gpt-4o was not run here" in page
    assert "The plant is not theirs" in page


def test_the_papers_figures_stand_beside_ours(page):
    assert row(page, "meshes")[2] == "8,327"
    assert row(page, "parts")[2] == "82"
    assert row(page, "valves fully found")[2] == "2"


def test_both_clustering_errors_show_in_paper_mode_only(page):
    assert row(page, "bent pipe, one joint on a voxel border")[2:5] == ["1", "2", "1"]
    assert row(page, "the same pipe, 5 mm higher")[2:5] == ["1", "1", "1"]
    assert row(page, "platform 16 mm from a tank")[2:5] == ["2", "1", "2"]


def test_every_picture_is_there_and_every_file_is_shown(folder, page):
    shown = PICTURE.findall(page)
    assert sorted(shown) == sorted(f"reproduction/{path.name}" for path in (folder / "reproduction").iterdir())
    for path in shown:
        with Image.open(folder / path) as image:
            image.load()


def test_both_cases_of_the_functional_graph_are_drawn(page):
    assert "S2-paper-true.jpg" in page
    assert "S2-paper-embedded.jpg" in page


def test_tables_are_rectangular(page):
    lines = page.splitlines()
    for above, below in zip(lines, lines[1:], strict=False):
        if above.startswith("|") and below.startswith("|"):
            assert above.count("|") == below.count("|"), below


def test_the_page_holds_no_times_and_no_paths(page, folder):
    assert not re.search(r"\d\s?(s|ms|seconds|min)\b(?! of)", page)
    assert str(folder) not in page


def test_the_same_seed_gives_the_same_bytes(folder, tmp_path):
    reproduce(tmp_path, quick=True)
    for path in sorted(folder.rglob("*.*")):
        assert path.read_bytes() == (tmp_path / path.relative_to(folder)).read_bytes(), path.name


def test_a_further_labeler_needs_a_row_only(tmp_path):
    nobody = replace(LABELINGS[1], name="nobody", title="nobody", settings={"label.labeler": "none"})
    text = reproduce(tmp_path, quick=True, labelings=(LABELINGS[0], nobody)).read_text(encoding="utf-8")
    assert row(text, "valves missed")[2:5] == ["0", "6", "6"]
    assert "S2-paper-nobody.jpg" in text


def test_an_unusable_folder_is_refused_before_the_work(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        reproduce(tmp_path / "file", quick=True)


def test_an_unknown_preset_is_refused(tmp_path):
    with pytest.raises(ValueError, match="no-such"):
        reproduce(tmp_path, preset="no-such")


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.id)
def test_our_structures_have_as_many_valves_and_gauges_as_the_papers(structure):
    types = [unit.type for unit in make(structure.preset, 0).units]
    assert types.count("valve") == sum(structure.valves)
    assert types.count("gauge") == sum(structure.gauges)


def test_true_labels_are_all_right():
    trial = try_out(subject_of(make("riser", 0)), "exact", LABELINGS[0])
    assert trial.evaluation.total.parts.name.accuracy == 1.0
    assert trial.method == trial.evaluation.method


def test_clusters_of_fences_alone_do_not_count():
    plant = make("riser", 0)
    trial = try_out(subject_of(plant), "exact", LABELINGS[0])
    assert _inside(trial) == 1
    fenced = replace(plant, components=tuple(replace(c, cluster="fence-0") for c in plant.components))
    assert _inside(replace(trial, subject=subject_of(fenced))) == 0
