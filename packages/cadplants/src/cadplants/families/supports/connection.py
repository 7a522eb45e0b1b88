"""What holds things: supports, clamps and hangers of lines, brackets, gussets, loose fasteners."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved, sweep
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import along, box, cylinder, hexagon, ring, rod, turned
from cadplants.standards import PIPES, SIZES
from cadplants.transforms import at, spun

__all__ = ["CONNECTIONS"]

_GROUP, _FRAME = "Connection assembly", "Structural element"


def _beam_below(top: float, height: float, half: float, style: ModelingStyle, rng: np.random.Generator) -> list[Part]:
    """What a support stands on: a column, a beam on posts, a concrete sleeper; from ``top`` to the floor [m]."""
    low = -height
    kind = int(rng.integers(4))
    if height + top < 0.12:
        return [
            Part(
                box((0.25, 2 * half + 0.3, height + top), (0, 0, (low + top) / 2)), "foundation", "concrete", "", _FRAME
            )
        ]
    if kind == 0:
        side = float(rng.choice([0.06, 0.08, 0.1]))
        post = extrude(rounded_rectangle(side, side, 0.1 * side, 2), low + 0.012, top - 0.01)
        foot = box((2.2 * side, 2.2 * side, 0.012), (0, 0, low + 0.006))
        head = box((0.2, 2 * half + 0.06, 0.01), (0, 0, top - 0.005))
        return [
            Part(post, "post", "steel", "", _FRAME),
            Part(foot, "base plate", "steel", "", _FRAME),
            Part(head, "plate", "steel", "", _FRAME),
        ]
    if kind == 1:
        section = section_i(0.1, 0.1, 0.006, 0.008)
        column = extrude(section, low + 0.015, top - 0.01)
        foot = box((0.2, 0.2, 0.015), (0, 0, low + 0.0075))
        head = box((0.16, 2 * half + 0.06, 0.01), (0, 0, top - 0.005))
        return [
            Part(column, "column", "steel", "", _FRAME),
            Part(foot, "base plate", "steel", "", _FRAME),
            Part(head, "plate", "steel", "", _FRAME),
        ]
    if kind == 2:
        span = half + 0.25
        section = (
            section_channel(0.08, 0.045, 0.006, 0.008) if rng.random() < 0.5 else section_i(0.08, 0.08, 0.006, 0.008)
        )
        beam = extrude(section, -span, span)
        beam = moved(Solid(beam.vertices[:, [0, 2, 1]], beam.faces[:, ::-1]), at(0, 0, top - 0.04))
        posts = [
            Part(
                moved(extrude(rounded_rectangle(0.06, 0.06, 0.006, 2), low, top - 0.08), at(0, s * (span - 0.05))),
                "post",
                "steel",
                "",
                _FRAME,
            )
            for s in (-1, 1)
        ]
        return [Part(beam, "beam", "steel", "", _FRAME), *posts]
    pillar = extrude(rounded_rectangle(0.22, 2 * half + 0.12, 0.02, 2), low, top)
    return [Part(pillar, "foundation", "concrete", "", _FRAME)]


def _u_bolt(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A line on a beam or post, held by a U-bolt with nuts (DIN 3570)."""
    r = PIPES[dn].radius
    rod_, top = 0.004 + 0.03 * r, -r
    leg = r + rod_
    a = np.linspace(0, np.pi, 11)
    bow = np.column_stack([np.zeros(11), leg * np.cos(a), leg * np.sin(a)])
    path = np.vstack([[0, leg, top - 0.03], bow, [0, -leg, top - 0.03]])
    u = sweep(path, circle(rod_, 10), up=(1.0, 0.0, 0.0))
    nuts = [moved(hexagon(3.4 * rod_, top - 0.0125 - 1.6 * rod_, top - 0.0125), at(0, s * leg)) for s in (-1, 1)]
    support = _beam_below(top, height, leg + rod_, style, rng)
    nut_parts = [Part(n, "nut", "fastener", "u-bolt", "", True) for n in nuts]
    return Model([Part(u, "u-bolt", "clamp", "u-bolt"), *nut_parts, *support])


def _half_clamp(inner: float, outer: float, width: float, n: int, ear: float) -> Solid:
    """The upper half of a band round a pipe along x with two flat ears [m]."""
    a = np.linspace(0.02, np.pi - 0.02, max(9, n // 2 + 1))
    far = outer * np.column_stack([np.cos(a), np.sin(a)])
    near = inner * np.column_stack([np.cos(a), np.sin(a)])
    thick = outer - inner
    right = [(outer + ear, thick), (outer + ear, 0.001), (inner, 0.001)]
    left = [(-inner, 0.001), (-outer - ear, 0.001), (-outer - ear, thick)]
    outline = np.vstack(
        [[right[0]], far[1:-1], [left[2]], [left[1]], [left[0]], near[1:-1][::-1], [right[2]], [right[1]]]
    )
    band = extrude(outline[::-1] if _signed(outline) < 0 else outline, -width / 2, width / 2)
    # The outline lies in (y, z) and runs along x.
    return Solid(band.vertices[:, [2, 0, 1]], band.faces)


def _signed(outline: Floats) -> float:
    x, y = outline.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _clamp(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A two-half pipe clamp (DIN 3567), with a rubber lining or without, bolted on a support or on a rod."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    lined = bool(rng.random() < 0.5)
    inner = r + (0.004 if lined else 0.0)
    thick, width, ear = 0.003 + 0.02 * r, 0.025 + 0.15 * r, 0.02 + 0.15 * r
    half = _half_clamp(inner, inner + thick, width, n, ear)
    parts = [Part(half, "clamp", "clamp", "clamp"), Part(moved(half, spun("x", np.pi)), "clamp", "clamp", "clamp")]
    if lined:
        parts.append(Part(along("x", ring(r, inner, -0.55 * width, 0.55 * width, n)), "clamp", "rubber", "clamp"))
    y = inner + thick + 0.55 * ear
    bolt = merge(
        [
            cylinder(0.003 + 0.01 * r, -0.02, 0.02, 8),
            hexagon(0.012 + 0.03 * r, thick, thick + 0.006),
            hexagon(0.012 + 0.03 * r, -thick - 0.006, -thick),
        ]
    )
    parts += [Part(moved(bolt, at(0, s * y)), "bolt", "fastener", "clamp", "", True) for s in (-1, 1)]
    top = -inner - thick
    if rng.random() < 0.5:
        parts += _beam_below(top, height, inner + thick + ear, style, rng)
    else:
        parts.append(Part(cylinder(0.006, -height + 0.008, top + 0.001, 8), "stud", "fastener"))
        parts.append(
            Part(
                merge(
                    [box((0.1, 0.06, 0.008), (0, 0, -height + 0.004)), hexagon(0.02, -height + 0.008, -height + 0.02)]
                ),
                "bracket",
                "steel",
            )
        )
    return Model(parts)


def _shoe(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A pipe shoe: a T or a saddle under the pipe, sliding on a beam; with gussets."""
    r = PIPES[dn].radius
    tall, length = 0.06 + 0.3 * r, 0.15 + 0.8 * r
    top = -r - tall
    web = box((length, 0.008, tall + 0.02), (0, 0, -r - tall / 2 + 0.006))
    sole = box((length, 0.08 + 0.8 * r, 0.008), (0, 0, top + 0.004))
    parts = [Part(merge([web, sole]), "bracket", "steel", "bracket")]
    if rng.random() < 0.6:
        triangle = extrude(np.array([[0, 0], [0.03 + 0.3 * r, 0], [0, tall - 0.01]]), -0.004, 0.004)
        for x in (-0.35 * length, 0.35 * length):
            for turn in (0.5, -0.5):
                pose = at(x, 0, top + 0.008) @ spun("z", turn * np.pi) @ spun("x", np.pi / 2) @ at(0.004)
                parts.append(Part(moved(triangle, pose), "gusset plate", "steel", "bracket"))
    return Model([*parts, *_beam_below(top, height, 0.05 + 0.5 * r, style, rng)])


def _saddle(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An adjustable pipe stand: a cradle on a threaded rod in a tube with a foot plate (MSS SP-58 type 38)."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    a = np.linspace(1.15 * np.pi, 1.85 * np.pi, 9)
    thick = 0.004 + 0.02 * r
    far = (r + thick) * np.column_stack([np.cos(a), np.sin(a)])
    near = r * np.column_stack([np.cos(a), np.sin(a)])[::-1]
    shell = extrude(np.vstack([far, near]), -0.6 * r - 0.03, 0.6 * r + 0.03)
    cradle = Solid(shell.vertices[:, [2, 0, 1]], shell.faces)
    top = -r - 0.5 * thick
    middle = (top - height) / 2
    rods = merge(
        [cylinder(0.01 + 0.08 * r, middle, top, 10), hexagon(0.04 + 0.25 * r, middle + 0.03, middle + 0.05 + 0.1 * r)]
    )
    tube = cylinder(0.018 + 0.16 * r, -height + 0.01, middle + 0.03, max(8, n))
    foot = box((0.16 + r, 0.16 + r, 0.01), (0, 0, -height + 0.005))
    return Model(
        [
            Part(cradle, "bracket", "steel", "bracket"),
            Part(rods, "stud", "fastener", "bracket"),
            Part(tube, "post", "steel", "", _FRAME),
            Part(foot, "base plate", "steel", "", _FRAME),
        ]
    )


def _hanger(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A clevis or ring hanger on a rod from a beam above (MSS SP-58 types 1 and 10)."""
    r, n = PIPES[dn].radius, style.round(PIPES[dn].radius)
    wide, thick, drop = 0.02 + 0.1 * r, 0.003 + 0.01 * r, float(rng.uniform(0.25, 0.8))
    top = 1.5 * r + 0.03
    if rng.random() < 0.5:
        a = np.linspace(np.pi, 2 * np.pi, 11)
        low = np.column_stack([np.zeros(11), (r + thick / 2) * np.cos(a), (r + thick / 2) * np.sin(a)])
        path = np.vstack([[0, -r - thick / 2, 0.7 * r + 0.01], low, [0, r + thick / 2, 0.7 * r + 0.01]])
        section = np.array(
            [[wide / 2, -thick / 2], [wide / 2, thick / 2], [-wide / 2, thick / 2], [-wide / 2, -thick / 2]]
        )
        lower = sweep(path, section, up=(1.0, 0.0, 0.0))
        over = [
            [0, -r - 1.6 * thick, 0.4 * r],
            [0, -r - 1.6 * thick, 0.9 * r + 0.01],
            [0, -0.3 * r, top],
            [0, 0.3 * r, top],
            [0, r + 1.6 * thick, 0.9 * r + 0.01],
            [0, r + 1.6 * thick, 0.4 * r],
        ]
        upper = sweep(np.array(over), section, up=(1.0, 0.0, 0.0))
        pin = along("y", cylinder(0.004 + 0.01 * r, -r - 0.02, r + 0.02, 8), 0, 0, 0.55 * r + 0.005)
        parts = [
            Part(lower, "pipe hanger", "clamp", "pipe hanger"),
            Part(upper, "pipe hanger", "clamp", "pipe hanger"),
            Part(pin, "bolt", "fastener", "pipe hanger", "", True),
        ]
    else:
        loop = along("x", ring(r, r + thick, -wide / 2, wide / 2, n))
        knob = merge([cylinder(0.008, r + thick * 0.5, top, 8), hexagon(0.02, top - 0.012, top)])
        parts = [Part(merge([loop, knob]), "pipe hanger", "clamp", "pipe hanger")]
    parts.append(Part(cylinder(0.005 + 0.01 * r, top - 0.02, top + drop, 8), "stud", "fastener", "pipe hanger"))
    parts.append(
        Part(
            merge(
                [
                    hexagon(0.018 + 0.02 * r, top + 0.002, top + 0.012),
                    hexagon(0.018 + 0.02 * r, top + drop - 0.012, top + drop),
                ]
            ),
            "nut",
            "fastener",
            "pipe hanger",
            "",
            True,
        )
    )
    beam = extrude(section_i(0.12, 0.08, 0.005, 0.008), -0.5, 0.5)
    beam = moved(Solid(beam.vertices[:, [0, 2, 1]], beam.faces[:, ::-1]), at(0, 0, top + drop + 0.06))
    parts.append(Part(beam, "beam", "steel", "", _FRAME))
    if rng.random() < 0.5:
        for s in (-1, 1):
            leg = extrude(rounded_rectangle(0.08, 0.08, 0.006, 2), -height, top + drop)
            parts.append(Part(moved(leg, at(0, s * 0.45)), "column", "steel", "", _FRAME))
    return Model(parts)


def _wall_bracket(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A cantilever bracket with a brace on a wall or column beside the line."""
    r = PIPES[dn].radius
    reach = r + float(rng.uniform(0.15, 0.35))
    angle = extrude(section_angle(0.05, 0.005), 0.0, reach + r + 0.05)
    arm = moved(angle, at(-0.02, reach, -r - 0.05) @ spun("x", np.pi / 2))
    brace = sweep(
        np.array([[0, reach - 0.01, -r - 0.25 - 0.3 * r], [0, -r * 0.3, -r - 0.045]]),
        np.array([[0.02, -0.004], [0.02, 0.004], [-0.02, 0.004], [-0.02, -0.004]]),
        up=(1.0, 0.0, 0.0),
    )
    plate = box((0.12, 0.01, 0.35 + 0.4 * r), (0, reach + 0.003, -r - 0.13 - 0.15 * r))
    wall = (
        box((0.3, 0.2, height + 0.5), (0, reach + 0.108, (0.5 - height) / 2))
        if rng.random() < 0.5
        else moved(extrude(section_i(0.16, 0.15, 0.006, 0.009), -height, 0.5), at(0, reach + 0.088))
    )
    name, color = ("wall", "concrete") if len(wall.vertices) < 12 else ("column", "steel")
    bolts = merge(
        [
            along("-y", hexagon(0.02, 0.0, 0.01), sx * 0.04, reach - 0.002, -r - 0.13 - 0.15 * r + sz * 0.12)
            for sx in (-1, 1)
            for sz in (-1, 1)
        ]
    )
    return Model(
        [
            Part(merge([arm, plate]), "bracket", "steel", "bracket"),
            Part(brace, "bracket", "steel", "bracket"),
            Part(bolts, "bolt", "fastener", "", "", True),
            Part(wall, name, color, "", _FRAME),
        ]
    )


_M = (0.006, 0.008, 0.01, 0.012, 0.016, 0.02, 0.024, 0.03)  # m, ISO 261 coarse threads


def _thread(d: float, low: float, high: float, style: ModelingStyle) -> Solid:
    """A shank, with ridges for a thread where the style models every piece."""
    if style.fasteners != "pieces" or high - low < 3 * d * 0.3:
        return cylinder(d / 2, low, high, max(6, min(16, style.round(d))))
    pitch = 0.15 * d
    count = int(min(24, (high - low) / pitch))
    profile = []
    for k in range(count):
        z = low + k * (high - low) / count
        profile += [(0.43 * d, z), (0.5 * d, z + 0.5 * (high - low) / count)]
    return turned([*profile, (0.43 * d, high)], 12)


def _loose(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Fasteners on a plate: bolts (ISO 4014), socket screws (ISO 4762), nuts (ISO 4032), washers, studs, eye bolts."""
    d = float(rng.choice(_M))
    parts: list[Part] = []
    x = 0.0
    n = max(8, min(24, style.round(d)))
    top = 0.02
    length = float(rng.uniform(2.0, 5.0)) * d
    makers = ["hex", "socket", "nut", "washer", "stud", "countersunk", "eye", "set", "flange nut"]
    for kind in rng.permutation(makers)[: int(rng.integers(4, 8))]:
        kind = str(kind)
        pose = at(x, 0, top)
        x += 3.2 * d
        if kind == "hex":
            bolt = merge(
                [
                    hexagon(1.5 * d, 0.0, 0.65 * d),
                    cylinder(0.5 * d, 0.6 * d, 0.6 * d + 0.4 * length, n),
                    _thread(d, 0.6 * d + 0.4 * length, 0.6 * d + length, style),
                ]
            )
            parts.append(Part(moved(bolt, pose), "bolt", "fastener"))
        elif kind == "socket":
            head = extrude(circle(0.75 * d, n), 0.5 * d, 1.0 * d, (circle(0.45 * d, 6),))
            bolt = merge([head, cylinder(0.75 * d, 0.0, 0.5 * d, n), _thread(d, 0.95 * d, d + length, style)])
            parts.append(Part(moved(bolt, pose), "screw", "fastener"))
        elif kind == "nut":
            parts.append(Part(moved(hexagon(1.5 * d, 0.0, 0.85 * d, 0.5 * d, n), pose), "nut", "fastener"))
        elif kind == "flange nut":
            solid = merge([hexagon(1.5 * d, 0.1 * d, 0.95 * d, 0.5 * d, n), ring(0.5 * d, 1.05 * d, 0.0, 0.15 * d, n)])
            parts.append(Part(moved(solid, pose), "nut", "fastener"))
        elif kind == "washer":
            parts.append(Part(moved(ring(0.54 * d, 1.0 * d, 0.0, 0.16 * d, n), pose), "washer", "fastener"))
        elif kind == "stud":
            parts.append(Part(moved(_thread(d, 0.0, 1.6 * length, style), pose), "stud", "fastener"))
        elif kind == "countersunk":
            solid = merge([turned([(0.95 * d, 0.0), (0.5 * d, 0.5 * d)], n), _thread(d, 0.45 * d, length, style)])
            parts.append(Part(moved(solid, pose), "screw", "fastener"))
        elif kind == "eye":
            from cadplants.primitives import torus

            solid = merge(
                [
                    moved(torus(0.8 * d, 0.3 * d, n, 8), at(0, 0, length + 0.9 * d) @ spun("x", np.pi / 2)),
                    _thread(d, 0.0, length, style),
                    cylinder(0.8 * d, length - 0.2 * d, length, n),
                ]
            )
            parts.append(Part(moved(solid, pose), "bolt", "fastener"))
        else:
            parts.append(Part(moved(merge([_thread(0.9 * d, 0.0, length, style)]), pose), "screw", "fastener"))
    plate = box((x + 0.05, 8 * d, top), (x / 2 - 1.6 * d, 0, top / 2))
    return Model([*parts, Part(plate, "plate", "steel", "", _FRAME)])


def _joint(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bolted or welded steel joint: a column with a beam, an end plate or cleats, bolts, a gusset with a brace."""
    h, b, t, f = ((0.152, 0.160, 0.006, 0.009), (0.19, 0.2, 0.0065, 0.01), (0.2, 0.1, 0.0056, 0.0085))[
        int(rng.integers(3))
    ]
    tall, reach = float(rng.uniform(1.2, 2.2)), float(rng.uniform(0.8, 1.8))
    column = extrude(section_i(h, b, t, f), 0.02, tall)
    foot = box((b + 0.15, h + 0.15, 0.02), (0, 0, 0.01))
    z = 0.7 * tall
    half = h / 2
    beam = extrude(section_i(h, b, t, f), half + 0.012, half + reach)
    beam = moved(Solid(beam.vertices[:, [0, 2, 1]], beam.faces[:, ::-1]), at(0, 0, z))
    plate = box((b + 0.02, 0.012, h + 0.1), (0, half + 0.006, z))
    d = float(rng.choice([0.012, 0.016, 0.02]))
    bolt = merge(
        [
            cylinder(d / 2, -f - 0.6 * d, 0.012 + 0.9 * d, 10),
            hexagon(1.5 * d, 0.012, 0.012 + 0.65 * d),
            hexagon(1.5 * d, -f - 0.7 * d, -f),
        ]
    )
    parts = [
        Part(column, "column", "steel", "", _FRAME),
        Part(foot, "base plate", "steel", "", _FRAME),
        Part(beam, "beam", "steel", "", _FRAME),
        Part(plate, "plate", "steel", "", _FRAME),
    ]
    for sx in (-1, 1):
        for sz in (-0.6, 0.0, 0.6):
            parts.append(
                Part(
                    moved(bolt, at(sx * 0.3 * b, half, z + sz * 0.5 * h) @ spun("x", -np.pi / 2)),
                    "bolt",
                    "fastener",
                    "bolt",
                )
            )
    side = float(rng.uniform(0.15, 0.3))
    gusset = extrude(np.array([[0, 0], [side, 0], [side, 0.25 * side], [0.25 * side, side], [0, side]]), -0.005, 0.005)
    parts.append(
        Part(
            moved(
                gusset,
                at(0, half, z - half) @ spun("z", np.pi / 2) @ spun("x", np.pi / 2) @ np.diag([1.0, -1.0, 1.0, 1.0]),
            ),
            "gusset plate",
            "steel",
        )
    )
    if rng.random() < 0.6:
        leg = 0.06
        end = np.array([0.005, half + 0.75 * reach, 0.05])
        start = np.array([0.005, half + 0.4 * side, z - half - 0.4 * side])
        brace = (
            sweep(np.array([start, end]), section_angle(leg, 0.006), up=(1.0, 0.0, 0.0))
            if rng.random() < 0.5
            else rod(tuple(start), tuple(end), 0.03, max(8, style.round(0.03)))
        )
        parts.append(Part(brace, "brace", "steel", "", _FRAME))
    anchor = merge([cylinder(0.008, -0.02, 0.06, 8), hexagon(0.024, 0.02, 0.033), ring(0.009, 0.02, 0.018, 0.021, 10)])
    for sx in (-1, 1):
        for sy in (-1, 1):
            parts.append(
                Part(
                    moved(anchor, at(sx * 0.5 * (b + 0.09), sy * 0.5 * (h + 0.09))),
                    "bolt",
                    "fastener",
                    "bolt",
                    "",
                    True,
                )
            )
    return Model(parts)


def _carrier(name: str, build: object, sizes: tuple[int, ...] = SIZES, weight: float = 1.0) -> Family:
    return Family(name, "carrier", _GROUP, name.split("/")[0], build, sizes, "structure", weight)  # type: ignore[arg-type]


CONNECTIONS: tuple[Family, ...] = (
    _carrier("u-bolt/support", _u_bolt, weight=2),
    _carrier("clamp/two-half", _clamp, weight=2),
    _carrier("bracket/shoe", _shoe),
    _carrier("bracket/stand", _saddle),
    _carrier("pipe hanger/rod", _hanger, weight=1.5),
    _carrier("bracket/wall", _wall_bracket),
    Family("fastener/loose", "floor", _GROUP, "bolt", _loose, (15,), "fitting", 1.5),
    Family("joint/steel", "floor", _GROUP, "bolt", _joint, (15,), "fitting", 1.5),
)
