"""A question as it is sent, what comes back, and who answers."""

from __future__ import annotations

import functools
import hashlib
import json
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from cadgraph.labelers.lvlm.gallery import Picture

if TYPE_CHECKING:
    from cadgraph.model.diagnostic import Diagnostic

__all__ = ["Answerer", "Hasty", "Question", "Reply", "Watchful", "key_of", "spoken"]

_THOUGHT = re.compile(r"\A.*</think(?:ing)?>", re.DOTALL | re.IGNORECASE)


@dataclass(frozen=True)
class Question:
    """All that a model is shown.

    Args:
        system: what the conversation starts with.
        text: the question.
        schema: JSON schema of the answer.
        recipe: what the pictures follow from; with the texts it makes the question what it is.
        pictures: draws them.
        prompt: name and version of the template.
        part: that it is about, or -1.
        attempt: 0, or 1 where the first answer could not be used.
        about: what the part is called, for messages.
    """

    system: str
    text: str
    schema: dict[str, Any]
    recipe: str
    pictures: Callable[[], Sequence[Picture]]
    prompt: str
    part: int = -1
    attempt: int = 0
    about: str = ""

    @functools.cached_property
    def id(self) -> str:
        """Sixteen hexadecimal digits by its content: the same question has the same id, whoever is asked."""
        content = [self.system, self.text, self.schema, self.recipe, self.attempt]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]

    @property
    def called(self) -> str:
        """How messages name it: the folder of its files, and what it is about."""
        about = self.about or (f"part {self.part}" if self.part >= 0 else "")
        return f"q-{self.id}" + (f" about {about}" if about else "")


@dataclass(frozen=True)
class Reply:
    """What came back.

    Args:
        text: of the answer, or None.
        refusal: why the model won't answer, or None.
        prompt_tokens: as the server counted.
        answer_tokens: likewise.
        error: why there is no answer, or None. Such replies are not kept: the same command asks again.
        waiting: whether the answer will come another way (a batch, a folder).
        batch: whether it came by the batch interface.
        lost: whether the server may have answered all the same, so that it may be paid for.
    """

    text: str | None
    refusal: str | None = None
    prompt_tokens: int = 0
    answer_tokens: int = 0
    error: str | None = None
    waiting: bool = False
    batch: bool = False
    lost: bool = False


class Answerer(Protocol):
    """Whoever can answer questions."""

    name: str
    """Of the model; part of what answers are known by in the cache."""

    looks: bool
    """Whether it needs the pictures."""

    keeps: bool
    """Whether its replies go into the cache."""

    again: bool
    """Whether it can be asked again at once, with another question that follows from its answer."""

    def ask(self, question: Question) -> Reply:
        """Answers a question. Called from several threads.

        Raises:
            LabelError: it makes no sense to ask any further (no key, unknown model).
        """
        ...

    def close(self) -> None:
        """Lets go of files and connections; it may be asked again later."""
        ...


@runtime_checkable
class Hasty(Protocol):
    """An answerer that may wait long for somebody."""

    def hurry(self) -> None:
        """Ends what waits; what was sent is waited for."""
        ...

    def told(self) -> dict[str, Any]:
        """In which way it asks, for the record of the run."""
        ...


@runtime_checkable
class Watchful(Protocol):
    """An answerer that sees what is wrong beside single questions."""

    def findings(self) -> Sequence[Diagnostic]:
        """What is wrong, after all questions were asked."""
        ...


def key_of(question: Question, model: str, detail: str) -> str:
    """What the answer to a question is known by: its content, the model, and how closely it looks."""
    return hashlib.sha256(json.dumps([question.id, model, detail]).encode()).hexdigest()


def spoken(text: str) -> str:
    """An answer without what a model thought aloud before it; some servers leave that in, with or without its start."""
    return _THOUGHT.sub("", text)
