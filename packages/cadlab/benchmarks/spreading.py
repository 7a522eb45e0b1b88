"""What a correction does to other parts: ``python packages/cadlab/benchmarks/spreading.py [--real DIR]``.

In plants of all kinds of devices, and in real ones where a folder of such is given (each with ``scene.usdc`` and
``scene.truth.json``), parts whose label is wrong are corrected one at a time, each taken back before the next. Prints a
Markdown table of what became of others by likeness alone: mended, spoilt, or wrong before and after. Exact repeats of
the corrected part are not among them.
"""

from __future__ import annotations

import argparse
import random
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from _timing import machine

import cadgraph
from cadgraph.model.labels import CorrectedEvidence
from cadgraph.model.records import Part
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.session.session import Session
from cadlab.markdown import table
from cadplants import make
from cadplants.truth.truth_writer import truth_of

PLANTS = [(style, seed) for seed in (3, 7, 8) for style in ("bim", "game", "mechanical")]
MOST = 40  # corrections of a plant

Said = tuple[str, str | None]


def plants(real: Path | None) -> Iterator[tuple[str, Scene, Truth]]:
    """Name, scene and truth of each plant."""
    for style, seed in PLANTS:
        plant = make("assortment", seed=seed, style=style)
        yield f"`assortment`, {style}, {seed}", plant.scene(), Truth.from_json(truth_of(plant))
    for folder in sorted(real.iterdir()) if real else ():
        if (folder / "scene.usdc").exists():
            yield folder.name, cadgraph.load(folder / "scene.usdc"), Truth.load(folder / "scene.truth.json")


def said(part: Part) -> Said | None:
    """Group and name of a part."""
    return None if part.label is None else part.label.said


def row(name: str, scene: Scene, truth: Truth) -> tuple[list[str], Counter[str]]:
    """One line of the table, and its counts."""
    true = {mesh.mesh: (mesh.group, mesh.name) for mesh in truth.meshes if mesh.name is not None}
    session = Session.start(scene)
    before = {part.id: part for part in session.graph.parts()}
    right = {p.id: next((true[mesh] for mesh in p.meshes if mesh in true), None) for p in before.values()}
    wrong = [part for part in before.values() if right[part.id] is not None and said(part) != right[part.id]]
    corrected = random.Random(1).sample(wrong, min(MOST, len(wrong)))
    found: Counter[str] = Counter()
    for one in corrected:
        group, label = right[one.id] or ("", None)
        session.correct(one.id, f"{group}/{label}")
        for part in session.graph.parts():
            evidence = None if part.label is None else part.label.evidence
            reached = isinstance(evidence, CorrectedEvidence) and evidence.match == "kin"
            if reached and right[part.id] is not None:
                old = said(before[part.id])
                mended, spoilt = said(part) == right[part.id], old == right[part.id]
                found["mended" if mended else "spoilt" if spoilt else "wrong to wrong"] += said(part) != old
        session.undo()
    counts = [str(found[word]) for word in ("mended", "spoilt", "wrong to wrong")]
    return [name, str(len(before)), str(len(wrong)), str(len(corrected)), *counts], found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--real", type=Path, metavar="DIR", help="a folder of real plants with their truth")
    arguments = parser.parse_args()
    rows, all_found = [], Counter[str]()
    for plant in plants(arguments.real):
        told, found = row(*plant)
        rows.append(told)
        all_found += found
    counts = [str(all_found[word]) for word in ("mended", "spoilt", "wrong to wrong")]
    rows.append(["all", *(str(sum(int(told[k]) for told in rows)) for k in (1, 2, 3)), *counts])
    print("\n".join(table(("plant", "parts", "wrong", "corrected", "mended", "spoilt", "wrong to wrong"), rows)))
    print(f"\n({machine()})")


if __name__ == "__main__":
    main()
