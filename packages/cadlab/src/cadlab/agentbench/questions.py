"""The types of questions: how they are drawn from what is known of a plant, how they are put, what answers them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from random import Random
from typing import Any, Literal

from cadlab.agentbench import solvers
from cadlab.agentbench.facts import Fact, Facts

__all__ = ["GUIDE", "TYPES", "About", "Form", "Question", "QuestionType", "Value", "draw", "rounded"]

Form = Literal["number", "metres", "set", "list", "unknown"]
Value = float | Sequence[str] | None
"""A number, metres, tags, or None for what can't be told."""
About = Mapping[str, Any]

GUIDE = """\
Answer each question about the plant that it names, from that plant's graph alone. Names are tags, such as V-012.
Forms of an answer: "number": a whole number; "metres": a length or height in metres (right within 2 cm or 1 %,
whichever is more); "set": a JSON list of tags in any order; "list": a JSON list of tags in order; "unknown": as the
question asks.
Answer null where the graph doesn't tell, or where what is asked for isn't possible. A guess counts as wrong.
- The middle of a unit is the middle of its surface; distances and heights are from middle to middle. North is +y.
- Equipment is every unit that is neither a valve nor a gauge: pumps, tanks and others.
- By hand one works up to 2.0 m above the level that one stands on and up to 0.9 m beside it; where no level with a way
  up brings one near enough, answer null. The points of the compass are words such as "north east".
- To isolate a unit, close the nearest valve on every way that something could come by. Check, control and relief valves
  and valves of unknown kind are none that may be closed for that. Relief valves are shut anyway. Where a way leads to a
  tank or to an open end with no valve between, valves don't isolate the unit: answer null.
- Downstream and upstream: only along connections of known direction, and beside them the gauges that hang there.
- A unit is fed where a way leads to it from a source that nowhere goes against a known flow. Sources are tanks, and the
  ends of pipes that are not blind and not known to be outlets; where there is neither, pumps. Closing a valve cuts off
  what was fed and is no more; all other valves are open.
"""
"""What everyone who answers is told."""


@dataclass(frozen=True)
class QuestionType:
    """One type of question.

    Args:
        name: as the table calls it.
        level: 1 for one look, 2 for one walk, 3 for several steps.
        form: of the answer.
        candidates: what it could be asked about, of the units that are in the graph, in a drawn order.
        text: how it is put.
        solve: the answer that follows from facts.
    """

    name: str
    level: int
    form: Form
    candidates: Callable[[Facts, Random], Iterator[About]]
    text: Callable[[About], str]
    solve: Callable[[Facts, About], Value]


@dataclass(frozen=True)
class Question:
    """A question with its answers.

    Args:
        id: unique in its set.
        plant: name of the plant that it is about.
        type: name of its type.
        level: 1 to 3.
        form: of the answer.
        text: as it is put.
        about: what it is about, as the solver takes it.
        answer: what is true.
        graph: what the tools say on the graph.
        places: of a round, where its stops are in truth [m].
        leaks: of an isolation, what the graph's valves leave open in truth, and which of them are none to close.
    """

    id: str
    plant: str
    type: str
    level: int
    form: Form
    text: str
    about: About
    answer: Value
    graph: Value = None
    places: Mapping[str, Sequence[float]] | None = None
    leaks: Sequence[str] | None = None


def draw(facts: Facts, plant: str, seed: int, each: int) -> list[Question]:
    """Questions about a plant with their true answers.

    Args:
        facts: of the truth.
        plant: its name.
        seed: of the choice; the same facts and seed give the same questions.
        each: how many of each type, where there are as many.
    """
    found: list[Question] = []
    for type_ in TYPES:
        choose = Random(f"{seed} {plant} {type_.name}")
        said: set[str] = set()
        for about in type_.candidates(facts, choose):
            text = type_.text(about)
            if len(said) == each:
                break
            if text in said:
                continue
            said.add(text)
            number = f"{plant}/{type_.name}-{len(said)}"
            answer = rounded(type_.solve(facts, about))
            places = _places(facts, about["stops"]) if "stops" in about else None
            found.append(
                Question(
                    number,
                    plant,
                    type_.name,
                    about.get("level", type_.level),
                    type_.form,
                    text,
                    about,
                    answer,
                    places=places,
                )
            )
    return found


def rounded(answer: Value) -> Value:
    """An answer without the noise of sums."""
    return round(answer, 6) if isinstance(answer, float) else answer


def _places(facts: Facts, names: Sequence[str]) -> dict[str, tuple[float, ...]]:
    return {name: tuple(round(c, 6) for c in facts.nodes[facts.id_of(name)].middle or ()) for name in names}


# Who can be asked about


def _passed(facts: Facts) -> list[Fact]:
    """The units that something flows through; a gauge has no place along the flow of its own."""
    return [unit for unit in _piped(facts) if unit.type != "gauge"]


def _shuffled(items: Sequence[Any], choose: Random) -> list[Any]:
    return choose.sample(items, len(items))


def _known(facts: Facts) -> list[Fact]:
    """The units that are in the graph."""
    return [unit for unit in facts.units if not unit.name.startswith("(") and unit.middle is not None]


def _piped(facts: Facts) -> list[Fact]:
    return [unit for unit in _known(facts) if facts.links[unit.id]]


def _counts(facts: Facts, choose: Random) -> Iterator[About]:
    types = sorted({unit.type for unit in facts.units})
    kinds = sorted({(unit.type, unit.kind) for unit in facts.units if unit.kind})
    # One by kind for each by type, as kinds are harder.
    yield from ({"type": type_, "kind": kind} for type_, kind in _shuffled(kinds, choose)[:2])
    yield from ({"type": type_, "kind": ""} for type_ in _shuffled(types, choose))


def _pairs_in_height(facts: Facts, choose: Random) -> Iterator[About]:
    for a, b in _shuffled(list(combinations(_known(facts), 2)), choose):
        if a.middle and b.middle and abs(a.middle[2] - b.middle[2]) > 0.1:
            yield {"a": a.name, "b": b.name}


def _near(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_known(facts), choose):
        for type_ in _shuffled(sorted({other.type for other in facts.units}), choose):
            away = sorted(
                math.dist(unit.middle, other.middle)
                for other in facts.units
                if other.type == type_ and other.middle and other is not unit
            )
            if len(away) > 2 and away[1] > 1.1 * away[0] + 0.05:
                yield {"unit": unit.name, "type": type_}
                break


def _heights_about(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_known(facts), choose):
        clear = [
            other.name for other in _known(facts)
            if other is not unit and other.middle and unit.middle and abs(other.middle[2] - unit.middle[2]) > 0.1
        ]  # fmt: skip
        if len(clear) >= 5:
            yield {"unit": unit.name, "among": sorted(choose.sample(clear, 5))}


def _isolations(facts: Facts, choose: Random) -> Iterator[About]:
    equipment = [unit for unit in _piped(facts) if unit.is_equipment]
    others = [unit for unit in _piped(facts) if not unit.is_equipment]
    # Equipment first, of which there is less: that is what people open.
    asked = [unit.name for unit in (*_shuffled(equipment, choose)[:2], *_shuffled(others, choose))]
    answers = {name: solvers.isolate(facts, name) for name in asked}
    usual = [name for name in asked if answers[name]]
    # Few that need no valve or can't be isolated: whoever always answers null is not to be right often.
    odd = [name for name in asked if answers[name] is None][:1] + [name for name in asked if answers[name] == []][:1]
    yield from ({"unit": name} for name in (*usual[:2], *odd[:1], *usual[2:], *odd[1:]))


def _ways(facts: Facts, choose: Random) -> Iterator[tuple[str, str]]:
    units = _passed(facts)
    for a, b in _shuffled([(a.name, b.name) for a in units for b in units if a is not b], choose):
        if solvers.is_clear(facts, a, b):
            yield a, b


def _lengths(facts: Facts, choose: Random) -> Iterator[About]:
    yield from ({"a": a, "b": b} for a, b in _ways(facts, choose))


def _orders(facts: Facts, choose: Random) -> Iterator[About]:
    for a, b in _ways(facts, choose):
        if len(solvers.order(facts, a, b) or ()) >= 4:
            yield {"a": a, "b": b}


def _flows(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_passed(facts), choose):
        for type_ in _shuffled(["valve", "gauge", "pump", "tank"], choose):
            if solvers.halts(facts, unit.name):
                break
            if 0 < len(solvers.downstream(facts, unit.name, type_)) <= 12:
                yield {"unit": unit.name, "type": type_}
                break


def _feeds(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_passed(facts), choose):
        if not solvers.halts(facts, unit.name, against=True) and solvers.fed_by(facts, unit.name):
            yield {"unit": unit.name}


def _systems(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_piped(facts), choose):
        yield {"unit": unit.name, "type": choose.choice(("valve", "gauge"))}


def _closable(facts: Facts) -> list[str]:
    return [u.name for u in _piped(facts) if u.shuts and solvers.is_fed_throughout(facts, u.name)]


def _closings(facts: Facts, choose: Random) -> Iterator[About]:
    for valve in _shuffled(_closable(facts), choose):
        if 0 < len(solvers.cut_off(facts, [valve])) <= 12:
            yield {"close": [valve]}


def _double_closings(facts: Facts, choose: Random) -> Iterator[About]:
    alone = {valve: set(solvers.cut_off(facts, [valve])) for valve in _closable(facts)}
    pairs = _shuffled(sorted(combinations(alone, 2)), choose)
    # Two that cut off more together than each for itself are worth most.
    for better in (True, False):
        for a, b in pairs:
            both = set(solvers.cut_off(facts, [a, b]))
            if 0 < len(both) <= 12 and (both > alone[a] | alone[b]) == better:
                yield {"close": [a, b]}


def _isolation_heights(facts: Facts, choose: Random) -> Iterator[About]:
    for about in _isolations(facts, choose):
        if len(solvers.isolate(facts, about["unit"]) or ()) >= 2:
            yield {**about, "highest": choose.random() < 0.5}


def _closing_heights(facts: Facts, choose: Random) -> Iterator[About]:
    for about in _closings(facts, choose):
        if len(solvers.cut_off(facts, about["close"])) >= 2:
            yield {**about, "highest": choose.random() < 0.5}


def _rounds(facts: Facts, choose: Random) -> Iterator[About]:
    gauges = [unit.name for unit in _known(facts) if unit.type == "gauge"]
    stops = min(6, len(gauges))
    for _ in range(8 if stops >= 4 else 0):
        yield {"stops": choose.sample(gauges, stops)}


def _operators(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_known(facts), choose):
        if unit.type == "valve" and facts.reach_of(unit.name).height is not None:
            yield {"unit": unit.name}


def _faces(facts: Facts, choose: Random) -> Iterator[About]:
    for unit in _shuffled(_known(facts), choose):
        if unit.type == "gauge" and facts.reach_of(unit.name).facing is not None:
            yield {"unit": unit.name}


def _climbs(facts: Facts, choose: Random) -> Iterator[About]:
    clear = [
        unit.name for unit in _known(facts) if unit.type == "valve" and facts.reach_of(unit.name).level is not None
    ]
    served = [name for name in _shuffled(clear, choose) if solvers.level(facts, name) is not None]
    yield from ({"unit": name} for name in served)
    # Beside those one that no level serves, but none where that would be all.
    yield from ({"unit": name} for name in [name for name in clear if served and name not in served][:1])


_NOT_KNOWN = (
    (1, "Is {valve} open or closed at the moment?"),
    (1, "Which pressure does {gauge} show right now, in bar?"),
    (1, "Which fluid flows through {valve}?"),
    (2, "How much flows through {valve}, in cubic metres an hour?"),
    (2, "Who inspected {gauge} last?"),
    (2, "What does {valve} weigh, in kilograms?"),
    (1, "At what height, in metres, is the middle of X-9{number}?"),
    (2, "Which valves must be closed to isolate P-9{number}?"),
    (3, "If {valve} is closed and it takes ten minutes, which pressure is there before it then, in bar?"),
    (3, "Which of the valves that isolate {valve} leaks?"),
)


def _unknowns(facts: Facts, choose: Random) -> Iterator[About]:
    valves = [unit.name for unit in _known(facts) if unit.type == "valve"]
    gauges = [unit.name for unit in _known(facts) if unit.type == "gauge"]
    for level, text in _shuffled(list(_NOT_KNOWN), choose):
        number = choose.randrange(10, 100)
        if ("{valve}" in text and not valves) or ("{gauge}" in text and not gauges):
            continue
        valve, gauge = (choose.choice(names) if names else "" for names in (valves, gauges))
        yield {"asked": text.format(valve=valve, gauge=gauge, number=number), "level": level}


# How it is put


def _count_text(about: About) -> str:
    what = f"units of kind {about['kind']!r}" if about["kind"] else f"units of type {about['type']!r}"
    return f"How many {what} are there?"


def _isolate_text(about: About) -> str:
    return f"Which valves must be closed to isolate {about['unit']}?"


def _closing_text(about: About) -> str:
    names = about["close"]
    subject = f"{names[0]} is closed" if len(names) == 1 else f"{' and '.join(names)} are both closed"
    return f"If {subject}, which gauges and which equipment are cut off from every source?"


def _end(about: About) -> str:
    return "highest" if about["highest"] else "lowest"


TYPES: tuple[QuestionType, ...] = (
    QuestionType("count", 1, "number", _counts, _count_text, lambda f, q: solvers.count(f, **q)),
    QuestionType(
        "nearest", 1, "set", _near,
        lambda q: f"Which {q['type']} is nearest to {q['unit']}, straight through the air and not counting itself?",
        lambda f, q: solvers.nearest(f, **q),
    ),
    QuestionType(
        "height", 1, "metres", _pairs_in_height,
        lambda q: f"How much higher is {q['b']} than {q['a']}? Below 0 where it is lower.",
        lambda f, q: solvers.height(f, **q),
    ),
    QuestionType(
        "above", 1, "set", _heights_about,
        lambda q: f"Which of {', '.join(q['among'])} lie higher than {q['unit']}?",
        lambda f, q: solvers.above(f, **q),
    ),
    QuestionType(
        "handle", 1, "metres", _operators,
        lambda q: f"How high above the ground is the middle of the handwheel or lever of {q['unit']}?",
        lambda f, q: solvers.operator_height(f, **q),
    ),
    QuestionType(
        "facing", 1, "set", _faces,
        lambda q: f"Towards which of the eight points of the compass does the face of {q['unit']} look?",
        lambda f, q: solvers.facing(f, **q),
    ),
    QuestionType("isolate", 2, "set", _isolations, _isolate_text, lambda f, q: solvers.isolate(f, **q)),
    QuestionType(
        "length", 2, "metres", _lengths,
        lambda q: f"How long is the shortest way along the pipes from {q['a']} to {q['b']}?",
        lambda f, q: solvers.length(f, **q),
    ),
    QuestionType(
        "order", 2, "list", _orders,
        lambda q: f"In which order does one come by valves and equipment on the shortest way along the pipes from "
        f"{q['a']} to {q['b']}, both included?",
        lambda f, q: solvers.order(f, **q),
    ),
    QuestionType(
        "downstream", 2, "set", _flows,
        lambda q: f"Which {q['type']}s lie downstream of {q['unit']}?",
        lambda f, q: solvers.downstream(f, **q),
    ),
    QuestionType(
        "fed by", 2, "set", _feeds,
        lambda q: f"Which equipment lies upstream of {q['unit']}?",
        lambda f, q: solvers.fed_by(f, **q),
    ),
    QuestionType(
        "system", 2, "number", _systems,
        lambda q: f"How many {q['type']}s hang together with {q['unit']} by pipes, itself included if it is one?",
        lambda f, q: solvers.system(f, **q),
    ),
    QuestionType("what if", 2, "set", _closings, _closing_text, lambda f, q: solvers.cut_off(f, q["close"])),
    QuestionType("two closed", 3, "set", _double_closings, _closing_text, lambda f, q: solvers.cut_off(f, q["close"])),
    QuestionType(
        "isolate, height", 3, "metres", _isolation_heights,
        lambda q: f"Of the valves that must be closed to isolate {q['unit']}, how high (z) is the {_end(q)}?",
        lambda f, q: solvers.at_height(f, solvers.isolate(f, q["unit"]) or (), q["highest"]),
    ),
    QuestionType(
        "what if, height", 3, "metres", _closing_heights,
        lambda q: f"If {q['close'][0]} is closed, how high (z) is the {_end(q)} of the gauges and equipment that are "
        "cut off from every source?",
        lambda f, q: solvers.at_height(f, solvers.cut_off(f, q["close"]), q["highest"]),
    ),
    QuestionType(
        "climb", 3, "metres", _climbs,
        lambda q: f"How high above the ground is the level that one must climb to, to work at {q['unit']} by hand?",
        lambda f, q: solvers.level(f, **q),
    ),
    QuestionType(
        "round", 3, "list", _rounds,
        lambda q: f"In which order does one visit {', '.join(q['stops'])}, from {q['stops'][0]} and back to it, so "
        "that the straight ways in plan are together at most 5 % longer than the shortest round? Name each once.",
        lambda f, q: solvers.tour(f, q["stops"]),
    ),
    QuestionType("unanswerable", 1, "unknown", _unknowns, lambda q: str(q["asked"]), lambda f, q: None),
)  # fmt: skip
"""All types, in the order of the table."""
