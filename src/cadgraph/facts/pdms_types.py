"""Types of AVEVA PDMS and E3D elements, and Isogen's symbol keys, and the labels that they mean."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

__all__ = ["SILENT_TYPES", "isogen_label", "pdms_label"]

Said = tuple[str, str | None, str | None]
"""Group, name, and kind of unit."""


def pdms_label(element_type: str) -> Said | None:
    """What a type of element means; None where it says nothing of what the element is.

    Args:
        element_type: ``VALV``, or in full as default names have it (``VALVE``).
    """
    word = element_type.strip().upper()
    return _TYPES.get(word) or _TYPES.get(_IN_FULL.get(word, ""))


def isogen_label(key: str) -> Said | None:
    """What an Isogen symbol key (SKEY) means; None where that isn't certain.

    Args:
        key: four letters, two or three of them for the component and the rest for its ends: ``CKFL``.
    """
    word = key.strip().upper()
    return next((said for pattern, said in _SYMBOLS if pattern.fullmatch(word)), None)


_PIPE, _VALVE, _STEEL = "Pipe assembly", "Valve assembly", "Structural element"

# Fittings of pipes; steel, where a section may be a beam, a column or a brace: that geometry says.
_TYPES: Mapping[str, Said] = MappingProxyType(
    {
        "TUBI": (_PIPE, "pipe", None), "TUBE": (_PIPE, "pipe", None), "ELBO": (_PIPE, "elbow", None),
        "BEND": (_PIPE, "elbow", None), "TEE": (_PIPE, "tee", None), "CROS": (_PIPE, "cross", None),
        "REDU": (_PIPE, "reducer", None), "OLET": (_PIPE, "branch outlet", None), "FLAN": (_PIPE, "flange", None),
        "FBLI": (_PIPE, "blind flange", None), "GASK": (_PIPE, "gasket", None), "COUP": (_PIPE, "coupling", None),
        "UNIO": (_PIPE, "union", None), "CAP": (_PIPE, "pipe cap", None), "FLEX": (_PIPE, "hose", None),
        "FILT": (_PIPE, "strainer", None),
        "VALV": (_VALVE, "valve", None), "VTWA": (_VALVE, "valve", None), "VFWA": (_VALVE, "valve", None),
        "SCTN": (_STEEL, None, None), "GENSEC": (_STEEL, None, None), "PANE": (_STEEL, "plate", None),
        "STWALL": (_STEEL, "wall", None), "GWALL": (_STEEL, "wall", None), "WALL": (_STEEL, "wall", None),
        "CTRAY": ("Electrical and safety", "cable tray", None),
    }
)  # fmt: skip

SILENT_TYPES = frozenset(
    {
        *("INST", "PCOM", "ATTA", "EQUI", "SUBE", "BRAN", "PIPE", "ZONE", "SITE", "WORL", "STRU", "FRMW", "SBFR"),
        *(
            "BOX",
            "CYLI",
            "CONE",
            "DISH",
            "PYRA",
            "RTOR",
            "CTOR",
            "SNOU",
            "SLCY",
            "EXTR",
            "REVO",
            "POHE",
            "TMPL",
            "HANG",
        ),
        *("DRAW", "WELD", "DUCT", "HVAC", "SUPPO", "PLOO", "EQUIPMENT", "SUBEQUIPMENT", "BRANCH", "STRUCTURE"),
        # Of pumps and exchangers as of tanks: on the pumps of a real plant each would make a tank of its own.
        *("NOZZ", "NOZZLE"),
        *("FRAMEWORK", "SUBFRAMEWORK", "INSTRUMENT", "PCOMPONENT", "ATTACHMENT", "CYLINDER", "PYRAMID", "EXTRUSION"),
    }
)
"""Types that say nothing of what an element is: what holds others, plain bodies, and components of any kind."""

_IN_FULL = {
    "TUBING": "TUBI", "ELBOW": "ELBO", "CROSS": "CROS", "REDUCER": "REDU", "FLANGE": "FLAN", "FBLIND": "FBLI",
    "GASKET": "GASK", "COUPLING": "COUP", "UNION": "UNIO", "VALVE": "VALV", "VTWAY": "VTWA", "VFWAY": "VFWA",
    "FILTER": "FILT", "SCTION": "SCTN", "PANEL": "PANE",
}  # fmt: skip

# How a component is joined: butt weld, socket weld, screwed, flanged, compression, plain, clamped.
_ENDS = "(BW|SW|SC|FL|CP|PL|CL)"
# Only keys that mean the same wherever we have seen them; kinds of valves beside check valves differ between lists.
_SYMBOLS: tuple[tuple[re.Pattern[str], Said], ...] = tuple(
    (re.compile(pattern), said)
    for pattern, said in (
        (f"CK{_ENDS}", (_VALVE, "valve", "check valve")),
        (f"VB{_ENDS}", (_VALVE, "valve", "ball valve")),
        (f"V[A-Z34]{_ENDS}", (_VALVE, "valve", None)),
        (f"EL{_ENDS}", (_PIPE, "elbow", None)),
        (f"TE{_ENDS}", (_PIPE, "tee", None)),
        (f"CR{_ENDS}", (_PIPE, "cross", None)),
        (f"R[CE]{_ENDS}", (_PIPE, "reducer", None)),
        (f"KA{_ENDS}", (_PIPE, "pipe cap", None)),
        (f"CO{_ENDS}", (_PIPE, "coupling", None)),
        (f"UN{_ENDS}", (_PIPE, "union", None)),
        ("FLBL", (_PIPE, "blind flange", None)),
        ("FL(WN|SO|SC|SW|SF|LB|SE)", (_PIPE, "flange", None)),
        ("GASK", (_PIPE, "gasket", None)),
        ("(WTBW|SKSW|THSC|LABW)", (_PIPE, "branch outlet", None)),
    )
)
