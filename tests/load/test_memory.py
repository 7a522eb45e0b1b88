"""How much memory reading may take."""

from __future__ import annotations

import sys

import pytest

from cadgraph._io.limits import most_unpacked
from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load.sandbox.isolation import read_isolated
from cadgraph.load.sandbox.memory import allowed_bytes
from cadgraph.load.step_census import occurrences


def loader(tmp_path, monkeypatch, body):
    (tmp_path / "hungry_loader.py").write_text(f"import numpy as np\ndef read(path, config):\n    {body}\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    return "hungry_loader"


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere no system holds a process to it")
def test_reading_is_held_to_the_memory_that_is_set(tmp_path, monkeypatch):
    # Nothing of it is ever touched.
    module = loader(tmp_path, monkeypatch, "np.empty(3_000_000_000, np.uint8); raise RuntimeError('it had enough')")
    with pytest.raises(LoadError, match=r"a\.usd: there is not enough memory to read it within 2 GB; .*load\.memory"):
        read_isolated(module, tmp_path / "a.usd", "a.usd", LoadConfig(memory=2.0))
    with pytest.raises(LoadError, match="it had enough"):
        read_isolated(module, tmp_path / "a.usd", "a.usd", LoadConfig(memory=8.0))


def test_what_is_set_counts_else_what_the_machine_has():
    assert allowed_bytes(2.5) == 2_500_000_000
    has = allowed_bytes(None)
    assert has is None or has >= 1 << 30


def test_archives_may_unpack_by_their_size():
    assert most_unpacked(1000, 1 << 30) == (16 << 20) + 40_000
    assert most_unpacked(1 << 40, 1 << 30) == 1 << 30


def test_occurrences_of_nested_assemblies_are_counted():
    # Three in two in one: 1 at the top, 2 below it, 3 in each of these.
    uses = [(1, 2)] * 2 + [(2, 3)] * 3
    text = "\n".join(
        f"#{i + 9}=NEXT_ASSEMBLY_USAGE_OCCURRENCE('{i}','it''s',$,#{a},#{b},$);" for i, (a, b) in enumerate(uses)
    )
    assert occurrences(text.encode()) == 1 + 2 + 2 * 3
    assert occurrences(b"") == 0


def test_assemblies_in_a_circle_are_counted_once():
    text = "#9=NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#1,#2,$);#8=NEXT_ASSEMBLY_USAGE_OCCURRENCE('','','',#2,#1,$);"
    assert occurrences(text.encode()) == 2
