"""What a user asks to have corrected, by the ids of a graph: read, checked, put in words, and anchored to meshes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, Literal, cast

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from cadgraph._io.validation_messages import expectation
from cadgraph.model.analysis import Analysis
from cadgraph.model.anchors import Anchor, Fingerprint, anchor_of
from cadgraph.model.edits import (
    Correction,
    Cut,
    Device,
    Direction,
    Edit,
    Forget,
    Ground,
    Join,
    Merge,
    Split,
    Tag,
    about,
    check_tag,
)
from cadgraph.model.given_labels import split_label
from cadgraph.model.graph import SceneGraph
from cadgraph.model.names import loose_tag
from cadgraph.model.records import Connected, Junction, Part, Terminal, Unit
from cadgraph.model.vocabulary import Vocabulary, spell_label
from cadgraph.stages.relate import FARTHEST

__all__ = ["EditRequest", "Requests", "read_requests"]

_MOST_ANCHORS = 8  # parts that a unit is known by: the largest ones
_ALONE = ", this part alone"
_MOST = 100_000  # requests of one action, or parts of one request
# Names that a graph gives to its nodes; a unit that is called so could not be told from them.
_IDS = re.compile(r"site|unit-.*|(part|cluster|junction|terminal|system|shape)-?[0-9]+|l-?[0-9]{4,}", re.IGNORECASE)

_MARKS = ("->", "<-")

_Name = Annotated[str, Field(min_length=1, max_length=4096)]
_Names = Annotated[tuple[_Name, ...], Field(max_length=_MOST)]
_Place = Unit | Junction | Terminal


class _Request(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)


class LabelRequest(_Request):
    """What a part is; a name alone stands in ``group`` where only one group has it."""

    kind: Literal["label"]
    part: _Name
    group: _Name
    name: _Name | None = None
    this_only: bool = False


class ForgetRequest(_Request):
    """The correction of a part's own label is taken back."""

    kind: Literal["forget"]
    part: _Name


class UnitRequest(_Request):
    """Parts that are one unit, or that are a unit of their own."""

    kind: Literal["merge", "split"]
    parts: _Names = Field(strict=False)


class JointRequest(_Request):
    """Two parts that join along the pipes, or don't."""

    kind: Literal["join", "cut"]
    first: _Name
    second: _Name


class DirectionRequest(_Request):
    """Which way it flows through a connection, given by its ends and the parts between."""

    kind: Literal["direction"]
    source: _Name
    target: _Name
    via: _Names | None = Field(default=None, strict=False)
    flow: Literal["forward", "backward", "unknown"] = "forward"


class TagRequest(_Request):
    """What the plant calls a unit."""

    kind: Literal["tag"]
    unit: _Name
    tag: str


class DeviceRequest(_Request):
    """What kind of device a unit is."""

    kind: Literal["device"]
    unit: _Name
    device: str


class GroundRequest(_Request):
    """Whether a part is the ground."""

    kind: Literal["ground"]
    part: _Name
    ground: bool = True


EditRequest = Annotated[
    LabelRequest
    | ForgetRequest
    | UnitRequest
    | JointRequest
    | DirectionRequest
    | TagRequest
    | DeviceRequest
    | GroundRequest,
    Field(discriminator="kind"),
]
"""One correction, by the ids of a graph."""

_READER: TypeAdapter[list[EditRequest]] = TypeAdapter(
    Annotated[list[EditRequest], Field(min_length=1, max_length=_MOST)]
)


def read_requests(rows: Sequence[Mapping[str, Any] | BaseModel]) -> list[EditRequest]:
    """Corrections as they come from outside.

    Args:
        rows: one object each, as JSON has them.

    Raises:
        ValueError: one is none; the message names it and the field.
    """
    if not isinstance(rows, Sequence) or not all(isinstance(row, Mapping | BaseModel) for row in rows):
        raise ValueError("give a list of corrections, each an object with its kind")
    plain = [row.model_dump() if isinstance(row, BaseModel) else dict(row) for row in rows]
    try:
        return _READER.validate_python(plain)
    except ValidationError as error:
        fault = error.errors()[0]
        steps = [str(step) for step in fault["loc"]]
        where = f"edit {steps[0]}{f': {steps[-1]!r}' if len(steps) > 2 else ''}" if steps else "a correction"
        raise ValueError(f"{where} {expectation(fault)}") from None


@dataclass(frozen=True, eq=False)
class Requests:
    """Turns requests into edits that survive a rebuild; each is checked first.

    Args:
        graph: that the requests name parts, units and connections of.
        analysis: of its scene.
        vocabulary: the labels in use.
        corrected: source paths of the parts whose own label is corrected.
        tags: that corrections in force give.
    """

    graph: SceneGraph
    analysis: Analysis
    vocabulary: Vocabulary
    corrected: Collection[str]
    tags: Collection[str] = ()

    def anchor(self, requests: Sequence[EditRequest]) -> tuple[tuple[Edit, ...], str]:
        """The edits that requests ask for, and all of them in words.

        Raises:
            KeyError: the graph has no such part, unit or place.
            ValueError: a request can't be carried out; the message says why.
            LabelError: the vocabulary has no such label.
        """
        done = [self._one(request) for request in requests]
        self._refuse_tags([request for request in requests if isinstance(request, TagRequest)])
        _refuse_two_answers(done)
        told = _together([words for _, words in done])
        more = f"; and {len(told) - 3} more" if len(told) > 3 else ""
        return tuple(edit for edit, _ in done), "; ".join(told[:3]) + more

    def _one(self, request: EditRequest) -> tuple[Edit, str]:
        how = cast("Callable[[EditRequest], tuple[Edit, str]]", getattr(self, f"_{request.kind}"))
        return how(request)

    # Labels and the ground

    def _label(self, request: LabelRequest) -> tuple[Edit, str]:
        part = self.graph.part(request.part)
        group, name = split_label(spell_label(request.group, request.name), self.vocabulary)
        anchor = _anchor(part)
        edit = Correction(anchor.mesh, group, name, anchor.fingerprint, anchor.centroid, request.this_only)
        return edit, f"{self._called(part)} is {spell_label(group, name)}{_ALONE if request.this_only else ''}"

    def _forget(self, request: ForgetRequest) -> tuple[Edit, str]:
        part = self.graph.part(request.part)
        mesh = next((mesh for mesh in part.meshes if mesh in self.corrected), None)
        if mesh is None:
            raise ValueError(
                f"{request.part}: nobody corrected this part itself; 'cadgraph explain' names the one that was"
            )
        anchor = _anchor(part)
        edit = Forget(Anchor(mesh, anchor.fingerprint, anchor.centroid))
        return edit, f"correction of {self._called(part)} taken back"

    def _ground(self, request: GroundRequest) -> tuple[Edit, str]:
        part = self.graph.part(request.part)
        if part.ground == request.ground:
            raise ValueError(f"{part.id} is {'the ground' if part.ground else 'no ground'} already")
        row = self._row_of[part.meshes[0]]
        anchor = anchor_of(part.meshes[0], self.analysis.properties, row, self.analysis.scene.origin)
        said = "the ground" if request.ground else "no ground"
        return Ground(anchor, request.ground), f"{self._called(part)} is {said}"

    # Units

    def _merge(self, request: UnitRequest) -> tuple[Edit, str]:
        parts = self._parts(request.parts)
        units = self._units_of(parts)
        loose = [part for part in parts if self.graph.unit_of(part) is None]
        self._refuse_ground(parts)
        if not units:
            raise ValueError(
                "none of these parts is in a unit; correct the label of one first, so that there is a unit"
            )
        if len(units) == 1 and not loose:
            raise ValueError(f"all these parts are in {units[0].tag} already")
        _refuse_far([*units, *loose])
        names = [*(unit.tag for unit in units), *map(_named, loose)]
        return Merge(tuple(map(_anchor, parts))), f"{_listed(names)} are one unit"

    def _split(self, request: UnitRequest) -> tuple[Edit, str]:
        parts = self._parts(request.parts)
        units = self._units_of(parts)
        outside = next((part for part in parts if self.graph.unit_of(part) is None), None)
        if outside is not None or len(units) != 1:
            where = f"{outside.id} is in none" if outside is not None else _listed([unit.tag for unit in units])
            raise ValueError(f"the parts to split off must be of one unit ({where})")
        (unit,) = units
        if len(parts) == len(unit.parts):
            few = "has only this part" if len(parts) == 1 else "has no parts but these"
            raise ValueError(f"{unit.tag} {few}, so that nothing would be left of it")
        return Split(tuple(map(_anchor, parts))), f"{_listed([_named(part) for part in parts])} apart from {unit.tag}"

    def _tag(self, request: TagRequest) -> tuple[Edit, str]:
        unit, tag = self.graph.unit(request.unit), check_tag(request.tag)
        if tag == unit.tag and tag in self.tags:
            raise ValueError(f"{unit.tag} is called so already, and keeps it")
        if _IDS.fullmatch(tag):
            raise ValueError(f"tag {tag!r}: ids of the graph and numbers of lines look like this; give it another one")
        if "," in tag:
            raise ValueError(f"tag {tag!r}: a comma stands between tags; give it one without")
        if (mark := next((mark for mark in _MARKS if mark in tag), None)) is not None:
            raise ValueError(f"tag {tag!r}: {mark} stands between names where commands take them; give it one without")
        words = f"{unit.tag} keeps its tag" if tag == unit.tag else f"{unit.tag} is called {tag}"
        return Tag(self._anchors_of(unit), tag), words

    def _device(self, request: DeviceRequest) -> tuple[Edit, str]:
        unit, device = self.graph.unit(request.unit), check_tag(request.device)
        if unit.kind == device:
            raise ValueError(f"{unit.tag} is a {device} already")
        return Device(self._anchors_of(unit), device), f"{unit.tag} is a {device}"

    def _refuse_tags(self, requests: Sequence[TagRequest]) -> None:
        """Refuses a tag that another unit would have once all are given: two units may change tags with each other."""
        given = {self.graph.unit(request.unit).id: check_tag(request.tag) for request in requests}
        for unit, tag in given.items():
            for other in self.graph.units():
                called = given.get(other.id, other.tag)
                if other.id != unit and (called == tag or (loose_tag(tag) and loose_tag(called) == loose_tag(tag))):
                    raise ValueError(f"tag {tag!r}: another unit is called {called}; tags must differ")

    # Joints and directions

    def _join(self, request: JointRequest) -> tuple[Edit, str]:
        first, second = self._pair(request)
        if self._joined(first, second):
            raise ValueError(f"{first.id} and {second.id} are joined already")
        units = [self.graph.unit_of(part) for part in (first, second)]
        if units[0] is not None and units[0] == units[1]:
            raise ValueError(f"{first.id} and {second.id} are both parts of {units[0].tag}")
        _refuse_far([first, second])
        return Join(_anchor(first), _anchor(second)), f"{self._called(first)} joins {self._called(second)}"

    def _cut(self, request: JointRequest) -> tuple[Edit, str]:
        first, second = self._pair(request)
        if not self._joined(first, second):
            raise ValueError(f"{first.id} and {second.id} are not joined; 'cadgraph explain' lists what joins what")
        return Cut(_anchor(first), _anchor(second)), f"{self._called(first)} does not join {self._called(second)}"

    def _direction(self, request: DirectionRequest) -> tuple[Edit, str]:
        ends = [self.graph.find(which, Unit, Junction, Terminal) for which in (request.source, request.target)]
        source, target = (cast("_Place", end) for end in ends)
        edge = self._connection(source, target, request.via)
        onward = edge.source == source.id
        via = edge.via if onward else edge.via[::-1]
        path = edge.path if onward else edge.path[::-1]
        places = (path[0], path[-1]) if path else (_where(source), _where(target))
        anchors = tuple(_anchor(self.graph.part(part)) for part in via)
        edit = Direction(self._anchors_of(source), self._anchors_of(target), anchors, places, request.flow)
        names = [_name(place) for place in (source, target)]
        if request.flow == "unknown":
            return edit, f"direction between {names[0]} and {names[1]} taken back"
        return edit, "it flows from {} to {}".format(*(names if request.flow == "forward" else names[::-1]))

    def _connection(self, source: _Place, target: _Place, via: tuple[str, ...] | None) -> Connected:
        """The connection of two places over these parts."""
        between = [
            edge for edge in self.graph.connections(source) if {edge.source, edge.target} == {source.id, target.id}
        ]
        names = f"{_name(source)} and {_name(target)}"
        if not between:
            raise ValueError(f"nothing connects {names} without another unit or junction between; 'cadgraph lines'")
        meant = [edge for edge in between if via is None or via in (edge.via, edge.via[::-1])]
        if len(meant) != 1:
            count = "several connections" if len(meant) > 1 else "no connection over these parts"
            raise ValueError(f"{count} between {names}; name the parts between in order")
        return meant[0]

    # What is there

    @cached_property
    def _row_of(self) -> Mapping[str, int]:
        return {path: row for row, path in enumerate(self.analysis.scene.paths)}

    @cached_property
    def _made(self) -> frozenset[frozenset[str]]:
        return frozenset(frozenset((joint.first, joint.second)) for joint in self.graph.joints(made=True))

    def _joined(self, first: Part, second: Part) -> bool:
        return frozenset((first.id, second.id)) in self._made

    def _pair(self, request: JointRequest) -> tuple[Part, Part]:
        for which in (request.first, request.second):
            node = self.graph.nodes.get(which) or next((u for u in self.graph.units() if u.tag == which), None)
            if isinstance(node, Unit):
                raise ValueError(f"{which} is a unit, and parts join: name that one of its own, {_listed(node.parts)}")
        first, second = self.graph.part(request.first), self.graph.part(request.second)
        if first.id == second.id:
            raise ValueError(f"{first.id}: a part is not joined with itself")
        self._refuse_ground((first, second))
        return first, second

    def _parts(self, names: Sequence[str]) -> list[Part]:
        """The parts of these names, each once."""
        found = {part.id: part for part in map(self.graph.part, names)}
        if not found:
            raise ValueError("name at least one part")
        return list(found.values())

    def _units_of(self, parts: Sequence[Part]) -> list[Unit]:
        found = (self.graph.unit_of(part) for part in parts)
        return list({unit.id: unit for unit in found if unit is not None}.values())

    def _refuse_ground(self, parts: Sequence[Part]) -> None:
        ground = next((part for part in parts if part.ground), None)
        if ground is not None:
            raise ValueError(f"{ground.id} is the ground, which belongs to nothing; say first that it is none")

    def _anchors_of(self, place: _Place) -> tuple[Anchor, ...]:
        """The parts that a unit, junction or terminal is known by, the largest first."""
        parts = [self.graph.part(part) for part in place.parts]
        return tuple(_anchor(part) for part in sorted(parts, key=lambda part: (-part.area, part.id))[:_MOST_ANCHORS])

    def _called(self, part: Part) -> str:
        """A part as it is known in the plant, and by its id, which alone names it."""
        unit = self.graph.unit_of(part)
        return _named(part) if unit is None else f"{_named(part)} ({unit.tag})"


def _refuse_two_answers(done: Sequence[tuple[Edit, str]]) -> None:
    """Refuses that one correction says two things of the same: whichever came last would win without a word."""
    said: dict[tuple[object, ...], tuple[object, str]] = {}
    for number, (edit, words) in enumerate(done):
        subject, value = _what_is_said(edit, number)
        before = said.setdefault(subject, (value, words))
        if before[0] != value:
            raise ValueError(f"{before[1]}, and {words}: both in one correction; say one of them")


def _what_is_said(edit: Edit, number: int) -> tuple[tuple[object, ...], object]:
    """What an edit is about, and what it says of it."""
    if isinstance(edit, Direction):
        turned = edit.ends[0] > edit.ends[1]
        return ("direction", frozenset(edit.ends)), {"forward": not turned, "backward": turned}.get(edit.flow)
    # A joint that is to be made is none yet, and one to be cut is: no two say the opposite.
    return about(edit, number), type(edit) if isinstance(edit, Join | Cut) else edit


def _together(words: Sequence[str]) -> list[str]:
    """What was done, in words, what is said of several parts once: parts that are the same, above all."""
    subjects: dict[str, list[str]] = {}
    for each in words:
        subject, _, rest = each.partition(" is ")
        subjects.setdefault(rest, []).append(subject)
    return [
        each
        for rest, found in subjects.items()
        for each in (
            [f"{len(found):,} parts are {rest.removesuffix(_ALONE)}{', these alone' * rest.endswith(_ALONE)}"]
            if rest and len(found) > 1
            else found
            if not rest
            else [f"{found[0]} is {rest}"]
        )
    ]


def _anchor(part: Part) -> Anchor:
    extents = part.obb.extents
    fingerprint = Fingerprint(part.n_triangles, (math.sqrt(part.area), extents[0], extents[1], extents[2]))
    return Anchor(part.meshes[0], fingerprint, part.centroid)


def _named(part: Part) -> str:
    label = part.label
    return part.id if label is None else f"{label.name or label.group} {part.id}"


def _name(place: _Place) -> str:
    return place.tag if isinstance(place, Unit) else place.id


def _where(place: _Place) -> tuple[float, float, float]:
    return place.centroid if isinstance(place, Unit) else place.point


def _refuse_far(items: Sequence[Part | Unit]) -> None:
    """Makes sure that each of some things is near another one of them, by their boxes."""
    boxes = np.array([item.aabb for item in items])
    gaps = np.maximum(boxes[:, None, 0] - boxes[None, :, 1], boxes[None, :, 0] - boxes[:, None, 1])
    apart = np.linalg.norm(np.maximum(gaps, 0.0), axis=2)
    np.fill_diagonal(apart, np.inf)
    far = int(apart.min(axis=1).argmax())
    if apart[far].min() > FARTHEST:
        name = items[far].tag if isinstance(items[far], Unit) else items[far].id  # type: ignore[union-attr]
        gap = f"{apart[far].min():.1f} m"
        raise ValueError(f"{name} is {gap} away from the rest, and at most {FARTHEST:g} m are bridged: too far apart")


def _listed(names: Sequence[str]) -> str:
    shown = list(names[:3]) + ([f"{len(names) - 3} more"] if len(names) > 3 else [])
    return shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"
