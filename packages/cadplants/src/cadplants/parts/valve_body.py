"""What all valves share: flanged bodies, and how finely a style models them."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.plant import Assembly, Component, Device, Turning, Unit
from cadplants.model.standards import PIPES
from cadplants.solids.mesh_ops import Shell, Solid, merge, moved
from cadplants.solids.transforms import IDENTITY
from cadplants.styles.modeling_style import ModelingStyle

__all__ = ["Piece", "assemble", "bore_of", "flipped"]

# What stays a mesh of its own where a valve is modelled as body and operator; an indicator sits on its actuator.
_OPERATORS = ("handwheel", "lever", "actuator", "position indicator")

_TURNS = {"handwheel": "handwheel", "lever": "lever"}

Piece = tuple[Solid, Floats, str, str]  # solid, pose, name, colour


def flipped(shell: Shell, length: float) -> Shell:
    """The mirror image of a flange shell for the other end of a body about z."""
    mirror = np.diag([1.0, 1.0, -1.0, 1.0])
    mirror[2, 3] = length
    return moved(shell, mirror)


def bore_of(dn: int, style: ModelingStyle) -> float:
    """The radius of a body's bore [m]; 0 where the style models solid."""
    return PIPES[dn].bore if style.hollow else 0.0


def assemble(
    pieces: list[Piece],
    kind: str,
    unit: str,
    style: ModelingStyle,
    contacts: tuple[tuple[int, int], ...],
    outlet: int,
    length: float,
) -> Device:
    """The device as fine as the style models valves; the first piece holds the inlet face, ``outlet`` the other."""
    geared = any(name == "gearbox" for _, _, name, _ in pieces)
    turning = [(pose, _TURNS[name]) for _, pose, name, _ in pieces if name in _TURNS]
    inner = [Turning("gear operator" if geared else kind).placed(pose) for pose, kind in turning][:1]
    if style.valve == "one":
        pieces, contacts, outlet = [_joined(pieces, "valve")], (), 0
    elif style.valve == "few":
        rest = [p for p in pieces if p[2] in _OPERATORS]
        pieces = [_joined([p for p in pieces if p[2] not in _OPERATORS], "valve body"), *rest]
        contacts, outlet = tuple((min(k, 1), k + 1) for k in range(len(rest))), 0
    assembly = Assembly(
        tuple(
            Component(s, "Valve assembly", name, style.color(c), pose, unit, turns=_turning(name, pose, inner))
            for s, pose, name, c in pieces
        ),
        contacts,
        (Unit(unit, "valve", kind),),
    )
    return Device(assembly, length, 0, outlet)


def _joined(pieces: list[Piece], name: str) -> Piece:
    """Pieces as one mesh of a name."""
    return merge([moved(solid, pose) for solid, pose, _, _ in pieces]), IDENTITY, name, "valve"


def _turning(name: str, pose: Floats, inner: list[Turning]) -> Turning | None:
    """What turns of a mesh, in its own frame: an operator does, and so does a piece of a valve in one mesh."""
    if not inner or (name not in _TURNS and name != "valve"):
        return None
    return inner[0].placed(np.linalg.inv(pose).astype(np.float64))
