"""The steady state of a network: the flow in each link and the head at each node.

Newton's method on flows and heads together (the global gradient algorithm; Todini and Pilati 1988), damped along the
content of the network, which is convex: it can't run away. What lets pass one way only is open or shut, and is turned
until no flow and no head contradicts that (as EPANET does it, between its iterations).

Pieces that nothing of known head reaches are told apart: they keep the head that they had, but for what flows in or out
through a check or relief valve until both sides are even. A pump whose suction would fall below the pressure at which
the fluid boils gives only what reaches it at that pressure.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu

from cadgraph.errors import ScenarioError
from cadgraph.hydraulics.laws import CREEP, quadratic
from cadgraph.hydraulics.network import Circuit, LinkKind

__all__ = ["Condition", "Solution", "Solver"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]

STEP = 1e-8
"""Greatest change of a flow at which the iteration ends [m3/s]; at rest no relative change ever gets small."""
RELATIVE_STEP = 1e-9
"""Change of all flows, as a share of their sum, at which the iteration ends."""
LEAST_FLOW = 1e-15
"""Flow below which there is none [m3/s]: what rounding leaves, on some processors, where everything is shut."""
BACKFLOW = 1e-9
"""Flow against its way at which an open check valve shuts [m3/s]."""
LIFT = 1e-6
"""Head that opens what is shut [m]."""
MOST_STEPS = 100
_MOST_ROUNDS = 80
_ROUNDS_AT_ONCE = 12  # in which all that contradict turn at once; then one by one, so that nothing swings for ever
MOST_CHANGES = 3  # of a pump that is choked, then isn't; then it isn't
WILD = 1e3  # m3/s; of a step that leads nowhere
_START = 0.5  # velocity to begin with [m/s]


@dataclass(frozen=True)
class Condition:
    """What a network stands under.

    Args:
        square: (n_links,) head per square of the flow, valves as far open as they are [s2/m5].
        offset: (n_links,) head lost before anything flows [m]; negative for running pumps.
        shut: (n_links,) whether nothing can flow.
        one_way: (n_links,) whether nothing flows from end to start.
        head: (n_nodes,) of nodes whose head is given [m]; of others the last one, NaN where it was never known.
        floor: (n_nodes,) head at which the fluid boils [m].
        loop_head: (n_nodes,) head at the suction of a pump in a loop that nothing feeds [m].
    """

    square: Floats
    offset: Floats
    shut: Bools
    one_way: Bools
    head: Floats
    floor: Floats
    loop_head: Floats


@dataclass(frozen=True)
class Solution:
    """A steady state.

    Args:
        flow: (n_links,) from start to end [m3/s].
        head: (n_nodes,) [m]; NaN where nothing is known.
        open: (n_links,) whether something could flow.
        shut_in: (n_nodes,) whether nothing of known head reaches a node.
        cavitating: numbers of the pump links that get too little.
        steps: of Newton's method in all.
        last_step: greatest change of a flow in the last one [m3/s].
        settled: whether nothing contradicts anything.
    """

    flow: Floats
    head: Floats
    open: Bools
    shut_in: Bools
    cavitating: tuple[int, ...]
    steps: int
    last_step: float
    settled: bool


@dataclass(frozen=True)
class _Pieces:
    """What hangs together over open links.

    Args:
        of_node: (n_nodes,) number of the piece; 0 holds all nodes of given head.
        pins: numbers of the nodes whose head is set so that each floating piece has one.
        circulating: (n_pieces,) whether a pump moves something round in it.
    """

    of_node: Ints
    pins: Ints
    circulating: Bools


class Solver:
    """Solves one network under any condition.

    Args:
        circuit: the network.
    """

    def __init__(self, circuit: Circuit) -> None:
        self.circuit = circuit
        n_nodes, n_links = len(circuit.nodes), len(circuit.kind)
        self._free = np.flatnonzero(~circuit.fixed)
        self._row = np.full(n_nodes, -1)
        self._row[self._free] = np.arange(len(self._free))
        links = np.arange(n_links)
        into = sparse.csr_matrix((np.ones(n_links), (circuit.end, links)), shape=(n_nodes, n_links))
        out_of = sparse.csr_matrix((np.ones(n_links), (circuit.start, links)), shape=(n_nodes, n_links))
        self._incidence = sparse.csr_matrix((into - out_of)[self._free])
        self._pumps = np.flatnonzero(circuit.kind == LinkKind.PUMP)
        self._lay_pattern()
        self._first = circuit.creep * (_START / CREEP)
        self._known_pieces: dict[bytes, _Pieces] = {}
        self._known_starved: dict[bytes, tuple[Ints, Ints, Ints]] = {}

    def _lay_pattern(self) -> None:
        """Where in the matrix each link counts; that stays as it is, only the values change."""
        a, b = self._row[self.circuit.start], self._row[self.circuit.end]
        links = np.arange(len(a))
        n = len(self._free)
        rows, columns, of_link, signs = [np.arange(n)], [np.arange(n)], [np.full(n, -1)], [np.zeros(n)]
        for one, other, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            inner = (one >= 0) & (other >= 0) & (a != b)
            rows.append(one[inner])
            columns.append(other[inner])
            of_link.append(links[inner])
            signs.append(np.full(int(inner.sum()), sign))
        row, column = np.concatenate(rows), np.concatenate(columns)
        cells, at = np.unique(column * max(n, 1) + row, return_inverse=True)
        self._indices = (cells % max(n, 1)).astype(np.int32)
        counts = np.bincount(cells // max(n, 1), minlength=n) if n else np.zeros(0, int)
        self._pointers = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
        self._diagonal = at[:n]
        link, sign_of = np.concatenate(of_link), np.concatenate(signs)
        real = link >= 0
        self._spread = sparse.csr_matrix((sign_of[real], (at[real], link[real])), shape=(len(cells), len(links)))

    # One state

    def solve(self, condition: Condition, last: Solution | None = None) -> Solution:
        """The steady state under a condition.

        Args:
            condition: what it stands under.
            last: a state to begin from; the nearer, the faster.
        """
        starved, pulled, held = self._starved(condition)
        turning = condition.one_way & ~condition.shut
        turning[starved] = turning[held] = False
        usable = ~condition.shut
        usable[starved] = False
        opened = usable & (self.circuit.kind != LinkKind.RELIEF)
        opened[held] = False
        choked: tuple[int, ...] = ()
        flow = self._first
        if last is not None:
            opened[turning] = last.open[turning]
            # What a pump gives at no flow stands behind it, whatever was shut before.
            opened[self._pumps] = usable[self._pumps]
            choked = tuple(pump for pump in last.cavitating if opened[pump] and condition.one_way[pump])
            flow = last.flow
        let_go: Counter[int] = Counter()
        running = self._running(condition)
        steps, turned = 0, np.ones_like(opened)
        more: list[int] = []
        fewer: list[int] = []
        for number in range(_MOST_ROUNDS):
            choked, pieces = self._kept(opened, choked, let_go, running)
            flow, head, taken, step = self._newton(condition, opened, pieces, flow, choked)
            steps += taken
            if choked and step > STEP and taken >= MOST_STEPS:
                # What is left to a choked pump can lie behind it; then there is no such flow.
                let_go.update(dict.fromkeys(choked, MOST_CHANGES))
                choked, flow = (), self._first
                continue
            head = self._even_out(condition, opened, usable, pieces, head, pulled)
            free = turning.copy()
            free[list(choked)] = False
            turned = self._turned(condition, free, opened, flow, head, one_by_one=number >= _ROUNDS_AT_ONCE)
            if turned.any():
                opened = opened ^ turned
                continue
            more, fewer = self._choking(condition, opened, choked, flow, head)
            more = [pump for pump in more if let_go[pump] < MOST_CHANGES]
            if not more and not fewer:
                break
            let_go.update(fewer)
            choked = tuple(sorted({*choked, *more} - {*fewer}))
        settled = step <= STEP or taken < MOST_STEPS
        settled = settled and not (turned.any() or more or fewer)
        lacking = {*choked, *map(int, starved), *self._choking(condition, opened, choked, flow, head)[0]}
        shut_in = (pieces.of_node > 0) & ~pieces.circulating[pieces.of_node]
        flow = np.where(np.abs(flow) < LEAST_FLOW, 0.0, flow)
        return Solution(flow, head, opened, shut_in, tuple(sorted(lacking)), steps, step, settled)

    def _running(self, condition: Condition) -> Ints:
        """The pumps that run; through others it flows either way."""
        running: Ints = self._pumps[(condition.one_way & ~condition.shut)[self._pumps]]
        return running

    def _kept(
        self, opened: Bools, choked: Sequence[int], let_go: Counter[int], running: Ints
    ) -> tuple[tuple[int, ...], _Pieces]:
        """The pumps that stay choked, as both of their sides hang together with a given head, and the pieces then."""
        kept = tuple(pump for pump in choked if opened[pump])
        while True:
            pieces = self._pieces(opened, kept, running)
            apart = [
                pump
                for pump in kept
                if pieces.of_node[self.circuit.start[pump]] > 0 or pieces.of_node[self.circuit.end[pump]] > 0
            ]
            if not apart:
                return kept, pieces
            let_go.update(apart)
            kept = tuple(pump for pump in kept if pump not in apart)

    def _newton(
        self,
        condition: Condition,
        opened: Bools,
        pieces: _Pieces,
        flow: Floats,
        choked: Sequence[int],
    ) -> tuple[Floats, Floats, int, float]:
        """Flows and heads with everything open or shut as it is; how many steps that took, and the last one."""
        circuit, free = self.circuit, self._free
        head = condition.head.copy()
        given = np.where(circuit.fixed, head, 0.0)
        outer = given[circuit.start] - given[circuit.end]
        pin_rows = self._row[pieces.pins]
        pin_heads = self._pin_heads(condition, pieces)
        flow = np.where(opened, flow, 0.0)
        step, drop = np.inf, np.zeros_like(flow)
        linear = opened.copy()
        linear[list(choked)] = False
        balanced = False
        taken = 0
        loss, slope = self._loss(condition, flow)
        while taken < MOST_STEPS:
            taken += 1
            ease = np.where(linear, 1 / slope, 0.0)
            data = self._spread @ ease
            data[self._diagonal[pin_rows]] += 1.0
            right = self._incidence @ np.where(linear, flow + ease * (outer - loss), 0.0)
            right[pin_rows] += pin_heads
            solved, forced = self._linear(data, right, condition, choked)
            head[free] = solved
            drop = head[circuit.start] - head[circuit.end]
            change = np.where(linear, ease * (drop - loss), 0.0)
            for link, value in zip(choked, forced, strict=True):
                change[link] = value - flow[link]
            descent = float(((loss - drop) * change).sum()) if balanced and not choked else None
            flow, loss, slope = self._gone(condition, flow, change, drop, descent)
            balanced = True
            step = float(np.abs(change).max(initial=0.0))
            if choked and step > WILD:
                return flow, head, MOST_STEPS, step
            if step < STEP or np.abs(change).sum() < RELATIVE_STEP * np.abs(flow).sum():
                break
        return flow, head, taken, step

    def _loss(self, condition: Condition, flow: Floats) -> tuple[Floats, Floats]:
        friction, slope = self.circuit.friction.loss(flow)
        other, other_slope = quadratic(flow, condition.square, self.circuit.creep)
        return friction + other + condition.offset, slope + other_slope

    def _linear(
        self, data: Floats, right: Floats, condition: Condition, choked: Sequence[int]
    ) -> tuple[Floats, Floats]:
        """Heads of the free nodes, and the flows of choked pumps, whose suctions have the head at which it boils."""
        n = len(self._free)
        if n == 0:
            return np.zeros(0), np.zeros(0)
        matrix = sparse.csc_matrix((data, self._indices, self._pointers), shape=(n, n))
        try:
            factors = splu(matrix)
        except RuntimeError:
            raise ScenarioError(
                "no flow can be found, as a value is so large or so small that numbers run out; give those of a plant"
            ) from None
        heads = factors.solve(right)
        # Short wide pipes beside narrow ones lose digits; one refinement gets them back.
        heads += factors.solve(right - matrix @ heads)
        if not choked:
            return heads, np.zeros(0)
        at, to = self._row[self.circuit.start[list(choked)]], self._row[self.circuit.end[list(choked)]]
        moved = np.zeros((n, len(choked)))
        for column, (suction, discharge) in enumerate(zip(at, to, strict=True)):
            moved[suction, column] -= 1.0
            if discharge >= 0:
                moved[discharge, column] += 1.0
        effect = factors.solve(moved)
        wanted = condition.floor[self.circuit.start[list(choked)]]
        flows = np.linalg.lstsq(effect[at], wanted - heads[at], rcond=None)[0]
        return heads + effect @ flows, flows

    def _gone(
        self, condition: Condition, flow: Floats, change: Floats, drop: Floats, descent: float | None
    ) -> tuple[Floats, Floats, Floats]:
        """The flows after a step, with the losses and slopes there.

        A step goes as far as the content of the network still falls, or nearly so.

        Args:
            condition: what the network stands under.
            flow: before the step.
            change: the whole step.
            drop: heads that are left for each link.
            descent: how the content changes along the step at its beginning; None goes all of it.
        """
        low, high, share = 0.0, 1.0, 1.0
        loss, slope = self._loss(condition, flow + change)
        for _ in range(0 if descent is None else 12):
            along = float(((loss - drop) * change).sum())
            if abs(along) <= 0.5 * abs(descent or 0.0) + 1e-15 or (along < 0 and share == 1.0):
                break
            low, high = (low, share) if along > 0 else (share, high)
            share = (low + high) / 2
            loss, slope = self._loss(condition, flow + share * change)
        return flow + share * change, loss, slope

    # What hangs together

    def _pieces(self, opened: Bools, choked: Sequence[int], running: Ints) -> _Pieces:
        linked = opened.copy()
        linked[list(choked)] = False
        key = linked.tobytes() + running.tobytes()
        if key not in self._known_pieces:
            if len(self._known_pieces) > 1000:
                self._known_pieces.clear()
            self._known_pieces[key] = self._find_pieces(linked, running)
        return self._known_pieces[key]

    def _find_pieces(self, linked: Bools, running: Ints) -> _Pieces:
        circuit, n = self.circuit, len(self.circuit.nodes)
        ground = np.flatnonzero(circuit.fixed)
        # All nodes of given head are one: node n.
        a = np.concatenate([circuit.start[linked], ground])
        b = np.concatenate([circuit.end[linked], np.full(len(ground), n)])
        matrix = sparse.csr_matrix((np.ones(len(a)), (a, b)), shape=(n + 1, n + 1))
        count, labels = csgraph.connected_components(matrix, directed=False)
        order = np.full(count, -1)
        order[labels[n]] = 0
        following = 1
        for label in labels[:n]:
            if order[label] < 0:
                order[label] = following
                following += 1
        of_node = order[labels[:n]]
        circulating = np.zeros(count, bool)
        pins = np.zeros(count, int)
        for node in range(n - 1, -1, -1):
            pins[of_node[node]] = node
        for pump in running[linked[running]][::-1]:
            piece = of_node[circuit.start[pump]]
            circulating[piece] = piece > 0
            pins[piece] = circuit.start[pump]
        return _Pieces(of_node, pins[1:], circulating)

    def _pin_heads(self, condition: Condition, pieces: _Pieces) -> Floats:
        """The head to set at the pin of each floating piece."""
        found = []
        for number, pin in enumerate(pieces.pins, 1):
            own = condition.head[pieces.of_node == number]
            own = own[~np.isnan(own)]
            if pieces.circulating[number]:
                known = condition.head[pin]
                found.append(condition.loop_head[pin] if np.isnan(known) else known)
            else:
                # Two that were apart even out; nothing says how much each holds.
                found.append(float(own.mean()) if len(own) else 0.0)
        return np.array(found)

    def _even_out(
        self, condition: Condition, opened: Bools, usable: Bools, pieces: _Pieces, head: Floats, pulled: Ints
    ) -> Floats:
        """Heads of pieces that float: what presses through a valve that lets pass one way only evens out."""
        circuit = self.circuit
        n_pieces = len(pieces.pins) + 1
        if n_pieces == 1:
            return head
        floating = np.ones(n_pieces, bool)
        floating[0] = False
        floating &= ~pieces.circulating
        known = np.zeros(n_pieces, bool)
        for number in np.flatnonzero(floating):
            known[number] = not np.isnan(condition.head[pieces.of_node == number]).all()
        heads = head.copy()
        heads[(floating & ~known)[pieces.of_node]] = np.nan
        for node in pulled:
            number = pieces.of_node[node]
            if floating[number]:
                lowest = np.fmin.reduce(condition.floor[[n for n in pulled if pieces.of_node[n] == number]])
                heads[pieces.of_node == number] = lowest
        shut_ways = np.flatnonzero(usable & ~opened & condition.one_way)
        for _ in range(n_pieces):
            before = heads.copy()
            for link in shut_ways:
                a, b = circuit.start[link], circuit.end[link]
                into, out_of = pieces.of_node[b], pieces.of_node[a]
                if into == out_of:
                    continue
                pressing = heads[a] - condition.offset[link]
                if floating[into] and not np.isnan(pressing) and not heads[b] >= pressing:
                    heads[pieces.of_node == into] = pressing
                elif floating[out_of] and not np.isnan(heads[b]) and heads[a] > heads[b] + condition.offset[link]:
                    heads[pieces.of_node == out_of] = heads[b] + condition.offset[link]
            if np.array_equal(before, heads, equal_nan=True):
                break
        return heads

    def _starved(self, condition: Condition) -> tuple[Ints, Ints, Ints]:
        """The running pumps that nothing can flow to, the nodes that they draw from, and what they hold shut.

        A valve that would let out of what they draw empty lets nothing through, whatever the pressure behind it was.
        """
        key = condition.shut.tobytes() + condition.one_way.tobytes()
        if key not in self._known_starved:
            if len(self._known_starved) > 1000:
                self._known_starved.clear()
            self._known_starved[key] = self._find_starved(condition)
        return self._known_starved[key]

    def _find_starved(self, condition: Condition) -> tuple[Ints, Ints, Ints]:
        circuit = self.circuit
        onward: list[list[int]] = [[] for _ in circuit.nodes]
        upstream: list[list[int]] = [[] for _ in circuit.nodes]
        feeding: set[int] = set(np.flatnonzero(circuit.fixed).tolist())
        for link in np.flatnonzero(~condition.shut):
            a, b = int(circuit.start[link]), int(circuit.end[link])
            onward[a].append(b)
            upstream[b].append(a)
            if not condition.one_way[link]:
                onward[b].append(a)
                upstream[a].append(b)

        def reached(seeds: Iterable[int], ways: Sequence[Sequence[int]] = onward) -> set[int]:
            seen = set(seeds)
            waiting = list(seen)
            while waiting:
                for there in ways[waiting.pop()]:
                    if there not in seen:
                        seen.add(there)
                        waiting.append(there)
            return seen

        fed, running = reached(feeding), self._running(condition)
        starved = []
        for link in running:
            if int(circuit.start[link]) in fed:
                continue
            around = reached([int(circuit.end[link])])
            if int(circuit.start[link]) in around:
                fed |= around
        for link in running:
            if int(circuit.start[link]) not in fed:
                starved.append(int(link))
        found = np.array(starved, int)
        empty = np.zeros(len(circuit.nodes), bool)
        empty[list(reached(circuit.start[found].tolist(), upstream))] = True
        held = condition.one_way & ~condition.shut & empty[circuit.start] & ~empty[circuit.end]
        return found, circuit.start[found], np.flatnonzero(held)

    # What lets pass one way only

    def _turned(
        self, condition: Condition, turning: Bools, opened: Bools, flow: Floats, head: Floats, one_by_one: bool
    ) -> Bools:
        """Which links that let pass one way only contradict their flow or heads, so that they are to be turned."""
        pressing = head[self.circuit.start] - head[self.circuit.end] - condition.offset
        closing = turning & opened & (flow < -BACKFLOW)
        opening = turning & ~opened & (pressing > LIFT)
        if np.delete(closing, self._pumps).any():
            # A pump presses against the check valve behind it: that shuts first, and then nothing flows back.
            closing[self._pumps] = False
        turned = closing | opening
        if one_by_one and turned.any():
            size = np.where(closing, -flow / BACKFLOW, np.where(opening, pressing / LIFT, 0.0))
            turned = np.zeros_like(turned)
            turned[int(np.argmax(size))] = True
        return turned

    def _choking(
        self, condition: Condition, opened: Bools, choked: Sequence[int], flow: Floats, head: Floats
    ) -> tuple[list[int], list[int]]:
        """The pumps that draw more than reaches them, and the choked ones that no longer do."""
        circuit = self.circuit
        more, fewer = [], []
        loss = self._loss(condition, flow)[0] if choked else flow
        for pump in map(int, self._running(condition)):
            a, b = int(circuit.start[pump]), int(circuit.end[pump])
            if pump in choked:
                if head[a] - head[b] - loss[pump] < -LIFT or flow[pump] < -BACKFLOW:
                    fewer.append(pump)
            elif opened[pump] and flow[pump] > BACKFLOW and head[a] < condition.floor[a] - LIFT:
                more.append(pump)
        return more, fewer
