"""Asking a server that speaks OpenAI's chat completions: OpenAI, Azure, vLLM, Ollama, LM Studio, a proxy."""

from __future__ import annotations

import base64
import os
import threading
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from cadgraph._io.limits import REPLY
from cadgraph._io.text import printable
from cadgraph.errors import LabelError, MissingExtra
from cadgraph.labelers.lvlm.address import check_address
from cadgraph.labelers.lvlm.gallery import Picture
from cadgraph.labelers.lvlm.reply import Question, Reply

__all__ = ["Client", "Manner", "body_of"]

_IN_A_ROW = 12  # questions that fail one after the other, none answered between them: the server is gone


@dataclass(frozen=True)
class Manner:
    """What a server understands; found out by asking.

    Args:
        schema: ``json_schema``, ``json_object`` or ``none``: how it can be held to a form.
        limit: what it calls the greatest length of an answer.
        temperature: whether it may be set.
    """

    schema: str = "json_schema"
    limit: str = "max_completion_tokens"
    temperature: bool = True


class Client:
    """Asks a server. Safe for threads.

    Args:
        model: its name, as the server knows it.
        base_url: of the server; OpenAI's own (or ``OPENAI_BASE_URL``) if empty.
        key_variable: the environment variable that holds the key; a server of one's own may need none.
        timeout: of one try [s].
        retries: the client tries again so often on 408, 409, 429, 5xx and broken connections, and minds Retry-After.
        detail: of the pictures: low, high or auto.
        max_tokens: of an answer.
        temperature: None leaves it to the server.
        structured: ``auto``, or the one way to hold the server to a form.

    Raises:
        MissingExtra: the client library isn't installed.
        LabelError: the address is none, or no key is set.
    """

    looks = True
    keeps = True
    again = True

    def __init__(
        self,
        model: str,
        *,
        base_url: str = "",
        key_variable: str = "OPENAI_API_KEY",
        timeout: float = 120.0,
        retries: int = 5,
        detail: str = "high",
        max_tokens: int = 600,
        temperature: float | None = 0.0,
        structured: str = "auto",
    ) -> None:
        try:
            import openai
        except ImportError as error:
            raise MissingExtra("asking a vision-language model", "lvlm") from error
        address = base_url or os.environ.get("OPENAI_BASE_URL", "")
        check_address(address)
        key = os.environ.get(key_variable, "")
        if not key and not address:
            raise LabelError(
                f"no key: set the environment variable {key_variable}, or name a server of your own with --base-url"
            )
        self.name = model
        self._openai = openai
        self._detail, self._max_tokens, self._temperature = detail, max_tokens, temperature
        self._manner = Manner() if structured == "auto" else Manner(schema=structured)
        self._settled = structured != "auto"
        self._lock = threading.Lock()
        self._failed = 0
        self._client: Any = None
        self._session: dict[str, Any] = {
            "api_key": key or "none",
            "base_url": address or None,
            "timeout": timeout,
            "max_retries": retries,
        }

    def close(self) -> None:
        """Closes the connections; the next question opens new ones."""
        with self._lock:
            client, self._client = self._client, None
        if client is not None:
            client.close()

    def _open(self) -> Any:
        with self._lock:
            if self._client is None:
                hooks = {"response": [_refuse_huge]}
                http = self._openai.DefaultHttpxClient(event_hooks=hooks, follow_redirects=False)
                self._client = self._openai.OpenAI(http_client=http, **self._session)
            return self._client

    def ask(self, question: Question) -> Reply:
        """Asks; adapts to what the server understands."""
        if self._failed >= _IN_A_ROW:
            return Reply(None, error=f"not asked: {_IN_A_ROW} questions before failed, none was answered")
        pictures = encoded(question, self._detail)
        for _ in range(5):
            manner = self._manner
            body = body_of(question, pictures, self.name, manner, self._max_tokens, self._temperature)
            try:
                reply = self._once(body)
            except self._openai.BadRequestError as error:
                if not self._adapt(manner, str(error)):
                    return self._failure(error)
                continue
            except self._openai.UnprocessableEntityError as error:
                if not self._adapt(manner, str(error)):
                    return self._failure(error)
                continue
            except (self._openai.AuthenticationError, self._openai.PermissionDeniedError) as error:
                raise LabelError(f"the server refuses the key ({error.status_code}); check it and the model") from error
            except self._openai.NotFoundError as error:
                raise LabelError(
                    f"the server has no model {self.name!r} (404); check --model and --base-url"
                ) from error
            except (self._openai.OpenAIError, ValueError) as error:
                return self._failure(error)
            with self._lock:
                self._failed = 0
                self._settled = True
            return reply
        return Reply(None, error="the server accepts none of the ways to ask for JSON")

    def _once(self, body: dict[str, Any]) -> Reply:
        done = self._open().chat.completions.create(**body)
        usage = getattr(done, "usage", None)
        prompt_tokens = _count(getattr(usage, "prompt_tokens", 0))
        answer_tokens = _count(getattr(usage, "completion_tokens", 0))
        choices = getattr(done, "choices", None)
        if not choices:
            return Reply("", None, prompt_tokens, answer_tokens)
        message, end = choices[0].message, choices[0].finish_reason
        refusal = getattr(message, "refusal", None)
        if end == "content_filter" and not refusal:
            refusal = "stopped by the provider's filter"
        text = getattr(message, "content", None)
        return Reply(
            str(text)[: 2 * 20_000] if text is not None else None,
            str(refusal)[:300] if refusal else None,
            prompt_tokens,
            answer_tokens,
        )

    def _adapt(self, tried: Manner, message: str) -> bool:
        """Whether another way of asking is worth a try after a server refused this one; changes it for all."""
        words = message.lower()
        other = tried
        if "max_completion_tokens" in words or "max_tokens" in words:
            other = replace(tried, limit="max_tokens" if tried.limit != "max_tokens" else "max_completion_tokens")
        elif "temperature" in words and tried.temperature:
            other = replace(tried, temperature=False)
        elif tried.schema != "none" and (
            any(word in words for word in ("response_format", "json_schema", "json_object", "schema", "structured"))
            or not self._settled
        ):
            other = replace(tried, schema="json_object" if tried.schema == "json_schema" else "none")
        if other == tried:
            return False
        with self._lock:
            if self._manner == tried:
                self._manner = other
        return True

    def _failure(self, error: Exception) -> Reply:
        with self._lock:
            self._failed += 1
        return Reply(None, error=_reason(error))


def body_of(
    question: Question,
    pictures: list[dict[str, Any]],
    model: str,
    manner: Manner,
    max_tokens: int,
    temperature: float | None,
) -> dict[str, Any]:
    """The body of a request to ``/chat/completions``, as plain values."""
    body: dict[str, Any] = {
        "model": model,
        "messages": [
            {"role": "system", "content": question.system},
            {"role": "user", "content": [{"type": "text", "text": question.text}, *pictures]},
        ],
        manner.limit: max_tokens,
    }
    if temperature is not None and manner.temperature:
        body["temperature"] = temperature
    if manner.schema == "json_schema":
        form = {"name": "answer", "strict": True, "schema": question.schema}
        body["response_format"] = {"type": "json_schema", "json_schema": form}
    elif manner.schema == "json_object":
        body["response_format"] = {"type": "json_object"}
    return body


def encoded(question: Question, detail: str) -> list[dict[str, Any]]:
    """The pictures of a question, each after its caption, as parts of a message."""
    parts: list[dict[str, Any]] = []
    for picture in question.pictures():
        parts.append({"type": "text", "text": picture.caption})
        parts.append({"type": "image_url", "image_url": {"url": _data_url(picture), "detail": detail}})
    return parts


def _data_url(picture: Picture) -> str:
    return "data:image/jpeg;base64," + base64.b64encode(picture.draw()).decode("ascii")


def _refuse_huge(response: Any) -> None:
    length = str(response.headers.get("content-length", "0"))
    if length.isdigit() and int(length) > REPLY.most:
        raise ValueError(f"the reply has {length} bytes, more than {REPLY.most}")
    # A server may tell no length, or a wrong one, or pack a reply that grows a thousandfold.
    read = response.iter_bytes

    def pieces(chunk_size: int | None = None) -> Iterator[bytes]:
        size = 0
        for piece in read(chunk_size):
            size += len(piece)
            if size > REPLY.most:
                raise ValueError(f"the reply has more than {REPLY.most} bytes")
            yield piece

    response.iter_bytes = pieces


def _count(value: Any) -> int:
    return int(value) if isinstance(value, int) and 0 <= value < 10**9 else 0


def _reason(error: Exception) -> str:
    """Why there is no answer, in a few words; nothing of the server's own text but its first line, cut."""
    status = getattr(error, "status_code", None)
    kind = {429: "too many requests", 500: "server error", 503: "server overloaded"}.get(status or 0, "")
    if status is not None:
        return f"the server answered {status}{f' ({kind})' if kind else ''} to every try"
    name = type(error).__name__
    if name == "APITimeoutError":
        return "no answer in time, at every try"
    if name == "APIConnectionError":
        return "the connection to the server failed at every try"
    first = printable(str(error).splitlines()[0], "") if str(error) else ""
    return f"the server's reply can't be used: {first[:120] or name}"
