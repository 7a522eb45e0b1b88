"""How far the server is, what can be done with the plant, and everybody who waits for that to change."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

from cadgraph._io.text import printable

__all__ = ["Feed", "Refusal", "State", "one_line"]

_BEAT = 15.0  # s between two signs of life where nothing changes
_STEP = 0.1  # s that changes are gathered for


def one_line(text: str) -> str:
    """A text without line breaks and other control characters, for a message."""
    return printable(" ".join(text.split()), "\N{REPLACEMENT CHARACTER}")


@dataclass(frozen=True)
class State:
    """What the page shows above the plant.

    Args:
        status: whether the plant is read and built, can be worked on, or could not be read.
        stage: at work, where it is built.
        share: of that stage that is done, 0..1.
        message: why it failed, or what the person should know.
        version: of the content; grows with every change. 0 while there is none; it may be there before all is ready.
        read_only: why nothing can be changed, or None.
        title: file name of the source.
        folder: name of the folder of results.
        can_undo: whether there is an action to take back.
        can_redo: whether one was taken back last.
        undo: what would be taken back, in words.
        redo: what would be done again, in words.
        n_edits: corrections in force, as often as one can undo.
        lost: corrections that no longer fit the model, in words.
        who: name under which actions are kept.
    """

    status: Literal["building", "ready", "failed"] = "building"
    stage: str = ""
    share: float = 0.0
    message: str = ""
    version: int = 0
    read_only: str | None = None
    title: str = ""
    folder: str = ""
    can_undo: bool = False
    can_redo: bool = False
    undo: str | None = None
    redo: str | None = None
    n_edits: int = 0
    lost: tuple[str, ...] = ()
    who: str = ""

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {**asdict(self), "lost": list(self.lost)}


class Refusal(Exception):
    """A request that can't be met, with what the person can do about it.

    Args:
        status: of HTTP.
        reason: one line.
        state: as it is now, for a page that is behind it.
    """

    def __init__(self, status: int, reason: str, state: State | None = None) -> None:
        self.status, self.reason, self.state = status, reason, state
        super().__init__(reason)


class Feed:
    """The state as it is now; one thread changes it, requests follow it.

    Args:
        state: to begin with.
    """

    def __init__(self, state: State) -> None:
        self._state = state
        self._lock = threading.Lock()
        self._closed = False
        self._followers: dict[asyncio.Event, asyncio.AbstractEventLoop] = {}

    @property
    def state(self) -> State:
        """As it is now."""
        return self._state

    def publish(self, **changes: Any) -> State:
        """Changes some values, and tells everybody who follows.

        Args:
            changes: names and values of :class:`State`.
        """
        with self._lock:
            new = replace(self._state, **changes)
            if new != self._state:
                self._state = new
                self._wake()
        return new

    def close(self) -> None:
        """Ends what follows the state."""
        with self._lock:
            self._closed = True
            self._wake()

    def _wake(self) -> None:
        for event, loop in self._followers.items():
            loop.call_soon_threadsafe(event.set)

    async def follow(self) -> AsyncIterator[State | None]:
        """The state now and after each change, until the feed is closed; None now and then as a sign of life."""
        event = asyncio.Event()
        with self._lock:
            self._followers[event] = asyncio.get_running_loop()
        try:
            while not self._closed:
                event.clear()
                yield self._state
                while not event.is_set() and not self._closed:
                    try:
                        await asyncio.wait_for(event.wait(), _BEAT)
                    except TimeoutError:
                        yield None
                if not self._closed:
                    await asyncio.sleep(_STEP)
        finally:
            with self._lock:
                del self._followers[event]
