import inspect

import pytest

from cadgraph import errors
from cadgraph.errors import CadGraphError, FormatError, LoadError, MissingExtra


@pytest.mark.parametrize("name", errors.__all__)
def test_every_error_is_a_cadgraph_error(name):
    assert issubclass(getattr(errors, name), CadGraphError)


def test_the_tree_in_the_docstring_is_the_tree():
    defined = {name for name, one in inspect.getmembers(errors, inspect.isclass) if one.__module__ == errors.__name__}
    assert defined == set(errors.__all__)
    assert all(name in (errors.__doc__ or "") for name in defined)


def test_a_missing_extra_says_how_to_install_it():
    error = MissingExtra("reading STEP files", "cad")
    told = "reading STEP files needs an extra: in the checkout of cadgraph, pip install '.[cad]'"
    assert str(error) == told
    assert error.extra == "cad"


def test_messages_are_one_line_whatever_they_quote():
    assert str(LoadError("a.usd: 'x\ny\x1b[2J\ufeff' is no unit; give m")) == "a.usd: 'x y [2J ' is no unit; give m"
    long = str(FormatError("graph.json: " + "x" * 10_000 + "; build the graph anew"))
    assert len(long) == 2_000
    assert long.startswith("graph.json: xxx")
    assert long.endswith("xxx; build the graph anew")


def test_errors_keep_what_is_no_text():
    assert CadGraphError("a", 3).args == ("a", 3)
