from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import default_vocabulary
from cadplants.families import FAMILIES
from cadplants.families.lookalikes.lookalike import LOOKALIKES
from cadplants.families.primitive.primitive import PRIMITIVES
from cadplants.faults.defects import Defects
from cadplants.faults.omissions import OMISSIONS
from cadplants.parts.flange import flange
from cadplants.parts.piping import outlet
from cadplants.presets.assortment import make_assortment
from cadplants.presets.authoring_systems import SYSTEMS, draw_system, make_in_system
from cadplants.presets.taste import ALL_FAMILIES, LAID, Taste
from cadplants.styles.modeling_style import STYLES
from cadplants.truth.truth_check import prove
from cadplants.truth.truth_writer import truth_of
from plants.solids import is_closed, shell_volumes

OF_PRIMITIVES = Defects(devices="primitives").of_style(STYLES["plant-design"])


def drawn(name, count=60):
    return [draw_system(np.random.default_rng(seed), name) for seed in range(count)]


def check(plant):
    """That a plant is in the vocabulary's words, and that its truth holds."""
    vocabulary, of_group = default_vocabulary(), default_vocabulary().unit_of_group
    types = {unit.id: unit.type for unit in plant.units}
    assert {c.unit for c in plant.components} - {""} == set(types)
    for c in plant.components:
        assert vocabulary.holds(c.group, c.name) or c.family == "insulation"
        assert np.isfinite(c.vertices).all()
        assert len(c.faces)
        assert c.family
        if c.unit:
            assert types[c.unit] == of_group[c.group]
    known = set(types) | {point.id for point in plant.points}
    assert {c.source for c in plant.connections} | {c.target for c in plant.connections} <= known
    assert all(0 <= k < plant.n_meshes for pair in plant.contacts for k in pair)
    assert prove(plant.scene(), Truth.from_json(truth_of(plant))).lines() == ()


@pytest.mark.parametrize("name", SYSTEMS)
def test_a_system_makes_a_valid_plant(name):
    check(make_in_system(1, name))


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("name", SYSTEMS)
def test_a_system_makes_valid_plants_of_many_seeds(name):
    for seed in range(2, 10):
        check(make_in_system(seed, name))


def test_one_seed_makes_one_plant_and_others_make_others():
    first, second = make_in_system(3, "building"), make_in_system(3, "building")
    assert truth_of(first) == truth_of(second)
    for a, b in zip(first.components, second.components, strict=True):
        np.testing.assert_array_equal(a.vertices, b.vertices)
        np.testing.assert_array_equal(a.faces, b.faces)
    assert truth_of(first) != truth_of(make_in_system(4, "building"))
    assert truth_of(first) != truth_of(make_in_system(3, "scan"))
    assert first.seed == 3


def test_one_generator_draws_one_authoring():
    assert drawn("hobby", 4) == drawn("hobby", 4)
    assert {one.system for one in drawn(None)} == set(SYSTEMS)


@pytest.mark.parametrize("name", SYSTEMS)
def test_plants_of_one_system_differ_in_style_defects_and_omissions(name):
    some = drawn(name)
    assert all(one.omissions <= set(OMISSIONS) for one in some)
    assert len({one.omissions for one in some}) > 5
    assert len({one.style.sides for one in some}) > 2
    assert len({one.style.flange for one in some}) > 1
    assert len({repr(one.defects) for one in some}) > 5
    assert not {one.style.name for one in some} & set(STYLES)


def test_plant_design_leaves_faces_apart_and_draws_neither_gaskets_nor_holes():
    some = drawn("plant-design", 200)
    assert not any(one.style.gaskets or one.style.holes for one in some)
    apart = [one.defects.faces for one in some if one.defects.faces]
    assert len(apart) > 120
    assert all(0.0015 <= low < high <= 0.0045 for low, high in apart)
    assert sum(one.style.devices == "primitives" for one in some) > 150
    assert {"doubled", "insulation"} <= {
        field for one in some for field in ("doubled", "insulation") if getattr(one.defects, field)
    }


def test_mechanical_plants_have_every_fastener_and_pipes_set_back():
    some = drawn("mechanical", 100)
    assert sum(one.style.fasteners == "pieces" for one in some) > 40
    assert sum(one.defects.setback is not None for one in some) > 30


def test_families_can_be_left_out_of_a_system():
    plant = make_in_system(2, "plant-design", frozenset({"valve", "cable tray"}))
    assert not [c for c in plant.components if c.family.split("/")[0] in ("valve", "cable tray")]


def test_unknown_systems_and_families_are_named():
    with pytest.raises(ValueError, match="unknown system 'cave painting'; there are plant-design"):
        make_in_system(0, "cave painting")
    with pytest.raises(ValueError, match="unknown system"):
        draw_system(np.random.default_rng(0), "cave painting")
    with pytest.raises(ValueError, match="no family 'steam whistle'"):
        make_in_system(0, "game", frozenset({"steam whistle"}))


def test_names_of_all_families_differ():
    assert len(ALL_FAMILIES) == len(FAMILIES) + len(PRIMITIVES) + len(LOOKALIKES) + len(LAID)


def test_a_style_of_primitives_makes_an_assortment_of_primitives():
    plants = [make_assortment(seed, OF_PRIMITIVES) for seed in range(4)]
    kinds = Counter(c.family in PRIMITIVES for plant in plants for c in plant.components if c.unit)
    assert kinds[True] > 2 * kinds[False]
    ours = make_assortment(1, OF_PRIMITIVES, taste=Taste((0.0, 1.0, 0.0)))
    made = {c.family for c in ours.components if c.family in ALL_FAMILIES}
    assert made
    assert made <= set(PRIMITIVES)


@pytest.mark.parametrize("shape", ["ring", "slip", "neck"])
@pytest.mark.parametrize("hollow", [False, True])
def test_flanges_of_primitives_are_one_disc_with_its_hub_in_few_triangles(shape, hollow):
    style = replace(OF_PRIMITIVES, flange=shape, hollow=hollow, sides=(12, 12), holes=True)
    solid = flange(50, style).components[0].solid
    assert is_closed(solid)
    assert len(shell_volumes(solid)) == 1
    # A ring of 12 sides for each corner of the outline, two triangles a side.
    assert len(solid.faces) <= 12 * 2 * 7


@pytest.mark.parametrize("sides", [(8, 8), (10, 10), (12, 12)])
def test_outlets_of_primitives_are_bare_snouts_as_high_as_others(sides):
    solids = [
        outlet(50, style).components[0].solid for style in (replace(OF_PRIMITIVES, sides=sides), STYLES["plant-design"])
    ]
    assert is_closed(solids[0])
    assert len(solids[0].faces) < len(solids[1].faces)
    assert solids[0].vertices[:, 2].max() == pytest.approx(solids[1].vertices[:, 2].max())


def test_a_taste_keeps_to_its_sizes():
    style = replace(STYLES["bim"], gap=(0.0, 0.0))
    plant = make_assortment(5, style, frozenset(FAMILIES), Taste((1.0, 0.0, 0.0), sizes=(15, 15)))
    assert {round(line.outer, 4) for line in plant.lines} == {0.0213}
