"""What the file calls units, and of which kind it says they are, for those who ask for it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from cadgraph._io.text import natural_key
from cadgraph.facts.rules import Claim
from cadgraph.facts.statements import Statements, UnitStatement, usable_tag
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Label
from cadgraph.model.names import loose_tag
from cadgraph.model.parts import Network, Parts, UnitParts
from cadgraph.model.vocabulary import Vocabulary, spell_label

__all__ = ["Named", "name_as_stated", "renumbered", "tag_as_stated"]

_SURE = 0.75  # a claim that is trusted so much replaces the kind that geometry finds; others fill gaps
_NO_PLACE = 99  # of a name that its group doesn't have
# What a valve is for is no other kind than how it is made: these say more only where nothing else is known.
_PURPOSES = frozenset(
    {
        "isolating valve",
        "regulating valve",
        "commissioning valve",
        "safety cutoff valve",
        "changeover valve",
        "stopcock",
    }
)


@dataclass(frozen=True, eq=False)
class Named:
    """Units with the plant's own tags.

    Args:
        units: by tag.
        statements: what the file says of each.
        diagnostics: of tags that can't be used.
    """

    units: tuple[UnitParts, ...]
    statements: tuple[UnitStatement, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()


def tag_as_stated(
    units: Sequence[UnitParts],
    stated: Statements | None,
    parts: Parts,
    labels: Sequence[Label | None],
    vocabulary: Vocabulary,
) -> Named:
    """Gives units the tags that the file has for them; those without one keep their numbers.

    Args:
        units: with their numbers.
        stated: what the file says; None changes nothing.
        parts: of the scene.
        labels: of each part.
        vocabulary: the tree that they are from; the first names of a group stand for the whole of a unit.
    """
    if stated is None:
        return Named(tuple(units))
    said = stated.of_units(_by_rank(units, parts, labels, vocabulary))
    wanted = [next((tag for value in one.tags if (tag := usable_tag(value))), None) for one in said]
    renamed = renumbered(units, _claimed_once(wanted))
    order = sorted(range(len(units)), key=lambda k: natural_key(renamed[k]))
    return Named(
        tuple(replace(units[k], tag=renamed[k]) for k in order),
        tuple(said[k] for k in order),
        tuple(_tag_notes(units, said, wanted, parts)),
    )


def _claimed_once(wanted: Sequence[str | None]) -> list[str | None]:
    """The tags that no other unit claims, however it spells them."""
    claimed = Counter(loose_tag(tag) for tag in wanted if tag)
    return [tag if tag and claimed[loose_tag(tag)] == 1 else None for tag in wanted]


def _by_rank(
    units: Sequence[UnitParts], parts: Parts, labels: Sequence[Label | None], vocabulary: Vocabulary
) -> list[list[int]]:
    """The parts of each unit, those that stand for the whole first: by their names, then by their surfaces."""
    groups = vocabulary.groups.items()
    places = {(group, name): k for group, content in groups for k, name in enumerate(content.names)}
    areas = parts.properties.area

    def rank(part: int) -> tuple[int, float, int]:
        label = labels[part]
        place = _NO_PLACE if label is None or label.name is None else places.get((label.group, label.name), _NO_PLACE)
        return place, -float(areas[part]), part

    return [sorted(unit.parts, key=rank) for unit in units]


def renumbered(units: Sequence[UnitParts], tags: Sequence[str | None]) -> list[str]:
    """The given tags; for units without one the tags that they have, or where these are taken the next free numbers.

    Args:
        units: with a tag each.
        tags: another one for some.
    """
    taken = {loose_tag(tag) for tag in tags if tag}
    numbers = {loose_tag(unit.tag) for unit in units}
    found = []
    for unit, tag in zip(units, tags, strict=True):
        own = tag or unit.tag
        if not tag and loose_tag(own) in taken:
            letter = own.rpartition("-")[0]
            own = next(
                new for k in range(1, 2 * len(units) + 2) if _is_free(new := f"{letter}-{k:03d}", taken, numbers)
            )
            taken.add(loose_tag(own))
        found.append(own)
    return found


def _is_free(tag: str, taken: set[str], numbers: set[str]) -> bool:
    return loose_tag(tag) not in taken and loose_tag(tag) not in numbers


def _tag_notes(
    units: Sequence[UnitParts],
    said: Sequence[UnitStatement],
    wanted: Sequence[str | None],
    parts: Parts,
) -> Iterator[Diagnostic]:
    twice: dict[str, list[int]] = {}
    unusable = []
    for number, (tag, one) in enumerate(zip(wanted, said, strict=True)):
        if tag:
            twice.setdefault(loose_tag(tag), []).append(number)
        if one.tags and not tag:
            unusable.append(number)
    for numbers in (numbers for numbers in twice.values() if len(numbers) > 1):
        message = f"{len(numbers)} units that the file calls {wanted[numbers[0]]}; they keep their numbers"
        yield Diagnostic("tag-twice", message, _heads(units, numbers, parts))
    if unusable:
        example = said[unusable[0]].tags[0][:40]
        message = (
            f"{len(unusable)} units whose tags in the file are no tags here ({example!r}); they keep their numbers"
        )
        yield Diagnostic("tag-unusable", message, _heads(units, unusable, parts))


def _heads(units: Sequence[UnitParts], numbers: Sequence[int], parts: Parts) -> tuple[str, ...]:
    return tuple(parts.scene.paths[units[number].parts[0]] for number in numbers)


def name_as_stated(
    network: Network, named: Named, parts: Parts, vocabulary: Vocabulary
) -> tuple[Network, tuple[Diagnostic, ...]]:
    """Says of each unit the kind that the file says, where that is trusted more than geometry, or alone knows one.

    Args:
        network: with the kinds that geometry finds.
        named: what the file says of its units.
        parts: of the scene.
        vocabulary: which groups form which units.

    Returns:
        The network, and what the file says otherwise than geometry.
    """
    if not named.statements:
        return network, ()
    units, notes = [], []
    for unit, said in zip(network.units, named.statements, strict=True):
        claim = _kind_of(unit, said, vocabulary)
        fills = claim is not None and (claim.trust < _SURE or claim.kind in _PURPOSES)
        if claim is not None and not (fills and unit.kind):
            notes += [_other_kind(unit, claim, parts)] if unit.kind not in (None, claim.kind, unit.unit_type) else []
            unit = replace(unit, kind=claim.kind, kind_guesses=())
        other = _other_type(unit, said, vocabulary)
        notes += [_other_unit(unit, other, parts)] if other is not None else []
        units.append(unit)
    return replace(network, units=tuple(units)), tuple(notes)


def _kind_of(unit: UnitParts, said: UnitStatement, vocabulary: Vocabulary) -> Claim | None:
    """The most trusted claim that names a kind of this type of unit."""
    unit_of = vocabulary.unit_of_group
    own = [c for c in (*said.claims, *said.part_claims) if c.kind and unit_of.get(c.group) == unit.unit_type]
    return max(own, key=lambda claim: claim.trust, default=None)


def _other_type(unit: UnitParts, said: UnitStatement, vocabulary: Vocabulary) -> Claim | None:
    """What the file says the unit to be, where that is a unit of another type."""
    claims = sorted((c for c in said.claims if not c.is_prior), key=lambda claim: -claim.trust)
    if not claims or vocabulary.unit_of_group.get(claims[0].group, unit.unit_type) == unit.unit_type:
        return None
    return claims[0]


def _other_kind(unit: UnitParts, claim: Claim, parts: Parts) -> Diagnostic:
    message = f"{unit.tag} is a {claim.kind} by the file ({claim.rule}), which counts, and a {unit.kind} by geometry"
    return Diagnostic("file-disagrees", message, (parts.scene.paths[unit.parts[0]],))


def _other_unit(unit: UnitParts, claim: Claim, parts: Parts) -> Diagnostic:
    message = (
        f"{unit.tag} is {spell_label(*claim.said)} by the file ({claim.rule}), and a {unit.unit_type} by its parts, "
        "which count; correct one of them (cadgraph relabel) if they are wrong"
    )
    return Diagnostic("file-disagrees", message, (parts.scene.paths[unit.parts[0]],))
