import hashlib
import zipfile

import pytest

pytest.importorskip("ifcopenshell")

import ifcopenshell
import ifcopenshell.util.element

import graphs
import ifc_files
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError, MissingExtra, OutputError
from cadgraph.export.ifc import LABEL_SET, UNIT_SET, write_ifc
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Connected, Contains, SourceRecord, System

IN_PROCESS = LoadConfig(isolate=False)
SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")


def of_source(graph, source, sha256=None):
    digest = hashlib.sha256(source.read_bytes()).hexdigest() if sha256 is None else sha256
    record = SourceRecord(path=str(source), sha256=digest)
    return SceneGraph(graph.document.model_copy(update={"source": record}))


def line_graph(source):
    """Pump P-101, pipe, two valves as one unit, and an unlabelled pipe; one system of the two units."""
    scene = load(source, IN_PROCESS)
    paths = {fact.value: fact.path for fact in scene.facts if fact.key == "name"}
    pump, pipe, first, second = (paths[name] for name in ("P-101", "Pipe", "Valve 500", "Valve 700"))
    (bare,) = set(scene.paths) - {pump, pipe, first, second}
    nodes = [
        graphs.part(0, pump, label=graphs.label("Pump assembly", "pump", 0.9)),
        graphs.part(1, pipe, label=label("Pipe assembly", None, 0.654321987, likely=True)),
        graphs.part(2, first, second, label=graphs.label()),
        graphs.part(3, bare),
        graphs.unit("P-101", "part-0", unit_type="pump"),
        graphs.unit("V-001", "part-2", kind="ball valve"),
        System(id="system-0", units=("unit-P-101", "unit-V-001"), length=1.5, sizes=(100,)),
    ]
    edges = [
        *(Contains(source="system-0", target=f"unit-{tag}") for tag in ("P-101", "V-001")),
        Contains(source="unit-P-101", target="part-0"),
        Contains(source="unit-V-001", target="part-2"),
        Connected(source="unit-P-101", target="unit-V-001", via=("part-1",)),
    ]
    return of_source(graphs.graph(nodes, edges), source)


def label(group="Valve assembly", name="valve body", confidence=0.75, likely=False):
    return graphs.label(group, name, confidence).model_copy(update={"likely": likely})


def psets(product):
    return ifcopenshell.util.element.get_psets(product)


def named(model, name):
    return next(each for each in model.by_type("IfcElement") if each.Name == name)


def written(tmp_path, schema="IFC4"):
    source = ifc_files.pump_line(schema).write(tmp_path / "plant.ifc")
    target = write_ifc(line_graph(source), source, tmp_path / "out/labelled.ifc")
    return source, target, ifcopenshell.open(str(target))


@pytest.mark.parametrize("schema", SCHEMAS)
def test_products_get_the_label_of_their_part(tmp_path, schema):
    _, target, model = written(tmp_path, schema)
    assert target == tmp_path / "out/labelled.ifc"
    pump = psets(named(model, "P-101"))[LABEL_SET]
    del pump["id"]
    assert pump == {"Group": "Pump assembly", "Name": "pump", "Confidence": 0.9, "Source": "geometry",
                    "State": "sure", "Part": "part-0"}  # fmt: skip
    pipe = psets(named(model, "Pipe"))[LABEL_SET]
    assert (pipe["Confidence"], pipe["State"], "Name" in pipe) == (0.654322, "likely", False)
    for name in ("Valve 500", "Valve 700"):
        assert psets(named(model, name))[LABEL_SET]["Name"] == "valve body"
    # What is unlabelled or has no shape gets none, and what others say stays.
    assert sum(LABEL_SET in psets(each) for each in model.by_type("IfcElement")) == 4
    assert psets(named(model, "Valve 500"))["Isogen"]["SKEY"] == "VGFL"


@pytest.mark.parametrize("schema", SCHEMAS)
def test_everything_that_was_there_stays(tmp_path, schema):
    source, _, after = written(tmp_path, schema)
    before = ifcopenshell.open(str(source))
    for each in before:
        assert str(after.by_id(each.id())) == str(each)
    guids = [each.GlobalId for each in after.by_type("IfcRoot")]
    assert len(set(guids)) == len(guids) > len(before.by_type("IfcRoot"))
    assert str(after.header.file_name) == str(before.header.file_name)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_the_result_is_valid(tmp_path, schema):
    from ifcopenshell import validate

    source, target, _ = written(tmp_path, schema)
    faults = []
    for path in (source, target):
        logger = validate.json_logger()
        validate.validate(str(path), logger)
        faults.append(sorted(str(each["message"]) for each in logger.statements))
    assert faults[1] == faults[0]


def test_labels_are_a_classification(tmp_path):
    _, _, model = written(tmp_path)
    (classification,) = model.by_type("IfcClassification")
    assert classification.Name == "cadgraph"
    codes = {
        each.RelatingClassification.Identification: {one.Name for one in each.RelatedObjects}
        for each in model.by_type("IfcRelAssociatesClassification")
        if each.RelatingClassification.is_a("IfcClassificationReference")
    }
    assert codes == {
        "Pump assembly/pump": {"P-101"}, "Pipe assembly": {"Pipe"},
        "Valve assembly/valve body": {"Valve 500", "Valve 700"},
    }  # fmt: skip


@pytest.mark.parametrize("schema", SCHEMAS)
def test_units_and_systems_are_groups(tmp_path, schema):
    _, _, model = written(tmp_path, schema)
    members = {
        each.RelatingGroup.Name: {one.Name for one in each.RelatedObjects}
        for each in model.by_type("IfcRelAssignsToGroup")
        if each.RelatingGroup.ObjectType == "cadgraph"
    }
    assert members == {
        "P-101": {"P-101"}, "V-001": {"Valve 500", "Valve 700"},
        "CadGraph system 1": {"P-101", "Valve 500", "Valve 700", "Pipe"},
    }  # fmt: skip
    kinds = {each.Name: each.is_a() for each in model.by_type("IfcGroup")}
    assert kinds["V-001"] == "IfcGroup"
    assert kinds["CadGraph system 1"] == ("IfcSystem" if schema == "IFC2X3" else "IfcDistributionSystem")
    valve = next(each for each in model.by_type("IfcGroup") if each.Name == "V-001")
    assert valve.Description == "valve, ball valve"
    unit = psets(valve)[UNIT_SET]
    assert (unit["Type"], unit["Kind"], unit["Tag"]) == ("valve", "ball valve", "V-001")
    system = next(each for each in model.by_type("IfcSystem") if each.Name.startswith("CadGraph"))
    assert system.Description == "length 1.50 m, DN 100"


def test_a_system_with_what_is_no_distribution_element_is_a_plain_one(tmp_path):
    plant = ifc_files.IfcPlant()
    for i in range(2):
        plant.element("IfcBuildingElementProxy", plant.body(plant.cylinder(50, 500)), at=(600 * i, 0, 0))
    source = plant.write(tmp_path / "plant.ifc")
    paths = load(source, IN_PROCESS).paths
    nodes = [*(graphs.part(i, path) for i, path in enumerate(paths)), graphs.unit("V-1", "part-0", "part-1"),
             System(id="system-0", units=("unit-V-1",))]  # fmt: skip
    target = write_ifc(of_source(graphs.graph(nodes), source), source, tmp_path / "out.ifc")
    (system,) = ifcopenshell.open(str(target)).by_type("IfcSystem")
    assert (system.is_a(), system.Description) == ("IfcSystem", None)


@pytest.mark.parametrize("schema", SCHEMAS)
def test_a_second_run_replaces_what_the_first_added(tmp_path, schema):
    _, first, before = written(tmp_path, schema)
    again = line_graph(first)
    parts = [
        part.model_copy(update={"label": label("Tank", "vessel")}) if part.id == "part-0" else part
        for part in again.document.nodes
    ]
    changed = SceneGraph(again.document.model_copy(update={"nodes": tuple(parts)}))
    model = ifcopenshell.open(str(write_ifc(changed, first, tmp_path / "again.ifc")))
    assert len(list(model)) == len(list(before))
    assert psets(named(model, "P-101"))[LABEL_SET]["Name"] == "vessel"
    assert sum(each.Name == LABEL_SET for each in model.by_type("IfcPropertySet")) == 3
    assert [each.Name for each in model.by_type("IfcClassification")] == ["cadgraph"]
    assert sum(each.ObjectType == "cadgraph" for each in model.by_type("IfcGroup")) == 3
    # What names the same keeps its GlobalId.
    assert {each.GlobalId for each in model.by_type("IfcGroup")} == {
        each.GlobalId for each in before.by_type("IfcGroup")
    }


def test_own_labels_are_no_facts_when_read_again(tmp_path):
    source, target, _ = written(tmp_path)
    plain, labelled = load(source, IN_PROCESS), load(target, IN_PROCESS)
    assert labelled.facts == plain.facts
    assert labelled.links == plain.links
    assert labelled.paths == plain.paths


def test_the_same_graph_gives_the_same_bytes(tmp_path):
    source, target, _ = written(tmp_path)
    other = write_ifc(line_graph(source), source, tmp_path / "other.ifc")
    assert other.read_bytes() == target.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["other.ifc", "out", "plant.ifc"]


def test_a_product_of_several_parts_gets_the_label_of_the_largest(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    pump = next(path for path in load(source, IN_PROCESS).paths if "IfcPump" in path)
    nodes = [graphs.part(0, f"{pump}/body_1", label=label("Tank", "small"), size=0.5),
             graphs.part(1, f"{pump}/body_2", label=label("Tank", "large"), size=2.0)]  # fmt: skip
    target = write_ifc(of_source(graphs.graph(nodes), source), source, tmp_path / "out.ifc")
    model = ifcopenshell.open(str(target))
    assert psets(named(model, "P-101"))[LABEL_SET]["Name"] == "large"


def test_elements_told_by_their_lines_are_found(tmp_path):
    plant = ifc_files.IfcPlant()
    pipes = [plant.pipe(1000 * i, Name=f"pipe {i}") for i in range(2)]
    pipes[1].GlobalId = pipes[0].GlobalId
    source = plant.write(tmp_path / "plant.ifc")
    paths = load(source, IN_PROCESS).paths
    nodes = [graphs.part(i, path, label=label("Pipe assembly", path[-4:])) for i, path in enumerate(paths)]
    target = write_ifc(of_source(graphs.graph(nodes), source), source, tmp_path / "out.ifc")
    model = ifcopenshell.open(str(target))
    assert {psets(model.by_id(pipe.id()))[LABEL_SET]["Name"] for pipe in pipes} == {path[-4:] for path in paths}


def test_text_of_a_graph_can_not_break_the_file(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    pump = next(path for path in load(source, IN_PROCESS).paths if "IfcPump" in path)
    name = "a'); #1=IFCWALL(\n\\X\\0D ü" + "x" * 500
    nodes = [graphs.part(0, pump, label=label("Tank", name))]
    target = write_ifc(of_source(graphs.graph(nodes), source), source, tmp_path / "out.ifc")
    model = ifcopenshell.open(str(target))
    assert psets(named(model, "P-101"))[LABEL_SET]["Name"] == name.replace("\n", " ")[:255]
    assert not model.by_type("IfcWall")


# What can't be done


def test_a_source_that_has_changed_is_refused(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    graph = of_source(line_graph(source), source, "0" * 64)
    with pytest.raises(LoadError, match=r"plant\.ifc: it has changed since the graph was made"):
        write_ifc(graph, source, tmp_path / "out.ifc")


def test_a_graph_of_another_file_is_refused(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    graph = of_source(graphs.graph([graphs.part(0, "/World/IfcPump_3XvRU8z2bQCfz_OuPP8QNc")]), source)
    with pytest.raises(LoadError, match="no product for the graph's mesh '/World/IfcPump_3"):
        write_ifc(graph, source, tmp_path / "out.ifc")
    assert not (tmp_path / "out.ifc").exists()


def test_the_source_is_never_overwritten(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    link = tmp_path / "link.ifc"
    link.symlink_to(source)
    for target in (source, link):
        with pytest.raises(OutputError, match="this is the source itself"):
            write_ifc(line_graph(source), source, target)


def test_other_files_are_refused_in_one_line(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    graph = line_graph(source)
    for given, target, said in (
        (tmp_path / "plant.usd", "out.ifc", "no IFC file by its name"),
        (tmp_path / "missing.ifc", "out.ifc", r"can't be read \(No such file"),
        (source, "out.ifczip", r"give a file that ends in \.ifc"),
    ):
        with pytest.raises((LoadError, OutputError), match=said) as caught:
            write_ifc(graph, given, tmp_path / target)
        assert "\n" not in str(caught.value)


def test_a_draft_schema_is_refused(tmp_path):
    source = ifc_files.pump_line("IFC4X3").write(tmp_path / "plant.ifc")
    source.write_bytes(source.read_bytes().replace(b"'IFC4X3_ADD2'", b"'IFC4X3_RC3'", 1))
    with pytest.raises(LoadError, match="its schema is none that can be written; export it as IFC2X3"):
        write_ifc(line_graph(source), source, tmp_path / "out.ifc")


def test_half_a_source_is_refused(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    graph = line_graph(source)
    source.write_bytes(source.read_bytes()[:-100])
    with pytest.raises(LoadError, match="cut short"):
        write_ifc(of_source(graph, source), source, tmp_path / "out.ifc")


def test_a_folder_that_can_not_be_made_is_an_output_error(tmp_path):
    source = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    with pytest.raises(OutputError, match="choose another output folder"):
        write_ifc(line_graph(source), source, source / "out.ifc")


def test_without_the_library_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(MissingExtra, match=r"'\.\[ifc\]'"):
        write_ifc(graphs.graph(), tmp_path / "plant.ifc", tmp_path / "out.ifc")


def test_an_archive_is_a_source_too(tmp_path):
    plain = ifc_files.pump_line().write(tmp_path / "plant.ifc")
    source = tmp_path / "plant.ifczip"
    with zipfile.ZipFile(source, "w") as archive:
        archive.write(plain, "plant.ifc")
    target = write_ifc(line_graph(source), source, tmp_path / "out.ifc")
    assert LABEL_SET in psets(named(ifcopenshell.open(str(target)), "P-101"))
