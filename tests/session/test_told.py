from types import SimpleNamespace as Thing

from cadgraph.model.labels import CorrectedEvidence
from cadgraph.session.told import tell_followers, tell_renamed


def part(number, match=None):
    evidence = CorrectedEvidence(why="", match=match) if match else None
    return Thing(id=f"part-{number}", label=Thing(evidence=evidence))


class Graph:
    """Units of parts, each part its own mesh."""

    def __init__(self, **units):
        self._units = [Thing(tag=tag.replace("_", "-"), parts=tuple(parts)) for tag, parts in units.items()]

    def units(self):
        return self._units

    def part(self, which):
        return Thing(meshes=(which,))


def test_followers_of_a_label_are_told_by_why_they_follow():
    named = part(0)
    exact, near, kin, other = part(1, "exact"), part(2, "near"), part(3, "kin"), part(4)
    assert tell_followers([named], [named]) == ""
    assert tell_followers([named], [named, exact]) == "1 of its shape follows"
    told = tell_followers([named], [named, exact, near, kin, other])
    assert told == "1 of its shape and 2 that look much like it follow; 1 other label changes with it"
    assert tell_followers([named, part(9)], [kin]) == "1 that looks much like them follows"


def test_units_that_are_called_otherwise_are_told_in_runs():
    before = Graph(V_007="a", V_008="b", V_009="c", V_010="d", V_012="e", P_001="f")
    merged = Graph(V_007="ab", V_008="c", V_009="d", V_010="e", P_001="f")
    assert tell_renamed(before, merged) == "V-009 to V-010 are now V-008 to V-009; V-012 is now V-010"
    assert tell_renamed(before, before) == ""
    assert tell_renamed(Graph(V_001="a"), Graph(V_4711="a"), {"V-4711"}) == ""


def test_many_scattered_tags_are_counted():
    before = Graph(**{f"V_{2 * k:03d}": f"x{k}" for k in range(1, 8)})
    now = Graph(**{f"W_{k:03d}": f"x{k}" for k in range(1, 8)})
    assert tell_renamed(before, now).endswith("; 4 more tags change")
