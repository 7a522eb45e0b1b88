"""One decision for all joints: an end has one partner, and of those it could have the likelier."""

import random

import numpy as np
import pytest

import shapes
from cadgraph.stages.relate.decide import decide_joints, settle_faces
from cadgraph.stages.relate.offer import Offer
from piping import BORE, PIPE, VALVE, Plant, R, links, pipe, plate, ring, terminals, turned, valve_mesh


def face(row, other, odds, gap=0.0):
    return Offer("face", row, other, gap, odds)


def at(kind, row, part, odds):
    return Offer(kind, row, part, 0.0, odds)


def joined(faces, singles=None, settled=None):
    made = decide_joints(faces, singles or {}, settled or {}).joined
    return {row: (offer.kind, offer.row if offer.other == row else offer.other) for row, offer in made.items()}


def test_an_end_has_one_partner_the_likelier():
    assert joined([face(0, 1, 2.0), face(0, 2, 3.0)]) == {0: ("face", 2), 2: ("face", 0)}


def test_two_likely_joints_beat_one_that_is_likelier_than_each():
    chain = [face(0, 1, 2.0), face(1, 2, 3.0), face(2, 3, 2.0)]
    assert joined(chain) == {0: ("face", 1), 1: ("face", 0), 2: ("face", 3), 3: ("face", 2)}


@pytest.mark.parametrize(("odds", "kind"), [(2.4, "face"), (2.6, "mount")])
def test_a_solid_wins_where_it_is_likelier_than_a_face_and_no_open_end(odds, kind):
    # The other end stays open then, which costs 1.5.
    assert joined([face(0, 1, 1.0)], {0: [at("mount", 0, 7, odds)]})[0][0] == kind


def test_both_ends_of_an_unlikely_face_may_have_something_else():
    singles = {0: [at("mount", 0, 7, 1.0)], 1: [at("tap", 1, 8, 1.0)]}
    assert joined([face(0, 1, 1.9)], singles) == {0: ("mount", 7), 1: ("tap", 8)}
    assert joined([face(0, 1, 2.1)], singles) == {0: ("face", 1), 1: ("face", 0)}


def test_of_what_an_end_could_sit_on_the_likeliest_is_taken():
    singles = {0: [at("mount", 0, 7, 1.0), at("tap", 0, 8, 1.5), at("mount", 0, 9, -1.0)]}
    assert joined([], singles) == {0: ("tap", 8)}


@pytest.mark.parametrize("odds", [0.0, -0.1])
def test_what_more_speaks_against_than_for_is_not_made(odds):
    assert joined([face(0, 1, odds)], {2: [at("mount", 2, 7, odds)]}) == {}


def test_the_best_joint_that_was_not_made_is_known():
    decision = decide_joints([face(0, 1, 3.0), face(1, 2, 1.0), face(2, 3, -1.0)], {4: [at("tap", 4, 5, -2.0)]}, {})
    assert {row: offer.odds for row, offer in decision.refused.items()} == {2: 1.0, 3: -1.0, 4: -2.0}


@pytest.mark.parametrize(
    ("faces", "settled"),
    [
        ([face(0, 1, 3.0)], {0, 1}),
        ([face(0, 1, 2.9)], set()),  # not sure enough
        ([face(0, 1, 3.0, 0.0011)], set()),  # doesn't touch
        ([face(0, 1, 3.5), face(1, 2, 3.0)], {0, 1}),
        ([face(0, 1, 3.5), face(1, 2, 3.1)], set()),  # another one is nearly as likely
        ([Offer("corner", 0, 1, 0.0, 4.0)], set()),
    ],
)
def test_what_touches_and_has_no_rival_is_settled(faces, settled):
    assert settle_faces(faces).keys() == settled


def test_settled_ends_are_not_decided_again():
    settled = {0: face(0, 1, 3.0), 1: face(0, 1, 3.0)}
    made = joined([face(0, 1, 3.0), face(1, 2, 9.0)], {0: [at("mount", 0, 7, 9.0)]}, settled)
    assert made == {0: ("face", 1), 1: ("face", 0)}


@pytest.mark.parametrize("seed", range(5))
def test_the_order_of_offers_does_not_matter(seed):
    draw = random.Random(seed)
    faces = [
        face(a, b, round(draw.uniform(0.1, 4), 3)) for a in range(8) for b in range(a + 1, 8) if draw.random() < 0.5
    ]
    singles = {row: [at("mount", row, 9, round(draw.uniform(0.1, 4), 3))] for row in range(0, 8, 2)}
    first = joined(faces, singles)
    draw.shuffle(faces)
    assert joined(faces, dict(sorted(singles.items(), reverse=True))) == first


@pytest.mark.parametrize("back", [0.0, 0.003, 0.006, 0.008])
@pytest.mark.parametrize("gasket", [0.0, 0.002], ids=["bare", "gasket"])
@pytest.mark.parametrize("bore", [BORE, None], ids=["hollow", "solid"])
def test_a_pipe_set_back_in_its_slip_on_flange_reaches_the_valve(back, gasket, bore):
    plant = Plant().add(valve_mesh((1, 0, 0)), VALVE, "valve")
    for sign in (-1, 1):
        seat = 1 + sign * 0.089
        if gasket:
            plant.add(ring((seat, 0, 0), (sign, 0, 0), gasket, outer=0.05), PIPE, "gasket")
        front = seat + sign * gasket
        plant.add(ring((front, 0, 0), (sign, 0, 0), 0.022, inner=R + 0.0005), PIPE, "flange")
        plant.pipe((front + sign * back, 0, 0), (1 + sign, 0, 0), bore=bore)
    assert links(plant.graph()) == [("V-001", "open"), ("V-001", "open")]


def test_flanges_set_back_on_both_sides_of_a_gasket_join_two_pipes():
    plant = Plant().add(ring((0, 0, 0), (1, 0, 0), 0.002, outer=0.05), PIPE, "gasket")
    for sign, front in ((-1, 0.0), (1, 0.002)):
        plant.add(ring((front, 0, 0), (sign, 0, 0), 0.022, inner=R + 0.0005), PIPE, "flange")
        plant.pipe((front + sign * 0.006, 0, 0), (sign, 0, 0))
    plant.add(valve_mesh((1.089, 0, 0)), VALVE, "valve").add(valve_mesh((-1.089, 0, 0)), VALVE, "valve")
    assert links(plant.graph()) == [("V-001", "V-002")]


@pytest.mark.parametrize("gap", [0.0, 0.003, 0.0045])
def test_a_blind_flange_a_little_before_a_valve_closes_it(gap):
    plant = Plant().add(valve_mesh((1, 0, 0)), VALVE, "valve").pipe((1.089, 0, 0), (2, 0, 0))
    plant.add(plate((1 - 0.089 - gap, 0, 0), (-1, 0, 0)), PIPE, "blind flange")
    assert links(plant.graph()) == [("V-001", "blind"), ("V-001", "open")]


def half(shift, turn=None):
    """Valve, pipe."""
    shift = np.asarray(shift, float)
    meshes = [(valve_mesh((0, 0, 0)), VALVE, "valve"), (pipe((0.089, 0, 0), (1, 0, 0)), PIPE, "pipe")]
    turn = np.eye(3) if turn is None else turn
    return [(shapes.moved(mesh, turn, shift), group, name) for mesh, group, name in meshes]


BACK = np.diag([-1.0, -1.0, 1.0])
ACROSS = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])


@pytest.mark.parametrize(
    ("shift", "turn"),
    [
        ((2 + 0.0125, 0, 0), BACK),  # end to end
        ((1.3, 2 * R + 0.012, 0), BACK),  # side by side, in opposite senses
        ((0.2, 0, 2 * R + 0.012), None),  # one over the other
        ((0.6, -1 - R - 0.0125, 0), ACROSS),  # an end at the other's side
        ((0.6, -0.5, 2 * R + 0.012), ACROSS),  # crosswise
    ],
    ids=["ends", "opposite", "over", "end at side", "crossing"],
)
def test_two_plants_twelve_millimetres_apart_stay_two(shift, turn):
    plant = Plant()
    for mesh, group, name in [*half((0, 0, 0)), *half(shift, turn)]:
        plant.add(mesh, group, name)
    found = links(plant.graph())
    assert sorted(found) == [("V-001", "open"), ("V-002", "open")]


@pytest.mark.parametrize("span", [(0.2, 0.8), (-0.05, 1.05), (0.4, 0.46)], ids=["long", "whole", "short"])
@pytest.mark.parametrize("radius", [R + 0.02, R + 0.001])
def test_insulation_that_nobody_named_is_neither_line_nor_unit(span, radius):
    plant = Plant().pipe((0, 0, 0), (1, 0, 0))
    plant.add(valve_mesh((1.089, 0, 0)), VALVE, "valve").add(valve_mesh((-0.089, 0, 0)), VALVE, "valve")
    low, high = span
    plant.add(turned(shapes.tube(radius + 0.01, radius, high - low), ((low + high) / 2, 0, 0), (1, 0, 0)), None)
    graph = plant.graph()
    assert links(graph) == [("V-001", "V-002")]
    assert terminals(graph) == []


def test_two_ends_in_one_place_are_one():
    # The sleeve ends where its pipe does, both before the valve.
    plant = Plant().add(valve_mesh((1, 0, 0)), VALVE, "valve").pipe((0, 0, 0), (0.911, 0, 0))
    plant.add(turned(shapes.tube(R + 0.012, R, 0.05), (0.911 - 0.025, 0, 0), (1, 0, 0)), PIPE, "coupling")
    assert links(plant.graph()) == [("V-001", "open")]
