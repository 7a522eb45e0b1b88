"""IFC classes and predefined types, and the labels that they mean (IFC 4 and 4.3; ISO 16739-1)."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

__all__ = ["IfcClass", "ifc_class"]


class IfcClass(NamedTuple):
    """What a class means.

    Args:
        said: ``name`` or ``group`` of the built-in vocabulary where the predefined type says no more; None: no claim.
        by_type: what predefined types mean; None: no claim. What isn't here means ``said``.
        kinds: of units, by predefined type.
        is_prior: whether the class alone is so generic that it only leans a decision.
    """

    said: tuple[str, str | None] | None
    by_type: Mapping[str, tuple[str, str | None] | None] = MappingProxyType({})
    kinds: Mapping[str, str] = MappingProxyType({})
    is_prior: bool = False


def ifc_class(name: str) -> IfcClass | None:
    """What a class of IFC means; None where that isn't known.

    Args:
        name: ``IfcValve``, ``IfcValveType``, ``IfcBeamStandardCase``, in any capitals.
    """
    short = name.strip().upper().removeprefix("IFC")
    return _CLASSES.get(short.removesuffix("STANDARDCASE").removesuffix("ELEMENTEDCASE").removesuffix("TYPE"))


_PIPE, _VALVE, _PUMP, _TANK = "Pipe assembly", "Valve assembly", "Pump unit", "Tank"
_EQUIPMENT, _GAUGE, _JOIN = "Equipment", "Gauge assembly", "Connection assembly"
_STEEL, _ELECTRIC = "Structural element", "Electrical and safety"

# What a valve is for (isolating, regulating) says less than how it is made; the names of these kinds are IFC's words.
_VALVE_KINDS = MappingProxyType(
    {
        "CHECK": "check valve", "DOUBLECHECK": "check valve", "PRESSURERELIEF": "relief valve",
        "MIXING": "mixing valve", "DIVERTING": "diverting valve", "CHANGEOVER": "changeover valve",
        "SAFETYCUTOFF": "safety cutoff valve", "ISOLATING": "isolating valve", "REGULATING": "regulating valve",
        "DOUBLEREGULATING": "regulating valve", "PRESSUREREDUCING": "pressure reducing valve",
        "COMMISSIONING": "commissioning valve", "AIRRELEASE": "air release valve", "ANTIVACUUM": "vacuum breaker",
        "STOPCOCK": "stopcock", "GASCOCK": "gas cock",
    }
)  # fmt: skip

_CLASSES: Mapping[str, IfcClass] = MappingProxyType(
    {
        "PIPESEGMENT": IfcClass((_PIPE, "pipe"), {"FLEXIBLESEGMENT": (_PIPE, "hose"), "GUTTER": None, "CULVERT": None}),
        "PIPEFITTING": IfcClass(
            (_PIPE, None),
            {"BEND": (_PIPE, "elbow"), "JUNCTION": (_PIPE, "tee"), "TRANSITION": (_PIPE, "reducer")},
            is_prior=True,
        ),
        "VALVE": IfcClass((_VALVE, "valve"), {"STEAMTRAP": None, "FAUCET": None, "DRAWOFFCOCK": None}, _VALVE_KINDS),
        "PUMP": IfcClass((_PUMP, "pump")),
        "TANK": IfcClass((_TANK, "tank")),
        "BOILER": IfcClass((_EQUIPMENT, "boiler")),
        "HEATEXCHANGER": IfcClass((_EQUIPMENT, "heat exchanger")),
        "CONDENSER": IfcClass((_EQUIPMENT, "heat exchanger")),
        "COMPRESSOR": IfcClass((_EQUIPMENT, "compressor")),
        "BURNER": IfcClass((_EQUIPMENT, "burner")),
        "ELECTRICMOTOR": IfcClass((_PUMP, "motor")),
        "ACTUATOR": IfcClass((_VALVE, "actuator")),
        "FAN": IfcClass((_EQUIPMENT, "blower")),
        "SPACEHEATER": IfcClass((_EQUIPMENT, "radiator")),
        "INTERCEPTOR": IfcClass((_EQUIPMENT, "separator")),
        "FILTER": IfcClass((_EQUIPMENT, "filter"), {"STRAINER": (_PIPE, "strainer"), "AIRPARTICLEFILTER": None}),
        "FLOWINSTRUMENT": IfcClass(None, {"PRESSUREGAUGE": (_GAUGE, "gauge"), "THERMOMETER": (_GAUGE, "gauge")}),
        "FLOWMETER": IfcClass((_GAUGE, "flow meter")),
        "SENSOR": IfcClass((_GAUGE, "transmitter"), is_prior=True),
        "MECHANICALFASTENER": IfcClass(
            (_JOIN, None),
            {
                "BOLT": (_JOIN, "bolt"),
                "ANCHORBOLT": (_JOIN, "bolt"),
                "SCREW": (_JOIN, "screw"),
                "STUDSHEARCONNECTOR": (_JOIN, "stud"),
            },
        ),
        "DISCRETEACCESSORY": IfcClass(None, {"BRACKET": (_JOIN, "bracket"), "ANCHORPLATE": (_STEEL, "base plate")}),
        "RAILING": IfcClass((_STEEL, "railing"), {"FENCE": (_STEEL, "fence"), "BALUSTRADE": (_STEEL, "railing")}),
        "BEAM": IfcClass((_STEEL, "beam")),
        "COLUMN": IfcClass((_STEEL, "column")),
        "WALL": IfcClass((_STEEL, "wall")),
        "FOOTING": IfcClass((_STEEL, "foundation")),
        "PILE": IfcClass((_STEEL, "foundation")),
        "MEMBER": IfcClass((_STEEL, "beam"), {"BRACE": (_STEEL, "brace"), "POST": (_STEEL, "post")}),
        "PLATE": IfcClass(
            (_STEEL, "plate"), {"BASE_PLATE": (_STEEL, "base plate"), "GUSSET_PLATE": (_JOIN, "gusset plate")}
        ),
        "SLAB": IfcClass(None, {"BASESLAB": (_STEEL, "foundation"), "LANDING": (_STEEL, "platform")}),
        "CABLECARRIERSEGMENT": IfcClass((_ELECTRIC, "cable tray"), {"CONDUITSEGMENT": (_ELECTRIC, "conduit")}),
        "CABLESEGMENT": IfcClass((_ELECTRIC, "cable")),
        "JUNCTIONBOX": IfcClass((_ELECTRIC, "junction box")),
        "UNITARYCONTROLELEMENT": IfcClass(None, {"CONTROLPANEL": (_ELECTRIC, "control panel")}),
        "ELECTRICDISTRIBUTIONBOARD": IfcClass((_ELECTRIC, "control panel")),
        "LIGHTFIXTURE": IfcClass((_ELECTRIC, "lamp")),
        "LAMP": IfcClass((_ELECTRIC, "lamp")),
        "AUDIOVISUALAPPLIANCE": IfcClass(None, {"CAMERA": (_ELECTRIC, "camera")}),
        "SIGN": IfcClass((_ELECTRIC, "sign")),
        "FIRESUPPRESSIONTERMINAL": IfcClass(None, {"FIREHYDRANT": (_ELECTRIC, "hydrant")}),
    }
)
