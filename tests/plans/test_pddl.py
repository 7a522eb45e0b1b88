import re

import pytest

from cadgraph.plans import make_round, parse_goals
from cadgraph.plans.pddl import domain_text, plan_text, problem_text
from cadgraph.plans.round import survey
from gallery import gallery
from networks import network, pumping, unit

GRAPH = gallery()
GOALS = "read G-001, G-003, close V-003; close V-002, read G-002; open V-002"


def planned(text=GOALS, graph=GRAPH, start=None):
    goals = parse_goals(text, graph.find)
    known = survey(graph, goals, start)
    return known, make_round(known, goals, start)


def read(text):
    """The lists of a PDDL text."""
    stack = [[]]
    for word in re.findall(r"[()]|[^\s()]+", re.sub(r";[^\n]*", "", text)):
        if word == "(":
            stack.append([])
        elif word == ")":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(word.lower())
    assert len(stack) == 1, "brackets don't match"
    return stack[0]


def section(lists, name):
    return next(one[1:] for one in lists if one[0] == name)


class Planner:
    """Plays actions of a domain through, as PDDL defines them for STRIPS with types and costs."""

    def __init__(self, domain, problem):
        (self.domain,), (self.problem,) = read(domain), read(problem)
        self.types = {"none": "count"}
        listed = list(section(self.problem, ":objects"))
        while listed:
            dash = listed.index("-")
            self.types |= dict.fromkeys(listed[:dash], listed[dash + 1])
            listed = listed[dash + 2 :]
        init = section(self.problem, ":init")
        self.facts = {tuple(fact) for fact in init if fact[0] != "="}
        self.costs = {tuple(fact[1]): int(fact[2]) for fact in init if fact[0] == "="}
        self.actions = {one[1]: one for one in self.domain if one[0] == ":action"}
        self.cost = 0

    def do(self, name, *values):
        action = self.actions[name]
        parameters, kinds, waiting = [], {}, []
        words = action[action.index(":parameters") + 1]
        for i, word in enumerate(words):
            if word == "-":
                kinds |= dict.fromkeys(waiting, words[i + 1])
                waiting = []
            elif word.startswith("?"):
                parameters.append(word)
                waiting.append(word)
        bound = dict(zip(parameters, values, strict=True))
        for parameter, value in bound.items():
            kind = self.types[value]
            assert kinds[parameter] == kind or (kinds[parameter] == "unit" and kind in ("gauge", "valve", "pump"))
        for fact in action[action.index(":precondition") + 1][1:]:
            assert tuple(bound.get(word, word) for word in fact) in self.facts, (name, values, fact)
        added = []
        for effect in action[action.index(":effect") + 1][1:]:
            if effect[0] == "increase":
                self.cost += self.costs[tuple(bound.get(word, word) for word in effect[2])]
            elif effect[0] == "not":
                self.facts.remove(tuple(bound.get(word, word) for word in effect[1]))
            else:
                added.append(tuple(bound.get(word, word) for word in effect))
        self.facts |= set(added)

    def solves(self, plan):
        for action in read(plan):
            self.do(*action)
        return tuple(section(self.problem, ":goal")[0]) in self.facts


@pytest.mark.parametrize("start", [None, "unit-V-001", "unit-G-002"])
def test_a_round_solves_its_problem_and_costs_its_length(start):
    known, made = planned(start=start)
    planner = Planner(domain_text(), problem_text(known, made))
    plan = plan_text(known, made)
    assert planner.solves(plan)
    assert planner.cost == pytest.approx(1000 * made.length, abs=len(made.steps))
    assert f"; cost = {planner.cost}" in plan


def test_a_round_that_stops_a_pump_and_starts_another_solves_its_problem():
    graph = pumping()
    known, made = planned("stop P-001; close V-002, V-005; open V-003; start P-002", graph)
    problem = problem_text(known, made)
    assert "(runs p-001)" in problem
    assert "(is-stopped p-002)" in problem
    assert Planner(domain_text(), problem).solves(plan_text(known, made))


def test_a_plan_that_breaks_the_order_does_not_solve_it():
    known, made = planned()
    lines = [line for line in plan_text(known, made).splitlines() if "read task-1" not in line]
    with pytest.raises(AssertionError):
        Planner(domain_text(), problem_text(known, made)).solves("\n".join(lines))


def test_nothing_is_declared_twice_and_everything_used_is_declared():
    known, made = planned()
    planner = Planner(domain_text(), problem_text(known, made))
    predicates = {one[0] for one in section(planner.domain, ":predicates")}
    used = {fact[0] for fact in planner.facts}
    assert used <= predicates
    objects = section(planner.problem, ":objects")
    names = [word for i, word in enumerate(objects) if word != "-" and (i == 0 or objects[i - 1] != "-")]
    assert len(names) == len(set(names))
    assert {word for fact in planner.facts for word in fact[1:]} <= set(planner.types)


def test_what_is_not_known_is_told_to_who_plans():
    known, made = planned()
    text = problem_text(known, made)
    assert "; ? G-003: where to stand and whether it is within reach is not known" in text
    assert "(out-of-reach v-003)" in text
    assert "(within-reach v-003)" not in text


def test_names_from_a_file_can_not_change_a_problem():
    tags = ["G-1) (ended) (and (", "g 1 ended and", "ü\n(ended)", "none", "9"]
    odd = [unit(f"G-{i}").model_copy(update={"tag": tag, "id": f"unit-{i}"}) for i, tag in enumerate(tags)]
    graph = network(odd, [])
    known, made = planned("read " + ", ".join(one.id for one in odd), graph)
    text = problem_text(known, made)
    assert text.isascii()
    planner = Planner(domain_text(), text)
    assert ("ended",) not in planner.facts
    assert planner.solves(plan_text(known, made))


@pytest.mark.filterwarnings("ignore")
def test_a_reader_of_pddl_takes_all_three_files(tmp_path):
    pytest.importorskip("unified_planning")
    from unified_planning.engines import SequentialPlanValidator, ValidationResultStatus
    from unified_planning.io import PDDLReader

    known, made = planned()
    texts = {"domain": domain_text(), "problem": problem_text(known, made), "plan": plan_text(known, made)}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    reader = PDDLReader()
    problem = reader.parse_problem(str(tmp_path / "domain"), str(tmp_path / "problem"))
    plan = reader.parse_plan(problem, str(tmp_path / "plan"))
    validator = SequentialPlanValidator()
    validator.skip_checks = True
    result = validator.validate(problem, plan)
    assert result.status is ValidationResultStatus.VALID
    assert [float(str(cost)) for cost in result.metric_evaluations.values()] == pytest.approx(
        [1000 * made.length], abs=len(made.steps)
    )
