import numpy as np
import pytest

import shapes
from cadgraph.config import GroupConfig
from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Scene
from cadgraph.stages.group import group_meshes, group_volume


def near(*rows):
    rows = sorted(rows)
    pairs = np.array([r[:2] for r in rows], np.int64).reshape(-1, 2)
    return Contacts(pairs, np.array([r[2] for r in rows], float), np.zeros((len(rows), 2, 3)))


def heads(sizes, *rows, ground=(), **settings):
    properties = measure(Scene.from_meshes([shapes.box((s, s, s)) for s in sizes]))
    mask = np.isin(np.arange(len(sizes)), ground)
    return group_meshes(properties, mask, near(*rows), GroupConfig(**settings)).tolist()


def test_a_small_mesh_joins_the_closest_larger_one():
    assert heads([0.1, 0.1, 0.005], (0, 2, 0.008), (1, 2, 0.003)) == [0, 1, 1]


def test_a_tie_goes_to_the_lower_index():
    assert heads([0.1, 0.1, 0.005], (0, 2, 0.0), (1, 2, 1e-12)) == [0, 1, 0]


def test_a_small_mesh_without_a_larger_neighbour_stays_on_its_own():
    assert heads([0.1, 0.005, 0.005], (1, 2, 0.0)) == [0, 1, 2]


@pytest.mark.parametrize(("distance", "joined"), [(0.01, 0), (0.0101, 1)])
def test_the_proximity_itself_still_joins(distance, joined):
    assert heads([0.1, 0.005], (0, 1, distance))[1] == joined


@pytest.mark.parametrize(("size", "joined"), [(0.00999, 0), (0.01, 1)])
def test_only_meshes_below_the_volume_are_small(size, joined):
    assert heads([0.1, size], (0, 1, 0.0))[1] == joined


def test_nothing_joins_the_ground_and_the_ground_joins_nothing():
    assert heads([1.0, 0.005], (0, 1, 0.0), ground=[0]) == [0, 1]
    assert heads([1.0, 0.005], (0, 1, 0.0), ground=[1]) == [0, 1]


def test_a_threshold_of_zero_leaves_every_mesh_alone():
    assert heads([0.1, 0.001], (0, 1, 0.0), max_volume=0.0) == [0, 1]


def test_the_volume_that_decides_can_be_chosen():
    turn = np.array([[1, -1, 0], [1, 1, 0], [0, 0, np.sqrt(2)]]) / np.sqrt(2)
    properties = measure(Scene.from_meshes([shapes.moved(shapes.tube(0.1, 0.09, 1.0), turn)]))
    volume = {v: float(group_volume(properties, GroupConfig(volume=v))[0]) for v in ("obb", "aabb", "mesh")}
    assert volume["mesh"] < volume["obb"] <= volume["aabb"] * (1 + 1e-9)
    assert volume["obb"] == pytest.approx(0.04, rel=0.02)


def test_nothing_gives_nothing():
    assert heads([]) == []
