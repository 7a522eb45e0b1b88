import warnings

import numpy as np
import pytest

from cadgraph.model.graph import SceneGraph
from networks import chain, network, pumping, terminal, unit

gymnasium = pytest.importorskip("gymnasium")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from cadgraph.gym import Isolate, KeepLevel, PlantEnv, PlantVectorEnv, ReachReading  # noqa: E402


def tanked():
    tank = unit("T-001", ports=("N1", "N2"), at=(0.0, 0.0, 2.0))
    nodes = [terminal(1, at=(0.0, 0.0, 8.0)), unit("V-001", "gate valve"), tank, unit("V-002", "gate valve")]
    return network([*nodes, terminal(2)], chain("X1 V-001 T-001.N1") + chain("T-001.N2 V-002 X2"))


def action(env, **values):
    moved = env.reset(seed=0)[1]["moved"]
    asked = np.ones(len(moved), np.float32)
    for tag, value in values.items():
        asked[moved.index(tag.replace("_", "-"))] = value
    return asked


@pytest.mark.parametrize(
    ("graph", "task"), [(pumping(), None), (pumping(), ReachReading("G-003", 1.0)), (tanked(), KeepLevel("T-001"))]
)
def test_gymnasium_finds_nothing_to_object_to(graph, task):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made = gymnasium.make("cadgraph/Plant-v0", graph=graph, task=task)
        check_env(made.unwrapped)


def until_it_ends(env, asked, most=200):
    """The rewards of doing the same over and over, and how it ended."""
    rewards = []
    for _ in range(most):
        _, reward, ended, cut, info = env.step(asked)
        rewards.append(reward)
        if ended or cut:
            break
    return rewards, ended, info["success"]


def test_a_reading_that_is_reached_ends_the_episode():
    env = PlantEnv(pumping(), task=ReachReading("G-003", 0.1), dt=0.1, seconds=60, shuffle=False)
    rewards, ended, success = until_it_ends(env, action(env, P_001=0, P_002=0))
    assert (rewards[-1], ended, success) == (1.0, True, True)
    assert rewards[0] < rewards[-2] < 0


def test_a_pump_is_isolated_once_it_stands_still_and_nothing_reaches_it():
    # The tank is small: it is down to its nozzles after 0.1 s, and nothing reaches a pump beside an empty tank.
    env = PlantEnv(pumping(), task=Isolate("P-001"), dt=0.01, seconds=1200, shuffle=False)
    _, running, done, _, _ = env.step(action(env))
    assert not done
    _, stopped, done, _, _ = env.step(action(env, P_001=0))
    assert not done
    assert stopped > running
    env = PlantEnv(pumping(), task=Isolate("P-001"), dt=120.0, seconds=1200, shuffle=False)
    shut = dict.fromkeys(env.reset()[1]["moved"], 0)
    _, reward, done, _, _ = env.step(action(env, **shut))
    assert done
    assert reward > 0.5


def test_a_task_may_be_given_to_several_plants():
    task = ReachReading("G-003", 0.1)
    first = PlantEnv(pumping(), task=task, dt=0.01, seconds=60, shuffle=False)
    asked = action(first)
    alone = first.step(asked)[1]
    PlantEnv(tanked(), task=KeepLevel("T-001"))
    other = pumping()
    nodes = [node for node in other.document.nodes if getattr(node, "tag", "") != "G-001"]
    edges = [edge for edge in other.document.edges if "unit-G-001" not in (edge.source, getattr(edge, "target", ""))]
    PlantEnv(SceneGraph(other.document.model_copy(update={"nodes": tuple(nodes), "edges": tuple(edges)})), task=task)
    assert first.step(action(first))[1] == alone
    with pytest.raises(ValueError, match="give a Task"):
        PlantEnv(pumping(), task="isolate P-001")


def test_a_tank_that_runs_over_has_failed():
    env = PlantEnv(tanked(), task=KeepLevel("T-001"), dt=0.005, seconds=60.0, shuffle=False)
    rewards, ended, success = until_it_ends(env, action(env, V_002=0))
    assert (rewards[-1], ended, success) == (-1.0, True, False)
    assert rewards[0] > rewards[-2] > 0


def test_a_tank_that_is_down_to_its_outlet_has_failed():
    env = PlantEnv(tanked(), task=KeepLevel("T-001"), dt=0.005, seconds=60.0, shuffle=False)
    outlet = next(n.height for n in env.process.balance.circuit.nozzles if n.port == "N2")
    above = outlet - env.process.scenario.tanks["T-001"].bottom
    rewards, ended, success = until_it_ends(env, action(env, V_001=0))
    assert (rewards[-1], ended, success) == (-1.0, True, False)
    assert above > 0
    with pytest.raises(ValueError, match="can't be kept"):
        PlantEnv(tanked(), task=KeepLevel("T-001", above / 2))


def test_an_episode_is_cut_off_when_time_is_up():
    env = PlantEnv(pumping(), dt=1.0, seconds=3.0)
    asked = action(env)
    assert [env.step(asked)[3] for _ in range(3)] == [False, False, True]


@pytest.mark.parametrize(
    ("task", "said"),
    [
        (ReachReading("G-999", 1.0), "G-999"),
        (ReachReading("V-001", 1.0), "no gauge"),
        (ReachReading("G-003", 1e6), "can't show"),
        (KeepLevel("P-001"), "no tank"),
    ],
)
def test_a_task_that_speaks_of_what_is_not_there_is_refused(task, said):
    with pytest.raises(ValueError, match=said):
        PlantEnv(pumping(), task=task)


@pytest.mark.parametrize(("dt", "seconds"), [(0.0, 1.0), (2.0, 1.0), (float("nan"), 1.0), (4000.0, 9000.0)])
def test_a_step_that_can_not_be_is_refused(dt, seconds):
    for kind in (PlantEnv, lambda *given, **more: PlantVectorEnv(2, *given, **more)):
        with pytest.raises(ValueError, match="dt"):
            kind(pumping(), dt=dt, seconds=seconds)


def test_an_action_of_another_length_is_refused():
    env = PlantEnv(pumping())
    env.reset(seed=1)
    with pytest.raises(ValueError, match=r"an action has the shape \(\d+,\)"):
        env.step(np.ones(1, np.float32))


def test_many_plants_do_as_one_does():
    options = {"task": ReachReading("G-003", 1.0), "shuffle": False, "dt": 2.0, "seconds": 10.0}
    one, many = PlantEnv(pumping(), **options), PlantVectorEnv(3, pumping(), **options)
    assert np.array_equal(many.reset(seed=1)[0], np.tile(one.reset(seed=1)[0], (3, 1)))
    one.action_space.seed(5)
    for _ in range(5):
        asked = one.action_space.sample()
        seen, reward, done, cut, _ = one.step(asked)
        all_seen, rewards, all_done, all_cut, _ = many.step(np.tile(asked, (3, 1)))
        assert all_seen == pytest.approx(np.tile(seen, (3, 1)), abs=1e-6)
        assert rewards == pytest.approx(np.full(3, reward), abs=1e-6)
        assert (all_done.tolist(), all_cut.tolist()) == ([done] * 3, [cut] * 3)
        if done or cut:
            break


def test_many_plants_name_what_is_seen_and_moved_as_one_does():
    from gymnasium.wrappers.vector import DictInfoToList

    one, many = PlantEnv(tanked()), PlantVectorEnv(2, tanked())
    told = one.reset(seed=1)[1]
    assert told["observed"][-1] == "T-001"
    for info in DictInfoToList(many).reset(seed=1)[1]:
        assert (info["observed"], info["moved"]) == (told["observed"], told["moved"])


def test_what_has_ended_begins_anew_at_the_next_step():
    many = gymnasium.make_vec(
        "cadgraph/Plant-v0", num_envs=2, vectorization_mode="vector_entry_point", graph=pumping(), dt=1.0, seconds=2.0
    )
    first, _ = many.reset(seed=3)
    assert first in many.observation_space
    asked = np.zeros(many.action_space.shape, np.float32)
    cuts = [many.step(asked)[3].tolist() for _ in range(4)]
    assert cuts == [[False, False], [True, True], [False, False], [False, False]]
    again, _ = many.reset(seed=3)
    assert np.array_equal(first, again)
