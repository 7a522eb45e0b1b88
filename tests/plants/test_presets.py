from collections import Counter

import numpy as np
import pytest

from cadgraph.model.vocabulary import default_vocabulary
from cadplants import PRESETS, STYLES, Defects, degrade, make
from cadplants.model.plant import turned_front
from cadplants.truth.truth_writer import truth_of
from plants.solids import is_closed, shell_volumes, touching

SMALL = [name for name in PRESETS if name not in ("assortment", "field")]
EXACT = [name for name, style in STYLES.items() if not style.looseness]
LOOSE = [name for name, style in STYLES.items() if style.looseness]


@pytest.fixture(scope="module", params=SMALL)
def plant(request):
    return make(request.param, 0)


def test_labels_are_in_the_vocabulary(plant):
    vocabulary = default_vocabulary()
    assert all(vocabulary.holds(c.group, c.name) for c in plant.components)


def test_components_are_closed_and_look_outward(plant):
    seen = {id(c.solid): c for c in plant.components}
    for component in seen.values():
        assert is_closed(component.solid), component.name
        assert (shell_volumes(component.solid) > 0).all(), component.name


def test_units_are_of_the_type_of_their_group(plant):
    types = {unit.id: unit.type for unit in plant.units}
    assert len(types) == len(plant.units)
    of_group = default_vocabulary().unit_of_group
    for component in plant.components:
        if component.unit:
            assert types[component.unit] == of_group[component.group]
        else:
            assert of_group.get(component.group) is None


def test_every_unit_has_meshes_and_a_place_in_the_network(plant):
    assert {c.unit for c in plant.components} - {""} == {unit.id for unit in plant.units}
    joined = {c.source for c in plant.connections} | {c.target for c in plant.connections}
    assert joined == {unit.id for unit in plant.units} | {point.id for point in plant.points}


def test_junctions_have_three_branches_and_terminals_one(plant):
    degree = Counter()
    for connection in plant.connections:
        degree[connection.source] += 1
        degree[connection.target] += 1
    for point in plant.points:
        assert degree[point.id] == {"junction": 3, "terminal": 1}[point.kind], point


def test_lines_have_no_gaps_in_their_order(plant):
    steps = {}
    for connection in plant.connections:
        steps.setdefault(connection.line, []).append(connection)
    # What hangs on a tank without a pipe is in no line.
    steps.pop("", None)
    for line in steps.values():
        assert all(a.target == b.source for a, b in zip(line, line[1:], strict=False))
        assert all(step.length > 0 for step in line)


def test_each_cluster_hangs_together_and_all_but_one_plant_are_one(plant):
    parent = list(range(plant.n_meshes))

    def root(i):
        while parent[i] != i:
            i = parent[i]
        return i

    for a, b in plant.contacts:
        parent[root(a)] = root(b)
    pieces = {(root(i), c.cluster) for i, c in enumerate(plant.components) if c.name != "ground"}
    clusters = {cluster for _, cluster in pieces}
    assert len(pieces) == len({root(i) for i in range(plant.n_meshes)}) == len(clusters)
    assert len(clusters) == 1 or plant.name == "gallery"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("preset", "style"),
    [(preset, EXACT[k % len(EXACT)]) for k, preset in enumerate(SMALL)]
    + [("skid", style) for style in EXACT]
    + [("pumps", "plant-design"), ("rack", "plant-design"), ("tank", "plant-design"), ("riser", "vendor")],
)
def test_exactly_the_designed_pairs_touch(preset, style):
    pytest.importorskip("fcl")
    plant = make(preset, 1, style)
    assert {tuple(sorted(pair)) for pair in plant.contacts} == set(touching(plant))


@pytest.mark.slow
@pytest.mark.parametrize("preset", SMALL)
@pytest.mark.parametrize("style", LOOSE)
def test_loose_hands_leave_no_more_than_their_looseness(preset, style):
    pytest.importorskip("fcl")
    plant = make(preset, 1, style)
    near = touching(plant, plant.looseness + 1e-6)
    assert {tuple(sorted(pair)) for pair in plant.contacts} <= set(near)


@pytest.mark.parametrize(("preset", "valves", "gauges"), [("skid", 12, 12), ("riser", 6, 6), ("tank", 4, 5)])
@pytest.mark.parametrize("seed", range(3))
def test_structures_of_the_paper_have_its_valves_and_gauges(preset, valves, gauges, seed):
    count = Counter(unit.type for unit in make(preset, seed).units)
    assert (count["valve"], count["gauge"]) == (valves, gauges)


@pytest.mark.slow
@pytest.mark.parametrize("preset", SMALL)
def test_same_seed_same_plant_and_another_seed_another(preset):
    one, again, other = make(preset, 4), make(preset, 4), make(preset, 5)
    assert truth_of(one) == truth_of(again)
    assert np.array_equal(one.scene().vertices, again.scene().vertices)
    assert not np.array_equal(one.scene().vertices, other.scene().vertices)


@pytest.mark.slow
def test_hands_differ_in_what_they_model():
    count = {name: make("skid", 0, name).n_meshes for name in STYLES}
    assert len(STYLES) >= 6
    assert count["bim"] < count["game"] < count["plant-design"] < count["mechanical"]


@pytest.mark.parametrize("arguments", [("skids", 0), ("skid", 0, "foot")])
def test_an_unknown_name_is_an_error(arguments):
    with pytest.raises(ValueError, match="unknown"):
        make(*arguments)


def test_flow_is_known_where_physics_fixes_it():
    drains = [c for c in make("tank", 0).connections if c.line in ("L4", "L5")]
    assert {c.direction for c in drains} == {"forward"}
    assert all(c.reason for c in make("pumps", 0).connections if c.direction != "unknown")


def test_sins_are_recorded():
    clean = make("riser", 0)
    defects = Defects(duplicates=0.05, hidden=0.2, flipped=0.05, soup=0.05, degenerate=0.05, colors="gray")
    plant = degrade(clean, defects, 3)
    assert len(plant.duplicates) == round(0.05 * clean.n_meshes)
    assert plant.hidden
    assert plant.n_meshes == clean.n_meshes + len(plant.duplicates) + len(plant.hidden)
    for a, b in plant.duplicates:
        assert np.array_equal(plant.components[a].vertices, plant.components[b].vertices)
    flaws = Counter(flaw for c in plant.components[: clean.n_meshes] for flaw in c.flaws)
    assert set(flaws) == {"flipped", "soup", "degenerate"}
    assert len({c.color for c in plant.components}) == 1
    truth = truth_of(plant)
    assert len(truth["hidden"]) == len(plant.hidden)
    assert len(truth["meshes"]) == plant.n_meshes


def test_hidden_bodies_lie_inside_without_touching():
    pytest.importorskip("fcl")
    plant = degrade(make("riser", 0), Defects(hidden=0.2), 3)
    hidden = set(plant.hidden)
    assert not [pair for pair in touching(plant) if hidden & set(pair)]


def test_no_sins_change_nothing():
    clean = make("riser", 0)
    assert truth_of(degrade(clean, Defects())) == truth_of(clean)


@pytest.mark.slow
def test_field_holds_all_of_them_apart():
    plant = make("field", 0)
    clusters = Counter(c.cluster for c in plant.components)
    assert 30 <= len(clusters) - 1 <= 45
    assert [c.name for c in plant.components if not c.cluster] == ["ground"]
    boxes = {}
    for component in plant.components:
        low, high = component.vertices.min(axis=0), component.vertices.max(axis=0)
        boxes.setdefault(component.cluster, []).append((low, high))
    assert len({unit.id for unit in plant.units}) == len(plant.units)
    for a, b in plant.contacts:
        pair = {plant.components[a].cluster, plant.components[b].cluster} - {""}
        assert len(pair) == 1


def test_no_dial_looks_into_a_pipe_before_it(plant):
    gauges = {unit.id for unit in plant.units if unit.type == "gauge"}
    fronts = [(c, turned_front(c.front, c.pose)) for c in plant.components if c.unit in gauges and c.front]
    assert fronts
    for component, front in fronts:
        middle = component.pose[:3, 3] + component.pose[:3, :3] @ component.solid.vertices.mean(axis=0)
        sight = middle + np.linspace(0.0, 0.25, 26)[:, None] * np.array(front)
        for line in plant.lines:
            assert clearance(sight, line.points) > line.outer / 2, (component.unit, line.id)


def clearance(places, polyline):
    """The least distance of some places from a polyline."""
    start, along = polyline[:-1], np.diff(polyline, axis=0)
    offset = places[:, None] - start
    share = np.clip((offset * along).sum(axis=2) / np.maximum((along**2).sum(axis=1), 1e-12), 0, 1)
    return np.linalg.norm(offset - share[..., None] * along, axis=2).min()
