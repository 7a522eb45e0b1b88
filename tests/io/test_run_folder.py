import pytest

from cadgraph._io.folder_lock import LOCK
from cadgraph._io.run_folder import refuse_to_overwrite, results_folder
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
