"""The course end to end on a few tiny plants, and that nothing is tried on what it was learnt from."""

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cadgraph.labelers.embedded.model import STRANGE, default_model
from cadgraph.load import load
from cadgraph.model.vocabulary import default_vocabulary
from cadlab.training.figure import Answers, answer, error_of_families, least_confidence, score
from cadlab.training.real import read_modelled_plants, read_real_parts, read_real_plants, side_by_side
from cadlab.training.samples import LEFT_OUT, TRIED_FROM, Sample, held_out_lessons, training_samples
from cadplants.presets.authoring_systems import SYSTEMS
from cadplants.presets.preset import make
from cadplants.presets.single_device import make_device
from cadplants.writers.usd import write_usd

MODELLED = Path(__file__).parents[3] / "packages" / "cadlab" / "training_plants"


def answers(truth, name, confidence):
    truth, name, confidence = np.array(truth), np.array(name), np.array(confidence, float)
    group = np.array([label.split("/")[0] for label in name])
    empty = np.full(len(truth), "")
    return Answers(truth, name, group, confidence, confidence, empty, empty)


def test_strangers_count_against_the_threshold_but_not_in_the_score():
    said = answers(["a/x", "a/x", STRANGE, "a/y"], ["a/x", "a/x", "a/x", "b/z"], [0.9, 0.6, 0.7, 0.3])
    assert least_confidence(said, 1.0) == 0.9
    assert least_confidence(said, 0.6) == 0.6
    scores = score(said, 0.5)
    assert (scores.parts, scores.name, scores.kept, scores.precision) == (
        3,
        pytest.approx(2 / 3),
        pytest.approx(2 / 3),
        1,
    )


def test_parts_of_one_family_are_one_chance():
    said = answers(["a/x"] * 8, ["a/x"] * 4 + ["b/z"] * 4, [0.9] * 8)
    alone = replace(said, family=np.arange(8))
    together = replace(said, family=np.repeat([0, 1], 4))
    assert error_of_families(alone) == pytest.approx((0.5 / 8**0.5, 0.5 / 8**0.5))
    assert error_of_families(together) == pytest.approx((0.5 / 2**0.5, 0.5 / 2**0.5))


def test_lessons_know_every_system_and_trials_name_each():
    learnt = training_samples(16, 4, 3)
    assert {sample.system for sample in learnt} == {*SYSTEMS, ""}
    tried = held_out_lessons(1)
    for name in SYSTEMS:
        assert {sample.system for sample in tried[f"system: {name}"]} == {name}
    assert not set(learnt) & {sample for some in tried.values() for sample in some}


def test_a_second_draw_has_other_plants_and_none_of_the_systems_that_it_leaves_out():
    first, second = training_samples(18, 4, 3), training_samples(18, 4, 3, 1)
    assert not set(first) & set(second)
    assert {sample.system for sample in second} == {*SYSTEMS, ""} - LEFT_OUT
    # As many of each system as the first.
    assert len(second) == len(first) - 2 * len(LEFT_OUT)
    assert max(sample.seed for sample in second) < TRIED_FROM


def test_of_no_plants_there_are_no_answers():
    said = answer(default_model(), [])
    assert len(said.truth) == 0
    assert score(said, 0.5).parts == 0


@pytest.fixture(scope="module")
def modelled(tmp_path_factory):
    """A folder as one with plants of other modellers is laid out."""
    folder = tmp_path_factory.mktemp("modelled")
    for k, place in enumerate(("one/riser", "one/skid", "two/riser")):
        (folder / place).mkdir(parents=True)
        truth = write_usd(make("riser", k, "game"), folder / place / "scene.usdc")
        meshes = json.loads(truth.read_text())["meshes"]
        meshes[0] |= {"group": "none", "name": "none"}
        truth.write_text(json.dumps({"meshes": meshes}))
    return folder


@pytest.fixture(scope="module")
def real(tmp_path_factory):
    """A folder as one with real plants and parts is laid out."""
    folder = tmp_path_factory.mktemp("real")
    (folder / "riser").mkdir()
    truth = write_usd(make("riser", 3, "game"), folder / "riser" / "scene.usdc")
    meshes = json.loads(truth.read_text())["meshes"]
    truth.write_text(json.dumps({"meshes": meshes[5:]}))
    rows = []
    for k, (maker, licence) in enumerate(
        (("one", "MIT"), ("two", "CC-BY-SA-4.0"), ("three", "CC0"), ("four", "GPL-3.0"))
    ):
        (folder / "parts" / maker).mkdir(parents=True)
        truth = write_usd(make_device("gate valve/forged", k, "bim"), folder / "parts" / maker / "p0.usdc")
        first = json.loads(truth.read_text())["meshes"][0]
        if k == 2:
            first = {"mesh": first["mesh"], "group": "none", "name": ""}
        label = {key: first[key] for key in ("mesh", "group", "name")}
        rows.append({"file": f"{maker}/p0.usdc", "licence": licence, **label})
    with (folder / "parts" / "labels.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return folder


@pytest.mark.slow
def test_real_plants_and_parts_are_read_with_their_labels_and_licences(real, tmp_path):
    [plant] = read_real_plants(real)
    assert plant.name == "riser"
    assert plant.scene.n_meshes == len(plant.example.label)
    assert 0 < (plant.example.label == "").sum() < len(plant.example.label)
    parts = {part.maker: part for part in read_real_parts(real / "parts", tmp_path, workers=1)}
    assert {maker for maker, part in parts.items() if part.open} == {"one", "three"}
    assert STRANGE in parts["three"].examples[0].label
    # Stretched versions are the same parts of other sizes.
    as_it_is, stretched = parts["one"].examples[:2]
    assert (as_it_is.label == stretched.label).all()
    assert not np.allclose(as_it_is.sizes[0], stretched.sizes[0])
    again = read_real_parts(real / "parts", tmp_path, workers=1)
    assert len(again) == len(parts)


@pytest.mark.slow
def test_modelled_plants_are_read_with_what_belongs_to_no_plant_and_stretched(modelled, tmp_path):
    plants = read_modelled_plants(modelled, tmp_path, workers=1)
    assert [(plant.modeller, plant.name) for plant in plants] == [("one", "riser"), ("one", "skid"), ("two", "riser")]
    as_it_is, *stretched = plants[0].examples
    assert (as_it_is.label == STRANGE).sum() == 1
    assert len(stretched) == 3
    for other in stretched:
        assert (other.label == as_it_is.label).all()
        assert not np.allclose(other.sizes[other.shape], as_it_is.sizes[as_it_is.shape])
    kept = {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    again = read_modelled_plants(modelled, tmp_path, workers=1)
    assert {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()} == kept
    assert [plant.digest for plant in again] == [plant.digest for plant in plants]


def test_without_modelled_plants_there_are_none(tmp_path):
    assert read_modelled_plants(tmp_path / "nowhere", tmp_path / "kept", workers=1) == []


@pytest.mark.parametrize("truth", sorted(MODELLED.glob("*/*/scene.truth.json")), ids=lambda path: path.parent.name)
def test_every_mesh_of_a_plant_to_learn_from_has_a_label(truth):
    vocabulary = default_vocabulary()
    labels = {row["mesh"]: (row["group"], row["name"]) for row in json.loads(truth.read_text("utf-8"))["meshes"]}
    assert set(labels) == set(load(truth.with_name("scene.usdc")).paths)
    assert [label for label in labels.values() if label[0] != "none" and not vocabulary.holds(*label)] == []


@pytest.mark.slow
def test_scenes_side_by_side_keep_to_themselves(real, tmp_path):
    examples = [part.examples[0] for part in read_real_parts(real / "parts", tmp_path, workers=1)]
    whole = side_by_side(examples)
    n = len(examples[0].label)
    assert len(whole.label) == sum(len(e.label) for e in examples)
    assert ((whole.here < n) == (whole.there < n)).all()
    np.testing.assert_array_equal(whole.forms[whole.shape[n:]], np.vstack([e.forms[e.shape] for e in examples[1:]]))


@pytest.mark.slow
def test_a_tiny_course_ends_in_a_model_a_page_and_a_sheet(real, modelled, tmp_path, monkeypatch):
    pytest.importorskip("torch")
    from cadlab.training import __main__ as command
    from cadlab.training import course

    few = {
        **{f"system: {name}": [Sample("riser", 9, system=name)] for name in SYSTEMS},
        "published styles": [Sample("riser", 9, "game")],
        "strangers": [Sample("strangers", 9)],
        "unseen strangers": [Sample("strangers", 200_009)],
    }
    monkeypatch.setattr(course, "held_out_lessons", lambda seeds: few)
    monkeypatch.setattr(
        course, "training_samples", lambda *counts: [Sample("riser", k, system=name) for k, name in enumerate(SYSTEMS)]
    )
    model, page, sheet = tmp_path / "model.npz", tmp_path / "page.md", tmp_path / "sheet.jpg"
    command.main([
        "--model", str(model), "--page", str(page), "--sheet", str(sheet), "--plants-in", str(tmp_path / "kept"),
        "--real", str(real), "--modelled", str(modelled),
        "--members", "1", "--folds", "2", "--epochs", "1", "--workers", "1", "--no-ablations",
    ])  # fmt: skip
    assert model.is_file()
    assert sheet.read_bytes()[:2] == b"\xff\xd8"
    text = page.read_text()
    for words in (
        "riser", "single real parts of held-out makers", "robot-world", "sheet.jpg", "one, three", "modeller two",
        "3 plants by 2 other modellers",
    ):  # fmt: skip
        assert words in text.replace("['one', 'three']", "one, three").replace("'three', 'one'", "one, three")
