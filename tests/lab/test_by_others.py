"""Plants by others, measured with their true labels: what relations reach there stays reached."""

import importlib.util
import sys
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).parents[2] / "packages" / "cadlab" / "benchmarks"


@pytest.fixture(scope="module")
def by_others():
    """The benchmark as a module; it imports another one beside it."""
    sys.path.insert(0, str(BENCHMARKS))
    try:
        spec = importlib.util.spec_from_file_location("by_others", BENCHMARKS / "by_others.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        yield module
    finally:
        sys.path.remove(str(BENCHMARKS))


# Pairs along the pipes that may be missing and that may be too many, of those of each plant.
ALLOWED = {
    "amine_unit": (0, 0), "boiler_house": (1, 1), "cleaning_in_place": (3, 1), "compressed_air": (0, 0),
    "dosing_and_cooling": (0, 0), "filter_station": (3, 0), "fuel_oil": (0, 0), "heating_substation": (0, 0),
    "pasteuriser": (2, 0), "pump_test_stand": (2, 0), "slurry": (5, 0), "solvent_recovery": (0, 0),
    "water_skid": (1, 0), "wellhead": (1, 0),
}  # fmt: skip


SHORT = ("amine_unit", "boiler_house", "cleaning_in_place", "compressed_air", "pasteuriser", "water_skid")
"""The smaller ones; each of the others takes six seconds or more."""


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[] if name in SHORT else [pytest.mark.long]) for name in ALLOWED]
)
def test_relations_of_plants_by_others_hold_with_true_labels(name, by_others):
    counts = by_others.measured((BENCHMARKS / "others" / name, "true"))
    missing, extra = ALLOWED[name]
    assert counts["unsafe"] == 0
    assert counts["units that are none"] == 0
    assert counts["connections right"] >= counts["connections"] - missing
    assert counts["connections that are none"] <= extra


def test_all_plants_by_others_are_measured(by_others):
    assert [plant.name for plant in by_others.plants_in(by_others.OTHERS)] == list(ALLOWED)


def test_a_folder_without_a_truth_is_told(by_others, tmp_path):
    with pytest.raises(SystemExit, match=r"no scene\.truth\.json below it"):
        list(by_others.plants_in(tmp_path))


@pytest.mark.parametrize("scenes", [(), ("scene.usda", "scene.obj")])
def test_a_plant_has_one_scene(by_others, tmp_path, scenes):
    (tmp_path / "scene.truth.json").write_text("{}", encoding="utf-8")
    for name in scenes:
        (tmp_path / name).touch()
    with pytest.raises(SystemExit, match=f"{len(scenes)} files are called scene"):
        by_others.measured((tmp_path, "true"))
