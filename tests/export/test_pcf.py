"""Lines as piping component files, read back by a strict reader: gaps, lengths, and what they hold."""

from __future__ import annotations

import json
import math
from itertools import pairwise

import pytest

import graphs
import networks
from cadgraph.errors import OutputError
from cadgraph.export import write_export
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Joint, Port
from cadgraph.query.components import find_components
from cadgraph.query.lines import find_lines
from cadgraph.query.polyline import Polyline
from cadgraph.session.run import run
from cadplants import make, write_usd
from cadplants.writers.usd import truth_path
from pcf_reader import Pcf

PIPING = "Pipe assembly"


def pipe_part(number, name, *, group=PIPING):
    return graphs.part(number, label=graphs.label(group, name) if name else None)


def valve(tag, kind, parts, ports):
    base = networks.unit(tag, kind, at=ports[0])
    named = tuple(Port(name=f"N{i}", point=point, diameter=0.05) for i, point in enumerate(ports, 1))
    return base.model_copy(update={"parts": tuple(parts), "ports": named})


def join(first, second, at, kind="face"):
    return Joint(first=first, second=second, kind=kind, point=at, gap=0.0, score=0.9, made=True)


def edge(source, target, via, path, **more):
    values = {"size": 50, "diameter": 0.05, "length": sum(math.dist(a, b) for a, b in pairwise(path)), **more}
    (made,) = networks.chain(f"{source} {target}", direction="unknown")
    return made.model_copy(update={"via": tuple(via), "path": tuple(path), **values})


def arc(center, radius, start, turn, steps=16):
    """Points of an arc in the plane of x and y, by angles in degrees."""
    angles = [math.radians(start + turn * i / steps) for i in range(steps + 1)]
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a), 0.0) for a in angles]


def outlet_between_pipes():
    """Two pipes meet end to end; over where they do an outlet is set, with a branch of one pipe."""
    parts = [pipe_part(i, name) for i, name in enumerate(["pipe", "pipe", "branch outlet", "pipe"])]
    at = (3.0, 0.0, 0.0)
    joint = networks.junction(1, at).model_copy(update={"parts": ("part-0", "part-1", "part-2")})
    joints = [
        join("part-0", "part-1", at),
        join("part-2", "part-0", at, "tap"),
        join("part-2", "part-3", (3.0, 0.0, 0.1)),
    ]
    ends = [networks.terminal(k, "open", point) for k, point in enumerate([(0.0, 0, 0), (5.0, 0, 0), (3.0, 0, 1.1)], 1)]
    edges = [
        edge("X1", "J1", ["part-0"], [(0.0, 0.0, 0.0), at]),
        edge("J1", "X2", ["part-1"], [at, (5.0, 0.0, 0.0)]),
        edge("J1", "X3", ["part-2", "part-3"], [at, (3.0, 0.0, 0.1), (3.0, 0.0, 1.1)]),
    ]
    return networks.network([*parts, joint, *ends], edges, joints=joints)


def test_an_outlet_where_two_pipes_meet_is_set_on_them_and_they_stay_pipes():
    lines = find_components(outlet_between_pipes())
    found = [component for line in lines for component in line.components]
    lengths = {c.parts[0]: c.length for c in found if c.kind == "pipe"}
    assert lengths == pytest.approx({"part-0": 3.0, "part-1": 2.0, "part-3": 1.0})
    (outlet,) = [c for c in found if c.kind != "pipe"]
    assert (outlet.kind, outlet.parts, outlet.centre) == ("branch outlet", ("part-2",), pytest.approx((3.0, 0.0, 0.0)))
    assert outlet.branches[0].point == pytest.approx((3.0, 0.0, 0.1))


def valve_line():
    """X1 - pipe - flange - gasket - V-001 - gasket - flange - pipe - elbow - pipe - blind flange - X2, DN 50."""
    names = ["pipe", "flange", "gasket", "gasket", "flange", "pipe", "elbow", "pipe", "blind flange"]
    parts = [pipe_part(i, name) for i, name in enumerate(names)]
    body = pipe_part(20, "valve body", group="Valve assembly")
    x = [0.0, 1.0, 1.06, 1.062, 1.262, 1.264, 1.324, 2.324]
    at = [(value, 0.0, 0.0) for value in x]
    bend = arc((2.324, 0.076), 0.076, -90, 90)
    top, end, lid = (2.4, 0.076, 0.0), (2.4, 1.076, 0.0), (2.4, 1.09, 0.0)
    corners = [at[1], at[2], None, at[5], at[6], at[7], top, end]
    joints = [
        join(f"part-{i}", f"part-{i + 1}", corner) for i, corner in enumerate(corners) if corner is not None and i != 2
    ]
    joints += [join("part-2", "part-20", at[3], "mount"), join("part-3", "part-20", at[4], "mount")]
    joints = [j for j in joints if {j.first, j.second} != {"part-2", "part-3"}]
    middle = (1.162, 0.0, 0.0)
    nodes = (
        *parts,
        body,
        networks.terminal(1, "open", at[0]),
        networks.terminal(2, "blind", lid),
        valve("V-001", "ball valve", ["part-20"], [at[3], at[4]]),
    )
    edges = (
        edge("X1", "V-001.N1", ["part-0", "part-1", "part-2"], [at[0], at[1], at[2], at[3], middle]),
        edge("V-001.N2", "X2", [f"part-{i}" for i in range(3, 9)], [middle, *at[4:7], *bend, end, lid]),
    )
    return networks.network(nodes, edges, joints=joints)


def written(graph, folder):
    done = write_export(graph, "pcf", folder)
    return [Pcf(file.read_bytes()) for file in done.files], {note.code for note in done.notes}


def test_components_stand_in_order_and_share_their_ends(tmp_path):
    (pcf,), codes = written(valve_line(), tmp_path)
    assert pcf.faults() == []
    assert [record.keyword for record in pcf.chain] == [
        *("PIPE", "FLANGE", "GASKET", "VALVE", "GASKET", "FLANGE", "PIPE", "ELBOW", "PIPE", "FLANGE-BLIND"),
    ]
    assert [record.keyword for record in pcf.closing] == ["END-POSITION-OPEN", "END-POSITION-CLOSED"]
    ball = pcf.chain[3]
    assert (ball.one("SKEY"), ball.one("TAG")) == ("VBFL", "V-001")
    assert ball.ends == [[1062.0, 0.0, 0.0, 50.0], [1262.0, 0.0, 0.0, 50.0]]
    assert ball.parts == ["part-20"]
    assert codes == {"assumed-ends"}


def test_an_elbow_turns_about_the_point_where_its_tangents_meet(tmp_path):
    (pcf,), _ = written(valve_line(), tmp_path)
    (elbow,) = (record for record in pcf.chain if record.keyword == "ELBOW")
    assert elbow.one("SKEY") == "ELBW"
    assert int(elbow.one("ANGLE")) == pytest.approx(9000, abs=20)
    assert elbow.centre == pytest.approx([2400.0, 0.0, 0.0], abs=0.5)
    (line,) = find_lines(valve_line())
    assert pcf.length == pytest.approx(line.length * 1000, abs=1.0)


def with_taps(graph, *places):
    """The same plant with pressure gauges on the pipe before the valve."""
    first, *others = (e for e in graph.document.edges if e.kind == "connected")
    nodes, edges, start = list(graph.document.nodes), [], "X1"
    for number, x in enumerate(places, 1):
        tag, here = f"G-{number:03d}", (x, 0.0, 0.0)
        nodes += [networks.unit(tag, "pressure gauge", at=(x, 0.0, 0.2))]
        edges.append(edge(start, tag, ["part-0"], [first.path[0] if start == "X1" else edges[-1].path[-1], here]))
        start = tag
    last = first.model_copy(
        update={"source": networks.id_of(start), "path": (edges[-1].path[-1], *first.path[1:]), "length": None}
    )
    rest = [e for e in graph.document.edges if e.kind not in ("connected", "contains")]
    return networks.network(
        [n for n in nodes if n.layer not in ("site", "system")],
        [*edges, last, *others, *rest],
        joints=graph.document.joints,
    )


def test_a_pipe_is_cut_where_instruments_sit_on_it(tmp_path):
    (pcf,), _ = written(with_taps(valve_line(), 0.25, 0.75), tmp_path)
    assert pcf.faults() == []
    pipes = [record for record in pcf.chain if record.parts == ["part-0"]]
    assert [record.length for record in pipes] == pytest.approx([250, 500, 250])
    dials = [record for record in pcf.records if record.keyword == "INSTRUMENT-DIAL"]
    assert [(dial.one("TAG"), dial.place[0]) for dial in dials] == [("G-001", 250.0), ("G-002", 750.0)]


def test_a_pipe_with_bends_in_one_piece_is_pipes_and_bends(tmp_path):
    ring = [(0.0, 0.0, 0.0), *arc((1.0, 0.15), 0.15, -90, 90), *arc((1.3, 0.2), 0.15, 180, -90), (2.0, 0.35, 0.0)]
    graph = networks.network(
        (pipe_part(0, "pipe"), networks.terminal(1, "open", ring[0]), networks.terminal(2, "open", ring[-1])),
        [edge("X1", "X2", ["part-0"], ring)],
    )
    (pcf,), codes = written(graph, tmp_path)
    assert pcf.faults() == []
    assert [r.keyword for r in pcf.chain] == ["PIPE", "BEND", "PIPE", "BEND", "PIPE"]
    bends = [record for record in pcf.chain if record.keyword == "BEND"]
    assert [bend.centre for bend in bends] == [
        pytest.approx([1150, 0, 0], abs=2),
        pytest.approx([1150, 350, 0], abs=2),
    ]
    assert [math.dist(bend.ends[0][:3], bend.centre) for bend in bends] == pytest.approx([150, 150], abs=3)
    assert pcf.length == pytest.approx(sum(math.dist(a, b) for a, b in pairwise(ring)) * 1000, rel=2e-3)
    assert codes == {"unknown-symbol"}


def branching(*, hosted):
    """Three lines that meet at J1: in a tee, or the third set on a pipe that goes through."""
    center = (1.0, 0.0, 0.0)
    parts = [
        pipe_part(0, "pipe"),
        pipe_part(1, "pipe"),
        pipe_part(2, "pipe"),
        pipe_part(3, "pipe" if hosted else "tee"),
    ]
    ends = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (1.0, 1.0, 0.0)]
    mouths = [(0.9, 0.0, 0.0), (1.1, 0.0, 0.0), (1.0, 0.03 if hosted else 0.08, 0.0)]
    joints = [
        join(f"part-{i}", "part-3", mouth, "tap" if hosted and i == 2 else "face") for i, mouth in enumerate(mouths)
    ]
    nodes = [
        *parts,
        networks.junction(1, center).model_copy(update={"parts": ("part-3",)}),
        *(networks.terminal(i + 1, "open", end) for i, end in enumerate(ends)),
    ]
    edges = [
        edge(f"X{i + 1}", "J1", [f"part-{i}", "part-3"], [ends[i], mouths[i], center], size=50 if i < 2 else 25)
        for i in range(3)
    ]
    return networks.network(nodes, edges, joints=joints)


def test_a_tee_stands_in_one_line_and_the_others_end_at_it(tmp_path):
    pcfs, _ = written(branching(hosted=False), tmp_path)
    assert [fault for pcf in pcfs for fault in pcf.faults()] == []
    (tee,) = (record for pcf in pcfs for record in pcf.records if record.keyword == "TEE")
    assert tee.one("SKEY") == "TEBW"
    assert sorted(tee.ends) == [[900.0, 0.0, 0.0, 50.0], [1100.0, 0.0, 0.0, 50.0]]
    assert tee.centre == [1000.0, 0.0, 0.0]
    assert tee.branches == [[1000.0, 80.0, 0.0, 25.0]]
    places = [tuple(end.place) for pcf in pcfs for end in pcf.closing if end.keyword == "END-CONNECTION-PIPELINE"]
    # Each of the two joints to another line is told from both sides.
    assert sorted(places) == sorted(2 * [(1000.0, 80.0, 0.0)] + 2 * [places[0] if places[0][1] == 0 else places[-1]])
    assert sum(pcf.length for pcf in pcfs) == pytest.approx(3000)


def test_a_branch_set_on_a_pipe_begins_at_its_side(tmp_path):
    pcfs, codes = written(branching(hosted=True), tmp_path)
    assert [fault for pcf in pcfs for fault in pcf.faults()] == []
    (tap,) = (record for pcf in pcfs for record in pcf.records if record.keyword == "TEE-SET-ON")
    assert (tap.one("SKEY"), tap.centre, tap.branches) == ("TESO", [1000.0, 0.0, 0.0], [[1000.0, 30.0, 0.0, 25.0]])
    assert sum(pcf.length for pcf in pcfs) == pytest.approx(2970)
    assert "missing-joint" not in codes


@pytest.mark.parametrize(
    ("rise", "keyword", "flat"),
    [(0.0, "REDUCER-CONCENTRIC", None), (0.008, "REDUCER-ECCENTRIC", "UP"), (-0.008, "REDUCER-ECCENTRIC", "DOWN")],
)
def test_a_reducer_changes_the_bore_and_knows_its_flat_side(tmp_path, rise, keyword, flat):
    path = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.1, 0.0, rise), (2.0, 0.0, rise)]
    parts = [pipe_part(0, "pipe"), pipe_part(1, "reducer"), pipe_part(2, "pipe")]
    joints = [join("part-0", "part-1", path[1]), join("part-1", "part-2", path[2])]
    graph = networks.network(
        (*parts, networks.terminal(1, "open", path[0]), networks.terminal(2, "open", path[-1])),
        [edge("X1", "X2", ["part-0", "part-1", "part-2"], path, size=None, sizes=(80, 50))],
        joints=joints,
    )
    (pcf,), _ = written(graph, tmp_path)
    assert pcf.faults() == []
    reducer = pcf.chain[1]
    assert (reducer.keyword, reducer.one("FLAT-DIRECTION")) == (keyword, flat)
    assert [end[3] for end in reducer.ends] == [80, 50]


def test_what_the_graph_lacks_is_told_and_leaves_no_gap(tmp_path):
    path = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0)]
    parts = [
        pipe_part(i, "pipe").model_copy(
            update={"obb": pipe_part(i, None).obb.model_copy(update={"center": (x, 0.0, 0.0)})}
        )
        for i, x in ((0, 0.5), (1, 2.0))
    ]
    ends = (networks.terminal(1, "open", path[0]), networks.terminal(2, "unknown", path[1]))
    lines = [
        edge("X1", "X2", ["part-0", "part-1"], path, size=None, diameter=0.0312),
        edge("X3", "X4", [], [], size=None, diameter=None, length=None),
    ]
    nodes = (*parts, *ends, networks.terminal(3), networks.terminal(4, at=(1.0, 0.0, 0.0)))
    (pcf,), codes = written(networks.network(nodes, lines), tmp_path)
    assert pcf.faults() == []
    assert [record.length for record in pcf.chain] == pytest.approx([1250, 1750])
    assert pcf.chain[0].ends[0][3] == 31.2
    assert codes == {"missing-joint", "measured-bore", "no-centreline"}


def test_a_graph_without_parts_is_pipes_between_what_it_has(tmp_path):
    graph = networks.pumping()
    pcfs, codes = written(graph, tmp_path)
    assert [fault for pcf in pcfs for fault in pcf.faults()] == []
    assert "no-part" in codes
    lines = find_lines(graph)
    assert len(pcfs) == len(lines)
    assert sum(pcf.length for pcf in pcfs) == pytest.approx(1000 * sum(line.length for line in lines), rel=0.02)


def test_text_of_a_graph_stays_on_its_line(tmp_path):
    graph = valve_line()
    nodes = [
        n.model_copy(update={"tag": "V\r\nPIPE\r\n    END-POINT 0 0 0 0", "kind": "ball\nvalve"})
        if n.layer == "unit"
        else n
        for n in graph.document.nodes
    ]
    graph = type(graph)(graph.document.model_copy(update={"nodes": tuple(nodes)}))
    (pcf,), _ = written(graph, tmp_path)
    assert pcf.faults() == []
    assert pcf.chain[3].one("TAG") == "V PIPE END-POINT 0 0 0 0"


def test_lines_are_files_named_by_their_tags_alone(tmp_path):
    done = write_export(valve_line(), "pcf", tmp_path / "new")
    (line,) = find_lines(valve_line())
    assert [file.name for file in done.files] == [f"{line.tag}.pcf"]
    again = write_export(valve_line(), "pcf", tmp_path / "again")
    assert again.files[0].read_bytes() == done.files[0].read_bytes()


def test_a_folder_is_needed(tmp_path):
    with pytest.raises(ValueError, match="give a folder"):
        write_export(valve_line(), "pcf", tmp_path / "all.pcf")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(OutputError):
        write_export(valve_line(), "pcf", tmp_path / "file")


def test_contacts_alone_make_no_file(tmp_path):
    touching = Adjacent(source="part-0", target="part-1", distance=0.0, point=(0.0, 0.0, 0.0))
    graph = graphs.graph((graphs.part(0), graphs.part(1)), (touching,))
    assert find_components(graph) == ()
    assert write_export(graph, "pcf", tmp_path).files == ()


def test_a_line_knows_its_stations():
    line = Polyline.through([(0, 0, 0), (0, 0, 0), (1, 0, 0), (1, 2, 0)])
    assert line.length == 3
    assert line.at(2) == (1, 1, 0)
    assert (line.at(-1), line.at(9)) == ((0, 0, 0), (1, 2, 0))
    assert line.nearest((5, 1, 0)) == (2, 4)
    assert line.nearest((5, 1, 0), 0, 0.5)[0] == 0.5
    assert [s.turns for s in line.stretches(0, 3, 0.05)] == [False, False]


@pytest.mark.slow
@pytest.mark.parametrize(("preset", "lost"), [("skid", set()), ("loop", {"tap-not-written"}), ("manifold", set())])
def test_generated_plants_are_written_whole(tmp_path, preset, lost):
    scene = tmp_path / "plant.usdc"
    write_usd(make(preset, 0), scene)
    truth = json.loads(truth_path(scene).read_text(encoding="utf-8"))
    graph = SceneGraph.load(run(scene, tmp_path / "out", report=False).files["graph"])
    pcfs, codes = written(graph, tmp_path / "pcf")
    assert [fault for pcf in pcfs for fault in pcf.faults()] == []
    assert len(pcfs) == len(find_lines(graph))
    assert codes <= {"assumed-ends", "unknown-symbol", "measured-bore", *lost}
    # An outlet for a gauge is not as wide as the pipe that it is set on.
    outlets = [record.branches[0][3] for pcf in pcfs for record in pcf.records if record.keyword == "OLET"]
    assert all(0 < bore < 30 for bore in outlets)
    # The centrelines of the truth as far as the graph has them, and each piece of the pipes.
    known = sum(connection["length"] for connection in truth["connections"])
    assert sum(pcf.length for pcf in pcfs) == pytest.approx(known * 1000, rel=5e-3)
    meshes = {part.id: part.meshes for part in graph.parts()}
    there = {mesh for pcf in pcfs for record in pcf.records for part in record.parts for mesh in meshes[part]}
    assert {row["mesh"] for row in truth["meshes"] if row["group"] == PIPING} <= there
