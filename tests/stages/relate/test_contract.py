"""Where runs end: not in the pots and lids of strainers."""

from __future__ import annotations

import numpy as np
import pytest

from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.records import Junction, Terminal
from cadgraph.pipeline import build
from cadplants import STYLES
from cadplants.lines.instrument import strainer_at, tee_at, valve_at
from cadplants.lines.layout import Run, lay
from cadplants.lines.route import Route
from cadplants.model.plant import Plant
from cadplants.presets.single_device import make_device


def ends_of(plant, wrong=None):
    """Junctions and ends of the lines of a plant whose labels are known, but for names that are ``wrong``."""
    known = zip(plant.paths(), plant.components, strict=True)
    labels = [GivenLabel(path, part.group, (wrong or {}).get(part.name, part.name)) for path, part in known]
    graph = build(plant.scene(), labels=labels)
    return graph.of_layer(Junction), graph.of_layer(Terminal)


def line(dn, style, length):
    """A line from a lid at x = 0, with a strainer at 2 m, open at its end."""
    route = Route(np.array([(0.0, 0.0, 1.0), (length, 0.0, 1.0)]))
    items = (valve_at(1.0, "gate", "V-1", dn), strainer_at(2.0, dn))
    laid = lay(Run("L", dn, route, items, ends=("blind", "flange")), STYLES[style])
    return Plant.of(laid.assembly, "line", 0, [STYLES[style]])


@pytest.mark.parametrize("dn", [25, 100, 200])
@pytest.mark.parametrize("style", ["plant-design", "bim"])
def test_a_pot_under_a_line_is_no_end_of_it(dn, style):
    junctions, terminals = ends_of(line(dn, style, 4.0))
    assert not junctions
    assert [(end.kind, round(end.point[0])) for end in terminals] == [("blind", 0), ("open", 4)]


def test_a_strainer_at_the_end_of_a_line_keeps_its_open_mouth():
    plant = line(100, "plant-design", 4.0)
    body = next(k for k, part in enumerate(plant.components) if part.name == "strainer")
    end = float(plant.components[body].vertices[:, 0].max())
    beyond = [k for k, part in enumerate(plant.components) if part.vertices[:, 0].max() > end + 1e-3]
    _, terminals = ends_of(plant.without(beyond))
    assert [(end.kind, end.point[0]) for end in terminals] == [("blind", pytest.approx(0, abs=0.1)), ("open", end)]


@pytest.mark.parametrize("family", ["strainer/basket", "strainer/tee"])
def test_the_mouths_of_a_strainer_by_itself_are_not_lost(family):
    plant = make_device(family, 3, "plant-design", 100)
    whole = np.concatenate([part.vertices for part in plant.components])
    _, terminals = ends_of(plant)
    at = [end.point[0] for end in terminals if abs(end.point[2]) < 1e-6]
    assert min(at) == pytest.approx(whole[:, 0].min())
    assert max(at) == pytest.approx(whole[:, 0].max())


def test_an_open_branch_of_a_tee_that_is_taken_for_a_strainer_stays():
    route = Route(np.array([(0.0, 0.0, 1.0), (4.0, 0.0, 1.0)]))
    laid = lay(Run("L", 100, route, (tee_at(2.0, "J-1", 100, 80),), ends=("blind", "flange")), STYLES["plant-design"])
    plant = Plant.of(laid.assembly, "line", 0, [STYLES["plant-design"]])
    _, terminals = ends_of(plant, {"tee": "strainer"})
    assert sorted(end.kind for end in terminals) == ["blind", "open", "open"]
