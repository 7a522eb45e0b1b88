"""What moves in a plant as a MuJoCo model (MJCF): a body, a hinge and colliders for each valve and needle.

MuJoCo collides the hulls of meshes only, so the plant that stands still is not written: it would become blocks. Rims,
spokes and levers are capsules.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt
from scipy.spatial.transform import Rotation

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import printable
from cadgraph.draw.render.color import to_srgb
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph
from cadgraph.model.scene import Faces, Floats, Scene
from cadgraph.simulate.dynamics import Device, find_devices, grip, without_joint

__all__ = ["write_mjcf"]

_GREY = (0.6, 0.6, 0.62)
_TIMESTEP = 0.002  # [s] MuJoCo's own
_NEEDLE = (2.0, 0.2)  # stiffness [N m/rad] and damping [N m s/rad] of the servo that sets a needle; ours: 0.3 s
_MESHES = "meshes"


def write_mjcf(
    graph: SceneGraph, scene: Scene, path: str | Path, needles: bool = False
) -> tuple[tuple[Path, ...], tuple[Diagnostic, ...]]:
    """Writes a model, and the meshes that it shows into the folder ``meshes`` beside it, in metres, Z up.

    Joints are called as the tags of their units are (``V_001``); valves turn against dry friction without a motor,
    needles have a position actuator of the same name, in radians.

    Args:
        graph: the finished graph.
        scene: that it was made from.
        path: the model (``plant.xml``); its folder is made if missing.
        needles: whether gauges without a needle get one, where their dial is known.

    Returns:
        The files, and what could not be written (``immovable``).

    Raises:
        ValueError: the graph names a mesh that the scene doesn't have.
        OutputError: a file can't be written.
    """
    model = Path(path)
    devices = find_devices(graph, scene, needles)
    root = ElementTree.Element("mujoco", model="plant")
    ElementTree.SubElement(root, "compiler", angle="degree", meshdir=_MESHES, autolimits="true")
    ElementTree.SubElement(root, "option", timestep=_text(_TIMESTEP), integrator="implicitfast")
    assets = ElementTree.SubElement(root, "asset")
    world = ElementTree.SubElement(root, "worldbody")
    actuators = ElementTree.SubElement(root, "actuator")
    files = []
    for device in devices:
        body = _body(world, device)
        for number, moving in enumerate(device.moving):
            name = f"{device.joint}_{number}"
            vertices, faces = device.local(scene, moving)
            files.append(model.parent / _MESHES / f"{name}.obj")
            write_atomically(files[-1], _obj(vertices, faces))
            ElementTree.SubElement(assets, "mesh", name=name, file=f"{name}.obj", inertia="shell")
            color = scene.colors[moving.mesh]
            shown = to_srgb(color).tolist() if np.isfinite(color).all() else _GREY
            ElementTree.SubElement(
                body, "geom", type="mesh", mesh=name, rgba=_text([*shown, 1.0]), contype="0", conaffinity="0",
                group="2", mass="0",
            )  # fmt: skip
        if not device.moving:
            _drawn_needle(body, device)
        _collide(body, device)
        if device.is_needle:
            gain, damping = _NEEDLE
            limits = np.deg2rad(device.mechanism.limits)
            ElementTree.SubElement(
                actuators, "position", name=device.joint, joint=device.joint, kp=_text(gain), kv=_text(damping),
                ctrlrange=_text(limits),
            )  # fmt: skip
    ElementTree.indent(root)
    write_atomically(model, ElementTree.tostring(root, encoding="unicode") + "\n")
    notes = tuple(
        Diagnostic("immovable", f"{printable(each.tag)} has no joint: {printable(each.reason)}")
        for each in without_joint(graph, devices, "needles=True of write_mjcf in Python")
    )
    return (model, *files), notes


def _body(world: ElementTree.Element, device: Device) -> ElementTree.Element:
    x, y, z, w = Rotation.from_matrix(device.turn.T).as_quat(canonical=True).tolist()
    body = ElementTree.SubElement(world, "body", name=device.joint, pos=_text(device.pivot), quat=_text([w, x, y, z]))
    joint = {
        "name": device.joint,
        "type": "hinge",
        "axis": "0 0 1",
        "range": _text(device.mechanism.limits),
        "armature": _text(device.armature),
    }
    if not device.is_needle:
        # Stiffer than MuJoCo's own, whose dry friction creeps under load.
        joint |= {"frictionloss": _text(device.friction), "damping": _text(device.damping)}
        joint |= {"solreffriction": "0.004 1", "solimpfriction": ".99 .999 .001"}
    ElementTree.SubElement(body, "joint", joint)
    ElementTree.SubElement(
        body, "inertial", pos="0 0 0", mass=_text(device.mass), diaginertia=_text(device.inertia)
    )  # fmt: skip
    return body


def _collide(body: ElementTree.Element, device: Device) -> None:
    for each in grip(device):
        ElementTree.SubElement(
            body, "geom", type="capsule", fromto=_text([*each.start, *each.end]), size=_text(each.radius), group="3",
            mass="0",
        )  # fmt: skip


def _drawn_needle(body: ElementTree.Element, device: Device) -> None:
    reach = device.mechanism.radius
    ElementTree.SubElement(
        body, "geom", type="box", pos=_text([0.4 * reach, 0, 0]), size=_text([0.6 * reach, 0.03 * reach, 0.01 * reach]),
        rgba="0.02 0.02 0.02 1", contype="0", conaffinity="0", group="2", mass="0",
    )  # fmt: skip


def _obj(vertices: Floats, faces: Faces) -> str:
    lines = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
    return "\n".join(lines) + "\n"


def _text(values: npt.ArrayLike) -> str:
    return " ".join(f"{value:.9g}" for value in np.atleast_1d(np.round(np.asarray(values, np.float64), 9) + 0.0))
