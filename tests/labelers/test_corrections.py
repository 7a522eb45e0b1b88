from dataclasses import replace

import numpy as np
import pytest

import knobs
import shapes
from cadgraph.config import LabelConfig
from cadgraph.labelers.base import label_parts
from cadgraph.labelers.corrections import apply_corrections
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.model.anchors import anchored_parts, fingerprint_of
from cadgraph.model.corrections import Correction
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.stages.preprocess import prepare_scene
from cadlab.training.example import make_parts_from
from cadplants.presets.preset import make
from plates import parts_of

NO_CONTACTS = Contacts(np.zeros((0, 2), np.int64), np.zeros(0), np.zeros((0, 2, 3)))
PIPE = Label("Pipe assembly", "pipe", 0.9, "geometry")


def at(mesh, *place):
    return shapes.moved(mesh, translation=place)


def scene_of(*meshes):
    return Scene.from_meshes([at(mesh, 3.0 * i, 0, 0) for i, mesh in enumerate(meshes)])


def correction(parts, part, name="handwheel", group="Valve assembly", **more):
    centroid = tuple(parts.properties.centroid[part].tolist())
    return Correction(parts.scene.paths[part], group, name, fingerprint_of(parts.properties, part), centroid, **more)


def applied(scene, corrections, labels=None):
    parts = parts_of(scene)
    made = [correction(parts, **c) if isinstance(c, dict) else c for c in corrections]
    return apply_corrections(labels or [None] * parts.n_parts, made, scene, parts, NO_CONTACTS)


def test_a_correction_is_by_a_human_and_keeps_what_was():
    labels, told = applied(scene_of(knobs.knob()), [{"part": 0}], [PIPE])
    assert (labels[0].group, labels[0].name, labels[0].confidence) == ("Valve assembly", "handwheel", 1.0)
    assert labels[0].source == "human"
    assert labels[0].evidence.to_json()["before"] == {
        "group": "Pipe assembly", "name": "pipe", "confidence": 0.9, "source": "geometry",
    }  # fmt: skip
    assert told == ()


def test_exact_repeats_follow_with_evidence():
    scene = scene_of(knobs.hook(), shapes.moved(knobs.hook(), knobs.turn_of((1, 2, 3))))
    labels, _ = applied(scene, [{"part": 0}], [PIPE, PIPE])
    assert (labels[1].name, labels[1].source, labels[1].confidence) == ("handwheel", "repeat", 1.0)
    assert labels[1].evidence.corrected == "/mesh_0"
    assert labels[1].evidence.match == "exact"


def test_this_only_changes_nothing_else():
    before = [PIPE, PIPE]
    labels, _ = applied(scene_of(knobs.hook(), knobs.hook()), [{"part": 0, "this_only": True}], before)
    assert labels[0].name == "handwheel"
    assert labels[1] is PIPE
    assert before == [PIPE, PIPE]


def test_other_triangles_sizes_and_hands_follow_softly():
    vertices, faces = knobs.knob()
    others = knobs.knob(sides=40), (3 * vertices, faces), knobs.mirrored(knobs.hook())
    scene = scene_of(knobs.knob(), knobs.hook(), *others)
    labels, _ = applied(scene, [{"part": 0}, {"part": 1, "name": "lever"}])
    assert [label.evidence.match for label in labels] == [None, None, "near", "scaled", "mirrored"]
    assert [label.name for label in labels[2:]] == ["handwheel", "handwheel", "lever"]
    assert all(0.5 < label.confidence < 1 for label in labels[2:])


@pytest.mark.parametrize("source", ["author", "human"])
def test_repeats_that_somebody_labelled_stay(source):
    kept = Label("Tank", "tank", 1.0, source)
    labels, _ = applied(scene_of(knobs.hook(), knobs.hook()), [{"part": 0}], [None, kept])
    assert labels[1] is kept


def test_a_correction_goes_before_given_labels():
    labels, _ = applied(scene_of(knobs.hook()), [{"part": 0}], [Label("Tank", "tank", 1.0, "author")])
    assert labels[0].source == "human"


def test_the_catalogue_keeps_near_repeats_but_not_exact_ones():
    known = Label("Tank", "tank", 0.99, "catalog")
    scene = scene_of(knobs.knob(), knobs.knob(), knobs.knob(sides=40))
    labels, _ = applied(scene, [{"part": 0}], [None, known, known])
    assert [label.source for label in labels] == ["human", "repeat", "catalog"]


def test_the_latest_correction_of_a_mesh_counts():
    labels, _ = applied(scene_of(knobs.hook()), [{"part": 0}, {"part": 0, "name": "lever"}])
    assert labels[0].name == "lever"


def test_parts_are_found_after_meshes_were_renamed_and_reordered():
    scene = scene_of(knobs.knob(), knobs.hook())
    parts = parts_of(scene)
    made = [correction(parts, 0), correction(parts, 1)]
    shuffled = replace(scene.select([1, 0]), paths=("/mesh_0", "/another"))
    found = anchored_parts(shuffled, parts_of(shuffled))
    assert [found.find(one.anchor) for one in made] == [1, 0]


def test_equal_parts_that_a_new_export_numbers_anew_are_found_by_their_place():
    scene = scene_of(*[knobs.hook()] * 4)
    made = correction(parts_of(scene), 2)
    # The first of them is gone, so that each has the name of the one before; the last one's name is free again.
    revised = replace(scene.select([1, 2, 3]), paths=("/mesh_0", "/mesh_1", "/mesh_2"))
    assert anchored_parts(revised, parts_of(revised)).find(made.anchor) == 1
    # Where nothing of its shape lies in its place, it has moved and kept its name.
    moved = scene.select([0, 2])
    gone = replace(moved.with_vertices(moved.vertices + np.array([0.0, 5.0, 0.0])), paths=("/mesh_0", "/mesh_2"))
    assert anchored_parts(gone, parts_of(gone)).find(made.anchor) == 1


def test_a_correction_without_its_part_is_told_and_lays_hands_on_nothing():
    parts = parts_of(scene_of(knobs.knob()))
    labels, told = applied(scene_of(knobs.hook()), [correction(parts, 0)])
    assert labels == (None,)
    assert [(d.code, d.meshes) for d in told] == [("correction-lost", ("/mesh_0",))]


def test_without_corrections_nothing_changes():
    assert applied(scene_of(knobs.hook()), [], [PIPE]) == ((PIPE,), ())


# Few shots: a family that no model has learnt, strewn into a plant.

SOUND = [(0.03 + 0.003 * k, 0.3 + 0.03 * (k % 5), 0.9 + 0.06 * ((3 * k) % 7)) for k in range(14)]
"""Radius, waist and height of each knob: no two have the same proportions."""
CORRECTED = (0, 4, 9)


@pytest.fixture(scope="module")
def plant():
    """The parts of a riser with knobs around it, their contacts, and their labels by the model in the package."""
    riser = make("riser", 5).scene()
    meshes = [riser.mesh(i) for i in range(riser.n_meshes)]
    angles = np.random.default_rng(3).uniform(-3, 3, (len(SOUND), 3))
    for k, (radius, waist, height) in enumerate(SOUND):
        mesh = knobs.knob(radius, waist, height * radius * 1.3, sides=(16, 20, 24, 32)[k % 4])
        meshes.append(shapes.moved(mesh, knobs.turn_of(angles[k]), (5 + 0.5 * k, 5, 1)))
    scene = Scene.from_meshes(meshes, [*riser.paths, *(f"/knob_{k}" for k in range(len(SOUND)))])
    parts, contacts = make_parts_from(scene)
    labels = label_parts(EmbeddedLabeler(), parts, contacts, default_vocabulary(), LabelConfig()).labels
    return prepare_scene(scene)[0], parts, contacts, labels


@pytest.mark.slow
def test_three_corrections_change_a_family_that_the_model_does_not_know_and_little_else(plant):
    scene, parts, contacts, said = plant
    part_of = {path: i for i, path in enumerate(parts.scene.paths)}
    knob_of = [part_of[f"/knob_{k}"] for k in range(len(SOUND))]
    # Whatever a model makes of some of them: what it doesn't know has no label.
    before = tuple(None if part in knob_of else label for part, label in enumerate(said))
    made = [correction(parts, knob_of[k], "lamp", "Electrical and safety") for k in CORRECTED]
    after, told = apply_corrections(before, made, scene, parts, contacts)
    assert told == ()
    others = [part for k, part in enumerate(knob_of) if k not in CORRECTED]
    followed = [after[part] for part in others if after[part] is not None and after[part].name == "lamp"]
    assert len(followed) >= 0.8 * len(others)
    assert {label.source for label in followed} == {"repeat"}
    assert "kin" in {label.evidence.match for label in followed}
    distractors = [part for part in range(parts.n_parts) if part not in knob_of]
    changed = [part for part in distractors if after[part] != before[part]]
    assert len(changed) < 0.02 * len(distractors)


def test_parts_that_the_model_is_sure_about_are_not_drawn_along(plant):
    scene, parts, contacts, before = plant
    sure = max(range(parts.n_parts), key=lambda p: before[p].confidence if before[p] is not None else 0.0)
    after, _ = apply_corrections(
        before, [correction(parts, sure, "lamp", "Electrical and safety")], scene, parts, contacts
    )
    moved = [p for p in range(parts.n_parts) if parts.shape[p] != parts.shape[sure] and after[p] != before[p]]
    kin = [p for p in moved if after[p].evidence.match == "kin"]
    assert all(after[p].evidence.similarity > 0.9 for p in kin if before[p] is not None)
