"""The steady states of many plants of one network at once.

The same method as :mod:`cadgraph.hydraulics.solve`, step by step, with arrays that have a plant in each column: what is
open or shut, which pieces hang together and how far a step goes differ from plant to plant, the network doesn't. Plants
that are done drop out.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy import sparse

from cadgraph.hydraulics.batch_pieces import Pieces, Reach
from cadgraph.hydraulics.elimination import Elimination
from cadgraph.hydraulics.laws import quadratic
from cadgraph.hydraulics.network import Circuit, LinkKind
from cadgraph.hydraulics.solve import (
    BACKFLOW,
    LEAST_FLOW,
    LIFT,
    MOST_CHANGES,
    MOST_STEPS,
    RELATIVE_STEP,
    STEP,
    WILD,
    Condition,
    Solution,
    Solver,
)

__all__ = ["BatchSolver", "Conditions", "Solutions"]

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]

_HALVINGS = 12
_ROUNDS = 6  # few plants need more
_EPSILON = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Conditions:
    """What each plant stands under: the arrays of :class:`~cadgraph.hydraulics.solve.Condition` side by side.

    Args:
        square: ``(n_links, n_plants)``.
        offset: ``(n_links, n_plants)``.
        shut: ``(n_links, n_plants)``.
        one_way: ``(n_links, n_plants)``.
        head: ``(n_nodes, n_plants)``.
        floor: ``(n_nodes, 1)``.
        loop_head: ``(n_nodes, 1)``.
    """

    square: Floats
    offset: Floats
    shut: Bools
    one_way: Bools
    head: Floats
    floor: Floats
    loop_head: Floats

    def of(self, plants: Ints) -> Conditions:
        """Those of some plants."""
        return Conditions(
            self.square[:, plants],
            self.offset[:, plants],
            self.shut[:, plants],
            self.one_way[:, plants],
            self.head[:, plants],
            self.floor,
            self.loop_head,
        )


@dataclass(frozen=True)
class Solutions:
    """The steady states: the arrays of :class:`~cadgraph.hydraulics.solve.Solution` side by side.

    Args:
        flow: ``(n_links, n_plants)`` from start to end [m3/s].
        head: ``(n_nodes, n_plants)`` [m]; NaN where nothing is known.
        open: ``(n_links, n_plants)`` whether something could flow.
        shut_in: ``(n_nodes, n_plants)`` whether nothing of known head reaches a node.
        cavitating: ``(n_pumps, n_plants)`` whether a pump gets too little.
        settled: ``(n_plants,)`` whether nothing contradicts anything.
    """

    flow: Floats
    head: Floats
    open: Bools
    shut_in: Bools
    cavitating: Bools
    settled: Bools

    def of(self, plants: Ints) -> Solutions:
        """Those of some plants."""
        return Solutions(*(getattr(self, name)[..., plants] for name in self.__dataclass_fields__))

    def put(self, plants: Ints, other: Solutions) -> None:
        """Takes over those of some plants."""
        for name in self.__dataclass_fields__:
            getattr(self, name)[..., plants] = getattr(other, name)


class BatchSolver:
    """Solves one network under many conditions.

    Args:
        circuit: the network.
    """

    def __init__(self, circuit: Circuit) -> None:
        self.circuit = circuit
        self.pumps = np.flatnonzero(circuit.kind == LinkKind.PUMP)
        n_nodes = len(circuit.nodes)
        self.free = np.flatnonzero(~circuit.fixed)
        self.row = np.full(n_nodes, -1)
        self.row[self.free] = np.arange(len(self.free))
        a, b = self.row[circuit.start], self.row[circuit.end]
        inner = (a >= 0) & (b >= 0) & (a != b)
        self.elimination = Elimination(len(self.free), zip(a[inner].tolist(), b[inner].tolist(), strict=True))
        self.spread = self._pattern(a, b, inner)
        self.incidence = self._balance(a, b)
        friction = circuit.friction
        names = ("laminar", "square", "reynolds", "rough")
        self._friction = replace(friction, **{name: getattr(friction, name)[:, None] for name in names})
        self._creep = circuit.creep[:, None]
        self.reach = Reach(circuit)
        self._alone = Solver(circuit)

    def _pattern(self, a: Ints, b: Ints, inner: Bools) -> sparse.csr_matrix:
        """In which cells of the equations each link counts."""
        links = np.arange(len(a))
        cells = [self.elimination.cell(int(i), int(j)) for i, j in zip(a[inner], b[inner], strict=True)]
        own = a != b
        places = [(a[own & (a >= 0)], links[own & (a >= 0)], 1.0), (b[own & (b >= 0)], links[own & (b >= 0)], 1.0)]
        places.append((np.array(cells, np.int64), links[inner], -1.0))
        rows, columns = (np.concatenate([place[k] for place in places]) for k in (0, 1))
        values = np.concatenate([np.full(len(place[0]), place[2]) for place in places])
        return sparse.csr_matrix((values, (rows, columns)), shape=(self.elimination.size, len(links)))

    def _balance(self, a: Ints, b: Ints) -> sparse.csr_matrix:
        """What flows into each free node."""
        links = np.arange(len(a))
        rows = np.concatenate([b[b >= 0], a[a >= 0]])
        columns = np.concatenate([links[b >= 0], links[a >= 0]])
        signs = np.concatenate([np.ones(int((b >= 0).sum())), -np.ones(int((a >= 0).sum()))])
        return sparse.csr_matrix((signs, (rows, columns)), shape=(len(self.free), len(links)))

    def solve(self, given: Conditions, last: Solutions) -> Solutions:
        """The steady states under conditions.

        Args:
            given: what each plant stands under.
            last: states to begin from, of as many plants; the nearer, the faster.
        """
        usable, starved = ~given.shut, self.reach.starved(given.shut, given.one_way)
        usable[self.pumps] &= ~starved
        held = self.reach.held(given.shut, given.one_way, starved)
        turning = given.one_way & usable & ~held
        opened = np.where(turning, last.open, usable & ~held)
        # What a pump gives at no flow stands behind it, whatever was shut before.
        opened[self.pumps] = usable[self.pumps]
        n = given.square.shape[1]
        # Until the end, 'cavitating' holds the pumps that give only what reaches them.
        found = Solutions(
            last.flow.copy(), given.head.copy(), opened, np.zeros(given.head.shape, bool),
            last.cavitating & opened[self.pumps], np.zeros(n, bool),
        )  # fmt: skip
        let_go, alone, left = np.zeros((len(self.pumps), n), np.int64), np.zeros(n, bool), np.arange(n)
        for _ in range(_ROUNDS):
            if not len(left):
                break
            work = _Round(
                self,
                given.of(left),
                found.of(left),
                usable[:, left],
                turning[:, left],
                starved[:, left],
                let_go[:, left],
            )
            work.go()
            found.put(left, work.now)
            let_go[:, left], alone[left] = work.let_go, work.lost
            left = left[~(work.now.settled | work.lost)]
        alone[left] = True
        found.cavitating[:] |= starved
        for plant in np.flatnonzero(alone).tolist():
            self._solve_alone(plant, given, last, found)
        found.flow[np.abs(found.flow) < LEAST_FLOW] = 0.0
        return found

    def _solve_alone(self, plant: int, given: Conditions, last: Solutions, found: Solutions) -> None:
        """Solves one plant by itself: it takes many rounds, which cost less so."""
        condition = Condition(
            given.square[:, plant], given.offset[:, plant], given.shut[:, plant], given.one_way[:, plant],
            given.head[:, plant], given.floor[:, 0], given.loop_head[:, 0],
        )  # fmt: skip
        before = Solution(
            last.flow[:, plant], last.head[:, plant], last.open[:, plant], last.shut_in[:, plant],
            tuple(self.pumps[last.cavitating[:, plant]].tolist()), 0, 0.0, bool(last.settled[plant]),
        )  # fmt: skip
        one = self._alone.solve(condition, before)
        found.put(np.array([plant]), self.several(one, 1))

    def several(self, one: Solution, n: int) -> Solutions:
        """A state of one plant, as often as this."""

        def side_by_side(part: npt.NDArray[Any]) -> Any:
            return np.repeat(part[..., None], n, axis=-1)

        return Solutions(
            side_by_side(one.flow), side_by_side(one.head), side_by_side(one.open), side_by_side(one.shut_in),
            side_by_side(np.isin(self.pumps, one.cavitating)), side_by_side(np.array(one.settled)),
        )  # fmt: skip

    def loss(self, flow: Floats, square: Floats, offset: Floats) -> tuple[Floats, Floats]:
        """The heads lost in all links, and their slopes.

        Args:
            flow: ``(n_links, n_plants)``.
            square: likewise, see :class:`Conditions`.
            offset: likewise.
        """
        friction, slope = self._friction.loss(flow)
        other, other_slope = quadratic(flow, square, self._creep)
        return friction + other + offset, slope + other_slope


class _Step:
    """Newton's method on some plants.

    Args:
        solver: of the network.
        given: what each plant stands under.
        linear: ``(n_links, n_plants)`` links whose flow follows from the heads.
        choked: ``(n_pumps, n_plants)`` pumps whose flow follows from the head at which the fluid boils.
        outer: ``(n_links, n_plants)`` difference of given heads along each link.
        pins: ``(n_free, n_plants)`` whether the head of a free node is set.
        pin_heads: ``(n_free, n_plants)`` to what; 0 elsewhere.
        flow: ``(n_links, n_plants)`` as they are now.
        balanced: ``(n_plants,)`` whether what flows in flows out.
    """

    def __init__(
        self, solver: BatchSolver, given: Conditions, linear: Bools, choked: Bools, outer: Floats, pins: Bools,
        pin_heads: Floats, flow: Floats, balanced: Bools,
    ) -> None:  # fmt: skip
        self.solver, self.given, self.linear, self.choked = solver, given, linear, choked
        self.outer, self.pins, self.pin_heads, self.flow, self.balanced = outer, pins, pin_heads, flow, balanced
        self.lost: tuple[Floats, Floats] | None = None

    def of(self, plants: Ints) -> _Step:
        """The same of some plants."""
        other = _Step(
            self.solver, self.given.of(plants), self.linear[:, plants], self.choked[:, plants], self.outer[:, plants],
            self.pins[:, plants], self.pin_heads[:, plants], self.flow[:, plants], self.balanced[plants],
        )  # fmt: skip
        if self.lost is not None:
            other.lost = self.lost[0][:, plants], self.lost[1][:, plants]
        return other

    def go(self) -> tuple[Floats, Floats, Bools]:
        """One step: the heads after it, the greatest change of a flow, and which plants are done."""
        solver, circuit, given, linear = self.solver, self.solver.circuit, self.given, self.linear
        if self.lost is None:
            self.lost = self._loss(self.flow)
        loss, slope = self.lost
        ease = np.where(linear, 1 / slope, 0.0)
        cells = solver.spread @ ease
        cells[: len(solver.free)] += self.pins
        right = solver.incidence @ np.where(linear, self.flow + ease * (self.outer - loss), 0.0)
        right += self.pin_heads
        head = given.head.copy()
        head[solver.free], forced = self._heads(cells, right, ease)
        drop = head[circuit.start] - head[circuit.end]
        change = np.where(linear, ease * (drop - loss), 0.0)
        change[solver.pumps] = np.where(self.choked, forced - self.flow[solver.pumps], change[solver.pumps])
        share = self._share(loss, change, drop)
        self.flow = self.flow + share * change
        self.balanced |= share == 1.0
        size = np.abs(change)
        step = size.max(axis=0, initial=0.0)
        done = (step < STEP) | (size.sum(axis=0) < RELATIVE_STEP * np.abs(self.flow).sum(axis=0))
        return head, step, done | (self.choked.any(axis=0) & (step > WILD))

    def _loss(self, flow: Floats) -> tuple[Floats, Floats]:
        return self.solver.loss(flow, self.given.square, self.given.offset)

    def _heads(self, cells: Floats, right: Floats, ease: Floats) -> tuple[Floats, Floats]:
        """Heads of the free nodes, and flows of choked pumps, whose suctions have the head at which it boils."""
        solver, circuit, pumps = self.solver, self.solver.circuit, self.solver.pumps
        factors = solver.elimination.factors(cells)
        heads = factors.solve(right)
        # Short wide pipes beside narrow ones lose digits; one refinement gets them back.
        every = np.zeros(self.given.head.shape)
        every[solver.free] = heads
        through = ease * (every[circuit.start] - every[circuit.end])
        heads += factors.solve(right + solver.incidence @ through - self.pins * heads)
        forced = np.zeros(self.choked.shape)
        plants = np.flatnonzero(self.choked.any(axis=0))
        if not len(plants):
            return heads, forced
        # What each pump does to the heads when it moves one unit.
        at, to = solver.row[circuit.start[pumps]], solver.row[circuit.end[pumps]]
        part = factors.of(plants)
        effect = np.zeros((len(solver.free), len(pumps), len(plants)))
        for number in np.flatnonzero(self.choked.any(axis=1)).tolist():
            moved = np.zeros((len(solver.free), len(plants)))
            moved[at[number]] -= 1.0
            if to[number] >= 0:
                moved[to[number]] += 1.0
            effect[:, number] = part.solve(moved)
        wanted = self.given.floor[circuit.start[pumps]] - heads[at][:, plants]
        choked = self.choked[:, plants]
        both = choked[:, None] & choked[None]
        # Rows: suctions; columns: pumps. Pumps that aren't choked have rows and columns of zeros, and move nothing.
        matrix = np.where(both, effect[at], 0.0).transpose(2, 0, 1)
        rest = np.where(choked, wanted, 0.0).T[..., None]
        flows = (np.linalg.pinv(matrix, rcond=len(pumps) * _EPSILON) @ rest)[..., 0].T
        heads[:, plants] += np.einsum("fpn,pn->fn", effect, flows)
        forced[:, plants] = flows
        return heads, forced

    def _share(self, before: Floats, change: Floats, drop: Floats) -> Floats:
        """How much of a step each plant goes: as far as the content of its network still falls, or nearly so.

        What is lost at the flows that this leads to is kept for the next step.
        """
        n = change.shape[1]
        loss, slope = self._loss(self.flow + change)
        share = np.ones(n)
        left = np.flatnonzero(self.balanced & ~self.choked.any(axis=0))
        if len(left):
            first = ((before - drop) * change).sum(axis=0)
            here = ((loss - drop) * change).sum(axis=0)
            left = left[(np.abs(here[left]) > 0.5 * np.abs(first[left]) + 1e-15) & (here[left] > 0)]
            self._halve(left, share, first, loss, slope, change, drop)
        self.lost = loss, slope
        return share

    def _halve(
        self, plants: Ints, share: Floats, first: Floats, loss: Floats, slope: Floats, change: Floats, drop: Floats
    ) -> None:
        """Finds the shares of plants for which the whole step goes too far; puts what is lost there in its place."""
        low, high = np.zeros(len(share)), np.ones(len(share))
        share[plants] = 0.5
        left = plants
        for _ in range(_HALVINGS - 1):
            if not len(left):
                return
            part = change[:, left]
            given = self.given.of(left)
            loss[:, left], slope[:, left] = self.solver.loss(
                self.flow[:, left] + share[left] * part, given.square, given.offset
            )
            here = ((loss[:, left] - drop[:, left]) * part).sum(axis=0)
            more = np.abs(here) > 0.5 * np.abs(first[left]) + 1e-15
            left, here = left[more], here[more]
            high[left] = np.where(here > 0, share[left], high[left])
            low[left] = np.where(here > 0, low[left], share[left])
            share[left] = (low[left] + high[left]) / 2
        given = self.given.of(left)
        loss[:, left], slope[:, left] = self.solver.loss(
            self.flow[:, left] + share[left] * change[:, left], given.square, given.offset
        )


class _Round:
    """One round of some plants: flows and heads with everything open or shut as it is, then what contradicts that.

    Args:
        solver: of the network.
        given: what each plant stands under.
        now: what they have come to.
        usable: ``(n_links, n_plants)`` what could be open.
        turning: ``(n_links, n_plants)`` what opens and shuts by itself.
        starved: ``(n_pumps, n_plants)`` pumps that nothing can flow to.
        let_go: ``(n_pumps, n_plants)`` how often a pump was choked and then wasn't.
    """

    def __init__(
        self, solver: BatchSolver, given: Conditions, now: Solutions, usable: Bools, turning: Bools, starved: Bools,
        let_go: Ints,
    ) -> None:  # fmt: skip
        self.solver, self.circuit = solver, solver.circuit
        self.given, self.now, self.usable, self.turning, self.starved = given, now, usable, turning, starved
        self.let_go, self.lost = let_go, np.zeros(let_go.shape[1], bool)
        self.choked = now.cavitating & now.open[solver.pumps] & given.one_way[solver.pumps]
        self.pieces = self._pieces()

    def _linear(self) -> Bools:
        linear = self.now.open.copy()
        linear[self.solver.pumps] &= ~self.choked
        return linear

    def _pieces(self) -> Pieces:
        """What hangs together; pumps stay choked only where both of their sides do with a given head."""
        circuit, pumps = self.circuit, self.solver.pumps
        while True:
            pieces = self.solver.reach.pieces(self._linear(), self.given.one_way)
            floating = (pieces.label[circuit.start[pumps]] >= 0) | (pieces.label[circuit.end[pumps]] >= 0)
            apart = self.choked & floating
            if not apart.any():
                return pieces
            self.let_go = self.let_go + apart
            self.choked = self.choked & ~apart

    def go(self) -> None:
        """Works out flows and heads, and turns what they contradict."""
        given, now = self.given, self.now
        flow, head, step, taken = self._newton()
        shut_ways = self.usable & ~now.open & given.one_way
        head = self.pieces.even_out(
            head, given.head, given.offset, given.floor, shut_ways, self.starved, self.solver.pumps
        )
        turned = self._turned(flow, head)
        more, fewer = self._choking(flow, head)
        wanted = more & (self.let_go < MOST_CHANGES)
        any_turned: Bools = np.logical_or.reduce(turned, axis=0)
        settled: Bools = np.logical_not(any_turned | np.logical_or.reduce(wanted | fewer, axis=0))
        # Those that Newton's method gets nowhere with are left to the solver of single plants.
        self.lost = (step > STEP) & (taken >= MOST_STEPS)
        calm = ~(any_turned | settled)
        self.let_go = self.let_go + (fewer & calm)
        choked = np.where(calm, (self.choked | wanted) & ~fewer, self.choked)
        self.now = Solutions(
            flow, head, now.open ^ turned, (self.pieces.label >= 0) & ~self.pieces.circulating,
            np.where(settled, self.choked | more, choked), settled & ~self.lost,
        )  # fmt: skip

    # Newton's method

    def _newton(self) -> tuple[Floats, Floats, Floats, Ints]:
        """Flows and heads with everything open or shut as it is; the last step of each plant, and how many it took."""
        solver, circuit, given = self.solver, self.circuit, self.given
        flow = np.where(self.now.open, self.now.flow, 0.0)
        fixed = np.where(circuit.fixed[:, None], given.head, 0.0)
        pins = self.pieces.pins[solver.free]
        pin_heads = self.pieces.pin_heads(given.head, given.loop_head)
        step = _Step(
            solver, given, self._linear(), self.choked, fixed[circuit.start] - fixed[circuit.end], pins,
            np.where(pins, pin_heads[solver.free], 0.0), flow, np.zeros(flow.shape[1], bool),
        )  # fmt: skip
        heads, flows, left = given.head.copy(), flow.copy(), np.arange(flow.shape[1])
        sizes, taken = np.zeros(len(left)), np.full(len(left), MOST_STEPS)
        for number in range(1, MOST_STEPS + 1):
            head, size, done = step.go()
            heads[:, left], flows[:, left], sizes[left] = head, step.flow, size
            if done.any():
                kept = np.flatnonzero(~done)
                ended = done & ~(step.choked.any(axis=0) & (size > WILD))
                taken[left[ended]] = number
                left, step = left[kept], step.of(kept)
            if not len(left):
                break
        return flows, heads, sizes, taken

    # What contradicts

    def _turned(self, flow: Floats, head: Floats) -> Bools:
        """Which links that let pass one way only contradict their flow or heads, so that they are to be turned."""
        circuit, opened = self.circuit, self.now.open
        turning = self.turning.copy()
        turning[self.solver.pumps] &= ~self.choked
        with np.errstate(invalid="ignore"):
            pressing = head[circuit.start] - head[circuit.end] - self.given.offset
            closing, opening = turning & opened & (flow < -BACKFLOW), turning & ~opened & (pressing > LIFT)
        # A pump presses against the check valve behind it: that shuts first, and then nothing flows back.
        closing[self.solver.pumps] &= ~np.delete(closing, self.solver.pumps, axis=0).any(axis=0)
        turned: Bools = closing | opening
        return turned

    def _choking(self, flow: Floats, head: Floats) -> tuple[Bools, Bools]:
        """The pumps that draw more than reaches them, and the choked ones that no longer do."""
        circuit, given, pumps = self.circuit, self.given, self.solver.pumps
        a, b, through = circuit.start[pumps], circuit.end[pumps], flow[pumps]
        loss = self.solver.loss(flow, given.square, given.offset)[0][pumps]
        with np.errstate(invalid="ignore"):
            fewer = self.choked & ((head[a] - head[b] - loss < -LIFT) | (through < -BACKFLOW))
            thirsty = (through > BACKFLOW) & (head[a] < given.floor[a] - LIFT)
        return ~self.choked & self.now.open[pumps] & given.one_way[pumps] & thirsty, fewer
