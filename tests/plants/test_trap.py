import numpy as np
import pytest
from scipy.spatial import cKDTree

from cadgraph.config import Config
from cadgraph.geometry.contact.points import sample_surface
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import build
from cadplants.presets.trap import VOXEL, make_bent_pipe, make_platform_and_tanks
from plants.solids import is_closed, shell_volumes

TRAPS = {"pipe": make_bent_pipe, "platform": make_platform_and_tanks}


def clusters(plant, method):
    """The clusters that are found, each as the set of names of the true clusters that it holds parts of."""
    scene = plant.scene()
    graph = build(scene, Config().replace({"method": method, "label.labeler": "none"}))
    true = dict(zip(scene.paths, (c.cluster for c in plant.components), strict=True))
    found = {}
    for part in graph.parts():
        cluster = graph.cluster_of(part)
        assert cluster is not None
        found.setdefault(cluster.id, set()).update(true[mesh] for mesh in part.meshes)
    return sorted(map(sorted, found.values()))


def test_paper_mode_splits_the_bent_pipe_and_exact_mode_does_not():
    plant = make_bent_pipe()
    assert clusters(plant, "paper") == [["bent pipe"], ["bent pipe"]]
    assert clusters(plant, "exact") == [["bent pipe"]]


def test_the_split_goes_away_where_the_joint_lies_within_a_voxel():
    assert clusters(make_bent_pipe(VOXEL / 2), "paper") == [["bent pipe"]]


def test_only_the_joint_on_the_border_falls_apart():
    surface = sample_surface(make_bent_pipe().scene(), VOXEL, VOXEL)
    gaps = [cKDTree(surface.of(i)).query(surface.of(i + 1))[0].min() for i in range(4)]
    assert gaps[0] > VOXEL + 1e-5
    assert max(gaps[1:]) < VOXEL / 2


@pytest.mark.slow
@pytest.mark.parametrize("gap", [0.0101, 0.012, 0.016, 0.0199])
def test_paper_mode_joins_the_platform_to_the_tanks_and_exact_mode_does_not(gap):
    plant = make_platform_and_tanks(gap)
    assert clusters(plant, "paper") == [["platform", "tanks"]]
    assert clusters(plant, "exact") == [["platform"], ["tanks"]]


@pytest.mark.slow
def test_both_modes_agree_beyond_two_voxels_and_within_one():
    apart, near = make_platform_and_tanks(0.0201), make_platform_and_tanks(0.0099)
    for method in ("paper", "exact"):
        assert clusters(apart, method) == [["platform"], ["tanks"]]
        assert clusters(near, method) == [["platform", "tanks"]]


def test_a_single_edge_joins_platform_and_tanks():
    plant = make_platform_and_tanks()
    graph = build(plant.scene(), Config().replace({"method": "paper", "label.labeler": "none"}))
    true = dict(zip(plant.paths(), (c.cluster for c in plant.components), strict=True))
    home = {part.id: true[part.meshes[0]] for part in graph.parts()}
    crossing = [e for e in graph.document.edges if e.kind == "adjacent" and home[e.source] != home[e.target]]
    assert len(crossing) == 1
    assert crossing[0].distance == pytest.approx(VOXEL)


@pytest.mark.parametrize("name", TRAPS)
def test_traps_are_clean_solids_with_labels_of_the_vocabulary(name):
    plant = TRAPS[name]()
    vocabulary = default_vocabulary()
    for component in plant.components:
        assert vocabulary.holds(component.group, component.name)
        assert is_closed(component.solid), component.name
        assert (shell_volumes(component.solid) > 0).all(), component.name


@pytest.mark.parametrize("name", TRAPS)
def test_traps_are_the_same_every_time(name):
    one, other = TRAPS[name]().scene(), TRAPS[name]().scene()
    assert np.array_equal(one.vertices, other.vertices)
    assert one.paths == other.paths
