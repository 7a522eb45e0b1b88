"""Small sound files of each kind: a plant of six parts in every format that plants are written in, its graph and what
goes with it, and pages by hand.
"""

from __future__ import annotations

import io
import json
import struct
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from cadlab.fuzz.texts import TEXTS
from cadplants import Plant, UsdStyle, truth_path, write_plant
from cadplants.model.plant import Component, Connection, Line, Point, Unit
from cadplants.solids.mesh_ops import tube
from cadplants.solids.primitives import along, cylinder, ring
from cadplants.solids.transforms import arc, at

__all__ = ["write_seeds"]

_SIDES = 6
_OLDEST = (1980, 1, 1, 0, 0, 0)
_RVM_TEXT = """HEAD
     1     2
program
note
date
user
Unicode UTF-8
MODL
     1     1
project
/model
CNTB
     1     2
/ZONE
          0.00          0.00          0.00
     1
CNTB
     1     2
/PIPE
          0.00          0.00          0.00
     2
PRIM
     1     1
     8
     0.0010000     0.0000000     0.0000000     1.0000000
     0.0000000     0.0010000     0.0000000     0.0000000
     0.0000000     0.0000000     0.0010000     0.0000000
  0.0 0.0 0.0
  0.0 0.0 0.0
30 500
PRIM
     1     1
     2
     0.0010000     0.0000000     0.0000000     2.0000000
     0.0000000     0.0010000     0.0000000     0.0000000
     0.0000000     0.0000000     0.0010000     0.0000000
  0.0 0.0 0.0
  0.0 0.0 0.0
100 200 300
PRIM
     1     1
     7
     0.0010000     0.0000000     0.0000000     3.0000000
     0.0000000     0.0010000     0.0000000     0.0000000
     0.0000000     0.0000000     0.0010000     0.0000000
  0.0 0.0 0.0
  0.0 0.0 0.0
100 50 200 10 10 0
0 0 0
CNTE
     1     2
CNTE
     1     2
END:
     1     1
"""
_ATTRIBUTES = """CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&
NEW Header Information
Project:= P1&end& Note:= x
END
NEW /ZONE
TYPE:= ZONE
NEW /PIPE
TYPE:= VALV &end& BORE:= 80mm
DESC:= gate valve
END
END
"""


def write_seeds(folder: Path) -> None:
    """Writes the sound files into ``folder/KIND/N.SUFFIX``; none of a kind whose package is missing."""
    from cadgraph.errors import MissingExtra

    for kind, texts in TEXTS.items():
        for text in texts:
            _put(folder, kind, _WRAP.get(kind, str.encode)(text))
    plant = _plant()
    for kind, suffix, style in (
        ("usdc", ".usdc", UsdStyle(instances="point")),
        ("usdc", ".usdc", UsdStyle(up_axis="Y", instances="nested", skewed=True)),
        ("ifc", ".ifc", None), ("step", ".step", None), ("rvm", ".rvm", None), ("glb", ".glb", None),
        ("obj", ".obj", None), ("stl-binary", ".stl", None),
        # The last one's truth is what stays beside it.
        ("usda", ".usda", UsdStyle(instances="native", polygons=1.0)),
    ):  # fmt: skip
        target = folder / f"plant{suffix}"
        try:
            write_plant(_without_lines(plant) if kind == "step" else plant, target, style)
        except MissingExtra:
            continue
        _put(folder, kind, target.read_bytes())
    _put(folder, "truth", truth_path(folder / "plant.usda").read_bytes())
    _put(folder, "rvm-text", _RVM_TEXT.encode())
    _put(folder, "att", _ATTRIBUTES.encode())
    _put(folder, "gltf", _embedded((folder / "plant.glb").read_bytes()))
    _put(folder, "ply-binary", _binary_ply())
    _usd(folder)
    _documents(folder)


def _put(folder: Path, kind: str, content: bytes) -> None:
    own = folder / kind
    own.mkdir(parents=True, exist_ok=True)
    (own / f"{len(list(own.iterdir()))}.seed").write_bytes(content)


def _plant() -> Plant:
    """A tank, a pipe, a valve of two meshes, a pipe round a bend."""
    pipes: dict[str, Any] = {"group": "Pipe assembly", "line": "L1", "cluster": "all"}
    valve: dict[str, Any] = {"group": "Valve assembly", "unit": "V-1", "line": "L1", "family": "gate valve"}
    steel, blue = (0.5, 0.5, 0.55), (0.1, 0.2, 0.6)
    body = along("x", cylinder(0.06, 0.0, 0.2, _SIDES))
    run = along("x", ring(0.024, 0.03, 0.0, 0.5, _SIDES))
    bend = tube(arc((0, 0, 0), (0.12, 0, 0), (0.12, 0.12, 0), 3), 0.03, 0.0, _SIDES)
    components = (
        Component(cylinder(0.4, 0.0, 1.0, _SIDES), name="shell", color=blue, pose=at(-0.4), group="Tank", unit="T-1"),
        Component(run, name="pipe", color=steel, pose=at(0, 0, 0.5), **pipes),
        Component(body, name="valve body", color=blue, pose=at(0.5, 0, 0.5), **valve),
        Component(ring(0.04, 0.05, 0.0, 0.01, _SIDES), name="handwheel", color=blue, pose=at(0.6, 0, 0.56), **valve),
        Component(run, name="pipe", color=steel, pose=at(0.7, 0, 0.5), **pipes),
        Component(bend, name="elbow", color=steel, pose=at(1.2, 0, 0.5), **pipes),
    )
    way = np.array([[0.0, 0, 0.5], [1.2, 0, 0.5], [1.32, 0.12, 0.5]])
    return Plant(
        components,
        contacts=((0, 1), (1, 2), (2, 3), (2, 4), (4, 5)),
        units=(Unit("V-1", "valve", "gate valve"), Unit("T-1", "tank", "storage tank")),
        points=(Point("L1/end", "terminal", (1.32, 0.12, 0.5), "open"),),
        connections=(
            Connection("T-1", "V-1", "L1", 0.6, 0.05, "forward", "a pump"),
            Connection("V-1", "L1/end", "L1", 0.8, 0.05, "forward", "a pump"),
        ),
        lines=(Line("L1", way, 0.06),),
        name="small",
        styles=("plant-design",),
    )


def _without_lines(plant: Plant) -> Plant:
    """The valve alone: a STEP file takes 7 kB for each part, and most of a second to read."""
    return replace(plant, components=plant.components[2:4], contacts=(), units=(), points=(), connections=(), lines=())


def _usd(folder: Path) -> None:
    """The page of features as a crate, and packages of both."""
    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(TEXTS["usda"][0])
    crate = folder / "features.usdc"
    layer.Export(str(crate))
    _put(folder, "usdc", crate.read_bytes())
    for name, content in (("a.usdc", crate.read_bytes()), ("a.usda", TEXTS["usda"][0].encode())):
        package = folder / "package.usdz"
        (folder / name).write_bytes(content)
        with Sdf.ZipFileWriter.CreateNew(str(package)) as writer:
            writer.AddFile(str(folder / name), name)
        _put(folder, "usdz", package.read_bytes())


def _documents(folder: Path) -> None:
    """The graph of the plant, and what is said of it in files."""
    import cadgraph
    from cadgraph.config import Config, LoadConfig
    from cadgraph.export.dexpi import write_dexpi
    from cadgraph.hydraulics.scenario import guess_scenario
    from cadgraph.hydraulics.scenario_file import scenario_text
    from cadgraph.model.catalog import Catalog, Entry, write_catalog
    from cadgraph.model.given_labels import GivenLabel
    from cadgraph.model.truth import Truth

    scene = cadgraph.load(folder / "plant.usda", LoadConfig(isolate=False))
    truth = Truth.load(truth_path(folder / "plant.usda"))
    given = [GivenLabel(row.mesh, str(row.group), row.name) for row in truth.meshes]
    graph = cadgraph.build(scene, Config(), labels=given)
    text = json.dumps(graph.to_json()).replace(str(folder), "")
    _put(folder, "graph", text.encode())
    _put(folder, "labels", json.dumps([{"mesh": g.mesh, "group": g.group, "name": g.name} for g in given]).encode())
    _put(folder, "dexpi", write_dexpi(graph, folder / "plant.xml").read_bytes())
    _put(folder, "scenario", scenario_text(guess_scenario(graph)).encode())
    _put(folder, "corrections", _corrections(folder))
    entries = [Entry("", g.group, g.name, "plant.usda", g.mesh) for g in given]
    catalog = write_catalog(Catalog.of(scene, entries), folder / "parts.cadgraph-catalog")
    _put(folder, "catalogue", catalog.read_bytes())
    (folder / "graph.json").write_text(text, encoding="utf-8")


def _corrections(folder: Path) -> bytes:
    """A correction of every kind, one of them undone."""
    from cadgraph.model.anchors import Anchor, Fingerprint
    from cadgraph.model.corrections import Correction, History, write_history
    from cadgraph.model.edits import Cut, Direction, Ground, Join, Merge, Split, Tag

    shape = Fingerprint(12, (1.0, 0.5, 0.4, 0.3))
    a, b, c = (Anchor(path, shape, (1.0, 2.0, 3.0)) for path in ("/a", "/b", "/c"))
    edits = (
        Correction("/a", "Tank", "tank", shape, (1.0, 2.0, 3.0)), Merge((a, b)), Split((a,)), Join(a, b), Cut(b, c),
        Direction((a,), (b,), (c,), ((0.0, 0.0, 0.0), (1.0, 2.0, 3.0)), "backward"), Tag((a, b), "V-4711"),
        Ground(a, True),
    )  # fmt: skip
    history = (
        History().do(edits, "all", when="2026-01-02T03:04:05Z", who="Ann", why="seen").do((Tag((c,), "P-1"),), "tag")
    )
    return write_history(history.undo(who="Bob"), folder / "corrections.json").read_bytes()


def _embedded(glb: bytes) -> bytes:
    """A glTF file with its buffer in it."""
    import base64

    length = int.from_bytes(glb[12:16], "little")
    tree = json.loads(glb[20 : 20 + length])
    data = base64.b64encode(glb[28 + length :]).decode()
    tree["buffers"][0]["uri"] = f"data:application/octet-stream;base64,{data}"
    return json.dumps(tree).encode()


def _binary_ply() -> bytes:
    head = TEXTS["ply"][0].partition("end_header\n")[0].replace("ascii", "binary_little_endian") + "end_header\n"
    rows = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    points = b"".join(struct.pack("<3f3B", *row, 255, 0, 0) for row in rows)
    faces = b"".join(struct.pack("<B3i", 3, *row) for row in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)))
    return head.encode() + points + faces


def _3mf(text: str) -> bytes:
    target = io.BytesIO()
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(zipfile.ZipInfo("3D/3dmodel.model", _OLDEST), text)
        archive.writestr(
            zipfile.ZipInfo("_rels/.rels", _OLDEST),
            '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="r" '
            'Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>',
        )
    return target.getvalue()


_WRAP: dict[str, Callable[[str], bytes]] = {"3mf": _3mf}
