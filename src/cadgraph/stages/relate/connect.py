"""Units and the network of lines between them, from labels and geometry."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from cadgraph.config import Config
from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Network, Parts, Properties
from cadgraph.model.scene import Ints, Scene
from cadgraph.model.vocabulary import Vocabulary
from cadgraph.stages.relate.algorithm import find_units
from cadgraph.stages.relate.attach import Attachments, attach_lines, flat_contacts
from cadgraph.stages.relate.contract import simplify
from cadgraph.stages.relate.flow import direct_flow, stated_flow
from cadgraph.stages.relate.joint import face_ends, gather_ends
from cadgraph.stages.relate.kind import name_kinds
from cadgraph.stages.relate.line import find_lines, is_disc, is_plain_tube
from cadgraph.stages.relate.network import draw_network
from cadgraph.stages.relate.role import Roles, find_roles, likely_lines, neighbor_lists
from cadgraph.stages.relate.run import make_network
from cadgraph.stages.relate.tag import tag_units
from cadgraph.stages.relate.unit import (
    FASTENERS,
    Group,
    connected_groups,
    is_loose_operator,
    mend_groups,
    split_groups,
    take_in_enclosed,
)

__all__ = ["connect_units"]

# A part that only its shape calls a pipe must face one of about its size: this ratio of radii, that of a reducing
# flange; one that its label calls a device must face one of its own size.
_RATIO, _OWN_RATIO = 0.3, 0.9
_SAME_PLACE = 1e-4  # copies of a part lie this near to each other [m]
_BY_SHAPE = 0.8  # how sure it is that such a part is a connector
_ON_LINES = frozenset({None, "pipe", "flange", "blind flange", "gasket", "coupling", "union", "nipple", "pipe cap"})
_CLOSED = {"blind flange": "blind", "pipe cap": "blind"}


def connect_units(
    scene: Scene,
    properties: Properties,
    parts: Parts,
    labels: Sequence[Label | None],
    guessed: Sequence[Label | None],
    contacts: Contacts,
    cluster: Ints,
    vocabulary: Vocabulary,
    config: Config,
) -> tuple[Network, tuple[Diagnostic, ...]]:
    """Finds the units and what follows what along the lines between them.

    Args:
        scene: the source meshes.
        properties: of the source meshes.
        parts: made from them.
        labels: of each part.
        guessed: what the embedded labeler alone says of each part: a second opinion.
        contacts: pairs of parts that are near.
        cluster: ``(n_parts,)``; -1 takes no part.
        vocabulary: says which groups are connectors and which form units.
        config: settings; with ``method = "paper"`` units are the paper's and there is no network of lines.

    Returns:
        The network, and what is to be told.
    """
    if config.method == "paper":
        return Network(find_units(labels, contacts, cluster, vocabulary)), ()
    roles = find_roles(parts, labels, guessed)
    near = neighbor_lists(contacts)
    bridge = config.relate.bridge
    groups = connected_groups(roles, contacts, cluster, vocabulary.unit_of_group)
    lines, copies = _find_all_lines(
        scene, properties, parts, roles, labels, guessed, contacts, vocabulary, groups, bridge
    )
    groups = connected_groups(roles, contacts, cluster, vocabulary.unit_of_group, lines)
    blobs = [
        part
        for part, group in enumerate(roles.groups)
        if group in vocabulary.connector_groups and part not in lines and part not in copies and cluster[part] >= 0
    ]
    members = {part for group in groups for part in group.parts}
    feet = {part for group in groups if group.unit_type == "gauge" for part in group.parts}
    found = attach_lines(parts, contacts, lines, [*members, *blobs], feet, bridge)
    shapeless = _shapeless(parts, found, lines, contacts)
    if shapeless:
        lines = {part: line for part, line in lines.items() if part not in shapeless}
        blobs = sorted([*blobs, *shapeless])
        found = attach_lines(parts, contacts, lines, [*members, *blobs], feet, bridge)
    unsure = _unsupported(roles)
    mended = mend_groups(
        groups, roles.names, near, _mounted(found), _kept_apart(parts, found), unsure, frozenset(lines)
    )
    types = [vocabulary.unit_of_group.get(group, "") if group is not None else None for group in roles.groups]
    mended = take_in_enclosed(mended, parts.inside, types, near, lines)
    taken_in = {part for group in mended for part in group.parts} - members
    if any(part in lines or part in blobs or roles.names[part] not in FASTENERS for part in taken_in):
        members |= taken_in
        lines = {part: line for part, line in lines.items() if part not in members}
        blobs = [part for part in blobs if part not in members]
        found = attach_lines(parts, contacts, lines, [*members, *blobs], feet, bridge)
    eps = config.cluster.eps
    reached = set(_mounted(found))
    # Where labels are doubtful, what only its own label calls a device and no line leads to is none.
    kept = [group for group in mended if not unsure.issuperset(group.parts) or reached.intersection(group.parts)]
    likeliest = [
        name or (label.guesses[0].name if label is not None and label.guesses else None)
        for name, label in zip(roles.names, labels, strict=True)
    ]
    loose = [group for group in kept if is_loose_operator(group, likeliest, reached)]
    kept = [group for group in kept if group not in loose]
    groups = split_groups(parts, kept, contacts, found, near, roles.names, eps)
    units = tag_units(parts, groups)
    owner = {part: number for number, unit in enumerate(units) for part in unit.parts}
    flanged = flat_contacts(parts, contacts, _between(contacts, owner, set(blobs)), eps)
    connectors = vocabulary.connector_groups
    sure = {part for part, label in enumerate(labels) if label is not None and label.group in connectors}
    where = {pair: middle for pair, (middle, _) in flanged.items()}
    drawing = draw_network(lines, blobs, units, found, where, lambda part: 1.0 if part in sure else _BY_SHAPE)
    tapped = {number for number, unit in enumerate(units) if unit.unit_type in ("gauge", "valve")}
    covers = frozenset(part for part, line in lines.items() if _is_cover(line, roles.names[part]))
    net = simplify(drawing, tapped, covers, len(units), config.relate.leg)
    network = make_network(
        net, drawing, units, lines, found, lambda part: _CLOSED.get(roles.names[part] or ""), sure.__contains__
    )
    network = name_kinds(network, roles.names, parts)
    network, told_flow = direct_flow(network, parts, roles.names, stated_flow(network, config.relate.flow))
    return network, (*_tell(parts, roles, drawing.bridged), *_tell_loose(parts, loose), *told_flow)


def _tell_loose(parts: Parts, loose: Sequence[Group]) -> tuple[Diagnostic, ...]:
    if not loose:
        return ()
    heads = tuple(parts.scene.paths[part] for group in loose for part in group.parts)
    return (Diagnostic("loose-operator", "handwheels, levers or the like that sit on no valve form no unit", heads),)


def _find_all_lines(
    scene: Scene,
    properties: Properties,
    parts: Parts,
    roles: Roles,
    labels: Sequence[Label | None],
    guessed: Sequence[Label | None],
    contacts: Contacts,
    vocabulary: Vocabulary,
    groups: Sequence[Group],
    bridge: float,
) -> tuple[dict[int, Centreline], set[int]]:
    """The lines of the connectors, and of what only geometry shows to be one; and the parts that are mere copies."""
    connectors = [part for part, group in enumerate(roles.groups) if group in vocabulary.connector_groups]
    others = likely_lines(roles, guessed, contacts, vocabulary, parts.ground.tolist())
    singles = [group.parts[0] for group in groups if len(group.parts) == 1]
    # What is too small for a part of its own (a flange's nuts) would blur the shape of the mesh that it joined.
    heads = {parts.meshes[part][0]: part for part in (*connectors, *others, *singles)}
    lines = {heads[mesh]: line for mesh, line in find_lines(scene, properties, list(heads)).items()}
    copies = _repeated(parts, contacts, lines)
    lines = {part: line for part, line in lines.items() if part not in copies}
    kept = {part: lines[part] for part in connectors if part in lines}
    maybe = {part: _RATIO for part in others if part in lines}
    for part in singles:
        # The labeler is no second opinion on what it said itself.
        if part not in lines or (part in roles.backed and labels[part] is not guessed[part]):
            continue
        if is_plain_tube(lines[part]) and not roles.doubtful:
            maybe[part] = _OWN_RATIO
        elif is_plain_tube(lines[part]) or (roles.doubtful and is_disc(lines[part])):
            maybe[part] = _RATIO
    if maybe:
        _accept(kept, maybe, lines, contacts, bridge)
    return dict(sorted(kept.items())), copies


def _repeated(parts: Parts, contacts: Contacts, lines: Mapping[int, Centreline]) -> set[int]:
    """Parts that lie where another one of their shape lies: of copies the first carries the line."""
    middles = parts.properties.centroid
    return {
        b
        for a, b in contacts.pairs.tolist()
        if a in lines
        and b in lines
        and parts.shape[a] == parts.shape[b]
        and float(np.abs(middles[a] - middles[b]).max()) < _SAME_PLACE
    }


def _accept(
    kept: dict[int, Centreline],
    maybe: Mapping[int, float],
    lines: Mapping[int, Centreline],
    contacts: Contacts,
    bridge: float,
) -> None:
    """Adds those lines that continue one that is kept."""
    tried = {part: line for part, line in lines.items() if part in kept or part in maybe}
    ends = gather_ends(tried)
    steps: dict[int, list[int]] = {}
    weak: dict[int, list[int]] = {}
    for facing in face_ends(ends, contacts, bridge):
        if facing.corner:
            continue
        a, b = int(ends.part[facing.first]), int(ends.part[facing.second])
        radii = sorted((float(ends.radius[facing.first]), float(ends.radius[facing.second])))
        for part, other in ((a, b), (b, a)):
            if part not in maybe or radii[0] >= maybe[part] * radii[1]:
                steps.setdefault(other, []).append(part)
            elif radii[0] >= _RATIO * radii[1]:
                weak.setdefault(part, []).append(other)
    # What has a flange at either end is no less a pipe.
    for part, others in sorted(weak.items()):
        if len(others) >= 2 and all(other in kept for other in others):
            kept[part] = lines[part]
    front = list(kept)
    while front:
        for part in steps.get(front.pop(), ()):
            if part in maybe and part not in kept:
                kept[part] = lines[part]
                front.append(part)


def _unsupported(roles: Roles) -> set[int]:
    """Parts whose group only their own doubtful label says."""
    if not roles.doubtful:
        return set()
    return {part for part, group in enumerate(roles.groups) if group is not None and part not in roles.backed}


def _is_cover(line: Centreline, name: str | None) -> bool:
    """Whether a part is a lid without being called one of a line's: a disc without a hole."""
    hollow = any(np.isfinite(end.bore) for end in line.ends)
    return is_disc(line) and not hollow and name not in _ON_LINES


def _mounted(found: Attachments) -> dict[int, set[int]]:
    """For each solid at an end of a line the parts whose line that is."""
    mounted: dict[int, set[int]] = {}
    for mount in found.mounts:
        mounted.setdefault(mount.part, set()).add(int(found.ends.part[mount.row]))
    return mounted


def _shapeless(parts: Parts, found: Attachments, lines: Mapping[int, Centreline], contacts: Contacts) -> set[int]:
    """Parts whose line joins nothing although ends of others are at them: it was traced wrongly."""
    joined = {row for facing in found.facings for row in (facing.first, facing.second)}
    joined |= {row for row, _ in found.doubled} | {row for row, _, tap in found.taps if not tap.sleeve}
    joined |= {mount.row for mount in found.mounts}
    idle = {part for part, rows in found.ends.of_part.items() if not joined.intersection(rows)}
    loose: dict[int, int] = {}
    for a, b in contacts.pairs.tolist():
        for part, other in ((a, b), (b, a)):
            if part in idle and other in lines and other not in idle:
                low, high = parts.properties.aabb[part]
                for row in found.ends.of_part.get(other, ()):
                    reach = float(found.ends.radius[row])
                    point = found.ends.point[row]
                    if row not in joined and np.all(point >= low - reach) and np.all(point <= high + reach):
                        loose[part] = loose.get(part, 0) + 1
    return {part for part, count in loose.items() if count >= 2}


def _kept_apart(parts: Parts, found: Attachments) -> set[int]:
    """Parts that no unit takes in: the ground, and those whose line is joined to another one."""
    rows = {row for facing in found.facings for row in (facing.first, facing.second)}
    rows |= {row for row, _, tap in found.taps if not tap.sleeve}
    return {int(found.ends.part[row]) for row in rows} | set(np.flatnonzero(parts.ground).tolist())


def _between(contacts: Contacts, owner: Mapping[int, int], blobs: Collection[int]) -> list[tuple[int, int]]:
    """Pairs of solids in contact that are not of one unit."""
    return [
        (a, b)
        for a, b in contacts.pairs.tolist()
        if (a in owner or a in blobs) and (b in owner or b in blobs) and owner.get(a, -1 - a) != owner.get(b, -1 - b)
    ]


def _tell(parts: Parts, roles: Roles, bridged: Sequence[tuple[int, int, float]]) -> tuple[Diagnostic, ...]:
    paths, told = parts.scene.paths, []
    if bridged:
        widest = max(gap for _, _, gap in bridged)
        heads = tuple(paths[part] for a, b, _ in sorted(bridged) for part in (a, b))
        told.append(
            Diagnostic(
                "bridged-gap",
                f"{len(bridged)} gaps between ends of pipes that face each other are bridged, the widest "
                f"{1000 * widest:.1f} mm (relate.bridge); each pair of meshes is listed in turn",
                heads,
            )
        )
    if roles.doubted:
        told.append(
            Diagnostic(
                "label-doubted",
                f"{len(roles.doubted)} labels are not followed where units are formed and lines traced: so many "
                "disagree with the geometry that it goes first",
                tuple(paths[part] for part in roles.doubted),
            )
        )
    return tuple(told)
