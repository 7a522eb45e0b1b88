"""What a file says of each part and each unit of an analysed scene: its facts and names, read as claims."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from cadgraph.facts.places import NodeFacts, Places
from cadgraph.facts.rules import Claim, claims_of, path_name, strongest
from cadgraph.facts.words import Words
from cadgraph.model.analysis import Analysis
from cadgraph.model.derived import kept_with
from cadgraph.model.facts import Fact
from cadgraph.model.names import loose_tag
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["Statements", "UnitStatement", "places_of", "statements_of", "usable_tag"]

_MOST = 0.5  # share of a unit's meshes from which on what is said of a node is said of the unit
_TAG = re.compile(r"[A-Za-z0-9](?:[A-Za-z0-9._+-]{0,38}[A-Za-z0-9])?")
_NO_TAG = re.compile(r"(part|cluster|junction|terminal|system|site|shape)\d*|unit.*")


@dataclass(frozen=True)
class UnitStatement:
    """What a file says of a unit.

    Args:
        tags: that the plant may call it by, the likeliest first, as they stand in the file.
        claims: of nodes that hold most of it.
        part_claims: of its parts.
    """

    tags: tuple[str, ...]
    claims: tuple[Claim, ...]
    part_claims: tuple[Claim, ...]


@kept_with
def places_of(analysis: Analysis) -> Places:
    """The facts of a scene by where they stand.

    Args:
        analysis: of the scene.
    """
    heads = [meshes[0] for meshes in analysis.parts.meshes]
    return Places(analysis.scene.paths, analysis.parts.part_of_mesh.tolist(), heads, analysis.scene.facts)


class Statements:
    """What a file says of the parts of a scene.

    Args:
        analysis: of the scene.
        words: what words mean.
        vocabulary: the labels in use; what speaks for another one is left out, and listed.
    """

    def __init__(self, analysis: Analysis, words: Words, vocabulary: Vocabulary) -> None:
        # Not the analysis itself: statements are kept as long as that lives.
        self._paths, self._meshes = analysis.scene.paths, analysis.parts.meshes
        self._words, self._vocabulary = words, vocabulary
        self._places = places_of(analysis)

    @cached_property
    def of_parts(self) -> tuple[tuple[Claim, ...], ...]:
        """Of each part the most trusted claim of each family that the vocabulary holds, the most trusted first."""
        return tuple(tuple(strongest(c for c in claims if self._holds(c))) for claims in self._all)

    @cached_property
    def unheld(self) -> dict[tuple[str, str | None], tuple[str, ...]]:
        """The labels that claims speak for and the vocabulary lacks, with the largest meshes of their parts."""
        found: dict[tuple[str, str | None], list[str]] = {}
        for part, claims in enumerate(self._all):
            for said in sorted({c.said for c in claims if not self._holds(c)}, key=str):
                found.setdefault(said, []).append(self._paths[self._meshes[part][0]])
        return {said: tuple(found[said]) for said in sorted(found, key=str)}

    @cached_property
    def _all(self) -> list[list[Claim]]:
        return [self._claims_of_part(part) for part in range(len(self._meshes))]

    def _claims_of_part(self, part: int) -> list[Claim]:
        found: list[Claim] = []
        for _, facts, name in self._places.nodes_of_part(part):
            named = [*facts, path_name(name)] if name else facts
            found += self._claims(named)
        return found

    def _claims(self, facts: Sequence[Fact]) -> list[Claim]:
        claims = (claim for _, claim in claims_of(facts, self._words, self._vocabulary))
        return [claim for claim in claims if claim is not None]

    def _holds(self, claim: Claim) -> bool:
        return self._vocabulary.holds(*claim.said)

    def of_units(self, units: Sequence[Sequence[int]]) -> tuple[UnitStatement, ...]:
        """What is said of units.

        Args:
            units: parts of each, those that stand for the whole first.
        """
        nodes = self._places.of_units(units)
        return tuple(self._of_unit(parts, above) for parts, above in zip(units, nodes, strict=True))

    def _of_unit(self, parts: Sequence[int], above: Sequence[NodeFacts]) -> UnitStatement:
        whole = [fact for node in above if node.covers > _MOST for fact in node.facts]
        named = [path_name(node.path.rsplit("/", 1)[-1]) for node in above if node.covers > _MOST]
        own = [fact for part in parts for fact in self._places.of_part(part)]
        tags = [fact.value for fact in (*whole, *own) if fact.key == "tag"]
        return UnitStatement(
            tuple(dict.fromkeys(tags)),
            tuple(claim for claim in self._claims([*whole, *named]) if self._holds(claim)),
            tuple(claim for part in parts for claim in self.of_parts[part]),
        )


@kept_with
def statements_of(analysis: Analysis, words: Words, vocabulary: Vocabulary) -> Statements:
    """What a file says of the parts of a scene, worked out once for labels and relations, and for all corrections.

    Args:
        analysis: of the scene.
        words: what words mean.
        vocabulary: the labels in use.
    """
    return Statements(analysis, words, vocabulary)


def usable_tag(value: str) -> str | None:
    """What the plant calls something, as a tag here; None where it can't be one.

    A tag has letters and digits, at most 40 of them with ``. _ + -``; spaces and slashes become hyphens. The ids that
    graphs give are none.

    Args:
        value: as it stands in the file; ``/P-101`` is how PDMS writes names.
    """
    tag = re.sub(r"[\s/]+", "-", value.strip().lstrip("/").strip())
    if not _TAG.fullmatch(tag) or not any(c.isdigit() for c in tag) or not any(c.isalpha() for c in tag):
        return None
    return None if _NO_TAG.fullmatch(loose_tag(tag)) else tag
