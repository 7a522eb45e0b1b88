import importlib
import sys

import pytest

from cadgraph._io.moved import MOVED
from cadgraph.model.labels import Label
from cadgraph.session.correct import amend


@pytest.mark.parametrize("name", MOVED)
def test_old_names_of_modules_work_with_a_warning(name, monkeypatch):
    monkeypatch.delitem(sys.modules, name, raising=False)
    with pytest.warns(DeprecationWarning, match=f"{name} is now"):
        importlib.import_module(name)
    del sys.modules[name]


def test_their_names_are_the_new_ones(monkeypatch):
    monkeypatch.delitem(sys.modules, "cadgraph.parts", raising=False)
    monkeypatch.delitem(sys.modules, "cadgraph.amendment", raising=False)
    with pytest.warns(DeprecationWarning, match="is now"):
        parts = importlib.import_module("cadgraph.parts")
    with pytest.warns(DeprecationWarning, match="is now"):
        amendment = importlib.import_module("cadgraph.amendment")
    assert amendment.amend is amend
    assert parts.Label is Label
    with pytest.raises(AttributeError, match="nothing_such"):
        _ = parts.nothing_such


def test_what_never_was_is_not_found():
    with pytest.raises(ModuleNotFoundError, match="nothing_such"):
        importlib.import_module("cadgraph.nothing_such")
