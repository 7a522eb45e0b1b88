"""A strict reader of piping component files, which says what doesn't hang together."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

ENDS = {
    "END-CONNECTION-EQUIPMENT",
    "END-CONNECTION-PIPELINE",
    "END-POSITION-OPEN",
    "END-POSITION-CLOSED",
    "END-POSITION-NULL",
}
SET_ON = {"TEE-SET-ON", "OLET"}
OFF_LINE = {"INSTRUMENT-DIAL", "SUPPORT"}
IN_LINE = {
    "PIPE", "BEND", "ELBOW", "TEE", "CROSS", "REDUCER-CONCENTRIC", "REDUCER-ECCENTRIC", "FLANGE", "FLANGE-BLIND",
    "GASKET", "COUPLING", "UNION", "CAP", "FILTER", "MISC-COMPONENT", "INSTRUMENT", "VALVE", "VALVE-ANGLE",
    "VALVE-3WAY", "VALVE-MULTIWAY",
}  # fmt: skip
HEAD = ["ISOGEN-FILES", "UNITS-BORE", "UNITS-CO-ORDS", "UNITS-WEIGHT", "PIPELINE-REFERENCE"]


@dataclass
class Record:
    keyword: str
    fields: list[tuple[str, str]] = field(default_factory=list)

    def one(self, key):
        found = [value for name, value in self.fields if name == key]
        assert len(found) <= 1, f"{self.keyword}: {key} stands {len(found)} times"
        return found[0] if found else None

    @property
    def ends(self):
        return [numbers(value, 4) for name, value in self.fields if name == "END-POINT"]

    @property
    def branches(self):
        return [numbers(v, 4) for n, v in self.fields if n.startswith("BRANCH") and n.endswith("-POINT")]

    @property
    def centre(self):
        value = self.one("CENTRE-POINT")
        return None if value is None else numbers(value, 3)

    @property
    def place(self):
        return numbers(self.one("CO-ORDS"), 3)

    @property
    def length(self):
        """Along the centreline [mm], as far as the file says."""
        if self.keyword not in IN_LINE:
            return 0.0
        first, last = (end[:3] for end in self.ends)
        if self.keyword in ("ELBOW", "BEND"):
            turn = math.radians(int(self.one("ANGLE")) / 100)
            tangent = (math.dist(first, self.centre) + math.dist(self.centre, last)) / 2
            return tangent / math.tan(turn / 2) * turn
        if self.centre is not None:
            ways = [first, last, *(branch[:3] for branch in self.branches)]
            return sum(math.dist(self.centre, way) for way in ways)
        return math.dist(first, last)

    @property
    def parts(self):
        return (self.one("COMPONENT-ATTRIBUTE1") or "").split()


def numbers(value, count):
    found = [float(word) for word in value.split()]
    assert len(found) == count, f"{value!r}: {count} numbers expected"
    assert all(map(math.isfinite, found)), value
    return found


class Pcf:
    """A file, checked line by line while it is read."""

    def __init__(self, data: bytes):
        text = data.decode("ascii")
        assert text.endswith("\r\n")
        lines = text.split("\r\n")[:-1]
        assert all(line == line.rstrip() and line for line in lines), "empty lines or spaces at ends"
        assert not any(ord(letter) < 32 for line in lines for letter in line), "control characters"
        self.head, self.records, self.materials = {}, [], {}
        self._read(lines)
        assert list(self.head)[:5] == HEAD
        assert (self.head["UNITS-BORE"], self.head["UNITS-CO-ORDS"]) == ("MM", "MM")

    def _read(self, lines):
        current, inside = None, False
        for line in lines:
            keyword, _, value = line.strip().partition(" ")
            if line.startswith(" "):
                assert line[:4].isspace(), line
                assert line[4] != " ", line
                assert value, f"{line!r} says nothing"
                if inside:
                    assert keyword == "DESCRIPTION"
                    self.materials[current] = value
                elif current is not None:
                    current.fields.append((keyword, value))
                else:
                    self.head[keyword] = value
            elif inside:
                assert keyword == "ITEM-CODE", line
                assert value not in self.materials, line
                current = value
            elif keyword == "MATERIALS":
                inside = True
            elif keyword in HEAD:
                assert not self.records, line
                self.head[keyword] = value
            else:
                assert keyword in ENDS | SET_ON | OFF_LINE | IN_LINE, f"unknown component {line!r}"
                assert not value, line
                current = Record(keyword)
                self.records.append(current)

    @property
    def chain(self):
        return [record for record in self.records if record.keyword in IN_LINE]

    @property
    def closing(self):
        return [record for record in self.records if record.keyword in ENDS]

    @property
    def length(self):
        """Of the whole line [mm]."""
        return sum(record.length for record in self.chain)

    def faults(self, tolerance=0.5):
        """What doesn't hang together, in words."""
        found = []
        for before, after in zip(self.chain, self.chain[1:], strict=False):
            gap = math.dist(before.ends[1][:3], after.ends[0][:3])
            if gap > tolerance:
                found.append(f"{before.keyword} - {after.keyword}: {gap:.2f} mm")
            if before.ends[1][3] != after.ends[0][3]:
                found.append(f"{before.keyword} - {after.keyword}: bore {before.ends[1][3]:g} - {after.ends[0][3]:g}")
        found += [f"{record.keyword} has {len(record.ends)} ends" for record in self.chain if len(record.ends) != 2]
        branches = [branch for record in self.records if record.keyword != "OLET" for branch in record.branches]
        if not 2 <= len(self.closing) <= 2 + len(branches):
            found.append(f"{len(self.closing)} ends of a line with {len(branches)} branches")
        elif self.chain:
            corners = self.chain[0].ends[0], self.chain[-1].ends[1]
            for end in self.closing[2:]:
                if min(math.dist(end.place, branch[:3]) for branch in branches) > tolerance:
                    found.append(f"{end.keyword} at {end.place} is at no branch")
            for end, corner in zip(self.closing[:2], corners, strict=True):
                if math.dist(end.place, corner[:3]) > tolerance:
                    found.append(f"{end.keyword} lies {math.dist(end.place, corner[:3]):.2f} mm off")
        found += [f for record in self.records for f in self._own_faults(record)]
        return found

    def _own_faults(self, record):
        code = record.one("ITEM-CODE")
        if record.keyword not in ENDS and code not in self.materials:
            yield f"{record.keyword}: no material {code}"
        if record.keyword in ("ELBOW", "BEND"):
            first, last = (math.dist(end[:3], record.centre) for end in record.ends)
            if abs(first - last) > 0.1 * max(first, last) + 1:
                yield f"{record.keyword}: legs of {first:.1f} and {last:.1f} mm"
        if record.keyword in ("TEE", "CROSS", "TEE-SET-ON") and (record.centre is None or not record.branches):
            yield f"{record.keyword} without a centre or branch"
        skey = record.one("SKEY")
        if skey is not None and (len(skey) != 4 or not skey.isalnum() or skey != skey.upper()):
            yield f"symbol key {skey}"
