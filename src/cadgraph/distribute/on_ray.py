"""Calls on a Ray cluster; where they run, and again after a process or a node is lost, is Ray's to decide."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

from cadgraph.distribute.hands import Call, Failure
from cadgraph.errors import CadGraphError, MissingExtra
from cadgraph.geometry.kernels.parallel import use_threads

__all__ = ["RayHands"]

_RETRIES = 4  # after the loss of a process or of its node


class RayHands:
    """Runs calls on a Ray cluster. Use it as a context: on its end the connection is closed.

    All nodes must have cadgraph of this version, and see the folders of the run under the same names.

    Args:
        address: of the cluster, as Ray knows it; ``"local"`` starts one on this machine, ``"auto"`` finds a running one.
        workers: processors of a cluster that is started; None: all.

    Raises:
        MissingExtra: Ray is not installed.
        CadGraphError: there is no cluster at the address.
    """

    def __init__(self, address: str, workers: int | None = None) -> None:
        # Nothing is sent to anybody by default.
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        try:
            import ray
        except ImportError:
            raise MissingExtra("working on a Ray cluster", "ray") from None
        self._ray: Any = ray
        self._own = not ray.is_initialized()
        if self._own:
            local = {"num_cpus": workers, "include_dashboard": False} if address == "local" else {}
            try:
                ray.init(address=address, log_to_driver=False, logging_level="error", **local)
            except (ConnectionError, ValueError, RuntimeError) as error:
                reason = " ".join(str(error).split())[:200]
                raise CadGraphError(f"--ray {address}: no cluster there ({reason}); '--ray local' starts one") from error

    def __enter__(self) -> RayHands:
        return self

    def __exit__(self, *_: object) -> None:
        if self._own:
            self._ray.shutdown()

    @property
    def count(self) -> int:
        """How many work at a time: the processors of the cluster as it is now."""
        return max(1, int(self._ray.cluster_resources().get("CPU", 1)))

    def run(
        self, function: Callable[..., Any], calls: Sequence[Call], told: Callable[[float], None] | None = None
    ) -> list[Any]:
        """Runs calls; see ``Hands.run``."""
        ray = self._ray
        remote = ray.remote(num_cpus=1, max_retries=_RETRIES)(_in_one_thread)
        numbers = {remote.remote(function, call): number for number, call in enumerate(calls)}
        results: list[Any] = [None] * len(calls)
        waiting = list(numbers)
        while waiting:
            done, waiting = ray.wait(waiting, num_returns=1)
            for one in done:
                results[numbers[one]] = self._result(one)
            if told is not None:
                told(1 - len(waiting) / len(calls))
        return results

    def _result(self, one: Any) -> Any:
        exceptions = self._ray.exceptions
        try:
            return self._ray.get(one)
        except exceptions.RayTaskError as error:
            cause = error.cause if isinstance(error.cause, Exception) else None
            return Failure(str(cause or error).strip().splitlines()[-1], cause)
        except exceptions.RayError as error:
            return Failure(f"lost by the cluster ({str(error).strip().splitlines()[0]})")


def _in_one_thread(function: Callable[..., Any], call: Call) -> Any:
    """A task has one processor, as the cluster counts them."""
    use_threads(1)
    return function(*call)
