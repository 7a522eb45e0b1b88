import dataclasses

import pytest

import cadgraph
import shapes
from cadgraph.errors import FormatError
from cadgraph.hydraulics.balance import default_scenario
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Access, Mechanism, Unit
from cadgraph.model.scene import Scene
from cadgraph.simulate.tasks.checking import begin, changed_gauges, check
from cadgraph.simulate.tasks.choosing import make_tasks
from cadgraph.simulate.tasks.records import TaskList
from networks import pumping


def at_hand(unit):
    """A unit with a wheel or a face, and a place to stand before it."""
    x, y, z = unit.centroid
    access = Access(
        place="place-001", stand=(x, y - 0.5, 0.0), height=z, reach="floor", facing=(0.0, -1.0, 0.0),
        facing_confidence=1.0, viewpoint=(x, y - 0.8, 1.5) if unit.unit_type == "gauge" else None,
    )  # fmt: skip
    more = {"access": access}
    if unit.unit_type == "valve" and unit.kind not in ("check valve", "relief valve"):
        more["mechanism"] = Mechanism(
            kind="handwheel", meshes=(f"/wheel of {unit.tag}",), axis=(0.0, 0.0, 1.0), pivot=(x, y, z + 0.3),
            radius=0.1, limits=(-3600.0, 0.0), open=0.0, shut=-3600.0,
        )  # fmt: skip
    return unit.model_copy(update=more)


def plant(change=lambda unit: unit):
    nodes = [change(at_hand(node)) if isinstance(node, Unit) else node for node in pumping().nodes.values()]
    graph = SceneGraph(pumping().document.model_copy(update={"nodes": tuple(nodes)}))
    wheels = [unit for unit in graph.units() if unit.mechanism]
    meshes = [shapes.moved(shapes.tube(0.11, 0.09, 0.02), translation=unit.mechanism.pivot) for unit in wheels]
    return graph, Scene.from_meshes(meshes, [unit.mechanism.meshes[0] for unit in wheels])


@pytest.fixture(scope="module")
def known():
    graph, scene = plant()
    scenario = default_scenario(graph)
    return graph, scenario, make_tasks(graph, scene, scenario, seed=7, n=40)


def task_of(known, text):
    return next(task for task in known[2].tasks if task.text.startswith(text))


def played(known, task, moves=None):
    process = begin(task, *known[:2])
    return [process.state, process.steady(task.solution.set if moves is None else moves)]


def test_every_task_is_done_by_its_own_solution_and_by_nothing_less(known):
    assert len(known[2].tasks) == 40
    for task in known[2].tasks:
        history = played(known, task)
        assert (
            check(task, history, task.solution.answer) == (True, ()) or check(task, history, task.solution.answer).done
        )
        if task.solution.set:
            assert not check(task, history[:1], task.solution.answer).done


def test_all_kinds_of_tasks_are_there_each_with_where_to_stand_and_how_to_get_there(known):
    assert {task.kind for task in known[2].tasks} == {"read", "close", "open", "isolate"}
    for task in known[2].tasks:
        assert task.stops
        for stop in task.stops:
            assert stop.stand is not None
            assert stop.viewpoint if stop.does == "read" else stop.ring and stop.hand
    assert len({task.id for task in known[2].tasks}) == 40


def test_the_same_seed_gives_the_same_bytes_and_another_seed_others(known, tmp_path):
    graph, scene = plant()
    again = make_tasks(graph, scene, default_scenario(graph), seed=7, n=40)
    assert again.write(tmp_path / "a").read_bytes() == known[2].write(tmp_path / "b").read_bytes()
    assert TaskList.read(tmp_path / "a") == known[2]
    other = make_tasks(graph, scene, default_scenario(graph), seed=8, n=40)
    assert [task.text for task in other.tasks] != [task.text for task in known[2].tasks]


def test_a_reading_counts_within_its_tolerance_and_only_while_the_gauge_shows_it(known):
    task = task_of(known, "read G-003")
    history = played(known, task)
    shown = history[-1].reading["G-003"]
    assert check(task, history, shown + 0.9 * task.goal.tolerance).done
    assert not check(task, history, shown + 1.1 * task.goal.tolerance).done
    for nothing in (None, True, float("nan"), "3.2", ("G-003",)):
        assert check(task, history, nothing).reasons == ("no reading of G-003 was told; give a number",)
    blind = [dataclasses.replace(state, reading={**state.reading, "G-003": None}) for state in history]
    assert check(task, blind, shown).reasons == ("what G-003 shows, nobody knows",)


def test_who_only_reads_moves_nothing(known):
    task = task_of(known, "read G-003")
    history = played(known, task, {"V-010": 0.0})
    [reason] = check(task, history, history[-1].reading["G-003"]).reasons
    assert reason == "V-010 was moved as well: from 1 to 0"


def test_a_valve_counts_as_closed_once_the_state_says_so(known):
    task = next(task for task in known[2].tasks if task.kind == "close" and task.solution.answer)
    process = begin(task, *known[:2])
    history = [process.state, process.step({task.tag: 0.0}, dt=1 / 60)]
    reasons = check(task, history, task.solution.answer).reasons
    assert any(reason.startswith(f"{task.tag} is ") and reason.endswith(" open, not 0") for reason in reasons)
    while process.state.opening[task.tag] > 0:
        history.append(process.step(dt=1.0))
    history.append(process.step(dt=5.0))
    # Levels have moved meanwhile: what counts is what the gauges do, not what they would have done at once.
    assert check(task, history, changed_gauges(task, history[0], history[-1])).done


def test_gauges_that_are_missed_or_made_up_are_named(known):
    task = next(task for task in known[2].tasks if task.kind == "close" and len(task.solution.answer) > 1)
    history, answer = played(known, task), list(task.solution.answer)
    assert check(task, history, answer[1:]).reasons == (f"{answer[0]} falls and was not told",)
    assert check(task, history, [*answer, "G-999"]).reasons == ("G-999 was told, but does not fall",)
    assert "give their tags" in check(task, history).reasons[0]


def test_isolating_needs_every_valve_and_a_pump_that_stands(known):
    task = task_of(known, "isolate P-001")
    assert check(task, played(known, task)).done
    valves = [tag for tag in task.solution.set if tag != "P-001"]
    for left in valves:
        found = check(task, played(known, task, {**task.solution.set, left: 1.0}))
        assert any("a known pressure still reaches" in reason for reason in found.reasons)
    running = check(task, played(known, task, dict.fromkeys(valves, 0.0)))
    assert "P-001 still runs" in running.reasons


def test_another_way_to_isolate_a_unit_counts_too(known):
    task = task_of(known, "isolate P-001")
    wider = {"V-001": 0.0, "V-003": 0.0, "V-005": 0.0, "V-002": 0.0, "P-001": 0.0}
    assert check(task, played(known, task, wider)).done


def test_states_of_another_start_or_in_another_order_count_for_nothing(known):
    task = task_of(known, "isolate P-001")
    history = played(known, task)
    assert not check(task, []).done
    assert "not the start" in check(task, history[1:]).reasons[0]
    late = dataclasses.replace(history[0], time=5.0)
    assert "order of time" in check(task, [late, history[1]]).reasons[0]


def test_what_can_not_be_done_is_said_with_its_reasons():
    def change(unit):
        if unit.tag == "V-002":
            return unit.model_copy(update={"mechanism": None})
        if unit.tag == "V-007":
            return unit.model_copy(
                update={
                    "access": unit.access.model_copy(update={"reach": "out of reach", "stand": None, "height": 3.1})
                }
            )
        if unit.tag == "G-003":
            return unit.model_copy(update={"access": unit.access.model_copy(update={"viewpoint": None})})
        return unit.model_copy(update={"access": None}) if unit.tag == "G-004" else unit

    graph, scene = plant(change)
    made = make_tasks(graph, scene, default_scenario(graph), n=20)
    told = {one.text: "; ".join(one.reasons) for one in made.left_out}
    assert "its wheel or lever was not found" in told["close V-002 and see which gauges fall"]
    assert told["close V-007 and see which gauges fall"] == "V-007: 3.1 m above the ground, out of reach"
    assert "from which its face is seen" in told["read G-003"]
    assert "without places" in told["read G-004"]
    assert "V-002" in told["isolate P-001"]
    named = {stop.tag for task in made.tasks for stop in task.stops}
    assert not named & {"V-002", "V-007", "G-003", "G-004"}


def test_a_start_is_that_of_the_task_whatever_was_done_before(known):
    task = next(task for task in known[2].tasks if set(task.start.opening.values()) - {1.0})
    process = begin(task, *known[:2])
    assert {tag: process.state.opening[tag] for tag in task.start.opening} == task.start.opening
    assert process.state.speed == task.start.speed


def test_damaged_files_are_refused_in_one_line(tmp_path):
    file = tmp_path / "tasks.json"
    for text, where in (("{", "the file"), ('{"seed": "x"}', "seed")):
        file.write_text(text)
        with pytest.raises(FormatError, match=where):
            TaskList.read(file)


def test_no_task_is_no_number_of_tasks():
    graph, scene = plant()
    with pytest.raises(ValueError, match="n=0"):
        make_tasks(graph, scene, default_scenario(graph), n=0)
    assert cadgraph.Process(graph).state.reading
