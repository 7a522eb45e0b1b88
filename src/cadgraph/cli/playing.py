"""The option ``--play`` of simulate: a timetable played, its film written down."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.markup import escape

from cadgraph.cli.screen import out

if TYPE_CHECKING:
    from cadgraph.hydraulics.process import Process
    from cadgraph.simulate.play.film import Film

__all__ = ["play_timetable", "say_played", "show_film", "supposed_by"]

_TOLD = 5  # of what has no joint


def supposed_by(timetable: Path, scenario: Path | None) -> Path | None:
    """The file that says what is supposed while a timetable is played: the timetable's own, if it says that much.

    Args:
        timetable: the file with the list ``play``.
        scenario: the one that was named, which goes first.
    """
    from cadgraph.simulate.play.timetable import says_more

    return timetable if scenario is None and says_more(timetable) else scenario


def play_timetable(process: Process, file: Path, seconds: float) -> Film:
    """Plays a timetable.

    Args:
        process: of the plant.
        file: the timetable.
        seconds: how long.
    """
    from cadgraph.simulate.play.film import play
    from cadgraph.simulate.play.timetable import read_timetable

    return play(process, read_timetable(file, process.network), seconds)


def show_film(film: Film, process: Process, source: Path | None, folder: Path) -> dict[str, Any]:
    """Writes ``animation.usda`` over the stage that was written beforehand, ``animation.png`` and ``animation.gif``.

    Args:
        film: what was played.
        process: of the plant.
        source: where the file is that the graph was made from; None: where it was.
        folder: that holds the graph, and gets the files.

    Returns:
        What was played and written, for JSON and for :func:`say_played`.
    """
    from cadgraph._io.run_folder import coming_into
    from cadgraph.config import restore_config
    from cadgraph.load import load
    from cadgraph.model.source_file import find_source
    from cadgraph.simulate.play.showing import show

    graph = process.network.graph
    scene = load(find_source(graph.source, folder, source), restore_config(graph.config).load)
    with coming_into(folder):
        shown = show(film, graph, scene, process.scenario, folder)
    return {
        "played": {"seconds": film.seconds, "moves": [move.values() for move in film.moves]},
        "pictures": list(shown.times),
        "written": [str(path) for path in shown.files],
        "still": list(shown.still),
        "late": sum(move.at >= film.seconds for move in film.moves),
    }


def say_played(values: dict[str, Any]) -> None:
    """Says what was played and written.

    Args:
        values: what :func:`show_film` says.
    """
    played = values["played"]
    out.print(f"played {played['seconds']:g} s; pictures at " + ", ".join(f"{t:g} s" for t in values["pictures"]))
    if values["late"]:
        out.print(f"note: {values['late']} of the moves begin later; give more --seconds")
    if values["still"]:
        told = ", ".join(values["still"][:_TOLD]) + (" ..." if len(values["still"]) > _TOLD else "")
        out.print(escape(f"note: nothing that moves at {told} in simulation.usda; --needles draws what gauges lack"))
    for path in values["written"]:
        out.print(f"wrote {escape(path)}")
