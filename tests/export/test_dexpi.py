import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import xmlschema
from hypothesis import given, settings
from hypothesis import strategies as st

import graphs
from cadgraph.errors import FormatError
from cadgraph.export import export_graph
from cadgraph.export.dexpi import read_dexpi, write_dexpi
from cadgraph.export.dexpi.terms import kind_of, unit_type_of
from cadgraph.model.records import Connected, Junction, Terminal
from cadgraph.query import find_isolation, find_lines, trace
from cadgraph.query.compare import compare
from cadgraph.query.text import isolation_values, line_values, trace_values
from networks import chain, joint, junction, network, pumping, terminal, unit


@pytest.fixture(scope="module")
def schema():
    return xmlschema.XMLSchema(Path(__file__).parent / "proteus.xsd")


def there_and_back(graph, folder):
    return read_dexpi(write_dexpi(graph, folder / "plant.xml"))


def listed(graph):
    return [line_values(line) for line in find_lines(graph)]


NETWORKS = {
    "one line": ("T-001.N1 V-001 G-001 V-002 P-001.N1",),
    "gauges in a row": ("T-001.N1 G-001 G-002 V-001 G-003 P-001.N1",),
    "a tee": ("T-001.N1 J1 P-001.N1", "J1 V-001 X1"),
    "a cross": ("T-001.N1 J1 P-001.N1", "X1 J1 V-001 X2"),
    "parallel": ("T-001.N1 P-001.N1", "P-001.N2 T-001.N2"),
    "a loop": ("P-001.N2 V-001 P-001.N1",),
    "a ring": ("V-001 V-002 V-003 V-001",),
    "a junction ring": ("J1 V-001 J1", "J1 X1"),
    "valves at both ends": ("V-001 V-002",),
    "a three-way valve": ("X1 V-001 X2", "V-001 X3"),
    "gauges at both ends": ("G-001 V-001 G-002",),
    "a tap": ("T-001.N1 J1 P-001.N1", "J1 V-001 G-001"),
    "a bare tap": ("T-001.N1 J1 V-001 P-001.N1", "J1 G-001"),
    "a tap at a tank": ("T-001.N1 V-001 G-001", "T-001.N2 P-001.N1"),
    "no ports": ("T-001 V-001 P-001", "P-001 T-001"),
}


def made(texts, kinds=(), **more):
    kinds = dict(kinds)
    names = dict.fromkeys(name.split(".")[0] for text in texts for name in text.split())
    ports = {}
    for text in texts:
        for name in text.split():
            if "." in name:
                ports.setdefault(name.split(".")[0], {})[name.split(".")[1]] = True
    nodes = [
        junction(int(n[1:]), (1.0, 2.0, 3.0))
        if n[0] == "J"
        else terminal(int(n[1:]), kinds.get(n, "open"))
        if n[0] == "X"
        else unit(n, kinds.get(n), (4.0, 5.0, 6.0), tuple(sorted(ports.get(n, ()))))
        for n in names
    ]
    return network(nodes, [edge for text in texts for edge in chain(text, **more)])


@pytest.mark.parametrize("direction", ["forward", "unknown"])
@pytest.mark.parametrize("texts", NETWORKS.values(), ids=NETWORKS)
def test_every_construct_comes_back_and_is_valid(texts, direction, tmp_path, schema):
    graph = made(texts, direction=direction, length=0.5)
    back = there_and_back(graph, tmp_path)
    schema.validate(tmp_path / "plant.xml")
    assert listed(back) == listed(graph)
    assert {(u.id, u.tag, u.unit_type, u.kind, u.centroid) for u in back.units()} == {
        (u.id, u.tag, u.unit_type, u.kind, u.centroid) for u in graph.units()
    }


def test_a_plant_comes_back_with_all_its_answers(tmp_path, schema):
    graph = pumping()
    back = there_and_back(graph, tmp_path)
    schema.validate(tmp_path / "plant.xml")
    assert listed(back) == listed(graph)
    assert trace_values(trace(back, "V-003")) == trace_values(trace(graph, "V-003"))
    assert isolation_values(find_isolation(back, "P-001")) == isolation_values(find_isolation(graph, "P-001"))
    for kind in (Junction, Terminal):
        assert sorted(back.of_layer(kind), key=lambda n: n.id) == sorted(graph.of_layer(kind), key=lambda n: n.id)
    assert len(back.of_kind(Connected)) == len(graph.of_kind(Connected))


@pytest.mark.parametrize("word", ["ball", "gate", "globe", "butterfly", "check", "control", "relief", "plug", None])
def test_kinds_of_valves_come_back(word, tmp_path):
    kind = word and f"{word} valve"
    graph = made(("T-001.N1 V-001 P-001.N1",), [("V-001", kind)])
    assert there_and_back(graph, tmp_path).unit("V-001").kind == kind


@pytest.mark.parametrize("kind", ["open", "blind", "unknown"])
def test_kinds_of_ends_come_back(kind, tmp_path):
    graph = made(("T-001.N1 X1",), [("X1", kind)])
    assert there_and_back(graph, tmp_path).of_layer(Terminal)[0].kind == kind


@pytest.mark.parametrize(
    ("name", "custom", "unit_type", "kind"),
    [
        ("CustomCheckValve", "", "equipment", "check valve"),
        ("CustomCheckValve", "DN 50 PN 16", "equipment", "check valve"),
        ("CustomCheckValve", "lift check valve", "equipment", "lift check valve"),
        ("CustomSafetyValveOrFitting", "valve", "equipment", "safety valve"),
        ("CustomSafetyValveOrFitting", "relief valve", "equipment", "relief valve"),
        ("ReciprocatingPump", "", "pump", "reciprocating pump"),
        ("RotaryPump", "", "pump", "rotary pump"),
        ("CustomPump", "", "pump", None),
        ("Vessel", "", "tank", None),
        ("ProcessColumn", "", "tank", None),
        ("CustomFilter", "strainer", "equipment", "strainer"),
    ],
)
def test_classes_of_the_standard_are_what_they_say(name, custom, unit_type, kind):
    assert kind_of(name, custom) == kind
    if "Valve" not in name:
        assert unit_type_of(name, "equipment") == unit_type


def test_a_change_of_size_at_a_valve_begins_a_segment(tmp_path):
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    graph = network(nodes, chain("T-001 V-001", 80) + chain("V-001 P-001", 50))
    assert listed(there_and_back(graph, tmp_path)) == listed(graph)
    root = ET.parse(tmp_path / "plant.xml").getroot()
    assert len(root.findall(".//PipingNetworkSegment")) == 2
    assert root.find(".//PipingComponent[@ComponentClass='PipeReducer']") is None


def test_a_reducer_in_a_connection_is_written_and_read(tmp_path, schema):
    edges = chain("T-001 P-001", 80, 2.0, sizes=(80, 50))
    graph = network([unit("T-001"), unit("P-001")], edges)
    assert listed(there_and_back(graph, tmp_path)) == listed(graph)
    schema.validate(tmp_path / "plant.xml")
    assert "PipeReducer-1" in (tmp_path / "plant.xml").read_text(encoding="utf-8")


def test_a_change_of_size_at_a_gauge_is_a_reducer(tmp_path):
    nodes = [unit("T-001"), unit("G-001"), unit("P-001")]
    graph = network(nodes, chain("T-001 G-001", 80) + chain("G-001 P-001", 50))
    assert listed(there_and_back(graph, tmp_path)) == listed(graph)


def test_a_valve_on_the_side_of_a_run_is_written_on_a_branch_of_its_own(tmp_path, schema):
    graph = made(("T-001.N1 G-001 V-001.N1 V-002 P-001.N1",), [("V-001", "relief valve"), ("V-002", "gate valve")])
    back = there_and_back(graph, tmp_path)
    schema.validate(tmp_path / "plant.xml")
    (tee,) = back.of_layer(Junction)
    assert {unit.tag for unit in back.units()} == {"T-001", "G-001", "V-001", "V-002", "P-001"}
    assert {edge.source for edge in back.of_kind(Connected) if edge.target == "unit-V-001"} == {tee.id}
    assert compare(graph, back).agrees
    in_series = made(("T-001.N1 G-001 V-001 V-002 P-001.N1",), [("V-001", "relief valve"), ("V-002", "gate valve")])
    assert not compare(graph, in_series).agrees


def test_unconnected_units_are_not_lost(tmp_path, schema):
    graph = network([unit("V-001"), unit("G-001", "pressure gauge"), unit("P-001")], [])
    back = there_and_back(graph, tmp_path)
    schema.validate(tmp_path / "plant.xml")
    assert {u.tag for u in back.units()} == {"V-001", "G-001", "P-001"}


def test_contradictory_flow_comes_back(tmp_path):
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    graph = network(nodes, chain("T-001 V-001") + chain("V-001 P-001", direction="backward"))
    assert listed(there_and_back(graph, tmp_path)) == listed(graph)
    assert [line["flow"] for line in listed(graph)] == ["contradictory"]


def test_the_file_is_the_same_every_time(tmp_path):
    write_dexpi(pumping(), tmp_path / "a.xml")
    write_dexpi(pumping(), tmp_path / "b.xml")
    assert (tmp_path / "a.xml").read_bytes() == (tmp_path / "b.xml").read_bytes()


@pytest.mark.parametrize("tag", ["V\"<&>'001", "V]]>", "V\x00\x1f1", "\ud800V", "=1+1"])
def test_hostile_tags_are_text(tag, tmp_path, schema):
    nodes = [unit("T-001"), unit(tag, unit_type="valve"), unit("P-001")]
    one = chain("T-001 P-001")[0]
    edges = [one.model_copy(update={"target": f"unit-{tag}"}), one.model_copy(update={"source": f"unit-{tag}"})]
    graph = network(nodes, edges, path="/home/me/a&b<c>.usd")
    back = there_and_back(graph, tmp_path)
    schema.validate(tmp_path / "plant.xml")
    assert "/home/me" not in (tmp_path / "plant.xml").read_text(encoding="utf-8")
    kept = "".join(c for c in tag if c >= " " and not "\ud800" <= c <= "\udfff")
    assert kept in {u.tag for u in back.units()}


@settings(max_examples=20, deadline=None)
@given(st.text(max_size=12))
def test_any_text_makes_well_formed_xml(text):
    from cadgraph._io.text import xml_text

    element = ET.Element("a", value=xml_text(text))
    ET.fromstring(ET.tostring(element))


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("<!DOCTYPE a [<!ENTITY b 'c'>]><PlantModel>&b;</PlantModel>", "document type declaration"),
        ("<!DOCTYPE PlantModel SYSTEM 'file:///etc/passwd'><PlantModel/>", "document type declaration"),
        ("<PlantModel>", "not XML"),
        ("", "not XML"),
        ("<svg/>", "the root is 'svg'"),
    ],
)
def test_bad_files_are_refused_in_one_line(content, says, tmp_path):
    path = tmp_path / "bad.xml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(FormatError, match=says) as error:
        read_dexpi(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(FormatError, match="no such file"):
        read_dexpi(tmp_path / "nothing.xml")


def test_a_file_of_another_tool_is_read(tmp_path):
    (tmp_path / "other.xml").write_text(
        """<PlantModel>
        <PlantInformation SchemaVersion="4.1.1"/>
        <Equipment ID="E1" ComponentClass="Tank">
          <GenericAttributes Set="DexpiAttributes">
            <GenericAttribute Name="TagNameAssignmentClass" Value="T4750"/>
          </GenericAttributes>
          <Nozzle ID="N1"><ConnectionPoints><Node/><Node Type="process"/></ConnectionPoints></Nozzle>
        </Equipment>
        <Equipment ID="E2" ComponentClass="ReciprocatingPump" TagName="P4711"><Nozzle ID="N2"/></Equipment>
        <PipingNetworkSystem ID="S1"><PipingNetworkSegment ID="S1-1">
          <PipingComponent ID="V1" ComponentClass="BallValve" TagName="HV-1"/>
          <CenterLine NumPoints="0"/>
          <Connection FromID="N1" FromNode="1" ToID="N2" ToNode="1"/>
        </PipingNetworkSegment></PipingNetworkSystem></PlantModel>""",
        encoding="utf-8",
    )
    (line,) = find_lines(read_dexpi(tmp_path / "other.xml"))
    assert (line.start_name, line.through_names, line.end_name, line.flow) == ("T4750", ("HV-1",), "P4711", "forward")
    assert line.reasons == ("drawn so in the diagram",)


OTHER = """<PlantModel>
  <PlantInformation SchemaVersion="4.1.1"/>
  <ShapeCatalogue>
    <Equipment ID="shape-1" ComponentClass="Tank" ComponentName="TANK"/>
    <PipingComponent ID="shape-2" ComponentClass="BallValve" ComponentName="VALVE"/>
  </ShapeCatalogue>
  <Drawing Name="1">
    <Equipment ID="E1" ComponentClass="PlateHeatExchanger" TagName="H-7">
      <Nozzle ID="N1" TagName="A"/>
      <Equipment ID="E1-1" ComponentClass="Chamber"><Nozzle ID="N2" TagName="B"/></Equipment>
    </Equipment>
    <Equipment ComponentClass="Tank" TagName="T-lost"/>
    <PipingNetworkSystem ID="S1">
      <PipingNetworkSegment ID="S1-1">
        <PipingComponent ID="F1" ComponentClass="Flange"/>
        <PipingComponent ID="V1" ComponentClass="NeedleValve" TagName="HV-1"/>
        <PropertyBreak ID="B1" ComponentClass="PropertyBreak"/>
        <Label ID="L1"/>
        <PipingComponent ComponentClass="GateValve"/>
        <Connection FromID="N1" ToID="F1"/><Connection FromID="F1" ToID="V1"/><Connection FromID="V1" ToID="B1"/>
      </PipingNetworkSegment>
      <PipingNetworkSegment ID="S1-2">
        <PipingComponent ID="M1" ComponentClass="ElectromagneticFlowMeter" TagName="FT-1"/>
        <Connection FromID="N2" ToID="M1"/><Connection FromID="M1" ToID="B1"/>
      </PipingNetworkSegment>
      <PipingNetworkSegment ID="S1-3">
        <GenericAttributes Set="DexpiAttributes">
          <GenericAttribute Name="NominalDiameterNumericalValueRepresentationAssignmentClass" Value="1e999"/>
        </GenericAttributes>
        <PipingComponent ID="V2" ComponentClass="OperatedValve" TagName="HV-1"/>
        <CenterLine/>
        <Connection FromID="E1" ToID="elsewhere"/>
      </PipingNetworkSegment>
      <PipingNetworkSegment ID="S1-4"/>
    </PipingNetworkSystem>
  </Drawing>
</PlantModel>"""


@pytest.fixture
def other(tmp_path):
    (tmp_path / "other.xml").write_text(OTHER, encoding="utf-8")
    return read_dexpi(tmp_path / "other.xml")


def test_what_other_tools_write_is_read_as_far_as_it_goes(other):
    units = {unit.tag: (unit.unit_type, unit.kind) for unit in other.units()}
    assert units == {
        "H-7": ("equipment", None),
        "HV-1": ("valve", "needle valve"),
        "FT-1": ("gauge", "flow meter"),
        "HV-1 (V2)": ("valve", None),
    }
    edges = {(edge.source, edge.target) for edge in other.connections()}
    # The flange and the break are passed over, and the second half was drawn towards the break.
    assert edges == {("E1", "V1"), ("V1", "M1"), ("E1", "M1"), ("E1", "V2"), ("V2", "end-elsewhere")}
    assert other.nodes["end-elsewhere"].kind == "unknown"


def test_flow_turns_with_a_segment_that_was_drawn_the_other_way(other):
    directions = {(edge.source, edge.target): edge.direction for edge in other.connections()}
    assert directions["V1", "M1"] == "forward"
    assert directions["E1", "M1"] == "forward"


def test_ports_of_other_tools_are_kept(other):
    assert [port.name for port in other.unit("H-7").ports] == ["A", "B"]


def test_what_was_skipped_is_told(other):
    told = {finding.code: finding.message for finding in other.diagnostics}
    assert told == {
        "dexpi-no-id": "2 items without an ID are left out: T-lost, GateValve",
        "dexpi-tag-twice": "1 tags are used more than once; later ones get their ID behind them: HV-1",
        "dexpi-unknown-end": "1 connections end at something that the file doesn't hold; taken for ends of pipes: "
        "elsewhere",
        "dexpi-no-ends": "1 segments join nothing: S1-4",
    }


def test_fittings_at_which_pipes_branch_or_end_are_nodes(tmp_path):
    (tmp_path / "a.xml").write_text(
        """<PlantModel><PipingNetworkSystem><PipingNetworkSegment>
        <PipingComponent ID="F" ComponentClass="Flange"/><PipingComponent ID="G" ComponentClass="Flange"/>
        <PipingComponent ID="V1" ComponentClass="GateValve"/><PipingComponent ID="V2" ComponentClass="GateValve"/>
        <PipingComponent ID="V3" ComponentClass="GateValve"/>
        <Connection FromID="V1" ToID="F"/><Connection FromID="F" ToID="V2"/><Connection FromID="F" ToID="V3"/>
        <Connection FromID="V3" ToID="G"/></PipingNetworkSegment></PipingNetworkSystem></PlantModel>""",
        encoding="utf-8",
    )
    graph = read_dexpi(tmp_path / "a.xml")
    assert [node.id for node in graph.junctions()] == ["F"]
    assert [node.id for node in graph.terminals()] == ["G"]


def test_it_is_a_format_of_export(tmp_path):
    assert export_graph(pumping(), "dexpi", tmp_path) == [tmp_path / "dexpi.xml"]
    assert export_graph(pumping(), "dexpi", tmp_path / "plant.xml") == [tmp_path / "plant.xml"]


def test_pipe_drawn_in_two_strokes_is_one_connection(tmp_path):
    def stroke(length):
        return (
            "<CenterLine><GenericAttributes Set='DexpiCustomAttributes'>"
            f"<GenericAttribute Name='Length' Value='{length}'/></GenericAttributes></CenterLine>"
        )

    (tmp_path / "a.xml").write_text(
        f"""<PlantModel><PipingNetworkSystem><PipingNetworkSegment ID="S">
        <PipingComponent ID="V1" ComponentClass="GateValve"/>{stroke(1.0)}{stroke(2.0)}
        <PipingComponent ID="V2" ComponentClass="GateValve"/></PipingNetworkSegment></PipingNetworkSystem>
        <ProcessInstrumentationFunction ID="G1" TagName="PI-1"><ProcessSignalGeneratingFunction ID="P1">
        <GenericAttributes Set="DexpiCustomAttributes"><GenericAttribute Name="DistanceAlongSegment" Value="2.5"/>
        </GenericAttributes><Association Type="is located in" ItemID="S"/></ProcessSignalGeneratingFunction>
        </ProcessInstrumentationFunction></PlantModel>""",
        encoding="utf-8",
    )
    edges = read_dexpi(tmp_path / "a.xml").connections()
    assert [(edge.source, edge.target, edge.length) for edge in edges] == [("V1", "G1", 2.5), ("G1", "V2", 0.5)]


def test_where_the_plant_was_doubtful_its_drawing_is(tmp_path):
    nodes = [unit("T-001"), unit("V-001", "gate valve"), unit("P-001"), unit("V-002", "gate valve"), unit("T-002")]
    graph = network(nodes, chain("T-001 V-001 P-001 V-002 T-002"))
    sure = there_and_back(graph, tmp_path)
    assert (find_isolation(graph, "P-001").isolated, find_isolation(sure, "P-001").isolated) == (True, True)
    assert sure.diagnostics == ()
    parts = [graphs.part(k, f"/{name}", id=name) for k, name in enumerate(("p1", "e1"))]
    nodes[2] = nodes[2].model_copy(update={"parts": ("p1",)})
    nodes.append(unit("E-001").model_copy(update={"parts": ("e1",)}))
    unjoined = [joint("p1", "e1", 0.003, 0.4, made=False)]
    doubtful = network([*parts, *nodes], chain("T-001 V-001 P-001 V-002 T-002"), joints=unjoined)
    assert find_isolation(doubtful, "P-001").isolated is None
    drawn = there_and_back(doubtful, tmp_path)
    found = find_isolation(drawn, "P-001")
    assert found.isolated is None
    assert "the plant that this drawing was written from goes on here, maybe" in found.doubts[0].text
    assert compare(doubtful, drawn).skipped == ()
    short = network([unit("T-001"), unit("P-001")], chain("T-001 P-001"))
    assert there_and_back(short, tmp_path).diagnostics == ()


def test_an_instrument_somewhere_in_a_segment_is_told(tmp_path):
    graph = made(("T-001.N1 G-001 V-001 T-002.N1",), [("V-001", "gate valve")])
    file = write_dexpi(graph, tmp_path / "plant.xml")
    assert read_dexpi(file).diagnostics == ()
    file.write_text(file.read_text("utf-8").replace('Name="DistanceAlongSegment"', 'Name="Other"'), "utf-8")
    (note,) = read_dexpi(file).diagnostics
    assert note.code == "dexpi-somewhere"
    assert note.message.endswith("are not the drawing's: G-001")
