"""What the paper reports (section IV and Table I), to stand beside what is measured here."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["CLUSTERS", "CLUSTERS_INSIDE", "EXCLUDED", "GROUPS", "MESHES", "NAMES", "PARTS", "STRUCTURES", "Structure"]

MESHES = 8327
EXCLUDED = 9
PARTS = 2068
CLUSTERS = 39
CLUSTERS_INSIDE = 15
"""Without the outer fences."""

GROUPS, NAMES = 7, 44
"""Labels in use."""


@dataclass(frozen=True)
class Structure:
    """One column of Table I.

    Args:
        id: as the paper calls it.
        preset: of ours that stands for it.
        parts: after grouping.
        name_accuracy: of gpt-4o, 0..1.
        group_accuracy: likewise.
        valves: fully found, partially found, missed.
        gauges: fully found, partially found, missed; the paper names no partially found gauges.
    """

    id: str
    preset: str
    parts: int
    name_accuracy: float
    group_accuracy: float
    valves: tuple[int, int, int]
    gauges: tuple[int, int, int]


STRUCTURES = (
    Structure("S1", "skid", 174, 0.385, 0.799, (5, 7, 0), (12, 0, 0)),
    Structure("S2", "riser", 82, 0.305, 0.732, (2, 4, 0), (4, 0, 2)),
    Structure("S3", "tank", 200, 0.420, 0.840, (0, 3, 1), (3, 0, 2)),
)
