"""The words of DEXPI 1.3 for what cadgraph knows, and back.

Class names and reference data are those of the DEXPI P&ID specification 1.3. A class whose URI we could not confirm
there is written without one.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from cadgraph.model.records import Terminal, Unit

__all__ = [
    "CUSTOM_SET",
    "DEXPI_SET",
    "INSTRUMENT",
    "URIS",
    "Term",
    "kind_of",
    "term_of_terminal",
    "term_of_unit",
    "unit_type_of",
]

DEXPI_SET = "DexpiAttributes"
CUSTOM_SET = "DexpiCustomAttributes"

_RDL = "http://data.posccaesar.org/rdl/"
URIS = {
    "CentrifugalPump": f"{_RDL}RDS416834",
    "Tank": f"{_RDL}RDS445139",
    "Nozzle": f"{_RDL}RDS415214",
    "PipingNetworkSystem": f"{_RDL}RDS270359",
    "PipingNetworkSegment": f"{_RDL}RDS267704",
    "BallValve": f"{_RDL}RDS416654",
    "ButterflyValve": f"{_RDL}RDS416609",
    "GateValve": f"{_RDL}RDS416519",
    "GlobeValve": f"{_RDL}RDS416204",
    "PlugValve": f"{_RDL}RDS421109",
    "SwingCheckValve": f"{_RDL}RDS610424",
    "PipeTee": f"{_RDL}RDS427724",
    "BlindFlange": f"{_RDL}RDS414719",
}
"""The reference data of classes, where the specification names it."""


@dataclass(frozen=True)
class Term:
    """What something is called in DEXPI.

    Args:
        name: the component class.
        custom: the type in words, for classes ``Custom...`` that need one; else empty.
    """

    name: str
    custom: str = ""


INSTRUMENT = "instrument connection"
"""The fitting that stands for an instrument where lines meet."""

_VALVES = (
    ("ball", "BallValve"), ("butterfly", "ButterflyValve"), ("gate", "GateValve"), ("globe", "GlobeValve"),
    ("plug", "PlugValve"), ("swing check", "SwingCheckValve"),
)  # fmt: skip
_CUSTOM_VALVES = (
    ("check", "CustomCheckValve"), ("non-return", "CustomCheckValve"), ("safety", "CustomSafetyValveOrFitting"),
    ("relief", "CustomSafetyValveOrFitting"),
)  # fmt: skip
_EQUIPMENT = (("exchanger", "CustomHeatExchanger"), ("filter", "CustomFilter"), ("strainer", "CustomFilter"))

_VESSELS = frozenset({"Tank", "Vessel", "PressureVessel", "CustomVessel", "ProcessColumn", "Silo"})
_KINDS = {name: f"{word} valve" for word, name in _VALVES}


def term_of_unit(unit: Unit) -> Term:
    """The class of a valve, pump, tank or other equipment."""
    kind = (unit.kind or "").casefold()
    if unit.unit_type == "valve":
        named = next((name for word, name in _VALVES if word in kind), None)
        if named:
            return Term(named)
        custom = next((name for word, name in _CUSTOM_VALVES if word in kind), "CustomOperatedValve")
        return Term(custom, unit.kind or "valve")
    if unit.unit_type == "pump":
        return Term("CentrifugalPump") if "centrifugal" in kind else Term("CustomPump", unit.kind or "pump")
    if unit.unit_type == "tank":
        pressed = "pressure" in kind or "drum" in kind
        return Term("PressureVessel" if pressed else "Tank")
    named = next((name for word, name in _EQUIPMENT if word in kind), "CustomEquipment")
    return Term(named, unit.kind or unit.unit_type)


def term_of_terminal(terminal: Terminal) -> Term:
    """The class of the end of a line; DEXPI 1.3 has none for an open end."""
    if terminal.kind == "blind":
        return Term("BlindFlange")
    return Term("CustomPipeFitting", "open end" if terminal.kind == "open" else "end of pipe")


def unit_type_of(name: str, default: str) -> str:
    """The type of unit of a component class of equipment."""
    return "tank" if name in _VESSELS else "pump" if name.endswith("Pump") else default


def kind_of(name: str, custom: str) -> str | None:
    """The kind that a class stands for, in our words."""
    words = [word for word, custom_name in _CUSTOM_VALVES if custom_name == name]
    if words and not any(word in custom.casefold() for word in words):
        # A type of somebody's own, as "DN 50 PN 16", says less than the class.
        return f"{words[0]} valve"
    if custom:
        return None if custom in ("valve", "pump", "tank", "equipment") else custom
    if name.endswith(("Pump", "Valve")) and name not in _KINDS and not name.startswith(("Custom", "Operated")):
        return " ".join(re.findall("[A-Z][a-z]*", name)).lower()
    return "pressure vessel" if name == "PressureVessel" else _KINDS.get(name)
