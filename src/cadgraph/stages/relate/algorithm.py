"""Functional units and their relations (paper, section III-B, step 6 and Algorithm 1)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from cadgraph._io.text import natural_key
from cadgraph.geometry.components import connected_sets
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, UnitParts, owners_of
from cadgraph.model.scene import Ints
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["LETTERS", "find_units", "number_units", "pipe_systems", "relate_units"]

LETTERS = {"valve": "V", "gauge": "G", "pump": "P", "tank": "T", "equipment": "E"}


def find_units(
    labels: Sequence[Label | None], contacts: Contacts, cluster: Ints, vocabulary: Vocabulary
) -> tuple[UnitParts, ...]:
    """The functional units: connected sets of parts with the same functional group.

    Args:
        labels: of each part.
        contacts: pairs of parts.
        cluster: ``(n_parts,)``; -1 takes no part.
        vocabulary: says which groups form units.

    Returns:
        The units by tag (``G-001``, ``V-001``...); tags are numbered by type in the order of their lowest part.
    """
    unit_of_group = vocabulary.unit_of_group
    groups = [label.group if label is not None and label.group in unit_of_group else None for label in labels]
    members = [part for part, group in enumerate(groups) if group is not None]
    joined = [(a, b) for a, b in contacts.plain_pairs if groups[a] == groups[b] and cluster[a] == cluster[b] >= 0]
    return number_units((unit_of_group[str(groups[p[0]])], p) for p in connected_sets(members, joined))


def number_units(groups: Iterable[tuple[str, tuple[int, ...]]]) -> tuple[UnitParts, ...]:
    """Units with tags that are numbered by type.

    Args:
        groups: type and parts of each, in the order in which they are numbered.

    Returns:
        The units by tag.
    """
    counts: Counter[str] = Counter()
    units = []
    for unit_type, parts in groups:
        counts[unit_type] += 1
        letter = LETTERS.get(unit_type, unit_type[:3].upper())
        units.append(UnitParts(unit_type, f"{letter}-{counts[unit_type]:03d}", parts))
    return tuple(sorted(units, key=lambda unit: natural_key(unit.tag)))


def pipe_systems(labels: Sequence[Label | None], cluster: Ints, vocabulary: Vocabulary) -> frozenset[int]:
    """The clusters that hold a connector part; only there are relations looked for."""
    connectors = vocabulary.connector_groups
    return frozenset(
        int(cluster[part])
        for part, label in enumerate(labels)
        if label is not None and label.group in connectors and cluster[part] >= 0
    )


def relate_units(
    units: Sequence[UnitParts],
    labels: Sequence[Label | None],
    contacts: Contacts,
    cluster: Ints,
    vocabulary: Vocabulary,
) -> tuple[tuple[int, int], ...]:
    """Algorithm 1 of the paper, with the order of units fixed by their order here.

    Units grow round by round over connector parts that no unit holds yet; units whose territories touch are
    related. In each round only the parts that a unit won in the round before can have unclaimed neighbours left,
    so only these are looked at; the answer is that of the paper's full scan.

    Args:
        units: in the order in which they grow.
        labels: of each part.
        contacts: pairs of parts.
        cluster: ``(n_parts,)``.
        vocabulary: says which groups are connectors.

    Returns:
        Pairs of unit indices, first < second, ascending.
    """
    inside = _pairs_in_systems(labels, contacts, cluster, vocabulary)
    connectors = vocabulary.connector_groups
    connector = [label is not None and label.group in connectors for label in labels]
    owner = _territories(units, _neighbors(inside), connector)
    related = {
        (min(owner[a], owner[b]), max(owner[a], owner[b]))
        for a, b in inside
        if a in owner and b in owner and owner[a] != owner[b]
    }
    return tuple(sorted(related))


def _pairs_in_systems(
    labels: Sequence[Label | None], contacts: Contacts, cluster: Ints, vocabulary: Vocabulary
) -> list[tuple[int, int]]:
    """The contacts within clusters that hold a connector."""
    systems = pipe_systems(labels, cluster, vocabulary)
    pairs = contacts.plain_pairs
    return [(a, b) for a, b in pairs if cluster[a] == cluster[b] and int(cluster[a]) in systems]


def _neighbors(pairs: Sequence[tuple[int, int]]) -> dict[int, list[int]]:
    """The parts that each one is paired with."""
    found: dict[int, list[int]] = {}
    for a, b in pairs:
        found.setdefault(a, []).append(b)
        found.setdefault(b, []).append(a)
    return found


def _territories(
    units: Sequence[UnitParts], neighbors: Mapping[int, Sequence[int]], connector: Sequence[bool]
) -> dict[int, int]:
    """The unit that each part belongs to after all have grown."""
    owner = owners_of(units)
    fronts = [list(unit.parts) for unit in units]
    while any(fronts):
        for i, front in enumerate(fronts):
            won = _unclaimed(front, neighbors, connector, owner)
            owner.update(dict.fromkeys(won, i))
            fronts[i] = won
    return owner


def _unclaimed(
    front: Sequence[int], neighbors: Mapping[int, Sequence[int]], connector: Sequence[bool], owner: Mapping[int, int]
) -> list[int]:
    """The connector parts next to a front that no unit holds, each once."""
    return list(
        dict.fromkeys(
            there for here in front for there in neighbors.get(here, ()) if connector[there] and there not in owner
        )
    )
