import pkgutil
from importlib import import_module

import numpy as np
import pytest

import cadplants
from cadplants.solids.mesh_ops import (
    Branch,
    about_x,
    box,
    branched,
    extrude,
    moved,
    revolve,
    stack,
    sweep,
    tube,
    volume,
    weld,
)
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.transforms import arc, at, spun
from plants.solids import is_closed, shell_volumes


def polygon_area(radius, sides):
    return sides / 2 * radius**2 * np.sin(2 * np.pi / sides)


def test_box_has_its_volume_and_looks_outward():
    solid = box((1.0, 2.0, 3.0), (5.0, 5.0, 5.0))
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(6.0)


def test_drilled_plate_loses_the_volume_of_its_holes():
    holes = (circle(0.1, 16, (0.5, 0.0)), circle(0.1, 16, (-0.5, 0.0)))
    solid = extrude(rounded_rectangle(2.0, 1.0, 0.0), 0.0, 0.1, holes)
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(0.1 * (2.0 - 2 * polygon_area(0.1, 16)))


def test_ring_of_revolution_is_closed():
    solid = weld([revolve([(0.4, 0.0), (0.5, 0.0), (0.5, 1.0), (0.4, 1.0)], 24, closed=True)])
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(polygon_area(0.5, 24) - polygon_area(0.4, 24))


def test_stack_has_no_inner_faces():
    hexagon, shank = circle(1.0, 6), circle(0.5, 12)
    solid = stack([(0.0, 1.0, hexagon), (1.0, 3.0, shank), (3.0, 4.0, hexagon)])
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(2 * polygon_area(1.0, 6) + 2 * polygon_area(0.5, 12))


def test_tube_round_a_bend_ends_square_to_its_legs():
    path = arc((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), 8)
    solid = tube(path, 0.1, 0.08, 16)
    assert is_closed(solid)
    assert len(shell_volumes(solid)) == 1
    assert volume(solid) > 0
    at_start = np.isclose(solid.vertices[:, 0], 0.0, atol=1e-12)
    at_end = np.isclose(solid.vertices[:, 1], 1.0, atol=1e-12)
    assert at_start.sum() == at_end.sum() == 32


def test_arc_touches_the_circle_from_outside():
    path = arc((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), 6)
    distance = np.linalg.norm(path - [0.0, 1.0, 0.0], axis=1)
    assert (distance >= 1.0 - 1e-12).all()
    middles = (path[1:-2] + path[2:-1]) / 2
    np.testing.assert_allclose(np.linalg.norm(middles - [0.0, 1.0, 0.0], axis=1), 1.0)


def test_closed_sweep_is_closed():
    loop = np.array([[1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]])
    solid = sweep(loop, circle(0.1, 8), closed=True)
    assert is_closed(solid)
    assert volume(solid) > 0


@pytest.mark.parametrize("radius", [0.1, 0.3, 0.49])
def test_branch_grows_out_of_its_body_without_a_seam(radius):
    profile = [(0.0, -1.0), (0.5, -1.0), (0.5, 1.0), (0.0, 1.0)]
    body, ends = branched(profile, 32, [Branch(0.0, np.pi / 2, radius, ((radius, 1.0), (0.0, 1.0)))])
    assert is_closed(body)
    assert len(shell_volumes(body)) == 1
    alone = polygon_area(0.5, 32) * 2
    assert alone < volume(body) < alone + np.pi * radius**2
    assert len(ends) == 1


def test_two_branches_stay_apart():
    profile = [(0.0, -1.0), (0.5, -1.0), (0.5, 1.0), (0.0, 1.0)]
    out = ((0.2, 1.0), (0.0, 1.0))
    body, _ = branched(profile, 32, [Branch(0.5, 0.0, 0.2, out), Branch(-0.5, np.pi, 0.2, out)])
    assert is_closed(body)


def test_mirror_image_still_looks_outward():
    solid = moved(box((1.0, 1.0, 1.0)), np.diag([1.0, 1.0, -1.0, 1.0]))
    assert volume(solid) == pytest.approx(1.0)


def test_about_x_lays_the_axis_along_x():
    solid = about_x(box((1.0, 2.0, 3.0)))
    np.testing.assert_allclose(np.ptp(solid.vertices, axis=0), [3.0, 1.0, 2.0])


def test_quarter_turns_are_exact():
    assert set(np.unique(spun("z", np.pi / 2))) <= {-1.0, 0.0, 1.0}
    np.testing.assert_array_equal((at(1, 2, 3) @ spun("x", np.pi))[:3, 3], [1.0, 2.0, 3.0])


def test_no_function_keeps_the_shapes_of_every_plant_that_is_made():
    kept = {}
    for found in pkgutil.walk_packages(cadplants.__path__, "cadplants."):
        for name, one in vars(import_module(found.name)).items():
            if hasattr(one, "cache_info") and one.__module__ == found.name:
                kept[f"{one.__module__}.{name}"] = one.cache_info().maxsize
    assert len(kept) > 60
    # By words of the code alone, of which there are so many and no more.
    endless = {"builder.draws.of_makes", "builder.table.group_of", "families.valves.body.packings"}
    assert {name for name, most in kept.items() if most is None} == {f"cadplants.{name}" for name in endless}
