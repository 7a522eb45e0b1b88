from dataclasses import replace

import numpy as np
import pytest

from cadplants.model.contacts import measured
from cadplants.model.plant import Component, Plant, Unit
from cadplants.presets.single_device import make_device
from cadplants.solids.primitives import box
from cadplants.solids.transforms import at


def row_of(*places, unit="", said=()):
    """Cubes of 0.1 m along x, the first at 0."""
    cubes = tuple(
        Component(box((0.1, 0.1, 0.1)), "Tank", "tank", (0, 0, 0), at(x), unit=unit, cluster="S1") for x in places
    )
    return Plant(cubes, said, (Unit(unit, "tank", "drum"),) if unit else ())


def clusters_of(plant):
    return [component.cluster for component in plant.components]


def test_contacts_are_what_touches_and_what_is_said_to_within_the_looseness():
    plant = replace(row_of(0.0, 0.1, 0.202, 0.4, said=((1, 2), (2, 3))), looseness=0.003)
    now = measured(plant)
    assert now.contacts == ((0, 1), (1, 2))
    assert now.looseness == 0.003


def test_pieces_of_a_cluster_that_come_near_are_joined_and_the_looseness_tells_how_near():
    now = measured(row_of(0.0, 0.104, 0.304))
    assert now.contacts == ((0, 1),)
    assert now.looseness == pytest.approx(0.004, abs=2e-6)
    assert clusters_of(now) == ["S1", "S1", "S1/2"]


def test_measuring_twice_changes_nothing():
    once = measured(row_of(0.0, 0.104, 0.304, 0.6, unit="T-1"))
    twice = measured(once)
    assert clusters_of(twice) == clusters_of(once)
    assert (twice.contacts, twice.units, twice.looseness) == (once.contacts, once.units, once.looseness)


def test_what_stands_apart_is_a_unit_of_its_own():
    now = measured(row_of(0.0, 0.1, 0.5, unit="T-1"))
    assert [component.unit for component in now.components] == ["T-1", "T-1", "T-1/2"]
    assert [unit.id for unit in now.units] == ["T-1", "T-1/2"]


def test_copies_are_in_the_cluster_of_their_originals():
    plant = row_of(0.0, 0.3, 0.3)
    now = measured(replace(plant, duplicates=((1, 2),)))
    assert now.contacts == ()
    assert clusters_of(now) == ["S1", "S1/2", "S1/2"]


def test_drums_on_the_floor_are_units_of_their_own_and_those_on_a_pallet_are_one():
    for base, ids in ((0.0, ["X-1", "X-1/2"]), (0.144, ["X-1"])):
        plant = make_device("tank/drums", given={"count": 2, "base": base, "lying": False})
        assert [unit.id for unit in plant.units] == ids
        assert np.isfinite(plant.looseness)
