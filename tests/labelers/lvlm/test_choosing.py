import numpy as np
import pytest

import plates
from cadgraph.labelers.lvlm.choosing import OVERCONFIDENT, choose, in_stages
from cadgraph.labelers.lvlm.question_groups import QuestionGroup, find_question_groups
from cadgraph.model.labels import Label

PARTS = plates.parts_of(plates.scene_of(4, 2))
KINDS = find_question_groups(PARTS)
NAME = sorted(OVERCONFIDENT & {"pipe"})[0]


def label(name="gasket", confidence=0.9, group="Pipe assembly", source="geometry"):
    return Label(group, name, confidence, source)


def chosen(labels, below=0.8, near=None):
    return [kind.parts[0] for kind in choose(KINDS, labels, PARTS, near or {}, plates.VOCABULARY, below)]


def test_kinds_without_a_name_are_always_asked_about():
    labels = [label()] * 8
    labels[2] = labels[3] = label(None, 0.99)
    labels[6] = labels[7] = None
    assert chosen(labels) == [6, 2]
    assert chosen(labels, below=0.0) == [6, 2]


@pytest.mark.parametrize(("confidence", "asked"), [(0.79, [0]), (0.8, [])])
def test_unsure_is_below_a_limit(confidence, asked):
    labels = [label()] * 8
    labels[0] = label(confidence=confidence)
    assert chosen(labels) == asked


@pytest.mark.parametrize(
    ("name", "source", "asked"), [(NAME, "geometry", [0]), (NAME, "lvlm", []), ("gasket", "geometry", [])]
)
def test_names_that_are_given_too_confidently_are_asked_about_sooner(name, source, asked):
    labels = [label()] * 8
    labels[0] = label(name, 0.9, source=source)
    assert chosen(labels) == asked


def test_those_first_whose_answer_mends_most():
    labels = [label()] * 8
    labels[0] = label(confidence=0.5)
    labels[2] = labels[3] = label(confidence=0.5)
    labels[4] = label(confidence=0.1)
    assert chosen(labels) == [2, 4, 0]


def test_what_the_network_hangs_on_comes_first():
    labels = [label()] * 8
    labels[0] = label("beam", 0.5, "Structural element")
    labels[2] = label("gasket", 0.5)
    near = {0: (1, 3, 4), 2: (1, 3, 4)}
    assert chosen(labels, near=near) == [2, 0]
    assert chosen(labels) == [0, 2]


def test_asking_about_all_asks_about_all():
    assert sorted(chosen([label(confidence=1.0)] * 8, below=None)) == [0, 2, 4, 6]


def test_the_ground_is_not_asked_about_where_a_labeler_knows_the_rest():
    parts = plates.parts_of(plates.scene_of(1, 1))
    parts.ground[:] = True
    kinds = [QuestionGroup((0,))]
    assert choose(kinds, [None], parts, {}, plates.VOCABULARY, 0.8) == []


def test_large_parts_are_asked_about_before_small_ones():
    large, small = in_stages(KINDS, PARTS)
    size = np.linalg.norm(PARTS.properties.obb_extents, axis=1)
    assert min(size[kind.parts[0]] for kind in large) >= max(size[kind.parts[0]] for kind in small)
    assert sorted(kind.parts[0] for kind in (*large, *small)) == [0, 2, 4, 6]
