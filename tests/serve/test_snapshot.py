import networks
from cadgraph.model.scene import Scene
from cadgraph.serve.snapshot import Snapshot


def snapshot(direction):
    nodes = [networks.unit("T-001"), networks.unit("V-001"), networks.unit("V-002")]
    graph = networks.network(nodes, networks.chain("T-001 V-001 V-002", direction=direction))
    return Snapshot(1, graph, Scene.from_meshes([]))


def test_where_a_trace_halts_is_a_doubt_of_it():
    doubts = snapshot("unknown").trace("V-001", "downstream", None)["doubts"]
    assert [doubt["text"].split(" (")[0] for doubt in doubts] == [
        "the way halts at V-001: the direction of flow towards T-001 is unknown",
        "the way halts at V-001: the direction of flow towards V-002 is unknown",
    ]
    assert {doubt["place"] for doubt in doubts} == {"unit-V-001"}


def test_a_trace_that_ends_where_the_pipe_does_has_no_halt():
    assert not any(
        "halts" in doubt["text"] for doubt in snapshot("forward").trace("V-001", "downstream", None)["doubts"]
    )
