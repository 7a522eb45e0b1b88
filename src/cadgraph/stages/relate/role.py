"""Which parts carry lines and which form units: the labels, and what is left of them where they are doubtful."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["USERS", "Roles", "find_roles", "likely_lines"]

USERS = frozenset({"human", "repeat", "catalog"})
"""Sources of labels that are a user's own word, which nothing overrules: corrections, the same at repeats of what was
corrected, and catalogues."""

# A second opinion counts from this confidence on.
_CONFIDENT = 0.63
# What the labeler alone says of a group counts from here on; below, what lies around the part decides.
_LIKELY = 0.57
# A label whose group it gives at least this probability stands. By Bayes' rule: where a fifth of the labels are wrong
# at random over nine groups, a label is right at even odds if the second opinion gives its group a 32nd of its own.
# Ours is below that: what the labeler gets wrong it is often sure of.
_POSSIBLE = 0.02
# Labels that disagree with what the labeler is sure of, each in its own way, are strays; above this share of the parts,
# and from this number on, labels are taken for doubtful. Ours: in plants of others true labels give up to 3 % (what
# the labeler always gets wrong is one way), 20 % at random give 15 to 20 %.
_SURE = 0.87
_STRAY_SHARE, _LEAST_STRAYS = 0.06, 3
# What happens this often at most, as share of the parts, is a way of its own.
_RARE = 0.002
# Least share of the parts of one shape that must agree to outvote a label.
_MAJORITY = 0.5


@dataclass(frozen=True)
class Roles:
    """What each part does.

    Args:
        groups: group of each part, None where unknown; its label's unless that is doubted.
        names: name of each part, likewise.
        doubted: parts whose label is not followed.
        doubtful: whether labels are wrong so often that the second opinion goes first.
        backed: parts whose group the second opinion or most of their repeats say, too.
    """

    groups: tuple[str | None, ...]
    names: tuple[str | None, ...]
    doubted: tuple[int, ...]
    doubtful: bool
    backed: frozenset[int]


def find_roles(parts: Parts, labels: Sequence[Label | None], guessed: Sequence[Label | None]) -> Roles:
    """Takes each part's label, or in a scene of doubtful labels what its shape, its repeats and geometry say.

    Args:
        parts: parts of the scene.
        labels: label of each part, None where it has none.
        guessed: label that the embedded labeler alone gives each part.
    """
    said = [_followed(label, guess) for label, guess in zip(labels, guessed, strict=True)]
    followed = [group for group, _ in said]
    majority = _majorities(parts, labels)
    doubtful = _are_doubtful(labels, guessed)
    if doubtful:
        said = [
            _weighed(label, guess, majority.get(int(parts.shape[part])))
            for part, (label, guess) in enumerate(zip(labels, guessed, strict=True))
        ]
    groups, names = tuple(group for group, _ in said), tuple(name for _, name in said)
    doubted = tuple(part for part, group in enumerate(followed) if group is not None and groups[part] != group)
    return Roles(groups, names, doubted, doubtful, _backed(parts, groups, guessed, majority))


def _said(label: Label | None) -> tuple[str | None, str | None]:
    """The group and name that a label gives."""
    return (None, None) if label is None else (label.group, label.name)


def _followed(label: Label | None, guess: Label | None) -> tuple[str | None, str | None]:
    """The group and name that a label gives, unless only the labeler says so and isn't sure enough."""
    if label is None or label is not guess:
        return _said(label)
    likely = max(_share(label, label.group), label.confidence)
    return (None, None) if likely < _LIKELY else _said(label)


def _share(guess: Label, group: str) -> float:
    """How likely the second opinion holds a group, as far as it tells."""
    return sum(one.confidence for one in guess.guesses if one.group == group)


def _weighed(
    label: Label | None, guess: Label | None, most: tuple[str, str | None] | None
) -> tuple[str | None, str | None]:
    """The group and name of a part whose label may be wrong.

    Args:
        label: what is given.
        guess: the second opinion.
        most: what most of its repeats are said to be.
    """
    said = _said(label)
    if label is not None and label.source in USERS:
        return said
    # Wrong labels at random hardly ever agree with each other; the labeler is wrong alike about all repeats.
    better = most
    if better is None and guess is not None and guess.confidence >= _CONFIDENT and not _allows(guess, label):
        better = guess.group, guess.name
    return said if better is None or better[0] == said[0] else better


def _backed(
    parts: Parts,
    groups: Sequence[str | None],
    guessed: Sequence[Label | None],
    majority: Mapping[int, tuple[str, str | None]],
) -> frozenset[int]:
    def said(part: int) -> set[str]:
        guess = guessed[part]
        return {majority.get(int(parts.shape[part]), ("", None))[0], guess.group if guess is not None else ""}

    return frozenset(part for part, group in enumerate(groups) if group is not None and group in said(part))


def _allows(guess: Label, label: Label | None) -> bool:
    """Whether the second opinion holds a label's group for possible."""
    if label is None:
        return False
    return _share(guess, label.group) >= _POSSIBLE


def _are_doubtful(labels: Sequence[Label | None], guessed: Sequence[Label | None]) -> bool:
    both = [
        (label, guess)
        for label, guess in zip(labels, guessed, strict=True)
        if label is not None and guess is not None and guess.confidence >= _SURE
    ]
    ways = Counter((a.group, a.name, b.group) for a, b in both if a.group != b.group)
    rare = max(1.0, _RARE * len(both))
    strays = sum(count for count in ways.values() if count <= rare)
    return strays >= max(_LEAST_STRAYS, _STRAY_SHARE * len(both))


def _majorities(parts: Parts, labels: Sequence[Label | None]) -> dict[int, tuple[str, str | None]]:
    """The label that at least two, and most, of the parts of a shape have."""
    votes: dict[int, Counter[tuple[str, str | None]]] = {}
    for part, label in enumerate(labels):
        if label is not None:
            votes.setdefault(int(parts.shape[part]), Counter())[label.group, label.name] += 1
    found = {}
    for shape, counts in votes.items():
        (best, n), total = counts.most_common(1)[0], sum(counts.values())
        if n >= 2 and n >= _MAJORITY * total:
            found[shape] = best
    return found


def likely_lines(
    roles: Roles, guessed: Sequence[Label | None], contacts: Contacts, vocabulary: Vocabulary, ground: Sequence[bool]
) -> list[int]:
    """Parts that are no connectors by label but may be by shape: they touch one, or a unit, and nothing speaks against.

    Args:
        roles: what each part does.
        guessed: label that the embedded labeler alone gives each part.
        contacts: pairs of parts that are near.
        vocabulary: says which groups are connectors and which form units.
        ground: whether each part is ground.
    """
    connectors, unit_of = vocabulary.connector_groups, vocabulary.unit_of_group
    functional = [group in connectors or group in unit_of for group in roles.groups]
    # Two say that it is something else: then it is.
    connecting = [_followed(guess, guess)[0] in {None, *connectors} for guess in guessed]
    possible = np.array(connecting, np.bool_) & ~np.array(functional, np.bool_) & ~np.array(ground, np.bool_)
    pairs = np.concatenate([contacts.pairs, contacts.pairs[:, ::-1]])
    near = possible[pairs[:, 0]] & np.array(functional, np.bool_)[pairs[:, 1]]
    found: list[int] = np.unique(pairs[near, 0]).tolist()
    return found
