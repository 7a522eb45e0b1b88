"""What a part is, how sure that is, who says so, and what that rests on: in the stages and in the graph alike.

The kinds of evidence are told apart by the label's ``source``, which stands in ``graph.json`` beside them.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Literal

from pydantic import (
    Field,
    SerializeAsAny,
    ValidationError,
    ValidationInfo,
    field_validator,
)

from cadgraph.model.record import Record

__all__ = [
    "EVIDENCE",
    "CatalogEvidence",
    "CorrectedEvidence",
    "Evidence",
    "FileEvidence",
    "FileSupport",
    "FormerLabel",
    "GeometryEvidence",
    "GivenEvidence",
    "Guess",
    "Label",
    "LvlmEvidence",
    "NetworkEvidence",
]


def _absent(**limits: Any) -> Any:
    """A field that is left out of the file where nothing is known."""
    return Field(default=None, exclude_if=lambda value: value is None, **limits)


def _checked_as_fields(init: Callable[..., None]) -> None:
    """Has pydantic check the fields of a record that it reads by themselves, where it would call ``__init__``.

    Large graphs hold half a million of them. ``RootModel`` of pydantic does the same.
    """
    init.__pydantic_base_init__ = True  # type: ignore[attr-defined]


class Guess(Record):
    """What a part may be.

    Args:
        group: a group of the vocabulary.
        name: a name in that group, or None where only the group is meant.
        confidence: 0..1.
    """

    group: str
    name: str | None = None
    confidence: float = Field(ge=0, le=1)

    def __init__(self, group: str, name: str | None = None, confidence: float = 0.0, **unknown: Any) -> None:
        super().__init__(**{"group": group, "name": name, "confidence": confidence, **unknown})

    _checked_as_fields(__init__)

    @property
    def said(self) -> tuple[str, str | None]:
        """Group and name."""
        return self.group, self.name


class FormerLabel(Record):
    """What a label was before something else took its place.

    Args:
        group: of the vocabulary.
        name: in that group, or None.
        confidence: 0..1, None where it was not kept.
        source: who said so, None where it was not kept.
        why: in words, or None.
        likely: whether it was not sure; left out where it was, or where that was not kept.
    """

    group: str
    name: str | None = None
    confidence: float | None = _absent(ge=0, le=1)
    source: str | None = _absent()
    why: str | None = _absent()
    likely: bool | None = _absent()

    @classmethod
    def of(cls, label: Label | None) -> FormerLabel | None:
        """The former label of a part that had this one; None of none."""
        if label is None:
            return None
        return cls(
            group=label.group,
            name=label.name,
            confidence=round(label.confidence, 6),
            source=label.source,
            why=label.evidence.why,
            likely=True if label.likely else None,
        )


class Evidence(Record):
    """What a label rests on; labelers of others may put anything else beside these.

    Args:
        why: in words.
        before: what the part's label was until this evidence replaced it.
    """

    sources: ClassVar[tuple[str, ...]] = ()
    """The values of ``Label.source`` that go with this kind of evidence."""

    why: str | None = _absent()
    before: FormerLabel | None = _absent()

    @field_validator("before", mode="before")
    @classmethod
    def _read_text(cls, value: Any) -> Any:
        # Graphs of version 0.1.0 have 'group: name' where sizes corrected a label.
        if isinstance(value, str):
            group, _, name = (piece.strip() for piece in value.partition(":"))
            return {"group": group, "name": name or None}
        return value

    def to_json(self) -> dict[str, Any]:
        """As it stands in ``graph.json``."""
        return self.model_dump(mode="json")

    def __getitem__(self, key: str) -> Any:
        """Deprecated: what stands under a key of ``graph.json``."""
        warnings.warn("evidence['key'] is deprecated; use evidence.key or to_json()", DeprecationWarning, stacklevel=2)
        return self.to_json()[key]

    def get(self, key: str, default: Any = None) -> Any:
        """Deprecated: what stands under a key of ``graph.json``, if anything."""
        warnings.warn("evidence.get is deprecated; use evidence.key or to_json()", DeprecationWarning, stacklevel=2)
        return self.to_json().get(key, default)


class FileSupport(Record):
    """What the source file says that agrees with a label.

    Args:
        key: kind of fact (``"class"``, ``"name"``).
        text: what stands in the file.
        rule: by which that is read, in words.
        without: confidence without it, 0..1.
    """

    key: str
    text: str
    rule: str
    without: float


class GeometryEvidence(Evidence):
    """Shape and surroundings.

    Args:
        file: what the file says that made the label surer, where it counts (``label.use_metadata``).
    """

    sources = ("geometry",)

    file: FileSupport | None = _absent()


class LvlmEvidence(Evidence):
    """The answer of a vision-language model; sizes may have corrected it (source ``context``).

    Args:
        model: who answered.
        prompt: version of the question's words.
        question: id of the question.
        asked: source path of the part that was shown.
        repeats: how many parts of its shape and role the answer holds for.
        votes: ``group: name`` of each answer.
        seen: what the model says it saw.
        again: whether the answer is that to a second question with more context.
    """

    sources = ("lvlm", "context")

    model: str | None = _absent()
    prompt: str | None = _absent()
    question: str | None = _absent()
    asked: str | None = _absent()
    repeats: int | None = _absent()
    votes: tuple[str, ...] | None = _absent()
    seen: str | None = _absent()
    again: bool | None = _absent()


class CatalogEvidence(Evidence):
    """An entry of a user's catalogue.

    Args:
        entry: its id.
        catalog: name of the catalogue's file.
        match: how the shapes agree: ``exact``, ``mirrored``, ``near`` or ``scaled``.
        similarity: of the shapes, 0..1.
        taken_from: file and mesh that the entry was made from.
        scale: size of the part over that of the entry.
    """

    sources = ("catalog",)

    entry: str | None = _absent()
    catalog: str | None = _absent()
    match: str | None = _absent()
    similarity: float | None = _absent()
    taken_from: str | None = _absent()
    scale: float | None = _absent()


class GivenEvidence(Evidence):
    """A label that somebody gave for a mesh, from outside.

    Args:
        mesh: its source path.
    """

    sources = ("author",)

    mesh: str | None = _absent()


class CorrectedEvidence(Evidence):
    """A user's correction: of this part (source ``human``), or of one that it is like (source ``repeat``).

    Args:
        mesh: source path of the part, where it was corrected itself.
        corrected: source path of the corrected part that this one follows.
        match: how they agree: ``exact``, ``mirrored``, ``near``, ``scaled``, or ``kin`` (seen much alike).
        similarity: 0..1.
        scale: size of this part over that of the corrected one.
    """

    sources = ("human", "repeat")

    mesh: str | None = _absent()
    corrected: str | None = _absent()
    match: str | None = _absent()
    similarity: float | None = _absent()
    scale: float | None = _absent()


class FileEvidence(Evidence):
    """What the source file says of the mesh by itself: a class, a type, a name.

    Args:
        key: kind of fact (``"class"``, ``"name"``).
        text: what stands in the file.
        rule: by which that is read, in words.
    """

    sources = ("file",)

    key: str | None = _absent()
    text: str | None = _absent()
    rule: str | None = _absent()


class NetworkEvidence(Evidence):
    """What the lines through a part say about it: what a line runs through is a pipe."""

    sources = ("network",)


EVIDENCE: dict[str, type[Evidence]] = {
    source: kind
    for kind in (
        GeometryEvidence,
        LvlmEvidence,
        CatalogEvidence,
        GivenEvidence,
        CorrectedEvidence,
        FileEvidence,
        NetworkEvidence,
    )
    for source in kind.sources
}
"""The kind of evidence of each source of labels."""


class Label(Record):
    """What a part is, how sure that is, and who says so.

    Args:
        group: a group of the vocabulary.
        name: a name in that group, or None where only the group is known.
        confidence: 0..1.
        source: who says so: a key of ``EVIDENCE``, or a word of a labeler of your own.
        evidence: what the source's word rests on; plain values become the kind that goes with the source.
        guesses: what the part may be, the likeliest first, the label itself among them; in a graph they stand beside
            the label, not in it.
        likely: whether it is the likeliest label, but not sure; left out of the file where it is sure.
    """

    group: str
    name: str | None = None
    confidence: float = Field(ge=0, le=1)
    source: str = Field(description=f"{', '.join(EVIDENCE)}, or a word of somebody's own labeler")
    evidence: SerializeAsAny[Evidence] = Field(
        default_factory=Evidence, description="what the source needs to be traced"
    )
    guesses: tuple[Guess, ...] = Field(default=(), exclude=True, repr=False)
    likely: bool = Field(
        default=False,
        exclude_if=lambda value: not value,
        description="the likeliest label, but not sure; absent where it is sure",
    )

    def __init__(
        self,
        group: str,
        name: str | None = None,
        confidence: float = 1.0,
        source: str = "",
        evidence: Evidence | Mapping[str, Any] | None = None,
        guesses: tuple[Guess, ...] = (),
        **unknown: Any,
    ) -> None:
        values = {"group": group, "name": name, "confidence": confidence, "source": source, "guesses": guesses}
        super().__init__(**values, **{"evidence": {} if evidence is None else evidence, **unknown})

    _checked_as_fields(__init__)

    @field_validator("evidence", mode="before")
    @classmethod
    def _type_evidence(cls, value: Any, before: ValidationInfo) -> Any:
        return typed_evidence(before.data.get("source"), value) if isinstance(value, Mapping) else value

    @property
    def said(self) -> tuple[str, str | None]:
        """Group and name."""
        return self.group, self.name

    @property
    def state(self) -> Literal["sure", "likely"]:
        """How sure it is, in a word."""
        return "likely" if self.likely else "sure"


def typed_evidence(source: object, plain: Mapping[str, Any]) -> Evidence:
    """Evidence as the kind that goes with a source; what doesn't fit that kind is kept as it is.

    Args:
        source: of the label.
        plain: keys and values, as they stand in ``graph.json``.
    """
    kind = EVIDENCE.get(source, Evidence) if isinstance(source, str) else Evidence
    try:
        return kind.model_validate(dict(plain))
    except ValidationError:
        # Somebody's own labeler may use our word for its source, and other values.
        return Evidence.model_validate(dict(plain))
