"""What an engineer would say at a glance: bores that open, wheels that turn, bolts that reach, weights that can be."""

from dataclasses import replace

import numpy as np
import pytest

from cadgraph.geometry.contact.pairs import distances
from cadgraph.model.scene import Scene
from cadplants import make
from cadplants.families.lookalikes.lookalike import LOOKALIKES
from cadplants.families.primitive.primitive import PRIMITIVES
from cadplants.model.family import as_assembly
from cadplants.parts.flange import flange
from cadplants.presets.taste import ALL_FAMILIES
from cadplants.styles.modeling_style import STYLES
from plants.solids import shell_volumes, shells

STYLE = replace(STYLES["mechanical"], sides=(12, 16))
CRUDE = {*LOOKALIKES, *PRIMITIVES, "valve/cones or cylinder"}
"""What is drawn as others draw in a hurry: of plain solids."""
INSIDE = {"valve disc", "valve ball", "valve stem", "gasket", "impeller", "thermowell"}
BODIES = {"valve body", "valve bonnet", "flange", "blind flange", "pipe", "actuator", "gearbox"}
CLEAR = 0.002
"""What a wheel's rim keeps from everything that doesn't turn with it, at least [m]."""
STEEL = 7850  # kg/m3

# Usual figures of manufacturers for class 150 or PN 16 with operator, rounded [kg].
WEIGHTS = {
    ("gate valve/os&y", 50): 19,
    ("gate valve/os&y", 100): 50,
    ("gate valve/os&y", 200): 135,
    ("globe valve/sphere", 50): 22,
    ("globe valve/sphere", 100): 60,
    ("globe valve/sphere", 200): 200,
    ("check valve/swing", 50): 15,
    ("check valve/swing", 100): 40,
    ("check valve/swing", 200): 115,
    ("ball valve/two-piece", 50): 10,
    ("ball valve/two-piece", 100): 30,
    ("ball valve/two-piece", 200): 110,
    ("butterfly valve/wafer lever", 50): 3.0,
    ("butterfly valve/wafer lever", 100): 5.5,
    ("butterfly valve/wafer lever", 200): 16,
    ("strainer/Y flanged", 50): 12,
    ("strainer/Y flanged", 100): 36,
    ("strainer/Y flanged", 200): 130,
    ("tee/butt weld", 50): 1.4,
    ("tee/butt weld", 100): 5.5,
    ("tee/butt weld", 200): 23,
    ("blind flange/disc", 50): 2.6,
    ("blind flange/disc", 100): 7.5,
    ("blind flange/disc", 200): 21,
}
# ASME B16.5 class 150, welding neck, as in the tables of manufacturers [kg].
FLANGE_WEIGHTS = {25: 1.1, 50: 2.7, 80: 5.2, 100: 7.3, 150: 11.0, 200: 18.0}


def components(family, seed, dn=None):
    """What a family builds, each mesh in place."""
    rng, dn = np.random.default_rng(seed), dn or family.sizes[len(family.sizes) // 2]
    built = family.build(dn, STYLE, rng, 1.1) if family.place == "carrier" else family.build(dn, STYLE, rng)
    return as_assembly(family, built, STYLE, "X-1").components


def met_by(origin, direction, solid):
    """How far from a point a straight line meets a solid, ascending [m]."""
    a, b, c = np.moveaxis(np.asarray(solid.vertices)[solid.faces], 1, 0)
    across = np.cross(direction, c - a)
    slope = np.einsum("ij,ij->i", b - a, across)
    with np.errstate(divide="ignore", invalid="ignore"):
        u = np.einsum("ij,ij->i", origin - a, across) / slope
        turned = np.cross(origin - a, b - a)
        v, far = turned @ direction / slope, np.einsum("ij,ij->i", c - a, turned) / slope
        met = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9)
    return np.sort(far[met])


def closed_ends(family, seed):
    """How many ends of a device in a line are walls: less than a twentieth of its size open behind the face."""
    outside = [c for c in components(family, seed) if c.name not in INSIDE]
    along = np.concatenate([c.vertices[:, 0] for c in outside])
    deep = 0.05 * family.sizes[len(family.sizes) // 2] / 1000
    count = 0
    for end, way in ((along.min(), 1.0), (along.max(), -1.0)):
        start = np.array([end - way, 1.0e-4, 1.3e-4])  # off the axis, where triangles have a corner in common
        count += any((met_by(start, np.array([way, 0, 0]), c)[:1] - 1.0 < deep).any() for c in outside)
    return count


@pytest.mark.slow
def test_the_bore_of_what_sits_in_a_line_is_open_at_both_ends():
    inline = [
        family
        for family in ALL_FAMILIES.values()
        if family.place == "inline" and family.name not in CRUDE and not family.name.startswith("blind flange/")
    ]
    assert len(inline) > 200
    assert [(family.name, seed) for family in inline for seed in range(2) if closed_ends(family, seed)] == []


def rims(component):
    """The rim of a wheel, as a mesh of its own; nothing of a chain, which hangs where it likes."""
    flat = component.vertices - component.vertices.mean(axis=0)
    axes = np.linalg.svd(flat, full_matrices=False)[2]
    extent = np.ptp(flat @ axes.T, axis=0)
    across = np.delete(flat @ axes.T, extent.argmin(), axis=1)
    across -= (across.min(axis=0) + across.max(axis=0)) / 2
    if extent.max() > 1.5 * np.sort(extent)[1]:
        return []
    corners = across[component.faces]
    points = np.concatenate([corners, (corners + np.roll(corners, 1, axis=1)) / 2], axis=1)
    kept = (np.linalg.norm(points, axis=2) > 0.6 * np.linalg.norm(across, axis=1).max()).all(axis=1)
    return [(component.vertices, component.faces[kept])] if kept.any() else []


def least_room(parts):
    """The least distance of a wheel's rim from a body [m], infinite where there is no wheel or no body."""
    bodies = [(c.vertices, c.faces) for c in parts if c.name in BODIES]
    wheels = [rim for c in parts if c.name == "handwheel" for rim in rims(c)]
    if not bodies or not wheels:
        return np.inf
    pairs = [(k, len(wheels) + j) for k in range(len(wheels)) for j in range(len(bodies))]
    return float(distances(Scene.from_meshes([*wheels, *bodies]), pairs)[0].min())


@pytest.mark.slow
def test_wheels_clear_what_they_turn_beside():
    valves = [
        family
        for family in ALL_FAMILIES.values()
        if family.group in ("Valve assembly", "Electrical and safety") and family.name not in CRUDE
    ]
    room = {(family.name, seed): least_room(components(family, seed)) for family in valves for seed in range(3)}
    assert sum(np.isfinite(one) for one in room.values()) > 100
    assert {name: one for name, one in room.items() if one < CLEAR} == {}


def bolts_of(component):
    """Each bolt of a mesh: its direction, ``(2, 3)`` across it, where it stands across, from, to, and its radius."""
    pieces = shells(component)
    longest = max(pieces, key=lambda p: np.ptp(p, axis=0).max())
    basis = np.linalg.svd(longest - longest.mean(axis=0), full_matrices=False)[2]
    way, across = basis[0], basis[1:]
    groups = []
    for piece in pieces:
        flat = piece @ across.T
        middle = (flat.min(axis=0) + flat.max(axis=0)) / 2
        group = next((g for g in groups if np.linalg.norm(g[0] - middle) < 0.004), None)
        if group is None:
            groups.append((middle, [piece]))
        else:
            group[1].append(piece)
    for middle, found in groups:
        points = np.concatenate(found)
        wide = np.linalg.norm(points @ across.T - middle, axis=1)
        yield way, across, middle, (points @ way).min(), (points @ way).max(), wide[wide > 0.25 * wide.max()].min()


def short_bolts(parts):
    """How many bolts there are through flanges, and how many of them end inside."""
    plates = [c for c in parts if c.name in ("flange", "blind flange")]
    lows, highs = ([f(c.vertices, axis=0) for c in plates] for f in (np.min, np.max))
    through = short = 0
    for component in parts:
        if component.name not in ("bolt", "stud"):
            continue
        for way, across, middle, low, high, radius in bolts_of(component):
            center = middle @ across + way * (low + high) / 2
            metal = []
            for plate, least, most in zip(plates, lows, highs, strict=True):
                if (center < least - 0.05).any() or (center > most + 0.05).any():
                    continue
                for angle in np.arange(6) * np.pi / 3 + 0.2:
                    beside = 1.6 * radius * np.array([np.cos(angle), np.sin(angle)])  # under its nut, beyond its hole
                    far = met_by((middle + beside) @ across - 10 * way, way, plate) - 10
                    metal += [far[[0, -1]]] if len(far) and far[-1] > low and far[0] < high else []
            if metal:
                through += 1
                short += bool(low > np.min(metal) + 1e-4 or high < np.max(metal) - 1e-4)
    return through, short


def test_bolts_reach_through_the_flanges_that_they_hold():
    through, short = short_bolts(make("skid", 0, "mechanical").components)
    assert through > 80
    assert short == 0


def shortened(solid):
    """The same bolt, a third as long."""
    extent = np.ptp(solid.vertices, axis=0)
    size, middle = np.where(extent == extent.max(), 0.33, 1.0), solid.vertices.mean(axis=0)
    return replace(solid, vertices=middle + size * (solid.vertices - middle))


def test_bolts_that_are_too_short_are_found():
    parts = make("skid", 0, "mechanical").components
    through, short = short_bolts([replace(c, solid=shortened(c.solid)) if c.name == "stud" else c for c in parts])
    assert short == through > 80


def weight(solids):
    return sum(float(shell_volumes(solid).sum()) for solid in solids) * STEEL


@pytest.mark.slow
def test_weights_are_within_a_factor_of_three_of_those_in_catalogues():
    ratio = {
        (name, dn): weight([c.solid for c in components(ALL_FAMILIES[name], seed, dn) if c.name != "gasket"]) / known
        for (name, dn), known in WEIGHTS.items()
        for seed in range(2)
    }
    assert {key: round(one, 2) for key, one in ratio.items() if not 1 / 3 < one < 3} == {}


def test_flanges_weigh_what_the_tables_say():
    style = STYLES["mechanical"]
    made = {dn: [c.solid for c in flange(dn, style).components if c.name == "flange"] for dn in FLANGE_WEIGHTS}
    ratio = {dn: weight(made[dn]) / known for dn, known in FLANGE_WEIGHTS.items()}
    assert {dn: round(one, 2) for dn, one in ratio.items() if not 0.7 < one < 1.4} == {}
