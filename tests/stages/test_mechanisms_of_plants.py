import numpy as np
import pytest

from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadgraph.query.mechanisms import immovable, joint_names
from cadplants import UsdStyle, make, write_usd
from cadplants.truth.truth_writer import truth_of

# Unit, up axis and instances of the file that a plant is written to.
WAYS = {
    "native, Y up, cm": UsdStyle(0.01, "Y", "native"),
    "nested, Z up, m": UsdStyle(1.0, "Z", "nested"),
    "point, Y up, mm": UsdStyle(0.001, "Y", "point"),
}


def built(preset, folder, style=None):
    file = folder / "plant.usdc"
    write_usd(make(preset, 7), file, style)
    return build(load(file))


def by_pivot(graph):
    """Kind, axis and pivot of all mechanisms, by where they are; a path names other meshes in each file."""
    found = [unit.mechanism for unit in graph.units() if unit.mechanism is not None]
    return sorted(((m.kind, np.array(m.axis), np.array(m.pivot)) for m in found), key=lambda m: tuple(m[2].round(2)))


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    return by_pivot(built("riser", tmp_path_factory.mktemp("plain")))


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_mechanisms_do_not_depend_on_how_the_file_stores_its_meshes(way, plain, tmp_path):
    found = by_pivot(built("riser", tmp_path, way))
    assert [kind for kind, _, _ in found] == [kind for kind, _, _ in plain]
    for (_, axis, pivot), (_, as_before, at_before) in zip(found, plain, strict=True):
        assert np.degrees(np.arccos(np.clip(axis @ as_before, -1, 1))) < 0.1
        assert np.linalg.norm(pivot - at_before) < 0.001


@pytest.mark.slow
@pytest.mark.parametrize(("preset", "count"), [("pumps", 16), ("skid", 24)])
def test_the_labeler_of_the_package_is_enough_to_find_every_mechanism(preset, count):
    plant = make(preset, 7)
    truth = Truth.from_json(truth_of(plant))
    graph = build(plant.scene())
    owner = {mesh: unit for unit in graph.units() for part in unit.parts for mesh in graph.part(part).meshes}
    turning = [unit.turns for unit in truth.units if unit.turns is not None]
    assert len(turning) == sum(unit.mechanism is not None for unit in graph.units()) == count
    assert len(joint_names(graph)) == len(set(joint_names(graph).values())) == count
    assert immovable(graph) == ()
    for true in turning:
        found = owner[true.mesh].mechanism
        axis, apart = np.array(true.axis), np.array(found.pivot) - true.point
        assert (found.kind, found.meshes[0]) == (true.kind, true.mesh)
        assert np.degrees(np.arccos(np.clip(axis @ found.axis, -1, 1))) < 0.1
        assert np.linalg.norm(apart - (apart @ axis) * axis) < 0.001
        if found.kind == "lever":
            assert min(abs(found.open), abs(found.shut)) < 0.5, "drawn at a stop"
        if found.kind == "handwheel":
            assert_square(owner[true.mesh])


def assert_square(unit):
    """The wheel of a gate or globe valve stands square over the middle of its bore, which it was not found by."""
    first, last = (np.array(port.point) for port in unit.ports)
    way = (last - first) / np.linalg.norm(last - first)
    axis = np.array(unit.mechanism.axis)
    square = np.cross(way, axis) / np.linalg.norm(np.cross(way, axis))
    assert abs((np.array(unit.mechanism.pivot) - first) @ square) < 0.001
    assert abs(np.degrees(np.arcsin(way @ axis))) < 0.1
