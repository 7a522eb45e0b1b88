"""Names that standards file under one word: a class of IFC or a type of PDMS is coarser than a vocabulary."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

__all__ = ["filed_alike"]


def filed_alike(group: str, name: str | None) -> tuple[str, ...]:
    """Other names of a group that people file under the word that means this one.

    Args:
        group: of the built-in vocabulary.
        name: in that group, or None.
    """
    return _ALIKE.get((group, name), ()) if name is not None else ()


_PIPE, _STEEL, _JOIN = "Pipe assembly", "Structural element", "Connection assembly"

_ALIKE: Mapping[tuple[str, str], tuple[str, ...]] = MappingProxyType(
    {
        (_PIPE, "pipe"): ("nipple",),
        # IfcPipeFitting JUNCTION; PDMS has types of its own for these, and files weldolets as tees all the same.
        (_PIPE, "tee"): ("cross", "branch outlet"),
        (_PIPE, "coupling"): ("union", "nipple"),
        (_STEEL, "beam"): ("brace", "column", "post", "skid frame"),
        (_STEEL, "column"): ("post", "beam"),
        (_STEEL, "plate"): ("base plate", "grating", "platform", "stair tread"),
        (_JOIN, "bolt"): ("stud", "screw", "u-bolt"),
    }
)
