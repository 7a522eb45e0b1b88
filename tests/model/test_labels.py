import pytest
from hypothesis import given
from hypothesis import strategies as st

import graphs
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import EVIDENCE, Evidence, FormerLabel, GeometryEvidence, Guess, Label, LvlmEvidence

TEXT = st.text(max_size=20)


@pytest.mark.parametrize(("source", "kind"), EVIDENCE.items())
def test_plain_evidence_becomes_the_kind_of_its_source(source, kind):
    label = Label("Tank", "tank", 0.5, source, {"why": "round"})
    assert type(label.evidence) is kind
    assert label.evidence.to_json() == {"why": "round"}


def test_the_source_of_somebody_elses_labeler_keeps_what_it_says():
    label = Label("Tank", "tank", 0.5, "my rules", {"why": "round", "rule": [7]})
    assert type(label.evidence) is Evidence
    assert label.evidence.to_json() == {"why": "round", "rule": [7]}


def test_our_source_with_other_values_is_kept_as_it_is():
    label = Label("Tank", "tank", 0.5, "geometry", {"name": "not what we put there"})
    assert label.evidence.to_json() == {"name": "not what we put there"}


def test_guesses_stand_beside_a_label_in_the_file_and_not_in_it():
    label = Label("Tank", "tank", 0.5, "geometry", GeometryEvidence(why="w"), (Guess("Tank", "tank", 0.5),))
    assert label.model_dump() == {
        "group": "Tank", "name": "tank", "confidence": 0.5, "source": "geometry", "evidence": {"why": "w"},
    }  # fmt: skip


def test_what_a_label_was_before_is_kept():
    old = Label("Pipe assembly", "gasket", 0.25, "lvlm", LvlmEvidence(model="m", why="flat"))
    new = Label("Pipe assembly", "flange", 0.9, "context", LvlmEvidence(model="m", before=FormerLabel.of(old)))
    before = new.evidence.to_json()["before"]
    assert before == {
        "group": "Pipe assembly", "name": "gasket", "confidence": 0.25, "source": "lvlm", "why": "flat",
    }  # fmt: skip
    assert FormerLabel.of(None) is None


def test_a_former_label_in_words_is_read():
    label = Label("Pipe assembly", "flange", 0.9, "context", {"before": "Pipe assembly: gasket"})
    assert (label.evidence.before.group, label.evidence.before.name) == ("Pipe assembly", "gasket")


@given(st.sampled_from(sorted(EVIDENCE)), st.dictionaries(TEXT.filter(lambda key: key not in ("why", "before")), TEXT))
def test_evidence_goes_to_the_file_and_back(source, plain):
    data = graphs.graph([graphs.part(0, "/a")]).to_json()
    node = next(node for node in data["nodes"] if node["layer"] == "part")
    node["label"] = {"group": "g", "name": None, "confidence": 0.5, "source": source, "evidence": plain}
    again = SceneGraph.from_json(data).to_json()
    assert next(n for n in again["nodes"] if n["layer"] == "part")["label"]["evidence"] == plain


def test_old_ways_of_reading_evidence_warn():
    evidence = GeometryEvidence(why="w")
    with pytest.warns(DeprecationWarning, match="evidence.key"):
        assert evidence["why"] == "w"
    with pytest.warns(DeprecationWarning, match="evidence.key"):
        assert evidence.get("name", 3) == 3
