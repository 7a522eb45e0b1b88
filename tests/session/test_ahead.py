import subprocess
import sys
import threading

import pytest

from cadgraph.session.ahead import imported_meanwhile
from cadgraph.session.run import _NEEDED


def test_modules_are_there_when_the_block_ends(tmp_path, monkeypatch):
    (tmp_path / "comes_later.py").write_text("VALUE = 7\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "comes_later", raising=False)
    with imported_meanwhile("no_such_module_anywhere", "comes_later"):
        pass
    assert sys.modules["comes_later"].VALUE == 7


def test_what_goes_wrong_in_the_block_comes_through_and_leaves_no_thread():
    before = threading.active_count()
    with pytest.raises(KeyError), imported_meanwhile("json"):
        raise KeyError("here")
    assert threading.active_count() == before


def test_a_run_needs_what_is_imported_ahead_and_reading_does_not():
    code = f"""
import sys, cadgraph.session.run
assert not set({_NEEDED!r}) & set(sys.modules)
assert not {{"numba", "scipy", "pxr", "networkx"}} & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", code], check=True)
