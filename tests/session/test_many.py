"""Many scenes in one run: each as if it were built alone, one that fails stops no other, and nothing is done twice."""

import shutil
from pathlib import Path

import pytest

from cadgraph.cli.build_command import with_address
from cadgraph.cli.screen import tell_built
from cadgraph.session.many import FOLDER, BuiltScene, build_many, folders_of
from cadgraph.session.run import run as run_one
from command_line import refused, run
from serving import write_blocks


@pytest.fixture(scope="module")
def scenes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scenes")
    write_blocks(folder / "first.usda")
    shutil.copy(folder / "first.usda", folder / "second.usda")
    (folder / "broken.usda").write_text("nothing that can be read")
    return [folder / f"{name}.usda" for name in ("first", "broken", "second")]


def states(built):
    return {one.name: one.state for one in built}


@pytest.mark.slow
def test_one_that_fails_stops_no_other_and_the_next_run_goes_on_with_it(tmp_path, scenes, capsys):
    out = tmp_path / "out"
    words = ("build", *scenes, "-o", out, "--no-report", "--workers", 2)
    code, said, err = run(capsys, *words)
    assert code == 2
    assert sorted(line.split()[:2] for line in said.splitlines()) == [
        ["broken", "failed:"],
        ["first", "built"],
        ["second", "built"],
    ]
    assert "error: 1 of 3 scenes failed" in err
    assert len([line for line in err.splitlines() if line.startswith("broken ")]) == 1
    run_one(scenes[0], tmp_path / "alone", report=False)
    assert (out / "first" / "graph.json").read_bytes() == (tmp_path / "alone" / "graph.json").read_bytes()

    code, said, _ = run(capsys, *words)
    assert code == 2
    assert sorted(line.split()[:2] for line in said.splitlines()) == [
        ["broken", "failed:"],
        ["first", "kept"],
        ["second", "kept"],
    ]


def test_a_scene_is_called_as_it_was_given_whatever_its_name(tmp_path, scenes, capsys, monkeypatch):
    (tmp_path / "in").mkdir()
    names = ["graph.json.usda", "first.usda"]
    for name in names:
        shutil.copy(scenes[0], tmp_path / "in" / name)
    monkeypatch.chdir(tmp_path)
    settings = ("--no-report", "--set", "label.labeler=none")
    assert run(capsys, "build", *(f"in/{name}" for name in names), "-o", "out", *settings)[0] == 0
    assert run(capsys, "build", "in/first.usda", "-o", "alone", *settings)[0] == 0
    alone = (tmp_path / "alone" / "graph.json").read_bytes()
    assert (tmp_path / "out" / "first" / "graph.json").read_bytes() == alone
    assert (tmp_path / "out" / "graph.json" / "graph.json").read_bytes() == alone.replace(
        b"in/first.usda", b"in/graph.json.usda"
    )


@pytest.mark.parametrize("state", ["built", "kept", "failed"])
def test_no_name_passes_for_the_line_of_another_scene(capsys, state):
    name = "a\ntank   built in 1.0 s\x1b[2K\u2028b"
    tell_built(BuiltScene(name, Path(f"{name}.usd"), state, reason="one\nline"), len(name))
    said = capsys.readouterr().out
    assert len(said.splitlines()) == 1
    assert said.startswith("a tank   built in 1.0 s [2K b  ")


@pytest.mark.slow
def test_what_was_built_is_kept_only_where_it_would_be_built_the_same(tmp_path, scenes):
    near = [tmp_path / scene.name for scene in scenes]
    for scene, copy in zip(scenes, near, strict=True):
        shutil.copy(scene, copy)
    out = tmp_path / "out"
    assert states(build_many(near, out, report=False)) == {"first": "built", "broken": "failed", "second": "built"}
    (out / "first" / "semantics.usda").write_text("#usda 1.0\n# of cadgraph, changed since\n")
    near[2].write_text(near[2].read_text() + "\n")
    assert states(build_many(near, out, report=False)) == {"first": "built", "broken": "failed", "second": "built"}
    labels = tmp_path / "labels.csv"
    labels.write_text("mesh,group,name\n/b0,Tank,shell\n")
    told = []
    again = build_many(near[::2], out, report=False, labels=labels, told=told.append)
    assert states(again) == {"first": "built", "second": "built"}
    assert told == again
    # All are built: the next run is a new one.
    assert not (out / FOLDER).exists()
    assert states(build_many(near[:1], out, report=False)) == {"first": "built"}


def test_a_run_that_is_stopped_says_how_far_it_was_and_goes_on(tmp_path, scenes):
    def stop(one):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as stopped:
        build_many(scenes[::2], tmp_path, report=False, told=stop)
    assert stopped.value.__notes__ == ["1 of 2 scenes are built, the same command goes on with the others"]
    assert "kept" in states(build_many(scenes[::2], tmp_path, report=False)).values()


@pytest.mark.parametrize("names", [("a/x.usd", "b/x.usd"), ("x.usd", "x.step"), ("Tank.usd", "tank.usd")])
def test_scenes_that_would_go_to_one_folder_are_refused(tmp_path, names):
    with pytest.raises(ValueError, match="have the same name: both would be built into a folder"):
        folders_of([tmp_path / name for name in names])


def test_a_scene_that_is_given_twice_is_refused(tmp_path, scenes, capsys):
    said = refused(capsys, "build", scenes[0], scenes[0], "-o", tmp_path / "out")
    assert "given twice" in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("--tiles", "3"), "--tiles cuts one scene"),
        (("--labeler", "lvlm"), "one scene at a time"),
    ],
)
def test_what_goes_with_one_scene_alone_is_refused_for_several(tmp_path, scenes, capsys, words, reason):
    assert reason in refused(capsys, "build", *scenes, "-o", tmp_path / "out", *words)


@pytest.mark.parametrize("many", [False, True])
def test_without_ray_it_is_named(tmp_path, scenes, capsys, monkeypatch, many):
    monkeypatch.setitem(__import__("sys").modules, "ray", None)
    said = refused(capsys, "build", *scenes[: 2 if many else 1], "-o", tmp_path / "out", "--ray")
    assert said == "error: --ray needs an extra: in the checkout of cadgraph, pip install '.[ray]'"
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("address", ["somewhere", "ray://head:10001", "head:port", "local:"])
def test_what_is_no_address_is_refused(tmp_path, scenes, capsys, address):
    said = refused(capsys, "build", scenes[0], "-o", tmp_path / "out", "--ray", address)
    assert f"--ray {address}: no address of a Ray cluster" in said


def test_nobody_at_an_address_is_one_line(tmp_path, scenes, capsys):
    pytest.importorskip("ray")
    said = refused(capsys, "build", scenes[0], "-o", tmp_path / "out", "--ray", "127.0.0.1:1")
    assert "--ray 127.0.0.1:1: nobody answers there" in said


def test_the_address_of_a_cluster_may_be_left_out(scenes):
    scene = str(scenes[0])
    for given, read in (
        (["--ray"], ["--ray", "local"]),
        (["--ray", "-o", "out"], ["--ray", "local", "-o", "out"]),
        (["--ray", scene], ["--ray", "local", scene]),
        (["--ray", "head:6379", scene], ["--ray", "head:6379", scene]),
        (["--ray=auto", scene], ["--ray=auto", scene]),
        (["--", "--ray"], ["--", "--ray"]),
    ):
        assert with_address(given) == read
