"""What questions cost: tokens estimated, prices looked up."""

from __future__ import annotations

import functools
import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from cadgraph._io.limits import PRICES
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.tables import checked, read_table, where_of

__all__ = ["ANSWER_TOKENS", "Estimate", "Price", "question_tokens", "read_price", "text_tokens"]

ANSWER_TOKENS = 95
"""Tokens of an answer as asked for: seven keys, 25 words."""

_MESSAGE_TOKENS = 4  # that a message takes beside its text
# One token each: up to seven letters (on average over English technical text), three digits, three marks.
_PIECES = re.compile(r"[A-Za-z]{1,7}|[0-9]{1,3}|[^\sA-Za-z0-9]{1,3}")


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class _Tiles(_Strict):
    base: float = Field(ge=0)
    tile: float = Field(ge=0)


class _Patches(_Strict):
    factor: float = Field(ge=0)
    most: int = Field(ge=1)


class _Image(_Strict):
    tiles: _Tiles | None = None
    patches: _Patches | None = None
    fixed: float | None = Field(default=None, ge=0)


class Price(_Strict):
    """Of one model: US dollars for a million tokens, and how pictures are counted."""

    input: float = Field(ge=0)
    output: float = Field(ge=0)
    batch: float = Field(default=1.0, ge=0, le=1)
    image: _Image = _Image()

    def image_tokens(self, width: int, height: int, detail: str) -> float:
        """Tokens of a picture [px]."""
        rule = self.image
        if rule.fixed is not None:
            return rule.fixed
        if rule.patches is not None:
            patches = math.ceil(width / 32) * math.ceil(height / 32)
            return rule.patches.factor * min(patches, rule.patches.most)
        if rule.tiles is None:
            return 0.0
        if detail == "low":
            return rule.tiles.base
        shrink = min(1.0, 2048 / max(width, height))
        width, height = int(width * shrink), int(height * shrink)
        shrink = min(1.0, 768 / min(width, height))
        tiles = math.ceil(width * shrink / 512) * math.ceil(height * shrink / 512)
        return rule.tiles.base + rule.tiles.tile * tiles

    def cost(self, prompt_tokens: float, answer_tokens: float, *, batch: bool = False) -> float:
        """In US dollars."""
        return (prompt_tokens * self.input + answer_tokens * self.output) * 1e-6 * (self.batch if batch else 1.0)


@dataclass(frozen=True)
class Estimate:
    """What questions will need.

    Args:
        questions: that would be sent.
        known: further ones that the cache answers.
        prompt_tokens: in all.
        answer_tokens: in all.
        cost: in US dollars, or None where the model has no price.
        model: that is asked.
        left_out: questions that the budget leaves out.
        resumed: of those that would be sent, how many an earlier run had sent without hearing of them again.
        profile: what is known of the model and its server, in words.
    """

    questions: int
    known: int
    prompt_tokens: int
    answer_tokens: int
    cost: float | None
    model: str
    left_out: int = 0
    resumed: int = 0
    profile: str = ""


@functools.lru_cache(256)
def text_tokens(text: str) -> int:
    """About how many tokens a text is: long words are several, short ones and runs of marks one."""
    return _MESSAGE_TOKENS + len(_PIECES.findall(text))


def question_tokens(system: str, text: str, schema: Mapping[str, Any], n_pictures: int) -> int:
    """About how many tokens a question takes without its pictures: texts, captions, and the schema, compressed."""
    return text_tokens(system) + text_tokens(text) + text_tokens(json.dumps(schema)) // 2 + 10 * n_pictures


def read_price(model: str, file: str | Path = "", *, local: bool = False) -> Price | None:
    """The price of a model: the entry with the longest key that begins its name.

    Args:
        model: its name.
        file: another table; the built-in one if empty.
        local: whether a server of one's own is asked: without an entry, nothing is billed.

    Returns:
        None where the table has no entry.

    Raises:
        LabelError: the table can't be read or is malformed.
    """
    where, table = where_of(file, PRICES), read_table(file, "prices.yaml", PRICES)
    if not isinstance(table, Mapping):
        raise LabelError(f"{where}: not a table of models; see the built-in one for its layout")
    keys = [key for key in table if isinstance(key, str) and key != "local" and model.startswith(key)]
    key = max(keys, key=len, default="local" if local and "local" in table else None)
    if key is None:
        return None
    return checked(Price, table[key], where, key)
