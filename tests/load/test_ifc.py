from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("ifcopenshell")

import ifcopenshell

import ifc_files
import shapes
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.ifc.entities import clean, of_type
from cadgraph.load.ifc.facts import _is_tag
from cadgraph.load.ifc.shapes import shape_products
from cadgraph.load.ifc.tree import plant_tree
from cadgraph.load.packing import Notes

IN_PROCESS = LoadConfig(isolate=False)
SHARED = Path(__file__).parents[2] / "../shared/data"
SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")


def loaded(plant, folder, **settings):
    return load(plant.write(folder / "plant.ifc"), LoadConfig(isolate=False, **settings))


def error_of(path):
    with pytest.raises(LoadError) as caught:
        load(path, IN_PROCESS)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(str(path))
    return str(caught.value)


def codes(scene):
    return {note.code: note for note in scene.diagnostics}


def last(path):
    return path.rpartition("/")[2]


def facts_of(scene, path):
    return {(fact.key, fact.value, fact.where) for fact in scene.facts if fact.path == path}


def path_named(scene, name):
    return next(fact.path for fact in scene.facts if fact.key == "name" and fact.value == name)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_products_are_meshes_in_metres(tmp_path, schema):
    scene = loaded(ifc_files.pump_line(schema), tmp_path)
    assert scene.n_meshes == 5
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), (2.2, 0.3, 0.3), rtol=2e-3)
    assert scene.source.format == "ifc"
    assert (scene.source.meters_per_unit, scene.source.unit_stated, scene.source.up_axis) == (0.001, True, "Z")
    assert {path.rpartition("/")[0] for path in scene.paths} == {"/Test_plant/Works/Pump_hall_1"}
    valve = path_named(scene, "Valve 500")
    vertices, faces = scene.mesh(scene.paths.index(valve))
    np.testing.assert_allclose(vertices.min(axis=0), (0.5, -0.08, -0.08), atol=1e-3)
    assert np.linalg.det(vertices[faces]).sum() / 6 == pytest.approx(np.pi * 0.08**2 * 0.2, rel=0.03)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_what_an_element_says_of_itself_and_by_its_type(tmp_path, schema):
    scene = loaded(ifc_files.pump_line(schema), tmp_path)
    valve = facts_of(scene, path_named(scene, "Valve 500"))
    assert {("predefined", "CHECK", "IfcValveType.PredefinedType"), ("type", "Gate valve DN100", "IfcValveType.Name"),
            ("spec", "VGFL", "Isogen.SKEY")} <= valve  # fmt: skip
    assert {(key, value) for key, value, _ in valve} >= {
        ("class", "IfcValve"), ("tag", "V-12"), ("system", "Feed water"), ("name", "Valve 500"),
    }  # fmt: skip
    pump = {(key, value) for key, value, _ in facts_of(scene, path_named(scene, "P-101"))}
    # A type that is user-defined gives its words, not the enumeration; a number is no tag.
    assert pump == {
        ("class", "IfcPump"), ("type", "Pump 7"), ("type", "Feed pump"), ("name", "P-101"), ("tag", "P-101"),
        ("description", "Feed"), ("system", "Feed water"),
    }  # fmt: skip
    assert ("size", "100") in {(key, value) for key, value, _ in facts_of(scene, path_named(scene, "Pipe"))}


def test_before_ifc4_the_class_is_that_of_the_type(tmp_path):
    scene = loaded(ifc_files.pump_line("IFC2X3"), tmp_path)
    pipe = path_named(scene, "Pipe")
    assert last(pipe).startswith("IfcFlowSegment_")
    assert ("class", "IfcPipeSegment", "IfcPipeSegmentType") in facts_of(scene, pipe)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_connected_ports_are_links_with_their_flow(tmp_path, schema):
    scene = loaded(ifc_files.pump_line(schema), tmp_path)
    names = {fact.path: fact.value for fact in scene.facts if fact.key == "name"}
    flows = set()
    for link in scene.links:
        assert link.where == "IfcRelConnectsPorts"
        ends = [names.get(link.first, "last"), names.get(link.second, "last")]
        ends = ends[::-1] if link.flow == "backward" else ends
        flows.add((*ends, link.flow != "unknown") if link.flow != "unknown" else (*sorted(ends), False))
    # The gasket between the valves has no shape, and is passed over.
    assert flows == {
        ("P-101", "Pipe", True), ("Pipe", "Valve 500", True), ("Valve 500", "Valve 700", True),
        ("Valve 700", "last", False),
    }  # fmt: skip
    assert {end for link in scene.links for end in (link.first, link.second)} <= set(scene.paths)
    assert "open-link" not in codes(scene)


def test_links_of_an_element_without_a_shape_that_ends_a_line_are_noted(tmp_path):
    plant = ifc_files.IfcPlant()
    pipe, bare = plant.pipe(0), plant.element("IfcTank", Name="not drawn")
    plant.connect(pipe, bare)
    scene = loaded(plant, tmp_path)
    assert scene.links == ()
    assert [last(path)[:8] for path in codes(scene)["open-link"].meshes] == ["IfcTank_"]


def test_links_stated_twice_or_both_ways_are_one(tmp_path):
    plant = ifc_files.IfcPlant()
    pipes = [plant.pipe(1000 * i, Name=f"pipe {i}") for i in range(3)]
    plant.connect(pipes[0], pipes[1])
    plant.connect(pipes[0], pipes[1])
    plant.connect(pipes[1], pipes[2])
    plant.connect(pipes[2], pipes[1])
    scene = loaded(plant, tmp_path)
    paths = [path_named(scene, f"pipe {i}") for i in range(3)]
    assert {frozenset((link.first, link.second)): link.flow != "unknown" for link in scene.links} == {
        frozenset(paths[:2]): True, frozenset(paths[1:]): False,
    }  # fmt: skip


def test_what_is_not_built_is_left_out_and_told(tmp_path):
    scene = loaded(ifc_files.storehouse(), tmp_path)
    assert sorted({last(path).partition("_")[0] for path in scene.paths}) == [
        "IfcBeam", "IfcBuildingElementProxy", "IfcTank", "IfcWall",
    ]  # fmt: skip
    notes = codes(scene)
    assert notes["not-built"].meshes == ("/Test_plant/Works/Pump_hall_1/Room_1",)
    assert [last(path).partition("_")[0] for path in notes["no-surface"].meshes] == ["IfcPipeSegment"]
    assert [last(path).partition("_")[0] for path in notes["no-geometry"].meshes] == ["IfcPipeFitting"]
    # The opening is cut out of the wall: pi (1 - 0.25) * 0.2 m3.
    vertices, faces = scene.mesh(next(i for i, path in enumerate(scene.paths) if "IfcWall" in path))
    assert np.linalg.det(vertices[faces]).sum() / 6 == pytest.approx(np.pi * 0.75 * 0.2, rel=0.01)


def test_members_stand_below_their_assembly_which_has_facts_of_its_own(tmp_path):
    scene = loaded(ifc_files.storehouse(), tmp_path)
    above = {path.rpartition("/")[0] for path in scene.paths if "IfcBeam" in path}
    assert len(above) == 1
    (frame,) = above
    assert last(frame).startswith("IfcElementAssembly_")
    assert {("tag", "FR-12", "IfcElementAssembly.Name"), ("class", "IfcElementAssembly", "IfcElementAssembly")} <= (
        facts_of(scene, frame)
    )
    # HEA-200 is a profile, no tag.
    assert not any(fact.key == "tag" and "IfcBeam" in fact.path for fact in scene.facts)


def test_elements_joined_directly_are_links_but_not_beams(tmp_path):
    scene = loaded(ifc_files.storehouse(), tmp_path)
    (link,) = scene.links
    assert link.where == "IfcRelConnectsElements"
    assert {last(end).partition("_")[0] for end in link[:2]} == {"IfcTank", "IfcBuildingElementProxy"}


def test_metadata_off_leaves_facts_and_links_and_the_same_geometry(tmp_path):
    kept = loaded(ifc_files.pump_line(), tmp_path)
    off = loaded(ifc_files.pump_line(), tmp_path, metadata="off")
    assert off.facts == off.links == off.source.metadata == ()
    assert off.paths == kept.paths
    assert off.vertices.tobytes() == kept.vertices.tobytes()


def test_georeference_is_told_but_not_in_the_points(tmp_path):
    scene = loaded(ifc_files.pump_line(), tmp_path)
    said = dict(scene.source.metadata)
    assert (said["crs"], said["eastings"], said["northings"]) == ("EPSG:25832", "500000", "5400000")
    assert (said["schema"], said["project"]) == ("IFC4", "Test plant")
    assert not scene.origin.any()
    assert np.abs(scene.vertices).max() < 3


def test_colours_of_styles_are_linear_and_others_unknown(tmp_path):
    scene = loaded(ifc_files.pump_line(), tmp_path)
    known = ~np.isnan(scene.colors).any(axis=1)
    assert known.sum() == 1
    np.testing.assert_allclose(scene.colors[known][0], (1, 0.21404, 0), atol=1e-4)


def test_products_of_one_shape_share_its_arrays(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    notes = Notes()
    model = ifcopenshell.open(str(file))
    pieces = shape_products(model, plant_tree(model, notes), IN_PROCESS, notes)
    valves = [piece for piece in pieces if "IfcValve" in piece.path]
    assert len(valves) == 2
    assert valves[0].points is valves[1].points
    assert valves[0].faces is valves[1].faces


def test_a_shape_that_is_listed_twice_is_one_mesh(tmp_path):
    plant = ifc_files.IfcPlant()
    body = plant.body(plant.cylinder(50, 500))
    pipe = plant.element("IfcPipeSegment", body)
    pipe.Representation.Representations = [body, body]
    plant.pipe(600)
    scene = loaded(plant, tmp_path)
    assert scene.n_meshes == 2
    assert len(codes(scene)["listed-twice"].meshes) == 1


def test_the_body_counts_and_not_the_clearance_around_it(tmp_path):
    plant = ifc_files.IfcPlant()
    clearance = plant.body(plant.cylinder(900, 900), name="Clearance")
    plant.element("IfcPipeSegment", clearance, plant.body(plant.cylinder(50, 500)))
    plant.element("IfcTank", clearance)
    scene = loaded(plant, tmp_path)
    assert scene.n_meshes == 1
    assert np.ptp(scene.vertices, axis=0).max() == pytest.approx(0.5)
    assert [last(path)[:8] for path in codes(scene)["no-surface"].meshes] == ["IfcTank_"]


def test_a_shape_that_cannot_be_made_is_named(tmp_path):
    plant = ifc_files.IfcPlant()
    plant.pipe(0)
    plant.element("IfcPipeSegment", plant.body(plant.cylinder(50, 0)))
    scene = loaded(plant, tmp_path)
    assert scene.n_meshes == 1
    assert len(codes(scene)["unreadable"].meshes) == 1


def test_triangles_that_the_file_holds_are_kept_as_they_are(tmp_path):
    plant = ifc_files.IfcPlant(unit="")
    vertices, faces = shapes.tube(sides=9)
    points = plant.file.create_entity("IfcCartesianPointList3D", vertices.tolist())
    held = plant.file.create_entity(
        "IfcTriangulatedFaceSet", Coordinates=points, CoordIndex=(faces + 1).tolist(), Closed=True
    )
    upright = {"along": (0, 0, 1)}
    plant.element("IfcPipeSegment", plant.body(held, kind="Tessellation"), **upright)
    shared = plant.shape_map(held)
    for x in (3, 6):
        plant.element("IfcPipeSegment", plant.mapped(shared), at=(x, 0, 0), **upright)
    plant.element("IfcPipeSegment", plant.body(plant.cylinder(1, 7)), at=(9, 0, 0))
    scene = loaded(plant, tmp_path)
    meshes = [scene.mesh(i) for i in range(scene.n_meshes)]
    held_ones = sorted((v for v, f in meshes if len(f) == len(faces)), key=lambda v: v[:, 0].min())
    assert (len(meshes), len(held_ones)) == (4, 3)
    for found, x in zip(held_ones, (0, 3, 6), strict=True):
        assert sorted(np.round(found - [x, 0, 0], 6).tolist()) == sorted(np.round(vertices, 6).tolist())


@pytest.mark.parametrize(("unit", "metres"), [("", 1.0), ("CENTI", 0.01)])
def test_units(tmp_path, unit, metres):
    plant = ifc_files.IfcPlant(unit=unit)
    plant.element("IfcPipeSegment", plant.body(plant.cylinder(1, 7)))
    scene = loaded(plant, tmp_path)
    assert (scene.source.meters_per_unit, scene.source.unit_stated) == (metres, True)
    assert np.ptp(scene.vertices, axis=0).max() == pytest.approx(7 * metres)


def test_a_file_without_a_unit_needs_one(tmp_path):
    plant = ifc_files.IfcPlant(unit=None)
    plant.element("IfcPipeSegment", plant.body(plant.cylinder(1, 7)))
    with pytest.raises(LoadError, match="names no unit of length"):
        loaded(plant, tmp_path)


def test_two_elements_of_one_global_id_are_told_by_their_lines(tmp_path):
    plant = ifc_files.IfcPlant()
    first, second, third = (plant.pipe(1000 * i) for i in range(3))
    second.GlobalId = first.GlobalId
    third.GlobalId = "../../no guid"
    scene = loaded(plant, tmp_path)
    expected = {f"IfcPipeSegment_id{pipe.id()}" for pipe in (first, second, third)}
    assert {last(path) for path in scene.paths} == expected
    assert len(codes(scene)["bad-guid"].meshes) == 3


def test_a_circle_of_wholes_ends(tmp_path):
    plant = ifc_files.IfcPlant()
    a = plant.element("IfcElementAssembly", within=False)
    b = plant.element("IfcElementAssembly", within=False)
    pipe = plant.element("IfcPipeSegment", plant.body(plant.cylinder(50, 500)), within=False)
    for whole, member in ((a, b), (b, a), (a, pipe)):
        plant.root("IfcRelAggregates", RelatingObject=whole, RelatedObjects=[member])
    scene = loaded(plant, tmp_path)
    assert scene.n_meshes == 1
    assert scene.paths[0].startswith("/Test_plant/")
    assert "bad-structure" in codes(scene)


def test_names_of_storeys_are_safe_and_unique(tmp_path):
    plant = ifc_files.IfcPlant()
    plant.storey.Name = "../Level: 1/2 ü\n"
    other = plant.root("IfcBuildingStorey", Name="Level 1/2 ü", CompositionType="ELEMENT")
    plant.root("IfcRelAggregates", RelatingObject=plant.site, RelatedObjects=[other])
    pipe = plant.element("IfcPipeSegment", plant.body(plant.cylinder(50, 500)), within=False)
    plant.root("IfcRelContainedInSpatialStructure", RelatingStructure=other, RelatedElements=[pipe])
    plant.pipe(600)
    scene = loaded(plant, tmp_path)
    assert {path.rpartition("/")[0] for path in scene.paths} == {
        "/Test_plant/Works/Level_1_2_ü", "/Test_plant/Works/Level_1_2_ü_1",
    }  # fmt: skip


def test_the_same_file_gives_the_same_scene(tmp_path):
    file = ifc_files.storehouse().write(tmp_path / "plant.ifc")
    first, second = load(file, IN_PROCESS), load(file, LoadConfig())
    assert first.paths == second.paths
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert first.faces.tobytes() == second.faces.tobytes()
    assert (first.facts, first.links, first.diagnostics) == (second.facts, second.links, second.diagnostics)
    assert first.source == second.source


def test_finer_settings_give_more_triangles(tmp_path):
    fine = loaded(ifc_files.pump_line(), tmp_path)
    coarse = loaded(ifc_files.pump_line(), tmp_path, max_gap=0.02, max_angle=1.0)
    assert coarse.n_triangles < fine.n_triangles / 2


# Files that are odd or damaged


def test_half_a_file_is_an_error(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    data = file.read_bytes()
    # At the end of a line, so that all that is left can be parsed.
    file.write_bytes(data[: data.rindex(b"\n", 0, len(data) // 2) + 1])
    assert "cut short" in error_of(file)


def test_spaces_and_zeros_behind_the_end_do_no_harm(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    file.write_bytes(file.read_bytes() + b"\n  " + bytes(4000))
    assert load(file, IN_PROCESS).n_meshes == 5


@pytest.mark.parametrize("draft", ["IFC4X3_RC3", "IFC4X3", "ifc4x3_rc4"])
def test_a_draft_of_a_schema_is_read_as_the_nearest_one(tmp_path, draft):
    file = ifc_files.pump_line("IFC4X3").write(tmp_path / "plant.ifc")
    file.write_bytes(file.read_bytes().replace(b"'IFC4X3_ADD2'", f"'{draft}'".encode(), 1))
    scene = load(file, IN_PROCESS)
    assert scene.n_meshes == 5
    assert f"{draft.upper()}; it was read as IFC4X3_ADD2" in codes(scene)["schema-guessed"].message


def test_an_unknown_schema_is_one_line(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    file.write_bytes(file.read_bytes().replace(b"'IFC4'", b"'IFC9_NEW'", 1))
    assert "schema IFC9_NEW is not known; export it as one of IFC2X3, IFC4, IFC4X3_ADD2" in error_of(file)


def test_a_line_that_can_not_be_read_is_told(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    lines = file.read_bytes().split(b"\n")
    at = next(i for i, line in enumerate(lines) if b"IFCCOLOURRGB" in line)
    number = lines[at].partition(b"=")[0]
    lines.insert(at, number + b"=IFCNOSUCHTHING(1);")
    file.write_bytes(b"\n".join(lines))
    assert "1 line of the file holds no readable entity" in codes(load(file, IN_PROCESS))["damaged-entity"].message


def test_broken_syntax_is_one_line(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    data = file.read_bytes()
    middle = len(data) // 2
    file.write_bytes(data[:middle] + b"?" * 60 + data[middle + 60 :])
    assert "not readable as IFC" in error_of(file)


def test_a_chain_of_wholes_of_any_length_ends(tmp_path):
    plant = ifc_files.IfcPlant()
    pipe = plant.element("IfcPipeSegment", plant.body(plant.cylinder(50, 500)))
    chain = [plant.element("IfcElementAssembly", within=False) for _ in range(300)]
    for whole, member in zip(chain, [*chain[1:], pipe], strict=True):
        plant.root("IfcRelAggregates", RelatingObject=whole, RelatedObjects=[member])
    (path,) = loaded(plant, tmp_path).paths
    assert path.count("/") <= 102


def test_a_file_without_products_is_one_line(tmp_path):
    assert "it holds no product" in error_of(ifc_files.IfcPlant().write(tmp_path / "plant.ifc"))


def test_a_file_with_axes_only_says_so(tmp_path):
    plant = ifc_files.IfcPlant()
    plant.element("IfcPipeSegment", plant.line())
    assert "1 of curves or points" in error_of(plant.write(tmp_path / "plant.ifc"))


def test_an_archive_is_unpacked(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    packed = tmp_path / "plant.ifczip"
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        # A name that leads elsewhere is not followed.
        archive.write(file, "../../elsewhere/plant.ifc")
    scene = load(packed, IN_PROCESS)
    assert scene.paths == load(file, IN_PROCESS).paths
    assert not (tmp_path.parent.parent / "elsewhere").exists()


def test_archives_that_hold_no_or_several_or_half_files(tmp_path):
    file = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    packed = tmp_path / "plant.ifczip"
    data = file.read_bytes()
    for members, said in (
        ({"readme.txt": b"x"}, "holds no .ifc file"),
        ({"model.ifcXML": b"<ifc/>"}, "holds IFC as XML alone"),
        ({"a.ifc": data, "b.ifc": data}, "holds 2 IFC files"),
        ({"a.ifc": data[: len(data) // 2]}, "in the archive: the file is cut short"),
    ):
        with zipfile.ZipFile(packed, "w") as archive:
            for name, content in members.items():
                archive.writestr(name, content)
        assert said in error_of(packed)
    packed.write_bytes(b"PK\x03\x04 no archive")
    assert "no zip archive, or cut short" in error_of(packed)


def test_an_archive_that_unpacks_without_end_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("cadgraph._io.spf._MOST_UNPACKED", 1 << 20)
    packed = tmp_path / "plant.ifczip"
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.ifc", b"ISO-10303-21;" + bytes(2 << 20))
    assert "unpacks to more than 1 MB" in error_of(packed)


def test_a_file_of_another_format_is_told_by_its_content(tmp_path):
    step = b"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nEND-ISO-10303-21;\n"
    for name, data, said in (
        ("a.ifc", step, "a STEP file by its schema (AUTOMOTIVE_DESIGN), no IFC file; rename it to end in .stp"),
        ("a.ifc", b"PK\x03\x04...", "rename it to end in .ifczip"),
        ("a.ifc", b"<?xml version='1.0'?>", "IFC as XML is not read"),
        ("a.ifc", b"solid cube", "no IFC file (ISO-10303-21 is missing at its start)"),
        ("a.ifcxml", b"<?xml version='1.0'?>", "export it as a STEP physical file (.ifc)"),
        ("a.dat", step.replace(b"AUTOMOTIVE_DESIGN", b"IFC4"), "looks like IFC; rename it to end in .ifc"),
        ("a.dat", step, "looks like STEP; rename it to end in .step"),
    ):
        file = tmp_path / name
        file.write_bytes(data)
        assert said in error_of(file)


def test_an_ifc_file_named_step_is_told(tmp_path):
    pytest.importorskip("cascadio")
    file = ifc_files.pump_line().write(tmp_path / "plant.step")
    assert "an IFC file by its schema (IFC4); rename it to end in .ifc" in error_of(file)


def test_texts_of_the_file_are_bounded_and_on_one_line(tmp_path):
    plant = ifc_files.IfcPlant()
    plant.pipe(0, Name="a\nb\x1b[31m" + "x" * 5000)
    (name,) = {fact.value for fact in loaded(plant, tmp_path).facts if fact.key == "name"}
    assert name.startswith("a b [31mxx")
    assert len(name) == 500
    assert clean(" a \t b ") == "a b"


@pytest.mark.parametrize("tag", ["P-101", "10-P-101A", "PT-12.3", "V12", "HV-1203-A", "TIC-4"])
def test_tags_of_plants(tag):
    assert _is_tag(tag)


@pytest.mark.parametrize("text", ["611904", "DN100", "HEA-200", "PN16", "M16", "Valve 5", "", "a-1", "P-", "12-13"])
def test_other_texts_are_no_tags(text):
    assert not _is_tag(text)


def test_classes_that_a_schema_lacks_are_none():
    assert of_type(ifcopenshell.file(schema="IFC2X3"), "IfcMapConversion") == []


# Real files


@pytest.mark.skipif(not (SHARED / "formats/Duplex_Electrical.ifc").exists(), reason="no further real files here")
@pytest.mark.slow
def test_a_real_building():
    scene = load(SHARED / "formats/Duplex_Electrical.ifc", LoadConfig())
    assert scene.n_meshes == 103
    assert set(codes(scene)) == {"not-built"}
    assert sum(fact.key == "class" for fact in scene.facts) == 103
    assert {("class", "IfcPump", "IfcPumpType"), ("predefined", "CIRCULATOR", "IfcPumpType.PredefinedType")} <= {
        fact[1:] for fact in scene.facts
    }
    np.testing.assert_allclose(np.ptp(scene.vertices, axis=0), (8.481, 17.258, 6.757), atol=1e-2)
    assert scene.source.meters_per_unit == pytest.approx(0.3048)


@pytest.mark.skipif(not (SHARED / "ifc/DrainageSystem-2.IFC").exists(), reason="no further real files here")
def test_a_real_draft_without_a_solid_is_one_line():
    said = error_of(SHARED / "ifc/DrainageSystem-2.IFC")
    assert "no product in it has a solid or a surface" in said
