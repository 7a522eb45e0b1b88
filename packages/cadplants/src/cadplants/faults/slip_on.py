"""Flanges that their pipe runs into, made of finished flanges."""

from __future__ import annotations

import numpy as np

from cadgraph.model.scene import Floats
from cadplants.model.standards import FLANGES, PIPES
from cadplants.parts.flange import face_shell, plate_thickness
from cadplants.solids.mesh_ops import Solid, about_x, revolve, shared, weld

__all__ = ["CLEARANCE", "slipped_on"]

CLEARANCE = 0.0005
"""Between the bore of a slip-on flange and its pipe, all round [m]: half of ASME B16.5's bore less the pipe's diameter,
0.4 to 0.8 mm for DN 15 to 100."""

_SAME = 0.0005  # m; a rim this near to a standard's is of that size
_EXACT = 1e-9  # m; rounding


def slipped_on(flange: Solid) -> Solid | None:
    """A slip-on flange of the same size, face and fineness, its bore open for the pipe.

    Args:
        flange: along x, its face at 0 looking to -x.

    Returns:
        None where the mesh is no plain flange of a standard's size: it carries its bolts, or is uneven.
    """
    radii = np.hypot(flange.vertices[:, 1], flange.vertices[:, 2])
    rim, x = float(radii.max()), flange.vertices[:, 0]
    dn = next((dn for dn, size in FLANGES.items() if abs(size.outer / 2 - rim) < _SAME), 0)
    length = float(x.max())
    # Bolts stand out before the face; an uneven face is not at 0.
    if not dn or abs(x.min()) > _EXACT or length < FLANGES[dn].thickness / 2:
        return None
    at_rim = radii > rim - _SAME / 10
    # The rim has a ring of corners at its front and one at its back.
    sides = round(int(at_rim.sum()) / 2)
    drilled = bool((np.abs(radii - FLANGES[dn].circle / 2) < 0.6 * FLANGES[dn].hole).any())
    flat = length <= plate_thickness(dn) + _SAME
    return _slip_on(dn, sides, drilled, round(length, 9) if flat else 0.0)


@shared
def _slip_on(dn: int, sides: int, drilled: bool, thickness: float) -> Solid:
    """The flange; a plain disc of this thickness [m], or one with a hub where that is 0."""
    size = FLANGES[dn]
    # Its flats, not its corners, clear the pipe.
    bore = (PIPES[dn].radius + CLEARANCE) / np.cos(np.pi / sides)
    if thickness:
        outline = [(bore, 0.0), (size.outer / 2, 0.0), (size.outer / 2, thickness), (bore, thickness)]
        return about_x(weld([revolve(outline, sides, closed=True)]))
    back, low, high = (
        max(size.hub / 2, 1.1 * bore),
        plate_thickness(dn),
        plate_thickness(dn) + size.slip - size.thickness,
    )
    hub: Floats = np.array([(back, low), (back, high), (bore, high), (bore, 0.0)])
    return about_x(weld([face_shell(dn, sides, back, bore, drilled), revolve(hub, sides)]))
