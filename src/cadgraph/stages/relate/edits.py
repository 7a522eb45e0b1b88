"""What a user corrected of the network, by the numbers of parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from cadgraph.model.anchors import Anchor, Anchored
from cadgraph.model.edits import Cut, Device, Direction, Edit, Flow, Join, Merge, Split, Tag
from cadgraph.model.scene import Floats

__all__ = ["FlowEdit", "JointEdit", "NameEdit", "NetworkEdits", "UnitEdit", "Unmet", "place_edits"]

_GONE = "{} of its {} parts are not there any more"
_KNOWN = 0.5  # least share of an edit's parts that must be there

Unmet = tuple[int, str]
"""The number of an edit that can't be carried out, and why."""


@dataclass(frozen=True)
class UnitEdit:
    """Parts that are one unit, or a unit of their own.

    Args:
        number: of the edit.
        merge: whether their units become one; else they leave theirs.
        parts: that were named.
    """

    number: int
    merge: bool
    parts: tuple[int, ...]


@dataclass(frozen=True)
class JointEdit:
    """Two parts that join along the pipes, or don't.

    Args:
        number: of the edit.
        join: whether they do.
        first: one part.
        second: the other.
    """

    number: int
    join: bool
    first: int
    second: int


@dataclass(frozen=True, eq=False)
class FlowEdit:
    """Which way it flows through a connection.

    Args:
        number: of the edit.
        source: parts of what it leaves.
        target: parts of what it leads to.
        via: parts between, in order.
        ends: ``(2, 3)`` where it begins and ends, relative to the scene's origin [m].
        flow: ``forward`` from source to target; ``unknown`` takes what was said before back.
    """

    number: int
    source: frozenset[int]
    target: frozenset[int]
    via: tuple[int, ...]
    ends: Floats
    flow: Flow


@dataclass(frozen=True)
class NameEdit:
    """What a unit is called: its tag, or its kind of device.

    Args:
        number: of the edit.
        parts: of the unit.
        name: the word for it.
    """

    number: int
    parts: tuple[int, ...]
    name: str


@dataclass(frozen=True, eq=False)
class NetworkEdits:
    """All that a user corrected of the network, each kind in the order in which it was done.

    Args:
        units: merged and split.
        joints: made and cut.
        flows: directions.
        tags: of units.
        devices: what units are.
        unmet: edits whose parts aren't there.
    """

    units: tuple[UnitEdit, ...] = ()
    joints: tuple[JointEdit, ...] = ()
    flows: tuple[FlowEdit, ...] = ()
    tags: tuple[NameEdit, ...] = ()
    devices: tuple[NameEdit, ...] = ()
    unmet: tuple[Unmet, ...] = ()

    @cached_property
    def cut(self) -> frozenset[tuple[int, int]]:
        """Pairs of parts that don't join, both ways round."""
        pairs = [(edit.first, edit.second) for edit in self.joints if not edit.join]
        return frozenset([*pairs, *((b, a) for a, b in pairs)])

    @cached_property
    def joined(self) -> tuple[JointEdit, ...]:
        """The joints that are to be made."""
        return tuple(edit for edit in self.joints if edit.join)


@dataclass
class _Placed:
    """Edits while their parts are looked for."""

    parts: Anchored
    units: list[UnitEdit] = field(default_factory=list)
    joints: list[JointEdit] = field(default_factory=list)
    flows: list[FlowEdit] = field(default_factory=list)
    tags: list[NameEdit] = field(default_factory=list)
    devices: list[NameEdit] = field(default_factory=list)

    def place(self, number: int, edit: Edit) -> str | None:
        """Takes an edit in; returns why it can't be."""
        match edit:
            case Merge() | Split():
                return self._place_unit(number, edit)
            case Join() | Cut():
                return self._place_joint(number, edit)
            case Direction():
                return self._place_flow(number, edit)
            case Tag():
                return self._place_name(number, edit.parts, edit.tag, self.tags)
            case Device():
                return self._place_name(number, edit.parts, edit.device, self.devices)
            case _:
                return None

    def _place_name(self, number: int, parts: Sequence[Anchor], name: str, names: list[NameEdit]) -> str | None:
        found = self.parts.find_all(parts)
        names += [NameEdit(number, tuple(found), name)] if found else []
        return None if found else _GONE.format("all", len(parts))

    def _place_unit(self, number: int, edit: Merge | Split) -> str | None:
        found = self.parts.find_all(edit.parts)
        merge = isinstance(edit, Merge)
        if len(found) < max(1 + merge, _KNOWN * len(edit.parts)):
            return _GONE.format(len(edit.parts) - len(found), len(edit.parts))
        self.units.append(UnitEdit(number, merge, tuple(found)))
        return None

    def _place_joint(self, number: int, edit: Join | Cut) -> str | None:
        first, second = self.parts.find(edit.first), self.parts.find(edit.second)
        if first is None or second is None:
            return f"{(edit.first if first is None else edit.second).mesh} is not there any more, or has another shape"
        if first == second:
            return "both are one part now"
        self.joints.append(JointEdit(number, isinstance(edit, Join), first, second))
        return None

    def _place_flow(self, number: int, edit: Direction) -> str | None:
        source, target, via = (self.parts.find_all(each) for each in (edit.source, edit.target, edit.via))
        if len(via) < _KNOWN * len(edit.via) or not (source or target or via):
            return _GONE.format(len(edit.via) - len(via), len(edit.via)) if via else "nothing of it is there any more"
        ends = np.asarray(edit.ends, np.float64) - self.parts.origin
        self.flows.append(FlowEdit(number, frozenset(source), frozenset(target), tuple(via), ends, edit.flow))
        return None


def place_edits(edits: Sequence[Edit], parts: Anchored) -> NetworkEdits:
    """Finds the parts that edits of the network are about; edits of other kinds are left out.

    Args:
        edits: in force, in the order in which they were made; their places are their numbers.
        parts: of the scene.
    """
    placed = _Placed(parts)
    told = ((number, placed.place(number, edit)) for number, edit in enumerate(edits))
    unmet = tuple((number, why) for number, why in told if why is not None)
    return NetworkEdits(
        tuple(placed.units),
        tuple(placed.joints),
        tuple(placed.flows),
        tuple(placed.tags),
        tuple(placed.devices),
        unmet,
    )
