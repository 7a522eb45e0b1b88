"""Cameras and signs on walls, posts and beams."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.families.chance import pick
from cadplants.families.utilities.mounting import FRAME, GROUP, JOINT, back, beam_over, pole, wall
from cadplants.family import Family, Model, Part
from cadplants.mesh_ops import Solid, about_x, extrude, merge, moved
from cadplants.modeling_style import ModelingStyle
from cadplants.polygon import circle, rounded_rectangle
from cadplants.primitives import along, around, ball, box, cylinder, dome, ring, rod, rope, turned
from cadplants.transforms import at, spun

__all__ = ["VIEWS"]

_C, _S = "camera", "sign"


def _cameras(_: int, style: ModelingStyle, rng: np.random.Generator, kind: str) -> Model:
    """A camera: bullet on a bracket, dome under an arm, swivelling on a gooseneck, or in a housing."""
    z, s, n = float(rng.uniform(1.9, 3.2)), float(rng.uniform(0.8, 1.4)), style.round(0.05)
    parts: list[tuple[Solid, str]] = []
    if kind == "bullet":
        r, long, y = 0.032 * s, float(rng.uniform(0.12, 0.22)) * s, -0.14
        shape = along("-y", turned([(0.6 * r, -0.02), (r, 0), (r, long), (0.85 * r, long + 0.004)], n))
        face = along(
            "-y",
            merge(
                [
                    cylinder(0.35 * r, long, long + 0.01, n),
                    around(cylinder(0.1 * r, long, long + 0.006, 8), 6, 0.65 * r),
                ]
            ),
        )
        shield = (
            box((2.3 * r, long + 0.04, 0.004), (0, -long / 2 - 0.01, 1.04 * r))
            if rng.random() < 0.5
            else cylinder(0.2 * r, 0, r, 8)
        )
        pose = at(0, y, z) @ spun("x", float(rng.uniform(0.0, 0.5))) @ spun("z", float(rng.uniform(-0.3, 0.3)))
        arm = [
            along("-y", cylinder(0.045 * s, 0, 0.025, n), 0, 0, z),
            rope([(0, -0.02, z), (0, -0.09, z), (0, y + 0.004, z)], 0.014, 8),
            moved(ball(0.024, 10), at(0, y + 0.03, z)),
        ]
        parts = [(moved(merge([shape, shield]), pose), "dial"), (moved(face, pose), "rubber"), (merge(arm), "dial")]
    elif kind == "dome":
        r, y = 0.06 * s, -float(rng.uniform(0.14, 0.3))
        cap = turned([(r, -0.03), (r, 0.0), (0.9 * r, 0.03), (0.4 * r, 0.05)], n)
        glass = moved(dome(0.85 * r, 0.85 * r, 0.0, n), at(0, 0, -0.03) @ spun("x", np.pi))
        stalk = rope([(0, -0.01, z + 0.1), (0, y - 0.0, z + 0.12), (0, y, z + 0.045)], 0.016, 8)
        foot = box((0.1, 0.012, 0.14), (0, -0.006, z + 0.08))
        pose = at(0, y, z)
        parts = [(moved(cap, pose), "dial"), (moved(glass, pose), "rubber"), (merge([stalk, foot]), "dial")]
    elif kind == "swivel":
        r, y = 0.06 * s, -float(rng.uniform(0.3, 0.5))
        neck = turned([(0.9 * r, -1.2 * r), (r, -1.1 * r), (r, 0.4 * r), (0.4 * r, 0.8 * r)], n)
        head = moved(ball(0.85 * r, max(10, n // 2)), at(0, 0, -1.7 * r))
        lens = moved(cylinder(0.3 * r, 0.0, 0.9 * r, 12), at(0, 0, -1.7 * r) @ spun("x", 0.3 + np.pi / 2))
        goose = [
            (0, -0.01, z - 0.1),
            (0, -0.3 * abs(y), z + 0.1),
            (0, y + 0.06, z + 0.16),
            (0, y, z + 0.14),
            (0, y, z + 0.03),
        ]
        stay = [
            box((0.12, 0.03, 0.2), (0, -0.015, z - 0.08)),
            rod((0, -0.02, z - 0.15), (0, -0.5 * abs(y), z + 0.1), 0.01, 8),
        ]
        parts = [
            (moved(merge([neck, head]), at(0, y, z)), "dial"),
            (moved(lens, at(0, y, z)), "rubber"),
            (merge([rope(goose, 0.02, 8), *stay]), "dial"),
        ]
    else:
        w, long, y = 0.1 * s, float(rng.uniform(0.28, 0.42)) * s, -0.12
        body = about_x(extrude(rounded_rectangle(w, 0.9 * w, 0.15 * w, 3), 0, long))
        body = moved(body, spun("z", -np.pi / 2))
        roof = box((1.25 * w, long + 0.08, 0.005), (0, -long / 2 - 0.02, 0.5 * w))
        glass = box((0.8 * w, 0.006, 0.7 * w), (0, -long - 0.002, 0))
        pose = at(0, y, z) @ spun("x", float(rng.uniform(0.05, 0.4)))
        shelf = [
            rope([(0, 0.0, z - 0.22), (0, y - 0.1, z - 0.16), (0, y - 0.12, z - 0.05)], 0.018, 8),
            box((0.1, 0.012, 0.12), (0, -0.006, z - 0.2)),
            box((0.07, 0.1, 0.03 + 0.1 * s), (0, y - 0.12, z - 0.06)),
        ]
        parts = [
            (moved(merge([body, roof]), pose), "electrical"),
            (moved(glass, pose), "rubber"),
            (merge(shelf), "clamp"),
        ]
    more = []
    if rng.random() < 0.5:
        box_ = box((0.12, 0.06, 0.12), (0, -0.03, z - 0.45))
        more = [
            Part(box_, "junction box", "electrical"),
            Part(rope([(0, -0.03, z - 0.4), (0, -0.03, z - 0.1)], 0.006, 6), "cable", "rubber"),
        ]
    return Model([*(Part(x, _C, c, _C) for x, c in parts), *more, *back(z + 0.4, style, rng)])


def _bullet(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A bullet camera on a bracket."""
    return _cameras(dn, style, rng, "bullet")


def _dome_camera(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A dome camera under an arm."""
    return _cameras(dn, style, rng, "dome")


def _swivel(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A pan-tilt-zoom camera on a gooseneck."""
    return _cameras(dn, style, rng, "swivel")


def _housed(dn: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """A camera in a weatherproof housing with a sun roof."""
    return _cameras(dn, style, rng, "housing")


# --- signs ---


def _plate(kind: str, s: float, style: ModelingStyle) -> Floats:
    """The outline of a sign of a shape, about its middle."""
    if kind == "rectangle":
        return rounded_rectangle(2 * s, 1.4 * s, 0.1 * s, 3)
    if kind == "tall":
        return rounded_rectangle(1.2 * s, 1.8 * s, 0.08 * s, 3)
    if kind == "round":
        return circle(s, max(12, style.round(s)))
    if kind == "diamond":
        turned_: Floats = rounded_rectangle(1.5 * s, 1.5 * s, 0.1 * s, 3) @ np.array(
            [[0.7071, 0.7071], [-0.7071, 0.7071]]
        )
        return turned_
    if kind == "arrow":
        return np.array([(-s, -0.4 * s), (0.6 * s, -0.4 * s), (1.1 * s, 0), (0.6 * s, 0.4 * s), (-s, 0.4 * s)])
    return circle(s, 3 if kind == "triangle" else 8, phase=np.pi / 2 if kind == "triangle" else np.pi / 8)


def _mounted(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Safety signs (ISO 7010): on a wall, screwed; as a flag off it; hung from a beam on chains; between two posts."""
    kind, s, z = (
        pick(rng, "wall", "flag", "hung", "two posts"),
        float(rng.uniform(0.1, 0.4)),
        float(rng.uniform(1.3, 2.2)),
    )
    front = spun("x", np.pi / 2)
    t = float(rng.choice([0.002, 0.004, 0.012]))
    if kind == "wall":
        parts = []
        for k in range(int(rng.integers(1, 5))):
            outline = _plate(pick(rng, "rectangle", "tall", "round", "triangle", "diamond", "arrow"), s, style)
            pose = at(k * 2.5 * s, -0.001, z) @ front
            parts.append(Part(moved(extrude(outline, 0, t), pose), _S, "safety", _S))
            if rng.random() < 0.4:
                parts.append(Part(moved(extrude(0.75 * outline, t, t + 0.001), pose), _S, "dial", _S))
        return Model([*parts, wall(-2 * s - 0.2, 9 * s, z + 2 * s + 0.3)])
    if kind == "flag":
        w = 1.4 * s
        sheet = box((t, 2 * s, w), (0, -s - 0.02, z))
        fold = box((0.06, 0.004, w), (0.03, -0.002, z))
        neck = box((t, 0.02, w), (0, -0.01, z))
        return Model([Part(merge([sheet, fold, neck]), _S, "safety", _S), *back(z + s + 0.3, style, rng)])
    if kind == "hung":
        w, h = 2.6 * s, 1.0 * s
        drop = float(rng.uniform(0.2, 0.6))
        sheet = box((w, t, h), (0, 0, z + 0.6))
        chains = [
            rod((q * 0.42 * w, 0, z + 0.6 + h / 2 - 0.01), (q * 0.42 * w, 0, z + 0.6 + h / 2 + drop), 0.004, 6)
            for q in (-1, 1)
        ]
        return Model(
            [
                Part(sheet, _S, "safety", _S),
                *(Part(c, "pipe hanger", "clamp", "", JOINT) for c in chains),
                *beam_over(-w, w, z + 0.6 + h / 2 + drop - 0.001),
            ]
        )
    w = 5 * s
    sheet = box((w, 0.003, 0.6 * w), (0, -0.0015, z))
    rails = [box((0.96 * w, 0.03, 0.04), (0, 0.015, z + q * 0.2 * w)) for q in (-1, 1)]
    posts = []
    for q in (-1, 1):
        r = 0.03
        posts += [
            Part(moved(p.solid, at(q * 0.36 * w, 0.03 + r)), p.name, p.color, "", p.group, p.fine)
            for p in pole(z + 0.35 * w, r, style)
        ]
    return Model([Part(sheet, _S, "safety", _S), Part(merge(rails), "bracket", "clamp", "", JOINT), *posts])


def _marker(_: int, style: ModelingStyle, rng: np.random.Generator) -> Model:
    """Small plates: tags with arrows strapped to a pipe, a tag on a chain, name plates on legs, markers on stakes."""
    r, long, z = float(rng.uniform(0.03, 0.12)), float(rng.uniform(1.0, 2.0)), float(rng.uniform(0.6, 1.4))
    if rng.random() < 0.5:
        n = style.round(r)
        parts = [Part(along("x", cylinder(r, -long / 2, long / 2, n), 0, 0, z), "pipe", "pipe", "", "Pipe assembly")]
        for k in range(int(rng.integers(1, 4))):
            x, w = (k - 1) * 0.3 * long, float(rng.uniform(0.12, 0.3))
            h = min(1.2 * r, 0.1)
            tag = moved(
                extrude(_plate("arrow", w / 2, style) * (1, 2.5 * h / w), 0, 0.002),
                at(x, -r - 0.006, z) @ spun("x", np.pi / 2),
            )
            bands = [along("x", ring(r, r + 0.0015, -0.006, 0.006, n), x + q * 0.35 * w, 0, z) for q in (-1, 1)]
            pad = box((0.8 * w, 0.007 + 0.12 * r, 0.4 * h), (x, -r - 0.003 + 0.06 * r, z))
            parts += [Part(merge([tag, pad]), _S, "dial", _S), *(Part(b, "clamp", "clamp", "", JOINT) for b in bands)]
        parts += [
            Part(
                merge(
                    [
                        box((0.06, 0.06, z - r), (q * 0.4 * long, 0, (z - r) / 2)),
                        box((0.14, 0.14, 0.01), (q * 0.4 * long, 0, 0.005)),
                    ]
                ),
                "post",
                "steel",
                "",
                FRAME,
            )
            for q in (-1, 1)
        ]
        return Model(parts)
    parts = []
    for k in range(int(rng.integers(1, 4))):
        h, w = float(rng.uniform(0.5, 1.2)), float(rng.uniform(0.06, 0.16))
        tilt = float(rng.choice([0.0, 0.5]))
        pose = at(0.5 * k, -0.02, h) @ spun("x", -tilt) @ spun("x", np.pi / 2)
        parts.append(
            Part(moved(extrude(rounded_rectangle(2 * w, 1.2 * w, 0.1 * w, 2), -0.02, 0.004), pose), _S, "dial", _S)
        )
        parts.append(Part(moved(box((0.03, 0.03, h)), at(0.5 * k, 0, h / 2)), "post", "clamp", "", FRAME))
    return Model(parts)


VIEWS: tuple[Family, ...] = tuple(
    Family(name, "floor", GROUP, name.split("/")[0], build, (15,), "fitting" if name[0] == "s" else "structure", weight)
    for name, build, weight in (
        ("camera/bullet", _bullet, 1.0),
        ("camera/dome", _dome_camera, 1.0),
        ("camera/swivelling", _swivel, 1.0),
        ("camera/housed", _housed, 1.0),
        ("sign/mounted", _mounted, 1.5),
        ("sign/marker", _marker, 1.2),
    )
)
