"""Generated industrial plants with their ground truth: an open benchmark for whoever reads CAD."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cadplants.faults.defects import Defects, degrade, draw_defects
    from cadplants.model.plant import Component, Plant
    from cadplants.presets.preset import PRESETS, make
    from cadplants.presets.riser import make_riser
    from cadplants.presets.skid import make_skid
    from cadplants.presets.tank import make_tank
    from cadplants.styles.modeling_style import STYLES, ModelingStyle
    from cadplants.writers import write_plant
    from cadplants.writers.matching import match, truth_for
    from cadplants.writers.metadata import Metadata
    from cadplants.writers.plant_file import FileStyle
    from cadplants.writers.usd import truth_path, write_usd
    from cadplants.writers.usd_style import UsdStyle, draw_style

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
    "Component": "cadplants.model.plant",
    "Defects": "cadplants.faults.defects",
    "FileStyle": "cadplants.writers.plant_file",
    "Metadata": "cadplants.writers.metadata",
    "ModelingStyle": "cadplants.styles.modeling_style",
    "PRESETS": "cadplants.presets.preset",
    "Plant": "cadplants.model.plant",
    "STYLES": "cadplants.styles.modeling_style",
    "UsdStyle": "cadplants.writers.usd_style",
    "degrade": "cadplants.faults.defects",
    "draw_defects": "cadplants.faults.defects",
    "draw_style": "cadplants.writers.usd_style",
    "make": "cadplants.presets.preset",
    "make_riser": "cadplants.presets.riser",
    "make_skid": "cadplants.presets.skid",
    "make_tank": "cadplants.presets.tank",
    "match": "cadplants.writers.matching",
    "truth_for": "cadplants.writers.matching",
    "truth_path": "cadplants.writers.usd",
    "write_plant": "cadplants.writers",
    "write_usd": "cadplants.writers.usd",
}


def __getattr__(name: str) -> Any:
    if name in _LATER:
        return getattr(import_module(_LATER[name]), name)
    raise AttributeError(f"module 'cadplants' has no attribute {name!r}")
