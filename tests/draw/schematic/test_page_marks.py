"""What links a schematic to the rest of a page."""

import re

import networks
from cadgraph.draw.schematic import diagram_style, draw_diagram
from cadgraph.query.lines import find_lines
from cadgraph.query.network import Network


def test_everything_drawn_says_which_unit_end_or_line_it_is():
    network = Network(networks.pumping())
    drawn = draw_diagram(network, for_page=True)
    assert set(re.findall(r'data-id="([^"]*)"', drawn)) == {p for p in network.places if network.arcs(p)}
    assert set(re.findall(r'data-line="([^"]*)"', drawn)) == {line.tag for line in find_lines(network)}


def test_a_page_can_mark_each_connection_of_a_line_alone():
    network = Network(networks.pumping())
    drawn = draw_diagram(network, for_page=True)
    pieces: dict[str, list[str]] = {}
    for line, rows in re.findall(r'<path[^>]* data-line="([^"]*)" data-connection="([^"]*)"', drawn):
        pieces.setdefault(line, []).extend(rows.split())
    for line in find_lines(network):
        assert {int(row) for row in pieces[line.tag]} == {arc.index for arc in line.arcs}
    lines = [line for line in find_lines(network) if len(line.arcs) > 2]
    assert lines
    # All that stands between two connections parts their pieces.
    assert all(" " not in piece for line in lines for piece in pieces[line.tag])


def test_a_page_brings_the_rules_itself_that_stand_in_a_document_otherwise():
    network = Network(networks.pumping())
    alone, within = draw_diagram(network), draw_diagram(network, for_page=True)
    plain = re.sub(r' data-connection="[^"]*"', "", within)
    assert alone.replace(f"<style>{diagram_style()}</style>", "") == plain
    assert alone != within
    assert "style" not in within
    assert all(rule.startswith(".schematic ") for rule in diagram_style().rstrip("}").split("}"))
