"""The preset ``assortment``: lines, devices and structures of all families at random, each in realistic context.

A plant to learn from rather than to look at: every part sits where such parts sit (valves between flanges in pipe runs,
gauges on outlets, pumps with their motors on bases, pipes on supports), but what there is, of which build, how finely
modelled and by what style is drawn anew for each plant and each device.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeVar

import numpy as np

from cadgraph.geometry.components import connected_sets
from cadgraph.model.scene import Floats
from cadplants.builder.params import Apart, Source
from cadplants.families import FAMILIES
from cadplants.faults.defects import loosen
from cadplants.faults.retessellate import retold
from cadplants.lines.layout import Inline, Laid, Run, Tap, lay
from cadplants.lines.route import Route
from cadplants.model.contacts import measured, met
from cadplants.model.family import Family, Model, as_assembly, as_device
from cadplants.model.plant import Assembly, Component, Device, Plant, gather
from cadplants.model.standards import ELBOW_LONG_RADIUS, PIPES, SIZES
from cadplants.parts.flange import GASKET, bolts, flange, flange_length, gasket, plate_thickness
from cadplants.parts.piping import bend_tangent, cap, elbow
from cadplants.presets.taste import ALL_FAMILIES, OF_PRIMITIVES, Taste
from cadplants.solids.mesh_ops import merge, moved
from cadplants.solids.primitives import box
from cadplants.solids.transforms import at, looking, spun
from cadplants.styles.drawn_styles import draw_modeling_style
from cadplants.styles.modeling_style import Grain, ModelingStyle

__all__ = ["FAMILIES", "draw_modeling_style", "make_assortment"]

_Made = TypeVar("_Made", Assembly, Device)

_LANE = 1.8  # m between two lines
_LOWEST, _HIGHEST = 0.45, 3.2  # m, of a line's axis
_ROOM = 8.0  # m between things on the floor: their lines stay clear of each other
_MESHES, _MOST = (90, 280), 24  # a plant is full at a number of meshes without fasteners, or has so many things
_NARROWING = ("reducer/bare cone",)  # families of single reducers whose two ends are on one axis
_FOREIGN = 2  # other styles at most, of a plant whose taste is given
_FASTENERS = ("bolt", "nut", "washer", "stud", "screw")
_LIDS = frozenset({"pipe cap", "blind flange"})
_GROUND = 0.3  # share of plants that stand on a slab
_DN_WEIGHTS = np.array([2, 2, 3, 2, 3, 4, 2, 3, 3, 1, 2, 2, 1, 1], float)  # of DN15..DN300


def make_assortment(
    seed: int = 0,
    style: ModelingStyle | None = None,
    without: frozenset[str] = frozenset(),
    taste: Taste | None = None,
) -> Plant:
    """Builds a random assortment of lines, devices and structures, about 100 to 500 meshes and their fasteners.

    Args:
        seed: of everything.
        style: how everything is modelled; else styles are drawn, one for the plant and others for some of its parts.
        without: names of families that are left out (keys of ``ALL_FAMILIES``), or what comes before their slash.
        taste: what is drawn how often; else all of ``FAMILIES``, or families of primitives where the style's devices
            are.

    Returns:
        The plant with its labels and families; contacts and clusters are those that its surfaces have.

    Raises:
        ValueError: ``without`` names a family that there is not.
    """
    _check_names(without)
    source = Apart(seed, 20)
    if taste is None and style is not None and style.devices == "primitives":
        taste = OF_PRIMITIVES
    main = draw_modeling_style(source.of("style").rng, "drawn-1") if style is None else style
    plant = _Draw(source, _Whole(source, style, main, without, taste))
    parts: list[Assembly] = []
    budget = int(plant.rng.integers(*(_MESHES if taste is None else taste.meshes)))
    lines = 0
    for k in range(_MOST):
        work = plant.of(f"thing {k}")
        style = work.style()
        if k % 4 == 0:
            one = _line(work, style, f"L{lines + 1}", _LANE * lines)
            lines += 1
        else:
            j = k - lines
            place = at(_ROOM * (j % 4), -4.0 - _ROOM * (j // 4)) @ spun(
                "z", float(work.rng.choice([0, 0.5, 1, 1.5])) * np.pi
            )
            one = _stand(work, style, f"S{j + 1}").placed(place)
        # What touches as it is meant is measured before gaps are left, and what touches all the same at the end.
        parts.append(_finished(met(one), style, seed + 1000 * k))
        budget -= sum(c.name not in _FASTENERS for c in one.components)
        if budget < 0 and k > 1:
            break
    if plant.of("ground").rng.random() < _GROUND:
        parts.append(_ground(gather(parts), main))
    return measured(Plant.of(gather(parts), "assortment", seed, plant.whole.used))


def _check_names(without: frozenset[str]) -> None:
    known = set(ALL_FAMILIES) | {name.split("/")[0] for name in ALL_FAMILIES}
    for name in sorted(without - known):
        raise ValueError(f"there is no family {name!r}; see ALL_FAMILIES for their names")


class _Whole:
    """What all draws of one plant share: its styles, its families, how many units it has."""

    def __init__(
        self,
        source: Apart,
        fixed: ModelingStyle | None,
        main: ModelingStyle,
        without: frozenset[str],
        taste: Taste | None,
    ) -> None:
        self.fixed, self.main, self.taste = fixed, main, taste
        self.used = [main]
        self.count = 0
        self._source, self._others = source, dict[str, ModelingStyle]()
        self.families: dict[str, list[Family]] = {}
        for family in (FAMILIES if taste is None else ALL_FAMILIES).values():
            if family.name not in without and family.name.split("/")[0] not in without:
                self.families.setdefault(family.place, []).append(family)

    def other(self, which: str) -> ModelingStyle:
        """A style other than the main one; of the same name, the same."""
        if which not in self._others:
            style = draw_modeling_style(self._source.of(f"style {which}").rng, f"drawn-{len(self.used) + 1}")
            self._others[which] = style
            self.used.append(style)
        return self._others[which]


class _Draw:
    """Draws families, sizes and styles for one part of a plant, from a stream of its own: what is drawn more or less
    elsewhere changes nothing here.

    Args:
        source: of this part.
        whole: what it shares with the others.
    """

    def __init__(self, source: Source, whole: _Whole) -> None:
        self.source, self.whole = source, whole
        self.rng = source.rng

    def of(self, name: str) -> _Draw:
        """What draws a part of this part."""
        return _Draw(self.source.of(name), self.whole)

    def style(self) -> ModelingStyle:
        """The plant's style, or in a third of the cases another one."""
        if self.whole.fixed is not None or self.rng.random() < 0.65:
            return self.whole.main
        return self.whole.other(str(self.rng.integers(_MOST)))

    def grained(self, style: ModelingStyle) -> ModelingStyle:
        """The style with a granularity of its own for one device; a given style keeps its own."""
        taste = self.whole.taste
        if taste is not None:
            if self.rng.random() < taste.foreign:
                return self.whole.other(str(self.rng.integers(_FOREIGN)))
            if self.rng.random() >= taste.mixed:
                return style
        elif self.whole.fixed is not None or self.rng.random() < 0.5:
            return style
        grains: tuple[Grain, ...] = ("one", "few", "pieces")
        grain = grains[int(self.rng.integers(3))]
        return replace(style, valve=grain, gauge=grain, pump=grain, tank=grain, equipment=grain, structure=grain)

    def family(self, place: str, dn: int = 0) -> Family | None:
        """One family for a place, made in this size; None where all are left out."""
        some = [f for f in self.whole.families.get(place, []) if not dn or dn in f.sizes]
        if not some:
            return None
        taste = self.whole.taste
        weights = np.array([f.weight for f in some]) if taste is None else taste.weights(some)
        if not weights.sum():
            return None
        return some[int(self.rng.choice(len(some), p=weights / weights.sum()))]

    def model(self, family: Family, dn: int, style: ModelingStyle, *height: float) -> Model | Device | Assembly:
        """A device of a family."""
        return family.build(dn, style, self.source.of(family.name), *height)

    def unit(self, family: Family) -> str:
        """An id for a device's unit."""
        self.whole.count += 1
        return f"{family.unit[:1].upper()}-{self.whole.count}" if family.unit else ""

    def dn(self) -> int:
        """A nominal size, small ones more often."""
        weights = _DN_WEIGHTS
        if self.whole.taste is not None:
            least, most = self.whole.taste.sizes
            weights = weights * [least <= size <= most for size in SIZES]
        return int(self.rng.choice(SIZES, p=weights / weights.sum()))


def _finished(assembly: Assembly, style: ModelingStyle, seed: int) -> Assembly:
    """Gaps, unevenness and triangles as the style leaves them; families for plain pipe."""
    whole = retold(loosen(assembly, style, seed), style, seed)
    styles = {"flange": f"flange/{style.flange}", "blind flange": "flange/blind", "elbow": "elbow/long radius"}
    components = tuple(
        replace(c, family=c.family or styles.get(c.name, f"{c.name}/plain"), granularity=c.granularity or "pieces")
        for c in whole.components
    )
    return replace(whole, components=components).marked(style=style.name)


def _ground(whole: Assembly, style: ModelingStyle) -> Assembly:
    """A slab under everything."""
    points = np.concatenate([c.vertices for c in whole.components])[:, :2]
    (low_x, low_y), (high_x, high_y) = points.min(axis=0) - 0.5, points.max(axis=0) + 0.5
    slab = box((high_x - low_x, high_y - low_y, 0.1), ((low_x + high_x) / 2, (low_y + high_y) / 2, -0.05))
    color = style.color("ground")
    ground = Component(slab, "Structural element", "ground", color, family="ground/slab", granularity="one")
    return Assembly((replace(ground, style=style.name),))


# --- lines ---


@dataclass(frozen=True)
class _Leg:
    """A straight stretch of a line: what is in it and how long it is without bends [m]."""

    items: tuple[Inline, ...]
    taps: tuple[Tap, ...]
    length: float


def _line(work: _Draw, style: ModelingStyle, tag: str, lane: float) -> Assembly:
    """One line along x in its lane, with its supports and whatever ends it."""
    rng, dn = work.rng, work.dn()
    bent, bend = bool(rng.random() < 0.4), float(rng.uniform(1.5, 3.5))
    directions = _directions(rng, int(rng.integers(1, 5)))
    tangents = [
        bend_tangent(bend * PIPES[dn].outer if bent else ELBOW_LONG_RADIUS[dn], a, b)
        for a, b in zip(directions[:-1], directions[1:], strict=True)
    ]
    points = [np.array([0.0, lane, float(rng.uniform(0.8, 1.8))])]
    inline: list[Inline] = []
    taps: list[Tap] = []
    s = 0.0
    for k, direction in enumerate(directions):
        before = tangents[k - 1] if k else flange_length(dn, style) + 0.05
        after = tangents[k] if k < len(tangents) else flange_length(dn, style) + 0.05
        leg = _leg(work.of(f"leg {k}"), style, dn, s + before, abs(float(direction[2])) < 0.1)
        length = before + leg.length + after
        points.append(points[-1] + length * direction)
        inline += leg.items
        taps += leg.taps
        s += length
    ends = tuple(str(rng.choice(["open", "open", "flange", "blind"])) for _ in range(2))
    height = min(float(p[2]) for p in points)
    lift = np.array([0.0, 0.0, max(0.0, _LOWEST - height)])
    points = [p + lift for p in points]
    run = Run(
        tag, dn, Route(np.array(points)), tuple(inline), tuple(taps), bent=bent, bend=bend, ends=(ends[0], ends[1])
    )
    laid = lay(run, style)
    supports, endings = _supports(work, style, laid), _endings(work, style, run)
    line = _ended(laid.assembly, run, endings)
    whole = gather([line, *supports, *(part for _, parts in endings for part in parts)])
    return (_spooled(whole) if style.merged else whole).marked(cluster=tag)


def _directions(rng: np.random.Generator, count: int) -> list[Floats]:
    """Directions of the legs of a line that goes on towards +x: bends of 90 and 45 degrees, offsets, risers."""
    result = [np.array([1.0, 0.0, 0.0])]
    while len(result) < count:
        last = result[-1]
        if last[0] > 0.9:
            turn = float(rng.choice([0.5, 0.5, 0.25])) * np.pi
            way = (
                (0.0, 0.0, float(rng.choice([1.0, 1.0, -1.0])))
                if rng.random() < 0.75
                else (0.0, float(rng.choice([1, -1])), 0.0)
            )
            result.append(np.array([1.0, 0.0, 0.0]) * np.cos(turn) + np.array(way) * np.sin(turn))
        else:
            result.append(np.array([1.0, 0.0, 0.0]))
    return [np.where(np.abs(d) < 1e-12, 0.0, d) for d in result]


def _leg(work: _Draw, style: ModelingStyle, dn: int, start: float, level: bool) -> _Leg:
    """Some devices in a row with pipe between them."""
    items: list[Inline] = []
    taps: list[Tap] = []
    x = float(work.rng.uniform(0.08, 0.4))
    for k in range(int(work.rng.integers(1, 4))):
        here = work.of(f"item {k}")
        pipe = float(here.rng.choice([0.12, 0.25, 0.5])) * float(here.rng.uniform(0.8, 1.6))
        if here.rng.random() < 0.45 and level and pipe > 0.2:
            taps += _taps(here.of("tap"), style, dn, start + x + pipe / 2)
        x += pipe
        item, length = _item(here, style, dn, start + x)
        items.append(item)
        x += length
        if item.dn:
            narrow, length = _narrowed(here.of("narrowed"), style, dn, item, start + x, length)
            items += narrow
            x += length
    return _Leg(tuple(items), tuple(taps), x + float(work.rng.uniform(0.15, 0.9)))


def _taps(work: _Draw, style: ModelingStyle, dn: int, s: float) -> list[Tap]:
    """What stands on a pipe there; nothing where all that could are left out."""
    family = work.family("tap")
    if family is None:
        return []
    own, unit = work.grained(style), work.unit(family)
    # Most instruments are made in one size, whatever the pipe that they stand on.
    size = min(family.sizes, key=lambda one: abs(one - dn))
    assembly = as_assembly(family, work.model(family, size, own), own, unit)
    return [Tap(s, partial(_given, assembly), unit)]


def _given(made: _Made, _: ModelingStyle) -> _Made:
    """What was made already, whatever style asks."""
    return made


def _item(work: _Draw, style: ModelingStyle, dn: int, low: float) -> tuple[Inline, float]:
    """One thing in a line that begins at a chainage, and how long it is with its flanges [m]."""
    rng = work.rng
    neck, pad = flange_length(dn, style), GASKET if style.gaskets else 0.0
    family = work.family("inline", dn) if rng.random() < 0.9 else None
    if family is None:
        length = 2 * neck + pad
        return Inline(low + length / 2), length
    own = work.grained(style)
    unit = work.unit(family)
    model = work.model(family, dn, own)
    device = as_device(family, model, own, unit)
    welded = family.welded or (isinstance(model, Model) and model.joint == "welded")
    length = device.length + (0.0 if welded else 2 * (neck + pad))
    roll = float(rng.choice([0.0, 0.0, 0.0, 0.5, -0.5, 1.0])) * np.pi
    build: Callable[[ModelingStyle], Device] = partial(_given, device)
    behind = model.dn if isinstance(model, Model) and family.name in _NARROWING else 0
    return Inline(low + length / 2, build, unit, roll, welded=welded, dn=behind), length


def _narrowed(
    work: _Draw, style: ModelingStyle, dn: int, reducer: Inline, low: float, length: float
) -> tuple[list[Inline], float]:
    """What follows a reducer: narrow pipe, at times with a device in it, and the same reducer the other way round; and
    how long that is [m].
    """
    rng, items = work.rng, []
    x = float(rng.uniform(0.15, 0.5))
    if rng.random() < 0.6:
        item, more = _item(work.of("device"), style, reducer.dn, low + x)
        items.append(replace(item, dn=0))
        x += more + float(rng.uniform(0.15, 0.5))
    build = partial(_once_more, reducer.build) if reducer.build is not None else None
    back = Inline(low + x + length / 2, build, reverse=True, welded=True, dn=dn)
    return [*items, back], x + length


def _once_more(build: Callable[[ModelingStyle], Device], style: ModelingStyle) -> Device:
    """A second device like one that stands already: what it is built from is recorded of each by itself."""
    device = build(style)
    components = device.assembly.components
    said = next((dict(c.params) for c in components if c.params is not None), None)
    own = tuple(replace(c, params=said) for c in components)
    return replace(device, assembly=replace(device.assembly, components=own))


def _ended(line: Assembly, run: Run, endings: Iterable[tuple[int, list[Assembly]]]) -> Assembly:
    """A line whose truth says what stands at its ends (0 or 1): closed by a lid, untold where a device goes on."""
    names = {f"{run.tag}/{('start', 'end')[which]}": parts for which, parts in endings}
    points = (replace(p, end=_end_by(names[p.id], p.end)) if p.id in names else p for p in line.points)
    return replace(line, points=tuple(points))


def _end_by(parts: Iterable[Assembly], end: str) -> str:
    """What an end is by what stands there: closed by a lid; open or not for a device to say."""
    components = [component for part in parts for component in part.components]
    names = {component.name for component in components}
    if names & _LIDS and "branch outlet" not in names:
        return "blind"
    return "" if any(component.unit for component in components) else end


def _endings(work: _Draw, style: ModelingStyle, run: Run) -> list[tuple[int, list[Assembly]]]:
    """What stands at the ends (0 or 1) of a line: caps, bends and hoses on pipes; valves and lids on flanges."""
    found = []
    for which, s in ((0, 0.0), (1, run.route.length)):
        here = work.of(f"end {which}")
        frame = run.route.frame(s) if which else run.route.frame(s) @ spun("z", np.pi)
        dn = run.dn_at(s)
        if here.rng.random() < 0.3 or run.ends[which] not in ("open", "flange"):
            continue
        build = _pipe_end if run.ends[which] == "open" else _flange_end
        found.append((which, build(here, style, dn, frame)))
    return found


def _pipe_end(work: _Draw, style: ModelingStyle, dn: int, frame: Floats) -> list[Assembly]:
    family = work.family("end", dn)
    if family is None or work.rng.random() < 0.25:
        return [cap(dn, style).placed(frame)]
    own = work.grained(style)
    return [as_assembly(family, work.model(family, dn, own), own).placed(frame)]


def _flange_end(work: _Draw, style: ModelingStyle, dn: int, frame: Floats) -> list[Assembly]:
    """A device with one flange, bolted on; half of the upright ones stand on an elbow."""
    family = work.family("head", dn)
    if family is None:
        return []
    own, unit = work.grained(style), work.unit(family)
    pad, plate = GASKET if style.gaskets else 0.0, plate_thickness(dn)
    parts = [gasket(dn, style).placed(frame), bolts(dn, 2 * plate + pad, style).placed(frame @ at(-plate))]
    if family.unit and abs(frame[2, 0]) < 0.1 and work.rng.random() < 0.6:
        neck, radius = flange_length(dn, style), ELBOW_LONG_RADIUS[dn]
        turn = looking(frame[:3, 3], frame[:3, 0], (0.0, 0.0, 1.0)) @ spun("x", np.pi / 2)
        start = turn @ at(pad)
        parts.append(flange(dn, style).placed(start))
        parts.append(elbow(dn, np.pi / 2, style).placed(start @ at(neck)))
        frame = start @ at(neck + radius, radius) @ spun("z", np.pi / 2) @ at(neck)
        parts.append(flange(dn, style).placed(frame @ spun("z", np.pi)))
        parts += [gasket(dn, style).placed(frame), bolts(dn, 2 * plate + pad, style).placed(frame @ at(-plate))]
    model = work.model(family, dn, own)
    roll = spun("x", float(work.rng.uniform(0, 2 * np.pi)))
    return [*parts, as_assembly(family, model, own, unit).placed(frame @ at(pad) @ roll)]


def _supports(work: _Draw, style: ModelingStyle, laid: Laid) -> list[Assembly]:
    """What carries the level pipes of a line: from the ground up, or from a beam above."""
    parts = []
    run = laid.run
    taken = [tap.s for tap in run.taps]
    for k, piece in enumerate(laid.pieces):
        here = work.of(f"support {k}")
        middle = (piece.low + piece.high) / 2
        frame = run.route.frame(middle)
        straight = run.route.leg(piece.low + 1e-6) == run.route.leg(piece.high - 1e-6)
        clear = all(abs(s - middle) > 0.12 for s in taken)
        if (
            not straight
            or abs(frame[2, 0]) > 0.01
            or piece.high - piece.low < 0.25
            or not clear
            or here.rng.random() < 0.4
        ):
            continue
        dn = run.dn_at(middle)
        family = here.family("carrier", dn)
        if family is None:
            continue
        own = here.grained(style)
        model = here.model(family, dn, own, float(frame[2, 3]))
        parts.append(as_assembly(family, model, own).placed(frame))
    return parts


# Names of two pieces that are welded to each other; flanges are bolted.
_WELDED = ({"pipe"}, {"elbow"}, {"pipe", "elbow"}, {"pipe", "flange"}, {"elbow", "flange"})


def _spooled(whole: Assembly) -> Assembly:
    """Pipes, elbows and flanges that are welded to each other as one mesh called pipe; flanges stay apart."""
    plain = [c.group == "Pipe assembly" and c.family not in ALL_FAMILIES for c in whole.components]
    names = [c.name if own else "" for c, own in zip(whole.components, plain, strict=True)]
    joined = [(a, b) for a, b in whole.contacts if {names[a], names[b]} in _WELDED]
    spools = connected_sets(range(len(names)), joined)
    components = []
    for spool in spools:
        one = whole.components[spool[0]]
        if len(spool) > 1:
            solids = [moved(whole.components[i].solid, whole.components[i].pose) for i in spool]
            one = replace(one, solid=merge(solids), pose=np.eye(4), name="pipe", family="pipe/spool", granularity="one")
        components.append(one)
    place = {i: k for k, spool in enumerate(spools) for i in spool}
    pairs = {(place[a], place[b]) for a, b in whole.contacts}
    contacts = tuple(sorted({(min(p), max(p)) for p in pairs if p[0] != p[1]}))
    return replace(whole, components=tuple(components), contacts=contacts)


# --- the floor ---


def _stand(work: _Draw, style: ModelingStyle, cluster: str) -> Assembly:
    """One thing on the floor, with a short line from each of its faces."""
    family = work.family("floor")
    if family is None:
        return Assembly()
    own, unit = work.grained(style), work.unit(family)
    model = work.model(family, int(work.rng.choice(family.sizes)), own)
    parts = [as_assembly(family, model, own, unit)]
    ports = model.ports if isinstance(model, Model) else ()
    for k, port in enumerate(ports):
        here = work.of(f"port {k}")
        if here.rng.random() < 0.8:
            parts.append(_stub_line(here, style, f"{cluster}-{k + 1}", port.frame, port.dn, unit))
    whole = gather(parts)
    return (_spooled(whole) if style.merged else whole).marked(cluster=cluster)


def _stub_line(work: _Draw, style: ModelingStyle, tag: str, frame: Floats, dn: int, unit: str) -> Assembly:
    """A line of one or two legs away from a face, with a device in it."""
    rng = work.rng
    start, out = frame[:3, 3], frame[:3, 0]
    neck = flange_length(dn, style) + GASKET + 0.05
    leg = _leg(work.of("leg"), style, dn, neck, abs(float(out[2])) < 0.1)
    points = [start, start + out * (neck + leg.length + ELBOW_LONG_RADIUS[dn])]
    if rng.random() < 0.6:
        up = np.array([0.0, 0.0, 1.0]) if abs(out[2]) < 0.5 else looking((0, 0, 0), out)[:3, 1]
        points.append(points[-1] + up * (ELBOW_LONG_RADIUS[dn] + neck + float(rng.uniform(0.2, 0.8))))
    end = str(rng.choice(["open", "flange", "blind"]))
    route = Route(np.array(points))
    return lay(Run(tag, dn, route, leg.items, leg.taps, ends=("joint", end), nodes=(unit, "")), style).assembly
