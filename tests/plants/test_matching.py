from collections import Counter

import numpy as np
import pytest

from cadgraph.model.scene import Scene
from cadgraph.model.truth import Truth
from cadplants import make, match, truth_for, write_plant
from cadplants.truth.truth_writer import truth_of
from cadplants.writers.placing import shells
from plants.small_plant import small_plant


@pytest.fixture(scope="module")
def plant():
    return small_plant()


@pytest.fixture
def truth(plant, tmp_path):
    return Truth.load(write_plant(plant, tmp_path / "plant.stl"))


def meshes_of(plant):
    return [(c.vertices, c.faces) for c in plant.components]


def test_meshes_in_another_order_and_a_little_off_are_found(plant, truth):
    meshes = [(v + 0.0004, f) for v, f in meshes_of(plant)][::-1]
    found = match(Scene.from_meshes(meshes), truth)
    assert list(found.same.values()) == [f"/mesh_{i}" for i in range(plant.n_meshes)][::-1]
    assert found.lines() == ()


def test_the_truth_for_a_scene_is_the_same_in_other_names(plant, truth):
    scene = Scene.from_meshes(meshes_of(plant))
    now = truth_for(scene, truth)
    assert [(row.mesh, row.name) for row in now.meshes] == [
        (f"/mesh_{i}", c.name) for i, c in enumerate(plant.components)
    ]
    assert now.contacts == tuple((f"/mesh_{a}", f"/mesh_{b}") for a, b in plant.contacts)
    assert now.units[0].meshes == ("/mesh_4", "/mesh_5")
    assert now.connections == truth.connections


def test_pieces_of_a_mesh_are_one_part(plant, truth):
    meshes = meshes_of(plant)
    solid = plant.components[4].solid
    pose = plant.components[4].pose
    split = [(one.vertices @ pose[:3, :3].T + pose[:3, 3], one.faces) for one in shells(solid)]
    assert len(split) == 2
    scene = Scene.from_meshes([*meshes[:4], *meshes[5:], *split])
    found = match(scene, truth)
    assert found.split == {"/region_4": ("/mesh_11", "/mesh_12")}
    assert found.missing == found.surplus == ()
    now = truth_for(scene, truth)
    assert ("/mesh_11", "/mesh_12") in now.parts
    assert now.contacts is None


def test_a_piece_with_the_box_of_the_whole_is_not_taken_for_it(tmp_path):
    plant = make("pumps", 0)
    truth = Truth.load(write_plant(plant, tmp_path / "pumps.stl"))
    pieces, of_row = [], []
    for i, c in enumerate(plant.components):
        some = [(one.vertices @ c.pose[:3, :3].T + c.pose[:3, 3], one.faces) for one in shells(c.solid)]
        pieces += some
        of_row += [i] * len(some)
    scene = Scene.from_meshes(pieces)
    labels = [row.name for row in truth_for(scene, truth).meshes]
    assert labels == [plant.components[i].name for i in of_row]
    assert Counter(of_row)[next(i for i, c in enumerate(plant.components) if c.name == "handwheel")] > 3


def test_a_mesh_that_is_cut_in_two_holds_both_halves(plant, truth):
    meshes = meshes_of(plant)
    vertices, faces = meshes[0]
    left = vertices[faces].mean(axis=1)[:, 0] < vertices[:, 0].mean()
    scene = Scene.from_meshes([*meshes[1:], (vertices, faces[left]), (vertices, faces[~left])])
    found = match(scene, truth)
    assert found.split == {"/region_0": ("/mesh_11", "/mesh_12")}
    assert found.missing == found.surplus == ()


def test_merged_meshes_keep_a_label_only_where_they_agree(plant, truth):
    meshes = meshes_of(plant)

    def joined(*some):
        parts = [meshes[i] for i in some]
        shifts = np.cumsum([0, *(len(v) for v, _ in parts)])
        return np.concatenate([v for v, _ in parts]), np.concatenate(
            [f + s for (_, f), s in zip(parts, shifts[:-1], strict=True)]
        )

    rest = [meshes[i] for i in range(plant.n_meshes) if i not in (3, 6, 0, 1)]
    scene = Scene.from_meshes([*rest, joined(3, 6), joined(0, 1)])
    found = match(scene, truth)
    assert found.merged == {"/mesh_8": ("/region_3", "/region_6"), "/mesh_9": ("/region_0", "/region_1")}
    now = {row.mesh: (row.group, row.name) for row in truth_for(scene, truth).meshes}
    assert now["/mesh_8"] == ("Pipe assembly", "gasket")
    assert now["/mesh_9"] == ("Tank", None)


def test_what_is_gone_or_new_is_told(plant, truth):
    meshes = meshes_of(plant)
    far = (meshes[0][0] + 50, meshes[0][1])
    scene = Scene.from_meshes([*meshes[:4], *meshes[6:], far])
    found = match(scene, truth)
    assert found.missing == ("/region_4", "/region_5")
    assert found.surplus == ("/mesh_10",)
    assert len(found.lines()) == 2
    now = truth_for(scene, truth)
    assert {unit.id for unit in now.units} == {"T-1"}
    assert now.connections == ()
    assert now.meshes[-1].group is None


def test_a_truth_without_places_is_refused(plant):
    with pytest.raises(ValueError, match="bounds"):
        match(plant.scene(), Truth.from_json(truth_of(plant)))
