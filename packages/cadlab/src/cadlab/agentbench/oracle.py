"""What the tools for agents say of a graph: the answers of an agent that always picks the right ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from cadgraph.agents.plant import Plant
from cadgraph.agents.tools import tool_named
from cadgraph.errors import CadGraphError
from cadgraph.model.records import Place
from cadlab.agentbench import solvers
from cadlab.agentbench.people import compass
from cadlab.agentbench.questions import About, Question, Value

__all__ = ["Oracle"]


class Oracle:
    """Answers questions by calling tools.

    Args:
        plant: that is asked about.
    """

    def __init__(self, plant: Plant) -> None:
        self.plant = plant
        self._solve: Mapping[str, Callable[[About], Value]] = {
            "count": self._count,
            "nearest": self._nearest,
            "height": self._height,
            "above": self._above,
            "handle": self._handle,
            "facing": self._facing,
            "climb": self._climb,
            "isolate": lambda q: self.isolate(q["unit"]),
            "length": self._length,
            "order": self._order,
            "downstream": self._downstream,
            "fed by": self._fed_by,
            "system": self._system,
            "what if": lambda q: self._cut_off(q["close"]),
            "two closed": lambda q: self._cut_off(q["close"]),
            "isolate, height": lambda q: self._end(self.isolate(q["unit"]), q["highest"]),
            "what if, height": lambda q: self._end(self._cut_off(q["close"]), q["highest"]),
            "round": self._round,
            "unanswerable": lambda q: None,
        }

    def answer(self, question: Question) -> Value:
        """What the tools say; None where they can't tell, or refuse."""
        try:
            return self._solve[question.type](question.about)
        except CadGraphError:
            return None

    def _say(self, tool: str, **arguments: Any) -> Mapping[str, Any]:
        return tool_named(tool).ask(self.plant, arguments).values

    def _found(self, **arguments: Any) -> list[Mapping[str, Any]]:
        return list(self._say("find", **arguments)["found"])

    def _tags(self, *types: str) -> set[str]:
        return {unit["tag"] for type_ in types for unit in self._found(type=type_)}

    def _equipment(self) -> set[str]:
        return {unit["tag"] for unit in self._found()} - self._tags("valve", "gauge")

    def _count(self, about: About) -> Value:
        found = self._found(type=about["type"], kind=about["kind"])
        return len([unit for unit in found if about["kind"] in ("", unit["kind"])])

    def _nearest(self, about: About) -> Value:
        found = self._found(type=about["type"], near=about["unit"], sort="distance")
        return [unit["tag"] for unit in found if unit["tag"] != about["unit"]][:1] or None

    def _height(self, about: About) -> float:
        return float(self._say("measure", a=about["a"], b=about["b"])["height_m"])

    def _above(self, about: About) -> Value:
        heights = {name: self._height({"a": about["unit"], "b": name}) for name in about["among"]}
        return sorted(name for name, height in heights.items() if height > 0)

    def _handle(self, about: About) -> Value:
        said = self._say("approach", target=about["unit"])
        return None if said["reach"] is None else self._over_ground(said["level_id"]) + float(said["height_m"])

    def _climb(self, about: About) -> Value:
        said = self._say("approach", target=about["unit"])
        return self._over_ground(said["level_id"]) if said["reach"] in ("floor", "platform") else None

    def _over_ground(self, level: str) -> float:
        heights = {place.id: place.height for place in self.plant.graph.of_layer(Place)}
        return heights[level] - min(heights.values())

    def _facing(self, about: About) -> Value:
        said = self._say("approach", target=about["unit"])
        return [compass(said["facing"])] if said["reach"] is not None and said["facing"] else None

    def isolate(self, unit: str) -> list[str] | None:
        """The valves that isolate a unit; None where they don't, or the tools can't tell."""
        try:
            said = self._say("isolate", target=unit)
        except CadGraphError:
            return None
        return sorted(valve["tag"] for valve in said["valves"]) if said["isolated"] else None

    def _length(self, about: About) -> Value:
        said = self._say("route", start=about["a"], end=about["b"])
        return float(said["length_m"]) if said["length_complete"] else None

    def _order(self, about: About) -> Value:
        units = self._equipment() | self._tags("valve")
        said = self._say("route", start=about["a"], end=about["b"])
        return [step["tag"] for step in said["steps"] if step["tag"] in units] or None

    def _traced(self, unit: str, direction: str) -> list[str]:
        said = self._say("trace", start=unit, direction=direction)
        return [step["tag"] for step in said["steps"] if step["tag"] != unit]

    def _downstream(self, about: About) -> Value:
        return sorted(self._tags(about["type"]) & set(self._traced(about["unit"], "downstream")))

    def _fed_by(self, about: About) -> Value:
        return sorted(self._equipment() & set(self._traced(about["unit"], "upstream")))

    def _system(self, about: About) -> Value:
        system = next(unit["system"] for unit in self._found() if unit["tag"] == about["unit"])
        return None if system is None else len(self._found(type=about["type"], system=system))

    def _cut_off(self, close: list[str]) -> list[str]:
        told = self._equipment() | self._tags("gauge")
        return sorted(one["tag"] for one in self._say("what_if", close=close)["cut_off"] if one["tag"] in told)

    def _end(self, names: list[str] | None, highest: bool) -> Value:
        heights = [unit["at_m"][2] for unit in self._found() if unit["tag"] in (names or ())]
        if not heights:
            return None
        return float(max(heights) if highest else min(heights))

    def _round(self, about: About) -> Value:
        places = {unit["tag"]: unit["at_m"] for unit in self._found(type="gauge")}
        return solvers.best_tour([(name, places[name]) for name in about["stops"]])
