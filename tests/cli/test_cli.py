import json
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import cadgraph
import graphs
import shapes
from cadgraph.cli.signals import Stopped, stoppable
from cadgraph.model.scene import Scene
from command_line import refused, run

USDA = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "box"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5]
    point3f[] points = [(0,0,0), (1,0,0), (0,1,0), (1,1,0), (0,0,1), (1,0,1), (0,1,1), (1,1,1)]
}
"""


@pytest.fixture
def scene_file(tmp_path):
    path = tmp_path / "scene.usda"
    path.write_text(USDA)
    return path


def test_build_writes_everything_and_says_what_to_open(capsys, scene_file, tmp_path):
    code, out, _ = run(capsys, "build", scene_file, "-o", tmp_path / "out", "--set", "report.samples=1")
    assert code == 0
    for name in ("graph.json", "semantics.usda", "report.html", "picture.png", "timings.json"):
        assert (tmp_path / "out" / name).stat().st_size > 0
        assert name in out or name == "timings.json"
    assert not [p for p in (tmp_path / "out").iterdir() if p.name.startswith(".")]
    assert cadgraph.SceneGraph.load(tmp_path / "out").source.n_meshes == 1


def test_show_prints_a_summary_or_json(capsys, scene_file, tmp_path):
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report", "--set", "label.labeler=none")
    shown = run(capsys, "show", tmp_path / "out")[1]
    for words in ("1 mesh, 12 triangles", "1, not labelled", "1, without pipes", "0 pairs of parts"):
        assert words in shown
    assert json.loads(run(capsys, "show", tmp_path / "out", "--json")[1])["n_parts"] == 1


@pytest.mark.parametrize("to", ["graphml", "csv", "networkx-json"])
def test_export_names_what_it_wrote(capsys, scene_file, tmp_path, to):
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report")
    code, out, _ = run(capsys, "export", tmp_path / "out", "--to", to, "-o", tmp_path / "exported")
    assert code == 0
    for line in out.splitlines():
        assert Path(line.removeprefix("wrote ")).stat().st_size > 0


def test_the_printed_settings_can_be_read_back(capsys, tmp_path):
    text = run(capsys, "config", "--set", "cluster.eps=0.02", "--set", "ground.meshes=['/a', '/b']")[1]
    (tmp_path / "settings.toml").write_text(text)
    assert run(capsys, "config", "--config", tmp_path / "settings.toml")[1] == text
    assert cadgraph.read_config(tmp_path / "settings.toml").cluster.eps == 0.02


def test_flags_win_over_the_file_and_the_file_over_the_defaults(capsys, scene_file, tmp_path):
    (tmp_path / "settings.toml").write_text('method = "paper"\n[cluster]\neps = 0.05\n')
    arguments = ("build", scene_file, "-o", tmp_path / "out", "--no-report", "--config", tmp_path / "settings.toml")
    run(capsys, *arguments, "--set", "cluster.eps=0.03")
    config = cadgraph.SceneGraph.load(tmp_path / "out").document.config
    assert config["method"] == "paper"
    assert config["cluster"]["eps"] == 0.03


def test_a_missing_file(capsys, tmp_path):
    assert "nothing.usd" in refused(capsys, "build", tmp_path / "nothing.usd", "-o", tmp_path / "out")


def test_an_empty_file(capsys, tmp_path):
    (tmp_path / "empty.usd").touch()
    assert "empty.usd" in refused(capsys, "build", tmp_path / "empty.usd", "-o", tmp_path / "out")


def test_a_text_file_named_usd(capsys, tmp_path):
    (tmp_path / "text.usd").write_text("this is no scene\n")
    assert "text.usd" in refused(capsys, "build", tmp_path / "text.usd", "-o", tmp_path / "out")


def test_a_stage_without_meshes(capsys, tmp_path):
    (tmp_path / "bare.usda").write_text('#usda 1.0\ndef Xform "a" {}\n')
    assert "bare.usda" in refused(capsys, "build", tmp_path / "bare.usda", "-o", tmp_path / "out")


def test_an_output_folder_that_cannot_be_written(capsys, scene_file, tmp_path):
    (tmp_path / "file").touch()
    message = refused(capsys, "build", scene_file, "-o", tmp_path / "file" / "out")
    assert "choose another output folder" in message


def test_a_label_file_with_an_unknown_path(capsys, scene_file, tmp_path):
    (tmp_path / "labels.json").write_text(json.dumps([{"mesh": "/nowhere", "group": "Tank", "name": "tank"}]))
    message = refused(capsys, "build", scene_file, "-o", tmp_path / "out", "--labels", tmp_path / "labels.json")
    assert "/nowhere" in message
    assert str(tmp_path / "labels.json") in message
    assert "correct its path" in message
    assert not (tmp_path / "out").exists(), "a folder that was made for nothing is gone again"


@pytest.mark.parametrize(
    ("extra", "word"),
    [
        (["--set", "cluster.eps"], "NAME=VALUE"),
        (["--set", "cluster.epsilon=1"], "cluster.epsilon"),
        (["--set", "cluster.eps=-1"], "cluster.eps"),
        (["--set", "nonsense.eps=1"], "nonsense.eps"),
        (["--method", "guess"], "method"),
        (["--ground", "/nowhere"], "'/nowhere' is not a mesh of the scene; give a path as in graph.json"),
        (["--ground", "/"], "give a mesh, as '/box' below it"),
        (["--set", "cluster.eps=true"], "cluster.eps must be a number, not true"),
        (["--config", "nothing.toml"], "nothing.toml"),
        (["--labels", "nothing.json"], "nothing.json"),
        (["--vocabulary", "nothing.yaml"], "nothing.yaml"),
    ],
)
def test_bad_flags_are_named(capsys, scene_file, tmp_path, extra, word):
    assert word in refused(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report", *extra)


def test_export_tells_what_it_could_not_write_and_refuses_a_needless_source(capsys, scene_file, tmp_path):
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report", "--set", "label.labeler=none")
    code, out, _ = run(capsys, "export", tmp_path / "out", "--to", "labels-csv", "-o", tmp_path / "exported")
    assert code == 0
    assert out.splitlines()[1].startswith("note  unlabelled: meshes without a label have no row: /")
    assert "leave --source out" in refused(capsys, "export", tmp_path / "out", "--to", "csv", "--source", scene_file)
    assert "'labels-csv' writes the labels by path" in refused(capsys, "export", tmp_path / "out", "--to", "gltf")


def test_an_unknown_export_format_lists_the_known_ones(capsys, scene_file, tmp_path):
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report")
    assert "graphml" in refused(capsys, "export", tmp_path / "out", "--to", "dwg")


@pytest.mark.parametrize("content", ["", "{", "[]", '{"format": "cadgraph", "version": 99}'])
def test_a_graph_that_is_none_is_named(capsys, tmp_path, content):
    (tmp_path / "graph.json").write_text(content)
    assert "graph.json" in refused(capsys, "show", tmp_path)


def test_labels_come_from_a_file_and_say_so(capsys, scene_file, tmp_path):
    (tmp_path / "labels.csv").write_text("mesh,group,name\n/box,Tank,shell\n")
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report", "--labels", tmp_path / "labels.csv")
    label = cadgraph.SceneGraph.load(tmp_path / "out").parts()[0].label
    assert (label.group, label.name, label.source, label.confidence) == ("Tank", "shell", "author", 1.0)


def test_another_vocabulary_is_used_and_kept(capsys, scene_file, tmp_path):
    (tmp_path / "own.yaml").write_text("groups:\n  Vessel:\n    unit: vessel\n    names: [drum]\n")
    (tmp_path / "labels.json").write_text(json.dumps([{"mesh": "/box", "group": "Vessel", "name": "drum"}]))
    flags = ("--labels", tmp_path / "labels.json", "--vocabulary", tmp_path / "own.yaml", "--no-report")
    run(capsys, "build", scene_file, "-o", tmp_path / "out", *flags)
    graph = cadgraph.SceneGraph.load(tmp_path / "out")
    assert [u.unit_type for u in graph.units()] == ["vessel"]
    assert graph.document.vocabulary == {"Vessel": {"names": ["drum"], "unit": "vessel"}}


def test_the_version_and_the_help_are_there(capsys):
    assert run(capsys, "--version")[1].strip() == f"cadgraph {cadgraph.__version__}"
    code, out, _ = run(capsys, "--help")
    assert code == 0
    for command in ("build", "demo", "show", "export", "config"):
        assert command in out


def test_it_runs_as_a_module():
    done = subprocess.run([sys.executable, "-m", "cadgraph", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("cadgraph ")


@pytest.mark.skipif(sys.platform == "win32", reason="no process can be sent Ctrl-C by itself there")
def test_ctrl_c_while_the_program_is_still_imported_ends_it_without_a_word():
    code = (
        "import signal, sys, types\n"
        # A parent in the background may have had it ignored.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "half_imported = types.ModuleType('cadgraph.cli')\n"
        "half_imported.main = lambda: signal.raise_signal(signal.SIGINT)\n"
        "sys.modules['cadgraph.cli'] = half_imported\n"
        "from cadgraph.__main__ import main\n"
        "main()\n"
        "print('went on')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_the_built_in_vocabulary_is_printed_as_a_file_to_begin_from(capsys, tmp_path):
    code, out, _ = run(capsys, "vocabulary", "show", "--yaml")
    assert code == 0
    (tmp_path / "own.yaml").write_text(out)
    assert cadgraph.read_vocabulary(tmp_path / "own.yaml") == cadgraph.default_vocabulary()


def test_a_crash_between_files_leaves_none_half_written(monkeypatch, tmp_path):
    graph = cadgraph.build(Scene.from_meshes([shapes.box()]), cadgraph.Config().replace({"label.labeler": "none"}))
    monkeypatch.setattr(Path, "replace", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(cadgraph.OutputError, match="No space left"):
        graph.save(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["a\nb.usda", "a\x01b.usda", "a\x7fb.usda"])
def test_a_name_that_no_layer_can_refer_to_is_refused_before_the_work(capsys, tmp_path, name):
    (tmp_path / name).write_text(USDA)
    assert "rename it" in refused(capsys, "build", tmp_path / name, "-o", tmp_path / "out", "--no-report")
    assert not (tmp_path / "out").exists()


def test_a_name_that_is_no_text_is_refused_in_one_line(capsys, tmp_path):
    path = tmp_path / "a\udce4.usda"
    try:
        path.write_text(USDA)
    except (OSError, UnicodeError):
        pytest.skip("this system has no such names")
    assert "rename it" in refused(capsys, "build", path, "-o", tmp_path / "out", "--no-report")
    with pytest.raises(cadgraph.LoadError, match="not UTF-8"):
        cadgraph.load(path)


def test_an_error_cannot_move_the_cursor(capsys, tmp_path):
    message = refused(capsys, "build", tmp_path / "a\x1b[31m\r\nb.usda", "-o", tmp_path / "out")
    assert message.isprintable()


@pytest.mark.parametrize(
    "command",
    [
        ("show", "{}"), ("show", "{}", "--json"), ("lines", "{}"), ("lines", "{}", "--csv"), ("lines", "{}", "--json"),
        ("find", "{}"), ("find", "{}", "--json"), ("describe", "{}", "unit-V-001"), ("explain", "{}", "unit-V-001"),
        ("explain", "{}", "unit-V-001", "--json"),
    ],
)  # fmt: skip
def test_a_tampered_graph_cannot_move_the_cursor(capsys, tmp_path, command):
    escapes = "\x1b]0;title\x07\x9b31m\u202e"
    data = graphs.valve_line().to_json()
    data["source"]["path"] += escapes
    data["diagnostics"] = [{"code": f"odd{escapes}", "message": f"odd{escapes}", "meshes": [escapes]}]
    for node in data["nodes"]:
        node.update(
            {key: node[key] + escapes for key in ("tag", "kind_guesses", "name") if isinstance(node.get(key), str)}
        )
        if node.get("label"):
            node["label"]["evidence"] = {"why": f"odd{escapes}"}
    (tmp_path / "graph.json").write_text(json.dumps(data))
    code, out, err = run(capsys, *(str(tmp_path) if word == "{}" else word for word in command))
    assert code == 0
    assert out + err
    assert all(one.isprintable() or one in "\n\t" for one in out + err)


def test_no_bars_where_nobody_looks(capsys, scene_file, tmp_path):
    (tmp_path / "labels.json").write_text('[{"mesh": "/no", "group": "Tank"}]')
    flags = ("--labels", tmp_path / "labels.json", "--no-report")
    _, out, err = run(capsys, "build", scene_file, "-o", tmp_path / "out", *flags)
    assert out == ""
    assert len(err.splitlines()) == 1


def test_ctrl_c_says_what_is_done_already(capsys, monkeypatch, tmp_path):
    def half(*_, **__):
        try:
            signal.raise_signal(signal.SIGINT)
        except BaseException as stop:
            stop.add_note("the graph is written")
            raise

    monkeypatch.setattr("cadgraph.session.run.run", half)
    assert run(capsys, "build", "a.usd", "-o", tmp_path / "out")[2].splitlines() == ["stopped; the graph is written"]


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_ctrl_c_and_a_polite_kill_end_alike(capsys, monkeypatch, tmp_path, number, code):
    handlers = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    monkeypatch.setattr("cadgraph.session.run.run", lambda *_, **__: signal.raise_signal(number))
    ended, _, err = run(capsys, "build", "a.usd", "-o", tmp_path / "out")
    assert ended == code
    assert err.splitlines() == ["stopped; nothing half-written was left, the same command starts anew"]
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == handlers


def test_a_stop_that_a_library_swallows_comes_again(capsys, monkeypatch, tmp_path):
    class Swallows:
        def __del__(self):
            signal.raise_signal(signal.SIGINT)

    def work(*_, **__):
        Swallows()
        threading.Event().wait(30)

    monkeypatch.setattr("cadgraph.cli.signals._PATIENCE", 0.05)
    monkeypatch.setattr("sys.unraisablehook", lambda _: None)
    monkeypatch.setattr("cadgraph.session.run.run", work)
    assert run(capsys, "build", "a.usd", "-o", tmp_path / "out")[0] == 130


@pytest.mark.skipif(sys.platform == "win32", reason="there the number goes to a socket")
def test_a_signal_that_woke_nobody_comes_again(capsys, monkeypatch, tmp_path):
    def work(*_, **__):
        # All that happens when the main thread was on its way into a call of the system that then waits.
        told = signal.set_wakeup_fd(-1)
        signal.set_wakeup_fd(told)
        os.write(told, bytes([signal.SIGTERM]))
        threading.Event().wait(30)

    monkeypatch.setattr("cadgraph.cli.signals._PATIENCE", 0.05)
    monkeypatch.setattr("cadgraph.session.run.run", work)
    assert run(capsys, "build", "a.usd", "-o", tmp_path / "out")[0] == 143


def test_a_signal_that_got_through_does_not_come_again(monkeypatch):
    monkeypatch.setattr("cadgraph.cli.signals._PATIENCE", 0.05)
    told = signal.set_wakeup_fd(-1)
    with stoppable():
        with pytest.raises(Stopped) as stop:
            signal.raise_signal(signal.SIGINT)
        stop.value.got_through()
        threading.Event().wait(0.2)
        with pytest.raises(Stopped):
            signal.raise_signal(signal.SIGINT)
    assert signal.set_wakeup_fd(told) == told
    assert "cadgraph-signals" not in [thread.name for thread in threading.enumerate()]


def test_a_signal_that_a_server_took_over_does_not_come_again(monkeypatch):
    monkeypatch.setattr("cadgraph.cli.signals._PATIENCE", 0.05)
    heard = []
    with stoppable():
        signal.signal(signal.SIGINT, lambda *_: heard.append(1))
        signal.raise_signal(signal.SIGINT)
        threading.Event().wait(0.2)
    assert heard == [1]


@pytest.mark.parametrize("unit", ["nan", "0", "-1", "inf", "1e-9", "mile"])
def test_a_plant_in_an_impossible_unit_is_refused(capsys, tmp_path, unit):
    message = refused(capsys, "environment", "make", "-o", tmp_path / "a.usdc", "--unit", unit)
    assert "from 1e-06 to 1000" in message
    assert "give m, dm, cm, mm" in message
    assert not (tmp_path / "a.usdc").exists()


def test_a_plant_is_written_in_a_unit_by_its_name(capsys, tmp_path):
    target = tmp_path / "a.usda"
    assert run(capsys, "environment", "make", "--preset", "riser", "-o", target, "--unit", "in")[0] == 0
    assert "metersPerUnit = 0.0254" in target.read_text()


def test_a_plant_is_drawn_as_others_draw_it(capsys, tmp_path):
    assert "gaps, overlaps" in refused(capsys, "environment", "make", "-o", tmp_path / "a.usdc", "--drawn", "badly")
    code, _, _ = run(capsys, "environment", "make", "--preset", "riser", "-o", tmp_path / "a.usdc", "--drawn", "gaps")
    assert code == 0
    assert json.loads((tmp_path / "a.truth.json").read_text())["looseness"] > 0.003


def test_want_of_memory_is_one_line(capsys, monkeypatch, tmp_path):
    def greedy(*_, **__):
        raise MemoryError

    monkeypatch.setattr("cadgraph.session.run.run", greedy)
    assert "not enough memory" in refused(capsys, "build", "a.usd", "-o", tmp_path / "out")


def test_an_earlier_report_says_so_when_the_new_run_draws_none(capsys, scene_file, tmp_path):
    small = [word for name in ("samples=1", "width=64", "height=64") for word in ("--set", f"report.{name}")]
    flags = ("-o", tmp_path / "out", *small)
    run(capsys, "build", scene_file, *flags)
    (tmp_path / "out" / "notes.txt").write_text("mine")
    (tmp_path / "out" / ".graph-abcdefgh.json").write_text("left by a killed run")
    _, out, _ = run(capsys, "build", scene_file, *flags, "--no-report")
    assert "earlier graph" not in out, "it is the same graph"
    _, out, _ = run(capsys, "build", scene_file, *flags, "--no-report", "--set", "label.labeler=none")
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    kept = ["manifest.json", "notes.txt", "picture.png", "report.html", "semantics.usda", "timings.json"]
    assert names == ["graph.json", *kept]
    assert "picture.png, report.html: of an earlier graph; 'cadgraph build' or 'relabel' draws it anew" in out
    assert b"This report shows an earlier graph" in (tmp_path / "out" / "report.html").read_bytes()
    assert "report.html: of an earlier graph" in run(capsys, "show", tmp_path / "out")[1]
    _, out, _ = run(capsys, "build", scene_file, *flags, "--no-report")
    assert "earlier graph" not in out, "it is the graph of the report again"
    assert b"This report shows an earlier graph" not in (tmp_path / "out" / "report.html").read_bytes()


def test_a_failed_run_leaves_the_earlier_results(capsys, scene_file, tmp_path):
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report")
    before = (tmp_path / "out" / "graph.json").read_bytes()
    refused(capsys, "build", scene_file, "-o", tmp_path / "out", "--ground", "/nowhere")
    assert (tmp_path / "out" / "graph.json").read_bytes() == before


def test_the_source_itself_is_refused_before_the_work(capsys, tmp_path):
    source = tmp_path / "semantics.usda"
    source.write_text(USDA + "# cadgraph\n")
    assert "this is the source itself" in refused(capsys, "build", source, "-o", tmp_path)
    assert source.read_text() == USDA + "# cadgraph\n"


def test_a_layer_that_the_source_refers_to_is_never_written_over(capsys, scene_file, tmp_path):
    run(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report")
    layer = (tmp_path / "out" / "semantics.usda").read_bytes()
    (tmp_path / "whole.usda").write_text("#usda 1.0\n( subLayers = [@out/semantics.usda@] )\n")
    message = refused(capsys, "build", tmp_path / "whole.usda", "-o", tmp_path / "out", "--no-report")
    assert "a file that the source refers to" in message
    assert (tmp_path / "out" / "semantics.usda").read_bytes() == layer


@pytest.mark.parametrize("name", ["graph.json", "semantics.usda", "scene.usdc", "report.html", "picture.png"])
def test_files_of_the_user_are_never_written_over(capsys, scene_file, tmp_path, name):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / name).write_text('{"my": "data"}')
    assert name in refused(capsys, "build", scene_file, "-o", tmp_path / "out", "--no-report")
    assert (tmp_path / "out" / name).read_text() == '{"my": "data"}'


def test_run_can_be_called_again_and_writes_over_its_own(scene_file, tmp_path):
    for _ in range(2):
        cadgraph.run(scene_file, tmp_path / "out", report=False)
    assert cadgraph.SceneGraph.load(tmp_path / "out").parts()


def test_what_may_spoil_everything_is_said_in_words(capsys, tmp_path):
    path = tmp_path / "scene.usda"
    path.write_text(USDA.replace("metersPerUnit = 1", "metersPerUnit = 0"))
    code, out, _ = run(capsys, "build", path, "-o", tmp_path / "out", "--no-report")
    assert code == 0
    assert "metersPerUnit = 0 is impossible; taken as centimetres" in out


@pytest.mark.parametrize(
    ("name", "remedy"),
    [("plant.fbx", "export it as USD or glTF"), ("plant.JT", "export it as STEP"), ("plant.dwg", "export it as IFC")],
)
def test_formats_that_others_turn_into_readable_ones_are_named_as_such(capsys, tmp_path, name, remedy):
    (tmp_path / name).write_text("anything")
    said = refused(capsys, "build", tmp_path / name, "-o", tmp_path / "out")
    assert f"{Path(name).suffix.lower()} files are not read; {remedy}" in said


def test_relabel_says_what_the_others_became(capsys, tmp_path):
    mesh = USDA.split("def Mesh", 1)
    far = mesh[1].replace('"box"', '"other"', 1).replace("(0,0,0)", "(0,0,0)")
    turned = far.rstrip().removesuffix("}") + "    double3 xformOp:translate = (9, 0, 0)\n"
    turned += '    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    (tmp_path / "scene.usda").write_text(USDA + "def Mesh" + turned)
    assert run(capsys, "build", tmp_path / "scene.usda", "-o", tmp_path / "out", "--no-report")[0] == 0
    code, out, err = run(capsys, "relabel", tmp_path / "out", "part-00000", "--as", "Tank/shell", "--no-report")
    assert code == 0, err
    assert "part-00000 is Tank/shell now" in out
    assert "part-00001 Tank/shell" in " ".join(out.split())


def test_relabel_says_which_units_are_called_otherwise_and_keeps_who_says_so(capsys, tmp_path):
    graph = ("relabel", tmp_path / "out", "--no-report", "--this-only", "--as")
    other = '    double3 xformOp:translate = ({}, 0, 0)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}}\n'
    mesh = USDA.split("def Mesh", 1)[1].rstrip().removesuffix("}")
    meshes = [f"def Mesh{mesh.replace('box', name)}{other.format(x)}" for name, x in (("b", 9), ("c", 18))]
    (tmp_path / "scene.usda").write_text(USDA + "".join(meshes))
    run(capsys, "build", tmp_path / "scene.usda", "-o", tmp_path / "out", "--no-report")
    _, out, _ = run(capsys, *graph, "Valve assembly/valve", "part-00000")
    assert "now" in out.split("other parts changed")[0]
    assert "V-" not in out
    _, out, _ = run(capsys, *graph, "Valve assembly/valve", "part-00001", "--who", "Ada", "--why", "seen there")
    assert "V-001 is now V-002" in out
    said = run(capsys, "corrections", tmp_path / "out")[1]
    assert "Ada" in said
    assert "seen there" in said
