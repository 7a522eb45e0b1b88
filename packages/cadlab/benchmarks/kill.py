"""What is left when a command is killed: ``python packages/cadlab/benchmarks/kill.py [--kills 200] [--seed 0]``.

Each command is run on a small plant in a folder with the results of an earlier run and ended by ``kill -9``, with all
processes that it started, at random moments: a third of them anywhere in its run, a third while it writes, and a third
in the instant in which its files come to their places. Then the folder is read as anybody would read it, and compared
with what it was before and what the command makes of it: ``graph.json`` and what is made of it to the byte, the rest by
the manifest. The same command, run again, must end well and make what it makes. Prints a Markdown table; ends with 1
where anything was between.

A command is a fork of this process, which has all modules in memory, so that its own start is no part of what is
killed. Linux and macOS.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from _timing import machine

from cadgraph._io.manifest import behind, changed_by_others
from cadgraph._io.staging import NEXT, READY
from cadgraph.cli import main as cadgraph
from cadgraph.errors import CadGraphError
from cadgraph.model.corrections import read_history
from cadgraph.model.graph import SceneGraph
from cadlab.markdown import table
from cadplants import make, write_usd

SMALL = ["--set", "report.width=160", "--set", "report.height=120", "--set", "report.samples=1"]
PART = "part-00003"
SAID = {"group": "Pipe assembly", "name": "gasket"}
# What a run of the same command makes to the byte; the times of stages and of corrections are others each time.
SAME = ("graph.json", "semantics.usda", "scene.usdc", "report.html", "picture.png", "simulation.usda", "devices.json")
PATIENCE = 120.0  # s for anything at all
MOVE = 0.0015  # s that a dozen files take to come to their places
LOOK = 0.0005  # s between two looks whether writing has begun

Digests = dict[str, bytes]


@dataclass(frozen=True)
class Case:
    """One command.

    Args:
        name: of it.
        words: of the command line; of ``view``, a correction is posted once it is ready.
        share: of all kills.
        extra: whether it makes files of its own beside the results.
    """

    name: str
    words: Sequence[str]
    share: float
    extra: bool = False

    @property
    def is_view(self) -> bool:
        """Whether it is a server."""
        return self.words[0] == "view"


@dataclass
class Tally:
    """What came of the kills of one command."""

    kills: int = 0
    writing: int = 0
    states: Counter[str] = field(default_factory=Counter)
    reruns: int = 0
    wrong: list[str] = field(default_factory=list)


def start(words: Sequence[str]) -> tuple[int, int]:
    """The command in a process group of its own: its process, and where what it says can be read."""
    said, say = os.pipe()
    process = os.fork()
    if process:
        os.close(say)
        return process, said
    code = 1
    try:
        os.setsid()
        os.dup2(say, 1)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        os.close(said)
        cadgraph(list(words))
        code = 0
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else int(bool(stop.code))
    finally:
        sys.stdout.flush()
        os._exit(code)


def ended(process: int) -> int | None:
    """How a process ended; None while it runs."""
    done, status = os.waitpid(process, os.WNOHANG)
    return os.waitstatus_to_exitcode(status) if done else None


def kill(process: int) -> None:
    """Ends a process and all that it started, at once."""
    os.killpg(process, signal.SIGKILL)
    os.waitpid(process, 0)


class Server:
    """A running ``cadgraph view``."""

    def __init__(self, said: int) -> None:
        # Open until the end, as the server says more.
        self.lines = os.fdopen(said, "rb", buffering=0)
        address = self.lines.readline().decode().strip()
        self._base = address.partition("/?")[0]
        self._token = parse_qs(urlsplit(address).query)["token"][0]

    def _ask(self, path: str, body: object = None) -> object:
        data = None if body is None else json.dumps(body).encode()
        headers = {"Authorization": f"Bearer {self._token}", "Content-Type": "application/json"}
        with urllib.request.urlopen(
            urllib.request.Request(self._base + path, data, headers), timeout=PATIENCE
        ) as answer:
            return json.load(answer)

    def wait_until_ready(self) -> int:
        """Its version, once the plant can be corrected."""
        while True:
            try:
                state = self._ask("/api/state")
            except urllib.error.URLError:
                state = None
            if isinstance(state, dict) and state["status"] == "ready" and state["can_undo"] is not None:
                return int(state["version"])
            time.sleep(0.05)

    def correct(self, version: int) -> None:
        """Posts the correction; it is kept when this returns."""
        edit = {"kind": "label", "part": PART, **SAID, "this_only": True}
        self._ask("/api/edit", {"version": version, "edits": [edit], "why": "seen"})


def begun(folder: Path) -> bool:
    """Whether the command has begun to write."""
    return (folder / NEXT).exists() or (folder / READY).exists()


def complete(folder: Path) -> bool:
    """Whether its files are complete and come to their places."""
    return (folder / READY).exists()


def run(case: Case, folder: Path) -> tuple[float, float]:
    """Runs a command to its end: seconds of it (of ``view``, from the correction on), and of them after it wrote first.

    Raises:
        RuntimeError: it failed.
    """
    process, said = start(case.words)
    first: float | None = None
    since = time.perf_counter()
    if case.is_view:
        server = Server(said)
        version = server.wait_until_ready()
        if not behind(folder) and not read_history(folder).events:
            since = time.perf_counter()
            server.correct(version)
        while behind(folder) or begun(folder):
            first = first or (time.perf_counter() if begun(folder) else None)
            time.sleep(LOOK)
        now = time.perf_counter()
        os.kill(process, signal.SIGINT)
        code: int | None = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    else:
        while (code := ended(process)) is None:
            first = first or (time.perf_counter() if begun(folder) else None)
            time.sleep(LOOK)
        now = time.perf_counter()
        os.close(said)
    if code:
        raise RuntimeError(f"{' '.join(case.words)} ended with {code}")
    return now - since, now - (first or now)


def run_until(case: Case, folder: Path, moment: float, since: Callable[[Path], bool]) -> bool:
    """Runs a command and kills it so many seconds after something holds of its folder; whether it was writing then."""
    process, said = start(case.words)
    if case.is_view:
        server = Server(said)
        server.correct(server.wait_until_ready())
    waited = time.perf_counter()
    while not since(folder) and time.perf_counter() - waited < PATIENCE:
        if case.is_view:
            if not behind(folder):
                break  # it was quicker than this looked
        elif ended(process) is not None:
            os.close(said)
            return False
        time.sleep(LOOK / 10)
    time.sleep(moment)
    wrote = begun(folder)
    try:
        kill(process)
    except (ProcessLookupError, ChildProcessError):
        wrote = False  # it was quicker
    if not case.is_view:
        os.close(said)
    return wrote


def state_of(folder: Path) -> Digests:
    """All files of a folder that count."""
    paths = (path for path in folder.rglob("*") if path.is_file() and not path.name.startswith("."))
    hidden = (folder / NEXT, folder / READY)
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in paths
        if not any(path.is_relative_to(place) for place in hidden)
    }


def judge(folder: Path, before: Digests, after: Digests, extra: bool) -> str:
    """What a reader finds: ``before``, ``after``, ``kept`` (the correction, which the folder says to be ahead of its
    graph), or why it is none of them."""
    try:
        # As every command does it, which ends a move that was begun.
        graph = SceneGraph.load(folder)
        history = read_history(folder)
        torn = changed_by_others(folder)
        ahead = behind(folder)
    except CadGraphError as error:
        return str(error)
    now = state_of(folder)
    if now == before:
        return "before"
    if torn:
        return f"{', '.join(torn)} don't belong there"
    ours = {name for name in SAME if name in before or name in after}
    if ahead:
        same = all(now.get(name) == before.get(name) for name in ours)
        return "kept" if same and len(history.events) == 1 and graph.digest else "a graph that nobody made"
    wanted = ours | set(after if extra else ())
    others = [name for name in sorted(wanted - {"timings.json", "corrections.json", "manifest.json"})
              if now.get(name) != after.get(name)]  # fmt: skip
    if others or now.keys() != after.keys():
        return f"neither before nor after: {', '.join(others) or 'other files'}"
    return "after"


def trial(case: Case, work: Path, before: Path, kills: int, chance: random.Random, say: Callable[[str], None]) -> Tally:
    """Kills a command again and again."""
    folder, tally = work / "run", Tally()
    restore(before, folder)
    old = state_of(folder)
    whole, writing = run(case, folder)
    new = state_of(folder)
    for number in range(kills):
        restore(before, folder)
        since, span, named = (
            (lambda _: True, whole * 1.02, "after it began"),
            (begun, writing * 1.02, "after it began to write"),
            (complete, MOVE, "after its files were complete"),
        )[number % 3]
        moment = chance.uniform(0, span)
        tally.kills += 1
        tally.writing += run_until(case, folder, moment, since)
        found = judge(folder, old, new, case.extra)
        known = found in ("before", "after", "kept" if case.is_view else "after")
        tally.states[found if known else "between"] += 1
        if not known:
            tally.wrong.append(f"{case.name}, {moment:.4f} s {named}: {found}")
        try:
            run(case, folder)
            graph = (folder / "graph.json").read_bytes()
            tidy = not any(path.name.startswith(".") for path in folder.iterdir())
            tally.reruns += graph == new["graph.json"] and tidy and not changed_by_others(folder)
        except (RuntimeError, CadGraphError, OSError) as error:
            tally.wrong.append(f"{case.name}, run again: {error}")
        say(f"{case.name}: {number + 1} of {kills}, {dict(tally.states)}, {tally.reruns} run again")
    return tally


def restore(before: Path, folder: Path) -> None:
    """Puts a folder back as it was."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(before, folder)


def cases(scene: Path, folder: Path) -> list[Case]:
    """The commands."""
    label = ["--as", f"{SAID['group']}/{SAID['name']}", "--this-only"]
    return [
        Case("build", ["build", str(scene), "-o", str(folder), *SMALL], 0.25),
        Case("label", ["label", str(folder), "--labeler", "embedded"], 0.2),
        Case("relabel", ["relabel", str(folder), PART, *label], 0.2),
        Case("view, with a correction", ["view", str(folder), "--no-browser"], 0.15),
        Case("export csv", ["export", str(folder), "--to", "csv"], 0.1, extra=True),
        Case("export usd", ["export", str(folder), "--to", "usd"], 0.05),
        Case("simulate", ["simulate", str(folder)], 0.05),
    ]


def main() -> None:
    """Runs it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=200, help="of all commands together")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", help="a command")
    given = parser.parse_args()
    chance = random.Random(given.seed)
    rows: list[tuple[str, list[int]]] = []
    wrong: list[str] = []
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        tempfile.tempdir = os.environ["TMPDIR"] = str(work)
        scene, folder, before = work / "plant.usdc", work / "run", work / "before"
        write_usd(make("tank"), scene)
        first = Case("first", ["build", str(scene), "-o", str(folder), *SMALL, "--set", "label.labeler=none"], 0)
        run(first, folder)
        shutil.copytree(folder, before)
        for case in cases(scene, folder):
            if given.only and not case.name.startswith(given.only):
                continue
            kills = max(1, round(given.kills * case.share))
            tally = trial(case, work, before, kills, chance, lambda line: print(line, file=sys.stderr, flush=True))
            counts = [tally.states[state] for state in ("before", "kept", "after", "between")]
            rows.append((case.name, [tally.kills, tally.writing, *counts, tally.reruns]))
            wrong += tally.wrong
    rows.append(("all", [sum(column) for column in zip(*(counts for _, counts in rows), strict=True)]))
    head = ["command", "kills", "while writing", "as before", "correction kept", "as after", "between", "run again"]
    print(f"{machine()}; seed {given.seed}.\n")
    print("\n".join(table(head, [[name, *counts] for name, counts in rows])))
    for line in wrong:
        print(f"- {line}")
    if wrong:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
