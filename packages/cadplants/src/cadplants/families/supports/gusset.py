"""Steel joints with gusset plates: truss node, bracing corner, haunch, stiffeners, splice, stiffened foot."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.supports.shape import GROUP, bolt_parts, framed, member, piece, slab_yz, upright
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import bar, box, cylinder, hexagon, ring
from cadplants.transforms import at, spun

__all__ = ["GUSSETS"]

_G = "gusset plate"
_HEADS = ("hex", "hex", "flange", "stud")


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


def _node(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A truss node: a plate of many corners between double angles or on a tube, chord and two to four web members."""
    t, leg = float(rng.choice([0.008, 0.01, 0.012])), float(rng.choice([0.05, 0.06, 0.08]))
    high, span = float(rng.uniform(0.5, 1.2)), float(rng.uniform(0.7, 1.3))
    down = bool(rng.random() < 0.5)  # whether the web members go down from an upper chord
    sign = -1.0 if down else 1.0
    kind = int(rng.integers(3))
    angles = [(0.25 * np.pi, 0.75 * np.pi), (0.25 * np.pi, 0.5 * np.pi, 0.75 * np.pi), (0.5 * np.pi, 0.8 * np.pi)][
        int(rng.integers(3))
    ]
    d = float(rng.choice([0.012, 0.016]))
    level = high + 0.6 if down else high
    parts: list[Part] = []
    corners = [
        [-0.5 * span * 0.35, 0.0],
        [0.5 * span * 0.35, 0.0],
        [-0.5 * span * 0.35, -sign * 0.4 * leg],
        [0.5 * span * 0.35, -sign * 0.4 * leg],
    ]
    sides = (-1, 1) if kind == 0 else (1,)
    section = section_angle(leg, 0.1 * leg)

    def pieces(a: Floats, b: Floats, name: str) -> None:
        if kind == 2:
            thin, holes = circle(0.5 * leg, style.round(0.5 * leg)), ()
            parts.append(framed(bar(a, b, thin, holes), name))
            return
        for s in sides:
            shape = section * (s, 1) - np.array([-s * t / 2, 0.5 * leg])
            parts.append(framed(bar(a, b, shape if s > 0 else shape[::-1]), name))

    pieces(np.array([-span, 0, level]), np.array([span, 0, level]), "beam")
    for a in angles:
        way = np.array([np.cos(a), 0.0, sign * np.sin(a)])
        near = 0.8 * leg + 0.05 + (0.05 if abs(np.cos(a)) > 0.1 else 0.0)
        overlap = 0.12 + 2 * d
        start = np.array([0, 0, level]) + way * near
        pieces(start, start + way * float(rng.uniform(0.4, 0.55)), "brace")
        side = np.array([-way[2], 0, way[0]])
        for s in (-1, 1):
            p = start + way * overlap + s * 0.65 * leg * side
            corners.append([p[0], p[2] - level])
        if kind < 2:
            for q in (0.3, 0.8):
                x, _, z = start + way * overlap * q
                outer = t / 2 + 0.1 * leg
                low = -outer if kind == 0 else -t / 2
                pose = at(x, outer, z) @ spun("x", np.pi / 2)
                parts += bolt_parts(d, outer - low, pose, style, "", str(rng.choice(_HEADS)))
    plate = upright(_hull(np.array(corners)) + np.array([0.0, level]), -t / 2, t / 2)
    parts.insert(0, piece(plate, _G, "", "steel"))
    posts = [box((0.08, 0.08, level - 0.5 * leg), (s * 0.8 * span, 0, (level - 0.5 * leg) / 2)) for s in (-1, 1)]
    parts += [framed(p, "post") for p in posts]
    return Model(parts)


def _corner(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """The corner of a braced bay: column, beam, a gusset in between, a brace bolted on."""
    size = float(rng.choice([0.1, 0.14, 0.2]))
    tall, reach, t = (
        float(rng.uniform(1.2, 2.4)),
        float(rng.uniform(1.0, 1.8)),
        float(rng.choice([0.008, 0.012, 0.016])),
    )
    column = extrude(section_i(size, size, 0.06 * size, 0.08 * size) @ np.array([[0.0, 1.0], [-1.0, 0.0]]), 0.02, tall)
    foot = box((size + 0.12, size + 0.12, 0.02), (0, 0, 0.01))
    outline, holes = member(size, style, rng, flat=True)
    z = tall - size / 2 if rng.random() < 0.6 else 0.02 + size / 2
    up = 1.0 if z < 0.5 * tall else -1.0
    beam = bar((size / 2, 0, z), (reach, 0, z), outline, holes)
    x0, z0 = size / 2, z + up * size / 2
    w, h = float(rng.uniform(0.18, 0.34)), float(rng.uniform(0.18, 0.34))
    clip = 0.3 * min(w, h)
    a = np.linspace(0, np.pi / 2, 8)[1:-1]
    form = int(rng.integers(4))
    forms: list[list[list[float]]] = [
        [[0, 0], [w, 0], [w, clip], [clip, h], [0, h]],
        [[0, 0], [w, 0], *([w * (1 - np.sin(q)), h * (1 - np.cos(q))] for q in a), [0, h]],
        [[0.03, 0], [w, 0], [w, 0.4 * h], [0.4 * w, h], [0, h], [0, 0.03]],
        [[0, 0], [w, 0], [0, h]],
    ]
    shape = forms[form]
    gusset = upright([[x0 + x, z0 + up * y] for x, y in shape], -t / 2, t / 2)
    mid = np.array([x0 + 0.3 * w, 0, z0 + up * 0.3 * h])
    end = np.array([reach - 0.1, 0, z0 + up * (reach - 0.1 - x0) * h / w])
    limit = (tall - 0.05 if up > 0 else 0.05) - mid[2]
    share = min(1.0, abs(limit) / abs(end[2] - mid[2]))
    end = mid + share * (end - mid)
    thin = float(rng.choice([0.05, 0.06, 0.08]))
    kinds = (
        section_angle(thin, 0.006),
        section_channel(thin, 0.5 * thin, 0.006, 0.006),
        rounded_rectangle(0.01, thin, 0),
    )
    k = int(rng.integers(3))
    y = -t / 2 - (0.005 if k == 2 else 0.0)
    brace = moved(
        bar(mid, end, kinds[k] - np.array([0.0, 0.5 * thin if k == 0 else 0.0])), at(0, y if k == 2 else t / 2)
    )
    parts = [
        framed(column, "column"),
        framed(foot, "base plate"),
        framed(beam, "beam"),
        piece(gusset, _G, "", "steel"),
        framed(brace, "brace"),
    ]
    way = (end - mid) / np.linalg.norm(end - mid)
    d = float(rng.choice([0.012, 0.016, 0.02]))
    thick = t + (0.01 if k == 2 else 0.006)
    low = -t / 2 - (0.01 if k == 2 else 0.0)
    for q in (0.02, 0.02 + 3 * d, 0.02 + 6 * d)[: int(rng.integers(2, 4))]:
        x, _, zz = mid + way * q
        parts += bolt_parts(d, thick, at(x, low + thick, zz) @ spun("x", np.pi / 2), style, "", str(rng.choice(_HEADS)))
    return Model(parts)


def _haunch(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A moment joint: beam with a haunch, an end plate bolted to a column, web stiffeners in line with the flanges."""
    h = float(rng.choice([0.16, 0.2, 0.25]))
    b, web, f = float(rng.choice([0.5, 1.0])) * h, 0.04 * h, 0.06 * h
    tall, reach = float(rng.uniform(1.2, 2.2)), float(rng.uniform(0.8, 1.6))
    t, d = float(rng.choice([0.012, 0.016, 0.02])), float(rng.choice([0.016, 0.02]))
    column = extrude(section_i(h, max(b, 0.14), web, f) @ np.array([[0.0, 1.0], [-1.0, 0.0]]), 0.02, tall)
    z = tall - h / 2 - 0.05
    beam = bar((h / 2 + t, 0, z), (h / 2 + t + reach, 0, z), section_i(h, b, web, f))
    deep, long_ = float(rng.uniform(0.5, 1.0)) * h, float(rng.uniform(1.0, 2.0)) * h
    x0, under = h / 2 + t, z - h / 2
    parts = [
        framed(column, "column"),
        framed(beam, "beam"),
        framed(box((h + 0.15, max(b, 0.14) + 0.15, 0.02), (0, 0, 0.01)), "base plate"),
    ]
    low = under - 0.02
    if rng.random() < 0.7:
        a = np.linspace(0, np.pi / 2, 7)[1:-1]
        straight = [[x0, under], [x0 + long_, under], [x0, under - deep]]
        curved = [
            [x0, under],
            [x0 + long_, under],
            *([x0 + long_ * (1 - np.sin(q)), under - deep * (1 - np.cos(q))] for q in a),
            [x0, under - deep],
        ]
        bent = rng.random() < 0.3
        parts.append(piece(upright(curved if bent else straight, -web, web), _G, "", "steel"))
        if not bent:
            flange = bar((x0, 0, under - deep - f / 2), (x0 + long_, 0, under - f / 2), rounded_rectangle(b, f, 0))
            parts.append(framed(flange, "plate"))
        low = under - deep - 0.02
    top = z + h / 2 + 0.02
    wide = max(b, 0.14)
    parts.append(framed(box((t, wide, top - low), (h / 2 + t / 2, 0, (top + low) / 2)), "plate"))
    count = int(rng.integers(3, 6))
    for q in np.linspace(low + 0.05, top - 0.045, count):
        for s in (-1, 1):
            pose = at(h / 2 - f, s * 0.3 * wide, float(q)) @ spun("y", np.pi / 2)
            parts += bolt_parts(d, t + f, pose, style, "", str(rng.choice(["hex", "flange"])))
    half = (max(b, 0.14) - web) / 2
    clip = 0.15 * half if rng.random() < 0.6 else 0.0
    w = (h - 2 * f) / 2
    plan = (
        [[-w, 0], [w, 0], [w, half], [-w, half]]
        if not clip
        else [[-w + clip, 0], [w - clip, 0], [w, clip], [w, half], [-w, half], [-w, clip]]
    )
    for level in {round(z + h / 2 - f, 4), round(under, 4)}:
        for s in (-1, 1):
            stiff = extrude(np.array(plan), -0.004, 0.004)
            parts.append(
                piece(moved(stiff, at(0, s * web / 2, level) @ spun("x", 0.0 if s > 0 else np.pi)), _G, "", "steel")
            )
    return Model(parts)


def _stiffened(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A beam on two posts with web stiffeners: full, partial, clipped, triangular, over the posts and along it."""
    h = float(rng.choice([0.16, 0.2, 0.3]))
    b, web, f = float(rng.uniform(0.5, 0.9)) * h, 0.04 * h, 0.06 * h
    span, top = float(rng.uniform(1.2, 2.6)), float(rng.uniform(0.6, 1.8))
    beam = bar((-span / 2, 0, top - h / 2), (span / 2, 0, top - h / 2), section_i(h, b, web, f))
    parts = [framed(beam, "beam")]
    half, deep = (b - web) / 2, h - 2 * f
    clip = 0.2 * half
    shapes: tuple[list[list[float]], ...] = (
        [[0, 0], [half, 0], [half, deep], [0, deep]],
        [[clip, 0], [half, 0], [half, deep], [clip, deep], [0, deep - clip], [0, clip]],
        [[0, 0], [0.9 * half, 0], [0, 0.6 * deep]],
        [[0, 0], [0.9 * half, 0], [0.9 * half, 0.15 * deep], [0.3 * half, 0.75 * deep], [0, 0.75 * deep]],
    )
    shape = shapes[int(rng.integers(4))]
    t = float(rng.choice([0.006, 0.008, 0.012]))
    xs = np.linspace(-0.42 * span, 0.42 * span, int(rng.integers(2, 6)))
    for x in xs:
        for s in (-1, 1):
            outline = [[s * (web / 2 + y), top - h + f + z] for y, z in shape]
            parts.append(piece(slab_yz(outline, float(x) - t / 2, float(x) + t / 2), _G, "", "steel"))
    size = min(0.1, b)
    for s in (-1, 1):
        x = s * 0.42 * span
        parts.append(framed(box((size + 0.06, size + 0.04, 0.012), (x, 0, top - h - 0.006)), "plate"))
        parts.append(
            framed(moved(extrude(rounded_rectangle(size, size, 0.005, 2), 0.015, top - h - 0.012), at(x)), "post")
        )
        parts.append(framed(box((size + 0.12, size + 0.12, 0.015), (x, 0, 0.0075)), "base plate"))
        for q in (-1, 1):
            parts += bolt_parts(0.012, f + 0.012, at(x + q * (size / 2 + 0.012), q * 0.3 * b, top - h - 0.012), style)
    if rng.random() < 0.4:
        foot: list[list[float]] = [[0, 0], [0.05, 0], [0.0, 0.1]]
        for s in (-1, 1):
            for q in (-1, 1):
                rib = upright([[s * 0.42 * span + q * (size / 2 + x), 0.015 + z] for x, z in foot], -0.004, 0.004)
                parts.append(piece(rib, _G, "", "steel"))
    return Model(parts)


def _splice(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A beam or column splice: cover plates on flanges and web with rows of bolts, or end plates face to face."""
    h = float(rng.choice([0.16, 0.2, 0.25]))
    b, web, f = float(rng.uniform(0.6, 1.0)) * h, 0.04 * h, 0.06 * h
    half, level = float(rng.uniform(0.5, 1.2)), float(rng.uniform(0.5, 1.5))
    section, t, d = section_i(h, b, web, f), float(rng.choice([0.006, 0.01])), float(rng.choice([0.012, 0.016]))
    name = _G if rng.random() < 0.5 else "plate"
    parts = [framed(bar((s * (half + 0.003), 0, level), (s * 0.002, 0, level), section), "beam") for s in (-1, 1)]
    rows = int(rng.integers(2, 4))
    pitch = 3.5 * d
    long_ = 2 * (rows * pitch + d)

    def plate(solid: Solid) -> Part:
        return piece(solid, _G, "", "steel") if name == _G else framed(solid, "plate")

    xs = [s * (0.7 * pitch + k * pitch) for s in (-1, 1) for k in range(rows)]
    if rng.random() < 0.75:
        for s in (-1, 1):
            parts.append(plate(box((long_, b, t), (0, 0, level + s * (h / 2 + t / 2)))))
            for x in xs:
                for y in (-0.32 * b, 0.32 * b):
                    pose = at(x, y, level + s * (h / 2 - f)) @ spun("x", 0.0 if s > 0 else np.pi)
                    parts += bolt_parts(d, f + t, pose, style, "", str(rng.choice(["hex", "flange"])))
        tall = 0.7 * (h - 2 * f)
        for s in (-1, 1):
            parts.append(plate(box((long_ * 0.8, t, tall), (0, s * (web + t) / 2, level))))
        for x in xs[:: max(1, rows - 1)]:
            for z in (-0.3 * tall, 0.3 * tall):
                parts += bolt_parts(d, web + 2 * t, at(x, web / 2 + t, level + z) @ spun("x", np.pi / 2), style)
    else:
        thick = 0.016
        parts[0] = framed(bar((-half, 0, level), (-thick, 0, level), section), "beam")
        parts[1] = framed(bar((thick, 0, level), (half, 0, level), section), "beam")
        parts += [framed(box((thick, b + 0.02, h + 0.1), (s * thick / 2, 0, level)), "plate") for s in (-1, 1)]
        for y in (-0.32 * b, 0.32 * b):
            for z in (-h / 2 - 0.03, -h / 4, h / 4, h / 2 + 0.03):
                parts += bolt_parts(d, 2 * thick, at(-thick, y, level + z) @ spun("y", np.pi / 2), style)
        for s in (-1, 1):
            for x in (-1, 1):
                z0 = level + s * h / 2
                rib = upright([[x * thick, z0], [x * (thick + 0.09), z0], [x * thick, z0 + s * 0.045]], -0.004, 0.004)
                parts.append(piece(rib, _G, "", "steel"))
    for s in (-1, 1):
        post = box((0.1, min(b, 0.1), level - h / 2), (s * (half - 0.1), 0, (level - h / 2) / 2))
        parts.append(framed(post, str(rng.choice(["post", "column"]))))
    return Model(parts)


def _foot(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A column foot: thick base plate on grout and a pedestal, ribs of many cuts, anchors with two nuts."""
    size, tall = float(rng.choice([0.1, 0.14, 0.2])), float(rng.uniform(0.7, 2.0))
    outline, holes = member(size, style, rng, flat=bool(rng.random() < 0.6))
    side, t = size + float(rng.uniform(0.16, 0.3)), float(rng.choice([0.02, 0.03, 0.04]))
    low, grout = float(rng.choice([0.1, 0.2, 0.4])), float(rng.choice([0.0, 0.03, 0.05]))
    parts = [framed(box((side + 0.15, side + 0.15, low), (0, 0, low / 2)), "foundation", "concrete")]
    if grout:
        parts.append(framed(box((side + 0.02, side + 0.02, grout), (0, 0, low + grout / 2)), "foundation", "concrete"))
    z = low + grout
    top = z + t
    parts += [
        framed(box((side, side, t), (0, 0, z + t / 2)), "base plate"),
        framed(moved(extrude(outline, top, top + tall, holes), at()), "column"),
    ]
    w, high, thick = (side - size) / 2 - 0.005, float(rng.uniform(0.1, 0.25)), float(rng.choice([0.008, 0.012]))
    form = int(rng.integers(4))
    c = 0.012
    forms: list[list[list[float]]] = [
        [[0, 0], [w, 0], [w, 0.02], [0.02, high], [0, high]],
        [[c, 0], [w, 0], [0, high], [0, c]],
        [[0, 0], [w, 0], [w, 0.35 * high], [0.3 * w, high], [0, high]],
        [
            [0, 0],
            [w, 0],
            *([w * (1 - np.sin(q)), high * (1 - np.cos(q)) + 0.01] for q in np.linspace(0.1, 1.4, 6)),
            [0, high + 0.01],
        ],
    ]
    shape = forms[form]
    rib = upright([[size / 2 + x, top + y] for x, y in shape], -thick / 2, thick / 2)
    spread = float(rng.choice([0.0, 0.0, 0.35])) * size
    for k in range(4):
        for y in (-spread, spread) if spread and k % 2 else (0.0,):
            parts.append(piece(moved(rib, spun("z", k * np.pi / 2) @ at(0, y)), _G, "", "steel"))
    if rng.random() < 0.25:  # a ring plate on top of the ribs
        parts.append(
            framed(
                extrude(
                    rounded_rectangle(side * 0.9, side * 0.9, 0),
                    top + high,
                    top + high + 0.01,
                    (rounded_rectangle(1.03 * size, 1.03 * size, 0),),
                ),
                "plate",
            )
        )
    d = float(rng.choice([0.016, 0.02, 0.024]))
    q = side / 2 - 1.6 * d
    for sx in (-1, 1):
        for sy in (-1, 1):
            pose = at(sx * q, sy * q, top)
            solids = [
                ("bolt", cylinder(d / 2, -t - grout - 0.08, 3.0 * d, 10)),
                (
                    "washer",
                    box((2.4 * d, 2.4 * d, 0.006), (0, 0, 0.003))
                    if form % 2
                    else ring(0.55 * d, 1.1 * d, 0, 0.005, 12),
                ),
                ("nut", hexagon(1.6 * d, 0.006, 0.006 + 0.85 * d, d / 2, 10)),
                ("nut", hexagon(1.6 * d, 0.006 + 0.87 * d, 0.006 + 1.5 * d, d / 2, 10)),
            ]
            if style.fasteners != "pieces":
                solids = [("bolt", merge([s for _, s in solids]))]
            parts += [piece(moved(s, pose), n, "", "fastener", True) for n, s in solids]
    return Model(parts)


def _family(name: str, build: object, weight: float = 1.0) -> Family:
    return Family(name, "floor", GROUP, _G, build, (15,), "fitting", weight)  # type: ignore[arg-type]


GUSSETS: tuple[Family, ...] = (
    _family("gusset plate/truss node", _node),
    _family("gusset plate/bracing corner", _corner),
    _family("gusset plate/haunch", _haunch),
    _family("gusset plate/stiffener", _stiffened),
    _family("gusset plate/splice", _splice),
    _family("gusset plate/foot", _foot),
)
