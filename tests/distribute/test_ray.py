"""The same work on a Ray cluster of several nodes, of which some are lost: the same graph, to the byte."""

import json
import os
import sys
import threading
import time
from pathlib import Path

import pytest

import cadgraph
import killed_tasks
from cadgraph.distribute.crew import TileCrew
from cadgraph.distribute.hands import Failure
from cadgraph.distribute.site import FOLDER
from cadgraph.errors import CadGraphError
from cadgraph.session.demo import DEMO_SCENE
from cadgraph.session.many import build_many
from cadgraph.session.run import run
from serving import write_blocks

pytest.importorskip("ray")
from cadgraph.distribute.on_ray import RayHands

# What Ray itself warns of, and leaves open, is its own.
pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore")]


@pytest.fixture(scope="module")
def cluster():
    """A cluster of three nodes on this machine, of one processor each; what it starts finds what tests import."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RAY_USAGE_STATS_ENABLED", "0")
        patch.setenv("RAY_health_check_period_ms", "500")
        patch.setenv("RAY_health_check_failure_threshold", "3")
        patch.setenv("PYTHONPATH", os.pathsep.join(path for path in sys.path if path))
        from ray.cluster_utils import Cluster

        small = {"num_cpus": 1, "object_store_memory": 80 << 20, "include_dashboard": False}
        made = Cluster(initialize_head=True, head_node_args=small)
        for _ in range(2):
            made.add_node(num_cpus=1, object_store_memory=80 << 20)
        made.wait_for_nodes()
        yield made
        made.shutdown()


@pytest.mark.long
def test_a_site_is_built_on_several_nodes_to_the_same_byte(cluster, tmp_path, capfd):
    run(DEMO_SCENE, tmp_path / "one", report=False)
    run(DEMO_SCENE, tmp_path / "two", report=False, ray=cluster.address)
    one, two = ({file.name for file in (tmp_path / name).iterdir()} for name in ("one", "two"))
    assert one == two
    assert FOLDER not in two
    for name in ("graph.json", "semantics.usda"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()
    assert capfd.readouterr() == ("", "")


@pytest.mark.long
def test_a_worker_that_is_killed_costs_another_try_and_one_that_always_ends_is_told(cluster, tmp_path, capfd):
    shares, seen = [], {}
    with RayHands(cluster.address, tmp_path) as hands:
        assert hands.count == 3
        calls = [(str(tmp_path / "mark"), number) for number in range(6)]
        assert hands.run(killed_tasks.end_once, calls, shares.append, seen.__setitem__) == list(range(6))
        (ended,) = hands.run(killed_tasks.end_always, [(7,)])
        (failed,) = hands.run(killed_tasks.fail, [(3,)])
    assert shares[-1] == 1
    assert seen == dict(enumerate(range(6)))
    assert isinstance(ended, Failure)
    assert ended.error is None
    assert "\n" not in ended.reason
    assert isinstance(failed, Failure)
    assert (failed.reason, type(failed.error)) == ("no 3", ValueError)
    assert capfd.readouterr() == ("", "")


class Losing:
    """Hands of which a process is killed, and then a node is lost, while they work."""

    def __init__(self, hands, cluster, node):
        self._hands, self._cluster, self._node = hands, cluster, node
        self.count, self.lost = hands.count, []

    def run(self, function, calls, told=None):
        if self.lost:
            return self._hands.run(function, calls, told)
        # Each call tells which process is at it, and where, and waits there until that is ended.
        folder = Path(calls[0][1])
        calls = [(function.__name__, str(folder), number, call) for number, call in enumerate(calls)]
        ending = threading.Thread(target=self._end, args=(folder,))
        ending.start()
        try:
            return self._hands.run(killed_tasks.wait_then_call, calls, told)
        finally:
            ending.join()

    def _end(self, folder):
        first = killed_tasks.at_work(folder, "", 1)[0]
        os.kill(first["pid"], 9)
        there = killed_tasks.at_work(folder, self._node.node_id, 1)[0]
        self._cluster.remove_node(self._node, allow_graceful=False)
        self.lost += [first, there]
        killed_tasks.let_go(folder)


def test_a_worker_and_a_node_that_are_lost_in_the_middle_change_nothing(cluster, tmp_path):
    scene = cadgraph.load(DEMO_SCENE)
    node = cluster.add_node(num_cpus=1, object_store_memory=80 << 20)
    cluster.wait_for_nodes()
    with RayHands(cluster.address, tmp_path) as hands:
        losing = Losing(hands, cluster, node)
        graph = cadgraph.build(scene, crew=TileCrew(losing, tmp_path / "tiles", 8))
    assert len(losing.lost) == 2
    assert json.dumps(graph.to_json()) == json.dumps(cadgraph.build(scene).to_json())


@pytest.mark.long
def test_many_scenes_go_to_the_nodes_and_one_that_fails_stops_no_other(cluster, tmp_path):
    (tmp_path / "broken.usda").write_text("nothing of ours")
    scenes = [write_blocks(tmp_path / "blocks.usda"), tmp_path / "broken.usda"]
    built = build_many(scenes, tmp_path / "out", report=False, ray=cluster.address)
    assert [one.state for one in built] == ["built", "failed"]
    assert (tmp_path / "out" / built[0].name / "graph.json").is_file()


def test_a_cluster_that_cannot_do_the_work_is_refused_in_one_line(cluster, tmp_path, monkeypatch):
    monkeypatch.setattr(cadgraph, "__version__", "0.0.1")
    with pytest.raises(CadGraphError, match=r"this is 0\.0\.1; make them the same"):
        RayHands(cluster.address, tmp_path)
    monkeypatch.undo()
    monkeypatch.setattr("cadgraph.distribute.on_ray.write_atomically", lambda *_: None)
    with pytest.raises(CadGraphError, match="put the results on a disk that all nodes share"):
        RayHands(cluster.address, tmp_path)


@pytest.mark.long
def test_a_cluster_of_its_own_is_gone_with_the_run(tmp_path, monkeypatch):
    import ray

    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(path for path in sys.path if path))
    with RayHands("local", tmp_path, 2) as hands:
        assert hands.count == 2
        assert hands.run(killed_tasks.double, [(4,), (5,)]) == [8, 10]
    assert not ray.is_initialized()


def test_work_is_given_up_at_once_where_somebody_stops_it(cluster, tmp_path):
    def stop(*_):
        raise KeyboardInterrupt

    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt), RayHands(cluster.address, tmp_path) as hands:
        hands.run(killed_tasks.double_slowly, [(0.0, 1), (60.0, 2)], each=stop)
    assert time.monotonic() - start < 50
