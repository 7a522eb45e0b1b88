"""Commands and the folder of a run: one at a time, all of its files or none, and what is out of date says so."""

import gzip
import hashlib
import json
import shutil

import pytest

from cadgraph._io.folder_lock import holding
from cadgraph._io.manifest import behind, changed_by_others, manifest_in, of_an_earlier_graph
from cadgraph._io.shard_files import FOLDER
from cadgraph.draw.report import marked_as_earlier
from cadgraph.model.corrections import read_corrections
from cadgraph.model.graph import SceneGraph
from command_line import refused, run
from serving import make_folder, write_blocks

SMALL = [word for name in ("samples=1", "width=64", "height=64") for word in ("--set", f"report.{name}")]


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return make_folder(tmp_path_factory.mktemp("blocks"))


@pytest.fixture
def folder(made, tmp_path):
    shutil.copytree(made.parent, tmp_path / "place")
    return tmp_path / "place" / "out"


def digests(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir() if path.is_file()}


@pytest.mark.parametrize(
    "words",
    [
        ("build", "SCENE", "-o", "FOLDER", "--no-report"),
        ("label", "FOLDER", "--labeler", "none", "--no-report"),
        ("relabel", "FOLDER", "part-00001", "--as", "tee", "--no-report"),
        ("correct", "FOLDER", "--label", "part-00001=tee", "--no-report"),
        ("view", "FOLDER", "--no-browser"),
        ("export", "FOLDER", "--to", "csv"),
        ("export", "FOLDER", "--to", "usd"),
        ("simulate", "FOLDER"),
        ("catalog", "add", "SCENE", "--as", "Tank/tank", "--catalog", "FOLDER/parts.cadgraph-catalog"),
    ],
    ids=lambda words: "-".join(words[:1]),
)
def test_whoever_comes_second_is_refused_in_one_line_and_changes_nothing(capsys, folder, words):
    named = {"SCENE": str(folder.parent / "plant.usda"), "FOLDER": str(folder)}
    arguments = [named.get(word, word.replace("FOLDER", str(folder))) for word in words]
    before = digests(folder)
    with holding(folder):
        said = refused(capsys, *arguments)
    assert f"{folder}: another cadgraph is at work in it (this very process); end that one first" in said
    assert digests(folder) == before


def test_without_a_report_the_one_of_the_earlier_graph_stays_and_says_so(capsys, folder):
    scene = folder.parent / "plant.usda"
    run(capsys, "build", scene, "-o", folder, *SMALL, "--set", "label.labeler=none")
    code, out, _ = run(capsys, "relabel", folder, "part-00001", "--as", "Tank/tank", "--this-only", "--no-report")
    assert code == 0
    assert "picture.png, report.html: of an earlier graph" in out
    assert of_an_earlier_graph(folder) == ("picture.png", "report.html")
    assert changed_by_others(folder) == ()
    page = (folder / "report.html").read_text("utf-8")
    assert page.count("This report shows an earlier graph") == 1
    assert "report.html: of an earlier graph" in run(capsys, "show", folder)[1]
    run(capsys, "relabel", folder, "part-00001", "--forget")
    assert of_an_earlier_graph(folder) == ()
    assert "This report shows an earlier graph" not in (folder / "report.html").read_text("utf-8")


def test_a_correction_comes_with_its_graph(capsys, folder):
    run(capsys, "relabel", folder, "part-00001", "--as", "Tank/tank", "--this-only", "--no-report")
    assert len(read_corrections(folder)) == 1
    assert not behind(folder)
    (folder / "corrections.json").unlink()
    assert "corrections.json: not what this graph shows" in run(capsys, "show", folder)[1]


def test_what_goes_with_the_earlier_graph_is_named(capsys, folder):
    run(capsys, "simulate", folder)
    assert {"simulation.usda", "devices.json"} <= manifest_in(folder).files.keys()
    assert of_an_earlier_graph(folder) == ()
    _, out, _ = run(capsys, "build", folder.parent / "plant.usda", "-o", folder, "--no-report")
    assert not (folder / "simulation.usda").exists()
    assert "simulation.usda, devices.json: of the earlier graph, removed; 'cadgraph simulate' makes it anew" in out


def test_a_graph_of_another_build_is_refused_in_one_line(capsys, folder, tmp_path):
    other = write_blocks(tmp_path / "other.usda", 3)
    run(capsys, "build", other, "-o", tmp_path / "other", "--no-report")
    shutil.copy(tmp_path / "other" / "graph.json", folder / "graph.json")
    for words in (
        ("show", folder),
        ("export", folder, "--to", "csv"),
        ("relabel", folder, "part-00001", "--as", "tee"),
    ):
        assert "graph.json: not what cadgraph wrote with the other files here" in refused(capsys, *words)
    shutil.copy(tmp_path / "other" / "manifest.json", folder / "manifest.json")
    _, out, _ = run(capsys, "show", folder)
    assert "semantics.usda, timings.json: changed or taken away since it was written" in out
    (folder / "manifest.json").unlink()
    assert SceneGraph.load(folder).source.n_meshes == 3


def test_exports_of_several_files_come_together_or_not_at_all(capsys, folder, monkeypatch):
    from cadgraph.export import tables

    real, written = tables.write_atomically, []

    def failing(path, content):
        written.append(path)
        if len(written) == 3:
            raise OSError(28, "No space left on device", str(path))
        real(path, content)

    before = digests(folder)
    monkeypatch.setattr(tables, "write_atomically", failing)
    assert "No space left" in refused(capsys, "export", folder, "--to", "csv")
    assert len(written) == 3
    assert digests(folder) == before
    monkeypatch.undo()
    assert run(capsys, "export", folder, "--to", "csv")[0] == 0
    assert len(list(folder.glob("*.csv"))) > 3


def test_a_report_says_once_that_it_is_earlier_and_nothing_when_it_is_not():
    page = b"<!doctype html>\n<html><body>\n<main>x</main></body></html>"
    marked = marked_as_earlier(page, True)
    assert b"<body>\n<p id=" in marked
    assert marked_as_earlier(marked, True) == marked
    assert marked_as_earlier(marked, False) == page
    assert marked_as_earlier(page, False) == page
    assert b"shows an earlier graph" in marked_as_earlier(b"no page of ours", True)


def shown(capsys, folder):
    return json.loads(run(capsys, "show", folder, "--json")[1])["warnings"]


def test_what_is_out_of_date_or_spoilt_is_said_in_json_too(capsys, folder):
    sound = shown(capsys, folder)
    (folder / "semantics.usda").write_text("#usda 1.0\n# of cadgraph, changed\n")
    run(capsys, "relabel", folder, "part-00001", "--as", "Tank/tank", "--this-only", "--no-report")
    (folder / "semantics.usda").unlink()
    (folder / "corrections.json").unlink()
    said = [line for line in shown(capsys, folder) if line not in sound]
    assert [line.split(":")[0] for line in said] == ["semantics.usda", "corrections.json"]
    assert "changed or taken away since it was written; 'cadgraph build' makes it anew" in said[0]
    text = run(capsys, "show", folder)[1]
    assert all(line in text for line in said)


def spoilt_gone(shard):
    shard.unlink()


def spoilt_empty(shard):
    shard.write_bytes(b"")


def spoilt_edited(shard):
    shard.write_bytes(gzip.compress(gzip.decompress(shard.read_bytes()).replace(b"part-00001", b"part-00009")))


@pytest.mark.parametrize("spoil", [spoilt_gone, spoilt_empty, spoilt_edited])
def test_a_spoilt_shard_is_said(capsys, folder, spoil):
    sound = shown(capsys, folder)
    run(capsys, "export", folder, "--to", "shards")
    assert shown(capsys, folder) == sound
    [shard] = (folder / FOLDER).glob("nodes-part-*")
    spoil(shard)
    [said] = [line for line in shown(capsys, folder) if line not in sound]
    assert said.startswith(f"{FOLDER}/{shard.name}: changed or taken away since it was written")


def test_another_layout_is_the_same_graph_and_nothing_becomes_earlier(capsys, folder):
    run(capsys, "relabel", folder, "part-00001", "--as", "Tank/tank", "--this-only")
    whole, labels = (folder / "graph.json").read_bytes(), digests(folder)["semantics.usda"]
    before = shown(capsys, folder)
    for words in (("--to", "shards"), ("--to", "shards"), ("--to", "json", "-o", folder / "graph.json")):
        assert run(capsys, "export", folder, *words)[0] == 0
        assert of_an_earlier_graph(folder) == changed_by_others(folder) == ()
        assert not behind(folder)
        assert shown(capsys, folder) == before
        assert digests(folder)["semantics.usda"] == labels
    assert (folder / "graph.json").read_bytes() == whole
    assert not (folder / FOLDER).exists()


def test_what_shows_an_earlier_graph_does_so_in_another_layout_too(capsys, folder):
    run(capsys, "build", folder.parent / "plant.usda", "-o", folder, *SMALL, "--set", "label.labeler=none")
    run(capsys, "relabel", folder, "part-00001", "--as", "Tank/tank", "--this-only", "--no-report")
    run(capsys, "export", folder, "--to", "shards")
    assert of_an_earlier_graph(folder) == ("picture.png", "report.html")


def test_a_correction_leaves_a_graph_in_its_shards(capsys, folder):
    relabel = ("part-00001", "--as", "Tank/tank", "--this-only", "--no-report")
    run(capsys, "export", folder, "--to", "shards")
    assert run(capsys, "relabel", folder, *relabel)[0] == 0
    assert json.loads((folder / "graph.json").read_text())["version"] == 2
    graph = SceneGraph.load(folder)
    assert graph.part("part-00001").label.name == "tank"
    assert graph.spoilt_shards() == changed_by_others(folder) == ()
    # A build is laid out as the settings say, and takes along what no graph needs.
    run(capsys, "build", folder.parent / "plant.usda", "-o", folder, "--no-report")
    assert json.loads((folder / "graph.json").read_text())["version"] == 1
    assert not (folder / FOLDER).exists()


def test_a_correction_of_one_file_leaves_it_one(capsys, folder):
    (folder / FOLDER).mkdir()
    run(capsys, "relabel", folder, "part-00001", "--as", "Tank/tank", "--this-only", "--no-report")
    assert json.loads((folder / "graph.json").read_text())["version"] == 1


def test_a_source_that_changed_since_is_said(capsys, folder):
    scene = folder.parent / "plant.usda"
    run(capsys, "build", scene, "-o", folder, "--no-report")
    sound = shown(capsys, folder)
    scene.write_text(scene.read_text() + "\n")
    [said] = [line for line in shown(capsys, folder) if line not in sound]
    assert f"{scene}: changed since the graph was built" in said
    scene.unlink()
    assert shown(capsys, folder) == sound


def test_of_a_run_of_many_scenes_each_is_told(capsys, folder, tmp_path):
    for name in ("pump-2", "pump-10"):
        shutil.copytree(folder, tmp_path / "many" / name)
    (tmp_path / "many" / "pump-2" / "semantics.usda").unlink()
    code, out, _ = run(capsys, "show", tmp_path / "many")
    lines = out.splitlines()
    assert code == 0
    assert [line.split()[0] for line in lines] == ["pump-2", "mind", "pump-10"]
    assert "semantics.usda: changed or taken away" in lines[1]
    values = json.loads(run(capsys, "show", tmp_path / "many", "--json")[1])
    assert list(values) == ["pump-2", "pump-10"]
    assert values["pump-10"] == json.loads(run(capsys, "show", folder, "--json")[1])
    assert "graph.json: no such file; 'cadgraph build' makes it" in refused(capsys, "show", tmp_path)
    assert "none: no such file or folder; check the path" in refused(capsys, "show", tmp_path / "none")


@pytest.mark.parametrize(
    "words",
    [
        ("overview",), ("lines",), ("describe", "V-001"), ("export", "--to", "csv"), ("label",), ("simulate",),
        ("corrections",), ("relabel", "part-00001", "--forget"), ("correct", "--undo"), ("ask-folder",), ("view",),
    ],
    ids=lambda words: words[0],
)  # fmt: skip
def test_a_folder_of_several_plants_names_them(capsys, folder, tmp_path, words):
    site = tmp_path / "site"
    for name in ("skid", "pumps"):
        (site / name).mkdir(parents=True)
        shutil.copy(folder / "graph.json", site / name)
    before = sorted(site.iterdir())
    said = refused(capsys, words[0], site, *words[1:])
    assert said == f"error: {site} holds 2 plants: pumps, skid; name one, as {site / 'pumps'}"
    assert sorted(site.iterdir()) == before


@pytest.mark.parametrize(
    "words",
    [
        ("catalog", "list", "MISSING"), ("compare", "FOLDER", "MISSING"), ("evaluate", "FOLDER", "MISSING"),
        ("compare", "FOLDER", "MISSING", "--map", "MISSING"), ("vocabulary", "show", "MISSING"),
        ("config", "--config", "MISSING"), ("plan", "FOLDER", "--check", "MISSING"),
        ("simulate", "FOLDER", "--scenario", "MISSING"), ("facts", "MISSING"),
        ("label", "FOLDER", "--labeler", "lvlm", "--batch-results", "MISSING"),
    ],
    ids=" ".join,
)  # fmt: skip
def test_a_file_that_is_not_there_is_said_to_be_missing(capsys, folder, tmp_path, words):
    missing = tmp_path / "missing"
    places = {"FOLDER": folder, "MISSING": missing}
    said = refused(capsys, *(places.get(word, word) for word in words))
    made = ", or make a catalogue with 'cadgraph catalog add'" if words[0] == "catalog" else ""
    assert said == f"error: {missing}: no such file; check the path{made}"
