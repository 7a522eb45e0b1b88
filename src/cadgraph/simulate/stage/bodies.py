"""Bodies and joints of what moves: one articulation for the whole plant, fixed to the ground."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Vt
from scipy.spatial.transform import Rotation

from cadgraph.export.usd_specs import apply_schemas, define_prim, set_attribute
from cadgraph.model.scene import Floats
from cadgraph.simulate.devices import BASE, DEVICES, JOINTS
from cadgraph.simulate.dynamics import Capsule, Device, grip
from cadgraph.simulate.stage.specs import point_at

__all__ = ["add_articulation", "add_body", "body_matrix"]

# Of the drive that sets a needle: [N m/deg], [N m s/deg], [N m]; ours: it follows in a tenth of a second, without
# overshoot. In the tensors of the engines the gains are per radian, 57.3 times these.
_NEEDLE_STIFFNESS, _NEEDLE_DAMPING, _NEEDLE_FORCE = 0.02, 0.002, 10.0
_IDENTITY = Gf.Quatf(1.0, 0.0, 0.0, 0.0)


def add_articulation(layer: Any, devices: Sequence[Device]) -> None:
    """The root of the articulation, its body that stands still, and the joint that holds it to the world."""
    root = Sdf.Path(DEVICES)
    prim = define_prim(layer, root, "Xform")
    apply_schemas(prim, "PhysicsArticulationRootAPI", "PhysxArticulationAPI", "NewtonArticulationRootAPI")
    # Bodies that move stand apart, and two wheels that meet would lock each other.
    set_attribute(prim, "physxArticulation:enabledSelfCollisions", "Bool", False)
    set_attribute(prim, "newton:selfCollisionEnabled", "Bool", False)
    base = define_prim(layer, root.AppendChild(BASE), "Xform")
    apply_schemas(base, "PhysicsRigidBodyAPI", "PhysicsMassAPI")
    _mass(base, 1000.0, np.full(3, 1000.0))
    define_prim(layer, root.AppendChild(JOINTS), "Scope")
    fixed = define_prim(layer, root.AppendChild(JOINTS).AppendChild(_fixed_name(devices)), "PhysicsFixedJoint")
    point_at(fixed, "physics:body1", [base.path])
    _frames(fixed, np.zeros(3), _IDENTITY)


def _fixed_name(devices: Sequence[Device]) -> str:
    """A name for the joint of the base that no tag has taken."""
    name, taken = BASE, {device.joint for device in devices}
    while name in taken:
        name += "_"
    return name


def add_body(layer: Any, device: Device) -> Any:
    """The body of a device with its joint and its colliders, where it is drawn; without what is to be seen of it."""
    path = Sdf.Path(DEVICES).AppendChild(device.joint)
    body = define_prim(layer, path, "Xform")
    apply_schemas(body, "PhysicsRigidBodyAPI", "PhysicsMassAPI")
    set_attribute(body, "xformOp:translate", "Double3", Gf.Vec3d(*device.pivot.tolist()))
    set_attribute(body, "xformOp:orient", "Quatd", _quaternion(device.turn))
    set_attribute(
        body, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:translate", "xformOp:orient"]), uniform=True
    )
    _mass(body, device.mass, device.inertia)
    if device.mechanism.kind != "lever":
        for number, capsule in enumerate(grip(device)):
            _capsule(layer, path.AppendChild(f"grip_{number:02d}"), capsule)
    _joint(layer, device, path)
    return body


def body_matrix(device: Device) -> Floats:
    """``(4, 4)`` for row vectors: from the world to the frame of the body."""
    matrix = np.eye(4)
    matrix[:3, :3] = device.turn.T
    matrix[3, :3] = -device.pivot @ device.turn.T
    return matrix


def _mass(prim: Any, mass: float, inertia: Floats) -> None:
    """With its middle on the joint's axis, so that no weight turns it."""
    set_attribute(prim, "physics:mass", "Float", float(mass))
    set_attribute(prim, "physics:centerOfMass", "Point3f", Gf.Vec3f(0.0))
    set_attribute(prim, "physics:diagonalInertia", "Float3", Gf.Vec3f(*inertia.tolist()))
    set_attribute(prim, "physics:principalAxes", "Quatf", _IDENTITY)


def _quaternion(turn: Floats, kind: Any = Gf.Quatd) -> Any:
    x, y, z, w = Rotation.from_matrix(turn.T).as_quat(canonical=True).tolist()
    return kind(w, x, y, z)


def _frames(joint: Any, place: Floats, turn: Any) -> None:
    set_attribute(joint, "physics:localPos0", "Point3f", Gf.Vec3f(*place.tolist()))
    set_attribute(joint, "physics:localRot0", "Quatf", turn)
    set_attribute(joint, "physics:localPos1", "Point3f", Gf.Vec3f(0.0))
    set_attribute(joint, "physics:localRot1", "Quatf", _IDENTITY)


def _joint(layer: Any, device: Device, body: Any) -> None:
    root = Sdf.Path(DEVICES)
    joint = define_prim(layer, root.AppendChild(JOINTS).AppendChild(device.joint), "PhysicsRevoluteJoint")
    apply_schemas(joint, "PhysxJointAPI", "PhysxJointAxisAPI:angular", "NewtonJointAPI")
    point_at(joint, "physics:body0", [root.AppendChild(BASE)])
    point_at(joint, "physics:body1", [body])
    set_attribute(joint, "physics:axis", "Token", "Z", uniform=True)
    _frames(joint, device.pivot, _quaternion(device.turn, Gf.Quatf))
    # Without limits the angle would wrap at a full turn.
    low, high = device.mechanism.limits
    set_attribute(joint, "physics:lowerLimit", "Float", low)
    set_attribute(joint, "physics:upperLimit", "Float", high)
    set_attribute(joint, "physxJoint:armature", "Float", device.armature)
    set_attribute(joint, "newton:armature", "Float", device.armature)
    if device.is_needle:
        apply_schemas(joint, "PhysicsDriveAPI:angular")
        set_attribute(joint, "drive:angular:physics:type", "Token", "force", uniform=True)
        set_attribute(joint, "drive:angular:physics:stiffness", "Float", _NEEDLE_STIFFNESS)
        set_attribute(joint, "drive:angular:physics:damping", "Float", _NEEDLE_DAMPING)
        set_attribute(joint, "drive:angular:physics:maxForce", "Float", _NEEDLE_FORCE)
        set_attribute(joint, "drive:angular:physics:targetPosition", "Float", 0.0)
        return
    # Dry friction and never a drive: a drive spoils the friction of one engine, and is none in another.
    set_attribute(joint, "newton:friction", "Float", device.friction)
    set_attribute(joint, "newton:damping", "Float", float(np.deg2rad(device.damping)))
    set_attribute(
        joint, "physxJointAxis:angular:viscousFrictionCoefficient", "Float", float(np.deg2rad(device.damping))
    )
    set_attribute(joint, "physxJointAxis:angular:staticFrictionEffort", "Float", device.friction)
    set_attribute(joint, "physxJointAxis:angular:dynamicFrictionEffort", "Float", device.friction)


def _capsule(layer: Any, path: Any, capsule: Capsule) -> None:
    prim = define_prim(layer, path, "Capsule")
    apply_schemas(prim, "PhysicsCollisionAPI")
    start, end = np.asarray(capsule.start), np.asarray(capsule.end)
    length = float(np.linalg.norm(end - start))
    set_attribute(prim, "axis", "Token", "Z", uniform=True)
    set_attribute(prim, "height", "Double", length)
    set_attribute(prim, "radius", "Double", capsule.radius)
    reach = 0.5 * length + capsule.radius
    low = Gf.Vec3f(-capsule.radius, -capsule.radius, -reach)
    set_attribute(prim, "extent", "Float3Array", Vt.Vec3fArray([low, -low]))
    set_attribute(prim, "purpose", "Token", "guide", uniform=True)
    way = Gf.Rotation(Gf.Vec3d(0, 0, 1), Gf.Vec3d(*(end - start).tolist())).GetQuat()
    set_attribute(prim, "xformOp:translate", "Double3", Gf.Vec3d(*(0.5 * (start + end)).tolist()))
    set_attribute(prim, "xformOp:orient", "Quatd", way)
    set_attribute(
        prim, "xformOpOrder", "TokenArray", Vt.TokenArray(["xformOp:translate", "xformOp:orient"]), uniform=True
    )
