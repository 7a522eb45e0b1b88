"""The option ``--play`` of simulate: a timetable played, its film written down."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.markup import escape

from cadgraph.cli.screen import out

if TYPE_CHECKING:
    from cadgraph.hydraulics.process import Process
    from cadgraph.simulate.play.timetable import Timetable

__all__ = ["play_timetable", "say_played", "supposed_by"]


def supposed_by(timetable: Path, scenario: Path | None) -> Path | None:
    """The file that says what is supposed while a timetable is played: the timetable's own, if it says that much.

    Args:
        timetable: the file with the list ``play``.
        scenario: the one that was named, which goes first.
    """
    from cadgraph.simulate.play.timetable import says_more

    return timetable if scenario is None and says_more(timetable) else scenario


def play_timetable(process: Process, file: Path, seconds: float, folder: Path) -> dict[str, Any]:
    """Plays a timetable and writes ``animation.usda``, ``animation.png`` and ``animation.gif``.

    Args:
        process: of the plant.
        file: the timetable.
        seconds: how long.
        folder: that holds the graph, and gets the files.

    Returns:
        What was played and written, for JSON.
    """
    from cadgraph.config import restore_config
    from cadgraph.load import load
    from cadgraph.session.reopen import find_source
    from cadgraph.simulate.play.film import play
    from cadgraph.simulate.play.showing import show
    from cadgraph.simulate.play.timetable import read_timetable

    graph = process.network.graph
    timetable = read_timetable(file, process.network)
    scene = load(find_source(graph, folder, None), restore_config(graph.document.config).load)
    film = play(process, timetable, seconds)
    shown = show(film, graph, scene, process.scenario, folder)
    return {
        "played": {"seconds": film.seconds, "moves": [move.values() for move in timetable.moves]},
        "pictures": list(shown.times),
        "written": [str(path) for path in shown.files],
        "still": list(shown.still),
        "late": _late(timetable, film.seconds),
    }


def say_played(values: dict[str, Any]) -> None:
    """Says what was played and written.

    Args:
        values: what :func:`play_timetable` says.
    """
    played = values["played"]
    out.print(f"played {played['seconds']:g} s; pictures at " + ", ".join(f"{t:g} s" for t in values["pictures"]))
    if values["late"]:
        out.print(f"note: {values['late']} of the moves begin later; give more --seconds")
    if values["still"]:
        out.print(escape(f"note: simulation.usda has no joints {', '.join(values['still'])}; these stay as drawn"))
    for path in values["written"]:
        out.print(escape(f"wrote {path}"))


def _late(timetable: Timetable, seconds: float) -> int:
    return sum(move.at >= seconds for move in timetable.moves)
