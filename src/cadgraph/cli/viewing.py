"""The plant in the browser: view."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from cadgraph.cli.application import app
from cadgraph.cli.correcting import user_name
from cadgraph.cli.options import ConfigOption, SetOption, settings_of
from cadgraph.cli.panels import LOOK
from cadgraph.cli.screen import err, out
from cadgraph.cli.signals import Stopped
from cadgraph.errors import MissingExtra


@app.command(rich_help_panel=LOOK)
def view(
    what: Annotated[
        Path, typer.Argument(metavar="WHAT", help="A folder that 'cadgraph build' wrote, or a scene to build first.")
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="FOLDER", help="Of a scene: where the results go; ./NAME of the scene by default."
        ),
    ] = None,
    scene: Annotated[
        Path | None, typer.Option("--scene", metavar="FILE", help="Of a folder: the scene, if it has been moved.")
    ] = None,
    who: Annotated[
        str | None, typer.Option("--who", metavar="NAME", help="Who corrects; your name on this machine by default.")
    ] = None,
    report: Annotated[bool, typer.Option("--report", help="Draw the report anew at the end.")] = False,
    host: Annotated[
        str, typer.Option("--host", metavar="ADDRESS", help="Listen elsewhere than on this machine alone.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="0 takes any that is free.")] = 0,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page.")] = True,
    config: ConfigOption = None,
    settings: SetOption = None,
) -> None:
    """See a plant in the browser and correct it: labels, units, joints, directions, tags.

    A scene is built first, with its progress in the page; of a scene whose results are there already, these are opened.
    --config and --set build it anew. The page is served on this machine alone, works offline, and needs the token in
    the address that is printed. Each correction is in corrections.json before the page shows it; graph.json and
    semantics.usda follow a moment later. The report then says that it shows an earlier graph; --report draws it anew.
    """
    try:
        from cadgraph.serve.order import order_of
        from cadgraph.serve.running import Options, view
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("starlette", "uvicorn", "anyio", "h11"):
            raise
        raise MissingExtra("the viewer in the browser", "view") from None
    chosen = settings_of(config, settings or [], None) if config or settings else None
    order = order_of(what, output, scene, chosen)
    ending = view(order, Options(host, port, browser, user_name() if who is None else who, report), _say)
    if ending.status == "building":
        stop = Stopped(ending.signal)
        if not ending.busy:
            raise stop
        err.print("stopped; nothing half-written was left, the same command starts anew")
    code = {"building": 128 + ending.signal, "failed": 2}.get(ending.status, 0)
    if ending.busy:
        # A thread that measures or draws can't be ended, and the process would wait for it.
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    raise typer.Exit(code)


def _say(line: str) -> None:
    out.print(escape(line))
