"""Corrections of the network in small scenes: units, joints, directions, tags, the ground."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

import shapes
from cadgraph.errors import LabelError, OutputError, UnknownNode
from cadgraph.labelers.base import Labeling
from cadgraph.model.corrections import CorrectionsFile, History, read_history
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.query.duty import duty_of
from cadgraph.query.network import Network
from cadgraph.session.session import Session
from sketch import Sketch, around, block

VALVE, TANK, PUMP = ("Valve assembly", "valve"), ("Tank", "tank"), ("Pump unit", "pump")
GAP = 0.4


def line_with_a_gap():
    """Valve, pipe, a missing piece, pipe, tank, along x; a gauge-less drawing in which nothing else is near."""
    sketch = Sketch()
    sketch.add(block((0, 0, 0), 0.2), *VALVE, source="author")
    sketch.pipe((0.1, 0, 0), (1.0, 0, 0), source="author")
    sketch.pipe((1.0 + GAP, 0, 0), (2.0, 0, 0), source="author")
    sketch.add(block((2.25, 0, 0), 0.5), *TANK, source="author")
    return sketch


def session_of(sketch, history=None, **more):
    given = sketch.given(**more.pop("settings", {}))
    n = len(sketch.labels)
    labeling = Labeling(tuple(sketch.labels), ((),) * n, tuple(sketch.labels), (0.5,) * n, given.probabilities)
    return Session(given.analysis, labeling, given.config, history=history, **more)


def part(k):
    return f"/m{k}"


def bytes_of(session):
    return json.dumps(session.graph.to_json())


def flows(graph):
    """Of each connection both names, and which way it flows."""
    name = {unit.id: unit.tag for unit in graph.units()}
    return {
        frozenset((name.get(e.source, e.source), name.get(e.target, e.target))): (
            name.get(e.source if e.direction == "forward" else e.target) if e.direction != "unknown" else None,
            e.reason,
        )
        for e in graph.connections()
    }


def direction(session, source, target, flow="forward"):
    return {"kind": "direction", "source": source, "target": target, "flow": flow}


def test_a_join_makes_a_connection_over_the_straight_gap_and_says_who_did():
    session = session_of(line_with_a_gap())
    assert len(session.graph.terminals()) == 2
    change = session.apply([{"kind": "join", "first": part(1), "second": part(2)}], who="Ann", why="spool not drawn")
    assert (change.changed, change.regrouped) == ((), False)
    (edge,) = session.graph.connections()
    assert edge.length == pytest.approx(1.9, abs=0.12)
    joint = next(j for j in session.graph.joints(made=True) if {j.first, j.second} == {"part-00001", "part-00002"})
    assert (joint.reasons, joint.score) == (("joined by a user",), 1.0)
    assert joint.gap == pytest.approx(GAP, abs=1e-6)
    assert not [d for d in session.graph.diagnostics if d.code == "bridged-gap"]


@pytest.mark.parametrize("turned", [False, True])
def test_a_joint_that_was_cut_and_is_made_again_is_where_it_was(turned):
    session = session_of(line_with_a_gap())
    own = {(j.first, j.second): j for j in session.graph.joints(made=True)}
    lengths = [edge.length for edge in session.graph.connections()]
    for first, second in own:
        session.apply([{"kind": "cut", "first": first, "second": second}])
        pair = (second, first) if turned else (first, second)
        session.apply([{"kind": "join", "first": pair[0], "second": pair[1]}])
    again = {(j.first, j.second): j for j in session.graph.joints(made=True)}
    assert {pair: (j.kind, j.point, j.gap) for pair, j in again.items()} == {
        pair: (j.kind, j.point, j.gap) for pair, j in own.items()
    }
    assert {j.reasons for j in again.values()} == {("joined by a user",)}
    assert [edge.length for edge in session.graph.connections()] == lengths


def test_an_end_is_joined_with_a_far_solid_at_its_surface():
    sketch = line_with_a_gap()
    sketch.meshes[3] = block((2.75, 0, 0), 0.5)
    session = session_of(sketch)
    session.apply([{"kind": "join", "first": part(3), "second": part(2)}])
    edge = next(e for e in session.graph.connections() if "unit-T-001" in (e.source, e.target))
    (port,) = session.graph.unit("T-001").ports
    assert port.point == pytest.approx((2.5, 0, 0), abs=0.05)
    assert edge.length == pytest.approx(1.1, abs=0.06)


def test_two_solids_are_joined_without_a_line():
    sketch = line_with_a_gap()
    sketch.add(block((2.25, 0.75, 0), 0.2), *PUMP, source="author")
    session = session_of(sketch)
    session.apply([{"kind": "join", "first": part(3), "second": part(4)}])
    edge = next(e for e in session.graph.connections() if {e.source, e.target} == {"unit-T-001", "unit-P-001"})
    assert (edge.length, edge.confidence) == (pytest.approx(0.4), 1.0)


def test_an_end_is_joined_with_the_side_of_a_line():
    sketch = line_with_a_gap()
    sketch.pipe((1.7, 0, 0.4), (1.7, 0, 0.9), source="author")
    session = session_of(sketch)
    assert not session.graph.junctions()
    session.apply([{"kind": "join", "first": part(4), "second": part(2)}])
    (junction,) = session.graph.junctions()
    assert junction.point == pytest.approx((1.7, 0, 0), abs=0.2)
    assert sum(edge.length for edge in session.graph.connections(junction)) == pytest.approx(0.6 + 0.9, abs=0.04)


def test_a_cut_joint_makes_no_connection_whatever_is_rebuilt():
    session = session_of(line_with_a_gap())
    assert session.graph.connections("V-001")
    change = session.apply([{"kind": "cut", "first": part(0), "second": part(1)}])
    assert "does not join" in change.message
    assert not session.graph.connections("V-001")
    (joint,) = session.graph.joints("V-001")
    assert (joint.made, joint.reasons) == (False, ("cut by a user",))
    session.apply([{"kind": "join", "first": part(1), "second": part(0)}])
    assert session.graph.connections("V-001")
    session.undo()
    assert not session.graph.connections("V-001")


def test_a_device_that_labels_missed_is_not_found_again_where_it_was_cut_off():
    session = session_of(around((0.24, 0.24, 0.24), "aligned", likely={VALVE: 0.3}))
    assert len(session.graph.units("valve")) == 1
    session.apply([{"kind": "cut", "first": part(0), "second": part(k)} for k in (1, 2)])
    assert not session.graph.units("valve")


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        ({"kind": "join", "first": part(0), "second": part(1)}, "joined already"),
        ({"kind": "join", "first": part(0), "second": part(0)}, "not joined with itself"),
        ({"kind": "join", "first": part(1), "second": part(4)}, "too far apart"),
        ({"kind": "join", "first": part(1), "second": part(5)}, "correct its label first"),
        ({"kind": "cut", "first": part(1), "second": part(2)}, "are not joined"),
        ({"kind": "split", "parts": [part(0)]}, "has only this part"),
        ({"kind": "split", "parts": [part(0), part(3)]}, "of one unit"),
        ({"kind": "split", "parts": [part(1)]}, "is in none"),
        ({"kind": "merge", "parts": [part(1), part(2)]}, "none of these parts is in a unit"),
        ({"kind": "merge", "parts": [part(0)]}, "already"),
        ({"kind": "merge", "parts": [part(0), part(4)]}, "too far apart"),
        ({"kind": "direction", "source": "V-001", "target": "T-001"}, "nothing connects"),
        ({"kind": "tag", "unit": "V-001", "tag": "b 1"}, "another unit is called b 1"),
        ({"kind": "join", "first": "part-00000", "second": "V-001"}, "V-001 is a unit, and parts join: name that one"),
        ({"kind": "tag", "unit": "V-001", "tag": " "}, "at least one letter"),
        ({"kind": "tag", "unit": "V-001", "tag": "P-1 -> V-2"}, "-> stands between names"),
        ({"kind": "tag", "unit": "V-001", "tag": "x" * 65}, "at most 64"),
        ({"kind": "tag", "unit": "V-001", "tag": "a\nb"}, "can't be printed"),
        ({"kind": "tag", "unit": "V-001", "tag": "part-00001"}, "ids of the graph"),
        ({"kind": "tag", "unit": "V-001", "tag": "L-3206"}, "numbers of lines"),
        ({"kind": "tag", "unit": "V-001", "tag": "P-001, G-002"}, "a comma stands between tags"),
        ({"kind": "ground", "part": part(0), "ground": False}, "no ground already"),
        ({"kind": "forget", "part": part(0)}, "nobody corrected"),
        ({"kind": "tag", "unit": "V-001"}, "edit 1: 'tag' is missing"),
        ({"kind": "paint", "part": part(0)}, "edit 1 must be"),
        ({"kind": "label", "part": part(0), "group": "Tank", "colour": "red"}, "'colour'"),
        ({"kind": "label", "part": part(0), "group": 3}, "'group' must be text"),
    ],
    ids=lambda value: value if isinstance(value, str) else value["kind"],
)
def test_what_can_not_be_carried_out_is_refused_in_one_line_and_changes_nothing(refusing, edit, words):
    session, before = refusing
    with pytest.raises(ValueError, match=words) as caught:
        session.apply([{"kind": "tag", "unit": "T-001", "tag": "B-1"}, edit])
    assert "\n" not in str(caught.value)
    assert (bytes_of(session), session.history) == (before, History())


def test_two_units_change_tags_with_each_other_in_one_correction():
    session = session_of(line_with_a_gap())
    before = {unit.tag: unit.parts for unit in session.graph.units()}
    with pytest.raises(ValueError, match="another unit is called V-001"):
        session.apply([{"kind": "tag", "unit": "T-001", "tag": "v 001"}])
    session.apply([{"kind": "tag", "unit": "T-001", "tag": "V-001"}, {"kind": "tag", "unit": "V-001", "tag": "T-001"}])
    assert {unit.tag: unit.parts for unit in session.graph.units()} == {
        "V-001": before["T-001"], "T-001": before["V-001"],
    }  # fmt: skip
    assert not session.lost


def test_what_a_unit_is_counts_for_all_that_follows(tmp_path):
    session = session_of(line_with_a_gap(), file=CorrectionsFile(tmp_path))
    change = session.apply([{"kind": "device", "unit": "V-001", "device": " check valve "}])
    assert change.message.startswith("V-001 is a check valve")
    unit = session.graph.unit("V-001")
    assert (unit.kind, unit.kind_guesses) == ("check valve", ())
    assert duty_of(Network(session.graph), unit.id) == "check"
    with pytest.raises(ValueError, match="V-001 is a check valve already"):
        session.apply([{"kind": "device", "unit": "V-001", "device": "check valve"}])
    with pytest.raises(ValueError, match="both in one correction"):
        session.apply([{"kind": "device", "unit": "V-001", "device": name} for name in ("ball valve", "gate valve")])
    again = session_of(line_with_a_gap(), CorrectionsFile(tmp_path).read(default_vocabulary()))
    assert again.graph.unit("V-001").kind == "check valve"
    session.apply([{"kind": "device", "unit": "V-001", "device": "gate valve"}])
    assert session.graph.unit("V-001").kind == "gate valve"
    assert len(session.corrections) == 1
    session.undo()
    session.undo()
    assert session.graph.unit("V-001").kind != "check valve"


def test_units_that_keep_their_numbers_keep_them_when_one_before_them_is_gone():
    sketch = line_with_a_gap()
    sketch.add(block((5, 0, 0), 0.2), *VALVE, source="author")
    session = session_of(sketch)
    gone, kept = session.graph.unit("V-001"), session.graph.unit("V-002")
    away = {"kind": "label", "part": gone.parts[0], "group": "Structural element", "name": "beam", "this_only": True}
    assert session.apply([away]).message.count("V-002") >= 1
    assert session.graph.unit_of(session.graph.part(kept.parts[0])).tag == "V-001"
    session.undo()
    assert session.apply([{"kind": "tag", "unit": "V-002", "tag": "V-002"}]).message == "V-002 keeps its tag"
    with pytest.raises(ValueError, match="is called so already, and keeps it"):
        session.apply([{"kind": "tag", "unit": "V-002", "tag": "V-002"}])
    session.apply([away])
    assert session.graph.unit_of(session.graph.part(kept.parts[0])).tag == "V-002"


def test_one_correction_says_one_thing_of_each(refusing):
    session, before = refusing
    tag, label = {"kind": "tag", "unit": "V-001"}, {"kind": "label", "part": part(1), "group": "Pipe assembly"}
    for first, second in (
        ({**tag, "tag": "X-1"}, {**tag, "tag": "X-2"}),
        ({**label, "name": "pipe"}, {**label, "name": "hose"}),
    ):
        with pytest.raises(ValueError, match="both in one correction; say one of them"):
            session.apply([first, second])
    assert (bytes_of(session), session.history) == (before, History())
    session.apply([{**label, "name": "hose"}, {**label, "name": "hose"}])
    session.undo()


@pytest.fixture(scope="module")
def refusing():
    sketch = line_with_a_gap()
    sketch.pipe((9.0, 0, 0), (9.9, 0, 0), source="author")
    sketch.add(block((1.0, 0.2, 0), (0.1, 0.1, 0.1)), "Structural assembly", "beam", source="author")
    session = session_of(sketch)
    return session, bytes_of(session)


def test_unknown_names_are_refused():
    session = session_of(line_with_a_gap())
    for edit in (
        {"kind": "tag", "unit": "V-900", "tag": "x"},
        {"kind": "cut", "first": "/nowhere", "second": part(1)},
        {"kind": "direction", "source": "V-001", "target": "nowhere"},
    ):
        with pytest.raises(UnknownNode):
            session.apply([edit])
    with pytest.raises(LabelError, match="did you mean"):
        session.apply([{"kind": "label", "part": part(0), "group": "Tank", "name": "tnk"}])


def test_merged_units_are_one_with_the_type_of_the_larger_and_split_ones_are_two():
    sketch = line_with_a_gap()
    sketch.add(block((2.25, 0, 0.3), 0.1), *PUMP, source="author")
    session = session_of(sketch)
    before = bytes_of(session)
    session.apply([{"kind": "merge", "parts": [part(3), part(4)]}])
    assert [(u.tag, len(u.parts)) for u in session.graph.units()] == [("T-001", 2), ("V-001", 1)]
    session.apply([{"kind": "split", "parts": [part(4)]}])
    assert sorted(len(u.parts) for u in session.graph.units("tank")) == [1, 1]
    assert not session.graph.units("pump")
    session.undo()
    session.undo()
    assert bytes_of(session) == before


def test_a_part_that_comes_to_a_unit_carries_no_line_any_more():
    session = session_of(line_with_a_gap())
    session.apply([{"kind": "merge", "parts": [part(0), part(1)]}])
    unit = session.graph.unit("V-001")
    assert unit.parts == ("part-00000", "part-00001")
    assert not session.graph.connections(unit)


def test_a_tag_is_used_everywhere_and_changes_nothing_else():
    session = session_of(line_with_a_gap())
    before = bytes_of(session)
    hostile = "<img onerror=1> / V-4711 äß"
    change = session.apply([{"kind": "tag", "unit": "V-001", "tag": f"  {hostile} "}])
    what, lines = change.message.rsplit("; ", 1)
    assert what == f"V-001 is called {hostile}"
    assert re.fullmatch(r"line L-\d{4} is now L-\d{4}", lines)
    assert session.graph.unit(hostile).id == f"unit-{hostile}"
    assert bytes_of(session).replace(json.dumps(hostile)[1:-1], "V-001") == before


def test_a_number_that_a_user_gave_to_another_unit_moves_on():
    sketch = line_with_a_gap()
    sketch.add(block((5, 0, 0), 0.2), *VALVE, source="author")
    session = session_of(sketch)
    session.apply([{"kind": "tag", "unit": "V-002", "tag": "V-7"}])
    session.apply([{"kind": "tag", "unit": "V-001", "tag": "V-8"}])
    session.apply([{"kind": "tag", "unit": "V-7", "tag": "V-001"}])
    assert {u.tag: u.parts[0] for u in session.graph.units("valve")} == {"V-8": "part-00000", "V-001": "part-00004"}
    session.undo()
    assert {u.tag for u in session.graph.units("valve")} == {"V-8", "V-7"}


def test_a_set_direction_beats_geometry_and_spreads():
    sketch = Sketch()
    sketch.add(block((0, 0, 0), 0.2), *TANK, source="author")
    for x in (0.1, 1.2):
        sketch.pipe((x, 0, 0), (x + 0.9, 0, 0), source="author")
        sketch.add(block((x + 1.0, 0, 0), 0.2), *VALVE, source="author")
    sketch.pipe((2.3, 0, 0), (3.0, 0, 0), source="author")
    sketch.add(block((3.1, 0, 0), 0.2), *TANK, source="author")
    session = session_of(sketch, settings={"relate.flow": ("T-001 -> T-002",)})
    assert set(flows(session.graph).values()) == {
        ("T-001", "stated: T-001 -> T-002"),
        ("V-001", "stated: T-001 -> T-002"),
        ("V-002", "stated: T-001 -> T-002"),
    }
    for other in (direction(session, "V-001", "V-002"), direction(session, "V-002", "V-001", "backward")):
        with pytest.raises(ValueError, match="both in one correction; say one of them"):
            session.apply([direction(session, "V-002", "V-001"), other])
    change = session.apply([direction(session, "V-002", "V-001")])
    assert change.message.startswith("it flows from V-002 to V-001; the flow turns in 3 connections")
    told = flows(session.graph)
    assert told[frozenset(("V-001", "V-002"))] == ("V-002", "set by a user: V-002 -> V-001")
    assert told[frozenset(("V-001", "T-001"))] == ("V-001", "set by a user: V-002 -> V-001")
    against = [d.message for d in session.graph.diagnostics if d.code == "flow-contradiction"]
    assert "but stated: T-001 -> T-002" in against[0]
    with pytest.raises(ValueError, match="contradicts it"):
        session.apply([direction(session, "T-001", "V-001")])
    with pytest.raises(ValueError, match=r"^direction between T-001 and V-001 taken back: no direction was set there"):
        session.apply([direction(session, "T-001", "V-001", "unknown")])
    session.apply([direction(session, "V-001", "V-002", "unknown")])
    assert flows(session.graph)[frozenset(("V-001", "V-002"))] == ("V-001", "stated: T-001 -> T-002")
    session.apply([{"kind": "tag", "unit": "T-001", "tag": "B-1"}])
    assert flows(session.graph)[frozenset(("B-1", "V-001"))][1] == "stated: B-1 -> T-002"


def test_several_edits_are_one_action():
    session = session_of(line_with_a_gap())
    before = bytes_of(session)
    session.apply(
        [
            {"kind": "label", "part": part(1), "group": "Pipe assembly", "name": "elbow", "this_only": True},
            {"kind": "label", "part": part(2), "group": "Pipe assembly", "name": "elbow", "this_only": True},
            {"kind": "tag", "unit": "V-001", "tag": "V-4711"},
        ],
        who="Ann",
        why="P&ID",
    )
    (row,) = session.history.audit()
    assert row["what"].startswith("2 parts are Pipe assembly/elbow, these alone; V-001 is called V-4711; line L-")
    assert (row["who"], row["why"], row["undone"]) == ("Ann", "P&ID", False)
    assert row["when"].endswith("Z")
    session.undo(who="Bob")
    assert bytes_of(session) == before
    assert [(r["who"], r["undone"]) for r in session.history.audit()] == [("Bob", False), ("Ann", True)]


def test_ground_takes_a_part_out_of_its_structure_and_gives_it_back():
    session = session_of(line_with_a_gap())
    before = bytes_of(session)
    change = session.apply([{"kind": "ground", "part": part(1), "ground": True}])
    assert change.regrouped
    assert session.graph.part(part(1)).ground
    assert session.graph.cluster_of(part(1)) is None
    assert [d.message for d in session.graph.diagnostics if d.code == "ground-corrected"] == [
        "1 mesh: the ground, as a user said so"
    ]
    with pytest.raises(ValueError, match="is the ground"):
        session.apply([{"kind": "join", "first": part(1), "second": part(2)}])
    session.apply([{"kind": "ground", "part": part(1), "ground": False}])
    assert json.loads(bytes_of(session)) == json.loads(before)


EDITS = [
    [{"kind": "join", "first": part(1), "second": part(2)}],
    [{"kind": "tag", "unit": "V-001", "tag": "V-4711"}, {"kind": "tag", "unit": "T-001", "tag": "B 1"}],
    [{"kind": "direction", "source": "B 1", "target": "V-4711", "flow": "forward"}],
    [{"kind": "cut", "first": part(0), "second": part(1)}],
    [{"kind": "label", "part": part(2), "group": "Pipe assembly", "name": "elbow", "this_only": True}],
]


def test_all_of_it_is_on_the_disk_and_comes_back(tmp_path):
    session = session_of(line_with_a_gap(), file=CorrectionsFile(tmp_path))
    states = [bytes_of(session)]
    for edits in EDITS:
        session.apply(edits)
        states.append(bytes_of(session))
    file = CorrectionsFile(tmp_path)
    again = session_of(line_with_a_gap(), file.read(), file=file)
    assert bytes_of(again) == states[-1]
    for state in states[-2::-1]:
        again.undo()
        assert bytes_of(again) == state
    once_more = session_of(line_with_a_gap(), read_history(tmp_path))
    for state in states[1:]:
        once_more.redo()
        assert bytes_of(once_more) == state
    assert once_more.lost == ()
    with pytest.raises(OutputError, match="another program"):
        session.undo()
    assert bytes_of(session) == states[-1]
    assert len(session.history.events) == len(EDITS)


def test_a_full_disk_is_said_and_changes_nothing(tmp_path, monkeypatch):
    session = session_of(line_with_a_gap(), file=CorrectionsFile(tmp_path))
    session.apply(EDITS[0])
    before, held = bytes_of(session), (tmp_path / "corrections.json").read_bytes()

    def full(number):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OutputError, match="No space left"):
        session.apply(EDITS[1])
    assert (bytes_of(session), len(session.history.events)) == (before, 1)
    assert [f.name for f in tmp_path.iterdir()] == ["corrections.json"]
    assert (tmp_path / "corrections.json").read_bytes() == held


def test_in_a_changed_model_what_fits_is_kept_and_the_rest_is_told(tmp_path):
    session = session_of(line_with_a_gap())
    for edits in EDITS:
        session.apply(edits)
    history = session.history
    changed = line_with_a_gap()
    changed.meshes[3] = block((2.25, 0, 0), 0.4)  # the tank is another one

    def renamed():
        given = changed.given()
        scene = given.analysis.scene
        return replace(scene, paths=tuple(f"/new{k}" for k in range(scene.n_meshes)))

    again = session_of(Renamed(changed, renamed()), history)
    assert again.graph.unit("V-4711").parts == ("part-00000",)
    assert not again.graph.connections("V-4711")
    assert again.graph.part("/new2").label.name == "elbow"
    assert again.lost == ("tag B 1 of the unit of /m3: all of its 1 parts are not there any more",)
    assert again.history == history
    assert {u.tag for u in again.graph.units()} == {"V-4711", "T-001"}


class Renamed(Sketch):
    """A sketch whose meshes have other paths."""

    def __init__(self, sketch, scene):
        super().__init__()
        vars(self).update(vars(sketch))
        self.scene = scene

    def given(self, **settings):
        from cadgraph.pipeline import analyse

        given = super().given(**settings)
        return replace(given, analysis=analyse(self.scene, given.config))


def test_the_paper_has_units_and_tags_but_no_lines():
    session = session_of(line_with_a_gap(), settings={"method": "paper", "group.max_volume": 0.0})
    session.apply([{"kind": "tag", "unit": "V-001", "tag": "V-4711"}])
    assert {u.tag for u in session.graph.units()} == {"V-4711", "T-001"}
    joined = session_of(line_with_a_gap())
    joined.apply(EDITS[0])
    paper = session_of(line_with_a_gap(), joined.history, settings={"method": "paper"})
    assert paper.lost == ("joint of /m1 and /m2: method = 'paper' knows no lines",)


def test_a_scene_may_lie_far_from_the_origin():
    sketch = line_with_a_gap()
    far = np.array([1e5, -2e5, 300.0])
    sketch.meshes = [shapes.moved(mesh, translation=far) for mesh in sketch.meshes]
    session = session_of(sketch)
    for edits in EDITS:
        session.apply(edits)
    given = sketch.given()
    again = Session(given.analysis, session.labeling, given.config, history=session.history)
    assert bytes_of(again) == bytes_of(session)
    assert again.lost == ()
    assert isinstance(given.analysis.scene, Scene)
