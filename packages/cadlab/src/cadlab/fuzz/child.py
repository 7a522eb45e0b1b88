"""The reading child: ``python -m cadlab.fuzz.child SEEDS SCRATCH MEMORY`` judges what its standard input names.

Each line is ``KIND NUMBER``, or ``KIND PATH`` for a file that is there already; each answer is a line of JSON.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from cadlab.fuzz.judge import Verdict, judge
from cadlab.fuzz.kinds import KINDS, Kind
from cadlab.fuzz.mutate import spoilt

__all__ = ["file_of", "main", "put_down", "seeds_of"]


def main(seeds: Path, scratch: Path, memory: int) -> None:
    """Serves until its input ends; ``memory`` is what a case may take [bytes], where the system can tell."""
    _keep_small(memory)
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    with tempfile.TemporaryFile() as noise:
        os.dup2(noise.fileno(), 1)
        os.dup2(noise.fileno(), 2)
        for line in sys.stdin:
            name, _, what = line.rstrip("\n").partition(" ")
            kind = KINDS[name]
            # Emptied first: a library may end the process while the file is made, and then there must be none.
            _clear(scratch)
            content = _content(kind, what, seeds)
            before = os.fstat(noise.fileno()).st_size
            verdict = judge(kind, put_down(kind, content, seeds, scratch), seeds)
            sys.stdout.flush()
            sys.stderr.flush()
            if not kind.scene and not verdict.is_fault and os.fstat(noise.fileno()).st_size > before:
                noise.seek(before)
                verdict = Verdict("noise", repr(noise.read(200)))
            answers.write(json.dumps([verdict.outcome, verdict.detail]) + "\n")
            answers.flush()


def put_down(kind: Kind, content: bytes, seeds: Path, scratch: Path) -> Path:
    """Writes the file of a case, and what it lies beside, into an emptied folder; returns what is to be read."""
    _clear(scratch)
    file = file_of(kind, scratch)
    file.write_bytes(content)
    if kind.whole is None:
        return file
    suffix, other = kind.whole
    whole = scratch / f"part{suffix}"
    whole.write_bytes((seeds / other / "0.seed").read_bytes())
    return whole


def file_of(kind: Kind, scratch: Path) -> Path:
    """Where the spoilt file of a case is put."""
    return scratch / f"part{kind.suffix}"


def _clear(scratch: Path) -> None:
    for old in sorted(scratch.rglob("*"), reverse=True):
        if old.is_dir():
            old.rmdir()
        else:
            old.unlink()
    scratch.mkdir(parents=True, exist_ok=True)


def _content(kind: Kind, what: str, seeds: Path) -> bytes:
    if not what.isdigit():
        return Path(what).read_bytes()
    return spoilt(kind.name, kind.layout, seeds_of(kind, seeds), int(what))


def seeds_of(kind: Kind, seeds: Path) -> list[bytes]:
    """The sound files of a kind."""
    return [file.read_bytes() for file in sorted((seeds / kind.name).iterdir())]


def _keep_small(memory: int) -> None:
    with suppress(ImportError, OSError, ValueError):
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        # Libraries take address space by the gigabyte before they read anything.
        _import_readers()
        taken = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (taken + memory, taken + memory))


def _import_readers() -> None:
    from cadgraph.load import formats

    for module in (*(form.module for form in formats()), "cadgraph.pipeline", "cadgraph.load.finish", "cadgraph.query"):
        with suppress(ImportError):
            importlib.import_module(module)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]))
