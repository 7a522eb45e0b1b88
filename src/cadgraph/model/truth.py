"""What is known for certain about a scene: the content of ``<name>.truth.json`` (format version 1, ``docs/truth.md``).

Lengths are metres, coordinates world, right-handed, Z up, whatever the scene's file uses. A section that is absent (or
null) was not annotated and is not evaluated; an empty one says that there is nothing of its kind.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from cadgraph._io.depth import MOST_LEVELS, is_too_deep
from cadgraph._io.json_rows import write_json_rows
from cadgraph._io.limits import TRUTH, read_text_within
from cadgraph.errors import FormatError
from cadgraph.model.vocabulary import Vocabulary

__all__ = [
    "Truth",
    "TruthCluster",
    "TruthConnection",
    "TruthLine",
    "TruthMesh",
    "TruthPoint",
    "TruthTurning",
    "TruthUnit",
    "check_truth",
]

FORMAT = "cadgraph-truth"
VERSION = 1
_ROWS = ("meshes", "units", "points", "connections", "lines", "clusters", "parts", "contacts")
_SHOWN = 3  # examples in a message


class _Record(BaseModel):
    """A frozen record that keeps keys it doesn't know."""

    model_config = ConfigDict(frozen=True, extra="allow", allow_inf_nan=False, populate_by_name=True)


class TruthMesh(_Record):
    """What one mesh of the scene is."""

    mesh: str = Field(description="its source path")
    group: str | None = Field(default=None, description="of the vocabulary; null: not annotated")
    name: str | None = Field(default=None, description="in that group; null: not annotated")
    line: str | None = Field(default=None, description="tag of the pipe run that it belongs to")
    family: str | None = Field(default=None, description="what it was built as (ball valve, flange...)")
    build: str | None = Field(default=None, description="which design of that family (two-piece, barrel...)")
    granularity: str | None = Field(default=None, description="how finely its device is modelled: one, few or pieces")
    hand: str | None = Field(default=None, description="modelling style")


class TruthTurning(_Record):
    """What turns at a unit by hand or as a needle."""

    kind: Literal["handwheel", "lever", "gear operator", "needle", "dial"] = Field(
        description="dial: of a gauge that has no needle of its own"
    )
    mesh: str = Field(description="that turns, or that holds what turns")
    axis: tuple[float, float, float] = Field(description="unit vector out of the unit")
    point: tuple[float, float, float] = Field(description="on the axis [m]")


class TruthUnit(_Record):
    """A functional unit."""

    id: str = Field(description="unique among units and points")
    type: str = Field(description="as the vocabulary calls it (valve, gauge, pump, tank...)")
    kind: str | None = Field(default=None, description="ball valve, pressure gauge...")
    tag: str | None = Field(default=None, description="as people call it; the id where null")
    meshes: tuple[str, ...] = Field(description="all meshes that belong to it", min_length=1)
    fasteners: tuple[str, ...] = Field(
        default=(), description="bolts that clamp it into its line; no meshes of its own"
    )
    faces: tuple[float, float, float] | None = Field(
        default=None, description="unit vector out of what is read on it: a dial, a screen; null: nothing, or not known"
    )
    turns: TruthTurning | None = Field(
        default=None, description="a wheel, a lever, a needle; null: nothing, or not annotated"
    )


class TruthPoint(_Record):
    """A node of the functional graph that is no unit."""

    id: str = Field(description="unique among units and points")
    kind: Literal["terminal", "junction"] = Field(
        description="terminal: the open end of a run; junction: three or more branches meet"
    )
    point: tuple[float, float, float] | None = Field(default=None, description="where it is [m]")
    end: Literal["open", "blind"] | None = Field(
        default=None, description="of a terminal: whether something could flow out of it"
    )


class TruthConnection(_Record):
    """Two nodes that follow each other along a run, with no unit between them."""

    source: str = Field(alias="from", description="id of a unit or point")
    target: str = Field(alias="to", description="likewise")
    line: str | None = Field(default=None, description="tag of the run")
    length: float | None = Field(default=None, ge=0, description="along the centreline [m]")
    diameter: float | None = Field(default=None, ge=0, description="nominal bore [m]")
    direction: Literal["forward", "backward", "unknown"] = Field(
        default="unknown", description="of the flow; forward: source to target"
    )
    reason: str | None = Field(default=None, description="what fixes the direction")


class TruthLine(_Record):
    """The centreline of a pipe run."""

    id: str = Field(description="its tag")
    points: tuple[tuple[float, float, float], ...] = Field(
        description="along the axis, in order; bends as chords with their ends on it [m]", min_length=2
    )
    outer: float | None = Field(default=None, gt=0, description="greatest outside diameter of its pipe [m]")


class TruthCluster(_Record):
    """One connected structure: meshes that hang together. In the file, a bare list of paths will do."""

    id: str | None = Field(default=None, description="what people call it (S1)")
    meshes: tuple[str, ...]

    @model_validator(mode="before")
    @classmethod
    def _from_list(cls, value: Any) -> Any:
        return {"meshes": value} if isinstance(value, list | tuple) else value


class Truth(_Record):
    """Everything that is known for certain about a scene.

    Raises:
        ValidationError: (a ``ValueError``) a value is of the wrong type, an id or path is used twice, or one names
            what isn't there. :meth:`from_json` and :meth:`load` raise ``FormatError`` instead.
    """

    format: Literal["cadgraph-truth"] = "cadgraph-truth"
    version: Literal[1] = 1
    preset: str = Field(default="", description="name of the generated plant; empty for one from elsewhere")
    seed: int | None = Field(default=None, description="that the plant was made from")
    hands: tuple[str, ...] = Field(default=(), description="modelling styles in it")
    meshes: tuple[TruthMesh, ...] = ()
    units: tuple[TruthUnit, ...] | None = None
    points: tuple[TruthPoint, ...] = ()
    connections: tuple[TruthConnection, ...] | None = None
    lines: tuple[TruthLine, ...] | None = None
    clusters: tuple[TruthCluster, ...] | None = None
    parts: tuple[tuple[str, ...], ...] | None = Field(
        default=None,
        description="meshes that act as one item, the largest first; a mesh in none of them is a part by itself",
    )
    looseness: float | None = Field(default=None, ge=0, description="greatest gap between parts that touch [m]")
    contacts: tuple[tuple[str, str], ...] | None = Field(default=None, description="pairs of meshes that touch")
    duplicates: tuple[tuple[str, str], ...] = Field(
        default=(), description="pairs of meshes, the second an exact copy of the first at the same place"
    )
    hidden: tuple[str, ...] = Field(default=(), description="meshes that can't be seen from anywhere")
    flaws: dict[str, tuple[str, ...]] = Field(
        default_factory=dict, description="what is wrong with a mesh, by its path: flipped, soup, degenerate, polygons"
    )
    gaps: dict[str, float] = Field(
        default_factory=dict,
        description="what was taken off a mesh so that it misses its neighbours, by its path; negative: overlap [m]",
    )
    colors: str | None = Field(default=None, description="how the scene is painted: own, gray, random or none")
    instances: str | None = Field(
        default=None, description="how repeats are stored: none, native, nested, point or mixed"
    )
    nested: int | None = Field(default=None, ge=0, description="levels of frames without meaning above a mesh")
    meters_per_unit: float | None = Field(
        default=None, gt=0, description="length of one authored unit of the scene [m]"
    )
    up_axis: str | None = Field(default=None, description="as authored in the scene")

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        known = {row.mesh for row in self.meshes}
        for section, what, names in self._listed_once():
            _refuse_repeats(names, section, what)
        for section, names in self._named_meshes():
            _refuse_strangers(names, known, section, "mesh")
        nodes = set(self._node_ids())
        ends = (end for c in self.connections or () for end in (c.source, c.target))
        _refuse_strangers(ends, nodes, "connections", "unit or point")
        return self

    def _listed_once(self) -> Iterator[tuple[str, str, Iterable[str]]]:
        """What may be listed once only: section, what it is, and the names in the order of the file."""
        units, clusters = self.units or (), self.clusters or ()
        yield "meshes", "mesh", (row.mesh for row in self.meshes)
        yield "units and points", "id", self._node_ids()
        yield "units", "mesh", _flat(unit.meshes for unit in units)
        yield "clusters", "mesh", _flat(cluster.meshes for cluster in clusters)
        yield "clusters", "id", (cluster.id for cluster in clusters if cluster.id)
        yield "parts", "mesh", _flat(self.parts or ())
        yield "lines", "id", (line.id for line in self.lines or ())

    def _node_ids(self) -> tuple[str, ...]:
        return (*(unit.id for unit in self.units or ()), *(point.id for point in self.points))

    def _named_meshes(self) -> Iterator[tuple[str, Iterable[str]]]:
        """The sections that name meshes, and which."""
        yield "units", _flat(unit.meshes for unit in self.units or ())
        yield "clusters", _flat(cluster.meshes for cluster in self.clusters or ())
        yield "contacts", _flat(self.contacts or ())
        yield "duplicates", _flat(self.duplicates)
        yield "hidden and flaws", (*self.hidden, *self.flaws)
        yield "gaps", self.gaps
        yield "units", _flat(unit.fasteners for unit in self.units or ())
        yield "parts", _flat(self.parts or ())
        yield "units", (unit.turns.mesh for unit in self.units or () if unit.turns is not None)

    def to_json(self) -> dict[str, Any]:
        """The content of the file as plain values; what a mesh or unit may lack is left out where it does."""
        data = self.model_dump(mode="json", by_alias=True)
        for row in data["meshes"]:
            for key in ("line", "family", "build", "granularity", "hand"):
                if row[key] is None:
                    del row[key]
        for row in data["units"] or ():
            if not row["fasteners"]:
                del row["fasteners"]
            for key in ("faces", "turns"):
                if row[key] is None:
                    del row[key]
        for row in data["points"]:
            if row["end"] is None:
                del row["end"]
        return data

    @classmethod
    def from_json(cls, data: Any, where: str = "truth") -> Truth:
        """Reads the content of a truth file.

        Args:
            data: plain values.
            where: the file's name, for messages.

        Raises:
            FormatError: it does not follow the format; the text names the key.
        """
        if not isinstance(data, Mapping) or data.get("format") != FORMAT:
            raise FormatError(f"{where}: not a truth file (key 'format' must be {FORMAT!r})")
        if data.get("version") != VERSION:
            raise FormatError(
                f"{where}: truth version {data.get('version')!r}, but this cadgraph reads version {VERSION}; update it"
            )
        if is_too_deep(data):
            raise FormatError(f"{where}: holds values in more than {MOST_LEVELS} levels; write it anew")
        try:
            return cls.model_validate(data)
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(str(step) for step in first["loc"])
            message = first["msg"].removeprefix("Value error, ")
            raise FormatError(f"{where}: {place + ': ' if place else ''}{message}") from None

    def save(self, path: str | Path) -> Path:
        """Writes a truth file, whole or not at all; the same truth gives the same bytes.

        Returns:
            The file.

        Raises:
            OutputError: it can't be written.
        """
        target = Path(path)
        write_json_rows(target, self.to_json(), rows=_ROWS)
        return target

    @classmethod
    def load(cls, path: str | Path) -> Truth:
        """Reads a truth file.

        Raises:
            FormatError: it is missing, no JSON, or does not follow the format.
        """
        target = Path(path)
        text = read_text_within(target, TRUTH, FormatError, "give a .truth.json file")
        try:
            data = json.loads(text, parse_constant=_refuse_constant)
        except (ValueError, RecursionError) as error:
            raise FormatError(f"{target}: not JSON ({error})") from error
        return cls.from_json(data, str(target))


def check_truth(truth: Truth, vocabulary: Vocabulary, paths: Iterable[str] | None = None) -> tuple[str, ...]:
    """Looks for what a truth file may say but most likely doesn't mean.

    Args:
        truth: what to check.
        vocabulary: that its groups, names and unit types should be in.
        paths: of all meshes of the scene, as ``cadgraph.load(scene).paths`` gives them; not compared if None.

    Returns:
        One line for each kind of finding, with how often it occurs and examples; empty if there are none.
    """
    cases = [*_odd_meshes(truth, vocabulary), *_odd_units(truth, vocabulary), *_unconnected(truth)]
    if paths is not None:
        cases += _differences(truth, set(paths))
    found: dict[str, list[str]] = {}
    for what, name in cases:
        found.setdefault(what, []).append(name)
    return tuple(_counted(what, names) for what, names in found.items())


_Cases = Iterator[tuple[str, str]]
"""A kind of finding and the name that it is about."""


def _odd_meshes(truth: Truth, vocabulary: Vocabulary) -> _Cases:
    """Meshes whose group or name the vocabulary doesn't have."""
    for row in truth.meshes:
        if row.group is None:
            yield "meshes without a group (not evaluated)", row.mesh
        elif not vocabulary.holds(row.group):
            yield "groups that are not in the vocabulary", row.group
        elif not vocabulary.holds(row.group, row.name):
            yield "names that are not in their group", f"{row.group} / {row.name}"


def _odd_units(truth: Truth, vocabulary: Vocabulary) -> _Cases:
    """Units whose type the vocabulary doesn't have, or none of their meshes."""
    unit_of_group = vocabulary.unit_of_group
    types = set(unit_of_group.values())
    type_of = {row.mesh: unit_of_group.get(row.group or "") for row in truth.meshes}
    for unit in truth.units or ():
        if unit.type not in types:
            yield "unit types that are not in the vocabulary", unit.type
        elif all(type_of[mesh] != unit.type for mesh in unit.meshes):
            yield "units of which no mesh has a group of their type", unit.id


def _unconnected(truth: Truth) -> _Cases:
    """Meshes in no cluster, and points at no connection."""
    if truth.clusters is not None:
        clustered = set(_flat(cluster.meshes for cluster in truth.clusters))
        for row in truth.meshes:
            if row.mesh not in clustered:
                yield "meshes in no cluster (right for the ground only)", row.mesh
    joined = {end for c in truth.connections or () for end in (c.source, c.target)}
    for point in truth.points:
        if point.id not in joined:
            yield "points that no connection names", point.id


def _differences(truth: Truth, there: set[str]) -> _Cases:
    """Meshes that either the truth or the scene lacks."""
    listed = [row.mesh for row in truth.meshes]
    yield from (("meshes that the scene doesn't have", mesh) for mesh in listed if mesh not in there)
    yield from (("meshes of the scene that are not listed", mesh) for mesh in sorted(there - set(listed)))


def _flat(groups: Iterable[Iterable[str]]) -> Iterator[str]:
    return (name for group in groups for name in group)


def _counted(what: str, names: Sequence[str]) -> str:
    return f"{len(names)} {what}: {', '.join(list(dict.fromkeys(names))[:_SHOWN])}"


def _refuse_repeats(names: Iterable[str], section: str, what: str) -> None:
    repeated = [name for name, count in Counter(names).items() if count > 1]
    if repeated:
        raise ValueError(f"{section}: {what} {repeated[0]!r} is listed twice ({len(repeated)} such); keep one")


def _refuse_strangers(names: Iterable[str], known: set[str], section: str, what: str) -> None:
    strangers = [name for name in names if name not in known]
    if strangers:
        raise ValueError(f"{section}: {what} {strangers[0]!r} is not in this truth ({len(strangers)} such); list it")


def _refuse_constant(text: str) -> float:
    raise ValueError(f"{text} is no JSON number")
