"""Making one label of several spellings: capitals, hyphens, plurals, synonyms."""

from __future__ import annotations

import functools
import re
import unicodedata
from importlib import resources

import yaml

from cadgraph._io.text import printable
from cadgraph.model.vocabulary import Vocabulary

__all__ = ["clean_label", "fold_group", "fold_name", "normalized"]

MAX_LABEL = 60
"""Characters of a label that somebody proposes; longer is a sentence."""

_FORBIDDEN = re.compile(r"[:;,&|!<>{}\[\]\"'`\\/]")
_SPACES = re.compile(r"[\s_\-]+")
_KEEP_S = ("ss", "us", "is", "as", "os")


def clean_label(text: str, *, lower: bool = True) -> str | None:
    """A proposed label as the vocabulary could hold it; None where nothing usable is left.

    Args:
        text: anything.
        lower: whether it is a name; groups keep their capitals.
    """
    plain = printable(unicodedata.normalize("NFKC", text[: 4 * MAX_LABEL]))
    plain = " ".join(_FORBIDDEN.sub(" ", plain).replace("_", " ").split())
    if not plain or len(plain) > MAX_LABEL or not any(c.isalpha() for c in plain):
        return None
    return plain.lower() if lower else plain[0].upper() + plain[1:]


def normalized(text: str) -> str:
    """What equal labels have in common: lower case, one space for hyphens, the last word in the singular."""
    words = _SPACES.sub(" ", unicodedata.normalize("NFKC", text).casefold()).strip().split(" ")
    # Once more until nothing changes, so that what was folded folds to itself.
    while (single := _singular(words[-1])) != words[-1]:
        words[-1] = single
    return " ".join(words)


def fold_group(text: str, vocabulary: Vocabulary) -> str | None:
    """The group of the vocabulary that is meant, or None."""
    if text in vocabulary.groups:
        return text
    wanted = normalized(text)
    return next((group for group in vocabulary.groups if normalized(group) == wanted), None)


def fold_name(text: str, vocabulary: Vocabulary, group: str | None = None) -> tuple[str, str] | None:
    """The (group, name) of the vocabulary that is meant, or None.

    Args:
        text: as proposed.
        vocabulary: the tree.
        group: that it should be in; if None, any, as long as there is only one.
    """
    wanted = {normalized(text)}
    wanted |= {normalized(synonym) for synonym in [_synonyms().get(normalized(text))] if synonym}
    joined = {word.replace(" ", "") for word in wanted}
    groups = [group] if group is not None else list(vocabulary.groups)
    found = [
        (each, name)
        for each in groups
        if each in vocabulary.groups
        for name in vocabulary.groups[each].names
        if normalized(name) in wanted or normalized(name).replace(" ", "") in joined
    ]
    return found[0] if len(found) == 1 or (found and group is not None) else None


def _singular(word: str) -> str:
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if len(word) > 4 and word.endswith(("ches", "shes", "xes", "sses", "zes")):
        return word[:-2]
    if len(word) > 3 and word.endswith("s") and not word.endswith(_KEEP_S):
        return word[:-1]
    return word


@functools.cache
def _synonyms() -> dict[str, str]:
    text = resources.files("cadgraph.labelers.lvlm").joinpath("synonyms.yaml").read_text(encoding="utf-8")
    return {normalized(str(key)): str(value) for key, value in yaml.safe_load(text).items()}
