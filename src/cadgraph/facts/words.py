"""Words in names and types, in ten languages, and the labels that they mean."""

from __future__ import annotations

import functools
import re
import reprlib
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

from cadgraph._io.limits import WORDS, read_text_within
from cadgraph._io.strict_yaml import parse_yaml
from cadgraph.errors import LabelError

__all__ = ["Meaning", "Spoken", "Words", "fold", "read_words", "words_of"]

_LONGEST, _MOST_WORDS = 400, 32  # characters and words of a text that are read
_LONGEST_PHRASE, _MOST_PHRASES = 80, 100_000
_KEYS = ("version", "labels", "stop", "cut", "drop")
_WORD = re.compile(r"[^\W\d_]+")
_LETTERS = {"ø": "o", "ł": "l", "æ": "ae", "œ": "oe", "đ": "d", "ð": "d", "þ": "th", "ı": "i"}
_REMEDY = "give a YAML list of words laid out like the built-in one (facts/words.yaml)"


class Meaning(NamedTuple):
    """What a phrase means.

    Args:
        group: of the vocabulary.
        name: in that group; None where the group alone is meant.
        kind: of the unit, where it says that, too: ``"check valve"``.
    """

    group: str
    name: str | None
    kind: str | None = None


class Spoken(NamedTuple):
    """A phrase that was found in a text.

    Args:
        meaning: of the phrase.
        phrase: as it stands in the list, folded.
        language: that it is listed under.
    """

    meaning: Meaning
    phrase: str
    language: str


class _Phrase(NamedTuple):
    """A phrase of the list; a meaning of None is that of a word that means nothing here."""

    words: tuple[str, ...]
    meaning: Meaning | None
    language: str

    @property
    def weight(self) -> int:
        """How many letters it asks for."""
        return sum(len(word.strip("*")) for word in self.words)

    @property
    def text(self) -> str:
        """As it stands in the list."""
        return " ".join(self.words)


def fold(text: str) -> str:
    """A text without capitals and accents; ``ß`` is ss, ``ø`` is o."""
    plain = unicodedata.normalize("NFKD", text.casefold())
    return "".join(_LETTERS.get(letter, letter) for letter in plain if not unicodedata.combining(letter))


def words_of(text: str) -> tuple[str, ...]:
    """The folded words of a text, digits and signs left out: ``GateValve_012`` gives gate, valve; at most 32."""
    # Composed, so that an accent is no end of a word.
    whole = _WORD.findall(unicodedata.normalize("NFKC", text[:_LONGEST]))
    return tuple(fold(word) for run in whole for word in _at_capitals(run))[:_MOST_WORDS]


def _at_capitals(run: str) -> Iterator[str]:
    """The words of a run of letters: one begins with a capital after a small letter, or before one."""
    start = 0
    for k in range(1, len(run)):
        after_small = run[k].isupper() and run[k - 1].islower()
        before_small = run[k].isupper() and run[k - 1].isupper() and run[k + 1 : k + 2].islower()
        # The s of a plural begins no word: PSVs.
        if after_small or (before_small and run[k + 1 :] != "s"):
            yield run[start:k]
            start = k
    yield run[start:]


class Words:
    """A list of phrases, and what a text says by them.

    Args:
        phrases: of equal ones the first counts.
        cut: words after which a text names something else.
    """

    def __init__(self, phrases: Iterable[_Phrase], cut: Iterable[str] = ()) -> None:
        listed: dict[tuple[str, ...], _Phrase] = {}
        for phrase in phrases:
            listed.setdefault(phrase.words, phrase)
        self.n_phrases = len(listed)
        self._cut = frozenset(cut)
        self._by_first: dict[str, list[_Phrase]] = {}
        for phrase in listed.values():
            self._by_first.setdefault(phrase.words[0], []).append(phrase)
        patterns = {pattern for words in listed for pattern in words}
        self._plain = frozenset(pattern for pattern in patterns if "*" not in pattern)
        self._starred = sorted(patterns - self._plain)
        # Of a scene with a hundred thousand names only the numbers differ mostly.
        self._patterns_of = functools.lru_cache(maxsize=100_000)(self._find_patterns)
        self._spoken_by = functools.lru_cache(maxsize=100_000)(self._find_spoken)

    def read(self, text: str) -> Spoken | None:
        """What a text means: its longest phrase, of equally long ones the last; None where no phrase is known.

        Args:
            text: a name, a type, a description; the first 400 characters count.
        """
        return self._spoken_by(words_of(text))

    def _find_spoken(self, words: tuple[str, ...]) -> Spoken | None:
        heads = next((k for k, word in enumerate(words) if k and word in self._cut), len(words))
        found = list(self._found_in(words[:heads]))
        silent = {k for at, phrase in found if phrase.meaning is None for k in range(at, at + len(phrase.words))}
        speaking = [
            (phrase.weight, at + len(phrase.words), phrase)
            for at, phrase in found
            if phrase.meaning is not None and silent.isdisjoint(range(at, at + len(phrase.words)))
        ]
        if not speaking:
            return None
        phrase = max(speaking, key=lambda one: (one[0], one[1], one[2].words))[2]
        return Spoken(phrase.meaning or Meaning("", None), phrase.text, phrase.language)

    def _found_in(self, words: Sequence[str]) -> Iterator[tuple[int, _Phrase]]:
        """Every phrase of the list with the place where it begins."""
        patterns = [self._patterns_of(word) for word in words]
        for at, first in enumerate(patterns):
            for pattern in sorted(first):
                for phrase in self._by_first.get(pattern, ()):
                    rest = patterns[at : at + len(phrase.words)]
                    if len(rest) == len(phrase.words) and all(p in r for p, r in zip(phrase.words, rest, strict=True)):
                        yield at, phrase

    def _find_patterns(self, word: str) -> frozenset[str]:
        """The patterns that a word follows, in the singular or as it stands."""
        single = word[:-1] if word.endswith("s") and len(word) > 3 else word
        plain = {each for each in (word, single) if each in self._plain}
        return frozenset(plain | {pattern for pattern in self._starred if _follows(word, pattern)})


def _follows(word: str, pattern: str) -> bool:
    core = pattern.strip("*")
    if pattern.startswith("*") and pattern.endswith("*"):
        return core in word
    return word.endswith(core) if pattern.startswith("*") else word.startswith(core)


@functools.cache
def _built_in() -> tuple[tuple[_Phrase, ...], frozenset[str]]:
    text = resources.files("cadgraph.facts").joinpath("words.yaml").read_text(encoding="utf-8")
    phrases, cut, _ = _parsed(parse_yaml(text, "the built-in words", LabelError), "the built-in words")
    return phrases, cut


@functools.cache
def _built_in_words() -> Words:
    return Words(*_built_in())


def read_words(path: str | Path = "") -> Words:
    """The built-in list, and a user's over it.

    Args:
        path: of the user's list, a YAML file; none: the built-in one alone.

    Raises:
        LabelError: the file can't be read or is malformed; the message names the place in it.
    """
    if not str(path):
        return _built_in_words()
    where = str(path)
    phrases, cut, dropped = _parsed(
        parse_yaml(read_text_within(path, WORDS, LabelError, _REMEDY), where, LabelError), where
    )
    known, known_cut = _built_in()
    unknown = dropped - {phrase.words for phrase in known}
    if unknown:
        raise LabelError(f"{where}: drop: {' '.join(min(unknown))!r} isn't in the built-in list; remove it")
    return Words([*phrases, *(phrase for phrase in known if phrase.words not in dropped)], known_cut | cut)


_Parsed = tuple[tuple[_Phrase, ...], frozenset[str], frozenset[tuple[str, ...]]]


def _parsed(content: Any, where: str) -> _Parsed:
    """The phrases of a list, the words that cut, and the phrases that it drops."""
    if not isinstance(content, Mapping):
        raise LabelError(f"{where}: not a mapping; {_REMEDY}")
    for key in content:
        if key not in _KEYS:
            raise LabelError(f"{where}: unknown key {reprlib.repr(key)}; known are {', '.join(_KEYS)}")
    labels = content.get("labels") or {}
    if not isinstance(labels, Mapping):
        raise LabelError(f"{where}: labels: give 'group/name: {{language: [words]}}'")
    phrases = [_Phrase(words, None, language) for language, words in _listed(content.get("stop"), f"{where}: stop")]
    for label, lists in labels.items():
        meaning = _meaning(label, where)
        phrases += [_Phrase(words, meaning, lang) for lang, words in _listed(lists, f"{where}: {label}")]
    cut = [words for _, words in _listed(content.get("cut"), f"{where}: cut")]
    if any(len(words) > 1 or "*" in words[0] for words in cut):
        raise LabelError(f"{where}: cut: give single words without stars")
    dropped = frozenset(words for _, words in _listed(content.get("drop"), f"{where}: drop"))
    if len(phrases) > _MOST_PHRASES:
        raise LabelError(f"{where}: {len(phrases):,} phrases, and at most {_MOST_PHRASES:,} are read; leave some out")
    return tuple(phrases), frozenset(words[0] for words in cut), dropped


def _meaning(label: Any, where: str) -> Meaning:
    steps = [step.strip() for step in label.split("/")] if isinstance(label, str) else []
    if not 1 <= len(steps) <= 3 or not all(0 < len(step) <= _LONGEST_PHRASE for step in steps):
        raise LabelError(f"{where}: {reprlib.repr(label)} is no label; give 'group', 'group/name' or 'group/name/kind'")
    group, name, kind = (*steps, None, None)[:3]
    return Meaning(group or "", name, kind)


def _listed(lists: Any, where: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Language and words of each phrase of ``{language: [phrases]}``."""
    if lists is None:
        return
    if not isinstance(lists, Mapping):
        raise LabelError(f"{where}: give words by language, as 'en: [valve]'")
    for language, phrases in lists.items():
        if not isinstance(language, str):
            raise LabelError(f"{where}: language {language!r} is no text; put it in quotes ('no' in YAML means false)")
        if not isinstance(phrases, list):
            raise LabelError(f"{where}: {reprlib.repr(language)}: give a list of words, as [valve, vlv]")
        for phrase in phrases:
            yield language, _split(phrase, f"{where}: {reprlib.repr(language)}")


def _split(phrase: Any, where: str) -> tuple[str, ...]:
    """The patterns of a phrase."""
    shown = reprlib.repr(phrase)
    if not isinstance(phrase, str):
        raise LabelError(f"{where}: {shown} is no text; put it in quotes")
    words = tuple(fold(phrase).split())
    if not words or len(phrase) > _LONGEST_PHRASE:
        raise LabelError(f"{where}: {shown} is empty or longer than {_LONGEST_PHRASE} characters")
    for word in words:
        core = word.removeprefix("*").removesuffix("*")
        if not _WORD.fullmatch(core):
            raise LabelError(f"{where}: {shown} may hold letters and spaces, and a star where a word begins or ends")
    return words
