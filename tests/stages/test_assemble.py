from dataclasses import replace

import pytest

import cadgraph
import shapes
from cadgraph import pipeline
from cadgraph.model.parts import Joint
from cadgraph.model.scene import Scene

FAR = (100.0, 200.0, 300.0)


@pytest.fixture
def built_with(monkeypatch):
    """Builds three boxes; the network that is found has these joints."""

    def build(*joints):
        found = pipeline.connect_units

        def connect(given):
            connected = found(given)
            return replace(connected, network=replace(connected.network, joints=joints))

        monkeypatch.setattr(pipeline, "connect_units", connect)
        meshes = [shapes.box(center=(FAR[0] + 2.0 * k, *FAR[1:])) for k in range(3)]
        scene = Scene.from_meshes(meshes, ["/a", "/b", "/c"])
        return scene, cadgraph.build(scene, cadgraph.Config().replace({"label.labeler": "none"}))

    return build


def test_joints_name_their_parts_and_stand_where_they_are_in_the_plant(built_with):
    scene, graph = built_with(
        Joint(0, 1, "tap", (1.0, 0.0, 0.0), 0.0030000000001, 0.12345678, False, ("aligned", "far"))
    )
    (joint,) = graph.joints()
    assert [graph.part(part).meshes for part in (joint.first, joint.second)] == [("/a",), ("/b",)]
    assert joint.point == pytest.approx([1.0 + scene.origin[0], *scene.origin[1:]])
    assert (joint.kind, joint.gap, joint.score, joint.made) == ("tap", 0.003, 0.123457, False)
    assert joint.reasons == ("aligned", "far")


def test_joints_come_in_the_order_of_their_parts_whatever_they_were_found_in(built_with):
    rows = [(1, 2, "face"), (0, 2, "tap"), (0, 1, "mount"), (0, 1, "face")]
    joints = [Joint(a, b, kind, (0.0, 0.0, 0.0), 0.0, 0.5, True) for a, b, kind in rows]
    _, one = built_with(*joints)
    told = [(joint.first[-1], joint.second[-1], joint.kind) for joint in one.joints()]
    assert told == [("0", "1", "face"), ("0", "1", "mount"), ("0", "2", "tap"), ("1", "2", "face")]
    assert built_with(*joints[::-1])[1].joints() == one.joints()


def test_a_graph_of_a_network_without_joints_has_none(built_with):
    _, graph = built_with()
    assert graph.joints() == []
    assert "joints" not in graph.to_json()
