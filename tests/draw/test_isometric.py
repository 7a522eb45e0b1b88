"""Isometric drawings of lines: what is on them, where it stands, and that no text lies on anything."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace
from itertools import combinations, pairwise, product

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


def through(*points, kind="pipe", **more):
    """A line of straight components through some points."""
    base = next(iter(find_components(valve_line())))
    pieces = [
        replace(base.components[0], kind=kind, start=a, end=b, centre=None, angle=0.0, branches=(), **more)
        for a, b in pairwise(points)
    ]
    return replace(base, components=tuple(pieces), instruments=())


def classes(root):
    return [element.get("class") for element in root.iter() if element.get("class")]


def test_what_lies_does_not_seem_to_stand():
    # Half way between east and south a pipe would be drawn upright, and back over the one that stands.
    line = through((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, -1.0, 1.0), (2.0, -1.0, 1.0))
    text, sheet = draw_isometric(line)
    assert sheet.turned
    assert not draw_isometric(through((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 1.0)))[1].turned
    paths = [e.get("d") for e in ET.fromstring(text).iter(f"{SVG}path") if e.get("class") == "p"]
    # The first one is the arrow to the north: up and to the left.
    (ax, ay), (bx, by) = (tuple(map(float, spot.split())) for spot in paths[0][1:].split("L"))
    assert bx < ax
    assert by < ay
    _, lying, _ = paths[1:4]
    (ax, ay), (bx, by) = (tuple(map(float, spot.split())) for spot in lying[1:].split("L"))
    assert abs(by - ay) < 0.1 * abs(bx - ax)


def test_a_skew_pipe_shows_the_way_along_the_axes():
    skew = ET.fromstring(draw_isometric(through((0.0, 0.0, 0.0), (1.0, 1.0, 0.0)))[0])
    assert classes(skew).count("k") == 1
    straight = ET.fromstring(draw_isometric(through((0.0, 0.0, 0.0), (1.0, 0.01, 0.0)))[0])
    assert "k" not in classes(straight)
    (way,) = (e.get("d") for e in skew.iter(f"{SVG}path") if e.get("class") == "k")
    ends = [tuple(map(float, spot.split())) for spot in way[1:].split("L")]
    pipe = [e.get("d") for e in skew.iter(f"{SVG}path") if e.get("class") == "p"][1]
    assert [way[1:].split("L")[0], way[1:].split("L")[-1]] == pipe[1:].split("L")
    assert len(ends) == 3


@pytest.mark.parametrize(("what", "marks"), [("gate valve", 0), ("globe valve", 1), ("ball valve", 1), (None, 0)])
def test_kinds_of_valves_differ(what, marks):
    line = through((0.0, 0.0, 0.0), (0.3, 0.0, 0.0), kind="valve", what=what)
    root = ET.fromstring(draw_isometric(line)[0])
    assert sum(1 for _ in root.iter(f"{SVG}circle")) == marks


def test_the_tag_of_an_instrument_stands_in_its_balloon_clear_of_the_pipe():
    line = through((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0))
    line = replace(line, instruments=(("G-004", "pressure gauge", (0.0, 0.0, 1.0)),))
    root = ET.fromstring(draw_isometric(line)[0])
    (balloon,) = root.iter(f"{SVG}circle")
    (tag,) = (e for e in root.iter(f"{SVG}text") if e.text == "G-004")
    assert tag.get("x") == balloon.get("cx")
    # The pipe stands at x = 0.
    assert abs(float(balloon.get("cx"))) > float(balloon.get("r"))


def test_a_valve_on_a_tap_is_drawn_as_a_valve():
    line = through((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0))
    line = replace(line, instruments=(("V-010", "relief valve", (0.0, 0.0, 1.0)),))
    root = ET.fromstring(draw_isometric(line)[0])
    assert not list(root.iter(f"{SVG}circle"))
    assert {"V-010", "relief valve"} <= {element.text for element in root.iter(f"{SVG}text")}


def test_the_bill_has_the_outlets_that_instruments_sit_on():
    line = through((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 2.0))
    outlet = replace(line.components[0], kind="branch outlet", what="branch outlet", sizes=(80, 80))
    root = ET.fromstring(draw_isometric(replace(line, outlets=(outlet, outlet)))[0])
    said = [element.text for element in root.iter(f"{SVG}text")]
    row = said.index("branch outlet on the pipe")
    assert said[row : row + 3] == ["branch outlet on the pipe", "80", "2"]


def test_a_dimension_crosses_no_pipe_where_there_is_room_beside():
    line = through((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, -2.0, -1.0), (3.0, -2.0, -1.0), (3.0, -2.0, -4.0))
    root = ET.fromstring(draw_isometric(line)[0])
    lines = {key: [] for key in "pd"}
    (drawing,) = root.iter(f"{SVG}g")
    for path in drawing.iter(f"{SVG}path"):
        if path.get("class") in lines and not path.get("d").endswith("Z"):
            spots = [tuple(map(float, spot.split())) for spot in path.get("d")[1:].split("L")]
            lines[path.get("class")] += pairwise(spots)
    assert len(lines["d"]) >= 12
    assert not any(crosses(one, other) for one, other in product(lines["p"], lines["d"]))


def crosses(one, other):
    def side(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    (a, b), (c, d) = one, other
    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


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
