"""Labels by source path: as a table that is read again, and as PDMS attributes."""

from __future__ import annotations

import re

import pytest

import graphs
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError, OutputError
from cadgraph.export import export_graph, write_export
from cadgraph.export.att import write_att
from cadgraph.export.labels import mesh_labels
from cadgraph.load import load
from cadgraph.load.packing import Notes
from cadgraph.load.rvm import element_names
from cadgraph.load.rvm.attributes import find_attributes, read_attributes
from cadgraph.model.given_labels import read_labels
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import SourceRecord
from cadgraph.model.vocabulary import default_vocabulary
from rvm_files import Rvm, placed

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


def written(graph, path, names=None):
    file, _ = write_att(graph, path, names)
    return attributes(file.read_text(encoding="utf-8"))


def test_attributes_stand_at_the_nodes_of_the_tree(tmp_path):
    found = written(plant(), tmp_path / "a.att")
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
    names = {"/Skid": "/SKID-1", "/Skid/Pipe": "PIPE 1 of /SKID-1", "/Skid/Valve": "VALVE := 1 &end& x"}
    file, notes = write_att(plant(), tmp_path / "a.att", names)
    new = [line.strip()[4:] for line in file.read_text(encoding="utf-8").splitlines() if line.lstrip()[:4] == "NEW "]
    assert new == ["/SKID-1", "PIPE 1 of /SKID-1", "VALVE := 1 &end& x"]
    assert notes == ()


@pytest.mark.parametrize(
    ("name", "stands"),
    [
        ("/100-B-1/B1", True), ("VALVE 1 of BRANCH /100-B-1/B1", True), ("'quoted'", True), ('"', True), ("END", True),
        ("NEW END", True), ("Größe\u00a0µ", True), (":=", True), ("a &end& b", True),
        ("", False), (" x", False), ("x ", False), ("a\nb", False), ("a\rb", False), ("' x'", False), ("''", False),
        ("a\x00b", False), ("x" * 10_001, False),
    ],
)  # fmt: skip
def test_a_name_is_read_as_it_was_or_told(tmp_path, name, stands):
    graph = graphs.graph((graphs.part(0, "/a", label=PIPE), graphs.part(1, "/b", label=PIPE)))
    file, notes = write_att(graph, tmp_path / "a.att", {"/a": name, "/b": "/B"})
    assert [(note.code, note.meshes) for note in notes] == ([] if stands else [("changed-name", ("/a",))])
    read = read_attributes(file, Notes())
    assert len(read) == 2
    assert (name in read) == stands
    assert "/B" in read


def test_what_hangs_on_no_element_or_on_one_of_several_is_told(tmp_path):
    parts = [
        graphs.part(i, path, label=PIPE) for i, path in enumerate(("/A/primitive_1", "/B/x", "/C", "/primitive_7"))
    ]
    names = {"/A": "/SAME", "/B": "/SAME", "/C": "/C"}
    _, notes = write_att(graphs.graph(tuple(parts)), tmp_path / "a.att", names)
    assert {note.code: note.meshes for note in notes} == {
        "unmatched-mesh": ("/primitive_7",),
        "repeated-name": ("/A/primitive_1", "/B/x"),
    }


NAMED = {
    "VALVE_1": "VALVE 1 of BRANCH /100-B-1/B1",
    "ELBOW_2": "ELBOW 2 of BRANCH /100-B-1/B1",
    "Pump_1": "/Pump 1",
    "x_y": "x:=y",
}


@pytest.fixture
def model(tmp_path):
    """A line of an RVM file, its tubes on the branch itself."""
    file = Rvm().open("/SITE").open("/100-B-1").open("/100-B-1/B1")
    file.primitive(8, 50.0, 1000.0).primitive(8, 50.0, 900.0, matrix=placed((0, 0, 3)))
    for i, name in enumerate(NAMED.values()):
        file.open(name).primitive(8, 80.0, 300.0, matrix=placed((0, 0, 0.65 + 0.3 * i))).close()
    path = tmp_path / "plant.rvm"
    path.write_bytes(file.close(3).end().bytes)
    return path


def labelled(model, label=PIPE):
    scene = load(model, LoadConfig(isolate=False))
    parts = tuple(graphs.part(i, path, label=label) for i, path in enumerate(scene.paths))
    source = SourceRecord(path=str(model), sha256=scene.source.sha256, n_meshes=scene.n_meshes)
    return scene, SceneGraph(graphs.graph(parts).document.model_copy(update={"source": source}))


def test_attributes_are_found_again_by_the_reader_of_the_model(tmp_path, model):
    _, graph = labelled(model)
    written = write_export(graph, "att", model.with_suffix(".att"))
    assert written.notes == ()
    assert find_attributes(model) == model.with_suffix(".att")
    read = read_attributes(model.with_suffix(".att"), Notes())
    names = element_names(model)
    assert [names["/SITE/100-B-1/100-B-1_B1/" + step] for step in NAMED] == list(NAMED.values())
    # Tubes hang on their branch; every other mesh is an element.
    assert set(read) == {"/SITE", "/100-B-1", "/100-B-1/B1", *NAMED.values()}
    said = attributes(written.files[0].read_text(encoding="utf-8").replace("x:=y", "x"))
    assert len(said) == 1 + len(NAMED)
    assert {values[":CADGRAPH-GROUP"] for values in said.values()} == {"Pipe assembly"}


def test_a_model_is_read_the_same_with_the_attributes_beside_it(model):
    scene, graph = labelled(model)
    write_export(graph, "att", model.with_suffix(".att"))
    again, _ = labelled(model)
    assert again.paths == scene.paths
    assert again.facts == scene.facts
    assert again.diagnostics == scene.diagnostics


def test_names_come_from_paths_where_the_model_is_gone_or_another(tmp_path, model):
    _, graph = labelled(model)
    moved = model.rename(tmp_path / "moved.rvm")
    (note,) = write_export(graph, "att", tmp_path / "out").notes
    assert note.code == "names-from-paths"
    assert "not there" in note.message
    assert "\n" not in note.message
    assert write_export(graph, "att", tmp_path / "out", moved).notes == ()
    assert "NEW VALVE 1 of BRANCH /100-B-1/B1" in (tmp_path / "out/labels.att").read_text(encoding="utf-8")
    moved.write_bytes(moved.read_bytes() + bytes(4))
    with pytest.raises(LoadError, match="changed since the graph was built, or another file"):
        write_export(graph, "att", tmp_path / "out", moved)
    (note,) = write_export(plant(), "att", tmp_path / "other").notes
    assert note.message.endswith("the graph was made from no .rvm or .rev file")


def test_a_source_of_another_kind_is_refused(tmp_path):
    (tmp_path / "plant.usda").write_text("#usda 1.0", encoding="utf-8")
    graph = plant()
    graph = SceneGraph(graph.document.model_copy(update={"source": SourceRecord(path="plant.usda")}))
    with pytest.raises(LoadError, match=r"att is written for a \.rvm or \.rev file, which this is not"):
        write_export(graph, "att", tmp_path, tmp_path / "plant.usda")


def test_primitives_of_a_node_speak_for_it_the_largest_first(tmp_path):
    flange = graphs.label("Pipe assembly", "flange")
    parts = (
        graphs.part(0, "/B/primitive_1", label=PIPE, area=2.0),
        graphs.part(1, "/B/primitive_2", label=flange, area=3.0),
        graphs.part(2, "/B/Elbow", label=flange),
        graphs.part(3, "/primitive_7", label=PIPE),
    )
    found = written(graphs.graph(parts), tmp_path / "a.att")
    assert {node: said[":CADGRAPH-NAME"] for node, said in found.items()} == {
        "B": "flange",
        "B/Elbow": "flange",
        "primitive_7": "pipe",
    }


def test_names_with_tokens_or_line_breaks_stay_on_their_line(tmp_path):
    graph = graphs.graph((graphs.part(0, "/a\nEND\n/b := c &end& d", label=PIPE),))
    found = written(graph, tmp_path / "a.att")
    assert set(found) == {"a END/b c d"}


def test_a_deep_tree_does_not_blow_up_the_file(tmp_path):
    graph = graphs.graph((graphs.part(0, "/a" * 5000, label=PIPE),))
    assert write_att(graph, tmp_path / "a.att")[0].stat().st_size < 1_000_000


def test_attributes_of_others_are_not_written_over(tmp_path):
    (tmp_path / "plant.att").write_text("CADC_Attributes_File v1.0 , start: NEW\nNEW /A\nEND\n", encoding="utf-8")
    with pytest.raises(OutputError, match="not written by cadgraph"):
        write_att(plant(), tmp_path / "plant.att")
    own, _ = write_att(plant(), tmp_path / "own.att")
    before = own.read_bytes()
    assert write_att(plant(), own)[0].read_bytes() == before


def test_an_empty_graph_gives_files_that_say_nothing(tmp_path):
    assert list(mesh_labels(graphs.graph())) == []
    assert written(graphs.graph(), tmp_path / "a.att") == {}
    write_att(graphs.graph(), tmp_path / "a.att")
