"""What a file says of nodes above meshes: it lands on the unit, and names it where that is asked for."""

from dataclasses import replace

import pytest

import shapes
from cadgraph.config import Config
from cadgraph.facts.statements import Statements, usable_tag
from cadgraph.facts.words import read_words
from cadgraph.model.facts import Fact
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.graph import SceneGraph
from cadgraph.model.parts import Network, UnitParts
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import analyse, build
from cadgraph.stages.relate.stated_names import name_as_stated, tag_as_stated
from tanks import PATHS, built, tanks


def unit_of(graph, path):
    return graph.unit_of(graph.part(path))


def noted(graph, code):
    return [found for found in graph.diagnostics if found.code == code]


def test_the_scene_has_three_units():
    graph = built(tanks())
    assert sorted(unit.tag for unit in graph.units()) == ["T-001", "T-002", "T-003"]
    assert "facts" not in str(graph.to_json()["nodes"])


def test_a_node_above_several_parts_tells_of_their_unit():
    graph = built(tanks(("/area/T1", "description", "CONDENSATE TANK", "att DESC")), use=False)
    (fact,) = unit_of(graph, PATHS[0]).facts
    assert (fact.key, fact.value, fact.where, fact.path) == ("description", "CONDENSATE TANK", "att DESC", "/area/T1")
    assert graph.part(PATHS[0]).facts == ()
    assert unit_of(graph, PATHS[2]).facts == ()


def test_a_node_above_several_units_tells_of_the_whole():
    graph = built(tanks(("/area", "description", "AREA 7", "att DESC")), use=False)
    assert all(unit.facts == () for unit in graph.units())
    (fact,) = graph.nodes["site"].facts
    assert (fact.value, fact.path) == ("AREA 7", "/area")


def test_a_fact_of_a_mesh_is_its_parts():
    graph = built(tanks((PATHS[4], "spec", "A1", "att SPRE"), (PATHS[4], "class", "EQUI", "att TYPE")), use=False)
    assert [(f.key, f.value, f.path) for f in graph.part(PATHS[4]).facts] == [
        ("spec", "A1", None),
        ("class", "EQUI", None),
    ]
    assert SceneGraph.from_json(graph.to_json()).part(PATHS[4]).facts == graph.part(PATHS[4]).facts


def test_the_plants_tag_takes_the_place_of_a_number():
    scene = tanks(("/area/T1", "tag", "/10-B-7", "att NAME"), (PATHS[4], "tag", "B 12", "Tag"))
    graph = built(scene)
    assert unit_of(graph, PATHS[0]).tag == "10-B-7"
    assert unit_of(graph, PATHS[4]).tag == "B-12"
    assert unit_of(graph, PATHS[2]).tag == "T-002"
    assert graph.find("10b7", type(unit_of(graph, PATHS[0]))).id == "unit-10-B-7"


def test_without_being_asked_for_a_tag_is_only_kept():
    scene = tanks(("/area/T1", "tag", "B-7", "att NAME"))
    kept, bare = built(scene, use=False).to_json(), built(tanks(), use=False).to_json()
    for node in kept["nodes"]:
        node.pop("facts", None)
    assert kept == bare


def test_a_tag_of_two_units_is_noted_and_both_keep_their_numbers():
    graph = built(tanks(("/area/T1", "tag", "B-7", "x"), ("/area/T2", "tag", "b 07", "x")))
    assert {unit_of(graph, PATHS[0]).tag, unit_of(graph, PATHS[2]).tag} == {"T-001", "T-002"}
    (told,) = noted(graph, "tag-twice")
    assert len(told.meshes) == 2
    assert "B-7" in told.message


def test_a_number_that_the_plant_uses_moves_on():
    graph = built(tanks(("/area/T2", "tag", "T-1", "x")))
    tags = [unit_of(graph, path).tag for path in (PATHS[0], PATHS[2], PATHS[4])]
    assert tags[1] == "T-1"
    assert len({tag.replace("0", "") for tag in tags}) == 3


def test_a_tag_of_a_piece_counts_less_than_that_of_the_whole():
    scene = tanks((PATHS[1], "tag", "LEG-1", "x"), (PATHS[0], "tag", "B-1", "x"), (PATHS[3], "tag", "LEG-2", "x"))
    graph = built(scene)
    assert unit_of(graph, PATHS[0]).tag == "B-1"
    assert unit_of(graph, PATHS[2]).tag == "LEG-2"


@pytest.mark.parametrize(
    ("value", "tag"),
    [
        ("/P-101", "P-101"),
        ("10 PAC01 AP001", "10-PAC01-AP001"),
        ("V_12.a", "V_12.a"),
        ("316289", None),
        ("Pump", None),
        ("", None),
        ("P-101 -> T-1", None),
        ("part-00012", None),
        ("Unit 3", None),
        ("P" * 60 + "1", None),
        ("[red]P1", None),
        ("P-1\n", "P-1"),
        ("Ü-1", None),
    ],
)
def test_what_can_be_a_tag(value, tag):
    assert usable_tag(value) == tag


def test_a_tag_that_is_none_is_noted():
    graph = built(tanks(("/area/T1", "tag", "316289", "IfcTank.Tag")))
    assert unit_of(graph, PATHS[0]).tag == "T-001"
    assert "316289" in noted(graph, "tag-unusable")[0].message


def test_a_node_that_is_another_device_is_noted():
    graph = built(tanks(("/area/T1", "description", "feed pump", "att DESC")))
    (told,) = noted(graph, "file-disagrees")
    assert "Pump unit/pump" in told.message
    assert "tank" in told.message
    assert all(graph.part(path).label.group == "Tank" for path in PATHS)


def test_the_papers_method_has_the_plants_tags_too():
    graph = built(tanks(("/area/T1", "tag", "B-7", "x")), method="paper")
    assert unit_of(graph, PATHS[0]).tag == "B-7"


def valve(*facts):
    scene = Scene.from_meshes([shapes.box((0.2, 0.1, 0.1)), shapes.box((1, 1, 1), (5, 0, 0))], ["/V/body", "/other"])
    scene = replace(scene, facts=tuple(Fact("/V/body", *fact) for fact in facts))
    labels = [GivenLabel("/V/body", "Valve assembly", "valve")]
    config = Config().replace({"label.labeler": "none", "label.use_metadata": True, "ground.find": "none"})
    return build(scene, config, labels=labels).units("valve")[0].kind


@pytest.mark.parametrize(
    ("facts", "kind"),
    [
        ([("class", "IfcValve", "IfcValve"), ("predefined", "CHECK", "IfcValve.PredefinedType")], "check valve"),
        ([("class", "IfcValve", "IfcValve"), ("predefined", "ISOLATING", "x")], "isolating valve"),
        ([("spec", "CKFL", "IsogenData.SKEY")], "check valve"),
        ([("type", "Kugelhahn DN50", "x"), ("name", "gate valve", "x")], "ball valve"),
        ([("name", "gate valve", "x")], "gate valve"),
        ([("class", "IfcValve", "IfcValve")], None),
        ([("class", "IfcPump", "IfcPump"), ("description", "centrifugal pump", "x")], None),
    ],
)
def test_the_file_says_the_kind_of_a_unit(facts, kind):
    assert valve(*facts) == kind


def test_what_a_valve_is_for_does_not_replace_how_it_is_made():
    unit = UnitParts("valve", "V-001", (0,), "gate valve")
    scene = Scene.from_meshes([shapes.box()], ["/v"])
    for value, kind, told in (("ISOLATING", "gate valve", 0), ("CHECK", "check valve", 1)):
        facts = (Fact("/v", "class", "IfcValve", "x"), Fact("/v", "predefined", value, "x"))
        analysis = analyse(replace(scene, facts=facts), Config().replace({"ground.find": "none"}))
        stated = Statements(analysis, read_words(), default_vocabulary())
        named = tag_as_stated([unit], stated, analysis.parts, [None], default_vocabulary())
        network, notes = name_as_stated(Network(named.units), named, analysis.parts, default_vocabulary())
        assert network.units[0].kind == kind
        assert [note.code for note in notes] == ["file-disagrees"] * told
