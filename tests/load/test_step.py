from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("cascadio")

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.bodies import split_bodies
from cadgraph.load.gltf import node_matrix
from cadgraph.load.gltf_file import parse_glb
from cadgraph.load.gltf_nodes import root_nodes
from load.solids import _FACES, StepFile
from shapes import box, moved

IN_PROCESS = LoadConfig(isolate=False)
HERE = Path(__file__).parents[1] / "data/step"
VALVES = Path(__file__).parents[2] / "../shared/data/step/valves"
more = pytest.mark.skipif(not VALVES.is_dir(), reason="no further real files here")

# Numbers of solids as the STEP text lists them; sizes as first loaded, to catch changes [m].
FASTENER_FACTS = {
    "nut_iso4032_m3.step": (1, (0.0055, 0.00635, 0.0024)),
    "washer_iso7093_m12.step": (1, (0.037, 0.037, 0.003)),
}
VALVE_FACTS = {
    "ballvalves/ballDN15.stp": (3, (0.1215, 0.0688, 0.0690)),
    "ballvalves/ballDN25.step": (1, (0.1640, 0.0923, 0.0890)),
    "ballvalves/ballDN50flg.step": (1, (0.1661, 0.1152, 0.3115)),
    "butterflyvalves/DN150.step": (1, (0.4326, 0.3928, 0.1162)),
    "butterflyvalves/DN80.step": (1, (0.2518, 0.2735, 0.1163)),
    "checkvalves/DN100cv.step": (1, (0.1620, 0.1620, 0.0600)),
    "checkvalves/DN40cv.step": (1, (0.0917, 0.0917, 0.0315)),
}


def volume(scene, index=0):
    vertices, faces = scene.mesh(index)
    return float(np.linalg.det(vertices[faces]).sum() / 6)


def one_box(unit=".MILLI.", name="Part", low=(0, 0, 0), high=(10, 20, 30)):
    file = StepFile(unit)
    file.product(name, [file.box(low, high)])
    return file


def test_assembly_tree_names_and_instances_are_kept(tmp_path):
    file = StepFile()
    bolt = file.product("Bolt/M3", [file.box((0, 0, 0), (10, 20, 30))])
    sub = file.product("Sub", (), [(100, 0, 0), (200, 0, 0)])
    top = file.product("Top", (), [(0, 0, 0), (0, 0, 500)])
    for parent, child, names in ((sub, bolt, ("left", "right")), (top, sub, ("same", "same"))):
        for i, name in enumerate(names):
            file.use(parent, child, i, name)
    scene = load(file.write(tmp_path / "a.step"), IN_PROCESS)
    assert scene.paths == ("/Top/same/left", "/Top/same/right", "/Top/same_1/left", "/Top/same_1/right")
    np.testing.assert_allclose(scene.mesh(3)[0].min(axis=0), [0.2, 0, 0.5], atol=1e-9)
    np.testing.assert_allclose(scene.mesh(3)[0].max(axis=0), [0.21, 0.02, 0.53], atol=1e-9)
    assert volume(scene, 3) == pytest.approx(6e-6)


def test_occurrence_without_a_name_gets_that_of_its_part(tmp_path):
    file = StepFile()
    bolt = file.product("Bolt/M3 <x>", [file.box((0, 0, 0), (10, 20, 30))])
    top = file.product("Top", (), [(0, 0, 0), (50, 0, 0)])
    file.use(top, bolt, 0)
    file.use(top, bolt, 1)
    assert load(file.write(tmp_path / "a.step"), IN_PROCESS).paths == ("/Top/Bolt_M3_x", "/Top/Bolt_M3_x_1")


def test_colours_are_linear_and_the_largest_area_wins(tmp_path):
    file = StepFile()
    small, large = file.box((0, 0, 0), (1, 1, 1)), file.box((5, 0, 0), (15, 10, 10))
    file.color(small, (1.0, 0.0, 0.0))
    file.color(large, (0.0, 0.5, 1.0))
    file.product("Two", [small, large])
    scene = load(file.write(tmp_path / "a.step"), IN_PROCESS)
    np.testing.assert_allclose(scene.colors, [[1, 0, 0], [0, 0.214, 1]], atol=1e-3)


def test_part_without_a_colour_has_none(tmp_path):
    assert np.isnan(load(one_box().write(tmp_path / "a.step"), IN_PROCESS).colors).all()


@pytest.mark.parametrize(("unit", "meters"), [(".MILLI.", 0.001), (".CENTI.", 0.01), ("$", 1.0)])
def test_units_become_metres(tmp_path, unit, meters):
    scene = load(one_box(unit).write(tmp_path / "a.stp"), IN_PROCESS)
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), np.array([10, 20, 30]) * meters, rtol=1e-6)
    assert (scene.source.meters_per_unit, scene.source.up_axis, scene.source.format) == (meters, "Z", "step")


def test_solids_of_one_part_become_bodies_even_where_they_touch(tmp_path):
    file = StepFile()
    file.product("Three", [file.box((x, 0, 0), (x + 10, 10, 10)) for x in (0, 10, 50)])
    scene = load(file.write(tmp_path / "a.step"), IN_PROCESS)
    assert scene.paths == ("/Three/body_1", "/Three/body_2", "/Three/body_3")
    assert [round(volume(scene, i) * 1e9) for i in range(3)] == [1000] * 3
    assert [n.code for n in scene.diagnostics] == ["several-bodies"]


def test_open_surfaces_stay_one_mesh(tmp_path):
    file = StepFile()
    file.product("Open", [file.box((x, 0, 0), (x + 10, 10, 10), _FACES[:4]) for x in (0, 50)])
    assert load(file.write(tmp_path / "a.step"), IN_PROCESS).paths == ("/Open",)


def test_isolated_reading_agrees(tmp_path):
    path = one_box().write(tmp_path / "a.step")
    isolated, direct = load(path), load(path, IN_PROCESS)
    assert isolated.vertices.tobytes() == direct.vertices.tobytes()
    assert isolated.source == direct.source


def test_isolated_reading_goes_without_trimesh(tmp_path, monkeypatch):
    (tmp_path / "trimesh").mkdir()
    (tmp_path / "trimesh/__init__.py").write_text("raise SystemExit('trimesh was imported')\n")
    monkeypatch.syspath_prepend(tmp_path)
    assert load(one_box().write(tmp_path / "a.step")).n_meshes == 1


@pytest.mark.slow
def test_damaged_files_are_one_line_errors(tmp_path):
    path = one_box().write(tmp_path / "a.step")
    text = path.read_bytes()
    cases = {
        "cut.step": text[: len(text) // 2],
        "words.step": b"some words",
        "head.step": text[:200],
        "no.igs": b"x" * 2000,
    }
    for name, content in cases.items():
        (tmp_path / name).write_bytes(content)
        with pytest.raises(LoadError) as caught:
            load(tmp_path / name)
        assert name in str(caught.value)
        assert "\n" not in str(caught.value)


def test_file_without_geometry_is_an_error(tmp_path):
    file = StepFile()
    file.product("Nothing")
    with pytest.raises(LoadError):
        load(file.write(tmp_path / "a.step"), IN_PROCESS)


@pytest.mark.parametrize(("unit", "meters"), [("2,2HMM", 0.001), ("1,2HIN", 0.0254), ("6,1HM", 1.0)])
def test_iges_surface_in_metres(tmp_path, unit, meters):
    """A flat patch of 10 x 20 units (IGES 5.3, entity 128)."""
    head = f"1H,,1H;,1Ht,1Ht,1Ht,1Ht,32,38,6,308,15,1Ht,1.0,{unit},1,0.01,"
    head += "15H20200101.000000,1E-6,1000.0,1Ht,1Ht,11,0,;"
    patch = "128,1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,"
    patch += "0.,0.,0.,10.,0.,0.,0.,20.,0.,10.,20.,0.,0.,1.,0.,1.;"
    lines = [f"{'test':<72}S{1:7d}"]
    pieces = {"G": wrapped(head, 72), "P": wrapped(patch, 64)}
    lines += [f"{piece:<72}G{i:7d}" for i, piece in enumerate(pieces["G"], 1)]
    zeros = "".join(f"{0:8d}" for _ in range(6))
    lines.append(f"{128:8d}{1:8d}{zeros}{'00000000'}D{1:7d}")
    lines.append(f"{128:8d}{0:8d}{0:8d}{len(pieces['P']):8d}{0:8d}{'':16}{'SURF':>8}{0:8d}D{2:7d}")
    lines += [f"{piece:<64}{1:8d}P{i:7d}" for i, piece in enumerate(pieces["P"], 1)]
    lines.append(f"S{1:7d}G{len(pieces['G']):7d}D{2:7d}P{len(pieces['P']):7d}{'':40}T{1:7d}")
    (tmp_path / "a.igs").write_text("\n".join(lines) + "\n")
    scene = load(tmp_path / "a.igs", IN_PROCESS)
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), [10 * meters, 20 * meters, 0], rtol=1e-6)
    assert (scene.source.format, scene.source.meters_per_unit) == ("iges", meters)


def wrapped(text, width):
    lines = [""]
    for word in text.replace(",", ",\n").split("\n"):
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += word
    return lines


@pytest.mark.parametrize(
    ("path", "n", "extent"),
    [
        *((HERE / name, *facts) for name, facts in FASTENER_FACTS.items()),
        *(pytest.param(VALVES / name, *facts, marks=more) for name, facts in VALVE_FACTS.items()),
    ],
)
def test_real_files_hold_their_solids(path, n, extent):
    scene = load(path, IN_PROCESS)
    assert scene.n_meshes == n
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), extent, rtol=0.01)
    assert all(volume(scene, i) > 0 for i in range(n))
    for i in range(n):
        faces = scene.mesh(i)[1]
        edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).tolist()
        assert sorted(map(tuple, edges)) == sorted(tuple(e[::-1]) for e in edges)


def test_finer_settings_give_more_triangles():
    path = HERE / "nut_iso4032_m3.step"
    coarse = load(path, LoadConfig(isolate=False, max_gap=0.002, max_angle=0.8))
    assert coarse.n_triangles < load(path, IN_PROCESS).n_triangles


# --- bodies and glTF on their own


def joined(*meshes):
    first = np.cumsum([0, *(len(v) for v, _ in meshes)])
    points = np.concatenate([v for v, _ in meshes]).astype(np.float32)
    return points, np.concatenate([f + n for (_, f), n in zip(meshes, first[:-1], strict=True)]).astype(np.int32)


def test_void_stays_with_the_solid_around_it():
    outer, (inner, faces) = box((4, 4, 4)), box()
    points, faces = joined(outer, (inner, faces[:, ::-1]), moved(box(), translation=(9, 0, 0)))
    assert [len(body) for body in split_bodies(points, faces)] == [24, 12]


def test_void_without_a_solid_is_left_alone():
    points, faces = joined((box()[0], box()[1][:, ::-1]), moved(box(), translation=(9, 0, 0)))
    assert [len(body) for body in split_bodies(points, faces)] == [24]


def test_no_faces_make_one_empty_body():
    assert [len(b) for b in split_bodies(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))] == [0]


@pytest.mark.parametrize("data", [b"", b"glTF", b"glTF" + struct.pack("<II", 2, 20) + b"\0" * 12])
def test_no_glb_is_an_error(data):
    with pytest.raises((ValueError, KeyError)):
        parse_glb(data)


def test_node_placements_follow_gltf():
    tree = (
        b'{"scenes":[{"nodes":[0,1]}],"nodes":[{"translation":[1,2,3],"rotation":[0,0,0.70710678,0.70710678],'
        b'"scale":[2,1,1]},{"matrix":[0,2,0,0,-1,0,0,0,0,0,1,0,1,2,3,1]}]}'
    )
    tree += b" " * (-len(tree) % 4)
    data = b"glTF" + struct.pack("<IIII", 2, 20 + len(tree), len(tree), 0x4E4F534A) + tree
    gltf = parse_glb(data)
    assert root_nodes(gltf) == [0, 1]
    first, second = (node_matrix(node) for node in gltf.rows("nodes"))
    np.testing.assert_allclose(first, second, atol=1e-7)
    np.testing.assert_allclose([1, 0, 0, 1] @ first, [1, 4, 3, 1], atol=1e-7)
