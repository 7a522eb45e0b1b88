"""Plants in other formats, read back by libraries that are not ours where there is one."""

from __future__ import annotations

import importlib
import json
import struct
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from cadgraph.config import LoadConfig
from cadgraph.load import load
from cadgraph.model.truth import Truth
from cadplants import FileStyle, Metadata, UsdStyle, make, match, truth_for, write_plant, write_usd
from cadplants.solids.mesh_ops import Solid, volume
from cadplants.writers import FORMATS, format_of
from plants.small_plant import small_plant

FILES = [form for form in FORMATS if form.module]


@pytest.fixture(scope="module")
def plant():
    return small_plant()


@pytest.fixture(scope="module")
def size(plant):
    """Volume and box of the whole plant [m3, m]."""
    scene = plant.scene()
    return sum(volume(Solid(c.vertices, c.faces)) for c in plant.components), box_of(scene.vertices)


def box_of(points):
    return np.array([points.min(axis=0), points.max(axis=0)])


def content(meshes):
    return sum(volume(Solid(np.asarray(v, float), np.asarray(f))) for v, f in meshes)


def scene_meshes(path, **options):
    """Placed vertices and faces of each mesh by the name of its node, by trimesh."""
    trimesh = pytest.importorskip("trimesh")
    scene = trimesh.load_scene(path, process=False, **options)
    found = {}
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph.get(node)
        mesh = scene.geometry[name].copy()
        mesh.apply_transform(matrix)
        found[node] = (np.asarray(mesh.vertices), np.asarray(mesh.faces))
    return found


@pytest.mark.parametrize("form", FILES, ids=lambda form: form.name)
def test_the_same_plant_gives_the_same_bytes_and_a_truth_with_places(form, plant, tmp_path):
    if form.library:
        pytest.importorskip(form.library)
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        write_plant(plant, tmp_path / folder / f"plant{form.suffixes[0]}")
    names = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert [p.read_bytes() for p in sorted((tmp_path / "a").iterdir())] == [
        (tmp_path / "b" / name).read_bytes() for name in names
    ]
    truth = Truth.load(tmp_path / "a" / "plant.truth.json")
    assert len(truth.meshes) == plant.n_meshes
    assert len(truth.contacts) == len(plant.contacts)
    assert truth.model_extra["file_format"] == form.name
    for row, component in zip(truth.meshes, plant.components, strict=True):
        assert (row.group, row.name) == (component.group, component.name)
        # A true cylinder reaches beyond the corners of a coarse one.
        reach = 0.04 * np.ptp(component.vertices, axis=0).max() if form.name == "rvm" else 1e-6
        assert np.array(row.model_extra["bounds"]) == pytest.approx(box_of(component.vertices), abs=reach)
    found = match(plant.scene(), truth, 0.06 if form.name == "rvm" else 0.001)
    assert list(found.same) == [row.mesh for row in truth.meshes]
    assert found.lines() == ()


def test_usd_is_as_ever(plant, tmp_path):
    write_usd(plant, tmp_path / "a.usda")
    write_plant(plant, tmp_path / "b.usda")
    assert (tmp_path / "a.usda").read_bytes() == (tmp_path / "b.usda").read_bytes()
    assert (tmp_path / "a.truth.json").read_bytes() == (tmp_path / "b.truth.json").read_bytes()
    assert "bounds" not in (tmp_path / "a.truth.json").read_text()


def test_glb_nodes_share_meshes_and_lie_where_they_should(plant, size, tmp_path):
    write_plant(plant, tmp_path / "plant.glb")
    meshes = scene_meshes(tmp_path / "plant.glb")
    truth = Truth.load(tmp_path / "plant.truth.json")
    assert {f"/World/{name}" for name in meshes} == {row.mesh for row in truth.meshes}
    # glTF has Y up.
    points = np.concatenate([v for v, _ in meshes.values()])[:, [0, 2, 1]] * (1, -1, 1)
    assert box_of(points) == pytest.approx(size[1], abs=1e-6)
    assert content(meshes.values()) == pytest.approx(size[0], rel=1e-5)


def test_merged_glb_has_one_mesh_for_each_colour(plant, size, tmp_path):
    write_plant(plant, tmp_path / "plant.glb", FileStyle(0.001, "Z", layout="merged"))
    meshes = scene_meshes(tmp_path / "plant.glb")
    assert len(meshes) == len({c.color for c in plant.components})
    assert box_of(np.concatenate([v for v, _ in meshes.values()])) == pytest.approx(size[1] * 1000, abs=1e-3)
    assert content(meshes.values()) == pytest.approx(size[0] * 1e9, rel=1e-5)


def test_obj_has_an_object_for_each_mesh_and_a_material_file(plant, size, tmp_path):
    write_plant(plant, tmp_path / "plant.obj")
    meshes = scene_meshes(tmp_path / "plant.obj", split_objects=True, group_material=False)
    assert len(meshes) == plant.n_meshes
    points = np.concatenate([v for v, _ in meshes.values()])[:, [0, 2, 1]] * (1, -1, 1)
    assert box_of(points) == pytest.approx(size[1] * 1000, abs=1e-5)
    assert content(meshes.values()) == pytest.approx(size[0] * 1e9, rel=1e-7)
    assert "mtllib plant.mtl" in (tmp_path / "plant.obj").read_text()
    assert (tmp_path / "plant.mtl").read_text().count("newmtl") == 3


def test_stl_is_one_bag_of_all_triangles(plant, size, tmp_path):
    write_plant(plant, tmp_path / "plant.stl", FileStyle(meters_per_unit=1.0))
    ((vertices, faces),) = scene_meshes(tmp_path / "plant.stl").values()
    assert len(faces) == sum(len(c.faces) for c in plant.components)
    assert box_of(vertices) == pytest.approx(size[1], abs=1e-6)
    assert content([(vertices, faces)]) == pytest.approx(size[0], rel=1e-5)


def test_step_parts_are_solids(plant, size, tmp_path):
    pytest.importorskip("cascadio")
    write_plant(plant, tmp_path / "plant.step")
    scene = load(tmp_path / "plant.step", LoadConfig(isolate=False))
    # The valve body and the bolt are two closed shells each.
    assert scene.n_meshes == plant.n_meshes + 2
    assert box_of(scene.vertices) == pytest.approx(size[1], abs=1e-6)
    assert content(scene.mesh(i) for i in range(scene.n_meshes)) == pytest.approx(size[0], rel=1e-5)
    written = Truth.load(tmp_path / "plant.truth.json")
    found = match(scene, written)
    assert sorted(len(some) for some in found.split.values()) == [2, 2]
    assert (len(found.same), found.missing, found.surplus) == (plant.n_meshes - 2, (), ())
    truth = truth_for(scene, written)
    assert {row.mesh for row in truth.meshes} == set(scene.paths)
    assert Counter(row.name for row in truth.meshes)["valve body"] == 2
    assert truth.contacts is None
    assert {unit.id: len(unit.meshes) for unit in truth.units} == {"T-1": 2, "V-1": 3}


def test_ifc_is_valid_and_says_what_everything_is(plant, size, tmp_path):
    ifcopenshell = pytest.importorskip("ifcopenshell")
    for module in ("geom", "util.element", "util.system", "validate"):
        importlib.import_module(f"ifcopenshell.{module}")
    write_plant(plant, tmp_path / "plant.ifc")
    file = ifcopenshell.open(tmp_path / "plant.ifc")
    log = ifcopenshell.validate.json_logger()
    ifcopenshell.validate.validate(file, log)
    assert log.statements == []
    counts = Counter(product.is_a() for product in file.by_type("IfcElement"))
    assert counts["IfcPipeSegment"] == 2
    assert counts["IfcPipeFitting"] == 3
    assert counts["IfcValve"] == counts["IfcTank"] == counts["IfcBeam"] == 1
    (valve,) = file.by_type("IfcValve")
    assert (valve.Name, valve.PredefinedType) == ("V-1", "ISOLATING")
    assert ifcopenshell.util.element.get_type(valve).Name == "Gate valve DN50"
    assert len(ifcopenshell.util.element.get_parts(valve)) == 2
    assert [system.Name for system in ifcopenshell.util.system.get_element_systems(valve)] == ["L1"]
    # Along the line from the tank: pipe, gasket, valve, gasket, pipe, elbow.
    here, names = file.by_type("IfcTank")[0], []
    while here is not None:
        names.append(here.is_a())
        out = [p for p in ifcopenshell.util.system.get_ports(here) if p.FlowDirection == "SOURCE"]
        mate = ifcopenshell.util.system.get_connected_port(out[0]) if out else None
        here = ifcopenshell.util.system.get_port_element(mate) if mate else None
    fitting, pipe = "IfcPipeFitting", "IfcPipeSegment"
    assert names == ["IfcTank", pipe, fitting, "IfcValve", fitting, pipe, fitting]
    meshes = []
    for product in (one for one in file.by_type("IfcElement") if one.Representation):
        shape = ifcopenshell.geom.create_shape(ifcopenshell.geom.settings(USE_WORLD_COORDS=True), product)
        points = np.array(shape.geometry.verts).reshape(-1, 3)
        meshes.append((points, np.array(shape.geometry.faces).reshape(-1, 3)))
    assert len(meshes) == plant.n_meshes
    assert box_of(np.concatenate([v for v, _ in meshes])) == pytest.approx(size[1], abs=1e-6)
    assert content(meshes) == pytest.approx(size[0], rel=1e-5)
    assert len(file.by_type("IfcMappedItem")) == 0  # the one shape that repeats is mirrored
    assert len({one.GlobalId for one in file.by_type("IfcRoot")}) == len(file.by_type("IfcRoot"))


def test_ifc_repeats_are_mapped_and_units_are_kept(tmp_path):
    ifcopenshell = pytest.importorskip("ifcopenshell")
    importlib.import_module("ifcopenshell.util.unit")
    write_plant(make("skid"), tmp_path / "plant.ifc", FileStyle(meters_per_unit=0.0254))
    file = ifcopenshell.open(tmp_path / "plant.ifc")
    assert ifcopenshell.util.unit.calculate_unit_scale(file) == pytest.approx(0.0254)
    maps = Counter(item.MappingSource.id() for item in file.by_type("IfcMappedItem"))
    assert maps
    assert min(maps.values()) >= 2


def rvm_chunks(data):
    """Tag and payload of every chunk; each must end where the next begins."""
    at, found = 0, []
    while True:
        words = struct.unpack_from(">6I", data, at)
        tag = bytes(words[:4]).decode("ascii")
        assert words[4] % 4 == 0
        assert at + 24 <= words[4] <= len(data)
        found.append((tag, data[at + 24 : words[4]]))
        at = words[4]
        if tag == "END:":
            assert at == len(data)
            return found


def rvm_string(payload, at):
    (count,) = struct.unpack_from(">I", payload, at)
    return payload[at + 4 : at + 4 + 4 * count].rstrip(b"\0").decode(), at + 4 + 4 * count


def rvm_volume(kind, p, payload):
    """The volume of a body [mm3], after the closed forms of each kind."""
    if kind == 1:
        (a, b, c, d, _, _, h) = p
        return h / 6 * (2 * a * b + 2 * c * d + a * d + b * c)
    if kind == 11:
        return facet_volume(payload)
    return {
        2: lambda: p[0] * p[1] * p[2],
        3: lambda: (p[1] ** 2 - p[0] ** 2) * p[2] * p[3] / 2,
        4: lambda: p[0] * np.pi * p[1] ** 2 * p[2],
        5: lambda: 2 / 3 * np.pi * p[0] ** 2 * p[1],
        7: lambda: np.pi * p[2] / 3 * (p[0] ** 2 + p[0] * p[1] + p[1] ** 2),
        8: lambda: np.pi * p[0] ** 2 * p[1],
        9: lambda: np.pi * p[0] ** 3 / 6,
    }[kind]()


def facet_volume(payload):
    words = np.frombuffer(payload, ">u4")
    values = np.frombuffer(payload, ">f4").astype(float)
    at, total = 1, 0.0
    for _ in range(words[0]):
        assert words[at] == 1  # contours
        count = int(words[at + 1])
        corners = values[at + 2 : at + 2 + 6 * count].reshape(count, 6)
        area = np.cross(corners[:, :3], np.roll(corners[:, :3], -1, axis=0)).sum(axis=0)
        assert area @ corners[0, 3:] > 0  # the normal looks the way the corners turn
        total += area @ corners[0, :3] / 6
        at += 2 + 6 * count
    assert at == len(words)
    return total


def rvm_bodies(data):
    """Names of the nodes above each body, its kind, matrix, box, and volume [mm3]."""
    names, bodies = [], []
    for tag, payload in rvm_chunks(data):
        if tag == "CNTB":
            names.append(rvm_string(payload, 4)[0])
        elif tag == "CNTE":
            names.pop()
        elif tag == "PRIM":
            _, kind = struct.unpack_from(">2I", payload)
            matrix = np.frombuffer(payload, ">f4", 12, 8).astype(float).reshape(4, 3)
            box = np.frombuffer(payload, ">f4", 6, 56).astype(float).reshape(2, 3)
            rest = payload[80:]
            values = np.frombuffer(rest, ">f4").astype(float)
            bodies.append((tuple(names), kind, matrix, box, rvm_volume(kind, values, rest)))
    assert names == []
    return bodies


def test_rvm_bodies_are_true_primitives_where_they_can_be(plant, size, tmp_path):
    write_plant(plant, tmp_path / "plant.rvm")
    bodies = rvm_bodies((tmp_path / "plant.rvm").read_bytes())
    # Shell, one pipe and a bolt's shank; the box; pipe, two gaskets and a wheel; bend; head; foundation; ball.
    kinds = Counter(kind for _, kind, _, _, _ in bodies)
    assert kinds == {8: 3, 2: 1, 3: 4, 4: 1, 5: 1, 7: 1, 9: 1, 11: 2}
    corners = []
    for _, _, matrix, box, _ in bodies:
        turn = matrix[:3] * 1000
        assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-5)
        assert np.linalg.det(turn) == pytest.approx(1, abs=1e-5)
        every = np.array([[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
        corners.append(every @ matrix[:3] + matrix[3])
    assert box_of(np.concatenate(corners)) == pytest.approx(size[1], abs=0.03)
    # A circle has 4.7 % more area than the twelve corners in it; a dome of few rings lacks a little more.
    total = sum(one for *_, one in bodies) * 1e-9
    assert 1.0 < total / size[0] < 1.055


def test_rvm_has_the_tree_of_a_design_system_and_its_attributes(plant, tmp_path):
    write_plant(plant, tmp_path / "plant.rvm")
    bodies = rvm_bodies((tmp_path / "plant.rvm").read_bytes())
    branch = ("/SMALL", "/SMALL-PIPING", "/100-L1", "/100-L1/B1")
    on_branch = [names[4:] for names, *_ in bodies if names[:4] == branch]
    of = "of BRANCH /100-L1/B1"
    assert list(dict.fromkeys(on_branch)) == [
        (),
        (f"GASKET 1 {of}",),
        ("/V-1", "PCOMPONENT 1 of VALVE /V-1"),
        ("/V-1", "PCOMPONENT 2 of VALVE /V-1"),
        (f"GASKET 2 {of}",),
        (f"ELBOW 1 {of}",),
    ]
    assert on_branch.count(()) == 2  # two pipes without an element
    text = (tmp_path / "plant.att").read_text()
    nodes = [line.strip()[4:] for line in text.splitlines() if line.strip().startswith("NEW ")][1:]
    opened = [rvm_string(p, 4)[0] for tag, p in rvm_chunks((tmp_path / "plant.rvm").read_bytes()) if tag == "CNTB"]
    assert nodes == opened
    assert text.count("END\n") == len(nodes) + 1
    for said in ("Href:=  /T-1", "Type:=  ELBO", "Spref:=  /A150/GATE-VALVE-50", "Type:=  EQUI", "Hbore:=  50"):
        assert said in text


def test_wrong_classes_and_missing_names_are_as_many_as_asked_for(tmp_path):
    plant = make("pumps")
    style = FileStyle(metadata=Metadata(wrong_classes=0.2, missing_names=0.3))
    write_plant(plant, tmp_path / "plant.rvm", style)
    truth = Truth.load(tmp_path / "plant.truth.json")
    wrong, missing = truth.model_extra["wrong_classes"], truth.model_extra["missing_names"]
    assert len(missing) == pytest.approx(0.3 * plant.n_meshes, rel=0.3)
    assert len(wrong) == pytest.approx(0.2 * 0.7 * plant.n_meshes, rel=0.4)
    assert not set(wrong) & set(missing)
    text = (tmp_path / "plant.att").read_text()
    bare = text.split("NEW /X00001\n")[1].split("END")[0]
    assert not {"Type", "Desc", "Spref"} & {line.split(":=")[0].strip() for line in bare.splitlines()}


@pytest.mark.parametrize("value", [-0.1, 1.1, float("nan")])
def test_shares_are_from_0_to_1(value):
    with pytest.raises(ValueError, match="give a share"):
        Metadata(wrong_classes=value)


@pytest.mark.parametrize(
    ("name", "style", "message"),
    [
        ("a.rvm", FileStyle(meters_per_unit=1.0), "millimetres"),
        ("a.ifc", FileStyle(up_axis="Y"), "Z up"),
        ("a.step", FileStyle(meters_per_unit=0.0254), "0.001 m"),
        ("a.obj", FileStyle(layout="merged"), "one of glb"),
        ("a.stl", FileStyle(metadata=Metadata(0.1)), "have no classes"),
        ("a.usdc", FileStyle(), "UsdStyle"),
        ("a.glb", UsdStyle(), "FileStyle"),
        ("a.fbx", None, "ends in .usd"),
    ],
)
def test_what_a_format_cannot_say_is_refused(plant, name, style, message, tmp_path):
    if name == "a.ifc":
        pytest.importorskip("ifcopenshell")
    with pytest.raises(ValueError, match=message):
        write_plant(plant, tmp_path / name, style)
    assert list(tmp_path.iterdir()) == []


def test_a_format_is_known_by_its_name_or_its_suffix():
    assert format_of("a.STP").name == "step"
    assert format_of("a.stp", "step").name == "step"
    with pytest.raises(ValueError, match=r"as rvm a plant ends in \.rvm"):
        format_of("a.stp", "rvm")
    with pytest.raises(ValueError, match="give one of usd"):
        format_of("a.stp", "jt")


@pytest.mark.parametrize("name", ["plant.usda", "plant.obj", "plant.rvm"])
def test_a_plant_that_is_broken_off_leaves_nothing_and_its_truth_comes_first(name, plant, tmp_path, monkeypatch):
    order, replace_file = [], Path.replace

    def broken(one, other):
        order.append(Path(other).suffix)
        if len(order) == at:
            raise KeyboardInterrupt
        return replace_file(one, other)

    for at in (1, 100):
        order.clear()
        with monkeypatch.context() as patch:
            patch.setattr(Path, "replace", broken)
            if at == 1:
                with pytest.raises(KeyboardInterrupt):
                    write_plant(plant, tmp_path / name)
                assert list(tmp_path.iterdir()) == []
            else:
                write_plant(plant, tmp_path / name)
    assert order[0] == ".json"
    assert order[-1] == Path(name).suffix


@pytest.fixture
def run(capsys):
    from cadgraph.cli import main

    def command(*words):
        with pytest.raises(SystemExit) as end:
            main([str(word) for word in words])
        return end.value.code or 0, " ".join("".join(capsys.readouterr()).split())

    return command


def test_a_truth_that_was_made_by_hand_is_not_written_over(run, tmp_path):
    mine = tmp_path / "riser.truth.json"
    mine.write_text('{"format": "cadgraph-truth", "version": 1, "meshes": []}')
    code, said = run("environment", "make", "--preset", "riser", "-o", tmp_path / "riser.usdc")
    assert (code, "was not generated and would be lost; move it away" in said) == (2, True)
    assert [path.name for path in tmp_path.iterdir()] == ["riser.truth.json"]
    mine.unlink()
    for _ in range(2):
        assert run("environment", "make", "--preset", "riser", "-o", tmp_path / "riser.usdc")[0] == 0


def test_a_file_without_a_unit_is_checked_in_that_of_its_truth(run, tmp_path):
    assert run("environment", "make", "--preset", "riser", "-o", tmp_path / "riser.obj")[0] == 0
    code, said = run("environment", "check", tmp_path / "riser.obj")
    assert (code, said.endswith("the truth holds")) == (0, True)


def test_a_check_says_what_it_could_not_check_and_whether_to_match_first(run, tmp_path):
    for name, preset in (("riser.stl", "riser"), ("skid.stl", "skid")):
        assert run("environment", "make", "--preset", preset, "-o", tmp_path / name)[0] == 0
    code, said = run("environment", "check", tmp_path / "riser.stl")
    assert (code, "match" in said, "first" in said) == (2, True, True)
    code, said = run("environment", "check", tmp_path / "riser.stl", tmp_path / "skid.truth.json")
    assert (code, "the truth of another scene" in said) == (2, True)
    fitted = tmp_path / "fitted.json"
    code, said = run("environment", "match", tmp_path / "riser.stl", "-o", fitted)
    assert (code, "left out what touches" in said) == (0, True)
    code, said = run("environment", "check", tmp_path / "riser.stl", fitted)
    assert code == 0
    assert "not checked: whether clusters and units hang together, and what touches (no 'contacts')" in said
    assert said.endswith("what was checked of the truth holds")
    least = Truth.load(fitted).to_json()
    for keys, why in (
        (("format", "version", "meshes"), "say it in the truth as 'meters_per_unit'"),
        (("format", "version", "meshes", "meters_per_unit", "up_axis"), "says nothing that the geometry could prove"),
    ):
        (tmp_path / "least.json").write_text(json.dumps({key: least[key] for key in keys}))
        code, said = run("environment", "check", tmp_path / "riser.stl", tmp_path / "least.json")
        assert (code, why in said) == (2, True)


def test_the_truth_of_curved_primitives_holds_as_their_reader_cuts_them(run, tmp_path):
    assert run("environment", "make", "--preset", "station", "-o", tmp_path / "a.rvm")[0] == 0
    assert run("environment", "match", tmp_path / "a.rvm", "-o", tmp_path / "b.json")[0] == 0
    code, said = run("environment", "check", tmp_path / "a.rvm", tmp_path / "b.json")
    assert (code, said.endswith("the truth holds")) == (0, True)


def test_the_command_line_writes_each_format_and_fits_the_truth_to_what_is_read(tmp_path, run):
    target = tmp_path / "own.usda"
    make_it = ("environment", "make", "--preset", "riser", "--style", "bim", "-o")
    assert run(*make_it, tmp_path / "riser.rvm", "--wrong-classes", "0.1")[0] == 0
    assert {path.name for path in tmp_path.iterdir()} == {"riser.rvm", "riser.att", "riser.truth.json"}
    code, said = run(*make_it, tmp_path / "riser.rvm", "--polygons", "1")
    assert code != 0
    assert "--polygons is no setting of rvm" in said
    code, said = run(*make_it, target, "--missing-names", "0.1")
    assert code != 0
    assert "--missing-names is no setting of usd" in said
    assert run(*make_it, tmp_path / "other.rvm")[0] == run(*make_it, target)[0] == 0
    # Its meshes are called otherwise, so that this truth would be that of one of both.
    code, said = run(*make_it, tmp_path / "other.usd")
    assert (code, "other.truth.json is the truth of" in said) == (2, True)
    # What a file of this format does not say of its unit and up axis, its truth does.
    assert run(*make_it, tmp_path / "bag.obj", "--unit", "0.0254", "--up", "Z")[0] == 0
    code, said = run("environment", "match", tmp_path / "bag.obj", "-o", tmp_path / "bag.truth.json")
    assert (code, "meshes of the" in said, "75 meshes" in said) == (0, False, True)
    # The truth that was written with one format fits the same plant in another.
    code, said = run(
        "environment", "match", target, tmp_path / "other.truth.json", "-o", tmp_path / "fitted.truth.json"
    )
    assert (code, "75 meshes" in said) == (0, True)
    fitted = Truth.load(tmp_path / "fitted.truth.json")
    own = Truth.load(tmp_path / "own.truth.json")
    assert {row.mesh: row.name for row in fitted.meshes} == {row.mesh: row.name for row in own.meshes}
