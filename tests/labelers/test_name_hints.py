import numpy as np
import pytest

import shapes
from cadgraph.config import LabelConfig
from cadgraph.labelers.base import Labeling, label_parts
from cadgraph.labelers.coverage import find_unlearnt
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.name_hints import weigh_names, words_of
from cadgraph.model.labels import Guess, Label
from cadgraph.model.parts import Contacts
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Group, Vocabulary, default_vocabulary
from plates import parts_of

NO_CONTACTS = Contacts(np.zeros((0, 2), np.int64), np.zeros(0), np.zeros((0, 2, 3)))
VOCABULARY = default_vocabulary()


def unsure(confidence, lever=0.3):
    guesses = (Guess("Pipe assembly", "pipe", confidence), Guess("Valve assembly", "lever", lever))
    return Label("Pipe assembly", "pipe", confidence, "geometry", {"why": "bar"}, guesses)


def weighed(answer, path):
    return weigh_names([answer], parts_of(Scene.from_meshes([shapes.box()], [path])), VOCABULARY)[0]


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("/plant/GateValve_012/hand-wheel", ("gate", "valve", "hand", "wheel")),
        ("/a/b/PUMP_casing2", ("b", "pump", "casing")),
        ("/", ()),
        ("/123/_4", ()),
    ],
)
def test_words_come_from_the_last_segments(path, words):
    assert words_of(path) == words


def test_a_name_raises_what_is_possible_and_is_kept_as_evidence():
    label = weighed(unsure(0.4), "/line/Lever_3")
    assert (label.group, label.name) == ("Valve assembly", "lever")
    assert label.confidence == pytest.approx(6 * 0.3 / 0.7 / (1 + 6 * 0.3 / 0.7))
    assert label.source == "file"
    assert (label.evidence.key, label.evidence.text) == ("name", "lever")
    assert (label.evidence.before.name, label.evidence.before.source) == ("pipe", "geometry")
    assert sum(g.confidence for g in label.guesses) <= 1.0


def test_a_name_that_agrees_makes_surer():
    label = weighed(unsure(0.4), "/line/pipe_3")
    assert (label.name, label.source) == ("pipe", "geometry")
    assert label.confidence > 0.4
    assert label.evidence.to_json() == {
        "why": "bar",
        "name": {"word": "pipe", "speaks_for": "pipe", "without": 0.4},
    }


def test_synonyms_and_plurals_count():
    assert weighed(unsure(0.4), "/handle_2").name == "lever"
    assert weighed(unsure(0.4), "/levers").name == "lever"


@pytest.mark.parametrize("path", ["/plant/Geo_17", "/plant/impeller", "/lever/a/b"])
def test_names_that_say_nothing_possible_change_nothing(path):
    answer = unsure(0.4)
    assert weighed(answer, path) is answer


@pytest.mark.parametrize(("lever", "heard"), [(0.05, True), (0.0499, False)])
def test_a_name_alone_makes_no_label(lever, heard):
    label = weighed(unsure(0.6, lever), "/lever")
    assert ("name" in label.evidence.to_json()) is heard
    assert label.name == "pipe"


def test_names_are_not_looked_at_unless_asked_for():
    parts = parts_of(Scene.from_meshes([shapes.box()], ["/lever"]))

    class Says:
        def label(self, parts, contacts, vocabulary):
            return Labeling.judge([unsure(0.5, 0.45)])

    plain = label_parts(Says(), parts, NO_CONTACTS, VOCABULARY, LabelConfig())
    named = label_parts(Says(), parts, NO_CONTACTS, VOCABULARY, LabelConfig(use_names=True))
    assert plain.labels[0].name == "pipe"
    assert named.labels[0].name == "lever"


def test_names_that_the_model_has_not_learnt_are_told():
    mine = Vocabulary({"Pipe assembly": Group(("pipe", "warp coil")), "Tank": Group(("tank",))})
    (told,) = find_unlearnt(EmbeddedLabeler().learnt, mine)
    assert told.code == "vocabulary-unknown-to-model"
    assert "Pipe assembly/warp coil" in told.message
    assert "Pipe assembly/pipe" not in told.message


def test_nothing_is_told_of_the_built_in_vocabulary():
    assert find_unlearnt(EmbeddedLabeler().learnt, VOCABULARY) == ()
