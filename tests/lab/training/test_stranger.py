import numpy as np
import pytest
from scipy.spatial import KDTree

from cadlab.training.distractors import UNSEEN, UNSEEN_FROM, make_distractors, visited
from cadlab.training.oddities import ODDITIES
from cadlab.training.samples import Sample, held_out_lessons, training_samples
from cadplants.presets.assortment import make_assortment
from plants.solids import is_closed, shell_volumes


@pytest.mark.parametrize("build", sorted(set(ODDITIES), key=lambda b: b.__name__), ids=lambda b: b.__name__[1:])
def test_oddities_are_closed_and_the_same_for_a_seed(build):
    for seed in range(6):
        solid = build(np.random.default_rng(seed))
        assert is_closed(solid)
        assert (shell_volumes(solid) > 0).all()
        np.testing.assert_array_equal(solid.vertices, build(np.random.default_rng(seed)).vertices)


def kinds(plant):
    return {c.family.removeprefix("strange/") for c in plant.components if c.group == "strange"}


def test_what_is_kept_for_the_trial_is_never_learnt_from():
    unseen = {name[1:] for name in UNSEEN}
    assert not kinds(make_distractors(0)) & unseen
    assert kinds(make_distractors(UNSEEN_FROM)) <= unseen
    learnt = {(sample.kind, sample.seed) for sample in training_samples(40, 8, 4)}
    tried = {(sample.kind, sample.seed) for some in held_out_lessons(1).values() for sample in some}
    assert not learnt & tried


@pytest.mark.slow
def test_guests_touch_their_hosts_and_change_nothing_else():
    plant = make_assortment(3)
    whole = visited(plant, 3, 0.5)
    assert whole.components[: plant.n_meshes] == plant.components
    guests = whole.components[plant.n_meshes :]
    assert guests
    hosts = KDTree(np.concatenate([c.vertices for c in plant.components]))
    for guest in guests:
        assert hosts.query(guest.vertices)[0].min() < 1e-9


def test_lessons_with_guests_hold_strangers():
    sample = next(sample for sample in training_samples(8, 0, 0) if sample.guests)
    assert kinds(sample.plant())
    assert not kinds(Sample(sample.kind, sample.seed).plant())
