import contextlib
import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cadgraph.labelers.lvlm.answer import (
    Answer,
    GrowthAnswer,
    Malformed,
    Proposal,
    answer_schema,
    growth_schema,
    read,
    settle,
)
from cadgraph.model.vocabulary import Group, Vocabulary, default_vocabulary

TREE = default_vocabulary()
GOOD = {"seen": "a ring", "group": "Pipe assembly", "name": "gasket", "confidence": 0.7}


def answer(**changes):
    return read(json.dumps({**GOOD, **changes}), Answer)


@pytest.mark.parametrize("wrap", ["{}", "```json\n{}\n```", "Here it is: {} I hope it helps."])
def test_words_and_fences_round_the_object_are_passed_over(wrap):
    assert read(wrap.replace("{}", json.dumps(GOOD)), Answer).name == "gasket"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "empty"), ("", "empty"), ("  ", "empty"), ("a gasket", "no JSON object"), ("{'group': 1}", "not valid"),
        ('{"group": "Tank"}', "name"), ('{"group": 3, "name": "shell"}', "group"), ("{" * 30_000, "longer"),
        ('{"group": "Tank", "name": "shell", "confidence": NaN}', "not valid"),
        ('{"a":' * 3000 + "1" + "}" * 3000, "JSON"),
        ('{"group": "Tank", "name": "shell", "confidence": -1}', "confidence"),
        (json.dumps({**GOOD, "name": "x" * 5000}), "name"),
    ],
)  # fmt: skip
def test_what_is_no_answer_is_refused_with_the_reason(text, words):
    with pytest.raises(Malformed, match=words):
        read(text, Answer)


@settings(max_examples=60, deadline=None)
@given(st.text(max_size=300) | st.recursive(st.none() | st.integers() | st.text(), st.lists).map(json.dumps))
def test_nothing_that_comes_back_breaks_the_reading(text):
    with contextlib.suppress(Malformed):
        settle(read(text, Answer), TREE)


@pytest.mark.parametrize(("value", "share"), [(0.4, 0.4), (40, 0.4), (1, 1.0), (100, 1.0)])
def test_confidence_in_per_cent_is_understood(value, share):
    assert answer(confidence=value).confidence == pytest.approx(share)


def test_long_words_are_cut_and_control_characters_dropped():
    found = answer(seen="\x1b[31mred\n" + "x" * 2000)
    assert len(found.seen) == 300
    assert "\x1b" not in found.seen
    assert "\n" not in found.seen


@pytest.mark.parametrize(
    ("group", "name", "expected"),
    [
        ("Pipe assembly", "gasket", ("Pipe assembly", "gasket")),
        ("pipe assemblies", "Gaskets", ("Pipe assembly", "gasket")),
        ("Valve assembly", "hand-wheel", ("Valve assembly", "handwheel")),
        ("Valve assembly", "Hand Wheel", ("Valve assembly", "handwheel")),
        ("Pipe assembly", "warp core", ("Pipe assembly", None)),
        ("Tank", "gasket", ("Tank", None)),
        ("Spaceship", "gasket", ("Pipe assembly", "gasket")),
        ("Spaceship", "warp core", (None, None)),
    ],
)
def test_labels_are_found_in_the_vocabulary(group, name, expected):
    verdict = settle(answer(group=group, name=name), TREE)
    assert (verdict.group, verdict.name) == expected


def test_contradicting_answers_lose_confidence():
    assert settle(answer(group="Tank", name="gasket"), TREE).confidence < 0.7
    assert settle(answer(group="Spaceship", name="gasket"), TREE).confidence < 0.7
    assert settle(answer(), TREE).confidence == 0.7


def test_new_labels_become_proposals():
    verdict = settle(answer(propose_group="Tanks", propose_name="Agitator", reason="blades"), TREE)
    assert (verdict.group, verdict.name) == ("Pipe assembly", "gasket")
    assert verdict.proposal == Proposal("Tank", "agitator", "blades")
    assert settle(answer(propose_group="Tank", propose_name="Shells"), TREE).proposal is None
    assert settle(answer(group="Tank", name="agitator"), TREE).proposal == Proposal("Tank", "agitator")


def test_a_proposal_that_is_no_label_is_dropped():
    assert settle(answer(propose_group="Tank", propose_name="<" * 9), TREE).proposal is None
    assert settle(answer(propose_group="Tank", propose_name="a " * 90), TREE).proposal is None


def test_schema_is_strict_and_holds_to_the_vocabulary():
    schema = answer_schema(TREE)
    assert schema["additionalProperties"] is False
    assert set(schema["required"]) == set(schema["properties"])
    assert schema["properties"]["group"]["enum"] == list(TREE.groups)
    assert "gasket" in schema["properties"]["name"]["enum"]
    text = json.dumps([schema, growth_schema()])
    assert not any(f'"{word}"' in text for word in ("default", "maxLength", "minimum", "title", "maxItems"))


def test_a_huge_vocabulary_is_left_out_of_the_schema():
    huge = Vocabulary({"Things": Group(tuple(f"thing {i}" for i in range(600)))})
    assert "enum" not in answer_schema(huge)["properties"]["name"]


def test_a_list_without_end_of_new_labels_is_refused():
    with pytest.raises(Malformed):
        read(json.dumps({"labels": [{"group": "a", "name": "b"}] * 300}), GrowthAnswer)
