from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import shapes
from cadgraph.geometry.visibility.inside import find_inside
from cadgraph.model.scene import Scene


def inside_of(*meshes, **settings):
    return find_inside(Scene.from_meshes(meshes), **settings)


def pairs_of(found):
    return [tuple(map(int, pair)) for pair in found.pairs]


def flipped(mesh):
    return mesh[0], mesh[1][:, ::-1]


def joined(*meshes):
    starts = np.cumsum([0] + [len(v) for v, _ in meshes[:-1]])
    return np.vstack([v for v, _ in meshes]), np.vstack([f + s for (_, f), s in zip(meshes, starts, strict=True)])


def test_inner_of_concentric_spheres_is_inside_and_in_the_material():
    found = inside_of(shapes.sphere(1.0), shapes.sphere(0.5))
    assert pairs_of(found) == [(1, 0)]
    assert found.share.tolist() == [1.0]
    assert found.in_material.tolist() == [1.0]


def test_ball_in_the_cavity_of_a_closed_shell_is_inside_but_not_in_the_material():
    shell = joined(shapes.sphere(1.0), flipped(shapes.sphere(0.9)))
    found = inside_of(shell, shapes.sphere(0.3))
    assert pairs_of(found) == [(1, 0)]
    assert found.share.tolist() == [1.0]
    assert found.in_material.tolist() == [0.0]


def test_ball_beside_another_is_not_inside():
    assert pairs_of(inside_of(shapes.sphere(1.0), shapes.moved(shapes.sphere(0.2), translation=(0.7, 0.7, 0.7)))) == []


def test_shaft_through_an_open_tube_is_inside_as_far_as_the_tube_covers_it():
    tube = shapes.tube(0.1, 0.09, 1.0, 32)
    short = inside_of(tube, shapes.cylinder(0.05, 0.7, 24))
    assert pairs_of(short) == [(1, 0)]
    assert short.share[0] > 0.9
    assert short.in_material[0] == 0  # the bore is no material
    assert pairs_of(inside_of(tube, shapes.cylinder(0.05, 1.2, 24))) == [(1, 0)]
    assert pairs_of(inside_of(tube, shapes.cylinder(0.05, 4.0, 24))) == []


def test_bolt_in_a_ring_is_not_inside():
    assert pairs_of(inside_of(shapes.tube(0.1, 0.06, 0.02), shapes.cylinder(0.04, 0.1))) == []


def test_part_in_a_box_without_a_lid_is_not_inside():
    vertices, faces = shapes.box((1, 1, 1))
    top = (vertices[faces][:, :, 2] > 0.49).all(axis=1)
    assert top.sum() == 2
    assert pairs_of(inside_of((vertices, faces[~top]), shapes.sphere(0.3))) == []
    assert pairs_of(inside_of((vertices, faces), shapes.sphere(0.3))) == [(1, 0)]


def test_part_in_the_corner_of_three_walls_is_not_inside():
    vertices, faces = shapes.box((4, 4, 4))
    walls = (vertices[faces] < -1.9).all(axis=1).any(axis=1)
    assert walls.sum() == 6
    corner = (vertices, faces[walls])
    part = shapes.moved(shapes.sphere(0.2), translation=(-1.7, -1.7, -1.7))
    assert pairs_of(inside_of(corner, part)) == []


def test_material_of_an_open_mesh_is_undecided():
    vertices, faces = shapes.sphere(1.0, 24, 24)
    hole = (vertices[faces][:, :, 2] > 0.9).all(axis=1)
    inconsistent = faces.copy()
    inconsistent[::2] = inconsistent[::2, ::-1]
    opened = inside_of((vertices, faces[~hole]), shapes.sphere(0.3))
    assert pairs_of(opened) == [(1, 0)]
    twisted = inside_of((vertices, inconsistent), shapes.sphere(0.3))
    assert pairs_of(twisted) == [(1, 0)]
    assert np.isnan(twisted.in_material[0])


def test_nested_parts_are_in_all_around_them():
    found = inside_of(shapes.sphere(0.2), shapes.sphere(1.0), shapes.sphere(0.5))
    assert pairs_of(found) == [(0, 1), (0, 2), (2, 1)]


def test_what_touches_its_encloser_is_inside_all_the_same():
    assert pairs_of(inside_of(shapes.sphere(1.0), shapes.moved(shapes.sphere(0.5), translation=(0, 0, 0.495)))) == [
        (1, 0)
    ]


@pytest.mark.parametrize(("depth", "expected"), [(0.35, [(1, 0)]), (-0.35, [])])
def test_share_decides_about_what_sticks_out(depth, expected):
    # a bar through the wall of a closed box, mostly on one side of it
    scene = Scene.from_meshes([shapes.box((4, 4, 4)), shapes.box((0.1, 0.1, 1), (0, 0, 2 - depth))])
    found = find_inside(scene)
    assert pairs_of(found) == expected


def test_no_share_is_refused():
    with pytest.raises(ValueError, match="min_share"):
        inside_of(shapes.box(), min_share=0)


def test_degenerate_meshes_are_inside_nothing_and_around_nothing():
    nothing = (np.zeros((0, 3)), np.zeros((0, 3), int))
    flat = (np.array([[0.0, 0, 0], [0.1, 0, 0], [0.2, 0, 0]]), np.array([[0, 1, 2]]))
    wrong = (np.full((3, 3), np.nan), np.array([[0, 1, 2]]))
    assert pairs_of(inside_of(nothing, shapes.sphere(1.0), flat, wrong)) == []
    assert pairs_of(find_inside(Scene.from_meshes([]))) == []


def test_motion_and_workers_change_nothing():
    turn = Rotation.from_rotvec([0.3, -0.8, 0.5]).as_matrix()
    meshes = [shapes.tube(0.1, 0.09, 2.0, 32), shapes.cylinder(0.05, 1.4, 24), shapes.sphere(0.02)]
    scene = Scene.from_meshes([shapes.moved(mesh, turn, (100, 50, 20)) for mesh in meshes])
    found = find_inside(scene, workers=1)
    many = find_inside(scene, workers=3)
    assert pairs_of(found) == [(1, 0), (2, 0), (2, 1)]
    assert found.share.tobytes() == many.share.tobytes()
    assert found.in_material.tobytes() == many.in_material.tobytes()
