"""What all records of ``graph.json`` have in common."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

__all__ = ["Record"]


class Record(BaseModel):
    """A frozen record that keeps keys it doesn't know."""

    model_config = ConfigDict(frozen=True, extra="allow", allow_inf_nan=False)
