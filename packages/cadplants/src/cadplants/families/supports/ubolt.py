"""Lines held by U-bolts, V-bolts and hook bolts on angles, channels, plates, posts and under beams."""

from __future__ import annotations

from typing import Any

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import own_stream
from cadplants.builder.params import among, between, chance, nested, whole
from cadplants.builder.table import Table
from cadplants.families.supports.shape import (
    Below,
    Feet,
    Footing,
    Overhead,
    Standing,
    add_nuts,
    arc_yz,
    bow,
    few,
    foot_of,
    hung,
    radius,
    slab_yz,
    standing,
    strap,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import extrude, moved
from cadplants.solids.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, along, bar, box, ring, rope
from cadplants.solids.transforms import at, spun

__all__ = ["U_BOLTS"]

_BACK_UP, _BACK_DOWN = np.array([[0.0, -1.0], [1.0, 0.0]]), np.array([[0.0, 1.0], [-1.0, 0.0]])
_BARS = (0.006, 0.008, 0.010, 0.012, 0.016, 0.020, 0.024)  # m, M6 to M24 (DIN 3570)
_STEP = "sizes of the bar over the usual one for the line"


def _bar(p: Any) -> float:
    """Diameter of the bar of a U-bolt [m]."""
    return _BARS[int(np.clip(int(np.clip(round(radius(p) / 0.03), 0, 5)) + p.step, 0, 6))]


class _Held(Standing, bundle="u-bolt", label="u-bolt"):
    """A line held by a bent bar."""


class _UBolt(_Held):
    """A line held by a bent bar of some size."""

    step: int = whole(-1, 1, _STEP)


class _Post(Feet):
    """A post under an angle."""

    size: float = among((0.05, 0.06, 0.08), "width of the post", "m")
    foot: Footing = foot_of()


class OnAngle(_UBolt, name="u-bolt/angle"):
    """A round U-bolt (DIN 3570) through the level leg of an angle (EN 10056), with lock nuts above and below."""

    thick: float = among((0.005, 0.006, 0.008), "of the angle", "m")
    spare: float = between(0.025, 0.045, "width of the angle - 2.5 bars", "m")
    reach: float = between(0.04, 0.25, "from the U-bolt to a post", "m")
    hanging: bool = chance(0.5, "its other leg hangs on the left, not on the right")
    thread: float = between(2.0, 4.0, "thread under the angle / bar")
    twice: bool = chance(0.4, "lock nuts")
    washers: bool = chance(0.6, "washers")
    upper: bool = chance(0.3, "nuts above the angle too")
    taken: str = among(("beam", "beam", "brace"), "what the angle is taken for")
    post: _Post = nested(
        _Post, "each post", fixed=lambda p: {"holes": p.holes, "structure": p.structure}, stream=own_stream
    )
    both: bool = chance(0.6, "a post at either end")

    def build(self, t: Table) -> Model:
        d, top = _bar(self), -t.pipe.radius
        leg, side, size, foot = d / 2 - top, 2.5 * d + self.spare, self.post.size, self.post.foot
        reach, under = leg + self.reach + size, top - self.thick
        # The level leg lies under the line, the other one hangs down at its edge.
        angle = (section_angle(side, self.thick) @ np.diag([1.0, -1.0]))[::-1] - (0.55 * side, 0)
        t.add("u-bolt", bow(leg, under - d * self.thread, d / 2, t.style))
        add_nuts(t, [(0, s * leg, under) for s in BOTH], d, self.washers, self.twice)
        if self.upper:
            add_nuts(t.spun("x", np.pi), [(0, s * leg, -top) for s in BOTH], d, False)
        t.add(self.taken, bar((0, -reach, top), (0, reach, top), angle if self.hanging else (angle * (-1, 1))[::-1]))
        edge = (0.55 * side - size / 2) * (1 if self.hanging else -1)
        for s in BOTH if self.both else (1,):
            at_end = t.at(edge, s * (reach - size / 2))
            at_end.add("post", extrude(rounded_rectangle(size, size, 0.004, 1), foot.top - self.height, top - side))
            foot.build(at_end.at(0, 0, -self.height), size + 0.08, size)
        return t.model()


class OnChannel(_UBolt, name="u-bolt/channel"):
    """A U-bolt with four nuts over the back of a channel or through a strut, the line clear of it or on it."""

    play: float = among((0.0, 0.0015), "between the line and the U-bolt", "m")
    deep: float = among((0.041, 0.06, 0.08, 0.1), "height of the channel", "m")
    reach: float = between(0.05, 0.3, "how far the channel reaches past the U-bolt", "m")
    twice: bool = chance(0.5, "lock nuts")
    upper: bool = chance(0.6, "nuts above the channel too")
    below: Below = standing(lambda p: radius(p) + p.deep)

    def build(self, t: Table) -> Model:
        d, top, web = _bar(self), -t.pipe.radius, 0.006
        leg = d / 2 - top + self.play
        reach = leg + self.reach
        t.add("u-bolt", bow(leg, top - web - 3.2 * d, d / 2, t.style))
        add_nuts(t, [(0, s * leg, top - web) for s in BOTH], d, True, self.twice)
        if self.upper:
            add_nuts(t.spun("x", np.pi), [(0, s * leg, -top) for s in BOTH], d, False)
        channel = section_channel(max(0.041, 3 * d), self.deep, web, 0.006) @ _BACK_UP
        t.add("beam", bar((0, -reach, top), (0, reach, top), channel))
        self.below.build(t, top - self.deep, reach - 0.03)
        return t.model()


class Upright(_UBolt, name="u-bolt/upright"):
    """A U-bolt lying on its side that ties the line to a post, a column flange or a plate that stands beside it."""

    thick: float = among((0.006, 0.008, 0.01), "of the plate or flange", "m")
    tall: float = between(0.01, 0.08, "height of the plate - of the U-bolt and 4 bars", "m")
    wide: float = between(0, 0.08, "width of the plate - 50 mm", "m")
    washers: bool = chance(0.7, "washers")
    backing: str = among(("column", "post", "wall"), "what stands beside the line")
    corner: float = among((0.0, 0.01), "radius of the plate's corners", "m", when=lambda p: p.backing != "column")
    over: float = between(0.02, 0.6, "how far that rises over the plate", "m")

    def build(self, t: Table) -> Model:
        r, d, thick, wide = t.pipe.radius, _bar(self), self.thick, 0.05 + self.wide
        leg, floor = r + d / 2, -self.height
        tall = 2 * leg + 4 * d + self.tall
        high = tall / 2 + self.over
        side = t.spun("x", np.pi / 2)  # what hung down now points to +y
        side.add("u-bolt", bow(leg, -r - thick - 2.5 * d, d / 2, t.style))
        add_nuts(side, [(0, s * leg, -r - thick) for s in BOTH], d, self.washers)
        if self.backing == "column":  # through its flange
            t.at(0, r + 0.07).add("column", extrude(section_i(0.14, wide + 0.08, 0.007, thick), floor, high))
            return t.model()
        holes = tuple(circle(0.55 * d, 8, (0, s * leg)) for s in BOTH) if self.holes else ()
        side.add("plate", extrude(rounded_rectangle(wide, tall, self.corner, 2), -r - thick, -r, holes))
        gap, size = 3.2 * d, 0.1
        y = r + thick + gap
        lugs = [box((0.01 + 0.5 * wide, gap, 0.012), (0, r + thick + gap / 2, s * 0.5 * leg)) for s in BOTH]
        t.add("bracket", *lugs, own=False)
        if self.backing == "post":
            t = t.at(0, y + size / 2)
            t.add("post", extrude(rounded_rectangle(size, size, 0.006, 2), floor + 0.012, high))
            t.add("base plate", box((size + 0.1, size + 0.1, 0.012), (0, 0, floor + 0.006)))
        else:
            t.add("wall", box((0.8, 0.2, high - floor), (0, y + 0.1, (high + floor) / 2)))
        return t.model()


class Square(_Held, name="u-bolt/square"):
    """A square-bend U of round or flat bar as a guide over the line, with nuts or welded on, on a plate."""

    flat: bool = chance(0.4, "of flat bar, welded on")
    step: int = whole(-1, 1, _STEP)
    play: float = among((0.0, 0.003), "beside the line", "m")
    clear: float = among((0.0, 0.003), "over the line", "m")
    thick: float = among((0.006, 0.01), "of the plate or of the channel's web", "m")
    plated: bool = chance(0.5, "on a plate, not on a channel")
    below: Below = standing(lambda p: radius(p) + Square.depth(p))

    @staticmethod
    def depth(p: Any) -> float:
        """From the line's underside to its own [m]."""
        d = _bar(p)
        return p.thick + (0.0 if p.flat else 3.0 * d) if p.plated else 0.06 + 2 * d

    def build(self, t: Table) -> Model:
        r, d, thick, deep = t.pipe.radius, _bar(self), self.thick, self.depth(self)
        leg, crown, top, bend = r + d / 2 + self.play, r + d / 2 + self.clear, -r, min(0.9 * r, d)
        foot = top if self.flat else top - thick - 2.5 * d
        corner = arc_yz(bend, 0, np.pi / 2, 3, leg - bend, crown - bend)
        path = np.vstack([[[0, leg, foot]], corner, (corner * (1, -1, 1))[::-1], [[0, -leg, foot]]])
        if self.flat:
            t.add("u-bolt", strap(path, max(0.02, 2.5 * d), d))
        else:
            t.add("u-bolt", rope(path, d / 2, few(d / 2, t.style)))
            add_nuts(t, [(0, s * leg, top - thick) for s in BOTH], d)
        if self.plated:
            t.add("plate", box((max(0.06, 4 * d), 2 * leg + 5 * d + 0.02, thick), (0, 0, top - thick / 2)))
            gap = deep - thick
            if not self.flat:
                ribs = [box((0.008, 2 * leg - 3 * d, gap), (x, 0, top - thick - gap / 2)) for x in (-0.015, 0.015)]
                t.add("bracket", *ribs)
        else:
            channel = section_channel(deep, deep, thick, 0.006) @ _BACK_UP
            t.add("beam", bar((0, -leg - 0.1, top), (0, leg + 0.1, top), channel))
        self.below.build(t, top - deep, leg + 2 * d if self.plated else leg)
        return t.model()


class Saddled(_UBolt, name="u-bolt/saddle"):
    """An exhaust-type clamp: a U-bolt with a cast V or round saddle bridge that presses the line on a post or mast."""

    vee: bool = chance(0.5, "a V with flat flanks, not a round saddle")
    washers: bool = chance(0.5, "washers")
    below: Below = standing(lambda p: 1.5 * radius(p) + 2.6 * _bar(p) + 0.004)

    def build(self, t: Table) -> Model:
        r, d = t.pipe.radius, _bar(self)
        leg, neck, wide, ends, floor = r + d / 2, 0.5 * r + 2 * d, max(2.2 * d, 0.03), r + 1.7 * d, -r - 0.6 * d - 0.004
        hollow = [[0.75 * r, -0.25 * r], [0.3 * r, -r], [-0.3 * r, -r], [-0.75 * r, -0.25 * r]]
        if not self.vee:
            a = np.linspace(-0.12 * np.pi, -0.88 * np.pi, 9)
            hollow = np.column_stack([r * np.cos(a), r * np.sin(a)]).tolist()
        (brim, z), lower = hollow[0], [[-ends, floor + d], [-ends, floor], [ends, floor], [ends, floor + d]]
        outline = [[brim + 0.4 * d, z], *hollow, [-brim - 0.4 * d, z], *lower]
        t.add("u-bolt", bow(leg, floor - 2.5 * d, d / 2, t.style))
        t.add("clamp", slab_yz(outline, -wide / 2, wide / 2), of="steel")
        add_nuts(t, [(0, s * leg, floor) for s in BOTH], d, self.washers)
        # The bridge is welded on a short plate, or two masts cross.
        t.add("plate", box((0.8 * wide, 2 * (leg - 1.2 * d), neck), (0, 0, floor - neck / 2)))
        self.below.build(t, floor - neck, leg)
        return t.model()


class Lined(_UBolt, name="u-bolt/lined"):
    """A light U-bolt in a plastic sleeve with a plastic pad under the line (low friction, cold or galvanic lines)."""

    coat: float = between(0.0015, 0.004, "thickness of the sleeve", "m")
    pad: float = between(0.004, 0.012, "thickness of the pad", "m")
    sleeve: str = among(("u-bolt", "clamp"), "what the sleeve is taken for")
    twice: bool = chance(0.5, "lock nuts")
    hollow: bool = chance(0.5, "the pad is hollow, not flat")
    reach: float = between(0.06, 0.2, "how far the beam reaches past the U-bolt", "m")
    size: float = among((0.06, 0.08, 0.1), "height of the beam", "m")
    below: Below = standing(lambda p: radius(p) + p.pad + p.size)

    def build(self, t: Table) -> Model:
        r, d, pad, size, thick = t.pipe.radius, _bar(self), self.pad, self.size, 0.008
        leg, top, wide = r + self.coat + d / 2, -r - pad, max(0.04, 3 * d)
        t.add("u-bolt", bow(leg, top - thick - 3 * d, d / 2, t.style))
        t.add(self.sleeve, bow(leg, -0.6 * r, d / 2 + self.coat, t.style), of="rubber")
        add_nuts(t, [(0, s * leg, top - thick) for s in BOTH], d, True, self.twice)
        cushion = box((wide, 2 * (leg - d), pad), (0, 0, top + pad / 2))
        if self.hollow:
            a = np.linspace(1.25 * np.pi, 1.75 * np.pi, 7)
            hollow = np.column_stack([r * np.cos(a), r * np.sin(a)]).tolist()
            half = max(0.75 * r, leg - d)
            rim = [[-half, top], [half, top], [half, hollow[-1][1]], *hollow[::-1], [-half, hollow[0][1]]]
            cushion = slab_yz(rim, -wide / 2, wide / 2)
        t.add("plate", cushion, of="rubber")
        reach, z = leg + self.reach, top - size / 2
        t.add("beam", bar((0, -reach, z), (0, reach, z), section_i(size, max(0.06, 5 * d), 0.005, thick)))
        self.below.build(t, top - size, leg)
        return t.model()


class VBolt(_UBolt, name="u-bolt/v-bolt"):
    """A V-bolt: straight flanks that run together to a round crown, through a plate or the flange of a beam."""

    lean: float = between(0.25, 0.6, "of a flank from the upright", "rad")
    thick: float = among((0.006, 0.01), "of the plate or flange", "m")
    washers: bool = chance(0.7, "washers")
    plated: bool = chance(0.5, "through a plate on a web, not a beam")
    below: Below = standing(lambda p: radius(p) + (p.thick if p.plated else 0.0) + 0.05 + 3 * _bar(p))

    def build(self, t: Table) -> Model:
        r, d, lean, thick = t.pipe.radius, _bar(self), self.lean, self.thick
        crown, top = arc_yz(r + d / 2, lean, np.pi - lean, 6), -r
        slope = np.array([0.0, np.sin(lean), -np.cos(lean)])
        knee = crown[0] + slope * (crown[0][2] - top - 0.4 * d) / np.cos(lean)
        leg, foot = float(knee[1]), top - thick - 2.5 * d
        path = np.vstack([[[0, leg, foot], knee], crown, [knee * (1, -1, 1), [0, -leg, foot]]])
        t.add("u-bolt", rope(path, d / 2, few(d / 2, t.style)))
        add_nuts(t, [(0, s * leg, top - thick) for s in BOTH], d, self.washers)
        wide, size = max(0.05, 4 * d), 0.05 + 3 * d
        z = top - size / 2
        if self.plated:
            t.add("plate", box((wide, 2 * leg + 5 * d, thick), (0, 0, top - thick / 2)))
            t.add("bracket", box((0.008, 2 * leg - 4 * d, size), (0, 0, z - thick)), own=False)
        else:
            t.add("beam", bar((0, -leg - 0.15, z), (0, leg + 0.15, z), section_i(size, wide, 0.006, thick)))
        self.below.build(t, top - size - (thick if self.plated else 0.0), leg)
        return t.model()


class Hooks(_UBolt, name="u-bolt/hook"):
    """Hook bolts: one J that grips the line with one nut, or a pair of them opposite, on an angle or a plate."""

    thick: float = among((0.006, 0.008), "of the angle", "m")
    over: float = between(0.75, 1.1, "how far the hook goes round the line / half a turn")
    pair: bool = chance(0.4, "two hooks opposite")
    twice: bool = chance(0.4, "lock nuts")
    size: float = among((0.05, 0.06, 0.075), "width of the angle - of a bar", "m")
    reach: float = between(0.02, 0.2, "how far the angle reaches past the hook and 3 bars", "m")
    column: bool = chance(0.5, "welded on the front of a column")
    below: Below = standing(lambda p: radius(p) + Hooks.depth(p), when=lambda p: not p.column)

    @staticmethod
    def depth(p: Any) -> float:
        """Height of the angle [m]."""
        return p.size + _bar(p) * (4.0 if p.pair else 1.0)  # type: ignore[no-any-return]

    def build(self, t: Table) -> Model:
        r, d, thick, deep = t.pipe.radius, _bar(self), self.thick, self.depth(self)
        leg, top, shift = r + d / 2, -r, 1.5 * d if self.pair else 0.0
        steps = max(6, few(leg, t.style, 20) // 2)
        path = np.vstack([[[0, leg, top - thick - 2.6 * d]], arc_yz(leg, 0, self.over * np.pi, steps)])
        hook = rope(path, d / 2, few(d / 2, t.style))
        spots = [(shift, leg, top - thick), (-shift, -leg, top - thick)][: 2 if self.pair else 1]
        t.add("u-bolt", moved(hook, at(shift)))
        if self.pair:
            t.add("u-bolt", moved(hook, at(-shift) @ spun("z", np.pi)))
        add_nuts(t, spots, d, True, self.twice)
        reach = leg + 3 * d + self.reach
        angle = (section_angle(deep, thick) @ np.diag([1.0, -1.0]))[::-1] - (0.5 * deep, 0)
        t.add("beam", bar((0, -reach, top), (0, reach, top), angle))
        if self.column:
            t.at(0, reach + 0.06).add("column", extrude(section_i(0.12, 0.12, 0.006, 0.009), -self.height, top + 0.3))
        else:
            self.below.build(t, top - deep, reach - 0.03)
        return t.model()


class Hung(_UBolt, name="u-bolt/hung"):
    """A long U-bolt as a hanger: its bow under the line, its legs up through an angle, a channel or a flange above."""

    play: float = among((0.0, 0.0, 0.004), "between the line and the U-bolt", "m")
    clear: float = among((0.0, 0.0, 0.05, 0.15), "usual distance from the line to the beam over it", "m")
    factor: float = between(0.6, 1.4, "that distance / the usual one", when=lambda p: p.clear > 0)
    twice: bool = chance(0.5, "lock nuts")
    sleeve: bool = chance(0.4, "a sleeve round the line")
    reach: float = between(0.1, 0.35, "how far the beam reaches past the U-bolt", "m")
    section: str = among(("angle", "channel", "beam"), "section of the beam")
    high: bool = chance(0.5, "the beam hangs from another, not on posts")
    over: Overhead = hung(lambda p: radius(p) + _bar(p) / 2 + p.play + p.reach - 0.1, when=lambda p: p.high)

    def build(self, t: Table) -> Model:
        r, d, thick, own = t.pipe.radius, _bar(self), 0.008, t.spun("x", np.pi)
        leg, high = r + d / 2 + self.play, r + self.clear * self.factor
        own.add("u-bolt", bow(leg, -high - thick - 2.5 * d, d / 2, t.style))
        add_nuts(own, [(0, s * leg, -high - thick) for s in BOTH], d, True, self.twice)
        if self.sleeve:
            t.add("clamp", along("x", ring(r, r + 0.0015, -2 * d, 2 * d, t.n(r, 12))))
        reach, size = leg + self.reach, 0.05 + 3 * d
        if self.section == "angle":
            outline = section_angle(size, thick) - (0.5 * size, 0)
        elif self.section == "channel":
            outline = section_channel(max(0.05, 4 * d), size, thick, 0.006) @ _BACK_DOWN
        else:
            outline = section_i(1.6 * size, max(0.06, 5 * d), 0.006, thick) + np.array([0.0, 0.8 * size])
        t.add("beam", bar((0, -reach, high), (0, reach, high), outline))
        if self.high:
            self.over.build(t, high + float(outline[:, 1].max()))
        else:
            post = extrude(rounded_rectangle(0.06, 0.06, 0.005, 2), -self.height, high)
            for s in BOTH:
                t.at(0, s * (reach - 0.03)).add("post", post)
        return t.model()


U_BOLTS = families_of(OnAngle, OnChannel, Upright, Square, Saddled, Lined, VBolt, Hooks, Hung)
