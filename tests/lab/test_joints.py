import runpy
import sys
from pathlib import Path

import pytest

BENCHMARK = Path(__file__).parents[2] / "packages" / "cadlab" / "benchmarks" / "joints.py"


def told(monkeypatch, capsys, *arguments):
    monkeypatch.setattr(sys, "argv", [str(BENCHMARK), *arguments])
    runpy.run_path(str(BENCHMARK), run_name="__main__")
    return capsys.readouterr().out


def test_the_benchmark_of_joints_runs_on_a_slice(monkeypatch, capsys):
    slice_ = ("--presets", "riser", "--styles", "bim", "--defects", "gaskets")
    text = told(monkeypatch, capsys, *slice_).splitlines()
    lines = [line.strip("| ").split(" | ") for line in text if line.startswith("|")]
    assert lines[0] == ["joint", "score", "joints", "mean score", "meet in truth"]
    made = {
        score: (int(count), float(mean), float(right))
        for what, score, count, mean, right in lines[2:]
        if what == "made"
    }
    assert sum(count for count, _, _ in made.values()) > 50
    for score, (_, mean, right) in made.items():
        low, high = (float(bound) for bound in score.split("-"))
        assert low <= mean <= high
        assert right > 0.9


def test_scores_are_counted_by_bins_each_with_its_share_that_is_right():
    rows = runpy.run_path(str(BENCHMARK))["rows"]
    found = [(True, 0.95, True), (True, 0.93, False), (True, 1.0, True), (False, 0.05, False)]
    assert rows(found) == [
        ["made", "0.90-0.97", 2, "0.940", "0.500"],
        ["made", "0.99-1.00", 1, "1.000", "1.000"],
        ["not made", "0.00-0.10", 1, "0.050", "0.000"],
    ]


def test_an_unknown_style_is_refused_with_those_there_are(monkeypatch, capsys):
    with pytest.raises(SystemExit):
        told(monkeypatch, capsys, "--styles", "badly")
    assert "plant-design" in capsys.readouterr().err
