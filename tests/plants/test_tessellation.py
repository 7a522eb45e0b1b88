from dataclasses import replace

import numpy as np
import pytest

from cadplants.faults.retessellate import broken, fanned, in_rows, retold, uncapped
from cadplants.model.plant import Assembly, Component
from cadplants.solids.mesh_ops import Solid, volume
from cadplants.solids.primitives import ball, box, cylinder, dome, hexagon, ring, rod, rope, torus, turned, waves
from cadplants.styles.modeling_style import STYLES
from plants.solids import is_closed

FORMS = {
    "ball": ball(0.1, 12),
    "box": box((0.3, 0.2, 0.1)),
    "cylinder": cylinder(0.05, 0.0, 1.0, 16),
    "dome": dome(0.2, 0.1, 0.0, 16),
    "hexagon": hexagon(0.02, 0.0, 0.03),
    "nut": hexagon(0.02, 0.0, 0.03, 0.006),
    "ring": ring(0.1, 0.2, 0.0, 0.3, 14),
    "rod": rod((0, 0, 0), (1, 1, 1), 0.02, 8),
    "rope": rope([(0, 0, 0), (1, 0, 0), (1, 1, 0)], 0.02, 8),
    "torus": torus(0.3, 0.02, 24),
    "waves": turned(waves(0.0, 0.2, 0.05, 0.08, 4), 16),
}


@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)
def test_forms_are_closed_and_look_outward(form):
    assert is_closed(form)
    assert volume(form) > 0


@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)
@pytest.mark.parametrize("step", [0.06, 0.2])
def test_rows_keep_the_solid_and_shorten_its_edges(form, step):
    rows = in_rows(form, step)
    assert is_closed(rows)
    assert volume(rows) == pytest.approx(volume(form))
    corners = rows.vertices[rows.faces]
    assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() <= 1.5 * step + 1e-12


def test_rows_leave_short_edges_alone():
    assert in_rows(FORMS["box"], 10.0).faces.tolist() == FORMS["box"].faces.tolist()


def test_fans_take_the_middle_out_of_a_cap():
    fan = fanned(FORMS["cylinder"])
    assert is_closed(fan)
    assert len(fan.vertices) == len(FORMS["cylinder"].vertices) - 2
    assert volume(fan) == pytest.approx(volume(FORMS["cylinder"]))


@pytest.mark.parametrize("name", ["torus", "ring", "box"])
def test_what_has_no_middle_stays_as_it_is(name):
    assert fanned(FORMS[name]) is FORMS[name]
    assert uncapped(FORMS[name]) is FORMS[name]


def test_an_open_pipe_is_its_wall_alone():
    wall = uncapped(FORMS["cylinder"])
    assert len(wall.faces) == 2 * 16
    assert not is_closed(wall)


def test_broken_meshes_keep_most_of_their_triangles():
    rng = np.random.default_rng(0)
    mesh = FORMS["torus"]
    for _ in range(20):
        assert 0.9 * len(mesh.faces) < len(broken(mesh, rng).faces) < 1.1 * len(mesh.faces)


def test_a_few_triangles_are_never_broken_away():
    few = Solid(np.eye(3), np.array([[0, 1, 2]], np.int32))
    assert broken(few, np.random.default_rng(0)) is few


def one(name, solid):
    return Assembly((Component(solid, "Pipe assembly", name, (0, 0, 0)),))


def test_a_hand_without_ways_of_its_own_changes_nothing():
    whole = one("pipe", FORMS["cylinder"])
    assert retold(whole, STYLES["plant-design"], 0) is whole


def test_only_pipes_lose_their_caps():
    style = replace(STYLES["bim"], capped=False)
    assert not is_closed(retold(one("pipe", FORMS["cylinder"]), style, 0).components[0].solid)
    assert is_closed(retold(one("shaft", FORMS["cylinder"]), style, 0).components[0].solid)


def test_soup_and_cracks_are_told():
    style = replace(STYLES["bim"], soup=1.0, cracks=1.0)
    (component,) = retold(one("pipe", FORMS["torus"]), style, 0).components
    assert component.flaws == ("cracked", "soup")
    assert len(component.solid.vertices) == 3 * len(component.solid.faces)
