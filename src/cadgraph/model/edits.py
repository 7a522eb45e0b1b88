"""What a user can correct: labels, units, joints, directions of flow, tags, the ground."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from cadgraph.model.anchors import Anchor, Fingerprint
from cadgraph.model.vocabulary import spell_label

__all__ = [
    "LONGEST_TAG",
    "LOST",
    "Correction",
    "Cut",
    "Device",
    "Direction",
    "Edit",
    "Forget",
    "Ground",
    "Join",
    "Merge",
    "Split",
    "Tag",
    "check_tag",
    "describe",
    "fold",
    "meshes_of",
    "tell_lost",
    "with_correction",
]

LONGEST_TAG = 64
"""Characters of a tag at most."""

LOST = "correction-lost"
"""Code of the diagnostic of a correction that no longer fits."""

Flow = Literal["forward", "backward", "unknown"]


@dataclass(frozen=True)
class Correction:
    """What one part is.

    Args:
        mesh: source path of its largest mesh.
        group: of the vocabulary.
        name: in that group, or None.
        fingerprint: of the part.
        centroid: of the part, world coordinates [m].
        this_only: whether it says nothing about others.
    """

    mesh: str
    group: str
    name: str | None
    fingerprint: Fingerprint
    centroid: tuple[float, float, float]
    this_only: bool = False

    @property
    def anchor(self) -> Anchor:
        """What the part is found again by."""
        return Anchor(self.mesh, self.fingerprint, self.centroid)


@dataclass(frozen=True)
class Forget:
    """The correction of a part's label is taken back.

    Args:
        part: the part.
    """

    part: Anchor


@dataclass(frozen=True)
class Merge:
    """The units of some parts are one unit; parts without a unit come to it.

    Args:
        parts: two at least.
    """

    parts: tuple[Anchor, ...]


@dataclass(frozen=True)
class Split:
    """Some parts of a unit are a unit of their own.

    Args:
        parts: of one unit, not all of it.
    """

    parts: tuple[Anchor, ...]


@dataclass(frozen=True)
class Join:
    """Two parts join along the pipes.

    Args:
        first: one part.
        second: the other.
    """

    first: Anchor
    second: Anchor


@dataclass(frozen=True)
class Cut:
    """Two parts don't join along the pipes.

    Args:
        first: one part.
        second: the other.
    """

    first: Anchor
    second: Anchor


@dataclass(frozen=True)
class Direction:
    """Which way it flows through a connection.

    Args:
        source: parts of the unit, junction or terminal that the connection leaves.
        target: likewise of the one that it leads to.
        via: parts between, in order.
        ends: where it begins and ends, world coordinates [m].
        flow: ``forward`` from source to target; ``unknown`` takes what was said before back.
    """

    source: tuple[Anchor, ...]
    target: tuple[Anchor, ...]
    via: tuple[Anchor, ...]
    ends: tuple[tuple[float, float, float], tuple[float, float, float]]
    flow: Flow


@dataclass(frozen=True)
class Tag:
    """What the plant calls a unit.

    Args:
        parts: of the unit, the largest ones first.
        tag: its name.
    """

    parts: tuple[Anchor, ...]
    tag: str


@dataclass(frozen=True)
class Device:
    """What kind of device a unit is.

    Args:
        parts: of the unit, the largest ones first.
        device: its kind in words, ``"check valve"``.
    """

    parts: tuple[Anchor, ...]
    device: str


@dataclass(frozen=True)
class Ground:
    """Whether a mesh is the ground, which belongs to no structure.

    Args:
        mesh: with its own shape and place, not those of the part that it is in.
        ground: whether it is.
    """

    mesh: Anchor
    ground: bool


Edit: TypeAlias = Correction | Forget | Merge | Split | Join | Cut | Direction | Tag | Device | Ground
"""One thing that a user corrected, by what it is found again in another export of the model."""


def with_correction(corrections: Sequence[Correction], new: Correction) -> tuple[Correction, ...]:
    """The corrections with a new one; an earlier one of the same mesh is replaced."""
    return (*(old for old in corrections if old.mesh != new.mesh), new)


def fold(edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """What is in force of edits: a later one takes the place of an earlier one that is about the same.

    Args:
        edits: in the order in which they were made.

    Returns:
        Those that count, in that order; none is a ``Forget``.
    """
    kept: dict[tuple[object, ...], Edit] = {}
    for number, edit in enumerate(edits):
        key = about(edit, number)
        # What replaces another one is the later one, also where the order of both counts.
        kept.pop(key, None)
        if not isinstance(edit, Forget):
            kept[key] = edit
    return tuple(kept.values())


def about(edit: Edit, number: int) -> tuple[object, ...]:
    """What an edit is about: of two with the same key the later one counts."""
    match edit:
        case Correction():
            return "label", edit.mesh
        case Forget():
            return "label", edit.part.mesh
        case Join() | Cut():
            return "joint", *sorted((edit.first.mesh, edit.second.mesh))
        case Ground():
            return "ground", edit.mesh.mesh
        case Tag():
            return "tag", *sorted(part.mesh for part in edit.parts)
        case Device():
            return "device", *sorted(part.mesh for part in edit.parts)
        case _:
            # The order of merges and splits counts; a direction is matched with its connection first.
            return "each", number


def describe(edit: Edit) -> str:
    """An edit in words, by the paths of meshes: it reads the same in every export of the model."""
    match edit:
        case Correction():
            return f"label {spell_label(edit.group, edit.name)} of {edit.mesh}"
        case Forget():
            return f"label of {edit.part.mesh} taken back"
        case Merge():
            return f"one unit of {_paths(edit.parts)}"
        case Split():
            return f"a unit of its own of {_paths(edit.parts)}"
        case Join():
            return f"joint of {edit.first.mesh} and {edit.second.mesh}"
        case Cut():
            return f"cut between {edit.first.mesh} and {edit.second.mesh}"
        case Direction():
            way = _paths(edit.via) or f"{_paths(edit.source)} to {_paths(edit.target)}"
            return f"direction taken back along {way}" if edit.flow == "unknown" else f"direction along {way}"
        case Tag():
            return f"tag {edit.tag} of the unit of {_paths(edit.parts)}"
        case Device():
            return f"{edit.device} as what the unit of {_paths(edit.parts)} is"
        case Ground():
            return f"{edit.mesh.mesh} as {'the ground' if edit.ground else 'no ground'}"


def meshes_of(edit: Edit) -> tuple[str, ...]:
    """The source paths of the meshes that an edit names."""
    match edit:
        case Correction():
            return (edit.mesh,)
        case Forget():
            return (edit.part.mesh,)
        case Merge() | Split() | Tag() | Device():
            return tuple(anchor.mesh for anchor in edit.parts)
        case Join() | Cut():
            return edit.first.mesh, edit.second.mesh
        case Direction():
            return tuple(anchor.mesh for anchor in edit.via or (*edit.source, *edit.target))
        case Ground():
            return (edit.mesh.mesh,)


def tell_lost(edit: Edit, why: str) -> str:
    """What is told of an edit that no longer fits, or can't be carried out: its words, and why."""
    return f"{describe(edit)}: {why}"


def _paths(anchors: Sequence[Anchor]) -> str:
    if len(anchors) <= 2:
        return " and ".join(anchor.mesh for anchor in anchors)
    return f"{anchors[0].mesh} and {len(anchors) - 1} others"


def check_tag(tag: str) -> str:
    """A tag as it may stand in a graph, without the blanks around it.

    Raises:
        ValueError: it is empty, too long, or holds what can't be printed.
    """
    text = tag.strip()
    if not text:
        raise ValueError("a tag needs at least one letter or digit")
    if len(text) > LONGEST_TAG:
        raise ValueError(f"tag {text[:20]!r}...: {len(text)} characters, and a tag has at most {LONGEST_TAG}")
    if not text.isprintable():
        raise ValueError(f"tag {text!r}: holds characters that can't be printed; take them out")
    return text
