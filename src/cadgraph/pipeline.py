"""The method, from scene to graph: what geometry says, what the parts are called, and what follows from both."""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np

from cadgraph._io.garbage import collector_paused
from cadgraph._io.progress import Progress, quiet
from cadgraph.config import Config, config_as_read
from cadgraph.facts.statements import places_of, statements_of
from cadgraph.facts.words import read_words
from cadgraph.geometry.mesh.properties import measure
from cadgraph.geometry.shape.analysis import measure_shapes_by
from cadgraph.labelers.base import Labeler, label_parts
from cadgraph.labelers.former import settings_with
from cadgraph.labelers.precedence import SettledLabels, settle_labels
from cadgraph.labelers.registry import labeler_of
from cadgraph.model.analysis import Analysis
from cadgraph.model.anchors import anchored_meshes, anchored_parts
from cadgraph.model.catalog import read_catalog
from cadgraph.model.crew import Crew
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.edits import LOST, Edit, Ground, meshes_of, tell_lost
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.parts import Bools, Contacts, Parts, Properties
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary
from cadgraph.stages.adjacency import find_near_meshes, join_contacts
from cadgraph.stages.assemble import Results, assemble_graph
from cadgraph.stages.bridge import cut_bridges, find_weak_bridges, report_bridges
from cadgraph.stages.cluster import cluster_parts
from cadgraph.stages.ground import find_ground, report_ground
from cadgraph.stages.group import group_meshes
from cadgraph.stages.insides import find_insides, join_enclosed
from cadgraph.stages.inspect import inspect_meshes
from cadgraph.stages.mechanisms import find_mechanisms, report_not_movable
from cadgraph.stages.parts import make_parts, regrounded
from cadgraph.stages.places import find_places
from cadgraph.stages.preprocess import prepare_scene
from cadgraph.stages.relate import RelateInput, connect_units, pipe_systems, place_edits, relate_units

__all__ = [
    "ANALYSIS_SETTINGS",
    "CONTRADICTIONS",
    "STAGES",
    "analyse",
    "as_read",
    "build",
    "check_asked",
    "contradicted",
    "ground_as_said",
    "interpret",
    "lay_ground",
]

_WEAK = 0.46  # a likely label below this confidence is no label for the relations
STAGES = ("measure", "contacts", "group", "cluster", "label", "relate", "places", "mechanisms", "assemble")
"""The names that ``build`` gives to its progress, in order."""

ANALYSIS_SETTINGS = ("method", "inspect", "ground", "group", "cluster", "preprocess")
"""The settings that an analysis depends on; all others are about labels and what follows from them."""


def build(
    scene: Scene,
    config: Config | None = None,
    *,
    labels: Sequence[GivenLabel] = (),
    vocabulary: Vocabulary | None = None,
    labeler: Labeler | None = None,
    corrections: Sequence[Edit] = (),
    progress: Progress = quiet,
    crew: Crew | None = None,
) -> SceneGraph:
    """Turns a scene into a scene graph (paper, section III).

    Args:
        scene: what ``load`` returned; it is not changed, and the order of its meshes does not matter.
        config: all settings; the defaults if None.
        labels: labels of source meshes from outside.
        vocabulary: the built-in tree if None.
        labeler: another labeler than the one that is set.
        corrections: a user's that are in force; those of labels spread to parts alike.
        progress: called with the name of a stage and the share of it that is done.
        crew: does the costly steps of the analysis in place of this process; the graph is the same.

    Returns:
        The graph; the same scene and settings give the same graph to the byte.

    Raises:
        LabelError: a label names a mesh that is not in the scene, or a catalogue can't be read.
        ValueError: a setting names a mesh that is not in the scene, or the scene's arrays don't fit together.
        TypeError: an argument is none of its kind.
    """
    tree = vocabulary or default_vocabulary()
    config = as_read(scene, config or Config())
    check_asked(tree, labeler, labels, corrections)
    config = settings_with(config, labeler)
    catalogs = [read_catalog(file) for file in config.label.catalogs]
    analysis = lay_ground(analyse(scene, config, progress, crew), corrections, config)
    progress("label", 0)
    labeling = label_parts(labeler or labeler_of(config.label), analysis.parts, analysis.contacts, tree, config.label)
    settled = settle_labels(
        labeling, analysis, tree, config.label, catalogs=catalogs, given=labels, corrections=corrections
    )
    return interpret(analysis, settled, tree, config, progress, edits=corrections)


def check_asked(vocabulary: object, labeler: object, labels: object, corrections: object) -> None:
    """Makes sure that what ``build`` is given is what it takes.

    Raises:
        TypeError: it isn't; the message says what is.
    """
    if not isinstance(vocabulary, Vocabulary):
        raise TypeError(f"vocabulary: give what read_vocabulary returns, not {reprlib.repr(vocabulary)}")
    if labeler is not None and not callable(getattr(labeler, "label", None)):
        raise TypeError(f"labeler: give an object with a method label, not {reprlib.repr(labeler)}")
    for name, given, kinds, such_as in (
        ("labels", labels, (GivenLabel,), "those that read_labels returns"),
        ("corrections", corrections, get_args(Edit), "those of a Session; what its apply takes is none yet"),
    ):
        wrong = [one for one in given if not isinstance(one, kinds)] if isinstance(given, Sequence) else [given]
        if wrong:
            raise TypeError(f"{name}: give a list of {such_as}, not {reprlib.repr(wrong[0])}")


def as_read(scene: Scene, config: Config) -> Config:
    """The settings with those that a scene was read with, which are kept beside its graph.

    Raises:
        ValueError: a setting says that it was read otherwise.
        TypeError: it is no scene, or these are no settings.
    """
    _check_scene(scene)
    if not isinstance(config, Config):
        raise TypeError(f"build takes a Config, not {type(config).__name__}")
    return config_as_read(config, scene.source.read_with)


def _check_scene(scene: object) -> None:
    if not isinstance(scene, Scene):
        raise TypeError(f"build takes a Scene, as cadgraph.load returns it, not {type(scene).__name__}")


@collector_paused()
def analyse(
    scene: Scene, config: Config | None = None, progress: Progress = quiet, crew: Crew | None = None
) -> Analysis:
    """What geometry alone says of a scene: parts, contacts, structures.

    Args:
        scene: what ``load`` returned; it is not changed.
        config: those of ``ANALYSIS_SETTINGS`` count; the defaults if None.
        progress: called with the name of a stage and the share of it that is done.
        crew: does the costly steps in place of this process; the analysis is the same.

    Raises:
        ValueError: a setting names a mesh that is not in the scene, or the scene's arrays don't fit together.
        TypeError: ``scene`` is no scene.
    """
    _check_scene(scene)
    config = config or Config()
    scene, from_scene = prepare_scene(scene)
    progress("measure", 0)
    scene, properties, from_meshes = inspect_meshes(scene, measure(scene), config.inspect)
    ground = find_ground(scene, properties, config.ground)
    progress("contacts", 0)
    limit = max(config.cluster.eps, config.group.proximity)
    near = find_near_meshes(scene, properties, limit, config, progress, crew)
    seen = _Seen(scene, properties, near, ground, (*scene.diagnostics, *from_scene, *from_meshes))
    analysis = _structured(seen, ground, config, progress)
    if crew is not None:
        measure_shapes_by(crew.facts, analysis.parts)
    return analysis


@dataclass(frozen=True, eq=False)
class _Seen:
    """What is known of a scene's meshes before anything is said of the ground: see ``Analysis``."""

    scene: Scene
    properties: Properties
    near: Contacts
    found_ground: Bools
    notes: tuple[Diagnostic, ...]


def _structured(
    seen: _Seen, ground: Bools, config: Config, progress: Progress = quiet, former: Parts | None = None
) -> Analysis:
    """Parts, contacts and structures of meshes, of which some are the ground; former parts of the same meshes stay."""
    scene, near = seen.scene, seen.near
    progress("group", 0)
    heads = group_meshes(seen.properties, ground, near, config.group)
    parts = regrounded(former, heads, ground) if former is not None else None
    parts = make_parts(scene, seen.properties, heads, ground) if parts is None else parts
    parts = find_insides(parts, config.method)
    contacts = join_contacts(near, parts.part_of_mesh, config.cluster.eps)
    progress("cluster", 0)
    bridges = find_weak_bridges(parts.n_parts, contacts, parts.ground, config.cluster)
    from_bridges = report_bridges(bridges, contacts, parts, config.cluster.cut_bridges)
    contacts = cut_bridges(contacts, bridges) if config.cluster.cut_bridges else contacts
    cluster = cluster_parts(parts.n_parts, contacts, parts.ground, config.cluster.min_samples)
    cluster = join_enclosed(cluster, parts)
    found = (
        *seen.notes,
        *report_ground(scene, seen.properties, config.ground, ground, seen.found_ground),
        *from_bridges,
    )
    settings = config.model_dump(mode="json", include=set(ANALYSIS_SETTINGS))
    return Analysis(
        scene,
        seen.properties,
        parts,
        contacts,
        cluster,
        found,
        settings,
        near=near,
        found_ground=seen.found_ground,
        ground=ground,
        notes=seen.notes,
    )


def ground_as_said(analysis: Analysis, edits: Sequence[Edit]) -> Bools | None:
    """Which meshes are the ground as a user says.

    Args:
        analysis: of the scene, with whatever ground.
        edits: in force; those of the ground count.

    Returns:
        ``(n_meshes,)``; None where it is that of the analysis.
    """
    if analysis.found_ground is None:
        return None
    meshes = anchored_meshes(analysis.scene, analysis.properties)
    wanted = analysis.found_ground.copy()
    for edit in edits:
        mesh = meshes.find(edit.mesh) if isinstance(edit, Ground) else None
        if isinstance(edit, Ground) and mesh is not None:
            wanted[mesh] = edit.ground
    return None if analysis.ground is not None and np.array_equal(wanted, analysis.ground) else wanted


def lay_ground(analysis: Analysis, edits: Sequence[Edit], config: Config | None = None) -> Analysis:
    """An analysis in which the ground is what a user says; parts and structures follow, and nothing is measured again.

    Args:
        analysis: of the scene, with whatever ground.
        edits: in force; those of the ground count.
        config: that it was made with; the defaults if None.
    """
    wanted = ground_as_said(analysis, edits)
    if wanted is None or analysis.near is None or analysis.found_ground is None:
        return analysis
    seen = _Seen(analysis.scene, analysis.properties, analysis.near, analysis.found_ground, analysis.notes)
    return _structured(seen, wanted, config or Config(), former=analysis.parts)


def _without(labels: Sequence[Label | None], weak: Sequence[bool]) -> tuple[Label | None, ...]:
    return tuple(None if out else label for label, out in zip(labels, weak, strict=True))


@collector_paused()
def interpret(
    analysis: Analysis,
    labels: SettledLabels,
    vocabulary: Vocabulary,
    config: Config | None = None,
    progress: Progress = quiet,
    *,
    edits: Sequence[Edit] = (),
) -> SceneGraph:
    """Makes the graph of analysed parts whose labels are settled: units, lines, flow.

    Args:
        analysis: of the scene.
        labels: of its parts.
        vocabulary: the tree that they are from.
        config: all settings, which go into the graph; the defaults if None.
        progress: called with the name of a stage and the share of it that is done.
        edits: a user's that are in force; those of the network count here. That of labels and of the ground must have
            been followed before.
    """
    config = config or Config()
    parts, contacts, cluster = analysis.parts, analysis.contacts, analysis.cluster
    progress("relate", 0)
    # What is rather wrong than right counts by its probabilities, beside those of the other names.
    weak = [label is not None and label.likely and label.confidence < _WEAK for label in labels.labels]
    firm, opinions = _without(labels.labels, weak), _without(labels.opinions, weak)
    statements = (
        statements_of(analysis, read_words(config.label.words), vocabulary) if config.label.use_metadata else None
    )
    placed = place_edits(edits, anchored_parts(analysis.scene, parts))
    given = RelateInput(analysis, firm, opinions, vocabulary, config, labels.probabilities, statements, placed)
    connected = connect_units(given)
    network = connected.network
    named = tuple(
        before if after is None else after for before, after in zip(labels.labels, connected.labels, strict=True)
    )
    lost = _lost(edits, (*placed.unmet, *connected.unmet), analysis)
    related = relate_units(network.units, named, contacts, cluster, vocabulary)
    progress("places", 0)
    # The paper knows no places.
    reached = find_places(parts, named, network.units) if config.method != "paper" else None
    progress("mechanisms", 0)
    # Where people get at a unit says which way a gauge looks, so that there is nothing to find without places.
    motions = find_mechanisms(analysis.scene, parts, named, network, reached.access) if reached is not None else ()
    progress("assemble", 0)
    results = Results(
        scene=analysis.scene,
        parts=parts,
        contacts=contacts,
        cluster=cluster,
        pipe_systems=pipe_systems(named, cluster, vocabulary),
        labels=named,
        guesses=labels.guesses,
        network=network,
        related=related,
        diagnostics=(
            *(*analysis.diagnostics, *labels.diagnostics, *connected.diagnostics, *lost),
            *report_not_movable(analysis.scene, parts, network.units, motions),
        ),
        places=places_of(analysis) if analysis.scene.facts else None,
        reached=reached,
        motions=motions,
    )
    graph = assemble_graph(results, vocabulary, config.model_dump(mode="json"))
    progress("assemble", 1)
    return graph


def _lost(edits: Sequence[Edit], unmet: Sequence[tuple[int, str]], analysis: Analysis) -> list[Diagnostic]:
    """The corrections of the network and of the ground that no longer fit, each with the reason."""
    meshes = anchored_meshes(analysis.scene, analysis.properties)
    gone = [
        (number, "no mesh of that path and shape, and none of that shape in its place")
        for number, edit in enumerate(edits)
        if isinstance(edit, Ground) and meshes.find(edit.mesh) is None
    ]
    told = sorted((*unmet, *gone))
    return [Diagnostic(LOST, tell_lost(edits[number], why), (meshes_of(edits[number]))) for number, why in told]


CONTRADICTIONS = frozenset({"unit-short-of-lines", "end-before-part", "units-touch-unjoined", "line-untraced"})
"""Codes of the diagnostics that say that the network does not add up; often a label is the reason."""


def contradicted(
    analysis: Analysis,
    vocabulary: Vocabulary,
    config: Config,
    labels: Sequence[Label | None],
    probabilities: Probabilities | None,
) -> frozenset[int]:
    """The parts at which the network that follows from labels does not add up: devices short of a line, gaps in lines.

    Args:
        analysis: of the scene.
        vocabulary: the tree that the labels are from.
        config: all settings.
        labels: of each part.
        probabilities: what a labeler holds for possible; None where none is known.
    """
    given = RelateInput(analysis, tuple(labels), tuple(labels), vocabulary, config, probabilities)
    number = {path: part for part, path in enumerate(analysis.parts.scene.paths)}
    found = (one for one in connect_units(given).diagnostics if one.code in CONTRADICTIONS)
    return frozenset(number[mesh] for one in found for mesh in one.meshes if mesh in number)
