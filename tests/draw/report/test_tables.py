from cadgraph.draw.colors import color_of_unit_type, group_colors
from cadgraph.draw.report import tables
from cadgraph.model.records import Connected, Terminal


def texts(table):
    return [[cell.text for cell in row] for row in table.rows]


def test_units_with_place_confidence_and_mesh(graph):
    table = tables.unit_table(graph, color_of_unit_type(graph, group_colors(graph)))
    titles = [column.title for column in table.columns]
    assert "Kind" not in titles
    valve = dict(zip(titles, table.rows[0], strict=True))
    assert valve["Tag"].text == "V-001"
    assert valve["Tag"].color == group_colors(graph)["Valve assembly"]
    assert valve["Confidence"].text == "80 %"
    assert valve["Cluster"].text == "cluster-000"
    assert valve["x [m]"].text == "0.000"


def test_relations_of_algorithm_1_have_a_table_of_their_own(graph):
    table = tables.related_table(graph)
    assert [column.title for column in table.columns] == ["Unit", "Other unit", "Apart [m]"]
    assert texts(table)[0][:2] == ["V-001", "G-001"]
    assert tables.connection_table(graph).rows == ()


def test_connection_along_a_pipe_shows_what_is_known(graph, build_graph):
    end = Terminal(id="terminal-1", point=(1.0, 0.0, 0.0), parts=("part-00000",))
    edge = Connected(
        source="unit-G-001", target="terminal-1", via=("part-00000",), length=0.4, diameter=0.1, direction="forward",
        reason="check valve", confidence=0.9,
    )  # fmt: skip
    document = graph.document
    more = build_graph(nodes=(*document.nodes, end), edges=(*document.edges, edge))
    assert texts(tables.connection_table(more)) == [
        ["G-001", "terminal-1", "an end", "0.400", "100", "1", "→", "check valve", "90 %"]
    ]


def test_clusters_largest_first_with_unit_counts(graph):
    rows = texts(tables.cluster_table(graph))
    assert rows[0][:5] == ["cluster-000", "pipes", "4", "4", "2"]
    assert rows[2][1] == "unlabelled"


def test_labels_count_parts_and_the_unlabelled(graph):
    rows = texts(tables.label_table(graph, group_colors(graph)))
    assert ["Valve assembly", "(group only)", "1", "14 %", "1", "80 %", "0", "geometry 1"] in rows
    assert rows[-1][:3] == ["unlabelled", "", "2"]


def test_bars_add_up_to_all_parts(graph):
    bars = tables.label_bars(graph, group_colors(graph))
    assert sum(bar.count for bar in bars) == len(graph.parts())
    assert bars[-1].hatched


def test_findings_are_grouped_by_code_and_cut(graph):
    first, many = tables.findings(graph)
    assert (first.code, first.count, first.meshes) == ("unlabelled", 1, ("/World/mystery",))
    assert (many.count, len(many.messages), many.more_messages, len(many.meshes), many.more_meshes) == (
        100, 6, 94, 60, 40,
    )  # fmt: skip


def test_settings_come_with_their_meaning(graph):
    rows = {row[0]: row for row in texts(tables.setting_table(graph))}
    assert rows["cluster.eps"][1] == "0.01"
    assert "metre" in rows["cluster.eps"][2] or "[m]" in rows["cluster.eps"][2]


def test_unknown_setting_has_no_meaning_but_is_shown(build_graph):
    rows = texts(tables.setting_table(build_graph(config={"later": {"thing": [1, 2]}})))
    assert rows == [["later.thing", "[1, 2]", "", ""]]


def test_more_rows_than_fit_are_counted(build_graph, graph):
    more = Connected(source="unit-V-001", target="unit-G-001")
    table = tables.connection_table(build_graph(edges=(*graph.document.edges, *(more for _ in range(501)))))
    assert len(table.rows) == 400
    assert table.more == 101
