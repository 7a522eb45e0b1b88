import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import shapes
import tubes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.analysis import measure_shapes
from cadgraph.geometry.shape.solid import name_solid
from cadgraph.model.scene import Scene


def named(*meshes):
    scene = Scene.from_meshes(meshes)
    return [name_solid(facts) for facts in measure_shapes(scene, measure(scene))]


def angle_profile():
    outline = np.array([(0, 0), (0.1, 0), (0.1, 0.01), (0.01, 0.01), (0.01, 0.1), (0, 0.1)])
    vertices = np.concatenate([np.column_stack([outline, np.full(6, h)]) for h in (0, 1)])
    walls = [f for i in range(6) for j in [(i + 1) % 6] for f in ([i, j, 6 + j], [i, 6 + j, 6 + i])]
    cap = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]
    return vertices, np.array(walls + [f[::-1] for f in cap] + [[i + 6 for i in f] for f in cap])


def handwheel(spokes):
    arms = [
        tubes.pipe(np.outer([0.02, 0.15], [np.cos(a), np.sin(a), 0]), 0.006, 12)
        for a in np.arange(spokes) * 2 * np.pi / spokes
    ]
    pieces = [tubes.elbow(0.15, 0.01, 2 * np.pi, 60, 12), shapes.cylinder(0.03, 0.04), *arms]
    starts = np.cumsum([0, *(len(v) for v, _ in pieces)])
    faces = [f + s for (_, f), s in zip(pieces, starts[:-1], strict=True)]
    return np.concatenate([v for v, _ in pieces]), np.concatenate(faces)


SPOOL = [(0.04, 0), (0.1, 0), (0.1, 0.02), (0.05, 0.02), (0.05, 1.0), (0.1, 1.0), (0.1, 1.02), (0.04, 1.02)]
NAMED = {
    "sheet": (shapes.box((1, 2, 0)), "sheet"),
    "box": (shapes.box((1, 2, 3)), "box"),
    "cube": (shapes.box(), "box"),
    "plate": (shapes.box((2, 1, 0.004)), "box"),
    "sphere": (shapes.sphere(), "sphere"),
    "nut": (shapes.tube(0.02, 0.01, 0.016, 6), "hexagon"),
    "6-sided rod": (shapes.cylinder(0.05, 0.3, 6), "cylinder"),
    "rod": (shapes.cylinder(0.05, 0.3), "cylinder"),
    "disc": (shapes.cylinder(0.1, 0.005), "cylinder"),
    "tube": (shapes.tube(0.05, 0.04, 0.3), "cylinder"),
    "thin washer": (shapes.tube(0.1, 0.05, 0.001), "cylinder"),
    "open pipe": (tubes.pipe([[0, 0, 0], [0, 0, 1]], 0.05, 12), "cylinder"),
    "soup": (tubes.soup(shapes.tube(0.05, 0.04, 0.3)), "cylinder"),
    "frustum": (shapes.lathe([(0, 0), (0.1, 0), (0.05, 0.2), (0, 0.2)]), "cone"),
    "sharp cone": (shapes.lathe([(0, 0), (0.1, 0), (0, 0.2)]), "cone"),
    "hollow reducer": (shapes.lathe([(0.04, 0), (0.05, 0), (0.03, 0.1), (0.02, 0.1)], closed=True), "cone"),
    "ring": (tubes.elbow(0.2, 0.03, 2 * np.pi, 40, 24), "torus"),
    "square tube": (shapes.tube(0.1, 0.09, 2, 4), "extrusion"),
    "angle profile": (angle_profile(), "extrusion"),
    "spool": (shapes.lathe(SPOOL, 24, closed=True), "revolved"),
    "elbow": (tubes.elbow(0.2, 0.03, np.pi / 2, 24, 24), "bent tube"),
    "handwheel": (handwheel(5), "wheel"),
}


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", NAMED)
def test_simple_part_has_its_name_in_any_pose(name, seed):
    mesh, solid = NAMED[name]
    turn = np.eye(3) if seed == 0 else Rotation.random(random_state=seed).as_matrix()
    assert named(shapes.moved(mesh, turn, (seed * 2.0, -1.0, 3.0))) == [solid]


@settings(max_examples=20, deadline=None)
@given(
    name=st.sampled_from(sorted(NAMED)),
    seed=st.integers(0, 2**31),
    shift=st.tuples(*[st.floats(-100, 100)] * 3),
    scale=st.floats(0.1, 20),
)
def test_rigid_motion_and_scale_change_no_name(name, seed, shift, scale):
    (vertices, faces), _ = NAMED[name]
    moved = shapes.moved((vertices * scale, faces), Rotation.random(random_state=seed).as_matrix(), shift)
    before, after = named((vertices * scale, faces), moved)
    assert after == before


@pytest.mark.parametrize(("thickness", "solid"), [(0.0009, "sheet"), (0.0011, "box")])
def test_sheet_is_thinner_than_any_box(thickness, solid):
    assert named(shapes.box((1.0, 1.0, thickness))) == [solid]


def test_tee_and_nothing_have_no_name():
    assert named(tubes.tee(0.05, 0.04, 0.2, 0.2), (np.zeros((3, 3)), [[0, 1, 2]])) == [None, None]
