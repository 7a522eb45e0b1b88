"""Digests of whole results, and the files that keep them: a change of behaviour that nobody meant shows here first.

Each record has two digests. ``structure`` covers what is said: ids, labels, tags, edges, directions, counts, faces; it
holds on every machine. ``bytes`` covers every bit, rounding included, and holds where processor and libraries round as
they did on the machine that wrote it. ``pytest --renew-golden`` writes the records anew.
"""

import hashlib
import importlib.metadata
import json
import math
import platform
import struct
from functools import cache
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent / "golden"

# Their texts hold measured numbers in words, whose last digits are as the machine rounds them.
_WORDED = ("sha256", "guesses", "kind_guesses", "why", "reasons")


@cache
def rounding():
    """What decides how the last bits come out, told by what comes out: the same names of processor and libraries have
    rounded in two ways.
    """
    libraries = [f"{name} {importlib.metadata.version(name)}" for name in ("numba", "numpy", "scipy", "usd-core")]
    rest = (platform.machine(), platform.system(), *libraries)
    probe = hashlib.sha256(repr(rest).encode())
    for values in _probes():
        probe.update(np.ascontiguousarray(values, np.float64).tobytes())
    return probe.hexdigest()[:8]


def _probes():
    """Results of functions, products and decompositions of many sizes."""
    rng = np.random.default_rng(5)
    x, y = rng.normal(0, 3, (2, 1001))
    yield from (function(x) for function in (np.sin, np.cos, np.tan, np.exp, np.arctan, np.cbrt, np.tanh))
    yield from (function(np.abs(x)) for function in (np.sqrt, np.log, np.log1p))
    yield from (np.arctan2(x, y), np.hypot(x, y), np.abs(x) ** y, np.arccos(np.clip(x, -1, 1)), np.cumsum(x))
    yield [function(value) for function in (math.sin, math.cos, math.atan, math.exp) for value in x]
    for rows, inner, columns in ((3, 3, 3), (4, 4, 4), (1001, 3, 3), (7, 3, 1001), (40, 40, 40)):
        yield rng.normal(size=(rows, inner)) @ rng.normal(size=(inner, columns))
    yield np.einsum("nij,nj->ni", rng.normal(size=(50, 3, 3)), rng.normal(size=(50, 3)))
    yield np.linalg.norm(rng.normal(size=(500, 3)), axis=1)
    for n in (3, 4, 30):
        square = rng.normal(size=(n, n))
        yield from (*np.linalg.svd(square), *np.linalg.eigh(square @ square.T), np.linalg.inv(square))
        yield np.linalg.solve(square, rng.normal(size=n))


def digest(content):
    return hashlib.sha256(content).hexdigest()[:20]


def without_numbers(value):
    """A JSON value with every number that is no count left out."""
    if isinstance(value, dict):
        return {key: without_numbers(inner) for key, inner in value.items() if key not in _WORDED}
    if isinstance(value, list):
        return [without_numbers(inner) for inner in value]
    return None if isinstance(value, float) else value


def of_graph(path, layer):
    """The record of a graph and of the layer of labels beside it."""
    text = path.read_bytes()
    content = json.loads(text)
    # Messages hold measured numbers in words; the settings are tested by themselves.
    content["diagnostics"] = [(found["code"], found["meshes"]) for found in content["diagnostics"]]
    del content["config"]
    structure = json.dumps(without_numbers(content), sort_keys=True).encode()
    return {"structure": digest(structure), "graph": digest(text), "layer": digest(layer.read_bytes())}


def of_components(components):
    """The record of a device: what its parts are called and how their corners are joined; then where these lie."""
    said, exact = hashlib.sha256(), hashlib.sha256()
    for component in components:
        solid = component.solid
        said.update(f"{component.group}/{component.name}/{len(solid.vertices)}/{len(solid.faces)};".encode())
        said.update(np.ascontiguousarray(solid.faces, np.int64).tobytes())
        exact.update(np.ascontiguousarray(solid.vertices, np.float64).tobytes())
        exact.update(np.ascontiguousarray(component.pose, np.float64).tobytes())
        exact.update(struct.pack("<3d", *component.color))
    return {"structure": said.hexdigest()[:20], "corners": exact.hexdigest()[:20]}


class Records:
    """The records in one file."""

    def __init__(self, name, renew):
        self.file, self.renew = FOLDER / f"{name}.json", renew
        self.known = json.loads(self.file.read_text()) if self.file.exists() else {}

    def check(self, name, found):
        """Fails where a result differs from its record, or keeps it as the new one if that was asked for."""
        self.check_all({name: found})

    def check_all(self, results):
        """The same for several results by name; all that differ are named at once."""
        found = {name: {**result, "rounding": rounding()} for name, result in results.items()}
        if self.renew:
            self.known |= found
            rows = ",\n".join(f' "{k}": {json.dumps(v)}' for k, v in sorted(self.known.items()))
            self.file.write_text(f"{{\n{rows}\n}}\n")
            return
        missing = sorted(found.keys() - self.known.keys())
        assert missing == [], "without a record; write it with pytest --renew-golden"
        changed = [name for name, result in found.items() if not _agree(self.known[name], result)]
        assert changed == [], "not what they were; if that is meant, pytest --renew-golden and say so"


def _agree(known, found):
    """Whether two records are of one result: to the last bit where both were made with the same rounding."""
    return known == found if known["rounding"] == found["rounding"] else known["structure"] == found["structure"]
