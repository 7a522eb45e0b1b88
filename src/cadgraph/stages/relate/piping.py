"""What relating starts from, and the piping as far as it is known."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from cadgraph.config import Config
from cadgraph.facts.statements import Statements
from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.analysis import Analysis
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Joint, Parts
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Ints
from cadgraph.model.stated import resolve_links
from cadgraph.model.vocabulary import FASTENERS, Vocabulary
from cadgraph.stages.relate.attach import Attachments, attach_lines
from cadgraph.stages.relate.edit_joints import edit_joints
from cadgraph.stages.relate.edits import NetworkEdits
from cadgraph.stages.relate.role import Roles
from cadgraph.stages.relate.stated import Stated

__all__ = ["Group", "Piping", "Recovered", "RelateInput"]

_HOLDS = FASTENERS | {"clamp", "gasket"}  # what lies between two things without being either
_MOST_HELD = 6  # lines at one fastener: two flanges, their gaskets, pipes; more are a set of bolts in one mesh


@dataclass(frozen=True, eq=False)
class RelateInput:
    """Everything that functional relations are found from.

    Args:
        analysis: what geometry says: parts, contacts, structures.
        labels: label of each part, None where it has none.
        opinions: label that the embedded labeler alone gives each part, None where it gives none; a second opinion.
        vocabulary: label tree, with the groups that are connectors and those that form units.
        config: settings.
        probabilities: what the labeler holds for possible, where it knows.
        statements: what the file says of parts and units, where that counts.
        edits: what a user corrected of the network.
    """

    analysis: Analysis
    labels: Sequence[Label | None]
    opinions: Sequence[Label | None]
    vocabulary: Vocabulary
    config: Config
    probabilities: Probabilities | None = None
    statements: Statements | None = None
    edits: NetworkEdits = field(default_factory=NetworkEdits)

    @property
    def parts(self) -> Parts:
        """The items that the source meshes make up."""
        return self.analysis.parts

    @property
    def contacts(self) -> Contacts:
        """Pairs of parts that are near."""
        return self.analysis.contacts

    @property
    def cluster(self) -> Ints:
        """``(n_parts,)`` number of each part's structure; -1 for none."""
        return self.analysis.cluster

    @property
    def neighbors(self) -> Mapping[int, list[int]]:
        """The parts that are near each part, ascending."""
        return self.contacts.neighbors

    @cached_property
    def gaps(self) -> Mapping[tuple[int, int], float]:
        """The distance of each pair of near parts, the lower number first [m]."""
        distances = self.contacts.distance.tolist()
        return {(min(a, b), max(a, b)): gap for (a, b), gap in zip(self.contacts.plain_pairs, distances, strict=True)}

    @cached_property
    def stated(self) -> Stated:
        """What the file says of joints and flow; nothing unless ``relate.use_metadata`` lets it count."""
        if not self.config.relate.use_metadata:
            return Stated()
        scene = self.analysis.scene
        return Stated(resolve_links(scene.links, scene.paths, self.parts.part_of_mesh))

    @cached_property
    def is_connector(self) -> tuple[bool, ...]:
        """Of each part, whether its own label calls it a connector."""
        connectors = self.vocabulary.connector_groups
        return tuple(label is not None and label.group in connectors for label in self.labels)


@dataclass(frozen=True)
class Group:
    """Parts that work as one.

    Args:
        unit_type: as the vocabulary calls it.
        parts: ascending.
    """

    unit_type: str
    parts: tuple[int, ...]


@dataclass(frozen=True)
class Recovered:
    """Why a part is taken for something that its label doesn't say.

    Args:
        sure: how sure that is, 0..1.
        reasons: what speaks for and against it, in words, the weightiest first.
    """

    sure: float
    reasons: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Piping:
    """Lines, what they may end at, and what joins what; a pass returns a new one.

    Args:
        given: what everything is found from.
        roles: what each part does.
        lines: centreline of each part that carries one.
        lineless: connectors without a line, ascending.
        groups: connected parts of one functional group, as labels have them.
        members: parts of groups that lines may end at.
        feet: parts of gauges, which may sit on the side of a line.
        jackets: bodies around lines, insulation above all, which are neither line nor unit.
        recovered: parts that lie where a device or a fitting must be.
        branches: parts that are set on the side of a line, whatever their labels.
        open: joints that were not made between lines and what may be a branch of one.
    """

    given: RelateInput
    roles: Roles
    lines: Mapping[int, Centreline]
    lineless: tuple[int, ...]
    groups: tuple[Group, ...]
    members: frozenset[int]
    feet: frozenset[int]
    jackets: frozenset[int] = frozenset()
    recovered: Mapping[int, Recovered] = field(default_factory=dict)
    branches: frozenset[int] = frozenset()
    open: tuple[Joint, ...] = ()

    @cached_property
    def solids(self) -> frozenset[int]:
        """What lines may end at: parts of units, and connectors without a line."""
        return self.members.union(self.lineless)

    @cached_property
    def joints(self) -> Attachments:
        """What every end of a line joins; it follows from the lines and from what they may end at."""
        given = self.given
        found = attach_lines(
            given.parts,
            given.contacts,
            self.lines,
            self.solids,
            self.feet,
            given.config.relate.bridge,
            self.bolted,
            given.stated,
        )
        return edit_joints(found, given.edits, given.parts, self.lines, self.solids)

    @cached_property
    def owner(self) -> Mapping[int, Group]:
        """The group of each part that is in one."""
        return {part: group for group in self.groups for part in group.parts}

    @cached_property
    def bolted(self) -> frozenset[tuple[int, int]]:
        """Pairs of parts with lines that one fastener touches both of."""
        held = [near for part in self._fasteners if len(near := self.lines_near(part)) <= _MOST_HELD]
        return frozenset((a, b) for near in held for a in near for b in near if a < b)

    @property
    def _fasteners(self) -> list[int]:
        """Fasteners by name that carry no line."""
        return [part for part, name in enumerate(self.roles.names) if name in FASTENERS and part not in self.lines]

    def lines_near(self, part: int) -> list[int]:
        """The parts with a line near one."""
        return [other for other in self.given.neighbors.get(part, ()) if other in self.lines]

    def touched(self, parts: Collection[int]) -> set[int]:
        """What some parts touch, but for what only holds them."""
        near = {other for part in parts for other in self.given.neighbors.get(part, ())}
        return {other for other in near.difference(parts) if self.roles.names[other] not in _HOLDS}

    @cached_property
    def mounted(self) -> Mapping[int, set[int]]:
        """For each solid at an end of a line the parts whose line that is."""
        mounted: dict[int, set[int]] = {}
        for mount in self.joints.mounts:
            mounted.setdefault(mount.part, set()).add(int(self.joints.ends.part[mount.row]))
        return mounted

    @cached_property
    def apart(self) -> frozenset[int]:
        """Parts that no unit takes in: the ground, jackets, and those whose line is joined to another one."""
        rows = {row for facing in self.joints.facings for row in (facing.first, facing.second)}
        rows |= {tapped.row for tapped in self.joints.taps if not tapped.tap.sleeve}
        ground = np.flatnonzero(self.given.parts.ground).tolist()
        return self.jackets | {int(self.joints.ends.part[row]) for row in rows} | set(ground)

    @cached_property
    def unsupported(self) -> frozenset[int]:
        """Parts whose group only their own label says, in a scene of doubtful labels."""
        roles = self.roles
        if not roles.doubtful:
            return frozenset()
        return frozenset(part for part, group in enumerate(roles.groups) if group is not None) - roles.backed
