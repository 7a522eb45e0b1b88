import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

import graphs
from cadgraph.model.graph import SceneGraph
from cadgraph.model.labels import Label
from cadgraph.model.records import Adjacent, GraphDocument, Site, Stated, document_schema, points


def test_records_are_frozen():
    with pytest.raises(ValidationError, match="frozen"):
        Site(id="site").id = "other"


@pytest.mark.parametrize("confidence", [0.0, 1.0])
def test_confidence_at_its_limits_is_fine(confidence):
    assert graphs.label(confidence=confidence).confidence == confidence


@pytest.mark.parametrize("confidence", [-1e-9, 1 + 1e-9, math.nan])
def test_confidence_off_its_limits_is_an_error(confidence):
    with pytest.raises(ValidationError, match="confidence"):
        graphs.label(confidence=confidence)


def test_lengths_are_finite():
    with pytest.raises(ValidationError, match="distance"):
        Adjacent(source="a", target="b", distance=math.inf, point=(0, 0, 0))


def test_a_part_needs_a_mesh():
    with pytest.raises(ValidationError, match="meshes"):
        graphs.part(0, meshes=())


def test_unknown_keys_are_kept():
    assert Label(group="Tank", confidence=1, source="human", reviewer="R. D.").model_dump()["reviewer"] == "R. D."


def test_points_are_rounded_to_a_nanometre_without_negative_zero():
    [point] = points([[-1e-12, 0.1234567894, -0.0]])
    assert point == (0.0, 0.123456789, 0.0)
    assert all(math.copysign(1, x) == 1 for x in point)


@given(st.lists(st.tuples(*[st.floats(-1e7, 1e7)] * 3), max_size=4))
def test_points_move_less_than_a_nanometre_or_two_units_of_the_last_place(rows):
    exact = np.array(rows).reshape(-1, 3)
    moved = np.abs(np.array(points(rows)).reshape(-1, 3) - exact)
    assert np.all(moved <= np.maximum(1e-9, 2 * np.spacing(np.abs(exact))))


def test_the_schema_names_every_layer_and_kind():
    schema = document_schema()
    assert schema["$schema"].startswith("https://json-schema.org/")
    assert {"nodes", "edges", "diagnostics", "source"} <= set(schema["properties"])
    layers = {d["properties"]["layer"]["const"] for d in schema["$defs"].values() if "layer" in d["properties"]}
    kinds = {
        d["properties"]["kind"]["const"] for d in schema["$defs"].values() if "const" in d["properties"].get("kind", {})
    }
    assert layers == {"site", "cluster", "part", "unit", "junction", "terminal", "system", "place"}
    assert kinds == {"contains", "adjacent", "connected", "related", "reached_from"}


def test_the_schema_allows_unknown_keys():
    schema = document_schema()
    assert all(d["additionalProperties"] is True for d in [schema, *schema["$defs"].values()])


def test_every_field_of_a_document_is_in_the_schema():
    document = graphs.valve_line(joints=(graphs.joint(),)).document
    link = Stated(first=("part-00000",), second=(), first_path="/a", second_path="/b", where="IfcRelConnectsPorts")
    data = SceneGraph(document.model_copy(update={"stated": (link,)})).to_json()
    assert set(data) == set(document_schema()["properties"]) == set(GraphDocument.model_fields)
