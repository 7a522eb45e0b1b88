"""Calls in processes of this machine; one that is killed costs its calls another try, not the run."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.synchronize import Event
from typing import Any

from cadgraph.distribute.hands import Call, Failure
from cadgraph.errors import CadGraphError
from cadgraph.geometry.kernels.parallel import use_threads

__all__ = ["Processes"]

_SPAWN = get_context("spawn")
_TRIES = 3  # of a call whose process ends
_MOST_EACH, _LEAST_MOST = 4, 16  # processes for each processor, and what may be asked for anywhere
_UNGUARDED = (
    "the processes that share the work ended as they started. Each imports the script that asks for them: it must be a "
    'file, with its own work under if __name__ == "__main__":'
)
_ENDED = "its process ended each time it was tried; for want of memory give fewer --workers, or more --tiles"


class Processes:
    """Runs calls in processes of this machine. Use it as a context: on its end they are gone.

    A script that uses it must keep its own work under ``if __name__ == "__main__":``, as each process imports it.

    Args:
        workers: processes; at most four for each processor, or 16.
        threads: that kernels use in each; None: the processors divided among them.
    """

    def __init__(self, workers: int, threads: int | None = None) -> None:
        processors = os.cpu_count() or 1
        most = max(_LEAST_MOST, _MOST_EACH * processors)
        if workers < 1:
            raise ValueError(f"workers is {workers}; give at least 1")
        if workers > most:
            raise ValueError(
                f"workers is {workers}, for {processors} processor{'s' * (processors != 1)}; give at most {most}: more "
                "processes than processors only take memory"
            )
        self._workers = workers
        self._threads = threads or max(1, processors // workers)
        self._pool: ProcessPoolExecutor | None = None
        self._ended = 0
        self._begun = _SPAWN.Event()  # whether any process came as far as to its work

    def __enter__(self) -> Processes:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None and self._pool is not None:
            # Who was stopped doesn't wait for what is still being worked out: results are written whole or not at all.
            for process in list((getattr(self._pool, "_processes", None) or {}).values()):
                process.terminate()
        self._drop()

    @property
    def count(self) -> int:
        """How many work at a time."""
        return self._workers

    @property
    def ended(self) -> int:
        """How often a process ended amid its calls, which were then tried again."""
        return self._ended

    def run(
        self,
        function: Callable[..., Any],
        calls: Sequence[Call],
        told: Callable[[float], None] | None = None,
        each: Callable[[int, Any], None] | None = None,
    ) -> list[Any]:
        """Runs calls; see ``Hands.run``.

        Raises:
            CadGraphError: no process starts, as the script that each of them imports doesn't let it.
        """
        results: dict[int, Any] = {}

        def done(number: int, result: Any) -> None:
            results[number] = result
            if each is not None:
                each(number, result)
            if told is not None:
                told(len(results) / len(calls))

        waiting = list(range(len(calls)))
        for attempt in range(_TRIES):
            if not waiting:
                break
            # Which call ends a process can't be told while several run; the last time each has one for itself.
            groups = [[number] for number in waiting] if attempt == _TRIES - 1 else [waiting]
            for group in groups:
                self._try(function, calls, group, done)
            waiting = [number for number in waiting if number not in results]
        for number in waiting:
            done(number, Failure(_ENDED))
        return [results[number] for number in range(len(calls))]

    def _try(
        self,
        function: Callable[..., Any],
        calls: Sequence[Call],
        numbers: Sequence[int],
        done: Callable[[int, Any], None],
    ) -> None:
        """Runs some of the calls; those are without a result whose process ended."""
        try:
            pool = self._running()
            with _deaf_to_ctrl_c():
                futures = {pool.submit(function, *calls[number]): number for number in numbers}
        except BrokenProcessPool:
            self._drop_broken()
            return
        broken = False
        for future in as_completed(futures):
            try:
                result = future.result()
            except BrokenProcessPool:
                broken = True
                continue
            except Exception as error:  # noqa: BLE001 - whatever a call raises is its result
                result = Failure(str(error) or type(error).__name__, error)
            done(futures[future], result)
        if broken:
            self._drop_broken()

    def _running(self) -> ProcessPoolExecutor:
        if self._pool is None:
            self._pool = ProcessPoolExecutor(
                self._workers, _SPAWN, initializer=_begin, initargs=(self._threads, self._begun)
            )
        return self._pool

    def _drop_broken(self) -> None:
        processes = list((getattr(self._pool, "_processes", None) or {}).values())
        self._drop()
        self._ended += 1
        # Of one that the system ended, as for want of memory, the code is negative.
        if not self._begun.is_set() and any((process.exitcode or 0) > 0 for process in processes):
            raise CadGraphError(_UNGUARDED)

    def _drop(self) -> None:
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)
            self._pool = None


@contextmanager
def _deaf_to_ctrl_c() -> Iterator[None]:
    """Within the block, what Ctrl-C does to this process waits; processes that are started here never hear of it, even
    while they import what they need.
    """
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin(threads: int, begun: Event) -> None:
    """What each process does first."""
    begun.set()
    use_threads(threads)
    # Ctrl-C ends the parent, which then ends these.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Nobody waits for the results of a parent that was killed."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
