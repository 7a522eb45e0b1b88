"""The joints of a plant as a table for programs that turn them (``devices.json``)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from cadgraph._io.json_rows import write_json_rows
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Scene
from cadgraph.simulate.dynamics import Device, grip, without_joint

__all__ = ["BASE", "DEVICES", "JOINTS", "write_devices"]

DEVICES = "/Plant/Devices"
"""The prim with the articulation; a body of it is called as its joint is."""
BASE, JOINTS = "base", "joints"
"""Below it: the body that stands still, and what holds the joints."""


def write_devices(graph: SceneGraph, scene: Scene, devices: Sequence[Device], path: str | Path) -> Path:
    """Writes the joints of a plant with where each number comes from, and what can't be moved, and why.

    Positions are those of the graph [m]; a stage whose source lies far out stands about ``origin_m``, which is to be
    taken off them there.

    Args:
        graph: the finished graph.
        scene: that it was made from.
        devices: the joints.
        path: the file (``devices.json``).

    Returns:
        The file.

    Raises:
        OutputError: it can't be written.
    """
    document = {
        "format": "cadgraph-devices",
        "version": 1,
        "source": {"path": graph.source.path, "sha256": graph.source.sha256},
        "stage": "simulation.usda",
        "articulation": DEVICES,
        "origin_m": _rounded(scene.origin),
        "devices": [_row(scene, device) for device in devices],
        "immovable": [
            {"tag": each.tag, "unit": each.unit, "reason": each.reason} for each in without_joint(graph, devices)
        ],
    }
    write_json_rows(path, document, ("devices", "immovable"))
    return Path(path)


def _row(scene: Scene, device: Device) -> dict[str, Any]:
    unit, mechanism = device.unit, device.mechanism
    row: dict[str, Any] = {
        "tag": unit.tag,
        "unit": unit.id,
        "unit_type": unit.unit_type,
        "kind": mechanism.kind,
        "joint": device.joint,
        "body": f"{DEVICES}/{device.joint}",
        "joint_path": f"{DEVICES}/{JOINTS}/{device.joint}",
        "axis": list(mechanism.axis),
        "pivot_m": list(mechanism.pivot),
        "zero": _rounded(device.turn[0]),
        "radius_m": mechanism.radius,
        "limits_deg": list(mechanism.limits),
        "open_deg": mechanism.open,
        "shut_deg": mechanism.shut,
        "friction_nm": round(device.friction, 6),
        "damping_nms": round(device.damping, 6),
        "armature_kgm2": device.armature,
        "mass_kg": round(device.mass, 6),
        "inertia_kgm2": _rounded(device.inertia),
        "grasp": _grasp(scene, device),
        "meshes": [scene.paths[each.mesh] for each in device.moving],
        "drawn": not device.moving,
        "sources": {**mechanism.sources, **device.why},
    }
    if mechanism.pieces:
        row["pieces"] = list(mechanism.pieces)
    if unit.dial is not None:
        row["dial"] = unit.dial.model_dump(mode="json")
    return row


def _grasp(scene: Scene, device: Device) -> dict[str, Any] | None:
    """What a hand closes about: the ring in the rim of a wheel, the bar along a lever; None of a needle."""
    shapes = grip(device)
    if not shapes:
        return None

    def placed(point: npt.ArrayLike) -> list[float]:
        return _rounded(np.asarray(point) @ device.turn + device.pivot + scene.origin)

    if device.mechanism.kind == "lever":
        (bar,) = shapes
        return {"shape": "bar", "start_m": placed(bar.start), "end_m": placed(bar.end), "thickness_m": bar.radius}
    return {
        "shape": "ring",
        "center_m": placed((0.0, 0.0, shapes[0].start[2])),
        "axis": list(device.mechanism.axis),
        "radius_m": device.mechanism.radius,
        "thickness_m": round(shapes[0].radius, 9),
    }


def _rounded(values: npt.ArrayLike) -> list[float]:
    """Numbers to a nanometre, so that no rounding noise reaches the file."""
    rounded: list[float] = (np.round(np.asarray(values, np.float64), 9) + 0.0).tolist()
    return rounded
