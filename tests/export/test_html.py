"""The plant as one page: whole, quiet, and safe against what names hold."""

import base64
import hashlib
import json
import re
import zlib
from html.parser import HTMLParser

import pytest

import graphs
from cadgraph.config import LoadConfig
from cadgraph.draw.web import assets
from cadgraph.errors import FormatError, LoadError, OutputError
from cadgraph.export import html, write_export
from cadgraph.load import load
from cadgraph.model.records import Connected, SourceRecord, Terminal

HOSTILE = "</script><img src=x onerror=alert(1)><!--"
READ = LoadConfig(unit="m", isolate=False)
BOX = """o {name}
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1
f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4
"""


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.elements, self.texts, self.open = [], {}, None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.append(tag)
        self.open = (tag, dict(attrs).get("id", ""), dict(attrs).get("content", ""))

    def handle_data(self, data):
        if self.open:
            self.texts.setdefault(self.open, data)

    def handle_endtag(self, tag):
        self.open = None

    @property
    def data(self):
        found = {
            name.removeprefix("cadgraph-data-"): text for (_, name, _), text in self.texts.items() if "-data-" in name
        }
        return {name: zlib.decompress(base64.b64decode(text, validate=True)) for name, text in found.items()}


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "plant.obj"
    path.write_text(BOX.format(name=HOSTILE), encoding="utf-8")
    return path


@pytest.fixture
def graph(source):
    paths = load(source, READ).paths
    part = graphs.part(0, *paths, label=graphs.label(HOSTILE, HOSTILE))
    unit = graphs.unit(HOSTILE, "part-0", kind=HOSTILE)
    edge = Connected(source=unit.id, target="end-0", reason=HOSTILE)
    nodes = [part, unit, Terminal(id="end-0", point=(1, 2, 3), parts=("part-0",))]
    built = graphs.graph(nodes, [edge], config={"load": READ.model_dump(mode="json")})
    record = SourceRecord(path=str(source), sha256=hashlib.sha256(source.read_bytes()).hexdigest())
    return type(built)(built.document.model_copy(update={"source": record}))


def page_of(graph, folder):
    (file,) = write_export(graph, "html", folder).files
    return file, Page(file.read_text(encoding="utf-8"))


def test_the_page_holds_everything_that_it_shows(graph, tmp_path):
    file, page = page_of(graph, tmp_path / "out")
    assert file.name == "viewer.html"
    content, manifest = (json.loads(page.data[name]) for name in ("content", "manifest"))
    files = {manifest["instances"], *(chunk["file"] for chunk in manifest["chunks"])}
    assert set(page.data) == {"content", "manifest", "schematic", *files}
    assert content["meshes"]["part"] == [0]
    assert content["title"] == "plant.obj"
    assert manifest["n_triangles"] == 4
    assert b'data-id="unit-' in page.data["schematic"]
    assert b"<style" not in page.data["schematic"]


def test_the_same_graph_gives_the_same_page(graph, tmp_path):
    assert page_of(graph, tmp_path / "a")[0].read_bytes() == page_of(graph, tmp_path / "b")[0].read_bytes()


def test_names_are_never_markup(graph, tmp_path):
    file, page = page_of(graph, tmp_path)
    assert json.loads(page.data["content"])["network"]["units"][0]["tag"] == HOSTILE
    assert "img" not in page.elements
    assert HOSTILE not in file.read_text(encoding="utf-8")
    assert b"<img" not in page.data["schematic"]
    assert page.elements.count("script") == len(page.data) + 1


def test_nothing_tells_where_files_are_kept(graph, tmp_path):
    file, page = page_of(graph, tmp_path)
    for text in (file.read_bytes(), *page.data.values()):
        assert str(tmp_path).encode() not in text


def test_the_policy_lets_in_this_script_and_style_alone(graph, tmp_path):
    text = page_of(graph, tmp_path)[0].read_text(encoding="utf-8")
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)[1]
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    for rule, pattern in (
        ("script-src", r'<script type="module">(.*?)</script>'),
        ("style-src", r"<style>(.*?)</style>"),
    ):
        (inline,) = re.findall(pattern, text, re.DOTALL)
        assert rules[rule] == f"'sha256-{base64.b64encode(hashlib.sha256(inline.encode()).digest()).decode()}'"
    assert rules["default-src"] == "'none'"
    assert "connect-src" not in rules
    assert not re.search(r'(?:src|href)="(?!data:)', text)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("index.html", "<html></html>"),
        ("viewer.js", "'</Script>'"),
        ("viewer.css", "/*</style>*/"),
        ("viewer.js", "<!--"),
    ],
)
def test_a_damaged_page_is_refused(graph, source, monkeypatch, name, text):
    monkeypatch.setattr(html, "page_text", lambda file: text if file == name else assets.page_text(file))
    with pytest.raises(FormatError, match="install cadgraph again"):
        html.one_page(graph, load(source, READ))


def test_a_source_that_is_gone_is_asked_for_and_never_written_over(graph, source, tmp_path):
    with pytest.raises(OutputError, match="is the source"):
        html.write_html(graph, source, source)
    source.unlink()
    with pytest.raises(LoadError, match="--source FILE"):
        write_export(graph, "html", tmp_path)


def test_settings_that_are_unknown_now_are_said(graph, source, tmp_path):
    odd = type(graph)(graph.document.model_copy(update={"config": {"load": {"colour": 1}}}))
    with pytest.raises(FormatError, match=r"load\.colour"):
        html.write_html(odd, source, tmp_path / "viewer.html")
