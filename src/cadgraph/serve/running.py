"""Running the server: its address, the browser, and how it ends."""

from __future__ import annotations

import os
import secrets
import signal
import sys
import threading
import webbrowser
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import suppress
from dataclasses import dataclass

from cadgraph._io.folder_lock import holding
from cadgraph._io.run_folder import tidy
from cadgraph.serve.app import make_app
from cadgraph.serve.guard import Doors, is_loopback
from cadgraph.serve.listening import Server, listen
from cadgraph.serve.order import Order
from cadgraph.serve.plant import Plant
from cadgraph.serve.state import one_line

__all__ = ["Ending", "Options", "view"]

_PATIENCE = 0.4  # s that work which can't be ended gets at the end
_LOOK = 2.0  # s between two looks whether the folder was changed by others

Say = Callable[[str], None]


@dataclass(frozen=True)
class Options:
    """How the server is run.

    Args:
        host: address to listen at.
        port: 0 for any that is free.
        browser: whether to open one.
        who: name under which actions are kept.
        report: whether to draw the report anew at the end.
    """

    host: str = "127.0.0.1"
    port: int = 0
    browser: bool = True
    who: str = ""
    report: bool = False


@dataclass(frozen=True)
class Ending:
    """How it ended.

    Args:
        status: of the plant by then: ``building``, ``ready`` or ``failed``.
        signal: that ended it.
        busy: whether a thread is still at work that can't be ended, so that the process must be.
    """

    status: str
    signal: int
    busy: bool


def view(order: Order, options: Options, say: Say) -> Ending:
    """Serves a plant until it is told to end by Ctrl-C or a polite kill.

    Args:
        order: what is shown.
        options: how.
        say: prints a line for the person at the terminal.

    Raises:
        OutputError: another process is at work in the folder, or it can't be made.
        OSError: the address can't be listened at.
    """
    made = not order.folder.exists()
    order.prepare()
    try:
        return _serve(order, options, say)
    finally:
        if made:
            with suppress(OSError):  # results are in it
                order.folder.rmdir()


def _serve(order: Order, options: Options, say: Say) -> Ending:
    with holding(order.folder), listen(options.host, options.port) as listener:
        tidy(order.folder)
        doors, token = Doors(options.host, listener.getsockname()[1]), secrets.token_urlsafe(24)
        plant = Plant(order, options.who)
        worker = ThreadPoolExecutor(1, thread_name_prefix="cadgraph-worker")
        server = Server(make_app(plant, worker, token, doors), plant.stop)
        opening = worker.submit(plant.open)
        opening.add_done_callback(lambda done: _tell(done, plant, say))
        _welcome(doors, token, options, say)
        looking = _look_now_and_then(plant, worker)
        server.run(sockets=[listener])
        looking.set()
        return _end(plant, worker, opening, server.ended_by or signal.SIGINT, options, say)


def _end(
    plant: Plant, worker: ThreadPoolExecutor, opening: Future[None], ended_by: int, options: Options, say: Say
) -> Ending:
    plant.stop()
    worker.shutdown(wait=False, cancel_futures=True)
    status = plant.feed.state.status
    # What is at work ends itself at the next step of its progress.
    busy = bool(wait([opening], _PATIENCE).not_done) or not plant.idle(_PATIENCE)
    if plant.unsaved:
        say("writing the graph; Ctrl-C once more leaves that to the next run")
    if (failure := plant.close()) is not None:
        say(f"the graph is not written, which the next run makes up for: {one_line(failure)}")
    if options.report and not busy:
        say("drawing the report; Ctrl-C once more stops that")
        plant.draw_report()
    return Ending(status, ended_by, busy)


def _tell(done: Future[None], plant: Plant, say: Say) -> None:
    """Says at the terminal how opening went."""
    if done.cancelled():
        return
    state = plant.feed.state
    if (error := done.exception()) is not None:
        say(f"error: {one_line(f'{type(error).__name__}: {error}')}")
    elif state.status == "failed":
        say(f"error: {one_line(state.message)}")
    elif state.status == "ready":
        why = f"; view only: {one_line(state.read_only)}" if state.read_only else ""
        say(f"ready: {one_line(state.title)}{why}")


def _welcome(doors: Doors, token: str, options: Options, say: Say) -> None:
    """Says where the page is, and opens it."""
    near = "127.0.0.1" if doors.anywhere else doors.host
    shown = f"[{near}]" if ":" in near else near
    address = f"http://{shown}:{doors.port}/?token={token}"
    say(address)
    if not is_loopback(options.host):
        say(
            f"mind: --host {options.host} lets everybody who has this address, with the name of this machine, see and "
            "change the plant, and what is sent is not encrypted"
        )
    say("Ctrl-C ends it; each correction is in the folder as soon as the page shows it")
    if options.browser and _has_screen():
        # Some wait until the browser has started.
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()


def _has_screen() -> bool:
    """Whether a browser would open in a window, not in this terminal."""
    if not sys.platform.startswith("linux"):
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER"))


def _look_now_and_then(plant: Plant, worker: ThreadPoolExecutor) -> threading.Event:
    """Has the worker look now and then whether others changed the folder, until the event is set."""
    over = threading.Event()

    def look() -> None:
        while not over.wait(_LOOK):
            with suppress(RuntimeError):  # the worker has ended
                worker.submit(plant.look)

    threading.Thread(target=look, name="cadgraph-look", daemon=True).start()
    return over
