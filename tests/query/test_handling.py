import pytest

from cadgraph.draw.web.content import network_of
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.mechanisms import NOT_MOVABLE
from cadgraph.model.records import Dial, Mechanism
from cadgraph.query.mechanisms import say_handling
from networks import network, unit


def moves(kind, shut=-3600.0, **sources):
    return Mechanism(
        kind=kind, meshes=("/w",), axis=(0, 0, 1), pivot=(0, 0, 0), radius=0.12, limits=(shut, 0.0), open=0.0,
        shut=None if kind == "needle" else shut, sources=sources,
    )  # fmt: skip


def with_(tag="V-001", **more):
    return unit(tag).model_copy(update=more)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ({"affordances": ("turn",), "mechanism": moves("handwheel", -4320.0, limits="assumed: gate")},
         "can be turned: handwheel, radius 0.12 m, about 12 turns to shut"),
        ({"affordances": ("pull",), "mechanism": moves("lever", -90.0)},
         "can be pulled: lever, 0.12 m long, 90 degrees to shut"),
        ({"affordances": ("read",), "mechanism": moves("needle")}, "can be read: its needle was found"),
        ({"affordances": ("read",)}, "can be read: where its dial is, is not known"),
        ({}, ""),
    ],
)  # fmt: skip
def test_what_people_can_do_at_a_unit_is_said_in_words(more, said):
    assert say_handling(with_(**more)) == said


def test_a_dial_without_a_needle_is_read_all_the_same():
    dial = Dial(center=(0, 0, 0), normal=(0, 1, 0), radius=0.05, up=(0, 0, 1))
    assert (
        say_handling(with_("G-001", affordances=("read",), dial=dial))
        == "can be read: its dial has no needle of its own"
    )


def test_the_viewer_is_told_what_moves_and_why_something_does_not():
    graph = network(
        [with_("V-001", affordances=("turn",), mechanism=moves("handwheel")), with_("V-002"), with_("P-001")], []
    )
    note = Diagnostic(NOT_MOVABLE, "V-002: its wheel is one surface with the body")
    told = network_of(type(graph)(graph.document.model_copy(update={"diagnostics": (note,)})))
    assert {one["tag"]: one["handling"] for one in told["units"]} == {
        "V-001": "can be turned: handwheel, radius 0.12 m, 10 turns to shut",
        "V-002": "not movable: its wheel is one surface with the body",
        "P-001": "",
    }
