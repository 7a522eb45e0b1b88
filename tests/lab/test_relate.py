import runpy
import sys
from pathlib import Path

import pytest

BENCHMARK = Path(__file__).parents[2] / "packages" / "cadlab" / "benchmarks" / "relate.py"


def told(monkeypatch, capsys, *arguments):
    monkeypatch.setattr(sys, "argv", [str(BENCHMARK), *arguments])
    runpy.run_path(str(BENCHMARK), run_name="__main__")
    return capsys.readouterr().out


def test_the_benchmark_of_relations_runs_on_a_slice(monkeypatch, capsys):
    slice_ = ("--presets", "riser", "--styles", "bim", "--modes", "true", "--defects", "none", "gaskets", "--cases")
    lines = told(monkeypatch, capsys, *slice_).splitlines()
    cells = [line.strip("| ").split(" | ") for line in lines if line.startswith("| ")]
    assert [row[0] for row in cells] == ["labels", "true", "defect", "none", "gaskets", "labels", "true", "true"]
    assert [row[1:3] for row in cells[-2:]] == [["none", "bim"], ["gaskets", "bim"]]


def test_an_unknown_defect_is_refused_with_those_there_are(monkeypatch, capsys):
    with pytest.raises(SystemExit):
        told(monkeypatch, capsys, "--defects", "badly")
    assert "setback" in capsys.readouterr().err
