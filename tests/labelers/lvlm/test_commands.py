import json
import shlex

import pytest

import plates
from cadgraph.cli import main
from cadgraph.load import load
from cadgraph.model.graph import SceneGraph
from chat_server import ChatServer

SMALL = ("--set", "lvlm.size=128", "--set", "load.isolate=false", "--set", "inspect.hidden=false", "--no-report")


@pytest.fixture(autouse=True)
def _no_settings_from_outside(monkeypatch):
    monkeypatch.delenv("OPENAI_BASE_URL", raising=False)
    monkeypatch.setenv("OPENAI_API_KEY", "x")


def usda(scene):
    lines = ['#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n']
    for i in range(scene.n_meshes):
        vertices, faces = scene.mesh(i)
        points = ", ".join(f"({x}, {y}, {z})" for x, y, z in vertices.tolist())
        indices = ", ".join(str(k) for k in faces.reshape(-1).tolist())
        counts = ", ".join(["3"] * len(faces))
        lines.append(
            f'def Mesh "mesh_{i}"\n{{\n    int[] faceVertexCounts = [{counts}]\n'
            f"    int[] faceVertexIndices = [{indices}]\n    point3f[] points = [{points}]\n}}\n"
        )
    return "".join(lines)


@pytest.fixture
def scene_file(tmp_path):
    path = tmp_path / "plates.usda"
    path.write_text(usda(plates.scene_of(3)))
    return path


def run(capsys, *arguments):
    code = 0
    try:
        main([str(a) for a in arguments])
    except SystemExit as end:
        code = end.code or 0
    out, err = capsys.readouterr()
    return code, out, err


def parts_in(scene_file):
    return plates.parts_of(load(scene_file))


def labels_in(folder):
    return {
        part.meshes[0]: None if part.label is None else (part.label.group, part.label.name)
        for part in SceneGraph.load(folder).parts()
    }


def wanted(scene_file):
    parts = parts_in(scene_file)
    return dict(zip(parts.scene.paths, plates.truth_of(parts), strict=True))


def test_build_asks_a_server_and_a_second_run_asks_nothing(capsys, scene_file, tmp_path):
    server = ChatServer(plates.oracle(parts_in(scene_file)))
    with server.running() as address:
        arguments = ("build", scene_file, "-o", tmp_path / "out", "--labeler", "lvlm", "--base-url", address, "--yes")
        code, _, err = run(capsys, *arguments, *SMALL)
        assert code == 0
        assert "3 questions" in err
        assert labels_in(tmp_path / "out") == wanted(scene_file)
        first = (tmp_path / "out" / "graph.json").read_bytes()
        assert run(capsys, *arguments, *SMALL)[0] == 0
    assert len(server.bodies) == 3
    assert (tmp_path / "out" / "graph.json").read_bytes() == first
    record = json.loads((tmp_path / "out" / "lvlm" / "run.json").read_text())
    assert (record["asked"], record["from_cache"]) == (0, 3)


def test_nobody_there_to_confirm_asks_nothing(capsys, scene_file, tmp_path):
    server = ChatServer(plates.oracle(parts_in(scene_file)))
    with server.running() as address:
        code, _, err = run(
            capsys, "build", scene_file, "-o", tmp_path / "out", "--labeler", "lvlm", "--base-url", address, *SMALL
        )
    assert code == 2
    assert "--yes" in err
    assert server.bodies == []


def test_a_dry_run_can_be_answered_by_hand(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, "--labeler", "lvlm", "--dry-run", *SMALL)[0] == 0
    assert set(labels_in(out).values()) == {None}
    folders = sorted((out / "lvlm" / "questions").glob("q-*"))
    assert len(folders) == 3
    answer = plates.oracle(parts_in(scene_file))
    for folder in folders:
        assert len(list(folder.glob("view*.jpg"))) == 6
        prompt = (folder / "prompt.md").read_text()
        (folder / "answer.json").write_text(json.dumps(answer(prompt)))
    index = json.loads((out / "lvlm" / "questions" / "index.json").read_text())
    assert sorted(index) == [folder.name for folder in folders]
    (folders[1] / "answer.json").write_text("a flange, I think")
    code, _, err = run(capsys, "label", out, "--from-folder", out / "lvlm" / "questions", "--no-report")
    assert code == 0
    found, truth = labels_in(out), wanted(scene_file)
    missing = set(index[folders[1].name])
    assert {mesh for mesh, label in found.items() if label is None} == missing
    assert all(found[mesh] == truth[mesh] for mesh in found if mesh not in missing)
    assert "no JSON object" in err


@pytest.fixture
def labelled(capsys, scene_file, tmp_path):
    """A folder whose graph a server has labelled, and its bytes."""
    out = tmp_path / "out"
    with ChatServer(plates.oracle(parts_in(scene_file))).running() as address:
        arguments = ("build", scene_file, "-o", out, "--labeler", "lvlm", "--base-url", address, "--yes")
        assert run(capsys, *arguments, *SMALL)[0] == 0
    (out / "lvlm" / "answers.sqlite").unlink()
    return out, (out / "graph.json").read_bytes()


@pytest.mark.parametrize("arguments", [("--dry-run",), ("--batch",)])
def test_asking_without_answers_changes_no_result(capsys, labelled, arguments):
    out, before = labelled
    code, printed, _ = run(capsys, "label", out, "--labeler", "lvlm", *arguments, "--no-report")
    assert code == 0
    assert "no result was touched" in printed
    assert (out / "graph.json").read_bytes() == before
    assert any((out / "lvlm").glob("questions/q-*" if "--dry-run" in arguments else "batch-001.jsonl"))


def test_building_anew_without_answers_changes_no_result(capsys, labelled, scene_file):
    out, before = labelled
    assert run(capsys, "build", scene_file, "-o", out, "--labeler", "lvlm", "--dry-run", *SMALL)[0] == 0
    assert (out / "graph.json").read_bytes() == before


def test_an_empty_folder_of_answers_is_an_error(capsys, labelled, tmp_path):
    out, before = labelled
    (tmp_path / "nothing").mkdir()
    code, _, err = run(capsys, "label", out, "--labeler", "lvlm", "--from-folder", tmp_path / "nothing", "--no-report")
    assert code == 2
    assert "no answer to any of the 3 questions" in err
    assert (out / "graph.json").read_bytes() == before


@pytest.mark.parametrize("order", ["400", "500"])
def test_a_server_that_only_fails_is_an_error_with_its_reason(capsys, labelled, scene_file, order):
    out, before = labelled
    server = ChatServer(plates.oracle(parts_in(scene_file)), [order] * 99)
    with server.running() as address:
        asked = ("--labeler", "lvlm", "--base-url", address, "--yes", "--set", "lvlm.retries=0", "--no-report")
        code, _, err = run(capsys, "label", out, *asked)
    assert code == 2
    assert order in " ".join(err.split())
    assert (out / "graph.json").read_bytes() == before


def test_parts_without_an_answer_keep_their_labels_and_are_counted(capsys, labelled, scene_file):
    out, _ = labelled
    before = labels_in(out)
    server = ChatServer(plates.oracle(parts_in(scene_file)), ["500"])
    with server.running() as address:
        asked = ("--labeler", "lvlm", "--base-url", address, "--yes", "--set", "lvlm.retries=0", "--no-report")
        code, _, err = run(capsys, "label", out, *asked)
    assert code == 0
    assert labels_in(out) == before
    assert "2 parts have no answer" in err


def test_a_dry_run_tells_its_estimate_and_its_limits_are_not_kept(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    dry = ("--labeler", "lvlm", "--dry-run", "--max-questions", "1", "--max-cost", "5", "--model", "gpt-4o-mini")
    code, _, err = run(capsys, "build", scene_file, "-o", out, *dry, *SMALL)
    assert code == 0
    assert "1 questions to gpt-4o-mini: about " in err
    assert "$0." in err
    assert "2 are left out" in err
    assert "nobody is asked now" in err
    stored = SceneGraph.load(out).document.config["lvlm"]
    assert (stored["max_questions"], stored["max_cost"]) == (None, None)
    # What was asked for without a dry run stays what it was.
    assert stored["ask"] == "all"


def test_a_dry_run_over_a_finished_graph_touches_no_result(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, *SMALL)[0] == 0
    results = [path for path in out.iterdir() if path.is_file()]
    before = {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in results}
    for way in ("--dry-run", "--batch"):
        code, told, err = run(capsys, "label", out, "--labeler", "lvlm", way, "--max-questions", "2")
        assert code == 0
        assert "2 questions to gpt-4o" in err
        assert "no result was touched" in told
    assert {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in before} == before
    assert sorted(path.name for path in out.iterdir() if path.is_file()) == sorted(path.name for path in before)
    assert len(list((out / "lvlm" / "questions").glob("q-*"))) == 2
    assert len((out / "lvlm" / "batch-001.jsonl").read_text().splitlines()) == 2


def test_questions_are_answered_in_place_checked_and_applied(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, *SMALL)[0] == 0
    before = (out / "graph.json").read_bytes()
    code, told, _ = run(capsys, "ask-folder", out, "--all", "--set", "lvlm.size=128")
    assert code == 0
    assert "0 answered, 3 open, 0 malformed" in told
    assert (out / "graph.json").read_bytes() == before
    questions = out / "lvlm" / "questions"
    assert "answer.json" in (questions / "SKILL.md").read_text()
    first, second, third = (questions / name for name in (questions / "open.txt").read_text().split())
    answer = plates.oracle(parts_in(scene_file))
    (first / "answer.json").write_text(json.dumps(answer((first / "prompt.md").read_text())))
    (second / "answer.json").write_text("a flange, I think")
    code, told, _ = run(capsys, "ask-folder", out, "--check")
    assert code == 1
    assert "1 answered, 1 open, 1 malformed" in told
    assert f"malformed {second.name}: it held no JSON object" in told
    (second / "answer.json").write_text(json.dumps(answer((second / "prompt.md").read_text())))
    (questions / "notes.txt").write_text("x")
    code, told, _ = run(capsys, "ask-folder", out, "--check")
    assert code == 1
    assert "astray    notes.txt" in told
    (questions / "notes.txt").unlink()
    code, told, _ = run(capsys, "ask-folder", out, "--check")
    assert code == 0
    assert f"open      {third.name}" in told
    assert (questions / "open.txt").read_text() == f"{third.name}\n"
    # The settings of the questions lie beside them: nothing has to be said again.
    assert run(capsys, "label", out, "--from-folder", questions, "--no-report")[0] == 0
    index = json.loads((questions / "index.json").read_text())
    found, truth = labels_in(out), wanted(scene_file)
    answered = [*index[first.name], *index[second.name]]
    assert len(answered) == 4
    assert all(found[mesh] == truth[mesh] for mesh in answered)
    stored = SceneGraph.load(out).document.config["lvlm"]
    assert (stored["ask"], stored["size"]) == ("all", 128)


def test_only_the_questions_of_the_index_count(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, *SMALL)[0] == 0
    asked = ("ask-folder", out, "--all", "--max-questions", "1", "--set", "lvlm.size=128")
    assert "1 open" in run(capsys, *asked)[1]
    questions = out / "lvlm" / "questions"
    apply = ("label", out, "--from-folder", questions, "--no-report")
    assert "no answer to the question (waiting for its answer)" in run(capsys, *apply)[2]
    index = json.loads((questions / "index.json").read_text())
    [name] = index
    answer = plates.oracle(parts_in(scene_file))((questions / name / "prompt.md").read_text())
    (questions / name / "answer.json").write_text(json.dumps(answer))
    code, _, err = run(capsys, *apply)
    assert code == 0
    assert "parts have no answer" not in err
    found, truth = labels_in(out), wanted(scene_file)
    assert all(found[mesh] == truth[mesh] for mesh in index[name])
    told = {one.code: one.message for one in SceneGraph.load(out).diagnostics}
    assert told["lvlm-budget"].endswith("parts were not asked about: the questions there are about others")
    assert SceneGraph.load(out).document.config["lvlm"]["max_questions"] is None


def test_questions_about_something_else_are_an_error(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, *SMALL)[0] == 0
    assert run(capsys, "ask-folder", out, "--all", "--set", "lvlm.size=128")[0] == 0
    apply = ("label", out, "--from-folder", out / "lvlm" / "questions", "--no-report", "--set", "lvlm.size=256")
    code, _, err = run(capsys, *apply)
    assert code == 2
    assert "none of the 3 questions there is one about this graph as it is set" in " ".join(err.split())


def test_a_dry_run_ends_with_the_command_that_takes_its_answers(capsys, scene_file, tmp_path):
    out = tmp_path / "the results"
    assert run(capsys, "build", scene_file, "-o", out, *SMALL)[0] == 0
    _, told, _ = run(capsys, "label", out, "--labeler", "lvlm", "--dry-run", "--no-report")
    command = told.splitlines()[-1].partition(": cadgraph ")[2]
    assert shlex.split(command) == ["label", str(out), "--from-folder", str(out / "lvlm" / "questions")]


def test_growing_a_vocabulary_has_no_option_that_means_nothing_to_it(capsys, scene_file, tmp_path):
    for option in ("--labeler", "--votes", "--hints", "--yes", "--batch", "--paper-views"):
        code, _, err = run(capsys, "vocabulary", "grow", scene_file, "-o", tmp_path / "new.yaml", option)
        assert code == 2
        assert f"No such option: {option}" in err


def test_questions_go_where_they_are_wanted(capsys, scene_file, tmp_path):
    out, to = tmp_path / "out", tmp_path / "for an agent"
    assert run(capsys, "build", scene_file, "-o", out, *SMALL)[0] == 0
    code, _, _ = run(capsys, "ask-folder", out, "--all", "--to", to, "--max-questions", "1", "--set", "lvlm.size=128")
    assert code == 0
    assert len(list(to.glob("q-*"))) == len(json.loads((to / "index.json").read_text())) >= 1
    assert not (out / "lvlm" / "questions").exists()
    assert str(to) in (to / "SKILL.md").read_text()
    assert run(capsys, "ask-folder", out, "--check")[0] == 2


@pytest.mark.slow
def test_batch_requests_are_written_and_results_read_back(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, "--labeler", "lvlm", "--batch", *SMALL)[0] == 0
    rows = [json.loads(line) for line in (out / "lvlm" / "batch-001.jsonl").read_text().splitlines()]
    assert len(rows) == 3
    assert {(row["method"], row["url"]) for row in rows} == {("POST", "/v1/chat/completions")}
    answer = plates.oracle(parts_in(scene_file))
    results = []
    for i, row in enumerate(rows):
        text = row["body"]["messages"][1]["content"][0]["text"]
        message = {"role": "assistant", "content": json.dumps(answer(text)), "refusal": None}
        body = {"choices": [{"message": message}], "usage": {"prompt_tokens": 2000, "completion_tokens": 90}}
        response = {"status_code": 200 if i else 500, "body": body}
        results.append(json.dumps({"id": str(i), "custom_id": row["custom_id"], "response": response, "error": None}))
    (tmp_path / "results.jsonl").write_text("\n".join(results) + "\n")
    assert run(capsys, "label", out, "--batch-results", tmp_path / "results.jsonl", "--no-report")[0] == 0
    found, truth = labels_in(out), wanted(scene_file)
    assert sum(label is not None for label in found.values()) == 4
    assert all(label in (None, truth[mesh]) for mesh, label in found.items())
    # The request that failed is in the next batch.
    assert len((out / "lvlm" / "batch-001.jsonl").read_text().splitlines()) == 1


def test_keeping_renders_keeps_prompt_pictures_and_reply(capsys, scene_file, tmp_path):
    server = ChatServer(plates.oracle(parts_in(scene_file)))
    with server.running() as address:
        run(
            capsys, "build", scene_file, "-o", tmp_path / "out", "--labeler", "lvlm", "--base-url", address, "--yes",
            "--keep-renders", "--paper-views", "--max-questions", "1", *SMALL,
        )  # fmt: skip
    kept = list((tmp_path / "out" / "lvlm" / "renders").glob("q-*"))
    assert len(kept) == 1
    assert {path.name for path in kept[0].iterdir()} >= {"prompt.md", "reply.json", "view1-all.jpg", "view3-alone.jpg"}
    assert "magenta" not in (kept[0] / "prompt.md").read_text()


def test_words_of_a_model_do_nothing_on_the_terminal(capsys, scene_file, tmp_path):
    evil = "\x1b[31m[bold]<script>alert(1)</script>"

    def answer(text):
        return {"group": evil, "name": evil, "seen": evil, "propose_group": evil, "propose_name": evil, "confidence": 1}

    server = ChatServer(answer, ["refuse"])
    with server.running() as address:
        _, out, err = run(
            capsys,
            "build",
            scene_file,
            "-o",
            tmp_path / "out",
            "--labeler",
            "lvlm",
            "--base-url",
            address,
            "--yes",
            *SMALL,
        )
    assert "\x1b[31m" not in out + err
    assert "<script>" not in (tmp_path / "out" / "graph.json").read_text()


@pytest.mark.slow
def test_vocabulary_grows_with_the_source_of_each_addition(capsys, scene_file, tmp_path):
    def answer(text):
        return {
            "labels": [
                {"group": "tank", "name": "Level Indicators", "reason": "a dial"},
                {"group": "Pipe assembly", "name": "Elbows", "reason": "bent"},
                {"group": "Vehicle", "name": "forklift", "reason": "wheels"},
            ]
        }

    server = ChatServer(answer)
    new = tmp_path / "new.yaml"
    with server.running() as address:
        code, out, _ = run(
            capsys,
            "vocabulary",
            "grow",
            scene_file,
            "-o",
            new,
            "--base-url",
            address,
            "--pictures",
            "2",
            "--set",
            "load.isolate=false",
        )
    assert code == 0
    assert "level indicator" in out
    assert len(server.bodies) == 2
    assert "forklift" in server.bodies[1]["messages"][1]["content"][0]["text"]
    rows = json.loads((tmp_path / "new.added.json").read_text())
    assert [(row["source"], row["outcome"]) for row in rows[:3]] == [
        ("overview-1", "added"),
        ("overview-1", "folded"),
        ("overview-1", "added"),
    ]
    assert {row["outcome"] for row in rows[3:]} == {"folded"}
    code, out, _ = run(capsys, "vocabulary", "show", new)
    assert "Vehicle" in out
    assert run(capsys, "vocabulary", "check", new)[0] == 0


def test_proposals_of_a_run_merge_into_a_tree(capsys, tmp_path):
    proposals = {"labels": [{"group": "Tank", "name": "agitators"}, {"group": "Tank", "name": "Shells"}]}
    (tmp_path / "proposals.json").write_text(json.dumps(proposals))
    code, out, _ = run(
        capsys, "vocabulary", "merge", "builtin", tmp_path / "proposals.json", "-o", tmp_path / "merged.yaml"
    )
    assert code == 0
    assert "added    Tank: agitators" in out
    assert "into Tank: shell" in out
    assert "agitator" in (tmp_path / "merged.yaml").read_text()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--labeler", "chatgpt"], "embedded+lvlm"),
        (["--dry-run"], "--labeler lvlm"),
        (["--labeler", "lvlm", "--dry-run", "--batch"], "one of them"),
        (["--labeler", "lvlm", "--base-url", "http://a:b@c/v1"], "environment"),
        (["--labeler", "lvlm", "--model", "unheard-of", "--max-cost", "1", "--yes"], "has no price"),
    ],
)
def test_options_that_make_no_sense_are_refused_in_one_line(capsys, scene_file, tmp_path, arguments, words):
    code, _, err = run(capsys, "build", scene_file, "-o", tmp_path / "out", *arguments, *SMALL)
    assert code == 2
    assert words in err
    assert "Traceback" not in err


def test_labelling_anew_needs_the_same_scene(capsys, scene_file, tmp_path):
    out = tmp_path / "out"
    assert run(capsys, "build", scene_file, "-o", out, "--labeler", "lvlm", "--dry-run", *SMALL)[0] == 0
    scene_file.write_text(usda(plates.scene_of(2)))
    code, _, err = run(capsys, "label", out, "--from-folder", out / "lvlm" / "questions", "--no-report")
    assert code == 2
    assert "changed" in err
    scene_file.unlink()
    code, _, err = run(capsys, "label", out, "--from-folder", out / "lvlm" / "questions", "--no-report")
    assert code == 2
    assert "--scene" in err


def test_labelling_anew_without_a_model_takes_its_options_and_leaves_nothing_of_the_model(capsys, labelled, scene_file):
    folder, built = labelled
    assert run(capsys, "label", folder, "--labeler", "none", "--no-report")[0] == 0
    assert set(labels_in(folder).values()) == {None}
    assert SceneGraph.load(folder).config["label"]["labeler"] == "none"
    assert run(capsys, "label", folder, "--labeler", "embedded", "--set", "cluster.eps=0.02", "--no-report")[0] == 0
    again = SceneGraph.load(folder)
    assert (again.config["cluster"]["eps"], again.config["lvlm"]["ask"]) == (0.02, "never")
    assert run(capsys, "build", scene_file, "-o", folder, *SMALL, "--set", "cluster.eps=0.02")[0] == 0
    assert labels_in(folder) == {part.meshes[0]: part.label and part.label.said for part in again.parts()}
    assert (folder / "graph.json").read_bytes() != built
