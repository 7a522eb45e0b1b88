import base64
import hashlib
import io
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

from cadgraph.config import ReportConfig
from cadgraph.draw.report import write_report
from cadgraph.errors import OutputError
from cadgraph.model.records import Connected, Terminal
from cadgraph.query.summary import connection_words, end_words, share_words, summarize

SMALL = ReportConfig(width=160, height=100, samples=1)
VOID = {"meta", "img", "link", "br", "hr", "input"}


class Page(HTMLParser):
    """Notes elements and texts, and that every element is closed."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.raw = [], [], {}
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open:
            self.raw[self.open[-1]] = self.raw.get(self.open[-1], "") + data

    def all(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


@pytest.fixture(scope="module")
def folder(scene, graph, tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    assert write_report(scene, graph, folder / "report.html", SMALL) == folder / "report.html"
    return folder


@pytest.fixture(scope="module")
def page(folder):
    return Page((folder / "report.html").read_text("utf-8"))


def test_page_asks_nothing_of_a_network(folder, page):
    text = (folder / "report.html").read_text("utf-8")
    assert not re.search(r"(https?:)?//[a-z]", re.sub(r"base64,[^\"]*", "", text))
    assert all(image["src"].startswith("data:image/") for image in page.all("img"))
    assert not page.all("link") + page.all("iframe")


def test_pictures_are_embedded_and_told_in_words(page):
    images = page.all("img")
    assert len(images) == 4
    for image in images:
        decoded = Image.open(io.BytesIO(base64.b64decode(image["src"].split(",")[1])))
        assert decoded.size == (160, 100) == (int(image["width"]), int(image["height"]))
        assert len(image["alt"]) > 20


def test_main_picture_lies_beside_the_page(folder):
    with Image.open(folder / "picture.png") as picture:
        assert picture.size == (160, 100)


def test_names_from_the_source_are_text(folder, page):
    text = (folder / "report.html").read_text("utf-8")
    assert "<script>alert" not in text
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in text
    assert "<b>demo" not in text
    assert "<i>unsure" not in text
    assert len(page.all("script")) == 1


def test_policy_lets_in_only_the_styles_and_script_of_the_page(page):
    (policy,) = [m["content"] for m in page.all("meta") if m.get("http-equiv") == "Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    for tag in ("script", "style"):
        digest = base64.b64encode(hashlib.sha256(page.raw[tag].encode()).digest()).decode()
        assert f"{tag}-src 'sha256-{digest}'" in policy
    assert not [a for _, a in page.elements if "style" in a or any(name.startswith("on") for name in a)]


def test_same_input_same_bytes(scene, graph, folder, tmp_path):
    write_report(scene, graph, tmp_path, SMALL)
    for name in ("report.html", "picture.png"):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes()


def test_input_is_not_changed(scene, graph, tmp_path):
    before, vertices = graph.to_json(), scene.vertices.copy()
    write_report(scene, graph, tmp_path, SMALL)
    assert graph.to_json() == before
    np.testing.assert_array_equal(scene.vertices, vertices)


def test_long_lists_are_cut_and_say_so(folder):
    text = (folder / "report.html").read_text("utf-8")
    assert "finding 5<" in text
    assert "finding 6<" not in text
    assert "… and 94 more" in text
    assert "… and 40 more" in text


def test_far_from_the_origin_the_pictures_are_the_same(build_scene, build_graph, folder, tmp_path):
    origin = (4.5e6, -2.4e7, 120.0)
    write_report(build_scene(origin), build_graph(origin), tmp_path, SMALL)
    assert (tmp_path / "picture.png").read_bytes() == (folder / "picture.png").read_bytes()


def test_one_mesh(build_scene, build_graph, one_mesh, tmp_path):
    written = write_report(build_scene(meshes=one_mesh), build_graph(meshes=one_mesh), tmp_path, SMALL)
    page = Page(written.read_text("utf-8"))
    assert len(page.all("img")) == 4


def test_nothing_at_all(build_scene, build_graph, tmp_path):
    text = write_report(build_scene(meshes={}), build_graph(meshes={}), tmp_path, SMALL).read_text("utf-8")
    assert not Page(text).all("img")
    assert "no triangle to draw" in text
    assert not (tmp_path / "picture.png").exists()


def test_the_page_counts_what_the_summary_counts(scene, graph, build_graph, tmp_path):
    connected = Connected(source="unit-V-001", target="unit-G-001")
    end = Terminal(id="terminal-1", point=(0.0, 0.0, 0.0), parts=("part-00000",))
    leading = Connected(source="unit-G-001", target="terminal-1")
    document = graph.document
    more = build_graph(nodes=(*document.nodes, end), edges=(*document.edges, connected, leading))
    text = write_report(scene, more, tmp_path, SMALL).read_text("utf-8")
    tiles = dict(re.findall(r"<dt>(\w+)</dt><dd>([^<]+)</dd>", text))
    summary = summarize(more)
    assert (tiles["Connections"], tiles["Ends"], tiles["Systems"]) == ("2", "1", "0")
    assert (summary.n_connected, sum(summary.ends.values()), summary.n_systems) == (2, 1, 0)
    assert connection_words(summary) in text
    assert end_words(summary) in text
    assert "Relations of Algorithm 1" in text


@pytest.mark.parametrize(
    ("count", "total", "said"),
    [
        (302, 303, "99.7 %"),
        (2999, 3000, "99.9 %"),
        (1, 30000, "0.1 %"),
        (5, 5, "100 %"),
        (0, 5, "0 %"),
        (0, 0, "0 %"),
        (1, 2, "50 %"),
    ],
)
def test_a_share_is_whole_only_where_nothing_is_missing(count, total, said):
    assert share_words(count, total) == said


def test_a_unit_without_a_line_is_named_at_the_head_of_the_page(scene, graph, build_graph, tmp_path):
    end = Terminal(id="terminal-1", point=(0.0, 0.0, 0.0), parts=("part-00000",))
    document = graph.document
    edge = Connected(source="unit-V-001", target="terminal-1")
    more = build_graph(nodes=(*document.nodes, end), edges=(*document.edges, edge))
    assert "No line was found at G-001." in write_report(scene, more, tmp_path, SMALL).read_text("utf-8")


def test_number_of_pictures_of_structures_is_limited(scene, graph, tmp_path):
    config = SMALL.model_copy(update={"max_systems": 0})
    assert len(Page(write_report(scene, graph, tmp_path, config).read_text("utf-8")).all("img")) == 3


def test_folder_that_cannot_be_made_is_an_output_error(scene, graph, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="can't be written"):
        write_report(scene, graph, tmp_path / "file" / "report.html", SMALL)
