import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import plates
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.asking import Asking, Budget
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.growth import grow, overviews
from cadgraph.labelers.lvlm.merging import Wish, findings, merge, merge_vocabularies, read_wishes, to_yaml
from cadgraph.labelers.lvlm.normalize import clean_label, fold_group, fold_name, normalized
from cadgraph.model.vocabulary import Group, Vocabulary, default_vocabulary, read_vocabulary

TREE = default_vocabulary()
words = st.text(st.characters(codec="utf-8", exclude_categories=("Cs",)), max_size=80)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("Hand-Wheels", "hand wheel"),
        ("Bushes", "bush"),
        ("assemblies", "assembly"),
        ("glass", "glass"),
        ("Boxes", "box"),
    ],
)
def test_spellings_fold_into_one(one, other):
    assert normalized(one) == normalized(other)


@pytest.mark.parametrize(
    ("text", "label"),
    [
        ("Pressure Gauges", "pressure gauges"), ("a: b; c", "a b c"), ("<b>bolt</b>", "b bolt b"), ("", None),
        ("!!!", None),        ("x" * 61, None), ("x\x00y", "x y"), ("under_score", "under score"),
    ],
)  # fmt: skip
def test_labels_are_cleaned(text, label):
    assert clean_label(text) == label


def test_synonyms_and_groups_are_found():
    assert fold_name("guard rail", TREE) == ("Structural element", "railing")
    assert fold_name("Hand rails", TREE) == ("Structural element", "railing")
    assert fold_name("manhole", TREE) == ("Tank", "manway")
    assert fold_name("pressure gauge", TREE) is None
    assert fold_group("valve assemblies", TREE) == "Valve assembly"
    assert fold_group("Vehicles", TREE) is None


def test_a_name_in_two_groups_is_not_guessed():
    tree = Vocabulary({"A": Group(("plate",)), "B": Group(("plate",))})
    assert fold_name("plate", tree) is None
    assert fold_name("plates", tree, "B") == ("B", "plate")


def test_new_labels_are_added_and_known_ones_folded():
    tree, results = merge(
        TREE, [Wish("tank", "Agitators"), Wish("Vehicle", "fork lifts"), Wish("Pipe assembly", "Elbows")]
    )
    assert [row.outcome for row in results] == ["added", "added", "folded"]
    assert tree.groups["Tank"].names[-1] == "agitator"
    assert tree.groups["Vehicle"].names == ("fork lift",)
    assert list(tree.groups)[: len(TREE.groups)] == list(TREE.groups)
    assert tree.groups["Pipe assembly"].connector


@settings(max_examples=40, deadline=None)
@given(st.lists(st.tuples(words, words | st.none()), max_size=8))
def test_nothing_is_lost_and_the_tree_stays_one_that_can_be_read(rows):
    tree, results = merge(TREE, [Wish(group, name) for group, name in rows])
    assert len(results) == len(rows)
    for group, content in TREE.groups.items():
        assert tree.groups[group].names[: len(content.names)] == content.names
    assert Vocabulary.from_json(tree.to_json()).to_json() == tree.to_json()
    again, twice = merge(tree, [Wish(group, name) for group, name in rows])
    assert again.to_json() == tree.to_json()
    assert all(row.outcome != "added" for row in twice)


def test_a_tree_survives_being_written_and_read(tmp_path):
    (tmp_path / "tree.yaml").write_text(to_yaml(TREE, ["a comment\nwith two lines"]), encoding="utf-8")
    assert read_vocabulary(tmp_path / "tree.yaml").to_json() == TREE.to_json()


def test_merging_trees_keeps_units_and_connectors():
    other = Vocabulary({"Ducts": Group(("duct",), connector=True), "tank": Group(("silo",), unit="silo")})
    tree, _ = merge_vocabularies(TREE, other)
    assert tree.groups["Ducts"].connector
    assert tree.groups["Tank"].unit == "tank"
    assert "silo" in tree.groups["Tank"].names


def test_check_finds_what_a_person_should_look_at():
    assert findings(TREE) == []
    odd = Vocabulary({"A": Group(("hand wheel", "bolt")), "B": Group(("handwheels",)), "C": Group(())})
    found = " ".join(findings(odd))
    assert "several places" in found
    assert "no names" in found
    assert "connector" in found


def test_proposals_that_are_none_are_refused(tmp_path):
    path = tmp_path / "proposals.json"
    for content in ("{", "[]", '{"labels": 3}', '{"labels": [{"group": 1}]}', '{"labels": ["x"]}'):
        path.write_text(content)
        with pytest.raises(LabelError):
            read_wishes(path)
    with pytest.raises(LabelError, match="no such file"):
        read_wishes(tmp_path / "none.json")


SCENE = plates.scene_of(2)


def grown(answers, start=TREE, **more):
    told = plates.Told(lambda text: answers.pop(0))
    asking = Asking(told, Cache(":memory:"), budget=Budget(more.pop("questions", None)))
    return grow(SCENE, start, asking, count=2), told


def test_each_picture_is_asked_with_what_the_one_before_brought():
    rows = [{"labels": [{"group": "Vehicle", "name": "forklift"}]}, {"labels": []}]
    growth, told = grown([json.dumps(row) for row in rows])
    assert "forklift" not in told.asked[0].text
    assert "forklift" in told.asked[1].text
    assert growth.merged[0].wish.source == "overview-1"
    assert growth.vocabulary.groups["Vehicle"].names == ("forklift",)


def test_growth_from_nothing():
    growth, told = grown(['{"labels": [{"group": "Pipes", "name": "pipe"}]}', '{"labels": []}'], Vocabulary({}))
    assert "(none)" in told.asked[0].text
    assert growth.vocabulary.to_json() == {"Pipes": {"names": ["pipe"]}}


def test_a_picture_without_a_usable_answer_is_told():
    growth, told = grown(["no idea", "none", '{"labels": []}'])
    assert growth.failures[0][0] == "overview-1"
    assert len(told.asked) == 3


def test_a_model_that_answers_no_picture_is_an_error():
    with pytest.raises(LabelError, match=r"no answer to any of the 2 pictures .* nothing was written"):
        grown(["no idea"] * 4)


def test_growth_keeps_to_the_budget():
    growth, told = grown(['{"labels": []}'], questions=1)
    assert len(told.asked) == 1
    assert "budget" in growth.failures[0][1]


def test_overviews_have_names_of_their_own():
    names = [each.name for each in overviews(SCENE, 5)]
    assert len(set(names)) == len(names) == 4
    assert overviews(SCENE, 1)[0].draw().size == (1024, 768)
