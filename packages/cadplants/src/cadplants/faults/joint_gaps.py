"""Joints as they are drawn by others: apart, overlapping, without gaskets, with the pipe set back in its flange."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.faults.slip_on import slipped_on
from cadplants.faults.tubes import Joint, Tube, find_joints, find_tubes, trimmed
from cadplants.model.plant import Component, Plant
from cadplants.solids.transforms import at

__all__ = ["Span", "open_joints"]

Span = tuple[float, float]

_FASTENERS = ("bolt", "nut", "washer", "stud", "screw")


@dataclass
class _Pulled:
    """A plant whose joints are being changed.

    Args:
        plant: as it was.
        rng: of all sizes.
        tubes: its pipes.
        joints: of the pipes' ends.
        beside: what touches each component.
        off: what is taken off a pipe at an end [m].
        moved: how far a component moves [m].
        solids: shapes that take the place of others.
        gone: components that are left out.
        seated: ends of pipes that lie in a flange.
    """

    plant: Plant
    rng: np.random.Generator
    tubes: dict[int, Tube]
    joints: list[Joint]
    beside: dict[int, list[int]]
    off: dict[tuple[int, int], float] = field(default_factory=lambda: defaultdict(float))
    moved: dict[int, Floats] = field(default_factory=lambda: defaultdict(lambda: np.zeros(3)))
    solids: dict[int, Component] = field(default_factory=dict)
    gone: set[int] = field(default_factory=set)
    seated: set[tuple[int, int]] = field(default_factory=set)

    def draw(self, span: Span) -> float:
        """A size between two [m]."""
        return float(self.rng.uniform(*span))

    def pipe_of(self, flange: int) -> Joint | None:
        """The pipe that ends in a flange."""
        return next((joint for joint in self.joints if joint.partner == flange), None)

    def shift(self, some: Iterable[int], step: Floats) -> None:
        """Moves components by a step ``(3,)`` [m]."""
        for i in some:
            self.moved[i] = self.moved[i] + step

    def draw_back(self, flange: int, gap: float) -> bool:
        """Moves a flange away from its face, and the end of its pipe with it; whether it could."""
        component, joint = self.plant.components[flange], self.pipe_of(flange)
        if component.name == "flange" and joint is None:
            return False
        away = component.pose[:3, 0] / np.linalg.norm(component.pose[:3, 0])
        self.shift([flange], gap * away)
        if joint is not None:
            self.off[joint.pipe, joint.end] += gap
        return True


def open_joints(
    plant: Plant,
    rng: np.random.Generator,
    gaps: Span | None = None,
    faces: Span | None = None,
    setback: Span | None = None,
    screwed: Span | None = None,
) -> Plant:
    """The plant with its joints drawn otherwise; what follows what along its lines stays as it is.

    Args:
        plant: whose joints are closed.
        rng: of the sizes.
        gaps: between a pipe's end and what it meets, between flanges' faces and what they press on, and below branch
            outlets; negative: they run into each other [m].
        faces: between the faces of flanged joints, which then have no gaskets [m].
        setback: how far behind its flange's face a pipe ends; the flange becomes a slip-on flange [m].
        screwed: between an instrument and its branch outlet, and between its siphon and stem [m].
    """
    tubes = find_tubes(plant)
    beside: dict[int, list[int]] = defaultdict(list)
    for a, b in plant.contacts:
        beside[a].append(b)
        beside[b].append(a)
    pulled = _Pulled(plant, rng, tubes, find_joints(plant, tubes), beside)
    if setback:
        _set_back(pulled, setback)
    if faces:
        _leave_gaskets_out(pulled, faces)
    if gaps:
        _pull_apart(pulled, gaps, shut=faces is not None)
    if screwed:
        _unscrew(pulled, screwed)
    return _redrawn(pulled)


def _flanges(pulled: _Pulled) -> Iterable[int]:
    for i, component in enumerate(pulled.plant.components):
        if component.name in ("flange", "blind flange") and component.line:
            yield i


def _set_back(pulled: _Pulled, setback: Span) -> None:
    """Pipes run into their flanges and end behind their faces."""
    for flange in _flanges(pulled):
        component, joint = pulled.plant.components[flange], pulled.pipe_of(flange)
        if joint is None or component.name != "flange":
            continue
        solid = slipped_on(component.solid)
        if solid is None:
            continue
        tube = pulled.tubes[joint.pipe]
        end = tube.axis.point((tube.low, tube.high)[joint.end])
        depth = float((np.linalg.inv(component.pose) @ np.append(end, 1.0))[0])
        pulled.solids[flange] = replace(component, solid=solid, family="flange/slip")
        pulled.off[joint.pipe, joint.end] -= depth - pulled.draw(setback)
        pulled.seated.add((joint.pipe, joint.end))


def _beyond(pulled: _Pulled, flange: int) -> tuple[int, int] | None:
    """What a flange presses on, and the gasket in between (-1: none); None where its face is open."""
    near = [i for i in _beside(pulled, flange) if i not in pulled.tubes and _in_front(pulled, flange, i)]
    pad = next((i for i in near if pulled.plant.components[i].name == "gasket"), -1)
    if pad >= 0:
        near = [i for i in _beside(pulled, pad) if i != flange]
    return (near[0], pad) if near else None


def _beside(pulled: _Pulled, i: int) -> list[int]:
    """What a component touches in its line."""
    return [other for other in pulled.beside[i] if _in_line(pulled.plant.components[other])]


def _in_front(pulled: _Pulled, flange: int, other: int) -> bool:
    """Whether a component lies before a flange's face, but for what reaches over it."""
    inward = np.linalg.inv(pulled.plant.components[flange].pose)
    x = (pulled.plant.components[other].vertices @ inward[:3, :3].T + inward[:3, 3])[:, 0]
    return bool(x.min() < -0.001 and x.max() < 0.01 + 0.5 * np.ptp(x))


def _in_line(component: Component) -> bool:
    return component.name not in _FASTENERS and bool(component.group) and component.group != "Structural element"


def _leave_gaskets_out(pulled: _Pulled, faces: Span) -> None:
    """The faces of flanged joints stand apart with nothing in between."""
    done: set[frozenset[int]] = set()
    for flange in _flanges(pulled):
        found = _beyond(pulled, flange)
        if found is None or frozenset((flange, found[0])) in done:
            continue
        far, pad = found
        if pulled.draw_back(flange, pulled.draw(faces) - (_thickness(pulled, pad) if pad >= 0 else 0.0)):
            done.add(frozenset((flange, far)))
            pulled.gone.update({pad} - {-1})


def _thickness(pulled: _Pulled, pad: int) -> float:
    component = pulled.plant.components[pad]
    return float(np.ptp(component.solid.vertices[:, 0]) * np.linalg.norm(component.pose[:3, 0]))


def _pull_apart(pulled: _Pulled, gaps: Span, shut: bool) -> None:
    """Pipes end before what they meet, faces stand apart unless that is settled, outlets stand over their pipe."""
    done: set[frozenset[int]] = set()
    for joint in pulled.joints:
        pair = frozenset((joint.pipe, joint.partner))
        if (joint.pipe, joint.end) not in pulled.seated and pair not in done:
            done.add(pair)
            pulled.off[joint.pipe, joint.end] += pulled.draw(gaps)
    if not shut:
        for flange in _flanges(pulled):
            found = _beyond(pulled, flange)
            if found is not None and frozenset((flange, found[0])) not in done:
                done.add(frozenset((flange, found[0])))
                pulled.draw_back(flange, pulled.draw(gaps))
    for outlet, unit in _taps(pulled):
        pulled.shift([outlet, *unit], pulled.draw(gaps) * pulled.plant.components[outlet].pose[:3, 2])


def _taps(pulled: _Pulled) -> Iterable[tuple[int, list[int]]]:
    """Branch outlets with the components of the unit that stands on each."""
    components = pulled.plant.components
    for i, component in enumerate(components):
        if component.name == "branch outlet":
            units = sorted({components[j].unit for j in pulled.beside[i]} - {""})
            yield i, [j for j, other in enumerate(components) if other.unit in units]


def _unscrew(pulled: _Pulled, screwed: Span) -> None:
    """Instruments stand a little over their outlets, stems a little over their siphons."""
    components = pulled.plant.components
    for outlet, unit in _taps(pulled):
        pulled.shift(unit, pulled.draw(screwed) * components[outlet].pose[:3, 2])
        stems = [i for i in unit if components[i].name == "gauge stem"]
        siphons = {i for i in unit if components[i].name == "siphon"}
        if stems and siphons:
            rise = pulled.draw(screwed) * components[stems[0]].pose[:3, 2]
            pulled.shift([i for i in unit if i not in siphons], rise)


def _redrawn(pulled: _Pulled) -> Plant:
    """The plant with all that was pulled."""
    components = list(pulled.plant.components)
    for i, component in pulled.solids.items():
        components[i] = component
    for pipe in {pipe for pipe, _ in pulled.off}:
        components[pipe] = trimmed(components[pipe], pulled.tubes[pipe], pulled.off[pipe, 0], pulled.off[pipe, 1])
    for i, step in pulled.moved.items():
        components[i] = replace(components[i], pose=at(*step) @ components[i].pose)
    return replace(pulled.plant, components=tuple(components)).without(pulled.gone)
