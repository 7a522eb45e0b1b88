"""Real RVM files, where a collection of them is present; counts and shares are as first measured on them."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from cadgraph.config import LoadConfig
from cadgraph.load import load
from cadgraph.load.packing import Notes
from cadgraph.load.rvm.attributes import read_attributes
from cadgraph.load.rvm.chunks import find_chunks, map_words
from cadgraph.load.rvm.placing import cut_shapes
from cadgraph.load.rvm.primitives import FACETS, read_primitives
from cadgraph.load.rvm.shapes import Fineness
from cadgraph.load.rvm.tree import read_tree

DATA = Path(__file__).parents[2] / "../shared/data"
RHBG, WD1 = DATA / "formats/RHBG.RVM", DATA / "formats/WD1-PSUP.RVM"
PLM = DATA / "real/plm/plm.rvm"
IN_PROCESS = LoadConfig(isolate=False)
pytestmark = pytest.mark.skipif(not all(path.is_file() for path in (RHBG, WD1, PLM)), reason="no real files here")


def cut(path):
    """Words, chunks, primitives, shapes and the shape of each."""
    words, notes = map_words(path), Notes()
    chunks = find_chunks(words, path, notes)
    primitives = read_primitives(words, chunks, str, notes, insulation=False, skew=1e-4)
    shapes, shape = cut_shapes(words, primitives, Fineness(0.5, 0.35), 50_000_000, str, notes)
    assert {note.code for note in notes.diagnostics()} <= {"flat-primitive", "left-out-lines"}
    return words, chunks, primitives, shapes, shape


def is_closed(faces):
    start, end = faces.reshape(-1).astype(np.int64), faces[:, [1, 2, 0]].reshape(-1).astype(np.int64)
    return np.array_equal(np.sort(start << 32 | end), np.sort(end << 32 | start))


# Of 951, 2757 and 658 primitives: lines, those without thickness, and those whose box the file makes symmetric.
@pytest.mark.parametrize(
    ("path", "primitives", "lines", "flat", "asymmetric", "facets"),
    [(RHBG, 951, 0, 95, 0, 15), (WD1, 2757, 129, 0, 0, 334), (PLM, 658, 12, 36, 3, 80)],
)
def test_every_primitive_fills_its_box_and_is_a_solid(path, primitives, lines, flat, asymmetric, facets):
    words, chunks, found, shapes, shape = cut(path)
    assert len(chunks.of("PRIM")) == primitives
    assert len(found.kind) == primitives - lines
    assert (found.kind == FACETS).sum() == facets
    boxes = words[(chunks.start[found.chunk] + 14)[:, None] + np.arange(6)].view(">f4").astype(float)
    misfits = none = 0
    for box, kind, number in zip(boxes, found.kind, shape, strict=True):
        if shapes[number] is None:
            none += 1
            continue
        points = shapes[number][0] * 1000
        own = np.concatenate([points.min(axis=0), points.max(axis=0)])
        # E3D Mk3 stores those of facet groups in axes of their own.
        if kind != FACETS or path != RHBG:
            misfits += np.abs(own - box).max() > 0.02 * np.ptp(box.reshape(2, 3), axis=0).max() + 0.01
    assert (none, misfits) == (flat, asymmetric)
    for points, faces in filter(None, shapes):
        assert is_closed(faces)
        assert np.linalg.det(points[faces] - points[0]).sum() > 0


def test_granularity_of_a_real_plant():
    counts = {
        way: load(RHBG, LoadConfig(isolate=False, granularity=way)).n_meshes for way in ("auto", "primitive", "node")
    }
    assert counts == {"auto": 373, "primitive": 856, "node": 283}


def test_types_of_a_real_plant_are_told_by_default_names():
    scene = load(RHBG, IN_PROCESS)
    meshes = set(scene.paths)
    kinds = Counter(fact.value for fact in scene.facts if fact.key == "class" and fact.path in meshes)
    assert (kinds["VALVE"], kinds["ELBOW"], kinds["TEE"], kinds["FLANGE"]) == (24, 78, 12, 92)
    assert {link.where for link in scene.links} == {"order in branch"}


def test_attributes_match_every_node():
    notes = Notes()
    words = map_words(PLM)
    tree, _ = read_tree(words, find_chunks(words, PLM, notes), str(PLM), notes)
    told = read_attributes(PLM.with_suffix(".att"), notes)
    assert sum(name in told for name in tree.names) == len(tree.names) == 315
    assert all("TYPE" in told[name] for name in tree.names)


def test_links_of_a_real_plant_join_what_lies_together():
    scene = load(PLM, IN_PROCESS)
    number = {path: i for i, path in enumerate(scene.paths)}
    gaps = []
    for link in scene.links:
        if link.where == "order in branch" and link.first in number and link.second in number:
            one, other = (scene.mesh(number[path])[0] for path in (link.first, link.second))
            apart = np.maximum(one.min(axis=0) - other.max(axis=0), other.min(axis=0) - one.max(axis=0))
            gaps.append(np.linalg.norm(np.maximum(apart, 0)))
    assert len(gaps) > 100
    assert np.mean(np.array(gaps) < 0.01) > 0.9
    ends = {link.where for link in scene.links}
    assert ends == {"order in branch", "att HREF", "att TREF", "att CREF"}
