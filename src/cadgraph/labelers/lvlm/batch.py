"""The provider's batch interface: requests written as JSONL, results read back into the cache."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, Any

from cadgraph._io.limits import BATCH, CHECK_PATH, REPLY, lines_within
from cadgraph.errors import LabelError, OutputError
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.manner import Manner, body_of, encoded
from cadgraph.labelers.lvlm.reply import Question, Reply, spoken

__all__ = ["BatchWriter", "read_results"]

MAX_REQUESTS, MAX_BYTES = 50_000, 190_000_000
"""Of one file, as OpenAI takes it (50,000 requests, 200 MB)."""


class BatchWriter:
    """Writes every question as a request of a batch, and answers none.

    Files are called ``batch-001.jsonl`` and so on; a file that grows past what the provider takes is followed by
    another one. The custom id of a request is the key of its answer in the cache.

    Args:
        folder: where the files go; old ones of these names are removed.
        model: that will be asked.
        key_of: makes the key of a question.
        detail: of the pictures.
        max_tokens: of an answer.
        temperature: None leaves it to the server.
        manner: what the server understands.
    """

    looks = True
    keeps = False
    again = False

    def __init__(
        self, folder: Path, model: str, key_of: Any, *, detail: str, max_tokens: int, temperature: float | None,
        manner: Manner | None = None,
    ) -> None:  # fmt: skip
        self.name = model
        self.files: list[Path] = []
        self._folder, self._key_of = folder, key_of
        self._detail, self._max_tokens, self._temperature = detail, max_tokens, temperature
        self._manner = manner or Manner()
        self._lock = threading.Lock()
        self._open: IO[str] | None = None
        self._requests = self._bytes = 0
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for old in folder.glob("batch-[0-9][0-9][0-9].jsonl"):
                old.unlink()
        except OSError as error:
            raise OutputError(f"{folder}: can't be written ({error.strerror}); choose another output folder") from error

    def ask(self, question: Question) -> Reply:
        """Writes it as a line."""
        pictures = encoded(question, self._detail, self._manner)
        body = body_of(question, pictures, self.name, self._manner, self._max_tokens, self._temperature)
        line = json.dumps(
            {"custom_id": self._key_of(question), "method": "POST", "url": "/v1/chat/completions", "body": body}
        )
        with self._lock:
            if self._open is None or self._requests >= MAX_REQUESTS or self._bytes + len(line) > MAX_BYTES:
                self.close()
                path = self._folder / f"batch-{len(self.files) + 1:03d}.jsonl"
                self._open = path.open("w", encoding="utf-8", newline="\n")
                self.files.append(path)
                self._requests = self._bytes = 0
            self._open.write(line + "\n")
            self._requests += 1
            self._bytes += len(line) + 1
        return Reply(None, waiting=True)

    def close(self) -> None:
        """Closes the file at work."""
        if self._open is not None:
            self._open.close()
            self._open = None


def read_results(
    path: Path, cache: Cache, model: str, scrub: Callable[[str], str] = lambda text: text
) -> tuple[int, int]:
    """Reads a file of results (or of errors) that the provider made of a batch into the cache.

    Args:
        path: the file.
        cache: of answers.
        model: that answered.
        scrub: takes secrets out of a text.

    Returns:
        How many answers it held, and how many requests failed; the latter will be in the next batch.

    Raises:
        LabelError: it can't be read or is no such file.
    """
    answered = failed = 0
    for row in _rows(path):
        key, reply = row.get("custom_id"), _reply(row, scrub)
        if not isinstance(key, str) or not 0 < len(key) <= 64:
            raise LabelError(f"{path}: a line has no custom_id; give the file of results that the provider made")
        if reply is None:
            failed += 1
            continue
        cache.put(key, model, reply)
        answered += 1
    return answered, failed


def _rows(path: Path) -> Iterator[dict[str, Any]]:
    try:
        size = path.stat().st_size
        if size > BATCH.most:
            raise LabelError(
                f"{path}: {size >> 20:,} MB large, and at most {BATCH.most >> 20:,} MB are read of {BATCH.what}; "
                "split it"
            )
        with path.open(encoding="utf-8") as file:
            for number, line in enumerate(lines_within(file, REPLY.most + 1), 1):
                if not line.strip():
                    continue
                try:
                    row = json.loads(line) if len(line) <= REPLY.most else None
                except (ValueError, RecursionError):
                    row = None
                if not isinstance(row, dict):
                    raise LabelError(f"{path}: line {number} is no JSON object; give the provider's file of results")
                yield row
    except FileNotFoundError as error:
        raise LabelError(f"{path}: no such file; {CHECK_PATH}") from error
    except (OSError, UnicodeDecodeError) as error:
        raise LabelError(
            f"{path}: can't be read ({type(error).__name__}); give the provider's file of results"
        ) from error


def _reply(row: dict[str, Any], scrub: Callable[[str], str]) -> Reply | None:
    response = row.get("response")
    if row.get("error") or not isinstance(response, dict) or response.get("status_code") != 200:
        return None
    body = response.get("body")
    choices = body.get("choices") if isinstance(body, dict) else None
    if not isinstance(body, dict) or not isinstance(choices, list) or not choices or not isinstance(choices[0], dict):
        return None
    message = choices[0].get("message")
    usage = body.get("usage")
    if not isinstance(message, dict):
        return None
    text, refusal = message.get("content"), message.get("refusal")
    tokens = usage if isinstance(usage, dict) else {}
    return Reply(
        spoken(scrub(text)) if isinstance(text, str) else None,
        scrub(refusal)[:300] if isinstance(refusal, str) else None,
        _count(tokens.get("prompt_tokens")),
        _count(tokens.get("completion_tokens")),
        batch=True,
    )


def _count(value: Any) -> int:
    return value if isinstance(value, int) and 0 <= value < 10**9 else 0
