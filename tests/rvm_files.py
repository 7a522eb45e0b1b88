"""Small RVM files, binary and as text, for tests of their reader."""

from __future__ import annotations

import struct

import numpy as np

MM = 0.001
SIZES = {1: 7, 2: 3, 3: 4, 4: 3, 5: 2, 6: 2, 7: 9, 8: 2, 9: 1, 10: 2}


def placed(at=(0, 0, 0), turn=np.eye(3), scale=MM):
    """The twelve numbers of a placement; ``at`` [m], ``turn`` for row vectors."""
    return [*(np.asarray(turn) * scale).reshape(-1), *at]


def turned(angle, axis=2):
    """About one of the axes, for row vectors."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[i, i] = turn[j, j] = c
    turn[i, j], turn[j, i] = s, -s
    return turn


def cube(low, high, hole=False):
    """Polygons of a facet group: a box [mm], maybe with a square hole through top and bottom."""
    (a, b, c), (d, e, f) = low, high
    rings = [
        ([(a, b, c), (a, e, c), (d, e, c), (d, b, c)], (0, 0, -1)),
        ([(a, b, f), (d, b, f), (d, e, f), (a, e, f)], (0, 0, 1)),
        ([(a, b, c), (d, b, c), (d, b, f), (a, b, f)], (0, -1, 0)),
        ([(d, b, c), (d, e, c), (d, e, f), (d, b, f)], (1, 0, 0)),
        ([(d, e, c), (a, e, c), (a, e, f), (d, e, f)], (0, 1, 0)),
        ([(a, e, c), (a, b, c), (a, b, f), (a, e, f)], (-1, 0, 0)),
    ]
    polygons = [[[(point, normal) for point in ring]] for ring, normal in rings]
    if hole:
        # Its walls look inward; the caps get a second contour.
        inner = cube((a + (d - a) / 4, b + (e - b) / 4, c), (d - (d - a) / 4, e - (e - b) / 4, f))
        for i in (0, 1):
            polygons[i].append([(point, normal) for point, normal in reversed(inner[i][0])])
        for wall in inner[2:]:
            polygons.append([[(point, tuple(-x for x in normal)) for point, normal in reversed(wall[0])]])
    return polygons


class Rvm:
    """Gathers chunks; ``bytes`` is the file, ``text`` the same one as text."""

    def __init__(self, encoding="Unicode UTF-8"):
        self.data = bytearray()
        self.lines = []
        version = 2 if encoding else 1
        head = ["program", "note", "date", "user"] + [encoding] * bool(encoding)
        self.chunk("HEAD", [version, *head], head)
        self.chunk("MODL", [1, "project", "/model"], ["project", "/model"])

    def chunk(self, tag, payload, lines=(), version=1):
        body = b"".join(self._bytes(value) for value in payload)
        self.data += struct.pack(">6I", *tag.encode(), len(self.data) + 24 + len(body), 1) + body
        self.lines += [tag, f"     1{version:6d}", *lines]

    def open(self, name, material=1, at=(0, 0, 0)):
        place = "".join(f"{x:14.2f}" for x in at)
        self.chunk("CNTB", [2, name, *map(float, at), material], [name, place, f"{material:6d}"])
        return self

    def close(self, n=1):
        for _ in range(n):
            self.chunk("CNTE", [2])
        return self

    def primitive(self, kind, *sizes, matrix=None, tag="PRIM"):
        matrix = placed() if matrix is None else matrix
        extra = [] if tag == "PRIM" else [50 << 24]
        rows = np.array(matrix, float).reshape(4, 3).T
        lines = [f"{kind:6d}", *("".join(f"{x:14.7f}" for x in row) for row in rows), *["  0.0 0.0 0.0"] * 2]
        lines += ["    50"] * (tag != "PRIM")
        if kind == 11:
            payload = [len(sizes[0])]
            for contours in sizes[0]:
                payload.append(len(contours))
                for corners in contours:
                    payload += [len(corners), *(float(x) for corner in corners for part in corner for x in part)]
            lines += [f"{x}" for x in payload]
        else:
            payload = [float(x) for x in sizes]
            # Over several lines, as other programs write them.
            lines += [" ".join(f"{x:.9g}" for x in payload[i : i + 5]) for i in range(0, len(payload), 5)]
        self.chunk(tag, [1, kind, *map(float, matrix), *[0.0] * 6, *extra, *payload], lines)
        return self

    def color(self, index, rgb):
        self.chunk("COLR", [1, index, bytes([*rgb, 0])], [f"{index:6d}", " ".join(map(str, rgb))])
        return self

    def end(self):
        self.chunk("END:", [1])
        return self

    @property
    def bytes(self):
        return bytes(self.data) + bytes(200)

    @property
    def text(self):
        return "\n".join(self.lines) + "\n"

    @staticmethod
    def _bytes(value):
        if isinstance(value, bytes):
            return value
        if isinstance(value, str):
            raw = value.encode()
            n = len(raw) // 4 + 1
            return struct.pack(">I", n) + raw.ljust(4 * n, b"\0")
        return struct.pack(">f" if isinstance(value, float) else ">I", value)
