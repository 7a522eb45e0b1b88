"""What each part may be: the labeler's word by its probabilities, everybody else's for certain."""

import numpy as np
import pytest

from cadgraph.model.labels import Guess, Label
from cadgraph.model.probabilities import Probabilities
from cadgraph.stages.relate.belief import beliefs_of
from piping import PIPE, STEEL, VALVE
from sketch import VOCABULARY

LABELER = Probabilities(((PIPE, "pipe"), (VALVE, "valve"), ("Nonsense", "thing")), np.array([[0.5, 0.2, 0.3]]))


def beliefs(label, probabilities=LABELER):
    return beliefs_of([label], probabilities, VOCABULARY)


def likely(found, group, **more):
    return pytest.approx(float(found.of_groups([group], **more)[0]))


@pytest.mark.parametrize("label", [None, Label(STEEL, "beam", 0.8, "geometry")])
def test_the_labelers_probabilities_count_more_than_its_label(label):
    found = beliefs(label)
    assert (likely(found, PIPE), likely(found, VALVE), likely(found, STEEL)) == (0.5, 0.2, 0.0)
    assert found.open.tolist() == [True]
    assert found.values.sum() == pytest.approx(0.7), "what the vocabulary doesn't know is left out"


@pytest.mark.parametrize("source", ["human", "repeat", "catalog", "author", "file"])
def test_what_others_say_is_certain_and_shut(source):
    found = beliefs(Label(STEEL, "beam", 0.4, source, guesses=(Guess(VALVE, "valve", 0.6),)))
    assert (likely(found, PIPE), likely(found, VALVE), likely(found, STEEL)) == (0.0, 0.0, 1.0)
    assert found.open.tolist() == [False]


@pytest.mark.parametrize("source", ["lvlm", "context", "somebody's own"])
def test_a_model_counts_by_its_confidence_and_stays_open(source):
    found = beliefs(Label(STEEL, "beam", 0.4, source))
    assert (likely(found, PIPE), likely(found, STEEL)) == (0.0, 0.4)
    assert found.open.tolist() == [True]


def test_without_probabilities_guesses_have_to_do_and_without_these_the_label():
    guesses = (Guess(STEEL, "beam", 0.6), Guess(VALVE, None, 0.3), Guess("Nonsense", "thing", 0.1))
    found = beliefs(Label(STEEL, "beam", 0.6, "geometry", guesses=guesses), None)
    assert (likely(found, STEEL), likely(found, VALVE)) == (0.6, 0.3)
    assert likely(beliefs(Label(STEEL, "beam", 0.6, "geometry"), None), STEEL) == 0.6
    assert beliefs(None, None).values.sum() == 0.0


def test_names_can_be_left_out_of_a_sum():
    found = beliefs(Label(PIPE, "tee", 0.7, "lvlm"))
    assert (likely(found, PIPE), likely(found, PIPE, without=["tee"])) == (0.7, 0.0)


def test_a_label_outside_the_vocabulary_says_nothing():
    assert beliefs(Label("Nonsense", "thing", 1.0, "author")).values.sum() == 0.0
