"""A server for agents, and a picture as it sends them: serve, picture."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.correcting import user_name
from cadgraph.cli.options import GraphArgument
from cadgraph.cli.panels import ASK, LOOK
from cadgraph.cli.screen import err, out
from cadgraph.cli.signals import Stopped
from cadgraph.errors import MissingExtra

if TYPE_CHECKING:
    from cadgraph.agents.plants import Plants


@app.command(rich_help_panel=ASK)
def serve(
    where: Annotated[
        Path,
        typer.Argument(metavar="FOLDER", help="What 'cadgraph build' wrote, or a folder that holds several of these."),
    ],
    http: Annotated[
        bool, typer.Option("--http", help="Answer over HTTP on this machine, not over standard input and output.")
    ] = False,
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="With --http; 0 takes any that is free.")] = 0,
    host: Annotated[
        str, typer.Option("--host", metavar="ADDRESS", help="With --http: listen elsewhere than on this machine alone.")
    ] = "127.0.0.1",
    write: Annotated[bool, typer.Option("--write", help="Also offer a tool that corrects labels.")] = False,
    who: Annotated[
        str | None,
        typer.Option("--who", metavar="NAME", help="With --write: who corrects; 'agent of' your user name if none."),
    ] = None,
) -> None:
    """Answer the questions of agents about a plant: a server of the Model Context Protocol.

    An MCP client starts it and speaks with it over standard input and output. Its tools are the questions that the
    command line has too; all only read, unless --write is given. Then each correction is in corrections.json before it
    is answered, with who made it and why, and nothing else may change the folder meanwhile.
    """
    try:
        from cadgraph.agents.mcp.stdio import serve_stdio
    except ModuleNotFoundError as error:
        if not (error.name or "").partition(".")[0].startswith(("mcp", "anyio")):
            raise
        raise MissingExtra("a server for agents", "agents") from None
    from cadgraph.agents.plants import Plants

    if not http and (port or host != "127.0.0.1"):
        raise ValueError("--port and --host go with --http")
    if who is not None and not write:
        raise ValueError("--who goes with --write")
    name = (f"agent of {user_name()}".removesuffix(" of ") if who is None else who) if write else None
    plants = Plants(where, name)
    try:
        if http:
            from cadgraph.agents.mcp.http import serve_http

            # Standard output is left to protocols.
            serve_http(plants, host, port, _say)
        else:
            serve_stdio(plants, lambda: _end(plants))
    except* Stopped as stops:
        _heed(stops)
        _end(plants)
    finally:
        _close(plants)


def _end(plants: Plants) -> NoReturn:
    """Writes what is left to be written and ends the process, whatever its threads wait for."""
    _close(plants)
    sys.stderr.flush()
    os._exit(0)


def _heed(stop: BaseException) -> None:
    """Says that the wish to end is heeded, so that writing what is left may take its time."""
    while isinstance(stop, BaseExceptionGroup):
        stop = stop.exceptions[0]
    if isinstance(stop, Stopped):
        stop.got_through()


def _close(plants: Plants) -> None:
    """Writes what is left to be written; a second signal leaves that to the next run."""
    try:
        for failed in plants.close():
            _say(f"corrections are kept, but the graph is not written: {failed}")
    except Stopped:
        _say("corrections are kept, but the graph is not written; the next run makes up for that")


@app.command(rich_help_panel=LOOK)
def picture(
    graph: GraphArgument,
    target: Annotated[
        str, typer.Argument(metavar="TARGET", help="Tag or id of a unit, part, junction, end, structure or system.")
    ],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="FILE", help="The picture; ./TARGET.png by default.")
    ] = None,
) -> None:
    """Draw one thing in red among all others, with its neighbours tagged."""
    from cadgraph._io.atomic import write_atomically
    from cadgraph.agents.picture import picture as draw
    from cadgraph.agents.plant import Plant

    if output is not None and output.suffix.lower() != ".png":
        raise ValueError(f"{output}: a picture is written as PNG; give a file that ends in .png")
    plant = Plant.open(graph)
    # A name from a file is no path.
    plain = "".join(
        letter if letter.isalnum() or letter in "-_" else "_" for letter in plant.called(plant.find(target).id)
    )
    file = output or Path(f"{plain}.png")
    drawn = draw(plant, target)
    write_atomically(file, drawn.png)
    out.print(escape(drawn.text))
    out.print(f"wrote {escape(str(file))}")


def _say(line: str) -> None:
    err.print(escape(line))
