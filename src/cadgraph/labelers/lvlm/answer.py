"""What a model answers, checked: a schema for the server, limits and a reading of our own for whatever comes back."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator

from cadgraph._io.text import printable
from cadgraph.labelers.lvlm.normalize import MAX_LABEL, clean_label, fold_group, fold_name
from cadgraph.model.vocabulary import Vocabulary

__all__ = [
    "Answer",
    "GrowthAnswer",
    "Malformed",
    "Proposal",
    "Verdict",
    "answer_schema",
    "growth_schema",
    "plain_words",
    "read",
    "settle",
]

MAX_ANSWER = 20_000
"""Characters of an answer; a useful one has some 400."""

_MAX_WORDS = 300  # characters kept of what was seen, and of a reason
_MAX_ADDITIONS = 200
_OTHER_GROUP = 0.6  # a name of another group than the one that is said: one of the two is wrong

_Model = TypeVar("_Model", bound=BaseModel)


class Malformed(ValueError):
    """An answer that can't be used; its text says why, in words that may go back to the model."""


class _Data(BaseModel):
    model_config = ConfigDict(frozen=True, extra="ignore", allow_inf_nan=False)


class Answer(_Data):
    """What a model says a part is."""

    seen: str = Field(default="", description="what the pictures show, at most 25 words")
    group: str = Field(description="one of the groups in the list", max_length=4 * MAX_LABEL)
    name: str = Field(description="a name in that group", max_length=4 * MAX_LABEL)
    propose_group: str | None = Field(default=None, description="group of a better label, or null")
    propose_name: str | None = Field(default=None, description="name of a better label, or null")
    reason: str | None = Field(default=None, description="why a new label is needed, or null")
    confidence: float = Field(default=0.5, description="0 to 1", ge=0, le=1)

    @field_validator("seen", "reason", mode="before")
    @classmethod
    def _cut(cls, value: Any) -> Any:
        return plain_words(value) if isinstance(value, str) else value

    @field_validator("confidence", mode="before")
    @classmethod
    def _share(cls, value: Any) -> Any:
        # Some models answer in per cent.
        return value / 100 if isinstance(value, int | float) and 1 < value <= 100 else value


class Addition(_Data):
    """A label that is missing, as a model says."""

    group: str = Field(max_length=4 * MAX_LABEL)
    name: str = Field(max_length=4 * MAX_LABEL)
    reason: str = ""

    @field_validator("reason", mode="before")
    @classmethod
    def _cut(cls, value: Any) -> Any:
        return plain_words(value) if isinstance(value, str) else value


class GrowthAnswer(_Data):
    """Which labels are missing."""

    labels: tuple[Addition, ...] = Field(default=(), max_length=_MAX_ADDITIONS)


@dataclass(frozen=True)
class Proposal:
    """A label that the vocabulary doesn't hold.

    Args:
        group: of the vocabulary, or a new one.
        name: the new name, or None where only the group is new.
        reason: in the model's words.
    """

    group: str
    name: str | None
    reason: str = ""


@dataclass(frozen=True)
class Verdict:
    """An answer in the terms of the vocabulary.

    Args:
        group: of the vocabulary, or None where the answer names none.
        name: in that group, or None.
        confidence: 0..1.
        seen: in the model's words.
        proposal: of a label that the vocabulary doesn't hold, or None.
    """

    group: str | None
    name: str | None
    confidence: float
    seen: str = ""
    proposal: Proposal | None = None


def read(text: str | None, model: type[_Model]) -> _Model:
    """Reads the JSON object of an answer.

    Args:
        text: whatever came back; code fences and words round the object are passed over.
        model: what it must be.

    Raises:
        Malformed: it is empty, too long, no JSON, or not of that form.
    """
    if not text or not text.strip():
        raise Malformed("it was empty")
    if len(text) > MAX_ANSWER:
        raise Malformed(f"it was longer than {MAX_ANSWER} characters")
    first, last = text.find("{"), text.rfind("}")
    if first < 0 or last < first:
        raise Malformed("it held no JSON object")
    try:
        content = json.loads(text[first : last + 1], parse_constant=_refuse)
    except (ValueError, RecursionError):
        raise Malformed("it was not valid JSON") from None
    try:
        return model.model_validate(content)
    except ValidationError as error:
        wrong = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(str(step) for step in wrong["loc"])[:MAX_LABEL]
        raise Malformed(f"key {place!r}: {wrong['msg']}"[:200]) from None


def settle(answer: Answer, vocabulary: Vocabulary) -> Verdict:
    """Finds an answer's labels in the vocabulary; what isn't there becomes a proposal."""
    confidence = answer.confidence if math.isfinite(answer.confidence) else 0.0
    group = fold_group(answer.group, vocabulary)
    found = fold_name(answer.name, vocabulary, group) if group else None
    proposal = _proposal(answer, vocabulary, group, found)
    if group is None:
        elsewhere = fold_name(answer.name, vocabulary)
        if elsewhere is None:
            return Verdict(None, None, 0.0, answer.seen, proposal)
        return Verdict(elsewhere[0], elsewhere[1], confidence * _OTHER_GROUP, answer.seen, proposal)
    if found is None:
        known = fold_name(answer.name, vocabulary) is not None
        return Verdict(group, None, confidence * (_OTHER_GROUP if known else 1.0), answer.seen, proposal)
    return Verdict(group, found[1], confidence, answer.seen, proposal)


def _proposal(
    answer: Answer, vocabulary: Vocabulary, group: str | None, found: tuple[str, str] | None
) -> Proposal | None:
    proposed_group, proposed_name = answer.propose_group, answer.propose_name
    if not proposed_name:
        if found is not None or (group is None and fold_name(answer.name, vocabulary)):
            return None
        # A server that doesn't hold models to the schema: the label itself is new.
        proposed_group, proposed_name = proposed_group or answer.group, answer.name
    if fold_name(proposed_name, vocabulary) is not None:
        return None
    name = clean_label(proposed_name)
    wanted = proposed_group or answer.group
    place = fold_group(wanted, vocabulary) or clean_label(wanted, lower=False) or group
    if name is None or place is None:
        return None
    return Proposal(place, name, answer.reason or "")


def answer_schema(vocabulary: Vocabulary) -> dict[str, Any]:
    """The JSON schema of :class:`Answer`, groups and names held to the vocabulary."""
    schema = _strict(Answer.model_json_schema())
    names = list(dict.fromkeys(name for group in vocabulary.groups.values() for name in group.names))
    # Providers refuse schemas of more than some 500 values; then our own reading holds answers to the vocabulary.
    if vocabulary.groups and names and len(vocabulary.groups) + len(names) <= 450:
        schema["properties"]["group"]["enum"] = list(vocabulary.groups)
        schema["properties"]["name"]["enum"] = names
    return schema


def growth_schema() -> dict[str, Any]:
    """The JSON schema of :class:`GrowthAnswer`."""
    return _strict(GrowthAnswer.model_json_schema())


def _strict(schema: dict[str, Any]) -> dict[str, Any]:
    """As structured outputs want it: every key required, no others, none of the keywords that they don't know."""
    for unknown in ("default", "title", "maxLength", "minimum", "maximum", "maxItems"):
        schema.pop(unknown, None)
    if schema.get("type") == "object":
        schema["additionalProperties"] = False
        schema["required"] = list(schema.get("properties", {}))
    for inner in ("properties", "$defs"):
        for value in schema.get(inner, {}).values():
            _strict(value)
    if isinstance(schema.get("items"), dict):
        _strict(schema["items"])
    return schema


def plain_words(value: str) -> str:
    """A text of the model on one line, cut, without control characters: it goes to terminals and pages."""
    plain = printable(value[: 4 * _MAX_WORDS])
    return " ".join(plain.split())[:_MAX_WORDS]


def _refuse(constant: str) -> float:
    raise ValueError(constant)
