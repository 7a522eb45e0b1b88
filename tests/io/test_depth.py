import pytest

from cadgraph._io.depth import MOST_LEVELS, is_too_deep
from cadgraph.errors import FormatError
from cadgraph.model.graph import SceneGraph
from cadgraph.model.truth import Truth


def nested(n, kind=list):
    value = kind()
    for _ in range(n - 1):
        value = [value] if kind is list else {"a": value}
    return value


@pytest.mark.parametrize("kind", [list, dict])
def test_levels_are_counted(kind):
    assert not is_too_deep(nested(MOST_LEVELS, kind))
    assert is_too_deep(nested(MOST_LEVELS + 2, kind))
    assert is_too_deep(nested(5000, kind))
    assert not is_too_deep(3)


@pytest.mark.parametrize("read", [SceneGraph.from_json, Truth.from_json])
def test_files_of_many_levels_are_refused_by_name(read):
    content = {"format": "cadgraph", "version": 1, "unknown": nested(300)}
    for form in ("cadgraph", "cadgraph-truth", "cadgraph-graph"):
        for version in range(1, 20):
            with pytest.raises(FormatError, match=r"^a\.json: ") as caught:
                read({**content, "format": form, "version": version}, "a.json")
            if "levels" in str(caught.value):
                return
    raise AssertionError("never looked at")
