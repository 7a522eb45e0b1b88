"""What is skipped, repaired, guessed or left open, in every stage and in the graph."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from cadgraph.model.record import Record

__all__ = ["Diagnostic"]


class Diagnostic(Record):
    """One thing that was skipped, repaired, guessed or left open.

    Args:
        code: a stable kebab-case word for programs (``"missing-reference"``).
        message: one line for people.
        meshes: source paths that it concerns, maybe none.
    """

    code: str = Field(description="stable kebab-case word")
    message: str
    meshes: tuple[str, ...] = ()

    def __init__(self, code: str, message: str, meshes: tuple[str, ...] = (), **unknown: Any) -> None:
        super().__init__(**{"code": code, "message": message, "meshes": meshes, **unknown})
