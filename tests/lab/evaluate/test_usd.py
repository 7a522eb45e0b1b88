import pytest

import cadgraph
import graphs
from cadgraph.errors import LoadError
from cadgraph.export.usd import write_semantics
from cadgraph.model.truth import Truth
from cadgraph.model.vocabulary import Vocabulary
from cadlab.evaluate import evaluate, truth_from_usd
from cadplants import UsdStyle, make_skid, write_usd
from lab.evaluate.plants import agreeing

pytest.importorskip("pxr")

CUBE = 'def Cube "{name}" {extra} {{ double size = 1\n double3 xformOp:translate = ({x}, 0, 0)\n'
CUBE += ' uniform token[] xformOpOrder = ["xformOp:translate"]\n {body}\n}}\n'


def label(taxonomy, *words):
    return f"token[] semantics:labels:{taxonomy} = [{', '.join(chr(34) + w + chr(34) for w in words)}]"


def cube(name, body="", x=0, extra=""):
    return CUBE.format(name=name, body=body, x=x, extra=extra)


def written(tmp_path, text, name="scene.usda"):
    path = tmp_path / name
    path.write_text(f'#usda 1.0\n(defaultPrim = "W"\nmetersPerUnit = 1\nupAxis = "Z")\ndef Xform "W" {{\n{text}\n}}\n')
    return path


def test_a_label_layer_over_a_scene_elsewhere_is_read_where_its_folder_is_named(tmp_path):
    mesh = 'def Mesh "a"\n{\nint[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n'
    points = "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}"
    written(tmp_path, mesh + points)
    (tmp_path / "out").mkdir()
    layer = tmp_path / "out" / "semantics.usda"
    label = 'prepend apiSchemas = ["SemanticsLabelsAPI:class"])\n{\ntoken[] semantics:labels:class = ["tank"]\n}\n}'
    layer.write_text(f'#usda 1.0\n(subLayers = [@../scene.usda@])\nover "W"\n{{\nover "a" ({label}\n')
    with pytest.raises(LoadError):
        truth_from_usd(layer)
    assert labels(truth_from_usd(layer, asset_roots=[tmp_path])) == {"/W/a": ("Tank", "tank")}


def labels(truth):
    return {row.mesh: (row.group, row.name) for row in truth.meshes}


def test_labels_on_meshes_and_above_them(tmp_path):
    text = (
        cube("a", label("class", "valve body"))
        + cube("b", label("class", "Gate_Valve", "U_Bolt"), 2)
        + cube("c", label("class", "Pipe assembly"), 4)
        + cube("d", label("cad_group", "tank"), 6)
        + cube("e", label("class", "spaceship"), 8)
        + f'def Xform "up" {{ {label("class", "handwheel")}\n {cube("f", "", 10)}\n'
        + cube("g", label("class", "lever"), 12)
        + "}"
    )
    truth = truth_from_usd(written(tmp_path, text))
    assert labels(truth) == {
        "/W/a": ("Valve assembly", "valve body"),
        "/W/b": ("Connection assembly", "u-bolt"),
        "/W/c": ("Pipe assembly", None),
        "/W/d": ("Tank", None),
        "/W/e": (None, None),
        "/W/up/f": ("Valve assembly", "handwheel"),
        "/W/up/g": ("Valve assembly", "lever"),
    }
    assert (truth.units, truth.clusters, truth.connections, truth.contacts) == (None, None, None, None)
    assert (truth.meters_per_unit, truth.up_axis) == (1.0, "Z")


def test_a_name_in_two_groups_needs_its_group(tmp_path):
    tree = Vocabulary.from_json({"Pump": {"names": ["body"]}, "Valve": {"names": ["body"]}})
    text = cube("a", label("class", "body")) + cube("b", label("class", "body") + "\n" + label("cad_group", "Valve"), 2)
    assert labels(truth_from_usd(written(tmp_path, text), tree)) == {"/W/a": (None, None), "/W/b": ("Valve", "body")}


def test_a_unit_label_holds_what_lies_below(tmp_path):
    inner = cube("body", label("class", "valve body")) + cube("wheel", label("class", "handwheel"), 2)
    text = f'def Xform "V_1" {{ {label("cad_unit", "valve")}\n {inner} }}\n' + cube("p", label("class", "pipe"), 4)
    (unit,) = truth_from_usd(written(tmp_path, text)).units
    assert (unit.id, unit.tag, unit.type, unit.kind) == ("V_1", "V_1", "valve", None)
    assert unit.meshes == ("/W/V_1/body", "/W/V_1/wheel")


def test_units_of_the_same_name_get_ids_of_their_own(tmp_path):
    unit = f'def Xform "V" {{ {label("cad_unit", "valve")}\n {cube("b", label("class", "valve"))} }}\n'
    text = "".join(f'def Xform "L{i}" {{ {unit} }}\n' for i in range(2))
    assert [u.id for u in truth_from_usd(written(tmp_path, text)).units] == ["V", "V-2"]


@pytest.mark.slow
@pytest.mark.parametrize(
    "style", [UsdStyle(), UsdStyle(meters_per_unit=0.01, up_axis="Y", instances="native", nested=1)]
)
def test_a_layer_of_ours_gives_back_labels_units_and_clusters(tmp_path, style):
    scene = tmp_path / "skid.usdc"
    truth = Truth.load(write_usd(make_skid(), scene, style))
    write_semantics(cadgraph.load(scene), agreeing(truth), scene, tmp_path / "semantics.usda")
    found = truth_from_usd(tmp_path / "semantics.usda")
    assert labels(found) == labels(truth)
    assert {frozenset(u.meshes) for u in found.units} == {frozenset(u.meshes) for u in truth.units}
    assert {u.type for u in found.units} == {"valve", "gauge"}
    assert {u.kind for u in found.units} == {u.kind for u in truth.units}
    assert [frozenset(c.meshes) for c in found.clusters] == [frozenset(c.meshes) for c in truth.clusters]
    assert (found.meters_per_unit, found.up_axis) == (truth.meters_per_unit, truth.up_axis)
    assert len(found.connections) == len(truth.connections) == 27
    assert {p.kind for p in found.points} == {"terminal"}
    total = evaluate(agreeing(truth), found).total
    assert (total.units.total.exact, total.connected.edges.f1, total.connected.terminals.f1) == (24, 1.0, 1.0)


def test_directions_and_points_come_back(tmp_path):
    path = written(tmp_path, cube("mesh_0") + cube("mesh_1", "", 2) + cube("mesh_2", "", 4) + cube("mesh_3", "", 6))
    line = graphs.valve_line()
    moved = cadgraph.SceneGraph.from_json(
        line.to_json()
        | {
            "nodes": [
                {**node, "meshes": [f"/W{m}" for m in node["meshes"]]} if node["layer"] == "part" else node
                for node in line.to_json()["nodes"]
                if node["id"] not in ("part-4", "unit-G-001", "cluster-1")
            ],
            "edges": [
                edge
                for edge in line.to_json()["edges"]
                if not {"part-4", "unit-G-001", "cluster-1"} & {edge["source"], edge["target"]}
            ],
        }
    )
    write_semantics(cadgraph.load(path), moved, path, tmp_path / "semantics.usda")
    truth = truth_from_usd(tmp_path / "semantics.usda")
    flows = {(c.source, c.target): c.direction for c in truth.connections}
    (end,) = truth.points
    assert flows == {("V-001", "V-002"): "forward", (end.id, "V-002"): "unknown"}
    assert (end.kind, end.point) == ("terminal", (4.0, 0.0, 0.0))


def test_an_instance_that_stands_for_several_parts_labels_none_of_them(tmp_path):
    text = 'def Xform "i" (customData = { dictionary cadgraph = { string[] parts = ["p", "q"] } })\n'
    text += f"{{ {label('class', 'pipe')}\n {cube('a')} {cube('b', label('class', 'flange'), 2)} }}"
    assert labels(truth_from_usd(written(tmp_path, text))) == {
        "/W/i/a": (None, None), "/W/i/b": ("Pipe assembly", "flange"),
    }  # fmt: skip


def test_a_file_without_labels_is_a_load_error(tmp_path):
    with pytest.raises(LoadError, match="no mesh carries a label"):
        truth_from_usd(written(tmp_path, cube("a")))


def test_a_missing_file_is_a_load_error(tmp_path):
    with pytest.raises(LoadError, match="no such file"):
        truth_from_usd(tmp_path / "nothing.usda")


def test_a_truth_read_from_usd_survives_its_file(tmp_path):
    truth = truth_from_usd(written(tmp_path, cube("a", label("class", "pipe"))))
    assert Truth.load(truth.save(tmp_path / "a.truth.json")) == truth
