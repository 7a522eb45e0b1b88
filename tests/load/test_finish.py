"""Unit, up axis and bags of triangles: what every scene gets after its reader."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import cadgraph
import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.bodies import split_shells
from cadgraph.load.finish import finish
from cadgraph.load.units import METRES, UnitEvidence, weigh_units
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.scene import MeshArrays, Placement, Scene, Source

FILE = Path("plant.stl")
DEMO = Path(cadgraph.__file__).parent / "session/demo_plant.usdc"
OUTER = (0.0337, 0.0603, 0.0889, 0.1143, 0.2191)  # EN 10220: DN 25, 50, 80, 100, 200 [m]


def moved(mesh, at):
    return mesh[0] + np.asarray(at, float), mesh[1]


def pipes():
    """Pipes of standard diameters and a platform, in a plant of 12 m."""
    meshes = [
        moved(shapes.tube(outer=d / 2, inner=0.45 * d, height=1.5 + k, sides=24), (2 * k, 3, 0.4 * k))
        for k, d in enumerate(OUTER)
    ]
    return [*meshes, shapes.box((12.0, 8.0, 0.02))]


def scene_of(meshes, **source):
    return Scene.from_meshes(meshes, source=Source("plant.stl", **source))


def bag(meshes):
    """All in one mesh, in the order given."""
    shift = np.cumsum([0, *(len(v) for v, _ in meshes[:-1])])
    return np.concatenate([v for v, _ in meshes]), np.concatenate(
        [f + s for (_, f), s in zip(meshes, shift, strict=True)]
    )


def codes(scene):
    return [note.code for note in scene.diagnostics]


@pytest.mark.parametrize("unit", ["m", "cm", "mm", "in", "ft"])
def test_the_unit_is_found_by_the_pipes(unit):
    meshes = [(v / METRES[unit], f) for v, f in pipes()]
    found = finish(scene_of(meshes, unit_stated=False, format="stl"), LoadConfig(), FILE)
    assert found.source.meters_per_unit == METRES[unit]
    assert codes(found) == ["missing-units"]
    assert f"taken as {unit}" in found.diagnostics[0].message
    np.testing.assert_allclose(np.ptp(found.vertices, axis=0).max(), 12.0, rtol=0.2)


def test_without_evidence_the_unit_must_be_said():
    plain = scene_of([shapes.box((3.0, 2.0, 1.0)), moved(shapes.box(), (4, 0, 0))], unit_stated=False)
    with pytest.raises(LoadError, match=r"^plant\.stl: the file names no unit .* --unit mm"):
        finish(plain, LoadConfig(), FILE)
    hinted = replace(plain, diagnostics=(Diagnostic("unit-hint", "its name speaks of mm"),))
    with pytest.raises(LoadError, match=r"units across \(its name speaks of mm\)$"):
        finish(hinted, LoadConfig(), FILE)
    found = finish(plain, LoadConfig(unit="cm"), FILE)
    assert np.ptp(found.vertices[:, 0]) == pytest.approx(0.06)
    assert found.source.meters_per_unit == 0.01


def test_two_standard_diameters_among_others_decide_no_unit():
    two = UnitEvidence(dict.fromkeys(METRES, 0.0) | {"mm": 5.0}, dict.fromkeys(METRES, 0) | {"mm": 2}, 2, 1.0, 0.1)
    assert two.clear
    assert not replace(two, n_diameters=3).clear
    assert replace(two, n_diameters=9, hits=two.hits | {"mm": 3}).clear
    assert not replace(two, scores=two.scores | {"mm": 3.9}).clear


def test_a_stated_unit_is_doubted_and_kept():
    wrong = scene_of([(v / 0.0254, f) for v, f in pipes()], meters_per_unit=1.0)
    found = finish(wrong, LoadConfig(), FILE)
    assert codes(found) == ["unit-doubt"]
    assert "the file's unit is m" in found.diagnostics[0].message
    assert "--scale 0.0254" in found.diagnostics[0].message
    np.testing.assert_array_equal(found.vertices, wrong.vertices)
    assert codes(finish(wrong, LoadConfig(unit="in"), FILE)) == []
    mended = finish(wrong, LoadConfig(scale=0.0254), FILE)
    assert codes(mended) == []
    assert mended.source.meters_per_unit == pytest.approx(0.0254)
    np.testing.assert_allclose(mended.vertices, wrong.vertices * 0.0254)
    assert codes(finish(scene_of(pipes(), meters_per_unit=1.0), LoadConfig(), FILE)) == []


@pytest.mark.parametrize("wrong", [1.0, 0.0254, 0.01, 1e-6])
def test_the_demo_with_another_unit_is_doubted_with_the_scale_that_mends_it(wrong):
    sound = load(DEMO)
    assert "unit-doubt" not in codes(sound)
    assert sound.source.meters_per_unit == 0.001
    config = LoadConfig(scale=wrong / 0.001, split=False)
    [note] = [one for one in finish(sound, config, FILE).diagnostics if one.code == "unit-doubt"]
    told = float(re.search(r"--scale ([0-9.e+-]+);", note.message)[1])
    assert told * wrong == pytest.approx(0.001, rel=1e-8)
    assert "nothing was rescaled" in note.message


def test_sizes_alone_tell_of_many_meshes_and_not_of_few():
    boxes = [moved(shapes.box((0.3, 0.2, 0.1)), (x, y, 0)) for x in range(8) for y in range(6)]
    assert codes(finish(scene_of(boxes, meters_per_unit=1.0), LoadConfig(), FILE)) == []
    huge = [(1000 * vertices, faces) for vertices, faces in boxes]
    [note] = finish(scene_of(huge, meters_per_unit=1.0), LoadConfig(), FILE).diagnostics
    assert note.code == "unit-doubt"
    assert "odd for a plant" in note.message
    assert "read it with --unit mm" in note.message
    assert codes(finish(scene_of(huge[:12], meters_per_unit=1.0), LoadConfig(), FILE)) == []


def test_strokes_of_a_dial_by_the_hundred_tell_no_unit():
    boxes = [moved(shapes.box((0.3, 0.2, 0.1)), (0.5 * x, 0.5 * y, 0)) for x in range(8) for y in range(6)]
    strokes = [moved(shapes.box((0.002, 0.0003, 0.0001)), (0.01 * k, 0, 0.2)) for k in range(300)]
    assert codes(finish(scene_of([*boxes, *strokes], meters_per_unit=1.0), LoadConfig(), FILE)) == []
    small = [(vertices / 1000, faces) for vertices, faces in [*boxes, *strokes]]
    assert codes(finish(scene_of(small, meters_per_unit=1.0), LoadConfig(), FILE)) == ["unit-doubt"]


def test_a_scale_is_that_of_metres_where_no_unit_is_stated_and_never_beside_a_unit():
    unsaid = scene_of(pipes(), unit_stated=False)
    found = finish(unsaid, LoadConfig(scale=0.5), FILE)
    np.testing.assert_allclose(np.ptp(found.vertices, axis=0), 0.5 * np.ptp(unsaid.vertices, axis=0))
    assert found.source.meters_per_unit == 0.5
    with pytest.raises(ValueError, match="contradict each other"):
        LoadConfig(unit="mm", scale=2.0)


def test_a_unit_is_weighed_the_same_whatever_the_file_calls_it():
    one, two = weigh_units(scene_of(pipes()), 1.0), weigh_units(scene_of(pipes()), 0.001)
    assert one.scores["m"] == pytest.approx(two.scores["mm"])
    assert one.hits["m"] == two.hits["mm"] == len(OUTER)
    assert weigh_units(scene_of([shapes.box()]), 1.0).n_diameters == 0


def test_scenes_of_shared_shapes_are_scaled_and_turned_as_others():
    arrays = MeshArrays.of([shapes.box((2.0, 1.0, 0.5))])
    placement = Placement(np.zeros(2, int), np.tile(np.eye(3), (2, 1, 1)), np.array([[0.0, 0, 0], [5, 6, 7]]))
    shared = Scene(
        arrays, ("/a", "/b"), np.full((2, 3), np.nan, np.float32), Source(meters_per_unit=1.0), placement=placement
    )
    plain = shared.with_vertices(shared.vertices)
    config = LoadConfig(unit="mm", up="Y")
    one, two = finish(shared, config, FILE), finish(plain, config, FILE)
    np.testing.assert_allclose(one.vertices, two.vertices, atol=1e-15)
    np.testing.assert_allclose(one.mesh(1)[0].mean(axis=0), [0.005, -0.007, 0.006], atol=1e-12)  # Y is up now


def test_the_extent_of_turned_shapes_is_that_of_their_vertices():
    turns = Rotation.random(40, rng=5).as_matrix()
    shift = np.random.default_rng(6).uniform(-2, 2, (40, 3))
    arrays = MeshArrays.of([shapes.box((2.0, 1.0, 0.5)), shapes.cylinder(0.3, 2.0)])
    scene = Scene(
        arrays,
        tuple(f"/m_{i:02}" for i in range(40)),
        np.full((40, 3), np.nan, np.float32),
        Source(meters_per_unit=1.0),
        placement=Placement(np.arange(40) % 2, turns, shift),
    )
    largest = np.ptp(scene.with_vertices(scene.vertices).vertices, axis=0).max()
    assert weigh_units(scene, 1.0).largest == pytest.approx(largest, rel=1e-12)


def test_the_up_axis_of_a_file_without_one_is_that_it_lies_on():
    flat = shapes.box((8.0, 1.0, 6.0))
    found = finish(scene_of([flat], up_stated=False), LoadConfig(), FILE)
    assert codes(found) == ["missing-up-axis"]
    assert found.source.up_axis == "Y"
    np.testing.assert_allclose(np.ptp(found.vertices, axis=0), [8.0, 6.0, 1.0])
    tall = finish(scene_of([shapes.box((2.0, 3.0, 2.5))], up_stated=False), LoadConfig(), FILE)
    assert tall.source.up_axis == "Z"
    assert codes(finish(scene_of([flat], up_stated=False), LoadConfig(up="Z"), FILE)) == []


def test_a_bag_is_split_and_said_so():
    whole = scene_of([bag(pipes())], format="stl")
    found = finish(whole, LoadConfig(), FILE)
    assert found.n_meshes == 6
    assert found.paths[0] == "/mesh_0/solid_1"
    assert set(found.anchors) == {"/mesh_0"}
    assert codes(found) == ["split-mesh"]
    assert "6 separate surfaces" in found.diagnostics[0].message
    np.testing.assert_allclose(sorted(len(found.mesh(i)[1]) for i in range(6)), sorted(len(f) for _, f in pipes()))
    assert finish(whole, LoadConfig(split=False), FILE).n_meshes == 1


def plant_of(n, apart=1.0):
    """Pipes of three diameters, upright in a row."""
    return [moved(shapes.tube(0.1 + 0.05 * (k % 3), 0.09, 2.0), (apart * k, 0, 0)) for k in range(n)]


def test_a_format_that_keeps_parts_apart_is_split_only_where_a_mesh_is_a_plant():
    few = scene_of([bag(pipes())], format="usd")
    assert finish(few, LoadConfig(), FILE).n_meshes == 1
    deck = shapes.box((3.0, 3.0, 0.1))
    found = finish(scene_of([bag(plant_of(30, 0.3)), deck], format="gltf"), LoadConfig(), FILE)
    assert found.n_meshes == 31
    assert "/mesh_1" in found.paths
    boxes = [moved(shapes.box((0.1, 0.1, 0.1)), (0.3 * k, 0, 0)) for k in range(30)]
    assert finish(scene_of([bag(boxes), deck], format="gltf"), LoadConfig(), FILE).n_meshes == 2
    lamp = [(v * 0.01, f) for v, f in plant_of(30, 0.3)]
    assert finish(scene_of([bag(lamp)], format="gltf"), LoadConfig(), FILE).n_meshes == 1


def test_meshes_of_one_material_each_are_split_and_things_of_many_pieces_are_not():
    pillars = bag([moved(shapes.box((0.1, 0.1, 3.0)), (2 * k, 5, 0)) for k in range(12)])
    alone = shapes.box((1.0, 1.0, 0.2))
    found = finish(scene_of([pillars, bag(plant_of(12)), alone], format="gltf"), LoadConfig(), FILE)
    assert found.n_meshes == 25
    assert codes(found) == ["split-mesh", "split-mesh"]
    railing = bag([*plant_of(12), shapes.box((12.0, 0.05, 0.05), (5.5, 0.0, 0.5))])
    assert finish(scene_of([railing, alone], format="gltf"), LoadConfig(), FILE).n_meshes == 2


def test_scans_and_loose_triangles_stay_whole():
    rough = shapes.sphere(sides=64, rings=48)
    found = finish(scene_of([rough], format="stl"), LoadConfig(), FILE)
    assert (found.n_meshes, codes(found)) == (1, ["one-surface"])
    scraps = [moved(shapes.box((0.01, 0.01, 0.01)), (k, 9, 9)) for k in range(30)]
    assert finish(scene_of([bag([rough, *scraps])], format="stl"), LoadConfig(), FILE).n_meshes == 1
    vertices, faces = rough
    soup = vertices[faces] * 0.9 + 0.1 * vertices[faces].mean(axis=1, keepdims=True)
    loose = soup.reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)
    assert finish(scene_of([loose], format="stl"), LoadConfig(), FILE).n_meshes == 1


def two_boxes_on_an_edge():
    """Two boxes that share a whole edge, point by point the same."""
    one, two = shapes.box((1.0, 1.0, 1.0)), moved(shapes.box((1.0, 1.0, 1.0)), (1, 1, 0))
    points, faces = bag([one, two])
    _, first, place = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    return points[first], place.reshape(-1)[faces].astype(np.int32)


@pytest.mark.parametrize("interleaved", [False, True])
def test_solids_that_touch_along_an_edge_are_told_apart(interleaved):
    points, faces = two_boxes_on_an_edge()
    owner = np.repeat([0, 1], 12)
    if interleaved:
        order = np.arange(24).reshape(2, 12).T.reshape(-1)
        faces, owner = faces[order], owner[order]
    found = split_shells(points, faces)
    assert [set(owner[triangles].tolist()) for triangles in found] in ([{0}, {1}], [{1}, {0}])
    assert [len(triangles) for triangles in found] == [12, 12]


def test_a_void_stays_with_its_solid_however_the_file_faces():
    outer, inner = shapes.box((2.0, 2.0, 2.0)), shapes.box((1.0, 1.0, 1.0))
    hollow = bag([outer, (inner[0], inner[1][:, ::-1]), moved(shapes.box(), (5, 0, 0)), moved(shapes.box(), (8, 0, 0))])
    for faces in (hollow[1], hollow[1][:, ::-1]):
        assert sorted(len(t) for t in split_shells(hollow[0], faces.astype(np.int32))) == [12, 12, 24]


def test_nothing_is_done_to_an_empty_scene():
    empty = scene_of([])
    assert finish(empty, LoadConfig(), FILE) is empty


def test_millimetres_of_a_national_grid_are_not_too_far(tmp_path):
    file = tmp_path / "far.obj"
    points = [(5e8, 5.4e9, 0), (5e8 + 100, 5.4e9, 0), (5e8, 5.4e9 + 100, 0), (5e8, 5.4e9, 100)]
    text = (
        "o valve\n"
        + "".join(f"v {x:.1f} {y:.1f} {z:.1f}\n" for x, y, z in points)
        + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    )
    file.write_text(text)
    scene = load(file, LoadConfig(isolate=False, unit="mm"))
    assert np.linalg.norm(scene.origin) == pytest.approx(5.42e6, rel=1e-2)
    assert {note.code for note in scene.diagnostics} == {"missing-up-axis"}
    with pytest.raises(LoadError, match="all of it lies farther out than a million kilometres, one unit being 1 m"):
        load(file, LoadConfig(isolate=False, unit="m"))
    near = "".join(f"v {x} {y} {z}\n" for x, y, z in [(0, 0, 0), (100, 0, 0), (0, 100, 0), (0, 0, 100)])
    file.write_text(f"{text}o other\n{near}f 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n")
    scene = load(file, LoadConfig(isolate=False, unit="m"))
    assert scene.paths == ("/other",)
    assert "too-far" in {note.code for note in scene.diagnostics}
