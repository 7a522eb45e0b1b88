"""Answers that are worked out by hand, or another way."""

import math
from itertools import permutations

import pytest

from cadlab.agentbench import solvers
from cadlab.agentbench.facts import Fact, Facts, Link


def facts(nodes, links):
    """Facts of ``name: (type, kind, height)`` and of ``(from, to, length, flow)``."""
    made = {}
    for k, (name, (type_, kind, height)) in enumerate(nodes.items()):
        shuts = type_ == "valve" and kind in ("ball valve", "gate valve")
        middle = (float(k), 0.0, height) if height is not None else None
        made[name] = Fact(name, name, type_, kind, middle, shuts)
    leaving = {name: [] for name in made}
    turned = {"along": "against", "against": "along", "unknown": "unknown"}
    for number, (source, target, length, flow) in enumerate(links):
        leaving[source].append(Link(number, target, length, flow))
        leaving[target].append(Link(number, source, length, turned[flow]))
    return Facts(made, {name: tuple(each) for name, each in leaving.items()})


@pytest.fixture
def line():
    """T -> A -> P -> C (check) -> B -> J; J -> G (gauge), J -> R (relief) -> out, J -> D -> blind end."""
    return facts(
        {
            "T": ("tank", None, 3.0), "A": ("valve", "gate valve", 1.0), "P": ("pump", "centrifugal pump", 0.5),
            "C": ("valve", "check valve", 0.6), "B": ("valve", "ball valve", 0.7), "J": ("junction", None, None),
            "G": ("gauge", "pressure gauge", 1.5), "R": ("valve", "relief valve", 2.0), "out": ("open", None, None),
            "D": ("valve", "ball valve", 0.2), "lid": ("blind", None, None),
        },
        [
            ("T", "A", 1.0, "along"), ("A", "P", 2.0, "along"), ("P", "C", 0.5, "along"), ("C", "B", 0.5, "along"),
            ("B", "J", 1.0, "along"), ("J", "G", 0.2, "unknown"), ("J", "R", 0.4, "unknown"),
            ("R", "out", 0.6, "along"), ("J", "D", 0.3, "unknown"), ("D", "lid", 0.3, "unknown"),
        ],
    )  # fmt: skip


def test_isolation_passes_check_valves_and_stops_at_the_nearest_valve_that_shuts(line):
    assert solvers.isolate(line, "C") == ["A", "B"]  # behind B lies an open end, if only past a relief valve
    assert solvers.isolate(line, "R") is None  # its outlet is open
    assert solvers.isolate(line, "G") == ["B"]


def test_what_leads_to_a_tank_without_a_valve_is_not_isolated(line):
    assert solvers.isolate(line, "A") is None


def test_closing_what_must_not_be_closed_leaks(line):
    assert solvers.leaks(line, "P", ["A"]) == []
    assert solvers.leaks(line, "P", ["C"]) == ["C", "T"]
    assert solvers.leaks(line, "B", []) == ["T"]


def test_an_isolation_with_something_short_of_lines_cannot_be_told(line):
    short = Fact("C", "C", "valve", "check valve", short=True)
    assert solvers.isolate(Facts({**line.nodes, "C": short}, line.links), "C") is None


def test_closing_cuts_off_what_no_source_feeds_any_more(line):
    assert solvers.cut_off(line, ["A"]) == ["G", "P"]
    assert solvers.cut_off(line, ["B"]) == ["G"]
    assert solvers.cut_off(line, ["D"]) == []


def test_an_outlet_feeds_nothing_but_an_end_that_is_none_does(line):
    ends = [("well", "V", 1.0, "unknown"), ("V", "G", 1.0, "unknown"), ("G", "drain", 1.0, "along")]
    nodes = {"well": ("open", None, None), "V": ("valve", "ball valve", 1.0), "G": ("gauge", None, 1.0)}
    assert solvers.cut_off(facts({**nodes, "drain": ("open", None, None)}, ends), ["V"]) == ["G"]
    assert solvers.cut_off(facts({**nodes, "drain": ("open", None, None)}, [*ends[:2], ("G", "drain", 1, "unknown")]), ["V"]) == []  # fmt: skip # noqa: E501


def test_downstream_takes_gauges_beside_the_line_but_not_dead_ends(line):
    assert solvers.downstream(line, "P", "gauge") == ["G"]
    assert solvers.downstream(line, "P", "valve") == ["B", "C"]
    assert solvers.fed_by(line, "B") == ["P", "T"]
    assert not solvers.halts(line, "C", against=True)
    assert solvers.halts(line, "B")  # nobody says whether the relief valve lets through


def test_ways_have_lengths_and_an_order_without_gauges(line):
    assert solvers.length(line, "T", "B") == pytest.approx(4.0)
    assert solvers.order(line, "D", "P") == ["D", "B", "C", "P"]
    assert solvers.is_clear(line, "T", "B")


def test_of_two_ways_of_nearly_one_length_none_is_clear():
    units = dict.fromkeys("abcd", ("valve", "ball valve", 1.0))
    both = [("a", "b", 1.0, "unknown"), ("b", "d", 1.0, "unknown"), ("a", "c", 1.0, "unknown")]
    assert not solvers.is_clear(facts(units, [*both, ("c", "d", 1.01, "unknown")]), "a", "d")
    assert solvers.is_clear(facts(units, [*both, ("c", "d", 3.0, "unknown")]), "a", "d")


def test_places_are_compared_by_their_middles(line):
    assert solvers.height(line, "P", "T") == pytest.approx(2.5)
    assert solvers.above(line, "A", ["P", "G", "R"]) == ["G", "R"]
    assert solvers.nearest(line, "P", "valve") in (["A"], ["C"])
    assert solvers.at_height(line, ["A", "B"]) == 1.0
    assert solvers.at_height(line, ["A", "B"], highest=False) == 0.7
    assert solvers.at_height(line, []) is None


def test_a_round_is_as_short_as_the_best_of_all():
    places = [(str(k), (math.cos(k * k), math.sin(3 * k), 0.0)) for k in range(6)]
    named = dict(places)
    best = min(
        solvers.tour_length([named[name] for name in ("0", *rest)]) for rest in permutations([n for n, _ in places[1:]])
    )
    found = solvers.best_tour(places)
    assert found[0] == "0"
    assert sorted(found) == sorted(named)
    assert solvers.tour_length([named[name] for name in found]) == pytest.approx(best)
    assert solvers.best_tour(places[:1]) is None
