"""The application and its groups of commands; modules beside this one register theirs."""

from __future__ import annotations

import atexit
import gc
import sys
from collections.abc import Sequence
from typing import Annotated

import typer
from rich.markup import escape

from cadgraph import __version__
from cadgraph._io.text import printable
from cadgraph.cli.panels import Root
from cadgraph.cli.plugins import add_installed
from cadgraph.cli.screen import err, out
from cadgraph.cli.signals import Stopped, stoppable
from cadgraph.errors import CadGraphError

__all__ = ["app", "main", "run"]

app = typer.Typer(
    cls=Root,
    no_args_is_help=True,
    add_completion=False,
    rich_markup_mode="markdown",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Turns an unlabelled CAD scene into a semantic 3D scene graph: what each part is, what it touches, which "
    "structure it belongs to, and how valves, gauges, pumps and tanks hang together along the pipes.",
    epilog="Start with **cadgraph demo**, then **cadgraph build SCENE -o FOLDER**.",
)


def main(arguments: Sequence[str] | None = None) -> None:
    """Runs the command line; ends the process with 0, with 2 on bad input or arguments, with 130 on Ctrl-C."""
    # Nothing is of use at the end: to look for what isn't, among all that is imported, takes a third of a second.
    atexit.register(gc.freeze)
    # Here and not on import: what other packages bring imports this one.
    add_installed(app)
    run(app, arguments)


def run(commands: typer.Typer, arguments: Sequence[str] | None = None) -> None:
    """Runs commands of this package or of another; what they refuse is one line, and the process ends as in ``main``.

    Args:
        commands: as they are registered.
        arguments: of the command line; those of the process by default.
    """
    try:
        with stoppable():
            commands(arguments)
    except (CadGraphError, ValueError) as error:
        _refuse(str(error))
    except MemoryError:
        _refuse("there is not enough memory for this scene; close other programs, or split it")
    except OSError as error:
        _refuse(f"{error.filename or 'the system'}: {error.strerror or error}")
    except Stopped as stop:
        done = getattr(stop, "__notes__", None)
        err.print(f"stopped; {'; '.join(done or ['nothing half-written was left, the same command starts anew'])}")
        sys.exit(stop.code)


def _refuse(reason: str) -> None:
    err.print(f"[bold red]error:[/] {escape(_one_line(reason))}")
    sys.exit(2)


@app.callback(invoke_without_command=True)
def _root(version: Annotated[bool, typer.Option("--version", help="Print the version and stop.")] = False) -> None:
    if version:
        out.print(f"cadgraph {__version__}")
        raise typer.Exit


def _one_line(text: str) -> str:
    # Names from a file may hold what moves the cursor or recolours the terminal.
    return printable(" ".join(text.split()), "\N{REPLACEMENT CHARACTER}")
