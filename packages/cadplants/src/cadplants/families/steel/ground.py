"""Ground: slabs with joints, paving, gutters, gravel in kerbs, roads, uneven patches."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.builder.device import families_of
from cadplants.builder.draws import of_form, one_of
from cadplants.builder.params import among, between, chance, several, whole
from cadplants.builder.table import Table
from cadplants.families.steel.shape import (
    Structure,
    few_sides,
    rect,
    slab_xy,
    slab_xz,
)
from cadplants.model.family import Model
from cadplants.solids.mesh_ops import Solid
from cadplants.solids.polygon import circle
from cadplants.solids.primitives import BOTH, box, cylinder, turned

__all__ = ["GROUNDS"]


class Slabs(Structure, name="ground/slabs", weight=1.3, grain="fitting"):
    """Ground in fields: slabs with joints, paving stones, falls to a gutter, a ramp, holes."""

    form: str = among(("fields", "paving", "gutter", "ramp", "holes"), "what it is")
    length: float = between(1.5, 5.0, "along x", "m")
    width: float = between(1.2, 4.0, "along y", "m")
    thick: float = among(
        (0.02, 0.1, 0.2, 0.4), "thickness of a slab", "m", when=lambda p: p.form != "paving", otherwise=0.08
    )
    fields_along: int = whole(1, 3, "fields along x", when=of_form("fields"))
    fields_across: int = whole(1, 3, "fields along y", when=of_form("fields"))
    materials: tuple[str, ...] = several(
        one_of("ground", "concrete"), lambda p: p.fields_along * p.fields_across, "kind of material of a field"
    )
    holed: bool = chance(0.6, "with holes", when=of_form("holes"))
    footed: bool = chance(0.4, "a foundation on it", when=of_form("fields", "ramp"))
    foot: float = between(0.3, 0.8, "side of the foundation", "m", when=lambda p: p.footed)

    def build(self, t: Table) -> Model:
        a, b, thick = self.length, self.width, self.thick
        if self.form == "fields":
            m, n = self.fields_along, self.fields_across
            for k, of in enumerate(self.materials):
                middle = (k // n + 0.5) * a / m, (k % n + 0.5) * b / n, -thick / 2
                t.add("ground", box((a / m - 0.012, b / n - 0.012, thick), middle), of=of)
        elif self.form == "paving":
            m, n = min(int(a / 0.4), 10), min(int(b / 0.3), 8)
            spots = [(0.4 * i + 0.2 * (j % 2), 0.3 * j, -0.04) for j in range(n) for i in range(m)]
            t.add("ground", *(box((0.39, 0.29, 0.08), spot) for spot in spots), of="concrete")
            bed = (0.2 * m - 0.1, 0.15 * n - 0.15, -0.155)
            t.add("ground", box((0.4 * m + 0.2, 0.3 * n, 0.15), bed))
        elif self.form == "gutter":
            fall = slab_xz([(0, -thick), (b / 2, -thick), (b / 2, 0.05), (0, 0.0)], a)
            for s in BOTH:
                t.spun("z", s * np.pi / 2).at(0.08).add("ground", fall, of="concrete")
            gutter = [(-0.08, -0.12), (0.08, -0.12), (0.08, 0.0), (0.05, 0.0), (0.05, -0.08), (-0.05, -0.08)]
            gutter += [(-0.05, 0.0), (-0.08, 0.0)]
            t.spun("z", np.pi / 2).add("foundation", slab_xz(gutter, a), of="clamp")
        elif self.form == "ramp":
            t.add("ground", box((a, b, thick), (0, 0, -thick / 2)))
            ramp = slab_xz([(a / 2, -thick), (a / 2 + 1.2, -thick), (a / 2, 0)], 0.5 * b)
            t.add("ground", ramp, of="concrete")
        else:
            edge = np.array([[0, 0], [a, 0], [a, 0.6 * b], [0.6 * a, 0.6 * b], [0.6 * a, b], [0, b]])
            n = few_sides(t.style, 0.12, 24)
            holes = (circle(0.12, n, (0.3 * a, 0.3 * b)), rect(0.3, 0.3, 0.4 * a, 0.75 * b))
            t.add("ground", slab_xy(edge, -thick, 0, holes if self.holed else ()), of="concrete")
        if self.foot:
            t.add("foundation", box((self.foot, self.foot, 0.2), (0.25 * a, 0.25 * b, 0.1)))
        return t.model()


class Relief(Structure, name="ground/relief", grain="fitting"):
    """Ground with an edge or relief: gravel in kerbs, a grass mound, a round pad, a road, a terrain patch."""

    form: str = among(("kerbs", "pad", "road", "patch"), "what it is")
    length: float = between(1.5, 4.0, "along x, or diameter", "m")
    width: float = between(1.2, 3.0, "along y", "m", when=lambda p: p.form != "pad")
    kerb: float = among((0.06, 0.1, 0.15), "width of a kerb", "m", when=of_form("kerbs"))
    rise: float = among((0.0, 0.1), "of the round pad", "m", when=of_form("pad"))
    post: bool = chance(0.5, "a post on the round pad", when=of_form("pad"))
    points: int = whole(5, 11, "points of the patch each way", when=of_form("patch"))
    rough: float = between(0.02, 0.12, "standard deviation of the patch's heights", "m", when=of_form("patch"))
    heights: tuple[float, ...] = several(
        lambda rng, _: float(rng.standard_normal()),
        lambda p: p.points**2,
        "of a point / the standard deviation",
        when=of_form("patch"),
    )

    def build(self, t: Table) -> Model:
        a, b = self.length, self.width
        if self.form == "kerbs":
            t.add("ground", box((a, b, 0.1), (0, 0, -0.05)))
            k = self.kerb
            kerbs = [box((a + 2 * k, k, 0.25), (0, s * (b / 2 + k / 2), -0.05)) for s in BOTH]
            kerbs += [box((k, b, 0.25), (s * (a / 2 + k / 2), 0, -0.05)) for s in BOTH]
            t.add_each("foundation", kerbs)
        elif self.form == "pad":
            r = a / 2
            t.add("ground", turned([(r, -0.1), (r, 0.0), (0.9 * r, self.rise)], few_sides(t.style, r, 40)))
            if self.post:
                t.add("post", cylinder(0.05, 0.0, 1.0, 12), of="fence")
        elif self.form == "road":
            xs = np.linspace(-b / 2, b / 2, 9)
            top = np.column_stack([xs, 0.03 * (1 - (2 * xs / b) ** 2)])[::-1]
            t.add("ground", slab_xz([(-b / 2, -0.2), (b / 2, -0.2), *top], a))
            for s in BOTH:
                t.add("foundation", box((0.15, a, 0.32), (s * (b / 2 + 0.075), 0, -0.04)))
                t.add("ground", box((0.8, a, 0.1), (s * (b / 2 + 0.55), 0, 0.06)), of="concrete")
        else:
            n = self.points
            x, y = np.meshgrid(np.linspace(0, a, n), np.linspace(0, b, n), indexing="ij")
            z = self.rough * np.array(self.heights).reshape(n, n)
            t.add("ground", _terrain(x, y, z - z.min(), -0.3))
        return t.model()


def _terrain(x: Floats, y: Floats, z: Floats, low: float) -> Solid:
    """A block with an uneven top over a regular grid."""
    n, m = x.shape
    top = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    bottom = top * (1, 1, 0) + np.array([0, 0, low])
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n - 1), np.arange(m - 1), indexing="ij"))
    a, b, c, d = i * m + j, (i + 1) * m + j, (i + 1) * m + j + 1, i * m + j + 1
    up = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    rim = [k * m for k in range(n)] + [(n - 1) * m + k for k in range(1, m)]
    rim += [k * m + m - 1 for k in range(n - 2, -1, -1)] + list(range(m - 2, 0, -1))
    p, q = np.array(rim), np.roll(rim, -1)
    s = n * m
    side = np.concatenate([np.column_stack([p + s, q + s, q]), np.column_stack([p + s, q, p])])
    faces = np.concatenate([up, up[:, ::-1] + s, side]).astype(np.int32)
    return Solid(np.concatenate([top, bottom]), faces)


GROUNDS = families_of(Slabs, Relief)
