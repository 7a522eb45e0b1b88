"""Isometric drawings of lines: what is on them, where it stands, and that no text lies on anything."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from itertools import combinations

import pytest

from cadgraph.draw.isometric import draw_isometric, write_isometrics
from cadgraph.query.components import find_components
from export.test_pcf import branching, valve_line, with_taps

SVG = "{http://www.w3.org/2000/svg}"


def drawn(graph):
    """Each line's document and sheet."""
    found = []
    for line in find_components(graph):
        text, sheet = draw_isometric(line)
        found.append((line, ET.fromstring(text), sheet))
    return found


def words(root):
    return [element.text for element in root.iter(f"{SVG}text")]


def meet(one, other):
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


@pytest.mark.parametrize(
    "graph",
    [valve_line(), with_taps(valve_line(), 0.2, 0.4, 0.6, 0.8), branching(hosted=False), branching(hosted=True)],
    ids=["line", "taps", "tee", "set-on"],
)
def test_no_text_lies_on_another_or_on_a_symbol(graph):
    for _, _, sheet in drawn(graph):
        assert not [(a, b) for (a, _), (b, _) in combinations(sheet.texts, 2) if meet(a, b)]
        assert not [text for box, text in sheet.texts if any(meet(box, solid) for solid in sheet.solid)]


def test_the_sheet_says_what_the_line_is_made_of():
    ((line, root, _),) = drawn(with_taps(valve_line(), 0.5))
    said = words(root)
    for expected in ("V-001", "ball valve", "G-001", "DN 50", "OPEN END", "CLOSED END", "N", f"LINE {line.line.tag}"):
        assert expected in said
    assert "E 0  N 0  EL 0" in said
    # From the open end to the corner, and from there to the lid.
    assert {"2400", "1090"} <= set(said)
    rows = dict(zip(said, said[1:], strict=False))
    assert rows["elbow"] == "50"
    assert said[said.index("flange") + 2] == "2"
    assert said[said.index("gasket") + 2] == "2"


def test_all_of_it_lies_on_the_sheet():
    ((_, root, sheet),) = drawn(valve_line())
    _, _, wide, high = map(float, root.get("viewBox").split())
    left = min(box[0] for box in sheet.solid)
    right = max(box[2] for box in sheet.solid)
    assert 0 < right - left < wide
    assert all(0 <= float(t.get("x")) <= wide for t in root.findall(f"{SVG}text"))
    assert all(0 <= float(t.get("y")) <= high for t in root.findall(f"{SVG}text"))


@pytest.mark.parametrize("hosted", [False, True])
def test_the_line_that_a_branch_leaves_names_the_other(hosted):
    sheets = drawn(branching(hosted=hosted))
    tags = {line.line.tag for line, _, _ in sheets}
    named = {line.line.tag: tags & set(words(root)) for line, root, _ in sheets}
    (owner,) = (tag for tag, others in named.items() if others)
    assert named[owner] < tags - {owner}


def test_axes_are_at_thirty_degrees():
    ((_, root, _),) = drawn(valve_line())
    paths = [e.get("d") for e in root.iter(f"{SVG}path") if e.get("class") == "p"]
    slopes = set()
    for path in paths:
        ends = [tuple(map(float, spot.split())) for spot in path[1:].split("L")]
        (ax, ay), (bx, by) = ends[0], ends[-1]
        if abs(bx - ax) > 10:
            slopes.add(round((by - ay) / (bx - ax), 1))
    assert slopes == {0.6, -0.6}


def test_text_of_a_graph_is_escaped():
    graph = valve_line()
    nodes = [
        node.model_copy(update={"tag": "<script>\n&\x00", "kind": "a" * 500}) if node.layer == "unit" else node
        for node in graph.document.nodes
    ]
    graph = type(graph)(graph.document.model_copy(update={"nodes": tuple(nodes)}))
    ((_, root, _),) = drawn(graph)
    assert root.find(f".//{SVG}script") is None
    assert "<script> & " in words(root)
    assert max(map(len, words(root))) <= 48


def test_one_file_a_line_and_the_same_bytes_again(tmp_path):
    files, notes = write_isometrics(branching(hosted=False), tmp_path / "a")
    again, _ = write_isometrics(branching(hosted=False), tmp_path / "b")
    assert len(files) == 3
    assert notes == ()
    assert [file.read_bytes() for file in files] == [file.read_bytes() for file in again]
