"""Element types of PDMS and E3D for what is in a plant: the type in attributes, and the word in default names."""

from __future__ import annotations

__all__ = ["BRANCH_TYPES", "PdmsType", "pdms_type"]

PdmsType = tuple[str, str]
"""Type as attributes have it, and the word that stands in the default name of an unnamed element."""

# (group, name) -> type; the name "" stands for all others of the group.
_TYPES: dict[tuple[str, str], PdmsType] = {
    ("Pipe assembly", "pipe"): ("TUBI", "TUBING"),
    ("Pipe assembly", "elbow"): ("ELBO", "ELBOW"),
    ("Pipe assembly", "tee"): ("TEE", "TEE"),
    ("Pipe assembly", "cross"): ("CROS", "CROSS"),
    ("Pipe assembly", "reducer"): ("REDU", "REDUCER"),
    ("Pipe assembly", "branch outlet"): ("OLET", "OLET"),
    ("Pipe assembly", "flange"): ("FLAN", "FLANGE"),
    ("Pipe assembly", "blind flange"): ("FBLI", "FBLIND"),
    ("Pipe assembly", "gasket"): ("GASK", "GASKET"),
    ("Pipe assembly", "coupling"): ("COUP", "COUPLING"),
    ("Pipe assembly", "union"): ("UNIO", "UNION"),
    ("Pipe assembly", "pipe cap"): ("CAP", "CAP"),
    ("Pipe assembly", "hose"): ("FLEX", "FLEX"),
    ("Pipe assembly", "strainer"): ("FILT", "FILTER"),
    ("Pipe assembly", ""): ("PCOM", "PCOMPONENT"),
    ("Valve assembly", "valve"): ("VALV", "VALVE"),
    ("Valve assembly", ""): ("PCOM", "PCOMPONENT"),
    ("Gauge assembly", ""): ("INST", "INSTRUMENT"),
    ("Pump unit", "pump"): ("EQUI", "EQUIPMENT"),
    ("Pump unit", ""): ("SUBE", "SUBEQUIPMENT"),
    ("Tank", "tank"): ("EQUI", "EQUIPMENT"),
    ("Tank", "nozzle"): ("NOZZ", "NOZZLE"),
    ("Tank", ""): ("SUBE", "SUBEQUIPMENT"),
    ("Equipment", ""): ("EQUI", "EQUIPMENT"),
    ("Connection assembly", ""): ("ATTA", "ATTACHMENT"),
    ("Structural element", "beam"): ("SCTN", "SCTN"),
    ("Structural element", "column"): ("SCTN", "SCTN"),
    ("Structural element", "brace"): ("SCTN", "SCTN"),
    ("Structural element", "post"): ("SCTN", "SCTN"),
    ("Structural element", "railing"): ("SCTN", "SCTN"),
    ("Structural element", "skid frame"): ("GENSEC", "GENSEC"),
    ("Structural element", "plate"): ("PANE", "PANEL"),
    ("Structural element", "base plate"): ("PANE", "PANEL"),
    ("Structural element", "grating"): ("PANE", "PANEL"),
    ("Structural element", "stair tread"): ("PANE", "PANEL"),
    ("Structural element", "platform"): ("FLOOR", "FLOOR"),
    ("Structural element", "ground"): ("FLOOR", "FLOOR"),
    ("Structural element", "wall"): ("STWALL", "STWALL"),
    ("Structural element", ""): ("SUBS", "SUBSTRUCTURE"),
    ("Electrical and safety", "cable tray"): ("CTRAY", "CTRAY"),
    ("Electrical and safety", ""): ("SUBE", "SUBEQUIPMENT"),
}
_OTHER: PdmsType = ("SUBE", "SUBEQUIPMENT")

BRANCH_TYPES = frozenset(
    {"ELBO", "TEE", "CROS", "REDU", "OLET", "FLAN", "FBLI", "GASK", "COUP", "UNIO", "CAP", "FLEX", "FILT", "PCOM",
     "VALV", "INST", "TUBI", "ATTA"}
)  # fmt: skip
"""What may stand on a branch."""


def pdms_type(group: str, name: str) -> PdmsType:
    """The element type of a label of the vocabulary."""
    return _TYPES.get((group, name)) or _TYPES.get((group, "")) or _OTHER
