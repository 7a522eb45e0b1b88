"""Training end to end on two tiny plants: that every step still fits the next, not that much is learnt."""

from pathlib import Path

import numpy as np
import pytest

import cadgraph
from cadgraph.labelers.embedded.labeler import EmbeddedLabeler
from cadgraph.labelers.embedded.model import Model, default_model, read_model, write_model
from cadgraph.model.vocabulary import default_vocabulary
from cadlab.training.example import Example
from cadlab.training.figure import answer, score
from cadlab.training.samples import Sample, build_samples

LESSONS = (Sample("riser", 0, "game"), Sample("fasteners", 0))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("plants")


@pytest.fixture(scope="module")
def examples(folder):
    return build_samples(LESSONS, folder)


def test_examples_carry_names_of_the_vocabulary(examples):
    vocabulary = default_vocabulary()
    for example in examples:
        n = len(example.label)
        assert n > 10
        assert all(vocabulary.holds(*label.split("/")) for label in example.label.tolist())
        assert {len(getattr(example, name)) for name in ("shape", "places", "family", "style", "ground")} == {n}
        assert example.shape.max() < len(example.forms) == len(example.sizes)


def test_plants_that_were_built_before_are_read_as_they_were(examples, folder):
    written = sorted(folder.iterdir())
    again = build_samples(LESSONS, folder)
    assert sorted(folder.iterdir()) == written
    for a, b in zip(examples, again, strict=True):
        for name in Example.__annotations__:
            np.testing.assert_array_equal(getattr(a, name), getattr(b, name))


def test_the_model_in_the_package_answers_for_examples(examples):
    model = default_model()
    scores = score(answer(model, examples[:1]), model.threshold)
    assert scores.parts == int((~examples[0].ground).sum())
    assert scores.name > 0.7


def test_two_plants_are_learnt_and_labelled_by_the_file_that_was_written(examples, tmp_path):
    torch = pytest.importorskip("torch")
    from cadlab.training.fit import Recipe, fit

    classes = sorted({str(name) for example in examples for name in example.label})
    recipe = Recipe(hidden=32, width=16, talk=8, rounds=1, epochs=60, batch=2, dropout=0.0, noise=0.05, rate=0.02)
    torch.set_num_threads(1)
    losses = []
    network = fit(examples, classes, recipe, 0, losses.append)
    assert len(losses) == recipe.epochs
    write_model(Model((network,), tuple(classes), 1.0, 0.3, 0.3, 0.6, {"plants": 2}), tmp_path / "model.npz")
    model = read_model(tmp_path / "model.npz")
    assert model.classes == tuple(classes)
    assert score(answer(model, examples), model.threshold).name > 0.8
    graph = cadgraph.build(LESSONS[0].plant().scene(), labeler=EmbeddedLabeler(model))
    named = [part for part in graph.parts() if part.label is not None]
    assert len(named) > 0.5 * len(graph.parts())
    assert {f"{part.label.group}/{part.label.name}" for part in named} <= set(classes)


def test_the_course_trains_what_the_package_holds():
    pytest.importorskip("torch")
    from cadlab.training import __main__ as command
    from cadlab.training import course

    assert command._MODEL.is_file()
    assert list(command._MODELLED.glob("*/*/scene.truth.json"))
    for package, pattern in course._MAKERS:
        assert list(Path(package.__file__).parent.glob(pattern)), f"no file is {pattern}"
    assert len(course.source_digest()) == 8
    assert set(default_model().classes) == set(course.known_classes())
