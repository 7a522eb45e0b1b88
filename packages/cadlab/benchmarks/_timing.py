"""Timing of the geometry benchmarks, and the machine that they run on."""

from __future__ import annotations

import gc
import os
import platform
import statistics
import time
from collections.abc import Callable

import numba
import numpy as np
import scipy


def machine() -> str:
    """The machine and what matters of its software, in one line."""
    return (
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} processors, Python {platform.python_version()}, "
        f"numpy {np.__version__}, scipy {scipy.__version__}, numba {numba.__version__}"
    )


def timed(act: Callable[[], object], repeats: int = 3) -> tuple[float, float]:
    """Median wall and processor seconds, after one run that compiles and warms."""
    act()
    wall, spent = [], []
    for _ in range(repeats):
        gc.collect()
        start, clock = time.process_time(), time.perf_counter()
        act()
        wall.append(time.perf_counter() - clock)
        spent.append(time.process_time() - start)
    return statistics.median(wall), statistics.median(spent)


def once(act: Callable[[], object]) -> float:
    """Processor seconds of one run."""
    start = time.process_time()
    act()
    return time.process_time() - start
