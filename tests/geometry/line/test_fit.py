import numpy as np
import pytest

import fittings
from cadgraph.geometry.line.centreline import Branch, Centreline, End
from cadgraph.geometry.line.fit import fit_ends
from cadgraph.geometry.line.mouths import Mouth
from fittings import X

NAN = float("nan")
PIPE = fittings.straight([0 * X, X], [0.05, 0.05], 24)
TRIANGLES = PIPE.mesh[0][PIPE.mesh[1]]


def swept(low=0.0, high=1.0, radius=0.05):
    """A straight line along x from one place to the other."""
    points = np.array([[low, 0, 0], [high, 0, 0]])
    branch = Branch(points, np.full(2, radius), np.full(2, NAN))
    return Centreline((branch,), (End(points[0], -X, radius, NAN, 0), End(points[1], X, radius, NAN, 0)), (), 0.9)


def mouth(x, sense, radius=0.05, off=0.0, bore=NAN):
    return Mouth(np.array([x, off, 0]), sense * X, radius, bore)


def test_ends_and_branch_move_to_their_mouths():
    line = fit_ends(swept(0.02, 0.97), [mouth(0, -1, 0.06, bore=0.04), mouth(1, 1)], TRIANGLES)
    np.testing.assert_allclose(line.branches[0].points[:, 0], [0, 1])
    np.testing.assert_allclose(line.branches[0].radius, [0.06, 0.05])
    np.testing.assert_allclose(line.branches[0].bore, [0.04, NAN])
    assert [(end.point[0], end.radius) for end in line.ends] == [(0.0, 0.06), (1.0, 0.05)]


def test_a_line_without_mouths_stays():
    line = fit_ends(swept(), [], TRIANGLES)
    assert [end.point[0] for end in line.ends] == [0.0, 1.0]


@pytest.mark.parametrize(("short", "fits"), [(0.19, True), (0.21, False)])
def test_an_end_is_at_most_four_radii_before_its_mouth(short, fits):
    line = fit_ends(swept(0.0, 1 - short), [mouth(0, -1), mouth(1, 1)], TRIANGLES)
    assert (line is not None) is fits


@pytest.mark.parametrize(("beyond", "fits"), [(0.049, True), (0.051, False)])
def test_an_end_is_at_most_a_radius_beyond_its_mouth(beyond, fits):
    line = fit_ends(swept(0.0, 1 + beyond), [mouth(0, -1), mouth(1, 1)], TRIANGLES)
    assert (line is not None) is fits


@pytest.mark.parametrize(("off", "fits"), [(0.024, True), (0.026, False)])
def test_an_end_is_at_most_half_a_radius_off_its_mouths_axis(off, fits):
    line = fit_ends(swept(), [mouth(0, -1), mouth(1, 1, off=off)], TRIANGLES)
    assert (line is not None) is fits


@pytest.mark.parametrize(("degrees", "fits"), [(25, True), (27, False)])
def test_an_end_looks_the_way_of_its_mouth(degrees, fits):
    slanted = Mouth(X, np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0]), 0.05, NAN)
    assert (fit_ends(swept(), [mouth(0, -1), slanted], TRIANGLES) is not None) is fits


def test_a_mouth_without_an_end_leaves_no_line():
    branch = Mouth(np.array([0.5, 0, 0.2]), np.array([0, 0, 1.0]), 0.03, NAN)
    assert fit_ends(swept(), [mouth(0, -1), mouth(1, 1), branch], TRIANGLES) is None


def test_of_two_ends_the_nearer_has_the_mouth():
    line = swept()
    more = Centreline(line.branches * 2, (*line.ends, End(0.9 * X, X, 0.05, NAN, 1)), (), 0.9)
    fitted = fit_ends(more, [mouth(0, -1), mouth(1, 1)], TRIANGLES)
    # The surface goes on ahead of the other one, so that the part does not end there.
    assert [end.point[0] for end in fitted.ends] == [0.0, 1.0]


@pytest.mark.parametrize(("x", "ends"), [(0.974, 1), (0.976, 2)])
def test_an_end_without_a_mouth_stays_where_the_surface_stops(x, ends):
    assert len(fit_ends(swept(high=x), [mouth(0, -1)], TRIANGLES).ends) == ends
