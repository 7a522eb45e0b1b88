from dataclasses import replace

import numpy as np
import pytest

from cadgraph.geometry.occupancy import occupied
from cadgraph.model.grid import Grid, from_runs, to_runs
from cadgraph.model.labels import Label
from cadgraph.model.parts import Opening, UnitParts
from cadgraph.model.regions import region_of
from cadgraph.model.scene import Scene
from cadgraph.pipeline import analyse
from cadgraph.stages.places import find_places
from cadplants import STYLES
from cadplants.model.plant import gather
from cadplants.parts.access import ladder, platform, platform_with_stairs
from cadplants.parts.gauge import pressure_gauge
from cadplants.solids.mesh_ops import box
from cadplants.solids.transforms import at

STYLE = STYLES["bim"]


def thing(size, middle, name, group="Structural element"):
    solid = box(size, middle)
    return (solid.vertices, solid.faces), Label(group=group, name=name, confidence=1.0, source="given")


def components(assembly):
    return [
        ((c.vertices, c.faces), Label(group=c.group, name=c.name, confidence=1.0, source="given"))
        for c in assembly.components
    ]


def found(things, units=()):
    """The places of labelled meshes, and the access of units: type, and which of the meshes each is."""
    scene = Scene.from_meshes([mesh for mesh, _ in things], [f"/m{k:04d}" for k in range(len(things))])
    parts = analyse(scene).parts
    labels = [things[meshes[0]][1] for meshes in parts.meshes]
    made = [
        UnitParts(
            kind,
            f"X-{n}",
            tuple(sorted({int(parts.part_of_mesh[m]) for m in members})),
            openings=(Opening((0.0, 0.0, 0.0)),),
        )
        for n, (kind, members) in enumerate(units)
    ]
    return find_places(parts, labels, made)


def wheel(x, y, z):
    return thing((0.2, 0.2, 0.05), (x, y, z), "handwheel", "Valve assembly")


def slab():
    return thing((8.0, 8.0, 0.1), (0, 0, -0.05), "ground")


@pytest.fixture(scope="module", params=["stairs", "ladder"])
def with_platform(request):
    """A platform at 2 m with a way up, and wheels low, above the platform, and far up."""
    if request.param == "stairs":
        built = platform_with_stairs(3.0, 1.2, 2.0, STYLE, 0.5)
    else:
        built = gather([platform(3.0, 1.2, 2.0, STYLE, 0.5), ladder(2.0, STYLE).placed(at(0.5, -0.75))])
    things = [slab(), *components(built), wheel(3.0, 3.0, 1.1), wheel(0.0, 0.9, 3.2), wheel(3.0, -3.0, 4.5)]
    n = len(things)
    return request.param, found(things, [("valve", [n - 3]), ("valve", [n - 2]), ("valve", [n - 1])])


def test_a_platform_is_reached_over_its_way_up_and_that_from_the_ground(with_platform):
    kind, site = with_platform
    assert sorted(place.kind for place in site.places) == sorted(["ground", "platform", kind])
    way = next(place for place in site.places if place.kind == kind)
    level = next(place for place in site.places if place.kind == "platform")
    assert site.places[0].kind == "ground"
    assert level.name.startswith("platform +2.00 m")
    assert [site.places[k] for k in level.reached_from] == [way]
    assert way.reached_from == (0,)
    assert [round(z, 3) for _, _, z in way.landings] == [0.0, 2.0]


def test_units_are_reached_from_the_floor_from_a_platform_or_not_at_all(with_platform):
    _, site = with_platform
    low, above, far = site.access
    assert (low.reach, above.reach, far.reach) == ("floor", "platform", "out of reach")
    assert (low.height, above.height) == pytest.approx((1.1, 1.2))
    assert above.stand[2] == pytest.approx(2.0)
    assert np.hypot(above.stand[0], above.stand[1] - 0.9) <= 1.0
    assert far.stand is None


def test_a_platform_without_a_way_up_brings_nothing_within_reach():
    things = [slab(), *components(platform(3.0, 1.2, 2.0, STYLE, 0.5)), wheel(0.0, 0.9, 3.2)]
    site = found(things, [("valve", [len(things) - 1])])
    assert [place.reached_from for place in site.places] == [(), ()]
    assert site.access[0].reach == "out of reach"


@pytest.mark.parametrize(("gap", "rise", "n"), [(0.14, 0.0, 1), (0.16, 0.0, 2), (0.0, 0.04, 1), (0.0, 0.06, 2)])
def test_gratings_close_by_at_one_height_are_one_level(gap, rise, n):
    things = [
        slab(),
        thing((1.0, 1.0, 0.03), (0, 0, 2.0), "grating"),
        thing((1.0, 1.0, 0.03), (1.0 + gap, 0, 2.0 + rise), "grating"),
    ]
    assert sum(place.kind == "platform" for place in found(things).places) == n


def test_what_is_small_low_or_a_bare_plate_is_no_level():
    things = [
        slab(),
        thing((0.4, 0.4, 0.03), (0, 0, 2.0), "grating"),
        thing((1.0, 1.0, 0.03), (2, 0, 0.25), "grating"),
        thing((1.0, 1.0, 0.03), (-2, 0, 2.0), "plate"),
    ]
    assert [place.kind for place in found(things).places] == ["ground"]


def test_nobody_stands_where_something_is_between_ankle_and_head():
    wall = thing((0.1, 8.0, 2.0), (0, 0, 1.0), "wall")
    site = found([slab(), wall, thing((2.0, 2.0, 0.1), (2.5, 0, 1.95), "beam")])
    ground = site.places[0]
    xs, ys = ground.grid.centers()
    middle = int(np.argmin(np.abs(ys)))
    free = ground.free[middle]
    assert not free[np.abs(xs) < 0.2].any()
    # What begins above the head is in nobody's way; of two sides of a wall one is reached.
    assert free[np.abs(xs - 2.5) < 0.5].all() or free[np.abs(xs + 2.5) < 0.5].all()


@pytest.mark.parametrize("turn", [0.0, 1.1, 2.5, 4.4])
@pytest.mark.parametrize("grain", ["few", "pieces"])
def test_the_face_of_a_gauge_is_found_and_seen(turn, grain):
    gauge = pressure_gauge("G-1", replace(STYLES["plant-design"], gauge=grain), 100, 0.09, turn).placed(at(0, 0, 1.0))
    site = found([slab(), *components(gauge)], [("gauge", list(range(1, 1 + len(gauge.components))))])
    access = site.access[0]
    assert access.reach == "floor"
    assert np.dot(access.facing, (np.sin(turn), -np.cos(turn), 0)) > 0.95
    way = np.array(access.viewpoint) - (0, 0, 1.0)
    assert np.dot(way, access.facing) > 0


def test_a_gauge_behind_a_board_is_not_seen_from_its_front():
    gauge = pressure_gauge("G-1", replace(STYLES["plant-design"], gauge="pieces"), 100, 0.09).placed(at(0, 0, 1.0))
    board = thing((6.0, 0.02, 2.5), (0, -0.2, 1.25), "wall")
    site = found([slab(), board, *components(gauge)], [("gauge", list(range(2, 2 + len(gauge.components))))])
    assert site.access[0].facing[1] < -0.9
    assert site.access[0].viewpoint is None


def test_squares_under_a_tilted_triangle_are_those_that_its_points_between_the_heights_lie_in():
    corners = np.array([[0.13, 0.21, 0.0], [2.37, 0.64, 2.0], [0.55, 1.91, 1.0]])
    scene = Scene.from_meshes([(corners, np.array([[0, 1, 2]]))], ["/t"])
    grid = Grid((0.0, 0.0), 0.1, (25, 20))
    rng = np.random.default_rng(1)
    weights = rng.dirichlet((1, 1, 1), 200_000)
    points = weights @ corners
    points = points[(points[:, 2] >= 0.5) & (points[:, 2] <= 1.2)]
    sampled = np.zeros((20, 25), bool)
    columns, rows = grid.square_of(points).T
    sampled[rows, columns] = True
    drawn = occupied(scene, np.array([0]), 0.5 - scene.origin[2], 1.2 - scene.origin[2], _moved(grid, scene))
    assert (drawn | ~sampled).all()
    assert (drawn & ~sampled).sum() <= 2  # corners that hardly a point falls into


def _moved(grid, scene):
    return replace(grid, origin=(grid.origin[0] - scene.origin[0], grid.origin[1] - scene.origin[1]))


@pytest.mark.parametrize("free", [np.zeros((3, 4), bool), np.ones((3, 4), bool), np.eye(4, dtype=bool)])
def test_runs_say_which_squares_are_free(free):
    assert (from_runs(to_runs(free), free.shape[::-1]) == free).all()


def test_a_grid_over_much_ground_has_larger_squares():
    grid = Grid.over((0, 0), (1000, 1000), 0.1, 4_000_000)
    assert grid.step == pytest.approx(0.8)
    assert np.prod(grid.size) <= 4_000_000


@pytest.mark.parametrize(
    ("point", "words"), [((9, 9), "north east"), ((5, 5), "middle"), ((5, -3), "south"), ((0, 5), "west")]
)
def test_regions_are_ninths_of_the_plan(point, words):
    assert region_of((0, 0), (10, 10), point) == words
