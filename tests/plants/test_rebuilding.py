"""What is recorded of a device makes the same device again."""

import json

import numpy as np
import pytest

from cadgraph.cli import main
from cadgraph.load import load
from cadplants import PRESETS, make
from cadplants.faults.defects import DEFECTS
from cadplants.model.family import as_assembly
from cadplants.presets.single_device import draw_parameters, make_device, rebuild
from cadplants.presets.taste import ALL_FAMILIES
from cadplants.styles.modeling_style import STYLES, ModelingStyle
from cadplants.truth.truth_writer import truth_of

STYLE = STYLES["mechanical"]


def written(said):
    return json.loads(json.dumps(said))


def assert_same_meshes(some, others):
    assert [c.name for c in some] == [c.name for c in others]
    for one, other in zip(some, others, strict=True):
        np.testing.assert_array_equal(one.solid.faces, other.solid.faces)
        np.testing.assert_allclose(one.solid.vertices, other.solid.vertices, rtol=0, atol=1e-6)


@pytest.mark.slow
def test_the_parameters_of_every_family_come_back_from_what_is_written_of_them():
    wrong = []
    for number, name in enumerate(ALL_FAMILIES):
        device = draw_parameters(name, number, {}, STYLE)
        if type(device).from_json(written(device.to_json())).to_json() != device.to_json():
            wrong.append(name)
    assert wrong == []


@pytest.mark.slow
@pytest.mark.long
def test_every_family_is_built_again_from_what_is_written_of_it():
    coarse = STYLES["game"]
    for number, (name, family) in enumerate(ALL_FAMILIES.items()):
        device = draw_parameters(name, number, {}, STYLE)
        again = type(device).from_json(written(device.to_json()))
        one, other = (as_assembly(family, made.model(coarse), coarse, "X-1") for made in (device, again))
        assert_same_meshes(one.components, other.components)


@pytest.mark.slow
def test_the_devices_of_a_plant_are_built_again_in_their_own_styles():
    plant = make("assortment", 0)
    truth = written(truth_of(plant))
    assert len({row["style"] for row in truth["devices"]}) > 2
    number = {path: i for i, path in enumerate(plant.paths())}
    for row in truth["devices"]:
        again = rebuild(row, truth["styles"])
        own = [plant.components[number[mesh]] for mesh in row["meshes"]]
        assert [c.name for c in own] == [c.name for c in again.components], row["build"]
        # In the plant gaps are left and faces are told otherwise, but no shape is another one.
        for one, other in zip(own, again.components, strict=True):
            sizes = [np.ptp(c.solid.vertices, axis=0) for c in (one, other)]
            np.testing.assert_allclose(*sizes, rtol=0, atol=1e-6)


LAID_OUT = {
    "pipe",
    "elbow",
    "flange",
    "blind flange",
    "branch outlet",
    "gasket",
    "bolt",
    "nut",
    "washer",
    "stud",
    "ground",
}
"""What the layout of a line itself puts down, and what a plant stands on."""
BARE = {"loop": {"beam", "cable tray", "plate"}}
"""Boxes of single presets."""


@pytest.mark.slow
@pytest.mark.parametrize("defects", [None, "primitives"])
@pytest.mark.parametrize("preset", [name for name in PRESETS if name != "assortment"])
def test_all_devices_of_a_preset_are_recorded_and_built_again(preset, defects):
    plant = make(preset, 0, None, DEFECTS[defects] if defects else None)
    truth = written(truth_of(plant))
    parts = dict(zip(plant.paths(), plant.components, strict=True))
    meshes = [mesh for row in truth["devices"] for mesh in row["meshes"]]
    assert len(set(meshes)) == len(meshes)
    rest = {parts[path].name for path in parts.keys() - set(meshes)}
    assert rest <= LAID_OUT | BARE.get(preset, set())
    for row in truth["devices"]:
        again = rebuild(row, truth.get("styles"))
        own = [parts[mesh] for mesh in row["meshes"]]
        assert [c.name for c in own] == [c.name for c in again.components], row["build"]
        for one, other in zip(own, again.components, strict=True):
            sizes = [np.ptp(c.solid.vertices, axis=0) for c in (one, other)]
            np.testing.assert_allclose(*sizes, rtol=0, atol=1e-8)


def test_two_devices_alike_are_two_records():
    rows = [row for row in truth_of(make("skid", 0))["devices"] if row["family"] == "post"]
    assert len(rows) == 4
    assert all(row["params"] == rows[0]["params"] and len(row["meshes"]) == 2 for row in rows)


@pytest.mark.slow
@pytest.mark.parametrize("preset", ["assortment", "field"])
def test_devices_are_recorded_in_sizes_that_their_families_are_made_in(preset):
    for row in truth_of(make(preset, 1))["devices"]:
        family = ALL_FAMILIES[f"{row['family']}/{row['build']}"]
        none = (0,) if family.place in ("floor", "tap") else ()  # what no line goes through may have no size
        assert row["params"]["dn"] in (*none, *family.sizes), family.name


def test_a_style_comes_back_from_what_is_written_of_it():
    for style in STYLES.values():
        assert ModelingStyle.from_json(written(style.to_json())) == style
    with pytest.raises(ValueError, match="a style has no 'fog'"):
        ModelingStyle.from_json({"name": "x", "fog": 1})


def test_what_is_no_record_of_a_family_is_refused():
    said = draw_parameters("siphon/pigtail").to_json()
    kind = type(draw_parameters("siphon/pigtail"))
    with pytest.raises(ValueError, match="dn: is missing"):
        kind.from_json({key: value for key, value in said.items() if key != "dn"})
    with pytest.raises(ValueError, match="fog: no parameter; there are dn"):
        kind.from_json({**said, "fog": 1})
    with pytest.raises(ValueError, match="no params"):
        rebuild({"family": "siphon", "build": "pigtail"})


def test_values_that_were_rounded_and_lists_are_taken_as_given():
    plain = make_device("pump/end suction frame", 0, given={"sides": [16, 48]})
    assert plain.n_meshes
    turns = [draw_parameters("tank/drums", given={"lying": False, "count": 1, "turns": [1.5]}).turns]
    assert turns == [(1.5,)]


def test_the_command_line_builds_a_device_from_a_file(tmp_path, capsys):
    def run(*words):
        with pytest.raises(SystemExit) as end:
            main([str(word) for word in words])
        return end.value.code or 0, " ".join("".join(capsys.readouterr()).split())

    one = tmp_path / "one.usda"
    device = ("environment", "device", "siphon/pigtail")
    assert run(*device, "--style", "game", "-o", one)[0] == 0
    truth = json.loads((tmp_path / "one.truth.json").read_text())
    (row,) = truth["devices"]
    for name, said in (("truth", truth), ("row", row), ("params", row["params"])):
        file = tmp_path / f"{name}.json"
        file.write_text(json.dumps(said))
        style = ("--style", "game") if name == "params" else ()
        assert run(*device, "--params", file, *style, "-o", tmp_path / f"{name}.usda")[0] == 0
        np.testing.assert_allclose(load(tmp_path / f"{name}.usda").vertices, load(one).vertices, rtol=0, atol=1e-6)
    code, said = run("environment", "device", "siphon/coil", "--params", tmp_path / "row.json", "-o", one)
    assert (code, "is of siphon/pigtail" in said) == (2, True)
    code, said = run(*device, "--params", tmp_path / "row.json")
    assert (code, "give --output with it" in said) == (2, True)
