"""Stubs of a network: ends without length and parts, which stand for nothing in the plant."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from cadgraph.model.parts import Link, Network

__all__ = ["drop_stubs"]

_NO_LENGTH = 1e-6  # [m]; what the file rounds lengths to is a thousandth of that


def drop_stubs(network: Network) -> Network:
    """Takes away what leads from a unit straight to an end, over no part and no length.

    Such a stub is left where the pieces of line at an opening turned out to be something else. With it go the end and
    the opening that nothing else uses. Two units flange to flange stay connected, for both of them are there.

    Args:
        network: as it was found; it stays as it is.
    """
    at = Counter(node for link in network.links for node in (link.source, link.target))
    first_place = len(network.units)

    def is_stub(link: Link) -> bool:
        ends = (link.source, link.target)
        loose = [node for node in ends if node >= first_place and at[node] == 1]
        return bool(loose) and not link.via and link.length <= _NO_LENGTH

    stubs = [link for link in network.links if is_stub(link)]
    return _without(network, stubs) if stubs else network


def _without(network: Network, stubs: list[Link]) -> Network:
    """The network without some links, and without what only they used."""
    n_units = len(network.units)
    links = [link for link in network.links if link not in stubs]
    used = {node for link in links for node in (link.source, link.target)}
    gone = {node for link in stubs for node in (link.source, link.target)} - used
    kept = [k for k in range(n_units + len(network.places)) if k < n_units or k not in gone]
    number = {node: k for k, node in enumerate(kept)}
    ports = _ports(network, links, stubs)
    units = tuple(
        replace(unit, openings=tuple(unit.openings[port] for port in ports[k])) for k, unit in enumerate(network.units)
    )
    port_number = {(unit, port): new for unit, old in ports.items() for new, port in enumerate(old)}
    moved = tuple(
        replace(
            link,
            source=number[link.source],
            target=number[link.target],
            source_port=port_number.get((link.source, link.source_port), -1),
            target_port=port_number.get((link.target, link.target_port), -1),
        )
        for link in links
    )
    systems = (tuple(number[node] for node in members if node not in gone) for members in network.systems)
    places = tuple(place for k, place in enumerate(network.places, n_units) if k not in gone)
    return replace(network, units=units, places=places, links=moved, systems=tuple(s for s in systems if s))


def _ports(network: Network, links: list[Link], stubs: list[Link]) -> dict[int, list[int]]:
    """Of each unit the openings that stay: all but those that only stubs use."""

    def named(those: list[Link]) -> set[tuple[int, int]]:
        ends = [((link.source, link.source_port), (link.target, link.target_port)) for link in those]
        return {end for pair in ends for end in pair}

    dropped = named(stubs) - named(links)
    return {
        k: [port for port in range(len(unit.openings)) if (k, port) not in dropped]
        for k, unit in enumerate(network.units)
    }
