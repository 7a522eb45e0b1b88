import base64
import re

import numpy as np
import pytest

from cadgraph.config import ReportConfig
from cadgraph.draw.report.page import write_report
from cadgraph.draw.report.pictures import draw_pictures
from cadgraph.draw.report.tables import line_table
from cadgraph.model.records import Connected

CONFIG = ReportConfig(width=240, height=150, samples=1)
CORNER = (0.3, 0.0, 0.9)  # m, above everything that is drawn


@pytest.fixture
def connected(build_graph):
    """The little plant with a connection that goes out of its way."""
    graph = build_graph()
    ends = [graph.unit(tag) for tag in ("V-001", "G-001")]
    edge = Connected(
        source=ends[0].id,
        target=ends[1].id,
        length=2.0,
        size=50,
        direction="forward",
        path=(ends[0].centroid, CORNER, ends[1].centroid),
    )
    return type(graph)(graph.document.model_copy(update={"edges": (*graph.document.edges, edge)}))


def redness(picture, point):
    (column, row), _ = picture.camera.project([point])[0][0].astype(int), None
    patch = np.asarray(picture.image)[row - 2 : row + 3, column - 2 : column + 3].astype(int)
    return (patch[..., 0] - patch[..., 2]).max()


def middle(a, b):
    return tuple((x + y) / 2 for x, y in zip(a, b, strict=True))


def test_connections_are_drawn_along_their_path(scene, connected):
    by_group = draw_pictures(scene, connected, CONFIG)[0]
    start = connected.unit("V-001").centroid
    assert redness(by_group, middle(start, CORNER)) > 100
    assert "along the pipes" in by_group.caption


def test_relations_are_drawn_in_paper_mode_and_where_nothing_is_connected(scene, graph, connected):
    assert "relations of the paper's Algorithm 1" in draw_pictures(scene, graph, CONFIG)[0].caption
    paper = {**connected.document.config, "method": "paper"}
    alike = type(graph)(connected.document.model_copy(update={"config": paper}))
    by_group = draw_pictures(scene, alike, CONFIG)[0]
    assert "relations of the paper's Algorithm 1" in by_group.caption
    assert redness(by_group, middle(alike.unit("V-001").centroid, CORNER)) < 60


def test_the_page_holds_the_schematic_as_a_picture(scene, connected, tmp_path):
    page = write_report(scene, connected, tmp_path, CONFIG).read_text(encoding="utf-8")
    (data,) = re.findall(r"data:image/svg\+xml;base64,([A-Za-z0-9+/=]+)", page)
    svg = base64.b64decode(data).decode("utf-8")
    assert svg.startswith("<svg ")
    assert "V-001" in svg
    assert 'href="#schematic"' in page
    assert "img-src data:" in page


def test_without_connections_there_is_no_schematic(scene, graph, tmp_path):
    assert "schematic" not in write_report(scene, graph, tmp_path, CONFIG).read_text(encoding="utf-8")


def test_the_line_table_has_a_row_for_each_line(connected):
    table = line_table(connected)
    assert [cell.text for cell in table.rows[0]][1:4] in (["V-001", "→", "G-001"], ["G-001", "→", "V-001"])
    assert table.rows[0][5].text == "2.000"
