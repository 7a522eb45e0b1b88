"""A film for people without a USD viewer: ``animation.png``, a strip of pictures, and ``animation.gif``.

Each picture shows the plant, coloured by where it flows, and below it what one looks at closely: what is operated and
the gauges that answer, with their readings. Drawn by our own renderer; the same film gives the same bytes on one
machine.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from cadgraph._io.atomic import write_atomically
from cadgraph.hydraulics.settings import Move
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Unit
from cadgraph.model.scene import Scene
from cadgraph.simulate.play.chart import Line, draw_chart, fitted, font
from cadgraph.simulate.play.closeup import Closeup
from cadgraph.simulate.play.film import Film, key_times
from cadgraph.simulate.play.scenery import FLOWING, OPERATED, STILL, Scenery

__all__ = ["Gauge", "Strip"]

_WIDTH, _PLANT = 480, 320  # [px] of one picture, and the height of its upper part
_PANELS = 5
_MOST_OPERATED = 2  # of the panels; the rest is for gauges
_GAP = 8
_BAR, _REMARK = 40, 18  # [px] height of the line with the time, and of one with a remark
_CAPTION = 62  # [px] below a panel
_GIF_FRAMES, _GIF_PAUSE, _GIF_LAST = 48, 120, 1800  # pictures; [ms] of each, and of the last
_INK, _PALE, _CHANGED = "#1c2128", "#6a7480", "#b3261e"
_PAPER, _TABLE, _LINE = "#ffffff", "#e3e7ec", "#c8ced6"
_COLUMNS = 3
_MOST_DEEDS = 4
_NOTICED = 0.01  # of a gauge's span: what changes less doesn't count as a change
_LEAST_FLOW = 0.1 / 3600  # m3/s
_THERE = 0.005  # of the way of a valve


@dataclass(frozen=True)
class Gauge:
    """How a gauge is read.

    Args:
        tag: of it.
        span: from the least to the greatest reading.
        unit: of the reading, as it is written.
    """

    tag: str
    span: float
    unit: str


class Strip:
    """Draws a film.

    Args:
        graph: the finished graph.
        scene: of it, as prepared for building.
        film: what the plant does.
        gauges: those that can be read.
    """

    def __init__(self, graph: SceneGraph, scene: Scene, film: Film, gauges: Sequence[Gauge]) -> None:
        self.graph, self.film = graph, film
        self._gauges = {gauge.tag: gauge for gauge in gauges}
        shown = _by_change(film, gauges)
        operated = [graph.unit(tag) for tag in film.tags]
        self._changed = [tag for tag in shown if _change(film, self._gauges[tag]) > _NOTICED]
        room = _PANELS - min(len(operated), _MOST_OPERATED)
        units = [*operated[: _PANELS - min(room, len(shown))], *(graph.unit(tag) for tag in shown[:room])]
        self._shown = [unit.tag for unit in units if unit.unit_type == "gauge"]
        focus = list(dict.fromkeys([*film.tags, *(unit.tag for unit in units), *self._changed]))
        self._scenery = Scenery(graph, scene, film, focus, (_WIDTH, _PLANT))
        side = (_WIDTH - (_PANELS + 1) * _GAP) // _PANELS
        self._side = side
        self._closeups = [Closeup(graph, scene, film, unit, side) for unit in units]
        self._ends = _ends_of(graph)

    def write_png(self, path: str | Path) -> tuple[float, ...]:
        """Writes the strip: five pictures that tell what happened, and a summary.

        Args:
            path: of the PNG file.

        Returns:
            The times of its pictures [s].

        Raises:
            OutputError: it can't be written.
        """
        numbers = [self.film.number(time) for time in key_times(self.film.moves, self.film.seconds)]
        plants = self._scenery.pictures(numbers)
        cells = [self._compose(number, plants[number]) for number in numbers]
        cells.append(self._summary(cells[0].size, numbers))
        wide, tall = cells[0].size
        rows = -(-len(cells) // _COLUMNS)
        sheet = Image.new("RGB", (_COLUMNS * (wide + _GAP) + _GAP, rows * (tall + _GAP) + _GAP), _TABLE)
        for k, cell in enumerate(cells):
            row, column = divmod(k, _COLUMNS)
            sheet.paste(cell, (_GAP + column * (wide + _GAP), _GAP + row * (tall + _GAP)))
        _write(sheet, path, "PNG", optimize=True)
        return tuple(number / self.film.per_second for number in numbers)

    def write_gif(self, path: str | Path) -> None:
        """Writes the film as a GIF of 49 pictures that takes about seven seconds, however long the film is.

        Args:
            path: of the GIF file.

        Raises:
            OutputError: it can't be written.
        """
        last = len(self.film.states) - 1
        numbers = list(dict.fromkeys(np.linspace(0, last, min(last, _GIF_FRAMES) + 1).round().astype(int).tolist()))
        plants = self._scenery.pictures(numbers)
        pictures = [self._compose(number, plants[number]) for number in numbers]
        # One palette for all, of pictures that show all colours: what stands still doesn't flicker.
        sample = Image.new("RGB", (_WIDTH, 3 * pictures[0].height))
        for k, picture in enumerate((pictures[0], pictures[len(pictures) // 2], pictures[-1])):
            sample.paste(picture, (0, k * picture.height))
        palette = sample.quantize(255, method=Image.Quantize.MEDIANCUT)
        flat = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
        pauses = [_GIF_PAUSE] * (len(flat) - 1) + [_GIF_LAST]
        _write(flat[0], path, "GIF", save_all=True, append_images=flat[1:], duration=pauses, loop=0, optimize=False)

    def _compose(self, number: int, plant: Image.Image) -> Image.Image:
        """A picture of the plant with the time, and close-ups with captions below."""
        picture = Image.new("RGB", (_WIDTH, _PLANT + _BAR + _REMARK + self._side + _CAPTION + _GAP), _PAPER)
        picture.paste(plant, (0, 0))
        draw = ImageDraw.Draw(picture)
        middle = _PLANT + _BAR / 2
        draw.text((_GAP, middle), f"{number / self.film.per_second:.1f} s", _INK, font(25), "lm")
        said = self._event(number)
        draw.text((_WIDTH - _GAP, middle), said, _INK, fitted(said, _WIDTH - 130), "rm")
        remark = self._remark(number)
        draw.text((_WIDTH / 2, _PLANT + _BAR + 4), remark, _CHANGED, fitted(remark, _WIDTH - 2 * _GAP, 15), "mm")
        for k, closeup in enumerate(self._closeups):
            self._panel(picture, closeup, _GAP + k * (self._side + _GAP), number)
        return picture

    def _panel(self, picture: Image.Image, closeup: Closeup, left: int, number: int) -> None:
        unit, side, top, draw = closeup.unit, self._side, _PLANT + _BAR + _REMARK, ImageDraw.Draw(picture)
        state, now, before = self.film.states[number], *(self._said(unit, at) for at in (number, 0))
        picture.paste(closeup.picture(number, self._runs(unit, number)), (left, top))
        color = OPERATED if unit.tag in self.film.tags else _LINE
        draw.rectangle((left, top, left + side - 1, top + side - 1), None, color, 2)
        middle = left + side / 2
        draw.text((middle, top + side + 4), unit.tag, _PALE, font(15), "ma")
        draw.text((middle, top + side + 22), now, _CHANGED if now != before else _INK, fitted(now, side, 17), "ma")
        if now != before:
            draw.text((middle, top + side + 43), f"was {before}", _PALE, fitted(f"was {before}", side, 14), "ma")
        elif state is not self.film.states[0] and unit.unit_type == "gauge":
            draw.text((middle, top + side + 43), "as before", _PALE, font(14), "ma")

    def _said(self, unit: Unit, number: int) -> str:
        """What a caption says of a unit."""
        state = self.film.states[number]
        if unit.unit_type == "gauge":
            reading, gauge = state.reading.get(unit.tag), self._gauges[unit.tag]
            return "unknown" if reading is None else f"{_decimals(reading, gauge.span)} {gauge.unit}"
        if unit.unit_type == "valve":
            return _opening(state.opening[unit.tag])
        if state.speed.get(unit.tag) == 0:
            return "stopped"
        return "running" if self._runs(unit, number) else "no flow"

    def _runs(self, unit: Unit, number: int) -> bool:
        flow = self.film.states[number].flow
        return any(abs(flow.get(index, 0.0)) >= _LEAST_FLOW for index in self._ends.get(unit.id, ()))

    def _event(self, number: int) -> str:
        """What is being done, or was done last."""
        time = number / self.film.per_second
        begun = [move for move in self.film.moves if move.at < time]
        if not begun:
            return "before anything is done"
        move = begun[-1]
        opening = self.film.states[number].opening
        # A valve takes its time, however soon it is told to be somewhere.
        done = {
            tag: time >= move.at + move.over and abs(opening.get(tag, value) - value) < _THERE
            for tag, value in move.set.items()
        }
        return ", ".join(self._deed(tag, value, done[tag]) for tag, value in move.set.items())

    def _remark(self, number: int) -> str:
        """What is to be said of a moment that wasn't from the beginning on."""
        new = [text for text in self.film.states[number].remarks if text not in self.film.states[0].remarks]
        return new[0] + (f" (and {len(new) - 1} more)" if len(new) > 1 else "") if new else ""

    def _deed(self, tag: str, value: float, done: bool) -> str:
        unit = self.graph.unit(tag)
        if unit.unit_type == "pump":
            return f"{tag} {'stopped' if value == 0 else 'runs' if value == 1 else f'at {value:.0%} of its speed'}"
        if done:
            return f"{tag} {_opening(value)}"
        return f"{tag} is being {'closed' if value < self.film.states[0].opening.get(tag, 1.0) else 'opened'}"

    def _summary(self, size: tuple[int, int], numbers: Sequence[int]) -> Image.Image:
        """What is done, what the gauges say all the while, and what the colours mean."""
        cell = Image.new("RGB", size, _PAPER)
        draw, top = ImageDraw.Draw(cell), 14
        draw.text((_GAP + 4, top), "What is done", _PALE, font(17))
        for when, what in self._deeds():
            top += 25
            draw.text((_GAP + 4, top), when, _INK, font(17))
            draw.text((_GAP + 124, top), what, _INK, fitted(what, size[0] - 140, 17))
        top += 40
        times = np.arange(len(self.film.states)) / self.film.per_second
        lines = [Line(tag, readings) for tag in self._shown if np.isfinite(readings := self.film.readings(tag)).any()]
        marks = [number / self.film.per_second for number in numbers]
        legend = size[1] - 46
        if lines:
            units = sorted({self._gauges[tag].unit for tag in self._shown})
            draw_chart(draw, (_GAP + 4, top, size[0] - 2 * _GAP, legend - 12), times, lines, marks, ", ".join(units))
        left = _GAP + 4
        for color, text in ((FLOWING, "flows"), (STILL, "stands still"), (OPERATED, "operated")):
            draw.rectangle((left, legend + 12, left + 16, legend + 28), color)
            draw.text((left + 22, legend + 20), text, _INK, font(15), "lm")
            left += 36 + round(font(15).getlength(text))
        rest = len(self._gauges) - len(self._changed)
        if rest and self._changed:
            said = f"{rest} more gauge{'s' * (rest > 1)}: no change"
            draw.text((size[0] - 2 * _GAP, legend + 20), said, _PALE, fitted(said, size[0] - left - 24, 15), "rm")
        return cell

    def _deeds(self) -> list[tuple[str, str]]:
        """When what is done, the first few."""
        moves = self.film.moves[: _MOST_DEEDS - (len(self.film.moves) > _MOST_DEEDS)]
        told = []
        for move in moves:
            when = f"{move.at:.1f} s" if move.over == 0 else f"{move.at:.1f} to {move.at + move.over:.1f} s"
            told.append((when, ", ".join(self._told(move, tag, value) for tag, value in move.set.items())))
        if len(moves) < len(self.film.moves):
            told.append(("", f"and {len(self.film.moves) - len(moves)} more"))
        return told

    def _told(self, move: Move, tag: str, value: float) -> str:
        """What a move does to one thing; one that another takes over before its end doesn't get there."""
        ends = move.at + move.over
        broken_off = next((one.at for one in self.film.moves if tag in one.set and move.at < one.at < ends), None)
        said = self._deed(tag, value, True)
        return said if broken_off is None else f"{said}, broken off at {broken_off:.1f} s"


def _change(film: Film, gauge: Gauge) -> float:
    """How much a reading changes in a film, as share of the span."""
    readings = film.readings(gauge.tag)
    known = readings[np.isfinite(readings)]
    return float(np.ptp(known)) / gauge.span if len(known) else 0.0


def _by_change(film: Film, gauges: Sequence[Gauge]) -> list[str]:
    """The tags of gauges, those that change most first."""
    ordered = sorted(gauges, key=lambda gauge: (-round(_change(film, gauge), 6), gauge.tag))
    return [gauge.tag for gauge in ordered]


def _ends_of(graph: SceneGraph) -> dict[str, tuple[int, ...]]:
    """The numbers of the connections at each node."""
    found: dict[str, tuple[int, ...]] = {}
    for index, edge in enumerate(graph.of_kind(Connected)):
        for end in (edge.source, edge.target):
            found[end] = (*found.get(end, ()), index)
    return found


def _opening(value: float) -> str:
    return "shut" if value < 0.005 else "open" if value > 0.995 else f"{value:.0%} open"


def _decimals(reading: float, span: float) -> str:
    """A reading as one reads it off a dial: to about a two-hundredth of the span."""
    digits = 2 if span <= 10 else 1 if span <= 100 else 0
    return f"{round(reading, digits) + 0.0:.{digits}f}"


def _write(image: Image.Image, path: str | Path, form: str, **options: object) -> None:
    file = io.BytesIO()
    image.save(file, form, **options)
    write_atomically(path, file.getvalue())
