import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.model.truth import Truth
from cadlab.evaluate import evaluate
from cadlab.evaluate.labels import UNLABELLED, Observation, calibrate, score_labels
from lab.evaluate.plants import GAUGE, PIPE, VALVE, agreeing, changed, line, relabelled

WORDS = st.sampled_from(["a", "b", "c"])
SEEN = st.builds(
    Observation,
    structure=st.none(),
    true_group=WORDS,
    true_name=st.none() | WORDS,
    group=WORDS,
    name=st.none() | WORDS,
    confidence=st.none() | st.floats(0, 1),
) | st.builds(
    Observation,
    structure=st.none(),
    true_group=WORDS,
    true_name=st.none() | WORDS,
    group=st.none(),
    name=st.none(),
    confidence=st.none(),
)


def seen(true, given, confidence=None):
    """``"a x"`` is name x in group a; ``"a"`` leaves the name open."""
    true_group, _, true_name = true.partition(" ")
    group, _, name = (given or "").partition(" ")
    return Observation(None, true_group, true_name or None, group or None, name or None, confidence)


def test_a_case_worked_by_hand():
    scores = score_labels(
        "part",
        [seen("a x", "a x"), seen("a x", "a y"), seen("a y", "b x"), seen("b x", "b x"), seen("b x", None)],
    )
    assert (scores.n, scores.n_unlabelled, scores.unlabelled) == (5, 1, 0.2)
    assert (scores.group.n, scores.group.n_correct, scores.group.n_labelled) == (5, 3, 4)
    assert scores.group.accuracy == 0.6
    assert scores.group.accuracy_labelled == 0.75
    a, b = scores.group.classes
    assert (a.label, a.n_true, a.n_predicted, a.n_correct) == ("a", 3, 2, 2)
    assert (a.precision, a.recall, a.f1) == (1.0, 2 / 3, 0.8)
    assert (b.precision, b.recall, b.f1) == (0.5, 0.5, 0.5)
    assert scores.group.macro_f1 == pytest.approx(0.65)
    assert scores.group.confusion.labels == ("a", "b")
    assert scores.group.confusion.columns == ("a", "b", UNLABELLED)
    assert scores.group.confusion.counts == ((2, 1, 0), (0, 1, 1))
    assert scores.name.confusion.labels == ("a / x", "a / y", "b / x")
    assert scores.name.confusion.counts == ((1, 1, 0, 0), (0, 0, 1, 0), (0, 0, 1, 1))
    assert scores.name.accuracy == 0.4
    assert scores.name.macro_f1 == pytest.approx((2 / 3 + 0 + 0.5) / 3)


def test_the_same_name_in_another_group_is_wrong():
    assert score_labels("part", [seen("a x", "b x")]).name.accuracy == 0.0


def test_a_group_without_name_leaves_the_name_unlabelled():
    scores = score_labels("part", [seen("a x", "a")])
    assert scores.group.accuracy == 1.0
    assert (scores.name.accuracy, scores.name.n_labelled, scores.n_unlabelled) == (0.0, 0, 0)


def test_an_open_true_name_is_not_evaluated():
    scores = score_labels("part", [seen("a", "a x"), seen("a x", "a x")])
    assert (scores.group.n, scores.name.n, scores.name.accuracy) == (2, 1, 1.0)


def test_a_class_that_was_only_predicted_counts_for_the_macro_mean():
    assert score_labels("part", [seen("a", "a"), seen("a", "b")]).group.macro_f1 == pytest.approx((2 / 3 + 0) / 2)


def test_nothing_gives_none_not_zero():
    scores = score_labels("part", [])
    assert (scores.unlabelled, scores.group.accuracy, scores.group.macro_f1) == (None, None, None)
    assert (calibrate("group", []).ece, calibrate("group", []).mce) == (None, None)


@given(st.lists(SEEN))
def test_shares_lie_between_none_and_all(observations):
    scores = score_labels("part", observations)
    for task in (scores.group, scores.name):
        values = [task.accuracy, task.accuracy_labelled, task.macro_f1, scores.unlabelled]
        values += [value for c in task.classes for value in (c.precision, c.recall, c.f1)]
        assert all(value is None or 0 <= value <= 1 for value in values)
        assert sum(map(sum, task.confusion.counts)) == task.n
        assert [sum(row) for row in task.confusion.counts] == [c.n_true for c in task.classes]
        assert task.n_correct <= min(task.n, task.n_labelled)
    assert (scores.name.n_correct or 0) <= scores.group.n_correct


@given(st.lists(SEEN), st.randoms())
def test_order_does_not_matter(observations, rng):
    mixed = list(observations)
    rng.shuffle(mixed)
    assert score_labels("part", mixed) == score_labels("part", observations)


# Calibration


def test_calibration_worked_by_hand():
    sure, unsure = [seen("a", "a", 0.95), seen("a", "a", 0.91)], [seen("a", "b", 0.55), seen("a", "a", 0.6)]
    found = calibrate("group", [*sure, *unsure, seen("a", None)])
    assert [b.n for b in found.bins] == [0, 0, 0, 0, 0, 2, 0, 0, 0, 2]
    assert found.bins[5].accuracy == 0.5
    assert found.bins[5].confidence == pytest.approx(0.575)
    assert found.bins[0].accuracy is None
    assert found.ece == pytest.approx((2 * 0.075 + 2 * 0.07) / 4)
    assert found.mce == pytest.approx(0.075)


def test_names_are_calibrated_by_names():
    observations = [seen("a x", "a y", 1.0), seen("a", "a x", 1.0), seen("a x", "a", 1.0)]
    assert calibrate("group", observations).ece == 0.0
    assert calibrate("name", observations).ece == 1.0
    assert sum(b.n for b in calibrate("name", observations).bins) == 1


@pytest.mark.parametrize(("confidence", "place"), [(0.0, 0), (0.1, 0), (0.1001, 1), (0.3, 2), (0.7, 6), (1.0, 9)])
def test_a_bin_holds_its_upper_bound(confidence, place):
    found = calibrate("group", [seen("a", "a", confidence)])
    assert [b.n for b in found.bins].index(1) == place


@given(st.lists(SEEN))
def test_calibration_errors_are_shares(observations):
    for task in ("group", "name"):
        found = calibrate(task, observations)
        assert found.ece is None or 0 <= found.ece <= found.mce + 1e-12 <= 1 + 1e-9
        assert all(b.n == 0 or b.low - 1e-9 <= b.confidence <= b.high + 1e-9 for b in found.bins)


# On graphs


def test_mesh_and_part_are_counted_apart():
    truth = line()
    graph = changed(
        relabelled(agreeing(truth), {"/v1": (PIPE, "flange", 0.8)}),
        # The wheel belongs to the part of the body, which is the larger.
        lambda node: (
            None
            if getattr(node, "id", "") == "part-v1w"
            else node.model_copy(update={"meshes": ("/v1", "/v1w")})
            if node.id == "part-v1"
            else node.model_copy(update={"parts": ("part-v1",)})
            if node.id == "node-V1"
            else node
        ),
        lambda edge: None if "part-v1w" in (edge.source, edge.target) else edge,
    )
    total = evaluate(graph, truth).total
    assert (total.meshes.n, total.meshes.group.n_correct) == (11, 9)
    assert (total.parts.n, total.parts.group.n_correct) == (10, 9)


def test_a_parts_truth_is_that_of_its_largest_labelled_mesh():
    truth = Truth.from_json(
        {
            "format": "cadgraph-truth",
            "version": 1,
            "meshes": [{"mesh": "/a"}, {"mesh": "/b", "group": GAUGE, "name": "gauge"}, {"mesh": "/c", "group": VALVE}],
        }
    )
    import graphs

    graph = graphs.graph([graphs.part(0, "/z", "/a", "/b", "/c", label=graphs.label(GAUGE, "gauge"))])
    total = evaluate(graph, truth).total
    assert (total.parts.n, total.parts.name.accuracy) == (1, 1.0)
    assert (total.meshes.n, total.meshes.group.accuracy) == (2, 0.5)


def test_the_ground_without_a_label_counts_as_ground():
    truth = line()
    assert evaluate(agreeing(truth), truth).total.parts.name.accuracy == 1.0
    flat = changed(agreeing(truth), lambda n: n.model_copy(update={"ground": False}) if n.id == "part-floor" else n)
    assert evaluate(flat, truth).total.parts.n_unlabelled == 1


def test_lost_meshes_are_unlabelled_but_duplicates_and_hidden_ones_may_go():
    data = line().to_json()
    truth = Truth.from_json(data)

    def without(graph):
        return changed(
            graph,
            lambda node: None if node.id == "part-p0" else node,
            lambda edge: None if "part-p0" in (edge.source, edge.target) else edge,
        )

    found = evaluate(without(agreeing(truth)), truth)
    assert (found.n_lost, found.total.meshes.n_unlabelled, found.total.meshes.n) == (1, 1, 11)
    for flag in ({"hidden": ["/p0"]}, {"duplicates": [["/p1", "/p0"]]}, {"duplicates": [["/p0", "/p1"]]}):
        flagged = Truth.from_json(data | flag)
        found = evaluate(without(agreeing(flagged)), flagged)
        assert (found.n_lost, found.total.meshes.n_unlabelled, found.total.meshes.n) == (0, 0, 10)
        assert evaluate(agreeing(flagged), flagged).total.meshes.n == 11
