import pytest
from hypothesis import given
from hypothesis import strategies as st

import graphs
from cadgraph.model.records import Adjacent, Contains
from cadgraph.model.truth import Truth
from cadlab.evaluate import evaluate
from cadlab.evaluate.clusters import adjusted_rand_index, score_clusters
from lab.evaluate.plants import agreeing, changed, line, made_of


def test_rand_index_worked_by_hand():
    # Pairs together in both 1, in rows 1 + 1, in columns 1 + 1, of 6: expected 2/3, greatest 2.
    assert adjusted_rand_index("aabb", "xxyz") == pytest.approx((1 - 1 / 3) / (1.5 - 1 / 3))
    assert adjusted_rand_index("aabb", "xyxy") == pytest.approx((0 - 2 / 3) / (2 - 2 / 3))


@pytest.mark.parametrize(("true", "found"), [("aaa", "xxx"), ("abc", "xyz"), ("aab", "xxy")])
def test_equal_divisions_have_index_one(true, found):
    assert adjusted_rand_index(true, found) == pytest.approx(1.0)


def test_one_whole_against_all_single_is_chance():
    assert adjusted_rand_index("aaa", "xyz") == 0.0


def test_below_two_there_is_no_index():
    assert adjusted_rand_index("a", "x") is None
    assert adjusted_rand_index("", "") is None


@given(st.lists(st.tuples(st.sampled_from("abc"), st.sampled_from("xyz")), min_size=2), st.randoms())
def test_index_has_bounds_and_knows_no_order_names_or_sides(pairs, rng):
    true, found = zip(*pairs, strict=True)
    value = adjusted_rand_index(true, found)
    assert -0.5 - 1e-12 <= value <= 1 + 1e-12
    assert adjusted_rand_index(found, true) == pytest.approx(value)
    assert adjusted_rand_index([{"a": "q", "b": "r", "c": "s"}[t] for t in true], found) == value
    mixed = list(pairs)
    rng.shuffle(mixed)
    assert adjusted_rand_index(*zip(*mixed, strict=True)) == value


def test_split_and_merged_worked_by_hand():
    scores = score_clusters([("A", "1"), ("A", "1"), ("A", "2"), ("B", "2"), ("C", "3")])
    assert (scores.n_true, scores.n_predicted, scores.n_exact, scores.n_split, scores.n_merged) == (3, 3, 1, 1, 1)
    a, b, c = scores.clusters
    assert (a.pieces, a.joined_with, a.n_parts, a.split) == (("1", "2"), ("B",), 3, True)
    assert (b.pieces, b.joined_with, b.exact) == (("2",), ("A",), False)
    assert c.exact


def test_one_structure_alone():
    scores = score_clusters([("A", "1"), ("A", "2"), ("B", "2")], "B")
    assert (scores.n_true, scores.n_predicted, scores.n_split, scores.n_merged) == (1, 1, 0, 1)
    assert scores.adjusted_rand is None


def test_all_right():
    clusters = evaluate(agreeing(line()), line()).total.clusters
    assert (clusters.n_true, clusters.n_predicted, clusters.n_exact, clusters.adjusted_rand) == (2, 2, 2, 1.0)


def test_a_part_in_no_cluster_is_a_piece_of_its_own():
    graph = changed(agreeing(line()), edges=lambda e: None if isinstance(e, Contains) and e.target == "part-p0" else e)
    first, second = evaluate(graph, line()).total.clusters.clusters
    assert first.pieces == ("cluster-0", "part-p0")
    assert second.exact


def test_structures_are_named_and_of_a_kind():
    found = evaluate(agreeing(line()), line()).structures
    assert [(s.id, s.kind) for s in found] == [("A", "pipe system"), ("structure-2", "Structural element")]
    assert [s.parts.n for s in found] == [8, 2]


def test_an_unnamed_structure_takes_no_name_that_is_given():
    data = line().to_json()
    data["clusters"][0]["id"] = "structure-2"
    assert [s.id for s in evaluate(agreeing(line()), Truth.from_json(data)).structures] == [
        "structure-2", "structure-2'",
    ]  # fmt: skip


# Contacts


def test_contacts_all_right():
    contacts = evaluate(agreeing(line()), line()).total.contacts
    assert (contacts.pairs.precision, contacts.pairs.recall, contacts.pairs.f1) == (1.0, 1.0, 1.0)
    assert (contacts.n_extra_apart, contacts.missing) == (0, ())


def test_missing_and_extra_contacts():
    graph = agreeing(line())
    kept = [e for e in graph.document.edges if not (isinstance(e, Adjacent) and e.source == "part-b")]
    extra = [
        Adjacent(source="part-p0", target="part-p1", distance=0.004, point=graphs.ORIGIN),
        Adjacent(source="part-p0", target="part-p2", distance=0.0, point=graphs.ORIGIN),
    ]
    found = evaluate(made_of(graph.document.nodes, [*kept, *extra]), line())
    contacts = found.total.contacts
    assert (contacts.pairs.n_true, contacts.pairs.n_predicted, contacts.pairs.n_correct) == (8, 9, 7)
    assert contacts.n_extra_apart == 1
    assert contacts.missing == (("/b", "/v3"),)
    assert found.structures[1].contacts.pairs.recall == 0.0


def test_contacts_within_a_part_vanish_and_others_are_lifted():
    truth = line()
    graph = changed(
        agreeing(truth),
        lambda node: (
            None
            if node.id == "part-v1w"
            else node.model_copy(update={"meshes": ("/v1", "/v1w")})
            if node.id == "part-v1"
            else node.model_copy(update={"parts": ("part-v1",)})
            if node.id == "node-V1"
            else node
        ),
        lambda edge: None if "part-v1w" in (edge.source, edge.target) else edge,
    )
    pairs = evaluate(graph, truth).total.contacts.pairs
    assert (pairs.n_true, pairs.n_predicted, pairs.n_correct) == (7, 7, 7)


def test_what_is_not_annotated_is_not_scored():
    data = line().to_json() | {"clusters": None, "contacts": None, "units": None, "connections": None, "points": []}
    found = evaluate(agreeing(line()), Truth.from_json(data))
    assert found.structures == ()
    total = found.total
    assert (total.clusters, total.contacts, total.units, total.connected) == (None, None, None, None)
    assert total.parts.group.accuracy == 1.0
