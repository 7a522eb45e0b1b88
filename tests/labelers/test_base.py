import numpy as np
import pytest

import shapes
from cadgraph.config import LabelConfig
from cadgraph.errors import LabelError
from cadgraph.geometry.mesh.properties import measure
from cadgraph.labelers.base import Labeling, label_parts
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.given import apply_given
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.labels import GivenEvidence, Guess, Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary

VOCABULARY = default_vocabulary()
NO_CONTACTS = Contacts(np.zeros((0, 2), np.int64), np.zeros(0), np.zeros((0, 2, 3)))
PIPE = Label("Pipe assembly", "pipe", 0.9, "geometry")


class Says:
    def __init__(self, *answers, threshold=0.5):
        self.labeling = Labeling.judge(answers, threshold)

    def label(self, parts, contacts, vocabulary):
        return self.labeling


def sure(confidence):
    return PIPE.model_copy(update={"confidence": confidence})


def scene_of(n):
    return Scene.from_meshes([shapes.box(size=(1 + i, 1, 1), center=(10 * i, 0, 0)) for i in range(n)])


def parts_of(scene, *meshes):
    part_of_mesh = np.zeros(scene.n_meshes, np.int64)
    for part, members in enumerate(meshes):
        part_of_mesh[list(members)] = part
    heads = [members[0] for members in meshes]
    merged = scene.merge(part_of_mesh, heads)
    n = len(meshes)
    return Parts(merged, tuple(meshes), part_of_mesh, measure(merged), np.arange(n), np.zeros(n, np.bool_))


def given(mesh, name="valve", group="Valve assembly"):
    return GivenLabel(f"/mesh_{mesh}", group, name)


def test_no_labeler_leaves_all_parts_open():
    parts = parts_of(scene_of(2), (0,), (1,))
    labeled = label_parts(None, parts, NO_CONTACTS, VOCABULARY, LabelConfig())
    assert labeled.labels == (None, None)
    assert labeled.guesses == ((), ())


def test_setting_chooses_the_labeler():
    assert labeler_of(LabelConfig(labeler="none")) is None
    assert isinstance(labeler_of(LabelConfig()), EmbeddedLabeler)


@pytest.mark.parametrize(("confidence", "kept"), [(0.5, True), (0.4999, False)])
def test_label_at_least_as_sure_as_the_limit_is_kept(confidence, kept):
    parts = parts_of(scene_of(1), (0,))
    answer = sure(confidence)
    result = label_parts(Says(answer), parts, NO_CONTACTS, VOCABULARY, LabelConfig(min_confidence=0.5))
    assert result.labels == ((answer,) if kept else (None,))
    assert result.guesses == ((() if kept else (Guess("Pipe assembly", "pipe", confidence),)),)


def test_without_a_setting_the_labelers_own_threshold_counts():
    parts = parts_of(scene_of(1), (0,))
    assert label_parts(Says(sure(0.7)), parts, NO_CONTACTS, VOCABULARY, LabelConfig()).labels[0] is not None
    strict = Says(sure(0.7), threshold=0.8)
    assert label_parts(strict, parts, NO_CONTACTS, VOCABULARY, LabelConfig()).labels == (None,)
    assert label_parts(strict, parts, NO_CONTACTS, VOCABULARY, LabelConfig(min_confidence=0.6)).labels[0] is not None


def test_a_label_that_is_not_sure_is_marked_as_likely():
    parts = parts_of(scene_of(3), (0,), (1,), (2,))
    answers = [sure(0.9), sure(0.6), sure(0.3)]

    class Unsure:
        def label(self, parts, contacts, vocabulary):
            return Labeling.judge(answers, 0.4, sure=0.8)

    labels = label_parts(Unsure(), parts, NO_CONTACTS, VOCABULARY, LabelConfig()).labels
    assert [label and label.likely for label in labels] == [False, True, None]
    stricter = label_parts(Unsure(), parts, NO_CONTACTS, VOCABULARY, LabelConfig(sure_confidence=0.95)).labels
    assert [label and label.likely for label in stricter] == [True, True, None]
    assert "likely" not in labels[0].model_dump(mode="json")
    assert labels[1].model_dump(mode="json")["likely"] is True


def test_an_answer_for_many_parts_stays_one_object_marked_or_not():
    one, unsure = sure(0.9), sure(0.6)
    labels = Labeling.judge([one, unsure, one, unsure], 0.4, sure=(0.8, 0.8, 0.95, 0.5)).labels
    assert [label.likely for label in labels] == [False, True, True, False]
    labels = Labeling.judge([one, unsure] * 3, 0.4, sure=0.8).labels
    assert len({id(label) for label in labels}) == 2
    assert labels[0] is one
    assert (labels[1].likely, unsure.likely) == (True, False)


@pytest.mark.parametrize("unknown", [("Spaceship", None), ("Pipe assembly", "warp core")])
def test_label_outside_the_vocabulary_is_dropped_and_told(unknown):
    parts = parts_of(scene_of(3), (0,), (1,), (2,))
    stranger = Label(*unknown, 1.0, "geometry")
    said = label_parts(Says(stranger, PIPE, stranger), parts, NO_CONTACTS, VOCABULARY, LabelConfig())
    assert said.labels == (None, PIPE, None)
    [note] = said.diagnostics
    assert (note.code, note.meshes) == ("unknown-label", ("/mesh_0", "/mesh_2"))
    assert f"says {'/'.join(filter(None, unknown))!r} of 2 parts" in note.message


@pytest.mark.parametrize(
    ("source", "evidence", "words"),
    [
        ("human", {}, "calls the source of its label of /mesh_0 'human'.*a word of your own"),
        ("mine", {"weights": np.arange(3)}, "evidence of /mesh_0 can't be written.*ndarray.*give numbers"),
        ("mine", {"score": float("nan")}, "evidence of /mesh_0 can't be written"),
    ],
)
def test_what_a_labeler_may_not_say_ends_in_one_line(source, evidence, words):
    parts = parts_of(scene_of(1), (0,))
    says = Says(Label("Pipe assembly", "pipe", 0.9, source, evidence))
    with pytest.raises(LabelError, match=words) as caught:
        label_parts(says, parts, NO_CONTACTS, VOCABULARY, LabelConfig())
    assert "\n" not in str(caught.value)


def test_wrong_number_of_answers_is_an_error():
    parts = parts_of(scene_of(2), (0,), (1,))
    with pytest.raises(LabelError, match="1 answers for 2 parts"):
        label_parts(Says(PIPE), parts, NO_CONTACTS, VOCABULARY, LabelConfig())


def test_a_plain_list_of_labels_still_counts():
    class Lists:
        def label(self, parts, contacts, vocabulary):
            return [PIPE, sure(0.4)]

    parts = parts_of(scene_of(2), (0,), (1,))
    with pytest.warns(DeprecationWarning, match="Labeling.judge"):
        said = label_parts(Lists(), parts, NO_CONTACTS, VOCABULARY, LabelConfig())
    assert said.labels == (PIPE, None)


def test_guesses_without_an_answer_are_kept():
    parts = parts_of(scene_of(1), (0,))
    guess = Guess("Tank", "shell", 0.2)
    labeler = Says(None)
    labeler.labeling = Labeling((None,), ((guess,),), (None,), (0.0,))
    said = label_parts(labeler, parts, NO_CONTACTS, VOCABULARY, LabelConfig(min_confidence=0.1))
    assert (said.labels, said.guesses) == ((None,), ((guess,),))


def test_largest_labelled_mesh_wins_and_the_others_are_told():
    scene = scene_of(3)
    parts = parts_of(scene, (2, 1, 0))
    labels, told = apply_given([PIPE], [given(0, "lever"), given(1, "valve body")], scene, parts, LabelConfig())
    assert (labels[0].group, labels[0].name, labels[0].source) == ("Valve assembly", "valve body", "author")
    assert labels[0].evidence == GivenEvidence(mesh="/mesh_1")
    assert [(d.code, d.meshes) for d in told] == [("label-outvoted", ("/mesh_0",))]


def test_meshes_that_agree_are_not_outvoted():
    scene = scene_of(2)
    parts = parts_of(scene, (1, 0))
    labels, told = apply_given([None], [given(0), given(1)], scene, parts, LabelConfig())
    assert labels[0].name == "valve"
    assert told == ()


def test_unknown_mesh_is_an_error_that_names_it():
    scene = scene_of(1)
    with pytest.raises(LabelError, match="'/mesh_7' is not a mesh"):
        apply_given([None], [given(7)], scene, parts_of(scene, (0,)), LabelConfig())


def test_given_label_replaces_a_guess_only_if_it_may_overrule():
    scene = scene_of(2)
    parts = parts_of(scene, (0,), (1,))
    both = [given(0), given(1)]
    assert [label.name for label in apply_given([PIPE, None], both, scene, parts, LabelConfig())[0]] == ["valve"] * 2
    filled, _ = apply_given([PIPE, None], both, scene, parts, LabelConfig(overrule=False))
    assert filled[0] is PIPE
    assert filled[1].name == "valve"


def test_parts_without_given_labels_keep_theirs():
    scene = scene_of(2)
    guessed = [PIPE, None]
    labels, told = apply_given(guessed, [], scene, parts_of(scene, (0,), (1,)), LabelConfig())
    assert labels == (PIPE, None)
    assert told == ()
    assert guessed == [PIPE, None]
