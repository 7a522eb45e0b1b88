"""Units and the network of lines between them, from labels and geometry."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cadgraph.geometry.line.centreline import Centreline
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Label
from cadgraph.model.parts import Joint, Network, Parts, UnitParts, owners_of
from cadgraph.stages.relate.algorithm import find_units, number_units
from cadgraph.stages.relate.contract import Closed, simplify
from cadgraph.stages.relate.cover import Cover, cover_of
from cadgraph.stages.relate.edit_flow import set_flow, unmet_flow
from cadgraph.stages.relate.edit_joints import bridge_solids, joint_of_solids, unmet_joints
from cadgraph.stages.relate.edit_units import call_as_corrected, edit_groups, edit_units, tag_as_corrected
from cadgraph.stages.relate.edits import Unmet
from cadgraph.stages.relate.flow import direct_flow, stated_flow
from cadgraph.stages.relate.kind import name_kinds
from cadgraph.stages.relate.line import is_disc
from cadgraph.stages.relate.meet import meet_directly
from cadgraph.stages.relate.network import Drawing, draw_network
from cadgraph.stages.relate.offer import Offer
from cadgraph.stages.relate.piping import Group, Piping, RelateInput
from cadgraph.stages.relate.pocket import closed_ends
from cadgraph.stages.relate.record import record_joints
from cadgraph.stages.relate.recover import recover_units
from cadgraph.stages.relate.relabel import relabel_parts
from cadgraph.stages.relate.role import Roles, find_roles
from cadgraph.stages.relate.run import make_network
from cadgraph.stages.relate.shortfall import find_shortfalls
from cadgraph.stages.relate.split import split_groups
from cadgraph.stages.relate.standing import find_standing
from cadgraph.stages.relate.stated import report_unplaced
from cadgraph.stages.relate.stated_names import name_as_stated, tag_as_stated
from cadgraph.stages.relate.stub import drop_stubs
from cadgraph.stages.relate.tag import tag_units
from cadgraph.stages.relate.trace import drop_shapeless, trace_lines
from cadgraph.stages.relate.unit import is_loose, mend_units

__all__ = ["Connected", "connect_units"]

_BY_SHAPE = 0.8  # how sure it is that a part that only its shape calls one is a connector
_ON_LINES = frozenset({None, "pipe", "flange", "blind flange", "gasket", "coupling", "union", "nipple", "pipe cap"})
_CLOSED = {"blind flange": "blind", "pipe cap": "blind"}


@dataclass(frozen=True, eq=False)
class Connected:
    """What follows from lines.

    Args:
        network: units and what joins them.
        labels: of each part, as the network has it.
        diagnostics: what the user should know about it.
        unmet: the user's edits that can't be carried out: the number of each, and why.
    """

    network: Network
    labels: tuple[Label | None, ...]
    diagnostics: tuple[Diagnostic, ...] = ()
    unmet: tuple[Unmet, ...] = ()


def connect_units(given: RelateInput) -> Connected:
    """Finds the units and what follows what along the lines between them.

    Args:
        given: what everything is found from; with ``method = "paper"`` in its settings units are the paper's and there
            is no network of lines.

    Returns:
        The network, the labels that agree with it, and what the user should know.
    """
    if given.config.method == "paper":
        return _as_paper(given)
    roles = find_roles(given.parts, given.labels, given.opinions)
    piping = trace_lines(given, roles)
    piping = recover_units(drop_shapeless(piping))
    piping, groups = mend_units(piping)
    groups, loose = _decide(piping, groups)
    piping, groups, unmet = edit_units(piping, groups)
    labels = relabel_parts(piping, groups)
    names = [label.name if label is not None else None for label in labels]
    named = tag_as_stated(tag_units(given.parts, groups), given.statements, given.parts, labels, given.vocabulary)
    former = [unit.tag for unit in named.units]
    named, untagged = tag_as_corrected(named, given.edits)
    units = named.units
    drawing = _draw(piping, units)
    network = replace(_contract(piping, units, drawing, names), joints=_joints(piping, units, drawing))
    network = name_kinds(network, names, given.parts)
    network, told = name_as_stated(network, named, given.parts, given.vocabulary)
    network, strange = call_as_corrected(network, given.edits)
    stated = stated_flow(network, given.config.relate.flow, former)
    by_user = set_flow(network, given.edits)
    network, contradictions = direct_flow(network, given.parts, names, stated, given.stated, by_user.evidence)
    unmet += [*untagged, *strange, *_unjoined(piping, network), *by_user.unmet, *unmet_flow(network, by_user)]
    network = drop_stubs(network)
    diagnostics = (
        *find_shortfalls(piping, network),
        *_bridged_gaps(given, drawing),
        *_stated_gaps(piping),
        *report_unplaced(given.stated),
        *_doubted_labels(given.parts, roles),
        *_loose_pieces(given.parts, loose),
        *contradictions,
        *named.diagnostics,
        *told,
    )
    return Connected(network, labels, diagnostics, tuple(unmet))


def _as_paper(given: RelateInput) -> Connected:
    """The paper's units, as the user corrected them; there are no lines whose joints or directions could be."""
    units = find_units(given.labels, given.contacts, given.cluster, given.vocabulary)
    edits = given.edits
    numbers = [*(edit.number for edit in edits.joints), *(edit.number for edit in edits.flows)]
    unmet: list[Unmet] = [(number, "method = 'paper' knows no lines") for number in numbers]
    if edits.units:
        groups, lost = edit_groups([Group(u.unit_type, u.parts) for u in units], edits, given.parts.properties.area)
        units, unmet = number_units((group.unit_type, group.parts) for group in groups), [*unmet, *lost]
    named = tag_as_stated(units, given.statements, given.parts, given.labels, given.vocabulary)
    named, untagged = tag_as_corrected(named, edits)
    network, told = name_as_stated(Network(named.units), named, given.parts, given.vocabulary)
    network, strange = call_as_corrected(network, edits)
    return Connected(network, tuple(given.labels), (*named.diagnostics, *told), (*unmet, *untagged, *strange))


def _joints(piping: Piping, units: Sequence[UnitParts], drawing: Drawing) -> tuple[Joint, ...]:
    """The joints, with those of solids that a user made."""
    made = [joint_of_solids(pair, points) for pair, points in sorted(drawing.by_user.items(), key=lambda row: row[0])]
    return (*record_joints(piping, units, drawing), *made)


def _unjoined(piping: Piping, network: Network) -> list[Unmet]:
    """The joints that the user made and that can't be."""
    owner = owners_of(network.units)
    usable = {*piping.lines, *piping.lineless, *piping.members, *owner}
    return unmet_joints(piping.given.edits, network.joints, piping.given.parts, usable, owner)


def _decide(piping: Piping, groups: Sequence[Group]) -> tuple[list[Group], list[Group]]:
    """Which groups are units, each device one; and handwheels on no valve, lugs on no vessel, nameplates."""
    reached = set(piping.mounted)
    # Where labels are doubtful, what only its own label calls a device and no line leads to is none.
    held = [
        group for group in groups if not piping.unsupported.issuperset(group.parts) or reached.intersection(group.parts)
    ]
    likeliest = _likeliest_names(piping)
    loose = [group for group in held if is_loose(group, likeliest, reached, piping.given.parts)]
    return split_groups(piping, [group for group in held if group not in loose]), loose


def _likeliest_names(piping: Piping) -> list[str | None]:
    """The name of each part, or the first guess of its label where it has none."""
    return [
        name or (label.guesses[0].name if label is not None and label.guesses else None)
        for name, label in zip(piping.roles.names, piping.given.labels, strict=True)
    ]


def _draw(piping: Piping, units: Sequence[UnitParts]) -> Drawing:
    """The network of lines between units, every piece between two joints a span."""
    given = piping.given
    owner = {part: -1 - part for part in piping.lineless} | owners_of(units)
    bridged = bridge_solids(given.edits, given.parts, piping.lines, owner)
    standing = find_standing(piping, units)
    met = {pair: how for pair, how in meet_directly(piping, units, standing).items() if pair not in bridged}

    def confidence(part: int) -> float:
        return 1.0 if given.is_connector[part] else _BY_SHAPE

    return draw_network(piping.lines, piping.lineless, units, piping.joints, met, standing, confidence, bridged)


def _contract(piping: Piping, units: Sequence[UnitParts], drawing: Drawing, names: Sequence[str | None]) -> Network:
    """The runs between units, junctions and terminals."""
    given = piping.given
    tapped = {number for number, unit in enumerate(units) if unit.unit_type in ("gauge", "valve")}
    net = simplify(drawing, tapped, _closed(piping, drawing, names), len(units), given.config.relate.leg)
    carried = {*piping.lines, *piping.lineless, *owners_of(units), *piping.jackets}
    return make_network(
        net,
        drawing,
        units,
        piping.lines,
        piping.joints,
        lambda part: _CLOSED.get(names[part] or ""),
        lambda row: _cover(piping, carried, row),
        given.is_connector.__getitem__,
    )


def _closed(piping: Piping, drawing: Drawing, names: Sequence[str | None]) -> Closed:
    """Where no run ends: at lids of fittings, and in the pots of strainers."""
    covers = frozenset(part for part, line in piping.lines.items() if _is_cover(line, names[part]))
    strainers = frozenset(part for part in piping.lines if names[part] == "strainer")
    lids = frozenset(part for part in piping.lines if names[part] in _CLOSED)
    rows = closed_ends(piping.joints, strainers, lids)
    return Closed(covers, frozenset(node for node, own in drawing.ends.items() if rows.issuperset(own)))


def _cover(piping: Piping, carried: Collection[int], row: int) -> Cover | None:
    """What the bodies that a free end lies against make of it, those that carry lines left out."""
    given, ends = piping.given, piping.joints.ends
    near = given.contacts.neighbors.get(int(ends.part[row]), [])
    return cover_of(given.parts, [part for part in near if part not in carried], ends, row)


def _is_cover(line: Centreline, name: str | None) -> bool:
    """Whether a part is a lid without being called one of a line's: a disc without a hole."""
    hollow = bool(np.isfinite(line.table_of_ends[:, 7]).any())
    return is_disc(line) and not hollow and name not in _ON_LINES


def _bridged_gaps(given: RelateInput, drawing: Drawing) -> tuple[Diagnostic, ...]:
    by_user = {frozenset((edit.first, edit.second)) for edit in given.edits.joined}
    bridged = [(a, b, gap) for a, b, gap in drawing.bridged if frozenset((a, b)) not in by_user]
    if not bridged:
        return ()
    widest = max(gap for _, _, gap in bridged)
    heads = tuple(given.parts.scene.paths[part] for a, b, _ in sorted(bridged) for part in (a, b))
    message = (
        f"{len(bridged)} gaps between ends of pipes that face each other are bridged, the widest "
        f"{1000 * widest:.1f} mm (relate.bridge); each pair of meshes is listed in turn"
    )
    return (Diagnostic("bridged-gap", message, heads),)


def _stated_gaps(piping: Piping) -> tuple[Diagnostic, ...]:
    """The joints across gaps that geometry alone would not bridge."""
    far = _far_joints(piping)
    if not far:
        return ()
    paths, ends = piping.given.parts.scene.paths, piping.joints.ends
    pairs = [(int(ends.part[offer.row]), offer.part(ends)) for offer in far]
    message = (
        f"{len(far)} joints are made across gaps wider than relate.bridge because the file says so, the widest "
        f"{1000 * max(offer.gap for offer in far):.1f} mm; each pair of meshes is listed in turn"
    )
    return (Diagnostic("stated-gap", message, tuple(paths[part] for pair in pairs for part in pair)),)


def _far_joints(piping: Piping) -> list[Offer]:
    """The joints that are made because the file says so across a gap wider than geometry alone would bridge."""
    limit = piping.given.config.relate.bridge
    made = sorted(piping.joints.made.items())
    return [offer for row, offer in made if row == offer.row and offer.said and offer.gap > limit]


def _doubted_labels(parts: Parts, roles: Roles) -> tuple[Diagnostic, ...]:
    if not roles.doubted:
        return ()
    message = (
        f"{len(roles.doubted)} labels are not followed where units are formed and lines traced: so many "
        "disagree with the geometry that it goes first"
    )
    return (Diagnostic("label-doubted", message, tuple(parts.scene.paths[part] for part in roles.doubted)),)


def _loose_pieces(parts: Parts, loose: Sequence[Group]) -> Iterator[Diagnostic]:
    for unit_type, code, what in (
        ("valve", "loose-operator", "handwheels, levers or the like that sit on no valve"),
        ("tank", "loose-fitting", "lifting lugs, legs or the like that stand on no vessel"),
        ("gauge", "loose-dial", "dials by themselves that are longer than wide, as nameplates are,"),
    ):
        heads = tuple(
            parts.scene.paths[part] for group in loose if group.unit_type == unit_type for part in group.parts
        )
        if heads:
            yield Diagnostic(code, f"{what} form no unit", heads)
