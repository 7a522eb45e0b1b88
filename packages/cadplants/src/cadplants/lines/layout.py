"""Runs of pipe: devices placed by arc length on a centreline, pipes and bends in between.

Positions along a run are chainages: lengths [m] along the sharp-cornered route, from its first point.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.lines.run import Inline, Run, Tap
from cadplants.lines.run_truth import ONE_WAY, course
from cadplants.model.plant import Assembly, Device, gather
from cadplants.model.standards import PIPES
from cadplants.parts.fastener import clamping
from cadplants.parts.flange import GASKET, bolts, flange, flange_length, gasket, plate_thickness
from cadplants.parts.piping import elbow, outlet, pipe, spool
from cadplants.solids.transforms import arc, at, looking, spun
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Inline", "Laid", "Piece", "Run", "Tap", "lay"]

_SHORTEST = 0.002  # m; a shorter piece of pipe is a mistake in the layout
OUTLET_HEIGHT = 0.024


@dataclass(frozen=True)
class Piece:
    """Where on the run a component of pipe lies.

    Args:
        low: chainage of its beginning [m].
        high: of its end.
        component: index in the assembly.
    """

    low: float
    high: float
    component: int


@dataclass(frozen=True)
class Laid:
    """A finished run.

    Args:
        run: as asked for.
        assembly: its components and truth.
        pieces: the straight and bent pipes, in order.
        first: indices of the components that touch what lies before the run.
        last: of those that touch what lies behind it.
        devices: index of the first component of each inline device, by unit or junction id.
    """

    run: Run
    assembly: Assembly
    pieces: tuple[Piece, ...]
    first: tuple[int, ...]
    last: tuple[int, ...]
    devices: Mapping[str, int]

    def at(self, s: float) -> int:
        """The index of the pipe at this chainage.

        Raises:
            ValueError: no pipe lies there.
        """
        for piece in self.pieces:
            if piece.low < s < piece.high:
                return piece.component
        raise ValueError(f"run {self.run.tag}: no pipe at chainage {s:.3f} m, but {self.pieces}")


@dataclass
class _Work:
    """The run as it grows, from its start to its end."""

    run: Run
    style: ModelingStyle
    parts: list[Assembly] = field(default_factory=list)
    joints: list[tuple[int, int]] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)
    count: int = 0
    tail: int = -1
    cursor: float = 0.0
    dn: int = 0
    devices: dict[str, int] = field(default_factory=dict)
    one_way: dict[str, bool] = field(default_factory=dict)

    def add(self, assembly: Assembly) -> int:
        """Appends an assembly and returns the index of its first component."""
        first = self.count
        self.parts.append(assembly)
        self.count += len(assembly.components)
        return first

    def follow(self, assembly: Assembly, inlet: int = 0, outlet: int = 0) -> None:
        """Appends what touches the tail of the run and becomes its tail."""
        if not assembly.components:
            return
        first = self.add(assembly)
        if self.tail >= 0:
            self.joints.append((self.tail, first + inlet))
        self.tail = first + outlet


def lay(run: Run, style: ModelingStyle) -> Laid:
    """Builds a run: fills it with pipe between its devices and records what follows what.

    Raises:
        ValueError: devices overlap each other or a bend.
    """
    work = _Work(run, style, dn=run.dn)
    end = run.route.length
    first = _begin(work)
    for item in sorted(run.inline, key=lambda item: item.s):
        _fill(work, item.s - _half(item, work))
        if item.welded and item.build is not None:
            _weld_in(work, item)
        else:
            _block(work, item)
        work.dn = item.dn or work.dn
    tail = {"open": 0.0, "plate": 0.0, "joint": flange_length(work.dn, style) + _pad(style)}.get(
        run.ends[1], flange_length(work.dn, style)
    )
    _fill(work, end - tail)
    last = _finish(work)
    laid = Laid(run, Assembly(), tuple(work.pieces), first or (0,), last or (work.tail,), work.devices)
    for tap in run.taps:
        _tap(work, laid, tap)
    assembly = gather([*work.parts, course(run, work.one_way)], work.joints).marked(line=run.tag)
    return replace(laid, assembly=assembly)


def _pad(style: ModelingStyle) -> float:
    return GASKET if style.gaskets else 0.0


def _half(item: Inline, work: _Work) -> float:
    """Half the length of a device with its counter-flanges [m]."""
    neck, pad = flange_length(work.dn, work.style), _pad(work.style)
    if item.build is None:
        return neck + pad / 2
    length = item.build(work.style).length
    return length / 2 if item.welded else length / 2 + pad + neck


def _block(work: _Work, item: Inline) -> None:
    """A counter-flange, gasket and bolts on each side of a device, or a joint of two flanges."""
    run, style = work.run, work.style
    neck, pad = flange_length(work.dn, style), _pad(style)
    frame = run.route.frame(work.cursor)
    back = spun("z", np.pi)
    device = item.build(style) if item.build is not None else Device(Assembly(), 0.0)
    grip = 2 * (plate_thickness(work.dn) + pad) + device.length if device.wafer else _grip(work)
    work.follow(flange(work.dn, style, grip=grip).placed(frame @ at(neck) @ back))
    first = work.tail
    face = neck
    if device.wafer:
        _wafer(work, item, device, frame @ at(face), first)
        work.cursor += 2 * (neck + pad) + device.length
        return
    sealed = _joint(work, frame, face, item.unit)
    face += pad
    if item.build is not None:
        inlet, outlet_ = _set(work, item, device, frame @ at(face))
        _join_bolts(work, sealed, first, work.tail - outlet_ + inlet)
        first = work.tail
        face += device.length
        sealed = _joint(work, frame, face, item.unit)
        face += pad
    # The bolts of a plain joint are of one mesh with its first flange.
    work.follow(flange(work.dn, style, grip=_grip(work) if item.build is not None else 0.0).placed(frame @ at(face)))
    _join_bolts(work, sealed, first, work.tail)
    work.cursor += face + neck


def _set(work: _Work, item: Inline, device: Device, pose: Floats) -> tuple[int, int]:
    """Puts a device in the run; returns its inlet and outlet as they follow along the run."""
    pose = pose @ spun("x", item.roll)
    inlet, outlet_ = device.inlet, device.outlet
    if item.reverse:
        pose, inlet, outlet_ = pose @ at(device.length) @ spun("z", np.pi), outlet_, inlet
    if item.unit or item.junction:
        work.devices[item.unit or item.junction] = work.count
    if any(unit.id == item.unit and unit.kind in ONE_WAY for unit in device.assembly.units):
        work.one_way[item.unit] = not item.reverse
    work.follow(device.assembly.placed(pose), inlet, outlet_)
    return inlet, outlet_


def _wafer(work: _Work, item: Inline, device: Device, frame: Floats, first: int) -> None:
    """A device without flanges between gaskets, held by long bolts; the second counter-flange."""
    style, pad, plate = work.style, _pad(work.style), plate_thickness(work.dn)
    work.follow(gasket(work.dn, style).placed(frame))
    _set(work, item, device, frame @ at(pad))
    far = 2 * pad + device.length
    work.follow(gasket(work.dn, style).placed(frame @ at(far - pad)))
    studs = bolts(work.dn, 2 * plate + far, style).marked(holds=item.unit)
    start = work.add(studs.placed(frame @ at(-plate)))
    clamped = range(start, work.count)
    work.follow(flange(work.dn, style).placed(frame @ at(far)))
    _join_bolts(work, clamped, first, work.tail)
    if style.fasteners == "flange" and not style.gaskets:
        # Without gaskets only here does the device keep the flanges apart, but not the bolts of the first.
        work.joints.append((first, work.tail))


def _grip(work: _Work) -> float:
    """What the bolts of a joint clamp [m]."""
    return 2 * plate_thickness(work.dn) + _pad(work.style)


def _joint(work: _Work, frame: Floats, face: float, unit: str = "") -> range:
    """Gasket and bolts at a face of a unit; returns the indices of the bolts' components."""
    style = work.style
    plate = plate_thickness(work.dn)
    work.follow(gasket(work.dn, style).placed(frame @ at(face)))
    studs = bolts(work.dn, _grip(work), style).placed(frame @ at(face - plate)).marked(holds=unit)
    first = work.add(studs)
    return range(first, work.count)


def _join_bolts(work: _Work, studs: range, first: int, second: int) -> None:
    """Records that the nuts press on the two flanges."""
    if work.style.fasteners == "flange" and work.style.gaskets:
        work.joints.append((first, second))
    for near, far in clamping(studs, work.style):
        work.joints += [(first, near), (second, far)]


def _begin(work: _Work) -> tuple[int, ...]:
    """What stands at the start of the run; returns what touches the outside, if it is more than the first pipe."""
    run, style = work.run, work.style
    kind = run.ends[0]
    if kind in ("open", "plate"):
        return ()
    frame, back = run.route.frame(0.0), spun("z", np.pi)
    pad = _pad(style)
    work.cursor = flange_length(work.dn, style)
    if kind == "joint":
        sealed = _joint(work, frame, 0.0)
        work.follow(flange(work.dn, style, grip=_grip(work)).placed(frame @ at(pad)))
        work.cursor += pad
        outside = _outer_bolts(work, sealed, work.tail, first=True)
        return (0 if pad else work.tail, *outside)
    if kind == "blind":
        work.follow(flange(work.dn, style, blind=True).placed(frame @ at(-pad) @ back))
        lid = work.tail
        sealed = _joint(work, frame, -pad)
        work.follow(flange(work.dn, style, grip=_grip(work)).placed(frame))
        _join_bolts(work, sealed, lid, work.tail)
        return ()
    work.follow(flange(work.dn, style).placed(frame))
    return ()


def _finish(work: _Work) -> tuple[int, ...]:
    """What stands at the end of the run; returns what touches the outside, if it is more than the last pipe."""
    run, style = work.run, work.style
    kind = run.ends[1]
    if kind in ("open", "plate"):
        return ()
    frame = run.route.frame(run.route.length)
    back = spun("z", np.pi)
    pad = _pad(style)
    face = -pad if kind == "joint" else 0.0
    work.follow(flange(work.dn, style, grip=0.0 if kind == "flange" else _grip(work)).placed(frame @ at(face) @ back))
    body = work.tail
    if kind == "flange":
        return ()
    sealed = _joint(work, frame, face)
    if kind == "blind":
        work.follow(flange(work.dn, style, blind=True).placed(frame @ at(face + pad)))
        _join_bolts(work, sealed, body, work.tail)
        return ()
    outside = _outer_bolts(work, sealed, body, first=False)
    return (work.tail if pad else body, *outside)


def _outer_bolts(work: _Work, studs: range, inner: int, first: bool) -> tuple[int, ...]:
    """Joins the bolts to the flange of the run; returns those components that press on the flange beyond."""
    outside = [inner] if work.style.fasteners == "flange" and work.style.gaskets else []
    for near, far in clamping(studs, work.style):
        work.joints.append((inner, far if first else near))
        outside.append(near if first else far)
    return tuple(outside)


def _weld_in(work: _Work, item: Inline) -> None:
    """A butt-welded fitting."""
    if item.build is None:
        return
    device = item.build(work.style)
    _set(work, item, device, work.run.route.frame(work.cursor))
    work.cursor += device.length


def _fill(work: _Work, stop: float) -> None:
    """Pipe from the cursor to a chainage, round the corners on the way."""
    run = work.run
    begin = work.cursor
    if stop - begin < -1e-9:
        raise ValueError(
            f"run {run.tag}: devices overlap at chainage {stop:.3f} m, where the run has come to {begin:.3f} m"
        )
    if stop - begin < _SHORTEST:
        return
    starts = run.route.starts
    corners = [i for i in range(1, len(run.route.points) - 1) if begin < starts[i] < stop]
    if corners and (run.bent or work.style.spool == "bent"):
        _bent(work, begin, stop, corners)
    else:
        _segments(work, begin, stop, corners)
    work.cursor = stop


def _bent(work: _Work, begin: float, stop: float, corners: list[int]) -> None:
    """One bent pipe through some corners."""
    run, route = work.run, work.run.route
    path = [route.point(begin)[None]]
    reached = begin
    for corner in corners:
        tangent, s = run.tangent(corner), route.starts[corner]
        if s - tangent < reached - 1e-9 or s + tangent > stop + 1e-9:
            raise ValueError(f"run {run.tag}: no room for the bend at chainage {s:.3f} m")
        reached = s + tangent
        directions = route.directions
        turn = float(np.arccos(np.clip(directions[corner - 1] @ directions[corner], -1, 1)))
        radius = tangent / np.tan(turn / 2)
        p = route.points[corner]
        steps = work.style.bend(radius + PIPES[work.dn].radius, turn)
        path.append(arc(p - tangent * directions[corner - 1], p, p + tangent * directions[corner], steps))
    path.append(route.point(stop)[None])
    points = np.concatenate(path)
    distinct = np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])
    points = points[distinct]
    origin = points[0]
    work.follow(spool(work.dn, points - origin, work.style).placed(at(*origin)))
    work.pieces.append(Piece(begin, stop, work.tail))


def _segments(work: _Work, begin: float, stop: float, corners: list[int]) -> None:
    """Straight pipes and elbows."""
    run, route = work.run, work.run.route
    for corner in [*corners, -1]:
        s = route.starts[corner] if corner > 0 else stop
        tangent = run.tangent(corner) if corner > 0 else 0.0
        length = s - tangent - begin
        if length < -1e-9:
            raise ValueError(f"run {run.tag}: no room for the elbow at chainage {s:.3f} m")
        if length >= _SHORTEST:
            work.follow(pipe(work.dn, length, work.style).placed(route.frame(begin)))
            work.pieces.append(Piece(begin, s - tangent, work.tail))
        if corner > 0:
            before, after = route.directions[corner - 1], route.directions[corner]
            turn = float(np.arccos(np.clip(before @ after, -1, 1)))
            pose = looking(route.points[corner] - tangent * before, before, np.cross(before, after))
            work.follow(elbow(work.dn, turn, work.style).placed(pose))
            begin = s + tangent


def _tap(work: _Work, laid: Laid, tap: Tap) -> None:
    """A branch outlet with an instrument on it."""
    run = work.run
    frame, dn = run.route.frame(tap.s, tap.roll), run.dn_at(tap.s)
    foot = work.add(outlet(dn, work.style, height=OUTLET_HEIGHT).placed(frame))
    work.joints.append((laid.at(tap.s), foot))
    top = frame @ at(0, 0, PIPES[dn].radius + OUTLET_HEIGHT)
    work.joints.append((foot, work.add(tap.build(work.style).placed(top))))
