"""What was measured of shapes as plain arrays, and back, to the last bit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph.model.scene import Floats
from cadgraph.model.shapes import Disc, Facts

__all__ = ["pack_facts", "unpack_facts"]

_POINTS = ("center", "axis", "section")
_RAGGED = ("outer", "inner")
_NUMBERS = ("low", "high", "radius", "turned", "bore", "tube", "rim", "fill")
_COUNTS = ("sides", "spokes", "extruded")
_DISC_NUMBERS = ("outer", "inner", "area")


def pack_facts(facts: Sequence[Facts]) -> dict[str, npt.NDArray[Any]]:
    """The measures of some shapes as arrays, by name."""
    arrays: dict[str, npt.NDArray[Any]] = {}
    for name in _POINTS:
        arrays[name] = np.array([getattr(one, name) for one in facts], np.float64).reshape(-1, 3)
    for name in _NUMBERS:
        arrays[name] = np.array([getattr(one, name) for one in facts], np.float64)
    for name in _COUNTS:
        arrays[name] = np.array([getattr(one, name) for one in facts], np.int64)
    for name in _RAGGED:
        rows = [np.asarray(getattr(one, name), np.float64) for one in facts]
        arrays[f"{name}_rows"] = np.concatenate(rows) if rows else np.zeros(0)
        arrays[f"{name}_count"] = np.array([len(row) for row in rows], np.int64)
    for name in ("discs", "ports"):
        each = [getattr(one, name) for one in facts]
        flat = [disc for some in each for disc in some]
        arrays[f"{name}_count"] = np.array([len(some) for some in each], np.int64)
        arrays[f"{name}_places"] = np.array([(d.center, d.normal) for d in flat], np.float64).reshape(-1, 2, 3)
        arrays[f"{name}_sides"] = np.array([d.sides for d in flat], np.int64)
        arrays[f"{name}_numbers"] = np.array([[getattr(d, n) for n in _DISC_NUMBERS] for d in flat]).reshape(-1, 3)
    return arrays


def unpack_facts(arrays: Mapping[str, npt.NDArray[Any]]) -> list[Facts]:
    """The measures that ``pack_facts`` made arrays of.

    Raises:
        KeyError, ValueError, IndexError: an array is missing, or too short.
    """
    n = len(arrays["low"])
    rows: dict[str, list[Any]] = {name: [np.ascontiguousarray(row) for row in arrays[name]] for name in _POINTS}
    ragged: dict[str, list[Any]] = {name: _split(arrays[f"{name}_rows"], arrays[f"{name}_count"]) for name in _RAGGED}
    discs, ports = _discs(arrays, "discs"), _discs(arrays, "ports")
    numbers: dict[str, list[Any]] = {name: arrays[name].tolist() for name in (*_NUMBERS, *_COUNTS)}
    return [
        Facts(
            discs=discs[i],
            ports=ports[i],
            **{name: values[i] for name, values in rows.items()},
            **{name: values[i] for name, values in ragged.items()},
            **{name: values[i] for name, values in numbers.items()},
        )
        for i in range(n)
    ]


def _split(rows: Floats, count: npt.NDArray[np.int64]) -> list[Floats]:
    return [np.ascontiguousarray(some) for some in np.split(rows, np.cumsum(count)[:-1])]


def _discs(arrays: Mapping[str, npt.NDArray[Any]], name: str) -> list[tuple[Disc, ...]]:
    places, sides, numbers = (arrays[f"{name}_{what}"] for what in ("places", "sides", "numbers"))
    flat = [
        Disc(center.copy(), normal.copy(), outer, inner, n, area)
        for (center, normal), n, (outer, inner, area) in zip(places, sides.tolist(), numbers.tolist(), strict=True)
    ]
    ends = np.cumsum(arrays[f"{name}_count"]).tolist()
    return [tuple(flat[first:last]) for first, last in zip([0, *ends[:-1]], ends, strict=True)]
