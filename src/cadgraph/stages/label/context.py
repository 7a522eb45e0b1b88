"""Parts among their neighbours: what the rules ask of contacts, and the labels given so far."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cadgraph.parts import Contacts, Label, Parts
from cadgraph.scene import Floats
from cadgraph.stages.label.facts import Disc, find_facts, same_line
from cadgraph.stages.label.forms import forms_of

__all__ = ["Context", "offset", "parallel"]

MAX_GAP = 0.012  # parts further apart along a common axis do not join: adjacency (1 cm) and rounding
COAXIAL = 0.2  # greatest offset of two axes that are one, over the lesser radius


class Context:
    """All parts with their facts, forms, neighbours, and the labels that rules have given so far."""

    def __init__(self, parts: Parts, contacts: Contacts) -> None:
        self.parts = parts
        self.facts = find_facts(parts)
        self.forms = [forms_of(f) for f in self.facts]
        self.labels: list[Label | None] = [None] * parts.n_parts
        self.near: list[list[int]] = [[] for _ in self.facts]
        self.spot: dict[tuple[int, int], Floats] = {}
        for (a, b), points in zip(contacts.pairs.tolist(), contacts.points, strict=True):
            if not parts.ground[a] and not parts.ground[b]:
                self.near[a].append(b)
                self.near[b].append(a)
                self.spot[a, b], self.spot[b, a] = points

    def say(self, part: int, group: str, name: str | None, confidence: float, why: str) -> None:
        """Labels a part unless a rule before was at least as sure."""
        before = self.labels[part]
        if before is None or before.confidence < confidence:
            self.labels[part] = Label(group, name, confidence, "geometry", {"why": why})

    def is_a(self, part: int, group: str, *names: str) -> bool:
        """Whether a part has a label of this group (with one of these names)."""
        label = self.labels[part]
        return label is not None and label.group == group and (not names or label.name in names)

    def free(self, part: int) -> bool:
        """Whether no rule has labelled a part."""
        return self.labels[part] is None

    def mates(self, part: int, port: Disc) -> Iterator[int]:
        """The neighbours that continue a part beyond one of its ports, on the same axis."""
        for other in self.near[part]:
            g = self.facts[other]
            lines = [(p.center, p.normal, p.outer) for p in g.ports]
            lines += [(g.center, g.axis, g.radius)] if g.round and not g.ports else []
            for center, axis, radius in lines:
                reach = COAXIAL * min(port.outer, radius) + 0.001
                if same_line(port.center, port.normal, center, axis, reach):
                    ahead = (self.parts.properties.obb_center[other] - port.center) @ port.normal
                    beyond = min((abs((p.center - port.center) @ port.normal) for p in g.ports), default=0.0)
                    if ahead > 0 and beyond < MAX_GAP:
                        yield other
                        break

    def run(self, part: int) -> Iterator[tuple[Disc, Disc]]:
        """Pairs of ports of a part that look away from each other on one axis."""
        ports = self.facts[part].ports
        for i, first in enumerate(ports):
            for second in ports[i + 1 :]:
                reach = COAXIAL * min(first.outer, second.outer) + 0.001
                apart = (second.center - first.center) @ second.normal
                if apart > 0 and first.normal @ second.normal < 0 and same_line(
                    first.center, first.normal, second.center, second.normal, reach
                ):  # fmt: skip
                    yield first, second


def offset(point: Floats, port: Disc) -> float:
    """The distance of a point from the axis of a port [m]."""
    apart = point - port.center
    return float(np.linalg.norm(apart - (apart @ port.normal) * port.normal))


def parallel(a: Floats, b: Floats) -> bool:
    """Whether two unit directions agree but for their sense, within 8 degrees."""
    return bool(abs(a @ b) > 0.99)
