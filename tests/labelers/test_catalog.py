import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import knobs
import shapes
from cadgraph.config import LabelConfig
from cadgraph.labelers.catalog import apply_catalogs, find_matches, matches_of_shape
from cadgraph.labelers.given import apply_given
from cadgraph.model.catalog import Catalog, Entry
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.labels import Label
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary
from plates import parts_of

VOCABULARY = default_vocabulary()


def catalog_of(*meshes, names=()):
    names = names or ["handwheel"] * len(meshes)
    return Catalog.of(Scene.from_meshes(meshes), [Entry("", "Valve assembly", name) for name in names])


def matched(catalog, *meshes):
    found, _ = find_matches(catalog, Scene.from_meshes(meshes), workers=1)
    return found


def labelled(catalog, *meshes, before=None, vocabulary=VOCABULARY):
    parts = parts_of(Scene.from_meshes(meshes))
    return apply_catalogs(before or [None] * len(meshes), [catalog], parts, vocabulary)


@settings(max_examples=8, deadline=None)
@given(st.tuples(*[st.floats(-3, 3)] * 3), st.tuples(*[st.floats(-1000, 1000)] * 3))
def test_the_same_shape_matches_exactly_in_any_pose(angles, shift):
    (match,) = matched(catalog_of(knobs.hook()), shapes.moved(knobs.hook(), knobs.turn_of(angles), shift))
    assert (match.kind, match.similarity, match.scale) == ("exact", 1.0, 1.0)


def test_a_mirror_image_is_told_apart():
    (match,) = matched(catalog_of(knobs.hook()), knobs.mirrored(knobs.hook()))
    assert match.kind == "mirrored"


def test_shapes_of_one_scene_match_each_other_as_they_match_an_entry():
    meshes = [knobs.knob(sides=40), knobs.hook(), knobs.mirrored(knobs.hook()), knobs.knob(sides=24), shapes.box()]
    parts = parts_of(
        Scene.from_meshes([shapes.moved(mesh, translation=(9.0 * k, 0, 0)) for k, mesh in enumerate(meshes)])
    )
    for entry in range(len(meshes)):
        found = matches_of_shape(parts, int(parts.shape[entry]))
        expected = matched(catalog_of(meshes[entry]), *meshes)
        told = [found.get(int(shape)) for shape in parts.shape]
        assert [match and (match.kind, match.entry) for match in told] == [
            match and (match.kind, match.entry) for match in expected
        ]
    assert [match and match.kind for match in told] == [None, None, None, None, "exact"]


def test_other_triangles_match_nearly():
    (match,) = matched(catalog_of(knobs.knob(sides=24)), knobs.knob(sides=40))
    assert match.kind == "near"
    assert 0.9 <= match.similarity < 1
    assert match.scale == pytest.approx(1, abs=0.03)


def test_another_size_is_flagged_with_its_scale():
    vertices, faces = knobs.knob()
    (match,) = matched(catalog_of(knobs.knob()), (2.5 * vertices, faces))
    assert match.kind == "scaled"
    assert match.scale == pytest.approx(2.5, rel=1e-6)
    labels, _ = labelled(catalog_of(knobs.knob()), (2.5 * vertices, faces))
    assert labels[0].evidence.scale == 2.5
    assert "2.5 times its size" in labels[0].evidence.why


@pytest.mark.parametrize("mesh", [shapes.tube(0.02, 0.01, 0.003), shapes.box((0.1, 0.1, 0.01)), shapes.cylinder()])
def test_plain_shapes_match_in_their_own_size_only(mesh):
    vertices, faces = mesh
    same, larger = matched(catalog_of(mesh), (1.0 * vertices, faces), (2.0 * vertices, faces))
    assert same.kind == "exact"
    assert larger is None


def test_another_shape_does_not_match():
    assert matched(catalog_of(knobs.knob()), knobs.knob(waist=0.9), knobs.hook(), shapes.sphere(0.05)) == (None,) * 3


def test_entries_that_contradict_each_other_decide_nothing():
    catalog = catalog_of(knobs.knob(sides=24), knobs.knob(sides=25), names=["handwheel", "lever"])
    labels, told = labelled(catalog, knobs.knob(sides=40))
    assert labels == (None,)
    assert [d.code for d in told] == ["catalog-ambiguous"]


def test_an_exact_entry_goes_before_a_near_one():
    catalog = catalog_of(knobs.knob(sides=25), knobs.knob(sides=24), names=["lever", "handwheel"])
    labels, told = labelled(catalog, knobs.knob(sides=24))
    assert labels[0].name == "handwheel"
    assert told == ()


def test_repeats_get_the_label_with_evidence_and_the_labeler_is_overruled():
    before = [Label("Tank", "tank", 0.99, "geometry"), None, Label("Tank", "shell", 0.9, "geometry")]
    meshes = knobs.knob(), shapes.moved(knobs.knob(), translation=(1, 0, 0)), knobs.hook()
    labels, _ = labelled(catalog_of(knobs.knob()), *meshes, before=before)
    assert [label.source for label in labels] == ["catalog", "catalog", "geometry"]
    assert labels[0].confidence == pytest.approx(0.99)
    assert labels[0].evidence.match == "exact"
    assert before[0].name == "tank"


def test_given_labels_go_before_the_catalogue():
    scene = Scene.from_meshes([knobs.knob()])
    parts = parts_of(scene)
    known, _ = apply_catalogs([None], [catalog_of(knobs.knob())], parts, VOCABULARY)
    labels, _ = apply_given(known, [GivenLabel("/mesh_0", "Tank", "tank")], scene, parts, LabelConfig())
    assert (labels[0].name, labels[0].source) == ("tank", "author")


def test_labels_outside_the_vocabulary_are_told_and_not_given():
    catalog = Catalog.of(Scene.from_meshes([knobs.knob()]), [Entry("", "Spaceship", "rocket")])
    labels, told = labelled(catalog, knobs.knob())
    assert labels == (None,)
    assert told[0].code == "catalog-outside-vocabulary"
    assert "Spaceship/rocket" in told[0].message


def test_the_first_catalogue_that_knows_a_shape_counts():
    parts = parts_of(Scene.from_meshes([knobs.knob()]))
    first, second = catalog_of(knobs.knob()), catalog_of(knobs.knob(), names=["lever"])
    labels, _ = apply_catalogs([None], [first, second], parts, VOCABULARY)
    assert labels[0].name == "handwheel"


def test_nothing_matches_nothing():
    assert find_matches(catalog_of(knobs.knob()), Scene.from_meshes([])) == ((), ())
    assert matched(Catalog((), Scene.from_meshes([])), knobs.knob()) == (None,)
    flat = np.zeros((3, 3)), np.array([[0, 1, 2]])
    assert matched(catalog_of(knobs.knob(), flat), flat) == (None,)
