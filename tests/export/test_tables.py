import csv
from collections import Counter

import pytest

import graphs
import networks
from cadgraph.export.tables import write_tables
from cadgraph.model.graph import SceneGraph
from cadgraph.query.summary import summarize


def read(graph, folder):
    tables = {}
    for path in write_tables(graph, folder):
        with path.open(encoding="utf-8-sig", newline="") as file:
            tables[path.stem] = list(csv.DictReader(file))
    return tables


def test_every_table_has_its_rows(tmp_path):
    tables = read(graphs.valve_line(joints=(graphs.joint(),)), tmp_path / "new")
    assert {name: len(rows) for name, rows in tables.items()} == {
        "parts": 5, "units": 3, "connections": 2, "junctions": 0, "ends": 1, "systems": 1, "related": 1, "joints": 1,
        "clusters": 2, "contacts": 3, "meshes": 5, "facts": 0,
    }  # fmt: skip


def test_facts_name_their_node_and_no_formula_is_run(tmp_path):
    graph = graphs.valve_line()
    data = graph.to_json()
    part = next(node for node in data["nodes"] if node["layer"] == "part")
    part["facts"] = [{"key": "name", "value": "=1+1", "where": "att NAME"}]
    (row,) = read(SceneGraph.from_json(data), tmp_path)["facts"]
    assert (row["node"], row["key"], row["value"], row["where"]) == (part["id"], "name", "'=1+1", "att NAME")


def test_a_part_says_what_it_is_and_where_it_belongs(tmp_path):
    row = read(graphs.valve_line(), tmp_path)["parts"][1]
    assert row["part"] == "part-1"
    assert (row["group"], row["name"], row["confidence"]) == ("Valve assembly", "handwheel", "0.75")
    assert (row["unit"], row["cluster"]) == ("V-001", "cluster-0")
    assert (row["x_m"], row["size_x_m"], row["volume_m3"]) == ("1.0", "0.5", "0.125")
    assert (row["largest_mesh"], row["ground"]) == ("/mesh_1", "no")


def test_what_is_unknown_stays_empty(tmp_path):
    row = read(graphs.valve_line(), tmp_path)["parts"][4]
    assert (row["group"], row["confidence"], row["volume_m3"]) == ("", "", "")


def test_units_and_what_joins_them_go_by_their_tags(tmp_path):
    tables = read(graphs.valve_line(), tmp_path)
    valve, _, gauge = tables["units"]
    assert (valve["tag"], valve["kind"], valve["connected_to"], valve["related_to"], valve["cluster"]) == (
        "V-001", "ball valve", "V-002", "V-002", "cluster-0",
    )  # fmt: skip
    assert (valve["system"], gauge["system"]) == ("system-0", "")
    assert (gauge["connected_to"], gauge["related_to"]) == ("", "")
    run, end = tables["connections"]
    assert (run["from"], run["to"], run["direction"], run["length_m"]) == ("V-002", "V-001", "backward", "1.5")
    assert (run["between"], end["between"]) == ("units", "end")
    assert (tables["related"][0]["unit"], tables["related"][0]["other_unit"]) == ("V-001", "V-002")
    assert tables["clusters"][0]["n_units"] == "2"


def test_ends_systems_and_joints_say_what_the_graph_says(tmp_path):
    joints = (graphs.joint(), graphs.joint("part-2", "part-3", made=False, reasons=("gap of 4 mm", "sizes alike")))
    tables = read(graphs.valve_line(joints=joints), tmp_path)
    assert (tables["ends"][0]["end"], tables["ends"][0]["kind"], tables["ends"][0]["z_m"]) == (
        "end-0",
        "unknown",
        "3.0",
    )
    system = tables["systems"][0]
    assert (system["system"], system["n_units"], system["length_m"], system["units"]) == (
        "system-0", "2", "1.5", "V-001 V-002",
    )  # fmt: skip
    assert [(row["made"], row["gap_m"], row["score"]) for row in tables["joints"]] == [
        ("yes", "0.004", "0.875"),
        ("no", "0.004", "0.875"),
    ]
    assert tables["joints"][1]["reasons"] == "gap of 4 mm; sizes alike"


def test_tables_count_what_the_summary_counts(tmp_path):
    graph = networks.pumping()
    tables, summary = read(graph, tmp_path), summarize(graph)
    assert len(tables["connections"]) == summary.n_connected == 40
    assert Counter(row["between"] for row in tables["connections"]) == summary.between
    assert Counter(row["kind"] for row in tables["ends"]) == summary.ends
    assert (len(tables["junctions"]), len(tables["systems"])) == (summary.n_junctions, summary.n_systems)


@pytest.mark.parametrize(
    "text", ["=1+1", "+1", "-1", "@sum", "\t=1", "\r=1", " =1", "\n@x", "\x00=1", "\uff1d1"]
)  # fmt: skip
def test_text_that_a_spreadsheet_would_run_gets_an_apostrophe(tmp_path, text):
    graph = graphs.graph([graphs.part(0, text, label=graphs.label(text, text))])
    tables = read(graph, tmp_path)
    for cell in (tables["meshes"][0]["mesh"], tables["parts"][0]["largest_mesh"], tables["parts"][0]["group"]):
        assert cell.startswith("'")


def test_numbers_and_plain_text_get_no_apostrophe(tmp_path):
    graph = graphs.graph([graphs.part(0, '/a "quoted", text\nü', centroid=(-1.5, 0.0, 0.0))])
    tables = read(graph, tmp_path)
    assert tables["parts"][0]["x_m"] == "-1.5"
    assert tables["meshes"][0]["mesh"] == '/a "quoted", text\nü'


def test_excel_knows_the_encoding_by_a_byte_order_mark(tmp_path):
    assert all(path.read_bytes().startswith(b"\xef\xbb\xbf") for path in write_tables(graphs.graph(), tmp_path))


def test_an_empty_graph_has_headers_alone(tmp_path):
    assert all(rows == [] for rows in read(graphs.graph(), tmp_path).values())


def test_bytes_repeat(tmp_path):
    one, two = (
        [path.read_bytes() for path in write_tables(graphs.valve_line(), tmp_path / name)] for name in ("1", "2")
    )
    assert one == two


def test_lone_surrogates_do_not_stop_it(tmp_path):
    assert read(graphs.graph([graphs.part(0, "/a\ud800b")]), tmp_path)["meshes"][0]["mesh"] == "/ab"
