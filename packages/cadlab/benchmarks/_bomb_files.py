"""Small files that grow: each function writes one, or a few that belong together, into a folder."""

from __future__ import annotations

import json
import struct
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from pxr import Usd, UsdGeom, Vt

__all__ = ["BOMBS", "PLAIN", "plain_scene"]

PLAIN = "plain.usda"
_HEAD = '#usda 1.0\n(\n defaultPrim = "L0"\n metersPerUnit = 1\n upAxis = "Z"\n)\n'
_CUBE = 'def Cube "{}" {{\n}}\n'
_ITEMS = 100_000_000
_XML_ENTITIES = "<!DOCTYPE x [<!ENTITY a0 'ha'>" + "".join(
    f"<!ENTITY a{i} '{f'&a{i - 1};' * 10}'>" for i in range(1, 12)
) + "]>"  # fmt: skip
_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_HUGE = 3 << 30  # bytes of files that hold nothing; they take no room on a disk that knows holes


def plain_scene(folder: Path) -> Path:
    """One cube, which is no bomb."""
    return _text(folder, PLAIN, _HEAD + _CUBE.format("L0"))


def _text(folder: Path, name: str, content: str) -> Path:
    path = folder / name
    path.write_text(content, encoding="utf-8")
    return path


def _tree(folder: Path, name: str, levels: int, wide: int, arc: str) -> Path:
    """Each of some levels holds the next several times; ``arc`` is what a prim says of it."""
    text = _HEAD
    for i in range(levels):
        below = "".join(f' def "c{j}" (\n {arc.format(i + 1)}\n ) {{\n }}\n' for j in range(wide))
        text += f'def "L{i}" {{\n{below}}}\n'
    return _text(folder, name, text + _CUBE.format(f"L{levels}"))


def references(folder: Path) -> Path:
    """A hundred million cubes by nested references."""
    return _tree(folder, "references.usda", 8, 10, "references = </L{}>")


def references_of_a_million(folder: Path) -> Path:
    """A million cubes: no more than large plants have, but of 2 kB."""
    return _tree(folder, "million.usda", 6, 10, "references = </L{}>")


def payloads(folder: Path) -> Path:
    """The same by payloads."""
    return _tree(folder, "payloads.usda", 8, 10, "payload = </L{}>")


def inherits(folder: Path) -> Path:
    """The same by inherits."""
    return _tree(folder, "inherits.usda", 8, 10, "inherits = </L{}>")


def specializes(folder: Path) -> Path:
    """The same by specializes."""
    return _tree(folder, "specializes.usda", 8, 10, "specializes = </L{}>")


def instances(folder: Path) -> Path:
    """A hundred million cubes by nested native instances, of which each prim is composed once."""
    return _tree(folder, "instances.usda", 8, 10, "instanceable = true\n references = </L{}>")


def opened_instances(folder: Path) -> Path:
    """Native instances that prims above them open."""
    opened = "".join(f' over "c{j}" (\n instanceable = false\n ) {{\n }}\n' for j in range(10))
    text = _HEAD
    for i in range(8):
        below = "".join(
            f' def "c{j}" (\n instanceable = true\n references = </L{i + 1}>\n ) {{\n{opened}}}\n' for j in range(10)
        )
        text += f'def "L{i}" {{\n{below}}}\n'
    return _text(folder, "opened.usda", text + _CUBE.format("L8"))


def variants(folder: Path) -> Path:
    """References within variants."""
    text = _HEAD
    for i in range(8):
        below = "".join(f' def "c{j}" (\n references = </L{i + 1}>\n ) {{\n }}\n' for j in range(10))
        text += (
            f'def "L{i}" (\n variants = {{\n string v = "a"\n }}\n prepend variantSets = "v"\n ) {{\n'
            f' variantSet "v" = {{\n "a" {{\n{below}}}\n }}\n}}\n'
        )
    return _text(folder, "variants.usda", text + _CUBE.format("L8"))


def arcs_of_one_prim(folder: Path) -> Path:
    """One prim with a hundred million references, by lists of references to lists of references."""
    text = _HEAD + 'def "L0" (\n references = [</A0_0>]\n) {\n}\n'
    for i in range(8):
        listed = ", ".join(f"</A{i + 1}_{k}>" for k in range(10))
        text += "".join(f'def "A{i}_{j}" (\n references = [{listed}]\n) {{\n}}\n' for j in range(10))
    return _text(folder, "arcs.usda", text + "".join(_CUBE.format(f"A8_{j}") for j in range(10)))


def above_the_target(folder: Path) -> Path:
    """References to prims that only a reference of a prim above them brings."""
    text = _HEAD
    for i in range(8):
        below = "".join(f' def "c{j}" (\n references = </N{i + 1}/k>\n ) {{\n }}\n' for j in range(10))
        text += f'def "M{i}" {{\n def "k" {{\n{below}}}\n}}\ndef "N{i}" (\n references = </M{i}>\n) {{\n}}\n'
    text += 'def "L0" (\n references = </N0/k>\n) {\n}\ndef "N8" {\n ' + _CUBE.format("k") + "}\n"
    return _text(folder, "above.usda", text)


def circles(folder: Path) -> Path:
    """Prims that all refer to each other: the library follows every way through them."""
    n = 16
    text = _HEAD
    for i in range(n):
        others = "".join(f' def "c{j}" (\n references = </L{j}>\n ) {{\n }}\n' for j in range(n) if j != i)
        text += f'def "L{i}" {{\n{others}}}\n'
    return _text(folder, "circles.usda", text)


def files_of_files(folder: Path) -> Path:
    """Nested references over nine files."""
    for i in range(8):
        below = "".join(f' def "c{j}" (\n references = @./f{i + 1}.usda@\n ) {{\n }}\n' for j in range(10))
        _text(folder, f"f{i}.usda", _HEAD + f'def "L0" {{\n{below}}}\n')
    _text(folder, "f8.usda", _HEAD + _CUBE.format("L0"))
    return folder / "f0.usda"


def sublayers(folder: Path) -> Path:
    """Thirty levels of two layers each, all with both of the next level below them."""
    for i in range(30):
        for side in "ab":
            _text(
                folder, f"s{i}{side}.usda", f"#usda 1.0\n(\n subLayers = [@./s{i + 1}a.usda@, @./s{i + 1}b.usda@]\n)\n"
            )
    for side in "ab":
        _text(folder, f"s30{side}.usda", _HEAD + _CUBE.format("L0"))
    return folder / "s0a.usda"


def instancers(folder: Path) -> Path:
    """A hundred million cubes by nested point instancers."""
    items, places = ", ".join("0" * 10), ", ".join(f"({i}, 0, 0)" for i in range(10))
    text = _HEAD
    for i in range(8):
        text += (
            f'def PointInstancer "L{i}" {{\n rel prototypes = </L{i + 1}>\n int[] protoIndices = [{items}]\n'
            f" point3f[] positions = [{places}]\n}}\n"
        )
    return _text(folder, "instancers.usda", text + _CUBE.format("L8"))


def packed_items(folder: Path) -> Path:
    """A point instancer of a hundred million items, packed to 100 kB."""
    path = folder / "items.usdc"
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.Cube.Define(stage, "/L0")
    instancer = UsdGeom.PointInstancer.Define(stage, "/items")
    instancer.CreatePrototypesRel().AddTarget("/L0")
    instancer.CreateProtoIndicesAttr(Vt.IntArray.FromNumpy(np.zeros(_ITEMS, np.int32)))
    instancer.CreatePositionsAttr([(0, 0, 0)])
    stage.Save()
    return path


def packed_faces(folder: Path) -> Path:
    """A mesh of a hundred million corners, packed to 260 kB."""
    path = folder / "faces.usdc"
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    mesh = UsdGeom.Mesh.Define(stage, "/L0")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    n = _ITEMS // 3
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(n, 3, np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.tile(np.arange(3, dtype=np.int32), n)))
    stage.Save()
    return path


def outside(folder: Path) -> Path:
    """A scene whose only content lies above its folder."""
    (folder / "in").mkdir()
    _text(folder, "beside.usda", _HEAD + _CUBE.format("L0"))
    return _text(folder / "in", "outside.usda", _HEAD + 'def "L0" (\n references = @../beside.usda@\n) {\n}\n')


def _glb(path: Path, tree: dict[str, object], data: bytes) -> Path:
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, **tree}).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    whole = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(whole)) + whole)
    return path


def _gltf_tree(**more: object) -> tuple[dict[str, object], bytes]:
    data = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
    tree: dict[str, object] = {
        "buffers": [{"byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"componentType": 5126, "count": 9_999_999, "type": "VEC3"},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    return {**tree, **more}, data


def gltf_instances(folder: Path) -> Path:
    """Ten million instances that no bytes stand for."""
    extension = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}
    return _glb(folder / "instances.glb", *_gltf_tree(nodes=[{"mesh": 0, "extensions": extension}]))


def gltf_primitives(folder: Path) -> Path:
    """Meshes of many primitives, all of the same ten million points that no bytes stand for."""
    meshes = [{"primitives": [{"attributes": {"POSITION": 1}}] * 100}] * 20
    nodes = [{"mesh": i} for i in range(20)]
    return _glb(folder / "primitives.glb", *_gltf_tree(meshes=meshes, nodes=nodes, scenes=[{"nodes": [*range(20)]}]))


def gltf_nodes(folder: Path) -> Path:
    """Nodes that hold the same nodes many times."""
    nodes: list[dict[str, object]] = [{"children": [i + 1] * 10} for i in range(8)]
    return _glb(folder / "nodes.glb", *_gltf_tree(nodes=[*nodes, {"mesh": 0}]))


def _3mf(path: Path, resources: str, before: str = "", last: int = 9) -> Path:
    text = (
        f'<?xml version="1.0"?>{before}<model unit="millimeter" xmlns="{_CORE}"><resources>{resources}</resources>'
        f'<build><item objectid="{last}"/></build></model>'
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        package.writestr("3D/3dmodel.model", text)
    return path


_3MF_MESH = (
    '<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>'
    '<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/>{}</triangles></mesh></object>'
)


def components(folder: Path) -> Path:
    """A hundred million objects by nested components."""
    levels = "".join(
        f'<object id="{i + 1}"><components>' + f'<component objectid="{i}"/>' * 10 + "</components></object>"
        for i in range(1, 9)
    )
    return _3mf(folder / "components.3mf", _3MF_MESH.format("") + levels)


def packed_triangles(folder: Path) -> Path:
    """900 MB of the same triangle, packed to 3 MB."""
    more = '<triangle v1="0" v2="1" v3="2"/>' * (900 * (1 << 20) // 32)
    return _3mf(folder / "packed.3mf", _3MF_MESH.format(more), last=1)


def entities_3mf(folder: Path) -> Path:
    """An XML text that says the same thing a hundred thousand million times."""
    return _3mf(folder / "entities.3mf", "<metadata>&a11;</metadata>", _XML_ENTITIES)


def collada_nodes(folder: Path) -> Path:
    """A hundred million nodes by nested instances of nodes."""
    nodes = '<node id="n0"><instance_geometry url="#g"/></node>' + "".join(
        f'<node id="n{i}">' + f'<instance_node url="#n{i - 1}"/>' * 10 + "</node>" for i in range(1, 9)
    )
    return _dae(folder / "nodes.dae", nodes)


def entities_collada(folder: Path) -> Path:
    """COLLADA with the same entities."""
    return _dae(
        folder / "entities.dae", '<node id="n0" name="&a11;"><instance_geometry url="#g"/></node>', _XML_ENTITIES
    )


def _dae(path: Path, nodes: str, before: str = "") -> Path:
    path.write_text(
        f"""<?xml version="1.0"?>{before}
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01</created><modified>2020-01-01</modified><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>""",
        encoding="utf-8",
    )
    return path


def step_assembly(folder: Path) -> Path:
    """A hundred million occurrences by nested assemblies."""
    from _bomb_step import nested_assembly

    return _text(folder, "assembly.step", nested_assembly(8, 10))


def packed_ifc(folder: Path) -> Path:
    """3 GB of spaces after the head of an IFC file, packed to 3 MB."""
    path = folder / "packed.ifczip"
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package,
        package.open("a.ifc", "w", force_zip64=True) as file,
    ):
        file.write(b"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n")
        for _ in range(_HUGE >> 20):
            file.write(b" " * (1 << 20))
    return path


def _empty(folder: Path, name: str) -> Path:
    with (folder / name).open("wb") as file:
        file.truncate(_HUGE)
    return folder / name


def stl_of_nothing(folder: Path) -> Path:
    """An STL file that promises four thousand million triangles."""
    path = folder / "promise.stl"
    path.write_bytes(b"\0" * 80 + b"\xff\xff\xff\xff" + b"\0" * 100)
    return path


def huge_labels(folder: Path) -> Path:
    """Labels of 3 GB."""
    return _empty(folder, "labels.json")


def huge_vocabulary(folder: Path) -> Path:
    """A label tree of 3 GB."""
    return _empty(folder, "vocabulary.yaml")


def nested_vocabulary(folder: Path) -> Path:
    """A label tree whose aliases name each other ten times each."""
    lines = ["a0: &a0 [pipe, pipe]"] + [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 10)]
    return _text(folder, "aliases.yaml", "\n".join([*lines, "groups: *a9", ""]))


def huge_graph(folder: Path) -> Path:
    """A graph.json of 3 GB."""
    return _empty(folder, "graph.json")


def nested_graph(folder: Path) -> Path:
    """A graph.json of brackets alone."""
    return _text(folder, "graph.json", "[" * 1_000_000)


def huge_plan(folder: Path) -> Path:
    """A Proteus XML file of 3 GB."""
    return _empty(folder, "plan.xml")


def plan_of_entities(folder: Path) -> Path:
    """A Proteus XML file of entities."""
    return _text(folder, "plan.xml", f'<?xml version="1.0"?>{_XML_ENTITIES}<PlantModel>&a11;</PlantModel>')


BOMBS: dict[str, tuple[Callable[[Path], Path], tuple[str, ...]]] = {
    **{
        make.__name__.replace("_", " "): (make, ("build", "{bomb}", "-o", "{out}"))
        for make in (
            references, references_of_a_million, payloads, inherits, specializes, instances, opened_instances, variants,
            arcs_of_one_prim, above_the_target, circles, files_of_files, sublayers, instancers, packed_items,
            packed_faces, outside, gltf_instances, gltf_primitives, gltf_nodes, components, packed_triangles,
            entities_3mf, collada_nodes, entities_collada, step_assembly, packed_ifc, stl_of_nothing,
        )
    },
    "huge labels": (huge_labels, ("build", "{plain}", "-o", "{out}", "--labels", "{bomb}")),
    "huge vocabulary": (huge_vocabulary, ("build", "{plain}", "-o", "{out}", "--vocabulary", "{bomb}")),
    "nested vocabulary": (nested_vocabulary, ("build", "{plain}", "-o", "{out}", "--vocabulary", "{bomb}")),
    "huge graph": (huge_graph, ("show", "{bomb}")),
    "nested graph": (nested_graph, ("show", "{bomb}")),
    "huge P&ID": (huge_plan, ("compare", "{built}", "{bomb}")),
    "P&ID of entities": (plan_of_entities, ("compare", "{built}", "{bomb}")),
}  # fmt: skip
"""What each bomb is called, how it is made, and the command that meets it."""
