"""How long labelling takes: ``python packages/cadlab/benchmarks/label.py [--field]``.

Prints a Markdown table: for generated plants of growing size, processor seconds for the features of shapes, for those
of contacts and for the network, and per distinct shape; repeats of one plant show that shapes count, not parts.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import Any

import numpy as np
from _timing import machine, once

from cadgraph.labelers.embedded.features import Observation, observe
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler, judge
from cadgraph.labelers.embedded.model import default_model
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary
from cadlab.markdown import table
from cadlab.training.distractors import UNSEEN_FROM, make_distractors
from cadlab.training.example import make_parts_from
from cadplants import make


def tiled(scene: Scene, times: int) -> Scene:
    """The same scene several times side by side."""
    width = float(np.ptp(scene.vertices[:, 0])) + 2.0
    meshes, paths = [], []
    for k in range(times):
        for i in range(scene.n_meshes):
            vertices, faces = scene.mesh(i)
            meshes.append((vertices + np.array([k * width, 0, 0]), faces))
            paths.append(f"/tile_{k}{scene.paths[i]}")
    return Scene.from_meshes(meshes, paths)


def strangers(count: int, distinct: bool) -> Scene:
    """Jugs, boats and the like of a few thousand triangles in a row: all different, or one of them again and again.

    Args:
        count: how many.
        distinct: whether each is stretched in a way of its own.
    """
    rng = np.random.default_rng(7)
    one = max(make_distractors(UNSEEN_FROM, 30).components, key=lambda c: len(c.faces))
    vertices = one.vertices / np.ptp(one.vertices, axis=0).max()
    meshes = []
    for k in range(count):
        factors = rng.uniform(0.6, 1.6, 3) if distinct else np.ones(3)
        meshes.append((vertices * factors + np.array([3.0 * (k % 40), 3.0 * (k // 40), 0]), one.faces))
    return Scene.from_meshes(meshes)


def row(name: str, parts: Parts, contacts: Contacts) -> list[Any]:
    """One line of the table."""
    seen: list[Observation] = []
    model, vocabulary = default_model(), default_vocabulary()
    observe(parts, contacts)
    # What was seen is kept with the parts; a copy of them is looked at anew.
    looking = once(lambda: seen.append(observe(replace(parts), contacts)))
    naming = once(lambda: judge(model, seen[0], vocabulary))
    whole = once(lambda: EmbeddedLabeler().label(replace(parts), contacts, vocabulary))
    shapes = len(seen[0].facts)
    return [
        name, f"{parts.n_parts:,}", f"{len(contacts.pairs):,}", f"{shapes:,}", f"{parts.scene.n_triangles:,}",
        f"{looking:.2f}", f"{naming:.2f}", f"{whole:.2f}", f"{1000 * whole / max(shapes, 1):.1f}",
    ]  # fmt: skip


def main() -> None:
    """Runs the benchmark."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--field", action="store_true", help="also the whole field plant")
    rows = []
    skid = make("skid").scene()
    for times in (1, 4, 16):
        rows.append(row(f"{times} x skid", *make_parts_from(tiled(skid, times))))
    for preset in ("tank", "rack", *(("field",) if parser.parse_args().field else ())):
        rows.append(row(preset, *make_parts_from(make(preset).scene())))
    rows.append(row("1,000 times one stranger", *make_parts_from(strangers(1000, distinct=False))))
    rows.append(row("1,000 strangers", *make_parts_from(strangers(1000, distinct=True))))
    print(machine() + "\n")
    titles = [
        "plant",
        "parts",
        "contacts",
        "shapes",
        "triangles",
        "looking [s]",
        "naming [s]",
        "in all [s]",
        "ms a shape",
    ]
    print(*table(titles, rows, numbers=True), sep="\n")


if __name__ == "__main__":
    main()
