"""``scenario.yaml``: what a simulation supposes, with the reason for every value, to be edited and read back."""

from __future__ import annotations

import difflib
import json
import reprlib
import textwrap
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar, get_args

from pydantic import ValidationError

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import SCENARIO as LIMIT
from cadgraph._io.limits import read_text_within
from cadgraph._io.strict_yaml import parse_yaml
from cadgraph._io.text import printable
from cadgraph._io.validation_messages import expectation
from cadgraph.errors import ScenarioError, UnknownNode
from cadgraph.hydraulics.balance import complete
from cadgraph.hydraulics.network import OUTSIDE, ports_at
from cadgraph.hydraulics.scenario import guess_end, guess_scenario, guess_valve
from cadgraph.hydraulics.settings import (
    SCENARIO,
    UNITS,
    EndSetting,
    GaugeSetting,
    Move,
    Scenario,
    Setting,
    ValveSetting,
)
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Unit
from cadgraph.query.network import Network

__all__ = ["read_scenario", "scenario_text", "write_scenario"]

_AnySetting = TypeVar("_AnySetting", bound=Setting)

_REMEDY = "'cadgraph simulate' writes one to edit"
_ONE = ("fluid", "pipes")
_SEVERAL = ("valves", "pumps", "ends", "tanks", "gauges")
_HEAD = """\
# What 'cadgraph simulate' supposes of this plant. Change any value and run it again; what is left out is supposed anew.
# Behind each value stands where it comes from: what begins with "assumed" nobody has confirmed.
# Pressures are bar above that of the air, heights and levels m, times s.
"""
_ABOUT = {
    "valves": "duty: hand, check or relief. opening: 0 is shut, 1 is open. turns: of the wheel, 0.25 of a lever. "
    "travel: from open to shut. k: loss coefficient when open. pressure: that a relief valve opens at. towards: port "
    "that check and relief valves let out of.",
    "pumps": "head [m] at flow [m3/h]; 4/3 of that head at no flow. running: 0 stands still, 1 is full speed. "
    "suction: ports that it draws from.",
    "ends": "role: source (pressure), sink (flow [m3/h] at 3 bar) or blind.",
    "tanks": "level above the bottom, height at which it overflows, bottom: height in the plant, area of the surface "
    "[m2], pressure above the surface.",
    "gauges": "span: what it shows at the end of its scale, which begins at 0. lag: time constant of the needle.",
}
_PLAY = """\
# A timetable for 'cadgraph simulate OUT --play FILE', e.g.
# play:
#   - {at: 2, over: 10, set: {"V-001": 0}}
"""
_NAMES = """\
# The mesh that each name stood for when this was written: where a correction of the plant has given one of the names
# that are used above to another unit, the file is refused rather than applied to that.
"""
_MOST_NAMES = 3  # that a message quotes


def write_scenario(scenario: Scenario, path: str | Path) -> Path:
    """Writes a scenario, whole or not at all; the same scenario gives the same bytes.

    Args:
        scenario: what is supposed.
        path: the file, or the folder that gets ``scenario.yaml``.

    Returns:
        The file.

    Raises:
        OutputError: it can't be written.
    """
    target = Path(path)
    target = target / SCENARIO if target.is_dir() else target
    write_atomically(target, scenario_text(scenario))
    return target


def scenario_text(scenario: Scenario) -> str:
    """A scenario as YAML, the reasons as comments.

    Args:
        scenario: what is supposed.
    """
    return "\n".join(_lines(scenario)) + "\n"


def _lines(scenario: Scenario) -> Iterator[str]:
    yield _HEAD.rstrip()
    for name in _ONE:
        yield ""
        yield f"{name}:"
        yield from _values(getattr(scenario, name), "  ")
    for name in _SEVERAL:
        section: Mapping[str, Setting] = getattr(scenario, name)
        yield ""
        yield from (f"# {line}" for line in textwrap.wrap(_ABOUT[name], 118))
        yield f"{name}:" + ("" if section else " {}")
        for tag, setting in section.items():
            yield f"  {json.dumps(tag)}:"
            yield from _values(setting, "    ", units=False)
    yield ""
    if scenario.play:
        yield "play:"
        yield from (f"  - {json.dumps(move.values())}" for move in scenario.play)
    else:
        yield _PLAY.rstrip()
    if scenario.names:
        yield ""
        yield _NAMES.rstrip()
        yield "names:"
        yield from (f"  {json.dumps(name)}: {json.dumps(mesh)}" for name, mesh in scenario.names.items())


def _values(setting: Setting, indent: str, units: bool = True) -> Iterator[str]:
    model = type(setting).model_fields
    for name, value in setting.values().items():
        unit = (model[name].description or "") if units else ""
        said = "; ".join(printable(each) for each in (unit, setting.why.get(name, "")) if each)
        yield f"{indent}{name}: {json.dumps(value)}" + (f"  # {said}" if said else "")


def read_scenario(path: str | Path, graph: SceneGraph | Network) -> Scenario:
    """Reads a scenario for a graph; what it leaves out is supposed as in the default scenario.

    Args:
        path: the file.
        graph: the finished graph that it is for, or its network.

    Raises:
        ScenarioError: it can't be read, names what is not in the graph, or has values that can't be; the message says
            which and why on one line.
    """
    network = graph if isinstance(graph, Network) else Network(graph)
    content = parse_yaml(read_text_within(path, LIMIT, ScenarioError, _REMEDY), str(path), ScenarioError)
    return _Reading(str(path), network).scenario(content)


class _Reading:
    """Makes a scenario of what a file says and of what is supposed where it says nothing.

    Args:
        where: name of the file, for messages.
        network: of the graph that it is for.
    """

    def __init__(self, where: str, network: Network) -> None:
        self.where = where
        self.network = network
        self.guess = guess_scenario(network)

    def scenario(self, content: Any) -> Scenario:
        """What the plain values of a file say."""
        sections = self._table(content, "the file", (*_ONE, *_SEVERAL, "play", "names"))
        self._check_names(sections)
        parts: dict[str, Any] = {}
        for name in _ONE:
            parts[name] = self._merged(name, getattr(self.guess, name), sections.get(name))
        given: dict[str, dict[str, Mapping[str, Any]]] = {}
        for name in _SEVERAL:
            given[name] = self._named(name, sections.get(name))
            own: Mapping[str, Setting] = getattr(self.guess, name)
            parts[name] = {tag: self._setting(name, tag, setting, given[name].get(tag)) for tag, setting in own.items()}
        scenario = Scenario(**parts)
        self._check(scenario)
        scenario = self._completed(scenario)
        play = self._play(sections.get("play"), scenario)
        return scenario.model_copy(update={"play": play, "names": self.guess.names})

    def _check_names(self, sections: Mapping[str, Any]) -> None:
        """Refuses names that stood for something else when the file was written."""
        meant = self._table(sections.get("names"), "names", sections.get("names") or ())
        used = {self._spelled(key) for name in _SEVERAL for key in _keys(sections.get(name))}
        play = sections.get("play")
        for move in play if isinstance(play, list) else ():
            used.update(map(self._spelled, _keys(move.get("set") if isinstance(move, dict) else None)))
        moved = [(name, mesh) for name, mesh in meant.items() if str(name) in used and not self._holds(name, mesh)]
        if not moved:
            return
        told = [f"{name} is {self._owner(mesh)} now" for name, mesh in moved[:_MOST_NAMES]]
        more = [f"{len(moved) - _MOST_NAMES} more"] if len(moved) > _MOST_NAMES else []
        raise self._fault(
            "names",
            f"a correction has given names to other units since this was written ({', '.join([*told, *more])}); "
            f"put the names of now and take the section 'names' out, or delete the file: {_REMEDY}",
        )

    def _spelled(self, key: str) -> str:
        """A name as the graph spells it."""
        try:
            return self.network.name(self.network.find(key))
        except UnknownNode:
            return key

    def _holds(self, name: Any, mesh: Any) -> bool:
        """Whether a name stands for what holds a mesh."""
        try:
            node = self.network.places[self.network.find(str(name))]
        except UnknownNode:
            return False
        return any(mesh in self.network.graph.part(part).meshes for part in getattr(node, "parts", ()))

    def _owner(self, mesh: Any) -> str:
        """What a mesh is of now."""
        try:
            return self.network.name(self.network.find(str(mesh)))
        except UnknownNode:
            return "no unit"

    def _completed(self, scenario: Scenario) -> Scenario:
        """With what hangs on the pressures; the file's own values of that show as supposed where they are no others."""
        blank = {
            "valves": {tag: valve.model_copy(update={"pressure": None}) for tag, valve in scenario.valves.items()},
            "gauges": {
                tag: gauge.model_copy(update={"span": self.guess.gauges[tag].span})
                for tag, gauge in scenario.gauges.items()
            },
        }
        try:
            supposed = complete(self.network, scenario.model_copy(update=blank))
        except ScenarioError as error:
            raise ScenarioError(f"{self.where}: {error}") from None
        return scenario.model_copy(
            update={
                "valves": {
                    tag: _chosen(valve, supposed.valves[tag], "pressure") for tag, valve in scenario.valves.items()
                },
                "gauges": {tag: _chosen(gauge, supposed.gauges[tag], "span") for tag, gauge in scenario.gauges.items()},
            }
        )

    def _fault(self, place: str, what: str) -> ScenarioError:
        return ScenarioError(printable(f"{self.where}: {place}: {what}"))

    def _table(self, content: Any, place: str, known: Collection[str]) -> dict[str, Any]:
        if content is None:
            return {}
        if not isinstance(content, dict):
            raise self._fault(place, f"must be a table of names and values, not {reprlib.repr(content)}")
        for key in content:
            if key not in known:
                near = difflib.get_close_matches(str(key), list(known), 1)
                hint = f"; did you mean {near[0]}?" if near else f"; there are {', '.join(known)}"
                raise self._fault(place, f"nothing is called {reprlib.repr(key)}{hint}")
            if isinstance(content[key], bool):
                raise self._fault(place, f"{key} must not be {'true' if content[key] else 'false'}")
        return content

    def _named(self, section: str, content: Any) -> dict[str, Mapping[str, Any]]:
        """What a section says of each unit or end, by its tag or id."""
        if content is None:
            return {}
        if not isinstance(content, dict):
            raise self._fault(section, f"must be a table of names and values, not {reprlib.repr(content)}")
        found: dict[str, Mapping[str, Any]] = {}
        for key, values in content.items():
            name = self._name(section, str(key))
            if name in found:
                raise self._fault(section, f"{name} is there twice")
            found[name] = self._table(values, f"{section}: {name}", self._fields(section, name))
        return found

    def _name(self, section: str, key: str) -> str:
        known: Mapping[str, Setting] = getattr(self.guess, section)
        if key in known:
            return key
        try:
            place = self.network.find(key)
        except UnknownNode as error:
            raise self._fault(section, str(error)) from None
        node = self.network.places[place]
        name = node.tag if isinstance(node, Unit) else node.id
        if name in known:
            return name
        if not self.network.arcs(place):
            raise self._fault(section, f"no line was found at {name}, so nothing flows there")
        raise self._fault(section, f"{name} is a {self.network.what(place)}")

    def _fields(self, section: str, name: str) -> list[str]:
        own = getattr(self.guess, section)[name]
        return [field for field in type(own).model_fields if field != "why"]

    def _setting(self, section: str, name: str, own: Setting, given: Mapping[str, Any] | None) -> Setting:
        """One record; where the file changes what a valve or end is, the rest is supposed anew."""
        place = f"{section}: {name}"
        if given and isinstance(own, ValveSetting) and given.get("duty", own.duty) != own.duty:
            own = guess_valve(self.network, self._unit(name), self._known(place, "duty", given, ValveSetting))
        if given and isinstance(own, EndSetting) and given.get("role", own.role) != own.role:
            own = guess_end(self.network, name, self._known(place, "role", given, EndSetting))
        if given and isinstance(own, GaugeSetting) and given.get("measures", own.measures) != own.measures:
            measures = self._known(place, "measures", given, GaugeSetting)
            own = own.model_copy(update={"measures": measures, "unit": UNITS[measures], "span": None})
        return self._merged(place, own, given)

    def _known(self, place: str, field: str, given: Mapping[str, Any], model: type[Setting]) -> Any:
        """A value that is one of a few words."""
        words = get_args(model.model_fields[field].annotation)
        if given[field] not in words:
            raise self._fault(place, f"{field} must be {', '.join(words)}, not {reprlib.repr(given[field])}")
        return given[field]

    def _unit(self, tag: str) -> Unit:
        node = self.network.places[self.network.find(tag)]
        assert isinstance(node, Unit)  # its tag is a key of the guess
        return node

    def _merged(self, place: str, own: _AnySetting, given: Any) -> _AnySetting:
        values = self._table(given, place, [field for field in type(own).model_fields if field != "why"])
        try:
            said = type(own).model_validate({**own.values(), **values})
        except ValidationError as error:
            raise self._fault(place, _told(error)) from None
        why = {
            field: reason
            for field, reason in own.why.items()
            if field not in values or getattr(own, field) == getattr(said, field)
        }
        changed = [field for field in values if getattr(own, field) != getattr(said, field)]
        why |= dict.fromkeys(changed, f"given in {SCENARIO}")
        return said.model_copy(update={"why": why})

    # What must fit the plant

    def _check(self, scenario: Scenario) -> None:
        for tag, tank in scenario.tanks.items():
            if tank.level > tank.height:
                raise self._fault(f"tanks: {tag}", f"level {tank.level:g} is above its height {tank.height:g}")
        for tag, valve in scenario.valves.items():
            ports = self._ports(tag)
            if valve.duty != "hand" and valve.towards not in (ports if len(ports) > 1 else [OUTSIDE]):
                names = ", ".join(ports if len(ports) > 1 else [OUTSIDE])
                raise self._fault(f"valves: {tag}", f"towards must be {names}, not {valve.towards!r}")
            self._check_duty(f"valves: {tag}", valve)
        for tag, gauge in scenario.gauges.items():
            if gauge.unit != UNITS[gauge.measures]:
                fits = UNITS[gauge.measures] or "none"
                raise self._fault(
                    f"gauges: {tag}", f"what measures {gauge.measures} has the unit {fits}, not {gauge.unit}"
                )
        for tag, pump in scenario.pumps.items():
            ports = self._ports(tag)
            wrong = [port for port in pump.suction if port not in ports]
            if wrong:
                raise self._fault(f"pumps: {tag}", f"it has no port {wrong[0]!r}; there are {', '.join(ports)}")

    def _check_duty(self, place: str, valve: ValveSetting) -> None:
        """Refuses what a valve of another duty has: who says it supposes that it counts."""
        if valve.duty != "hand" and valve.opening is not None:
            raise self._fault(
                place, f"a {valve.duty} valve moves by itself and has no opening; one that is stuck has the duty hand"
            )
        if valve.duty != "relief" and valve.pressure is not None:
            raise self._fault(place, "pressure is what a relief valve opens at, and its duty is none")

    def _ports(self, tag: str) -> list[str]:
        return list(ports_at(self.network, self._unit(tag).id))

    def _play(self, content: Any, scenario: Scenario) -> tuple[Move, ...]:
        if content is None:
            return ()
        if not isinstance(content, list):
            raise self._fault("play", f"must be a list, not {reprlib.repr(content)}")
        moves = []
        for number, one in enumerate(content, 1):
            place = f"play: {number}"
            try:
                move = Move.model_validate(self._table(one, place, ("at", "over", "set")))
            except ValidationError as error:
                raise self._fault(place, _told(error)) from None
            moves.append(move.model_copy(update={"set": self._moved(place, move.set, scenario)}))
        return tuple(sorted(moves, key=lambda move: move.at))

    def _moved(self, place: str, given: Mapping[str, float], scenario: Scenario) -> dict[str, float]:
        found = {}
        for key, value in given.items():
            try:
                node = self.network.places[self.network.find(key)]
            except UnknownNode as error:
                raise self._fault(place, str(error)) from None
            tag = node.tag if isinstance(node, Unit) else node.id
            valve = scenario.valves.get(tag)
            if tag not in scenario.pumps and (valve is None or valve.duty != "hand"):
                raise self._fault(place, f"{tag} can't be set; set valves that are moved by hand, and pumps")
            if not 0 <= value <= 1:
                raise self._fault(place, f"{tag} must be from 0 to 1, not {value:g}")
            found[tag] = value
        return found


def _keys(section: Any) -> list[str]:
    """The names in a section, if it is one."""
    return [str(key) for key in section] if isinstance(section, dict) else []


def _chosen(given: _AnySetting, supposed: _AnySetting, field: str) -> _AnySetting:
    """A record with a value that is supposed where none is given, and with the reason where both are the same."""
    value, other = getattr(given, field), getattr(supposed, field)
    if value is not None and value != other:
        return given
    why = {name: reason for name, reason in given.why.items() if name != field}
    return given.model_copy(
        update={field: other, "why": why | {field: supposed.why[field]} if field in supposed.why else why}
    )


def _told(error: ValidationError) -> str:
    """What is wrong with the first value that is, on one line."""
    detail = error.errors(include_url=False)[0]
    where = ".".join(str(step) for step in detail["loc"])
    if detail["type"] == "value_error":
        return str(detail["ctx"]["error"])
    return f"{where} {expectation(detail)}" if where else expectation(detail)
