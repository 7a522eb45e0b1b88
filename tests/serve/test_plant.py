import json
import threading
import time

import pytest

import serving
from cadgraph._io.manifest import of_an_earlier_graph
from cadgraph.errors import FormatError, LoadError, OutputError
from cadgraph.model.corrections import CORRECTIONS, CorrectionsFile, read_corrections
from cadgraph.model.graph import SceneGraph
from cadgraph.serve import plant as serve_plant
from cadgraph.serve.boxes import boxes_of
from cadgraph.serve.order import Order, order_of
from cadgraph.serve.plant import Plant
from cadgraph.serve.state import Refusal
from cadgraph.session.correct import amend
from serving import label

NEVER = 1e9  # s


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return serving.make_folder(tmp_path_factory.mktemp("built"))


@pytest.fixture
def folder(built, tmp_path):
    serving.copy_of(built.parent, tmp_path / "copy")
    return tmp_path / "copy" / "out"


@pytest.fixture
def opened(request):
    """Opens a folder; the graph is written when the plant is closed."""

    def open_(folder, **more):
        plant = Plant(Order(folder, **{"scene": folder.parent / "plant.usda", **more}), "Ada", delay=NEVER)
        plant.open()
        request.addfinalizer(plant.close)
        return plant

    return open_


def names(graph):
    return {part.meshes[0]: part.label and part.label.name for part in graph.parts()}


def test_a_correction_is_on_disk_before_it_is_answered_and_the_graph_follows(opened, folder):
    plant = opened(folder)
    (folder / "report.html").write_text("<!-- cadgraph --> of the graph as it was")
    plant.edit(1, [label("part-00001", "Pipe assembly", "tee")], "seen on site")
    assert [(one.mesh, one.name) for one in read_corrections(folder)] == [("/b1", "tee")]
    assert names(SceneGraph.load(folder))["/b1"] is None
    assert plant.unsaved
    assert (folder / "report.html").exists()
    plant.close()
    assert names(SceneGraph.load(folder))["/b1"] == "tee"
    assert '"tee"' in (folder / "semantics.usda").read_text()
    assert b"shows an earlier graph" in (folder / "report.html").read_bytes()
    assert of_an_earlier_graph(folder) == ("report.html",)
    assert plant.feed.state.undo is not None


def test_after_a_kill_the_graph_follows_from_the_corrections(opened, folder):
    killed = opened(folder)
    killed.edit(1, [label("part-00001", "Pipe assembly", "tee")], "")
    again = opened(folder)
    assert names(again.shown().graph)["/b1"] == "tee"
    assert again.feed.state.version == 2, "the graph on disk, then the one that the corrections give"
    again.close()
    assert names(SceneGraph.load(folder))["/b1"] == "tee"


def test_a_folder_that_nothing_was_corrected_in_stays_as_it_is(opened, folder):
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    opened(folder).close()
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_window_that_is_behind_is_told_and_loses_nothing(opened, folder):
    plant = opened(folder)
    plant.edit(1, [label("part-00001", "Pipe assembly", "tee")], "")
    for act in (lambda: plant.edit(1, [label("part-00002", "Tank", None)], ""), lambda: plant.undo(1)):
        with pytest.raises(Refusal, match="another window") as refused:
            act()
        assert (refused.value.status, refused.value.state) == (409, plant.feed.state)
    plant.edit(2, [label("part-00002", "Tank", None)], "")
    assert [one.mesh for one in read_corrections(folder)] == ["/b1", "/b2"]


def test_what_another_program_corrected_meanwhile_is_taken_up_not_written_over(opened, folder):
    plant = opened(folder)
    plant.edit(1, [label("part-00001", "Pipe assembly", "tee")], "")
    amend(folder, "part-00002", "Pipe assembly/elbow", this_only=True, report=False)
    with pytest.raises(Refusal, match="another program") as refused:
        plant.edit(2, [label("part-00003", "Tank", None)], "")
    assert refused.value.status == 409
    plant.edit(3, [label("part-00003", "Tank", None)], "")
    assert [one.mesh for one in read_corrections(folder)] == ["/b1", "/b2", "/b3"]
    amend(folder, "part-00000", "Pipe assembly/pipe", this_only=True, report=False)
    plant.look()
    assert plant.feed.state.version == 5
    assert names(plant.shown().graph) == {"/b0": "pipe", "/b1": "tee", "/b2": "elbow", "/b3": None}


def test_corrections_that_somebody_broke_are_never_written_over(opened, folder):
    plant = opened(folder)
    (folder / CORRECTIONS).write_text("broken")
    plant.look()
    assert "corrections.json: not JSON" in plant.feed.state.read_only
    for _ in range(2):
        with pytest.raises((Refusal, serve_plant.LabelError)):
            plant.edit(1, [label("part-00003", "Tank", None)], "")
    assert (folder / CORRECTIONS).read_text() == "broken"
    (folder / CORRECTIONS).unlink()
    plant.look()
    plant.edit(plant.feed.state.version, [label("part-00003", "Tank", None)], "")
    assert len(read_corrections(folder)) == 1


def test_corrections_that_were_broken_before_are_taken_up_when_mended(opened, folder):
    amend(folder, "part-00000", "Pipe assembly/pipe", this_only=True, report=False)
    sound = (folder / CORRECTIONS).read_bytes()
    (folder / CORRECTIONS).write_text("broken")
    plant = opened(folder)
    assert plant.feed.state.status == "failed"
    assert "corrections.json: not JSON" in plant.feed.state.message
    plant.look()
    assert plant.feed.state.status == "failed"
    (folder / CORRECTIONS).write_bytes(sound)
    plant.look()
    assert (plant.feed.state.status, plant.feed.state.message) == ("ready", "")
    assert names(plant.shown().graph)["/b0"] == "pipe"


def test_a_folder_that_vanishes_is_said_and_not_made_anew(opened, folder):
    plant = opened(folder)
    plant.edit(1, [label("part-00000", "Pipe assembly", "pipe")], "")
    folder.rename(folder.with_name("elsewhere"))
    plant.look()
    assert "the folder is gone" in plant.feed.state.read_only
    with pytest.raises(Refusal, match="the folder is gone"):
        plant.edit(2, [label("part-00001", "Pipe assembly", "tee")], "")
    assert not folder.exists()
    folder.with_name("elsewhere").rename(folder)
    plant.look()
    assert plant.feed.state.read_only is None
    plant.edit(2, [label("part-00001", "Pipe assembly", "tee")], "")
    plant.close()
    assert names(SceneGraph.load(folder)) == {"/b0": "pipe", "/b1": "tee", "/b2": None, "/b3": None}


def test_what_the_disk_does_not_take_is_taken_back(opened, folder, monkeypatch):
    plant = opened(folder)
    plant.edit(1, [label("part-00001", "Pipe assembly", "tee")], "")
    before = plant.shown().content

    def full(self, history):
        raise OutputError(f"{self.file}: can't be written (No space left on device); choose another output folder")

    with monkeypatch.context() as patched:
        patched.setattr(CorrectionsFile, "write", full)
        with pytest.raises(Refusal, match="No space left") as refused:
            plant.edit(2, [label("part-00002", "Tank", None)], "")
    assert refused.value.status == 507
    assert "No space left" in plant.feed.state.read_only
    assert plant.shown().content == before
    assert not plant.audit()[0]["undone"]
    plant.edit(2, [label("part-00003", "Tank", None)], "")
    assert plant.feed.state.read_only is None
    assert [one.mesh for one in read_corrections(folder)] == ["/b1", "/b3"]
    assert names(plant.shown().graph)["/b2"] is None


def test_a_disk_that_cannot_be_written_is_said_at_once_and_when_it_can_again(opened, folder, monkeypatch):
    def read_only(path):
        raise OutputError(f"{path}: can't write there (Read-only file system); choose another output folder")

    with monkeypatch.context() as patched:
        patched.setattr(serve_plant, "ensure_writable", read_only)
        plant = opened(folder)
        assert plant.feed.state.status == "ready"
        assert "Read-only file system" in plant.feed.state.read_only
        with pytest.raises(Refusal, match="Read-only") as refused:
            plant.edit(1, [label("part-00002", "Tank", None)], "")
        assert refused.value.status == 507
        plant.look()
        assert plant.feed.state.read_only is not None
    plant.look()
    assert plant.feed.state.read_only is None


def test_a_graph_that_could_not_be_written_is_written_when_it_can(folder, monkeypatch):
    def full(*arguments):
        raise OutputError("graph.json: can't be written (No space left on device)")

    plant = Plant(Order(folder, scene=folder.parent / "plant.usda"), delay=0)
    plant.open()
    with monkeypatch.context() as patched:
        patched.setattr(serve_plant, "write_graph", full)
        plant.edit(1, [label("part-00001", "Pipe assembly", "tee")], "")
        wait_for(lambda: "corrections are kept, but the graph can't be written" in plant.feed.state.message)
    plant.look()
    wait_for(lambda: plant.feed.state.message == "the graph is written again")
    assert names(SceneGraph.load(folder))["/b1"] == "tee"
    assert plant.close() is None


def wait_for(condition):
    before = time.monotonic()
    while not condition():
        assert time.monotonic() - before < 120  # a busy machine takes its time
        time.sleep(0.01)


@pytest.mark.parametrize("how", ["gone", "changed"])
def test_without_its_scene_a_plant_is_shown_as_boxes_and_says_why(opened, tmp_path, how):
    folder = serving.make_folder(tmp_path)
    scene = folder.parent / "plant.usda"
    if how == "gone":
        scene.unlink()
    else:
        scene.write_text(scene.read_text() + "\n")
    plant = opened(folder, scene=None)
    state = plant.feed.state
    assert state.status == "ready"
    assert ("--scene" if how == "gone" else "changed since") in state.read_only
    assert plant.packed.manifest["n_meshes"] == 4
    assert json.loads(plant.shown().content)["parts"]["id"][0] == "part-00000"
    assert (plant.review(10), plant.audit()) == ([], [])
    with pytest.raises(Refusal) as refused:
        plant.edit(1, [label("part-00002", "Tank", None)], "")
    assert refused.value.status == 507


def test_a_box_lies_where_its_part_does(folder):
    graph = SceneGraph.load(folder)
    scene = boxes_of(graph)
    for number, part in enumerate(graph.parts()):
        vertices, faces = scene.mesh(number)
        low, high = (vertices + scene.origin).min(axis=0), (vertices + scene.origin).max(axis=0)
        assert [*low, *high] == pytest.approx([*part.aabb[0], *part.aabb[1]], abs=1e-6)
        a, b, c = (vertices[faces[:, corner]] for corner in range(3))
        volume = float(
            (
                (b - a)[:, [1, 2, 0]] * (c - a)[:, [2, 0, 1]] * a - (b - a)[:, [2, 0, 1]] * (c - a)[:, [1, 2, 0]] * a
            ).sum()
        )
        assert volume / 6 != pytest.approx(0)


def test_nothing_is_told_of_a_plant_that_is_still_built_and_why_one_failed(folder, tmp_path):
    plant = Plant(Order(folder))
    with pytest.raises(Refusal) as refused:
        plant.shown()
    assert refused.value.status == 423
    plant.close()
    broken = tmp_path / "broken.usda"
    broken.write_text("#usda 1.0\n(")
    failed = Plant(Order(tmp_path / "new", broken))
    failed.open()
    assert failed.feed.state.status == "failed"
    assert "broken.usda" in failed.feed.state.message
    with pytest.raises(Refusal, match="broken") as refused:
        failed.shown()
    assert refused.value.status == 503
    failed.close()


def test_work_ends_at_its_next_step_when_the_server_ends(folder):
    plant = Plant(Order(folder, scene=folder.parent / "plant.usda"))
    plant.stop()
    worker = threading.Thread(target=plant.open)
    worker.start()
    worker.join(10)
    assert plant.feed.state.status == "building"
    assert plant.idle(0)
    plant.close()


def test_a_scene_is_built_once_then_opened_again(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = serving.write_blocks(tmp_path / "plant.usda")
    order = order_of(scene, None, None, serving.NONE)
    assert (order.folder.name, order.source) == ("plant", scene)
    order.prepare()
    plant = Plant(order, delay=NEVER)
    plant.open()
    assert (plant.feed.state.status, plant.feed.state.title) == ("ready", "plant.usda")
    plant.edit(1, [label("part-00001", "Pipe assembly", "tee")], "")
    plant.close()
    assert names(SceneGraph.load(tmp_path / "plant"))["/b1"] == "tee"
    assert order_of(scene, None, None, None).source is None
    assert order_of(scene, None, None, serving.NONE).source == scene, "settings build it anew"
    scene.write_text(scene.read_text() + "\n")
    assert order_of(scene, None, None, None).source == scene, "it has changed"
    other = tmp_path / "elsewhere" / "plant.usda"
    other.parent.mkdir()
    serving.write_blocks(other)
    with pytest.raises(ValueError, match="another scene"):
        order_of(other, None, None, None)


def test_what_does_not_go_together_is_said_before_a_page_is_opened(folder, tmp_path):
    with pytest.raises(ValueError, match="--scene"):
        order_of(tmp_path / "plant.usda", None, tmp_path / "other.usda", None)
    with pytest.raises(ValueError, match="opened as they are"):
        order_of(folder, tmp_path, None, None)
    assert order_of(folder / "graph.json", None, None, None) == Order(folder)
    with pytest.raises(FormatError, match=r"graph\.json: no such file; 'cadgraph build' makes it"):
        Order(tmp_path).prepare()
    with pytest.raises(LoadError, match="no such file"):
        Order(tmp_path / "out", tmp_path / "nothing.usda").prepare()
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "report.html").write_text("somebody's")
    with pytest.raises(OutputError, match="not written by cadgraph"):
        Order(tmp_path / "taken", folder.parent / "plant.usda").prepare()
