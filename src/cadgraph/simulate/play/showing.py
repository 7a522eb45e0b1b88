"""A film written down: ``animation.usda``, ``animation.png`` and ``animation.gif``."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from cadgraph.hydraulics.settings import Scenario
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.simulate.play.animation import write_animation
from cadgraph.simulate.play.film import Film
from cadgraph.simulate.play.strip import Gauge, Strip

__all__ = ["ANIMATION", "SIMULATION", "Shown", "show", "shown_gauges"]

SIMULATION, ANIMATION = "simulation.usda", "animation.usda"
"""The stage that can be simulated, and the layer of time samples over it."""


@dataclass(frozen=True)
class Shown:
    """What was written.

    Args:
        files: in the order in which they were.
        times: of the pictures in the strip [s].
        still: names of joints that move in the film, but that the stage doesn't have.
    """

    files: tuple[Path, ...]
    times: tuple[float, ...]
    still: tuple[str, ...]


def shown_gauges(scenario: Scenario) -> tuple[Gauge, ...]:
    """The gauges that show anything, with what is at the end of their scales.

    Args:
        scenario: of the plant.
    """
    return tuple(
        Gauge(tag, gauge.span, gauge.unit)
        for tag, gauge in scenario.gauges.items()
        if gauge.measures != "nothing" and gauge.span is not None and gauge.unit is not None
    )


def show(film: Film, graph: SceneGraph, scene: Scene, scenario: Scenario, folder: str | Path) -> Shown:
    """Writes a film into a folder; without ``simulation.usda`` there, the pictures alone.

    Args:
        film: what the plant does.
        graph: the finished graph.
        scene: that it was made from.
        scenario: that it was played under.
        folder: where to.

    Raises:
        LoadError: the stage can't be opened.
        OutputError: a file can't be written.
    """
    target = Path(folder)
    files: tuple[Path, ...] = ()
    still: tuple[str, ...] = ()
    if (target / SIMULATION).exists():
        still = write_animation(film, target / SIMULATION, target / ANIMATION)
        files = (target / ANIMATION,)
    strip = Strip(graph, scene.in_path_order(), film, shown_gauges(scenario))
    times = strip.write_png(target / "animation.png")
    strip.write_gif(target / "animation.gif")
    return Shown((*files, target / "animation.png", target / "animation.gif"), times, still)
