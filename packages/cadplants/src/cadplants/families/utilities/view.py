"""Cameras and signs on walls, posts and beams."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import made, number, of_form
from cadplants.builder.params import Params, among, between, chance, nested, several, whole
from cadplants.builder.table import Table, outline
from cadplants.families.utilities.mounting import Back, Utility, beam_over, pole, wall
from cadplants.model.family import Family, Model
from cadplants.solids.mesh_ops import about_x, extrude, merge, moved
from cadplants.solids.polygon import circle, rounded_rectangle
from cadplants.solids.primitives import BOTH, along, around, ball, box, cylinder, dome, ring, rod, rope, turned
from cadplants.solids.transforms import at, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["VIEWS"]

_C, _S = "camera", "sign"


class _Head(Params):
    """A camera with what carries it, before y = 0."""

    plate: ClassVar[float] = 0.0
    """Height over the camera of what holds it at the wall, where a cable comes in [m]."""

    def build(self, t: Table, s: float) -> None:
        """Puts it down.

        Args:
            t: at its height.
            s: how large it is / usual.
        """
        raise NotImplementedError(type(self).__name__)


class _Bullet(_Head):
    """A bullet on a bracket."""

    plate = -0.02

    long: float = between(0.12, 0.22, "of the case / how large the camera is", "m")
    shielded: bool = chance(0.5, "a shield over it")
    tilt: float = between(0.0, 0.5, "down", "rad")
    turn: float = between(-0.3, 0.3, "sideways", "rad")

    def build(self, t: Table, s: float) -> None:
        r, long, y, n = 0.032 * s, self.long * s, -0.14, t.n(0.05)
        case = along("-y", turned(outline(0.6 * r, -0.02, r, 0, r, long, 0.85 * r, long + 0.004), n))
        shield = box((2.3 * r, long + 0.04, 0.004), (0, -long / 2 - 0.01, 1.04 * r))
        head = t.at(0, y).spun("x", self.tilt).spun("z", self.turn)
        head.add(_C, case, shield if self.shielded else cylinder(0.2 * r, 0, r, 8))
        lamps = around(cylinder(0.1 * r, long, long + 0.006, 8), 6, 0.65 * r)
        head.along("-y").add(_C, cylinder(0.35 * r, long, long + 0.01, n), lamps, of="rubber")
        arm = rope([(0, -0.02, 0), (0, -0.09, 0), (0, y + 0.004, 0)], 0.014, 8)
        t.add(_C, along("-y", cylinder(0.045 * s, 0, 0.025, n)), arm, moved(ball(0.024, 10), at(0, y + 0.03)))


class _Dome(_Head):
    """A dome under an arm."""

    plate = 0.03

    out: float = between(0.14, 0.3, "length of the arm", "m")

    def build(self, t: Table, s: float) -> None:
        r, y, n = 0.06 * s, -self.out, t.n(0.05)
        t.at(0, y).add(_C, turned(outline(r, -0.03, r, 0.0, 0.9 * r, 0.03, 0.4 * r, 0.05), n))
        t.at(0, y, -0.03).spun("x", np.pi).add(_C, dome(0.85 * r, 0.85 * r, 0.0, n), of="rubber")
        stalk = rope([(0, -0.01, 0.1), (0, y, 0.12), (0, y, 0.045)], 0.016, 8)
        t.add(_C, stalk, box((0.1, 0.012, 0.14), (0, -0.006, 0.08)))


class _Swivel(_Head):
    """One that swivels under a gooseneck."""

    plate = -0.16

    out: float = between(0.3, 0.5, "length of the gooseneck", "m")

    def build(self, t: Table, s: float) -> None:
        r, y, n = 0.06 * s, -self.out, t.n(0.05)
        neck = turned(outline(0.9 * r, -1.2 * r, r, -1.1 * r, r, 0.4 * r, 0.4 * r, 0.8 * r), n)
        head = t.at(0, y)
        head.add(_C, neck, moved(ball(0.85 * r, max(10, n // 2)), at(0, 0, -1.7 * r)))
        head.at(0, 0, -1.7 * r).spun("x", 0.3 + np.pi / 2).add(_C, cylinder(0.3 * r, 0.0, 0.9 * r, 12), of="rubber")
        goose = outline(-0.01, -0.1, 0.3 * y, 0.1, y + 0.06, 0.16, y, 0.14, y, 0.03)
        stay = rod((0, -0.02, -0.15), (0, 0.5 * y, 0.1), 0.01, 8)
        t.add(_C, rope([(0, *spot) for spot in goose], 0.02, 8), box((0.12, 0.03, 0.2), (0, -0.015, -0.08)), stay)


class _Housing(_Head):
    """One in a weatherproof housing with a sun roof."""

    plate = -0.24

    long: float = between(0.28, 0.42, "of the housing / how large the camera is", "m")
    tilt: float = between(0.05, 0.4, "down", "rad")

    def build(self, t: Table, s: float) -> None:
        w, long, y = 0.1 * s, self.long * s, -0.12
        body = moved(about_x(extrude(rounded_rectangle(w, 0.9 * w, 0.15 * w, 3), 0, long)), spun("z", -np.pi / 2))
        head = t.at(0, y).spun("x", self.tilt)
        roof = box((1.25 * w, long + 0.08, 0.005), (0, -long / 2 - 0.02, 0.45 * w + 0.002))
        head.add(_C, body, roof, of="electrical")
        head.add(_C, box((0.8 * w, 0.006, 0.7 * w), (0, -long - 0.002, 0)), of="rubber")
        arm = rope([(0, 0.0, -0.22), (0, y - 0.1, -0.16), (0, y - 0.12, -0.05)], 0.018, 8)
        shelf = box((0.07, 0.1, 0.03 + 0.1 * s), (0, y - 0.12, -0.06))
        t.add(_C, arm, box((0.1, 0.012, 0.12), (0, -0.006, -0.2)), shelf, of="clamp")


class _Camera(Utility, bundle=_C, grain="structure"):
    """A camera: bullet on a bracket, dome under an arm, swivelling on a gooseneck, or in a housing."""

    height: float = between(1.9, 3.2, "of the camera", "m")
    scale: float = between(0.8, 1.4, "how large it is / usual")
    head: _Head = nested(_Head, "camera")
    boxed: bool = chance(0.5, "a junction box below, with a cable")
    back: Back = nested(Back, "what it is fixed to")

    def build(self, t: Table) -> Model:
        z = self.height
        self.head.build(t.at(0, 0, z), self.scale)
        if self.boxed:
            t.add("junction box", box((0.12, 0.06, 0.12), (0, -0.03, z - 0.45)), own=False)
            end = z + self.head.plate
            t.add("cable", rope([(0, -0.03, z - 0.4), (0, -0.007, end - 0.05), (0, -0.007, end)], 0.006, 6), own=False)
        self.back.build(t, z + 0.4)
        return t.model()


class Bullet(_Camera, name="camera/bullet"):
    """A bullet camera on a bracket."""

    head: _Bullet = nested(_Bullet, "camera")


class DomeCamera(_Camera, name="camera/dome"):
    """A dome camera under an arm."""

    head: _Dome = nested(_Dome, "camera")


class Swivelling(_Camera, name="camera/swivelling"):
    """A pan-tilt-zoom camera on a gooseneck."""

    head: _Swivel = nested(_Swivel, "camera")


class Housed(_Camera, name="camera/housed"):
    """A camera in a weatherproof housing with a sun roof."""

    head: _Housing = nested(_Housing, "camera")


# --- signs ---


def _plate(form: str, s: float, style: ModelingStyle) -> Floats:
    """The outline of a sign of a shape, about its middle."""
    if form == "rectangle":
        return rounded_rectangle(2 * s, 1.4 * s, 0.1 * s, 3)
    if form == "tall":
        return rounded_rectangle(1.2 * s, 1.8 * s, 0.08 * s, 3)
    if form == "round":
        return circle(s, max(12, style.round(s)))
    if form == "diamond":
        half = np.array([[0.7071, 0.7071], [-0.7071, 0.7071]])
        diamond: Floats = rounded_rectangle(1.5 * s, 1.5 * s, 0.1 * s, 3) @ half
        return diamond
    if form == "arrow":
        return s * np.array(outline(-1, -0.4, 0.6, -0.4, 1.1, 0, 0.6, 0.4, -1, 0.4))
    return circle(s, 3, phase=np.pi / 2)


class _Plate(Params):
    """A sign on a wall."""

    form: str = among(("rectangle", "tall", "round", "triangle", "diamond", "arrow"), "its shape")
    bordered: bool = chance(0.4, "its middle is another mesh")


class Mounted(Utility, name="sign/mounted", weight=1.5, bundle=_S):
    """Safety signs (ISO 7010): on a wall, screwed; as a flag off it; hung from a beam on chains; between two posts."""

    form: str = among(("wall", "flag", "hung", "two posts"), "how it is mounted")
    size: float = between(0.1, 0.4, "about half the width of a sign", "m")
    height: float = between(1.3, 2.2, "of its middle", "m")
    thick: float = among((0.002, 0.004, 0.012), "of a sign", "m")
    count: int = whole(1, 4, "signs on a wall", when=of_form("wall"))
    plates: tuple[_Plate, ...] = several(made(_Plate), lambda p: p.count, "signs on a wall")
    back: Back | None = nested(Back, "what a flag is fixed to", when=of_form("flag"))
    drop: float = between(0.2, 0.6, "length of the chains", "m", when=of_form("hung"))

    def build(self, t: Table) -> Model:
        s, z, thick = self.size, self.height, self.thick
        if self.form == "wall":
            for k, plate in enumerate(self.plates):
                shape, front = _plate(plate.form, s, t.style), t.at(k * 2.5 * s, -0.001, z).spun("x", np.pi / 2)
                front.add(_S, extrude(shape, 0, thick))
                if plate.bordered:
                    front.add(_S, extrude(0.75 * shape, thick, thick + 0.001), of="dial")
            t.extend([wall(-2 * s - 0.2, 9 * s, z + 2 * s + 0.3)])
        elif self.back is not None:
            w = 1.4 * s
            sheet, fold = box((thick, 2 * s, w), (0, -s - 0.02, 0)), box((0.06, 0.004, w), (0.03, -0.002, 0))
            t.at(0, 0, z).add(_S, sheet, fold, box((thick, 0.02, w), (0, -0.01, 0)))
            self.back.build(t, z + s + 0.3)
        elif self.form == "hung":
            w, low, high = 2.6 * s, z + 0.6 + s / 2, z + 0.6 + s / 2 + self.drop
            t.add(_S, box((w, thick, s), (0, 0, z + 0.6)))
            for q in BOTH:
                t.add("pipe hanger", rod((q * 0.42 * w, 0, low - 0.01), (q * 0.42 * w, 0, high), 0.004, 6))
            t.extend(beam_over(-w, w, high - 0.001))
        else:
            w = 5 * s
            t.add(_S, box((w, 0.003, 0.6 * w), (0, -0.0015, z)))
            rails = [box((0.96 * w, 0.03, 0.04), (0, 0.015, z + q * 0.2 * w)) for q in BOTH]
            t.add("bracket", *rails, of="clamp")
            for q in BOTH:
                t.at(q * 0.36 * w, 0.06).extend(pole(z + 0.35 * w, 0.03, t.style))
        return t.model()


class _Stake(Params):
    """A marker on a stake."""

    height: float = between(0.5, 1.2, "of the stake", "m")
    width: float = between(0.06, 0.16, "half the width of the plate", "m")
    tilt: float = among((0.0, 0.5), "of the plate", "rad")

    def build(self, t: Table) -> None:
        """Puts it down."""
        h, w = self.height, self.width
        plate = extrude(rounded_rectangle(2 * w, 1.2 * w, 0.1 * w, 2), -0.02, 0.004)
        t.at(0, -0.02, h).spun("x", -self.tilt).spun("x", np.pi / 2).add(_S, plate, of="dial")
        t.add("post", box((0.03, 0.03, h), (0, 0, h / 2)), of="clamp")


class Marker(Utility, name="sign/marker", weight=1.2, bundle=_S):
    """Small plates: tags with arrows strapped to a pipe, a tag on a chain, name plates on legs, markers on stakes."""

    radius: float = between(0.03, 0.12, "of the pipe", "m")
    length: float = between(1.0, 2.0, "of the pipe", "m")
    height: float = between(0.6, 1.4, "of the pipe", "m")
    piped: bool = chance(0.5, "tags on a pipe, not markers on stakes")
    count: int = whole(1, 3, "signs")
    tags: tuple[float, ...] = several(
        number(0.12, 0.3), lambda p: p.count, "length of a tag", "m", when=lambda p: p.piped
    )
    stakes: tuple[_Stake, ...] = several(
        made(_Stake), lambda p: p.count, "markers on stakes", when=lambda p: not p.piped
    )

    def build(self, t: Table) -> Model:
        for k, stake in enumerate(self.stakes):
            stake.build(t.at(0.5 * k))
        if not self.piped:
            return t.model()
        r, long, z, n = self.radius, self.length, self.height, t.n(self.radius)
        t.at(0, 0, z).along("x").add("pipe", cylinder(r, -long / 2, long / 2, n))
        for k, w in enumerate(self.tags):
            h, here = min(1.2 * r, 0.1), t.at((k - 1) * 0.3 * long, 0, z)
            tag = extrude(_plate("arrow", w / 2, t.style) * (1, 2.5 * h / w), 0, 0.002)
            pad = box((0.8 * w, 0.007 + 0.12 * r, 0.4 * h), (0, -r - 0.003 + 0.06 * r, 0))
            here.add(_S, moved(tag, at(0, -r - 0.006) @ spun("x", np.pi / 2)), pad, of="dial")
            for q in BOTH:
                here.at(q * 0.35 * w).along("x").add("clamp", ring(r, r + 0.0015, -0.006, 0.006, n))
        leg = merge([box((0.06, 0.06, z - r), (0, 0, (z - r) / 2)), box((0.14, 0.14, 0.01), (0, 0, 0.005))])
        for q in BOTH:
            t.at(q * 0.4 * long).add("post", leg)
        return t.model()


VIEWS: tuple[Family, ...] = families_of(Bullet, DomeCamera, Swivelling, Housed, Mounted, Marker)
