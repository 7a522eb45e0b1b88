import pytest

from cadgraph.facts.ifc_classes import _CLASSES
from cadgraph.facts.pdms_types import _SYMBOLS, _TYPES, isogen_label, pdms_label
from cadgraph.facts.rules import claims_of, path_name, strongest
from cadgraph.facts.words import read_words
from cadgraph.model.facts import Fact
from cadgraph.model.vocabulary import default_vocabulary

WORDS, VOCABULARY = read_words(), default_vocabulary()


def claims(*rows):
    facts = [Fact("/a", key, value, where) for key, value, *rest in rows for where in [rest[0] if rest else key]]
    return [claim for _, claim in claims_of(facts, WORDS, VOCABULARY)]


def test_the_tables_hold_labels_of_the_vocabulary():
    told = [said for one in _CLASSES.values() for said in (one.said, *one.by_type.values()) if said is not None]
    told += [said[:2] for said in _TYPES.values()] + [said[:2] for _, said in _SYMBOLS]
    assert len(told) > 80
    assert all(VOCABULARY.holds(*said) for said in told)


@pytest.mark.parametrize(
    ("rows", "name", "trust"),
    [
        ([("class", "Tank/shell")], "shell", 0.95),
        ([("class", "Tank: shell")], "shell", 0.95),
        ([("class", "flange")], "flange", 0.95),
        ([("class", "VALV")], "valve", 0.9),
        ([("class", "VALVE")], "valve", 0.9),
        ([("class", "TUBI")], "pipe", 0.9),
        ([("spec", "KABW")], "pipe cap", 0.9),
        ([("class", "IfcPump")], "pump", 0.8),
        ([("class", "IFCBEAMSTANDARDCASE")], "beam", 0.8),
        ([("type", "IfcPipeSegmentType")], "pipe", 0.8),
        ([("type", "Kugelhahn DN50")], "valve", 0.75),
        ([("class", "Kugelhahn")], "valve", 0.75),
        ([("predefined", "Rohr DN20", "IfcPipeSegment.ObjectType")], "pipe", 0.75),
        ([("name", "Kugelhahn 12")], "valve", 0.6),
        ([("description", "CONDENSATE PUMP")], "pump", 0.6),
        ([("layer", "Flansche")], "flange", 0.3),
    ],
)
def test_trust_follows_the_kind_of_fact(rows, name, trust):
    (claim,) = claims(*rows)
    assert (claim.name, claim.trust) == (name, trust)


@pytest.mark.parametrize(
    "row",
    [
        ("class", "IfcBuildingElementProxy"),
        ("class", "IfcDoor"),
        ("class", "IfcFlowFitting"),
        ("class", "INST"),
        ("class", "EQUI"),
        ("class", "BRANCH"),
        ("class", "BOX"),
        ("spec", "SGFL"),
        ("spec", "12345"),
        ("tag", "PUMP-1"),
        ("system", "pump circuit"),
        ("size", "50"),
        ("predefined", "NOTDEFINED"),
        ("name", ""),
        ("class", "IfcSlab"),
    ],
)
def test_what_says_nothing_makes_no_claim(row):
    assert claims(row) == [None]


def test_an_enumeration_refines_its_class():
    assert [c.name for c in claims(("class", "IfcPipeFitting"), ("predefined", "BEND"))] == [None, "elbow"]
    assert [c.trust for c in claims(("class", "IfcPipeFitting"), ("predefined", "BEND"))] == [0.4, 0.9]
    assert claims(("predefined", "BEND", "IfcPipeFitting.PredefinedType"))[0].name == "elbow"
    check = claims(("class", "IfcValve"), ("predefined", "CHECK"))[1]
    assert (check.name, check.kind) == ("valve", "check valve")
    assert claims(("class", "IfcValve"), ("predefined", "STEAMTRAP"))[1] is None


def test_a_generic_class_only_leans():
    assert claims(("class", "IfcPipeFitting"))[0].is_prior
    assert claims(("class", "IfcPipeFitting"), ("predefined", "CONNECTOR"))[1].is_prior
    assert not claims(("class", "IfcValve"))[0].is_prior
    assert claims(("layer", "pump"))[0].is_prior


@pytest.mark.parametrize(
    ("key", "name", "kind"),
    [
        ("CKFL", "valve", "check valve"),
        ("V3FL", "valve", None),
        ("vgfl", "valve", None),
        ("FLWN", "flange", None),
        ("FLBL", "blind flange", None),
        ("ELBW", "elbow", None),
        ("RCBW", "reducer", None),
        ("WTBW", "branch outlet", None),
    ],
)
def test_symbol_keys(key, name, kind):
    assert isogen_label(key)[1:] == (name, kind)


def test_geometry_says_what_a_steel_section_is():
    assert pdms_label("SCTN") == ("Structural element", None, None)


def test_one_witness_of_each_family_the_most_trusted_first():
    found = strongest(
        c
        for c in claims(
            ("name", "Rohr"),
            ("class", "IfcValve"),
            ("predefined", "CHECK"),
            ("description", "pump"),
            ("type", "Kugelhahn"),
        )
        if c is not None
    )
    assert [(c.family, c.name) for c in found] == [("class", "valve"), ("type", "valve"), ("name", "pipe")]
    assert found[0].kind == "check valve"


def test_a_step_of_a_path_is_a_name():
    ((_, claim),) = claims_of([path_name("Handrad_3")], WORDS, VOCABULARY)
    assert (claim.key, claim.name, claim.trust) == ("name", "handwheel", 0.6)


def test_a_nozzle_of_rvm_says_nothing_as_pumps_have_them_too():
    for kind in ("NOZZ", "NOZZLE"):
        assert claims(("class", kind), ("name", "NOZZLE_2", "path")) == [None, None]
    # In a name that somebody gave, the word counts as ever.
    (claim,) = claims(("name", "Nozzle_N2", "path"))
    assert claim.said == ("Tank", "nozzle")


def test_default_names_repeat_their_type():
    said, repeated = claims(("class", "ELBO"), ("name", "ELBOW_12", "path"))
    assert (said.name, repeated) == ("elbow", None)
    assert [claim.name for claim in claims(("class", "ELBO"), ("name", "Tee_3", "path"))] == ["elbow", "tee"]
