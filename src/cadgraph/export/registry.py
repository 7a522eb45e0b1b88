"""The formats that a graph can be exported to, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Literal

from cadgraph._io.run_folder import coming_into
from cadgraph.errors import LoadError
from cadgraph.export.att import write_att
from cadgraph.export.graphml import write_graphml
from cadgraph.export.labels import write_labels
from cadgraph.export.nodelink import write_nodelink
from cadgraph.export.source import refuse_source, scene_of
from cadgraph.export.tables import write_tables
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.source_file import find_source

__all__ = ["Format", "Written", "export_graph", "formats", "write_export"]


@dataclass(frozen=True)
class Written:
    """What an export wrote.

    Args:
        files: all of them.
        notes: what of the graph could not be written, or was guessed.
    """

    files: tuple[Path, ...]
    notes: tuple[Diagnostic, ...] = ()


Write = Callable[[SceneGraph, Path, Path | None], Written]


@dataclass(frozen=True)
class Format:
    """One format.

    Args:
        name: as a user asks for it (``"graphml"``).
        meaning: what it is good for, one line.
        write: takes the graph, the place to write to, and the file that the graph was made from or None, and says what
            it wrote.
        source: whether that file is ``"needed"``, or only ``"helps"`` where it is still there; ``"no"`` is never given.
        file: the name of its file where a folder is given; None if it always takes a folder.
        also: further suffixes that its file may have.
        copied_as: how the copy of a source, or what stands beside it, ends, by how the source ends; empty where any
            source will do.
    """

    name: str
    meaning: str
    write: Write
    source: Literal["no", "helps", "needed"] = "no"
    file: str | None = None
    also: tuple[str, ...] = ()
    copied_as: Mapping[str, str] = field(default_factory=dict)


def _write_att(graph: SceneGraph, path: Path, source: Path | None) -> Written:
    if source is None:
        file, notes = write_att(graph, path)
        return Written((file,), notes)
    refuse_source(source, path)
    from cadgraph.load.rvm import element_names

    file, notes = write_att(graph, path, element_names(source))
    return Written((file,), notes)


def _write_dexpi(graph: SceneGraph, path: Path, _: Path | None) -> Written:
    # It places what it writes by the layout library, which the other formats do without.
    from cadgraph.export.dexpi import write_dexpi

    return Written((write_dexpi(graph, path),))


def _write_labels(graph: SceneGraph, path: Path, _: Path | None) -> Written:
    file, notes = write_labels(graph, path)
    return Written((file,), notes)


def _write_gltf(graph: SceneGraph, path: Path, source: Path | None) -> Written:
    from cadgraph.export.gltf import write_gltf

    assert source is not None  # it is needed
    file, notes = write_gltf(graph, source, path)
    return Written((file,), notes)


def _write_html(graph: SceneGraph, path: Path, source: Path | None) -> Written:
    from cadgraph.export.html import write_html

    assert source is not None  # it is needed
    file, notes = write_html(graph, source, path)
    return Written((file,), notes)


def _write_ifc(graph: SceneGraph, path: Path, source: Path | None) -> Written:
    from cadgraph.export.ifc import write_ifc

    assert source is not None  # it is needed
    return Written((write_ifc(graph, source, path),))


def _write_pcf(graph: SceneGraph, path: Path, _: Path | None) -> Written:
    from cadgraph.export.pcf import write_pcf

    return Written(*write_pcf(graph, path))


def _write_epanet(graph: SceneGraph, path: Path, _: Path | None, scenario: Path | None = None) -> Written:
    from cadgraph.export.epanet import write_epanet

    file, notes = write_epanet(graph, path, scenario)
    return Written((file,), notes)


def _write_usd(graph: SceneGraph, path: Path, source: Path | None) -> Written:
    from cadgraph.export.usd import write_semantics
    from cadgraph.export.usd_paths import check_source

    assert source is not None  # it is needed
    check_source(source, path)
    return Written((write_semantics(scene_of(graph, source), graph, source, path),))


def _write_baked(graph: SceneGraph, path: Path, source: Path | None, open_instances: bool = False) -> Written:
    from cadgraph.export.baked_usd import write_baked

    assert source is not None  # it is needed
    file, notes = write_baked(scene_of(graph, source), graph, source, path, open_instances=open_instances)
    return Written((file,), notes)


def _write_mjcf(graph: SceneGraph, path: Path, source: Path | None) -> Written:
    from cadgraph.simulate.mjcf import write_mjcf

    assert source is not None  # it is needed
    return Written(*write_mjcf(graph, scene_of(graph, source), path))


def _write_isometrics(graph: SceneGraph, path: Path, _: Path | None) -> Written:
    from cadgraph.draw.isometric import write_isometrics

    return Written(*write_isometrics(graph, path))


_FORMATS = (
    Format(
        "att",
        "labels as PDMS attributes, beside an RVM file",
        _write_att,
        source="helps",
        file="labels.att",
        copied_as={".rvm": ".att", ".rev": ".att"},
    ),
    Format(
        "csv",
        "tables of parts, units, relations, clusters, contacts and meshes, for Excel",
        lambda graph, path, _: Written(tuple(write_tables(graph, path))),
    ),
    Format(
        "dexpi",
        "tanks, pumps, lines, valves and instruments as Proteus XML in DEXPI 1.3 terms, for P&ID tools",
        _write_dexpi,
        file="dexpi.xml",
    ),
    Format(
        "epanet",
        "the network of pipes as it is simulated, for EPANET; by scenario.yaml where there is one",
        _write_epanet,
        file="plant.inp",
    ),
    Format(
        "gltf",
        "a copy of a glTF source with the labels in the extras of its nodes",
        _write_gltf,
        source="needed",
        file="labelled.glb",
        copied_as={".glb": ".glb", ".gltf": ".gltf"},
    ),
    Format(
        "graphml",
        "the whole graph, for yEd, Gephi, Cytoscape",
        lambda graph, path, _: Written((write_graphml(graph, path),)),
        file="graph.graphml",
    ),
    Format(
        "html",
        "the plant and its network as one page to look at in a browser, from disk",
        _write_html,
        source="needed",
        file="viewer.html",
    ),
    Format(
        "ifc",
        "a copy of an IFC source with the labels as a property set of its products",
        _write_ifc,
        source="needed",
        file="labelled.ifc",
        copied_as={".ifc": ".ifc", ".ifczip": ".ifc"},
    ),
    Format(
        "isometric",
        "each line as an isometric drawing, SVG",
        _write_isometrics,
    ),
    Format(
        "json",
        "the whole graph as one JSON file in cadgraph's own format, however large",
        lambda graph, path, _: Written((graph.save(path),)),
        file="whole_graph.json",
    ),
    Format("labels-csv", "labels by source path, for 'cadgraph build --labels'", _write_labels, file="labels.csv"),
    Format(
        "mjcf",
        "wheels, levers and needles as a MuJoCo model with joints called after the tags",
        _write_mjcf,
        source="needed",
        file="mjcf/plant.xml",
    ),
    Format(
        "networkx-json",
        "nodes and edges alone, for networkx.node_link_graph and d3",
        lambda graph, path, _: Written((write_nodelink(graph, path),)),
        file="nodelink.json",
    ),
    Format("pcf", "each line as an Isogen piping component file", _write_pcf),
    Format(
        "shards",
        "cadgraph's own format as for large plants, however small: graph.json becomes an index of shards",
        lambda graph, path, _: Written((graph.save(path, shard_above=0),)),
    ),
    Format(
        "usd",
        "the labels as a USD layer over the source; with --bake the source and its labels as one stage",
        _write_usd,
        source="needed",
        file="semantics.usda",
    ),
)

_BAKED = Format(
    "usd",
    "the source and its labels as one stage",
    _write_baked,
    source="needed",
    file="baked.usdc",
    also=(".usda", ".usd"),
)
# What ends so is meant to be a file, whatever format was asked for.
_OTHER_FILES = {Path(each.file).suffix for each in _FORMATS if each.file} | {
    *(".usd", ".usdc", ".usdz", ".gltf", ".glb", ".ifc", ".htm", ".pcf", ".csv", ".svg", ".png", ".zip", ".parquet")
}
_OPENED = replace(_BAKED, write=partial(_write_baked, open_instances=True))


def formats() -> dict[str, str]:
    """The names of all formats with their meaning, in alphabetical order."""
    return {each.name: each.meaning for each in _FORMATS}


def export_graph(graph: SceneGraph, to: str, path: str | Path, source: str | Path | None = None) -> list[Path]:
    """Writes a graph in another format; :func:`write_export` tells what could not be written, too.

    Args, errors as there.

    Returns:
        The files written.
    """
    return list(write_export(graph, to, path, source).files)


def write_export(
    graph: SceneGraph,
    to: str,
    path: str | Path,
    source: str | Path | None = None,
    *,
    bake: bool = False,
    open_instances: bool = False,
    scenario: str | Path | None = None,
    folder: Path | None = None,
) -> Written:
    """Writes a graph in another format; several files come into their folder together.

    Args:
        graph: what to write.
        to: the format's name, one of :func:`formats`.
        path: the folder that gets the files, made if missing; or the file, if it ends as the format's files do
            (``plant.graphml``).
        source: where the file is that the graph was made from, for formats that are a copy of it or stand beside it;
            None: where it was.
        bake: of ``usd``: whether to write the source and its labels as one stage, instead of a layer over the source.
        open_instances: of a baked stage: whether to open all native instances, for renderers that skip them.
        scenario: of ``epanet``: the file that says what is supposed; None: ``scenario.yaml`` beside the file that is
            written where there is one.
        folder: that the graph was loaded from, beside which its source is looked for, too.

    Returns:
        The files written, and what is to be said of them.

    Raises:
        ValueError: no format has that name, a file is given for a format of several files, or a source for a format
            that needs none.
        LoadError: the source is missing, is another one than the graph was made from, or one of another format.
        MissingExtra: the format needs a package that isn't installed.
        ScenarioError: the scenario can't be used.
        OutputError: a file can't be written, or another process is at work in the folder.
    """
    form = next((each for each in _FORMATS if each.name == to), None)
    if form is None:
        raise ValueError(f"no export format is called {to!r}; there are {', '.join(formats())}")
    if bake and to != "usd":
        raise ValueError(f"--bake is for USD; leave it out, or say --to usd instead of {to}")
    if open_instances and not bake:
        raise ValueError("--open-instances goes with --bake, as the source stays as it is otherwise")
    if scenario is not None and to != "epanet":
        raise ValueError(f"--scenario is for epanet; leave it out with {to}")
    form = (_OPENED if open_instances else _BAKED) if bake else form
    if scenario is not None:
        form = replace(form, write=partial(_write_epanet, scenario=Path(scenario)))
    target = Path(path)
    if form.source == "no":
        if source is not None:
            raise ValueError(f"{form.name} is written from the graph alone; leave --source out")
        return _written(form, graph, target, None)
    if form.source == "needed":
        origin = find_source(graph.source, folder, source)
        _check_kind(form, origin, "a copy of")
        return _written(form, graph, target, origin)
    there, missing = _source_if_there(form, graph, folder, source)
    written = _written(form, graph, target, there)
    if there is not None:
        return written
    notes = tuple(Diagnostic(note.code, f"{note.message}: {missing}", note.meshes) for note in written.notes)
    return Written(written.files, notes)


def _written(form: Format, graph: SceneGraph, path: Path, source: Path | None) -> Written:
    """Writes a graph, all files or none."""
    place = _place(form, path, source)
    # A format that places its files below the folder belongs to that folder all the same.
    folder = path.parent if place == path and form.file is not None else path
    with coming_into(folder, graph.digest):
        return form.write(graph, place, source)


def _source_if_there(
    form: Format, graph: SceneGraph, folder: Path | None, given: str | Path | None
) -> tuple[Path | None, str]:
    """The source of a graph where it is there and of the right kind, else why not; a given one has to be."""
    if given is not None:
        origin = find_source(graph.source, folder, given)
        _check_kind(form, origin, "written for")
        return origin, ""
    if Path(graph.source.path).suffix.lower() not in form.copied_as:
        return None, f"the graph was made from no {' or '.join(form.copied_as)} file"
    try:
        return find_source(graph.source, folder), ""
    except LoadError as error:
        return None, str(error)


def _check_kind(form: Format, source: Path, what: str) -> None:
    if form.copied_as and source.suffix.lower() not in form.copied_as:
        raise LoadError(
            f"{source}: {form.name} is {what} a {' or '.join(form.copied_as)} file, which this is not; "
            "'labels-csv' writes the labels by path"
        )


def _place(form: Format, path: Path, source: Path | None) -> Path:
    if form.file is None:
        if path.suffix.lower() == f".{form.name}" and not path.is_dir():
            raise ValueError(f"{path}: {form.name} is written as several files; give a folder")
        return path
    file = Path(form.file)
    if source is not None and form.copied_as:
        file = file.with_suffix(form.copied_as[source.suffix.lower()])
    endings = (file.suffix, *form.also)
    if path.is_dir() or path.suffix.lower() not in (*endings, *_OTHER_FILES):
        # A folder that is called as the format's own holds the files itself, not another folder of that name.
        return path / (file.name if path.name == file.parent.name else file)
    if path.suffix.lower() not in endings:
        raise ValueError(f"{path}: {form.name} is written as {' or '.join(endings)}; give such a file, or a folder")
    return path
