import pytest

import cadgraph
from cadgraph.errors import LabelError
from cadplants import make_skid


@pytest.fixture(scope="module")
def scene():
    return make_skid().scene()


@pytest.fixture
def session(scene):
    return cadgraph.Session.start(scene)


def first(graph, name):
    return next(part for part in graph.parts() if part.label is not None and part.label.name == name)


def test_a_session_gives_the_graph_that_build_gives(scene, session):
    assert session.graph.to_json() == cadgraph.build(scene).to_json()
    assert session.graph is session.graph


@pytest.mark.slow
def test_a_corrected_session_gives_the_graph_of_a_build_with_the_corrections(scene, session):
    session.correct(first(session.graph, "elbow").id, "Valve assembly/valve body")
    change = session.correct(first(session.graph, "gasket").meshes[0], "gauge face", this_only=True)
    assert change.part.label.said == ("Gauge assembly", "gauge face")
    assert [part.id for part in change.changed] == [change.part.id]
    built = cadgraph.build(scene, corrections=session.corrections)
    assert session.graph.to_json() == built.to_json()


@pytest.mark.slow
def test_repeats_follow_and_are_named(session):
    elbow = first(session.graph, "elbow")
    repeats = {part.id for part in session.graph.parts() if part.shape == elbow.shape}
    change = session.correct(elbow.id, "tee")
    assert repeats <= {part.id for part in change.changed}


@pytest.mark.slow
def test_undo_and_redo_go_back_and_forth(session):
    states = [session.graph.to_json()]
    for name, label in (("elbow", "tee"), ("flange", "gasket")):
        session.correct(first(session.graph, name).id, label)
        states.append(session.graph.to_json())
    assert session.undo().changed
    assert session.graph.to_json() == states[1]
    session.undo()
    assert session.graph.to_json() == states[0]
    assert (session.can_undo, session.can_redo, session.corrections) == (False, True, ())
    session.redo()
    session.redo()
    assert session.graph.to_json() == states[2]
    with pytest.raises(ValueError, match="nothing to redo"):
        session.redo()


@pytest.mark.slow
def test_a_new_correction_forgets_what_was_undone(session):
    session.correct(first(session.graph, "elbow").id, "tee")
    session.undo()
    session.correct(first(session.graph, "flange").id, "gasket")
    assert not session.can_redo


def test_a_correction_can_be_forgotten_and_that_be_undone(session):
    before = session.graph.to_json()
    elbow = first(session.graph, "elbow").id
    session.correct(elbow, "tee")
    corrected = session.graph.to_json()
    session.forget(elbow)
    assert session.graph.to_json() == before
    session.undo()
    assert session.graph.to_json() == corrected
    with pytest.raises(ValueError, match="nobody corrected"):
        session.forget(first(session.graph, "gasket").id)


def test_what_can_not_be_corrected_changes_nothing(session):
    before = session.graph
    with pytest.raises(KeyError, match="part-99999"):
        session.correct("part-99999", "tee")
    with pytest.raises(LabelError, match="did you mean"):
        session.correct(before.parts()[0].id, "Pipe assembly/elbw")
    assert session.graph is before
    assert not session.can_undo
    with pytest.raises(ValueError, match="nothing to undo"):
        session.undo()


@pytest.mark.slow
def test_another_labeler_keeps_the_corrections(session):
    elbow = first(session.graph, "elbow")
    session.correct(elbow.id, "tee", this_only=True)
    session.relabel(None)
    labels = {part.id: part.label for part in session.graph.parts() if part.label is not None}
    assert set(labels) == {elbow.id}
    assert labels[elbow.id].source == "human"


@pytest.mark.slow
def test_the_analysis_is_known_by_scene_and_settings(scene, session):
    again = cadgraph.analyse(scene)
    assert again.digest == session.analysis.digest
    other = cadgraph.analyse(scene, cadgraph.Config().replace({"cluster.eps": 0.02}))
    assert other.digest != again.digest
    labels = cadgraph.Config().replace({"label.min_confidence": 0.9})
    assert cadgraph.analyse(scene, labels).digest == again.digest
