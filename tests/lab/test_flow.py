import runpy
import sys
from pathlib import Path

BENCHMARK = Path(__file__).parents[2] / "packages" / "cadlab" / "benchmarks" / "flow.py"


def told(monkeypatch, capsys, *arguments):
    monkeypatch.setattr(sys, "argv", [str(BENCHMARK), *arguments])
    monkeypatch.syspath_prepend(str(BENCHMARK.parent))
    runpy.run_path(str(BENCHMARK), run_name="__main__")
    return capsys.readouterr().out


def test_the_benchmark_of_flow_runs_on_a_slice(monkeypatch, capsys):
    slice_ = ("--presets", "loop", "--styles", "bim", "--labels", "true", "--defects", "none", "one", "--reasons")
    lines = told(monkeypatch, capsys, *slice_).splitlines()
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("| true")]
    assert [row[1:3] for row in rows] == [["**all**", "**all**"], ["none", "bim"], ["one", "bim"]]
    for row in rows:
        certain, found, wrong = int(row[4]), int(row[5]), int(row[7])
        stated, right = int(row[10]), int(row[11])
        assert found >= 0.85 * certain > 0
        assert wrong == 0
        assert stated == right > 0
    assert any(line.startswith("- true: all of driven by the pumps") for line in lines)
    assert "Python" in lines[0]
