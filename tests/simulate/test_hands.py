import dataclasses

import numpy as np
import pytest

import shapes
from cadgraph.model.records import Mechanism
from cadgraph.model.scene import Scene
from cadgraph.simulate.tasks.hands import Hands, ring_of


def wheel(**more):
    values = {
        "kind": "handwheel", "meshes": ("/wheel",), "axis": (0.0, 0.0, 1.0), "pivot": (0.0, 0.0, 1.0), "radius": 0.1,
        "thickness": 0.01, "limits": (-3600.0, 0.0),
    }  # fmt: skip
    return Mechanism(**{**values, **more})


def scene(*others, moves=None, origin=(0.0, 0.0, 0.0)):
    """A wheel 1 m above the ground, and what stands about it."""
    moves = moves or shapes.moved(shapes.tube(0.11, 0.09, 0.02), translation=(0, 0, 1.0))
    meshes = [moves, shapes.box((2, 2, 0.1), (0, 0, -0.05)), *others]
    made = Scene.from_meshes(meshes, ["/wheel", *(f"/other_{i}" for i in range(len(meshes) - 1))])
    return dataclasses.replace(made, origin=np.array(origin))


def way(found, mechanism=None, stand=(0.6, 0.0, 0.0)):
    return Hands(found).find(mechanism or wheel(), stand)


def test_a_hand_comes_straight_along_the_axis_where_nothing_is_in_the_way():
    ring, hand, tried = way(scene())
    assert (ring.center, ring.radius, ring.kind) == ((0.0, 0.0, 1.0), 0.1, "handwheel")
    assert (hand.direction, hand.tilt) == ((0.0, 0.0, -1.0), 0.0)
    assert hand.grasp == pytest.approx((0.1, 0.0, 1.0)), "on the side of the one who stands there"
    assert tried == 16


def test_a_plate_above_makes_the_hand_come_from_the_side():
    _, hand, tried = way(scene(shapes.box((0.6, 0.6, 0.02), (0, 0, 1.25))))
    assert hand.tilt > 0
    assert tried > 16
    start = np.array(hand.grasp) - hand.free * np.array(hand.direction)
    assert start[2] < 1.25 or abs(start[:2]).max() > 0.3


def test_a_wheel_in_a_box_is_out_of_reach_of_a_hand():
    walls = [
        shapes.box(size, center)
        for size, center in (
            ((0.6, 0.6, 0.02), (0, 0, 1.2)),
            ((0.6, 0.02, 1.2), (0, 0.2, 0.6)),
            ((0.6, 0.02, 1.2), (0, -0.2, 0.6)),
            ((0.02, 0.6, 1.2), (0.2, 0, 0.6)),
            ((0.02, 0.6, 1.2), (-0.2, 0, 0.6)),
        )
    ]
    _, hand, tried = way(scene(*walls))
    assert hand is None
    assert tried == 16 * (1 + 4 * 8)


@pytest.mark.parametrize(("gap", "free"), [(0.04, False), (0.07, True)])
def test_a_hand_needs_room_beside_it(gap, free):
    # A slot along the axis for each place on the rim: a tube inside, and one outside.
    inner = shapes.moved(shapes.tube(0.1 - gap, 0.005, 0.5, sides=64), translation=(0, 0, 1.3))
    outer = shapes.moved(shapes.tube(0.5, 0.1 + gap, 0.5, sides=64), translation=(0, 0, 1.3))
    _, hand, _ = way(scene(inner, outer))
    assert (hand is not None and hand.tilt == 0) == free


@pytest.mark.parametrize("aside", [0.0, 0.012, 0.024, 0.036])
def test_a_rod_of_two_centimetres_across_the_way_is_met_wherever_it_crosses(aside):
    grips = [(0.1 * np.cos(turn), 0.1 * np.sin(turn)) for turn in np.radians(np.arange(16) * 22.5)]
    rods = [shapes.box((0.02, 0.12, 0.02), (x + aside, y, 1.2)) for x, y in grips]
    _, hand, _ = way(scene(*rods))
    assert hand.tilt > 0


def test_a_lever_is_gripped_near_its_end():
    bar = shapes.box((0.3, 0.03, 0.01), (0.13, 0, 1.02))
    lever = wheel(kind="lever", radius=0.28, limits=(-90.0, 0.0))
    ring, hand, _ = way(scene(moves=bar), lever)
    assert ring.center == pytest.approx((0, 0, 1.02))
    assert hand.grasp == pytest.approx((0.85 * 0.28, 0, 1.02), abs=0.02)


def test_places_are_those_of_the_world_where_the_scene_lies_far_out():
    far = (4.0e6, -2.0e6, 100.0)
    mechanism = wheel(pivot=tuple(np.add(far, (0, 0, 1.0))))
    ring, hand, _ = way(scene(origin=far), mechanism, stand=tuple(np.add(far, (0.6, 0, 0))))
    assert ring.center == pytest.approx(mechanism.pivot, abs=1e-6)
    assert np.array(hand.grasp) - far == pytest.approx((0.1, 0.0, 1.0), abs=1e-6)


def test_nobody_grips_a_needle():
    with pytest.raises(ValueError, match="needle"):
        ring_of(wheel(kind="needle"), np.zeros((0, 3)))
