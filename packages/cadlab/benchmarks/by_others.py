"""Plants by others, with embedded and with true labels: ``python packages/cadlab/benchmarks/by_others.py [FOLDER...]``

Each FOLDER holds plants as ``NAME/scene.*`` with ``NAME/scene.truth.json`` (docs/truth.md), or is such a plant itself;
without any it is that of the fourteen plants beside this file. ``--write`` puts the table into ``docs/functional.md``.
A row for each plant and mode, and one for all: parts with a true name but for fasteners; units that are there with
their type, and units that are none; pairs of neighbours along the pipes that are right, and that are none, and the same
where tanks and equipment count as one, for a sand filter looks like a tank; directions; kinds of valves; and answers of
``isolate`` that close a check, control or relief valve or say that something is shut off that is still fed.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from isolation import MODES, PAGE, Tally

from cadgraph import SceneGraph, load
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import FASTENERS
from cadgraph.pipeline import build
from cadlab.evaluate.evaluation import evaluate
from cadlab.evaluate.labels import observe_parts, true_labels
from cadlab.evaluate.pairing import pair
from cadlab.markdown import put, table

VESSELS = frozenset({"tank", "equipment"})
OTHERS = Path(__file__).with_name("others")
TITLES = [
    "plant", "labels", "parts", "group right", "name right", "wrong / open", "units / right / none",
    "connections / right / none", "vessels alike", "directions / right / wrong", "kinds right / wrong",
    "unsafe answers",
]  # fmt: skip


def plants_in(folder: Path) -> Iterator[Path]:
    """The folders of plants in a folder, itself or below it.

    Raises:
        SystemExit: there is none.
    """
    found = sorted(path.parent for path in folder.glob("**/scene.truth.json"))
    if not found:
        raise SystemExit(f"{folder}: no scene.truth.json below it; see docs/truth.md")
    yield from found


def measured(task: tuple[Path, str]) -> Counter[str]:
    """The counts of one plant with labels of one mode.

    Raises:
        SystemExit: beside the truth is no scene, or more than one.
    """
    folder, mode = task
    scenes = [path for path in folder.glob("scene.*") if not path.name.endswith(".json")]
    if len(scenes) != 1:
        raise SystemExit(f"{folder}: {len(scenes)} files are called scene.*: leave the one that the truth is of")
    truth = Truth.load(folder / "scene.truth.json")
    graph = build(load(scenes[0]), labels=true_labels(truth) if mode == "true" else [])
    seen = [one for one in observe_parts(pair(graph, truth)) if one.true_name not in FASTENERS and one.true_name]
    scores, tally = evaluate(graph, truth).total, Tally()
    counts = Counter({
        "parts": len(seen),
        "group": sum(one.group == one.true_group for one in seen),
        "name": sum((one.group, one.name) == (one.true_group, one.true_name) for one in seen),
        "open": sum(one.group is None for one in seen),
    })  # fmt: skip
    counts["wrong"] = counts["parts"] - counts["group"] - counts["open"]
    if scores.units is not None:
        units = scores.units.total
        counts.update({"units": units.n_true, "units right": units.matched, "units that are none": units.spurious})
    if scores.connected is not None:
        edges, ways = scores.connected.edges, scores.connected.direction
        counts.update({
            "connections": edges.n_true, "connections right": edges.n_correct,
            "connections that are none": edges.n_predicted - edges.n_correct,
        })  # fmt: skip
        alike = evaluate(graph, as_taken(graph, truth)).total.connected
        if alike is not None:
            counts["alike right"] = alike.edges.n_correct
            counts["alike that are none"] = alike.edges.n_predicted - alike.edges.n_correct
        if ways is not None:
            counts.update({
                "directions": ways.n_known, "directions right": ways.n_right,
                "directions wrong": ways.n_decided - ways.n_right + ways.n_invented,
            })  # fmt: skip
        tally.add(folder.name, graph, truth, False)
        counts.update({"kinds right": tally.kinds["right"], "kinds wrong": tally.kinds["wrong"]})
        counts["unsafe"] = tally.unsafe.total() + tally.fed.total()
    for case in (*tally.unsafe, *tally.fed):
        print(f"unsafe, {mode}: {case}", file=sys.stderr)
    return counts


def as_taken(graph: SceneGraph, truth: Truth) -> Truth:
    """The truth in which each vessel is of the type that most of its meshes were taken for, tank or equipment."""
    mesh_of = {part.id: part.meshes for part in graph.parts()}
    taken = {mesh: unit.unit_type for unit in graph.units() for part in unit.parts for mesh in mesh_of[part]}
    units = []
    for unit in truth.units or ():
        types = Counter(taken[mesh] for mesh in unit.meshes if taken.get(mesh) in VESSELS)
        vessel = unit.type in VESSELS and bool(types)
        units.append(unit.model_copy(update={"type": types.most_common(1)[0][0]}) if vessel else unit)
    return truth.model_copy(update={"units": tuple(units)})


def line(name: str, mode: str, n: Counter[str]) -> list[object]:
    """One row of the table."""
    parts = max(1, n["parts"])
    return [
        name, MODES[mode], n["parts"], f"{100 * n['group'] / parts:.1f} %", f"{100 * n['name'] / parts:.1f} %",
        f"{n['wrong']} / {n['open']}", f"{n['units']} / {n['units right']} / {n['units that are none']}",
        f"{n['connections']} / {n['connections right']} / {n['connections that are none']}",
        f"{n['alike right']} / {n['alike that are none']}",
        f"{n['directions']} / {n['directions right']} / {n['directions wrong']}",
        f"{n['kinds right']} / {n['kinds wrong']}", n["unsafe"],
    ]  # fmt: skip


def main() -> None:
    """Runs from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=Path, metavar="FOLDER", default=[OTHERS])
    parser.add_argument("--modes", nargs="+", default=list(MODES), choices=list(MODES))
    parser.add_argument("--write", action="store_true", help="put the table into docs/functional.md")
    parser.add_argument("--workers", type=int, default=2)
    options = parser.parse_args()
    plants = [plant for folder in options.folders for plant in plants_in(folder)]
    tasks = [(plant, mode) for mode in options.modes for plant in plants]
    totals: dict[str, Counter[str]] = {mode: Counter() for mode in options.modes}
    rows = []
    with ProcessPoolExecutor(options.workers) as pool:
        for (plant, mode), counts in zip(tasks, pool.map(measured, tasks), strict=True):
            totals[mode].update(counts)
            rows.append(line(plant.name, mode, counts))
    rows += [line("all", mode, total) for mode, total in totals.items()]
    text = "\n".join(table(TITLES, rows, True))
    print(text)
    if options.write:
        PAGE.write_text(put(PAGE.read_text(encoding="utf-8"), "others", text), encoding="utf-8")


if __name__ == "__main__":
    main()
