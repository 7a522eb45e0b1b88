from dataclasses import replace

import numpy as np
import pytest

import cadgraph
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import Joint
from cadgraph.session.requests import read_requests
from cadgraph.session.review.network import network_questions
from cadgraph.session.review.queue import review_queue
from cadgraph.session.review.state import ReviewState
from cadplants import make_riser

WRONG = ("Valve assembly", "valve body")


@pytest.fixture(scope="module")
def scene():
    return make_riser().scene()


@pytest.fixture(scope="module")
def begun(scene):
    return cadgraph.Session.start(scene)


@pytest.fixture
def session(begun):
    yield begun
    while begun.can_undo:
        begun.undo()


def about_labels(session, **more):
    return [question for question in review_queue(session, **more) if question.id.startswith("label:")]


def named(session, ids):
    return {part: session.graph.part(part).label and session.graph.part(part).label.said for part in ids}


def other_answer(session, question):
    """An option that changes all parts of a question."""
    now = set(named(session, (*question.parts, *question.alike)).values())
    return next(o for o in question.options if (o.edits[0]["group"], o.edits[0]["name"]) not in now)


def test_the_queue_is_in_the_order_of_gain_and_the_same_every_time(session):
    queue = review_queue(session)
    assert queue == review_queue(session)
    gains = [question.gain for question in queue]
    assert gains == sorted(gains, reverse=True)
    assert min(gains) > 0
    assert review_queue(session, limit=3) == queue[:3]
    assert review_queue(session, limit=0) == ()
    with pytest.raises(ValueError, match="limit"):
        review_queue(session, limit=-1)


def test_no_part_is_asked_about_twice_and_edits_are_what_a_session_takes(session):
    queue = about_labels(session, limit=1000)
    asked = [part for question in queue for part in (*question.parts, *question.alike)]
    assert len(asked) == len(set(asked))
    for question in queue:
        assert 1 <= len(question.options) <= 5
        for option in question.options:
            assert [edit["part"] for edit in option.edits] == [*question.parts, *question.alike]
            read_requests(option.edits)
        label = session.graph.part(question.parts[0]).label
        said = [(option.edits[0]["group"], option.edits[0]["name"]) for option in question.options]
        assert label is None or label.said in said


def test_an_answer_changes_the_parts_that_it_names_and_no_other(session):
    question = max(about_labels(session), key=lambda one: len(one.alike))
    assert question.alike
    before = named(session, [part.id for part in session.graph.parts()])
    by_lines = {part.id for part in session.graph.parts() if part.label is not None and part.label.source == "network"}
    option = other_answer(session, question)
    session.apply(option.edits)
    now = named(session, before)
    settled = {*question.parts, *question.alike}
    by_hand = {p.id for p in session.graph.parts() if p.label is not None and p.label.source == "human"}
    assert by_hand == settled
    # What the lines say of other parts may follow from an answer; what anybody else says of them does not.
    by_lines |= {p.id for p in session.graph.parts() if p.label is not None and p.label.source == "network"}
    assert {part for part in before if before[part] != now[part]} - settled <= by_lines


def test_what_was_answered_or_confirmed_is_not_asked_again_and_other_ids_stay(session):
    first, second, *rest = about_labels(session)
    session.apply(first.options[0].edits)
    label = session.graph.part(second.parts[0]).label
    kept = next(o for o in second.options if label is None or (o.edits[0]["group"], o.edits[0]["name"]) == label.said)
    session.apply(kept.edits)
    after = about_labels(session, limit=1000)
    settled = {*first.parts, *first.alike, *second.parts, *second.alike}
    assert not settled & {part for question in after for part in (*question.parts, *question.alike)}
    ids = {question.id for question in after}
    assert sum(question.id in ids for question in rest) >= 0.8 * len(rest)


def test_a_skipped_question_does_not_come_again_under_another_name(session):
    first = about_labels(session)[0]
    after = about_labels(session, limit=1000, skipped=[first.id])
    assert first.id not in {question.id for question in after}
    assert first.parts[0] not in {part for question in after for part in (*question.parts, *question.alike)}
    assert len(after) == len(about_labels(session, limit=1000)) - 1


class Mistaken:
    """The embedded labeler's answers in another's name, one of them wrong and stated as nearly certain."""

    def label(self, parts, contacts, vocabulary):
        own = EmbeddedLabeler().label(parts, contacts, vocabulary)
        said = [None if one is None else Label(*one.said, 0.97, "somebody") for one in own.labels]
        sure = [one.confidence if one is not None and one.name == "flange" else 0.0 for one in own.labels]
        said[int(np.argmax(sure))] = Label(*WRONG, 0.99, "somebody")
        return Labeling.judge(said)


def test_a_sure_label_that_is_wrong_is_asked_about_first_and_said_to_be_a_contradiction(scene):
    session = cadgraph.Session.start(scene, labeler=Mistaken())
    found = [question for question in about_labels(session) if question.kind == "contradiction"]
    wrong = next(p.id for p in session.graph.parts() if p.label is not None and p.label.confidence == 0.99)
    question = next(one for one in found[:3] if wrong in one.parts)
    assert question.options[0].text == "flange (Pipe assembly)"
    assert question.title == "Is this a valve body, or a flange?"
    assert "called valve body by somebody (99%)" in question.why
    assert "flange" in question.why.split(";")[1]
    session.apply(question.options[0].edits)
    assert session.graph.part(wrong).label.said == ("Pipe assembly", "flange")


def test_a_unit_short_of_a_line_is_asked_about_until_it_is_said_to_be_right(scene, session, monkeypatch):
    # Whatever the doubt in its label, which comes first.
    monkeypatch.setattr("cadgraph.session.review.network._IN_QUEUE", 2.0)
    valve = session.graph.units("valve")[0]
    via = session.graph.connections(valve)[0].via
    gone = {mesh for part in via for mesh in session.graph.part(part).meshes}
    less = cadgraph.Session.start(scene.select([k for k, path in enumerate(scene.paths) if path not in gone]))
    [question] = [one for one in review_queue(less, 1000) if one.kind == "ports"]
    assert question.title == "Where do the lines of V-001 lead?"
    assert question.why == "V-001 (valve) has one line and needs two ports"
    assert set(question.parts) == set(less.graph.unit("V-001").parts)
    less.apply(next(option for option in question.options if option.text.startswith("it is right")).edits)
    assert not [one for one in review_queue(less, 1000) if one.kind == "ports"]


def with_network(session, joints=(), diagnostics=()):
    """The state of a session with these joints and diagnostics in its graph."""
    document = session.graph.document.model_copy(update={"joints": joints, "diagnostics": diagnostics})
    return replace(ReviewState.of(session), graph=SceneGraph(document))


def test_likely_joints_are_asked_about_once_for_two_parts_until_a_user_has_said(session):
    a, b, c = (part.id for part in session.graph.parts()[:3])
    joints = [
        Joint(first=a, second=b, kind="face", point=(0, 0, 0), gap=0.004, score=0.4, made=False),
        Joint(first=b, second=a, kind="face", point=(0, 0, 0), gap=0.004, score=0.3, made=False),
        Joint(first=a, second=c, kind="face", point=(0, 0, 0), gap=0.004, score=0.01, made=False),
        Joint(first=b, second=c, kind="face", point=(0, 0, 0), gap=0.0, score=0.9, made=True),
    ]
    state = with_network(session, tuple(joints))
    [question] = network_questions(state)
    assert (question.kind, question.parts) == ("joint", (a, b))
    assert [option.edits[0] for option in question.options] == [
        {"kind": "cut", "first": a, "second": b},
        {"kind": "join", "first": a, "second": b},
    ]
    assert [option.confidence for option in question.options] == [0.6, 0.4]
    meshes = tuple(session.graph.part(part).meshes[0] for part in (b, a))
    assert network_questions(replace(state, settled_pairs=(meshes,))) == []


def test_an_end_before_a_part_is_asked_about_where_no_label_is_in_doubt(session):
    state = ReviewState.of(session)
    sure = np.argsort(state.suspicion.wrong + state.suspicion.wrong.max() * np.array([p.ground for p in state.nodes]))
    a, b = (state.nodes[int(part)] for part in sure[:2])
    told = Diagnostic("end-before-part", "it ends 3 mm before that: correct a label there", (a.meshes[0], b.meshes[0]))
    [question] = network_questions(with_network(session, diagnostics=(told,)))
    assert (question.kind, question.parts) == ("contradiction", (a.id, b.id))
    assert question.why == "it ends 3 mm before that"
    assert [option.edits[0]["kind"] for option in question.options][:2] == ["join", "cut"]
