"""What a valve can be relied on for when something is cut off: whether it shuts off, by its kind."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

from cadgraph.model.labels import Label
from cadgraph.model.ports import has_more_ways
from cadgraph.model.records import Unit
from cadgraph.model.vocabulary import OPERATORS
from cadgraph.query.network import Network

__all__ = [
    "Duty",
    "Suspect",
    "blocked_relief",
    "duty_of",
    "is_doubted",
    "joins_more",
    "likely_kinds",
    "moves_by_itself",
    "suspect_of",
    "worked_by_hand",
]

Duty = Literal["shuts off", "likely", "unknown", "check", "relief", "control", "other"]
"""``likely``: its kind is open, but all that it may be shuts off; ``other``: a kind that isn't known to shut off."""

# What stands for more than a hand-operated shut-off: a control valve may leak and moves by itself, so that rules of
# lockout and tagout (OSHA 29 CFR 1910.147, EN ISO 14118) don't take it for an isolating device. The first that fits
# counts: a "ball check valve" is a check valve, a "globe control valve" a control valve.
_DUTIES: tuple[tuple[tuple[str, ...], Duty], ...] = (
    (("relief", "safety valve"), "relief"),
    (("check", "nonreturn", "non return"), "check"),
    (("control", "regulating", "reducing", "modulating", "solenoid", "safety cutoff"), "control"),
)
_SHUTS = frozenset({
    "ball", "gate", "globe", "butterfly", "plug", "diaphragm", "needle", "pinch", "isolating", "isolation", "shutoff",
    "stop", "cock", "stopcock", "block", "drain",
})  # fmt: skip
# Words that change nothing of what a valve does. One that is not among them may: a "pressure regulator globe valve", a
# "thermostatic ball valve", a "non-shut-off valve", a "Y-port ball valve" are no shut-off valves.
_NO_MATTER = frozenset({
    "valve", "valves", "manual", "hand", "operated", "lever", "handwheel", "wheel", "gear", "geared", "chain",
    "flanged", "welded", "threaded", "screwed", "socket", "weld", "soldered", "wafer", "lug", "lugged", "full",
    "reduced", "bore", "port", "trunnion", "floating", "mounted", "rising", "non", "stem", "os", "y", "outside",
    "screw", "bellows", "sealed", "cryogenic", "double", "single", "triple", "eccentric", "offset", "concentric",
    "slide", "sluice", "knife", "wedge", "parallel", "flexible", "solid", "angle", "straight", "pattern", "inline",
    "in", "line", "root", "vent", "sample", "main", "quarter", "turn", "two", "way", "piece", "three", "body",
    "split", "top", "entry", "soft", "metal", "seated", "seat", "high", "low", "pressure", "temperature", "steel",
    "stainless", "brass", "bronze", "iron", "cast", "forged", "pvc", "water", "steam", "air", "gas", "oil", "fuel",
    "gauge", "instrument", "and",
})  # fmt: skip
_SIZE = re.compile(r"(?:dn|pn|nps|class|cl|ansi|asme|din|en|iso|api|inch|in|mm|lb|lbs|rf)?\d*")
# A valve whose kind is open shuts off where kinds that do are together as sure as a kind must be to be stated (ours).
_SURE = 0.9
_HAND_OPERATORS = frozenset({"lever", "handwheel"})
_OPERATORS = _HAND_OPERATORS | {"gearbox", "actuator"}


def duty_of(network: Network, place: str) -> Duty | None:
    """What a valve is good for; None for what is no valve.

    Args:
        network: of a finished graph.
        place: id of a node.
    """
    node = network.places[place]
    if not isinstance(node, Unit) or node.unit_type != "valve":
        return None
    if joins_more(network, place):
        return "other"
    if node.kind is not None:
        return _of_kind(node.kind)
    sure = 0.0
    for kind, confidence in node.kind_guesses:
        if _of_kind(kind) != "shuts off":
            return "unknown"
        sure += confidence
    return "likely" if sure >= _SURE else "unknown"


def joins_more(network: Network, place: str) -> bool:
    """Whether more than two lines end at a valve, which leaves one of them open as a rule, whatever it is called; lines
    that only lead to an instrument don't count.

    Args:
        network: of a finished graph.
        place: id of a valve.
    """
    return len({arc.start_port or arc.end for arc in network.main_arcs(place)}) > 2


def moves_by_itself(network: Network, place: str, n_ports: int) -> Literal["check", "relief"] | None:
    """What a valve does by its kind without anybody moving it; None where it is moved, or has more than two ports.

    Args:
        network: of a finished graph.
        place: id of a valve.
        n_ports: of its ports that lines were found at.
    """
    duty = duty_of(network, place)
    return duty if n_ports <= 2 and (duty == "check" or duty == "relief") else None


def is_doubted(network: Network, place: str) -> bool:
    """Whether parts of a valve have labels and nobody is sure of its body, or of any part where only what moves it has
    one: what stands there may be something else, a duplex filter with a lever.

    Args:
        network: of a finished graph.
        place: id of a valve.
    """
    labels = _labels(network, place)
    standing = [label for label in labels if label.name not in OPERATORS] or labels
    return bool(labels) and all(label.likely or label.source == "network" for label in standing)


def _labels(network: Network, place: str) -> list[Label]:
    """The labels of the parts of a node that have one."""
    found = (network.graph.part(part).label for part in network.places[place].parts)
    return [label for label in found if label is not None]


def likely_kinds(network: Network, place: str) -> str:
    """What a valve of unknown kind may be, in words: ``gate valve 55%, globe valve 42%``; empty where nobody knows."""
    node = network.places[place]
    guesses = node.kind_guesses if isinstance(node, Unit) and node.kind is None else ()
    return ", ".join(f"{kind} {sure:.0%}" for kind, sure in guesses)


@dataclass(frozen=True)
class Suspect:
    """Why a valve of unknown kind is likely a check valve.

    Args:
        pump: id of the pump that it protects.
        valve: id of the other valve there, which shuts the pump off.
        outermost: whether the other one stands behind it, seen from the pump.
    """

    pump: str
    valve: str
    outermost: bool


def suspect_of(network: Network, place: str) -> Suspect | None:
    """Why a valve of unknown kind at a pump is a check valve, most likely; None where nothing says so.

    It is the one of two valves that a pump pushes through at which nothing to turn was found: the first one, or the
    second one where the first has something.

    Args:
        network: of a finished graph.
        place: id of a valve.
    """
    if duty_of(network, place) != "unknown" or network.stands_aside(place) or _has_operator(network, place):
        return None
    before = _met(network, place, "pump")
    if before is not None:
        pump, port = before
        behind = _met(network, place, "valve", port)
        return None if behind is None else Suspect(pump, behind[0], True)
    for arc in network.main_arcs(place):
        between = _met(network, place, "valve", arc.index)
        pumped = _met(network, between[0], "pump") if between and _has_operator(network, between[0]) else None
        if between is not None and pumped is not None:
            return Suspect(pumped[0], between[0], False)
    return None


def _has_operator(network: Network, place: str) -> bool:
    """Whether something that works it was found at a valve: what turns by its shape, or a part that is called so."""
    node = network.places[place]
    if not isinstance(node, Unit):
        return False
    labels = (network.graph.part(part).label for part in node.parts)
    return node.mechanism is not None or any(label is not None and label.name in _OPERATORS for label in labels)


def worked_by_hand(network: Network, place: str) -> bool:
    """Whether a valve that only one line was found at is worked by hand, and nobody but the labeler says what it is."""
    labels = _labels(network, place)
    told = any(label.source in ("author", "human", "catalog", "repeat") for label in labels)
    operated = any(label.name in _HAND_OPERATORS for label in labels)
    return operated and not told and network.ports_in_use(place) < 2


def blocked_relief(network: Network, place: str) -> tuple[str, ...]:
    """The relief valves that closing a valve blocks: those before or behind it with nothing but gauges between.

    Args:
        network: of a finished graph.
        place: id of the valve.
    """
    if network.stands_aside(place):
        return ()
    found: dict[str, None] = {}
    for first in network.main_arcs(place):
        seen, arc = {place}, first
        while network.is_gauge(arc.end) and arc.end not in seen:
            seen.add(arc.end)
            onward = [other for other in network.main_arcs(arc.end) if other.index != arc.index]
            if len(onward) != 1:
                break
            arc = onward[0]
        if duty_of(network, arc.end) == "relief" and not network.stands_aside(arc.end):
            found[arc.end] = None
    return tuple(found)


def _of_kind(kind: str) -> Duty:
    tokens = re.findall(r"[^\W_]+", unicodedata.normalize("NFKC", kind).casefold())
    words = " ".join(tokens)
    for known, duty in _DUTIES:
        if any(word in words for word in known):
            return duty
    if has_more_ways(words) or not (_SHUTS.intersection(tokens) or "shut off" in words):
        return "other"
    if "non" in tokens and "rising" not in tokens:
        return "other"
    said = {"shut", "off", *_SHUTS, *_NO_MATTER}
    return "shuts off" if all(token in said or _SIZE.fullmatch(token) for token in tokens) else "other"


def _met(network: Network, place: str, wanted: str, but: int | None = None) -> tuple[str, int] | None:
    """The first unit of a type with nothing but gauges and joints between, and the connection that it is met over.

    Args:
        network: of a finished graph.
        place: id of where it is looked from.
        wanted: type of unit; a pump is only met on a side that it isn't known to draw from.
        but: number of the connection of the place that isn't followed.
    """
    for first in network.main_arcs(place):
        if first.index == but:
            continue
        seen, waiting = {place}, [first]
        while waiting:
            arc = waiting.pop()
            if arc.end in seen:
                continue
            seen.add(arc.end)
            kind = network.unit_type(arc.end)
            aside = network.stands_aside(arc.end)
            if kind == wanted and not aside and not (wanted == "pump" and arc.flow == "along"):
                return arc.end, first.index
            if aside or kind in (None, "gauge"):
                waiting += network.main_arcs(arc.end)
    return None
