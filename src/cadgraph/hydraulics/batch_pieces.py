"""What hangs together in many plants of one network: each plant a column, each sweep along the links one for all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.hydraulics.balance import LEAST, STILL
from cadgraph.hydraulics.network import Circuit, LinkKind

__all__ = ["Pieces", "Reach"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]

_GROUND = -1


@dataclass(frozen=True)
class Pieces:
    """What hangs together over open links.

    Args:
        circuit: the network.
        label: ``(n_nodes, n_plants)`` the lowest number of a node of the piece; -1 where a given head is in it.
        circulating: ``(n_nodes, n_plants)`` whether a pump moves something round in a node's piece.
        pins: ``(n_nodes, n_plants)`` whether the head of a node is set so that its floating piece has one.
    """

    circuit: Circuit
    label: Ints
    circulating: Bools
    pins: Bools

    def pin_heads(self, head: Floats, loop_head: Floats) -> Floats:
        """The heads to set at pins.

        Args:
            head: ``(n_nodes, n_plants)`` the last ones, NaN where never known.
            loop_head: ``(n_nodes, 1)`` at the suction of a pump in a loop that nothing feeds.

        Returns:
            ``(n_nodes, n_plants)``; anything where there is no pin.
        """
        mean, known = self._means(head)
        # Two that were apart even out; nothing says how much each holds.
        floating = np.where(known, mean, 0.0)
        return np.where(self.circulating, np.where(np.isnan(head), loop_head, head), floating)

    def _means(self, head: Floats) -> tuple[Floats, Bools]:
        """The mean of the known heads of each node's piece, and whether there is one."""
        n_nodes, n_plants = head.shape
        known = ~np.isnan(head)
        group = ((self.label + 1) * n_plants + np.arange(n_plants)).reshape(-1)
        size = (n_nodes + 1) * n_plants
        count = np.bincount(group, known.reshape(-1), size)
        total = np.bincount(group, np.where(known, head, 0.0).reshape(-1), size)
        with np.errstate(invalid="ignore"):
            mean = (total / count)[group].reshape(head.shape)
        return mean, (count > 0)[group].reshape(head.shape)

    def even_out(
        self, head: Floats, last: Floats, offset: Floats, floor: Floats, shut_ways: Bools, starved: Bools, pumps: Ints
    ) -> Floats:
        """Heads of pieces that float: what presses through a valve that lets pass one way only evens out.

        Args:
            head: ``(n_nodes, n_plants)`` as solved.
            last: likewise, from before.
            offset: ``(n_links, n_plants)`` head lost before anything flows.
            floor: ``(n_nodes, 1)`` head at which the fluid boils.
            shut_ways: ``(n_links, n_plants)`` links that let pass one way and are shut for now.
            starved: ``(n_pumps, n_plants)`` pumps that nothing can flow to.
            pumps: ``(n_pumps,)`` their links.
        """
        floats = (self.label >= 0) & ~self.circulating
        plants = np.flatnonzero(floats.any(axis=0))
        if not len(plants):
            return head
        label, floating = self.label[:, plants], floats[:, plants]
        heads = head[:, plants].copy()
        _, known = self._means(last)
        heads[floating & ~known[:, plants]] = np.nan
        self._pull(heads, label, floating, floor, starved[:, plants], pumps)
        ways = np.flatnonzero(shut_ways[:, plants].any(axis=1))
        offset, shut_ways = offset[:, plants], shut_ways[:, plants]
        # As often as it has pieces: what presses has come everywhere by then.
        rounds = self.pins[:, plants].sum(axis=0) + 1
        for number in range(int(rounds.max())):
            before = heads.copy()
            for link in ways:
                self._press(heads, label, floating, offset[link], shut_ways[link] & (number < rounds), int(link))
            if np.array_equal(before, heads, equal_nan=True):
                break
        evened = head.copy()
        evened[:, plants] = heads
        return evened

    def _pull(self, heads: Floats, label: Ints, floating: Bools, floor: Floats, starved: Bools, pumps: Ints) -> None:
        """A pump that nothing flows to pulls its suction down until the fluid boils."""
        nodes = self.circuit.start[pumps]
        for number, node in enumerate(nodes):
            pulls = starved[number] & floating[node]
            if not pulls.any():
                continue
            # The lowest of all that pull at the same piece.
            level = np.full(heads.shape[1], np.inf)
            for other, there in enumerate(nodes):
                same = starved[other] & (label[there] == label[node])
                level = np.where(same, np.fmin(level, floor[there, 0]), level)
            heads[:] = np.where(pulls & (label == label[node]), level, heads)

    def _press(self, heads: Floats, label: Ints, floating: Bools, offset: Floats, shut: Bools, link: int) -> None:
        a, b = int(self.circuit.start[link]), int(self.circuit.end[link])
        apart = shut & (label[a] != label[b])
        with np.errstate(invalid="ignore"):
            pressing = heads[a] - offset
            into = apart & floating[b] & ~np.isnan(pressing) & ~(heads[b] >= pressing)
            out = apart & ~into & floating[a] & ~np.isnan(heads[b]) & (heads[a] > heads[b] + offset)
        new = np.where(into, pressing, heads[b] + offset)
        turned = np.where(into, label[b], label[a])
        plants = np.flatnonzero(into | out)
        if len(plants):
            heads[:, plants] = np.where(label[:, plants] == turned[plants], new[plants], heads[:, plants])


class Reach:
    """Finds what hangs together in a network.

    Args:
        circuit: the network.
    """

    def __init__(self, circuit: Circuit) -> None:
        self.circuit = circuit
        self.pumps = np.flatnonzero(circuit.kind == LinkKind.PUMP)
        self._ends = list(zip(circuit.start.tolist(), circuit.end.tolist(), strict=True))

    def pieces(self, linked: Bools, running: Bools) -> Pieces:
        """What hangs together.

        Args:
            linked: ``(n_links, n_plants)`` links over which it does.
            running: likewise, of pumps whether they run.
        """
        circuit = self.circuit
        nodes = np.arange(len(circuit.nodes))
        label = np.repeat(np.where(circuit.fixed, _GROUND, nodes)[:, None], linked.shape[1], axis=1)
        way = list(enumerate(self._ends))
        while True:
            before = label.copy()
            # To and fro, so that a long line takes two sweeps whichever way its links are numbered.
            for link, (a, b) in (*way, *reversed(way)):
                least = np.minimum(label[a], label[b])
                np.copyto(label[a], least, where=linked[link])
                np.copyto(label[b], least, where=linked[link])
            if np.array_equal(before, label):
                break
        pins = label == nodes[:, None]
        circulating = np.zeros(label.shape, bool)
        for pump in self.pumps[::-1].tolist():
            at = self._ends[pump][0]
            round_it = linked[pump] & running[pump] & (label[at] >= 0)
            same = round_it & (label == label[at])
            circulating |= same
            # Of several pumps in a piece the first is its pin.
            pins &= ~same
            pins[at] |= round_it
        return Pieces(circuit, label, circulating, pins)

    def starved(self, shut: Bools, one_way: Bools) -> Bools:
        """``(n_pumps, n_plants)`` the running pumps that nothing can flow to.

        Args:
            shut: ``(n_links, n_plants)`` where nothing can flow.
            one_way: ``(n_links, n_plants)`` where nothing flows from end to start.
        """
        onward, back = ~shut, ~shut & ~one_way
        fed = np.repeat(self.circuit.fixed[:, None], shut.shape[1], axis=1)
        self._flood(fed, onward, back)
        for pump in self.pumps.tolist():
            start, end = self._ends[pump]
            plants = np.flatnonzero(onward[pump] & one_way[pump] & ~fed[start])
            if not len(plants):
                continue
            around = np.zeros((len(fed), len(plants)), bool)
            around[end] = True
            self._flood(around, onward[:, plants], back[:, plants])
            round_it = around[start]
            fed[:, plants] |= around & round_it
        starts = self.circuit.start[self.pumps]
        found: Bools = onward[self.pumps] & one_way[self.pumps] & ~fed[starts]
        return found

    def held(self, shut: Bools, one_way: Bools, starved: Bools) -> Bools:
        """``(n_links, n_plants)`` valves that would let out of what starved pumps draw empty, which holds them shut.

        Args:
            shut: ``(n_links, n_plants)`` where nothing can flow.
            one_way: ``(n_links, n_plants)`` where nothing flows from end to start.
            starved: ``(n_pumps, n_plants)``, as :meth:`starved` found them.
        """
        plants = np.flatnonzero(starved.any(axis=0))
        found = np.zeros(shut.shape, bool)
        if not len(plants):
            return found
        onward = ~shut[:, plants]
        empty = np.zeros((len(self.circuit.nodes), len(plants)), bool)
        for number, pump in enumerate(self.pumps.tolist()):
            empty[self._ends[pump][0]] |= starved[number, plants]
        self._flood(empty, onward & ~one_way[:, plants], onward)
        out = empty[self.circuit.start] & ~empty[self.circuit.end]
        found[:, plants] = onward & one_way[:, plants] & out
        return found

    def emptied(self, head: Floats, flow: Floats, opened: Bools, to_air: Bools) -> Bools:
        """``(n_nodes, n_plants)`` where nothing flows and air has got to, above what stands in the pipe below.

        Args:
            head: ``(n_nodes, n_plants)``.
            flow: ``(n_links, n_plants)``.
            opened: ``(n_links, n_plants)`` where something could flow.
            to_air: ``(n_links, n_plants)`` links that lead into the open and aren't shut.
        """
        circuit = self.circuit
        start, end = circuit.start, circuit.end
        with np.errstate(invalid="ignore"):
            low = head < circuit.height[:, None] + LEAST
        still = np.abs(flow) < STILL
        found = np.zeros(head.shape, bool)
        for link in np.flatnonzero(to_air.any(axis=1)).tolist():
            found[start[link]] |= to_air[link] & still[link] & low[start[link]]
        plants = np.flatnonzero(found.any(axis=0))
        if len(plants):
            reached = found[:, plants]
            along = (still & opened & low[start] & low[end])[:, plants]
            self._flood(reached, along, along)
            found[:, plants] = reached
        return found

    def _flood(self, reached: Bools, onward: Bools, back: Bools) -> None:
        """Spreads what is reached along links, in place."""
        way = list(enumerate(self._ends))
        while True:
            count = int(reached.sum())
            for link, (a, b) in (*way, *reversed(way)):
                reached[b] |= reached[a] & onward[link]
                reached[a] |= reached[b] & back[link]
            if int(reached.sum()) == count:
                break
