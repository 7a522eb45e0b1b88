"""What the network learns flows back: the labels of parts that lines run through, and of parts of units."""

from __future__ import annotations

from collections.abc import Sequence

from cadgraph.model.labels import FormerLabel, Label, NetworkEvidence
from cadgraph.stages.relate.belief import Beliefs, beliefs_of
from cadgraph.stages.relate.line import is_plain_tube, is_straight
from cadgraph.stages.relate.piping import Group, Piping
from cadgraph.stages.relate.role import USERS
from cadgraph.stages.relate.unit import ON_VESSELS

__all__ = ["relabel_parts"]

# How sure a label is that follows from a line through the part, from its unit, or from most of its repeats (ours).
_ON_LINE, _IN_UNIT, _OUTVOTED = 0.8, 0.7, 0.7
_MACHINES = "equipment"  # have nozzles, legs and lugs as vessels do
_NAMED = 0.5  # least share of a name among those of its group


def relabel_parts(piping: Piping, groups: Sequence[Group]) -> tuple[Label | None, ...]:
    """Labels that agree with the network, in place of those that it contradicts.

    What a user said of a part stays; what others said does, unless so many labels from outside are wrong that none is
    followed alone.

    Args:
        piping: with the lines.
        groups: the parts of each unit.

    Returns:
        A label for each part; those from here have the source ``network`` and hold what they were before.
    """
    given, roles = piping.given, piping.roles
    beliefs = beliefs_of(given.labels, given.probabilities, given.vocabulary)
    connectors = given.vocabulary.connector_groups
    labels = list(given.labels)
    for part in roles.doubted:
        group = roles.groups[part]
        if group is not None:
            labels[part] = _label(
                labels[part], group, roles.names[part], _OUTVOTED, "most of its repeats, or its shape"
            )
    for part in (*piping.lines, *piping.lineless):
        if not _says(labels[part], connectors) and _may_change(piping, beliefs, part):
            group, name = _connector(piping, beliefs, part)
            sure, why = _found(piping, part, _ON_LINE, "a line runs through it")
            labels[part] = _label(labels[part], group, name, sure, why)
    for unit in groups:
        _relabel_unit(piping, beliefs, unit, labels)
    return tuple(labels)


def _relabel_unit(piping: Piping, beliefs: Beliefs, group: Group, labels: list[Label | None]) -> None:
    """Labels of a unit's parts that are of its own group; what holds it together keeps its label."""
    own = piping.given.vocabulary.groups_of(group.unit_type)
    for part in group.parts if own else ():
        if _is_strange(piping, labels[part], part, group.unit_type) and _may_change(piping, beliefs, part):
            said, name = _likeliest(beliefs, part, own)
            if len(group.parts) == len(own) == 1:
                # What stands for the whole is called so.
                name = piping.given.vocabulary.groups[said].names[0]
            sure, why = _found(piping, part, _IN_UNIT, f"it is part of a {group.unit_type} in the network")
            labels[part] = _label(labels[part], said, name, sure, why)


def _is_strange(piping: Piping, label: Label | None, part: int, unit_type: str) -> bool:
    """Whether a part's label is that of a line or of another type of unit, or says nothing of a part that was found.

    What surely is a gasket stays one, and the nozzles and saddles of a machine stay nozzles and saddles.
    """
    if label is not None and label.name == "gasket" and not label.likely:
        return False
    if label is not None and label.name in ON_VESSELS and unit_type == _MACHINES:
        return False
    vocabulary = piping.given.vocabulary
    own = vocabulary.groups_of(unit_type)
    foreign = vocabulary.connector_groups | (vocabulary.unit_of_group.keys() - set(own))
    return (_says(label, foreign) or part in piping.recovered) and not _says(label, own)


def _found(piping: Piping, part: int, sure: float, why: str) -> tuple[float, str]:
    """How sure a label from the network is, and why: with what spoke for it where that was weighed."""
    found = piping.recovered.get(part)
    if found is None:
        return sure, why
    return found.sure, f"{why}: {'; '.join(found.reasons)}"


def _says(label: Label | None, groups: Sequence[str] | frozenset[str] | set[str]) -> bool:
    return label is not None and label.group in groups


def _may_change(piping: Piping, beliefs: Beliefs, part: int) -> bool:
    """Whether nobody but the labeler says what a part is, or labels are doubtful and no person has corrected it."""
    label = piping.given.labels[part]
    if label is not None and label.source in USERS:
        return False
    return bool(beliefs.open[part]) or piping.roles.doubtful


def _connector(piping: Piping, beliefs: Beliefs, part: int) -> tuple[str, str | None]:
    """The group and name of a part that a line runs through."""
    group, name = _likeliest(beliefs, part, sorted(piping.given.vocabulary.connector_groups))
    line = piping.lines.get(part)
    held = piping.given.vocabulary.groups[group].names
    if line is not None and is_plain_tube(line):
        by_shape = "pipe" if is_straight(line) else "elbow"
        return group, by_shape if by_shape in held else name
    return group, name


def _likeliest(beliefs: Beliefs, part: int, groups: Sequence[str]) -> tuple[str, str | None]:
    """Of some groups the likeliest one, and a name in it where one is likelier than all others together."""
    share = dict.fromkeys(groups, 0.0)
    said = [(float(beliefs.values[part, k]), g, n) for k, (g, n) in enumerate(beliefs.classes) if g in share]
    for sure, group, _ in said:
        share[group] += sure
    best = max(groups, key=lambda group: (share[group], group))
    names = [(sure, name) for sure, group, name in said if group == best and name]
    sure, name = max(names, default=(0.0, None))
    return best, name if share[best] > 0 and sure >= _NAMED * share[best] else None


def _label(before: Label | None, group: str, name: str | None, sure: float, why: str) -> Label:
    evidence = NetworkEvidence(why=why, before=FormerLabel.of(before))
    return Label(group, name, round(sure, 6), "network", evidence)
