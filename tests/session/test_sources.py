"""Corrections, catalogues and the USD layer over scenes of formats that state less than USD does."""

import struct
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom

import knobs
import shapes
from cadgraph.config import Config
from cadgraph.errors import LoadError
from cadgraph.export.usd_labels import CLASS
from cadgraph.model.catalog import rows_of
from cadgraph.model.graph import SceneGraph
from cadgraph.session.catalog_builder import EMPTY, take_graph
from cadgraph.session.correct import amend
from cadgraph.session.reopen import config_of, relabel
from cadgraph.session.run import run
from command_line import refused
from command_line import run as command
from load.gltf_files import GltfFile
from rvm_files import Rvm, cube, placed

NONE = Config().replace({"label.labeler": "none", "load.isolate": False})
LABEL = "Valve assembly/valve body"
MESHES = (knobs.knob(), shapes.moved(knobs.knob(), translation=(1, 0, 0)), shapes.box((0.3, 0.2, 0.1), (3, 0, 0)))


def authored(points, up, unit=1000.0):
    """Points in metres and Z up as a file with another unit and up axis has them."""
    return points @ (np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]) if up == "Y" else np.eye(3)) * unit


def obj(path):
    lines, first = [], 1
    for i, (points, faces) in enumerate(MESHES):
        lines.append(f"o knob {i}")
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in authored(points, "Y").tolist()]
        lines += [f"f {a} {b} {c}" for a, b, c in (faces + first).tolist()]
        first += len(points)
    path.write_text("\n".join(lines) + "\n")
    return {"load.unit": "mm", "load.up": "Y"}


def stl(path):
    """All in one bag."""
    corners = np.concatenate([authored(points, "Z")[faces] for points, faces in MESHES]).astype("<f4")
    records = [struct.pack("<3f", 0, 0, 0) + corner.tobytes() + b"\0\0" for corner in corners]
    path.write_bytes(bytes(80) + struct.pack("<I", len(records)) + b"".join(records))
    return {"load.unit": "mm", "load.up": "Z"}


def glb(path):
    file = GltfFile()
    for i, (points, faces) in enumerate(MESHES):
        file.node(name=f"knob {i}/a", mesh=file.mesh((authored(points, "Y", 1.0), faces)))
    file.glb(path)
    return {}


def rvm(path):
    file = Rvm().open("/SITE").open("/100-B-1/B1")
    for i, x in enumerate((0.0, 1.0)):
        file.open(f"VALVE {i + 1} of BRANCH /100-B-1/B1").primitive(8, 50.0, 60.0, matrix=placed((x, 0, 0)))
        file.primitive(8, 20.0, 40.0, matrix=placed((x, 0, 0.05))).close()
    file.open("/Box").primitive(11, cube((0, 0, 0), (300, 200, 100)), matrix=placed((3, 0, 0))).close()
    path.write_bytes(file.close(2).end().bytes)
    return {}


WRITERS = {"obj": obj, "stl": stl, "glb": glb, "rvm": rvm}


@pytest.fixture(params=WRITERS)
def built(request, tmp_path):
    """A folder of results, and the settings that its scene was read with."""
    source = tmp_path / f"plant.{request.param}"
    changes = WRITERS[request.param](source)
    run(source, tmp_path / "out", NONE.replace(changes), report=False)
    return tmp_path / "out", changes


def boxes(folder):
    return {part.meshes[0]: part.aabb for part in SceneGraph.load(folder).parts()}


def labels_in_usd(folder):
    """The class of each prim that carries a source path in its custom data."""
    stage = Usd.Stage.Open(str(folder / "semantics.usda"))
    assert stage.GetCompositionErrors() == []
    found = {}
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        path = (prim.GetCustomDataByKey("cadgraph") or {}).get("path")
        if path is not None:
            assert prim.IsA(UsdGeom.Mesh)
            labels = prim.GetAttribute(f"semantics:labels:{CLASS}").Get()
            found[path] = labels[0] if labels else None
    return found


def test_a_correction_holds_in_the_graph_in_usd_and_in_later_builds(built):
    folder, changes = built
    before = boxes(folder)
    assert len(before) == 3
    knob = min(before, key=lambda mesh: before[mesh][0][0])
    amendment = amend(folder, knob, LABEL, report=False)
    assert amendment.outcome.graph.part(knob).label.source == "human"
    assert boxes(folder) == before
    graph = SceneGraph.load(folder)
    labelled = {mesh for part in graph.parts() if part.label is not None for mesh in part.meshes}
    assert knob in labelled
    assert len(labelled) == 2
    assert {path for path, label in labels_in_usd(folder).items() if label == "valve body"} == labelled
    before_anew = graph.to_json()
    run(graph.source.path, folder, NONE.replace(changes), report=False)
    assert SceneGraph.load(folder).to_json() == before_anew
    relabel(folder, config_of(folder), None, report=False)
    assert SceneGraph.load(folder).to_json() == before_anew


def test_a_catalogue_takes_shapes_as_large_as_they_are(built):
    folder, _ = built
    before = boxes(folder)
    knob = min(before, key=lambda mesh: before[mesh][0][0])
    amend(folder, knob, LABEL, report=False)
    intake = take_graph(EMPTY, folder)
    (row,) = rows_of(intake.catalog)
    assert max(row["size"]) == pytest.approx(0.1, rel=0.05)


def test_a_source_that_changed_is_refused(built):
    folder, _ = built
    source = Path(SceneGraph.load(folder).source.path)
    source.write_bytes(source.read_bytes() + b"\n")
    mesh = next(iter(boxes(folder)))
    with pytest.raises(LoadError, match="changed since the graph was built"):
        amend(folder, mesh, LABEL, report=False)


def test_unit_and_up_can_be_said_wherever_a_file_is_read(tmp_path, capsys):
    source = tmp_path / "small.obj"
    source.write_text("o valve\nv 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    catalog = ("catalog", "add", source, "--as", LABEL, "--catalog", tmp_path / "c")
    assert "say it with --unit mm" in refused(capsys, *catalog)
    assert command(capsys, *catalog, "--unit", "mm", "--up", "z")[0] == 0
    assert "100 x" in command(capsys, "catalog", "list", tmp_path / "c")[1]
    assert "say it with --unit mm" in refused(capsys, "facts", source)
    assert "valve -> " in command(capsys, "facts", source, "--unit", "mm")[1]
    run(source, tmp_path / "out", NONE.replace({"load.unit": "mm"}), report=False)
    line = refused(capsys, "catalog", "add", tmp_path / "out", "--catalog", tmp_path / "c", "--unit", "mm")
    assert "for CAD files" in line
