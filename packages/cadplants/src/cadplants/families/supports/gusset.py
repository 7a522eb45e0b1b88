"""Steel joints with gusset plates: truss node, bracing corner, haunch, stiffeners, splice, stiffened foot."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, one_of
from cadplants.builder.params import Params, among, between, chance, given, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.supports.shape import (
    Fitting,
    Section,
    add_bolt,
    section_of,
    slab_yz,
    upright,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import extrude, merge
from cadplants.solids.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, CORNERS, bar, box, cylinder, hexagon, ring
from cadplants.solids.transforms import spun

__all__ = ["GUSSETS"]

_G = "gusset plate"
_HEADS = ("hex", "hex", "flange", "stud")
_ASIDE, _QUARTER = np.array([[0.0, 1.0], [-1.0, 0.0]]), spun("x", np.pi / 2)


def _hull(points: Floats) -> Floats:
    """The convex outline round some points, counter-clockwise."""
    order = sorted(map(tuple, np.round(points, 9).tolist()))

    def chain(row: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
        kept: list[tuple[float, ...]] = []
        for p in row:
            while len(kept) > 1:
                (ax, ay), (bx, by) = kept[-2], kept[-1]
                if (bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 1e-9:
                    break
                kept.pop()
            kept.append(p)
        return kept[:-1]

    return np.array(chain(order) + chain(order[::-1]))


def _round_cut(w: float, h: float, steps: Floats) -> list[tuple[float, float]]:
    """Points on the hollow edge of a plate that is this wide and high; angles from its upper end [m, rad]."""
    return [(w * (1 - np.sin(q)), h * (1 - np.cos(q))) for q in steps]


class _Joint(Fitting, label=_G):
    """A steel joint."""


class _Member(Params):
    """A member of a truss between its node and its other end."""

    bolted: bool = given(True, "bolted to the node")
    long: float = between(0.4, 0.55, "length that is there", "m")
    heads: tuple[str, ...] = several(one_of(*_HEADS), 2, "heads of its bolts", when=lambda p: p.bolted)


_FANS = ((0.25, 0.75), (0.25, 0.5, 0.75), (0.5, 0.8))


class TrussNode(_Joint, name="gusset plate/truss node"):
    """A truss node: a plate of many corners between double angles or on a tube, chord and two to four web members."""

    thick: float = among((0.008, 0.01, 0.012), "of the plate", "m")
    leg: float = among((0.05, 0.06, 0.08), "height of a member", "m")
    high: float = between(0.5, 1.2, "height of the node, of an upper chord 600 mm less", "m")
    span: float = between(0.7, 1.3, "half the length of the chord", "m")
    down: bool = chance(0.5, "the members go down from an upper chord")
    section: str = among(("double angle", "angle", "tube"), "section of the members")
    fan: tuple[float, ...] = among(_FANS, "angles of the members / half a turn")
    size: float = among((0.012, 0.016), "diameter of the bolts", "m")
    members: tuple[_Member, ...] = several(
        made(_Member, lambda p: {"bolted": p.section != "tube"}), lambda p: len(p.fan), "members"
    )

    def build(self, t: Table) -> Model:
        thick, leg, span, d, sign = self.thick, self.leg, self.span, self.size, -1.0 if self.down else 1.0
        level, corners, ways = self.high + (0.6 if self.down else 0.0), [], []
        corners += [[s * 0.175 * span, z] for z in (0.0, -sign * 0.4 * leg) for s in BOTH]
        for a in np.array(self.fan) * np.pi:
            way = np.array([np.cos(a), 0.0, sign * np.sin(a)])
            start = np.array([0, 0, level]) + way * (0.8 * leg + 0.05 + (0.05 if abs(np.cos(a)) > 0.1 else 0.0))
            ways.append((start, way))
            tip, side = start + way * (0.12 + 2 * d), 0.65 * leg * np.array([-way[2], 0, way[0]])
            corners += [[(tip + s * side)[0], (tip + s * side)[2] - level] for s in BOTH]
        t.add(_G, upright(_hull(np.array(corners)) + np.array([0.0, level]), -thick / 2, thick / 2))
        self._bars(t, np.array([-span, 0, level]), np.array([span, 0, level]), "beam")
        outer = thick / 2 + 0.1 * leg
        low = -outer if self.section == "double angle" else -thick / 2
        for (start, way), member in zip(ways, self.members, strict=True):
            self._bars(t, start, start + way * member.long, "brace")
            for q, head in zip((0.3, 0.8), member.heads, strict=False):
                x, _, z = start + way * (0.12 + 2 * d) * q
                add_bolt(t.at(x, outer, z).moved(_QUARTER), d, outer - low, head)
        tall = level - 0.5 * leg
        for s in BOTH:
            t.add("post", box((0.08, 0.08, tall), (s * 0.8 * span, 0, tall / 2)))
        return t.model()

    def _bars(self, t: Table, a: Floats, b: Floats, name: str) -> None:
        """A member: one bar, or two with the plate between them."""
        leg = self.leg
        if self.section == "tube":
            t.add(name, bar(a, b, circle(0.5 * leg, t.n(0.5 * leg))))
            return
        for s in BOTH if self.section == "double angle" else (1,):
            shape = section_angle(leg, 0.1 * leg) * (s, 1) - np.array([-s * self.thick / 2, 0.5 * leg])
            t.add(name, bar(a, b, shape if s > 0 else shape[::-1]))


class BracingCorner(_Joint, name="gusset plate/bracing corner"):
    """The corner of a braced bay: column, beam, a gusset in between, a brace bolted on."""

    size: float = among((0.1, 0.14, 0.2), "height of the column's section and of the beam", "m")
    tall: float = between(1.2, 2.4, "height of the column", "m")
    reach: float = between(1.0, 1.8, "length of the beam", "m")
    thick: float = among((0.008, 0.012, 0.016), "of the gusset", "m")
    section: Section = section_of("section of the beam", flat=True)
    top: bool = chance(0.6, "the beam is at the top, not at the foot")
    wide: float = between(0.18, 0.34, "width of the gusset", "m")
    high: float = between(0.18, 0.34, "height of the gusset", "m")
    cut: int = whole(0, 3, "the gusset has a straight edge between flats, a hollow edge, a cut corner, three corners")
    thin: float = among((0.05, 0.06, 0.08), "height of the brace", "m")
    brace: str = among(("angle", "channel", "flat"), "section of the brace")
    bolt: float = among((0.012, 0.016, 0.02), "diameter of the bolts", "m")
    bolts: int = whole(2, 3, "bolts")
    heads: tuple[str, ...] = several(one_of(*_HEADS), lambda p: p.bolts, "heads of the bolts")

    def build(self, t: Table) -> Model:
        size, tall, reach, thick, w, h = self.size, self.tall, self.reach, self.thick, self.wide, self.high
        z = tall - size / 2 if self.top else 0.02 + size / 2
        up = 1.0 if z < 0.5 * tall else -1.0
        x0, z0, clip = size / 2, z + up * size / 2, 0.3 * min(w, h)
        t.add("column", extrude(section_i(size, size, 0.06 * size, 0.08 * size) @ _ASIDE, 0.02, tall))
        t.add("base plate", box((size + 0.12, size + 0.12, 0.02), (0, 0, 0.01)))
        t.add("beam", bar((x0, 0, z), (reach, 0, z), *self.section.outline(size, t.style)))
        shape = (
            outline(0, 0, w, 0, w, clip, clip, h, 0, h),
            [(0, 0), (w, 0), *_round_cut(w, h, np.linspace(0, np.pi / 2, 8)[1:-1]), (0, h)],
            outline(0.03, 0, w, 0, w, 0.4 * h, 0.4 * w, h, 0, h, 0, 0.03),
            outline(0, 0, w, 0, 0, h),
        )[self.cut]
        t.add(_G, upright([(x0 + x, z0 + up * y) for x, y in shape], -thick / 2, thick / 2))
        mid = np.array([x0 + 0.3 * w, 0, z0 + up * 0.3 * h])
        end = np.array([reach - 0.1, 0, z0 + up * (reach - 0.1 - x0) * h / w])
        limit = (tall - 0.05 if up > 0 else 0.05) - mid[2]
        end = mid + min(1.0, abs(limit) / abs(end[2] - mid[2])) * (end - mid)
        flat, d = self.brace == "flat", self.bolt
        section = {
            "angle": section_angle(self.thin, 0.006) - np.array([0.0, 0.5 * self.thin]),
            "channel": section_channel(self.thin, 0.5 * self.thin, 0.006, 0.006),
            "flat": rounded_rectangle(0.01, self.thin, 0),
        }[self.brace]
        t.at(0, -thick / 2 - 0.005 if flat else thick / 2).add("brace", bar(mid, end, section))
        way, grip = (end - mid) / np.linalg.norm(end - mid), thick + (0.01 if flat else 0.006)
        low = -thick / 2 - (0.01 if flat else 0.0)
        for k, head in enumerate(self.heads):
            x, _, at_z = mid + way * (0.02 + 3 * k * d)
            add_bolt(t.at(x, low + grip, at_z).moved(_QUARTER), d, grip, head)
        return t.model()


class Haunch(_Joint, name="gusset plate/haunch"):
    """A moment joint: beam with a haunch, an end plate bolted to a column, web stiffeners in line with the flanges."""

    high: float = among((0.16, 0.2, 0.25), "height of the beam", "m")
    wide: float = among((0.5, 1.0), "width of the beam / height")
    tall: float = between(1.2, 2.2, "height of the column", "m")
    reach: float = between(0.8, 1.6, "length of the beam", "m")
    thick: float = among((0.012, 0.016, 0.02), "of the end plate", "m")
    bolt: float = among((0.016, 0.02), "diameter of the bolts", "m")
    haunched: bool = chance(0.7, "a haunch")
    deep: float = between(0.5, 1.0, "height of the haunch / of the beam", when=lambda p: p.haunched)
    long: float = between(1.0, 2.0, "length of the haunch / height of the beam", when=lambda p: p.haunched)
    curved: bool = chance(0.3, "the haunch is a plate with a hollow edge", when=lambda p: p.haunched)
    lines: int = whole(3, 5, "rows of bolts")
    heads: tuple[str, ...] = several(one_of("hex", "flange"), lambda p: 2 * p.lines, "heads of the bolts")
    clipped: bool = chance(0.6, "the stiffeners' corners are cut")

    def build(self, t: Table) -> Model:
        h, thick, d = self.high, self.thick, self.bolt
        b, web, f, z = self.wide * h, 0.04 * h, 0.06 * h, self.tall - h / 2 - 0.05
        wide, x0, under, deep, long = max(b, 0.14), h / 2 + thick, z - h / 2, self.deep * h, self.long * h
        t.add("column", extrude(section_i(h, wide, web, f) @ _ASIDE, 0.02, self.tall))
        t.add("beam", bar((x0, 0, z), (x0 + self.reach, 0, z), section_i(h, b, web, f)))
        t.add("base plate", box((h + 0.15, wide + 0.15, 0.02), (0, 0, 0.01)))
        if self.haunched:
            cut = _round_cut(long, deep, np.linspace(0, np.pi / 2, 7)[1:-1]) if self.curved else []
            side = [(0, 0), (long, 0), *cut, (0, deep)]
            t.add(_G, upright([(x0 + x, under - y) for x, y in side], -web, web))
            if not self.curved:
                ends = (x0, 0, under - deep - f / 2), (x0 + long, 0, under - f / 2)
                t.add("plate", bar(*ends, rounded_rectangle(b, f, 0)))
        low, top = under - deep - 0.02, z + h / 2 + 0.02
        t.add("plate", box((thick, wide, top - low), (h / 2 + thick / 2, 0, (top + low) / 2)))
        spots = [(s * 0.3 * wide, float(q)) for q in np.linspace(low + 0.05, top - 0.045, self.lines) for s in BOTH]
        for (y, q), head in zip(spots, self.heads, strict=True):
            add_bolt(t.at(h / 2 - f, y, q).spun("y", np.pi / 2), d, thick + f, head)
        half, w = (wide - web) / 2, (h - 2 * f) / 2
        clip = 0.15 * half
        plan = outline(-w, 0, w, 0, w, half, -w, half)
        if self.clipped:
            plan = outline(-w + clip, 0, w - clip, 0, w, clip, w, half, -w, half, -w, clip)
        stiffener = extrude(np.array(plan), -0.004, 0.004)
        for level in {round(z + h / 2 - f, 4), round(under, 4)}:
            for s in BOTH:
                t.at(0, s * web / 2, level).spun("x", 0.0 if s > 0 else np.pi).add(_G, stiffener)
        return t.model()


class Stiffener(_Joint, name="gusset plate/stiffener"):
    """A beam on two posts with web stiffeners: full, partial, clipped, triangular, over the posts and along it."""

    high: float = among((0.16, 0.2, 0.3), "height of the beam", "m")
    wide: float = between(0.5, 0.9, "width of the beam / height")
    span: float = between(1.2, 2.6, "length of the beam", "m")
    top: float = between(0.6, 1.8, "height of the beam's upper side over the floor", "m")
    cut: int = whole(0, 3, "stiffeners are full, clipped, triangular, cut short")
    thick: float = among((0.006, 0.008, 0.012), "of a stiffener", "m")
    count: int = whole(2, 5, "places of stiffeners")
    footed: bool = chance(0.4, "ribs on the posts' feet")

    def build(self, t: Table) -> Model:
        h, span, top, thick = self.high, self.span, self.top, self.thick
        b, web, f, low = self.wide * h, 0.04 * h, 0.06 * h, top - h
        t.add("beam", bar((-span / 2, 0, top - h / 2), (span / 2, 0, top - h / 2), section_i(h, b, web, f)))
        half, deep = (b - web) / 2, h - 2 * f
        clip, w = 0.2 * half, 0.9 * half
        shape = (
            outline(0, 0, half, 0, half, deep, 0, deep),
            outline(clip, 0, half, 0, half, deep, clip, deep, 0, deep - clip, 0, clip),
            outline(0, 0, w, 0, 0, 0.6 * deep),
            outline(0, 0, w, 0, w, 0.15 * deep, 0.3 * half, 0.75 * deep, 0, 0.75 * deep),
        )[self.cut]
        for x in np.linspace(-0.42 * span, 0.42 * span, self.count):
            for s in BOTH:
                side = [(s * (web / 2 + y), low + f + z) for y, z in shape]
                t.add(_G, slab_yz(side, float(x) - thick / 2, float(x) + thick / 2))
        size = min(0.1, b)
        for s in BOTH:
            post = t.at(s * 0.42 * span)
            post.add("plate", box((size + 0.06, size + 0.04, 0.012), (0, 0, low - 0.006)))
            post.add("post", extrude(rounded_rectangle(size, size, 0.005, 2), 0.015, low - 0.012))
            post.add("base plate", box((size + 0.12, size + 0.12, 0.015), (0, 0, 0.0075)))
            for q in BOTH:
                add_bolt(post.at(q * (size / 2 + 0.012), q * 0.3 * b, low - 0.012), 0.012, f + 0.012)
        for s, q in CORNERS if self.footed else ():
            rib = [(s * 0.42 * span + q * (size / 2 + x), 0.015 + z) for x, z in ((0, 0), (0.05, 0), (0.0, 0.1))]
            t.add(_G, upright(rib, -0.004, 0.004))
        return t.model()


class Splice(_Joint, name="gusset plate/splice"):
    """A beam or column splice: cover plates on flanges and web with rows of bolts, or end plates face to face."""

    high: float = among((0.16, 0.2, 0.25), "height of the beam", "m")
    wide: float = between(0.6, 1.0, "width of the beam / height")
    half: float = between(0.5, 1.2, "length of the beam on either side", "m")
    level: float = between(0.5, 1.5, "height of the beam's middle", "m")
    covered: bool = chance(0.75, "cover plates, not end plates")
    thick: float = among((0.006, 0.01), "of the cover plates", "m", when=lambda p: p.covered)
    bolt: float = among((0.012, 0.016), "diameter of the bolts", "m")
    gussets: bool = chance(0.5, "the covers are taken for gusset plates", when=lambda p: p.covered)
    lines: int = whole(2, 3, "rows of bolts on either side", when=lambda p: p.covered)
    heads: tuple[str, ...] = several(
        one_of("hex", "flange"), lambda p: 8 * p.lines, "heads of the bolts in the flanges", when=lambda p: p.covered
    )
    posts: tuple[str, ...] = several(one_of("post", "column"), 2, "what the posts are taken for")

    def build(self, t: Table) -> Model:
        h, half, level = self.high, self.half, self.level
        b, web, f, gap = self.wide * h, 0.04 * h, 0.06 * h, 0.002 if self.covered else 0.016
        section = section_i(h, b, web, f)
        if self.covered:
            for s in BOTH:
                t.add("beam", bar((s * (half + 0.003), 0, level), (s * gap, 0, level), section))
            self._covers(t, b, web, f)
        else:
            t.add("beam", bar((-half, 0, level), (-gap, 0, level), section))
            t.add("beam", bar((gap, 0, level), (half, 0, level), section))
            self._ends(t, b, gap)
        tall = level - h / 2
        for s, name in zip(BOTH, self.posts, strict=True):
            t.add(name, box((0.1, min(b, 0.1), tall), (s * (half - 0.1), 0, tall / 2)))
        return t.model()

    def _covers(self, t: Table, b: float, web: float, f: float) -> None:
        h, level, thick, d, rows = self.high, self.level, self.thick, self.bolt, self.lines
        pitch, heads, name = 3.5 * d, iter(self.heads), _G if self.gussets else "plate"
        long, tall = 2 * (rows * pitch + d), 0.7 * (h - 2 * f)
        xs = [s * (0.7 * pitch + k * pitch) for s in BOTH for k in range(rows)]
        for s in BOTH:
            t.add(name, box((long, b, thick), (0, 0, level + s * (h / 2 + thick / 2))))
            for x in xs:
                for y in (-0.32 * b, 0.32 * b):
                    spot = t.at(x, y, level + s * (h / 2 - f)).spun("x", 0.0 if s > 0 else np.pi)
                    add_bolt(spot, d, f + thick, next(heads))
        for s in BOTH:
            t.add(name, box((long * 0.8, thick, tall), (0, s * (web + thick) / 2, level)))
        for x in xs[:: max(1, rows - 1)]:
            for z in (-0.3 * tall, 0.3 * tall):
                add_bolt(t.at(x, web / 2 + thick, level + z).moved(_QUARTER), d, web + 2 * thick)

    def _ends(self, t: Table, b: float, thick: float) -> None:
        h, level = self.high, self.level
        for s in BOTH:
            t.add("plate", box((thick, b + 0.02, h + 0.1), (s * thick / 2, 0, level)))
        for y in (-0.32 * b, 0.32 * b):
            for z in (-h / 2 - 0.03, -h / 4, h / 4, h / 2 + 0.03):
                add_bolt(t.at(-thick, y, level + z).spun("y", np.pi / 2), self.bolt, 2 * thick)
        for s, x in CORNERS:
            z = level + s * h / 2
            rib = outline(x * thick, z, x * (thick + 0.09), z, x * thick, z + s * 0.045)
            t.add(_G, upright(rib, -0.004, 0.004))


class Foot(_Joint, name="gusset plate/foot"):
    """A column foot: thick base plate on grout and a pedestal, ribs of many cuts, anchors with two nuts."""

    size: float = among((0.1, 0.14, 0.2), "height of the column's section", "m")
    tall: float = between(0.7, 2.0, "height of the column", "m")
    flat: bool = chance(0.6, "the column is of a section with flat sides")
    section: Section = nested(Section, "section of the column", fixed=lambda p: {"flat": p.flat})
    side: float = between(0.16, 0.3, "width of the base plate - of the column", "m")
    thick: float = among((0.02, 0.03, 0.04), "of the base plate", "m")
    low: float = among((0.1, 0.2, 0.4), "height of the pedestal", "m")
    grout: float = among((0.0, 0.03, 0.05), "thickness of the grout", "m")
    high: float = between(0.1, 0.25, "height of a rib", "m")
    rib: float = among((0.008, 0.012), "thickness of a rib", "m")
    cut: int = whole(0, 3, "ribs have small flats, cut corners, large flats, a hollow edge")
    spread: float = among((0.0, 0.0, 0.35), "from the middle to a rib of a pair / width of the column")
    ring: bool = chance(0.25, "a ring plate on the ribs")
    bolt: float = among((0.016, 0.02, 0.024), "diameter of the anchors", "m")

    def build(self, t: Table) -> Model:
        size, low, high = self.size, self.low, self.high
        section, side, z = self.section.outline(size, t.style), size + self.side, low + self.grout
        top = z + self.thick
        t.add("foundation", box((side + 0.15, side + 0.15, low), (0, 0, low / 2)))
        if self.grout:
            t.add("foundation", box((side + 0.02, side + 0.02, self.grout), (0, 0, low + self.grout / 2)))
        t.add("base plate", box((side, side, self.thick), (0, 0, z + self.thick / 2)))
        t.add("column", extrude(section[0], top, top + self.tall, section[1]))
        w, c = (side - size) / 2 - 0.005, 0.012
        hollow = [(x, y + 0.01) for x, y in _round_cut(w, high, np.linspace(0.1, 1.4, 6))]
        shape = (
            outline(0, 0, w, 0, w, 0.02, 0.02, high, 0, high),
            outline(c, 0, w, 0, 0, high, 0, c),
            outline(0, 0, w, 0, w, 0.35 * high, 0.3 * w, high, 0, high),
            [(0, 0), (w, 0), *hollow, (0, high + 0.01)],
        )[self.cut]
        rib = upright([(size / 2 + x, top + y) for x, y in shape], -self.rib / 2, self.rib / 2)
        spread = self.spread * size
        for k in range(4):
            for y in (-spread, spread) if spread and k % 2 else (0.0,):
                t.spun("z", k * np.pi / 2).at(0, y).add(_G, rib)
        if self.ring:
            hole, plate = rounded_rectangle(1.03 * size, 1.03 * size, 0), rounded_rectangle(side * 0.9, side * 0.9, 0)
            t.add("plate", extrude(plate, top + high, top + high + 0.01, (hole,)))
        q = side / 2 - 1.6 * self.bolt
        for sx, sy in CORNERS:
            self._anchor(t.at(sx * q, sy * q, top))
        return t.model()

    def _anchor(self, t: Table) -> None:
        d = self.bolt
        washer = (
            box((2.4 * d, 2.4 * d, 0.006), (0, 0, 0.003)) if self.cut % 2 else ring(0.55 * d, 1.1 * d, 0, 0.005, 12)
        )
        nuts = [hexagon(1.6 * d, 0.006 + a * d, 0.006 + b * d, d / 2, 10) for a, b in ((0, 0.85), (0.87, 1.5))]
        solids = [cylinder(d / 2, -self.thick - self.grout - 0.08, 3.0 * d, 10), washer, *nuts]
        if t.style.fasteners != "pieces":
            solids = [merge(solids)]
        for name, solid in zip(("bolt", "washer", "nut", "nut"), solids, strict=False):
            t.add(name, solid)


GUSSETS = families_of(TrussNode, BracingCorner, Haunch, Stiffener, Splice, Foot)
