"""Numbers that stand for positions: equal where the positions are equal, and well spread."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from cadgraph.geometry.kernels.parallel import compiled

__all__ = ["NO_KEY", "Keys", "key_position", "mix"]

Keys: TypeAlias = np.ndarray[tuple[int, ...], np.dtype[np.uint64]]

NO_KEY = np.uint64(0)
_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)
_SEED = np.uint64(0x9E3779B97F4A7C15)
_S27, _S30, _S31 = np.uint64(27), np.uint64(30), np.uint64(31)
_MINUS_ZERO = np.uint64(1 << 63)


@compiled
def mix(x: np.uint64) -> np.uint64:
    """The finaliser of splitmix64: each bit of the input moves each bit of the output."""
    x = (x ^ (x >> _S30)) * _MIX_1
    x = (x ^ (x >> _S27)) * _MIX_2
    return x ^ (x >> _S31)


@compiled
def key_position(x: np.uint64, y: np.uint64, z: np.uint64) -> np.uint64:
    """A key, never 0, of the bits of three coordinates; -0.0 and 0.0 are one."""
    key = mix(_SEED ^ (x if x != _MINUS_ZERO else NO_KEY))
    key = mix(key ^ (y if y != _MINUS_ZERO else NO_KEY))
    key = mix(key ^ (z if z != _MINUS_ZERO else NO_KEY))
    return key if key != NO_KEY else _SEED
