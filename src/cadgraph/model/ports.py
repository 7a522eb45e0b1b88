"""How many lines a unit needs to work as what it is."""

from __future__ import annotations

import re

__all__ = ["has_more_ways", "least_ports", "port_word"]

# Fewest lines by words of the kind, the first that fits; then by type. A relief valve may blow into the open and a
# filter's or a heat exchanger's other sides may be shut, so that fewer than what these have on paper are no fault.
_BY_KIND = (("relief", 1), ("safety", 1), ("vent", 1), ("flow meter", 2))
_BY_TYPE = {"valve": 2, "pump": 2, "gauge": 1, "tank": 1, "equipment": 1}
_MORE_WAYS = re.compile(
    r"\b(?:[3-9]|three|four|five|six|multi)[\s_-]*(?:way|port)|\b[3-9]w\b|\b[0-9]\s*[/ ]\s*[0-9]\s*way"
    r"|\b[lty][\s_-]*port|divert|change[\s_-]*over|selector|shuttle"
)
_OF_EQUIPMENT = ("heat exchanger", "radiator", "boiler", "filter", "separator", "compressor")


def least_ports(unit_type: str, kind: str | None) -> int:
    """The fewest lines that a unit of a kind has in a plant that is whole.

    Args:
        unit_type: as the vocabulary calls it (``"valve"``).
        kind: ``"check valve"``, ``"flow meter"``...; None where it is unknown.

    Returns:
        2 for valves, pumps, flow meters and equipment that something flows through, 3 for valves of more than
        two ways, else 1.
    """
    words = (kind or "").casefold()
    for word, count in _BY_KIND:
        if word in words:
            return count
    if unit_type == "valve" and has_more_ways(words):
        return 3
    if any(word in words for word in _OF_EQUIPMENT):
        return 2
    return _BY_TYPE.get(unit_type, 1)


def has_more_ways(kind: str) -> bool:
    """Whether a valve of a kind joins more than two lines, so that it leaves one open however it stands.

    Args:
        kind: as people write it: ``"3-way ball valve"``, ``"three way plug valve"``, ``"diverter valve"``.
    """
    return _MORE_WAYS.search(kind.casefold()) is not None


def port_word(unit_type: str) -> str:
    """What a port of a unit is called: a nozzle of pumps, tanks and equipment, else a port."""
    return "nozzle" if unit_type in ("pump", "tank", "equipment") else "port"
