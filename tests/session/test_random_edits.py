"""Random corrections of the demo plant: whatever is done and undone, the same history gives the same graph."""

import json
import random

import pytest

import cadgraph
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.corrections import read_history, write_history
from cadgraph.session.demo import DEMO_SCENE
from cadgraph.session.session import Session

STEPS = 14


@pytest.fixture(scope="module")
def demo():
    return Session.start(cadgraph.load(DEMO_SCENE))


def fresh(demo, history):
    """A session with this history that has never been in another state."""
    return Session(demo.analysis, demo.labeling, demo.config, history=history, labeler=labeler_of(demo.config.label))


def bytes_of(session):
    return json.dumps(session.graph.to_json()).encode()


def random_edit(graph, dice):
    parts, units = graph.parts(), graph.units()
    kind = dice.choices(
        ("label", "tag", "merge", "split", "join", "cut", "direction", "ground"), (3, 4, 3, 3, 4, 4, 4, 1)
    )[0]
    if kind == "label":
        label = dice.choice(("Pipe assembly/elbow", "Valve assembly/handwheel", "Tank"))
        return {"kind": kind, "part": dice.choice(parts).id, "group": label, "this_only": dice.random() < 0.5}
    if kind == "tag":
        return {"kind": kind, "unit": dice.choice(units).tag, "tag": f"X-{dice.randrange(9)}"}
    if kind == "merge":
        one = dice.choice(units)
        other = min((u for u in units if u.id != one.id), key=lambda u: abs(u.centroid[0] - one.centroid[0]))
        return {"kind": kind, "parts": [*one.parts, *other.parts]}
    if kind == "split":
        several = [unit for unit in units if len(unit.parts) > 1]
        return {"kind": kind, "parts": [dice.choice(dice.choice(several).parts)]}
    if kind in ("cut", "join"):
        joint = dice.choice(graph.joints(made=kind == "cut") or graph.joints())
        return {"kind": kind, "first": joint.first, "second": joint.second}
    if kind == "direction":
        edge = dice.choice(graph.connections())
        flow = dice.choice(("forward", "backward", "unknown"))
        return {"kind": kind, "source": edge.source, "target": edge.target, "via": list(edge.via), "flow": flow}
    part = dice.choice([part for part in parts if part.ground] or parts)
    return {"kind": kind, "part": part.id, "ground": not part.ground}


@pytest.mark.slow
def test_random_corrections_and_undos_lead_back_to_the_same_bytes(demo, tmp_path):
    dice = random.Random(2)
    session = fresh(demo, None)
    states = {(): bytes_of(session)}
    done = set()
    for _ in range(STEPS):
        step = dice.choices(("do", "undo", "redo"), (6, 2, 1))[0]
        before = bytes_of(session), session.history
        try:
            if step == "do":
                edit = random_edit(session.graph, dice)
                session.apply([edit])
                done.add(edit["kind"])
            else:
                getattr(session, step)()
        except ValueError:
            assert (bytes_of(session), session.history) == before
        key = tuple(session.history.in_force)
        assert states.setdefault(key, bytes_of(session)) == bytes_of(session)
    assert len(done) >= 5
    file = write_history(session.history, tmp_path / "corrections.json")
    again = fresh(demo, read_history(file, demo.vocabulary))
    assert bytes_of(again) == bytes_of(session)
    while session.can_undo:
        session.undo()
    assert bytes_of(session) == states[()]
