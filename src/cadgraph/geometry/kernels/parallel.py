"""Compiled kernels, and how they are spread over threads."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import numba
import numpy as np
from numpy.typing import NDArray

from cadgraph.model.scene import Ints

__all__ = ["ZERO", "compiled", "for_ranges", "in_turn", "n_threads", "readable", "use_threads"]

_F = TypeVar("_F", bound=Callable[..., Any])
_T = TypeVar("_T", bound=np.generic)
_Found = TypeVar("_Found")

# Where an integer that kernels hand to each other starts: for a plain 0 they would be compiled once more.
ZERO: Any = np.int64(0)

# More ranges than threads, so that a thread that drew light ones takes another.
_RANGES_PER_WORKER = 8

_threads: int | None = None  # of this process; None: as many as there are processors


def use_threads(n: int | None) -> None:
    """Sets how many threads kernels use in this process where their caller doesn't say.

    For processes that share a machine with others of their kind: each takes its part of the processors.

    Args:
        n: at least 1; None: all processors.
    """
    global _threads
    _threads = n


def compiled(function: _F) -> _F:
    """Compiles a kernel to machine code that runs outside the interpreter lock, cached on disk.

    Divisions follow IEEE 754 (no exception on zero); fast-math stays off, so that results are the same everywhere.

    The first run on a machine waits for the compiler: about 1 ms for each operation, 2 ms for each access to an array
    of two dimensions, 6 ms for each loop or new array. Keep to loops over scalars: array expressions, slices, sorting
    and ``np.linalg`` pull in thousands of lines. An integer that starts as a constant and goes to another kernel
    should start as ``ZERO``.
    """
    # Nobody calls kernels from C, and each such entry would have to be compiled too.
    kernel: Any = numba.njit(cache=True, nogil=True, error_model="numpy", no_cfunc_wrapper=True)(function)
    # numba throws a cached kernel away when its own file changes, but not when that of a kernel that it calls does.
    index: Any = getattr(getattr(kernel, "_cache", None), "_cache_file", None)
    if index is not None and hasattr(index, "_source_stamp"):
        index._source_stamp = _stamp(function.__module__)
    compiled_function: _F = kernel
    return compiled_function


def readable(values: NDArray[Any], dtype: type[_T]) -> NDArray[_T]:
    """A contiguous array of a type that can't be written to, of the same values: a view where possible.

    To the compiler an array that can be written to is another type than one that can't, and a kernel is compiled for
    each that it meets; so inputs go to kernels as arrays of one kind.
    """
    array = np.ascontiguousarray(values, dtype).view()
    array.setflags(write=False)
    return array


_KERNELS = r"^from (cadgraph\.(?:geometry|draw)[\w.]+) import"  # modules that hold any


@cache
def _stamp(module: str) -> str:
    """A digest of the source of a module and of all modules of this package that it imports."""
    here, waiting, sources = Path(__file__).parents[2], [module], dict[str, bytes]()
    while waiting:
        name = waiting.pop()
        path = here.joinpath(*name.split(".")[1:]).with_suffix(".py")
        if name not in sources and path.is_file():
            sources[name] = path.read_bytes()
            waiting += re.findall(_KERNELS, sources[name].decode(), re.MULTILINE)
    return hashlib.sha256(b"".join(sources[name] for name in sorted(sources))).hexdigest()


def for_ranges(kernel: Callable[[int, int], object], weights: Ints, workers: int | None = None) -> None:
    """Calls ``kernel(first, last)`` on consecutive ranges of about equal weight that cover ``range(len(weights))``.

    Args:
        kernel: works on ``first <= i < last`` and writes only rows of its own range, so that the outcome does not
            depend on ``workers``.
        weights: ``(n,)`` about how much work each row is.
        workers: threads; all processors by default.

    Raises:
        ValueError: ``workers`` is below 1.
    """
    n, n_workers = len(weights), n_threads(workers)
    if n == 0:
        return
    if n_workers == 1 or n == 1:
        kernel(0, n)
        return
    load = np.concatenate([[0], np.cumsum(np.asarray(weights, np.float64) + 1.0)])
    n_ranges = min(n, n_workers * _RANGES_PER_WORKER)
    inner = np.searchsorted(load, load[-1] * np.arange(1, n_ranges) / n_ranges)
    bounds = np.unique(np.concatenate([[0], inner, [n]]))
    with ThreadPoolExecutor(n_workers) as pool:
        # list() raises what a kernel raised
        list(pool.map(lambda at: kernel(int(bounds[at]), int(bounds[at + 1])), range(len(bounds) - 1)))


def in_turn(act: Callable[[int], _Found], n: int, workers: int | None = None) -> Iterator[_Found]:
    """Gives ``act(0)``, ``act(1)`` and so on, in this order, worked out by threads: as many at a time as there are.

    For a few large steps that leave the interpreter lock, as products of matrices do.

    Args:
        act: what is worked out; it gets its number.
        n: how many.
        workers: threads; all processors by default.

    Raises:
        ValueError: ``workers`` is below 1.
    """
    at_once = n_threads(workers)
    if at_once == 1 or n < 2:
        yield from map(act, range(n))
        return
    with ThreadPoolExecutor(at_once) as pool:
        for first in range(0, n, at_once):
            yield from pool.map(act, range(first, min(first + at_once, n)))


def n_threads(workers: int | None = None) -> int:
    """How many threads to use: what a caller says, else this process's part of the processors.

    Raises:
        ValueError: ``workers`` is below 1.
    """
    n_workers = workers if workers is not None else _threads or os.cpu_count() or 1
    if n_workers < 1:
        raise ValueError(f"workers is {n_workers}; give at least 1")
    return n_workers
