"""Electrical and safety: trays, conduits, boxes, panels, lamps, cameras, signs, extinguishers, hydrants."""

from __future__ import annotations

import numpy as np

from cadplants.builder.device import families_of
from cadplants.builder.draws import made, of_form, yes
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Utility
from cadplants.families.utilities.tray import perforated
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import (
    BOTH,
    CORNERS,
    along,
    around,
    box,
    cylinder,
    dome,
    hexagon,
    ring,
    rod,
    rope,
    torus,
    turned,
)
from cadplants.solids.transforms import at, spun

__all__ = ["SAFETY"]

_UPRIGHT = spun("x", np.pi / 2)


class _Post(Params):
    """A round or square post on a base plate."""

    radius: float = between(0.02, 0.04, "half its width", "m")
    round_: bool = chance(0.6, "it is round")

    def build(self, t: Table, height: float) -> None:
        """Puts it down [m]."""
        r = self.radius
        square = box((2 * r, 2 * r, height - 0.01), (0, 0, (height + 0.01) / 2))
        t.add("post", cylinder(r, 0.01, height, t.n(r, 6)) if self.round_ else square, of="clamp")
        t.add("base plate", box((0.16, 0.16, 0.01), (0, 0, 0.005)), of="clamp")


class _Cable(Params):
    """A cable in a tray."""

    radius: float = between(0.005, 0.016, "of the cable", "m")
    off: float = between(-0.4, 0.4, "from the middle / width of the tray")


class Tray(Utility, name="cable tray/ladder and basket", weight=1.5):
    """A cable tray (IEC 61537): ladder, perforated or wire basket, on posts, with cables in it."""

    length: float = between(1.5, 4.0, "of the tray", "m")
    width: float = among((0.1, 0.2, 0.3, 0.45), "of the tray", "m")
    side: float = among((0.05, 0.08, 0.1), "height of its sides", "m")
    level: float = between(0.6, 2.5, "of the tray over the floor", "m")
    form: str = among(("ladder", "perforated", "basket"), "how it is made")
    count: int = whole(0, 4, "cables")
    cables: tuple[_Cable, ...] = several(made(_Cable), lambda p: p.count, "cables in it")

    def build(self, t: Table) -> Model:
        length, w, z = self.length, self.width, self.level
        floor = z + {"ladder": 0.0275, "perforated": 0.0015}.get(self.form, 0.002)
        t.add("cable tray", *self._solids(), of="clamp")
        for k, cable in enumerate(self.cables):
            r, y = cable.radius, cable.off * w
            path = [(f * length, y + 0.05 * w * np.sin(3 * f + k), floor + r) for f in np.linspace(-0.05, 1.05, 7)]
            t.add("cable", rope(path, r, t.n(r, 6, 12)), own=False)
        for x in (0.15 * length, 0.85 * length):
            t.add("post", box((0.05, 0.05, z - 0.03), (x, 0, (z - 0.03) / 2)))
            t.add("bracket", box((0.05, w + 0.1, 0.03), (x, 0, z - 0.015)))
        return t.model()

    def _solids(self) -> list[Solid]:
        length, w, side, z = self.length, self.width, self.side, self.level
        thick = {"ladder": 0.015, "perforated": 0.0015}.get(self.form, 0.0)
        sides = [box((length, thick, side), (length / 2, s * w / 2, z + side / 2)) for s in BOTH]
        if self.form == "ladder":
            return [*sides, *(box((0.03, w, 0.015), (x, 0, z + 0.02)) for x in np.arange(0.15, length, 0.3))]
        if self.form == "perforated":
            nx, ny = int(np.clip(length / 0.1, 4, 24)), int(np.clip(w / 0.05, 2, 6))
            return [moved(perforated(length, w, (nx, ny), 0.06), at(0, 0, z)), *sides]
        spots = [(-w / 2, side), (-w / 2, side / 2), (w / 2, side / 2), (w / 2, side)]
        spots += [(float(y), 0.0) for y in np.linspace(-w / 2, w / 2, 4)]
        bow = [(-w / 2, z + side), (-w / 2, z), (w / 2, z), (w / 2, z + side)]
        return [
            *(rod((0, y, z + dz), (length, y, z + dz), 0.0025, 6) for y, dz in spots),
            *(rope([(x, *point) for point in bow], 0.0025, 6) for x in np.arange(0.05, length, 0.1)),
        ]


class _Run(Params):
    """Where a conduit ends."""

    box: float = between(0.08, 0.16, "width of the junction box at its end", "m")
    tailed: bool = chance(0.5, "a flexible tail from there; no further conduit")


class WallConduit(Utility, name="conduit/wall"):
    """Conduits on a wall with saddles, bends, junction boxes with covers and glands, a flexible tail."""

    radius: float = among((0.008, 0.01, 0.0125, 0.016), "of the conduits", "m")
    height: float = between(1.0, 2.2, "of the first conduit's bend, about", "m")
    count: int = whole(1, 3, "conduits at most")
    first: _Run = nested(_Run, "end of the first conduit")
    second: _Run | None = nested(_Run, "end of the second", when=lambda p: p.count > 1 and not p.first.tailed)
    third: _Run | None = nested(
        _Run, "end of the third", when=lambda p: p.count > 2 and p.second is not None and not p.second.tailed
    )

    def build(self, t: Table) -> Model:
        r, h, n = self.radius, self.height, t.n(self.radius, 6, 12)
        t.add("wall", box((2.6, 0.15, h + 0.4), (1.1, 0.1, (h + 0.4) / 2)))
        for k, run in enumerate(one for one in (self.first, self.second, self.third) if one is not None):
            x, y, top, s, end = 0.3 * k, 0.023 - r, h - 0.05 - 0.1 * k, run.box, 1.75 + 0.2 * k
            bend = [(x, 0.1), (x, top - 0.1), (x + 0.02, top - 0.02), (x + 0.1, top), (end, top)]
            t.add("conduit", rope([(x, y, z) for x, z in bend], r, n))
            for z in (0.4, 0.5 * h):
                ears = box((2 * r + 0.04, 0.002, 0.015), (x, y + r + 0.001, z))
                t.add("clamp", ears, moved(ring(r, r + 0.002, -0.0075, 0.0075, 12), at(x, y, z)))
            mid = end + 0.4 * s
            here = t.at(mid, 0.025, top)
            lid = box((1.04 * s, 0.1 * s, 1.04 * s), (0, -0.64 * s, 0))
            here.add("junction box", box((s, 0.6 * s, s), (0, -0.3 * s, 0)), lid)
            if run.tailed:
                tail = [(mid, 0.025 - 0.3 * s, top - 0.5 * s), (mid, -0.02, top - 0.35)]
                tail += [(mid + 0.1, -0.2, max(top - 0.65, 0.3)), (mid + 0.3, -0.3, 0.3)]
                t.add("cable", rope(tail, 0.8 * r, n))
        return t.model()


class BoxOnPost(Utility, name="junction box/post", bundle="junction box", grain="structure"):
    """A junction box or local control station on a post: lid with screws, glands below, buttons, cables."""

    height: float = between(0.9, 1.5, "of the box's middle", "m")
    width: float = between(0.08, 0.3, "of the box", "m")
    depth: float = between(0.4, 0.7, "depth of the box / width")
    tall: float = between(0.8, 2.0, "height of the box / width")
    buttons: bool = chance(0.5, "three buttons on the lid")
    cables: tuple[bool, ...] = several(yes(0.7), 2, "whether a cable comes out of a gland")
    post: _Post = nested(_Post, "post")

    def build(self, t: Table) -> Model:
        h, s, n, y = self.height, self.width, 12, 0.001 - self.post.radius
        d, tall = self.depth * s, self.tall * s
        front, low = t.at(0, y, h).moved(_UPRIGHT), h - tall / 2
        front.add("junction box", extrude(rounded_rectangle(s, tall, 0.08 * s, 3), 0.0, d))
        front.add("junction box", extrude(rounded_rectangle(1.02 * s, 1.02 * tall, 0.08 * s, 3), d, 1.15 * d))
        for x in (-0.25, 0.25):
            gland = [hexagon(0.026, -0.02, 0.0), cylinder(0.01, -0.035, 0.0, n)]
            t.at(x * s, y - d / 2, low).add("junction box", *gland)
        for z in (-0.25, 0.0, 0.25) if self.buttons else ():
            button = t.at(0, y - 1.15 * d, h + z * tall).along("-y")
            button.add("junction box", cylinder(0.016, 0, 0.02, n), cylinder(0.02, 0.0, 0.008, n))
        for x, there in zip((-0.25, 0.25), self.cables, strict=True):
            if there:
                path = [(x * s, y - d / 2, low - 0.03), (x * s, y - 0.015, low - 0.2), (x * s, y - 0.015, 0.03)]
                t.add("cable", rope(path, 0.007, 8), own=False)
        self.post.build(t, h + 0.1)
        return t.model()


class Station(Utility, name="control panel/station", weight=1.2, bundle="control panel", grain="structure"):
    """A control panel: a wall box on legs, a desk with a sloping top, or a row of doors with handles and lamps."""

    form: str = among(("box", "desk", "row"), "what it is")
    width: float = between(0.4, 1.0, "of a box, or half a desk's", "m", when=of_form("box", "desk"))
    depth: float = between(0.2, 0.4, "of a box", "m", when=of_form("box"))
    height: float = between(0.5, 1.1, "of a box", "m", when=of_form("box"))
    legs: float = between(0.6, 1.0, "height of a box's legs", "m", when=of_form("box"))
    count: int = whole(2, 4, "cabinets in a row", when=of_form("row"))

    def build(self, t: Table) -> Model:
        w, name = self.width, "control panel"
        if self.form == "box":
            self._box(t)
        elif self.form == "desk":
            t.add(name, about_x(extrude(np.array(outline(-0.35, 0, 0.35, 0, 0.35, 1.1, 0.1, 1.1, -0.35, 0.85)), -w, w)))
            screen = moved(box((0.5, 0.02, 0.3)), at(0, 0.125, 1.35) @ spun("x", -0.2))
            t.add(name, screen, box((0.06, 0.04, 0.15), (0, 0.1, 1.15)), of="rubber")
        for k in range(self.count):
            here = t.at(0.62 * k)
            here.add(name, box((0.6, 0.5, 1.9), (0, 0, 0.95)))
            here.add(name, box((0.56, 0.015, 1.75), (0, -0.2575, 0.97)))
            lamps = [along("-y", cylinder(0.012, 0, 0.015, 10), x, -0.265, 1.65) for x in (-0.1, 0.0, 0.1)]
            handle, vent = box((0.02, 0.03, 0.14), (0.23, -0.28, 1.0)), box((0.3, 0.006, 0.2), (0, -0.267, 0.35))
            here.add(name, handle, *lamps, vent, of="rubber")
        return t.model()

    def _box(self, t: Table) -> None:
        w, d, h, z, name = self.width, self.depth, self.height, self.legs, "control panel"
        t.add(name, box((w, d, h), (0, 0, z + h / 2)))
        t.add(name, box((w - 0.03, 0.015, h - 0.03), (0, -d / 2 - 0.0075, z + h / 2)))
        spots = [(x * w, -d / 2 - 0.015, z + 0.8 * h) for x in (-0.3, -0.1, 0.1, 0.3)]
        knobs = [along("-y", cylinder(0.015, 0, 0.02, 12), *spot) for spot in spots]
        t.add(name, *knobs, box((0.3 * w, 0.004, 0.15 * h), (0, -d / 2 - 0.017, z + 0.55 * h)), of="rubber")
        for sx, sy in CORNERS:
            t.add("post", box((0.05, 0.05, z), (sx * 0.4 * w, sy * 0.3 * d, z / 2)))


class LampHead(Utility, name="lamp/head", bundle="lamp", grain="structure"):
    """A lamp: a bulkhead light with a cage, a tube light, a floodlight or a bent-arm street lamp, on a post."""

    form: str = among(("bulkhead", "tubes", "floodlight", "street lamp"), "what it is")
    height: float = between(1.8, 3.5, "of the post", "m")
    post: _Post = nested(_Post, "post")

    def build(self, t: Table) -> Model:
        name, h, n = "lamp", self.height, t.n(0.08)
        self.post.build(t, h)
        up = t.at(0, 0, h)
        if self.form == "bulkhead":
            front = up.at(0, 0.003 - self.post.radius, -0.1).moved(_UPRIGHT)
            front.add(name, turned(outline(0.09, 0, 0.09, 0.03, 0.07, 0.04), n), of="clamp")
            front.add(name, dome(0.065, 0.1, 0.04, n))
            spots = [(0.08 * np.cos(a), 0.08 * np.sin(a)) for a in (0.0, 1.57, 3.14, 4.71)]
            cage = [rope([(*spot, 0.03), (*spot, 0.1), (0, 0, 0.16)], 0.003, 6) for spot in spots]
            front.add(name, *cage, moved(torus(0.08, 0.003, 16, 6), at(0, 0, 0.09)), of="clamp")
        elif self.form == "tubes":
            up.along("x").add(name, extrude(rounded_rectangle(0.1, 0.12, 0.03, 3), -0.6, 0.6), of="electrical")
            up.add(name, *(along("x", cylinder(0.013, -0.57, 0.57, 10), 0, y, -0.062) for y in (-0.03, 0.03)))
        elif self.form == "floodlight":
            fins = [box((0.28, 0.04, 0.006), (0, 0.05, z)) for z in np.linspace(-0.09, 0.09, 7)]
            head = merge([box((0.3, 0.08, 0.22)), *fins, box((0.26, 0.006, 0.18), (0, -0.042, 0))])
            bow = rope([(-0.17, -0.1, 0), (-0.17, 0, -0.12), (0.17, 0, -0.12), (0.17, -0.1, 0)], 0.01, 6)
            up.add(name, moved(head, at(0, -0.1) @ spun("x", 0.6)), bow, of="rubber")
        else:
            arm = [(0, 0, -0.05), (0, 0, 0.3), (0.1, 0, 0.45), (0.5, 0, 0.5)]
            up.add(name, rope(arm, 0.022, t.n(0.02, 6)), of="clamp")
            up.at(0.55, 0, 0.52).add(name, turned(outline(0.17, -0.1, 0.17, -0.08, 0.05, 0.0), n), of="electrical")
        return t.model()


class CameraOnPost(Utility, name="camera/post", weight=1.5, bundle="camera", grain="structure"):
    """A camera: a bullet in a hood, a dome, or a box, on an arm from a post."""

    form: str = among(("bullet", "dome", "box"), "what it is")
    height: float = between(1.8, 3.0, "of the post", "m")
    post: _Post = nested(_Post, "post")

    def build(self, t: Table) -> Model:
        name, h, n = "camera", self.height, t.n(0.04)
        if self.form == "bullet":
            body = along("-y", turned(outline(0.035, 0, 0.038, 0.15, 0.03, 0.16), n))
            solids = [body, box((0.09, 0.22, 0.005), (0, -0.09, 0.039)), along("-y", cylinder(0.02, 0.155, 0.165, n))]
            t.at(0, -0.15, h + 0.03).spun("x", 0.25).add(name, *solids)
        elif self.form == "dome":
            ceiling = turned(outline(0.06, -0.01, 0.065, 0.02, 0.065, 0.06), n)
            t.at(0, -0.2, h - 0.03).add(name, ceiling, moved(dome(0.055, 0.055, 0.0, n), spun("x", np.pi)))
        else:
            lens = along("-y", cylinder(0.03, 0.085, 0.13, n))
            t.at(0, -0.22, h + 0.05).add(name, box((0.08, 0.18, 0.08)), lens)
        t.add(name, rope([(0, 0, h - 0.05), (0, -0.16, h - 0.05), (0, -0.2, h)], 0.014, 8), of="clamp")
        self.post.build(t, h)
        return t.model()


class SignOnPost(Utility, name="sign/shapes"):
    """A sign: square, round, triangular or octagonal plate, on a post or on four feet."""

    height: float = between(1.0, 2.0, "of the plate's middle", "m")
    size: float = between(0.12, 0.35, "half the width of the plate", "m")
    form: str = among(("rectangle", "round", "triangle", "octagon"), "of the plate")
    post: _Post = nested(_Post, "post")

    def build(self, t: Table) -> Model:
        h, s = self.height, self.size
        shape = {
            "rectangle": rounded_rectangle(2 * s, 1.4 * s, 0.1 * s, 3),
            "round": circle(s, t.n(s, 12)),
            "triangle": circle(s, 3, phase=np.pi / 2),
            "octagon": circle(s, 8, phase=np.pi / 8),
        }[self.form]
        t.at(0, -self.post.radius, h).moved(_UPRIGHT).add("sign", extrude(shape, 0.0, 0.003))
        self.post.build(t, h + s)
        return t.model()


class Bottle(Utility, name="fire extinguisher/bottle", bundle="fire extinguisher", grain="structure"):
    """A fire extinguisher (EN 3): a bottle with a domed shoulder, valve, levers, hose; on the floor or on a wall."""

    radius: float = between(0.05, 0.1, "of the bottle", "m")
    tall: float = between(4.0, 6.5, "height of the bottle to its shoulder / radius")
    lift: float = among((0.0, 0.0, 0.6), "height over the floor, on a wall if any", "m")

    def build(self, t: Table) -> Model:
        name, r, low, n = "fire extinguisher", self.radius, self.lift, t.n(self.radius)
        h, wall, t = self.tall * r, t, t.at(0, 0, low)
        shoulder = [(r * np.cos(a), h + 0.8 * r * np.sin(a)) for a in (0.4, 0.8, 1.2)]
        neck = outline(0.3 * r, h + 0.85 * r, 0.3 * r, h + r)
        t.add(name, turned([(0.9 * r, 0), (r, 0.1 * r), (r, h), *shoulder, *neck], n))
        top = t.at(0, 0, h + 0.98 * r)
        lever = moved(box((1.5 * r, 0.22 * r, 0.06 * r), (0.75 * r, 0, 0)), at(0, 0, 0.72 * r) @ spun("y", -0.25))
        top.add(
            name,
            hexagon(0.7 * r, 0, 0.4 * r),
            cylinder(0.22 * r, 0, 0.7 * r, 10),
            box((1.5 * r, 0.25 * r, 0.06 * r), (0.55 * r, 0, 0.65 * r)),
            lever,
            along("-y", cylinder(0.2 * r, 0.0, 0.15 * r, 10), 0, -0.3 * r, 0.2 * r),
            of="trim",
        )
        z = h + 0.98 * r
        hose = [(-0.2 * r, z + 0.25 * r), (-r, z + 0.3 * r), (-1.3 * r, 0.8 * h), (-1.2 * r, 0.25 * h)]
        nozzle = rod((-1.2 * r, 0, 0.26 * h), (-1.2 * r, 0, 0.1 * h), 0.2 * r, 8)
        t.add(name, rope([(x, 0, z) for x, z in hose], 0.12 * r, 8), nozzle, of="rubber")
        if low:
            wall.add("wall", box((0.3, 0.03, 1.5), (0, r + 0.017, 0.75)))
            t.add("bracket", box((0.5 * r, 0.03, 0.1), (0, r + 0.002, 0.8 * h)))
        return t.model()


class HoseReel(Utility, name="fire extinguisher/reel", weight=0.6, bundle="fire extinguisher", grain="structure"):
    """A fire hose reel or box: a cabinet with a round reel and a coiled hose."""

    def build(self, t: Table) -> Model:
        r, n, up = 0.26, t.n(0.26), t.at(0, 0, 1.0)
        reel = [along("y", cylinder(r, y, y + 0.01, n)) for y in (-0.12, 0.02)]
        hub = along("y", cylinder(0.3 * r, -0.13, 0.05, n))
        up.add("fire extinguisher", *reel, hub, box((0.08, 0.16, 0.4), (0, 0.12, 0)))
        rings = [torus(0.8 * r - 0.005 * (k % 2), 0.018, t.n(r, 12), 6) for k in range(4)]
        coil = [moved(one, at(0, -0.1 + 0.028 * k) @ _UPRIGHT) for k, one in enumerate(rings)]
        tail = rope([(0.78 * r, -0.05, 0), (0.9 * r, -0.1, -0.3), (0.6 * r, -0.15, -0.5)], 0.013, 8)
        up.add("hose", *coil, tail)
        t.add("wall", box((0.9, 0.15, 1.8), (0, 0.275, 0.9)))
        return t.model()


class PillarHydrant(Utility, name="hydrant/pillar", weight=1.5, bundle="hydrant", grain="structure"):
    """A pillar hydrant (EN 14384): a flanged barrel, a bonnet with a pentagon nut, two or three capped outlets."""

    radius: float = between(0.07, 0.12, "of the barrel", "m")
    height: float = between(0.6, 1.0, "of the barrel", "m")
    outlets: int = whole(2, 3, "outlets")

    def build(self, t: Table) -> Model:
        name, r, h, n = "hydrant", self.radius, self.height, t.n(self.radius)
        head = outline(r, h, 1.25 * r, h + 0.02, 1.25 * r, h + 0.3 * r)
        barrel = turned([*outline(1.9 * r, 0.0, 1.9 * r, 0.03, r, 0.04), *head], n)
        t.add(name, barrel, *(cylinder(1.25 * r, z, z + 0.03, n) for z in (0.25 * h, 0.25 * h + 0.032)))
        nut = turned(outline(0.3 * r, h + 1.2 * r, 0.3 * r, h + 1.5 * r), 5)
        t.add(name, dome(1.2 * r, r, h + 0.3 * r, n), nut)
        outs = []
        for angle, size in ((0.0, 0.75), (np.pi, 0.55), (-np.pi / 2, 0.55))[: self.outlets]:
            widths = ((size, 0.8, 1.5, n), (1.2 * size, 1.4, 1.75, n), (0.3 * size, 1.7, 2.0, 5))
            stub = merge([cylinder(wide * r, low * r, high * r, k) for wide, low, high, k in widths])
            outs.append(moved(along("x", stub, 0, 0, 0.82 * h), spun("z", angle)))
        t.add(name, *outs)
        t.add("bolt", around(hexagon(0.024, 0.03, 0.045), 6, 1.6 * r))
        return t.model()


SAFETY: tuple[Family, ...] = families_of(
    Tray,
    WallConduit,
    BoxOnPost,
    Station,
    LampHead,
    CameraOnPost,
    SignOnPost,
    Bottle,
    HoseReel,
    PillarHydrant,
)
