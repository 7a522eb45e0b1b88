"""A plant in a file: what every writer takes, and what it tells so that the truth can be put beside it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from cadgraph.model.scene import Floats
from cadplants.writers.metadata import Metadata

__all__ = ["FileStyle", "Written"]


@dataclass(frozen=True)
class FileStyle:
    """How a plant is put down in a format other than USD.

    Args:
        meters_per_unit: length of one unit of the file [m]; what is usual in the format by default.
        up_axis: ``"Y"`` or ``"Z"``; what is usual in the format by default.
        layout: ``nodes``: one node for each mesh; ``merged``: one mesh for each colour. Of GLB alone.
        metadata: how good classes and names are. Of RVM and IFC alone.
    """

    meters_per_unit: float | None = None
    up_axis: Literal["Y", "Z"] | None = None
    layout: Literal["nodes", "merged"] = "nodes"
    metadata: Metadata = field(default_factory=Metadata)


@dataclass(frozen=True)
class Written:
    """A file's content, and where each component is in it.

    Args:
        files: bytes by suffix, the first those of the target, the others of what lies beside it.
        paths: of each component as a reader of the format most likely calls it, unique.
        meters_per_unit: of the file [m].
        up_axis: of the file.
        boxes: ``(2, 3)`` of each component that is written as another shape than its mesh, by index [m].
        extra: further entries of the truth.
        painted: whether the format has colours.
    """

    files: dict[str, bytes]
    paths: tuple[str, ...]
    meters_per_unit: float
    up_axis: str
    boxes: dict[int, Floats] = field(default_factory=dict)
    extra: dict[str, object] = field(default_factory=dict)
    painted: bool = True
