"""The review queue: what is most worth a look first.

A question is worth the doubt in it, times how much the answer settles, times what hangs on it. Doubt is that of all
witnesses together (``labelers.suspicion``), so that a label that is sure but wrong is asked about, too.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal

from cadgraph.model.records import Part
from cadgraph.model.vocabulary import spell_label
from cadgraph.session.review.labels import Batch, find_batches
from cadgraph.session.review.network import network_questions
from cadgraph.session.review.question import MOST_OPTIONS, Option, Question, label_edits
from cadgraph.session.review.state import ReviewState
from cadgraph.session.session import Session

__all__ = ["review_queue"]

# A sure label that is rather wrong than right contradicts what else is known.
_CONTRADICTS = 0.5
_MOSTLY = 0.6  # share of kin from which on these mostly have a name
_ALSO = 0.05  # least probability of a name that is told beside the likeliest one


def review_queue(session: Session, limit: int = 50, skipped: Collection[str] = ()) -> tuple[Question, ...]:
    """What is to be asked about a graph, the most worth first.

    Nothing is asked about a part that a user has labelled, be it with the label that it had.

    Args:
        session: with the graph; it stays as it is.
        limit: how many questions at most.
        skipped: ids of questions that nobody wants to see again for now.

    Raises:
        ValueError: ``limit`` is negative.
    """
    if limit < 0:
        raise ValueError(f"limit must be 0 or more, not {limit}")
    state = ReviewState.of(session)
    batches = find_batches(
        state.nodes, session.analysis.parts, state.suspicion, state.stakes, _skipped_parts(state, skipped)
    )
    found = [question for question in network_questions(state) if question.id not in skipped]
    # Only what can come to stand in the queue is put into words.
    found += [_ask(state, batch) for batch in batches[:limit]]
    found.sort(key=lambda question: (-question.gain, question.id))
    return tuple(found[:limit])


def _skipped_parts(state: ReviewState, skipped: Collection[str]) -> frozenset[int]:
    """The parts that skipped questions about labels are named after."""
    meshes = (one.partition(":")[2] for one in skipped if one.startswith("label:"))
    return frozenset(state.number[mesh] for mesh in meshes if mesh in state.number)


def _ask(state: ReviewState, batch: Batch) -> Question:
    leader = state.nodes[batch.leader]
    others = tuple(state.nodes[part].id for part in batch.others)
    return Question(
        id=f"label:{leader.meshes[0]}",
        kind=_kind(state, batch.leader),
        title=_title(state, batch.leader),
        why=_why(state, batch),
        parts=(leader.id,),
        alike=others,
        gain=round(batch.gain, 6),
        options=_options(state, batch.leader, (leader.id, *others)),
    )


def _kind(state: ReviewState, part: int) -> Literal["label", "contradiction", "kind"]:
    if part in state.deciding_kind:
        return "kind"
    label = state.nodes[part].label
    doubted = label is not None and not label.likely and label.name is not None
    return "contradiction" if doubted and state.suspicion.wrong[part] >= _CONTRADICTS else "label"


def _options(state: ReviewState, part: int, members: tuple[str, ...]) -> tuple[Option, ...]:
    """The likeliest names; the label that it has is always among them."""
    said: list[tuple[tuple[str, str | None], float | None]]
    said = [(guess.said, guess.confidence) for guess in state.suspicion.guesses(part, MOST_OPTIONS)]
    label = state.nodes[part].label
    if label is not None and label.said not in [one for one, _ in said]:
        sure = state.suspicion.share(state.suspicion.values, part, label.said) if label.name is not None else None
        said = [*said[: MOST_OPTIONS - 1], (label.said, sure)]
    return tuple(
        Option(say_label(group, name), confidence, label_edits(members, group, name))
        for (group, name), confidence in said
    )


def say_label(group: str, name: str | None) -> str:
    """A label on a button."""
    return f"{name} ({group})" if name is not None else f"{group}, no name"


def _title(state: ReviewState, part: int) -> str:
    label, best = state.nodes[part].label, state.suspicion.guesses(part, 1)
    if label is None:
        return "What is this?"
    if label.name is None:
        return f"What is this? Only its group is known: {label.group}"
    if best and best[0].said != label.said and best[0].name is not None:
        return f"Is this {_article(label.name)}, or {_article(best[0].name)}?"
    return f"Is this {_article(label.name)}?"


def _article(noun: str) -> str:
    return f"{'an' if noun[:1] in 'aeiou' else 'a'} {noun}"


def _why(state: ReviewState, batch: Batch) -> str:
    told = [_now(state.nodes[batch.leader]), _seen(state, batch.leader)]
    told += [words for words in (_kin(state, batch.leader), _repeats(state, batch.leader)) if words]
    if batch.leader in state.contradicted:
        told.append("the lines do not add up here")
    tags = dict.fromkeys(state.unit_of[part].tag for group in batch.groups for part in group if part in state.unit_of)
    if tags:
        shown = ", ".join(list(tags)[:3])
        told.append(f"it belongs to {shown}{f' and {len(tags) - 3} more' if len(tags) > 3 else ''}")
    if batch.leader in state.deciding_kind:
        unit = state.unit_of[batch.leader]
        guesses = " or ".join(f"{kind} ({sure:.0%})" for kind, sure in unit.kind_guesses)
        told.append(f"the kind of {unit.tag} is open: {guesses}; what turns it tells")
    if len(batch.groups) > 1:
        told.append(f"{1 + len(batch.others)} parts of {len(batch.groups)} shapes that look alike")
    return "; ".join(told)


def _now(node: Part) -> str:
    label = node.label
    if label is None:
        return "nobody is sure what it is"
    named = f"called {label.name}" if label.name is not None else f"only said to be of {label.group}"
    by = {
        "geometry": "by the embedded labeler",
        "network": "by the lines",
        "file": "by the file",
        "author": "by labels from outside",
        "catalog": "by the catalogue",
        "repeat": "as a corrected part",
    }.get(label.source, f"by {label.source}")
    return f"{named} {by} ({label.confidence:.0%})"


def _seen(state: ReviewState, part: int) -> str:
    """What shape and surroundings speak for."""
    row = state.suspicion.opinion[part]
    order = sorted(range(len(row)), key=lambda k: (-row[k], k))[:2]
    named = [f"{state.suspicion.classes[k][1]} ({row[k]:.0%})" for k in order if k == order[0] or row[k] >= _ALSO]
    return f"shape and surroundings speak for {' or '.join(named)}"


def _kin(state: ReviewState, part: int) -> str:
    """What much alike parts are called, where that is something else."""
    row, label = state.suspicion.kin[part], state.nodes[part].label
    best = int(row.argmax())
    said = state.suspicion.classes[best]
    if row[best] < _MOSTLY or (label is not None and label.said == said):
        return ""
    return f"what looks much like it is mostly called {said[1]}"


def _repeats(state: ReviewState, part: int) -> str:
    """What parts of the very same shape are called, where they don't agree."""
    counts = state.repeats_of(part)
    if len(counts) < 2:
        return ""
    said = [f"{count} {spell_label(*one) if one is not None else 'without a label'}" for one, count in counts[:3]]
    return f"of its shape there are {', '.join(said)}{' and others' if len(counts) > 3 else ''}"
