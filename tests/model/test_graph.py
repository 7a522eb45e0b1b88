import json
import re

import networkx
import pytest
from hypothesis import given
from hypothesis import strategies as st

import graphs
import networks
from cadgraph.errors import FormatError, OutputError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Adjacent, Cluster, Connected, Part, Related, Site, Terminal, Unit
from cadgraph.query import find_way, trace


@pytest.fixture
def graph():
    return graphs.valve_line()


def ids(nodes):
    return [node.id for node in nodes]


# What is in the graph


def test_nodes_come_by_layer_in_the_order_of_the_file(graph):
    assert ids(graph.of_layer(Cluster)) == ["cluster-0", "cluster-1"]
    assert ids(graph.of_layer(Terminal)) == ["end-0"]
    assert graph.site == Site(id="site")


def test_edges_come_by_kind(graph):
    assert [(e.source, e.target) for e in graph.of_kind(Related)] == [("unit-V-001", "unit-V-002")]
    assert len(graph.of_kind(Adjacent)) == 3


def test_parts_are_found_by_group_name_and_cluster(graph):
    assert ids(graph.parts()) == [f"part-{i}" for i in range(5)]
    assert ids(graph.parts(group="Valve assembly")) == ["part-0", "part-1", "part-3"]
    assert ids(graph.parts(name="handwheel")) == ["part-1"]
    assert ids(graph.parts(group="Pipe assembly", name="handwheel")) == []
    assert ids(graph.parts(cluster="cluster-1")) == ["part-4"]
    with pytest.raises(KeyError, match="no cluster has the id 'nowhere'"):
        graph.parts(cluster="nowhere")


def test_a_type_of_units_that_neither_graph_nor_vocabulary_knows_is_a_mistake():
    tree = {"Tank": {"names": ["shell"], "unit": "tank"}}
    graph = graphs.graph([graphs.part(0, label=graphs.label("Tank", "shell"))], vocabulary=tree)
    assert graph.units("tank") == []
    with pytest.raises(ValueError, match="no type of units is called 'tnak'; there are tank"):
        graph.units("tnak")


def test_a_group_or_name_that_the_vocabulary_lacks_is_a_mistake_that_names_the_known_ones():
    tree = {"Tank": {"names": ["shell", "nozzle"]}, "Valve assembly": {"names": ["valve body"]}}
    graph = graphs.graph([graphs.part(0, label=graphs.label("Own group", "own name"))], vocabulary=tree)
    assert graph.parts(group="Tank") == graph.parts(name="nozzle") == graph.parts(group="Tank", name="shell") == []
    assert ids(graph.parts(group="Own group", name="own name")) == ["part-0"], "what is in use is known"
    with pytest.raises(ValueError, match=r"no group is called 'tank'.*has Tank, Valve assembly"):
        graph.parts(group="tank")
    with pytest.raises(ValueError, match="group 'Tank' has no name 'valve body'; it has shell, nozzle"):
        graph.parts(group="Tank", name="valve body")
    with pytest.raises(ValueError, match="vocabulary has no name 'lever'"):
        graph.parts(name="lever")


def test_the_functional_layers_have_typed_access(graph):
    assert ids(graph.terminals()) == ["end-0"]
    assert graph.terminals("open") == graph.junctions() == []
    assert ids(graph.systems()) == ["system-0"]
    assert [(e.source, e.target) for e in graph.connections()] == [
        ("unit-V-002", "unit-V-001"),
        ("unit-V-002", "end-0"),
    ]
    assert [e.target for e in graph.connections("end-0")] == ["end-0"]
    assert len(graph.connections(graph.unit("V-002"))) == 2
    with pytest.raises(KeyError, match="V-009"):
        graph.connections("V-009")


def test_a_graph_shows_what_it_holds_in_one_line(graph):
    assert repr(graph) == (
        "<SceneGraph of 'plant.usd': 5 parts, 2 clusters, 3 units, 3 contacts, 2 connections, 1 end, 1 system>"
    )


def test_units_and_clusters_are_found_by_type_and_kind(graph):
    assert [unit.tag for unit in graph.units("valve")] == ["V-001", "V-002"]
    assert len(graph.units()) == 3
    assert ids(graph.clusters("pipe system")) == ["cluster-0"]
    assert graph.units("pump") == []


def test_a_part_is_found_by_id_or_by_a_mesh_of_it(graph):
    assert graph.part("part-1") is graph.part("/mesh_1")


def test_a_unit_is_found_by_tag_or_id(graph):
    assert graph.unit("V-002") is graph.unit("unit-V-002")


@pytest.mark.parametrize("look", ["part", "unit"])
def test_what_is_not_there_is_a_key_error_that_names_it(graph, look):
    with pytest.raises(KeyError, match="V-999"):
        getattr(graph, look)("V-999")
    with pytest.raises(KeyError, match="site"):
        getattr(graph, look)("site")


def test_a_part_knows_its_unit_and_cluster(graph):
    assert graph.unit_of("part-1").tag == "V-001"
    assert graph.unit_of(graph.part("part-2")) is None
    assert graph.cluster_of("part-2").kind == "pipe system"
    assert graph.cluster_of(graph.unit("V-001")) is graph.cluster_of("V-001") is graph.cluster_of("/mesh_0")
    assert graph.cluster_of("end-0").id == "cluster-0"
    assert graphs.graph([graphs.part(0)]).cluster_of("part-0") is None
    for look in (graph.cluster_of, graph.unit_of):
        with pytest.raises(KeyError, match="no such part"):
            look("no such part")


# How things hang together


def test_neighbors_of_a_part_are_the_adjacent_parts(graph):
    assert ids(graph.neighbors(graph.part("part-2"))) == ["part-0", "part-3"]
    assert ids(graph.neighbors("/mesh_1")) == ["part-0"]
    assert graph.neighbors("part-4") == []


@pytest.mark.parametrize("which", ["cluster-0", "site", "system-0"])
def test_what_has_no_neighbors_by_its_nature_says_so(graph, which):
    with pytest.raises(ValueError, match=f"'{which}' is a "):
        graph.neighbors(which)


def test_neighbors_of_a_terminal_are_the_units_connected_to_it(graph):
    assert ids(graph.neighbors("end-0")) == ["unit-V-002"]


@pytest.mark.parametrize("what", [None, 3, object()])
def test_neighbors_of_nothing_is_a_type_error(graph, what):
    with pytest.raises(TypeError, match="give a part, a unit, or the id of one"):
        graph.neighbors(what)


def test_neighbors_of_a_unit_are_the_units_next_to_it_along_the_pipes(graph):
    assert [unit.tag for unit in graph.neighbors(graph.unit("V-002"))] == ["V-001"]
    assert [unit.tag for unit in graph.neighbors("V-001")] == ["V-002"]


def branched():
    """T-001 -> V-001 -> J1 -> V-002 -> X1, J1 - V-003 -> X2 of unknown direction, G-001 on J1; the paper: V-001, X."""
    nodes = [networks.unit(tag) for tag in ("T-001", "V-001", "V-002", "V-003", "G-001")]
    nodes += [networks.junction(1), networks.terminal(1), networks.terminal(2)]
    edges = [
        *networks.chain("T-001 V-001 J1 V-002 X1"),
        *networks.chain("J1 V-003 X2 ", direction="unknown"),
        *networks.chain("J1 G-001", 15, 0.2, "unknown"),
        Related(source="unit-V-003", target="unit-T-001"),
        Related(source="unit-G-001", target="unit-V-003"),
    ]
    return networks.network(nodes, edges, systems=False)


def tags(nodes):
    return [getattr(node, "tag", node.id) for node in nodes]


def test_neighbors_are_found_through_junctions_and_not_through_units():
    assert tags(branched().neighbors("V-001")) == ["T-001", "V-002", "V-003", "G-001"]
    assert tags(branched().neighbors("T-001")) == ["V-001"]
    assert tags(branched().neighbors("junction-001")) == ["V-001", "V-002", "V-003", "G-001"]


def test_neighbors_one_way_are_those_of_a_known_direction_and_the_instruments_on_the_way():
    assert tags(branched().neighbors("V-001", "downstream")) == ["V-002", "G-001"]
    assert tags(branched().neighbors("V-002", "upstream")) == ["V-001", "G-001"]
    assert tags(branched().neighbors("V-003", "upstream")) == []


def test_neighbors_one_way_are_steps_of_a_trace():
    graph = networks.pumping()
    for unit in graph.units():
        for direction in ("downstream", "upstream"):
            steps = {step.place for step in trace(graph, unit.tag, direction).steps}
            assert {other.id for other in graph.neighbors(unit, direction)} <= steps


@pytest.mark.parametrize(
    "ask", [lambda g: g.neighbors("V-001", "down"), lambda g: g.path("V-001", "V-002", "sideways")]
)
def test_a_direction_that_is_none_is_a_mistake(ask):
    with pytest.raises(ValueError, match="give 'downstream', 'upstream', or None"):
        ask(branched())


def test_parts_have_no_direction(graph):
    with pytest.raises(ValueError, match="parts that touch have no direction"):
        graph.neighbors("part-0", "downstream")
    with pytest.raises(ValueError, match="parts that touch have no direction"):
        graph.path("part-0", "part-3", "downstream")


def test_a_path_between_units_goes_along_the_pipes_and_not_over_relations():
    graph = branched()
    assert tags(graph.path("T-001", "V-003")) == ["T-001", "V-001", "junction-001", "V-003"]
    assert tags(graph.path("T-001", "V-002", "downstream")) == ["T-001", "V-001", "junction-001", "V-002"]
    assert tags(graph.path("V-002", "T-001", "upstream")) == ["V-002", "junction-001", "V-001", "T-001"]
    assert graph.path("V-002", "T-001", "downstream") == graph.path("T-001", "V-003", "downstream") == []


def test_a_path_is_the_shortest_along_the_centrelines_as_a_trace_finds_it():
    graph = networks.pumping()
    way = find_way(graph, "V-003", "G-007")
    assert [node.id for node in graph.path("V-003", "G-007")] == [step.place for step in way.steps]


def test_the_relation_of_the_paper_is_asked_for_by_name():
    graph = branched()
    assert tags(graph.related("V-003")) == ["T-001", "G-001"]
    assert graph.related(graph.unit("V-001")) == []
    assert [(edge.source, edge.target) for edge in graph.related()] == [
        ("unit-V-003", "unit-T-001"),
        ("unit-G-001", "unit-V-003"),
    ]
    with pytest.raises(ValueError, match="Algorithm 1 relates units, but 'junction-001' is a junction"):
        graph.related("junction-001")
    with pytest.raises(KeyError, match="V-9"):
        graph.related("V-9")


def test_a_part_stands_for_its_unit_where_the_relation_is_asked_for(graph):
    assert tags(graph.related("part-0")) == ["V-002"]
    with pytest.raises(ValueError, match="is a part"):
        graph.related("part-2")


def test_joints_are_found_by_what_they_are_at_and_whether_they_were_made():
    joints = (graphs.joint(), graphs.joint("part-2", "part-3", made=False, score=0.25))
    graph = graphs.valve_line(joints=joints)
    assert graph.joints() == list(joints)
    assert graph.joints(made=False) == [joints[1]]
    assert graph.joints("V-001") == graph.joints("part-0") == [joints[0]]
    assert graph.joints("part-2") == graph.joints("end-0") == list(joints)
    assert graph.joints("part-2", made=True) == [joints[0]]
    with pytest.raises(KeyError):
        graph.joints("part-9")


def test_joints_come_back_as_they_were_each_on_a_line_of_its_own(tmp_path):
    joints = (graphs.joint(), graphs.joint("part-2", "part-3", made=False, gap=-0.001, reasons=()))
    path = graphs.valve_line(joints=joints).save(tmp_path)
    assert tuple(SceneGraph.load(path).joints()) == joints
    assert sum('"made":' in line for line in path.read_text().splitlines()) == 2


def test_a_graph_without_joints_says_nothing_of_them(graph, tmp_path):
    assert '"joints"' not in graph.save(tmp_path).read_text()
    assert SceneGraph.load(tmp_path).joints() == []


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"first": "part-9"}, "'face' joint of 'part-9' and 'part-2' names 'part-9', but no part has that id"),
        ({"second": "unit-V-001"}, "names 'unit-V-001', but no part has that id"),
        ({"score": 1.5}, r"joint 'face' of 'part-0' and 'part-2' \(joints.0.score\)"),
        ({"kind": "glue"}, r"joint 'glue' of 'part-0' and 'part-2' \(joints.0.kind\)"),
        ({"gap": "wide"}, "joints.0.gap"),
    ],
)
def test_a_joint_off_the_format_is_an_error_that_names_its_parts(change, says):
    data = graphs.valve_line(joints=(graphs.joint(),)).to_json()
    data["joints"][0].update(change)
    with pytest.raises(FormatError, match=says):
        SceneGraph.from_json(data)


def test_a_path_is_the_shortest_way_with_both_ends(graph):
    assert ids(graph.path("part-1", "/mesh_3")) == ["part-1", "part-0", "part-2", "part-3"]
    assert ids(graph.path("V-001", "V-002")) == ["unit-V-001", "unit-V-002"]
    assert ids(graph.path("part-0", "part-0")) == ["part-0"]


def test_no_way_is_an_empty_path(graph):
    assert graph.path("part-0", "part-4") == []
    assert graph.path("V-001", "G-001") == []


def test_a_path_from_a_part_to_a_unit_is_an_error(graph):
    with pytest.raises(ValueError, match="two parts or two units"):
        graph.path("part-0", "V-002")
    with pytest.raises(KeyError, match="'nowhere'; its units are V-001, V-002, G-001"):
        graph.path("part-0", "nowhere")
    with pytest.raises(ValueError, match=r"'cluster-0' \(cluster\)"):
        graph.path("cluster-0", "cluster-1")


# networkx


def test_graph_json_loads_with_networkx_as_it_is(graph, tmp_path):
    with graph.save(tmp_path).open(encoding="utf-8") as file:
        found = networkx.node_link_graph(json.load(file), edges="edges", multigraph=True)
    assert isinstance(found, networkx.MultiDiGraph)
    assert list(found) == list(graph.nodes)
    assert found.number_of_edges() == len(graph.document.edges)
    assert found.nodes["part-0"]["label"]["name"] == "valve body"
    assert networkx.utils.graphs_equal(found, graph.to_networkx())


# On disk


def test_saving_and_loading_gives_the_same_graph(graph, tmp_path):
    assert SceneGraph.load(graph.save(tmp_path / "graph.json")).document == graph.document
    assert SceneGraph.load(tmp_path).to_json() == graph.to_json()


def test_the_same_graph_gives_the_same_bytes(graph, tmp_path):
    first = graph.save(tmp_path / "a.json").read_bytes()
    again = SceneGraph.load(tmp_path / "a.json").save(tmp_path / "b.json").read_bytes()
    assert first == again
    assert b"\r" not in first


def test_each_node_and_edge_has_a_line_of_its_own(graph, tmp_path):
    lines = graph.save(tmp_path).read_text(encoding="utf-8").splitlines()
    assert sum('"layer"' in line for line in lines) == len(graph.nodes)


def test_a_folder_gets_graph_json(graph, tmp_path):
    assert graph.save(tmp_path / "new") == tmp_path / "new" / "graph.json"


def test_unknown_keys_are_kept_everywhere(graph, tmp_path):
    data = graph.to_json()
    places = [
        data,
        data["source"],
        data["nodes"][3],
        data["nodes"][3]["label"],
        data["nodes"][3]["obb"],
        data["edges"][0],
        data["edges"][-1],
    ]
    for place in places:
        place["from_the_future"] = {"x": [1, None, "é"]}
    data["diagnostics"] = [{"code": "a", "message": "b", "meshes": [], "extra": 1}]
    again = SceneGraph.load(SceneGraph.from_json(data).save(tmp_path))
    assert again.to_json() == data


JSON = st.recursive(
    st.none() | st.booleans() | st.integers(-(2**53), 2**53) | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=6,
)  # fmt: skip


UNKNOWN_KEY = st.text(min_size=1).filter(lambda key: key not in Part.model_fields)


@given(st.text(), st.dictionaries(UNKNOWN_KEY, JSON, max_size=4))
def test_any_text_and_any_unknown_values_survive_a_round_trip(tmp_path_factory, text, extra):
    data = graphs.graph([graphs.part(0, text, label=graphs.label(text, text, evidence=text))]).to_json()
    for key, value in extra.items():
        data["nodes"][1].setdefault(key, value)
    path = SceneGraph.from_json(data).save(tmp_path_factory.mktemp("any"))
    assert SceneGraph.load(path).to_json() == data


def test_lone_surrogates_survive_a_round_trip(tmp_path):
    graph = graphs.graph([graphs.part(0, "/a\ud800b")])
    assert SceneGraph.load(graph.save(tmp_path)).to_json() == graph.to_json()


def adjacent(data):
    return next(edge for edge in data["edges"] if edge["kind"] == "adjacent")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda d: d.update(format="other"), "'format' must be 'cadgraph'"),
        (lambda d: d.pop("format"), "'format' must be 'cadgraph'"),
        (lambda d: d.update(version=2), "version 2, but this cadgraph reads version 1"),
        (lambda d: d.pop("nodes"), "nodes"),
        (lambda d: d.update(edges={}), "edges"),
        (lambda d: d["nodes"][3].pop("area"), r"node 'part-0' \(nodes\.3\.part\.area\) is missing"),
        (
            lambda d: d["edges"][-3].update(source=7),
            r"edge 'related' from 7 to 'unit-V-002' \(.*\) must be text, not 7",
        ),
        (lambda d: adjacent(d).pop("distance"), r"edge 'adjacent' from 'part-0' to 'part-1' \(.*distance\) is missing"),
        (lambda d: adjacent(d).update(target="part-0"), "ends where it starts"),
        (lambda d: adjacent(d).update(source="part-1", target="part-0"), "the wrong way round"),
        (lambda d: adjacent(d).update(distance=-1e-9), r"adjacent.distance\) must be at least 0"),
        (lambda d: adjacent(d).update(target="unit-V-001"), "joins a part with a unit"),
        (lambda d: d["edges"].append(adjacent(d)), "from 'part-0' to 'part-1' is there twice"),
        (
            lambda d: d["edges"].append({"source": "unit-V-002", "target": "unit-V-001", "kind": "related"}),
            "'related' edge .* is there twice",
        ),
        (
            lambda d: d["edges"].append({"source": "cluster-1", "target": "part-0", "kind": "contains"}),
            "'part-0' is in two nodes of layer 'cluster': 'cluster-0' and 'cluster-1'",
        ),
        (lambda d: d["edges"][-2].update(via=["ghost"]), "names 'ghost', but no part has that id"),
        (lambda d: d["nodes"][4].update(meshes=["/mesh_0"]), "mesh '/mesh_0' is in two parts: 'part-0' and 'part-1'"),
        (lambda d: d["nodes"][8].update(parts=["ghost"]), "unit 'unit-V-001' names 'ghost', but no part"),
        (lambda d: d["nodes"][9].update(parts=["part-0"]), "part 'part-0' is in two units"),
        (lambda d: d["nodes"][9].update(tag="V-001"), "tag 'V-001' is used by two units"),
        (lambda d: d["nodes"][11].update(parts=["cluster-0"]), "'end-0' names 'cluster-0', but no part"),
        (lambda d: d["nodes"][12].update(units=["part-0"]), "'system-0' names 'part-0', but no unit"),
        (lambda d: d["nodes"][12].update(junctions=["ghost"]), "'system-0' names 'ghost', but no junction"),
        (lambda d: d["nodes"][3].update(meshes=[]), r"nodes\.3\.part\.meshes"),
        (lambda d: d["nodes"][3]["label"].update(confidence=1.01), r"nodes\.3\.part\.label\.confidence"),
        (lambda d: d["nodes"][3].update(centroid=[0, 0]), r"nodes\.3\.part\.centroid"),
        (lambda d: d["nodes"][3].update(area=float("nan")), r"nodes\.3\.part\.area"),
        (lambda d: d["nodes"][0].update(layer="planet"), r"nodes\.0.*planet"),
        (lambda d: d["edges"][-1].update(direction="up"), r"edges\.\d+\.connected\.direction"),
        (
            lambda d: d["edges"][-1].update(length=-0.5),
            r"edges\.\d+\.connected\.length\) must be at least 0, not -0\.5",
        ),
        (lambda d: d["edges"][-1].update(diameter=-0.1), r"connected\.diameter\) must be at least 0"),
        (lambda d: d["nodes"][3].update(n_triangles=-1), r"part\.n_triangles\) must be at least 0"),
        (lambda d: d["nodes"][3]["obb"].update(extents=[1, 1, -1]), r"obb\.extents"),
        (lambda d: d["edges"][0].update(target="ghost"), "names 'ghost', but no node"),
        (lambda d: d["nodes"].append(d["nodes"][3]), "'part-0' is used twice"),
        (lambda d: d["nodes"].append({"layer": "site", "id": "two"}), "exactly one node of layer 'site', found 2"),
        (lambda d: d.update(nodes=[], edges=[]), "found 0"),
    ],
)
def test_a_graph_off_the_format_is_an_error_that_names_the_key(graph, tmp_path, change, says):
    data = graph.to_json()
    change(data)
    path = tmp_path / "graph.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    with pytest.raises(FormatError, match=says) as caught:
        SceneGraph.load(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("content", ["", "{", "[1]", "null", '"text"', "[" * 100_000])
def test_a_file_that_is_no_graph_is_a_format_error(tmp_path, content):
    path = tmp_path / "graph.json"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(FormatError, match=re.escape(str(path))):
        SceneGraph.load(path)


def test_bytes_that_are_no_text_are_a_format_error(tmp_path):
    (tmp_path / "graph.json").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(FormatError, match="not UTF-8 text"):
        SceneGraph.load(tmp_path)


def test_a_missing_file_says_what_makes_it(tmp_path):
    with pytest.raises(FormatError, match=r"none\.json: no such file or folder; check the path"):
        SceneGraph.load(tmp_path / "none.json")
    with pytest.raises(FormatError, match="'cadgraph build' makes it"):
        SceneGraph.load(tmp_path)


def test_a_place_that_cannot_be_written_is_an_output_error(graph, tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(OutputError, match="choose another output folder"):
        graph.save(tmp_path / "file" / "graph.json")


def test_records_stay_as_they_are_when_looked_at(graph):
    before = graph.to_json()
    graph.neighbors("part-2"), graph.path("V-001", "V-002"), graph.to_networkx(), graph.parts(cluster="cluster-0")
    assert graph.to_json() == before


def test_the_types_of_records_are_kept(graph, tmp_path):
    again = SceneGraph.load(graph.save(tmp_path))
    assert isinstance(again.nodes["part-0"], Part)
    assert isinstance(again.nodes["unit-V-001"], Unit)
    assert isinstance(again.document.edges[-1], Connected)
