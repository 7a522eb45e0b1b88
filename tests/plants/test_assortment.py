from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary
from cadplants import STYLES, make, write_usd
from cadplants.presets.assortment import FAMILIES, draw_modeling_style, make_assortment
from cadplants.presets.taste import Taste
from cadplants.truth.truth_check import prove
from cadplants.truth.truth_writer import truth_of

pytestmark = pytest.mark.slow

# Exact and whole, so that nothing but the layout is looked at.
PLAIN = replace(STYLES["bim"], name="plain", gap=(0.0, 0.0))


@pytest.fixture(scope="module")
def plants():
    return [make_assortment(seed, PLAIN) for seed in range(6)]


def test_labels_are_in_the_vocabulary_and_families_are_told(plants):
    vocabulary = default_vocabulary()
    for plant in plants:
        for component in plant.components:
            assert vocabulary.holds(component.group, component.name)
            assert component.family
            assert component.granularity
            assert np.isfinite(component.vertices).all()


def test_units_are_those_that_their_components_name(plants):
    of_group = default_vocabulary().unit_of_group
    for plant in plants:
        types = {unit.id: unit.type for unit in plant.units}
        assert len(types) == len(plant.units)
        assert {c.unit for c in plant.components} - {""} == set(types)
        for component in plant.components:
            if component.unit:
                assert types[component.unit] == of_group[component.group]


def test_everything_stands_in_a_cluster_of_its_own(plants):
    for plant in plants:
        assert all(c.cluster or c.name == "ground" for c in plant.components)
        assert len({c.cluster for c in plant.components}) > 3


@pytest.mark.parametrize("seed", range(6))
def test_the_truth_holds_as_it_is_written(seed, tmp_path):
    write_usd(make("assortment", seed), tmp_path / "plant.usdc")
    proof = prove(load(tmp_path / "plant.usdc"), Truth.load(tmp_path / "plant.truth.json"))
    assert proof.lines() == ()
    assert proof.n_checked["contact"] > 200


@pytest.mark.parametrize("style", STYLES)
def test_the_truth_holds_in_every_style(style):
    plant = make("assortment", 3, style)
    assert prove(plant.scene(), Truth.from_json(truth_of(plant))).lines() == ()


def test_connections_join_what_there_is(plants):
    for plant in plants:
        known = {unit.id for unit in plant.units} | {point.id for point in plant.points}
        assert {c.source for c in plant.connections} | {c.target for c in plant.connections} <= known


def test_one_seed_makes_one_plant():
    first, second = make("assortment", 3), make("assortment", 3)
    assert truth_of(first) == truth_of(second)
    for a, b in zip(first.components, second.components, strict=True):
        np.testing.assert_array_equal(a.vertices, b.vertices)
        np.testing.assert_array_equal(a.faces, b.faces)


def test_what_a_plant_has_more_changes_nothing_of_the_rest():
    few, many = (make_assortment(2, PLAIN, taste=Taste(meshes=(most, most + 1))) for most in (60, 200))
    assert few.n_meshes < many.n_meshes
    for a, b in zip(few.components, many.components, strict=False):
        assert (a.name, a.family) == (b.name, b.family)
        np.testing.assert_array_equal(a.vertices, b.vertices)


def test_what_a_device_draws_more_changes_nothing_of_the_rest(monkeypatch):
    plain = make_assortment(2, PLAIN)
    changed = {c.family for c in plain.components} & set(FAMILIES)

    def build_after_more_draws(family, dn, style, source, *height):
        source.rng.random(5)
        return family.build(dn, style, source, *height)

    for name in changed:
        monkeypatch.setitem(
            FAMILIES, name, replace(FAMILIES[name], build=partial(build_after_more_draws, FAMILIES[name]))
        )
    other = make_assortment(2, PLAIN)
    assert changed
    for a, b in zip(plain.components, other.components, strict=True):
        np.testing.assert_array_equal(a.vertices, b.vertices)


def test_seeds_differ(plants):
    assert len({plant.n_meshes for plant in plants}) > 1


def test_whole_kinds_and_single_builds_can_be_left_out():
    without = frozenset({"ball valve", "gauge", "tee/butt weld"})
    kinds = {c.family for seed in range(4) for c in make_assortment(seed, PLAIN, without).components}
    assert not [name for name in kinds if name.split("/")[0] in without or name in without]


def test_a_plant_without_any_family_is_bare_pipe():
    plant = make_assortment(1, PLAIN, frozenset(FAMILIES))
    assert {c.group for c in plant.components if c.name != "ground"} == {"Pipe assembly"}
    assert not plant.units


def test_an_unknown_family_is_named():
    with pytest.raises(ValueError, match="no family 'steam whistle'"):
        make_assortment(0, PLAIN, frozenset({"steam whistle"}))


def test_spools_take_in_their_elbows_and_flanges():
    style = replace(PLAIN, merged=True)
    named = [c for seed in range(3) for c in make_assortment(seed, style, frozenset(FAMILIES)).components]
    assert "pipe/spool" in {c.family for c in named}
    assert "elbow" not in {c.name for c in named}


def test_drawn_hands_vary_and_are_none_of_the_published():
    styles = [draw_modeling_style(np.random.default_rng(seed)) for seed in range(200)]
    assert all(replace(style, name=known.name) != known for style in styles for known in STYLES.values())
    assert not {style.name for style in styles} & set(STYLES)
    for field, least in (("flange", 3), ("fasteners", 4), ("valve", 3), ("gauge", 3), ("pump", 3), ("sides", 12)):
        assert len({getattr(style, field) for style in styles}) >= least, field
    for field in ("hollow", "holes", "gaskets", "merged", "capped", "fans"):
        assert {getattr(style, field) for style in styles} == {True, False}, field
    assert min(style.gap[0] for style in styles) == -0.002
    assert 0.004 < max(style.gap[1] for style in styles) <= 0.005
    assert min(style.sides[0] for style in styles) == 6
    assert max(style.sides[1] for style in styles) == 64
    assert draw_modeling_style(np.random.default_rng(1)) == draw_modeling_style(np.random.default_rng(1))
