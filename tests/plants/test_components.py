import numpy as np
import pytest

from cadgraph.model.vocabulary import default_vocabulary
from cadplants import STYLES
from cadplants.lines.instrument import meter_at, strainer_at, valve_at
from cadplants.lines.layout import Run, lay
from cadplants.lines.route import Route
from cadplants.model.plant import gather
from cadplants.model.standards import ELBOW_LONG_RADIUS, FACE_TO_FACE, FLANGES, PIPES, SIZES
from cadplants.parts.access import platform, railing, stairs
from cadplants.parts.brand import Brand
from cadplants.parts.electrical import cabinet, cable_tray, lamp, sign
from cadplants.parts.enclosure import fence, pillar
from cadplants.parts.fastener import bolt, pipe_support
from cadplants.parts.flange import flange, flange_length, gasket
from cadplants.parts.gauge import pressure_gauge
from cadplants.parts.piping import cap, elbow, outlet, pipe, reducer, tee
from cadplants.parts.pump import pump
from cadplants.parts.structure import caster, deck, post
from cadplants.parts.valve import VALVES, valve_length
from cadplants.parts.vessel import Nozzle, tank
from plants.solids import is_closed, least_edge, shell_volumes, touching

pytestmark = pytest.mark.slow

SOME = (15, 25, 50, 80, 150, 300)


def builds(dn, style):
    valves = [build("V-1", dn, style).assembly for kind, build in VALVES.items() if dn in FACE_TO_FACE[kind]]
    return gather(
        [
            *valves,
            flange(dn, style),
            flange(dn, style, blind=True),
            gasket(dn, style),
            bolt(FLANGES[dn].bolt, 0.05, style),
            pipe(dn, 1.0, style),
            elbow(dn, np.pi / 2, style),
            elbow(dn, np.pi / 4, style),
            outlet(dn, style),
            pipe_support(dn, style),
            pressure_gauge("G-1", style),
            pressure_gauge("G-2", style, size=100),
            caster(style),
            deck(2.0, 0.8, style),
            post(1.0, style),
            cap(dn, style),
            tee(dn, dn, style).assembly,
            tee(dn, 15, style).assembly,
        ]
    )


def yard(style):
    nozzles = [
        Nozzle(50, "top", (0.2, 0.1)),
        Nozzle(25, "side", (0.3, 0.5)),
        Nozzle(300, "side", (2.0, 0.6), manway=True),
    ]
    return gather(
        [
            tank("T-1", style, 0.7, 1.5, 0.3, nozzles).assembly,
            *(pump("P-1", a, b, style).assembly for a, b in ((50, 32), (80, 50), (150, 100))),
            platform(3.0, 1.6, 2.2, style, 0.3),
            stairs(2.2, style),
            railing((0.0, 0.0, 0.0), (2.0, 0.0, 1.5), style),
            fence(2.4, style),
            fence(2.4, style, gate=True),
            pillar(style),
            cabinet(style),
            cable_tray(3.0, style, pieces=2),
            lamp(style),
            sign(style),
        ]
    )


@pytest.mark.slow
@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
@pytest.mark.parametrize("dn", SOME)
def test_every_component_is_a_closed_solid_that_looks_outward(style, dn):
    for component in builds(dn, style).components:
        assert is_closed(component.solid), component.name
        assert (shell_volumes(component.solid) > 0).all(), component.name
        assert least_edge(component.solid) > 1e-7, component.name


MAKES = [
    Brand("plate", 3, "straight", "barrel", "barrel", True),
    Brand("solid", 5, "straight", "barrel", "barrel", False),
    Brand("plate", 6, "cranked", "two-piece", "barrel"),
]


@pytest.mark.slow
@pytest.mark.parametrize("make", MAKES)
@pytest.mark.parametrize("dn", [15, 50, 200])
def test_devices_of_every_make_touch_their_joints_and_nothing_else(make, dn):
    pytest.importorskip("fcl")
    style = STYLES["mechanical"]
    kinds = [kind for kind in VALVES if dn in FACE_TO_FACE[kind]]
    step = max(1.2, 0.012 * dn)
    items = [valve_at((i + 1) * step, kind, f"V-{i}", dn, make=make) for i, kind in enumerate(kinds)]
    end = (len(kinds) + 1) * step
    items += [valve_at(end, "ball", "V-9", dn, actuated=True), meter_at(end + step, "F-1", dn)]
    items.append(strainer_at(end + 2 * step, dn))
    route = Route(np.array([(0.0, 0.0, 0.0), (end + 3 * step, 0.0, 0.0)]))
    laid = lay(Run("L", dn, route, tuple(items), ends=("blind", "flange")), style)
    assert {tuple(sorted(pair)) for pair in laid.assembly.contacts} == set(touching(laid.assembly))
    for component in laid.assembly.components:
        assert is_closed(component.solid), component.name
        assert (shell_volumes(component.solid) > 0).all(), component.name


@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
def test_everything_else_in_a_yard_is_closed_too(style):
    for component in yard(style).components:
        assert is_closed(component.solid), component.name
        assert (shell_volumes(component.solid) > 0).all(), component.name


@pytest.mark.parametrize("height", [1.5, 1.8, 2.1, 3.0, 3.7])
def test_every_tread_lies_between_its_stringers(height):
    pytest.importorskip("fcl")
    steps = stairs(height, STYLES["plant-design"])
    assert set(steps.contacts) == set(touching(steps))


def test_platform_stands_on_its_columns_and_carries_its_railing():
    pytest.importorskip("fcl")
    floor = platform(3.0, 1.6, 2.4, STYLES["plant-design"], 0.3)
    assert {tuple(sorted(pair)) for pair in floor.contacts} == set(touching(floor))


@pytest.mark.parametrize(("dn", "other"), [(100, 50), (50, 100), (80, 65)])
def test_reducer_leads_from_one_bore_to_the_other(dn, other):
    device = reducer(dn, other, STYLES["plant-design"])
    vertices = device.assembly.components[0].vertices
    for x, size in ((0.0, dn), (device.length, other)):
        rim = vertices[np.isclose(vertices[:, 0], x)]
        assert np.ptp(rim[:, 1]) == pytest.approx(PIPES[size].outer)
    assert is_closed(device.assembly.components[0].solid)


@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
def test_every_label_is_in_the_vocabulary(style):
    vocabulary = default_vocabulary()
    for component in (*builds(50, style).components, *yard(style).components):
        assert vocabulary.holds(component.group, component.name), (component.group, component.name)


def test_components_refer_to_units_that_exist():
    whole = builds(50, STYLES["plant-design"])
    assert {c.unit for c in whole.components} - {""} == {unit.id for unit in whole.units}


@pytest.mark.parametrize("dn", SIZES)
def test_flange_has_the_size_of_the_standard(dn):
    style = STYLES["plant-design"]
    vertices = flange(dn, style).components[0].vertices
    size = FLANGES[dn]
    np.testing.assert_allclose(np.ptp(vertices, axis=0), [flange_length(dn, style), size.outer, size.outer], rtol=1e-9)
    holes = np.hypot(vertices[:, 1], vertices[:, 2])
    drilled = (holes > size.raised / 2 + 1e-6) & (holes < size.outer / 2 - 1e-6) & (vertices[:, 0] < 0.003)
    angles = np.arctan2(vertices[drilled, 2], vertices[drilled, 1])
    assert len(np.unique(np.floor(angles * size.n_bolts / (2 * np.pi)))) == size.n_bolts


def test_flanges_of_one_size_bolt_together_where_their_holes_are():
    for size in FLANGES.values():
        assert size.bolt < size.hole < size.bolt + 0.0042
        assert size.circle / 2 + size.hole / 2 < size.outer / 2
        assert size.circle / 2 - size.hole / 2 > size.raised / 2


@pytest.mark.parametrize("dn", SIZES)
def test_elbow_ends_where_the_standard_says(dn):
    vertices = elbow(dn, np.pi / 2, STYLES["plant-design"]).components[0].vertices
    reach = ELBOW_LONG_RADIUS[dn]
    assert vertices[:, 1].max() == pytest.approx(reach)
    at_end = vertices[np.isclose(vertices[:, 1], reach)]
    assert (at_end[:, 0].max() + at_end[:, 0].min()) / 2 == pytest.approx(reach)
    assert np.ptp(at_end[:, 0]) == pytest.approx(PIPES[dn].outer)


@pytest.mark.parametrize("kind", VALVES)
@pytest.mark.parametrize("dn", SOME)
def test_valve_is_as_long_as_the_standard_says(kind, dn):
    if dn not in FACE_TO_FACE[kind]:
        pytest.skip("the standard has no such size")
    device = VALVES[kind]("V-1", dn, STYLES["plant-design"])
    body = np.concatenate([c.vertices for c in device.assembly.components if c.name == "valve body"])
    body = body[np.hypot(body[:, 1], body[:, 2]) < FLANGES[dn].raised / 2 + 1e-6]
    assert device.length == valve_length(kind, dn)
    assert body[:, 0].min() == pytest.approx(0.0)
    assert body[:, 0].max() == pytest.approx(device.length)


def test_repeats_share_one_solid():
    style = STYLES["plant-design"]
    assert bolt(0.0159, 0.05, style).components[0].solid is bolt(0.0159, 0.05, style).components[0].solid
