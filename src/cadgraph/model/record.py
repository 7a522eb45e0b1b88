"""What all records of ``graph.json`` have in common."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

from pydantic import BaseModel, ConfigDict

__all__ = ["Record"]


class Record(BaseModel):
    """A frozen record that keeps keys it doesn't know."""

    model_config = ConfigDict(frozen=True, extra="allow", allow_inf_nan=False, ser_json_inf_nan="constants")

    def model_post_init(self, context: Any, /) -> None:
        """Gives up what pydantic notes of each record beside its values: it takes as much memory as they do.

        Which fields were given, and which stayed as they are by default, is asked of no record.
        """
        _set(self, "__pydantic_fields_set__", _NONE_GIVEN)
        if not self.__pydantic_extra__:
            _set(self, "__pydantic_extra__", _NOTHING_ELSE)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """A copy with some values put in place of its own, which are not checked."""
        copied = super().model_copy(update=update, deep=deep)
        copied.model_post_init(None)
        return copied


# Frozen records don't change them, and what is copied from one has its own.
_NONE_GIVEN: set[str] = set()
_NOTHING_ELSE: dict[str, Any] = {}
_set = object.__setattr__
