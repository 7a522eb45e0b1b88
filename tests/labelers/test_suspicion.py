import numpy as np
import pytest

from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.suspicion import suspect_labels
from cadgraph.model.labels import CorrectedEvidence, Label
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import analyse
from cadplants import make_riser

TREE = default_vocabulary()
WRONG = Label("Valve assembly", "valve body", 0.99, "somebody")


@pytest.fixture(scope="module")
def analysis():
    return analyse(make_riser().scene())


@pytest.fixture(scope="module")
def labels(analysis):
    return EmbeddedLabeler().label(analysis.parts, analysis.contacts, TREE).labels


def suspected(analysis, labels, **more):
    return suspect_labels(labels, analysis.parts, analysis.contacts, TREE, **more)


def surest(labels, name):
    named = [part for part, label in enumerate(labels) if label is not None and label.name == name]
    return max(named, key=lambda part: labels[part].confidence)


def test_a_label_that_is_sure_but_wrong_is_suspected_most_and_the_right_one_comes_first(analysis, labels):
    flange = surest(labels, "flange")
    others = [None if label is None else Label(*label.said, 0.95, "somebody") for label in labels]
    others[flange] = WRONG
    found = suspected(analysis, others)
    assert found.wrong[flange] > 0.8
    assert found.guesses(flange)[0].name == "flange"
    assert found.share(found.opinion, flange, ("Valve assembly", None)) < 0.1
    assert suspected(analysis, labels).wrong[flange] < 0.1


def test_what_a_user_settled_is_not_doubted_and_speaks_for_its_kin(analysis, labels):
    part = surest(labels, "pipe")
    settled = list(labels)
    settled[part] = Label("Pipe assembly", "tee", 0.9, "human", CorrectedEvidence(mesh="/a"))
    found = suspected(analysis, settled)
    assert found.wrong[part] == 0
    tee = found.classes.index(("Pipe assembly", "tee"))
    kin = found.kin[:, tee] > suspected(analysis, labels).kin[:, tee]
    assert kin.any()
    assert np.all(found.values[kin, tee] > suspected(analysis, labels).values[kin, tee])


def test_parts_without_a_name_are_doubtful_and_the_ground_never_is(analysis, labels):
    open_label, group_only = list(labels), list(labels)
    open_label[0], group_only[0] = None, Label("Pipe assembly", None, 0.9, "geometry")
    assert suspected(analysis, open_label).wrong[0] > suspected(analysis, group_only).wrong[0] > 0.4
    assert not suspected(analysis, labels).wrong[analysis.parts.ground].any()


def test_a_label_is_more_doubtful_where_the_lines_do_not_add_up(analysis, labels):
    part = surest(labels, "pipe")
    assert suspected(analysis, labels, contradicted=[part]).wrong[part] > 2 * suspected(analysis, labels).wrong[part]


def test_probabilities_at_hand_give_what_is_worked_out_without_them(analysis, labels):
    known = EmbeddedLabeler().label(analysis.parts, analysis.contacts, TREE).probabilities
    assert np.array_equal(suspected(analysis, labels, opinions=known).values, suspected(analysis, labels).values)
