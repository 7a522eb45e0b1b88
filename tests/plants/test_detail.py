from collections import Counter

import numpy as np
import pytest

from cadgraph.geometry.mesh.properties import measure
from cadgraph.model.truth import Truth
from cadplants import STYLES, make
from cadplants.model.plant import Plant
from cadplants.parts.detail import marked_gauge, plate, screw
from cadplants.parts.gauge import pressure_gauge
from cadplants.presets.field import make_field
from cadplants.solids.lettering import letters
from cadplants.truth.part_oracle import SMALL, find_parts
from cadplants.truth.truth_check import prove
from cadplants.truth.truth_writer import truth_of
from plants.solids import is_closed, shell_volumes

pytestmark = pytest.mark.slow

HAND = STYLES["plant-design"]


def plant_of(assembly):
    whole = assembly.marked(cluster="one")
    return Plant(whole.components, whole.contacts, whole.units)


@pytest.mark.parametrize("size", [63, 100, 160])
@pytest.mark.parametrize("needle", [0.6, 2.2, 4.5])
def test_marks_lie_on_the_dial_and_touch_nothing_else(size, needle):
    gauge = plant_of(marked_gauge(pressure_gauge("G", HAND, size, needle=needle), size, "all", HAND))
    assert prove(gauge.scene(), Truth.from_json(truth_of(gauge))).lines() == ()
    assert all(is_closed(c.solid) and (shell_volumes(c.solid) > 0).all() for c in gauge.components)


def test_marks_and_screws_are_below_a_cubic_centimetre_and_join_the_gauge():
    gauge = plant_of(marked_gauge(pressure_gauge("G", HAND, 63), 63, "all", HAND))
    small = measure(gauge.scene()).obb_volume < SMALL
    assert small[3:].all()
    assert sum(len(part) - 1 for part in find_parts(gauge)) == small.sum()


def test_a_gauge_of_one_mesh_has_no_marks():
    gauge = pressure_gauge("G", STYLES["bim"], 63)
    assert marked_gauge(gauge, 63, "all", STYLES["bim"]) is gauge


def test_a_plate_has_a_mesh_for_each_letter_and_rivet():
    sign = plant_of(plate(("V-101", "DN50"), HAND))
    assert len(sign.components) == 1 + 9 + 4
    assert prove(sign.scene(), Truth.from_json(truth_of(sign))).lines() == ()


def test_a_coarse_hand_leaves_letters_out():
    assert len(plate(("V-101",), STYLES["game"]).components) == 1


def test_letters_stand_in_a_row_about_the_origin():
    row = letters("AB 8", 0.01, 0.0003)
    assert len(row) == 3
    ends = [solid.vertices[:, 0].min() + pose[0, 3] for solid, pose in row]
    assert ends == sorted(ends)


def test_a_screw_is_small():
    assert measure(plant_of(screw(HAND)).scene()).obb_volume[0] < SMALL


@pytest.mark.parametrize(("preset", "parts"), [("skid", 174), ("riser", 82), ("tank", 200)])
def test_structures_of_the_paper_have_about_its_parts(preset, parts):
    plant = make(preset, 0)
    joined = sum(len(part) - 1 for part in find_parts(plant))
    assert abs(plant.n_meshes - joined - parts) <= 0.15 * parts


@pytest.mark.slow
def test_the_field_is_like_the_papers_plant():
    plant = make_field(0)
    joined = {i for part in find_parts(plant) for i in part[1:]}
    heads = Counter(c.group for i, c in enumerate(plant.components) if i not in joined)
    assert abs(plant.n_meshes - 8327) < 0.03 * 8327
    assert abs(heads.total() - 2068) < 0.08 * 2068
    assert heads["Structural element"] > heads.total() / 2
    assert 0.2 < heads["Pipe assembly"] / heads.total() < 0.3
    clusters = {c.cluster for c in plant.components if c.cluster}
    assert len(clusters) == 39
    assert sum(not name.startswith(("fence", "pillar")) for name in clusters) == 15


@pytest.mark.slow
@pytest.mark.parametrize("preset", ["skid", "riser", "tank", "pumps", "rack"])
def test_seeds_change_the_whole_layout(preset):
    sizes = []
    for seed in range(4):
        vertices = make(preset, seed).scene().vertices
        sizes.append(np.ptp(vertices, axis=0))
    spread = np.ptp(sizes, axis=0)
    assert (spread > 0.08).sum() >= 2


def test_a_tank_stands_or_lies():
    kinds = {unit.kind for seed in range(6) for unit in make("tank", seed).units if unit.type == "tank"}
    assert kinds == {"tank", "horizontal tank"}
