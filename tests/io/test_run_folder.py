import pytest

from cadgraph._io.folder_lock import LOCK
from cadgraph._io.manifest import changed_by_others
from cadgraph._io.results import new_results
from cadgraph._io.run_folder import refuse_to_overwrite, results_folder
from cadgraph._io.staging import NEXT
from cadgraph.errors import OutputError


def stopped_in(folder, reason, leave=()):
    with results_folder(folder) as target:
        for name in leave:
            (target / name).touch()
        raise reason


@pytest.mark.parametrize("reason", [RuntimeError, KeyboardInterrupt, SystemExit])
def test_a_folder_made_for_nothing_is_gone_again_with_those_above_it(tmp_path, reason):
    with pytest.raises(reason):
        stopped_in(tmp_path / "a" / "b", reason)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_was_there_or_holds_something_stays(tmp_path):
    for folder, leave in ((tmp_path, ()), (tmp_path / "a" / "b", ("x",))):
        with pytest.raises(KeyboardInterrupt):
            stopped_in(folder, KeyboardInterrupt, leave)
    assert (tmp_path / "a" / "b" / "x").exists()


def test_what_a_killed_run_left_half_written_goes(tmp_path):
    half = (".graph-12345678.json", ".picture-abcdefgh.png", ".corrections-0a1b2c3d.json")
    for name in (*half, ".graph-mine.json", "corrections.json"):
        (tmp_path / name).touch()
    with results_folder(tmp_path):
        kept = {path.name for path in tmp_path.iterdir()} - {LOCK}
        assert kept == {".graph-mine.json", "corrections.json"}


def test_a_graph_vouches_for_what_has_no_mark(tmp_path):
    (tmp_path / "picture.png").touch()
    with pytest.raises(OutputError, match=r"picture\.png: not written by cadgraph"), results_folder(tmp_path):
        pass
    (tmp_path / "graph.json").write_text('{\n "format": "cadgraph"')
    with results_folder(tmp_path) as folder:
        assert folder == tmp_path


def test_a_folder_named_like_a_result_is_refused(tmp_path):
    (tmp_path / "report.html").mkdir()
    with pytest.raises(OutputError, match="a folder stands where a result goes"), results_folder(tmp_path):
        pass


def test_a_file_that_must_stay_is_known_by_any_path_to_it(tmp_path):
    (tmp_path / "graph.json").touch()
    (tmp_path / "link").symlink_to(tmp_path)
    with pytest.raises(OutputError, match="this is the source itself"):
        refuse_to_overwrite(tmp_path, [tmp_path / "link" / "graph.json"], "the source itself")
    refuse_to_overwrite(tmp_path, [tmp_path / "other.json"], "the source itself")


def test_a_manifest_of_another_program_is_left_alone(tmp_path):
    (tmp_path / "manifest.json").write_text('{"name": "my web page"}')
    with (
        pytest.raises(OutputError, match=r"manifest\.json: not written by cadgraph, so it is left alone"),
        results_folder(tmp_path),
    ):
        pass


def of_a_run(folder):
    with new_results(folder):
        (folder / NEXT).mkdir()
        for name, content in (
            ("graph.json", '{"format": "cadgraph"}'),
            ("semantics.usda", "#usda 1.0 cadgraph"),
            ("picture.png", "a picture"),
        ):
            (folder / NEXT / name).write_text(content)


NOTHING, ZEROS = b"", bytes(3000)


@pytest.mark.parametrize(
    "left",
    [
        {"graph.json": None},
        {"graph.json": NOTHING},
        {"graph.json": b"{}"},
        {"graph.json": ZEROS},
        {"manifest.json": NOTHING},
        {"manifest.json": ZEROS},
        {"manifest.json": b'{"format": "cadgraph-manifest", "ver'},
        {"manifest.json": None, "graph.json": NOTHING},
        {"manifest.json": NOTHING, "graph.json": NOTHING},
        {"semantics.usda": NOTHING, "graph.json": b"{}", "picture.png": NOTHING},
    ],
)
def test_what_a_loss_of_power_leaves_of_results_can_be_built_over(tmp_path, left):
    of_a_run(tmp_path)
    for name, content in left.items():
        if content is None:
            (tmp_path / name).unlink()
        else:
            (tmp_path / name).write_bytes(content)
    with results_folder(tmp_path):
        of_a_run(tmp_path)
    assert changed_by_others(tmp_path) == ()


@pytest.mark.parametrize("name", ["report.html", "simulation.usda", "semantics.usda"])
def test_beside_our_results_a_file_of_somebody_else_stays(tmp_path, name):
    of_a_run(tmp_path)
    (tmp_path / name).write_text("mine")
    with pytest.raises(OutputError, match=f"{name}: not written by cadgraph"), results_folder(tmp_path):
        pass
    assert (tmp_path / name).read_text() == "mine"


@pytest.mark.parametrize("content", [NOTHING, b"{}", ZEROS])
def test_where_nothing_proves_a_folder_ours_no_file_is_taken_for_a_rest(tmp_path, content):
    (tmp_path / "graph.json").write_bytes(content)
    with pytest.raises(OutputError, match=r"graph\.json: not written by cadgraph"), results_folder(tmp_path):
        pass
