"""The built-in labeler: rules on geometry that name what they are sure of and leave the rest alone.

First each part's shape allows some forms (``forms``); then contacts decide, rule by rule in the order of ``_RULES``:
fasteners and piping first, then what is left between pipe ends is a valve, and what ends on a stem is a gauge. No
source name, colour or direction of gravity counts.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from cadgraph.parts import Contacts, Label, Parts
from cadgraph.scene import Floats
from cadgraph.stages.label.context import Context, offset, parallel
from cadgraph.stages.label.facts import Disc, Facts, angles_about, same_line
from cadgraph.stages.label.forms import BOLT, CASE, WHEEL
from cadgraph.vocabulary import Vocabulary

__all__ = ["GeometryLabeler"]

PIPE, VALVE, GAUGE = "Pipe assembly", "Valve assembly", "Gauge assembly"
FASTENER, STRUCTURE = "Connection assembly", "Structural element"

# Sizes [m], and ratios
MAX_ROD = 0.020  # a solid rod thinner than DN15 (21.3 mm) may be a stem
MAX_PIPE = 0.62  # wider (DN600 has 610 mm) and short is as likely the shell of a vessel
MAX_BASE = 0.6  # a larger plate under a post is a deck
FLANGE_PIPE = (1.2, 4.7)  # flange over pipe: ASME B16.5 4.2 (DN15 class 150), 1.5 (DN300)
STEM_CASE = 0.5  # greatest width of a stem over the case that it carries: 22 mm flats under 63 mm
MAX_OPENING = 200.0  # degrees that what holds a pipe may leave open: a U-bolt leaves 180


def _mm(length: float) -> str:
    return f"{1000 * length:.0f} mm"


def _fasteners(c: Context) -> None:
    """Three or more of one shape, parallel, on a circle about a port: bolts, studs, nuts."""
    for part, f in enumerate(c.facts):
        small = [j for j in c.near[part] if c.forms[j].pin or c.forms[j].nut or c.forms[j].washer]
        for shape in sorted({int(c.parts.shape[j]) for j in small}):
            same = [j for j in small if c.parts.shape[j] == shape]
            for port in f.ports if len(same) >= 3 else ():
                radii = [offset(c.facts[j].center, port) for j in same if parallel(c.facts[j].axis, port.normal)]
                middle = float(np.median(radii)) if len(radii) >= 3 else 0.0
                if middle > 1.2 * c.facts[same[0]].radius and np.ptp(radii) < 0.1 * middle:
                    g = c.facts[same[0]]
                    plain = g.outer.min() > 0.9 * g.outer.max()
                    kinds = c.forms[same[0]]
                    name = "nut" if kinds.nut else "washer" if kinds.washer else "stud" if plain else "bolt"
                    why = f"{len(same)} alike on a circle of {_mm(2 * middle)}, {_mm(g.length)} long"
                    for j in same:
                        c.say(j, FASTENER, name, 0.93, why)
                    break


def _stems(c: Context) -> None:
    """What a wheel or a lever may sit on is set aside before pipes are named: a rod in the wheel's axis."""
    for wheel, forms in enumerate(c.forms):
        if not forms.wheel:
            continue
        f = c.facts[wheel]
        for rod in c.near[wheel]:
            g = c.facts[rod]
            on_axis = same_line(f.center, f.axis, g.center, g.axis, 0.1 * f.radius)
            if on_axis and g.round and g.radius < 0.35 * f.radius and g.length > g.radius:
                why = f"wheel with {f.spokes} spokes, {_mm(2 * f.radius)}, on a rod of {_mm(2 * g.radius)}"
                c.say(wheel, VALVE, "handwheel", 0.8, why)
                c.say(rod, VALVE, "valve stem", 0.7, f"rod in the axis of a wheel of {_mm(2 * f.radius)}")


def _continues(c: Context, part: int, port: Disc) -> str:
    """What goes on beyond a port of a pipe or bend, in words; empty if nothing of piping does."""
    for other in c.mates(part, port):
        g, forms = c.facts[other], c.forms[other]
        if c.is_a(other, VALVE):
            continue
        if forms.tube or forms.bend:
            if 0.5 < g.ports[0].outer / port.outer < 2.0:
                return "bend" if forms.bend else "pipe"
        elif forms.flange and FLANGE_PIPE[0] < g.radius / port.outer < FLANGE_PIPE[1]:
            return "flange"
        elif any(
            0.8 < p.outer / port.outer < FLANGE_PIPE[1]
            and same_line(port.center, port.normal, p.center, p.normal, 0.005)
            for p, _ in c.run(other)
        ):
            return "device"
    return ""


def _pipes(c: Context) -> None:
    """Tubes that go on at an end; bends that do; long hollow tubes even alone."""
    for part, forms in enumerate(c.forms):
        f = c.facts[part]
        if not (forms.tube or forms.bend) or not c.free(part):
            continue
        ends = [word for word in (_continues(c, part, port) for port in f.ports) if word]
        width = 2 * f.ports[0].outer
        hollow = f.ports[0].inner > 0
        kind = f"{'hollow' if hollow else 'solid'} {'bend' if forms.bend else 'tube'}, {_mm(width)} across"
        why = f"{kind}, {_mm(f.tube)} long, " + (f"goes on in {' and '.join(ends)}" if ends else "alone")
        if (not hollow and width < MAX_ROD and "bend" not in ends) or (width > MAX_PIPE and f.tube < 6 * width):
            continue
        straight = f.tube > 4 * width or (not forms.bend)
        name = "pipe" if straight else "elbow"
        if f.tube < width and len(ends) < 2:
            continue  # rings, bosses, glands
        if set(ends) == {"device"} and f.tube < (1.0 if hollow else 3.0) * width:
            continue
        if ends:
            c.say(part, PIPE, name, (0.85, 0.95)[len(ends) - 1], why)
        elif hollow and f.tube > 3 * width:
            c.say(part, PIPE, name, 0.6 if forms.tube else 0.7, why)


def _flanges(c: Context) -> None:
    """Discs and hubbed rings on a narrower pipe, or bolted; rings between two of them are gaskets."""
    for part, forms in enumerate(c.forms):
        f = c.facts[part]
        if not forms.flange or not c.free(part):
            continue
        pipes = [
            j for port in f.ports for j in c.mates(part, port)
            if c.is_a(j, PIPE) and c.facts[j].ports and c.facts[j].tube
            and FLANGE_PIPE[0] < f.radius / c.facts[j].ports[0].outer < FLANGE_PIPE[1]
        ]  # fmt: skip
        bolted = sum(c.is_a(j, FASTENER) for j in c.near[part]) >= 3
        faces = [j for port in f.ports for j in c.mates(part, port) if c.forms[j].flange or c.forms[j].gasket]
        solid = all(port.inner == 0 for port in f.ports)
        kind = f"disc of {_mm(2 * f.radius)}"
        if pipes:
            why = f"{kind} on a pipe of {_mm(2 * c.facts[pipes[0]].ports[0].outer)}" + (", bolted" if bolted else "")
            c.say(part, PIPE, "flange", 0.95 if bolted or faces else 0.85, why)
        elif bolted and faces and solid:
            c.say(part, PIPE, "blind flange", 0.7, f"{kind}, closed, bolted to a flange")
    for part, forms in enumerate(c.forms):
        f = c.facts[part]
        if forms.gasket and len(f.ports) == 2:
            sides = [list(c.mates(part, port)) for port in f.ports]
            if all(sides) and any(c.is_a(j, PIPE) for side in sides for j in side):
                c.say(part, PIPE, "gasket", 0.9, f"ring {_mm(f.length)} thick between two faces, {_mm(2 * f.radius)}")


def _fittings(c: Context) -> None:
    """Reducers, tees and crosses: what joins pipes by its ports."""
    for part, f in enumerate(c.facts):
        if not c.free(part) or len(f.ports) < 2:
            continue
        joined = [port for port in f.ports if any(_is_piping(c, j) for j in c.mates(part, port))]
        width = max(port.outer for port in f.ports)
        if f.tube and len(joined) == 2 and all(any(_same_pipe(c, j, p) for j in c.mates(part, p)) for p in f.ports):
            c.say(part, PIPE, "pipe", 0.9, f"short piece between pipes of {_mm(2 * width)}")
            continue
        if len(joined) in (3, 4) and len(f.ports) == len(joined) and f.section[0] < 8 * width:
            name = "tee" if len(joined) == 3 else "cross"
            c.say(part, PIPE, name, 0.8, f"joins {len(joined)} pipe ends")
        elif len(joined) == 2 == len(f.ports) and f.round and not f.tube:
            slope = np.diff(f.outer) * (1 if f.outer[-1] > f.outer[0] else -1)
            if slope.min() > -0.01 * f.radius and f.outer.min() < 0.93 * f.radius and f.length > 0.8 * f.radius:
                c.say(part, PIPE, "reducer", 0.75, f"narrows from {_mm(2 * f.radius)} to {_mm(2 * f.outer.min())}")


def _is_piping(c: Context, part: int) -> bool:
    return c.is_a(part, PIPE) and not c.is_a(part, PIPE, "branch outlet")


def _same_pipe(c: Context, part: int, port: Disc) -> bool:
    """Whether a part is a pipe or elbow as wide as a port."""
    g = c.facts[part]
    return c.is_a(part, PIPE, "pipe", "elbow") and abs(g.ports[0].outer - port.outer) < 0.05 * port.outer


def _valves(c: Context) -> None:
    """What lies between two pipe ends and carries something on its side; or a handle, where nothing else is near."""
    for part in range(len(c.facts)):
        for first, second in c.run(part) if c.free(part) and not c.facts[part].tube else ():
            ends = [list(c.mates(part, port)) for port in (first, second)]
            piped = sum(any(_is_piping(c, j) for j in end) for end in ends)
            lone = not any(ends) and _is_lone_valve(c, part, first, second)
            if (all(ends) and piped and _is_valve(c, part, first, second, piped == 2)) or lone:
                for j in (j for end in ends for j in end):
                    beyond = [k for k in c.near[j] if k != part and not c.is_a(k, FASTENER)]
                    if c.free(j) and c.forms[j].flange and all(c.is_a(k, PIPE, "flange", "gasket") for k in beyond):
                        c.say(j, VALVE, "valve body", 0.8, "flanged end piece of a valve body")
                break


def _is_valve(c: Context, part: int, first: Disc, second: Disc, between_pipes: bool) -> bool:
    """Labels a body between two ends, and its handle, if what it carries tells a valve."""
    f, width = c.facts[part], max(first.outer, second.outer)
    top = [j for j in c.near[part] if _on_side(c, j, first, width)]
    handle = _find_handle(c, part, top)
    off = offset(c.parts.properties.obb_center[part], first) / width
    length = float((second.center - first.center) @ second.normal)
    kind = f"body of {_mm(length)} between two ends of {_mm(2 * width)}"
    for j, name in handle.items():
        c.say(j, VALVE, name, 0.85, f"{name or 'trim'} on a {kind}")
    if handle:
        c.say(part, VALVE, "valve body", 0.95, f"{kind}, with a handle")
    elif between_pipes and any(_stands(c, j, first.normal) for j in top) and length < 12 * width:
        c.say(part, VALVE, "valve body", 0.7, f"{kind}, with a stem on one side")
    elif between_pipes and off > 0.1 and length < 12 * width:
        c.say(part, VALVE, "valve", 0.7, f"{kind}, with something on one side")
    elif between_pipes and not f.tube and length < 8 * width and (not f.round or _swells(f)):
        c.say(part, VALVE, None, 0.55, f"{kind}, wider in its middle than a pipe")
    return not c.free(part)


def _is_lone_valve(c: Context, part: int, first: Disc, second: Disc) -> bool:
    """Labels a device without piping: a through bore, and a handle beside it that is longer than the ends are wide."""
    f, width = c.facts[part], max(first.outer, second.outer)
    through = min(first.inner, second.inner) > 0.3 * width and abs(first.outer - second.outer) < 0.1 * width
    branches = [p for p in f.ports if not parallel(p.normal, first.normal) and p.outer > 0.5 * width]
    if not through or branches or f.section[0] > 1.5 or f.round:
        return False
    handle = _find_handle(c, part, [j for j in c.near[part] if c.free(j)])
    kind = f"bore of {_mm(2 * min(first.inner, second.inner))} with a handle beside it"
    for j, name in handle.items():
        c.say(j, VALVE, name, 0.7, f"{name or 'trim'} on a {kind}")
    corners = c.parts.scene.mesh(part)[0] - first.center
    reach = np.linalg.norm(corners - np.outer(corners @ first.normal, first.normal), axis=1).max(initial=0.0)
    off = offset(c.parts.properties.obb_center[part], first)
    if handle:
        c.say(part, VALVE, "valve body", 0.7, kind)
    elif not c.near[part] and reach > 2.0 * width and off > 0.4 * width:
        c.say(part, VALVE, "valve", 0.6, f"{kind}, {_mm(float(reach))} off")
    return not c.free(part)


def _on_side(c: Context, part: int, port: Disc, width: float) -> bool:
    """Whether a free part stands on the side of a run rather than on its axis."""
    if not (c.free(part) or c.is_a(part, VALVE)):
        return False
    return offset(c.parts.properties.obb_center[part], port) > 0.5 * width


def _stands(c: Context, part: int, axis: Floats) -> bool:
    """Whether a part is round about an axis across a run, as stems and bonnets are."""
    f = c.facts[part]
    return f.round and bool(abs(f.axis @ axis) < 0.1)


def _swells(f: Facts) -> bool:
    """Whether a profile is wide at both ends, narrower inside of these, and wide again in the middle."""
    n = len(f.outer)
    middle = f.outer[n // 3 : n - n // 3].max()
    necks = max(f.outer[: n // 3].min(), f.outer[n - n // 3 :].min())
    return bool(middle > 1.15 * necks and min(f.outer[:3].max(), f.outer[-3:].max()) > 1.15 * necks)


def _find_handle(c: Context, body: int, top: Sequence[int]) -> dict[int, str | None]:
    """The free parts from a body's side up to its handle, each with its name; empty if there is no handle."""
    size = float(c.facts[body].section[0])
    reached: dict[int, str | None] = {}
    queue = list(top)
    while queue and len(reached) < 12:
        part = queue.pop(0)
        f, forms = c.facts[part], c.forms[part]
        if part in reached or part == body or not (c.free(part) or c.is_a(part, VALVE)) or f.section[0] > 3 * size:
            continue
        if (forms.bend or forms.tube) and f.ports[0].inner > 0 and f.tube > 4 * f.ports[0].outer:
            continue  # a pipe that no rule has named
        around = [j for j in c.near[part] if not c.is_a(j, FASTENER) and not c.is_a(j, PIPE)]
        label = c.labels[part]
        if forms.wheel or (len(around) == 1 and _is_plain_wheel(c, part, around[0])):
            reached[part] = "handwheel"
        elif forms.lever and len(around) <= 2:
            reached[part] = "lever"
        else:
            reached[part] = label.name if label is not None else _trim_name(c, part, body)
            queue += sorted(c.near[part])
    return reached if {"handwheel", "lever"} & set(reached.values()) else {}


def _is_plain_wheel(c: Context, part: int, rod: int) -> bool:
    """Whether a flat round part sits on a much thinner rod."""
    f, g = c.facts[part], c.facts[rod]
    flat = f.sides >= 8 and f.turned > 0.85 and f.length < 0.9 * f.radius and WHEEL[0] < 2 * f.radius < WHEEL[1]
    return flat and g.radius < 0.35 * f.radius and same_line(f.center, f.axis, g.center, g.axis, 0.1 * f.radius)


def _trim_name(c: Context, part: int, body: int) -> str | None:
    f = c.facts[part]
    if f.round and f.radius < 0.25 * c.facts[body].section[1] and f.length > f.radius:
        return "valve stem"
    if f.round and part in c.near[body]:
        return "valve bonnet"
    return None


def _gauges(c: Context) -> None:
    """A short cylinder on a thin stem that stands on piping; or both as one mesh."""
    for part, forms in enumerate(c.forms):
        f = c.facts[part]
        if not c.free(part):
            continue
        if forms.case:
            size, kind = 2 * f.radius, f"case of {_mm(2 * f.radius)}, {_mm(f.length)} deep"
            for stem in (j for j in c.near[part] if _is_gauge_stem(c, part, j)):
                way = _way_to_piping(c, stem, 3 * size, {part, stem, *c.near[part]})
                if way is not None:
                    c.say(part, GAUGE, "gauge case", 0.92, f"{kind}, on a stem on piping")
                    c.say(stem, GAUGE, "gauge stem", 0.88, f"stem under a {kind}")
                    _name_stand(c, way, kind)
                    for j in (j for j in c.near[part] if c.free(j)):
                        g = c.facts[j]
                        if g.radius < f.radius and same_line(f.center, f.axis, g.center, g.axis, 0.2 * f.radius):
                            c.say(j, GAUGE, "gauge face", 0.85, f"disc in a {kind}")
                    break
        elif f.discs and _is_whole_gauge(c, part):
            way = _way_to_piping(c, part, float(f.section[0]), {part})
            if way is not None:
                kind = f"dial of {_mm(2 * f.discs[0].outer)}"
                c.say(part, GAUGE, "gauge", 0.8, f"{kind} on a stem, in one mesh")
                _name_stand(c, way, kind)


def _is_gauge_stem(c: Context, case: int, stem: int) -> bool:
    """Whether a free part is slender and points at the case."""
    f, g = c.facts[case], c.facts[stem]
    way = c.parts.properties.obb_axes[stem][0]
    # On the axis of the case (back entry) a stem must be thinner and short, or a flange on its pipe would do.
    back = abs(f.axis @ way) > 0.9
    long, wide = float(g.section[0]), float(g.section[1])
    slender = long > 1.5 * wide and wide < (0.6 if back else 1.0) * STEM_CASE * 2 * f.radius
    apart = c.parts.properties.obb_center[stem] - c.parts.properties.obb_center[case]
    aims = np.linalg.norm(apart - (apart @ way) * way) < 0.35 * f.radius + 0.5 * f.length * abs(f.axis @ way)
    return bool(slender and long < (1.5 if back else 4.0) * 2 * f.radius and aims and c.free(stem))


def _way_to_piping(c: Context, start: int, size: float, banned: set[int]) -> tuple[int, ...] | None:
    """The free parts (three at most, none larger than ``size`` [m]) from a part to piping; None if none lead there."""
    queue: list[tuple[int, tuple[int, ...]]] = [(start, ())]
    while queue:
        here, way = queue.pop(0)
        onward = [j for j in c.near[here] if j not in banned and j not in way]
        if any(_is_piping(c, j) for j in onward):
            return way
        if len(way) < 3:
            queue += [(j, (*way, j)) for j in onward if c.free(j) and c.facts[j].section[0] < size]
    return None


def _name_stand(c: Context, way: Sequence[int], kind: str) -> None:
    for j in way:
        if c.facts[j].bent:
            c.say(j, GAUGE, "siphon", 0.8, f"thin bent tube under a {kind}")
        elif j == way[-1]:
            c.say(j, PIPE, "branch outlet", 0.8, f"stub between piping and a {kind}")
        else:
            c.say(j, GAUGE, None, 0.7, f"under a {kind}")


def _is_whole_gauge(c: Context, part: int) -> bool:
    """A dial whose axis has the stem far out on one side only, touching piping there and nothing else."""
    f = c.facts[part]
    dial = max(f.discs, key=lambda d: d.outer)
    if not CASE[0] < 2 * dial.outer < CASE[1] or not 0 < len(c.near[part]) <= 3:
        return False
    corners = c.parts.scene.mesh(part)[0] - dial.center
    across = corners - np.outer(corners @ dial.normal, dial.normal)
    reach = np.linalg.norm(across, axis=1)
    far = across[reach > 0.95 * reach.max()].mean(axis=0)
    far = far / max(float(np.linalg.norm(far)), 1e-9)
    depth = float(np.ptp(corners @ dial.normal))
    one_sided = -float((across @ far).min()) < 1.3 * dial.outer
    side = across - np.outer(across @ far, far)
    thin_foot = np.linalg.norm(side[across @ far > 0.8 * reach.max()], axis=1).max(initial=0.0) < STEM_CASE * dial.outer
    touches = any((c.spot[part, j] - dial.center) @ far > 1.05 * dial.outer for j in c.near[part])
    return bool(reach.max() > 1.35 * dial.outer and one_sided and thin_foot and depth < 2.2 * dial.outer and touches)


def _supports(c: Context) -> None:
    """Rods and bands around a pipe; what carries them."""
    held = []
    for part in range(len(c.facts)):
        if not c.free(part):
            continue
        for pipe in c.near[part]:
            ahead = [j for port in c.facts[pipe].ports for j in c.mates(pipe, port)]
            opening = _opening(c, part, pipe) if c.is_a(pipe, PIPE, "pipe", "elbow") and part not in ahead else 360.0
            if opening < MAX_OPENING:
                name = "u-bolt" if opening > 60.0 else "clamp"
                c.say(part, FASTENER, name, 0.75, f"goes around a pipe of {_mm(2 * c.facts[pipe].ports[0].outer)}")
                held.append(part)
                break
    for part in held:
        for j in c.near[part]:
            long, mid, thin = c.facts[j].section
            if c.free(j) and long < 2.0 * c.facts[part].section[0] and thin < 0.55 * mid:
                c.say(j, FASTENER, "bracket", 0.6, "carries what goes around a pipe")


def _opening(c: Context, part: int, pipe: int) -> float:
    """The widest angle around a pipe without a corner of a part close to its skin [degrees]."""
    spot = c.spot[part, pipe]
    corners = c.parts.scene.mesh(part)[0]
    for port in c.facts[pipe].ports:
        r = port.outer
        if any(0.8 * r < p.outer < 1.25 * r and not parallel(p.normal, port.normal) for p in c.facts[part].ports):
            continue  # an elbow that starts here
        if offset(spot, port) > r + 0.02 or max(c.facts[part].section) > 10 * r:
            continue
        apart = corners - port.center
        across = apart - np.outer(apart @ port.normal, port.normal)
        radii = np.linalg.norm(across, axis=1)
        close = across[(radii > 0.9 * r) & (radii < 1.35 * r + 0.005)]
        if len(close) >= 6:
            angles = angles_about(port.normal, close)
            return float(np.degrees(np.diff(np.append(angles, angles[0] + 2 * np.pi)).max()))
    return 360.0


def _bolt_sets(c: Context) -> None:
    """All bolts of a joint as one mesh: it lies around the axis of a flange, within its rim, clear of its bore."""
    for part, f in enumerate(c.facts):
        flanges = [j for j in c.near[part] if c.is_a(j, PIPE, "flange", "blind flange", "gasket")]
        if not c.free(part) or not flanges or f.fill > 0.3 or f.tube:
            continue
        rim = max((c.facts[j] for j in flanges), key=lambda g: g.radius)
        apart = c.parts.scene.mesh(part)[0] - rim.center
        across = apart - np.outer(apart @ rim.axis, rim.axis)
        radii = np.linalg.norm(across, axis=1)
        if radii.min() > 0.45 * rim.radius and radii.max() < 1.02 * rim.radius and float(f.section[0]) > rim.radius:
            gaps = np.degrees(np.diff(angles_about(rim.axis, across)))
            if (gaps > 15.0).sum() >= 3:
                c.say(part, FASTENER, "bolt", 0.75, f"pieces around the axis of a flange of {_mm(2 * rim.radius)}")


def _structure(c: Context) -> None:
    """Long bars and plates that touch each other."""
    for part, forms in enumerate(c.forms):
        if not c.free(part) or not (forms.bar or forms.plate):
            continue
        size, across = c.facts[part].section[0], c.parts.properties.obb_axes[part][2]
        beside = [j for j in c.near[part] if c.forms[j].bar or (forms.bar and c.forms[j].plate)]
        if not beside:
            continue
        stands = any(parallel(c.parts.properties.obb_axes[j][0], across) for j in beside)
        name = ("base plate" if stands and size < MAX_BASE else "plate") if forms.plate else None
        c.say(part, STRUCTURE, name, 0.6, f"{'plate' if forms.plate else 'bar'} of {_mm(float(size))} in a frame")


def _leftovers(c: Context) -> None:
    """What touches only parts of one device, or is enclosed by it, belongs to it; a wheel without a valve does not."""
    for group in (VALVE, GAUGE):
        for _ in range(2):
            for part, near in enumerate(c.near):
                around = [j for j in near if not c.is_a(j, FASTENER)]
                if c.free(part) and around and all(c.is_a(j, group) for j in around):
                    c.say(part, group, None, 0.65, f"touches only parts of a {group.split()[0].lower()}")
    for part, f in enumerate(c.facts):
        forms, width = c.forms[part], 2 * f.radius
        if c.is_a(part, VALVE, "handwheel", "valve stem") and not _on_valve(c, part):
            c.labels[part] = None
        if not c.free(part):
            continue
        if forms.nut and width < BOLT[1]:
            c.say(part, FASTENER, "nut", 0.75, f"hexagon with a hole, {_mm(width)} over corners")
        elif forms.washer:
            c.say(part, FASTENER, "washer", 0.6, f"flat ring of {_mm(width)}, {_mm(f.length)} thick")
        elif forms.pin and _has_head(f):
            c.say(part, FASTENER, "screw", 0.6, f"shank of {_mm(f.length)} with a head of {_mm(width)}")


def _has_head(f: Facts) -> bool:
    """Whether a shank of one radius carries a wider head at one end, of the proportions of a screw."""
    outer = f.outer if f.outer[0] > f.outer[-1] else f.outer[::-1]
    shank = float(np.median(outer))
    head = int((outer > 1.3 * shank).sum())
    level = np.ptp(outer[head + 1 :]) < 0.25 * shank if head else False  # threads may be modelled
    thick = head * f.length / len(outer)
    return bool(level and outer[:head].min() > 1.3 * shank and f.radius < 2.4 * shank and thick < 1.6 * 2 * shank)


def _on_valve(c: Context, part: int) -> bool:
    """Whether parts labelled as valve lead from here to a body."""
    seen, queue = {part}, [part]
    while queue:
        here = queue.pop()
        if c.is_a(here, VALVE, "valve body", "valve", "valve bonnet"):
            return True
        queue += [j for j in c.near[here] if j not in seen and c.is_a(j, VALVE)]
        seen.update(queue)
    return False


_RULES: tuple[Callable[[Context], None], ...] = (
    _fasteners, _stems, _pipes, _flanges, _fittings, _valves, _gauges, _bolt_sets, _supports, _structure, _leftovers,
)  # fmt: skip


@dataclass(frozen=True)
class GeometryLabeler:
    """Labels by rules on geometry; most parts of an unknown kind stay without a label."""

    rules: tuple[Callable[[Context], None], ...] = field(default=_RULES)

    def label(self, parts: Parts, contacts: Contacts, vocabulary: Vocabulary) -> Sequence[Label | None]:
        """Labels parts; see ``Labeler.label``. Labels that the vocabulary lacks are left out."""
        context = Context(parts, contacts)
        for rule in self.rules:
            rule(context)
        return [
            label if label is not None and vocabulary.holds(label.group, label.name) else None
            for label in context.labels
        ]
