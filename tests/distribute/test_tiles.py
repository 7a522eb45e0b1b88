"""What a crew finds tile by tile is what one process finds, to the byte."""

import errno
import json
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import cadgraph
import killed_tasks
from cadgraph.config import Config
from cadgraph.distribute.crew import TileCrew
from cadgraph.distribute.cut import cut_rows, cut_tiles, own_pairs
from cadgraph.distribute.hands import Failure
from cadgraph.distribute.packing import pack_facts, unpack_facts
from cadgraph.distribute.processes import Processes
from cadgraph.distribute.site import FOLDER
from cadgraph.errors import OutputError
from cadgraph.geometry.contact.broad import near_boxes
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.analysis import measure_shapes
from cadgraph.session.demo import DEMO_SCENE
from cadgraph.session.run import run


class Here:
    """Runs calls one after the other in this process, and counts them."""

    def __init__(self, count=2):
        self.count, self.calls, self.ended = count, 0, 0

    def run(self, function, calls, told=None, each=None):
        self.calls += len(calls)
        return [function(*call) for call in calls]


@pytest.fixture(scope="module")
def plant():
    scene = cadgraph.load(DEMO_SCENE)
    return scene, _bytes(cadgraph.build(scene))


def _bytes(graph):
    return json.dumps(graph.to_json()).encode()


@given(seed=st.integers(0, 2**32), tiles=st.integers(1, 40), by_space=st.booleans(), count=st.integers(1, 5))
@settings(max_examples=4, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_whatever_tiles_a_site_is_cut_into_the_graph_is_the_same_to_the_byte(
    plant, tmp_path_factory, seed, tiles, by_space, count
):
    scene, whole = plant

    def scattered(boxes, n):
        return np.random.default_rng(seed).integers(0, n, len(boxes))

    crew = TileCrew(Here(count), tmp_path_factory.mktemp("tiles"), tiles, cut_tiles if by_space else scattered)
    assert _bytes(cadgraph.build(scene, crew=crew)) == whole


@given(
    seed=st.integers(0, 2**32),
    n=st.integers(0, 60),
    tiles=st.integers(1, 9),
    reach=st.floats(0, 2),
    broken=st.booleans(),
)
@settings(max_examples=60, deadline=None)
def test_every_pair_of_near_boxes_is_owned_by_one_tile(seed, n, tiles, reach, broken):
    rng = np.random.default_rng(seed)
    low = rng.uniform(0, 10, (n, 3))
    boxes = np.stack([low, low + rng.exponential(1.0, (n, 3))], axis=1)
    if broken and n:
        boxes[rng.integers(n)] = np.nan
    dealt = own_pairs(boxes, rng.integers(0, tiles, n), reach)
    found = [tuple(pair) for pairs in dealt for pair in pairs.tolist()]
    assert len(found) == len(set(found))
    assert set(map(tuple, near_boxes(boxes, reach).tolist())) <= set(found)


@given(weights=st.lists(st.integers(0, 100), max_size=80), count=st.integers(1, 12), grain=st.integers(1, 32))
def test_ranges_hold_each_row_once_and_begin_at_the_grain(weights, count, grain):
    ranges = cut_rows(np.array(weights, np.int64), count, grain)
    assert [row for first, last in ranges for row in range(first, last)] == list(range(len(weights)))
    assert len(ranges) <= count
    assert all(first % grain == 0 for first, _ in ranges)


def test_tiles_are_about_equally_full():
    rng = np.random.default_rng(3)
    low = rng.uniform(0, 100, (1000, 3))
    counts = np.bincount(cut_tiles(np.stack([low, low + 1], axis=1), 7), minlength=7)
    assert counts.sum() == 1000
    assert counts.max() - counts.min() < 20


def test_measures_of_shapes_survive_packing_to_the_last_bit(plant):
    scene, _ = plant
    facts = measure_shapes(scene, measure(scene))
    before, after = pack_facts(facts), pack_facts(unpack_facts(pack_facts(facts)))
    assert before.keys() == after.keys()
    assert all(before[name].tobytes() == after[name].tobytes() for name in before)


def test_a_run_that_was_stopped_goes_on_where_it_was(plant, tmp_path):
    scene, whole = plant
    first = Here()
    assert TileCrew(first, tmp_path, 5).remarks == ()
    cadgraph.build(scene, crew=TileCrew(first, tmp_path, 5))
    results = sorted(tmp_path.rglob("result-*.npz"))
    assert len(results) == first.calls > 5
    results[0].unlink()
    results[-1].write_bytes(results[-1].read_bytes()[:100])
    again = Here()
    assert _bytes(cadgraph.build(scene, crew=TileCrew(again, tmp_path, 5))) == whole
    assert again.calls == 2


def spoilt_zeros(file):
    """The last quarter of a file is zeros, as where its last blocks never reached the disk."""
    content = file.read_bytes()
    kept = len(content) * 3 // 4
    file.write_bytes(content[:kept] + bytes(len(content) - kept))


def spoilt_short(file):
    file.write_bytes(file.read_bytes()[:200])


def spoilt_gone(file):
    file.unlink()


def spoilt_empty(file):
    file.write_bytes(b"")


@pytest.mark.parametrize("spoil", [spoilt_zeros, spoilt_short, spoilt_gone, spoilt_empty])
@pytest.mark.parametrize("name", ["vertices.npy", "face_offsets.npy", "done"])
def test_what_tasks_read_is_written_anew_where_a_crash_spoilt_it(plant, tmp_path, spoil, name):
    scene, _ = plant
    measured = measure(scene)
    crew = TileCrew(Here(), tmp_path, 5)
    first = crew.contacts(scene, measured, 0.01)
    (file,) = tmp_path.glob(f"scene-*/{name}")
    content = file.read_bytes()
    spoil(file)
    for result in tmp_path.rglob("result-*.npz"):
        result.unlink()
    again = crew.contacts(scene, measured, 0.01)
    assert again.distance.tobytes() == first.distance.tobytes()
    assert again.pairs.tobytes() == first.pairs.tobytes()
    assert file.read_bytes() == content


def test_what_tasks_read_stays_where_it_is_whole(plant, tmp_path):
    scene, _ = plant
    measured = measure(scene)
    crew = TileCrew(Here(), tmp_path, 5)
    crew.contacts(scene, measured, 0.01)
    (file,) = tmp_path.glob("scene-*/vertices.npy")
    before = file.stat()
    crew.contacts(scene, measured, 0.01)
    assert (file.stat().st_ino, file.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)


class Full:
    """A file on a disk that has no more room."""

    def __init__(self, *_):
        self.write = self._refuse

    def _refuse(self, _):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_is_said_and_nothing_is_left(tmp_path, monkeypatch):
    monkeypatch.setattr("cadgraph._io.arrays.SimpleNamespace", lambda write: Full())
    with pytest.raises(OutputError, match=r"vertices\.npy: can't be written \(No space left on device\)"):
        run(DEMO_SCENE, tmp_path / "out", Config().replace({"load.isolate": False}), report=False, tiles=4)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("count", "anew"), [(3, False), (64, True)])
def test_with_a_few_more_workers_a_run_goes_on_with_the_tiles_that_it_had(plant, tmp_path, count, anew):
    scene, _ = plant
    measured = measure(scene)
    first = TileCrew(Here(2), tmp_path).contacts(scene, measured, 0.01)
    more = Here(count)
    again = TileCrew(more, tmp_path).contacts(scene, measured, 0.01)
    assert again.pairs.tobytes() == first.pairs.tobytes()
    assert again.distance.tobytes() == first.distance.tobytes()
    assert bool(more.calls) == anew


def test_results_of_another_scene_are_not_taken(plant, tmp_path):
    scene, _ = plant
    crew = TileCrew(Here(), tmp_path, 3)
    cadgraph.build(scene, crew=crew)
    less = scene.select(np.arange(scene.n_meshes - 5))
    assert _bytes(cadgraph.build(less, crew=crew)) == _bytes(cadgraph.build(less))


def test_processes_write_the_same_files_and_leave_nothing_else(tmp_path):
    run(DEMO_SCENE, tmp_path / "one", report=False)
    run(DEMO_SCENE, tmp_path / "two", report=False, workers=2)
    one, two = ({file.name for file in (tmp_path / name).iterdir()} for name in ("one", "two"))
    assert one == two
    assert FOLDER not in two
    assert (tmp_path / "one/graph.json").read_bytes() == (tmp_path / "two/graph.json").read_bytes()


def test_a_process_that_is_killed_costs_another_try(tmp_path):
    calls = [(str(tmp_path / "mark"), number) for number in range(6)]
    shares = []
    with Processes(2) as hands:
        assert hands.run(killed_tasks.end_once, calls, shares.append) == list(range(6))
        assert shares[-1] == 1
        assert hands.ended == 1
        (told,) = TileCrew(hands, tmp_path).remarks
        assert told.startswith("once a process ended before its work was done, and that was done again")
        # The processes are as good as new.
        assert hands.run(killed_tasks.double, [(4,)]) == [8]
        assert hands.ended == 1


def test_who_is_stopped_does_not_wait_for_what_is_being_worked_out():
    def stop(*_):
        raise KeyboardInterrupt

    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt), Processes(2) as hands:
        hands.run(killed_tasks.double_slowly, [(0.0, 1), (300.0, 2)], each=stop)
    assert time.monotonic() - start < 150


def test_a_call_that_always_ends_its_process_is_told_and_the_others_are_done():
    with Processes(2) as hands:
        (ended,) = hands.run(killed_tasks.end_always, [(7,)])
        (failed,) = hands.run(killed_tasks.fail, [(3,)])
    assert isinstance(ended, Failure)
    assert "--tiles" in ended.reason
    assert ended.error is None
    assert isinstance(failed, Failure)
    assert failed.reason == "no 3"
    assert isinstance(failed.error, ValueError)


@pytest.mark.skipif(sys.platform == "win32", reason="there is no mask of signals")
def test_a_script_that_must_not_be_imported_is_told_so(tmp_path):
    script = tmp_path / "unguarded.py"
    head = "from cadgraph.distribute.processes import Processes\nimport math\n"
    work = "with Processes(2) as processes: print(processes.run(math.sqrt, [(4,)]))\n"
    script.write_text(head + work)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run([sys.executable, script], env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode != 0
    assert 'with its own work under if __name__ == "__main__":' in done.stderr.splitlines()[-1]
    script.write_text(f'{head}if __name__ == "__main__":\n    {work}')
    done = subprocess.run([sys.executable, script], env=environment, capture_output=True, text=True, timeout=120)
    assert done.stdout.strip() == "[2.0]"


def test_ctrl_c_reaches_no_process_while_it_starts():
    with Processes(1) as hands:
        assert hands.run(killed_tasks.hears_ctrl_c, [()]) == [False]
    assert killed_tasks.hears_ctrl_c(), "it still reaches this one"


def test_more_processes_than_are_of_use_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"workers is 100000, for .* at most"):
        run(DEMO_SCENE, tmp_path, workers=100_000)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("wrong", [{"workers": 0}, {"tiles": 0}])
def test_a_count_below_one_is_refused(tmp_path, wrong):
    with pytest.raises(ValueError, match="at least 1"):
        run(DEMO_SCENE, tmp_path, **wrong)
