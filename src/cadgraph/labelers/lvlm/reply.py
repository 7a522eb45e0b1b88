"""A question as it is sent, what comes back, and who answers."""

from __future__ import annotations

import functools
import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from cadgraph.labelers.lvlm.gallery import Picture

__all__ = ["Answerer", "Question", "Reply"]


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
    """

    system: str
    text: str
    schema: dict[str, Any]
    recipe: str
    pictures: Callable[[], Sequence[Picture]]
    prompt: str
    part: int = -1
    attempt: int = 0

    @functools.cached_property
    def id(self) -> str:
        """Sixteen hexadecimal digits by its content: the same question has the same id, whoever is asked."""
        content = [self.system, self.text, self.schema, self.recipe, self.attempt]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]


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
    """

    text: str | None
    refusal: str | None = None
    prompt_tokens: int = 0
    answer_tokens: int = 0
    error: str | None = None
    waiting: bool = False
    batch: bool = False


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
