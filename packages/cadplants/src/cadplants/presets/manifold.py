"""The preset ``manifold``: well-heads side by side on two headers, with up to thirty valves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cadplants.families.preset_devices import Post
from cadplants.lines.choice import Choice
from cadplants.lines.instrument import tee_at
from cadplants.lines.route import Route
from cadplants.lines.run import Run
from cadplants.model.plant import Plant
from cadplants.model.standards import PIPES, TEE_CENTER_TO_END
from cadplants.parts.brand import Brand, draw_brand, dressed
from cadplants.parts.fastener import SUPPORT_REACH
from cadplants.presets.site import Placed, Site, Work
from cadplants.solids.transforms import at
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["make_manifold"]

_USUAL = {"fasteners": "set", "valve": "few", "gauge": "few"}


@dataclass(frozen=True)
class _Plan:
    """The proportions of one manifold [m].

    Args:
        wells: how many stand along x.
        pitch: from well to well.
        flow: nominal size of the lines of the wells.
        production: of the header that takes what is produced.
        test: of the header to the test separator.
        wing: height of the lines from the wells to the headers.
        below: how far the test header lies below.
    """

    wells: int = 4
    pitch: float = 0.75
    flow: int = 50
    production: int = 100
    test: int = 80
    wing: float = 1.55
    below: float = 0.85

    @property
    def xs(self) -> list[float]:
        """Where the wells stand."""
        return [k * self.pitch for k in range(self.wells)]

    @property
    def split(self) -> float:
        """Where the lines to both headers part, along y."""
        return 1.95

    @property
    def production_y(self) -> float:
        """Where the production header lies."""
        return self.split + 1.05

    @property
    def test_y(self) -> float:
        """Where the test header lies."""
        return self.split + 0.85


def _draw(rng: np.random.Generator) -> _Plan:
    """Proportions at random: two to four wells."""
    large = bool(rng.random() < 0.4)
    return _Plan(
        wells=int(rng.integers(2, 5)),
        pitch=float(rng.uniform(0.70, 0.95)),
        flow=50 if large else 40,
        production=125 if large else 100,
        test=80 if large else 65,
        wing=float(rng.uniform(1.50, 1.70)),
        below=float(rng.uniform(0.85, 0.95)),
    )


_Work = Work[_Plan]


def make_manifold(seed: int = 0, style: ModelingStyle | None = None) -> Plant:
    """Builds well-heads with seven valves each, whose lines go to a production and to a test header; stands on z = 0.

    Args:
        seed: chooses how many wells, proportions, sizes, paint, looks of the devices.
        style: how it is modelled; plant-design CAD by default.
    """
    rng = np.random.default_rng([seed, 16])
    style = dressed(style, rng, seed, _USUAL)
    choice = Choice(draw_brand(rng) if seed else Brand(), "few")
    work = _Work(Site("manifold"), style, choice, _draw(rng) if seed else _Plan(), rng)
    plan = work.plan
    production = _header(work, "A", plan.production, plan.production_y, plan.wing)
    test = _header(work, "B", plan.test, plan.test_y, plan.wing - plan.below)
    for k in range(plan.wells):
        tree = _tree(work, k)
        wing = _wing(work, k, tree, production)
        _to_test(work, k, wing, test)
    return work.site.plant("manifold", seed, style)


def _header(work: _Work, tag: str, dn: int, y: float, z: float) -> Placed:
    """A header along x with a tee towards each well, a lid at one end, a gate valve and a flange at the other."""
    plan = work.plan
    low, high = -0.55, plan.xs[-1] + 1.25
    route = Route(np.array([(low, y, z), (high, y, z)]))
    # The lines of the wells come from -y, which is to the right of a run along +x.
    tees = [tee_at(x - low, f"J-{tag}{k + 1}", dn, plan.flow, np.pi / 2) for k, x in enumerate(plan.xs)]
    tap = work.choice.gauge(plan.xs[-1] + 0.35 - low, f"G-{tag}", 100, work.needle())
    valve = work.choice.valve(plan.xs[-1] + 0.85 - low, "gate", f"V-{tag}", dn)
    run = Run(tag, dn, route, (*tees, valve), (tap,), ends=("blind", "flange"))
    placed = work.site.lay(run, work.style)
    for x in (-0.28, *((a + b) / 2 for a, b in zip(plan.xs[:-1:2], plan.xs[1::2], strict=False)), plan.xs[-1] + 0.50):
        height = z - PIPES[dn].radius - SUPPORT_REACH
        upright = Post(height=height, side=0.06, capped=True).as_assembly(work.style)
        stand = work.site.add(upright.placed(at(x, y, 0)))
        work.site.support(placed, x - low, stand + 2, work.style)
    return placed


def _tree(work: _Work, k: int) -> Placed:
    """The well-head: up through a master valve, past the wing's tee, through a swab valve to a lid."""
    x, dn = work.plan.xs[k], work.plan.flow
    low, wing = 0.14, work.plan.wing
    route = Route(np.array([(x, 0.0, low), (x, 0.0, wing + 0.80)]))
    inline = (
        work.choice.valve(0.52, "gate", f"V-{k + 1}1", dn, np.pi / 2),
        tee_at(wing - low, f"J-W{k + 1}", dn, dn, -np.pi / 2),
        work.choice.valve(wing - low + 0.42, "gate", f"V-{k + 1}2", dn, np.pi / 2),
    )
    tap = work.choice.side_gauge(wing - low - 0.34, f"G-{k + 1}1", 63, work.needle(), roll=np.pi / 2)
    ends, reason = ("flange", "blind"), "comes from a well"
    run = Run(f"W{k + 1}", dn, route, inline, (tap,), ends=ends, flow="forward", reason=reason)
    return work.site.lay(run, work.style)


def _wing(work: _Work, k: int, tree: Placed, header: Placed) -> Placed:
    """From the well-head through wing valve, choke and check valve, past the tee to the test header, to production."""
    plan, x, dn, z = work.plan, work.plan.xs[k], work.plan.flow, work.plan.wing
    before, after = TEE_CENTER_TO_END[dn], TEE_CENTER_TO_END[plan.production]
    route = Route(np.array([(x, before, z), (x, plan.production_y - after, z)]))

    def there(y: float) -> float:
        return y - before

    inline = (
        work.choice.valve(there(0.42), "gate", f"V-{k + 1}3", dn),
        work.choice.valve(there(0.90), "globe", f"V-{k + 1}4", dn),
        work.choice.valve(there(1.50), "check", f"V-{k + 1}5", dn),
        tee_at(there(plan.split), f"J-T{k + 1}", dn, dn, np.pi),
        work.choice.valve(there(plan.split + 0.45), "ball", f"V-{k + 1}6", dn),
    )
    tap = work.choice.gauge(there(1.20), f"G-{k + 1}2", 63, work.needle(), np.pi / 2)
    run = Run(
        f"F{k + 1}",
        dn,
        route,
        inline,
        (tap,),
        ends=("open", "open"),
        nodes=(f"J-W{k + 1}", f"J-A{k + 1}"),
        arms=(before, after),
    )
    return work.site.lay(run, work.style, [tree.device(f"J-W{k + 1}")], [header.device(f"J-A{k + 1}")])


def _to_test(work: _Work, k: int, wing: Placed, header: Placed) -> None:
    """From the tee behind the check valve down and through a ball valve to the test header."""
    plan, x, dn = work.plan, work.plan.xs[k], work.plan.flow
    before, after = TEE_CENTER_TO_END[dn], TEE_CENTER_TO_END[plan.test]
    z, low = plan.wing - before, plan.wing - plan.below
    route = Route(np.array([(x, plan.split, z), (x, plan.split, low), (x, plan.test_y - after, low)]))
    run = Run(
        f"T{k + 1}",
        dn,
        route,
        (work.choice.valve(0.35, "ball", f"V-{k + 1}7", dn, np.pi / 2),),
        ends=("open", "open"),
        nodes=(f"J-T{k + 1}", f"J-B{k + 1}"),
        arms=(before, after),
    )
    work.site.lay(run, work.style, [wing.device(f"J-T{k + 1}")], [header.device(f"J-B{k + 1}")])
