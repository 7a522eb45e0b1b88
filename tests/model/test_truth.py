import json
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from cadgraph.errors import FormatError, OutputError
from cadgraph.model.truth import (
    Truth,
    TruthCluster,
    TruthConnection,
    TruthLine,
    TruthMesh,
    TruthPoint,
    TruthUnit,
    check_truth,
)
from cadgraph.model.vocabulary import default_vocabulary
from lab.evaluate.plants import line

PAGE = Path(__file__).parents[2] / "docs" / "truth.md"
HEAD = {"format": "cadgraph-truth", "version": 1}


def examples():
    return [json.loads(text) for text in re.findall(r"```json\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)]


def test_documented_examples_load_and_have_nothing_to_complain_about():
    whole, least = (Truth.from_json(example) for example in examples())
    assert (len(whole.meshes), len(whole.units), len(whole.connections), len(whole.contacts)) == (9, 3, 4, 5)
    findings = check_truth(whole, default_vocabulary(), [row.mesh for row in whole.meshes])
    assert findings == ("1 meshes in no cluster (right for the ground only): /World/Geo_08",)
    assert least.units is None
    assert least.clusters is None
    assert check_truth(least, default_vocabulary()) == ()


def test_documented_check_runs(tmp_path, monkeypatch):
    from cadplants import make_skid, write_usd

    write_usd(make_skid(), tmp_path / "plant.usd")
    monkeypatch.chdir(tmp_path)
    code = re.search(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S).group(1)
    found = []
    exec(code, {"print": found.append})
    assert found == []


def test_every_key_is_documented():
    page = PAGE.read_text(encoding="utf-8")
    for record in (Truth, TruthMesh, TruthUnit, TruthPoint, TruthConnection, TruthLine, TruthCluster):
        for name, field in record.model_fields.items():
            assert f"`{field.alias or name}`" in page


def test_round_trip_keeps_unknown_keys(tmp_path):
    data = line().to_json()
    data["author"] = {"name": "me", "ärger": [1, 2.5, None]}
    data["meshes"][0]["note"] = "rusty"
    data["units"][0]["dn"] = 50
    truth = Truth.from_json(data)
    assert Truth.load(truth.save(tmp_path / "a.truth.json")) == truth
    assert truth.to_json()["author"]["ärger"] == [1, 2.5, None]
    assert truth.to_json()["meshes"][0]["note"] == "rusty"


def test_saving_twice_gives_the_same_bytes(tmp_path):
    first, second = line().save(tmp_path / "a.json"), line().save(tmp_path / "b.json")
    assert first.read_bytes() == second.read_bytes()


def test_written_plants_load(tmp_path):
    from cadplants import make_skid, write_usd

    plant = make_skid(2)
    truth = Truth.load(write_usd(plant, tmp_path / "skid.usdc"))
    assert [row.group for row in truth.meshes] == [component.group for component in plant.components]
    assert len(truth.units) == len(plant.units)
    assert truth.meters_per_unit == 0.001
    assert check_truth(truth, default_vocabulary()) == ()


def test_bare_lists_are_clusters():
    truth = Truth.from_json({**HEAD, "meshes": [{"mesh": "/a"}], "clusters": [["/a"]]})
    assert truth.clusters == (TruthCluster(id=None, meshes=("/a",)),)
    assert truth.to_json()["clusters"] == [{"id": None, "meshes": ["/a"]}]


def test_absent_sections_stay_apart_from_empty_ones(tmp_path):
    absent = Truth.from_json(HEAD)
    empty = Truth.from_json({**HEAD, "units": [], "contacts": []})
    for truth in (absent, empty):
        assert Truth.load(truth.save(tmp_path / "t.json")) == truth
    assert (absent.units, absent.contacts, empty.units, empty.contacts) == (None, None, (), ())


MESHES = {"meshes": [{"mesh": "/a"}, {"mesh": "/b"}]}
UNIT = {"id": "V", "type": "valve", "meshes": ["/a"]}
WRONG = [
    ([], "not a truth file"),
    ({"format": "cadgraph"}, "'cadgraph-truth'"),
    ({**HEAD, "version": 2}, "version 2, but this cadgraph reads version 1"),
    ({**HEAD, "meshes": [{"group": "Tank"}]}, "meshes.0.mesh"),
    ({**HEAD, "meshes": [{"mesh": "/a"}, {"mesh": "/a"}]}, "'/a' is listed twice"),
    ({**HEAD, **MESHES, "units": [{**UNIT, "meshes": []}]}, "units.0.meshes"),
    ({**HEAD, **MESHES, "units": [{**UNIT, "meshes": ["/c"]}]}, "'/c' is not in this truth"),
    ({**HEAD, **MESHES, "units": [UNIT, {**UNIT, "id": "W"}]}, "units: mesh '/a' is listed twice"),
    ({**HEAD, **MESHES, "units": [UNIT], "points": [{"id": "V", "kind": "terminal"}]}, "id 'V' is listed twice"),
    ({**HEAD, **MESHES, "units": [UNIT], "connections": [{"from": "V", "to": "X"}]}, "'X' is not in this truth"),
    ({**HEAD, **MESHES, "connections": [{"from": "V"}]}, "connections.0.to"),
    ({**HEAD, **MESHES, "clusters": [["/a"], ["/a"]]}, "clusters: mesh '/a' is listed twice"),
    ({**HEAD, **MESHES, "clusters": [{"id": "S", "meshes": ["/a"]}, {"id": "S", "meshes": []}]}, "id 'S'"),
    ({**HEAD, **MESHES, "contacts": [["/a", "/z"]]}, "'/z' is not in this truth"),
    ({**HEAD, **MESHES, "contacts": [["/a"]]}, "contacts.0"),
    ({**HEAD, **MESHES, "duplicates": [["/a", "/y"]]}, "duplicates: mesh '/y'"),
    ({**HEAD, **MESHES, "hidden": ["/z"]}, "hidden and flaws: mesh '/z'"),
    ({**HEAD, **MESHES, "looseness": -1}, "looseness"),
    ({**HEAD, "points": [{"id": "e", "kind": "end"}]}, "points.0.kind"),
]


@pytest.mark.parametrize(("data", "message"), WRONG, ids=[message for _, message in WRONG])
def test_wrong_content_is_a_format_error_that_names_the_key(data, message):
    with pytest.raises(FormatError, match=re.escape(message)) as caught:
        Truth.from_json(data, "plant.truth.json")
    assert str(caught.value).startswith("plant.truth.json: ")
    assert "\n" not in str(caught.value)


def test_values_that_contradict_each_other_are_refused_when_made():
    with pytest.raises(ValidationError):
        Truth(meshes=(TruthMesh(mesh="/a"), TruthMesh(mesh="/a")))


@pytest.mark.parametrize(
    ("content", "message"),
    [(b"{", "not JSON"), (b"\xff\xfe\x00", "not UTF-8"), (b'{"a": NaN}', "NaN"), (b"[" * 200_000, "not JSON")],
)
def test_damaged_files_are_format_errors(tmp_path, content, message):
    (tmp_path / "t.json").write_bytes(content)
    with pytest.raises(FormatError, match=message):
        Truth.load(tmp_path / "t.json")


def test_a_missing_file_is_a_format_error_with_its_path(tmp_path):
    with pytest.raises(FormatError, match=r"nothing\.json: no such file; check the path"):
        Truth.load(tmp_path / "nothing.json")


def test_a_folder_that_is_a_file_is_an_output_error(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        line().save(tmp_path / "file" / "t.json")


def test_check_tells_what_is_most_likely_not_meant():
    truth = Truth.from_json(
        {
            **HEAD,
            "meshes": [
                {"mesh": "/a", "group": "Valves"},
                {"mesh": "/b", "group": "Valve assembly", "name": "pipe"},
                {"mesh": "/c"},
                {"mesh": "/d", "group": "Pipe assembly", "name": "pipe"},
            ],
            "units": [
                {"id": "U", "type": "valves", "meshes": ["/a"]},
                {"id": "W", "type": "valve", "meshes": ["/d"]},
            ],
            "points": [{"id": "e", "kind": "terminal"}],
            "clusters": [["/a", "/b", "/c"]],
        }
    )
    assert check_truth(truth, default_vocabulary(), ["/a", "/b", "/c", "/x"]) == (
        "1 groups that are not in the vocabulary: Valves",
        "1 names that are not in their group: Valve assembly / pipe",
        "1 meshes without a group (not evaluated): /c",
        "1 unit types that are not in the vocabulary: valves",
        "1 units of which no mesh has a group of their type: W",
        "1 meshes in no cluster (right for the ground only): /d",
        "1 points that no connection names: e",
        "1 meshes that the scene doesn't have: /d",
        "1 meshes of the scene that are not listed: /x",
    )


NAMES = st.text(min_size=1, max_size=5)


@given(
    st.lists(st.tuples(NAMES, st.none() | NAMES, st.none() | NAMES, st.booleans()), unique_by=lambda row: row[0]),
    st.dictionaries(NAMES.map(lambda name: "x-" + name), st.none() | st.integers() | NAMES),
)
def test_any_truth_survives_json(rows, more):
    meshes = [{"mesh": m, "group": g, "name": n} for m, g, n, _ in rows]
    hidden = [row[0] for row in rows if row[3]]
    clusters = [[row[0] for row in rows]]
    truth = Truth.from_json({**HEAD, **more, "meshes": meshes, "clusters": clusters, "hidden": hidden})
    assert Truth.from_json(json.loads(json.dumps(truth.to_json()))) == truth
