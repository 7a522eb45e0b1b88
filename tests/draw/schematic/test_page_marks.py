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


def test_a_page_brings_the_rules_itself_that_stand_in_a_document_otherwise():
    network = Network(networks.pumping())
    alone, within = draw_diagram(network), draw_diagram(network, for_page=True)
    assert alone.replace(f"<style>{diagram_style()}</style>", "") == within
    assert alone != within
    assert "style" not in within
    assert all(rule.startswith(".schematic ") for rule in diagram_style().rstrip("}").split("}"))
