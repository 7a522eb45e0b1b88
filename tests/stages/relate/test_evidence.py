"""Each row of the tables of evidence decides something: a scene on each side of it, and both alike without it."""

import numpy as np
import pytest

from cadgraph.stages.relate import decide
from cadgraph.stages.relate.evidence import BASE, CURVES, FLAGS, OPEN_END, Curve, add_up, add_up_one, score_of, tell
from cadgraph.stages.relate.joint import gather_ends
from cadgraph.stages.relate.offer import Offer, bear_witness, offer_mount
from runs import decided, offers, run, stated, taps, touching

WIDE, NARROW = 0.2, 0.05  # radii of which the lesser is a quarter [m]


def faces(*lines, **around):
    """Whether the first two lines are joined."""
    return (0, 1) in decided(lines, **around)


def in_line(gap, *, first=NARROW, second=NARROW, aside=0.0, length=1.0, **around):
    return faces(run(-1, 0, first), run([gap, aside, 0], [gap + length, aside, 0], second), **around)


def at_angle(degrees, gap=0.010, second=0.3 * NARROW, length=1.0):
    """Two pipes whose ends lie on the line that halves the angle between their axes."""
    half = np.radians(degrees) / 2
    first, way = np.array([np.cos(half), np.sin(half), 0]), np.array([np.cos(half), -np.sin(half), 0])
    lines = run(-first, [0, 0, 0], NARROW), run([gap, 0, 0], np.array([gap, 0, 0]) + length * way, second)
    return faces(*lines, contacts=touching([0, 1]))


def in_stated_line(gap, aside=0.0):
    """Two pipes that face each other across a gap, which the file joins."""
    return in_line(gap, first=WIDE, second=WIDE, aside=aside, stated=stated((0, 1)))


def on_its_side(said):
    """A pipe before the side of another one, each of which the file joins to two others, maybe also to each other."""
    lines = [run(0, 3, 0.1), run([1.0, 0.05, 1], [1.0, 0.05, np.sqrt(0.11**2 - 0.05**2)], 0.05)]
    witness = stated((0, 2), (0, 3), (1, 4), (1, 5), *said)
    ends = gather_ends(dict(enumerate(lines)))
    (offer,) = [one for one in taps(lines, 1, 0) if one.kind == "tap"]
    return bear_witness(offer, ends, 0, witness).odds > 0


def mount(*, gap=0.010, along=0.0, off=0.0, facing=None, radius=0.01):
    return offer_mount(0, 1, gap, along, off, facing, radius, False).odds > 0


def tap(gap, *, miss=0.0, from_end=1.0, wall=0.1, radius=0.05):
    """A pipe that ends before the side of another one."""
    lines = [run(0, 3, wall), run([from_end, miss, 1], [from_end, miss, np.sqrt((wall + gap) ** 2 - miss**2)], radius)]
    return any(offer.kind == "tap" and offer.odds > 0 for offer in taps(lines, 1, 0, 0.05))


def at_corner(each):
    """Two pipes that meet in a corner, each of which could sit on something as well."""
    lines = [run(-1, 0), run([0, 0, 0], [0, 1, 0])]
    singles = {row: [Offer("tap", row, 9, 0.0, each)] for row in (1, 2)}
    return (0, 1) in decided(lines, singles)


def beside_sleeve(gap, radius=0.02):
    """Two pipes face each other across a gap, and the first lies in a third one."""
    lines = [run(-1, 0, radius), run(gap, 1, radius), run(-5, 5, 0.03)]
    return (0, 1) in decided(lines, {1: taps(lines, 0, 2)})


def with_habit(others):
    """A gap that is wide for a narrow pipe, and that so many other joints of the plant have."""
    gap = 0.0118
    lines = [run(-1, 0, 0.008), run(gap, 1, 0.008)]
    for k in range(others):
        lines += [run([-1, k + 1, 0], [0, k + 1, 0]), run([gap, k + 1, 0], [1, k + 1, 0])]
    return (0, 1) in decided(lines)


def with_plug(reach):
    """A thin end that sticks out of the first pipe by so much, or in."""
    return faces(run(-1, 0), run(0.010, 1), run(-1, reach, 0.01, only=1))


def plate(length):
    """A pipe before something much wider, a little off its axis, which is a disc where it is shorter than 1.6 radii."""
    return in_line(0.0119, first=0.06, second=0.3, aside=0.0195, length=length)


# For each row: the scene, a value with which the joint is made, and one with which it is not.
CURVE_SCENES = {
    "gap": (lambda value: in_line(value, first=WIDE), 0.010, 0.0118),
    "wide": (lambda radius: in_line(0.0118, first=radius, second=radius), 0.02, 0.0085),
    "depth": (lambda share: at_angle(20, gap=-0.004 - 0.06 * share, length=0.06, second=0.25 * NARROW), 0.9, 1.025),
    "angle": (at_angle, 10.0, 20.0),
    "offset": (lambda share: in_line(0.0, aside=share * NARROW), 0.45, 0.48),
    "size": (lambda share: in_line(0.010, first=0.5, second=share * 0.5), 0.3, 0.18),
    "off": (lambda share: mount(off=share * 0.01 + 0.010), 0.3, 1.0),
    "behind": (lambda share: mount(along=-share * 0.05, radius=0.05), 3.0, 3.6),
    "facing": (lambda cosine: mount(facing=cosine), 0.7, 0.21),
    "miss": (lambda share: tap(0.010, miss=share * 0.1), 0.6, 0.82),
    "far": (in_stated_line, 0.13, 0.149),
    "near end": (lambda share: tap(0.005, miss=0.05, from_end=share * 0.1), 1.1, 0.9),
}

FLAG_SCENES = {
    "habit": (with_habit, 5, 4),
    "bolted": (lambda pairs: in_line(0.013, bolted=pairs), [(0, 1)], []),
    "hidden": (with_plug, -0.005, 0.005),
    "over": (in_line, 0.0120, 0.0121),
    "blocked": (lambda pairs: in_line(0.010, blocked=pairs), [], [(0, 1)]),
    "stated": (lambda pairs: in_line(0.120, first=WIDE, second=WIDE, stated=stated(*pairs)), [(0, 1)], []),
    "unstated": (on_its_side, [(0, 1)], []),
}

# For each kind of joint: the scene, a value on either side of where its base decides, and whether it is made without.
BASE_SCENES = {
    "face": (lambda gap: in_line(gap, first=WIDE), 0.0112, 0.0119, True),
    "corner": (at_corner, 1.2, 1.5, True),
    "mount": (lambda gap: mount(gap=gap), 0.0105, 0.011, False),
    "tap": (lambda gap: tap(gap, miss=0.05), 0.0115, 0.0125, None),
    "sleeve": (beside_sleeve, 0.0118, 0.0121, False),
}


@pytest.mark.parametrize("name", CURVE_SCENES)
def test_what_is_measured_decides(name, monkeypatch):
    scene, made, refused = CURVE_SCENES[name]
    assert scene(made)
    assert not scene(refused)
    monkeypatch.setitem(CURVES, name, Curve((0.0, 1.0), (0.0, 0.0), ""))
    assert scene(made) == scene(refused)


@pytest.mark.parametrize("name", FLAG_SCENES)
def test_what_is_there_or_not_decides(name, monkeypatch):
    scene, made, refused = FLAG_SCENES[name]
    assert scene(made)
    assert not scene(refused)
    monkeypatch.setitem(FLAGS, name, (0.0, ""))
    assert scene(made) == scene(refused)


@pytest.mark.parametrize("name", BASE_SCENES)
def test_what_a_kind_of_joint_starts_from_decides(name, monkeypatch):
    scene, made, refused, without = BASE_SCENES[name]
    assert scene(made)
    assert not scene(refused)
    if without is not None:
        monkeypatch.setitem(BASE, name, 0.0)
        assert scene(refused if without else made) == without
    else:
        assert BASE[name] == 0.0


@pytest.mark.parametrize(("length", "made"), [(0.47, True), (0.49, False)])
def test_a_flange_counts_for_more_than_a_pipe_as_wide(length, made, monkeypatch):
    assert plate(length) == made
    monkeypatch.setitem(FLAGS, "disc", (0.0, ""))
    assert not plate(length)


@pytest.mark.parametrize(("more", "made"), [(1.4, True), (1.6, False)])
def test_an_end_that_is_left_open_costs_so_much(more, made, monkeypatch):
    lines = [run(-1, 0, WIDE), run(0.0066, 1, NARROW)]
    (face,) = offers(lines)[0]
    singles = {1: [Offer("mount", 1, 9, 0.0, face.odds + more)]}
    assert ((0, 1) in decided(lines, singles)) == made
    monkeypatch.setattr(decide, "OPEN_END", 0.0)
    assert (0, 1) not in decided(lines, singles)


def test_every_row_has_its_scenes():
    assert CURVE_SCENES.keys() == CURVES.keys()
    assert FLAG_SCENES.keys() | {"disc"} == FLAGS.keys()
    assert BASE_SCENES.keys() == BASE.keys()
    assert OPEN_END > 0


@pytest.mark.parametrize("name", CURVES)
def test_curves_are_straight_between_their_points_and_level_beyond(name):
    curve = CURVES[name]
    assert list(curve.at) == sorted(curve.at)
    assert len(curve.at) == len(curve.gives)
    np.testing.assert_allclose(curve(np.array(curve.at)), curve.gives)
    assert curve(curve.at[0] - 1) == curve.gives[0]
    assert curve(curve.at[-1] + 1) == curve.gives[-1]
    assert curve(sum(curve.at[:2]) / 2) == pytest.approx(sum(curve.gives[:2]) / 2)
    assert curve(float("nan")) == 0.0


def test_log_odds_add_up_and_what_is_unknown_adds_nothing():
    nan = np.array([np.nan, 0.0])
    total = add_up("face", {"gap": np.zeros(2), "size": nan + 1.0}, {"bolted": np.array([0.0, 1.0])})
    first = BASE["face"] + 2.5
    np.testing.assert_allclose(total, [first, first + 1.0 + FLAGS["bolted"][0]])


def test_one_joint_is_weighed_as_many_are():
    measured = {"gap": 0.0031, "wide": 0.7, "off": 0.61, "behind": 0.13, "facing": float("nan")}
    (many,) = add_up("mount", {name: np.array([value]) for name, value in measured.items()})
    assert add_up_one("mount", measured) == many


@pytest.mark.parametrize(("odds", "score"), [(0.0, 0.5), (2.0, 0.8808), (-2.0, 0.1192), (1e6, 1.0), (-1e6, 0.0)])
def test_a_score_is_the_logistic_function_of_the_log_odds(odds, score):
    assert score_of(odds) == pytest.approx(score, abs=1e-4)


def test_reasons_come_weightiest_first_each_with_its_log_odds():
    assert tell({"gap": 0.005, "angle": 32.0, "size": 1.0}, ("bolted", "over")) == (
        "a gap wider than relate.bridge (-4.0)",
        "axes 32 degrees apart (-2.5)",
        "fasteners hold both (+2.5)",
        "a gap of 5.0 mm (+1.2)",
        "widths as 1 to 1.00 (+1.0)",
    )


def test_what_is_unknown_is_not_told():
    assert tell({"gap": float("nan"), "near end": float("inf"), "offset": 0.0}) == (
        "axes 0.00 radii off each other (+1.0)",
    )
    assert tell({}) == ()
