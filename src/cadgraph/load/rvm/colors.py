"""The colours of materials: those that the file lists, else the default ones of PDMS."""

from __future__ import annotations

import numpy as np

from cadgraph.load.rvm.chunks import Chunks, Words
from cadgraph.load.triangles import linear
from cadgraph.model.scene import Floats, Ints

__all__ = ["colors_of"]

# Red, green and blue of the standard colours of PDMS, and which numbers they have (AVEVA's palette, as the readers
# rvmparser and rvmsharp list it).
_PALETTE = {
    "000000": (1, 33, 206), "cc0000": (2, 34, 214), "ed9900": (3, 35, 222), "cccc00": (4, 36, 226),
    "00cc00": (5, 37, 232), "00eded": (6, 38, 235), "0000cc": (7, 39, 238), "dd00dd": (8, 40, 247),
    "cc2b2b": (9, 41, 252), "ffffff": (10, 28, 42, 60, 207), "f97f70": (11, 43, 221), "bfbfbf": (12, 44, 211),
    "a8a8a8": (13, 45, 210), "8c668c": (14, 46, 218), "f4f4f4": (15, 47, 208), "8e236b": (16, 48, 225),
    "00ff7f": (17, 49, 231), "f4ddb2": (18, 50, 249), "edc933": (19, 51, 227), "4775ff": (20, 52, 239),
    "ede8aa": (21, 53, 229), "ed1189": (22, 54, 219), "238e23": (23, 55, 233), "ffa500": (24, 56, 223),
    "edede0": (25, 57, 209), "ed7521": (26, 58, 254), "4782b5": (27, 59, 243), "2d2d4f": (29, 61, 242),
    "00007f": (30, 62, 240), "cc919e": (31, 63, 220), "cc5b44": (32, 64, 216), "518c8c": (212,), "2d4f4f": (213,),
    "ff0000": (215,), "ff6347": (217,), "ff7f00": (224,), "ededd1": (228,), "99cc33": (230,), "2d4f2d": (234,),
    "00bfcc": (236,), "75edc6": (237,), "afe0e5": (241,), "330066": (244,), "660099": (245,), "ed82ed": (246,),
    "f4f4db": (248,), "db9370": (250,), "f4a55e": (251,), "9e9e5e": (253,), "8c4414": (255,),
}  # fmt: skip


def colors_of(material: Ints, words: Words, chunks: Chunks) -> Floats:
    """``(n, 3)`` linear RGB of materials ``(n,)``, NaN where nothing tells it."""
    table = {number: bytes.fromhex(rgb) for rgb, numbers in _PALETTE.items() for number in numbers}
    at = chunks.of("COLR")
    for start, end in zip(chunks.start[at].tolist(), chunks.end[at].tolist(), strict=True):
        if end - start >= 3:
            table[int(words[start + 1])] = words[start + 2 : start + 3].tobytes()[:3]
    different, which = np.unique(material, return_inverse=True)
    colors = np.full((len(different), 3), np.nan)
    for i, number in enumerate(different.tolist()):
        if number in table:
            colors[i] = np.frombuffer(table[number], np.uint8) / 255
    return linear(colors)[which.reshape(-1)]
