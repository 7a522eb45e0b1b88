import shutil
from pathlib import Path

import numpy as np
import pytest

from cadgraph.session.run import run
from cadplants import PRESETS, STYLES, make, write_usd
from cadplants.model.family import as_assembly
from cadplants.presets.taste import ALL_FAMILIES
from golden_digest import Records, of_components, of_graph

IN_STYLES = ("plant-design", "bim", "game")
LARGE = ("assortment", "field", "station")
QUICK = {("riser", "plant-design"), ("pumps", "game")}
REAL = Path(__file__).parent / "data"
FILES = sorted(
    path.relative_to(REAL).as_posix()
    for path in REAL.rglob("*")
    if path.suffix in (".usda", ".usdc", ".usd", ".step", ".stp")
)


@pytest.fixture(scope="module")
def graphs(request):
    return Records("graphs", request.config.getoption("--renew-golden"))


@pytest.fixture(scope="module")
def families(request):
    return Records("families", request.config.getoption("--renew-golden"))


@pytest.fixture(scope="module")
def presets(request):
    return Records("presets", request.config.getoption("--renew-golden"))


def marks_of(preset, style):
    if (preset, style) in QUICK:
        return []
    # Each preset in one style, and each style with a third of the presets.
    first = IN_STYLES[list(PRESETS).index(preset) % len(IN_STYLES)]
    return [pytest.mark.slow] if style == first and preset not in LARGE else [pytest.mark.slow, pytest.mark.long]


def build(source, name, graphs):
    outcome = run(source, "out", report=False)
    graphs.check(name, of_graph(outcome.files["graph"], outcome.files["labels"]))


@pytest.mark.parametrize(
    ("preset", "style"),
    [pytest.param(preset, style, marks=marks_of(preset, style)) for preset in PRESETS for style in IN_STYLES],
)
def test_graphs_of_generated_plants_stay_as_they_are(preset, style, graphs, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_usd(make(preset, 0, style), Path("plant.usdc"))
    build("plant.usdc", f"{preset} {style}", graphs)


@pytest.mark.parametrize("file", FILES)
def test_graphs_of_real_files_stay_as_they_are(file, graphs, tmp_path, monkeypatch):
    # The source's path stands in the graph and in the layer, and what USD files refer to lies beside them.
    shutil.copytree(REAL, tmp_path / "data")
    monkeypatch.chdir(tmp_path / "data")
    outcome = run(file, tmp_path / "out", report=False)
    graphs.check(f"file {file}", of_graph(outcome.files["graph"], outcome.files["labels"]))


def family_digest(family):
    style, rng = STYLES["mechanical"], np.random.default_rng(7)
    dn = family.sizes[len(family.sizes) // 2]
    model = family.build(dn, style, rng, 1.1) if family.place == "carrier" else family.build(dn, style, rng)
    return of_components(as_assembly(family, model, style, "X-1").components)


@pytest.mark.slow
def test_shapes_of_families_stay_as_they_are(families):
    families.check_all({family.name: family_digest(family) for family in ALL_FAMILIES.values()})


@pytest.mark.slow
def test_shapes_of_presets_in_their_own_style_stay_as_they_are(presets):
    presets.check_all(
        {f"{name} {seed}": of_components(make(name, seed).components) for name in PRESETS for seed in (0, 3)}
    )


def test_every_record_still_has_its_test(graphs, families):
    names = {f"{preset} {style}" for preset in PRESETS for style in IN_STYLES} | {f"file {file}" for file in FILES}
    assert set(graphs.known) == names
    assert set(families.known) == set(ALL_FAMILIES)
