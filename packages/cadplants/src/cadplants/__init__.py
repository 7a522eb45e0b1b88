"""Generated industrial plants with their ground truth: an open benchmark for whoever reads CAD."""

import warnings
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cadplants.defects import Defects, degrade, draw_defects
    from cadplants.matching import match, truth_for
    from cadplants.modeling_style import STYLES, ModelingStyle
    from cadplants.plant import Component, Plant
    from cadplants.preset import PRESETS, make
    from cadplants.riser import make_riser
    from cadplants.skid import make_skid
    from cadplants.tank import make_tank
    from cadplants.usd import truth_path, write_usd
    from cadplants.usd_style import UsdStyle, draw_style
    from cadplants.writers import write_plant
    from cadplants.writers.metadata import Metadata
    from cadplants.writers.plant_file import FileStyle

__version__ = "0.1.0"

__all__ = [
    "PRESETS",
    "STYLES",
    "Component",
    "Defects",
    "FileStyle",
    "Metadata",
    "ModelingStyle",
    "Plant",
    "UsdStyle",
    "degrade",
    "draw_defects",
    "draw_style",
    "make",
    "make_riser",
    "make_skid",
    "make_tank",
    "match",
    "truth_for",
    "truth_path",
    "write_plant",
    "write_usd",
]

# The families of devices are many modules; a command line that only lists this package's commands needs none of them.
_LATER = {
    "Component": "cadplants.plant",
    "Defects": "cadplants.defects",
    "FileStyle": "cadplants.writers.plant_file",
    "Metadata": "cadplants.writers.metadata",
    "ModelingStyle": "cadplants.modeling_style",
    "PRESETS": "cadplants.preset",
    "Plant": "cadplants.plant",
    "STYLES": "cadplants.modeling_style",
    "UsdStyle": "cadplants.usd_style",
    "degrade": "cadplants.defects",
    "draw_defects": "cadplants.defects",
    "draw_style": "cadplants.usd_style",
    "make": "cadplants.preset",
    "make_riser": "cadplants.riser",
    "make_skid": "cadplants.skid",
    "make_tank": "cadplants.tank",
    "match": "cadplants.matching",
    "truth_for": "cadplants.matching",
    "truth_path": "cadplants.usd",
    "write_plant": "cadplants.writers",
    "write_usd": "cadplants.usd",
}
_OLD = {"HANDS": "STYLES", "Hand": "ModelingStyle", "Sins": "Defects", "draw_sins": "draw_defects", "spoil": "degrade"}


def __getattr__(name: str) -> Any:
    # Names of version 0.1.0, kept for one more.
    if name in _OLD:
        warnings.warn(f"cadplants.{name} is now cadplants.{_OLD[name]}", DeprecationWarning, stacklevel=2)
        name = _OLD[name]
    if name in _LATER:
        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module 'cadplants' has no attribute {name!r}")
