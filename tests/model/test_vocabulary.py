import json

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.errors import LabelError
from cadgraph.model.vocabulary import Group, Vocabulary, default_vocabulary, read_vocabulary

LETTER = st.characters(exclude_characters=":;,&|!", exclude_categories=("Cs", "Cc", "Cf", "Co", "Cn", "Z"))
NAME = st.text(LETTER, min_size=1, max_size=9).map(str.lower).filter(str.isprintable)
UNIT = st.from_regex(r"[a-z][a-z0-9]{0,8}", fullmatch=True)


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
        NAME,
        st.builds(Group, st.lists(NAME, max_size=3, unique=True).map(tuple), st.none() | UNIT, st.booleans()),
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
        ("Tank: {names: [Shell]}", "name 'Shell' of group 'Tank' must be lower case: 'shell'"),
        ("Tank: {names: [shell, nozzle, shell]}", "name 'shell' is twice in group 'Tank'"),
        ("Tank: {names: [a]}\ntank: {names: [b]}", "group 'tank' is there twice"),
        ("Tank: {names: [a]}\nTank: {names: [b]}", "'Tank' is there twice in line 2"),
        ("Tank: {names: [a], names: [b]}", "'names' is there twice"),
        ("Tank: {names: ['a  b']}", "'a  b' in group 'Tank' is not a label"),
        ('Tank: {names: ["a\\nb"]}', "in group 'Tank' is not a label"),
        (f"Tank: {{names: [{'a' * 81}]}}", "at most 80 characters"),
        ("Tank: {names: [shell], unit: ''}", "'unit' of group 'Tank' must be text of lower-case letters"),
        ("Tank: {names: [shell], unit: 'Big:tank'}", "'unit' of group 'Tank' must be text of lower-case letters"),
        ("Tank: {names: [shell], unit: ../tank}", "'unit' of group 'Tank' must be text of lower-case letters"),
        ("Tank: {names: [shell], unit: true}", "'unit' of group 'Tank' must be text"),
        ("Tank: {names: [shell], conector: true}", "group 'Tank': unknown key 'conector'"),
        ("groups: {Tank: {names: [shell]}}\nextra: 1", "unknown key 'extra'; known are groups, version"),
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


def test_a_label_of_greatest_length_and_a_unit_of_two_words_are_fine(tmp_path):
    path = tmp_path / "tree.yaml"
    path.write_text(f"groups:\n  Tank: {{names: [{'a' * 80}], unit: storage tank}}\nversion: 1\n")
    assert read_vocabulary(path).unit_of_group == {"Tank": "storage tank"}


def test_aliases_that_unfold_without_end_are_an_error_of_moderate_length(tmp_path):
    path = tmp_path / "tree.yaml"
    rows = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    rows += [f"a{i}: &a{i} [{', '.join(9 * [f'*a{i - 1}'])}]" for i in range(1, 9)]
    path.write_text("\n".join(rows) + "\nTank: {names: *a8}\n")
    with pytest.raises(LabelError) as caught:
        read_vocabulary(path)
    assert len(str(caught.value)) < 1000


def test_a_graphs_tree_may_hold_keys_from_the_future():
    assert Vocabulary.from_json({"Tank": {"names": ["shell"], "color": "blue"}}) == Vocabulary(
        {"Tank": Group(("shell",))}
    )


def test_what_cannot_be_read_is_an_error(tmp_path):
    with pytest.raises(LabelError, match="no such file"):
        read_vocabulary(tmp_path / "none.yaml")
    with pytest.raises(LabelError, match="can't be read"):
        read_vocabulary(tmp_path)
    (tmp_path / "binary.yaml").write_bytes(b"\xff\xfe\xff")
    with pytest.raises(LabelError, match="not UTF-8 text"):
        read_vocabulary(tmp_path / "binary.yaml")
