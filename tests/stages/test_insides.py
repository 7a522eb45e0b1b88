import numpy as np
import pytest

import shapes
from cadgraph import Config, build
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.query.explain import explain
from cadgraph.stages.insides import find_insides, join_enclosed
from cadgraph.stages.relate.unit import Group, take_in_enclosed
from cadplants import STYLES
from cadplants.families import FAMILIES
from cadplants.model.family import as_assembly
from plates import parts_of


def shell(outer, inner, center=(0, 0, 0)):
    """A closed hollow body."""
    out, cavity = shapes.sphere(outer), shapes.sphere(inner)
    vertices = np.vstack([out[0], cavity[0]])
    return vertices + np.asarray(center), np.vstack([out[1], cavity[1][:, ::-1] + len(out[0])])


def inside_of(*meshes, method="exact"):
    return dict(find_insides(parts_of(Scene.from_meshes(meshes)), method).inside)


def test_ball_in_a_hollow_body_is_inside():
    assert inside_of(shell(0.2, 0.15), shapes.sphere(0.1)) == {1: 0}


def test_part_in_a_box_without_a_lid_is_not_inside():
    vertices, faces = shapes.box((1, 1, 1))
    top = (vertices[faces][:, :, 2] > 0.49).all(axis=1)
    assert inside_of((vertices, faces[~top]), shapes.sphere(0.3)) == {}
    assert inside_of((vertices, faces), shapes.sphere(0.3)) == {1: 0}


def test_part_inside_two_is_inside_the_innermost():
    assert inside_of(shapes.sphere(0.05), shell(0.4, 0.35), shell(0.2, 0.15)) == {0: 2, 2: 1}


def test_stem_that_stands_out_is_not_inside():
    assert inside_of(shell(0.2, 0.15), shapes.cylinder(0.02, 0.6)) == {}


def test_copies_in_one_place_are_not_inside_each_other():
    assert inside_of(shapes.sphere(0.2), shapes.sphere(0.2)) == {}


def test_the_ground_encloses_nothing():
    parts = parts_of(Scene.from_meshes([shapes.box((9, 9, 9)), shapes.sphere(0.3)]))
    parts.ground[0] = True
    assert find_insides(parts).inside == {}


def test_the_paper_knows_no_insides():
    assert inside_of(shell(0.2, 0.15), shapes.sphere(0.1), method="paper") == {}


def test_no_parts_have_no_insides():
    assert inside_of() == {}


def test_structure_of_what_is_inside_is_that_of_the_part_around_it():
    parts = find_insides(
        parts_of(Scene.from_meshes([shapes.box((1, 1, 1), (5, 0, 0)), shell(0.2, 0.15), shapes.sphere(0.1)]))
    )
    assert join_enclosed(np.array([0, 1, 2]), parts).tolist() == [0, 1, 1]
    assert join_enclosed(np.array([0, 1, -1]), parts).tolist() == [0, 1, 1]
    assert join_enclosed(np.array([2, 1, 0]), parts).tolist() == [0, 1, 1]


def test_structure_that_reaches_out_keeps_its_own():
    parts = find_insides(
        parts_of(Scene.from_meshes([shell(0.2, 0.15), shapes.sphere(0.1), shapes.box((1, 1, 1), (5, 0, 0))]))
    )
    assert join_enclosed(np.array([0, 1, 1]), parts).tolist() == [0, 1, 1]


def test_plant_in_a_closed_room_keeps_its_structures():
    row = [shapes.box((0.4, 0.4, 0.4), (0.5 * i, 0, 0)) for i in range(9)]
    parts = find_insides(parts_of(Scene.from_meshes([shell(9, 8.5), *row])))
    assert len(parts.inside) == 9
    assert join_enclosed(np.array([0] + [1] * 9), parts).tolist() == [0] + [1] * 9
    assert join_enclosed(np.array([0] + [1] * 8 + [2]), parts).tolist() == [0] * 10


@pytest.mark.parametrize(
    ("types", "near", "expected"),
    [
        (["valve", None], {}, [(0, 1)]),
        (["valve", "valve"], {}, [(0, 1)]),
        (["valve", None], {0: [1], 1: [0]}, [(0, 1)]),
        (["valve", "gauge"], {}, [(0,), (1,)]),
        (["valve", ""], {}, [(0,)]),
        (["valve", None, None], {1: [2]}, [(0,)]),
    ],
)
def test_enclosed_part_goes_to_the_unit_around_it(types, near, expected):
    groups = [Group(unit, (part,)) for part, unit in enumerate(types) if unit]
    assert [group.parts for group in take_in_enclosed(groups, {1: 0}, types, near, ())] == expected


def test_enclosed_parts_that_touch_each_other_go_together():
    types = ["valve", None, None]
    (whole,) = take_in_enclosed([Group("valve", (0,))], {1: 0, 2: 0}, types, {1: [2], 2: [1]}, ())
    assert whole.parts == (0, 1, 2)
    # One of them is held by a unit of another type.
    groups = [Group("valve", (0,)), Group("gauge", (2,))]
    assert take_in_enclosed(groups, {1: 0, 2: 0}, ["valve", None, "gauge"], {1: [2], 2: [1]}, ()) == groups


def test_part_with_a_line_stays_apart():
    groups = [Group("valve", (0,))]
    assert take_in_enclosed(groups, {1: 0}, ["valve", None], {}, {1}) == groups


@pytest.fixture(scope="module")
def ball_in_body():
    meshes = [shell(0.2, 0.15), shapes.sphere(0.1), shapes.box((0.3, 0.3, 0.3), (2, 0, 0))]
    return Scene.from_meshes(meshes, ["/body", "/ball", "/tank"])


LABELS = [GivenLabel("/body", "Valve assembly", "valve body"), GivenLabel("/ball", "Valve assembly", "valve ball")]


def test_ball_makes_no_unit_and_no_structure_of_its_own(ball_in_body, tmp_path):
    graph = build(ball_in_body, labels=LABELS)
    ball = graph.part("/ball")
    assert ball.inside == graph.part("/body").id
    assert graph.unit_of(ball) == graph.unit_of("/body") == graph.units("valve")[0]
    assert len(graph.units("valve")) == 1
    assert graph.cluster_of(ball) == graph.cluster_of("/body") != graph.cluster_of("/tank")
    assert ("lies", f"inside {ball.inside}") in explain(graph, "/ball").lines()
    assert SceneGraph.load(graph.save(tmp_path)).part("/ball").inside == ball.inside


def test_key_is_absent_where_nothing_is_around(ball_in_body):
    rows = {row["id"]: row for row in build(ball_in_body, labels=LABELS).to_json()["nodes"] if row["layer"] == "part"}
    assert [row.get("inside", "absent") for row in rows.values()].count("absent") == 2


def test_paper_method_is_as_it_was(ball_in_body):
    graph = build(ball_in_body, Config().replace({"method": "paper"}), labels=LABELS)
    assert len(graph.units("valve")) == 2
    assert all(part.inside is None for part in graph.parts())


@pytest.mark.parametrize("family", ["ball valve/trunnion", "ball valve/block", "globe valve/bellows seal"])
def test_insides_of_generated_valves_lie_in_their_own_unit(family):
    style, rng = STYLES["mechanical"], np.random.default_rng(7)
    made = FAMILIES[family]
    model = made.build(made.sizes[len(made.sizes) // 2], style, rng)
    assembly = as_assembly(made, model, style, "V-1").components
    meshes = [(c.vertices, c.faces) for c in assembly] * 2
    far = [(v + (0 if i < len(assembly) else 9), f) for i, (v, f) in enumerate(meshes)]
    parts = find_insides(parts_of(Scene.from_meshes(far)))
    held = {assembly[part % len(assembly)].name for part in parts.inside}
    assert held & {"valve ball", "valve disc"}
    assert all(inner // len(assembly) == outer // len(assembly) for inner, outer in parts.inside.items())
    units = [(assembly[a % len(assembly)].unit, assembly[b % len(assembly)].unit) for a, b in parts.inside.items()]
    # Seals are of no unit in the truth.
    assert set(units) <= {("V-1", "V-1"), ("", "V-1")}
    assert ("V-1", "V-1") in units
