"""IFC4 classes and predefined types for what is in a plant (enumerations as in IFC4 ADD2 TC1)."""

from __future__ import annotations

__all__ = ["PROXY", "ifc_class"]

PROXY = ("IfcBuildingElementProxy", "NOTDEFINED")

# (group, name) -> class and predefined type; the name "" stands for all others of the group.
_CLASSES: dict[tuple[str, str], tuple[str, str]] = {
    ("Pipe assembly", "pipe"): ("IfcPipeSegment", "RIGIDSEGMENT"),
    ("Pipe assembly", "hose"): ("IfcPipeSegment", "FLEXIBLESEGMENT"),
    ("Pipe assembly", "elbow"): ("IfcPipeFitting", "BEND"),
    ("Pipe assembly", "tee"): ("IfcPipeFitting", "JUNCTION"),
    ("Pipe assembly", "cross"): ("IfcPipeFitting", "JUNCTION"),
    ("Pipe assembly", "branch outlet"): ("IfcPipeFitting", "JUNCTION"),
    ("Pipe assembly", "reducer"): ("IfcPipeFitting", "TRANSITION"),
    ("Pipe assembly", "strainer"): ("IfcFilter", "STRAINER"),
    ("Pipe assembly", "pipe cap"): ("IfcPipeFitting", "OBSTRUCTION"),
    ("Pipe assembly", "blind flange"): ("IfcPipeFitting", "OBSTRUCTION"),
    ("Pipe assembly", ""): ("IfcPipeFitting", "CONNECTOR"),
    ("Valve assembly", "valve"): ("IfcValve", "NOTDEFINED"),
    ("Valve assembly", "actuator"): ("IfcActuator", "NOTDEFINED"),
    ("Gauge assembly", "gauge"): ("IfcFlowInstrument", "NOTDEFINED"),
    ("Gauge assembly", "level gauge"): ("IfcFlowInstrument", "NOTDEFINED"),
    ("Gauge assembly", "sight glass"): ("IfcFlowInstrument", "NOTDEFINED"),
    ("Gauge assembly", "flow meter"): ("IfcFlowMeter", "NOTDEFINED"),
    ("Gauge assembly", "transmitter"): ("IfcSensor", "PRESSURESENSOR"),
    ("Pump unit", "pump"): ("IfcPump", "ENDSUCTION"),
    ("Pump unit", "motor"): ("IfcElectricMotor", "INDUCTION"),
    ("Tank", "tank"): ("IfcTank", "STORAGE"),
    ("Equipment", "heat exchanger"): ("IfcHeatExchanger", "NOTDEFINED"),
    ("Equipment", "radiator"): ("IfcSpaceHeater", "RADIATOR"),
    ("Equipment", "boiler"): ("IfcBoiler", "WATER"),
    ("Equipment", "filter"): ("IfcFilter", "WATERFILTER"),
    ("Equipment", "separator"): ("IfcInterceptor", "NOTDEFINED"),
    ("Equipment", "compressor"): ("IfcCompressor", "NOTDEFINED"),
    ("Equipment", "blower"): ("IfcFan", "NOTDEFINED"),
    ("Equipment", "burner"): ("IfcBurner", "NOTDEFINED"),
    ("Connection assembly", "bolt"): ("IfcMechanicalFastener", "BOLT"),
    ("Connection assembly", "screw"): ("IfcMechanicalFastener", "SCREW"),
    ("Connection assembly", "bracket"): ("IfcDiscreteAccessory", "BRACKET"),
    ("Connection assembly", "gusset plate"): ("IfcPlate", "USERDEFINED"),
    ("Connection assembly", ""): ("IfcMechanicalFastener", "USERDEFINED"),
    ("Structural element", "beam"): ("IfcBeam", "BEAM"),
    ("Structural element", "skid frame"): ("IfcBeam", "USERDEFINED"),
    ("Structural element", "column"): ("IfcColumn", "COLUMN"),
    ("Structural element", "brace"): ("IfcMember", "BRACE"),
    ("Structural element", "post"): ("IfcMember", "POST"),
    ("Structural element", "plate"): ("IfcPlate", "SHEET"),
    ("Structural element", "base plate"): ("IfcDiscreteAccessory", "ANCHORPLATE"),
    ("Structural element", "grating"): ("IfcPlate", "USERDEFINED"),
    ("Structural element", "stair tread"): ("IfcPlate", "USERDEFINED"),
    ("Structural element", "railing"): ("IfcRailing", "HANDRAIL"),
    ("Structural element", "fence"): ("IfcRailing", "USERDEFINED"),
    ("Structural element", "platform"): ("IfcSlab", "LANDING"),
    ("Structural element", "foundation"): ("IfcFooting", "PAD_FOOTING"),
    ("Structural element", "ground"): ("IfcSlab", "NOTDEFINED"),
    ("Structural element", "wall"): ("IfcWall", "SOLIDWALL"),
    ("Electrical and safety", "cable tray"): ("IfcCableCarrierSegment", "CABLETRAYSEGMENT"),
    ("Electrical and safety", "conduit"): ("IfcCableCarrierSegment", "CONDUITSEGMENT"),
    ("Electrical and safety", "cable"): ("IfcCableSegment", "CABLESEGMENT"),
    ("Electrical and safety", "junction box"): ("IfcJunctionBox", "POWER"),
    ("Electrical and safety", "control panel"): ("IfcUnitaryControlElement", "CONTROLPANEL"),
    ("Electrical and safety", "lamp"): ("IfcLightFixture", "NOTDEFINED"),
    ("Electrical and safety", "camera"): ("IfcAudioVisualAppliance", "CAMERA"),
    ("Electrical and safety", "hydrant"): ("IfcFireSuppressionTerminal", "FIREHYDRANT"),
}
_PARTS = ("Valve assembly", "Gauge assembly", "Pump unit", "Tank")
_PIECE = ("IfcDiscreteAccessory", "USERDEFINED")  # a handwheel, a dial, a saddle

# What the kind of a valve or an instrument says of its predefined type, the first that is found in it.
_VALVES = {
    "check": "CHECK", "relief": "PRESSURERELIEF", "safety": "PRESSURERELIEF", "trap": "STEAMTRAP",
    "three-way": "MIXING", "control": "REGULATING", "globe": "REGULATING", "needle": "REGULATING",
    "ball": "ISOLATING", "gate": "ISOLATING", "butterfly": "ISOLATING", "plug": "ISOLATING",
}  # fmt: skip
_INSTRUMENTS = {"pressure": "PRESSUREGAUGE", "temperature": "THERMOMETER", "thermometer": "THERMOMETER"}


def ifc_class(group: str, name: str, words: str = "") -> tuple[str, str]:
    """The class and predefined type of a label of the vocabulary.

    Args:
        group: of the vocabulary.
        name: in that group.
        words: what it is called more closely (``"ball valve"``).
    """
    found = _CLASSES.get((group, name)) or (_PIECE if group in _PARTS else _CLASSES.get((group, ""))) or PROXY
    closer = _VALVES if found[0] == "IfcValve" else _INSTRUMENTS if found[0] == "IfcFlowInstrument" else {}
    return found[0], next((value for word, value in closer.items() if word in words), found[1])
