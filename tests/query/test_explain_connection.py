import json

import pytest

import graphs
from cadgraph.model.records import Adjacent
from cadgraph.query import explain_connection
from networks import chain, joint, junction, mounted, network, terminal, unit

UNITS = ("T-001", "V-001", "V-002", "P-001", "G-001")


def plant(*joints, touching=()):
    """T-001 (t) - a - V-001 (v) - b - J1 (tee) - c - V-002 (x), J1 - d - an end; apart: P-001 (p), e, f, G-001 (g)."""
    names = ["t", "a", "v", "b", "tee", "c", "x", "d", "p", "e", "f", "g"]
    parts = []
    for k, name in enumerate(names):
        low = (float(k), 0.0, 0.0)
        parts.append(graphs.part(k, f"/{name}", id=name, aabb=(low, (k + 0.5, 0.5, 0.5))))
    of = dict(zip(UNITS, "tvxpg", strict=True))
    nodes = [unit(tag).model_copy(update={"parts": (of[tag],)}) for tag in UNITS]
    nodes += [junction(1).model_copy(update={"parts": ("tee",)}), terminal(1).model_copy(update={"parts": ("d",)})]
    edges = chain("T-001 V-001", via=("a",)) + chain("V-001 J1", via=("b",), length=0.5)
    edges += chain("J1 V-002", via=("tee", "c")) + chain("J1 X1", via=("d",))
    edges += [Adjacent(source=a, target=b, distance=distance, point=(0.0, 0.0, 0.0)) for a, b, distance in touching]
    return network([*parts, *nodes], edges, joints=joints)


MADE = (
    joint("t", "a", 0.0, 0.95),
    joint("v", "a", 0.001, 0.9),
    joint("b", "v", 0.0, 0.99),
    joint("b", "tee", 0.002, 0.7, reasons=("gap of 2 mm",)),
    joint("tee", "c", 0.0, 0.98),
    joint("c", "x", 0.0, 0.97),
    joint("tee", "d", 0.0, 0.98),
)


def told(joints):
    return [(joint.near, joint.far) for joint in joints]


def test_joints_on_the_way_come_in_order_and_the_weakest_is_named():
    found = explain_connection(plant(*MADE), "T-001", "V-002")
    assert found.connected
    assert found.way == ("T-001", "V-001", "junction-001", "V-002")
    assert found.length == 2.5
    assert told(found.joints) == [("t", "a"), ("a", "v"), ("v", "b"), ("b", "tee"), ("tee", "c"), ("c", "x")]
    assert (found.weakest.near, found.weakest.score) == ("b", 0.7)
    assert (found.unnamed, found.open_joints, found.nearest) == (0, (), None)
    rows = found.lines()
    assert rows[0] == ("connected", "T-001 - V-002, 2.50 m, by way of V-001, junction-001")
    assert rows[4][1].endswith("end to end, gap 2.0 mm, 70%: gap of 2 mm")
    assert rows[-1] == ("weakest", "joint 4, 70%")


def test_the_way_back_has_the_same_joints_in_the_other_order():
    there = explain_connection(plant(*MADE), "T-001", "V-002")
    back = explain_connection(plant(*MADE), "V-002", "T-001")
    assert told(back.joints) == [(far, near) for near, far in told(there.joints)][::-1]


def test_a_gauge_that_stands_in_the_run_makes_no_way_up_and_down_its_leg():
    parts = [graphs.part(k, f"/{name}", id=name) for k, name in enumerate(["t", "a", "boss", "g", "x"])]
    of = {"T-001": "t", "G-001": "g", "V-001": "x"}
    nodes = [unit(tag).model_copy(update={"parts": (part,)}) for tag, part in of.items()]
    edges = chain("T-001 G-001 V-001", via=("a",))
    joints = (joint("t", "a"), joint("a", "boss"), joint("boss", "g"), joint("a", "x"))
    graph = network([*parts, *nodes], edges, joints=joints)
    assert told(explain_connection(graph, "T-001", "V-001").joints) == [("t", "a"), ("a", "x")]
    assert told(explain_connection(graph, "T-001", "G-001").joints) == [("t", "a"), ("a", "boss"), ("boss", "g")]
    assert told(explain_connection(graph, "G-001", "V-001").joints) == [("g", "boss"), ("boss", "a"), ("a", "x")]


def test_a_step_for_which_no_joint_is_named_is_counted():
    found = explain_connection(plant(*MADE[1:]), "T-001", "V-001")
    assert told(found.joints) == [("a", "v")]
    assert found.unnamed == 1
    assert found.lines()[-1] == ("note", "of 1 steps from part to part on the way no joint is named")


def test_a_step_over_parts_that_the_connection_does_not_name_is_followed():
    joints = (joint("t", "e"), joint("e", "a"), *MADE[1:])
    assert told(explain_connection(plant(*joints), "T-001", "V-001").joints) == [("t", "e"), ("e", "a"), ("a", "v")]


def test_where_no_way_leads_the_best_joint_between_the_pieces_is_told():
    near = (joint("p", "d", 0.003, 0.31, made=False, reasons=("gap of 3 mm",)), joint("p", "c", 0.02, 0.1, made=False))
    found = explain_connection(plant(*MADE, *near), "P-001", "T-001")
    assert not found.connected
    assert told(found.open_joints) == [("p", "d")]
    assert found.weakest.score == 0.31
    assert [heading for heading, _ in found.lines()] == ["separate", "not joined"]
    assert "gap 3.0 mm, 31%: gap of 3 mm" in found.lines()[1][1]


def test_made_joints_carry_on_where_connections_end():
    found = explain_connection(plant(*MADE, joint("p", "e"), joint("d", "e", made=False, score=0.4)), "P-001", "T-001")
    assert told(found.open_joints) == [("e", "d")]


def test_several_joints_may_be_missing_and_the_likeliest_way_counts():
    open_joints = (
        joint("p", "e", made=False, score=0.5),
        joint("e", "d", made=False, score=0.5),
        joint("p", "f", made=False, score=0.4),
        joint("f", "d", made=False, score=0.55),
        joint("p", "d", made=False, score=0.2),
    )
    found = explain_connection(plant(*MADE, *open_joints), "P-001", "T-001")
    assert told(found.open_joints) == [("p", "e"), ("e", "d")]
    direct = (*open_joints[:4], joint("p", "d", made=False, score=0.26))
    assert told(explain_connection(plant(*MADE, *direct), "P-001", "T-001").open_joints) == [("p", "d")]


def test_a_joint_of_no_score_is_told_too():
    found = explain_connection(plant(*MADE, joint("p", "d", made=False, score=0.0)), "P-001", "T-001")
    assert told(found.open_joints) == [("p", "d")]


def test_units_that_are_joined_without_a_run_of_pipe_between_them_show_their_joints():
    found = explain_connection(plant(*MADE, joint("p", "e"), joint("e", "d")), "P-001", "T-001")
    assert not found.connected
    assert told(found.joints)[:2] == [("p", "e"), ("e", "d")]
    assert found.lines()[-1] == ("note", "they are joined part by part, but no run of pipe was made of that")


def test_parts_that_touch_without_a_joint_are_named():
    found = explain_connection(plant(*MADE, touching=[("d", "p", 0.004), ("c", "p", 0.006)]), "P-001", "T-001")
    assert (found.nearest.first, found.nearest.second, found.nearest.distance) == ("p", "d", 0.004)
    assert "nearest are p (unlabelled) and d (unlabelled), 4.0 mm apart" in found.lines()[1][1]


def test_where_nothing_is_near_the_nearest_boxes_are_told():
    found = explain_connection(plant(*MADE), "P-001", "T-001")
    assert (found.nearest.first, found.nearest.second, found.nearest.touching) == ("p", "d", False)
    assert found.nearest.distance == 0.5
    assert found.lines()[1][1].startswith("nothing was found between them; nearest are p")


def test_units_without_parts_have_no_nearest_ones():
    graph = network([unit("P-001"), unit("T-001")], [])
    found = explain_connection(graph, "P-001", "T-001")
    assert found.nearest is None
    assert found.lines() == [
        ("separate", "no way along the pipes leads from P-001 to T-001"),
        ("between", "nothing was found between them, and not both have parts"),
        ("note", "the graph names no joints: build it anew to see why"),
    ]


def test_a_unit_and_itself_are_refused():
    with pytest.raises(ValueError, match="are both V-001: give two different ones"):
        explain_connection(plant(), "V-001", "v")


@pytest.mark.parametrize("pair", [("G-001", "T-001"), ("T-001", "G-001")])
def test_a_gauge_on_the_shell_of_a_tank_is_told_as_mounted_there(pair):
    nodes, touch = mounted()
    told = explain_connection(network([*nodes, terminal(1)], [*touch, *chain("T-001.N1 X1")]), *pair)
    assert told.mounted == ("G-001", "T-001")
    assert told.lines()[1:] == [("mounted", "G-001 is mounted at T-001"), told.lines()[-1]]


def test_order_of_the_joints_in_the_file_changes_nothing():
    open_joints = (joint("p", "d", made=False, score=0.3), joint("p", "c", made=False, score=0.3))
    one = explain_connection(plant(*MADE, *open_joints), "P-001", "T-001")
    assert explain_connection(plant(*open_joints[::-1], *MADE[::-1]), "P-001", "T-001") == one


def test_the_answer_is_plain_values():
    values = json.loads(json.dumps(explain_connection(plant(*MADE), "T-001", "V-002").to_json()))
    assert values["weakest"]["reasons"] == ["gap of 2 mm"]
    assert values["connected"] is True
