import subprocess
import sys
import threading

import pytest

from cadgraph.session.ahead import imported_meanwhile, worked_out_meanwhile
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


def test_outcome_is_handed_over_once():
    with worked_out_meanwhile(lambda checkpoint: "found") as outcome:
        assert outcome() == "found"
        with pytest.raises(IndexError):
            outcome()


def test_error_of_the_work_is_raised_where_the_outcome_is_wanted():
    def act(checkpoint):
        raise MemoryError("no room")

    with worked_out_meanwhile(act) as outcome, pytest.raises(MemoryError, match="no room"):
        outcome()
    with worked_out_meanwhile(act):
        pass  # nobody asked


def test_work_that_nobody_waits_for_ends_at_its_next_checkpoint():
    before, began = threading.active_count(), threading.Event()

    def act(checkpoint):
        began.set()
        while True:
            checkpoint()

    def block():
        with worked_out_meanwhile(act):
            began.wait()
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        block()
    assert threading.active_count() == before
