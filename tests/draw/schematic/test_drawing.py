import re
import xml.etree.ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.cli import main
from cadgraph.draw.schematic import draw_diagram
from cadgraph.draw.schematic.drawing import _apart as apart
from cadgraph.draw.schematic.layout import lay_out
from cadgraph.draw.schematic.plan import plan_systems
from cadgraph.query import Network
from networks import chain, junction, network, pumping, terminal, unit

SVG = "{http://www.w3.org/2000/svg}"


def texts(svg):
    return [element.text for element in ET.fromstring(svg).iter(f"{SVG}text")]


def titles(svg):
    return [element.text for element in ET.fromstring(svg).iter(f"{SVG}title")]


def test_every_unit_is_drawn_once_with_its_tag():
    graph = pumping()
    svg = draw_diagram(graph)
    for one in graph.units():
        assert sum(title.startswith(f"{one.tag}:") for title in titles(svg)) == 1
        assert texts(svg).count(one.tag) == 1


def test_every_line_is_named_once_with_its_size():
    svg = draw_diagram(pumping())
    labels = [text for text in texts(svg) if re.match(r"L-\d{4}", text or "")]
    assert len(labels) == len(set(labels)) == 16
    assert all(re.search(r"DN \d+$", label) for label in labels)


def test_instruments_carry_the_letters_of_their_variable():
    found = texts(draw_diagram(pumping()))
    assert found.count("PI") == 5
    assert found.count("LI") == found.count("FI") == 1


def test_arrows_stand_only_where_the_flow_is_known():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    known, unknown = (network(nodes, chain("T-001 V-001 P-001", direction=d)) for d in ("forward", "unknown"))
    assert draw_diagram(known).count("<polygon") == 1
    assert draw_diagram(unknown).count("<polygon") == 0


def test_the_file_is_the_same_every_time():
    assert draw_diagram(pumping()) == draw_diagram(pumping())


@settings(max_examples=5, deadline=None)
@given(st.randoms(use_true_random=False))
def test_the_order_of_the_file_does_not_matter(random):
    document = pumping().document
    edges = list(document.edges)
    random.shuffle(edges)
    mixed = type(pumping())(document.model_copy(update={"edges": tuple(edges)}))
    assert draw_diagram(mixed) == draw_diagram(pumping())


def test_no_two_texts_overlap():
    from cadgraph.draw.schematic.layout import lay_out
    from cadgraph.draw.schematic.plan import plan_systems

    (sketch,) = plan_systems(Network(pumping()))
    placed = lay_out(sketch)
    boxes = []
    for (x, y), row in zip(placed.rows, placed.sketch.rows, strict=True):
        boxes.append((x - row.width / 2, y - row.top, x + row.width / 2, y + row.bottom))
    for (x, y), anchor in zip(placed.anchors, placed.sketch.anchors, strict=True):
        symbol = anchor.symbol
        boxes.append((x - symbol.left, y - symbol.top, x + symbol.right, y + symbol.bottom))
    for i, a in enumerate(boxes):
        for b in boxes[:i]:
            assert a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3]


def test_lines_are_orthogonal_and_rows_are_straight():
    from cadgraph.draw.schematic.layout import lay_out
    from cadgraph.draw.schematic.plan import plan_systems

    (sketch,) = plan_systems(Network(pumping()))
    placed = lay_out(sketch)
    for way in placed.ways:
        for (ax, ay), (bx, by) in zip(way, way[1:], strict=False):
            assert abs(ax - bx) < 0.01 or abs(ay - by) < 0.01
    assert all(abs(placed.ways[i][-1][1] - placed.rows[e.row][1]) < 0.01 for i, e in enumerate(sketch.edges))


@pytest.mark.parametrize("tag", ['V"<script>alert(1)</script>', "V&001", "V\x00\x1f001", "V]]>", "\ud800V", "V" * 300])
def test_hostile_tags_are_text(tag):
    nodes = [unit("T-001"), unit(tag, "gate valve", unit_type="valve"), unit("P-001")]
    edges = chain("T-001 P-001")
    edges = [
        edges[0].model_copy(update={"target": f"unit-{tag}"}),
        edges[0].model_copy(update={"source": f"unit-{tag}"}),
    ]
    svg = draw_diagram(network(nodes, edges, path="/home/<b>me</b>/a&b.usd"))
    root = ET.fromstring(svg.encode("utf-8"))
    assert {element.tag for element in root.iter()} <= {
        f"{SVG}{name}" for name in ("svg", "title", "style", "rect", "g", "path", "circle", "text", "polygon")
    }
    assert "/home/" not in svg


def test_the_title_block_names_the_file_without_its_folder():
    assert "plant.usd" in texts(draw_diagram(network([unit("T-001")], [], path="C:\\secret\\plant.usd")))


def test_a_graph_without_connections_says_so_and_names_the_units():
    found = texts(draw_diagram(network([unit("V-002"), unit("V-010")], [])))
    assert "No connections along pipes in this graph." in found
    assert "Not connected: V-002, V-010" in found


def test_one_system_can_be_drawn_alone():
    graph = pumping()
    assert "G-007" in texts(draw_diagram(graph, "system-001"))
    with pytest.raises(ValueError, match="no system is called 'system-9'; there are: system-001"):
        draw_diagram(graph, "system-9")


@pytest.mark.parametrize(
    "text",
    [
        "V-001 V-002 V-003 V-001",
        "P-001.N1 P-001.N2",
        "G-001 G-002",
        "T-001.N1 T-002.N1",
        "J1 J2 J1",
        "X1 V-001",
        "V-001 J1 V-001",
    ],
)
def test_odd_networks_are_drawn(text):
    names = dict.fromkeys(name.split(".")[0] for name in text.split())
    nodes = [junction(int(n[1:])) if n[0] == "J" else terminal(int(n[1:])) if n[0] == "X" else unit(n) for n in names]
    root = ET.fromstring(draw_diagram(network(nodes, chain(text))))
    assert root.tag == f"{SVG}svg"


@pytest.mark.parametrize("word", ["ball", "gate", "globe", "butterfly", "check", "control", "relief", "plug"])
def test_kinds_of_valves_differ(word):
    def shape(kind):
        nodes = [unit("T-001"), unit("V-001", kind), unit("P-001")]
        svg = draw_diagram(network(nodes, chain("T-001 V-001 P-001")))
        group = next(g for g in ET.fromstring(svg).iter(f"{SVG}g") if (g[0].text or "").startswith("V-001"))
        return [ET.tostring(child) for child in group[1:]]

    assert shape(f"{word} valve") != shape(None)


def test_a_change_of_size_in_a_line_is_drawn_as_a_reducer():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    svg = draw_diagram(network(nodes, chain("T-001 V-001", 80) + chain("V-001 P-001", 50)))
    assert "DN 80 to DN 50" in titles(svg)


@pytest.mark.parametrize(("ports", "hangs"), [("V-001.N1", True), ("V-001", False)])
def test_a_valve_on_the_side_of_a_run_hangs_on_a_branch(ports, hangs):
    nodes = [unit("T-001"), unit("V-001", "relief valve", ports=("N1",)), unit("P-001")]
    (row,) = plan_systems(Network(network(nodes, chain(f"T-001 {ports} P-001"))))[0].rows
    (cell,) = row.cells
    assert (cell.symbol is None, len(cell.hanging)) == ((True, 1) if hangs else (False, 0))


def test_a_pump_discharges_at_its_right_even_where_the_line_leads_back():
    nodes = [unit("T-001", ports=("N1", "N2")), unit("P-001", ports=("N1", "N2")), unit("V-001", "gate valve")]
    graph = network(nodes, chain("T-001.N1 P-001.N1") + chain("P-001.N2 V-001 T-001.N2"))
    placed = lay_out(plan_systems(Network(graph))[0])
    pump = next(i for i, anchor in enumerate(placed.sketch.anchors) if anchor.place == "unit-P-001")
    x, _ = placed.anchors[pump]
    sides = {
        edge.port: way[0][0] > x
        for edge, way in zip(placed.sketch.edges, placed.ways, strict=True)
        if edge.anchor == pump
    }
    assert sides == {"N1": False, "N2": True}


def test_the_arrow_of_a_branch_stands_where_it_has_left_the_header():
    header = ((860.0, 90.0), (950.0, 90.0))
    branch = ((860.0, 90.0), (900.0, 90.0), (900.0, 190.0), (930.0, 190.0))
    assert apart(branch, [((860.0, 90.0), (800.0, 90.0)), header]) == branch[1:]
    assert apart(branch, [((860.0, 90.0), (860.0, 10.0), (950.0, 10.0))]) == branch
    assert apart(header, [branch]) == header


def test_an_unsure_connection_is_dashed():
    nodes = [unit("T-001"), unit("V-001"), unit("P-001")]
    assert 'class="p u"' not in draw_diagram(network(nodes, chain("T-001 V-001 P-001", confidence=0.9)))
    assert 'class="p u"' in draw_diagram(network(nodes, chain("T-001 V-001 P-001", confidence=0.4)))


def test_the_command_writes_svg_and_nothing_else(tmp_path, capsys):
    pumping().save(tmp_path)
    with pytest.raises(SystemExit):
        main(["diagram", str(tmp_path), "-o", str(tmp_path / "plant.svg")])
    assert (tmp_path / "plant.svg").read_text(encoding="utf-8").startswith("<svg ")
    with pytest.raises(SystemExit) as end:
        main(["diagram", str(tmp_path), "-o", str(tmp_path / "plant.png")])
    assert end.value.code == 2
