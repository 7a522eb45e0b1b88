import json

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.errors import LabelError
from cadgraph.vocabulary import Group, Vocabulary, default_vocabulary, read_vocabulary

WORD = st.text(st.characters(exclude_characters=":;,&|!", exclude_categories=("Cs",)), min_size=1).filter(str.strip)


def test_the_built_in_tree_has_connectors_and_units():
    tree = default_vocabulary()
    assert tree.connector_groups == {"Pipe assembly"}
    assert tree.unit_of_group == {
        "Valve assembly": "valve",
        "Gauge assembly": "gauge",
        "Pump unit": "pump",
        "Tank": "tank",
        "Equipment": "equipment",
    }


def test_no_name_of_the_built_in_tree_is_in_two_groups():
    names = [name for group in default_vocabulary().groups.values() for name in group.names]
    assert len(set(names)) == len(names)


def test_a_tree_knows_its_groups_and_names():
    tree = default_vocabulary()
    assert tree.holds("Tank")
    assert tree.holds("Tank", "shell")
    assert not tree.holds("Tank", "lever")
    assert not tree.holds("tank")


@given(
    st.dictionaries(
        WORD,
        st.builds(Group, st.lists(WORD, max_size=3).map(tuple), st.none() | WORD, st.booleans()),
        min_size=1,
        max_size=4,
    )
)
def test_any_tree_survives_a_round_trip(groups):
    tree = Vocabulary(groups)
    data = json.loads(json.dumps(tree.to_json()))
    assert Vocabulary.from_json(data) == tree
    assert list(Vocabulary.from_json(data).groups) == list(groups), "the order is kept"


@pytest.mark.parametrize("suffix", ["yaml", "json"])
@pytest.mark.parametrize("wrapped", [True, False])
def test_a_file_may_wrap_its_groups_or_not(tmp_path, suffix, wrapped):
    tree = {"Vessel": {"names": ["drum"], "unit": "vessel"}}
    content = {"groups": tree} if wrapped else tree
    path = tmp_path / f"tree.{suffix}"
    path.write_text(json.dumps(content) if suffix == "json" else yaml.safe_dump(content), encoding="utf-8")
    assert read_vocabulary(path) == Vocabulary({"Vessel": Group(("drum",), "vessel")})


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("", "no groups"),
        ("groups: {}", "no groups"),
        ("[a, b]", "no groups"),
        ("Tank: [shell]", "group 'Tank' needs a list 'names'"),
        ("Tank: {names: shell}", "group 'Tank' needs a list 'names'"),
        ("Tank: {names: ['a:b']}", "'a:b' in group 'Tank' is not a label"),
        ("Tank: {names: [1]}", "1 in group 'Tank' is not a label"),
        ("Tank: {names: [' ']}", "' ' in group 'Tank' is not a label"),
        ("7: {names: [shell]}", "7 in group 7 is not a label"),
        ("Tank: {names: [shell], unit: [x]}", "'unit' of group 'Tank' must be text"),
        ("Tank: {names: [shell], connector: 1}", "'connector' of group 'Tank' must be true or false"),
        ("{", "not YAML"),
        ("!!python/object/apply:os.getcwd []", "not YAML"),
        ("[" * 5000, "not YAML"),
    ],
)
def test_a_malformed_tree_is_an_error_that_names_file_and_key(tmp_path, content, says):
    path = tmp_path / "tree.yaml"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(LabelError) as caught:
        read_vocabulary(path)
    assert says in str(caught.value)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_cannot_be_read_is_an_error(tmp_path):
    with pytest.raises(LabelError, match="can't be read"):
        read_vocabulary(tmp_path / "none.yaml")
    with pytest.raises(LabelError, match="can't be read"):
        read_vocabulary(tmp_path)
    (tmp_path / "binary.yaml").write_bytes(b"\xff\xfe\xff")
    with pytest.raises(LabelError, match="not YAML"):
        read_vocabulary(tmp_path / "binary.yaml")
