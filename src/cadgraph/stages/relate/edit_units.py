"""Units as a user corrected them: merged, split, and called by the plant's own tags."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from cadgraph.model.names import loose_tag
from cadgraph.model.parts import Network, UnitParts, owners_of
from cadgraph.model.scene import Floats
from cadgraph.stages.relate.edits import NameEdit, NetworkEdits, UnitEdit, Unmet
from cadgraph.stages.relate.piping import Group, Piping
from cadgraph.stages.relate.stated_names import Named, renumbered

__all__ = ["edit_groups", "edit_units", "tag_as_corrected"]

_NO_UNIT = "none of its parts is in a unit"


def edit_units(piping: Piping, groups: Sequence[Group]) -> tuple[Piping, list[Group], list[Unmet]]:
    """The units as a user merged and split them.

    Args:
        piping: what joins what.
        groups: the parts of each unit.

    Returns:
        The piping, in which parts that came to a unit carry no line, the groups, and the edits that don't fit.
    """
    edits = piping.given.edits
    if not edits.units:
        return piping, list(groups), []
    edited, unmet = edit_groups(groups, edits, piping.given.parts.properties.area)
    new = _parts_of(edited) - _parts_of(groups)
    touched = _parts_of([group for group in edited if group not in groups])
    gauges = _parts_of([group for group in edited if group.unit_type == "gauge"])
    members = piping.members | new
    changed = replace(
        piping,
        lines={part: line for part, line in piping.lines.items() if part not in new},
        lineless=tuple(part for part in piping.lineless if part not in new),
        members=members,
        feet=(piping.feet - touched) | (gauges & touched & members),
    )
    return changed, edited, unmet


def _parts_of(groups: Sequence[Group]) -> set[int]:
    return {part for group in groups for part in group.parts}


def edit_groups(groups: Sequence[Group], edits: NetworkEdits, area: Floats) -> tuple[list[Group], list[Unmet]]:
    """The groups as a user merged and split them.

    Args:
        groups: the parts of each unit.
        edits: of a user.
        area: ``(n_parts,)`` surface of each part [m2].

    Returns:
        The groups by their parts, and the edits that don't fit.
    """
    edited, unmet = list(groups), []
    for edit in edits.units:
        changed = _merged(edited, edit, area) if edit.merge else _split(edited, edit)
        if changed is None:
            unmet.append((edit.number, _NO_UNIT))
        else:
            edited = changed
    return sorted(edited, key=lambda group: group.parts), unmet


def _merged(groups: Sequence[Group], edit: UnitEdit, area: Floats) -> list[Group] | None:
    """The groups with those that hold some parts as one, of the type of the one with the largest surface."""
    named = set(edit.parts)
    held = [group for group in groups if not named.isdisjoint(group.parts)]
    if not held:
        return None
    largest = max(held, key=lambda group: (float(area[list(group.parts)].sum()), -group.parts[0]))
    parts = named.union(*(group.parts for group in held))
    return [*(group for group in groups if group not in held), Group(largest.unit_type, tuple(sorted(parts)))]


def _split(groups: Sequence[Group], edit: UnitEdit) -> list[Group] | None:
    """The groups with some parts of one as a group of their own."""
    named = set(edit.parts)
    shared = {k: named.intersection(group.parts) for k, group in enumerate(groups)}
    home = max(shared, key=lambda k: (len(shared[k]), -k), default=None)
    if home is None or not shared[home]:
        return None
    own = shared[home]
    rest = tuple(part for part in groups[home].parts if part not in own)
    if not rest:
        return list(groups)
    unit_type = groups[home].unit_type
    others = [group for k, group in enumerate(groups) if k != home]
    return [*others, Group(unit_type, rest), Group(unit_type, tuple(sorted(own)))]


def tag_as_corrected(named: Named, edits: NetworkEdits) -> tuple[Named, list[Unmet]]:
    """Gives units the tags that a user gave them; others with such a tag get the next free number.

    The order of the units stays, so that nothing but tags changes.

    Args:
        named: units with their tags so far.
        edits: of a user.

    Returns:
        The units, and the edits that don't fit.
    """
    if not edits.tags:
        return named, []
    wanted, unmet = _wanted(named.units, edits.tags)
    tags = renumbered(named.units, [wanted[k].name if k in wanted else None for k in range(len(named.units))])
    units = tuple(replace(unit, tag=tag) for unit, tag in zip(named.units, tags, strict=True))
    return replace(named, units=units), unmet


def call_as_corrected(network: Network, edits: NetworkEdits) -> tuple[Network, list[Unmet]]:
    """Makes units the kinds of devices that a user says they are, whatever shape and file say.

    Args:
        network: with its units.
        edits: of a user.

    Returns:
        The network, and the edits that don't fit.
    """
    if not edits.devices:
        return network, []
    owner = owners_of(network.units)
    units, unmet = list(network.units), list[Unmet]()
    for edit in edits.devices:
        number = _unit_of(edit, owner)
        if number is None:
            unmet.append((edit.number, _NO_UNIT))
        else:
            units[number] = replace(units[number], kind=edit.name, kind_guesses=())
    return replace(network, units=tuple(units)), unmet


def _wanted(units: Sequence[UnitParts], edits: Sequence[NameEdit]) -> tuple[dict[int, NameEdit], list[Unmet]]:
    """The tag of each unit that a user gave one, each tag once; and the edits that don't fit."""
    owner = owners_of(units)
    unmet: list[Unmet] = []
    wanted: dict[int, NameEdit] = {}
    for edit in edits:
        unit = _unit_of(edit, owner)
        if unit is None:
            unmet.append((edit.number, _NO_UNIT))
            continue
        for other in [k for k, one in wanted.items() if k != unit and _is_same(one.name, edit.name)]:
            unmet.append((wanted.pop(other).number, "another unit is called so by a later correction"))
        wanted[unit] = edit
    return wanted, unmet


def _unit_of(edit: NameEdit, owner: Mapping[int, int]) -> int | None:
    """The unit that most of an edit's parts are in, of several the one of its first part."""
    homes = [owner[part] for part in edit.parts if part in owner]
    return max(homes, key=lambda k: (homes.count(k), -homes.index(k)), default=None)


def _is_same(one: str, other: str) -> bool:
    return one == other or (bool(loose_tag(one)) and loose_tag(one) == loose_tag(other))
