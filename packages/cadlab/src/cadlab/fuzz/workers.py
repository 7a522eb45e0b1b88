"""Children that read spoilt files one after the other, and are started anew where one crashes or doesn't come back."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from cadgraph._io.search_path import search_path
from cadgraph.config import LoadConfig
from cadgraph.errors import CadGraphError
from cadlab.fuzz.child import file_of, put_down
from cadlab.fuzz.judge import Verdict, fault_of_message
from cadlab.fuzz.kinds import KINDS, read_scene

__all__ = ["Case", "Judged", "judge_all"]

_PATIENCE = 10.0  # [s] for one case
_FIRST = 60.0  # [s] for the first one of a kind in a child, which imports what reads it
_MEMORY = 2 << 30  # [bytes] of address space of a child beyond what its libraries take

Case = tuple[str, int | Path]
"""A kind, and a number or a file."""


@dataclass(frozen=True)
class Judged:
    """A case that was judged.

    Args:
        case: which.
        verdict: what came of it.
        content: of its file, where that may be wanted; None where it is sound, or was not made.
    """

    case: Case
    verdict: Verdict
    content: bytes | None = None


def judge_all(cases: Iterable[Case], seeds: Path, workers: int = 2) -> Iterator[Judged]:
    """Judges cases in several children.

    Args:
        cases: drawn one by one, so that their iterator may end when the time is up.
        seeds: folder of the sound files.
        workers: number of children.

    Yields:
        What came of each case, as they are done.
    """
    waiting = iter(cases)
    lock, done = threading.Lock(), queue.Queue[Judged | BaseException | None]()

    def work() -> None:
        try:
            with _child(seeds) as child:
                while True:
                    with lock:
                        case = next(waiting, None)
                    if case is None:
                        return
                    done.put(child.judge(case))
        except BaseException as error:  # noqa: BLE001 - whoever asks for the verdicts gets it
            done.put(error)
        finally:
            done.put(None)

    threads = [threading.Thread(target=work, daemon=True) for _ in range(workers)]
    for thread in threads:
        thread.start()
    running = workers
    while running:
        found = done.get()
        if found is None:
            running -= 1
        elif isinstance(found, BaseException):
            raise found
        else:
            yield found


@contextmanager
def _child(seeds: Path) -> Iterator[_Child]:
    with tempfile.TemporaryDirectory(prefix="fuzz-", ignore_cleanup_errors=True) as folder:
        child = _Child(seeds, Path(folder))
        try:
            yield child
        finally:
            child.end()


class _Child:
    def __init__(self, seeds: Path, folder: Path) -> None:
        self._seeds, self._folder = seeds, folder
        self._process: subprocess.Popen[str] | None = None
        self._known: set[str] = set()

    def judge(self, case: Case) -> Judged:
        verdict = self._answer(case)
        if verdict.outcome == "memory":
            # The cases before may have left little: a new child tells whether this one takes it.
            self.end()
            verdict = self._answer(case)
        file = file_of(KINDS[case[0]], self._folder / "case")
        content = file.read_bytes() if file.is_file() else None
        if verdict.outcome in ("hang", "crash", "memory") and KINDS[case[0]].scene:
            verdict = self._as_users_see_it(case, verdict, content)
        return Judged(case, verdict, content if verdict.outcome not in ("read", "refused") else None)

    def _answer(self, case: Case) -> Verdict:
        name, what = case
        process = self._process or self._start()
        assert process.stdin is not None
        assert process.stdout is not None
        late = threading.Event()

        def give_up() -> None:
            late.set()
            process.kill()

        timer = threading.Timer(_PATIENCE if name in self._known else _FIRST, give_up)
        timer.daemon = True
        timer.start()
        try:
            process.stdin.write(f"{name} {what}\n")
            process.stdin.flush()
            line = process.stdout.readline()
        except OSError:
            line = ""
        finally:
            timer.cancel()
        if line.endswith("\n"):
            self._known.add(name)
            verdict = Verdict(*json.loads(line))
        else:
            with suppress(subprocess.TimeoutExpired):
                process.wait(_PATIENCE)
            self.end()
            verdict = (
                Verdict("hang", "no answer") if late.is_set() else Verdict("crash", f"exit code {process.returncode}")
            )
        return verdict

    def _as_users_see_it(self, case: Case, verdict: Verdict, content: bytes | None) -> Verdict:
        """Whether reading in a process of its own turns it into one line, as it must."""
        kind = KINDS[case[0]]
        if content is None:
            return Verdict(f"stopped-{verdict.outcome}", "the USD library ended on the text of a crate to be")
        file = put_down(kind, content, self._seeds, self._folder / "again")
        try:
            read_scene(file, LoadConfig(timeout=_PATIENCE))
        except CadGraphError as error:
            return fault_of_message(kind, file, str(error)) or Verdict(f"stopped-{verdict.outcome}", str(error))
        except Exception as error:  # noqa: BLE001 - which ones may come is the question
            return Verdict("traceback", f"{type(error).__name__}: {error!s:.200}")
        return Verdict("read", f"after a {verdict.outcome} with little memory")

    def _start(self) -> subprocess.Popen[str]:
        # One thread each: those of libraries for linear algebra take address space by the gigabyte.
        threads = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
        scratch = self._folder / "case"
        scratch.mkdir(exist_ok=True)
        self._known.clear()
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "cadlab.fuzz.child", str(self._seeds), str(scratch), str(_MEMORY)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            env=os.environ | threads | {"PYTHONPATH": search_path(), "PYTHONUTF8": "1", "TMPDIR": str(self._folder)},
        )
        return self._process

    def end(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    pipe.close()
