import numpy as np
import pytest

import plates
from cadgraph.errors import LabelError
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.lvlm.answer import Verdict
from cadgraph.labelers.lvlm.joining import Accuracy, Beliefs, read_accuracy
from cadgraph.model.labels import Guess, Label
from cadgraph.model.probabilities import Probabilities

TREE = plates.VOCABULARY
FLANGE, GASKET, PIPE = (("Pipe assembly", name) for name in ("flange", "gasket", "pipe"))
SHELL, SKIRT = ("Tank", "shell"), ("Tank", "skirt")


def begun(*rows, accuracy=None, labels=None):
    """Beliefs after a labeler's probabilities, a dict of label and share for each part."""
    classes = (FLANGE, GASKET, PIPE, SHELL, SKIRT)
    values = np.array([[row.get(pair, 0.0) for pair in classes] for row in rows])
    said = Labeling.judge(labels or [None] * len(rows), probabilities=Probabilities(classes, values))
    return Beliefs(TREE, said, len(rows), accuracy or Accuracy())


def said(beliefs, part=0, least=0.5):
    found = beliefs.label_of(part, least)
    return found.said, found.confidence


def test_without_a_labeler_an_answer_is_believed_as_often_as_the_model_is_right():
    beliefs = Beliefs(TREE, None, 1, Accuracy(0.9, 0.95))
    beliefs.believe([0], [Verdict(*SHELL, 0.85)])
    label, confidence = said(beliefs)
    assert label == SHELL
    assert confidence == pytest.approx(0.9, abs=0.01)


def test_the_right_group_without_a_name_takes_the_name_of_the_answer():
    label = Label("Tank", None, 0.7, "geometry")
    beliefs = Beliefs(TREE, Labeling.judge([label]), 1, Accuracy())
    beliefs.believe([0], [Verdict(*SHELL, 0.6)])
    assert said(beliefs)[0] == SHELL
    assert said(beliefs)[1] > 0.7


def test_an_answer_for_the_group_keeps_the_labelers_name():
    beliefs = begun({SHELL: 0.5, FLANGE: 0.4})
    beliefs.believe([0], [Verdict("Tank", None, 0.9)])
    assert said(beliefs)[0] == SHELL


def test_a_sure_labeler_outweighs_an_unsure_answer_and_an_unsure_one_does_not():
    sure, unsure = begun({FLANGE: 0.97, GASKET: 0.02}), begun({FLANGE: 0.5, GASKET: 0.45})
    for beliefs in (sure, unsure):
        beliefs.believe([0], [Verdict(*SHELL, 0.3)])
    assert said(sure)[0] == FLANGE
    unsure.believe([0], [Verdict(*GASKET, 0.9)])
    assert said(unsure)[0] == GASKET


def test_agreement_is_surer_than_either():
    beliefs = begun({FLANGE: 0.8, GASKET: 0.2})
    beliefs.believe([0], [Verdict(*FLANGE, 0.85)])
    assert said(beliefs)[1] > 0.95


def test_names_that_are_often_confused_are_told_apart_by_the_labeler():
    row = {FLANGE: 0.55, GASKET: 0.2, PIPE: 0.2}
    plain, aware = begun(row), begun(row, accuracy=Accuracy(confused=(("gasket", "flange"),)))
    for beliefs in (plain, aware):
        beliefs.believe([0], [Verdict(*GASKET, 0.85)])
    flange = [beliefs.values[0, beliefs.classes.index(FLANGE)] for beliefs in (plain, aware)]
    assert flange[1] > 2 * flange[0]


def test_what_the_labeler_does_not_know_can_be_answered():
    rare = ("Equipment", "boiler")
    beliefs = begun({FLANGE: 0.3, GASKET: 0.2})
    beliefs.believe([0], [Verdict(*rare, 0.9)])
    assert said(beliefs)[0] == rare


def test_several_answers_count_for_less_than_as_many_of_different_shapes():
    one, three = begun({FLANGE: 0.6, GASKET: 0.4}), begun({FLANGE: 0.6, GASKET: 0.4})
    one.believe([0], [Verdict(*GASKET, 0.7)])
    three.believe([0], [Verdict(*GASKET, 0.7)] * 3)
    each = begun({FLANGE: 0.6, GASKET: 0.4})
    for _ in range(3):
        each.believe([0], [Verdict(*GASKET, 0.7)])
    confidence = [said(beliefs)[1] for beliefs in (one, three, each)]
    assert confidence[0] < confidence[1] < confidence[2]


def test_answers_that_agree_on_the_group_only_leave_the_name_open():
    beliefs = Beliefs(TREE, None, 1, Accuracy())
    names = ("shell", "skirt", "saddle", "manway")
    beliefs.believe([0], [Verdict("Tank", name, 0.8) for name in names])
    assert said(beliefs)[0] == ("Tank", None)


def test_answers_without_a_group_say_nothing():
    beliefs = begun({FLANGE: 0.6, GASKET: 0.4})
    before = beliefs.values.copy()
    beliefs.believe([0], [Verdict(None, None, 0.0)])
    assert np.array_equal(before, beliefs.values)


def test_a_labeler_without_probabilities_is_believed_by_its_label_and_guesses():
    guesses = (Guess(*FLANGE, 0.6), Guess(*GASKET, 0.3))
    beliefs = Beliefs(TREE, Labeling.judge([Label(*FLANGE, 0.6, "mine", guesses=guesses)]), 1, Accuracy())
    assert said(beliefs)[0] == FLANGE
    assert beliefs.values[0, beliefs.classes.index(GASKET)] == pytest.approx(0.3, abs=0.03)


def test_each_row_is_a_distribution():
    beliefs = begun({FLANGE: 0.6}, {}, {SHELL: 1.0, SKIRT: 0.5})
    beliefs.believe([0, 1], [Verdict(*PIPE, 0.4)])
    assert beliefs.values.sum(axis=1) == pytest.approx([1, 1, 1])
    assert beliefs.probabilities().values.sum(axis=1) == pytest.approx([1, 1, 1])


def test_the_entry_of_the_longest_name_counts(tmp_path):
    file = tmp_path / "mine.yaml"
    file.write_text(
        "default: {name: 0.5, group: 0.6}\nqwen: {name: 0.7, group: 0.8}\n"
        "qwen2: {name: 0.8, group: 0.9, groups: {Tank: {name: 0.95, group: 0.97}}}\nconfused: [[a, b]]\n"
    )
    assert read_accuracy("gpt", file).entry == "default"
    assert read_accuracy("qwen-vl", file).name == 0.7
    mine = read_accuracy("qwen2.5vl:7b", file)
    assert (mine.entry, mine.of("Tank"), mine.of("Gauge assembly")) == ("qwen2", (0.95, 0.97), (0.8, 0.9))
    assert mine.confused == (("a", "b"),)


def test_the_papers_pictures_have_an_entry_of_their_own():
    assert read_accuracy("gpt-4o", paper=True).name == 0.38
    assert read_accuracy("gpt-4o").name > 0.8


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[1, 2]", "no entry 'default'"),
        ("default: {name: 2, group: 0.5}", "default.name"),
        ("default: {name: 0.5, group: 0.5, other: 1}", "default.other"),
        ("default: {name: 0.5, group: 0.5}\nconfused: 3", "pairs"),
        ("a: [", "not YAML"),
    ],
)
def test_a_table_that_cannot_be_used_is_told(tmp_path, text, words):
    file = tmp_path / "mine.yaml"
    file.write_text(text)
    with pytest.raises(LabelError, match=words):
        read_accuracy("gpt-4o", file)
