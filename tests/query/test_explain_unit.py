import json

import pytest

import graphs
from cadgraph.errors import UnknownNode
from cadgraph.model.records import Port
from cadgraph.query import explain_unit
from cadgraph.query.explain import explain
from networks import chain, joint, network, terminal, unit


def plant(*joints):
    """T-001 (t) - pipe a - V-001 (v, w) - pipe b - an open end; P-001 (p) apart, beside pipe b."""
    names = ["t", "a", "v", "w", "b", "p"]
    labels = {"a": graphs.label("Pipe assembly", "pipe"), "v": graphs.label(name="valve body")}
    parts = [graphs.part(k, f"/plant/{name}", id=name, label=labels.get(name)) for k, name in enumerate(names)]
    valve = unit("V-001", "gate valve").model_copy(
        update={
            "parts": ("v", "w"),
            "ports": (Port(name="N1", point=(-0.1, 0.0, 0.0)), Port(name="N2", point=(0.1, 0.0, 0.0))),
        }
    )
    end = terminal(1).model_copy(update={"parts": ("b",)})
    nodes = [unit("T-001").model_copy(update={"parts": ("t",)}), valve]
    nodes += [unit("P-001").model_copy(update={"parts": ("p",)}), end]
    edges = chain("T-001 V-001.N1", via=("a",), confidence=0.97) + chain("V-001.N2 X1", via=("b",), size=None)
    return network([*parts, *nodes], edges, joints=joints)


JOINTS = (
    joint("a", "v", 0.0016, 0.97, at=(-0.1, 0.0, 0.0), reasons=("axes aligned", "same size")),
    joint("b", "v", 0.0, 0.99, at=(0.1, 0.0, 0.0)),
    joint("v", "w", 0.0, 0.99),
    joint("p", "b", 0.003, 0.31, made=False, kind="mount"),
    joint("p", "w", -0.002, 0.05, made=False, kind="flange", reasons=()),
    joint("b", "w", 0.02, 0.2, made=False),
)


def test_each_port_says_what_it_is_joined_to_why_and_how_sure():
    found = explain_unit(plant(*JOINTS), "V-001")
    assert (found.name, found.what, found.unit_type, found.system) == ("V-001", "gate valve", "valve", "system-001")
    assert [(part.part, part.mesh, part.label) for part in found.parts] == [
        ("v", "/plant/v", "valve body"),
        ("w", "/plant/w", None),
    ]
    first, second = found.ports
    assert (first.port, first.to, first.lengths, first.sizes, first.confidences) == (
        "N1", ("T-001",), (1.0,), (80,), (0.97,),
    )  # fmt: skip
    (told,) = first.joints
    assert (told.near, told.far, told.far_what, told.gap, told.score) == ("v", "a", "pipe", 0.0016, 0.97)
    assert told.reasons == ("axes aligned", "same size")
    assert told.meshes == ("/plant/v", "/plant/a")
    assert (second.to, [joint.far for joint in second.joints]) == (("terminal-001",), ["b"])


def test_what_was_not_made_comes_likeliest_first_and_joints_within_the_unit_are_left_out():
    found = explain_unit(plant(*JOINTS), "V-001")
    assert [(joint.near, joint.far, joint.score) for joint in found.open_joints] == [("w", "b", 0.2), ("w", "p", 0.05)]
    assert found.joints == ()


def test_a_unit_that_lacks_lines_says_how_many_and_what_is_near():
    found = explain_unit(plant(*JOINTS), "P-001")
    assert (found.used, found.least, found.missing, found.ports) == (0, 2, 2, ())
    rows = found.lines()
    assert ("missing", "none of 2 nozzles with a line: 2 more would make a whole pump") in rows
    near = "p (unlabelled of P-001) - b (unlabelled of terminal-001), an end at a body, gap 3.0 mm, 31%: axes aligned"
    assert ("not joined", near) in rows
    assert any("2.0 mm into each other" in text for _, text in rows)


def test_a_port_without_a_connection_is_told():
    graph = plant(*JOINTS)
    document = graph.document.model_copy(update={"edges": graph.document.edges[:1]})
    found = explain_unit(type(graph)(document), "V-001")
    assert ("port N2", "no line was found here") in found.lines()
    assert found.missing == 1


def test_the_words_name_port_size_length_and_certainty():
    rows = explain_unit(plant(*JOINTS), "V-001").lines()
    assert rows[0] == ("unit", "V-001, gate valve (valve)")
    assert ("port N1", "to T-001 (DN 80, 1.00 m, 97% sure)") in rows
    assert ("", "v (valve body of V-001) - a (pipe), end to end, gap 1.6 mm, 97%: axes aligned; same size") in rows


@pytest.mark.parametrize("which", ["terminal-001", "b"])
def test_an_end_of_a_line_can_be_asked_about(which):
    found = explain_unit(plant(*JOINTS), which)
    assert (found.what, found.least, found.missing) == ("open end", None, 0)
    assert [joint.far for joint in found.open_joints] == ["p", "w"]


def test_a_part_says_where_it_is_joined_made_ones_first():
    found = explain(plant(*JOINTS), "b")
    assert [(joint.far, joint.made) for joint in found.joints] == [("v", True), ("p", False), ("w", False)]
    assert [heading for heading, _ in found.lines()][-3:] == ["joined", "not joined", "not joined"]


def test_a_graph_that_names_no_joints_says_so():
    found = explain_unit(plant(), "P-001")
    assert not found.recorded
    assert found.lines()[-1] == ("note", "the graph names no joints: build it anew to see why")


def test_where_nothing_is_near_that_is_said():
    rows = explain_unit(plant(JOINTS[0]), "P-001").lines()
    assert rows[-1] == ("not joined", "nothing was found near it that its line could go on in")


def test_the_answer_is_plain_values():
    values = json.loads(json.dumps(explain_unit(plant(*JOINTS), "V-001").to_json()))
    assert values["ports"][0]["joints"][0]["reasons"] == ["axes aligned", "same size"]
    assert values["missing"] == 0


def test_many_joints_are_cut_in_words_alone():
    joints = [joint("p", "b", 0.001 * k, 0.5, made=False, at=(float(k), 0.0, 0.0)) for k in range(9)]
    found = explain_unit(plant(*joints), "P-001")
    assert len(found.open_joints) == 9
    assert found.lines()[-1] == ("", "and 3 more; --json has them all")


def test_what_is_not_there_is_named():
    with pytest.raises(UnknownNode, match="V-009"):
        explain_unit(plant(), "V-009")
