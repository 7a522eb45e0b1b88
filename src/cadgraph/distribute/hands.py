"""What a crew works with: something that runs calls elsewhere, and says which of them failed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

__all__ = ["Call", "Failure", "Hands"]

Call = tuple[Any, ...]
"""The arguments of one call: names of files, numbers; never geometry."""


@dataclass(frozen=True)
class Failure:
    """A call that came to nothing, though it was tried again.

    Args:
        reason: one line.
        error: what it raised; None where its process ended instead.
    """

    reason: str
    error: Exception | None = None


class Hands(Protocol):
    """Run calls of one function, each in a process that may end at any time, and again where one did."""

    @property
    def count(self) -> int:
        """How many work at a time."""
        ...

    @property
    def ended(self) -> int:
        """How often a process ended amid its calls, which were then tried again; as far as that is known."""
        ...

    def run(
        self,
        function: Callable[..., Any],
        calls: Sequence[Call],
        told: Callable[[float], None] | None = None,
        each: Callable[[int, Any], None] | None = None,
    ) -> list[Any]:
        """Runs calls.

        Args:
            function: of a module, so that another process finds it; the same call may be run twice.
            calls: its arguments.
            told: called with the share that is done.
            each: called with the number of a call and what came of it, as soon as that is known.

        Returns:
            What each call returned, or its ``Failure``, in the order of the calls.
        """
        ...
