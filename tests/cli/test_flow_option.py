"""Statements of flow on the command line."""

import pytest

from cadgraph.cli.options import read_flows


def test_statements_and_files_of_them_may_be_mixed(tmp_path):
    file = tmp_path / "flows.txt"
    file.write_text("# duty pump\nP-001 -> T-001\n\nT-001 -> V-003  # by gravity\n", encoding="utf-8")
    assert read_flows(["P-002 -> T-001", str(file)]) == ("P-002 -> T-001", "P-001 -> T-001", "T-001 -> V-003")


def test_what_is_neither_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"--flow .*nowhere\.txt"):
        read_flows([str(tmp_path / "nowhere.txt")])
