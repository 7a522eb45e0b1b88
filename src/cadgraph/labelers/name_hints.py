"""Names in the source as evidence, for those who ask for it: words that speak for a label.

Off by default: names are missing, wrong or in another language as often as not. A word never names a part by itself; it
raises a label that the labeler thinks possible, by a fixed factor of its odds.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from cadgraph.model.labels import FileEvidence, FormerLabel, GeometryEvidence, Guess, Label, NameHint
from cadgraph.model.parts import Parts
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["weigh_names", "words_of"]

# The odds of a label that a name speaks for are multiplied by this. Ours, a modest guess, not measured: the generated
# plants have meaningless names on purpose.
_ODDS = 6.0
_POSSIBLE = 0.05  # least probability by geometry alone
_SEGMENTS = 2  # of the path that are read: the mesh, and what it lies in
_LONGEST = 400  # characters of a segment that are read
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+")

# Words that mean a name of the built-in vocabulary; abbreviations as line lists and catalogues have them.
_SYNONYMS = {
    "handrad": "handwheel", "wheel": "handwheel", "handle": "lever", "ell": "elbow", "bend": "elbow", "flg": "flange",
    "vlv": "valve", "gskt": "gasket", "mtr": "motor", "vessel": "tank", "bonnet": "valve bonnet", "stem": "valve stem",
    "dial": "gauge face", "needle": "gauge needle", "casing": "pump casing", "cap": "pipe cap", "hanger": "pipe hanger",
    "gusset": "gusset plate", "tray": "cable tray", "tube": "pipe", "head": "dished head",
}  # fmt: skip


def words_of(path: str) -> tuple[str, ...]:
    """The lower-case words in the last segments of a path: ``/plant/GateValve_012/hand-wheel`` gives gate, valve..."""
    segments = [segment for segment in path.split("/") if segment][-_SEGMENTS:]
    return tuple(word.lower() for segment in segments for word in _WORD.findall(segment[:_LONGEST]))


def weigh_names(answers: Sequence[Label | None], parts: Parts, vocabulary: Vocabulary) -> tuple[Label | None, ...]:
    """Raises the labels that the names of parts speak for.

    Args:
        answers: of the labeler, with their guesses.
        parts: their paths are those of their largest meshes.
        vocabulary: the labels to choose from.

    Returns:
        The answers, some with another confidence; the evidence holds the word and what the confidence was before. Where
        a name makes another of the guesses the label, its source is ``file``.
    """
    names = {name for group in vocabulary.groups.values() for name in group.names}
    paths = parts.scene.paths
    return tuple(
        _weighed(answer, _meant(words_of(path), names)) if answer is not None else None
        for answer, path in zip(answers, paths, strict=True)
    )


def _meant(words: Sequence[str], names: set[str]) -> dict[str, str]:
    """The names of the vocabulary that words speak for, with these words."""
    meant: dict[str, str] = {}
    singular = [word[:-1] if word.endswith("s") and len(word) > 3 else word for word in words]
    for spelt in (words, singular):
        text = f" {' '.join(spelt)} "
        for name in names:
            if f" {name} " in text or (" " not in name and f" {name} " in text.replace(" hand wheel ", " handwheel ")):
                meant.setdefault(name, name)
        for word in spelt:
            name = _SYNONYMS.get(word, "")
            if name in names:
                meant.setdefault(name, word)
    # 'valve body' says more than 'valve'.
    return {name: word for name, word in meant.items() if not any(name != m and name in m.split() for m in meant)}


def _weighed(answer: Label, meant: dict[str, str]) -> Label:
    if answer.source == "file" or (isinstance(answer.evidence, GeometryEvidence) and answer.evidence.name):
        return answer
    guesses = answer.guesses or (Guess(answer.group, answer.name, answer.confidence),)
    spoken = [g for g in guesses if g.name in meant and g.confidence >= _POSSIBLE]
    if not spoken:
        return answer
    best = spoken[0]
    odds = _ODDS * best.confidence / max(1.0 - best.confidence, 1e-9)
    raised = odds / (1.0 + odds)
    others = (1.0 - raised) / max(1.0 - best.confidence, 1e-9)
    weighed = [
        g.model_copy(update={"confidence": raised if g is best else round(g.confidence * others, 4)}) for g in guesses
    ]  # fmt: skip
    weighed.sort(key=lambda g: -g.confidence)
    top = weighed[0]
    hint = NameHint(word=meant[str(best.name)], speaks_for=str(best.name), without=round(best.confidence, 4))
    evidence = answer.evidence.model_copy(update={"name": hint})
    if top.said != best.said:
        return answer.model_copy(update={"evidence": evidence, "guesses": tuple(weighed)})
    if top.said != answer.said:
        word = FileEvidence(
            why=f"named {hint.word!r} in the source, which geometry holds for possible ({hint.without:.0%})",
            key="name",
            text=hint.word,
            before=FormerLabel.of(answer),
        )
        return Label(*top.said, raised, "file", word, tuple(weighed))
    return answer.model_copy(
        update={"confidence": max(raised, answer.confidence), "evidence": evidence, "guesses": tuple(weighed)}
    )
