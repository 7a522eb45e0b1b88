"""Files of real plants: ``python packages/cadlab/benchmarks/formats_real.py [DATA] [--tables plm rhbg ...] [--write]``.

DATA is a folder of public CAD files (``real/plm``, ``formats``, ``mesh``, ``usd``, ``step``), beside the repository
where none is named. Tables: ``plm`` (a PDMS plant read from USD and from its RVM, beside its truth), ``rhbg`` (an E3D
plant, beside the types of its elements), ``files`` (what reading each of the others gives), ``damage`` (damaged copies
of each format), ``million`` (a million RVM primitives), ``units`` (whether lengths tell their unit). ``--write`` puts
them into ``docs/formats.md``.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from _damaged_files import write_files
from _timing import machine, timed
from _unit_doubts import TITLES as UNIT_TITLES
from _unit_doubts import files_in, tally_files, tally_plants
from damage import TITLES as DAMAGE_TITLES
from damage import try_copies
from rvm import made_up, peak, repeat

from cadgraph.config import Config, LoadConfig
from cadgraph.errors import LoadError
from cadgraph.facts.pdms_types import pdms_label
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadgraph.pipeline import build
from cadgraph.query.compare_source import Verdict, compare_source
from cadgraph.query.source_text import source_lines
from cadlab.evaluate.evaluation import evaluate
from cadlab.markdown import put, table
from cadplants.writers.matching import match, truth_for

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "formats.md"
DATA = ROOT.parent / "shared" / "data"
IN_PROCESS = LoadConfig(isolate=False)
METADATA = {"label.use_metadata": True, "relate.use_metadata": True}
PLM_TOLERANCE = 0.005  # of the boxes of two readings of one plant [m]; 1 and 20 mm give the same pairs
ASK_FOR_UNIT = "--unit"
SEEDS = (3, 11)
ALWAYS = "OBJ, STL and PLY are read with --unit mm; sound ones get a note, too, on their up axis or on being split."

# ---------------------------------------------------------------------------------------------------------- plm.rvm


def plm(data: Path) -> list[str]:
    """One plant read from USD without names and from RVM, beside its truth."""
    folder = data / "real" / "plm"
    usd, rvm = (load(folder / name, IN_PROCESS) for name in ("scene.usdc", "plm.rvm"))
    truth = plm_truth(folder, usd)
    rows = [
        plm_row("scene.usdc", usd, truth, {}),
        plm_row("plm.rvm, geometry alone", rvm, truth, {}),
        plm_row("plm.rvm, --use-metadata", rvm, truth, METADATA),
    ]
    titles = (
        "read from", "meshes", "true meshes found", "group right", "name right", "connected: right / said / true", "F1",
        "directions: right / said / true",
    )  # fmt: skip
    found = match(rvm, truth, PLM_TOLERANCE)
    extra = surplus_words(rvm, found.surplus)
    labels = labels_of(build(rvm))
    now = {old: (new,) for old, new in found.same.items()} | found.split
    wrong = [
        mesh.mesh
        for mesh in truth.meshes
        if mesh.name is not None and any(labels[path] != (mesh.group, mesh.name) for path in now.get(mesh.mesh, ("",)))
    ]
    split = sum(path in found.split for path in wrong)
    pieces = sum(map(len, found.split.values()))
    return [
        *table(titles, rows, numbers=True),
        "",
        f"{len(found.split)} meshes of scene.usdc are {pieces} of plm.rvm, and right only where all of these are: "
        f"{split} of the {len(wrong)} names that are wrong by geometry alone are of such. "
        f"{sum(map(len, found.merged.values()))} is part of another there, {len(found.missing)} are not in it; "
        f"{len(found.surplus)} meshes of plm.rvm are not in "
        f"scene.usdc: {extra}.",
    ]


def plm_truth(folder: Path, scene: Scene) -> Truth:
    """The truth with the place of each mesh, and its contracted connections between units."""
    truth = json.loads((folder / "scene.truth.json").read_text("utf-8"))
    row = {path: i for i, path in enumerate(scene.paths)}
    for mesh in truth["meshes"]:
        vertices, faces = scene.mesh(row[mesh["mesh"]])
        used = vertices[np.unique(faces)] + scene.origin
        mesh["bounds"] = [used.min(axis=0).tolist(), used.max(axis=0).tolist()]
    scored = json.loads((folder / "score.truth.json").read_text("utf-8"))
    truth["connections"] = [
        {
            "from": edge["a"],
            "to": edge["b"],
            "direction": "unknown"
            if edge["direction"] is None
            else ("forward" if edge["direction"][0] == edge["a"] else "backward"),
        }
        for edge in scored["edges"]
    ]
    return Truth.from_json(truth)


def plm_row(title: str, scene: Scene, truth: Truth, settings: Mapping[str, object]) -> tuple[object, ...]:
    """A row of the table; a true mesh that is several is right where all of these are."""
    graph = build(scene, Config().replace(dict(settings)))
    found = match(scene, truth, PLM_TOLERANCE)
    now = {old: (new,) for old, new in found.same.items()} | found.split
    named = [mesh for mesh in truth.meshes if mesh.name is not None]
    labels = labels_of(graph)
    group = sum(all(labels[p][0] == mesh.group for p in now.get(mesh.mesh, ("",))) for mesh in named)
    name = sum(all(labels[p] == (mesh.group, mesh.name) for p in now.get(mesh.mesh, ("",))) for mesh in named)
    there = sum(mesh.mesh in now for mesh in named)
    scores = evaluate(graph, truth_for(scene, truth, PLM_TOLERANCE)).total.connected
    if scores is None or scores.direction is None:
        raise ValueError(f"{title}: the truth has no connections")
    edges, ways = scores.edges, scores.direction
    known = sum(one.direction != "unknown" for one in truth.connections or ())
    return (
        title, scene.n_meshes, f"{there} of {len(named)}", share(group, len(named)), share(name, len(named)),
        f"{edges.n_correct} / {edges.n_predicted} / {edges.n_true}", f"{edges.f1 or 0:.2f}",
        f"{ways.n_right} / {ways.n_decided} / {known}",
    )  # fmt: skip


def labels_of(graph: SceneGraph) -> dict[str, tuple[str | None, str | None]]:
    """Group and name of each mesh by that of its part; nothing for the path ""."""
    found: dict[str, tuple[str | None, str | None]] = {"": (None, None)}
    for part in graph.parts():
        label = (part.label.group, part.label.name) if part.label else (None, None)
        found |= dict.fromkeys(part.meshes, label)
    return found


def surplus_words(scene: Scene, paths: Sequence[str]) -> str:
    """How many meshes of which type there are among some."""
    types = types_of(scene)
    counts = Counter(types.get(path, "without a type") for path in paths)
    return ", ".join(f"{count} {kind}" for kind, count in counts.most_common())


def types_of(scene: Scene) -> dict[str, str]:
    """The type of the element of each mesh, or of the nearest element above it that has one, by path."""
    said = {fact.path: fact.value for fact in scene.facts if fact.key == "class"}
    found = {}
    for path in scene.paths:
        above = path
        while above and above not in said:
            above = above.rpartition("/")[0]
        if above:
            found[path] = said[above]
    return found


# ---------------------------------------------------------------------------------------------------------- RHBG.RVM


def rhbg(data: Path) -> list[str]:
    """The labels of a plant's elements, beside their types, which are read from default names."""
    scene = load(data / "formats" / "RHBG.RVM", IN_PROCESS)
    graphs = [build(scene, Config().replace(settings)) for settings in ({}, METADATA)]
    plain, told = map(labels_of, graphs)
    titles = ("type", "meshes", "name", "group right", "name right", "other names", "name right with metadata")
    heads = (
        "graph", "units", "connections", "compare --source: agree", "only graph", "only source", "directions agree",
        "differ", "only graph", "only source",
    )  # fmt: skip
    print("\n".join(source_lines(compare_source(graphs[0]), most=8)), file=sys.stderr)
    return [
        f"{scene.n_meshes} meshes, {scene.n_triangles:,} triangles, {len(scene.facts)} facts, {len(scene.links)} links "
        "of elements that follow each other in a branch.",
        "",
        *table(titles, type_rows(scene, plain, told), numbers=True),
        "",
        *table(heads, map(source_row, ("geometry alone", "with metadata"), graphs), numbers=True),
    ]


Labels = Mapping[str, tuple[str | None, str | None]]


def type_rows(scene: Scene, plain: Labels, told: Labels) -> Iterator[tuple[object, ...]]:
    """A row for each type of element that tells a name, the most frequent first."""
    own = {fact.path: fact.value for fact in scene.facts if fact.key == "class"}
    for kind, count in Counter(own[path] for path in scene.paths if path in own).most_common():
        means = pdms_label(kind)
        if means is None or means[1] is None:
            continue
        paths = [path for path in scene.paths if own.get(path) == kind]
        right, right_told = (sum(labels[path] == means[:2] for path in paths) for labels in (plain, told))
        group = sum(plain[path][0] == means[0] for path in paths)
        others = Counter(plain[path][1] or "no name" for path in paths if plain[path][1] != means[1])
        misses = ", ".join(f"{n} {name}" for name, n in others.most_common(3))
        yield kind.lower(), count, means[1], group, right, misses or "-", right_told


def source_row(title: str, graph: SceneGraph) -> tuple[object, ...]:
    """What a graph holds, and how it compares with what the file joins."""
    units = Counter(unit.unit_type for unit in graph.units())
    found = compare_source(graph)
    words = ", ".join(f"{n} {kind}" for kind, n in sorted(units.items())) or "none"
    verdicts: tuple[Verdict, ...] = ("agree", "differ", "ours", "theirs")
    return (
        title, words, len(graph.connections()), len(found.agreeing), len(found.only_ours), len(found.only_theirs),
        *(len(found.directions(verdict)) for verdict in verdicts),
    )  # fmt: skip


# -------------------------------------------------------------------------------------------------------- other files


def files(data: Path) -> list[str]:
    """What reading and labelling files of all other formats gives."""
    found = [data / "formats" / "Duplex_Electrical.ifc", data / "formats" / "WD1-PSUP.RVM"]
    found += sorted((data / "formats").glob("*.glb"))
    found += [data / "formats" / "counter.unitsmm.stl", data / "formats" / "counterXP.3mf"]
    found += sorted((data / "mesh").rglob("*.dae"))
    found += sorted((data / "ifc").rglob("*.[iI][fF][cC]"))
    titles = ("file", "meshes", "triangles", "read [CPU s]", "parts", "with a label", "notes")
    return table(titles, map(file_row, found), numbers=True)


def file_row(path: Path) -> tuple[object, ...]:
    """The row of a file; one without a unit is read in millimetres once it is refused."""
    config, refused = IN_PROCESS, ""
    try:
        load(path, config)
    except LoadError as error:
        if ASK_FOR_UNIT not in str(error):
            return path.name, "-", "-", "-", "-", "-", str(error).removeprefix(str(path)).lstrip(": ")
        config, refused = config.model_copy(update={"unit": "mm"}), "refused without --unit; "
    seconds = timed(lambda: load(path, config), repeats=1)[1]
    scene = load(path, config)
    parts = build(scene).parts()
    labelled = share(sum(part.label is not None for part in parts), len(parts))
    notes = ", ".join(sorted({note.code for note in scene.diagnostics})) or "none"
    return path.name, scene.n_meshes, f"{scene.n_triangles:,}", f"{seconds:.2f}", len(parts), labelled, refused + notes


# ------------------------------------------------------------------------------------------------------------- damage


def damage(copies: int) -> list[str]:
    """How reading damaged copies of each format ends."""
    rows, defects = [], []
    with tempfile.TemporaryDirectory() as folder:
        for path in write_files(Path(folder)):
            cells, other = try_copies(path, copies)
            rows.append((f"{path.suffix[1:].upper()}, {path.stat().st_size / 1000:.0f} kB", *cells[1:]))
            defects += other
            print(rows[-1], *other, sep="\n", file=sys.stderr, flush=True)
    return [*table(("format", *DAMAGE_TITLES[1:]), rows, numbers=True), "", ALWAYS, *(f"\n{line}" for line in defects)]


# ------------------------------------------------------------------------------------------------ a million primitives


def million(data: Path, primitives: int) -> list[str]:
    """Time and memory of a plant of very many primitives: a real one, repeated in a grid."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.rvm"
        n = repeat(data / "formats" / "RHBG.RVM", path, primitives)
        rows = []
        for title, *more in (
            ("in this process, metadata off", "--metadata", "off"),
            ("in this process",),
            ("in a process of its own, as by default", "--isolate"),
        ):
            command = [sys.executable, __file__, "--load", str(path), *more]
            got = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
            cells = [f"{got[name]:,}" for name in ("meshes", "shapes", "triangles", "facts")]
            cells += [f"{got[name]:.1f}" for name in ("cpu", "wall")]
            rows.append((title, *cells, f"{got['peak']:.2f}", f"{got['reader']:.2f}" if got["reader"] else "-"))
        megabytes = path.stat().st_size / 1e6
    titles = ("read", "meshes", "shapes", "triangles", "facts", "CPU s", "wall s", "peak GB", "of the reading process")
    notes = f"{n:,} primitives, a file of {megabytes:.0f} MB; notes: {', '.join(got['notes'])}."
    return [notes, "", *table(titles, rows, numbers=True)]


def load_and_tell(path: Path, config: LoadConfig) -> None:
    """Reads a file and prints its times and peak memory as JSON; a small one first, so that all is compiled."""
    import resource

    with tempfile.TemporaryDirectory() as folder:
        small = Path(folder) / "small.rvm"
        made_up(small, 1)
        load(small, config)

    def spent() -> float:
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        return time.process_time() + children.ru_utime + children.ru_stime

    begun, clock = spent(), time.perf_counter()
    scene = load(path, config)
    found: dict[str, Any] = {
        "cpu": spent() - begun,
        "wall": time.perf_counter() - clock,
        "peak": peak(),
        "reader": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e6 if config.isolate else 0,
        "meshes": scene.n_meshes,
        "shapes": scene.shapes.n,
        "triangles": scene.n_triangles,
        "facts": len(scene.facts),
        "notes": sorted({note.code for note in scene.diagnostics}),
    }
    print(json.dumps(found))


# -------------------------------------------------------------------------------------------------------------- units


def units(data: Path) -> list[str]:
    """Whether lengths tell their unit, and how often a wrong one."""
    tallies = []
    for tally in _tallies(data):
        tallies.append(tally)
        print(tally, file=sys.stderr, flush=True)
    alarms = [name for tally in tallies for name in tally.alarms]
    misled = [name for tally in tallies for name in tally.misled]
    return [
        *table(UNIT_TITLES, (tally.cells() for tally in tallies), numbers=True),
        "",
        f"False alarms: {', '.join(alarms) or 'none'}. A wrong unit taken: {', '.join(misled) or 'none'}.",
    ]


def _tallies(data: Path) -> Iterator[Any]:
    real = data / "real"
    parts = files_in(real / "parts")
    yield tally_files("real plants with truth", [path for path in files_in(real) if path not in set(parts)])
    yield tally_files("USD samples", files_in(data / "usd"))
    yield tally_files("STEP parts", files_in(data / "step"))
    yield tally_files("single real parts", parts)
    yield tally_plants(SEEDS)


# --------------------------------------------------------------------------------------------------------------- main


def share(count: int, of: int) -> str:
    return f"{100 * count / of:.1f} %" if of else "-"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", nargs="?", type=Path, default=DATA, help="a folder of public CAD files")
    parser.add_argument("--copies", type=int, default=300, help="damaged ones of each format")
    parser.add_argument("--primitives", type=int, default=1_000_000)
    parser.add_argument("--write", action="store_true", help=f"put the tables into {PAGE.name}")
    parser.add_argument("--load", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--isolate", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--metadata", default="keep", help=argparse.SUPPRESS)
    makers: dict[str, Callable[[argparse.Namespace], list[str]]] = {
        "plm": lambda options: plm(options.data),
        "rhbg": lambda options: rhbg(options.data),
        "files": lambda options: files(options.data),
        "damage": lambda options: damage(options.copies),
        "million": lambda options: million(options.data, options.primitives),
        "units": lambda options: units(options.data),
    }
    parser.add_argument("--tables", nargs="+", choices=list(makers), default=list(makers))
    options = parser.parse_args()
    if options.load:
        load_and_tell(options.load, LoadConfig(isolate=options.isolate, metadata=options.metadata))
        return 0
    if not (options.data / "formats").is_dir():
        print(f"{options.data}: no folder of CAD files (formats, real...); give one as the first argument")
        return 1
    for name in options.tables:
        text = "\n".join([*makers[name](options), "", f"{machine()}."])
        print(f"\n## {name}\n\n{text}", flush=True)
        if options.write:
            PAGE.write_text(put(PAGE.read_text("utf-8"), name, text), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
