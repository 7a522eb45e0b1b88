"""Labels by source path: as a table that is read again, and as PDMS attributes."""

from __future__ import annotations

import re

import pytest

import graphs
from cadgraph.errors import OutputError
from cadgraph.export import export_graph, write_export
from cadgraph.export.att import write_att
from cadgraph.export.labels import mesh_labels
from cadgraph.model.given_labels import read_labels
from cadgraph.model.vocabulary import default_vocabulary

LIKELY = graphs.label("Pipe assembly", None, 0.5).model_copy(update={"likely": True})
PIPE = graphs.label("Pipe assembly", "pipe", 0.9)


def plant():
    parts = (
        graphs.part(0, "/Skid/Valve/Body", "/Skid/Valve/Bolt", label=graphs.label("Valve assembly", "valve body", 0.8)),
        graphs.part(1, "/Skid/Pipe", label=LIKELY),
        graphs.part(2, "/Skid/Thing"),
    )
    return graphs.graph((*parts, graphs.unit("V-001", "part-0")))


def test_every_mesh_of_a_labelled_part_has_a_row_that_is_read_again(tmp_path):
    (file,) = export_graph(plant(), "labels-csv", tmp_path)
    assert file.name == "labels.csv"
    read = {(label.mesh, label.group, label.name) for label in read_labels(file, default_vocabulary())}
    assert read == {
        ("/Skid/Valve/Body", "Valve assembly", "valve body"),
        ("/Skid/Valve/Bolt", "Valve assembly", "valve body"),
        ("/Skid/Pipe", "Pipe assembly", None),
    }
    rows = file.read_text(encoding="utf-8-sig").splitlines()
    assert rows[0] == "mesh,group,name,confidence,state,source,part,unit,tag"
    assert "/Skid/Valve/Bolt,Valve assembly,valve body,0.8,sure,geometry,part-0,unit-V-001,V-001" in rows
    assert "/Skid/Pipe,Pipe assembly,,0.5,likely,geometry,part-1,," in rows


def test_meshes_without_a_label_are_told(tmp_path):
    notes = write_export(plant(), "labels-csv", tmp_path).notes
    assert [(note.code, note.meshes) for note in notes] == [("unlabelled", ("/Skid/Thing",))]


def test_a_path_that_would_run_as_a_formula_is_told_and_guarded(tmp_path):
    graph = graphs.graph((graphs.part(0, "=cmd()", label=PIPE), graphs.part(1, "/a\x00b", label=PIPE)))
    written = write_export(graph, "labels-csv", tmp_path)
    assert written.notes[0].code == "changed-path"
    assert written.notes[0].meshes == ("=cmd()", "/a\x00b")
    assert "'=cmd()," in written.files[0].read_text(encoding="utf-8-sig")


def attributes(text):
    """The attributes of each element by the names along the tree; strict in the dialect."""
    lines = text.splitlines()
    tokens = dict(re.findall(r"(\w+): (\S+)", lines[0]))
    assert tokens == {"start": "NEW", "end": "END", "name_end": ":=", "sep": "&end&"}
    found, above = {}, []
    for line in lines[1:]:
        words = line.strip()
        if words.startswith("NEW "):
            above.append(words[4:])
        elif words == "END":
            above.pop()
        else:
            key, end, value = words.partition(":= ")
            assert end
            assert value
            assert "&end&" not in value
            assert ":=" not in value
            found.setdefault("/".join(above), {})[key] = value
    assert above == []
    return found


def test_attributes_stand_at_the_nodes_of_the_tree(tmp_path):
    found = attributes(write_att(plant(), tmp_path / "a.att").read_text(encoding="utf-8"))
    assert found == {
        "Skid/Valve/Body": {
            ":CADGRAPH-GROUP": "Valve assembly",
            ":CADGRAPH-NAME": "valve body",
            ":CADGRAPH-CONFIDENCE": "0.800",
            ":CADGRAPH-STATE": "sure",
            ":CADGRAPH-PART": "part-0",
            ":CADGRAPH-UNIT": "V-001",
        },
        "Skid/Valve/Bolt": {**found["Skid/Valve/Body"]},
        "Skid/Pipe": {
            ":CADGRAPH-GROUP": "Pipe assembly",
            ":CADGRAPH-CONFIDENCE": "0.500",
            ":CADGRAPH-STATE": "likely",
            ":CADGRAPH-PART": "part-1",
        },
    }


def test_elements_go_by_their_own_names_where_they_are_known(tmp_path):
    names = {"/Skid": "/SKID-1", "/Skid/Pipe": "PIPE 1 of /SKID-1"}
    found = attributes(write_att(plant(), tmp_path / "a.att", names).read_text(encoding="utf-8"))
    assert set(found) == {"/SKID-1/Valve/Body", "/SKID-1/Valve/Bolt", "/SKID-1/PIPE 1 of /SKID-1"}


def test_primitives_of_a_node_speak_for_it_the_largest_first(tmp_path):
    flange = graphs.label("Pipe assembly", "flange")
    parts = (
        graphs.part(0, "/B/primitive_1", label=PIPE, area=2.0),
        graphs.part(1, "/B/primitive_2", label=flange, area=3.0),
        graphs.part(2, "/B/Elbow", label=flange),
        graphs.part(3, "/primitive_7", label=PIPE),
    )
    found = attributes(write_att(graphs.graph(parts), tmp_path / "a.att").read_text(encoding="utf-8"))
    assert {node: said[":CADGRAPH-NAME"] for node, said in found.items()} == {
        "B": "flange",
        "B/Elbow": "flange",
        "primitive_7": "pipe",
    }


def test_names_with_tokens_or_line_breaks_stay_on_their_line(tmp_path):
    graph = graphs.graph((graphs.part(0, "/a\nEND\n/b := c &end& d", label=PIPE),))
    found = attributes(write_att(graph, tmp_path / "a.att").read_text(encoding="utf-8"))
    assert set(found) == {"a END/b c d"}


def test_a_deep_tree_does_not_blow_up_the_file(tmp_path):
    graph = graphs.graph((graphs.part(0, "/a" * 5000, label=PIPE),))
    assert write_att(graph, tmp_path / "a.att").stat().st_size < 1_000_000


def test_attributes_of_others_are_not_written_over(tmp_path):
    (tmp_path / "plant.att").write_text("CADC_Attributes_File v1.0 , start: NEW\nNEW /A\nEND\n", encoding="utf-8")
    with pytest.raises(OutputError, match="not written by cadgraph"):
        write_att(plant(), tmp_path / "plant.att")
    own = write_att(plant(), tmp_path / "own.att")
    before = own.read_bytes()
    assert write_att(plant(), own).read_bytes() == before


def test_an_empty_graph_gives_files_that_say_nothing(tmp_path):
    assert list(mesh_labels(graphs.graph())) == []
    assert attributes(write_att(graphs.graph(), tmp_path / "a.att").read_text(encoding="utf-8")) == {}
    write_att(graphs.graph(), tmp_path / "a.att")
