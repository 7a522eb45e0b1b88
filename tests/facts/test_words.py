import pytest
from hypothesis import given
from hypothesis import strategies as st

from cadgraph.errors import LabelError
from cadgraph.facts.words import Meaning, _built_in, fold, read_words, words_of
from cadgraph.model.vocabulary import default_vocabulary

WORDS = read_words()
LANGUAGES = {"en", "de", "fr", "es", "it", "pt", "nl", "pl", "sv", "ru"}


def said(text, words=WORDS):
    spoken = words.read(text)
    return None if spoken is None else (spoken.meaning.name or spoken.meaning.group)


def test_every_phrase_of_the_list_means_one_label_of_the_vocabulary():
    phrases, _ = _built_in()
    meant = {}
    for phrase in phrases:
        if phrase.meaning is not None:
            assert default_vocabulary().holds(phrase.meaning.group, phrase.meaning.name), phrase
        assert meant.setdefault(phrase.words, phrase.meaning) == phrase.meaning, phrase


def test_the_list_speaks_ten_languages():
    phrases, _ = _built_in()
    assert {phrase.language for phrase in phrases} == LANGUAGES
    for language in LANGUAGES:
        known = {p.meaning for p in phrases if p.language == language and p.meaning is not None}
        assert {m.name for m in known} >= {"valve", "pump", "flange", "elbow", "tank", "gasket", "beam", "gauge"}


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Gate valve DN50", "valve"),
        ("Absperrklappe", "valve"),
        ("vanne papillon", "valve"),
        ("valvola a sfera", "valve"),
        ("Válvula de retenção", "valve"),
        ("válvula de bola", "valve"),
        ("kogelkraan", "valve"),
        ("zawór kulowy", "valve"),
        ("backventil", "valve"),
        ("клапан обратный", "valve"),
        ("Kreiselpumpe 3", "pump"),
        ("pompe centrifuge", "pump"),
        ("циркуляционный насос", "pump"),
        ("Blindflansch DN80", "blind flange"),
        ("bride", "flange"),
        ("kołnierz", "flange"),
        ("Rohrbogen 90°", "elbow"),
        ("COUDE 3D", "elbow"),
        ("gomito", "elbow"),
        ("отвод 90", "elbow"),
        ("Reduzierstück", "reducer"),
        ("Dichtung", "gasket"),
        ("прокладка", "gasket"),
        ("uszczelka", "gasket"),
        ("Wärmetauscher", "heat exchanger"),
        ("Heizkörper", "radiator"),
        ("Handrad", "handwheel"),
        ("hand-wheel", "handwheel"),
        ("PUMPCasing2", "pump casing"),
        ("/HANDRAIL-12", "railing"),
        ("levers", "lever"),
        ("Ausdehnungsgefäß", "tank"),
        ("Sechskantmutter", "nut"),
        ("Rørledning", "Pipe assembly"),
    ],
)
def test_names_in_ten_languages_are_known(text, name):
    assert said(text) == name


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Ventilator 2", "blower"),
        ("Ventilation", None),
        ("Lüftung_Ventilationskanal", None),
        ("steel", None),
        ("Steel beam", "beam"),
        ("committee", None),
        ("Pumpensumpf", None),
        ("pump room", None),
        ("M16 Bolzen", "Connection assembly"),
        ("Verschraubung", "union"),
        ("gasket for valve", "gasket"),
        ("Dichtung für Pumpe", "gasket"),
        ("Flanged valve", "valve"),
        ("tank farm", None),
        ("valve body", "valve body"),
        ("pipe clamp", "clamp"),
        ("Ventilgehäuse", "valve body"),
        ("shell and tube", "heat exchanger"),
        ("вентиляция", None),
        ("вентилятор", "blower"),
    ],
)
def test_traps(text, name):
    assert said(text) == name


@pytest.mark.parametrize(
    "text",
    [
        "mesh_12",
        "Body",
        "Solid",
        "Part1",
        "Geo_00012",
        "NAUO12",
        "Boss-Extrude1",
        "4711-0815",
        "",
        "___",
        "Component4",
        "=>[1:1:1:2]",
        "GLTF_17",
        "Cube.003",
        "DN80 PN16",
    ],
)
def test_names_without_meaning_match_nothing(text):
    assert WORDS.read(text) is None


def test_kinds_of_units_are_told():
    assert WORDS.read("GateValve_012").meaning == Meaning("Valve assembly", "valve", "gate valve")
    assert WORDS.read("PSVs").meaning.kind == "relief valve"
    assert WORDS.read("valve").meaning.kind is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("GateValve_012", ("gate", "valve")),
        ("PUMPCasing2", ("pump", "casing")),
        ("hand-wheel", ("hand", "wheel")),
        ("Größe", ("grosse",)),
        ("zawór", ("zawor",)),
        ("rør", ("ror",)),
        ("/123/_4", ()),
        ("PSVs", ("psvs",)),
    ],
)
def test_words_of_a_name(text, words):
    assert words_of(text) == words


@given(st.text(max_size=60))
def test_any_text_is_read(text):
    words_of(text)
    WORDS.read(text)
    assert fold(fold(text)) == fold(text)


def test_a_text_is_read_no_further_than_its_first_letters():
    assert said("x " * 40 + "valve") is None
    assert said("9" * 500 + "valve") is None


def mine(tmp_path, text):
    (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
    return tmp_path / "mine.yaml"


def test_a_users_words_add_and_win(tmp_path):
    own = read_words(
        mine(
            tmp_path,
            "labels:\n  Tank/tank: {firm: [bolt, 'zbx*']}\nstop: {firm: [gizmo valve]}\ndrop: {en: [elbow]}\n",
        )
    )
    assert said("Bolt", own) == "tank"
    assert said("ZBX-12", own) == "tank"
    assert said("zbxy", own) == "tank"
    assert said("gizmo valve", own) is None
    assert said("elbow", own) is None
    assert said("Ventil", own) == "valve"
    assert said("Bolt") == "bolt"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("labels: [a\n", "line"),
        ("- a\n", "not a mapping"),
        ("label: {}\n", "'label'"),
        ("labels: {Tank/tank: [tank]}\n", "Tank/tank"),
        ("labels: {Tank/tank: {no: [tank]}}\n", "quotes"),
        ("labels: {Tank/tank: {en: tank}}\n", "list of words"),
        ("labels: {Tank/tank: {en: [12]}}\n", "12"),
        ("labels: {Tank/tank: {en: ['']}}\n", "empty"),
        ("labels: {Tank/tank: {en: ['a*b']}}\n", "star"),
        ("labels: {Tank/tank: {en: ['*']}}\n", "star"),
        ("labels: {a/b/c/d: {en: [x]}}\n", "'a/b/c/d'"),
        ("labels: {Tank/tank: {en: [a], en: [b]}}\n", "twice"),
        ("drop: {en: [quux]}\n", "quux"),
        ("cut: {en: ['a b']}\n", "cut"),
    ],
)
def test_a_malformed_list_ends_in_one_line(tmp_path, text, told):
    file = mine(tmp_path, text)
    with pytest.raises(LabelError) as error:
        read_words(file)
    assert str(file) in str(error.value)
    assert told in str(error.value)
    assert "\n" not in str(error.value)
