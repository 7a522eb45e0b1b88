"""Every fact of a scene with the claim that it makes, and what matched nothing: how a list of words is looked after."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from cadgraph.facts.rules import SPEAKING, Claim, claims_of, path_name
from cadgraph.facts.words import Words
from cadgraph.model.facts import Fact
from cadgraph.model.vocabulary import Vocabulary, spell_label

__all__ = ["FactRow", "list_facts"]


@dataclass(frozen=True)
class FactRow:
    """All facts of one key and value that make the same claim.

    Args:
        key: of the facts.
        value: of the facts.
        count: how many there are.
        label: ``group/name`` that they speak for; None where they speak for none.
        kind: of the unit, where they say that.
        trust: of the claim, 0..1; None where there is none.
        rule: by which it is read, or why there is none.
        matched: whether a rule was found; True, too, for keys that say where a part belongs and not what it is.
    """

    key: str
    value: str
    count: int
    label: str | None
    kind: str | None
    trust: float | None
    rule: str
    matched: bool

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return asdict(self)


def list_facts(
    paths: Sequence[str], facts: Sequence[Fact], words: Words, vocabulary: Vocabulary
) -> tuple[FactRow, ...]:
    """Every key and value of a scene's facts, and the names of its meshes, with the claims that they make.

    Args:
        paths: source path of each mesh; its last step is its name.
        facts: of the scene.
        words: what words mean.
        vocabulary: the labels in use.

    Returns:
        What matched first, the most frequent first; then what matched nothing, likewise.
    """
    at: dict[str, list[Fact]] = {}
    for fact in facts:
        at.setdefault(fact.path, []).append(fact)
    counts: Counter[tuple[str, str, Claim | None]] = Counter()
    for told in at.values():
        counts.update((f.key, f.value, _plain(claim)) for f, claim in claims_of(told, words, vocabulary))
    names = Counter(path.rsplit("/", 1)[-1] for path in paths)
    for name, count in names.items():
        ((fact, claim),) = claims_of([path_name(name)], words, vocabulary)
        counts[fact.key, name, _plain(claim)] += count
    rows = [_row(key, value, claim, count, vocabulary) for (key, value, claim), count in counts.items()]
    return tuple(sorted(rows, key=lambda row: (not row.matched, -row.count, row.key, row.value, row.label or "")))


def _plain(claim: Claim | None) -> Claim | None:
    return None if claim is None else claim._replace(value="")


def _row(key: str, value: str, claim: Claim | None, count: int, vocabulary: Vocabulary) -> FactRow:
    if claim is None:
        speaks = key in SPEAKING
        rule = "matches nothing" if speaks else "kept; says where it belongs, not what it is"
        return FactRow(key, value, count, None, None, None, rule, not speaks)
    held = vocabulary.holds(*claim.said)
    rule = claim.rule if held else f"{claim.rule}; left out, as the vocabulary lacks the label"
    return FactRow(key, value, count, spell_label(*claim.said), claim.kind, claim.trust, rule, True)
