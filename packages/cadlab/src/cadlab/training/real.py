"""Real parts by other hands, to try the network on; nothing is ever learnt from them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from cadgraph.errors import CadGraphError
from cadgraph.labelers.embedded.features import observe
from cadgraph.load import load
from cadlab.training.example import Example, make_parts_from

__all__ = ["KINDS", "RealPart", "read_real_parts"]

KINDS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("valves/", "Valve assembly", ()),
    ("Bolts & Screws/", "Connection assembly", ("bolt", "screw", "stud")),
    ("Nuts/", "Connection assembly", ("nut",)),
    ("Washers/", "Connection assembly", ("washer",)),
    ("Piping/DN15_FIG_130", "Pipe assembly", ("tee",)),
    ("Piping/DN15_Stamped_Flange", "Pipe assembly", ("flange",)),
    ("Bearings/", "", ()),
    ("Pulleys/", "", ()),
)
"""What the parts of a file are, by a piece of its path: group, and the names that count as right (any if empty).

Things without a group are none of a plant's: right is to leave them open.
"""


@dataclass(frozen=True)
class RealPart:
    """One part of a real file.

    Args:
        file: its path below the folder.
        group: that is right; empty if none is.
        names: that are right; any of the group if empty.
        example: what the network sees of the file.
        index: of the part in it.
    """

    file: str
    group: str
    names: tuple[str, ...]
    example: Example
    index: int


def read_real_parts(folder: Path) -> list[RealPart]:
    """The parts of all STEP files below a folder whose kind is known; files that can't be read are left out."""
    found = []
    for path in sorted((*folder.rglob("*.st?p"), *folder.rglob("*.stp"))):
        name = path.relative_to(folder).as_posix()
        kind = next(((group, names) for piece, group, names in KINDS if piece in name), None)
        if kind is None:
            continue
        try:
            parts, contacts = make_parts_from(load(path))
        except CadGraphError:
            continue
        seen = observe(parts, contacts)
        around, n = seen.surroundings, parts.n_parts
        empty = np.full(n, "", dtype="<U1")
        example = Example(
            seen.shapes.sizes, seen.shapes.forms, seen.shape_of_part, around.places, around.here, around.there,
            around.sides, np.full(n, f"{kind[0]}/{kind[1][0] if kind[1] else ''}"), empty, empty, np.full(n, "real"),
            parts.ground,
        )  # fmt: skip
        found += [RealPart(name, *kind, example, index) for index in range(n)]
    return found
