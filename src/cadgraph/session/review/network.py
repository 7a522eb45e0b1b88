"""Questions about the network: joints not made, units short of a line, gaps in lines."""

from __future__ import annotations

from collections.abc import Iterator

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.records import Joint, Unit
from cadgraph.query.doubt import likely_joints
from cadgraph.query.told_joint import say_joint, tell_joint
from cadgraph.session.review.question import MOST_OPTIONS, Option, Question, label_edits
from cadgraph.session.review.state import ReviewState

__all__ = ["network_questions"]

# What an answer is worth beside one about a label that is surely wrong (1): a joint by how likely it is, a unit that is
# short of a line or a gap in a line as a label that is wrong with even odds.
_JOINT, _SHORT, _GAP = 1.5, 0.5, 0.4
_MOST_JOINS = 3
_IN_QUEUE = 0.1  # doubt from which on a label is asked about first, which may settle the unit's lines, too


def network_questions(state: ReviewState) -> list[Question]:
    """All questions about the network, in no order.

    Args:
        state: the graph as it is now.
    """
    joints = list(_joints(state))
    asked = {frozenset(question.parts) for question in joints}
    shorts = list(_ports(state))
    return [
        *joints,
        *shorts,
        *(gap for gap in _gaps(state) if frozenset(gap.parts) not in asked),
    ]


def _pair(kind: str, first: str, second: str) -> Option:
    text = "they join" if kind == "join" else "they do not join"
    return Option(text, None, ({"kind": kind, "first": first, "second": second},))


def _joints(state: ReviewState) -> Iterator[Question]:
    """Joints that were not made although they are likely; of those between two parts the likeliest."""
    seen: set[frozenset[str]] = set()
    for joint in likely_joints(state.network):
        pair = frozenset((joint.first, joint.second))
        if pair in seen or _is_settled(state, joint.first, joint.second):
            continue
        seen.add(pair)
        options = [_sure(_pair("join", joint.first, joint.second), joint.score)]
        options.append(_sure(_pair("cut", joint.first, joint.second), 1 - joint.score))
        yield Question(
            id=f"joint:{_meshes(state, joint.first, joint.second)}",
            kind="joint",
            title="Do these two join?",
            why=say_joint(tell_joint(state.network, joint, (joint.first,))),
            parts=(joint.first, joint.second),
            alike=(),
            gain=round(_JOINT * joint.score, 6),
            options=tuple(sorted(options, key=lambda option: -(option.confidence or 0.0))),
        )


def _sure(option: Option, confidence: float) -> Option:
    return Option(option.text, round(confidence, 4), option.edits)


def _meshes(state: ReviewState, first: str, second: str) -> str:
    return " + ".join(sorted(state.nodes[state.rank[part]].meshes[0] for part in (first, second)))


def _is_settled(state: ReviewState, first: str, second: str) -> bool:
    """Whether a user has said whether two parts join."""
    meshes = [frozenset(state.nodes[state.rank[part]].meshes) for part in (first, second)]
    return any(
        (a in meshes[0] and b in meshes[1]) or (a in meshes[1] and b in meshes[0]) for a, b in state.settled_pairs
    )


def _ports(state: ReviewState) -> Iterator[Question]:
    """Units with fewer lines than their kind needs, unless one of their labels is asked about anyway."""
    for told in _of_code(state, "unit-short-of-lines"):
        unit = next((unit for mesh in told.meshes if (unit := state.unit_at(mesh)) is not None), None)
        if unit is None:
            continue
        main = _main_part(state, unit)
        label = state.nodes[main].label
        if _is_doubted(state, unit):
            continue
        joins = [
            _sure(_pair("join", joint.first, joint.second), joint.score)
            for joint in _open_joints(state, unit)
            if not _is_settled(state, joint.first, joint.second)
        ][:_MOST_JOINS]
        if not joins and label is not None and label.source == "human":
            # Whoever says that it is what it is called sees nothing to be joined to it.
            continue
        named = [Option(f"it joins {_other(state, unit, one)}", one.confidence, one.edits) for one in joins]
        if joins:
            cuts = tuple({**one.edits[0], "kind": "cut"} for one in joins)
            named.append(Option("it joins none of these", None, cuts))
        yield Question(
            id=f"ports:{state.nodes[main].meshes[0]}",
            kind="ports",
            title=f"Where do the lines of {unit.tag} lead?",
            why=told.message.partition(": correct a label")[0],
            parts=unit.parts,
            alike=(),
            gain=_SHORT,
            options=(*named, *_label_options(state, main, MOST_OPTIONS - len(named))),
        )


def _of_code(state: ReviewState, *codes: str) -> Iterator[Diagnostic]:
    return (one for one in state.graph.diagnostics if one.code in codes)


def _main_part(state: ReviewState, unit: Unit) -> int:
    """The number of the largest part of a unit."""
    return max((state.rank[part] for part in unit.parts), key=lambda part: (state.nodes[part].area, -part))


def _is_doubted(state: ReviewState, unit: Unit) -> bool:
    return any(state.suspicion.wrong[state.rank[part]] >= _IN_QUEUE for part in unit.parts)


def _open_joints(state: ReviewState, unit: Unit) -> list[Joint]:
    """Joints at a unit that were not made, the likeliest first, one for each pair of parts."""
    own = set(unit.parts)
    found: dict[frozenset[str], Joint] = {}
    for joint in sorted(state.network.open_joints, key=lambda joint: (-joint.score, joint.first, joint.second)):
        if (joint.first in own) != (joint.second in own):
            found.setdefault(frozenset((joint.first, joint.second)), joint)
    return list(found.values())


def _other(state: ReviewState, unit: Unit, option: Option) -> str:
    """What a unit would be joined to: tag and label of that."""
    edit = option.edits[0]
    part = edit["second"] if edit["first"] in unit.parts else edit["first"]
    node = state.nodes[state.rank[part]]
    what = node.label.name or node.label.group if node.label is not None else "part"
    owner = state.network.owner_of_part(part)
    return f"the {what}{f' of {state.network.name(owner)}' if owner is not None else ''}"


def _label_options(state: ReviewState, part: int, most: int) -> tuple[Option, ...]:
    """That a part is what it is called, then what else it may be."""
    node = state.nodes[part]
    others = [
        guess
        for guess in state.suspicion.guesses(part, most + 1)
        if node.label is None or guess.said != node.label.said
    ]
    options = []
    if node.label is not None:
        what = node.label.name or node.label.group
        options.append(Option(f"it is right: {what}", None, label_edits((node.id,), *node.label.said)))
    options += [
        Option(
            f"it is {guess.name} ({guess.group})", guess.confidence, label_edits((node.id,), guess.group, guess.name)
        )
        for guess in others
    ]
    return tuple(options[:most])


def _gaps(state: ReviewState) -> Iterator[Question]:
    """Ends that stop before something, and units that touch, without being joined."""
    for told in _of_code(state, "end-before-part", "units-touch-unjoined"):
        numbers = [state.number[mesh] for mesh in told.meshes if mesh in state.number]
        if len(numbers) != 2 or max(state.suspicion.wrong[numbers]) >= _IN_QUEUE:
            continue
        first, second = (state.nodes[part].id for part in numbers)
        if _is_settled(state, first, second):
            continue
        doubtful = max(numbers, key=lambda part: (state.suspicion.wrong[part], -part))
        relabel = [option for option in _label_options(state, doubtful, 3) if option.confidence is not None]
        yield Question(
            id=f"contradiction:{_meshes(state, first, second)}",
            kind="contradiction",
            title="Do these two join?",
            why=told.message.partition(": correct a label")[0],
            parts=(first, second),
            alike=(),
            gain=_GAP,
            options=(_pair("join", first, second), _pair("cut", first, second), *relabel),
        )
