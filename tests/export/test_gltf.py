"""Labels in a copy of a glTF file: only its JSON changes."""

from __future__ import annotations

import hashlib
import json
import struct
from pathlib import Path

import pytest

import graphs
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError, OutputError
from cadgraph.export import export_graph, write_export
from cadgraph.export.gltf import write_gltf
from cadgraph.load import load
from cadgraph.load.gltf_file import Gltf
from cadgraph.load.gltf_nodes import node_paths
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import SourceRecord

POINTS = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def tree(**more):
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"name": "Skid", "children": [1, 2, 3], "extras": {"owner": "me"}},
            {"name": "Valve", "mesh": 0, "extras": {"tag": 7}},
            {"name": "Valve", "mesh": 0, "extras": "a word"},
            {"mesh": 0},
        ],
        "meshes": [{"name": "Ring (1)", "primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}],
        **more,
    }


def binary(content, data=POINTS):
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(data)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    return struct.pack("<4sII", b"glTF", 2, size) + chunks


def opened(data):
    assert data[:4] == b"glTF"
    assert struct.unpack_from("<I", data, 8)[0] == len(data)
    length, kind = struct.unpack_from("<II", data, 12)
    assert (length % 4, kind) == (0, 0x4E4F534A)
    return json.loads(data[20 : 20 + length]), data[20 + length :]


def plant(path="", sha256=""):
    parts = (
        graphs.part(0, "/Skid/Valve", label=graphs.label("Valve assembly", "valve body", 0.8)),
        graphs.part(1, "/Skid/Valve_1/instance_1", label=graphs.label("Pipe assembly", "pipe"), area=1.0),
        graphs.part(2, "/Skid/Valve_1/instance_2", label=graphs.label("Pipe assembly", "elbow"), area=2.0),
        graphs.part(3, "/Elsewhere", label=graphs.label("Pipe assembly", "pipe")),
        graphs.part(4, "/Skid/Ring_1"),
    )
    source = SourceRecord(path=str(path), sha256=sha256)
    document = graphs.graph((*parts, graphs.unit("V-001", "part-0"))).document
    return SceneGraph(document.model_copy(update={"source": source}))


def test_labels_go_into_the_nodes_and_all_else_stays(tmp_path):
    source = tmp_path / "plant.glb"
    source.write_bytes(binary(tree()))
    file, notes = write_gltf(plant(), source, tmp_path / "copy.glb")
    copy, rest = opened(file.read_bytes())
    assert rest == opened(source.read_bytes())[1]
    nodes = copy["nodes"]
    assert nodes[1].pop("extras") == {
        "tag": 7,
        "cadgraph": {
            "group": "Valve assembly",
            "name": "valve body",
            "confidence": 0.8,
            "state": "sure",
            "source": "geometry",
            "part": "part-0",
            "unit": "unit-V-001",
            "tag": "V-001",
        },
    }
    extras = nodes[2].pop("extras")
    assert extras["value"] == "a word"
    assert extras["cadgraph"]["name"] == "elbow"
    assert {rest: said["name"] for rest, said in extras["cadgraph"]["meshes"].items()} == {
        "instance_1": "pipe",
        "instance_2": "elbow",
    }
    untouched = tree()
    del untouched["nodes"][1]["extras"], untouched["nodes"][2]["extras"]
    assert copy == untouched
    assert [(note.code, note.meshes) for note in notes] == [("unmatched-mesh", ("/Elsewhere",))]


def test_the_same_labels_give_the_same_bytes_and_a_second_run_changes_nothing(tmp_path):
    source = tmp_path / "plant.glb"
    source.write_bytes(binary(tree()))
    once, _ = write_gltf(plant(), source, tmp_path / "once.glb")
    twice, _ = write_gltf(plant(), once, tmp_path / "twice.glb")
    assert opened(twice.read_bytes())[0]["nodes"][1] == opened(once.read_bytes())[0]["nodes"][1]
    assert write_gltf(plant(), source, tmp_path / "again.glb")[0].read_bytes() == once.read_bytes()


def test_files_beside_the_source_are_referred_to_from_the_new_place(tmp_path):
    (tmp_path / "in/my data").mkdir(parents=True)
    (tmp_path / "in/my data/points.bin").write_bytes(POINTS)
    source = tmp_path / "in/plant.gltf"
    images = [{"uri": "data:image/png;base64,AA=="}, {"uri": "https://x.org/a.png"}, {"bufferView": 0}]
    source.write_text(
        json.dumps(tree(buffers=[{"byteLength": 36, "uri": "my%20data/points.bin"}], images=images)), encoding="utf-8"
    )
    file, _ = write_gltf(plant(), source, tmp_path / "out/deep/copy.gltf")
    copy = json.loads(file.read_text(encoding="utf-8"))
    assert copy["buffers"][0]["uri"] == "../../in/my%20data/points.bin"
    assert copy["images"] == images
    beside, _ = write_gltf(plant(), source, tmp_path / "in/copy.gltf")
    assert json.loads(beside.read_text(encoding="utf-8"))["buffers"][0]["uri"] == "my%20data/points.bin"


def test_the_source_is_found_where_it_was_and_checked(tmp_path):
    source = tmp_path / "plant.glb"
    source.write_bytes(binary(tree()))
    digest = hashlib.sha256(source.read_bytes()).hexdigest()
    graph = plant(source, digest)
    assert export_graph(graph, "gltf", tmp_path / "out") == [tmp_path / "out/labelled.glb"]
    moved = source.rename(tmp_path / "moved.glb")
    with pytest.raises(LoadError, match="is not there; give it with --source"):
        export_graph(graph, "gltf", tmp_path / "out")
    assert export_graph(graph, "gltf", tmp_path / "out", moved) == [tmp_path / "out/labelled.glb"]
    moved.write_bytes(binary(tree(scene=0, extras={})))
    with pytest.raises(LoadError, match="changed since the graph was built, or another file"):
        export_graph(graph, "gltf", tmp_path / "out", moved)
    with pytest.raises(LoadError, match="doesn't say which file"):
        export_graph(plant(), "gltf", tmp_path / "out")


def test_a_source_of_another_format_and_a_needless_one_are_told(tmp_path):
    usd = tmp_path / "plant.usda"
    usd.write_text("#usda 1.0", encoding="utf-8")
    with pytest.raises(LoadError, match=r"a copy of a \.glb or \.gltf file"):
        write_export(plant(usd), "gltf", tmp_path)
    with pytest.raises(ValueError, match="leave --source out"):
        write_export(plant(usd), "csv", tmp_path, usd)


def test_the_source_is_never_written_over(tmp_path):
    source = tmp_path / "plant.glb"
    source.write_bytes(binary(tree()))
    with pytest.raises(OutputError, match="stays untouched"):
        write_gltf(plant(), source, tmp_path / "x/../plant.glb")


@pytest.mark.parametrize(
    "content",
    [
        b"glTF",
        binary(tree())[:40],
        struct.pack("<4sIIII", b"glTF", 2, 4_000_000_000, 3_999_999_980, 0x4E4F534A),
        struct.pack("<4sIIII", b"glTF", 1, 20, 0, 0x4E4F534A),
        b"{",
        b"[" * 100_000,
        b"[]",
        b"{}",
        b"\xff\xfe",
    ],
    ids=["head", "cut", "huge", "gltf-1", "cut-json", "deep", "list", "no-asset", "no-text"],
)
def test_damage_ends_in_one_line(tmp_path, content):
    (tmp_path / "bad.glb").write_bytes(content)
    with pytest.raises(LoadError) as caught:
        write_gltf(plant(), tmp_path / "bad.glb", tmp_path / "copy.glb")
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "copy.glb").exists()


def paths_of(content):
    return list(node_paths(Gltf(content, Path("plant.gltf"), None)))


def test_paths_are_names_made_unique_and_broken_nodes_are_passed_over():
    content = tree(
        nodes=[
            {"name": "A/b c", "children": [1, 2, 3, 3, 0, 99, "x"]},
            {"name": "A"},
            {"name": "A", "children": {"a": 1}},
            {"mesh": 0},
            {"name": "never reached"},
        ]
    )
    assert paths_of(content) == [("/A_b_c", 0), ("/A_b_c/A", 1), ("/A_b_c/A_1", 2), ("/A_b_c/Ring_1", 3)]
    assert paths_of({}) == []
    assert paths_of({"nodes": [{"children": [1]}, {}]}) == [("/node_0", 0), ("/node_0/node_1", 1)]


def test_a_deep_chain_of_nodes_ends():
    nodes = [{"children": [i + 1]} for i in range(5000)]
    assert len(paths_of({"nodes": [*nodes, {}]})) == 201


def test_paths_are_those_of_the_reader(tmp_path):
    odd = tree()
    hidden = {"KHR_node_visibility": {"visible": False}}
    children = [
        {"name": "a b", "mesh": 0},
        {"name": "a b", "mesh": 0, "extensions": hidden},
        {"name": "a.b", "mesh": 0},
    ]
    children += [{"name": "a b", "mesh": 0}, {"mesh": 0}, {"name": 7, "mesh": 0}, {"matrix": "x", "mesh": 0}]
    first = len(odd["nodes"])
    odd["nodes"] += [{"name": "/TOP/1", "children": [*range(first + 1, first + 8), first + 1, True, 999]}, *children]
    odd["scenes"][odd.get("scene", 0)]["nodes"].append(first)
    source = tmp_path / "plant.glb"
    source.write_bytes(binary(odd))
    scene = load(source, LoadConfig(isolate=False))
    known = dict(paths_of(odd))
    below = {path.removeprefix("/TOP_1/"): known[path] - first for path in scene.paths if path.startswith("/TOP_1/")}
    assert below == {"a_b": 1, "a.b": 3, "a_b_2": 4, "Ring_1": 5, f"node_{first + 6}": 6}
    assert set(scene.paths) <= set(known)
    everything = load(source, LoadConfig(isolate=False, invisible=True))
    assert set(everything.paths) - set(scene.paths) == {"/TOP_1/a_b_1"}
