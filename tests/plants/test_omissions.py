import numpy as np
import pytest

from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary
from cadplants.faults.omissions import OMISSIONS, omitted
from cadplants.model.plant import Component, Plant, Unit
from cadplants.parts.flange import GASKET
from cadplants.presets.preset import make
from cadplants.solids.primitives import box
from cadplants.truth.truth_check import prove
from cadplants.truth.truth_writer import truth_of


@pytest.fixture(scope="module")
def pumps():
    return make("pumps", 0, "plant-design")


def labels(plant):
    return {(c.group, c.name) for c in plant.components}


@pytest.mark.parametrize("kind", ["fasteners", "gaskets", "supports", "structure", "handwheels", "gauge needles"])
def test_a_class_that_is_left_out_is_gone(kind, pumps):
    left = omitted(pumps, [kind])
    assert left.n_meshes < pumps.n_meshes
    assert not labels(left) & OMISSIONS[kind] - {("Valve assembly", "handwheel"), ("Valve assembly", "lever")}
    assert left.units == pumps.units
    assert left.connections == pumps.connections
    assert {unit.id for unit in left.units} <= {c.unit for c in left.components}


def test_faces_without_their_gasket_count_as_touching(pumps):
    left = omitted(pumps, ["fasteners", "gaskets"])
    assert left.looseness == pumps.looseness + GASKET
    codes = {finding.code for finding in prove(left.scene(), Truth.from_json(truth_of(left))).findings}
    assert "contact" not in codes


def test_contacts_are_those_of_what_is_left(pumps):
    left = omitted(pumps, ["fasteners", "supports"])
    place = {id(c): k for k, c in enumerate(left.components)}
    kept = [place.get(id(c), -1) for c in pumps.components]
    assert set(left.contacts) == {(kept[a], kept[b]) for a, b in pumps.contacts if kept[a] >= 0 and kept[b] >= 0}


def test_nothing_left_out_changes_nothing(pumps):
    assert omitted(pumps, []).components == pumps.components


def test_an_unknown_class_is_named(pumps):
    with pytest.raises(ValueError, match="'screws and bolts'"):
        omitted(pumps, ["screws and bolts"])


def test_classes_are_of_the_vocabulary():
    vocabulary = default_vocabulary()
    for pairs in OMISSIONS.values():
        assert all(vocabulary.holds(group, name) for group, name in pairs if name)


def stack_of(*names):
    """A valve of cubes on each other."""
    parts = tuple(
        Component(box((1, 1, 1), (0, 0, k)), "Valve assembly", name, (0.5, 0.5, 0.5), np.eye(4), "V-1")
        for k, name in enumerate(names)
    )
    pairs = tuple((k, k + 1) for k in range(len(names) - 1))
    return Plant(parts, pairs, (Unit("V-1", "valve", "valve"),))


def test_a_piece_between_others_stays():
    left = omitted(stack_of("valve body", "gland", "handwheel"), ["glands"])
    assert [c.name for c in left.components] == ["valve body", "gland", "handwheel"]


def test_a_piece_that_nothing_hangs_on_goes():
    left = omitted(stack_of("valve body", "valve stem", "handwheel"), ["handwheels"])
    assert [c.name for c in left.components] == ["valve body", "valve stem"]


def test_the_last_piece_of_a_unit_stays():
    left = omitted(stack_of("handwheel", "lever"), ["handwheels"])
    assert len(left.components) == 1
    assert left.units
