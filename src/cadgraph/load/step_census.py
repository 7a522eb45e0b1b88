"""How often a STEP file places its parts, counted before the CAD library builds them: assemblies may nest."""

from __future__ import annotations

import re

__all__ = ["occurrences"]

_USE = re.compile(
    rb"NEXT_ASSEMBLY_USAGE_OCCURRENCE\s*\(\s*(?:'(?:[^']|'')*'|\$)\s*,\s*(?:'(?:[^']|'')*'|\$)\s*,"
    rb"\s*(?:'(?:[^']|'')*'|\$)\s*,\s*#(\d{1,18})\s*,\s*#(\d{1,18})"
)


def occurrences(data: bytes) -> int:
    """How many places all products of a file have together, those within assemblies counted for each place of these.

    Args:
        data: the text of the file.
    """
    uses: dict[int, list[int]] = {}
    used: set[int] = set()
    for found in _USE.finditer(data):
        above, below = int(found[1]), int(found[2])
        uses.setdefault(above, []).append(below)
        used.add(below)
    known: dict[int, int] = {}
    entered: set[int] = set()
    # What only circles use is begun at last.
    for top in [*(each for each in uses if each not in used), *uses]:
        waiting = [top]
        while waiting:
            at = waiting[-1]
            if at not in known and at not in entered:
                entered.add(at)
                waiting.extend(each for each in uses.get(at, ()) if each not in known and each not in entered)
                continue
            waiting.pop()
            if at not in known:
                known[at] = 1 + sum(known.get(each, 0) for each in uses.get(at, ()))
    return sum(known[each] for each in uses if each not in used) or max(known.values(), default=0)
