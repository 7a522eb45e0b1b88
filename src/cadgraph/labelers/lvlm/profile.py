"""What is known of models that people run themselves, and of the servers that they run behind."""

from __future__ import annotations

import fnmatch
import math
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal
from urllib.parse import urlsplit

from pydantic import BaseModel, ConfigDict, Field, model_validator

from cadgraph._io.limits import PROFILES
from cadgraph.labelers.lvlm.manner import GAP, LEVELS, Manner, sent
from cadgraph.labelers.lvlm.tables import checked, read_table, where_of

__all__ = ["Profile", "read_profile"]

_SAFE = 0.95  # of a context is filled by our estimate, which may be too low


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class _Tokens(_Strict):
    """Of a picture."""

    fixed: int | None = Field(default=None, ge=0)
    patch: int | None = Field(default=None, ge=1)
    tile: int | None = Field(default=None, ge=1)
    each: int = Field(default=0, ge=0)
    most: int = Field(default=12, ge=1)

    @model_validator(mode="after")
    def _one(self) -> _Tokens:
        if sum(way is not None for way in (self.fixed, self.patch, self.tile)) != 1:
            raise ValueError("give one of fixed, patch and tile")
        return self

    def of(self, width: int, height: int) -> int:
        """How many a picture takes [px]."""
        if self.fixed is not None:
            return self.fixed
        if self.patch is not None:
            return math.ceil(width / self.patch) * math.ceil(height / self.patch)
        side = self.tile or 1
        # As InternVL tiles a square: more tiles where the picture has more than half of their pixels; and a thumbnail.
        tiles = max(
            (n * n for n in range(1, 7) if n * n <= self.most and width * height > side**2 * n * n / 2), default=1
        )
        return self.each * (tiles + (tiles > 1))


class _Server(_Strict):
    name: str
    context: int | None = Field(default=None, ge=256)
    schema_: Literal["json_schema", "json_object", "none"] | None = Field(default=None, alias="schema")
    limit: Literal["max_tokens", "max_completion_tokens"] | None = None


class _Model(_Server):
    match: tuple[str, ...] = Field(min_length=1)
    pictures: int | None = Field(default=None, ge=1)
    side: int | None = Field(default=None, ge=64)
    tokens: _Tokens | None = None
    system: bool = True
    temperature: bool = True


_UNKNOWN, _NOWHERE = _Model(name="", match=("",)), _Server(name="")


class _Table(_Strict):
    models: tuple[_Model, ...] = ()
    servers: dict[int, _Server] = {}


class Profile(_Strict):
    """What is known of a model behind a server.

    Args:
        model: name of its family; empty where it isn't known.
        server: what it runs behind; empty where that isn't known.
        context: tokens of question and answer together, or None.
        tokens: of a picture, or None.
        manner: to begin with.
    """

    model: str = ""
    server: str = ""
    context: int | None = None
    tokens: _Tokens | None = None
    manner: Manner = Manner()

    @property
    def told(self) -> str:
        """In words, for people; empty where nothing is known."""
        if not self.model and not self.server and self.context is None:
            return ""
        who = " behind ".join(name for name in (self.model or "a model that isn't known", self.server) if name)
        told = [f"taken for {who}"]
        told += [f"a context of {self.context:,} tokens"] if self.context else []
        told += [f"{_pictures(self.manner.pictures)} a message"] if self.manner.pictures else []
        told += [f"at most {self.manner.side} px"] if self.manner.side else []
        return ", ".join(told)

    def to_json(self) -> dict[str, Any]:
        """As plain values, for the record of a run."""
        return {"model": self.model or None, "server": self.server or None, "context": self.context}

    def picture_tokens(self, n: int, size: int, manner: Manner | None = None) -> int:
        """Tokens of the pictures of a question as they are sent; 0 where nothing is known of them.

        Args:
            n: pictures of the question.
            size: side of each [px].
            manner: in which it is asked; that to begin with if None.
        """
        if self.tokens is None:
            return 0
        manner = manner or self.manner
        side, shown = sent(manner.level, n)
        side = min(limit for limit in (size, side, manner.side) if limit is not None)
        if manner.pictures is None or shown <= manner.pictures:
            return shown * self.tokens.of(side, side)
        columns = math.ceil(math.sqrt(math.ceil(shown / manner.pictures)))
        whole = columns * (side + GAP)
        whole = whole if manner.side is None else min(whole, manner.side)
        return manner.pictures * self.tokens.of(whole, whole)

    def level(self, words: int, n: int, size: int, answer: int, manner: Manner | None = None) -> int:
        """Which of ``manner.LEVELS`` the context leaves room for; the last where it leaves room for none.

        Args:
            words: tokens of the question without pictures.
            n: pictures of the question.
            size: side of each [px].
            answer: tokens that an answer may have.
            manner: in which it is asked; that to begin with if None.
        """
        manner = manner or self.manner
        if self.context is None or self.tokens is None:
            return manner.level
        for level in range(manner.level, len(LEVELS)):
            if words + self.picture_tokens(n, size, replace(manner, level=level)) + answer <= _SAFE * self.context:
                return level
        return len(LEVELS) - 1


def read_profile(
    model: str, address: str, file: str | Path = "", *, context: int | None = None, pictures: int | None = None,
    schema: str = "auto",
) -> Profile:  # fmt: skip
    """What is known of a model at an address; settings count more.

    Args:
        model: its name, as the server knows it.
        address: of the server.
        file: another table; the built-in one if empty.
        context: the server's, if somebody knows better.
        pictures: of a message at most, if somebody knows better.
        schema: how the server is held to a form; ``auto`` leaves it to the table.

    Raises:
        LabelError: the table can't be read or is malformed.
    """
    table = _read(file)
    name = model.rpartition("/")[2].partition(":")[0].lower()
    known = next((row for row in table.models if any(fnmatch.fnmatchcase(name, each) for each in row.match)), _UNKNOWN)
    server = table.servers.get(_port(address) or -1, _NOWHERE)
    contexts = [row.context for row in (server, known) if row.context is not None]
    form = server.schema_ or known.schema_ or "json_schema"
    return Profile(
        model=known.name,
        server=server.name,
        context=context or min(contexts, default=None),
        tokens=known.tokens,
        manner=Manner(
            schema=form if schema == "auto" else schema,
            limit=server.limit or known.limit or "max_completion_tokens",
            temperature=known.temperature,
            system=known.system,
            pictures=pictures or known.pictures,
            side=known.side,
        ),
    )


def _read(file: str | Path) -> _Table:
    return checked(_Table, read_table(file, "profiles.yaml", PROFILES), where_of(file, PROFILES))


def _port(address: str) -> int | None:
    try:
        return urlsplit(address).port
    except ValueError:
        return None


def _pictures(n: int) -> str:
    return "one picture" if n == 1 else f"at most {n} pictures"
