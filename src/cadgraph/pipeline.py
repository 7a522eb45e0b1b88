"""The method, from scene to graph."""

from __future__ import annotations

from collections.abc import Sequence

from cadgraph._io.progress import Progress, quiet
from cadgraph.config import Config
from cadgraph.geometry.mesh.properties import measure
from cadgraph.labelers.base import Labeler, label_parts, labeler_of
from cadgraph.labelers.precedence import settle_labels
from cadgraph.model.catalog import read_catalog
from cadgraph.model.corrections import Correction
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import GivenLabel
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary
from cadgraph.stages.adjacency import find_near_meshes, join_contacts
from cadgraph.stages.assemble import Results, assemble_graph
from cadgraph.stages.bridge import cut_bridges, find_weak_bridges, tell_bridges
from cadgraph.stages.cluster import cluster_parts
from cadgraph.stages.ground import find_ground
from cadgraph.stages.group import group_meshes
from cadgraph.stages.inspect import inspect_meshes
from cadgraph.stages.parts import make_parts
from cadgraph.stages.preprocess import prepare_scene
from cadgraph.stages.relate import pipe_systems, relate_units
from cadgraph.stages.relate.connect import connect_units

__all__ = ["STAGES", "build"]

STAGES = ("measure", "contacts", "group", "cluster", "label", "relate", "assemble")
"""The names that ``build`` gives to its progress, in order."""


def build(
    scene: Scene,
    config: Config | None = None,
    *,
    labels: Sequence[GivenLabel] = (),
    vocabulary: Vocabulary | None = None,
    labeler: Labeler | None = None,
    corrections: Sequence[Correction] = (),
    progress: Progress = quiet,
) -> SceneGraph:
    """Turns a scene into a scene graph (paper, section III).

    Args:
        scene: what ``load`` returned; it is not changed, and the order of its meshes does not matter.
        config: all settings; the defaults if None.
        labels: labels of source meshes from outside.
        vocabulary: the built-in tree if None.
        labeler: another labeler than the one that is set.
        corrections: a user's, of single parts; they spread to others like them.
        progress: told how far it is.

    Returns:
        The graph; the same scene and settings give the same graph to the byte.

    Raises:
        LabelError: a label names a mesh that is not in the scene, or a catalogue can't be read.
        ValueError: a setting names a mesh that is not in the scene, or the scene's arrays don't fit together.
        TypeError: ``scene`` is no scene, or ``config`` no configuration.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"build takes a Scene, as cadgraph.load returns it, not {type(scene).__name__}")
    if not isinstance(config, Config | None):
        raise TypeError(f"build takes a Config, not {type(config).__name__}")
    config = config or Config()
    vocabulary = vocabulary or default_vocabulary()
    catalogs = [read_catalog(file) for file in config.label.catalogs]
    scene, told_scene = prepare_scene(scene)

    progress("measure", 0)
    scene, properties, told_meshes = inspect_meshes(scene, measure(scene), config.inspect)
    told = (*told_scene, *told_meshes)
    ground, told_ground = find_ground(scene, properties, config.ground)

    progress("contacts", 0)
    near = find_near_meshes(scene, max(config.cluster.eps, config.group.proximity), config, progress)

    progress("group", 0)
    parts = make_parts(scene, properties, group_meshes(properties, ground, near, config.group), ground)
    contacts = join_contacts(near, parts.part_of_mesh, config.cluster.eps)

    progress("cluster", 0)
    bridges = find_weak_bridges(parts.n_parts, contacts, parts.ground, config.cluster)
    told_bridges = tell_bridges(bridges, contacts, parts, config.cluster.cut_bridges)
    contacts = cut_bridges(contacts, bridges) if config.cluster.cut_bridges else contacts
    cluster = cluster_parts(parts.n_parts, contacts, parts.ground, config.cluster.min_samples)

    progress("label", 0)
    labeler = labeler or labeler_of(config.label)
    labeled = label_parts(labeler, parts, contacts, vocabulary, config.label)
    settled = settle_labels(
        labeled.labels, labeler, catalogs, labels, corrections, scene, parts, contacts, vocabulary, config.label
    )

    progress("relate", 0)
    network, told_lines = connect_units(
        scene, properties, parts, settled.labels, settled.opinions, contacts, cluster, vocabulary, config
    )
    related = relate_units(network.units, settled.labels, contacts, cluster, vocabulary)

    progress("assemble", 0)
    results = Results(
        scene=scene,
        parts=parts,
        contacts=contacts,
        cluster=cluster,
        pipe_systems=pipe_systems(settled.labels, cluster, vocabulary),
        labels=settled.labels,
        guesses=labeled.guesses,
        network=network,
        related=related,
        diagnostics=(
            *scene.diagnostics,
            *told,
            *told_ground,
            *told_bridges,
            *settled.diagnostics,
            *told_lines,
        ),
    )
    graph = assemble_graph(results, vocabulary, config.model_dump(mode="json"))
    progress("assemble", 1)
    return graph
