"""Lines as Isogen piping component files (PCF), one for each, for isometrics, stress analysis and piping tools.

Keywords follow the PCF examples of PTC Creo's piping help ("Weld Components in a PCF File", "Creating Pipe Component
Information"), symbol keys (SKEY) AVEVA's list of them ("VALV Symbol Keys", "FLAN Symbol Keys", "INST Symbol Keys",
"PCOM Symbol Keys", E3D Design) and PTC's symbol map. Coordinates are millimetres, angles hundredths of a degree.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import printable
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.records import Part, Point
from cadgraph.query.components import find_components
from cadgraph.query.piped_line import Branch, Component, LineEnd, PipedLine

__all__ = ["write_pcf"]

_HEAD = ("ISOGEN-FILES ISOGEN.FLS", "UNITS-BORE MM", "UNITS-CO-ORDS MM", "UNITS-WEIGHT KGS")
_LONGEST = 200  # characters of a field; ours

# Component and symbol key by the kind of a component. ** stands for how the ends are joined.
_KEYWORDS: dict[str, tuple[str, str | None]] = {
    "pipe": ("PIPE", None),
    "bend": ("BEND", None),
    "elbow": ("ELBOW", "ELBW"),
    "tee": ("TEE", "TEBW"),
    "cross": ("CROSS", "CRBW"),
    "reducer": ("REDUCER-CONCENTRIC", "RCBW"),
    "flange": ("FLANGE", "FLWN"),
    "blind flange": ("FLANGE-BLIND", "FLBL"),
    "gasket": ("GASKET", None),
    "coupling": ("COUPLING", None),
    "union": ("UNION", None),
    "pipe cap": ("CAP", "KABW"),
    "strainer": ("FILTER", "FI**"),
    "expansion joint": ("MISC-COMPONENT", "EX**"),
    "hose": ("MISC-COMPONENT", "FX**"),
    "instrument": ("INSTRUMENT", "II**"),
    "tap": ("TEE-SET-ON", "TESO"),
    "branch outlet": ("OLET", None),
    "valve": ("VALVE", "VV**"),
}
_OTHER = ("MISC-COMPONENT", "NC**")
_VALVES = {
    "ball valve": "VB**",
    "butterfly valve": "VY**",
    "check valve": "CK**",
    "wafer check valve": "CK**",
    "plug valve": "VP**",
    "diaphragm valve": "VD**",
    "gate valve": "VT**",
    "globe valve": "VG**",
    "needle valve": "VN**",
    "relief valve": "VR**",
    "safety valve": "VR**",
    "pressure reducing valve": "VX**",
}
_DIRECTIONS = (("EAST", "WEST"), ("NORTH", "SOUTH"), ("UP", "DOWN"))  # along +x and -x, y, z
_MAIN = 0.98  # ours: share of a direction that lies along an axis
_CONTROL = ("control valve", "CV**")
_ASSUMED = {
    "elbow": "butt-welding ends (ELBW)",
    "tee": "butt-welding ends (TEBW)",
    "cross": "butt-welding ends (CRBW)",
    "reducer": "butt-welding ends",
    "flange": "welding neck (FLWN)",
    "pipe cap": "butt-welding ends (KABW)",
}
_DESCRIPTIONS = {"bend": "bend in a pipe", "tap": "branch set on a pipe"}


def write_pcf(graph: SceneGraph, folder: str | Path) -> tuple[tuple[Path, ...], tuple[Diagnostic, ...]]:
    """Writes a file for each line, ``L-0123.pcf``.

    Components stand in the order of the line, from end to end without a gap: where the graph joins two, they share
    the point. Bores are nominal sizes (DN), else measured. ``COMPONENT-ATTRIBUTE1`` holds the ids of the parts,
    ``ITEM-CODE`` a generic code by kind and bore, as the graph knows no catalogue.

    Args:
        graph: the finished graph.
        folder: where to; made if missing.

    Returns:
        The files in the order of the line list, and notes: ``no-centreline`` and ``no-component`` (a line that could
        not be written), ``missing-joint``, ``no-part`` (a connection that the graph has no part of), ``measured-bore``,
        ``unknown-bore``, ``assumed-ends`` (what a symbol key says that the graph doesn't know), ``unknown-symbol``
        (written without a key), ``unknown-flat`` (of an eccentric reducer), ``no-branch`` and ``no-turn`` (a tee, an
        elbow that the graph shows otherwise; a ``MISC-COMPONENT``), ``tap-not-written`` (a valve that sits on a tap).

    Raises:
        OutputError: a file can't be written.
    """
    notes = _Notes(graph)
    files = []
    for line in find_components(graph):
        notes.gather(line.notes)
        if not line.components:
            if not line.notes:
                notes.add("no-component", f"{line.line.tag}: nothing of it stands between what it joins", ())
            continue
        path = Path(folder) / f"{line.line.tag}.pcf"
        write_atomically(path, "\r\n".join(_lines(line, notes)) + "\r\n")
        files.append(path)
    return tuple(files), notes.all()


class _Notes:
    """What could not be written or was assumed; the same thing said of many parts is one note."""

    def __init__(self, graph: SceneGraph) -> None:
        self._graph = graph
        self._found: dict[tuple[str, str], dict[str, None]] = {}

    def gather(self, notes: Iterable[Diagnostic]) -> None:
        for note in notes:
            self._found.setdefault((note.code, note.message), {}).update(dict.fromkeys(note.meshes))

    def add(self, code: str, message: str, parts: Iterable[str]) -> None:
        nodes = (self._graph.nodes.get(part) for part in parts)
        meshes = [node.meshes[0] for node in nodes if isinstance(node, Part)][:1]
        self._found.setdefault((code, message), {}).update(dict.fromkeys(meshes))

    def all(self) -> tuple[Diagnostic, ...]:
        return tuple(Diagnostic(code, said, tuple(meshes)) for (code, said), meshes in sorted(self._found.items()))


def _lines(line: PipedLine, notes: _Notes) -> Iterator[str]:
    yield from _HEAD
    yield f"PIPELINE-REFERENCE {_field(line.line.tag)}"
    yield f"    ATTRIBUTE1 {_field(line.line.start_name)} - {_field(line.line.end_name)}"
    materials: dict[str, str] = {}
    yield from _end(line.start)
    for component in line.components:
        yield from _component(component, materials, notes)
    yield from _end(line.end)
    for component in line.components:
        for branch in component.branches:
            if branch.goes_on:
                yield from _end(LineEnd("pipeline", branch.point, branch.line))
    for outlet in line.outlets:
        yield from _component(outlet, materials, notes)
    yield from _taps(line, materials, notes)
    yield "MATERIALS"
    for code, description in sorted(materials.items()):
        yield f"ITEM-CODE {code}"
        yield f"    DESCRIPTION {description}"


def _end(end: LineEnd) -> Iterator[str]:
    place = f"    CO-ORDS {_point(end.point)}"
    if end.kind == "equipment":
        yield "END-CONNECTION-EQUIPMENT"
        yield place
        yield f"    CONNECTION-REFERENCE {_field('/'.join(filter(None, (end.name, end.port))))}"
    elif end.kind == "pipeline":
        yield "END-CONNECTION-PIPELINE"
        yield place
        yield f"    PIPELINE-REFERENCE {_field(end.name or '')}"
    else:
        yield {"open": "END-POSITION-OPEN", "closed": "END-POSITION-CLOSED"}.get(end.kind, "END-POSITION-NULL")
        yield place


def _component(component: Component, materials: dict[str, str], notes: _Notes) -> Iterator[str]:
    keyword, skey = _symbol(component, notes)
    bores = _bores(component, notes)
    yield keyword
    if keyword not in ("TEE-SET-ON", "OLET"):
        yield f"    END-POINT {_point(component.start)} {bores[0]}"
        yield f"    END-POINT {_point(component.end)} {bores[1]}"
    if component.centre is not None and keyword not in ("PIPE", "VALVE", "MISC-COMPONENT"):
        yield f"    CENTRE-POINT {_point(component.centre)}"
    for number, branch in enumerate(component.branches, 1):
        yield f"    BRANCH{number}-POINT {_point(branch.point)} {_branch_bore(branch, component, bores[0], notes)}"
    if skey is not None:
        yield f"    SKEY {skey}"
    if keyword in ("ELBOW", "BEND"):
        yield f"    ANGLE {round(math.degrees(component.angle) * 100)}"
    if component.offset is not None:
        yield from _flat(component, notes)
    if component.tag is not None:
        yield f"    TAG {_field(component.tag)}"
    yield from _tail(component, bores, keyword, materials)


def _flat(component: Component, notes: _Notes) -> Iterator[str]:
    """The flat side of an eccentric reducer: that to which its smaller end lies off."""
    offset = component.offset or (0.0, 0.0, 0.0)
    axis = max(range(3), key=lambda k: abs(offset[k]))
    if abs(offset[axis]) < _MAIN * math.hypot(*offset):
        notes.add("unknown-flat", "eccentric reducers whose flat side looks in no main direction", component.parts)
        return
    yield f"    FLAT-DIRECTION {_DIRECTIONS[axis][offset[axis] < 0]}"


def _tail(component: Component, bores: tuple[str, str], keyword: str, materials: dict[str, str]) -> Iterator[str]:
    branches = [_bore(branch.size, branch.diameter) or "0" for branch in component.branches if keyword == "OLET"]
    size = "X".join(dict.fromkeys((*bores, *branches)))
    code = f"{keyword}-{size}" if component.kind != "valve" else f"{_code(component.what or 'valve')}-{size}"
    what = _DESCRIPTIONS.get(component.kind) or component.what or component.kind
    materials[code] = f"{_field(what)} {size}"
    yield f"    ITEM-CODE {code}"
    if component.parts:
        yield f"    COMPONENT-ATTRIBUTE1 {_field(' '.join(component.parts))}"


def _symbol(component: Component, notes: _Notes) -> tuple[str, str | None]:
    keyword, skey = _KEYWORDS.get(component.kind, _OTHER)
    if component.kind == "valve":
        keyword, skey = _valve(component)
    elif component.kind == "reducer" and component.offset is not None:
        keyword, skey = "REDUCER-ECCENTRIC", "REBW"
    elif component.kind in ("tee", "cross") and not component.branches:
        notes.add("no-branch", f"{component.kind}s whose branches the graph doesn't have", component.parts)
        keyword, skey = _OTHER
    elif component.kind == "elbow" and component.centre is None:
        notes.add("no-turn", "elbows whose centreline doesn't turn", component.parts)
        keyword, skey = _OTHER
    if component.kind in _ASSUMED and keyword != "MISC-COMPONENT":
        notes.add("assumed-ends", f"{component.kind}s are written with {_ASSUMED[component.kind]}", component.parts)
    if skey is None:
        if keyword not in ("PIPE", "GASKET"):
            notes.add("unknown-symbol", f"{keyword} is written without a symbol key", component.parts)
        return keyword, None
    if skey.endswith("**"):
        # Ends that are neither are written as plain ones, which claims nothing.
        ends = "FL" if all(component.flanged) or (any(component.flanged) and component.kind == "valve") else "PL"
        if ends == "PL":
            notes.add(
                "assumed-ends", f"{component.kind}s without flanges are written with plain ends (PL)", component.parts
            )
        skey = skey.replace("**", ends)
    return keyword, skey


def _valve(component: Component) -> tuple[str, str]:
    if component.branches and len(component.branches) == 1:
        return "VALVE-3WAY", "V3**"
    if component.branches:
        return "VALVE-MULTIWAY", "NC**"
    if component.what == _CONTROL[0]:
        return "INSTRUMENT", _CONTROL[1]
    if component.angle and component.centre is not None:
        return "VALVE-ANGLE", "AR**" if component.what in ("relief valve", "safety valve") else "AV**"
    return "VALVE", _VALVES.get(component.what or "", "VV**")


def _taps(line: PipedLine, materials: dict[str, str], notes: _Notes) -> Iterator[str]:
    """What sits on taps: instruments by a dial at the pipe."""
    for tag, kind, point in line.instruments:
        if kind is not None and "valve" in kind:
            notes.add("tap-not-written", f"{line.line.tag}: {tag} ({kind}) sits on a tap", ())
            continue
        yield "INSTRUMENT-DIAL"
        yield f"    CO-ORDS {_point(point)}"
        yield "    SKEY IDPL"
        yield f"    TAG {_field(tag)}"
        code = _code(kind or "instrument")
        materials[code] = _field(kind or "instrument")
        yield f"    ITEM-CODE {code}"


def _bores(component: Component, notes: _Notes) -> tuple[str, str]:
    found = [_bore(s, d) for s, d in zip(component.sizes, component.diameters, strict=True)]
    if None in component.sizes:
        code = "measured-bore" if any(component.diameters) else "unknown-bore"
        said = "the measured bore" if any(component.diameters) else "bore 0"
        notes.add(code, f"components without a nominal size are written with {said}", component.parts)
    first, last = found[0] or found[1] or "0", found[1] or found[0] or "0"
    return first, last


def _branch_bore(branch: Branch, component: Component, run: str, notes: _Notes) -> str:
    """The bore of a branch; that of an outlet set on a pipe is never taken to be the pipe's."""
    found = _bore(branch.size, branch.diameter)
    if component.kind != "branch outlet":
        return found or run
    if branch.size is None:
        code, said = ("measured-bore", "the measured bore") if found else ("unknown-bore", "bore 0")
        notes.add(code, f"components without a nominal size are written with {said}", component.parts)
    return found or "0"


def _bore(size: int | None, diameter: float | None) -> str | None:
    if size is not None:
        return str(size)
    return f"{diameter * 1000:.1f}" if diameter else None


def _point(point: Point) -> str:
    # A tenth of a micrometre, with no minus zero.
    return " ".join(f"{round(c * 1000, 4) + 0.0:.4f}" for c in point)


def _code(text: str) -> str:
    return (
        "".join(letter if letter.isascii() and letter.isalnum() else "-" for letter in text.upper())[:_LONGEST] or "X"
    )


def _field(text: str) -> str:
    """A text on one line."""
    return " ".join(printable(text)[:_LONGEST].split()) or "-"
