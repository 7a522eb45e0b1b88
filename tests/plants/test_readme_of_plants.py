"""What the page of cadplants prints is run as it stands, one block after the other."""

import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from cadgraph.model.truth import Truth
from cadplants.cli import main
from cadplants.families import FAMILIES
from cadplants.presets.taste import ALL_FAMILIES, register

PAGE_OF = Path(__file__).parents[2] / "packages" / "cadplants"
PAGE = (PAGE_OF / "README.md").read_text()
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


@pytest.fixture
def own_families():
    """Families that a test adds are gone after it."""
    known = set(ALL_FAMILIES)
    yield
    for name in set(ALL_FAMILIES) - known:
        del ALL_FAMILIES[name], FAMILIES[name]


@pytest.mark.slow
def test_the_commands_of_the_page_run_in_their_order(own_families, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (code,) = [text for language, text in BLOCKS if language == "python"]
    Path("vents.py").write_text(code)
    commands = [line for language, text in BLOCKS if not language for line in text.splitlines()]
    again = re.search(r"`(cadplants\s+device siphon/pigtail --params [^`]*)`", PAGE)
    for line in [*commands, again.group(1)]:
        words = shlex.split(line, comments=True)
        if words[0] == "pip":
            continue
        for name in [name for name in ALL_FAMILIES if name == "vent/mushroom"]:
            del ALL_FAMILIES[name], FAMILIES[name]
        with pytest.raises(SystemExit) as end:
            main(words[1:])
        said = "".join(capsys.readouterr())
        assert not end.value.code, f"{line}: {said}"
    assert Truth.load("vent.truth.json").meshes[0].family == "vent"


def test_the_page_says_how_many_families_there_are():
    numbers = (len(ALL_FAMILIES), len(FAMILIES), len(ALL_FAMILIES) - len(FAMILIES))
    assert [int(n) for n in re.findall(r"(\d+)\sfamilies \((\d+) of the assortment, (\d+) of", PAGE)[0]] == list(
        numbers
    )
    assert f"structures of {len(FAMILIES)} families" in PAGE


def test_families_of_ones_own_are_made_as_all_others(own_families, tmp_path, capsys):
    def run(*words):
        with pytest.raises(SystemExit) as end:
            main([str(word) for word in words])
        return end.value.code or 0, " ".join("".join(capsys.readouterr()).split())

    file = tmp_path / "own.py"
    file.write_text(next(text for language, text in BLOCKS if language == "python"))
    code, said = run("devices", "mushroom", "--with", file)
    assert code == 0
    assert said.endswith("vent/mushroom tap Pipe assembly 1 families")
    # It is drawn in assortments, where nothing else that stands on outlets is left.
    from cadplants.presets.assortment import make_assortment

    others = frozenset(name for name, one in FAMILIES.items() if one.place == "tap" and name != "vent/mushroom")
    assert "vent/mushroom" in {c.family for seed in range(3) for c in make_assortment(seed, None, others).components}
    code, said = run("devices", "mushroom", "--with", file)
    assert (code, "as no other has them" in said) == (2, True)
    file.write_text("x = 1\n")
    code, said = run("devices", "--with", file)
    assert (code, "defines no class of Device with a name" in said) == (2, True)
    code, said = run("devices", "--with", "no_such_module")
    assert (code, "can't be imported" in said) == (2, True)


def test_a_family_that_no_plant_could_hold_is_refused(own_families):
    from cadplants.builder.device import Device

    for name, place, group, message in (
        ("vent", "tap", "Pipe assembly", "give kind and construction"),
        ("vent/x", "roof", "Pipe assembly", "place 'roof' is none of inline, tap"),
        ("vent/x", "tap", "Vents", "group 'Vents' is not in the vocabulary"),
    ):
        made = type("Made", (Device,), {}, name=name, place=place, group=group)
        with pytest.raises(ValueError, match=message):
            register(made)


def test_the_package_has_a_command_of_its_own(capsys):
    with pytest.raises(SystemExit) as end:
        main(["device", "gate valve/os&y", "--set", "dn=81"])
    assert end.value.code == 2
    assert "error: dn=81: gate valve/os&y is made in 15, 20" in capsys.readouterr().err
    found = subprocess.run([sys.executable, "-m", "cadplants", "devices", "siphon"], capture_output=True, text=True)
    assert (found.returncode, "siphon/pigtail  " in found.stdout) == (0, True)
    assert tomllib.loads((PAGE_OF / "pyproject.toml").read_text())["project"]["scripts"] == {
        "cadplants": "cadplants.__main__:main"
    }
