import math

import numpy as np
import pytest

from cadgraph.hydraulics.laws import Friction, quadratic

PIPE = Friction.of(np.array([10.0]), np.array([0.05]), 4.5e-5, 1e-6)


def at(reynolds):
    return np.array([reynolds]) / PIPE.reynolds


def factor(reynolds):
    q = at(reynolds)
    return float(PIPE.loss(q)[0][0] / (PIPE.square[0] * q[0] ** 2))


def test_laminar_flow_loses_head_as_hagen_and_poiseuille_say():
    q = 1e-6
    expected = 128 * 1e-6 * 10 * q / (math.pi * 9.80665 * 0.05**4)
    assert PIPE.loss(np.array([q]))[0][0] == pytest.approx(expected)


@pytest.mark.parametrize("reynolds", [5e3, 1e5, 1e7])
def test_turbulent_friction_is_near_that_of_colebrook(reynolds):
    root = 1 / math.sqrt(factor(reynolds))
    wanted = -2 * math.log10(4.5e-5 / 0.05 / 3.7 + 2.51 * root / reynolds)
    assert root == pytest.approx(wanted, rel=0.02)


@pytest.mark.parametrize("reynolds", [2000.0, 4000.0])
def test_the_laws_meet_without_a_jump(reynolds):
    (before, slope_before), (after, slope_after) = (PIPE.loss(at(reynolds * share)) for share in (1 - 1e-9, 1 + 1e-9))
    assert after == pytest.approx(before, rel=1e-6)
    assert slope_after == pytest.approx(slope_before, rel=1e-3)


def test_the_loss_rises_with_the_flow_and_the_slope_is_its_own():
    q = np.concatenate([-np.geomspace(1e-2, 1e-9, 400), np.geomspace(1e-9, 1e-2, 400)])
    for law in (lambda q: PIPE.loss(q), lambda q: quadratic(q, np.array([1e5]), np.array([1e-6]))):
        head, slope = law(q[:, None])
        assert (np.diff(head[:, 0]) > 0).all()
        step = 1e-6 * np.abs(q[:, None])
        difference = (law(q[:, None] + step)[0] - law(q[:, None] - step)[0]) / (2 * step)
        assert difference == pytest.approx(slope, rel=1e-4)
