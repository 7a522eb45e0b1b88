import random

import pytest

from cadgraph.stages.relate.flow_spread import Evidence, around, idle_links, spread
from flows import link_between, name_of, network


def shown(found, first, last, confidence=0.95, reason=None):
    number, forward = link_between(found, first, last)
    return Evidence(number, forward, confidence, reason or f"{first} to {last}")


def flows(found, *evidence):
    """What flows where, as ``"T1 V1"``, with its confidence."""
    chosen = spread(found, evidence).chosen
    told = {}
    for number, one in chosen.items():
        link = found.links[number]
        ends = [name_of(found, link.source), name_of(found, link.target)]
        told[" ".join(ends if one.forward else ends[::-1])] = one.confidence
    return told


def test_what_flows_into_a_valve_flows_out_a_little_less_sure():
    found = network("P1 V1 V2 X1")
    told = flows(found, shown(found, "P1", "V1"))
    assert told == {
        "P1 V1": 0.95,
        "V1 V2": pytest.approx(0.95 * 0.995),
        "V2 X1": pytest.approx(0.95 * 0.995**2),
    }


@pytest.mark.parametrize("border", ["T1", "E1"])
def test_it_ends_at_tanks_and_equipment(border):
    found = network(f"P1 V1 {border}", f"{border} V2 X1")
    assert set(flows(found, shown(found, "P1", "V1"))) == {"P1 V1", f"V1 {border}"}


def test_a_branch_that_may_go_either_way_is_left_open():
    found = network("P1 J1 T1", "J1 T2")
    assert set(flows(found, shown(found, "P1", "J1"))) == {"P1 J1"}


@pytest.mark.parametrize("closed", ["B1", "G1", "V9 B1"])
def test_closed_ends_and_gauges_are_no_way_out(closed):
    found = network("P1 J1 T1", f"J1 {closed}")
    assert set(flows(found, shown(found, "P1", "J1"))) == {"P1 J1", "J1 T1"}


@pytest.mark.parametrize(("width", "goes_on"), [(0.04, True), (0.041, False)])
def test_a_narrow_open_branch_can_not_take_the_flow_of_its_run(width, goes_on):
    found = network("P1 J1 T1", "J1 V1 X1", sizes={"J1 V1": width, "V1 X1": width})
    assert ("J1 T1" in flows(found, shown(found, "P1", "J1"))) is goes_on


def test_a_narrow_branch_to_a_tank_or_between_two_runs_counts():
    for tail in ("J1 V1 T2", "J1 V1 J2"):
        found = network("P1 J1 T1", tail, "J2 T3", "J2 T4", sizes={"J1 V1": 0.02})
        assert set(flows(found, shown(found, "P1", "J1"))) == {"P1 J1"}


def test_a_narrow_branch_leads_what_flows_in_it_to_its_end():
    found = network("T1 J1 T2", "J1 V1 X1", sizes={"J1 V1": 0.02, "V1 X1": 0.02})
    assert set(flows(found, shown(found, "J1", "V1"))) == {"J1 V1", "V1 X1"}


def test_what_is_behind_narrow_branches_alone_is_dead():
    found = network("P1 J1 T1", "J1 J2", "J2 B1", "J2 V1 X1", sizes={"J2 V1": 0.02, "V1 X1": 0.02})
    assert idle_links(found).dead.issuperset({link_between(found, "J1", "J2")[0]})
    assert "J1 T1" in flows(found, shown(found, "P1", "J1"))


def heating(*more):
    """A pump that drives a loop of three ways from supply to return."""
    return network("P1 J1 V1 J4", "J1 J2 V2 J5", "J2 J3 V3 J6", "J3 V4 J6", "J6 J5", "J5 J4", "J4 V9 P1", *more)


def test_ways_round_a_loop_lead_from_supply_to_return():
    found = heating()
    told = flows(found, shown(found, "P1", "J1"), shown(found, "V9", "P1"))
    expected = "P1 J1,J1 V1,V1 J4,J1 J2,J2 V2,V2 J5,J2 J3,J3 V3,V3 J6,J3 V4,V4 J6,J6 J5,J5 J4,J4 V9,V9 P1"
    assert set(told) == set(expected.split(","))


def test_a_tank_in_the_loop_leaves_what_it_may_turn_open():
    found = heating("J3 T1")
    told = flows(found, shown(found, "P1", "J1"), shown(found, "V9", "P1"))
    assert {"P1 J1", "J4 V9", "V9 P1"} <= set(told)
    assert not {"J3 V3", "V3 J3", "J2 J3", "J3 J2"} & set(told)


def test_a_bridge_between_two_ways_is_left_open():
    found = network("P1 J1 V1 J2 V2 J4 P1", "J1 V3 J3 V4 J4", "J2 V5 J3")
    told = flows(found, shown(found, "P1", "J1"), shown(found, "J4", "P1"))
    assert {"J1 V1", "V1 J2", "J2 V2", "J1 V3", "V4 J4"} <= set(told)
    assert not {"J2 V5", "V5 J2"} & set(told)


def test_pumps_in_parallel_deliver_the_same_way():
    found = network("J1 P1 J2", "J1 P2 J3", "T1 J1", "J2 J3", "J3 V1 T2", "B1 J2")
    told = flows(found, shown(found, "P1", "J2"), shown(found, "P2", "J3"))
    assert {"T1 J1", "J1 P1", "J1 P2", "J2 J3", "J3 V1", "V1 T2"} <= set(told)


def test_reasons_that_disagree_are_taken_back_unless_one_is_much_surer():
    found = network("P1 V1 V2 P2")
    equal = spread(found, [shown(found, "P1", "V1"), shown(found, "P2", "V2")])
    assert not equal.chosen
    assert equal.against
    surer = spread(found, [shown(found, "P1", "V1", 0.95), shown(found, "P2", "V2", 0.74)])
    assert len(surer.chosen) == 3
    assert {one.reason for one in surer.chosen.values()} == {"P1 to V1"}
    nearly = spread(found, [shown(found, "P1", "V1", 0.95), shown(found, "P2", "V2", 0.76)])
    assert not nearly.chosen


def test_everything_flowing_into_one_place_is_a_contradiction():
    found = network("P1 V1 J1", "P2 V2 J1", "P3 V3 J1")
    evidence = [shown(found, f"P{k}", f"V{k}") for k in (1, 2, 3)]
    flowing = spread(found, evidence)
    assert flowing.against
    assert not flowing.chosen


def test_a_loop_with_too_many_ways_is_left_open(monkeypatch):
    monkeypatch.setattr("cadgraph.stages.relate.flow_spread._MOST_STEPS", 10)
    found = heating()
    told = flows(found, shown(found, "P1", "J1"), shown(found, "V9", "P1"))
    assert not {"J1 V1", "J1 J2"} & set(told)


def test_loops_say_nothing_that_another_resistance_would_turn():
    """Flows through random resistances agree with all that is said of a network of loops."""
    np = pytest.importorskip("numpy")
    choose = random.Random(3)
    for _ in range(25):
        names = [f"J{k}" for k in range(1, 7)]
        pairs = [(a, b) for k, a in enumerate(names) for b in names[k + 1 :] if choose.random() < 0.5]
        pairs = list(dict.fromkeys([*pairs, *zip(names[:-1], names[1:], strict=True)]))
        found = network("P1 J1", "P1 J6", *(f"{a} {b}" for a, b in pairs))
        evidence = [shown(found, "P1", "J1"), shown(found, "J6", "P1")]
        told = set(flows(found, *evidence))
        for _ in range(20):
            laplace = np.zeros((6, 6))
            for a, b in pairs:
                i, j, flow = names.index(a), names.index(b), 10 ** choose.uniform(-2, 2)
                laplace[[i, j], [i, j]] += flow
                laplace[[i, j], [j, i]] -= flow
            pressure = np.linalg.lstsq(laplace, np.array([1, 0, 0, 0, 0, -1.0]), rcond=None)[0]
            for a, b in pairs:
                ahead = pressure[names.index(a)] - pressure[names.index(b)]
                assert f"{b} {a}" not in told or ahead <= 1e-9
                assert f"{a} {b}" not in told or ahead >= -1e-9


def test_links_at_a_node_are_told_with_their_sense():
    found = network("V1 V2", "V3 V2")
    assert around(found)[1] == [(0, False), (1, False)]
