import pytest

import plates
import shapes
from cadgraph.labelers.lvlm.repair import repair
from cadgraph.model.labels import Label
from cadgraph.model.scene import Scene

NEAR = {0: (1, 2)}


def repaired(thickness, name, near=NEAR, source="lvlm", diameter=0.1):
    meshes = [shapes.cylinder(diameter, thickness), shapes.box(), shapes.sphere()]
    parts = plates.parts_of(Scene.from_meshes(meshes))
    labels = [Label("Pipe assembly", name, 0.7, source, {"model": "m"}), None, None]
    return repair(labels, parts, near, plates.VOCABULARY)[0]


@pytest.mark.parametrize(
    ("thickness", "name", "result"),
    [(0.003, "gasket", "gasket"), (0.02, "gasket", "flange"), (0.02, "flange", "flange"), (0.003, "flange", "gasket")],
)
def test_thickness_tells_gaskets_from_flanges(thickness, name, result):
    assert repaired(thickness, name).name == result


@pytest.mark.parametrize(("thickness", "result"), [(0.0064, "gasket"), (0.0066, "flange"), (0.0091, "flange")])
def test_both_sides_of_the_greatest_thickness(thickness, result):
    assert repaired(thickness, "flange").name == result


def test_a_thin_flange_that_touches_nothing_stays_one():
    assert repaired(0.003, "flange", near={}).name == "flange"


def test_what_was_changed_says_why_and_what_it_was():
    label = repaired(0.02, "gasket")
    assert label.source == "context"
    assert (label.evidence.before.group, label.evidence.before.name) == ("Pipe assembly", "gasket")
    assert "20.0 mm" in label.evidence.why
    assert label.evidence.model == "m"


def test_labels_of_others_are_left_alone():
    assert repaired(0.02, "gasket", source="geometry").name == "gasket"
