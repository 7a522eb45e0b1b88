"""Every kind of file that is read, how it is laid out, and what reads it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig
    from cadgraph.model.scene import Scene

__all__ = ["KINDS", "Kind", "read_scene"]

Read = Callable[[Path, Path], Any]


@dataclass(frozen=True)
class Kind:
    """A kind of file.

    Args:
        name: as in ``--only``.
        suffix: of its files.
        layout: what spoils it, a key of the table in ``mutate``.
        read: takes the spoilt file and the folder of the seeds, and returns what it holds.
        scene: whether it returns a scene, which is then read in a process of its own outside of this fuzzer.
        whole: another file that is sound, by its suffix; ``read`` is then given that one, the spoilt one beside.
        values: whether what refuses it is a plain ``ValueError``, which the command line tells like its own errors.
        named: whether a refusal must name the file; not where an answer of a model is read, which is in no file.
    """

    name: str
    suffix: str
    layout: str
    read: Read
    scene: bool = False
    whole: tuple[str, str] | None = None
    named: bool = True
    values: bool = False


def read_scene(file: Path, config: LoadConfig) -> Scene:
    """Reads a scene; formats without a unit are otherwise refused for that alone."""
    import cadgraph

    unit = "mm" if file.suffix in (".obj", ".stl", ".ply") else None
    return cadgraph.load(file, config.model_copy(update={"unit": unit}))


def _scene(file: Path, _: Path) -> Scene:
    from cadgraph.config import LoadConfig

    return read_scene(file, LoadConfig(isolate=False))


def _graph(file: Path, _: Path) -> Any:
    from cadgraph.model.graph import SceneGraph
    from cadgraph.query import find_lines
    from cadgraph.query.summary import summarize

    graph = SceneGraph.load(file)
    find_lines(graph)
    summarize(graph)
    return graph.to_json()


def _truth(file: Path, _: Path) -> Any:
    from cadgraph.model.truth import Truth, check_truth
    from cadgraph.model.vocabulary import default_vocabulary

    return check_truth(Truth.load(file), default_vocabulary())


def _corrections(file: Path, _: Path) -> Any:
    from cadgraph.model.corrections import read_history
    from cadgraph.model.vocabulary import default_vocabulary

    return read_history(file, default_vocabulary()).in_force


def _labels(file: Path, _: Path) -> Any:
    from cadgraph.model.given_labels import read_labels
    from cadgraph.model.vocabulary import default_vocabulary

    return read_labels(file, default_vocabulary())


def _catalogue(file: Path, _: Path) -> Any:
    from cadgraph.model.catalog import read_catalog, rows_of

    return rows_of(read_catalog(file))


def _vocabulary(file: Path, _: Path) -> Any:
    from cadgraph.model.vocabulary import read_vocabulary

    return read_vocabulary(file).to_json()


def _dexpi(file: Path, _: Path) -> Any:
    from cadgraph.export.dexpi import read_dexpi
    from cadgraph.query import find_lines

    return find_lines(read_dexpi(file))


def _answer(file: Path, _: Path) -> Any:
    """As 'cadgraph ask-folder --check' and labelling read it."""
    from cadgraph.labelers.lvlm.folder import ANSWER_FILE, write_index
    from cadgraph.labelers.lvlm.skill import check_answers
    from cadgraph.model.vocabulary import default_vocabulary

    question = "0123456789abcdef"
    own = file.parent / f"q-{question}"
    own.mkdir(exist_ok=True)
    (own / ANSWER_FILE).write_bytes(file.read_bytes())
    write_index(file.parent, [(question, ["/a"])])
    lines = check_answers(file.parent, default_vocabulary()).lines()
    if any(not line.isprintable() for line in lines):
        raise ValueError(f"a line that can't be printed: {lines!r}")
    return lines


def _index(file: Path, _: Path) -> Any:
    from cadgraph.labelers.lvlm.folder import read_index

    (file.parent / "index.json").write_bytes(file.read_bytes())
    return read_index(file.parent)


def _batch(file: Path, _: Path) -> Any:
    from cadgraph.labelers.lvlm.batch import read_results
    from cadgraph.labelers.lvlm.cache import Cache

    cache = Cache(":memory:")
    try:
        return read_results(file, cache, "a model")
    finally:
        cache.close()


def _proposals(file: Path, _: Path) -> Any:
    from cadgraph.labelers.lvlm.merging import read_wishes

    return read_wishes(file)


def _config(file: Path, _: Path) -> Any:
    from cadgraph.config import read_config

    return read_config(file)


def _scenario(file: Path, seeds: Path) -> Any:
    from cadgraph.hydraulics.scenario_file import read_scenario, scenario_text
    from cadgraph.model.graph import SceneGraph

    return scenario_text(read_scenario(file, SceneGraph.load(seeds / "graph.json")))


def _round(file: Path, _: Path) -> Any:
    from cadgraph.plans.written import read_written

    return read_written(file.read_text(encoding="utf-8", errors="replace"), str(file))


def _mapping(file: Path, _: Path) -> Any:
    from cadgraph.query.compare import read_mapping

    return read_mapping(file.read_text(encoding="utf-8", errors="replace"), str(file))


_EVERY = (
    *(
        Kind(name, suffix, layout, _scene, scene=True)
        for name, suffix, layout in (
            ("usda", ".usda", "text"), ("usdc", ".usdc", "crate"), ("usdz", ".usdz", "zip"), ("step", ".step", "text"),
            ("ifc", ".ifc", "text"), ("rvm", ".rvm", "bytes"), ("rvm-text", ".rvm", "text"), ("gltf", ".gltf", "json"),
            ("glb", ".glb", "glb"), ("obj", ".obj", "text"), ("stl", ".stl", "text"), ("stl-binary", ".stl", "bytes"),
            ("ply", ".ply", "text"), ("ply-binary", ".ply", "bytes"), ("3mf", ".3mf", "zip"), ("dae", ".dae", "text"),
        )
    ),
    Kind("mtl", ".mtl", "text", _scene, scene=True, whole=(".obj", "obj")),
    Kind("att", ".att", "text", _scene, scene=True, whole=(".rvm", "rvm-text")),
    Kind("graph", ".json", "json", _graph),
    Kind("truth", ".json", "json", _truth),
    Kind("corrections", ".json", "json", _corrections),
    Kind("labels", ".json", "json", _labels),
    Kind("labels-csv", ".csv", "text", _labels),
    Kind("catalogue", ".cadgraph-catalog", "arrays", _catalogue),
    Kind("vocabulary", ".yaml", "text", _vocabulary),
    Kind("dexpi", ".xml", "text", _dexpi),
    Kind("answer", ".json", "json", _answer, named=False),
    Kind("index", ".json", "json", _index),
    Kind("batch", ".jsonl", "text", _batch),
    Kind("proposals", ".json", "json", _proposals),
    Kind("config", ".toml", "text", _config, values=True),
    Kind("scenario", ".yaml", "text", _scenario),
    Kind("round", ".json", "json", _round),
    Kind("mapping", ".csv", "text", _mapping, values=True),
)  # fmt: skip

KINDS = {kind.name: kind for kind in _EVERY}
"""By name."""
