"""Structures: profiles, frames, ladders, gratings, railings, fences, walls, foundations, skids, casters."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number, of_form, own_stream, yes
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.shape import (
    Section,
    Structure,
    grid,
    lug,
    rect,
    strings,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid, extrude, merge, moved, sweep
from cadplants.solids.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.solids.primitives import BOTH, CORNERS, along, ball, bar, box, cylinder, hexagon, rod, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["FRAMES"]


class Profile(Params):
    """A rolled or hollow section (proportions of EN 10365, EN 10056, EN 10210)."""

    share: float = between(0.4, 1.0, "height / the greatest that it could have")
    form: str = among(("H", "I", "channel", "angle", "square tube", "round tube"), "section")
    corner: float = among((0.0, 0.08), "radius of its corners / height", when=of_form("square tube"))

    def section(self, style: ModelingStyle, big: float) -> Section:
        """Its outline and hole; at most so high [m]."""
        h = self.share * big
        if self.form == "square tube":
            inner = (rounded_rectangle(0.66 * h, 0.66 * h, 0.05 * h, 2),) if style.hollow else ()
            return rounded_rectangle(0.75 * h, 0.75 * h, self.corner * h, 3), inner
        if self.form == "round tube":
            n = style.round(0.35 * h)
            return circle(0.35 * h, n), ((circle(0.31 * h, n),) if style.hollow else ())
        return {
            "H": section_i(h, h, 0.05 * h, 0.07 * h),
            "I": section_i(h, 0.5 * h, 0.03 * h, 0.045 * h),
            "channel": section_channel(h, 0.45 * h, 0.06 * h, 0.08 * h) - (0.2 * h, 0),
            "angle": section_angle(0.6 * h, 0.06 * h) - 0.2 * h,
        }[self.form], ()


class _Foot(Params):
    """What is under a column of a bay."""

    anchored: bool = chance(0.5, "with anchors")
    footed: bool = chance(0.4, "on a foundation")


class Bay(Structure, name="frame/bay", weight=2, grain="fitting"):
    """A bay of a steel frame: columns on base plates, beams, braces (crossed, single, knee), gusset plates, anchors."""

    width: float = between(1.2, 3.0, "along a beam", "m")
    depth: float = between(1.0, 2.5, "along a purlin", "m")
    height: float = between(1.8, 3.5, "of a column", "m")
    column: Profile = nested(Profile, "of the columns")
    beam: Profile = nested(Profile, "of the beams")
    thin: Profile = nested(Profile, "of purlins and braces")
    feet: tuple[_Foot, ...] = several(made(_Foot), 4, "what is under the columns")
    purlins: int = whole(2, 4, "on the beams")
    braces: str = among(("crossed", "single", "knee"), "how it is braced")
    floored: bool = chance(0.4, "a floor on it")
    floor: str = among(("platform", "plate"), "what the floor is", when=lambda p: p.floored)

    def build(self, t: Table) -> Model:
        w, d, h = self.width, self.depth, self.height
        (up, up_hole), across = self.column.section(t.style, 0.22), self.beam.section(t.style, 0.2)
        thin, thin_hole = self.thin.section(t.style, 0.14)
        side, bolt = (
            float(np.ptp(up, axis=0).max()) + 0.12,
            [cylinder(0.008, 0.0, 0.05, 8), hexagon(0.024, 0.015, 0.028)],
        )
        for (x, y), foot in zip(((0.0, 0.0), (0.0, d), (w, 0.0), (w, d)), self.feet, strict=True):
            t.add("column", bar((x, y, 0.015), (x, y, h), up, up_hole))
            t.add("base plate", box((side, side, 0.015), (x, y, 0.0075)))
            for sx, sy in CORNERS if foot.anchored else ():
                t.at(x + sx * 0.4 * side, y + sy * 0.4 * side).add("bolt", *bolt)
            if foot.footed:
                t.add("foundation", box((side + 0.15, side + 0.15, 0.2), (x, y, -0.1)))
        level = h + float(np.ptp(across[0][:, 1])) / 2
        t.add_each("beam", [bar((0, y, level), (w, y, level), *across) for y in (0.0, d)])
        deep, level = float(np.ptp(thin[:, 1])), 2 * level - h
        for x in np.linspace(0, w, self.purlins):
            t.add("beam", bar((x, 0, level + deep / 2), (x, d, level + deep / 2), thin, thin_hole))
        half = float(np.ptp(up[:, 0])) / 2
        self._braces(t, half, (0.8 * thin, tuple(0.8 * hole for hole in thin_hole)))
        if self.floored:
            t.add(self.floor, box((w + 0.1, d + 0.1, 0.008), (w / 2, d / 2, level + deep + 0.004)), of="steel")
        return t.model()

    def _braces(self, t: Table, half: float, one: Section) -> None:
        """Knee braces, or braces on either side of gusset plates in the corners between columns, feet and beam."""
        w, h, side = self.width, self.height, 0.16
        if self.braces == "knee":
            t.add_each("brace", [bar((x, 0, h - 0.6), (x + s * 0.5, 0, h), *one) for x, s in ((0.0, 1), (w, -1))])
            return
        y = 0.004 + min(-float(one[0][:, 0].min()), float(one[0][:, 0].max()))
        lines = [((0.0, y, 0.1), (w, y, h - 0.1)), ((0.0, -y, h - 0.1), (w, -y, 0.1))]
        shape = [[0, 0], [side, 0], [side, 0.3 * side], [0.3 * side, side], [0, side]]
        gusset = moved(extrude(np.array(shape), -0.004, 0.004), spun("x", np.pi / 2))
        for start, end in lines[: 2 if self.braces == "crossed" else 1]:
            t.add("brace", bar(start, end, *one))
            for x, z in ((start[0] + half, start[2]), (end[0] - half, end[2])):
                sx, sz = np.sign(w / 2 - x), np.sign(h / 2 - z)
                t.at(x, 0, z - sz * 0.085).moved(np.diag([sx, 1.0, sz, 1.0])).add("gusset plate", gusset)


class Caged(Structure, name="ladder/cage", weight=1.5):
    """A fixed ladder (ISO 14122-4): stiles, rungs every 250 to 300 mm, with a safety cage or without, wall brackets."""

    height: float = between(2.0, 4.5, "of the ladder", "m")
    width: float = between(0.35, 0.5, "of the ladder", "m")
    pitch: float = between(0.25, 0.3, "from rung to rung", "m")
    flat: bool = chance(0.5, "its stiles are flats, not tubes")
    caged: bool = chance(0.65, "with a safety cage", when=lambda p: p.height > 2.6)

    def build(self, t: Table) -> Model:
        h, wide, n, own = self.height, self.width, max(6, min(12, t.style.round(0.015))), t.bundled("ladder")
        for x in (-wide / 2, wide / 2):
            own.add("ladder", box((0.012, 0.06, h), (x, 0, h / 2)) if self.flat else rod((x, 0, 0), (x, 0, h), 0.02, n))
        levels = np.arange(self.pitch, h - 0.02, self.pitch)
        own.add_each("ladder", [rod((-wide / 2, 0, z), (wide / 2, 0, z), 0.011, n) for z in levels])
        if self.caged:
            a = np.linspace(-0.35, np.pi + 0.35, 13)
            hoop = np.column_stack([0.38 * np.cos(a), -0.36 - 0.36 * np.sin(a), np.zeros(13)])
            hoop = np.vstack([[wide / 2, 0, 0], hoop, [-wide / 2, 0, 0]])
            solid = sweep(hoop, np.array([[0.003, -0.02], [0.003, 0.02], [-0.003, 0.02], [-0.003, -0.02]]))
            for z in np.linspace(2.2, h, max(2, round((h - 2.2) / 0.7) + 1)):
                own.at(0, 0, float(z)).add("ladder", solid)
            for x, y, _ in hoop[[1, 4, 7, 10, 13]]:
                own.add("ladder", box((0.03, 0.005, h - 2.2), (x, y, (h + 2.2) / 2)))
        for z in (0.4, h - 0.4):
            t.add_each("bracket", [box((0.01, 0.2, 0.05), (s * wide / 2, 0.12, z)) for s in BOTH])
        return t.model()


class Panel(Params):
    """A floor panel: bars as one lattice or one by one, a plain slab, a chequer plate."""

    form: str = among(("lattice", "bars", "slab", "chequer plate"), "what it is")

    def build(self, t: Table, w: float, d: float, thick: float) -> None:
        """Puts it down about the origin on z = 0, of two sides and a thickness [m]."""
        made = {"lattice": self._lattice, "bars": self._bars, "chequer plate": self._chequer}
        slab = box((w, d, 0.3 * thick), (0, 0, 0.85 * thick))
        solid = made[self.form](w, d, thick) if self.form in made else slab
        t.add("plate" if self.form == "chequer plate" else "grating", solid, of="clamp")

    def _lattice(self, w: float, d: float, thick: float) -> Solid:
        counts = int(np.clip(w / 0.034, 4, 30)), int(np.clip(d / 0.1, 3, 12))
        return moved(grid(w + 0.003, d + 0.005, thick, counts, (0.003, 0.005)), at(0.0015, 0.0025))

    def _bars(self, w: float, d: float, thick: float) -> Solid:
        xs, ys = (
            np.linspace(-span / 2, span / 2, int(np.clip(span / pitch, least, most)))
            for span, pitch, least, most in ((w, 0.04, 4, 26), (d, 0.1, 3, 12))
        )
        bars = [box((0.005, d, thick), (x, 0, thick / 2)) for x in xs]
        return merge([*bars, *(box((w, 0.006, 0.006), (0, y, thick - 0.004)) for y in ys)])

    def _chequer(self, w: float, d: float, thick: float) -> Solid:
        lugs = [
            moved(box((0.03, 0.006, 0.002)), at(x, y, thick + 0.001) @ spun("z", 0.7854 * (-1) ** (i + j + 1)))
            for i, x in enumerate(np.linspace(-0.45 * w, 0.45 * w, 9))
            for j, y in enumerate(np.linspace(-0.45 * d, 0.45 * d, 9))
        ]
        return merge([box((w, d, 0.006), (0, 0, thick - 0.003)), *lugs])


class Rails(Params):
    """A railing along x (ISO 14122-3): posts, top rail, knee rail, toe board; ball joints or mitred ends."""

    height: float = between(0.95, 1.15, "of the top rail", "m")
    square: bool = chance(0.3, "of square tube, not round")
    barred: bool = chance(0.3, "filled with upright bars")
    toe: bool = chance(0.5, "a toe board")
    balls: bool = chance(0.3, "ball joints on its posts")
    plated: bool = chance(0.5, "base plates under its posts")

    def build(self, t: Table, length: float) -> None:
        """Puts it down from 0 to a length [m]."""
        n, h, own = max(6, min(16, t.style.round(0.022))), self.height, t.bundled("railing")

        def tube(name: str, a: tuple[float, float], b: tuple[float, float], r: float) -> None:
            start, end = (a[0], 0, a[1]), (b[0], 0, b[1])
            square = rounded_rectangle(1.8 * r, 1.8 * r, 0.0)
            own.add(name, bar(start, end, square, ()) if self.square else rod(start, end, r, n), of="safety")

        xs = np.linspace(0, length, max(2, int(length / 1.2) + 1))
        tube("railing", (0, h), (length, h), 0.021)
        tube("railing", (0, 0.5 * h), (length, 0.5 * h), 0.014)
        for x in xs:
            tube("post", (x, 0), (x, h), 0.021)
        for x in np.arange(0.12, length, 0.14) if self.barred else ():
            tube("railing", (x, 0.08), (x, h), 0.007)
        if self.toe:
            own.add("railing", box((length, 0.005, 0.1), (length / 2, 0.025, 0.06)))
        if self.balls:
            own.add_each("railing", [moved(ball(0.03, 10), at(x, 0, h)) for x in xs])
        if self.plated:
            t.add_each("base plate", [box((0.08, 0.08, 0.01), (x, 0, 0.005)) for x in xs])


class Tubular(Structure, name="railing/tubular", grain="fitting"):
    """A railing of round or square tube, straight or round a corner."""

    length: float = between(1.0, 3.0, "along x", "m")
    rails: Rails = nested(Rails, "railing along x")
    corner: bool = chance(0.5, "it goes round a corner")
    second: float = between(0.8, 2.0, "length along y", "m", when=lambda p: p.corner)
    others: Rails = nested(Rails, "railing along y", when=lambda p: p.corner)

    def build(self, t: Table) -> Model:
        self.rails.build(t, self.length)
        if self.corner:
            self.others.build(t.spun("z", np.pi / 2), self.second)
        return t.model()


class _Tread(Params):
    """A tread of a flight of stairs."""

    form: str = among(("slab", "grating", "folded"), "what it is")

    def solids(self, go: float, wide: float) -> list[Solid]:
        """The tread about its middle, its width along y [m]."""
        if self.form == "slab":
            return [box((go + 0.02, wide - 0.02, 0.03))]
        if self.form == "grating":
            bars = [box((0.005, wide - 0.02, 0.03), (x, 0, 0)) for x in np.linspace(-go / 2, go / 2, 7)]
            ys = np.linspace(-wide / 2 + 0.02, wide / 2 - 0.02, 5)
            return bars + [box((go, 0.005, 0.03), (0, y, 0)) for y in ys]
        nose = box((0.005, wide - 0.02, 0.04), (-go / 2 - 0.01, 0, -0.02))
        return [box((go + 0.02, wide - 0.02, 0.005)), nose]


class Flight(Structure, name="stairs/flight", weight=1.5, grain="fitting"):
    """A flight of stairs: two stringers of channel or flat, treads of grating, plate or chequer, a handrail."""

    rise: float = between(0.16, 0.21, "of a step", "m")
    going: float = between(0.21, 0.28, "of a step", "m")
    width: float = between(0.6, 1.0, "of the flight", "m")
    count: int = whole(4, 8, "steps")
    flat: bool = chance(0.5, "its stringers are flats, not channels")
    tread: _Tread = nested(_Tread, "of every step", stream=own_stream)
    railed: bool = chance(0.7, "a handrail on either side")

    def build(self, t: Table) -> Model:
        go, wide, n = self.going, self.width, max(6, t.style.round(0.02))
        run, height = go * self.count, self.rise * self.count
        outline = rounded_rectangle(0.01, 0.2, 0.0) if self.flat else section_channel(0.18, 0.05, 0.006, 0.008)
        sides = [s * wide / 2 for s in BOTH]
        # The strings' axes run through the middles of the treads.
        lift = self.rise / 2 - 0.04
        strings(t, (outline, ()), sides, run, height, lift)
        tread = self.tread.solids(go, wide)
        for k in range(self.count):
            t.at((k + 0.5) * go, 0, (k + 1) * self.rise - 0.04).add("stair tread", *tread)
        own = t.at(0, 0, lift).bundled("railing")
        for y in sides if self.railed else ():
            own.add("railing", rod((0, y, 0.95), (run, y, height + 0.95), 0.02, n))
            feet = [(f * run, y, f * height) for f in (0.05, 0.5, 0.95)]
            own.add_each("post", [rod((x, y, z), (x, y, z + 0.95), 0.02, n) for x, y, z in feet], of="safety")
        return t.model()


class Platform(Structure, name="platform/bay", weight=2.5):
    """A platform: columns, edge beams, a floor of grating panels or plate, railings on some sides."""

    width: float = between(1.2, 2.6, "along x", "m")
    depth: float = between(0.9, 1.8, "along y", "m")
    height: float = between(0.4, 2.4, "of its floor", "m")
    column: Profile = nested(Profile, "of the columns")
    edge: Profile = nested(Profile, "of the beams")
    plain: bool = chance(0.3, "its floor is one plate")
    count: int = whole(1, 3, "panels", when=lambda p: not p.plain)
    panels: tuple[Panel, ...] = several(made(Panel), lambda p: p.count, "of the floor", when=lambda p: not p.plain)
    back: Rails = nested(Rails, "railing along x", when=lambda p: p.height > 0.5)
    sided: bool = chance(0.6, "a railing along y", when=lambda p: p.height > 0.5)
    side: Rails = nested(Rails, "that railing", when=lambda p: p.sided)

    def build(self, t: Table) -> Model:
        w, d, h = self.width, self.depth, self.height
        up, edge = self.column.section(t.style, 0.16), self.edge.section(t.style, 0.16)
        ys = edge[0][:, 1]
        deep, z = float(np.ptp(ys)), h - float(np.ptp(ys)) / 2 - float(ys.max() + ys.min()) / 2
        corners = [(sx * w / 2, sy * d / 2) for sx, sy in CORNERS]
        t.add_each("column", [bar((x, y, 0.0), (x, y, h - deep), *up) for x, y in corners])
        t.add_each("beam", [bar((-w / 2, s * d / 2, z), (w / 2, s * d / 2, z), *edge) for s in BOTH])
        t.add_each("beam", [bar((s * w / 2, -d / 2, z), (s * w / 2, d / 2, z), *edge) for s in BOTH])
        if self.plain:
            t.add("platform", box((w, d, 0.012), (0, 0, h + 0.006)))
        for k, panel in enumerate(self.panels):
            panel.build(t.at(-w / 2 + (k + 0.5) * w / self.count, 0, h), w / self.count - 0.004, d, 0.03)
        if h > 0.5:
            self.back.build(t.at(-w / 2, d / 2, h + 0.03), w)
            if self.sided:
                self.side.build(t.at(-w / 2, -d / 2, h + 0.03).spun("z", np.pi / 2), d)
        return t.model()


class Grating(Structure, name="grating/panel", grain="fitting"):
    """Gratings on a low frame of angles."""

    width: float = between(0.8, 2.0, "along x", "m")
    depth: float = between(0.5, 1.2, "along y", "m")
    thick: float = among((0.025, 0.03, 0.04), "thickness of the panel", "m")
    panel: Panel = nested(Panel, "panel")

    def build(self, t: Table) -> Model:
        w, d = self.width, self.depth
        self.panel.build(t.at(0, 0, 0.1), w, d, self.thick)
        angle = section_angle(0.05, 0.005)
        t.add_each("beam", [bar((-w / 2, s * d / 2, 0.07), (w / 2, s * d / 2, 0.07), angle, ()) for s in BOTH])
        t.add_each("post", [box((0.05, 0.05, 0.07), (sx * w / 2, sy * d / 2, 0.035)) for sx, sy in CORNERS])
        return t.model()


class Fence(Structure, name="fence/panel", weight=1.5, grain="fitting"):
    """A panel fence of welded wire, planks or sheet between posts, maybe with a gate leaf and its hinges."""

    length: float = between(1.5, 2.6, "of the panel", "m")
    height: float = between(1.0, 2.2, "of the panel", "m")
    rounds: tuple[bool, ...] = several(yes(0.5), 2, "whether a post is round, not flat")
    fill: str = among(("wires", "planks", "sheet"), "of the panel")
    gated: bool = chance(0.6, "a gate leaf beside it")
    strut: bool = chance(0.5, "one diagonal in the leaf, not bars", when=lambda p: p.gated)

    def build(self, t: Table) -> Model:
        long, h, n = self.length, self.height, max(6, min(12, t.style.round(0.02)))
        for x, is_round in zip((0.0, long), self.rounds, strict=True):
            flat = box((0.06, 0.04, h + 0.1), (x, 0, (h + 0.1) / 2))
            t.add("post", rod((x, 0, 0), (x, 0, h + 0.1), 0.03, n) if is_round else flat, of="fence")
        t.add("fence", *self._filling())
        if self.gated:
            a, b = long + 0.08, long + 1.0
            leaf = [rod((a, 0, z), (b, 0, z), 0.02, n) for z in (0.1, h)]
            leaf += [rod((x, 0, 0.1), (x, 0, h), 0.02, n) for x in (a, b)]
            bars = (
                []
                if self.strut
                else [rod((x, 0, 0.1), (x, 0, h), 0.008, 6) for x in np.arange(a + 0.12, b - 0.05, 0.12)]
            )
            t.add("gate", *leaf, *(bars or [rod((a, 0, 0.1), (b, 0, h), 0.015, n)]))
            t.add("bracket", *(moved(cylinder(0.014, 0, 0.08, 10), at(long + 0.05, 0, z)) for z in (0.25, h - 0.3)))
        return t.model()

    def _filling(self) -> list[Solid]:
        """What is between the posts."""
        long, h = self.length, self.height
        if self.fill == "wires":
            wires = [rod((x, 0, 0.05), (x, 0, h), 0.003, 6) for x in np.arange(0.06, long - 0.03, 0.08)]
            return wires + [
                rod((0.03, 0.004, z), (long - 0.03, 0.004, z), 0.004, 6) for z in np.linspace(0.08, h - 0.05, 8)
            ]
        if self.fill == "planks":
            return [box((long - 0.06, 0.02, 0.12), (long / 2, 0, z)) for z in np.arange(0.15, h, 0.18)]
        sheet = box((long - 0.06, 0.003, h - 0.1), (long / 2, 0, h / 2 + 0.05))
        return [sheet, *(box((long - 0.06, 0.03, 0.04), (long / 2, 0.015, z)) for z in (0.2, h - 0.1))]


class Concrete(Structure, name="foundation/concrete", weight=1.5, grain="fitting"):
    """Concrete: a stepped foundation with anchor bolts, a wall (maybe with an opening), a kerb, a plinth."""

    form: str = among(("foundation", "wall", "kerb"), "what it is")
    length: float = between(
        lambda p: 0.5 if p.form == "foundation" else 1.5,
        lambda p: 1.4 if p.form == "foundation" else 4.0,
        "along x",
        "m",
    )
    width: float = between(0.4, 1.0, "of a foundation", "m", when=of_form("foundation"))
    height: float = between(1.0, 3.0, "of a wall", "m", when=of_form("wall"))
    thick: float = between(0.1, 0.3, "thickness of a wall", "m", when=of_form("wall"))
    opening: bool = chance(0.5, "an opening in the wall", when=of_form("wall"))

    def build(self, t: Table) -> Model:
        a, b, h = self.length, self.width, self.height
        if self.form == "foundation":
            t.add("foundation", box((a + 0.3, b + 0.3, 0.2), (0, 0, 0.1)), box((a, b, 0.4), (0, 0, 0.4)))
            t.add("base plate", box((0.8 * a, 0.8 * b, 0.02), (0, 0, 0.61)))
            for sx, sy in CORNERS:
                bolt = [cylinder(0.01, -0.05, 0.1, 8), hexagon(0.03, 0.02, 0.036)]
                t.at(sx * 0.35 * a, sy * 0.35 * b, 0.6).add("bolt", *bolt)
        elif self.form == "wall":
            hole = [[0.3 * a, 0.35 * h], [0.6 * a, 0.35 * h], [0.6 * a, 0.75 * h], [0.3 * a, 0.75 * h]]
            holes = (np.array(hole),) if self.opening else ()
            wall = extrude(np.array([[0, 0], [a, 0], [a, h], [0, h]]), -self.thick / 2, self.thick / 2, holes)
            t.spun("x", np.pi / 2).add("wall", wall)
            t.add("foundation", box((a + 0.2, self.thick + 0.4, 0.2), (a / 2, 0, -0.1)))
        else:
            kerbs = [box((a, 0.12, 0.15), (a / 2, s * 0.8, 0.075)) for s in BOTH]
            t.add("wall", *kerbs, *(box((0.12, 1.6, 0.15), (x, 0, 0.075)) for x in (0.06, a - 0.06)))
            t.add("foundation", box((a, 1.72, 0.1), (a / 2, 0, -0.05)))
        return t.model()


class Wheeled(Structure, name="skid frame/wheeled", weight=3, grain="fitting"):
    """A skid frame of sections, maybe with a deck and lifting eyes, on casters or on the floor."""

    length: float = between(1.2, 2.6, "of the frame", "m")
    width: float = between(0.7, 1.4, "of the frame", "m")
    profile: Profile = nested(Profile, "of the frame")
    wheeled: bool = chance(0.55, "on casters")
    radius: float = between(0.04, 0.09, "of a caster's wheel", "m", when=lambda p: p.wheeled)
    ties: int = whole(3, 5, "cross members")
    decked: bool = chance(0.5, "a plate on it")
    loose: bool = chance(0.5, "that plate is a part of its own kind, not of the frame", when=lambda p: p.decked)
    turns: tuple[float, ...] = several(number(0, 6), 4, "which way a caster points", "rad", when=lambda p: p.wheeled)
    eyed: bool = chance(0.4, "with lifting eyes")

    def build(self, t: Table) -> Model:
        w, d, r, own = self.length, self.width, self.radius, t.bundled("skid frame")
        outline, holes = self.profile.section(t.style, 0.16)
        low = 2.6 * r if self.wheeled else 0.0
        z, top = low - float(outline[:, 1].min()), low + float(np.ptp(outline[:, 1]))
        own.add_each("skid frame", [bar((-w / 2, s * d / 2, z), (w / 2, s * d / 2, z), outline, holes) for s in BOTH])
        tie = 0.95 * outline, tuple(0.95 * hole for hole in holes)
        xs = np.linspace(-w / 2 + 0.05, w / 2 - 0.05, self.ties)
        own.add_each("skid frame", [bar((x, -d / 2, z), (x, d / 2, z), *tie) for x in xs])
        if self.decked:
            t.add("plate" if self.loose else "skid frame", box((w, d, 0.006), (0, 0, top + 0.003)))
        for sx, sy in CORNERS if self.eyed else ():
            t.at(sx * (w / 2 - 0.15), sy * d / 2, top).add("lifting lug", lug(t.style, 0.07, 0.012), of="steel")
        for (sx, sy), turn in zip(CORNERS, self.turns, strict=False):
            self._caster(t.at(sx * 0.4 * w, sy * d / 2).spun("z", turn).bundled("caster"), low)
        return t.model()

    def _caster(self, t: Table, low: float) -> None:
        r, n = self.radius, t.n(self.radius)
        fork = [box((0.9 * r, 0.05 * r + 0.003, 1.5 * r), (0.25 * r, s * 0.42 * r, 1.55 * r)) for s in BOTH]
        fork.append(box((1.6 * r, 1.4 * r, 0.08 * r), (0, 0, low - 0.04 * r)))
        fork.append(cylinder(0.5 * r, 2.25 * r, low - 0.05 * r, max(8, n)))
        t.add("caster", *fork, box((0.9 * r, 0.95 * r, 0.06 * r), (0.15 * r, 0, 2.28 * r)), of="clamp")
        tread = turned([(0.9 * r, -0.3 * r), (r, -0.2 * r), (r, 0.2 * r), (0.9 * r, 0.3 * r)], n)
        t.add("caster", along("y", tread, 0.4 * r, 0, r))
        t.add("bolt", along("y", cylinder(0.1 * r, -0.55 * r, 0.55 * r, 8), 0.4 * r, 0, r))


class _Piece(Params):
    """A section that lies or stands."""

    big: float = between(0.08, 0.3, "greatest height of its profile", "m")
    profile: Profile = nested(Profile, "profile")
    long: float = between(float(np.log(0.3)), float(np.log(5.0)), "natural logarithm of its length / 1 m")
    upright: bool = chance(0.4, "it stands on a base plate")
    holed: bool = chance(0.5, "holes in the base plate", when=lambda p: p.upright)
    corner: float = among((0.0, 0.01), "radius of the base plate's corners", "m", when=lambda p: p.upright)
    capped: bool = chance(0.5, "a cap plate on top", when=lambda p: p.upright)

    def build(self, t: Table) -> None:
        """Puts it down, along x or z."""
        (outline, holes), long = self.profile.section(t.style, self.big), float(np.exp(self.long))
        if not self.upright:
            half = float(-outline[:, 1].min())
            t.add("beam", bar((0.5, 0, half), (0.5 + long, 0, half), outline, holes))
            return
        t.add("column", extrude(outline, 0.0, long, holes))
        side = float(np.ptp(outline, axis=0).max()) + 0.1
        hole = tuple(circle(0.007, 10, (sx * 0.4 * side, sy * 0.4 * side)) for sx, sy in CORNERS if self.holed)
        t.add("base plate", extrude(rounded_rectangle(side, side, self.corner, 2), -0.012, 0.0, hole))
        if self.capped:
            t.add("plate", extrude(rect(side, side), long, long + 0.01))


class Stock(Structure, name="profile/stock", weight=1.5, grain="fitting"):
    """Sections of any length lying and standing, plates with holes and without."""

    count: int = whole(3, 6, "sections")
    pieces: tuple[_Piece, ...] = several(made(_Piece), lambda p: p.count, "section")

    def build(self, t: Table) -> Model:
        for k, one in enumerate(self.pieces):
            one.build(t.at(0, 0.45 * k))
        return t.model()


FRAMES = families_of(Bay, Caged, Tubular, Flight, Platform, Grating, Fence, Concrete, Wheeled, Stock)
