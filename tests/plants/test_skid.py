import json
from collections import Counter

import numpy as np
import pytest

from cadgraph.errors import OutputError
from cadgraph.model.vocabulary import default_vocabulary
from cadplants import STYLES, UsdStyle, make_skid, truth_path, write_usd
from cadplants.truth.truth_writer import truth_of
from plants.solids import touching

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def skid():
    return make_skid(0)


def test_skid_has_what_the_paper_shows(skid):
    assert 150 <= skid.n_meshes <= 400
    kinds = Counter(unit.kind for unit in skid.units)
    assert kinds == {"ball valve": 6, "globe valve": 6, "pressure gauge": 12}


def test_names_are_in_the_vocabulary(skid):
    vocabulary = default_vocabulary()
    assert all(vocabulary.holds(c.group, c.name) for c in skid.components)


def test_units_are_of_the_type_of_their_group(skid):
    types = {unit.id: unit.type for unit in skid.units}
    of_group = default_vocabulary().unit_of_group
    for component in skid.components:
        assert (types[component.unit] if component.unit else None) == of_group.get(component.group)


def test_lines_stay_apart(skid):
    pytest.importorskip("fcl")
    for a, b in touching(skid, margin=0.01):
        lines = {skid.components[a].line, skid.components[b].line} - {""}
        assert len(lines) <= 1


def test_everything_hangs_together(skid):
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    pairs = np.array(skid.contacts)
    n = skid.n_meshes
    count, _ = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), shape=(n, n)), directed=False)
    assert count == 1
    assert {component.cluster for component in skid.components} == {"skid"}


def test_it_stands_on_the_ground(skid):
    assert skid.scene().vertices[:, 2].min() == pytest.approx(0.0, abs=1e-3)


def test_connections_follow_each_line_from_end_to_end(skid):
    ids = {unit.id for unit in skid.units} | {point.id for point in skid.points}
    for line in ("L1", "L2", "L3"):
        steps = [c for c in skid.connections if c.line == line]
        assert steps[0].source == f"{line}/start"
        assert steps[-1].target == f"{line}/end"
        assert all(a.target == b.source for a, b in zip(steps, steps[1:], strict=False))
        assert all(step.length > 0 for step in steps)
        assert len(steps) == 9
    assert {c.source for c in skid.connections} | {c.target for c in skid.connections} == ids


def test_one_pipe_carries_two_gauges(skid):
    feet = [i for i, c in enumerate(skid.components) if c.name == "branch outlet"]
    below = Counter(a for a, b in skid.contacts if b in feet and skid.components[a].name == "pipe")
    assert max(below.values()) >= 2


def test_same_seed_same_plant():
    a, b = make_skid(5), make_skid(5)
    assert np.array_equal(a.scene().vertices, b.scene().vertices)
    assert truth_of(a) == truth_of(b)


def test_other_seeds_differ():
    assert not np.array_equal(make_skid(1).scene().vertices, make_skid(2).scene().vertices)


@pytest.mark.parametrize("style", STYLES.values(), ids=STYLES)
def test_every_hand_builds_it(style):
    plant = make_skid(1, style)
    assert len(plant.units) == 24
    assert plant.styles == (style.name,)


STYLES = [
    UsdStyle(),
    UsdStyle(meters_per_unit=0.01, up_axis="Y", instances="native", nested=1),
    UsdStyle(meters_per_unit=1.0, nested=0, shuffle=False, colors=False),
]


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("suffix", [".usdc", ".usda"])
def test_usd_holds_the_plant_where_it_stands(skid, tmp_path, style, suffix):
    from pxr import Usd, UsdGeom

    path = tmp_path / f"skid{suffix}"
    truth = json.loads(write_usd(skid, path, style).read_text())
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageMetersPerUnit(stage) == style.meters_per_unit
    assert UsdGeom.GetStageUpAxis(stage) == style.up_axis
    cache = UsdGeom.XformCache()
    meshes = [p for p in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies()) if p.IsA(UsdGeom.Mesh)]
    assert {str(p.GetPath()) for p in meshes} == {row["mesh"] for row in truth["meshes"]}
    for row, component in zip(truth["meshes"], skid.components, strict=True):
        mesh = stage.GetPrimAtPath(row["mesh"])
        world = np.array(cache.GetLocalToWorldTransform(mesh))
        points = np.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get(), float) @ world[:3, :3] + world[3, :3]
        points *= style.meters_per_unit
        if style.up_axis == "Y":
            points = points[:, [0, 2, 1]] * [1, -1, 1]
        np.testing.assert_allclose(points, component.vertices, atol=1e-6)


def test_names_in_the_file_give_nothing_away(skid, tmp_path):
    path = tmp_path / "skid.usda"
    write_usd(skid, path)
    text = path.read_text().lower()
    for word in ("valve", "gauge", "pipe", "flange", "bolt", "caster"):
        assert word not in text


def test_writing_twice_gives_the_same_bytes(skid, tmp_path):
    for name in ("a", "b"):
        write_usd(skid, tmp_path / name / "skid.usdc", UsdStyle(instances="mixed", polygons=0.5))
    assert (tmp_path / "a" / "skid.usdc").read_bytes() == (tmp_path / "b" / "skid.usdc").read_bytes()
    assert (tmp_path / "a" / "skid.truth.json").read_bytes() == (tmp_path / "b" / "skid.truth.json").read_bytes()


def test_truth_names_every_mesh_once(skid, tmp_path):
    truth = json.loads(write_usd(skid, tmp_path / "skid.usd").read_text())
    assert truth_path(tmp_path / "skid.usd").exists()
    assert (truth["format"], truth["version"]) == ("cadgraph-truth", 1)
    paths = [row["mesh"] for row in truth["meshes"]]
    assert len(set(paths)) == len(paths) == skid.n_meshes
    assert sorted(path for cluster in truth["clusters"] for path in cluster["meshes"]) == sorted(paths)
    assert all(set(unit["meshes"]) <= set(paths) and unit["meshes"] for unit in truth["units"])


def test_an_unknown_suffix_is_an_error(skid, tmp_path):
    with pytest.raises(ValueError, match=r"\.obj"):
        write_usd(skid, tmp_path / "skid.obj")


def test_a_folder_that_is_a_file_is_an_output_error(skid, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        write_usd(skid, tmp_path / "file" / "skid.usdc")
