from dataclasses import replace

import numpy as np
import pytest

from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadplants import degrade, draw_defects, draw_style, make, truth_path, write_usd
from cadplants.solids.transforms import at
from cadplants.truth.truth_check import prove
from cadplants.truth.truth_writer import truth_of

SMALL = ("skid", "riser", "tank", "pumps", "rack")


def proof_of(plant, **changes):
    truth = Truth.from_json({**truth_of(plant), **changes})
    return prove(plant.scene(), truth)


def shifted(plant, index, pose):
    components = list(plant.components)
    components[index] = replace(components[index], pose=pose @ components[index].pose)
    return replace(plant, components=tuple(components))


@pytest.fixture(scope="module")
def riser():
    return make("riser", 0)


def codes(proof):
    return {finding.code for finding in proof.findings}


@pytest.mark.slow
@pytest.mark.parametrize("preset", SMALL)
def test_the_truth_of_every_preset_holds(preset):
    proof = proof_of(make(preset, 7))
    assert proof.lines() == ()
    assert proof.n_checked["contact"] > 100
    assert proof.n_checked["order"] >= 18


@pytest.mark.parametrize("style", ["bim", "mechanical", "scan"])
def test_the_truth_of_every_hand_holds(style):
    assert proof_of(make("riser", 3, style)).lines() == ()


@pytest.mark.slow
@pytest.mark.parametrize("style", ["bim", "game", "scan"])
@pytest.mark.parametrize("preset", ["station", "field"])
def test_what_stands_on_coarse_shells_and_uneven_ground_is_told(preset, style):
    plant = make(preset, 0, style)
    assert proof_of(plant).lines() == ()
    ground = next(i for i, c in enumerate(plant.components) if c.name == "ground")
    assert sum(ground in pair for pair in plant.contacts) > 10


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("preset", ["skid", "riser", "tank"])
def test_fifty_seeds_hold(preset):
    for seed in range(50):
        assert proof_of(make(preset, seed)).lines() == (), seed


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 4])
def test_the_truth_of_a_spoilt_file_holds(seed, tmp_path):
    plant = make("riser", seed, defects=draw_defects(seed))
    write_usd(plant, tmp_path / "plant.usdc", draw_style(seed))
    proof = prove(load(tmp_path / "plant.usdc"), Truth.load(truth_path(tmp_path / "plant.usdc")))
    assert proof.lines() == ()


def test_a_part_that_has_moved_contradicts_its_contacts_and_its_line(riser):
    pipe = next(i for i, c in enumerate(riser.components) if c.name == "pipe")
    proof = proof_of(shifted(riser, pipe, at(0.02, 0.03, 0.0)))
    assert {"contact", "tube"} <= codes(proof)
    assert not proof.holds


def test_a_contact_that_is_not_listed_is_found(riser):
    contacts = truth_of(riser)["contacts"][1:]
    assert "touch" in codes(proof_of(riser, contacts=contacts))


def test_a_cluster_that_falls_apart_is_found(riser):
    truth = truth_of(riser)
    lone = truth["meshes"][-1]["mesh"]
    contacts = [pair for pair in truth["contacts"] if lone not in pair]
    assert {"cluster", "touch"} <= codes(proof_of(riser, contacts=contacts))


def test_clusters_that_touch_are_found(riser):
    meshes = [row["mesh"] for row in truth_of(riser)["meshes"]]
    clusters = [{"id": "a", "meshes": meshes[:40]}, {"id": "b", "meshes": meshes[40:]}]
    assert "apart" in codes(proof_of(riser, clusters=clusters))


def test_devices_in_the_wrong_order_are_found(riser):
    connections = truth_of(riser)["connections"]
    first, second = connections[1], connections[2]
    swapped = {first["to"]: second["to"], second["to"]: first["to"]}
    wrong = [{**c, "from": swapped.get(c["from"], c["from"]), "to": swapped.get(c["to"], c["to"])} for c in connections]
    assert "order" in codes(proof_of(riser, connections=wrong))


def test_a_wrong_length_is_found(riser):
    connections = truth_of(riser)["connections"]
    connections[0]["length"] += 0.2
    assert "order" in codes(proof_of(riser, connections=connections))


def test_units_with_a_stranger_are_found(riser):
    truth = truth_of(riser)
    units = [dict(unit) for unit in truth["units"]]
    caster = next(row["mesh"] for row in truth["meshes"] if row["name"] == "caster")
    units[0]["meshes"] = [*units[0]["meshes"], caster]
    assert "unit" in codes(proof_of(riser, units=units))


def test_a_copy_that_is_none_is_found(riser):
    meshes = [row["mesh"] for row in truth_of(riser)["meshes"]]
    assert "duplicate" in codes(proof_of(riser, duplicates=[meshes[:2]]))


def test_a_hidden_body_that_sticks_out_is_found():
    plant = degrade(make("riser", 0), draw_defects(2), 2)
    assert plant.hidden
    grown = shifted(plant, plant.hidden[0], np.eye(4))
    one = grown.components[plant.hidden[0]]
    big = replace(one, solid=replace(one.solid, vertices=one.solid.vertices * 40))
    components = list(grown.components)
    components[plant.hidden[0]] = big
    assert "hidden" in codes(proof_of(replace(grown, components=tuple(components))))


def test_a_truth_of_another_scene_is_told_at_once(riser):
    other = Truth.from_json(truth_of(make("skid", 0)))
    proof = prove(riser.scene(), other)
    assert codes(proof) == {"mesh"}


def test_what_a_truth_leaves_open_is_not_checked(riser):
    truth = truth_of(riser)
    least = {key: truth[key] for key in ("format", "version", "meshes")}
    assert prove(riser.scene(), Truth.from_json(least)).holds


def test_the_same_scene_gives_the_same_proof(riser):
    assert proof_of(riser, contacts=[]) == proof_of(riser, contacts=[])
