import json

import pytest

from cadplants.builder.device import Maker
from cadplants.presets.single_device import draw_parameters, family_called, make_device, rebuild
from cadplants.presets.taste import ALL_FAMILIES
from cadplants.truth.truth_writer import truth_of
from command_line import refused, run


def test_every_family_is_a_class_of_parameters_that_people_can_read():
    for name, family in ALL_FAMILIES.items():
        assert isinstance(family.build, Maker), name
        drawn = draw_parameters(name, 1)
        assert json.loads(json.dumps(drawn.to_json()))
        for parameter, value, limits, about in drawn.rows():
            assert parameter, name
            assert isinstance(value, str), (name, parameter)
            assert limits, (name, parameter)
            assert about, (name, parameter)


def test_what_depends_on_other_parameters_is_said_in_numbers_for_a_draw():
    for name in ALL_FAMILIES:
        assert "by the fields before" not in {row[2] for row in draw_parameters(name, 2).rows(here=True)}, name


@pytest.mark.parametrize("name", list(ALL_FAMILIES)[::59])
def test_a_device_by_itself_is_a_plant_with_truth(name):
    plant = make_device(name, 3)
    truth = truth_of(plant)
    assert {mesh["family"] for mesh in truth["meshes"]} == {name.split("/")[0]}
    assert plant.contacts or plant.n_meshes == 1
    (device,) = truth["devices"]
    assert device["meshes"] == list(plant.paths())
    assert device["params"] == draw_parameters(name, 3).to_json()


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("gate valve/os&z", {}, "no family of devices; did you mean gate valve/os&y"),
        ("gate valve", {}, "gate valve/"),
        ("gate valve/os&y", {"dn": 81}, "dn=81: gate valve/os&y is made in"),
        ("gate valve/os&y", {"dn": "x"}, "dn=x: gate valve/os&y is made in"),
    ],
)
def test_unknown_families_and_sizes_are_refused(name, given, message):
    with pytest.raises(ValueError, match=message):
        make_device(name, given=given)


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("tank/drum", {"nozzles.0.size": 47}, "nozzles.0.size=47: give 15, 20"),
        ("tank/drum", {"nozzles.0.first": "nan"}, "nozzles.0.first=nan: give a number"),
        ("tank/drum", {"nozzles.0.first": 5}, "tank/drum: .*nozzles.0: of DN 80, it reaches beyond the shell"),
        ("tank/drum", {"nozzles.0.on": "side"}, "tank/drum: .*nozzles.0.on=side: give top, left, right"),
        ("tank/dished with manway", {"nozzles.1.on": "left"}, "nozzles.1.on=left: give top, side"),
        ("platform/grating", {"opening": 9}, "opening=9: give -"),
        ("pump/end suction", {"out": 47}, "out=47: give 0, 15"),
    ],
)
def test_what_would_make_no_device_is_refused(name, given, message):
    with pytest.raises(ValueError, match=message):
        make_device(name, given=given)


@pytest.mark.parametrize("size", [47, None, "wide", float("nan")])
def test_a_record_that_makes_no_device_is_refused(size):
    (row,) = truth_of(make_device("tank/drum"))["devices"]
    nozzles = [{**row["params"]["nozzles"][0], "size": size}, *row["params"]["nozzles"][1:]]
    with pytest.raises(ValueError, match="tank/drum: these parameters do not fit each other"):
        rebuild({**row, "params": {**row["params"], "nozzles": nozzles}})


@pytest.mark.filterwarnings("ignore:invalid value")
def test_no_device_is_written_whose_corners_are_no_numbers():
    (row,) = truth_of(make_device("post/square"))["devices"]
    with pytest.raises(ValueError, match="post/square: these parameters do not fit each other: they make no solid"):
        rebuild({**row, "params": {**row["params"], "height": float("nan")}})


def test_a_style_by_its_name():
    with pytest.raises(ValueError, match="style 'baroque': give one of"):
        make_device("gate valve/os&y", style="baroque")


def test_sizes_are_those_of_the_family():
    family = family_called("ball valve/two-piece")
    assert make_device(family.name, given={"dn": str(family.sizes[0])}).n_meshes > 1


def test_commands_list_describe_and_write_devices(capsys, tmp_path):
    code, out, _ = run(capsys, "environment", "devices", "gate valve")
    assert code == 0
    assert "gate valve/os&y  inline  Valve assembly" in out
    code, out, _ = run(capsys, "environment", "device", "gate valve/os&y")
    assert code == 0
    assert out.startswith("gate valve/os&y: Valve assembly, inline, DN ")
    scene = tmp_path / "valve.usdc"
    code, _, _ = run(capsys, "environment", "device", "gate valve/os&y", "--set", "dn=80", "-o", scene)
    assert code == 0
    assert scene.exists()
    assert (tmp_path / "valve.truth.json").exists()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("device", "gate valve/os&z"), "'gate valve/os&z' is no family"),
        (("device", "gate valve/os&y", "--set", "dn"), "--set dn: give a parameter and its value as NAME=VALUE"),
        (("device", "gate valve/os&y", "--set", "dn=81"), "dn=81"),
        (("devices", "zeppelin"), "'zeppelin': no family has this in its name"),
    ],
)
def test_commands_refuse_in_one_line(capsys, arguments, said):
    assert said in refused(capsys, "environment", *arguments)
