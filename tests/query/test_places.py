import pytest

from cadgraph.agents.plant import Plant
from cadgraph.agents.tools import tool_named
from cadgraph.errors import AskError, FormatError
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.pipeline import build
from cadgraph.query.places import levels, region, walk, way_to
from cadplants import make


@pytest.fixture(scope="module")
def gallery():
    plant = make("gallery", 0, "bim")
    labels = [GivenLabel(path, c.group, c.name) for path, c in zip(plant.paths(), plant.components, strict=True)]
    return build(plant.scene(), labels=labels), {
        path: c.unit for path, c in zip(plant.paths(), plant.components, strict=True)
    }


@pytest.fixture(scope="module")
def tags(gallery):
    """The unit of the graph for each tag of the generated plant."""
    graph, unit_of = gallery
    return {unit_of[graph.nodes[part].meshes[0]]: unit for unit in graph.units() for part in unit.parts}


@pytest.mark.parametrize(
    ("tag", "kinds"),
    [
        *((f"{letter}-{line}1", ["ground"]) for letter in "VG" for line in "ABC"),
        *((f"{letter}-A2", ["ground", "stairs", "platform"]) for letter in "VG"),
        *((f"{letter}-B2", ["ground", "ladder", "platform"]) for letter in "VG"),
        *((f"{letter}-C2", []) for letter in "VG"),
    ],
)
def test_units_overhead_are_reached_over_the_way_that_was_built_for_them(gallery, tags, tag, kinds):
    graph, _ = gallery
    access = tags[tag].access
    assert access.reach == ("out of reach" if not kinds else "floor" if kinds == ["ground"] else "platform")
    assert [step.kind for step in way_to(graph, access.place)] == (kinds or ["ground"])
    if kinds and tag[0] == "G":
        assert access.viewpoint is not None


def test_a_walk_leads_over_the_stairs_and_is_longer_than_the_straight_way(gallery, tags):
    graph, _ = gallery
    start, end = tags["V-A1"].access.stand, tags["V-A2"].access.stand
    there, back = walk(graph, start, end), walk(graph, end, start)
    assert there == pytest.approx(back)
    assert there > 4.0
    assert walk(graph, start, start) == 0
    assert walk(graph, start, (100.0, 0.0, 0.0)) is None
    assert walk(graph, (start[0], start[1], 1.0), end) is None


def test_a_place_that_nothing_leads_to_has_no_way(gallery):
    graph, _ = gallery
    data = graph.to_json()
    data["edges"] = [edge for edge in data["edges"] if edge["kind"] != "reached_from"]
    cut = SceneGraph.from_json(data)
    assert [len(way_to(cut, level)) for level in levels(cut)] == [1, 0, 0]


def test_places_survive_a_save_and_their_edges_are_checked(gallery, tmp_path):
    graph, _ = gallery
    assert SceneGraph.load(graph.save(tmp_path)).to_json() == graph.to_json()
    data = graph.to_json()
    place = next(node for node in data["nodes"] if node["layer"] == "place")
    place["floor"]["runs"] = [1, 2]
    with pytest.raises(FormatError, match="place-001"):
        SceneGraph.from_json(data)
    place["floor"] |= {"size": [1_000_000, 1_000_000], "runs": [10**12]}
    with pytest.raises(FormatError, match="at most"):
        SceneGraph.from_json(data)


def test_the_region_of_the_first_line_is_in_the_south(gallery, tags):
    assert region(gallery[0], tags["V-A2"].centroid).startswith("south")


def test_approach_tells_the_way_and_says_what_is_out_of_reach(gallery, tags):
    plant, approach = Plant(gallery[0]), tool_named("approach")
    told = approach.ask(plant, {"target": tags["G-A2"].tag})
    assert told.values["way"][0] == "ground"
    assert told.values["way"][1].startswith("stairs")
    assert "seen from an eye at" in told.text
    out = approach.ask(plant, {"target": tags["V-C2"].tag})
    assert out.values["reach"] == "out of reach"
    assert "OUT OF REACH" in out.text
    with_a_pole = approach.ask(plant, {"target": tags["V-C2"].tag, "reach": 4.0})
    assert with_a_pole.values["reach"] == "floor"
    assert with_a_pole.values["stand_m"] is not None
    with pytest.raises(AskError, match="reach"):
        approach.ask(plant, {"target": tags["V-C2"].tag, "reach": 0.0})


def test_approach_says_that_nothing_is_known_where_the_graph_has_no_places(gallery, tags):
    data = gallery[0].to_json()
    data["nodes"] = [
        {key: value for key, value in node.items() if key != "access"}
        for node in data["nodes"]
        if node["layer"] != "place"
    ]
    kept = {node["id"] for node in data["nodes"]}
    data["edges"] = [edge for edge in data["edges"] if edge["source"] in kept and edge["target"] in kept]
    bare = Plant(SceneGraph.from_json(data))
    told = tool_named("approach").ask(bare, {"target": tags["G-A2"].tag})
    assert "unknown" in told.text
    assert told.values["reach"] is None
