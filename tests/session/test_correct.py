import json

import pytest

import knobs
import shapes
from cadgraph import build, load
from cadgraph.config import Config
from cadgraph.errors import LabelError, LoadError
from cadgraph.labelers.base import Labeling
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.model.catalog import read_catalog, write_catalog
from cadgraph.model.corrections import read_corrections
from cadgraph.model.given_labels import GivenLabel, split_label
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.query.explain import explain
from cadgraph.session.catalog_builder import EMPTY, take_file, take_graph
from cadgraph.session.correct import amend, step_back_or_forth
from cadgraph.session.demo import DEMO_SCENE
from cadgraph.session.run import run
from command_line import refused
from command_line import run as command

NONE = Config().replace({"label.labeler": "none", "load.isolate": False})


def write_usda(path, meshes):
    """The meshes as USD text."""
    lines = ['#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)']
    for name, (vertices, faces) in meshes.items():
        points = ", ".join(f"({x!r}, {y!r}, {z!r})" for x, y, z in vertices.tolist())
        indices = ", ".join(str(i) for i in faces.reshape(-1).tolist())
        lines.append(
            f'def Mesh "{name}" {{\n  int[] faceVertexCounts = [{", ".join("3" * len(faces))}]\n'
            f"  int[] faceVertexIndices = [{indices}]\n  point3f[] points = [{points}]\n}}"
        )
    path.write_text("\n".join(lines))
    return path


@pytest.fixture
def scene(tmp_path):
    """Two equal hooks that touch a box, and a knob apart."""
    return write_usda(
        tmp_path / "plant.usda",
        {
            "a": knobs.hook(),
            "b": shapes.moved(knobs.hook(), translation=(1, 0, 0)),
            "box": shapes.box((2, 1, 0.1), (0.5, 0, -0.06)),
            "knob": shapes.moved(knobs.knob(), translation=(5, 0, 0)),
        },
    )


@pytest.fixture
def folder(scene, tmp_path):
    run(scene, tmp_path / "out", NONE, report=False)
    return tmp_path / "out"


def label_of(graph, mesh):
    label = graph.part(mesh).label
    return None if label is None else (label.name, label.source)


def test_a_correction_changes_the_part_and_its_repeats_and_is_kept(folder, scene):
    done = amend(folder, "/a", "handwheel", report=False)
    assert {p.meshes[0] for p in done.changed} == {"/a", "/b"}
    graph = SceneGraph.load(folder)
    assert label_of(graph, "/a") == ("handwheel", "human")
    assert label_of(graph, "/b") == ("handwheel", "repeat")
    assert {u.unit_type for u in graph.units()} == {"valve"}
    assert "handwheel" in (folder / "semantics.usda").read_text()


def test_a_later_build_into_the_folder_gives_the_same_graph(folder, scene):
    amend(folder, "/a", "Valve assembly/handwheel", report=False)
    amend(folder, "/knob", "Tank", this_only=True, report=False)
    before = (folder / "graph.json").read_bytes()
    run(scene, folder, NONE, report=False)
    assert (folder / "graph.json").read_bytes() == before
    assert len(json.loads((folder / "corrections.json").read_text())["events"]) == 2


def test_a_correction_can_be_taken_back(folder):
    before = (folder / "graph.json").read_bytes()
    amend(folder, "/a", "handwheel", report=False)
    amend(folder, "/a", None, report=False)
    assert (folder / "graph.json").read_bytes() == before
    with pytest.raises(ValueError, match="nobody corrected"):
        amend(folder, "/a", None, report=False)


def test_given_labels_stay(scene, tmp_path):
    run(scene, tmp_path / "out", NONE, labels=[GivenLabel("/b", "Tank", "tank")], report=False)
    done = amend(tmp_path / "out", "/a", "handwheel", report=False)
    assert label_of(done.outcome.graph, "/b") == ("tank", "author")


def test_when_the_source_is_gone_nothing_is_left_behind(folder, scene):
    scene.unlink()
    with pytest.raises(LoadError, match="--scene"):
        amend(folder, "/a", "handwheel", report=False)
    assert not (folder / "corrections.json").exists()


def test_whenever_a_correction_is_stopped_graph_and_corrections_agree(folder, monkeypatch):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    for name, kept in (("export.usd.write_semantics", 0), ("draw.report.write_report", 1)):
        with monkeypatch.context() as patched:
            patched.setattr(f"cadgraph.{name}", stopped)
            with pytest.raises(KeyboardInterrupt) as ended:
                amend(folder, "/knob", "Tank", this_only=True, report=True)
        assert bool(getattr(ended.value, "__notes__", ())) == bool(kept)
        assert len(read_corrections(folder)) == kept
        assert (label_of(SceneGraph.load(folder), "/knob") == (None, "human")) == bool(kept)


def test_labels_of_a_model_that_was_asked_are_kept_without_asking(folder):
    graph = json.loads((folder / "graph.json").read_text())
    graph["config"]["lvlm"]["ask"] = "all"
    for node in graph["nodes"]:
        if node["layer"] == "part" and node["meshes"] != ["/box"]:
            node["label"] = {"group": "Tank", "name": "tank", "confidence": 0.7, "source": "lvlm", "evidence": {}}
        elif node["layer"] == "part":
            node["guesses"] = [{"group": "Tank", "name": "shell", "confidence": 0.2}]
    SceneGraph.from_json(graph).save(folder)
    amend(folder, "/a", "handwheel", report=False)
    done = amend(folder, "/a", None, report=False)
    graph = done.outcome.graph
    assert {label_of(graph, mesh) for mesh in ("/a", "/b", "/knob")} == {("tank", "lvlm")}
    assert label_of(graph, "/box") is None
    assert [g.name for g in graph.part("/box").guesses] == ["shell"]


class Halves:
    """Says what the embedded labeler says, of every other part as if somebody had said so who is never sure."""

    def label(self, parts, contacts, vocabulary):
        said = EmbeddedLabeler().label(parts, contacts, vocabulary)
        answers = [
            Label(*one.said, 0.6, "mine", {"why": "looks so"}) if one is not None and part % 2 else one
            for part, one in enumerate(said.answers)
        ]
        return Labeling.judge(answers, said.thresholds, sure=said.sure)


@pytest.fixture
def halves(tmp_path):
    """The folder of the demo's plant, labelled by a program's own labeler."""
    run(DEMO_SCENE, tmp_path / "out", Config().replace({"load.isolate": False}), labeler=Halves(), report=False)
    return tmp_path / "out"


def test_a_correction_keeps_the_labels_of_an_own_labeler_and_how_sure_they_are(halves):
    before = SceneGraph.load(halves)
    content = (halves / "graph.json").read_bytes()
    assert before.config["label"]["labeler"] == "own"
    assert sum(part.label is not None and part.label.likely for part in before.parts()) > 20
    part = next(p for p in before.parts() if p.label is not None and p.label.likely and p.label.name == "pipe")
    done = amend(halves, part.id, "Pipe assembly/hose", this_only=True, report=False)
    assert [one.meshes[0] for one in done.changed] == [part.meshes[0]]
    now = SceneGraph.load(halves)
    assert now.part(part.meshes[0]).label.evidence.before.likely
    assert sum(one.label is not None and one.label.source == "mine" for one in now.parts()) > 20
    step_back_or_forth(halves, "undo", report=False)
    assert (halves / "graph.json").read_bytes() == content
    remarks = run(DEMO_SCENE, halves, Config().replace({"load.isolate": False}), report=False).remarks
    assert ["program's own labeler" in one for one in remarks] == [True]


def test_a_correction_leaves_likely_labels_of_a_model_likely(tmp_path):
    run(DEMO_SCENE, tmp_path, Config().replace({"load.isolate": False}), report=False)
    content = json.loads((tmp_path / "graph.json").read_text())
    content["config"]["lvlm"]["ask"] = "unsure"
    content["diagnostics"].append({"code": "lvlm-budget", "message": "3 parts were not asked about", "meshes": []})
    SceneGraph.from_json(content).save(tmp_path)
    before = SceneGraph.load(tmp_path)
    likely = {part.meshes[0]: part.label for part in before.parts() if part.label is not None and part.label.likely}
    pipe = before.parts(name="pipe")[0]
    amend(tmp_path, pipe.id, "Pipe assembly/hose", this_only=True, report=False)
    now = step_back_or_forth(tmp_path, "undo", report=False).outcome.graph
    assert likely
    assert {p.meshes[0]: p.label for p in now.parts() if p.label is not None and p.label.likely} == likely
    assert "lvlm-budget" in {note.code for note in now.diagnostics}
    assert [(u.tag, u.kind, u.parts) for u in now.units()] == [(u.tag, u.kind, u.parts) for u in before.units()]


def test_a_build_tells_which_labels_of_the_earlier_graph_it_does_not_have(scene, halves):
    run(scene, halves, NONE, labels=[GivenLabel("/knob", "Tank", "tank")], report=False)
    outcome = run(scene, halves, NONE, report=False)
    assert len(outcome.remarks) == 1
    assert "1 labels from outside" not in outcome.remarks[0]
    assert "1 label from outside, this one has none; build it again with --labels" in outcome.remarks[0]
    assert run(scene, halves, NONE, report=False).remarks == ()
    content = json.loads((halves / "graph.json").read_text())
    content["nodes"][0]["label"] = {"group": "Tank", "confidence": 0.7, "source": "lvlm", "evidence": {}}
    SceneGraph.from_json(content).save(halves)
    assert "'cadgraph label' gives them again" in run(scene, halves, NONE, report=False).remarks[0]


def test_a_build_without_the_labeler_of_a_program_is_refused_where_the_settings_name_it():
    with pytest.raises(LabelError, match=r"label.labeler is 'own'.*embedded or none"):
        build(load(DEMO_SCENE), Config().replace({"label.labeler": "own"}))


def test_labels_are_split_by_the_vocabulary():
    tree = default_vocabulary()
    assert split_label("Valve assembly/lever", tree) == ("Valve assembly", "lever")
    assert split_label(" Tank ", tree) == ("Tank", None)
    assert split_label("lever", tree) == ("Valve assembly", "lever")
    assert split_label("My/own part", None) == ("My", "own part")
    with pytest.raises(LabelError, match="did you mean 'Valve assembly/handwheel'"):
        split_label("Valve assembly/hanwheel", tree)
    for nonsense in ("", "/", "Tank/", "Tank/x:y"):
        with pytest.raises(LabelError):
            split_label(nonsense, tree)
    with pytest.raises(LabelError):
        split_label("A:b/c", None)


def test_a_file_gives_an_entry_for_each_shape_or_one_of_all(scene):
    taken = take_file(EMPTY, scene, "Valve assembly", "valve", config=NONE)
    assert (taken.n_parts, len(taken.added), taken.known) == (4, 3, 1)
    again = take_file(taken.catalog, scene, "Valve assembly", "valve", config=NONE)
    assert (len(again.added), again.known) == (0, 4)
    other = take_file(taken.catalog, scene, "Tank", None, config=NONE)
    assert (len(other.replaced), len(other.catalog.entries)) == (3, 3)
    assert len(take_file(EMPTY, scene, "Tank", None, merge=True, config=NONE).added) == 1


def test_a_graph_gives_its_corrected_parts_with_their_labels(folder, scene, tmp_path):
    with pytest.raises(LabelError, match="--only"):
        take_graph(EMPTY, folder)
    amend(folder, "/a", "handwheel", report=False)
    taken = take_graph(EMPTY, folder)
    assert [(e.name, e.said_by, e.mesh) for e in taken.added] == [("handwheel", "human", "/a")]
    assert len(take_graph(EMPTY, folder, only=("Valve assembly", None)).added) == 1
    file = write_catalog(taken.catalog, tmp_path / "parts.cadgraph-catalog")
    graph = run(scene, tmp_path / "new", NONE.replace({"label.catalogs": [str(file)]}), report=False).graph
    assert label_of(graph, "/b") == ("handwheel", "catalog")
    assert label_of(graph, "/knob") is None
    scene.write_text(scene.read_text() + "\n")
    with pytest.raises(LoadError, match="changed since"):
        take_graph(EMPTY, folder)


def test_a_shape_with_two_labels_in_a_graph_is_left_out(scene, tmp_path):
    given = [GivenLabel("/a", "Tank", "tank"), GivenLabel("/b", "Tank", "shell"), GivenLabel("/knob", "Tank", "shell")]
    run(scene, tmp_path / "out", NONE, labels=given, report=False)
    taken = take_graph(EMPTY, tmp_path / "out")
    assert (len(taken.added), taken.torn) == (1, 1)


def test_a_shape_that_others_have_under_another_label_is_left_out_of_a_catalogue(folder):
    amend(folder, "/a", "handwheel", report=False)
    amend(folder, "/b", "lever", this_only=True, report=False)
    taken = take_graph(EMPTY, folder, only=("Valve assembly", "lever"))
    assert (taken.added, taken.torn, taken.catalog.entries) == ((), 1, ())


def test_explanations_say_what_the_graph_knows(folder):
    told = explain(amend(folder, "/a", "handwheel", report=False).outcome.graph, "/b")
    assert (told.label, told.source, told.confidence) == ("Valve assembly/handwheel", "repeat", 1.0)
    assert "/a" in told.why
    assert [n.mesh for n in told.neighbors] == ["/box"]
    assert told.repeats == {"Valve assembly/handwheel": 1}
    assert told.unit == "V-001"
    box = explain(SceneGraph.load(folder), "/box")
    assert (box.label, box.why) == (None, "nobody has an idea")
    assert dict(box.lines())["label"] == "none"
    with pytest.raises(ValueError, match="/nowhere"):
        explain(SceneGraph.load(folder), "/nowhere")


def test_the_commands_say_what_they_did(capsys, folder, scene, tmp_path):
    code, out, _ = command(capsys, "relabel", folder, "/a", "--as", "handwheel", "--no-report")
    assert code == 0
    assert "is Valve assembly/handwheel now" in out
    assert "1 other parts changed" in out
    code, out, _ = command(capsys, "explain", folder, "/a", "--json")
    assert json.loads(out)["source"] == "human"
    assert "corrected by a user" in command(capsys, "explain", folder, "/a")[1]
    file = tmp_path / "p.cadgraph-catalog"
    code, out, _ = command(capsys, "catalog", "add", folder, "--catalog", file)
    assert code == 0
    assert "1 entry added" in out
    code, out, _ = command(capsys, "catalog", "add", scene, "--as", "Tank/tank", "--merge", "--catalog", file)
    assert len(read_catalog(file).entries) == 2
    assert len(json.loads(command(capsys, "catalog", "list", file, "--json")[1])) == 2
    assert "handwheel" in command(capsys, "catalog", "list", file)[1]
    code, out, _ = command(
        capsys, "build", scene, "-o", tmp_path / "n", "--catalog", file, "--no-report", "--labeler", "none"
    )
    assert label_of(SceneGraph.load(tmp_path / "n"), "/b") == ("handwheel", "catalog")


def test_several_corrections_are_one_and_are_undone_and_listed(capsys, folder, scene):
    before = (folder / "graph.json").read_bytes()
    code, out, _ = command(
        capsys, "correct", folder, "--label", "/a=handwheel", "--label", "/knob=Tank", "--why", "seen on site",
        "--who", "Ann [b]", "--no-report",
    )  # fmt: skip
    assert code == 0
    assert "is Valve assembly/handwheel" in out
    code, out, _ = command(capsys, "correct", folder, "--tag", "V-001=V-4711 <b>", "--no-report")
    assert "V-001 is called V-4711 <b>" in out
    graph = (folder / "graph.json").read_bytes()
    assert SceneGraph.load(folder).unit("V-4711 <b>").unit_type == "valve"
    assert "V-4711" in (folder / "semantics.usda").read_text()
    run(scene, folder, NONE, report=False)
    assert (folder / "graph.json").read_bytes() == graph
    for _ in range(2):
        assert "undone: " in command(capsys, "correct", folder, "--undo", "--no-report")[1]
    assert (folder / "graph.json").read_bytes() == before
    assert "nothing to undo" in refused(capsys, "correct", folder, "--undo")
    command(capsys, "correct", folder, "--redo", "--no-report")
    code, out, _ = command(capsys, "corrections", folder)
    rows = [line.split() for line in out.splitlines()]
    assert [row[0] for row in rows] == ["5", "4", "3", "2", "1", "5"]
    assert "Ann [b]" in out
    assert "seen on site" in out
    told = json.loads(command(capsys, "corrections", folder, "--json")[1])
    assert [row["undone"] for row in told["corrections"]] == [False, False, False, True, False]
    assert told["lost"] == []


def test_all_units_keep_their_numbers(capsys, folder):
    command(capsys, "correct", folder, "--label", "/a=handwheel", "--no-report")
    assert "V-001 keeps its tag" in command(capsys, "correct", folder, "--keep-tags", "--no-report")[1]
    assert "each that there is keeps it" in refused(capsys, "correct", folder, "--keep-tags")
    command(capsys, "correct", folder, "--undo", "--no-report")
    assert "V-001 keeps" in command(capsys, "correct", folder, "--keep-tags", "--no-report")[1]


def test_bad_corrections_end_in_one_line(capsys, folder):
    assert "--tag V-001=V-4711" in refused(capsys, "correct", folder)
    assert "one of --undo" in refused(capsys, "correct", folder, "--undo", "--tag", "V-001=x")
    assert "write it as V-001=V-4711" in refused(capsys, "correct", folder, "--tag", "V-001")
    assert "is no flow" in refused(capsys, "correct", folder, "--flow", "V-001")
    assert "are not joined" in refused(capsys, "correct", folder, "--cut", "/a", "/box")
    assert "nothing in the graph" in refused(capsys, "correct", folder, "--merge", "V-9", "/a")
    assert "too far apart" in refused(capsys, "correct", folder, "--join", "/a", "/knob", "--no-report")
    assert not (folder / "corrections.json").exists()


def test_what_a_changed_scene_lost_is_told_and_kept(capsys, folder, scene):
    command(capsys, "correct", folder, "--label", "/knob=Tank", "--no-report")
    scene.write_text(scene.read_text().replace("(5.", "(6."))
    text = scene.read_text().replace('def Mesh "knob"', 'def Mesh "moved"')
    scene.write_text(text)
    done = run(scene, folder, NONE, report=False)
    lost = "label Tank of /knob: no part of that path and shape, and none of that shape in its place"
    assert [d.message for d in SceneGraph.load(folder).diagnostics if d.code == "correction-lost"] == [lost]
    assert done.remarks == ("1 of 1 correction no longer fits; kept for a scene that holds what they are about:", lost)
    assert "no longer fits: label Tank of /knob" in command(capsys, "corrections", folder)[1]
    assert "/knob" in (folder / "corrections.json").read_text()


def test_bad_input_ends_in_one_line(capsys, folder, scene, tmp_path):
    assert "spaceship" in refused(capsys, "relabel", folder, "/a", "--as", "spaceship")
    assert "/nowhere" in refused(capsys, "relabel", folder, "/nowhere", "--as", "valve")
    assert "--forget" in refused(capsys, "relabel", folder, "/a")
    assert "--as" in refused(capsys, "catalog", "add", scene)
    assert "catalog add" in refused(capsys, "catalog", "list", tmp_path / "none")
    (tmp_path / "bad").write_bytes(b"PK\x03\x04 nonsense")
    assert "damaged" in refused(capsys, "build", scene, "-o", tmp_path / "n", "--catalog", tmp_path / "bad")
    (folder / "corrections.json").write_text("{}")
    assert "corrections.json" in refused(capsys, "build", scene, "-o", folder, "--no-report")
