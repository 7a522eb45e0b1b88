"""A conversation with a model that may call tools, over the same connection as questions about pictures."""

from __future__ import annotations

import json
import re
import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from cadgraph._io.text import printable
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.client import Client, Refused
from cadgraph.labelers.lvlm.manner import Manner, too_long
from cadgraph.labelers.lvlm.patience import Gone

__all__ = ["Talker", "ToolCall", "Turn"]

_WAYS = 6  # of asking that are tried for one turn
_SAID = 160  # characters of a server's own words in a message
_BACK = {
    "reasoning_content",
    "reasoning",
    "reasoning_details",
    "extra_content",
}  # that some servers miss in the next turn
_MOST_CALLS = 64  # of one turn
_LONGEST = 40_000  # characters of a text or of the arguments of a call that are kept
# Ollama, vLLM, llama.cpp and proxies mind tools in words like these, with 400, 404, 422 or 500.
_MINDED = re.compile(r"\btools?\b.*(support|requir|enabl)|support.*\btools?\b")
_OF_TOOLS = re.compile(r"\btools?\b|tool_choice|tool[ _-]call|function[ _-]call")


@dataclass(frozen=True)
class ToolCall:
    """A tool that a model wants to be run.

    Args:
        ident: the server's name for the call, which its result goes back with.
        name: of the tool, as the model wrote it.
        arguments: as the model wrote them; JSON, if it knows how.
        extra: what else the server told of the call and wants back, as signatures of its thoughts.
    """

    ident: str
    name: str
    arguments: str
    extra: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Turn:
    """What a model said in its turn.

    Args:
        text: without what it thought aloud and without keys; ``""`` where it only calls tools.
        calls: the tools that it wants to be run.
        prompt_tokens: as the server counted; 0 where it doesn't.
        answer_tokens: likewise.
        cut: whether it was longer than it might be, so that its end is missing.
        extra: what else the server told of its message and wants back where tools were called: its thoughts.
    """

    text: str
    calls: tuple[ToolCall, ...] = ()
    prompt_tokens: int = 0
    answer_tokens: int = 0
    cut: bool = False
    extra: Mapping[str, Any] = field(default_factory=dict)


class Talker(Client):
    """A client that leads a conversation. Safe for threads, one conversation each."""

    purpose = "asking a language model"
    settings = ("--timeout", "--timeout")

    def turn(
        self,
        system: str,
        messages: Sequence[Mapping[str, Any]],
        tools: Sequence[Mapping[str, Any]],
        most: int,
        last: bool,
    ) -> Turn:
        """The model's next turn.

        Args:
            system: what it has to keep to.
            messages: of the conversation so far, the first one of the user.
            tools: that it may call, as the interface wants them.
            most: tokens of its turn.
            last: whether it must not call any more; the tools are then left out.

        Raises:
            LabelError: there is none; the message says why in one line.
        """
        ident = uuid.uuid4().hex
        offered = not last
        for way in range(_WAYS):
            manner = self.manner
            body = self._body(system, messages, manner, most)
            # Some servers want the tools of earlier calls to be named even where no more may follow.
            more = {"tools": list(tools)} | ({"tool_choice": "none"} if last else {}) if offered else {}
            try:
                done = self._sent(body | more, f"{ident}-{way}", manner)
            except Refused as refusal:
                words = refusal.said.lower()
                if last and not offered and _OF_TOOLS.search(words):
                    offered = True
                    continue
                other = not too_long(words) and self._adapt(manner, refusal.said)
                if not other or self._body(system, messages, self.manner, most) == body:
                    raise self._no(refusal, offered) from None
                continue
            except Gone as gone:
                raise LabelError(str(gone)) from None
            except (self._openai.OpenAIError, ValueError) as error:
                raise LabelError(self._reason(error)) from error
            self._patience.answered()
            with self._lock:
                self._settled = True
            return self._turn(done)
        raise LabelError("the server accepts none of the ways to ask for an answer")

    def _mind(self, error: Any, manner: Manner, last: bool) -> None:
        said, status = self._words(error), int(error.status_code)
        if status in (404, 500, 501) and _MINDED.search(said[: 4 * _SAID].lower()):
            raise Refused(said, status) from error
        super()._mind(error, manner, last)

    def _no(self, refusal: Refused, offered: bool) -> LabelError:
        """Why there is no turn, where a server minds how it is asked."""
        words, said = refusal.said.lower(), f"({refusal.status}): {refusal.said[:_SAID]}"
        if too_long(words):
            return LabelError(
                f"the conversation is too long for the server's context {said}; ask for less at a time, or give the "
                "server a larger context"
            )
        if offered and not self._settled and _OF_TOOLS.search(words):
            return LabelError(
                f"model {self.name!r} can't use tools, as the server says {said}; take a model that can, or start the "
                "server so that it may"
            )
        return LabelError(f"the server refused the question {said}")

    def _body(self, system: str, messages: Sequence[Mapping[str, Any]], manner: Manner, most: int) -> dict[str, Any]:
        first, *rest = messages
        asked = (
            [{"role": "system", "content": system}, first]
            if manner.system
            else [{**first, "content": f"{system}\n\n{first['content']}"}]
        )
        body: dict[str, Any] = {"model": self.name, "messages": [*asked, *rest], manner.limit: most}
        if self._temperature is not None and manner.temperature:
            body["temperature"] = self._temperature
        return body

    def _turn(self, done: Any) -> Turn:
        """What is of use in a server's answer, whatever it holds."""
        reply = self._reply(done)
        choices = getattr(done, "choices", None) or [None]
        message = getattr(choices[0], "message", None)
        calls = []
        for number, call in enumerate((getattr(message, "tool_calls", None) or ())[:_MOST_CALLS]):
            function = getattr(call, "function", None)
            name, arguments = (str(getattr(function, each, None) or "") for each in ("name", "arguments"))
            ident = printable(self._scrub(str(getattr(call, "id", None) or "")))[:200] or f"call_{number + 1}"
            name, arguments = printable(self._scrub(name))[:200], _encodable(self._scrub(arguments))[:_LONGEST]
            calls.append(ToolCall(ident, name, arguments, _told_beside(call)))
        return Turn(
            _encodable(reply.text or (f"The model declined: {reply.refusal}" if reply.refusal else "")),
            tuple(calls),
            reply.prompt_tokens,
            reply.answer_tokens,
            getattr(choices[0], "finish_reason", None) == "length",
            _told_beside(message),
        )


def _told_beside(told: Any) -> dict[str, Any]:
    """What a server told beside the fields that the interface has, of what it wants back."""
    extra = getattr(told, "model_extra", None) or {}
    return {name: value for name, value in extra.items() if name in _BACK and value and _sendable(value)}


def _sendable(value: Any) -> bool:
    try:
        json.dumps(value, ensure_ascii=False, allow_nan=False).encode()
    except (ValueError, RecursionError):
        return False
    return True


def _encodable(text: str) -> str:
    """A text without halves of characters, which JSON can hold and no request can."""
    return text.encode("utf-8", "replace").decode("utf-8")
