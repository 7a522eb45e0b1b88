"""What a STEP file names and what the CAD library made of it: whether anything was lost on the way.

The library (OpenCASCADE) leaves out what it can't build, writes that to the process's standard output, and goes on.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from cadgraph._io.text import printable
from cadgraph.model.diagnostic import Diagnostic

__all__ = ["Complaints", "Counts", "damage_of", "hear", "named_in"]

_SHELL = re.compile(rb"\b(?:CLOSED|OPEN)_SHELL\s*\(\s*'(?:[^']|'')*'\s*,\s*\(([^)]*)\)", re.IGNORECASE)
_SOLID = re.compile(rb"\b(?:MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS|FACETED_BREP)\s*\(", re.IGNORECASE)
_PRODUCT = re.compile(rb"#(\d+)\s*=\s*PRODUCT_DEFINITION(?:_WITH_ASSOCIATED_DOCUMENTS)?\s*\(", re.IGNORECASE)
_USED = re.compile(
    rb"\bNEXT_ASSEMBLY_USAGE_OCCURRENCE\s*\((?:\s*'(?:[^']|'')*'\s*,|\s*\$\s*,){3}\s*#\d+\s*,\s*#(\d+)", re.IGNORECASE
)
_REFERENCE = re.compile(rb"#(\d+)")
_COMPLAINT = re.compile(r"\bERR\b|\bError|\bException|\bFail|\bUnresolved|undefined", re.IGNORECASE)
_STYLE = re.compile("\x1b\\[[0-9;]*m")  # colours for a terminal
_MOST_HEARD = 1 << 20  # [bytes] of what the library writes, from its start
_MOST_TOLD = 3  # of its lines
_LONGEST = 160  # characters of one


@dataclass(frozen=True)
class Counts:
    """How much geometry there is.

    Args:
        roots: products that no other product uses.
        solids: closed bodies.
        faces: in their shells, and in open ones.
    """

    roots: int
    solids: int
    faces: int


@dataclass
class Complaints:
    """What the library said is wrong, as lines; filled when ``hear`` ends."""

    lines: list[str] = field(default_factory=list)


def named_in(data: bytes) -> Counts:
    """What a file names, by its text alone.

    Args:
        data: of a STEP file (ISO 10303-21).
    """
    faces: set[bytes] = set()
    for shell in _SHELL.finditer(data):
        faces.update(_REFERENCE.findall(shell[1]))
    used = {found[1] for found in _USED.finditer(data)}
    roots = sum(found[1] not in used for found in _PRODUCT.finditer(data))
    return Counts(roots, sum(1 for _ in _SOLID.finditer(data)), len(faces))


@contextmanager
def hear() -> Iterator[Complaints]:
    """Listens to what libraries write to the process's standard output within the block, which does not get there.

    Nothing is heard where the process has no standard output.
    """
    told = Complaints()
    with tempfile.TemporaryFile() as heard:
        try:
            sys.stdout.flush()
            kept = os.dup(1)
        except (OSError, ValueError, AttributeError):
            yield told
            return
        os.dup2(heard.fileno(), 1)
        try:
            yield told
        finally:
            os.dup2(kept, 1)
            os.close(kept)
            heard.seek(0)
            text = heard.read(_MOST_HEARD).decode("utf-8", "replace")
            lines = (" ".join(printable(_STYLE.sub("", line)).split()).strip("* ") for line in text.splitlines())
            told.lines = [line for line in lines if _COMPLAINT.search(line)]


def damage_of(form: str, named: Counts | None, came: Counts, complaints: Complaints) -> Diagnostic | None:
    """What is to be said of a file of which something is missing; None of a sound one.

    Args:
        form: ``"STEP"`` or ``"IGES"``.
        named: what the file names; None where its text does not tell.
        came: what came of it.
        complaints: of the library.
    """
    lost = named.faces - came.faces if named is not None else 0
    if lost <= 0 and not complaints.lines:
        return None
    said = []
    if named is not None and lost > 0:
        said.append(
            f"{lost:,} of {named.faces:,} faces are missing: the file names {_words(named)}; what came back is "
            f"{_words(came)}"
        )
    if complaints.lines:
        n = len(complaints.lines)
        distinct = list(dict.fromkeys(line[:_LONGEST] for line in complaints.lines))
        shown = "; ".join(distinct[:_MOST_TOLD])
        said.append(f"the CAD library objects {n:,} time{'s' if n > 1 else ''}: {shown}")
    return Diagnostic("damaged-source", f"the {form} file is damaged, export it again: {'; '.join(said)}")


def _words(counts: Counts) -> str:
    return ", ".join(
        f"{n:,} {word}{'' if n == 1 else 's'}"
        for n, word in ((counts.roots, "root"), (counts.solids, "solid"), (counts.faces, "face"))
    )
