"""The network of a real plant follows from its shapes, not from how these are cut into triangles."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import fittings
from cadgraph.config import Config, LoadConfig
from cadgraph.load import load
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.records import Connected, Junction, Part, Terminal, Unit
from cadgraph.model.scene import Scene
from cadgraph.pipeline import build

REAL = Path(__file__).parents[3] / "../shared/data/real"
MIRROR = np.diag([1.0, -1.0, 1.0])
CHANGES = ("quartered", "shuffled", "mirrored", "unwelded", "inside out")


def mirrored(mesh, random):
    return mesh[0] @ MIRROR, mesh[1][:, ::-1]


def inside_out(mesh, random):
    return mesh[0], mesh[1][:, ::-1]


CHANGE = {
    "quartered": fittings.quartered, "shuffled": fittings.shuffled, "mirrored": mirrored, "unwelded": fittings.soup,
    "inside out": inside_out,
}  # fmt: skip


@cache
def plant(name):
    """Its meshes with their paths, and the true label of each that has one."""
    folder = REAL / name
    if not folder.is_dir():
        pytest.skip("no real plants here")
    scene = load(folder / "scene.usdc", LoadConfig(isolate=False))
    truth = json.loads((folder / "score.truth.json").read_text())["meshes"]
    labels = [GivenLabel(path, row["group"], row["name"]) for path, row in truth.items() if row.get("name")]
    return [scene.mesh(i) for i in range(scene.n_meshes)], scene.paths, labels


def network(name, change=None, labeler="none", least=None):
    """What is connected with what: units by their first mesh, junctions and ends by their kind."""
    meshes, paths, labels = plant(name)
    random = np.random.default_rng(0)
    if change is not None:
        meshes = [CHANGE[change](mesh, random) for mesh in meshes]
    config = Config().replace({"label.labeler": labeler, "label.min_confidence": least, "ground.find": "none"})
    graph = build(Scene.from_meshes(meshes, paths), config, labels=labels)
    known = {part.id: part.meshes for part in graph.of_layer(Part)}
    names = {unit.id: min(mesh for part in unit.parts for mesh in known[part]) for unit in graph.of_layer(Unit)}
    names |= {node.id: f"{node.kind} end" for node in graph.of_layer(Terminal)}
    names |= {node.id: "junction" for node in graph.of_layer(Junction)}
    return sorted(tuple(sorted((names[one.source], names[one.target]))) for one in graph.of_kind(Connected))


@cache
def as_drawn(name, labeler):
    return network(name, None, labeler)


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize(
    ("name", "labeler"),
    [("plm", "none"), ("plm", "embedded"), pytest.param("wells", "embedded", marks=pytest.mark.slow)],
)
def test_other_triangles_give_the_same_network(name, labeler, change):
    assert network(name, change, labeler) == as_drawn(name, labeler)


@pytest.mark.slow
@pytest.mark.parametrize("least", [0.3, 0.5])
def test_from_where_on_labels_are_given_changes_no_connection(least):
    assert network("plm", None, "embedded", least) == as_drawn("plm", "embedded")


def told(file):
    """The type and kind of each unit on its lines, and how many of their connections have a direction."""
    graph = build(load(file, LoadConfig(isolate=False)))
    # The mark of the plant's origin, which looks like a gauge, is in one of the files only.
    units = [(unit.unit_type, unit.kind) for unit in graph.of_layer(Unit) if unit.unit_type != "gauge"]
    ways = [one.direction for one in graph.of_kind(Connected)]
    return sorted(units, key=str), sum(way != "unknown" for way in ways)


def test_a_plant_tells_as_much_from_the_format_of_its_own_system():
    if not (REAL / "plm").is_dir():
        pytest.skip("no real plants here")
    assert told(REAL / "plm/plm.rvm") == told(REAL / "plm/scene.usdc")
