"""Lines held by U-bolts, V-bolts and hook bolts on angles, channels, plates, posts and under beams."""

from __future__ import annotations

import numpy as np

from cadplants.families.supports.shape import (
    arc_yz,
    below,
    bow,
    carrier,
    few,
    footing,
    framed,
    nut_parts,
    overhead,
    piece,
    slab_yz,
    strap,
)
from cadplants.family import Family, Model, Part, placed
from cadplants.mesh_ops import extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle, section_angle, section_channel, section_i
from cadplants.primitives import along, bar, box, ring, rope
from cadplants.standards import PIPES
from cadplants.transforms import at, spun

__all__ = ["U_BOLTS"]


def _rod(r: float, rng: np.random.Generator) -> float:
    """Radius of the bar of a U-bolt for a pipe of this radius, M6 to M24 (DIN 3570) [m]."""
    sizes = (0.003, 0.004, 0.005, 0.006, 0.008, 0.010, 0.012)
    k = int(np.clip(round(r / 0.03), 0, 5)) + int(rng.integers(-1, 2))
    return sizes[int(np.clip(k, 0, 6))]


def _on_angle(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A round U-bolt (DIN 3570) through the level leg of an angle (EN 10056), with lock nuts above and below."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    leg, top = r + d / 2, -r
    thick = float(rng.choice([0.005, 0.006, 0.008]))
    side = max(0.04, 2.5 * d + float(rng.uniform(0.01, 0.03)))
    reach = leg + float(rng.uniform(0.04, 0.25))
    # The level leg lies under the line, the other one hangs down at its edge or stands up beside it.
    angle = section_angle(side, thick) @ np.diag([1.0, -1.0])
    angle = angle[::-1] - (0.55 * side, 0)
    solid = bar((0, -reach, top), (0, reach, top), angle if rng.random() < 0.5 else (angle * (-1, 1))[::-1])
    foot = top - thick - d * float(rng.uniform(2.0, 4.0))
    parts = [piece(bow(leg, foot, d / 2, style), "u-bolt", "u-bolt")]
    twice = bool(rng.random() < 0.4)
    parts += nut_parts([(0, s * leg, top - thick) for s in (-1, 1)], d, style, "u-bolt", rng.random() < 0.6, twice)
    if rng.random() < 0.3:
        upper = nut_parts([(0, s * leg, -top) for s in (-1, 1)], d, style, "u-bolt", False)
        parts += placed(upper, spun("x", np.pi))
    parts.append(framed(solid, str(rng.choice(["beam", "beam", "brace"]))))
    seed = int(rng.integers(1 << 30))
    for s in (-1, 1):
        y = s * (reach - 0.02)
        if s > 0 or rng.random() < 0.6:
            same = np.random.default_rng(seed)
            size = float(same.choice([0.05, 0.06, 0.08]))
            foot_parts, up = footing(size + 0.08, size, style, same)
            post = extrude(rounded_rectangle(size, size, 0.004, 1), up - height, top - side)
            parts += [framed(moved(post, at(0.03, y)), "post"), *placed(foot_parts, at(0.03, y, -height))]
    return Model(parts)


def _on_channel(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A U-bolt with four nuts over the back of a channel or through a strut, the line clear of it or on it."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    leg, deep = r + d / 2 + float(rng.choice([0.0, 0.0015])), float(rng.choice([0.041, 0.06, 0.08, 0.1]))
    reach, top, web = leg + float(rng.uniform(0.05, 0.3)), -r, 0.006
    wide = max(0.041, 3 * d)
    channel = section_channel(wide, deep, web, 0.006) @ np.array([[0.0, -1.0], [1.0, 0.0]])
    solid = bar((0, -reach, top), (0, reach, top), channel)
    parts = [piece(bow(leg, top - web - 3.2 * d, d / 2, style), "u-bolt", "u-bolt")]
    parts += nut_parts([(0, s * leg, top - web) for s in (-1, 1)], d, style, "u-bolt", True, rng.random() < 0.5)
    if rng.random() < 0.6:
        upper = nut_parts([(0, s * leg, -top) for s in (-1, 1)], d, style, "u-bolt", False)
        parts += placed(upper, spun("x", np.pi))
    parts.append(framed(solid, "beam"))
    return Model([*parts, *below(top - deep, height, reach - 0.03, style, rng)])


def _upright(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A U-bolt lying on its side that ties the line to a post, a column flange or a plate that stands beside it."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    leg = r + d / 2
    thick = float(rng.choice([0.006, 0.008, 0.01]))
    tall, wide = 2 * leg + 4 * d + float(rng.uniform(0.01, 0.08)), 0.05 + float(rng.uniform(0, 0.08))
    turn = spun("x", np.pi / 2)  # what hung down now points to +y
    holes = tuple(circle(0.55 * d, 8, (0, s * leg)) for s in (-1, 1)) if style.holes else ()
    plate = extrude(rounded_rectangle(wide, tall, float(rng.choice([0.0, 0.01])), 2), -r - thick, -r, holes)
    own = [piece(bow(leg, -r - thick - 2.5 * d, d / 2, style), "u-bolt", "u-bolt")]
    own += nut_parts([(0, s * leg, -r - thick) for s in (-1, 1)], d, style, "u-bolt", rng.random() < 0.7)
    kind = int(rng.integers(3))
    high = tall / 2 + float(rng.uniform(0.02, 0.6))
    size = 0.1
    if kind == 0:  # through the flange of a column
        column = moved(extrude(section_i(0.14, wide + 0.08, 0.007, thick), -height, high), at(0, r + 0.07))
        return Model([*placed(own, turn), framed(column, "column")])
    gap = 3.2 * d
    lug = [box((0.01 + 0.5 * wide, gap, 0.012), (0, r + thick + gap / 2, s * 0.5 * leg)) for s in (-1, 1)]
    parts = [*placed([*own, framed(plate, "plate")], turn), piece(merge(lug), "bracket", "", "steel")]
    y = r + thick + gap + size / 2
    if kind == 1:
        post = moved(extrude(rounded_rectangle(size, size, 0.006, 2), 0.012 - height, high), at(0, y))
        foot = moved(box((size + 0.1, size + 0.1, 0.012)), at(0, y, 0.006 - height))
        return Model([*parts, framed(post, "post"), framed(foot, "base plate")])
    wall = box((0.8, 0.2, height + high), (0, y - size / 2 + 0.1, (high - height) / 2))
    return Model([*parts, framed(wall, "wall", "concrete")])


def _square(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A square-bend U of round or flat bar as a guide over the line, with nuts or welded on, on a plate."""
    r = PIPES[dn].radius
    flat = bool(rng.random() < 0.4)
    d = 2 * _rod(r, rng)
    leg, crown = r + d / 2 + float(rng.choice([0.0, 0.003])), r + d / 2 + float(rng.choice([0.0, 0.003]))
    top, thick = -r, float(rng.choice([0.006, 0.01]))
    bend = min(0.9 * r, d)
    foot = top if flat else top - thick - 2.5 * d
    corner = arc_yz(bend, 0, np.pi / 2, 3, leg - bend, crown - bend)
    path = np.vstack([[[0, leg, foot]], corner, (corner * (1, -1, 1))[::-1], [[0, -leg, foot]]])
    body = strap(path, max(0.02, 2.5 * d), d) if flat else rope(path, d / 2, few(d / 2, style))
    side = 2 * leg + 5 * d + 0.02
    parts = [piece(body, "u-bolt", "u-bolt")]
    if not flat:
        parts += nut_parts([(0, s * leg, top - thick) for s in (-1, 1)], d, style, "u-bolt")
    if rng.random() < 0.5:
        plate = box((max(0.06, 4 * d), side, thick), (0, 0, top - thick / 2))
        parts.append(framed(plate, "plate"))
        gap = 0.0 if flat else 3.0 * d
        if gap:
            rib = [box((0.008, 2 * leg - 3 * d, gap), (x, 0, top - thick - gap / 2)) for x in (-0.015, 0.015)]
            parts.append(piece(merge(rib), "bracket", "u-bolt", "steel"))
        return Model([*parts, *below(top - thick - gap, height, leg + 2 * d, style, rng)])
    size = 0.06 + 2 * d
    reach = leg + 0.1
    channel = section_channel(size, size, thick, 0.006) @ np.array([[0.0, -1.0], [1.0, 0.0]])
    parts.append(framed(bar((0, -reach, top), (0, reach, top), channel), "beam"))
    return Model([*parts, *below(top - size, height, leg, style, rng)])


def _saddled(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """An exhaust-type clamp: a U-bolt with a cast V or round saddle bridge that presses the line on a post or mast."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    leg, deep = r + d / 2, 0.5 * r + 2 * d
    wide = max(2.2 * d, 0.03)
    ends = leg + 1.2 * d
    if rng.random() < 0.5:  # a V with flat flanks
        hollow = [[0.75 * r, -0.25 * r], [0.3 * r, -r], [-0.3 * r, -r], [-0.75 * r, -0.25 * r]]
    else:
        a = np.linspace(-0.12 * np.pi, -0.88 * np.pi, 9)
        hollow = np.column_stack([r * np.cos(a), r * np.sin(a)]).tolist()
    z = hollow[0][1]
    floor = -r - 0.6 * d - 0.004
    brim = hollow[0][0] + 0.4 * d
    lower = [[-ends, floor + d], [-ends, floor], [ends, floor], [ends, floor + d]]
    outline = [[brim, z], *hollow, [-brim, z], *lower]
    saddle = slab_yz(outline, -wide / 2, wide / 2)
    parts = [
        piece(bow(leg, floor - 2.5 * d, d / 2, style), "u-bolt", "u-bolt"),
        piece(saddle, "clamp", "u-bolt", "steel"),
        *nut_parts([(0, s * leg, floor) for s in (-1, 1)], d, style, "u-bolt", rng.random() < 0.5),
    ]
    # The bridge is welded on a short plate, or two masts cross.
    neck = deep
    plate = box((0.8 * wide, 2 * (leg - 1.2 * d), neck), (0, 0, floor - neck / 2))
    parts.append(framed(plate, "plate"))
    return Model([*parts, *below(floor - neck, height, leg, style, rng)])


def _lined(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A light U-bolt in a plastic sleeve with a plastic pad under the line (low friction, cold or galvanic lines)."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    coat = float(rng.uniform(0.0015, 0.004))
    leg = r + coat + d / 2
    pad = float(rng.uniform(0.004, 0.012))
    top, thick = -r - pad, 0.008
    sleeve = bow(leg, -0.6 * r, d / 2 + coat, style)
    parts = [
        piece(bow(leg, top - thick - 3 * d, d / 2, style), "u-bolt", "u-bolt"),
        piece(sleeve, str(rng.choice(["u-bolt", "clamp"])), "u-bolt", "rubber"),
        *nut_parts([(0, s * leg, top - thick) for s in (-1, 1)], d, style, "u-bolt", True, rng.random() < 0.5),
    ]
    wide = max(0.04, 3 * d)
    if rng.random() < 0.5:
        a = np.linspace(1.25 * np.pi, 1.75 * np.pi, 7)
        hollow = np.column_stack([r * np.cos(a), r * np.sin(a)]).tolist()
        half = max(0.75 * r, leg - d)
        rim = [[-half, top], [half, top], [half, hollow[-1][1]], *hollow[::-1], [-half, hollow[0][1]]]
        cushion = slab_yz(rim, -wide / 2, wide / 2)
    else:
        cushion = box((wide, 2 * (leg - d), pad), (0, 0, top + pad / 2))
    parts.append(framed(cushion, "plate", "rubber"))
    reach, size = leg + float(rng.uniform(0.06, 0.2)), float(rng.choice([0.06, 0.08, 0.1]))
    outline = section_i(size, max(0.06, 5 * d), 0.005, thick)
    parts.append(framed(bar((0, -reach, top - size / 2), (0, reach, top - size / 2), outline), "beam"))
    return Model([*parts, *below(top - size, height, leg, style, rng)])


def _v_bolt(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A V-bolt: straight flanks that run together to a round crown, through a plate or the flange of a beam."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    lean = float(rng.uniform(0.25, 0.6))  # of a flank from the upright, in radians
    reach = r + d / 2
    crown = arc_yz(reach, lean, np.pi - lean, 6)
    top, thick = -r, float(rng.choice([0.006, 0.01]))
    slope = np.array([0.0, np.sin(lean), -np.cos(lean)])
    knee = crown[0] + slope * (crown[0][2] - top - 0.4 * d) / np.cos(lean)
    leg = float(knee[1])
    foot = top - thick - 2.5 * d
    path = np.vstack([[[0, leg, foot], knee], crown, [knee * (1, -1, 1), [0, -leg, foot]]])
    parts = [
        piece(rope(path, d / 2, few(d / 2, style)), "u-bolt", "u-bolt"),
        *nut_parts([(0, s * leg, top - thick) for s in (-1, 1)], d, style, "u-bolt", rng.random() < 0.7),
    ]
    wide, size = max(0.05, 4 * d), 0.05 + 3 * d
    if rng.random() < 0.5:
        parts.append(framed(box((wide, 2 * leg + 5 * d, thick), (0, 0, top - thick / 2)), "plate"))
        web = box((0.008, 2 * leg - 4 * d, size), (0, 0, top - thick - size / 2))
        parts.append(piece(web, "bracket", "", "steel"))
        return Model([*parts, *below(top - thick - size, height, leg, style, rng)])
    beam = bar((0, -leg - 0.15, top - size / 2), (0, leg + 0.15, top - size / 2), section_i(size, wide, 0.006, thick))
    return Model([*parts, framed(beam, "beam"), *below(top - size, height, leg, style, rng)])


def _j_bolt(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """Hook bolts: one J that grips the line with one nut, or a pair of them opposite, on an angle or a plate."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    leg, top, thick = r + d / 2, -r, float(rng.choice([0.006, 0.008]))
    steps = max(6, few(leg, style, 20) // 2)
    over = float(rng.uniform(0.75, 1.1)) * np.pi
    path = np.vstack([[[0, leg, top - thick - 2.6 * d]], arc_yz(leg, 0, over, steps)])
    hook = rope(path, d / 2, few(d / 2, style))
    pair = bool(rng.random() < 0.4)
    shift = 1.5 * d if pair else 0.0
    solids = [moved(hook, at(shift)), *([moved(hook, at(-shift) @ spun("z", np.pi))] if pair else [])]
    parts: list[Part] = [piece(s, "u-bolt", "u-bolt") for s in solids]
    spots = [(shift, leg, top - thick), *([(-shift, -leg, top - thick)] if pair else [])]
    parts += nut_parts(spots, d, style, "u-bolt", True, rng.random() < 0.4)
    size = float(rng.choice([0.05, 0.06, 0.075])) + d
    reach = leg + 3 * d + float(rng.uniform(0.02, 0.2))
    angle = (section_angle(size + 2 * shift, thick) @ np.diag([1.0, -1.0]))[::-1] - (0.5 * size + shift, 0)
    parts.append(framed(bar((0, -reach, top), (0, reach, top), angle), "beam"))
    deep = size + 2 * shift
    if rng.random() < 0.5:  # welded on the front of a column
        column = extrude(section_i(0.12, 0.12, 0.006, 0.009), -height, top + 0.3)
        return Model([*parts, framed(moved(column, at(0, reach + 0.06)), "column")])
    return Model([*parts, *below(top - deep, height, reach - 0.03, style, rng)])


def _hung(dn: int, style: ModelingStyle, rng: np.random.Generator, height: float) -> Model:
    """A long U-bolt as a hanger: its bow under the line, its legs up through an angle, a channel or a flange above."""
    r = PIPES[dn].radius
    d = 2 * _rod(r, rng)
    leg = r + d / 2 + float(rng.choice([0.0, 0.0, 0.004]))
    high = r + float(rng.choice([0.0, 0.0, 0.05, 0.15])) * float(rng.uniform(0.6, 1.4))
    thick = 0.008
    flip = spun("x", np.pi)
    parts = placed(
        [
            piece(bow(leg, -high - thick - 2.5 * d, d / 2, style), "u-bolt", "u-bolt"),
            *nut_parts([(0, s * leg, -high - thick) for s in (-1, 1)], d, style, "u-bolt", True, rng.random() < 0.5),
        ],
        flip,
    )
    if rng.random() < 0.4:
        parts.append(piece(along("x", ring(r, r + 0.0015, -2 * d, 2 * d, max(12, style.round(r)))), "clamp", "u-bolt"))
    reach, size = leg + float(rng.uniform(0.1, 0.35)), 0.05 + 3 * d
    kind = int(rng.integers(3))
    if kind == 0:
        outline = section_angle(size, thick) - (0.5 * size, 0)
    elif kind == 1:
        outline = section_channel(max(0.05, 4 * d), size, thick, 0.006) @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    else:
        outline = section_i(1.6 * size, max(0.06, 5 * d), 0.006, thick) + np.array([0.0, 0.8 * size])
    parts.append(framed(bar((0, -reach, high), (0, reach, high), outline), "beam"))
    deep = float(outline[:, 1].max())
    if rng.random() < 0.5:
        return Model([*parts, *overhead(high + deep, height, reach - 0.1, style, rng)])
    posts = [
        moved(extrude(rounded_rectangle(0.06, 0.06, 0.005, 2), -height, high), at(0, s * (reach - 0.03)))
        for s in (-1, 1)
    ]
    return Model([*parts, *(framed(p, "post") for p in posts)])


U_BOLTS: tuple[Family, ...] = (
    carrier("u-bolt/angle", _on_angle),
    carrier("u-bolt/channel", _on_channel),
    carrier("u-bolt/upright", _upright),
    carrier("u-bolt/square", _square),
    carrier("u-bolt/saddle", _saddled),
    carrier("u-bolt/lined", _lined),
    carrier("u-bolt/v-bolt", _v_bolt),
    carrier("u-bolt/hook", _j_bolt),
    carrier("u-bolt/hung", _hung),
)
