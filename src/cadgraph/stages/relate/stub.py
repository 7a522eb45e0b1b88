"""Stubs of a network: ends without length and parts, which stand for nothing in the plant."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

from cadgraph.model.parts import Link, Network, UnitParts

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
    links = [link for link in network.links if link not in stubs]
    gone = _nodes(stubs) - _nodes(links)
    first_place = len(network.units)
    stays = [*range(first_place), *(k for k in range(first_place, first_place + len(network.places)) if k not in gone)]
    number = {node: k for k, node in enumerate(stays)}
    ports = [_ports(k, len(unit.openings), links, stubs) for k, unit in enumerate(network.units)]
    return replace(
        network,
        units=tuple(map(_with_ports, network.units, ports)),
        places=tuple(network.places[node - first_place] for node in stays[first_place:]),
        links=tuple(_renumbered(link, number, ports) for link in links),
        systems=_systems(network, gone, number),
    )


def _systems(network: Network, gone: set[int], number: dict[int, int]) -> tuple[tuple[int, ...], ...]:
    """The connected networks that have anything left."""
    left = (tuple(number[node] for node in members if node not in gone) for members in network.systems)
    return tuple(members for members in left if members)


def _with_ports(unit: UnitParts, ports: list[int]) -> UnitParts:
    return replace(unit, openings=tuple(unit.openings[port] for port in ports))


def _nodes(links: list[Link]) -> set[int]:
    return {node for link in links for node in (link.source, link.target)}


def _ports(unit: int, n_openings: int, links: list[Link], stubs: list[Link]) -> list[int]:
    """The openings of a unit that stay: all but those that only stubs use."""
    gone = _used(unit, stubs) - _used(unit, links)
    return [port for port in range(n_openings) if port not in gone]


def _used(unit: int, links: list[Link]) -> set[int]:
    return {
        port
        for link in links
        for node, port in ((link.source, link.source_port), (link.target, link.target_port))
        if node == unit
    }


def _renumbered(link: Link, number: dict[int, int], ports: list[list[int]]) -> Link:
    """A link between the same things, by their new numbers."""

    def port_of(node: int, port: int) -> int:
        return ports[node].index(port) if port >= 0 else -1

    return replace(
        link,
        source=number[link.source],
        target=number[link.target],
        source_port=port_of(link.source, link.source_port),
        target_port=port_of(link.target, link.target_port),
    )
