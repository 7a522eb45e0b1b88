"""Asking a server that speaks OpenAI's chat completions: OpenAI, Azure, vLLM, Ollama, LM Studio, a proxy."""

from __future__ import annotations

import hashlib
import io
import os
import threading
import time
from collections.abc import Sequence
from dataclasses import asdict, astuple, replace
from typing import Any

from cadgraph._io.text import printable
from cadgraph.errors import LabelError, MissingExtra
from cadgraph.labelers.lvlm.address import check_address
from cadgraph.labelers.lvlm.gallery import Picture
from cadgraph.labelers.lvlm.manner import LEVELS, Manner, adapted, blind, body_of, encoded, too_long
from cadgraph.labelers.lvlm.patience import CONNECT, Gone, Patience, resolves, retry_after
from cadgraph.labelers.lvlm.price import question_tokens
from cadgraph.labelers.lvlm.profile import Profile
from cadgraph.labelers.lvlm.reply import Question, Reply, key_of, spoken
from cadgraph.labelers.lvlm.secret import scrubber
from cadgraph.labelers.lvlm.wire import ENCODINGS, capped

__all__ = ["Client", "Refused"]

_WAYS = 12  # of asking that are tried for one question
_SAID = 120  # characters of a server's own words in a message
_PAGE = 500  # characters from which an error is a page of a gateway, whose words mean nothing
_KINDS = {429: "too many requests", 500: "server error", 503: "server overloaded"}


class Client:
    """Asks a server. Safe for threads.

    Args:
        model: its name, as the server knows it.
        base_url: of the server; OpenAI's own (or ``OPENAI_BASE_URL``) if empty.
        key_variable: the environment variable that holds the key; a server of one's own may need none.
        timeout: of one try [s].
        retries: a question is sent again so often after 408, 409, 429, 5xx, a timeout or a broken connection.
        wait: the longest that is waited where a server asks for it with Retry-After [s].
        detail: of the pictures: low, high or auto.
        max_tokens: of an answer.
        temperature: None leaves it to the server.
        profile: what is known of the model and its server, to begin with.
        fixed: whether the form of the answer is as the profile says, and no other is tried.

    Raises:
        MissingExtra: the client library isn't installed.
        LabelError: the address is none, or no key is set.
    """

    looks = True
    keeps = True
    again = True

    purpose = "asking a vision-language model"
    """What the client library is needed for, as a person would say it."""

    settings = ("lvlm.wait", "lvlm.timeout")
    """What sets the longest wait and the time of one try, for messages."""

    def __init__(
        self,
        model: str,
        *,
        base_url: str = "",
        key_variable: str = "OPENAI_API_KEY",
        timeout: float = 120.0,
        retries: int = 5,
        wait: float = 300.0,
        detail: str = "high",
        max_tokens: int = 600,
        temperature: float | None = 0.0,
        profile: Profile | None = None,
        fixed: bool = False,
    ) -> None:
        try:
            import openai
        except ImportError as error:
            raise MissingExtra(self.purpose, "lvlm") from error
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
        self._retries, self._timeout = retries, timeout
        self._profile = profile or Profile()
        self._manner, self._settled = self._profile.manner, fixed
        self._lock = threading.Lock()
        self._scrub = scrubber(key_variable, "OPENAI_API_KEY")
        self._address = address or "https://api.openai.com/v1"
        self._patience = Patience(wait, timeout, self._address, self.settings)
        self._reasons: dict[str, str] = {}
        self._resolved = False
        self._client: Any = None
        self._session: dict[str, Any] = {
            "api_key": key or "none",
            "base_url": address or None,
            "timeout": openai.Timeout(timeout, connect=min(timeout, CONNECT)),
            # Ours, since the library's own give up on a server that asks for a longer wait, without a word.
            "max_retries": 0,
            "default_headers": {"Accept-Encoding": ENCODINGS},
        }

    @property
    def manner(self) -> Manner:
        """What the server understands, as far as is known."""
        return self._manner

    @property
    def address(self) -> str:
        """Where the server is."""
        return self._address

    def close(self) -> None:
        """Closes the connections; the next question opens new ones."""
        with self._lock:
            client, self._client = self._client, None
        self._patience.calm()
        if client is not None:
            client.close()

    def hurry(self) -> None:
        """Ends what waits; what was sent is waited for."""
        self._patience.hurry()

    def told(self) -> dict[str, Any]:
        """In which way it asks, for the record of the run."""
        return asdict(self._manner)

    def ask(self, question: Question) -> Reply:
        """Asks; adapts to what the server understands.

        Raises:
            LabelError: the server refuses the key, has no such model, or the model sees no pictures.
        """
        if self._patience.over is not None:
            return Reply(None, error=f"not asked: {self._patience.over}")
        key = key_of(question, self.name, self._detail)
        for _ in range(_WAYS):
            manner = self._fitting(question)
            pictures = encoded(question, self._detail, manner)
            body = body_of(question, pictures, self.name, manner, self._max_tokens, self._temperature)
            try:
                reply = self._reply(self._sent(body, f"{key[:40]}-{_digest(manner)}", manner))
            except Refused as refusal:
                if not self._adapt(manner, refusal.said):
                    return self._failure(self._wrong(refusal.said, refusal.status, manner))
                continue
            except Gone as gone:
                return self._failure(str(gone), lost=gone.lost)
            except (self._openai.OpenAIError, ValueError) as error:
                told = isinstance(error, self._openai.APIStatusError)
                return self._failure(self._reason(error), lost=not told and not _unreachable(error))
            self._patience.answered()
            with self._lock:
                self._settled = True
            return reply
        return self._failure("the server accepts none of the ways to ask for an answer")

    def _sent(self, body: dict[str, Any], ident: str, manner: Manner) -> Any:
        """The server's answer, after as many tries as it takes.

        Raises:
            Refused: it minds how it is asked.
            Gone: it makes no sense to ask any further.
            OpenAIError: of the last try.
        """
        refused, lost = 0, False
        for tried in range(self._retries + 1):
            started = time.monotonic()
            last = tried == self._retries
            # After an error that it told, a server that knows the id again would tell the same one.
            headers = dict.fromkeys(("Idempotency-Key", "X-Request-ID", "X-Client-Request-Id"), f"{ident}-{refused}")
            try:
                self._patience.ready()
                try:
                    return self._open().chat.completions.create(**body, extra_headers=headers)
                except self._openai.APIConnectionError as error:
                    lost |= not _unreachable(error)
                    self._note_broken(error, started)
                    if last:
                        raise
                except self._openai.APIStatusError as error:
                    self._patience.heard()
                    refused += 1
                    self._mind(error, manner, last)
                    if retry_after(error.response.headers) is not None:
                        continue
                self._patience.rest(tried)
            except Gone as gone:
                gone.lost = lost
                raise
        raise Gone("nothing was sent")

    def _note_broken(self, error: Any, started: float) -> None:
        """A try that ended without a word of the server.

        Raises:
            Gone: it makes no sense to go on.
        """
        late = isinstance(error, self._openai.APITimeoutError)
        if _unreachable(error):
            self._patience.unreachable(started, "no connection in time" if late else self._cause(error))
        elif late:
            self._patience.silent(started)

    def _mind(self, error: Any, manner: Manner, last: bool) -> None:
        """What an error that the server told means: another way of asking, an end, or another try.

        Raises:
            Refused: another way.
            LabelError: the run ends.
            Gone: the server asks for a longer wait than is waited.
            OpenAIError: the question ends.
        """
        status, said = int(error.status_code), self._words(error)
        if blind(said):
            raise LabelError(f"model {self.name!r} sees no pictures, as the server says ({status}): {said}") from error
        if status in (401, 403):
            raise LabelError(f"the server refuses the key ({status}); check it and the model") from error
        if status == 404:
            raise LabelError(f"the server has no model {self.name!r} (404); check --model and --base-url") from error
        if status in (400, 413, 415, 422) or (status >= 500 and len(said) < _PAGE and adapted(manner, said, True)):
            raise Refused(said, status) from error
        if status not in (408, 409, 429) and status < 500:
            raise error
        if getattr(error, "code", None) == "insufficient_quota":
            self._patience.end("the account has no credit left (insufficient_quota)")
        wait = retry_after(error.response.headers)
        if wait is not None:
            self._patience.asked_to_wait(wait)
        if last:
            raise error

    def _open(self) -> Any:
        if not self._resolved:
            started = time.monotonic()
            if not resolves(self._address):
                self._patience.unreachable(started - CONNECT, "its name has no address")
            self._resolved = True
        with self._lock:
            if self._client is None:
                hooks = {"response": [lambda response: capped(response, self._timeout)]}
                http = self._openai.DefaultHttpxClient(event_hooks=hooks, follow_redirects=False)
                self._client = self._openai.OpenAI(http_client=http, **self._session)
            return self._client

    def _reply(self, done: Any) -> Reply:
        """What is of use in a server's answer; its secrets and its thinking aloud taken out."""
        usage = getattr(done, "usage", None)
        used = _count(getattr(usage, "prompt_tokens", 0)), _count(getattr(usage, "completion_tokens", 0))
        choices = getattr(done, "choices", None)
        if not choices:
            return Reply("", None, *used)
        message, end = getattr(choices[0], "message", None), getattr(choices[0], "finish_reason", None)
        refusal = getattr(message, "refusal", None)
        if end == "content_filter" and not refusal:
            refusal = "stopped by the provider's filter"
        text = getattr(message, "content", None)
        return Reply(
            spoken(self._scrub(str(text)))[: 2 * 20_000] if text is not None else None,
            self._scrub(str(refusal))[:300] if refusal else None,
            *used,
        )

    def _fitting(self, question: Question) -> Manner:
        """How to ask so that the question fits into the context that is known."""
        manner = self._manner
        if self._profile.context is None:
            return manner
        pictures = question.pictures()
        words = question_tokens(question.system, question.text, question.schema, len(pictures))
        level = self._profile.level(words, len(pictures), _side(pictures), self._max_tokens, manner)
        return replace(manner, level=level)

    def _adapt(self, tried: Manner, message: str) -> bool:
        """Whether another way of asking is worth a try after a server refused this one; changes it for all."""
        other = adapted(tried, message, self._settled)
        with self._lock:
            if replace(self._manner, level=tried.level) != tried or self._manner.level > tried.level:
                return True
            if other is not None:
                self._manner = other
        return other is not None

    def _failure(self, reason: str, *, lost: bool = False) -> Reply:
        self._patience.failed(reason)
        return Reply(None, error=reason, lost=lost)

    def _words(self, error: Any) -> str:
        """The server's own words in an error, on one line, cut, without secrets or control characters."""
        body = getattr(error, "body", None)
        said = body.get("message", body.get("error", "")) if isinstance(body, dict) else body
        said = said.get("message", "") if isinstance(said, dict) else said
        plain = printable(self._scrub(str(said or getattr(error, "message", "")))[:4000], "")
        return " ".join(plain.split())

    def _wrong(self, said: str, status: int, manner: Manner) -> str:
        if manner.level == len(LEVELS) - 1 and too_long(said):
            return f"a question with a single picture is too long for the server's context ({status}): {said[:_SAID]}"
        return self._first(str(status), f"the server refused the question ({status}): {said[:_SAID]}")

    def _reason(self, error: Exception) -> str:
        """Why there is no answer, in a few words."""
        status = getattr(error, "status_code", None)
        if status is not None:
            kind = f" ({_KINDS[status]})" if status in _KINDS else ""
            said = self._words(error)[:_SAID]
            return self._first(
                str(status), f"the server answered {status}{kind} to every try" + (f": {said}" if said else "")
            )
        if isinstance(error, self._openai.APITimeoutError):
            return "no answer in time, at every try"
        if isinstance(error, self._openai.APIConnectionError) and not isinstance(error.__cause__, ValueError):
            cause = self._first("connection", self._cause(error))
            return f"the connection to the server failed at every try ({cause})"
        wrapped = error.__cause__ if isinstance(error, self._openai.OpenAIError) else None
        first = printable(self._scrub(str(wrapped or error)), "")
        return f"the server's reply can't be used: {' '.join(first.split())[:_SAID] or type(error).__name__}"

    def _cause(self, error: BaseException) -> str:
        """What the system says of a broken connection."""
        while error.__cause__ is not None or error.__context__ is not None:
            error = error.__cause__ or error.__context__ or error
        told = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        return " ".join(printable(self._scrub(told), "").split())[:_SAID] or type(error).__name__

    def _first(self, kind: str, reason: str) -> str:
        """The same words for the same kind of error, so that a report holds each once: servers put numbers in them."""
        with self._lock:
            return self._reasons.setdefault(kind, reason)


class Refused(Exception):
    """The server minds how it is asked."""

    def __init__(self, said: str, status: int) -> None:
        super().__init__(said)
        self.said, self.status = said, status


def _unreachable(error: BaseException) -> bool:
    """Whether no connection came about, as the client's HTTP library names it."""
    seen: BaseException | None = error
    while seen is not None:
        if type(seen).__name__ in ("ConnectError", "ConnectTimeout"):
            return True
        seen = seen.__cause__ or seen.__context__
    return False


def _side(pictures: Sequence[Picture]) -> int:
    """Greatest side of the first of some pictures [px]; all of a question have one size."""
    from PIL import Image

    if not pictures:
        return 1
    with Image.open(io.BytesIO(pictures[0].draw())) as image:
        return max(image.size)


def _digest(manner: Manner) -> str:
    return hashlib.sha256(repr(astuple(manner)).encode()).hexdigest()[:8]


def _count(value: Any) -> int:
    return int(value) if isinstance(value, int) and 0 <= value < 10**9 else 0
