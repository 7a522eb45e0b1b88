"""Which joints are offered, and what is said for and against them."""

import numpy as np
import pytest

from cadgraph.stages.relate.joint import gather_ends
from cadgraph.stages.relate.offer import Ahead, EndsAhead, Surroundings, is_hidden, near_ends, offer_mount
from runs import offers, run, taps, touching


def flags(lines, **around):
    """The flags of the offer between the first two lines; None where there is none."""
    found, ends = offers(lines, **around)
    for offer in found:
        if {int(ends.part[offer.row]), int(ends.part[offer.other])} == {0, 1}:
            return set(offer.flags)
    return None


def test_two_faces_that_face_each_other_are_offered_with_their_measures():
    (offer,) = offers([run(-1, 0, 0.05), run(0.004, 1, 0.04)])[0]
    assert (offer.kind, offer.row, offer.other) == ("face", 1, 2)
    assert offer.gap == pytest.approx(0.004)
    known = {name: value for name, value in offer.measured.items() if np.isfinite(value)}
    assert known == pytest.approx({"gap": 0.004, "wide": 0.1, "angle": 0.0, "offset": 0.0, "size": 0.8})
    assert offer.flags == ()
    assert 0.95 < offer.score < 1.0
    assert offer.reasons[0] == "a gap of 4.0 mm (+1.4)"


def test_what_lies_in_each_other_has_a_depth_and_no_gap():
    (offer,) = offers([run(-1, 0), run(-0.054, 0.946)], contacts=touching([0, 1]))[0]
    assert offer.gap == pytest.approx(-0.054)
    assert offer.measured["depth"] == pytest.approx(0.05)
    assert np.isnan(offer.measured["gap"])


@pytest.mark.parametrize(("overlap", "deep"), [(0.0039, False), (0.0041, True)])
def test_what_overlaps_no_deeper_than_a_weld_touches(overlap, deep):
    (offer,) = offers([run(-1, 0), run(-overlap, 1)])[0]
    assert np.isfinite(offer.measured["depth"]) == deep


@pytest.mark.parametrize(
    "second", [run(-0.9, 0.004, only=1), run([0.004, 0.06, 0], [1, 0.06, 0]), run([0.004, 0, 0], [0.6, 0.8, 0])],
    ids=["the same way", "beside", "across"],
)  # fmt: skip
def test_ends_that_do_not_face_each_other_are_not_offered(second):
    assert [offer for offer in offers([run(-1, 0), second])[0] if offer.kind == "face"] == []


@pytest.mark.parametrize(("degrees", "kind"), [(31, "face"), (33, "corner"), (119, "corner"), (121, None)])
def test_pipes_whose_axes_are_farther_apart_meet_in_a_corner(degrees, kind):
    turn = np.radians(degrees)
    found = offers([run(-1, 0), run([0, 0, 0], [np.cos(turn), np.sin(turn), 0])])[0]
    assert [offer.kind for offer in found] == [kind] * (kind is not None)


@pytest.mark.parametrize(("share", "offered"), [(0.91, True), (0.89, False)])
def test_only_pipes_of_one_size_meet_in_a_corner(share, offered):
    found = offers([run(-1, 0), run([0, 0, 0], [0, 1, 0], share * 0.05)])[0]
    assert any(offer.kind == "corner" for offer in found) == offered


@pytest.mark.parametrize(("gap", "bridge", "offered"), [(0.0119, 0.006, True), (0.0121, 0.006, False)])
def test_gaps_are_looked_at_up_to_twice_the_bridge(gap, bridge, offered):
    lines = [run(-1, 0, 0.5), run(gap, 1, 0.5)]
    assert bool(offers(lines, bridge=bridge, bolted=[(0, 1)])[0]) == offered
    # Those of parts that are near each other always.
    assert offers(lines, bridge=bridge, bolted=[(0, 1)], contacts=touching([0, 1]))[0]


@pytest.mark.parametrize(("gap", "hidden"), [(0.002, False), (0.006, True)])
def test_an_end_before_a_face_hides_it(gap, hidden):
    lines = [run(-1, 0), run(gap, 1), run(-1, 0.003, 0.02, only=1)]
    assert flags(lines) == ({"hidden"} if hidden else set())


def test_the_far_end_of_what_is_joined_hides_nothing():
    # A gasket of 2 mm has two ends; seen from the pipe the far one lies behind the near one.
    lines = [run(-1, 0), run(0, 0.002), run(0.002, 1)]
    assert flags(lines) == {"disc"}


@pytest.mark.parametrize(
    ("ahead", "hidden"),
    [
        (Ahead(5, 2, 0.004, True), True),  # another end between, which looks the same way
        (Ahead(5, 2, 0.012, True), False),  # beyond
        (Ahead(5, 2, 0.004, False), True),  # a nearer face
        (Ahead(5, 2, 0.010, False), False),  # a face in one place with it
        (Ahead(5, 1, 0.004, True), False),  # of a part of the joint itself
    ],
)
def test_what_lies_in_a_gap_of_ten_millimetres_hides(ahead, hidden):
    assert is_hidden([ahead], 0.010, (0, 1)) == hidden


def test_ends_ahead_lie_on_the_axis_and_not_behind():
    ends = gather_ends(dict(enumerate([run(-1, 0), run(0.01, 1), run([0.01, 0.04, 0], [1, 0.04, 0])])))
    found = EndsAhead(ends, np.array([[0, 2], [1, 2], [1, 4], [1, 3]]))
    assert [(one.row, one.part, one.alike) for one in found.of(1)] == [(2, 1, False), (3, 1, True)]
    assert [(one.row, one.alike) for one in found.of(2)] == [(0, True), (1, False)]
    assert found.of(0) == []


def scattered(seed, n=40):
    """Short lines on few axes, so that many ends lie before others; the third has one end, every seventh none."""
    random = np.random.default_rng(seed)
    lines = {}
    for part in range(n):
        place = random.integers(0, 4, 3) * [0.02, 0.1, 0.1] + random.normal(0, 0.002, 3)
        line = run(place, place + np.array([random.uniform(0.005, 0.05), 0, 0]), only=1 if part % 3 == 0 else None)
        if part % 7:
            lines[2 * part] = line
    return gather_ends(lines)


@pytest.mark.parametrize("seed", range(5))
def test_near_ends_are_those_of_near_parts_and_those_nearer_than_twice_the_bridge(seed):
    ends, random = scattered(seed), np.random.default_rng(seed)
    pairs = sorted({tuple(sorted(random.choice(80, 2, replace=False).tolist())) for _ in range(30)})
    known, bridge = set(pairs), 0.006
    wanted = [
        [p, q]
        for p in range(len(ends.part))
        for q in range(p + 1, len(ends.part))
        if (a := int(ends.part[p])) != (b := int(ends.part[q]))
        and ((a, b) in known or np.linalg.norm(ends.point[p] - ends.point[q]) <= 2 * bridge)
    ]
    assert near_ends(ends, Surroundings(touching(*pairs), bridge)).tolist() == wanted != []


def test_no_ends_are_near_where_there_are_none():
    assert near_ends(gather_ends({}), Surroundings(touching([0, 1]), 0.006)).shape == (0, 2)
    far = gather_ends({0: run(-1, 0), 3: run(5, 6)})
    assert near_ends(far, Surroundings(touching([0, 1], [1, 3]), 0.006)).shape == (0, 2)


@pytest.mark.parametrize("seed", range(5))
def test_what_hides_many_pairs_at_once_hides_each_by_itself(seed):
    ends, random = scattered(seed), np.random.default_rng(seed)
    ahead = EndsAhead(ends, near_ends(ends, Surroundings(touching(), 0.05)))
    pairs = random.integers(0, len(ends.part), (300, 2))
    gap, own = random.uniform(0, 0.06, 300), ends.part[pairs]
    found = ahead.hide(pairs, gap, own)
    each = [
        any(is_hidden(ahead.of(row), wide, parts) for row in pair)
        for pair, wide, parts in zip(pairs.tolist(), gap.tolist(), own.tolist(), strict=True)
    ]
    assert found.tolist() == each
    assert 20 < sum(each) < 280
    assert ahead.hide(pairs[:0], gap[:0], own[:0]).tolist() == []


@pytest.mark.parametrize(("gap", "flag"), [(0.0059, set()), (0.0061, {"blocked"})])
def test_a_solid_near_both_counts_against_a_gap_that_it_fits_into(gap, flag):
    assert flags([run(-1, 0), run(gap, 1)], blocked=[(0, 1)], bolted=[(0, 1)]) == flag | {"bolted"}


@pytest.mark.parametrize(("gap", "flag"), [(0.0039, set()), (0.0041, {"bolted"})])
def test_fasteners_count_where_there_is_a_gap(gap, flag):
    assert flags([run(-1, 0), run(gap, 1)], bolted=[(0, 1)]) == flag


@pytest.mark.parametrize(
    ("gap", "others", "flag"),
    [
        (0.0030, 4, {"habit"}), (0.0030, 3, set()),  # five in all
        (0.0033, 4, {"habit"}), (0.0035, 4, set()),  # alike within 0.4 mm
        (0.0009, 5, set()),  # what is narrower says nothing
    ],
)  # fmt: skip
def test_gaps_that_recur_are_a_habit(gap, others, flag):
    usual = 0.0030 if gap > 0.002 else gap
    lines = [run(-1, 0), run(gap, 1)]
    for k in range(others):
        lines += [run([-1, k + 1, 0], [0, k + 1, 0]), run([usual, k + 1, 0], [1, k + 1, 0])]
    assert flags(lines) == flag


def test_an_end_at_a_solid_is_offered_with_its_measures():
    offer = offer_mount(3, 7, 0.001, 0.02, 0.011, 0.9, 0.05, True)
    assert (offer.kind, offer.row, offer.other, offer.flags) == ("mount", 3, 7, ("hidden",))
    assert dict(offer.measured) == pytest.approx({"gap": 0.001, "wide": 0.02, "off": 0.2, "behind": 0.4, "facing": 0.9})
    assert np.isnan(offer_mount(3, 7, 0.001, 0.02, 0.011, None, 0.05, False).measured["facing"])


def branch(degrees=90.0, aside=0.0, gap=0.0, radius=0.03, wall=0.05, at=1.0):
    """The offers of a pipe that ends at the side of another one along x."""
    turn = np.radians(degrees)
    way = np.array([np.cos(turn), 0, np.sin(turn)])
    foot = np.array([at, aside, 0]) + way * (np.sqrt((wall + gap) ** 2 - aside**2) / np.sin(turn))
    lines = [run(0, 2, wall), run(foot + way, foot, radius)]
    return taps(lines, 1, 0)


def test_an_end_at_the_side_of_a_line_is_a_tap():
    (offer,) = branch()
    assert (offer.kind, offer.row, offer.other) == ("tap", 3, 0)
    np.testing.assert_allclose(offer.tap.point, [1, 0, 0], atol=1e-12)
    assert offer.tap.s == pytest.approx(1.0)
    assert offer.gap == pytest.approx(0.0)


@pytest.mark.parametrize(("degrees", "kinds"), [(32, ["tap"]), (30, [])])
def test_a_tap_meets_the_line_at_an_angle(degrees, kinds):
    assert [offer.kind for offer in branch(degrees)] == kinds


@pytest.mark.parametrize(("share", "offered"), [(0.84, True), (0.86, False)])
def test_a_tap_runs_into_the_axis_within_a_share_of_the_radius(share, offered):
    assert bool(branch(aside=share * 0.05)) == offered


@pytest.mark.parametrize(("ratio", "offered"), [(1.24, True), (1.26, False)])
def test_nothing_much_wider_sits_on_a_line(ratio, offered):
    assert bool(branch(radius=ratio * 0.05)) == offered


@pytest.mark.parametrize(("gap", "offered"), [(0.0119, True), (0.0121, False)])
def test_a_tap_is_within_the_bridge(gap, offered):
    assert bool(branch(gap=gap)) == offered


def test_an_end_along_the_side_of_a_line_is_a_sleeve():
    (offer,) = taps([run(0, 2, 0.06), run(-1, 0.5, 0.05)], 1, 0)
    assert (offer.kind, offer.tap.sleeve) == ("sleeve", True)
    assert offer.tap.s == pytest.approx(0.5)
