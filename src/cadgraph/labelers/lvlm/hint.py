"""What geometry knows about a part, in words: its form, how often it is there, what it touches."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from cadgraph.geometry.shape.analysis import shapes_of
from cadgraph.geometry.shape.solid import Solid, name_solid
from cadgraph.labelers.lvlm.prompt import size_text
from cadgraph.model.labels import Label
from cadgraph.model.parts import Contacts, Parts
from cadgraph.model.shapes import Facts

__all__ = ["Hints", "neighbors_of"]

_MOST_NEIGHBORS = 8
_KNOWN = 0.8  # confidence from which a label of a neighbour helps more than it misleads
_FLAT = 0.25  # a cylinder that is shorter than this share of its diameter is a disc, or a ring
_FORMS: Mapping[Solid, str] = {
    "sheet": "a sheet without thickness",
    "wheel": "a ring with {spokes} spokes",
    "hexagon": "a six-sided prism",
    "bent tube": "a bent tube of one round section",
    "cylinder": "a cylinder",
    "sphere": "a sphere",
    # What only looks like a torus (a nut with its chamfers) is called by what is sure.
    "torus": "round about one axis",
    "cone": "a cone",
    "revolved": "round about one axis",
    "box": "a box",
    "extrusion": "one cross-section all along an axis",
}


def neighbors_of(parts: Parts, contacts: Contacts) -> Mapping[int, tuple[int, ...]]:
    """For each part those that it touches, the ground left out, ascending."""
    near: dict[int, list[int]] = {}
    for a, b in contacts.pairs.tolist():
        if not parts.ground[a] and not parts.ground[b]:
            near.setdefault(a, []).append(b)
            near.setdefault(b, []).append(a)
    return {part: tuple(sorted(others)) for part, others in near.items()}


class Hints:
    """Lines for the prompts of one scene.

    Args:
        parts: of the scene.
        near: what each part touches.
    """

    def __init__(self, parts: Parts, near: Mapping[int, tuple[int, ...]]) -> None:
        self._parts, self._near = parts, near

    def lines(self, part: int, repeats: int, labels: Sequence[Label | None]) -> tuple[str, ...]:
        """What is known about a part.

        Args:
            part: which.
            repeats: how many parts are of this shape, in this role.
            labels: of all parts as far as they are known.
        """
        known = shapes_of(self._parts)
        found = [_form(known.facts[int(known.shape[part])])]
        found.append(f"it is there {repeats} times in the plant" if repeats > 1 else "there is only one of it")
        if not self._near.get(part):
            return (*found, "it touches no other part")
        return (*found, *self.around(part, labels))

    def around(self, part: int, labels: Sequence[Label | None]) -> tuple[str, ...]:
        """What a part touches, as far as that is known well enough to help; nothing where none of it is.

        Args:
            part: which.
            labels: of all parts as far as they are known.
        """
        neighbors = self._near.get(part, ())
        known = [label for other in neighbors if (label := labels[other]) is not None and label.confidence >= _KNOWN]
        if not known:
            return ()
        named: dict[str, list[float]] = {}
        for label in known:
            named.setdefault(label.name or label.group, []).append(label.confidence)
        most = sorted(named.items(), key=lambda row: (-len(row[1]), row[0]))[:_MOST_NEIGHBORS]
        words = ", ".join(f"{len(sure)} x {name} ({min(sure):.0%} sure)" for name, sure in most)
        count = f"{len(neighbors)} part{'s' * (len(neighbors) != 1)}"
        return (f"it touches {count}, {len(known)} of which are known: {words}",)


def _form(facts: Facts) -> str:
    """Which simple solid a shape is, with its sizes."""
    solid = name_solid(facts)
    if solid is None:
        ways = sum(port.outer > 0.2 * facts.radius for port in facts.ports)
        return "its form is none of the simple solids" + (f", with {ways} round ends" if ways >= 2 else "")
    form = _FORMS[solid].format(spokes=facts.spokes)
    if solid == "cylinder" and facts.length < 2 * _FLAT * facts.radius:
        form = "a flat ring" if facts.bore > 0 else "a flat disc"
    return ", ".join((f"its form is {form}", *_sizes(solid, facts)))


def _sizes(solid: Solid, facts: Facts) -> tuple[str, ...]:
    """Those that tell more than the oriented box, which every question states."""
    across = f"outer diameter {size_text(2 * facts.radius)}"
    if solid in ("sphere", "wheel"):
        return (across,)
    if solid == "bent tube":
        return f"outer diameter {size_text(2 * facts.ports[0].outer)}", f"{size_text(facts.tube)} along its middle"
    if solid == "extrusion":
        return (f"{size_text(float(facts.section[facts.extruded]))} long",)
    if solid in ("sheet", "box"):
        return ()
    bore = f"open along its axis with a bore of {size_text(2 * facts.bore)}" if facts.bore > 0 else "without a bore"
    return across, f"{size_text(facts.length)} long", bore
