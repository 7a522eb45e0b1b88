"""Calls on a Ray cluster: where they run, and again after a process or a node is lost, is Ray's to decide."""

from __future__ import annotations

import logging
import os
import re
import secrets
import signal
import socket
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import cadgraph
from cadgraph._io.atomic import write_atomically
from cadgraph.distribute.hands import Call, Failure
from cadgraph.errors import CadGraphError, MissingExtra
from cadgraph.geometry.kernels.parallel import use_threads

__all__ = ["LOCAL", "RayHands", "check_address"]

LOCAL = "local"
"""The address of a cluster that is started on this machine, and gone with the run."""

_ADDRESS = re.compile(r"local|auto|[\w.-]+:\d{1,5}|\[[0-9a-fA-F:]+\]:\d{1,5}")
_RETRIES = 3  # of a call after the loss of its process or of its node
_AHEAD = 2  # calls for each processor that Ray knows of at a time
_PAUSE = 0.02  # s between two looks at what is done
_PATIENCE = 5.0  # s for a cluster to answer at all
_PROBE = 120.0  # s for each node to start a process and import cadgraph
_LONGEST = 200  # characters of what Ray says of an error
_LOST = "the cluster lost it each time it was tried"


def check_address(address: str) -> None:
    """Makes sure that a text may be the address of a cluster.

    Raises:
        ValueError: it can't.
    """
    if not _ADDRESS.fullmatch(address):
        raise ValueError(
            f"--ray {address}: no address of a Ray cluster; give local (starts one here), auto (the one that runs on "
            "this machine) or HOST:PORT"
        )


class RayHands:
    """Runs calls on a Ray cluster. Use it as a context: on its end the connection is closed, a local cluster is gone.

    All nodes must have cadgraph of this version, and see the folder under the same name; both are tried first. Where
    the caller's script is connected to a cluster already, that one is used and stays.

    Args:
        address: ``"local"`` starts a cluster on this machine, ``"auto"`` finds a running one, else ``"host:port"``.
        folder: that all nodes must see; it exists.
        workers: of a cluster that is started: its processors; of one that runs: how many calls at a time, at most.
            None: all processors.

    Raises:
        ValueError: ``address`` can't be one, or ``workers`` is below 1.
        MissingExtra: Ray is not installed.
        CadGraphError: no cluster answers at the address, or a node of it can't do the work.
    """

    def __init__(self, address: str, folder: Path, workers: int | None = None) -> None:
        check_address(address)
        if workers is not None and workers < 1:
            raise ValueError(f"workers is {workers}; give at least 1")
        self._address, self._workers = address, workers
        self._ray: Any = _import_ray(address)
        self._own = not self._ray.is_initialized()
        if self._own:
            self._connect()
        if not (self._own and address == LOCAL):
            try:
                self._probe(folder.absolute())
            except BaseException:
                self._leave()
                raise

    def __enter__(self) -> RayHands:
        return self

    def __exit__(self, *_: object) -> None:
        self._leave()

    @property
    def count(self) -> int:
        """How many work at a time: the processors of the cluster as it is now, or fewer."""
        there = max(1, int(self._ray.cluster_resources().get("CPU", 1)))
        return there if self._workers is None else min(there, self._workers)

    @property
    def ended(self) -> int:
        """None that is known of: Ray tries calls again by itself, and tells nobody."""
        return 0

    def run(
        self,
        function: Callable[..., Any],
        calls: Sequence[Call],
        told: Callable[[float], None] | None = None,
        each: Callable[[int, Any], None] | None = None,
    ) -> list[Any]:
        """Runs calls; see ``Hands.run``."""
        remote = self._ray.remote(num_cpus=1, max_retries=_RETRIES)(_in_one_thread)
        results: list[Any] = [None] * len(calls)
        waiting, running = deque(range(len(calls))), dict[Any, int]()
        n_done = 0
        while waiting or running:
            # A cluster that may grow sees that there is more to do; one that stays as it is isn't flooded.
            most = self.count * (1 if self._workers is not None else _AHEAD)
            while waiting and len(running) < most:
                number = waiting.popleft()
                running[remote.remote(function, calls[number])] = number
            # Not in Ray's own waiting, where a signal gets lost.
            done, _ = self._ray.wait(list(running), num_returns=len(running), timeout=0)
            for one in done:
                number = running.pop(one)
                results[number] = self._result(one)
                n_done += 1
                if each is not None:
                    each(number, results[number])
                if told is not None:
                    told(n_done / len(calls))
            if not done:
                time.sleep(_PAUSE)
        return results

    def _result(self, one: Any) -> Any:
        exceptions = self._ray.exceptions
        try:
            return self._ray.get(one)
        except exceptions.RayTaskError as error:
            cause = error.cause if isinstance(error.cause, Exception) else None
            return Failure(_line_of(cause or error), cause)
        except exceptions.RayError as error:
            return Failure(f"{_LOST} ({_line_of(error)})")

    def _connect(self) -> None:
        """Connects to the cluster, or starts one."""
        more: dict[str, Any] = {}
        if self._address == LOCAL:
            more = {"num_cpus": self._workers, "include_dashboard": False}
        elif self._address != "auto":
            _check_answers(self._address)
        try:
            with _signals_kept(), _no_words():
                self._ray.init(address=self._address, log_to_driver=False, logging_level=logging.CRITICAL, **more)
            # What it says of lost processes, in many lines on standard output, is told by results that don't come. It
            # has no option for that; its own debugger does the same.
            with suppress(AttributeError):
                self._ray._private.worker._worker_logs_enabled = False
        except (ConnectionError, ValueError, RuntimeError, OSError, TimeoutError) as error:
            self._leave()
            raise CadGraphError(
                f"--ray {self._address}: no Ray cluster that can be used there ({_line_of(error)}); '--ray local' "
                "starts one on this machine"
            ) from error

    def _leave(self) -> None:
        if self._own:
            with _signals_kept(), _no_words():
                self._ray.shutdown()

    def _probe(self, folder: Path) -> None:
        """Makes sure that each node has this cadgraph and sees the folder; nodes that come later are not asked.

        Raises:
            CadGraphError: one doesn't.
        """
        from ray.util.scheduling_strategies import NodeAffinitySchedulingStrategy as At

        word, mark = secrets.token_hex(8), folder / f".cadgraph-probe-{os.getpid()}"
        write_atomically(mark, word)
        try:
            remote = self._ray.remote(num_cpus=0, max_retries=1)(_look_from_node)
            nodes = [node for node in self._ray.nodes() if node["Alive"] and node["Resources"].get("CPU", 0) >= 1]
            asked = {
                remote.options(scheduling_strategy=At(node["NodeID"], soft=False)).remote(str(mark)): node
                for node in nodes
            }
            until = time.monotonic() + _PROBE
            running = list(asked)
            while running and time.monotonic() < until:
                done, running = self._ray.wait(running, num_returns=len(running), timeout=0)
                for one in done:
                    self._judge(self._result(one), asked[one], word, folder)
                time.sleep(_PAUSE)
        finally:
            with suppress(OSError):
                mark.unlink()
        if running:
            raise CadGraphError(f"--ray {self._address}: node {_name_of(asked[running[0]])} doesn't answer")

    def _judge(self, said: Any, node: dict[str, Any], word: str, folder: Path) -> None:
        """Refuses a cluster by what one of its nodes sees; a node that is lost meanwhile says nothing."""
        where = f"--ray {self._address}: node {_name_of(node)}"
        if isinstance(said, Failure):
            if said.reason.startswith(_LOST):
                return
            raise CadGraphError(f"{where} can't run cadgraph ({said.reason}); install it there, of this version")
        version, seen = said
        if version != cadgraph.__version__:
            raise CadGraphError(f"{where} has cadgraph {version}, this is {cadgraph.__version__}; make them the same")
        if seen != word:
            raise CadGraphError(f"{where} doesn't see {folder}; put the results on a disk that all nodes share")


def _import_ray(address: str) -> Any:
    """Ray, told to send nothing to anybody."""
    # Read when it is imported, or when a cluster is started; what the user says himself holds.
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
    # A call that never fits into memory is to end like one whose process ends, and not to be tried for ever.
    os.environ.setdefault("RAY_task_oom_retries", str(_RETRIES))
    if address != LOCAL:
        # Where somebody listens who is no cluster, a minute is enough to find out.
        os.environ.setdefault("RAY_NUM_REDIS_GET_RETRIES", "2")
    try:
        import ray
        import ray.exceptions
    except ImportError:
        raise MissingExtra("--ray", "ray") from None
    return ray


def _check_answers(address: str) -> None:
    """Asks first whether anybody listens, as Ray takes a minute and many lines to find out."""
    host, _, port = address.rpartition(":")
    try:
        socket.create_connection((host.strip("[]"), int(port)), timeout=_PATIENCE).close()
    except (OSError, OverflowError) as error:
        raise CadGraphError(
            f"--ray {address}: nobody answers there ({getattr(error, 'strerror', None) or error}); 'ray status' on a "
            "node of the cluster tells its address"
        ) from error


@contextmanager
def _signals_kept() -> Iterator[None]:
    """Whatever the block does to them, Ctrl-C and a polite kill do after it what they did before."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            if handler is not None:
                signal.signal(number, handler)


@contextmanager
def _no_words() -> Iterator[None]:
    """Within the block nothing is said on standard error, also by what is no Python; errors are raised all the same."""
    try:
        kept = os.dup(2)
    except OSError:  # it is closed
        yield
        return
    if sys.stderr is not None:
        sys.stderr.flush()
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)


def _in_one_thread(function: Callable[..., Any], call: Call) -> Any:
    """A call has one processor, as the cluster counts them."""
    use_threads(1)
    return function(*call)


def _look_from_node(mark: str) -> tuple[str, str | None]:
    """The version of cadgraph on a node, and what a file holds there; None where it isn't seen."""
    try:
        return cadgraph.__version__, Path(mark).read_text(encoding="utf-8")
    except OSError:
        return cadgraph.__version__, None


def _name_of(node: dict[str, Any]) -> str:
    return str(node.get("NodeManagerHostname") or node.get("NodeManagerAddress") or node["NodeID"])


def _line_of(error: BaseException) -> str:
    """What an error says, in one line: the last, where it tells a whole trace."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()] or [type(error).__name__]
    return lines[-1 if "Traceback" in str(error) or "ray::" in lines[0] else 0][:_LONGEST]
