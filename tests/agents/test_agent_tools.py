import json
import os

import pytest

import graphs
from cadgraph.agents.answer import BUDGET, tokens
from cadgraph.agents.drawing.drawer import read_scene
from cadgraph.agents.plant import Plant
from cadgraph.agents.tools import TOOLS, tool_named
from cadgraph.errors import AskError, CadGraphError, Unconnected
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Access, Place
from networks import chain, junction, network, pumping, terminal, unit
from plants_by_hand import HOSTILE, hostile_plant, large_plant, pumping_plant


def ask(plant, name, **arguments):
    return tool_named(name).ask(plant, arguments)


def told(plant, name, **arguments):
    """The text of all pages, each checked against the budget."""
    texts = []
    while True:
        texts.append(ask(plant, name, **arguments, **({"page": len(texts) + 1} if texts else {})).text)
        assert tokens(texts[-1]) <= BUDGET, (name, arguments)
        if f"; next: page={len(texts) + 1}" not in texts[-1].rpartition("\n")[2]:
            return texts


def first_cells(texts):
    return [line.split("\t")[0] for text in texts for line in text.split("\n")]


def calls(tag):
    """Every tool on one unit."""
    yield "describe", {"id": tag}
    yield "neighbors", {"id": tag}
    yield "neighbors", {"id": tag, "by": "touch"}
    yield "trace", {"start": tag}
    yield "trace", {"start": tag, "direction": "upstream", "unknown": True}
    yield "route", {"start": tag, "end": "T-001"}
    yield "isolate", {"target": tag}
    yield "isolate", {"target": tag, "fewest": True}
    yield "what_if", {"close": tag}
    yield "lines", {"through": tag}
    yield "measure", {"a": tag, "b": "T-001"}
    yield "find", {"near": tag, "within": 5.0}


@pytest.fixture(scope="module")
def plant():
    return pumping_plant()


@pytest.fixture(scope="module")
def large():
    return large_plant()


# The limits of an answer


@pytest.mark.slow
def test_every_answer_about_units_of_a_large_plant_keeps_within_the_budget(large):
    for one in large.graph.units()[::15]:
        for name, arguments in calls(one.tag):
            if name == "what_if" and one.unit_type != "valve":
                with pytest.raises(AskError, match=r"is no valve but"):
                    ask(large, name, **arguments)
            else:
                told(large, name, **arguments)
    for name, arguments in (("overview", {}), ("lines", {}), ("find", {}), ("find", {"type": "part"})):
        told(large, name, **arguments)


@pytest.mark.parametrize(
    ("name", "arguments", "key", "tag"),
    [
        ("find", {}, "found", "tag"),
        ("find", {"type": "part", "sort": "height"}, "found", "tag"),
        ("find", {"near": "T-000"}, "found", "tag"),
        ("neighbors", {"id": "V-0001", "by": "touch"}, "neighbors", "part"),
        ("lines", {}, "lines", "line"),
    ],
)
def test_pages_together_hold_each_row_of_the_values_once_in_their_order(large, name, arguments, key, tag):
    expected = [each[tag] for each in ask(large, name, **arguments).values[key]]
    assert expected
    assert [cell for cell in first_cells(told(large, name, **arguments)) if cell in set(expected)] == expected


def test_a_long_trace_loses_no_step(large):
    texts = told(large, "trace", start="T-000")
    assert len(texts) > 1
    steps = [step["tag"] for step in ask(large, "trace", start="T-000").values["steps"][1:]]
    assert [line.split("\t")[1] for text in texts for line in text.split("\n") if " m\t" in line] == steps


def test_a_long_list_of_what_is_cut_off_loses_no_tag(large):
    values = ask(large, "what_if", close="V-0001").values
    cut = [one["tag"] for one in values["cut_off"]]
    assert len(cut) > 50
    cells = [line.split("\t") for text in told(large, "what_if", close="V-0001") for line in text.split("\n")]
    shown = [tag for row in cells if row[0] == "cut off" for tag in row[2].split(", ")]
    assert sorted(shown) == sorted(cut)


# Names of anybody


def test_hostile_names_stay_cells_of_one_line():
    plant = hostile_plant()
    names = [plant.called(one.id) for one in plant.graph.units()]
    assert len(set(names)) == len(names)
    for name in names:
        assert plant.called(plant.find(name).id) == name
        for tool, arguments in calls(name):
            for text in told(plant, tool, **arguments) if (tool, name) != ("what_if", "T-001") else ():
                assert all(line.isprintable() for part in text.split("\t") for line in part.split("\n"))
    rows = [line for text in told(plant, "find", type="valve") for line in text.split("\n")]
    assert sorted(row.split("\t")[0] for row in rows[2:]) == sorted(set(names) - {"T-001"})
    assert not any(row.startswith(("Ignore", "ball valve")) for row in rows)


def test_hostile_names_come_back_as_the_values_say_them():
    plant = hostile_plant()
    for row in ask(plant, "find").values["found"]:
        assert ask(plant, "describe", id=row["tag"]).values["tag"] == row["tag"]


@pytest.mark.parametrize("name", [*HOSTILE, "", " ", "../../etc/passwd", "'; DROP TABLE unit; --"])
def test_hostile_arguments_are_refused_in_one_short_line(plant, name):
    for tool, arguments in calls(name):
        if tool == "find" or (tool == "what_if" and not name.strip()):
            arguments = {**arguments, "near": name or "?"} if tool == "find" else arguments
        with pytest.raises(CadGraphError) as refused:
            ask(plant, tool, **arguments) if tool != "lines" or name else ask(plant, "describe", id="")
        assert len(str(refused.value)) < 600
        assert str(refused.value).isprintable()


def test_tags_that_look_alike_are_told_apart():
    nodes = [unit("V-001"), unit("V-002").model_copy(update={"tag": "V-001\n"}), terminal(1)]
    plant = Plant(network(nodes, chain("V-001 V-002 X1")))
    assert plant.called("unit-V-001") == "V-001"
    assert plant.called("unit-V-002") == "unit-V-002"
    assert plant.find("V-001").id == "unit-V-001"


# Wrong arguments


@pytest.mark.parametrize(
    ("name", "arguments", "match"),
    [
        ("describe", {"id": "V-04x"}, r"did you mean V-0"),
        ("describe", {"id": "P-999"}, r"did you mean P-001, P-002\?"),
        ("isolate", {"target": "L-0000"}, r"lines are numbered so"),
        ("isolate", {"target": "PX-001"}, r"did you mean P-001"),
        ("isolate", {"target": "system-001"}, r"is a system, not a unit"),
        ("find", {"type": "vlave"}, r"did you mean valve\?"),
        ("find", {"region": "nroth"}, r"did you mean north"),
        ("find", {"system": "system-002"}, r"did you mean system-001"),
        ("find", {"sort": "distance"}, r"say near what"),
        ("find", {"near": "P-001", "within": -1}, r"within=-1: give metres"),
        ("find", {"near": "1,2,nan"}, r"must be finite"),
        ("find", {"sort": "size"}, r"find: sort: Input should be 'auto', 'tag', 'distance' or 'height'"),
        ("find", {"typ": "valve"}, r"find has no argument 'typ'; did you mean type\?"),
        ("trace", {"start": "V-001", "direction": "sideways"}, r"'downstream' or 'upstream'"),
        ("route", {"start": "V-001"}, r"route: end: Field required"),
        ("what_if", {"close": "P-001"}, r"P-001 is no valve but a pump"),
        ("what_if", {"close": []}, r"name at least one valve"),
        ("what_if", {"close": "V-001", "sources": ["V-001"]}, r"can't be a source as well"),
        ("measure", {"a": "system-001", "b": "P-001"}, r"has no one place"),
        ("find", {"page": 2}, r"there is no page 2; this answer has 1 page"),
    ],
)
def test_wrong_arguments_are_told_with_what_would_be_right(plant, name, arguments, match):
    with pytest.raises(AskError, match=match):
        ask(plant, name, **arguments)


def test_an_unknown_tool_is_told_with_the_nearest():
    with pytest.raises(AskError, match=r"did you mean isolate\?"):
        tool_named("isolat")


@pytest.mark.parametrize("name", ["neighbors", "trace", "isolate", "what_if", "lines", "route"])
def test_a_unit_without_a_line_gets_no_answer_along_pipes(name):
    lonely = Plant(network([unit("V-001"), unit("T-001"), terminal(1)], chain("T-001 X1")))
    arguments = next(each for tool, each in calls("V-001") if tool == name)
    with pytest.raises(Unconnected, match="no line was found at V-001"):
        ask(lonely, name, **arguments)


# What the tools say


def test_overview_counts_kinds_and_says_what_is_not_known(plant):
    text = ask(plant, "overview").text
    assert "valve: 16 (gate valve 5, ball valve 4" in text
    assert "trust: valve kind unknown: V-012" in text
    assert "flow unknown in 4 of 16 lines" in text


def test_overview_counts_likely_labels_and_units_short_of_lines():
    labels = [graphs.label().model_copy(update={"likely": likely}) for likely in (True, False)]
    parts = [graphs.part(k, label=label) for k, label in enumerate(labels)]
    text = ask(Plant(network([*parts, unit("V-001"), terminal(1)], chain("V-001.N1 X1"))), "overview").text
    assert "trust: 0 parts unlabelled, 1 only likely" in text
    assert "trust: fewer lines found than needed at V-001" in text


def test_overview_says_where_corrections_may_be_missing(plant, tmp_path):
    plant.graph.save(tmp_path / "graph.json")
    reopened = Plant.open(tmp_path)
    assert "corrections" not in ask(reopened, "overview").text
    (tmp_path / "corrections.json").touch()
    os.utime(tmp_path / "graph.json", (1, 1))
    assert "trust: corrections were made that this graph may lack" in ask(reopened, "overview").text


def test_find_by_kind_names_those_that_may_be_one(plant):
    answer = ask(plant, "find", type="valve", kind="check")
    assert [row["tag"] for row in answer.values["found"]] == ["V-004", "V-006"]
    assert "NOT SURE: 1 more of unknown kind may be one" in answer.text
    assert [row["tag"] for row in ask(plant, "find", type="valves", kind="unknown").values["found"]] == ["V-012"]
    assert (
        "none of kind 'buterfly valve'; did you mean butterfly valve" in ask(plant, "find", kind="buterfly valve").text
    )


def test_find_sorts_by_distance_from_what_is_near_and_keeps_within(plant):
    found = ask(plant, "find", type="gauge", near="P-001", within=2.0).values["found"]
    assert [(row["tag"], round(row["distance_m"], 3)) for row in found] == [("G-003", 0.4), ("G-001", 0.6)]
    assert ask(plant, "find", near="3.5,0,0.8").values["found"][0]["tag"] == "P-001"


@pytest.mark.parametrize(("where", "tags"), [("north", {"P-002"}), ("north-east", set()), ("southwest", set())])
def test_find_takes_all_ninths_that_a_word_means(plant, where, tags):
    found = {row["tag"] for row in ask(plant, "find", type="pump", region=where).values["found"]}
    assert found == tags


def test_a_line_or_a_system_is_described_too(plant):
    tag = ask(plant, "lines", through="P-001").values["lines"][0]["line"]
    assert ask(plant, "describe", id=tag).values["line"]["line"] == tag
    assert ask(plant, "describe", id="system-001").values["id"] == "system-001"


def test_neighbors_are_the_next_units_with_where_they_lie(plant):
    found = {row["tag"]: row["flow"] for row in ask(plant, "neighbors", id="P-001").values["neighbors"]}
    assert found == {"G-001": "upstream", "G-003": "downstream"}
    around = {row["tag"]: row["flow"] for row in ask(plant, "neighbors", id="V-002").values["neighbors"]}
    assert around == {"G-001": "downstream", "V-001": "upstream", "V-003": "beside"}


def test_measure_says_where_and_how_far(plant):
    answer = ask(plant, "measure", a="P-001", b="P-002")
    values = answer.values
    assert (values["straight_m"], values["height_m"], values["compass"], values["vertical"]) == (
        2.0,
        0.0,
        "north",
        "level",
    )
    assert values["gap_m"] == pytest.approx(1.8)
    assert "along pipes" in answer.text


def test_isolate_says_what_is_wrong_before_what_to_close():
    nodes = [unit("T-001"), unit("V-001", "gate valve"), unit("P-001", ports=("N1", "N2")), terminal(1)]
    plant = Plant(network(nodes, chain("T-001 V-001 P-001.N1") + chain("P-001.N2 X1")))
    answer = ask(plant, "isolate", target="P-001")
    lines = answer.text.split("\n")
    assert lines[0] == "isolate P-001 (pump): CAN'T BE ISOLATED WHOLLY: 1 way stays open; 1 valve to close"
    assert lines[1].startswith("stays open\tterminal-001\topen end\tN2")
    assert [line.split("\t")[0] for line in lines].index("close") > 1
    assert answer.values["isolated"] is False


def test_what_if_says_what_is_open_before_what_is_cut_off(plant):
    text = ask(plant, "what_if", close='["V-005", "V-012"]').text
    first = [line.split("\t")[0].split(",")[0] for line in text.split("\n")]
    assert "UNKNOWN" in first[0] or "UNKNOWN" in text.split("\n")[0]
    assert first.index("mind") < first.index("unknown")
    assert "V-012 is of unknown kind: it may be a check valve" in text


def test_names_of_valves_may_come_in_one_text(plant):
    several = ask(plant, "what_if", close=["V-005", "V-007"]).values
    assert ask(plant, "what_if", close="V-005, V-007").values == several
    assert ask(plant, "what_if", close='["V-005","V-007"]').values == several


# The list of tools


def test_tools_are_described_in_few_words_and_small_schemas():
    for tool in TOOLS:
        assert len(tool.description.split()) <= 60
        assert tool.schema["type"] == "object"
        told = json.dumps([tool.name, tool.description, tool.schema], separators=(",", ":"))
        assert tokens(told) <= 450, tool.name


def test_arguments_are_taken_as_a_model_sends_them(plant):
    assert (
        ask(plant, "find", page="1", within="2.5", near="P-001").values
        == ask(plant, "find", within=2.5, near="P-001").values
    )


def test_values_are_plain_json(plant):
    for name, arguments in calls("V-002"):
        json.dumps(ask(plant, name, **arguments).values, allow_nan=False)


def test_asking_changes_nothing(tmp_path):
    graph = pumping()
    before = graph.document.model_dump_json()
    for name, arguments in calls("V-002"):
        ask(Plant(graph), name, **arguments)
    assert graph.document.model_dump_json() == before
    path = graph.save(tmp_path)
    assert Plant.open(tmp_path).name == Plant.open(path).name == tmp_path.name


@pytest.mark.slow
def test_the_scene_is_the_one_that_the_graph_is_of(tmp_path):
    (tmp_path / "plant.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 1 3 4\n")
    document = pumping(str(tmp_path / "plant.obj")).document
    graph = SceneGraph(document.model_copy(update={"config": {"load": {"unit": "m"}}}))
    assert read_scene(graph.source, graph.document.config, tmp_path).n_meshes == 1
    for source, folder in ((graph.source, None), (pumping(str(tmp_path / "gone.obj")).source, tmp_path)):
        with pytest.raises(AskError, match="isn't where it was"):
            read_scene(source, graph.document.config, folder)


def test_an_empty_graph_is_no_error():
    plant = Plant(SceneGraph(network([junction(1)], []).document))
    assert "parts 0" in ask(plant, "overview").text
    assert ask(plant, "find").values == {"found": []}
    assert ask(plant, "lines").values == {"lines": []}


# Places


def with_places():
    """A valve on the ground, one on a platform, and one out of reach."""
    box = ((0.0, 0.0, 0.0), (4.0, 4.0, 0.0))
    ground = Place(id="place-001", kind="ground", name="ground", height=0.0, area=16.0, aabb=box, parts=())
    deck = Place(
        id="place-002", kind="platform", name="platform +2.10 m (east)", height=2.1, area=4.0, aabb=box, parts=()
    )
    stairs = Place(id="place-003", kind="stairs", name="stairs", height=2.1, low=0.0, area=0.0, aabb=box, parts=())
    rows = (
        ("V-001", "place-001", "floor", 1.0),
        ("V-002", "place-002", "platform", 0.9),
        ("V-003", "place-002", "out of reach", 2.4),
    )
    units = [
        unit(tag, "ball valve", (i, 0.0, 1.0)).model_copy(
            update={"access": Access(place=place, stand=None, height=height, reach=reach)}
        )
        for i, (tag, place, reach, height) in enumerate(rows)
    ]
    return Plant(network([*units, terminal(1), ground, deck, stairs], chain("V-001 V-002 V-003 X1")))


@pytest.mark.parametrize(
    ("arguments", "tags"),
    [
        ({"level": "ground"}, ["V-001"]),
        ({"level": "platform"}, ["V-002", "V-003"]),
        ({"level": "place-002", "reach": "platform"}, ["V-002"]),
        ({"reach": "out of reach"}, ["V-003"]),
        ({"reach": "floor", "type": "end"}, []),
    ],
)
def test_find_goes_by_level_and_reach(arguments, tags):
    assert [row["tag"] for row in ask(with_places(), "find", **arguments).values["found"]] == tags


def test_levels_and_reach_are_told():
    plant = with_places()
    assert "levels 2: ground, platform +2.10 m (east); units reached from floor 1" in ask(plant, "overview").text
    assert "reach\tplatform: 0.90 m above platform +2.10 m (east)" in ask(plant, "describe", id="V-002").text
    for called in ("place-002", "platform +2.10 m (east)"):
        assert ask(plant, "describe", id=called).values["units"] == ["V-002", "V-003"]
    assert "its middle: 1.00 m above ground" in ask(plant, "approach", target="V-001").text
    assert "height\tfrom 0.00 m to 2.10 m" in ask(plant, "describe", id="place-003").text
    with pytest.raises(AskError, match=r"no level 'roof' here; there is ground, platform"):
        ask(plant, "find", level="roof")


def test_without_places_reach_is_unknown_and_not_none(plant):
    for arguments in ({"reach": "floor"}, {"level": "ground"}):
        with pytest.raises(AskError, match="unknown: this graph was built without places; build it again"):
            ask(plant, "find", **arguments)
    assert "levels unknown" in ask(plant, "overview").text


def test_isolate_names_apart_what_is_not_relied_on():
    nodes = [unit("T-001"), unit("V-001", "gate valve"), unit("V-002"), unit("P-001", ports=("N1",)), terminal(1)]
    plant = Plant(network(nodes, chain("T-001 V-001 V-002 P-001.N1") + chain("P-001 X1")))
    answer = ask(plant, "isolate", target="P-001")
    assert [valve["tag"] for valve in answer.values["valves"]] == ["V-001"]
    assert any(line.startswith("not relied on\tV-002") for line in answer.text.split("\n"))
    assumed = ask(plant, "isolate", target="P-001", assume_shutoff=True)
    assert [valve["tag"] for valve in assumed.values["valves"]] == ["V-002"]
