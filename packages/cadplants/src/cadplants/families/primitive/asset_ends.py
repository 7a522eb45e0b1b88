"""How the pieces of a kit are drawn: a pipe fitting and the flanges, collars or ferrules at its ends in one mesh."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.params import Params, among, between, chance, given, nested, weighted, whole
from cadplants.families.primitive.shape import lying
from cadplants.solids.mesh_ops import Solid, loft, merge, moved, weld
from cadplants.solids.primitives import box, cylinder
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Collar", "Ends", "Ferrule", "Look", "Rim", "skin"]

Ends = tuple[bool, bool]
"""Whether the first and the last end of a piece has a rim."""
Outline = list[tuple[float, float]]
_BACK = spun("z", np.pi)


def skin(
    outline: Sequence[tuple[float, float]], way: Callable[[float], Floats], sides: int, bore: Sequence[float] = ()
) -> Solid:
    """A round body whose radius follows an outline along a way.

    Args:
        outline: how far along the way, and the radius there [m].
        way: the ``(4, 4)`` frame at a length along it, x ahead.
        sides: of its circle.
        bore: inside radius at each point of the outline [m]; none makes it solid.
    """
    angles = np.arange(sides) * 2 * np.pi / sides
    unit = np.column_stack([np.zeros(sides), np.cos(angles), np.sin(angles)])

    def loop(far: float, radius: float) -> Floats:
        pose = way(far)
        round_it: Floats = radius * unit @ pose[:3, :3].T + pose[:3, 3]
        return round_it

    outside = [loop(far, radius) for far, radius in outline]
    if not bore:
        first, last = (way(outline[k][0])[None, :3, 3] for k in (0, -1))
        return weld([loft([first, *outside, last])])
    inside = {far: radius for (far, _), radius in zip(outline, bore, strict=True)}
    return weld([loft([*outside, *(loop(far, radius) for far, radius in list(inside.items())[::-1])], closed=True)])


class Rim(Params):
    """What stands out round an end of a piece: a flange, at times with heads of bolts on its back."""

    form: str = weighted(
        "how it is made", plain=0.35, chamfered=0.2, raised=0.15, hubbed=0.15, paired=0.08, grooved=0.07
    )
    wide: float = between(1.3, 2.4, "radius / of the pipe")
    thick: float = between(0.12, 0.55, "(thickness - 2 mm) / radius of the pipe")
    edge: float = between(0.1, 0.35, "its chamfer, raised face or groove / its thickness")
    hub: float = between(1.1, 1.5, "radius of its hub / of the pipe", when=lambda p: p.form == "hubbed")
    neck: float = between(0.2, 0.8, "length of its hub / radius of the pipe", when=lambda p: p.form == "hubbed")
    bolts: int = among((0, 0, 0, 4, 6, 8, 12), "heads of bolts on its back", when=lambda p: p.wide > 1.55, otherwise=0)
    head: str = among(("hexagon", "round", "box"), "form of these", when=lambda p: p.bolts > 0, otherwise="hexagon")
    high: float = between(0.3, 1.2, "height of these / their radius", when=lambda p: p.bolts > 0)

    def plate(self, r: float) -> float:
        """How thick it is on a pipe of a radius [m]."""
        return self.thick * r + 0.002

    def outline(self, r: float) -> Outline:
        """From the face to the pipe of a radius: how far behind the face, and its radius there [m]."""
        t, wide = self.plate(r), self.wide * r
        step = self.edge * t
        cut = min(step, 0.5 * (wide - r))
        if self.form == "chamfered":
            return [(0.0, wide - cut), (step, wide), (t - step, wide), (t, wide - cut), (t, r)]
        if self.form == "raised":
            face = 0.45 * r + 0.55 * wide
            return [(0.0, face), (0.5 * step, face), (0.5 * step, wide), (t, wide), (t, r)]
        if self.form == "hubbed":
            hub = r * min(self.hub, 0.8 * self.wide + 0.2)
            return [(0.0, wide), (t, wide), (t, hub), (t + self.neck * r, r)]
        if self.form == "paired":
            low, far, inner = 0.45 * t, 1.45 * t, 0.6 * wide + 0.4 * r
            return [
                (0.0, wide),
                (low, wide),
                (low, inner),
                (far - low, inner),
                (far - low, wide),
                (far, wide),
                (far, r),
            ]
        if self.form == "grooved":
            a, b, inner = 0.5 * t - 0.5 * step, 0.5 * t + 0.5 * step, 0.9 * wide
            return [(0.0, wide), (a, wide), (a, inner), (b, inner), (b, wide), (t, wide), (t, r)]
        return [(0.0, wide), (t, wide), (t, r)]

    def heads(self, r: float) -> list[Solid]:
        """The heads of its bolts behind a face at x = 0, the pipe ahead [m]."""
        if not self.bolts:
            return []
        back = max(far for far, radius in self.outline(r) if radius > 1.05 * r and radius > 0.9 * self.wide * r)
        middle = 0.5 * (1 + self.wide) * r
        radius = min(0.3 * (self.wide - 1) * r, 0.8 * middle * np.pi / self.bolts)
        low, top = 0.7 * back, back + self.high * radius
        one = cylinder(radius, low, top, 6 if self.head == "hexagon" else 8)
        if self.head == "box":
            one = box((1.5 * radius, 1.5 * radius, top - low), (0, 0, 0.5 * (low + top)))
        turns = (2 * np.arange(self.bolts) + 1) * np.pi / self.bolts
        return [moved(lying(one), spun("x", float(turn)) @ at(0, middle)) for turn in turns]


class Collar(Rim):
    """A thick collar at an end, as sockets of plastic or cast iron have it; at times with a lip at its mouth."""

    form: str = among(("collar", "collar", "lipped", "coned"), "how it is made")
    wide: float = between(1.1, 1.45, "radius / of the pipe")
    thick: float = between(0.5, 1.5, "(length - 2 mm) / radius of the pipe")
    edge: float = between(0.1, 0.35, "length of its lip or cone / its length")
    bolts: int = given(0, "heads of bolts on its back")

    def outline(self, r: float) -> Outline:
        """Likewise."""
        t, wide = self.plate(r), self.wide * r
        step = self.edge * t
        if self.form == "lipped":
            lip = 1.08 * wide
            return [(0.0, lip), (step, lip), (step, wide), (t, wide), (t, r)]
        if self.form == "coned":
            return [(0.0, wide), (t - step, wide), (t, r)]
        return [(0.0, wide), (t, wide), (t, r)]


class Ferrule(Rim):
    """A thin rim of a hygienic piece, its back sloping to the tube."""

    form: str = given("sloped", "how it is made")
    wide: float = between(1.3, 1.9, "radius / of the pipe")
    thick: float = between(0.02, 0.12, "(thickness - 2 mm) / radius of the pipe")
    edge: float = between(0.2, 0.9, "how far its back slopes / its height")
    bolts: int = given(0, "heads of bolts on its back")

    def outline(self, r: float) -> Outline:
        """Likewise."""
        t, wide = self.plate(r), self.wide * r
        return [(0.0, wide), (t, wide), (t + self.edge * (wide - r), r)]


class Look(Params):
    """How all pieces of a kit are drawn."""

    sides: int = among((0, 0, 0, 6, 8, 8, 10, 12, 12, 16, 20, 24), "sides of a pipe; 0: as the style has them")
    bored: bool = chance(0.45, "bores, where the style models any")
    wall: float = between(0.06, 0.25, "thickness of a wall / radius", when=lambda p: p.bored)
    steps: int = whole(2, 8, "pieces of a right angle")
    crossed: bool = chance(0.5, "branches run through the wall of the run")
    rim: Rim = nested(Rim, "flanges")

    def n(self, style: ModelingStyle, r: float) -> int:
        """Sides of a circle."""
        return self.sides or style.round(r)

    def depth(self, r: float, rim: bool = True) -> float:
        """How far a rim reaches back from its face [m]."""
        return self.rim.outline(r)[-1][0] if rim else 0.0

    def reach(self, r: float, angle: float) -> float:
        """From a corner to the face of a rim that clears one as wide on a leg at an angle to it [m]."""
        return 1.06 * self.rim.wide * r / float(np.tan(angle / 2)) + self.depth(r)

    def least(self, r: float, ends: Ends) -> float:
        """The least length of a straight piece [m]."""
        return 0.002 + 1.1 * sum(self.depth(r, one) for one in ends)

    def piece(
        self, style: ModelingStyle, middle: Outline, ends: Ends, length: float, way: Callable[[float], Floats]
    ) -> Solid:
        """A piece along a way: what is between its rims, and these [m]."""
        first, last = middle[0][1], middle[-1][1]
        begin = self.rim.outline(first) if ends[0] else [(0.0, first)]
        end = self.rim.outline(last) if ends[1] else [(0.0, last)]
        inside = [(far, radius) for far, radius in middle if begin[-1][0] < far < length - end[-1][0]]
        outline = [*begin, *inside, *((length - far, radius) for far, radius in end[::-1])]
        bore: list[float] = []
        if self.bored and style.hollow:
            within = [first] * len(begin) + [radius for _, radius in inside] + [last] * len(end)
            bore = [(1 - self.wall) * radius for radius in within]
        solids = [skin(outline, way, self.n(style, max(first, last)), bore)]
        if ends[0]:
            solids += [moved(one, way(0.0)) for one in self.rim.heads(first)]
        if ends[1]:
            solids += [moved(one, way(length) @ _BACK) for one in self.rim.heads(last)]
        return merge(solids)

    def straight(self, style: ModelingStyle, r: float, length: float, ends: Ends) -> Solid:
        """A straight piece along x [m]."""
        return self.piece(style, [(0.0, r), (length, r)], ends, length, at)

    def lone(self, style: ModelingStyle, r: float) -> Solid:
        """A rim alone, its face at x = 0, round the end of a body in one skin [m]."""
        outline = self.rim.outline(r)
        bore = [0.97 * r] * len(outline) if self.bored and style.hollow else []
        return merge([skin(outline, at, self.n(style, r), bore), *self.rim.heads(r)])

    def tapered(
        self, style: ModelingStyle, radii: tuple[float, float], length: float, drop: float, ends: Ends
    ) -> Solid:
        """A piece along x from one radius to another, whose axis drops by some of what is lost [m]."""
        (a, b), lead = radii, 0.08 * length
        first, last = self.depth(a, ends[0]) + lead, length - self.depth(b, ends[1]) - lead

        def way(far: float) -> Floats:
            share = float(np.clip((far - first) / (last - first), 0, 1))
            return at(far, 0, -drop * share)

        return self.piece(style, [(0.0, a), (first, a), (last, b), (length, b)], ends, length, way)

    def bent(self, style: ModelingStyle, r: float, radius: float, turn: float, ends: Ends) -> tuple[Solid, Floats]:
        """A bend from +x towards +y and the frame of its far end [m]."""
        need = self.reach(r, np.pi - turn) - radius * float(np.tan(turn / 2))
        lead = max(1.05 * self.depth(r), need) if any(ends) else 0.0
        length = 2 * lead + radius * turn

        def way(far: float) -> Floats:
            angle = float(np.clip((far - lead) / radius, 0, turn))
            arc = at(lead + radius * float(np.sin(angle)), radius * (1 - float(np.cos(angle)))) @ spun("z", angle)
            return at(min(far, lead) - lead) @ arc if far < lead else arc @ at(max(0.0, far - lead - radius * turn))

        count = self.steps if self.sides else style.bend(radius + r)
        angles = np.linspace(0, turn, max(2, round(count * turn / (0.5 * np.pi))) + 1)
        middle = [(0.0, r), *((lead + radius * float(a), r) for a in angles), (length, r)]
        return self.piece(style, middle, ends, length, way), way(length)
