"""The records that ``graph.json`` is made of: node and edge types, and the document itself (format version 1).

Lengths are metres, areas m2, volumes m3, angles radians; coordinates are world, right-handed, Z up.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeVar

import numpy as np
import numpy.typing as npt
from pydantic import Field, TypeAdapter

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.labels import Guess, Label
from cadgraph.model.record import Record

__all__ = [
    "BY_USER",
    "CUT",
    "ROWS_OF",
    "Access",
    "Adjacent",
    "Affordance",
    "AnyEdge",
    "AnyNode",
    "Box",
    "Cluster",
    "Connected",
    "Contains",
    "Dial",
    "Edge",
    "FreeFloor",
    "GraphDocument",
    "Joint",
    "Junction",
    "Mechanism",
    "Node",
    "OrientedBox",
    "Part",
    "Place",
    "Point",
    "Port",
    "ReachedFrom",
    "Related",
    "Site",
    "SourceFact",
    "SourceRecord",
    "Stated",
    "System",
    "Terminal",
    "Unit",
    "document_schema",
    "points",
]

Point = tuple[float, float, float]
Box = tuple[Point, Point]
_Extent = Annotated[float, Field(ge=0)]
Size = tuple[_Extent, _Extent, _Extent]


class SourceRecord(Record):
    """Where the scene came from."""

    path: str = Field("", description="as the user gave it")
    sha256: str = ""
    meters_per_unit: float = Field(1.0, gt=0, description="length of one authored unit [m]")
    up_axis: str = "Z"
    n_meshes: int = Field(0, ge=0)
    n_triangles: int = Field(0, ge=0)
    referred: tuple[tuple[str, str], ...] = Field(
        default=(),
        exclude_if=lambda referred: not referred,
        description="other files that its geometry comes from: path from the folder of the file, sha256; absent where "
        "there is none",
    )


class OrientedBox(Record):
    """A box in any pose."""

    center: Point
    axes: tuple[Point, Point, Point] = Field(description="unit axes as rows, right-handed")
    extents: Size = Field(description="full side lengths along the axes [m]")


class SourceFact(Record):
    """One thing that the source file says of a part, a unit, or the whole; without influence unless it is asked for."""

    key: str = Field(description="class, predefined, type, name, spec, system, size, tag, description or layer")
    value: str = Field(description="as it stands in the file")
    where: str = Field(description="the place of it in the file: 'IfcValve.PredefinedType', 'att TYPE'")
    path: str | None = Field(
        default=None,
        exclude_if=lambda path: path is None,
        description="node of the source that it is said of; absent where that is a mesh of the part itself",
    )


def _facts(what: str) -> Any:
    return Field(default=(), exclude_if=lambda facts: not facts, description=f"{what}; absent where nothing")


class Site(Record):
    """The root; exactly one."""

    id: str
    layer: Literal["site"] = "site"
    facts: tuple[SourceFact, ...] = _facts("what the file says of nodes that are no part and no unit here")


class Cluster(Record):
    """One connected structure."""

    id: str
    layer: Literal["cluster"] = "cluster"
    kind: str | None = Field(
        default=None, description="'pipe system' where it holds a connector part, else its commonest group"
    )
    n_parts: int = Field(ge=0)
    centroid: Point
    aabb: Box


class Part(Record):
    """What the paper calls a mesh after grouping: one or more source meshes that act as one item."""

    id: str
    layer: Literal["part"] = "part"
    meshes: tuple[str, ...] = Field(description="source paths, the largest first", min_length=1)
    label: Label | None = None
    guesses: tuple[Guess, ...] = Field(default=(), description="what the labeler holds for possible; likeliest first")
    centroid: Point
    aabb: Box
    obb: OrientedBox
    area: float = Field(ge=0, description="[m2]")
    volume: float | None = Field(description="[m3]; null where the surface is not closed")
    n_triangles: int = Field(ge=0)
    shape: str = Field(description="shared by parts of the same shape in any pose")
    ground: bool = False
    inside: str | None = Field(
        default=None,
        exclude_if=lambda part: part is None,
        description="id of the innermost part that encloses it on all sides; absent where none does",
    )
    facts: tuple[SourceFact, ...] = _facts("what the file says of its meshes")


class Port(Record):
    """Where a line joins a unit: a nozzle, a flanged end, a gauge's foot."""

    name: str = Field(description="unique in its unit: N1, N2...")
    point: Point = Field(description="centre of the opening")
    direction: Point | None = Field(default=None, description="unit vector out of the unit")
    diameter: float | None = Field(
        default=None, ge=0, description="bore, else outer diameter, of the line that joins here [m]"
    )


class Access(Record):
    """Where one stands to work at a unit, or to read it, and which way its face looks."""

    place: str | None = Field(
        description="id of the place that it is reached from; where it is out of reach, of the level below it"
    )
    stand: Point | None = Field(description="where one stands, on the floor; null where nobody gets near")
    height: float = Field(description="of its operator or face above that place [m]; of its middle, where it has none")
    reach: Literal["floor", "platform", "out of reach"] = Field(
        description="'floor': from the ground; 'platform': from another level that a way leads up to; within 0.9 m of "
        "where one stands and at most 2.0 m above it"
    )
    facing: Point | None = Field(default=None, description="unit vector out of a gauge's face; null where unknown")
    facing_confidence: float | None = Field(default=None, ge=0, le=1, description="of the facing")
    viewpoint: Point | None = Field(
        default=None, description="of an eye that sees a gauge's face, nothing in between; null where none was found"
    )


class Dial(Record):
    """The face of a gauge that a needle stands over."""

    center: Point
    normal: Point = Field(description="unit vector out of the face")
    radius: float = Field(ge=0, description="of the face [m]")
    up: Point = Field(description="unit vector in the face, towards where twelve stands")


class Mechanism(Record):
    """What moves at a unit, about an axis: the wheel or lever of a valve, the needle of a gauge."""

    kind: Literal["handwheel", "lever", "gear operator", "needle"]
    meshes: tuple[str, ...] = Field(description="source paths of what moves, the largest first", min_length=1)
    pieces: tuple[int, ...] = Field(
        default=(),
        exclude_if=lambda pieces: not pieces,
        description="where only pieces of the one mesh move: their numbers in the order of their first triangles, a "
        "piece being what hangs together by corners in the same place; absent where whole meshes move",
    )
    axis: Point = Field(
        description="unit vector out of the unit, towards the one who turns or reads it; angles count anticlockwise "
        "as seen from there"
    )
    pivot: Point = Field(description="on the axis, amid what moves")
    radius: float = Field(
        ge=0, description="from the axis to the middle of the rim, the lever's end, the needle's tip [m]"
    )
    thickness: float | None = Field(default=None, ge=0, description="of what a hand grips: half its width [m]")
    limits: tuple[float, float] = Field(description="least and greatest angle [deg]; 0 is as drawn")
    open: float | None = Field(default=None, description="angle at which the valve is open [deg]; null for needles")
    shut: float | None = Field(default=None, description="angle at which the valve is shut [deg]; null for needles")
    sources: dict[str, str] = Field(
        default_factory=dict, description="how each of these was found, or why it is assumed, in words, by its name"
    )


Affordance = Literal["turn", "pull", "read"]
"""What can be done at a unit by hand or eye."""


class Unit(Record):
    """A functional unit: connected parts that work as one valve, gauge, pump, tank..."""

    id: str
    layer: Literal["unit"] = "unit"
    unit_type: str
    tag: str
    kind: str | None = Field(default=None, description="ball valve, check valve, pressure gauge... where it is known")
    kind_guesses: tuple[tuple[str, float], ...] = Field(
        default=(),
        exclude_if=lambda guesses: not guesses,
        description="the likeliest kinds with their confidences where the kind is open; absent otherwise",
    )
    parts: tuple[str, ...]
    ports: tuple[Port, ...] = ()
    centroid: Point
    aabb: Box
    access: Access | None = Field(
        default=None,
        exclude_if=lambda access: access is None,
        description="how people get at it; absent where nothing is known of the places of a plant",
    )
    affordances: tuple[Affordance, ...] = Field(
        default=(),
        exclude_if=lambda affordances: not affordances,
        description="'turn': a wheel; 'pull': a lever; 'read': a gauge; absent where there is nothing of these",
    )
    mechanism: Mechanism | None = Field(
        default=None,
        exclude_if=lambda mechanism: mechanism is None,
        description="what moves, and how; absent where none was found",
    )
    dial: Dial | None = Field(
        default=None, exclude_if=lambda dial: dial is None, description="of a gauge; absent where none was found"
    )
    facts: tuple[SourceFact, ...] = _facts("what the file says of nodes above several of its parts")

    def __hash__(self) -> int:
        return hash(self.id)


class Junction(Record):
    """A point where three or more branches of connectors meet."""

    id: str
    layer: Literal["junction"] = "junction"
    point: Point
    parts: tuple[str, ...]


class Terminal(Record):
    """Where a run ends without a unit."""

    id: str
    layer: Literal["terminal"] = "terminal"
    kind: Literal["open", "blind", "unknown"] = Field(
        default="unknown", description="an open pipe end, or one that is closed"
    )
    point: Point
    parts: tuple[str, ...]


class System(Record):
    """One connected functional network."""

    id: str
    layer: Literal["system"] = "system"
    units: tuple[str, ...]
    junctions: tuple[str, ...] = ()
    terminals: tuple[str, ...] = ()
    length: float | None = Field(default=None, ge=0, description="of all its connections along the centrelines [m]")
    sizes: tuple[int, ...] = Field(default=(), description="nominal sizes (DN) of its lines, ascending")


class FreeFloor(Record):
    """The squares of a level on which a person can stand: nothing from 0.1 to 1.8 m above them within 0.2 m."""

    origin: tuple[float, float] = Field(description="x and y of the corner where both are least [m]")
    step: float = Field(gt=0, description="side of a square [m]")
    size: tuple[int, int] = Field(description="squares along x, squares along y")
    runs: tuple[int, ...] = Field(
        description="lengths of runs of squares, row by row from the least y, each from the least x; squares that are "
        "not free first, then free ones, and so on by turns"
    )


class Place(Record):
    """A level that one can stand on, or a way up to one."""

    id: str = Field(description="numbered by height, then by position: place-001...")
    layer: Literal["place"] = "place"
    kind: Literal["ground", "platform", "stairs", "ladder"]
    name: str = Field(description="'ground', 'platform +2.10 m (north east)'")
    height: float = Field(description="of the surface to stand on; of a way up, its top [m]")
    low: float | None = Field(default=None, description="of a way up: the height that it starts from [m]")
    area: float = Field(ge=0, description="to stand on, of what nothing else stands on [m2]; 0 for ways up")
    aabb: Box
    parts: tuple[str, ...]
    floor: FreeFloor | None = Field(
        default=None, exclude_if=lambda floor: floor is None, description="where one can stand; absent for ways up"
    )
    landings: tuple[Point, ...] = Field(
        default=(),
        exclude_if=lambda landings: not landings,
        description="of a way up: where one stands at its foot and at each level that it leads to, the lowest first",
    )


class Contains(Record):
    """Site to cluster, cluster to part, system to unit, unit to part, place to the units reached from it."""

    source: str
    target: str
    kind: Literal["contains"] = "contains"


class Adjacent(Record):
    """Two parts that touch or nearly do; stored once, source < target."""

    source: str
    target: str
    kind: Literal["adjacent"] = "adjacent"
    distance: float = Field(ge=0, description="between the surfaces [m], 0 where they touch or overlap")
    point: Point = Field(description="of contact or of closest approach")


class Connected(Record):
    """Two units, junctions or terminals, consecutive along connector parts."""

    source: str
    target: str
    kind: Literal["connected"] = "connected"
    via: tuple[str, ...] = Field(default=(), description="part ids in order")
    length: float | None = Field(default=None, ge=0, description="along the centreline [m]")
    diameter: float | None = Field(default=None, ge=0, description="nominal bore estimate [m]")
    size: int | None = Field(
        default=None, ge=0, description="nominal size (DN) by the standard tables of outer diameters"
    )
    sizes: tuple[int, ...] = Field(
        default=(), description="nominal sizes (DN) from the source to the target, where they change: reducers"
    )
    source_port: str | None = Field(default=None, description="name of the port at the source, where that is a unit")
    target_port: str | None = Field(default=None, description="name of the port at the target, where that is a unit")
    path: tuple[Point, ...] = Field(
        default=(), description="polyline along the centreline, from the source to the target"
    )
    direction: Literal["forward", "backward", "unknown"] = Field(
        default="unknown", description="of the flow; forward is from source to target"
    )
    reason: str | None = Field(default=None, description="why the flow has that direction")
    direction_confidence: float | None = Field(default=None, ge=0, le=1, description="of the direction")
    confidence: float | None = Field(default=None, ge=0, le=1, description="of the connection itself")


class Related(Record):
    """Two units that Algorithm 1 of the paper relates."""

    source: str
    target: str
    kind: Literal["related"] = "related"


class ReachedFrom(Record):
    """From a level to a way up to it, and from that to the level that it starts on."""

    source: str
    target: str
    kind: Literal["reached_from"] = "reached_from"


BY_USER, CUT = "joined by a user", "cut by a user"
"""The only reason of a joint that a user made, or cut."""


class Joint(Record):
    """A place where two parts join along the pipes, or might have: what the connections are decided from."""

    first: str = Field(description="id of the part that carries the line that ends there, or of a solid")
    second: str = Field(description="id of the other part")
    kind: Literal["face", "corner", "tap", "mount", "side", "flange"] = Field(
        description="'face': end to end; 'corner': likewise at an angle; 'tap': an end on the side of a line; "
        "'mount': an end at a solid; 'side': a solid on the side of a line; 'flange': solid to solid"
    )
    point: Point
    gap: float = Field(description="between the two [m]; negative where one lies in the other")
    score: float = Field(ge=0, le=1, description="how sure it is that they join")
    made: bool = Field(description="whether the network joins them")
    reasons: tuple[str, ...] = Field(default=(), description="what speaks for and against it, in words")


class Stated(Record):
    """Two places of the source that it says itself are joined along a pipe, and which way it flows there."""

    first: tuple[str, ...] = Field(
        description="ids of the parts that it is: one for a mesh, several for a node above meshes; none where nothing "
        "of it is in the graph, or where it is a node above more than 2,000 meshes"
    )
    second: tuple[str, ...] = Field(description="likewise of what it is joined to")
    first_path: str = Field(description="path in the source: of a mesh, or of a node above meshes")
    second_path: str = Field(description="likewise")
    flow: Literal["forward", "backward", "unknown"] = Field(
        default="unknown", description="what the source says of the flow; forward is from first to second"
    )
    where: str = Field(
        default="", description="by what the source says so: 'IfcRelConnectsPorts', 'order in branch'..."
    )


Node = Site | Cluster | Part | Unit | Junction | Terminal | System | Place
Edge = Contains | Adjacent | Connected | Related | ReachedFrom
_NodeField = Annotated[Node, Field(discriminator="layer")]
_EdgeField = Annotated[Edge, Field(discriminator="kind")]
AnyNode = TypeVar("AnyNode", Site, Cluster, Part, Unit, Junction, Terminal, System, Place)
AnyEdge = TypeVar("AnyEdge", Contains, Adjacent, Connected, Related, ReachedFrom)


ROWS_OF = ("nodes", "edges", "joints", "stated", "diagnostics")
"""What of a document is many rows."""


class GraphDocument(Record):
    """``graph.json`` as it stands on disk."""

    format: Literal["cadgraph"] = "cadgraph"
    version: Literal[1] = 1
    directed: Literal[True] = True
    multigraph: Literal[True] = True
    graph: dict[str, Any] = Field(default_factory=dict)
    source: SourceRecord = Field(default_factory=lambda: SourceRecord.model_validate({}))
    vocabulary: dict[str, Any] = Field(default_factory=dict)
    config: dict[str, Any] = Field(default_factory=dict)
    nodes: tuple[_NodeField, ...]
    edges: tuple[_EdgeField, ...]
    joints: tuple[Joint, ...] = Field(
        default=(),
        exclude_if=lambda joints: not joints,
        description="what the connections are made of, and the likeliest joints that were not made; absent where none",
    )
    stated: tuple[Stated, ...] = Field(
        default=(),
        exclude_if=lambda stated: not stated,
        description="what the source itself says is joined to what; absent where it says nothing",
    )
    diagnostics: tuple[Diagnostic, ...] = ()

    def content(self) -> dict[str, Any]:
        """What stands on disk: plain values, but for the rows, which stay records."""
        rows: dict[str, tuple[Record, ...]] = {key: getattr(self, key) for key in ROWS_OF}
        # One row of each is enough for what stands where.
        few = self.model_copy(update={key: some[:1] for key, some in rows.items()}).model_dump(mode="json")
        return {key: rows.get(key) or value for key, value in few.items()}


def document_schema() -> dict[str, Any]:
    """The JSON schema of ``graph.json``."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **TypeAdapter(GraphDocument).json_schema(mode="serialization"),
    }


def points(rows: npt.ArrayLike) -> tuple[Point, ...]:
    """Rows of three numbers as points, rounded to a nanometre so that no rounding noise reaches the file."""
    values = np.round(np.asarray(rows, np.float64).reshape(-1, 3), 9) + 0.0
    return tuple((x, y, z) for x, y, z in values.tolist())
