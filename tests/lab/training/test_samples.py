import numpy as np

from cadlab.training.samples import Sample
from cadplants.presets.authoring_systems import make_in_system


def test_a_sample_with_a_system_is_a_plant_of_that_system():
    plant, same = Sample("assortment", 2, system="hobby").plant(), make_in_system(2, "hobby")
    assert [c.name for c in plant.components] == [c.name for c in same.components]
    for a, b in zip(plant.components, same.components, strict=True):
        np.testing.assert_array_equal(a.vertices, b.vertices)


def test_a_sample_with_defects_keeps_those_of_its_system():
    plant, spoilt = (Sample("assortment", 2, sin=sin, system="game").plant() for sin in ("", "duplicates"))
    assert len(spoilt.duplicates) > len(plant.duplicates)
    assert set(plant.duplicates) <= set(spoilt.duplicates)
