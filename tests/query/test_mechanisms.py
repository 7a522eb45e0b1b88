import pytest

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.mechanisms import NOT_MOVABLE
from cadgraph.model.records import Dial, Mechanism
from cadgraph.query.mechanisms import Immovable, immovable, joint_names, say_mechanism, say_not_movable
from networks import network, unit

UP = (0.0, 0.0, 1.0)
LEVER = Mechanism(
    kind="lever", meshes=("/a",), axis=UP, pivot=UP, radius=0.2, limits=(-90.0, 0.0), open=0.0, shut=-90.0,
    sources={"open": "the lever along the line", "limits": "assumed: a quarter turn, clockwise shuts"},
)  # fmt: skip
NEEDLE = Mechanism(kind="needle", meshes=("/b",), axis=UP, pivot=UP, radius=0.04, limits=(-10.0, 260.0))
DIAL = Dial(center=UP, normal=UP, radius=0.05, up=(0.0, 1.0, 0.0))


def with_(name, **more):
    return unit(name, kind="ball valve").model_copy(update=more)


def plant(*units, findings=()):
    graph = network(units, [])
    document = graph.document.model_copy(update={"diagnostics": tuple(findings)})
    return type(graph)(document)


def test_names_of_joints_are_tags_that_any_format_takes_and_no_two_are_the_same():
    tags = ("V-003", "V.003", "v_003", "2/A", "base", "阀")
    units = [with_("V-1", id=f"u{k}", tag=tag, mechanism=LEVER) for k, tag in enumerate(tags)]
    names = joint_names(plant(*units, with_("V-9")))
    assert list(names.values()) == ["V_003", "V_003_2", "v_003_3", "_2_A", "base_2", "_"]


def test_dials_without_a_needle_have_names_too_so_that_drawing_one_renames_nothing():
    assert joint_names(plant(with_("G-1", dial=DIAL))) == {"unit-G-1": "G_1"}


def test_valves_that_can_not_be_moved_are_told_with_their_reason():
    graph = plant(
        with_("V-1"), with_("V-11"), with_("V-2", mechanism=LEVER),
        findings=[Diagnostic(NOT_MOVABLE, "V-11: no wheel or lever was found"), Diagnostic("noise", "V-1: no")],
    )  # fmt: skip
    assert immovable(graph) == (Immovable("unit-V-11", "V-11", "no wheel or lever was found"),)
    assert [say_not_movable(graph, one) for one in graph.units()] == [
        "",
        "not movable: no wheel or lever was found",
        "",
    ]


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (
            {"mechanism": LEVER, "affordances": ("pull",)},
            "pull: lever, open at 0 degrees, shut at -90 from as drawn (assumed: a quarter turn, clockwise shuts)",
        ),
        ({"mechanism": NEEDLE, "affordances": ("read",)}, "read: its needle"),
        ({"dial": DIAL, "affordances": ("read",)}, "read: its dial, without a needle of its own"),
        ({}, ""),
    ],
)
def test_what_can_be_done_by_hand_is_said_with_what_is_assumed(more, said):
    assert say_mechanism(with_("V-1", **more)) == said
