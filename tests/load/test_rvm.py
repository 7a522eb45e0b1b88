"""RVM files to scenes: small ones written here, and real ones where a collection of them is present."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.losses import LOST_GEOMETRY
from rvm_files import SIZES, Rvm, cube, placed, turned

IN_PROCESS = LoadConfig(isolate=False)
FINE = LoadConfig(isolate=False, max_gap=1e-5, max_angle=0.05)
PI = np.pi

# Of each kind: sizes [mm, rad] and the volume that they mean [mm3].
SOLIDS = {
    "pyramid": (1, (40, 30, 20, 10, 5, -4, 60), 60 / 6 * (40 * 30 + 20 * 10 + (40 + 20) * (30 + 10))),
    "wedge": (1, (40, 30, 40, 0, 0, 0, 60), 40 * 30 * 60 / 2),
    "wedge, upside down": (1, (0, 30, 40, 30, 0, 0, 60), 40 * 30 * 60 / 2),
    "pointed pyramid": (1, (40, 30, 0, 0, 0, 0, 60), 40 * 30 * 60 / 3),
    "box": (2, (10, 20, 30), 6000),
    "rectangular torus": (3, (50, 80, 20, PI / 2), (80**2 - 50**2) * PI / 4 * 20),
    "rectangular ring": (3, (50, 80, 20, 2 * PI), (80**2 - 50**2) * PI * 20),
    "slice of cake": (3, (0, 80, 20, 1.0), 80**2 / 2 * 20),
    "cake": (3, (0, 80, 20, 2 * PI), 80**2 * PI * 20),
    "bend": (4, (152, 57, PI / 2), PI / 2 * 152 * PI * 57**2),
    "bend to the right": (4, (152, 57, -PI / 2), PI / 2 * 152 * PI * 57**2),
    "ring": (4, (152, 57, 2 * PI), 2 * PI * 152 * PI * 57**2),
    "elliptical dish": (5, (100, 40), 2 / 3 * PI * 100**2 * 40),
    "spherical dish": (6, (100, 40), PI * 40 / 6 * (3 * 100**2 + 40**2)),
    "deep spherical dish": (6, (100, 150), PI * 150 / 6 * (3 * 100**2 + 150**2)),
    "cone": (7, (50, 0, 120, 0, 0, 0, 0, 0, 0), PI * 50**2 * 120 / 3),
    "cone, upside down": (7, (0, 50, 120, 10, 0, 0, 0, 0, 0), PI * 50**2 * 120 / 3),
    "eccentric reducer": (7, (80, 50, 120, 30, 0, 0, 0, 0, 0), PI * 120 / 3 * (80**2 + 80 * 50 + 50**2)),
    "mitre": (7, (50, 50, 120, 0, 0, 0.3, -0.2, 0.1, 0.4), PI * 50**2 * 120),
    "cylinder": (8, (50, 200), PI * 50**2 * 200),
    "sphere": (9, (100,), PI * 100**3 / 6),
    "facet group": (11, (cube((0, 0, 0), (10, 20, 30)),), 6000),
    "facet group with a hole": (11, (cube((0, 0, 0), (40, 40, 30), hole=True),), 40 * 40 * 30 * 0.75),
}


def one(*primitives, name="/P-101"):
    """The bytes of a file with one node."""
    rvm = Rvm().open(name)
    for kind, sizes in primitives:
        rvm.primitive(kind, *sizes)
    return rvm.close().end().bytes


def read(tmp_path, data, config=IN_PROCESS, name="a.rvm"):
    path = tmp_path / name
    path.write_bytes(data if isinstance(data, bytes) else data.encode("utf-8"))
    return load(path, config)


def codes(scene):
    return {note.code for note in scene.diagnostics}


def volume(scene, mesh=0):
    points, faces = scene.mesh(mesh)
    return np.linalg.det(points[faces] - points[0]).sum() / 6


def is_closed(scene, mesh):
    _, faces = scene.mesh(mesh)
    edges = Counter(tuple(edge) for face in faces.tolist() for edge in zip(face, face[1:] + face[:1], strict=True))
    return all(edges[b, a] == n for (a, b), n in edges.items())


@pytest.mark.parametrize("name", SOLIDS)
def test_primitives_are_closed_face_outward_and_hold_what_their_formula_says(tmp_path, name):
    kind, sizes, expected = SOLIDS[name]
    scene = read(tmp_path, one((kind, sizes)), FINE)
    assert is_closed(scene, 0)
    assert volume(scene) == pytest.approx(expected * 1e-9, rel=5e-3)
    # Inscribed: curved solids never hold more than they should; bends are cut into chords, which may.
    coarse = read(tmp_path, one((kind, sizes)), LoadConfig(isolate=False, max_gap=0.01, max_angle=1.0))
    assert is_closed(coarse, 0)
    assert volume(coarse) > 0.5 * expected * 1e-9


def test_finer_settings_make_more_triangles_and_gaps_keep_their_limit(tmp_path):
    data = one((8, (500, 100)))
    for gap in (0.01, 0.001, 0.0001):
        scene = read(tmp_path, data, LoadConfig(isolate=False, max_gap=gap, max_angle=1.6))
        points, _ = scene.mesh(0)
        rim = points[np.linalg.norm(points[:, :2], axis=1) > 0.4]
        sides = len(rim) // 2
        assert 0.5 * (1 - np.cos(PI / sides)) <= gap
        assert sides % 4 == 0
        assert 0.5 * (1 - np.cos(PI / (sides - 4))) > gap


def test_placements_turn_and_shift_in_metres(tmp_path):
    rvm = Rvm().open("/a").primitive(2, 1000, 2000, 3000, matrix=placed((10, 20, 30), turned(PI / 2))).close().end()
    low, high = (f(read(tmp_path, rvm.bytes).vertices, axis=0) for f in (np.min, np.max))
    np.testing.assert_allclose((low, high), ((9, 19.5, 28.5), (11, 20.5, 31.5)), atol=1e-5)


@pytest.mark.parametrize("pull", [np.diag([-1.0, 1, 1]), np.diag([2.0, 1, 1]), [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]]])
def test_mirrored_stretched_and_sheared_placements_are_kept(tmp_path, pull):
    rvm = Rvm().open("/a").primitive(8, 50, 200, matrix=placed((1, 2, 3), np.array(pull) @ turned(0.7)))
    rvm.primitive(11, cube((0, 0, 0), (10, 20, 30)), matrix=placed((1, 2, 3), pull)).close().end()
    scene = read(tmp_path, rvm.bytes, LoadConfig(isolate=False, granularity="primitive", max_angle=0.05))
    grown = abs(np.linalg.det(pull))
    assert volume(scene, 0) == pytest.approx(PI * 0.05**2 * 0.2 * grown, rel=5e-3)
    assert volume(scene, 1) == pytest.approx(6e-6 * grown, rel=1e-4)
    np.testing.assert_allclose(scene.mesh(0)[0].mean(axis=0), (1, 2, 3), atol=1e-6)


def branch():
    """A branch with a tube, a valve of two primitives, a gasket, a tube, an elbow."""
    rvm = Rvm().open("/ZONE").open("/100-B-1").open("/100-B-1/B1", material=2)
    rvm.primitive(8, 50, 1000)
    rvm.open("VALVE 1 of BRANCH /100-B-1/B1").primitive(8, 60, 200).primitive(2, 50, 50, 50).close()
    rvm.open("GASKET 1 of BRANCH /100-B-1/B1").close()
    rvm.primitive(8, 50, 500, matrix=placed((2, 0, 0)))
    rvm.open("ELBOW 1 of BRANCH /100-B-1/B1").primitive(4, 152, 50, PI / 2).close()
    return rvm.close(3).end()


B1 = "/ZONE/100-B-1/100-B-1_B1"


@pytest.mark.parametrize(
    ("granularity", "paths"),
    [
        ("auto", ["ELBOW_1", "VALVE_1", "primitive_1", "primitive_2"]),
        ("node", ["", "ELBOW_1", "VALVE_1"]),
        (
            "primitive",
            ["ELBOW_1/primitive_1", "VALVE_1/primitive_1", "VALVE_1/primitive_2", "primitive_1", "primitive_2"],
        ),
    ],
)
def test_granularity_says_what_is_one_mesh(tmp_path, granularity, paths):
    scene = read(tmp_path, branch().bytes, LoadConfig(isolate=False, granularity=granularity))
    assert list(scene.paths) == [f"{B1}/{path}".rstrip("/") for path in paths]


def test_default_names_give_classes_order_and_systems(tmp_path):
    scene = read(tmp_path, branch().bytes)
    classes = {fact.path: (fact.value, fact.where) for fact in scene.facts if fact.key == "class"}
    assert classes == {
        B1: ("BRANCH", "default name below it"),
        f"{B1}/primitive_1": ("TUBI", "primitive of a branch"),
        f"{B1}/primitive_2": ("TUBI", "primitive of a branch"),
        f"{B1}/VALVE_1": ("VALVE", "default name"),
        f"{B1}/ELBOW_1": ("ELBOW", "default name"),
    }
    order = [f"{B1}/{name}" for name in ("primitive_1", "VALVE_1", "primitive_2", "ELBOW_1")]
    assert [(link.first, link.second) for link in scene.links] == list(zip(order, order[1:], strict=False))
    assert {(link.flow, link.where) for link in scene.links} == {("forward", "order in branch")}
    assert ("name", "/100-B-1/B1") in {(fact.key, fact.value) for fact in scene.facts if fact.path == B1}


def test_primitives_between_two_members_are_one_straight_piece(tmp_path):
    rvm = Rvm().open("/B").primitive(2, 100, 4, 900).primitive(2, 4, 50, 900).primitive(2, 4, 50, 900)
    rvm.open("BEND 1 of BRANCH /B").primitive(2, 9, 9, 9).close().primitive(2, 100, 4, 900)
    rvm.open("GASKET 1 of BRANCH /B").close().primitive(2, 100, 4, 900).close().end()
    links = read(tmp_path, rvm.bytes).links
    order = ["/B/primitive_1", "/B/BEND_1", "/B/primitive_4", "/B/primitive_5"]
    assert [(link.first, link.second) for link in links] == list(zip(order, order[1:], strict=False))


def test_metadata_off_changes_nothing_but_facts_and_links(tmp_path):
    (tmp_path / "a.att").write_text(ATT, encoding="utf-8")
    kept = read(tmp_path, branch().bytes)
    off = read(tmp_path, branch().bytes, LoadConfig(isolate=False, metadata="off"))
    assert off.facts == () == off.links
    assert kept.paths == off.paths
    assert kept.facts
    np.testing.assert_array_equal(kept.vertices, off.vertices)


ATT = """CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&
NEW Header Information
  Source:= PDMS Data &end& Date:= 11 Jul 2013
END
NEW /ZONE
  Type:=  ZONE
  NEW /100-B-1
    Type:=  PIPE
    NEW /100-B-1/B1
      Type:=  BRAN
      Hbore:=  100
      Href:=  /P-101
      Tref:=  =1/2
      NEW VALVE 1 of BRANCH /100-B-1/B1
        Name:=  =1/7
        Type:=  VALV
        Spref:=  /SPEC/VALVE
        Description:=  Vanne à boisseau
        Bore:=  0
        Cref:=  Unset
      END
    END
  END
END
"""
E3D = """CADC_Attributes_File v1.0 , start: BEGIN , end: STOP , name_end: == , sep: |
BEGIN '/ZONE'
 BEGIN '/100-B-1/B1'
  TYPE== 'BRAN' | HBOR== '100' | HREF== '/P-101'
  BEGIN VALVE 1 of BRANCH /100-B-1/B1
   TYPE== 'VALV' | SPREF== '/SPEC/VALVE' | DESC== 'Vanne à boisseau'
  STOP
 STOP
STOP
"""


@pytest.mark.parametrize(
    ("text", "encoding", "name"),
    [(ATT, "utf-8", "a.att"), (ATT, "cp1252", "a.ATT"), (ATT, "utf-8-sig", "a.txt"), (E3D, "utf-8", "a.att")],
)
def test_attributes_beside_the_file_are_read_in_their_dialects(tmp_path, text, encoding, name):
    (tmp_path / name).write_bytes(text.replace("\n", "\r\n").encode(encoding))
    rvm = branch()
    rvm.data = rvm.data[: -24 - 4]
    scene = read(tmp_path, rvm.open("/EQ").open("/P-101").primitive(8, 300, 600).close(2).end().bytes)
    facts = {(fact.path, fact.key, fact.value, fact.where) for fact in scene.facts}
    assert {
        (f"{B1}/VALVE_1", "class", "VALV", "att TYPE"),
        (f"{B1}/VALVE_1", "spec", "/SPEC/VALVE", "att SPREF"),
        (B1, "class", "BRAN", "att TYPE"),
        (B1, "size", "100", "att HBOR" if text is E3D else "att HBORE"),
    } <= facts
    assert {fact.value for fact in scene.facts if fact.key == "description"} == {"Vanne à boisseau"}
    assert not any(fact.value in ("0", "Unset") for fact in scene.facts)
    assert (f"{B1}/primitive_1", "/EQ/P-101", "backward", "att HREF") in scene.links
    assert ("encoding-guessed" in codes(scene)) == (encoding == "cp1252")


def test_a_tag_is_the_name_of_a_plant_item(tmp_path):
    rvm = Rvm().open("/AREA").open("/P-101").primitive(8, 300, 600)
    rvm.open("NOZZLE 1 of EQUIPMENT /P-101").primitive(8, 50, 100).close(3).end()
    facts = read(tmp_path, rvm.bytes).facts
    assert [(f.path, f.value) for f in facts if f.key == "tag"] == [("/AREA/P-101", "P-101")]


def test_attributes_of_another_model_and_files_that_are_none_are_told(tmp_path):
    (tmp_path / "a.att").write_text(ATT.replace("/", "/X"), encoding="utf-8")
    assert "attributes-of-another" in codes(read(tmp_path, branch().bytes))
    (tmp_path / "a.att").write_text("", encoding="utf-8")
    assert codes(read(tmp_path, branch().bytes)) == {"attributes-unread"}


def test_a_text_that_is_no_attribute_file_is_left_alone(tmp_path):
    (tmp_path / "a.txt").write_text("Type:= VALV", encoding="utf-8")
    assert all(fact.where != "att TYPE" for fact in read(tmp_path, branch().bytes).facts)


def test_text_files_hold_the_same_as_binary_ones(tmp_path):
    rvm = branch()
    for name in ("facets", "END:"):
        rvm.data, rvm.lines = rvm.data[:-28], rvm.lines[:-2]
        rvm.open(f"/{name}", material=9).primitive(11, cube((0, 0, 0), (40, 40, 30), hole=True))
        rvm.primitive(7, 50, 20, 120, 30, 5, 0.1, 0, 0, 0, matrix=placed((1, 2, 3), turned(0.4) @ turned(1.1, 0)))
        rvm.close().color(9, (255, 0, 0)).end()
    binary = read(tmp_path, rvm.bytes)
    text = read(tmp_path, rvm.text, name="b.rev")
    also = read(tmp_path, rvm.text, name="c.rvm")
    assert codes(text) == codes(binary) == set()
    assert binary.paths == text.paths == also.paths
    assert (binary.facts, binary.links) == (text.facts, text.links)
    assert text.source.metadata == binary.source.metadata
    np.testing.assert_array_equal(binary.faces, text.faces)
    np.testing.assert_array_equal(binary.colors, text.colors)
    np.testing.assert_allclose(binary.vertices, text.vertices, atol=2e-5)


def test_placements_that_a_text_rounds_become_rotations_again(tmp_path):
    rvm = Rvm().open("/a").primitive(8, 50, 2000, matrix=placed((1, 2, 3), turned(0.4) @ turned(1.1, 0))).close().end()
    rounded = [
        "".join(f"{float(x):14.5f}" for x in line.split()) if line.count(".") == 4 else line for line in rvm.lines
    ]
    scene = read(tmp_path, "\n".join(rounded), name="a.rev")
    axis = np.ptp(scene.vertices, axis=0)
    assert np.linalg.norm(axis) == pytest.approx(
        np.linalg.norm(np.ptp(read(tmp_path, rvm.bytes).vertices, 0)), rel=0.01
    )
    assert volume(scene) == pytest.approx(volume(read(tmp_path, rvm.bytes)), rel=1e-6)


def test_colours_are_those_listed_even_after_the_bodies_or_the_usual_ones(tmp_path):
    rvm = Rvm().open("/a", material=2).primitive(2, 1, 1, 1).close().open("/b", material=7).primitive(2, 1, 1, 1)
    rvm.close().open("/c", material=100_000).primitive(2, 1, 1, 1).close().color(7, (255, 0, 128)).end()
    colors = read(tmp_path, rvm.bytes).colors
    np.testing.assert_allclose(colors[0], (0.6038, 0, 0), atol=1e-3)
    np.testing.assert_allclose(colors[1], (1, 0, 0.2158), atol=1e-3)
    assert np.isnan(colors[2]).all()


def test_insulation_is_left_out_unless_asked_for(tmp_path):
    rvm = Rvm().open("/a").primitive(8, 50, 100).primitive(8, 70, 100, tag="INSU")
    rvm.primitive(11, cube((0, 0, 0), (10, 20, 30)), tag="OBST").close().end()
    config = {"isolate": False, "granularity": "primitive"}
    without = read(tmp_path, rvm.bytes, LoadConfig(**config))
    assert without.n_meshes == 1
    assert [note.message.split(";")[0] for note in without.diagnostics] == [
        "left out: 1 insulation volumes",
        "left out: 1 obstruction volumes",
    ]
    for data, name in ((rvm.bytes, "a.rvm"), (rvm.text, "a.rev")):
        scene = read(tmp_path, data, LoadConfig(insulation=True, max_angle=0.05, **config), name)
        assert scene.paths == ("/a/primitive_1", "/a/primitive_2", "/a/primitive_3")
        assert volume(scene, 1) == pytest.approx(PI * 0.07**2 * 0.1, rel=5e-3)
        assert volume(scene, 2) == pytest.approx(6e-6, rel=1e-5)


def test_the_extra_word_of_volumes_is_found_before_the_matrix_too(tmp_path):
    rvm = Rvm().open("/a")
    matrix = placed((1, 2, 3), turned(0.3))
    rvm.chunk("INSU", [1, 8, 50 << 24, *map(float, matrix), *[0.0] * 6, 70.0, 100.0])
    scene = read(tmp_path, rvm.close().end().bytes, LoadConfig(isolate=False, insulation=True, max_angle=0.05))
    assert volume(scene) == pytest.approx(PI * 0.07**2 * 0.1, rel=5e-3)


def test_lines_flat_solids_frames_and_welds_are_left_out_with_a_note(tmp_path):
    rvm = Rvm().open("/B").primitive(8, 50, 100).primitive(10, 0, 100).primitive(2, 10, 10, 0)
    rvm.primitive(2, 10, 10, 0.002)
    for word in ("WELD", "DRAWING"):
        rvm.open(f"{word} 1 of BRANCH /B").primitive(2, 10, 10, 10).close()
    scene = read(tmp_path, rvm.close().end().bytes)
    assert scene.paths == ("/B/primitive_1", "/B/primitive_4")
    assert codes(scene) == {"left-out-lines", "flat-primitive", "left-out-type"}
    (note,) = (note for note in scene.diagnostics if note.code == "left-out-type")
    assert note.meshes == ("/B/DRAWING_1", "/B/WELD_1")
    # Nothing of the plant is lost with them.
    assert "left-out-type" not in LOST_GEOMETRY


@pytest.mark.parametrize("kind", sorted(SIZES.keys() - {10}))
def test_primitives_without_any_size_are_left_out(tmp_path, kind):
    scene = read(tmp_path, one((2, (10, 20, 30)), (kind, (0,) * SIZES[kind])))
    assert volume(scene) == pytest.approx(6e-6)
    assert codes(scene) == {"flat-primitive"}


def test_equal_names_and_odd_ones_still_make_unique_paths(tmp_path):
    rvm = Rvm()
    for name in ("/a", "/a", '/6"-P11/x', "//", "", "/b\n/é"):
        rvm.open(name).primitive(2, 1, 1, 1).close()
    assert set(read(tmp_path, rvm.end().bytes).paths) == {"/a", "/a_1", "/6_-P11_x", "/node", "/node_1", "/b_é"}


def test_facets_with_wrong_normals_close_as_they_are_wound(tmp_path):
    wrong = [
        [[(point, tuple(-x for x in normal)) for point, normal in ring] for ring in p] for p in cube((0,) * 3, (9,) * 3)
    ]
    mixed = [*wrong[:2], *cube((0,) * 3, (9,) * 3)[2:]]
    scene = read(tmp_path, one((11, (mixed,))))
    assert is_closed(scene, 0)
    assert volume(scene) == pytest.approx(729e-9, rel=1e-4)


def test_facets_wound_anyhow_are_turned_by_their_normals(tmp_path):
    right = cube((0,) * 3, (9,) * 3)
    mixed = [[list(reversed(ring)) for ring in p] if i % 2 else p for i, p in enumerate(right)]
    scene = read(tmp_path, one((11, (mixed,))))
    assert is_closed(scene, 0)
    assert volume(scene) == pytest.approx(729e-9, rel=1e-4)


def test_too_many_triangles_make_curves_coarser_with_a_note(tmp_path):
    data = one(*[(9, (2000 + i,)) for i in range(20)])
    full = read(tmp_path, data)
    assert full.n_triangles > 20_000
    scene = read(tmp_path, data, LoadConfig(isolate=False, max_triangles=20_000))
    assert scene.n_triangles <= 20_000
    assert codes(scene) == {"coarsened"}
    least = read(tmp_path, data, LoadConfig(isolate=False, max_triangles=1000, max_angle=1.6))
    assert any("still more" in note.message for note in least.diagnostics) == (least.n_triangles > 1000)


def damaged_float(rvm, value):
    data = bytearray(rvm)
    at = data.index(np.array([50, 200], ">f4").tobytes())
    data[at : at + 4] = np.array([value], ">f4").tobytes()
    return bytes(data)


@pytest.mark.parametrize("value", [np.inf, np.nan, 1e30])
def test_a_broken_primitive_costs_itself_alone(tmp_path, value):
    data = damaged_float(one((2, (10, 20, 30)), (8, (50, 200)), (2, (10, 20, 30))), value)
    scene = read(tmp_path, data)
    assert volume(scene) == pytest.approx(2 * 6e-6)
    (note,) = scene.diagnostics
    assert (note.code, note.meshes) == ("broken-primitive", ("/P-101",))


def test_infinite_placements_unknown_kinds_and_short_chunks_are_noted(tmp_path):
    rvm = Rvm().open("/a").primitive(2, 10, 20, 30).primitive(2, 1, 1, 1, matrix=placed((np.inf, 0, 0)))
    rvm.primitive(12, 1, 1).primitive(8, 1).primitive(2, 1, 1, 1, matrix=placed(turn=np.zeros((3, 3))))
    rvm.chunk("PRIM", [1, 2])
    rvm.chunk("WXYZ", [1])
    rvm.primitive(11, cube((0, 0, 0), (1, 1, 1))[:0]).close().end()
    scene = read(tmp_path, rvm.bytes)
    assert scene.n_meshes == 1
    assert codes(scene) == {"broken-primitive", "invalid-transform", "unknown-chunk", "empty-mesh"}


@pytest.mark.parametrize("count", [7, 1 << 20, (1 << 32) - 1])
def test_counts_of_facets_beyond_their_chunk_are_noted(tmp_path, count):
    good = one((11, (cube((0, 0, 0), (10, 20, 30)),)), (2, (10, 20, 30)))
    at = good.index(np.array([6, 1, 4], ">u4").tobytes())
    for word in range(3):
        data = bytearray(good)
        data[at + 4 * word : at + 4 * word + 4] = count.to_bytes(4, "big")
        scene = read(tmp_path, bytes(data))
        assert codes(scene) == {"broken-primitive"}
        assert volume(scene) == pytest.approx(6e-6)


def test_a_broken_link_costs_no_more_than_its_chunk(tmp_path):
    rvm = Rvm().open("/a").primitive(2, 10, 20, 30)
    at = len(rvm.data)
    rvm.primitive(2, 10, 20, 30).primitive(2, 10, 20, 30).close().end()
    for wrong in (0, 3, at, len(rvm.data) + 4, 0xFFFFFFFC):
        data = bytearray(rvm.bytes)
        data[at + 16 : at + 20] = wrong.to_bytes(4, "big")
        scene = read(tmp_path, bytes(data))
        assert volume(scene) == pytest.approx(3 * 6e-6)
        assert codes(scene) == {"broken-link"}


def test_one_end_of_a_node_too_many_or_too_few_is_noted(tmp_path):
    surplus = Rvm().open("/a").primitive(2, 1, 1, 1).close(2).open("/b").primitive(2, 1, 1, 1).close().end()
    scene = read(tmp_path, surplus.bytes)
    assert (scene.paths, codes(scene)) == (("/a", "/b"), {"unbalanced-tree"})
    lacking = Rvm().open("/a").open("/b").primitive(2, 1, 1, 1).close().end()
    scene = read(tmp_path, lacking.bytes)
    assert (scene.paths, codes(scene)) == (("/a/b",), {"unbalanced-tree"})


def test_a_cut_file_says_so(tmp_path):
    data = branch().bytes
    scene = read(tmp_path, data[: data.index(b"\0\0\0V\0\0\0A") if b"\0\0\0V\0\0\0A" in data else len(data) // 2])
    assert "cut-short" in codes(scene)


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"\0\0\0X" * 40, "no RVM file"),
        (b"solid of something else", "no RVM file"),
        (b"HEAD\n     1     1\n", "holds no primitive"),
        (Rvm().end().bytes, "holds no primitive"),
        (Rvm().open("/a").primitive(10, 0, 100).close().end().bytes, "holds no primitive"),
    ],
)
def test_what_is_no_model_ends_in_one_clear_line(tmp_path, data, why):
    with pytest.raises(LoadError, match=why) as error:
        read(tmp_path, data)
    assert "\n" not in str(error.value)


def test_deep_trees_and_endless_names_end_in_one_line(tmp_path):
    rvm = Rvm()
    for _ in range(600):
        rvm.open("/a")
    with pytest.raises(LoadError, match="deeper than 500"):
        read(tmp_path, rvm.primitive(2, 1, 1, 1).close(600).end().bytes)
    rvm = Rvm().open("/" + "x" * 600_000)
    for i in range(1000):
        rvm.open(f"/{i}").close()
    with pytest.raises(LoadError, match="beyond all measure"):
        read(tmp_path, rvm.primitive(2, 1, 1, 1).close().end().bytes)


def test_many_nodes_of_one_name_take_no_longer(tmp_path):
    rvm = Rvm()
    for _ in range(3000):
        rvm.open("/a").primitive(2, 1, 1, 1).close()
    assert read(tmp_path, rvm.end().bytes).n_meshes == 3000


def test_random_damage_ends_in_a_scene_or_one_line(tmp_path):
    data = np.frombuffer(branch().bytes, np.uint8)
    rng = np.random.default_rng(3)
    ends = Counter()
    for i in range(150):
        copy = data.copy()
        at = int(rng.integers(0, len(data)))
        if i % 3 == 0:
            copy = copy[:at]
        elif i % 3 == 1:
            copy[rng.integers(0, len(data), 10)] = rng.integers(0, 256, 10)
        else:
            copy[at : at + 64] = 0
        if not len(copy):
            continue
        try:
            assert np.isfinite(read(tmp_path, copy.tobytes()).vertices).all()
            ends["scene"] += 1
        except LoadError as error:
            ends["several lines" if "\n" in str(error) else "error"] += 1
    assert ends["scene"] > 75
    assert ends["error"] > 5
    assert set(ends) == {"scene", "error"}


def test_reading_twice_gives_the_same_bytes(tmp_path):
    first, second = (read(tmp_path, branch().bytes) for _ in range(2))
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert (first.paths, first.facts, first.links) == (second.paths, second.facts, second.links)


def test_an_isolated_process_reads_the_same(tmp_path):
    here, there = read(tmp_path, branch().bytes), read(tmp_path, branch().bytes, LoadConfig())
    assert here.vertices.tobytes() == there.vertices.tobytes()
    assert (here.paths, here.facts, here.links) == (there.paths, there.facts, there.links)
