import csv

import pytest

import graphs
from cadgraph.export.tables import write_tables


def read(graph, folder):
    tables = {}
    for path in write_tables(graph, folder):
        with path.open(encoding="utf-8-sig", newline="") as file:
            tables[path.stem] = list(csv.DictReader(file))
    return tables


def test_every_table_has_its_rows(tmp_path):
    tables = read(graphs.valve_line(), tmp_path / "new")
    assert {name: len(rows) for name, rows in tables.items()} == {
        "parts": 5, "units": 3, "relations": 3, "clusters": 2, "contacts": 3, "meshes": 5,
    }  # fmt: skip


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


def test_units_and_relations_go_by_their_tags(tmp_path):
    tables = read(graphs.valve_line(), tmp_path)
    valve, _, gauge = tables["units"]
    assert (valve["tag"], valve["kind"], valve["related_to"], valve["cluster"]) == (
        "V-001", "ball valve", "V-002", "cluster-0",
    )  # fmt: skip
    assert gauge["related_to"] == ""
    run = tables["relations"][0]
    assert (run["from"], run["to"], run["direction"], run["length_m"]) == ("V-002", "V-001", "backward", "1.5")
    assert tables["clusters"][0]["n_units"] == "2"


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
