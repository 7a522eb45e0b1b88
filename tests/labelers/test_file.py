"""What a file says of parts, joined with what a labeler says."""

from dataclasses import replace

import numpy as np
import pytest

import shapes
from cadgraph.config import Config, LabelConfig
from cadgraph.labelers.base import Labeling, label_parts
from cadgraph.labelers.file import lay_file
from cadgraph.labelers.precedence import settle_labels
from cadgraph.model.facts import Fact
from cadgraph.model.given_labels import GivenLabel
from cadgraph.model.labels import Guess, Label
from cadgraph.model.probabilities import Probabilities
from cadgraph.model.scene import Scene
from cadgraph.model.vocabulary import Group, Vocabulary, default_vocabulary
from cadgraph.pipeline import analyse

VOCABULARY = default_vocabulary()
USE = LabelConfig(use_metadata=True)
PIPE, VALVE = ("Pipe assembly", "pipe"), ("Valve assembly", "valve")


def scene_of(paths, facts=()):
    meshes = [shapes.box(center=(3.0 * k, 0, 0)) for k in range(len(paths))]
    return replace(Scene.from_meshes(meshes, paths), facts=tuple(Fact(*fact) for fact in facts))


class Sure:
    """A labeler that says the same of every part, with the rest spread over some other labels."""

    def __init__(self, said, confidence, other=(), least=0.5):
        self.said, self.confidence, self.other, self.least = said, confidence, dict(other), least

    def label(self, parts, contacts, vocabulary):
        rows = {self.said: self.confidence, **self.other}
        guesses = tuple(Guess(*said, share) for said, share in sorted(rows.items(), key=lambda row: -row[1]))
        label = Label(*self.said, self.confidence, "geometry", {"why": "its form"}, guesses)
        values = np.tile(np.array(list(rows.values())), (parts.n_parts, 1))
        return Labeling.judge([label] * parts.n_parts, self.least, Probabilities(tuple(rows), values))


def joined(scene, labeler, config=USE, vocabulary=VOCABULARY):
    analysis = analyse(scene, Config().replace({"ground.find": "none"}))
    said = label_parts(labeler, analysis.parts, analysis.contacts, vocabulary, config)
    return lay_file(said, analysis, vocabulary, config), said, analysis


def first(*args, **kwargs):
    return joined(*args, **kwargs)[0].labels[0]


def test_among_names_that_are_filed_alike_geometry_decides():
    scene = scene_of(["/a/x"], [("/a/x", "predefined", "JUNCTION", "IfcPipeFitting.PredefinedType")])
    outlet = ("Pipe assembly", "branch outlet")
    label = first(scene, Sure(outlet, 0.9, {("Pipe assembly", "tee"): 0.05}))
    assert (label.said, label.source) == (outlet, "geometry")
    assert first(scene, Sure(PIPE, 0.4, {outlet: 0.3, ("Pipe assembly", "tee"): 0.3})).said == ("Pipe assembly", "tee")


def test_a_class_labels_what_nobody_knows():
    label = first(scene_of(["/a/x"], [("/a/x", "class", "IfcPipeSegment", "IfcPipeSegment")]), None)
    assert (label.said, label.source) == (PIPE, "file")
    assert label.confidence == pytest.approx(0.67, abs=0.005)  # a nipple is filed so, too
    assert (label.evidence.key, label.evidence.text, label.evidence.rule) == ("class", "IfcPipeSegment", "class of IFC")
    assert label.evidence.before is None


def test_without_being_asked_for_nothing_is_laid():
    after, before, _ = joined(
        scene_of(["/valve"], [("/valve", "class", "IfcValve", "x")]), Sure(PIPE, 0.6), LabelConfig()
    )
    assert after is before


def test_what_agrees_makes_surer_and_leaves_the_source():
    label = first(scene_of(["/x"], [("/x", "class", "IfcPipeSegment", "x")]), Sure(PIPE, 0.6, {VALVE: 0.3}))
    assert (label.said, label.source) == (PIPE, "geometry")
    assert label.confidence > 0.9
    assert label.evidence.why == "its form"
    assert label.evidence.to_json()["file"] == {
        "key": "class", "text": "IfcPipeSegment", "rule": "class of IFC", "without": 0.6,
    }  # fmt: skip


def test_the_file_names_the_part_where_both_see_one_group():
    scene = scene_of(["/x"], [("/x", "class", "TUBI", "att TYPE")])
    label = first(scene, Sure(("Pipe assembly", "elbow"), 0.95, {PIPE: 0.01}))
    assert (label.said, label.source) == (PIPE, "file")
    assert label.evidence.before.name == "elbow"
    assert "elbow" in label.evidence.why


def test_a_name_alone_does_not_overrule_a_sure_labeler():
    label = first(scene_of(["/Rohr 7"]), Sure(("Pipe assembly", "elbow"), 0.95, {PIPE: 0.01}))
    assert label.said == ("Pipe assembly", "elbow")
    assert first(scene_of(["/Rohr 7"]), Sure(("Pipe assembly", "elbow"), 0.6, {PIPE: 0.35})).said == PIPE


def test_a_device_leaves_open_which_piece_a_part_is():
    scene = scene_of(["/x"], [("/x", "class", "VALV", "att TYPE")])
    assert first(scene, Sure(("Valve assembly", "handwheel"), 0.9, {VALVE: 0.02})).said == (
        "Valve assembly",
        "handwheel",
    )
    assert first(scene, Sure(("Valve assembly", "handwheel"), 0.4, {VALVE: 0.3})).said == VALVE


@pytest.mark.parametrize(("sure", "won"), [(0.5, "file"), (0.9995, "geometry")])
def test_of_two_groups_the_more_probable_counts_and_the_other_is_told(sure, won):
    scene = scene_of(["/x", "/y"], [(p, "class", "IfcColumn", "x") for p in ("/x", "/y")])
    after, _, _ = joined(scene, Sure(PIPE, sure, {("Structural element", "column"): 0.0004}))
    assert after.labels[0].group == ("Structural element" if won == "file" else "Pipe assembly")
    (told,) = [one for one in after.diagnostics if one.code == "file-disagrees"]
    assert "Structural element/column" in told.message
    assert "Pipe assembly/pipe" in told.message
    assert told.meshes == ("/x", "/y")


def test_a_generic_class_leans_and_never_disagrees():
    scene = scene_of(["/x"], [("/x", "class", "IfcPipeFitting", "x")])
    after, _, _ = joined(scene, Sure(VALVE, 0.9, {("Pipe assembly", "tee"): 0.05}))
    assert after.labels[0].said == VALVE
    assert after.labels[0].confidence < 0.9
    assert after.diagnostics == ()


def test_a_name_that_repeats_the_class_is_no_second_witness():
    one = scene_of(["/x"], [("/x", "class", "IfcColumn", "x")])
    two = scene_of(["/x"], [("/x", "class", "IfcColumn", "x"), ("/x", "name", "column 3", "x")])
    class_only, name_only = scene_of(["/x"], [("/x", "class", "IfcColumn", "x")]), scene_of(["/column"])
    labeler = Sure(PIPE, 0.9, {("Structural element", "column"): 0.002})

    def odds(scene):
        share = joined(scene, labeler)[0].probabilities
        row = dict(zip(share.classes, share.values[0], strict=True))
        return row["Structural element", "column"] / row[PIPE]

    base = 0.95 * 0.002 / (0.95 * 0.9)
    assert odds(two) > odds(one)
    assert odds(two) < odds(class_only) * odds(name_only) / base / 5


def test_facts_of_a_node_above_one_part_are_that_parts():
    scene = scene_of(["/plant/P1/mesh_0", "/plant/x"], [("/plant/P1", "class", "TUBI", "att TYPE")])
    after, _, _ = joined(scene, None)
    assert [label and label.name for label in after.labels] == ["pipe", None]


def test_facts_of_a_node_above_several_parts_label_none_of_them():
    scene = scene_of(["/plant/P1/a", "/plant/P1/b"], [("/plant/P1", "class", "TUBI", "att TYPE")])
    assert joined(scene, None)[0].labels == (None, None)


@pytest.mark.parametrize("path", ["/flange_2/mesh_0", "/plant/Flansch/Geo_1/Body"])
def test_names_of_steps_above_count_where_they_hold_nothing_else(path):
    other = "/plant/other" if path.startswith("/plant") else "/other"
    after, _, _ = joined(scene_of([path, other]), None)
    assert (after.labels[0].name, after.labels[0].evidence.key) == ("flange", "name")
    assert after.labels[0].confidence == pytest.approx(0.6, abs=0.01)
    assert after.labels[1] is None


def test_what_the_vocabulary_lacks_is_left_out_and_told():
    mine = Vocabulary({"Pipe assembly": Group(("pipe",), connector=True), "Tank": Group(("tank",), unit="tank")})
    scene = scene_of(["/x", "/pump"], [("/x", "class", "IfcPump", "x")])
    after, _, _ = joined(scene, None, vocabulary=mine)
    assert after.labels == (None, None)
    (told,) = after.diagnostics
    assert (told.code, told.meshes) == ("file-unknown-label", ("/pump", "/x"))
    assert "Pump unit/pump" in told.message


def test_what_the_user_knows_beats_the_file():
    scene = scene_of(["/x"], [("/x", "class", "TUBI", "att TYPE")])
    after, said, analysis = joined(scene, None)
    settled = settle_labels(said, analysis, VOCABULARY, USE, given=[GivenLabel("/x", "Tank", "tank")])
    assert (after.labels[0].source, settled.labels[0].source) == ("file", "author")


def test_parts_of_which_the_file_says_nothing_stay_as_they_are():
    scene = scene_of(["/x", "/y"], [("/y", "class", "TUBI", "att TYPE")])
    after, before, _ = joined(scene, Sure(VALVE, 0.7, {PIPE: 0.2}))
    assert after.labels[0] is before.labels[0]
    known = [k for k, said in enumerate(after.probabilities.classes) if said in before.probabilities.classes]
    order = [before.probabilities.classes.index(after.probabilities.classes[k]) for k in known]
    assert after.probabilities.values[0, known].tolist() == before.probabilities.values[0, order].tolist()


def test_a_users_words_count(tmp_path):
    (tmp_path / "mine.yaml").write_text("labels:\n  Tank/shell: {firm: [zbx]}\n")
    config = LabelConfig(use_metadata=True, words=str(tmp_path / "mine.yaml"))
    assert first(scene_of(["/ZBX_3"]), None, config).said == ("Tank", "shell")


def test_a_label_that_is_the_files_already_is_not_weighed_twice():
    once = first(scene_of(["/x"], [("/x", "class", "TUBI", "t")]), None)

    class Former:
        def label(self, parts, contacts, vocabulary):
            return Labeling.judge([once], 0.0)

    assert first(scene_of(["/x"], [("/x", "class", "TUBI", "t")]), Former()) == once


def test_a_setting_of_old_is_read_as_the_new_one():
    with pytest.warns(DeprecationWarning, match=r"label\.use_metadata"):
        assert LabelConfig(use_names=True).use_metadata
    assert not LabelConfig(use_names=False).use_metadata
    with pytest.warns(DeprecationWarning, match=r"label\.use_metadata"):
        assert Config().replace({"label.use_names": True}).label.use_metadata
    with pytest.raises(ValueError, match="use_metadata"):
        Config().replace({"label.use_names": "yes"})


RIGHT_CLASS = {
    ("Pipe assembly", "pipe"): "IfcPipeSegment",
    ("Valve assembly", "valve"): "IfcValve",
    ("Pump unit", "pump"): "IfcPump",
    ("Tank", "tank"): "IfcTank",
    ("Structural element", "beam"): "IfcBeam",
    ("Electrical and safety", "lamp"): "IfcLamp",
}


class Often:
    """A labeler that is right as often as it is sure: by 99 % of four parts of five, by 55 % of the others."""

    def __init__(self, truth, seed):
        random = np.random.default_rng(seed)
        self.truth = truth
        self.sure = np.where(random.uniform(size=len(truth)) < 0.8, 0.99, 0.55)
        right = random.uniform(size=len(truth)) < self.sure
        said = list(RIGHT_CLASS)
        wrong = [said[(said.index(t) + 1 + int(random.integers(len(said) - 1))) % len(said)] for t in truth]
        self.said = [t if ok else w for t, ok, w in zip(truth, right, wrong, strict=True)]

    def label(self, parts, contacts, vocabulary):
        classes = tuple(RIGHT_CLASS)
        values = np.repeat((1 - self.sure)[:, None] / (len(classes) - 1), len(classes), axis=1)
        order = [int(path.rsplit("_", 1)[1]) for path in parts.scene.paths]
        for part, mesh in enumerate(order):
            values[part] = (1 - self.sure[mesh]) / (len(classes) - 1)
            values[part, classes.index(self.said[mesh])] = self.sure[mesh]
        labels = [Label(*self.said[mesh], float(self.sure[mesh]), "geometry") for mesh in order]
        return Labeling.judge(labels, 0.3, Probabilities(classes, values))


@pytest.mark.parametrize("seed", range(3))
def test_with_a_tenth_of_classes_wrong_both_are_right_more_often_than_either(seed):
    random, said = np.random.default_rng(100 + seed), list(RIGHT_CLASS)
    truth = [said[k] for k in random.integers(len(said), size=300)]
    stated = [t if random.uniform() >= 0.1 else said[int(random.integers(len(said)))] for t in truth]
    paths = [f"/mesh_{k}" for k in range(len(truth))]
    scene = scene_of(paths, [(p, "class", RIGHT_CLASS[s], "x") for p, s in zip(paths, stated, strict=True)])
    labeler = Often(truth, seed)
    both, alone, analysis = joined(scene, labeler)
    order = [int(path.rsplit("_", 1)[1]) for path in analysis.parts.scene.paths]

    def right(labels):
        return np.mean(
            [label is not None and label.group == truth[k][0] for label, k in zip(labels, order, strict=True)]
        )

    by_class = right(joined(scene, None)[0].labels)
    assert right(both.labels) >= 0.93
    assert right(both.labels) > right(alone.labels)
    assert right(both.labels) > by_class
    assert by_class > 0.85
