"""``animation.usda``: what a plant does while a timetable is played, as time samples over ``simulation.usda``.

Every USD viewer shows it: what turns is turned by samples of an angle about the axis of its joint, and what a simulator
would do to it is switched off. The joints of ``simulation.usda`` say what turns about what, so that an angle means the
same here as there.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdPhysics

from cadgraph._io.atomic import write_atomically
from cadgraph.errors import LoadError
from cadgraph.model.scene import Floats
from cadgraph.simulate.play.film import Film

__all__ = ["write_animation"]

_DIGITS = 4  # of an angle [deg]: a ten-thousandth of a degree moves the rim of a wheel by less than a micrometre
_RESTATED = ("defaultPrim", "upAxis", "metersPerUnit", "kilogramsPerUnit")
_ARTICULATIONS = ("PhysicsArticulationRootAPI", "PhysxArticulationAPI", "NewtonArticulationRootAPI")


def write_animation(film: Film, simulation: str | Path, path: str | Path) -> tuple[str, ...]:
    """Writes a film as a layer of time samples over a stage that can be simulated.

    Args:
        film: what the plant does.
        simulation: ``simulation.usda``, whose joints are named as in the film; it stays as it is.
        path: the layer to write (``animation.usda``).

    Returns:
        The names of the joints of the film that the stage doesn't have, sorted.

    Raises:
        LoadError: the stage can't be opened.
        OutputError: the layer can't be written.
    """
    below, target = Path(simulation), Path(path)
    stage = _open(below)
    layer = Sdf.Layer.CreateAnonymous(".usda")
    _restate(layer, stage, below, target, film)
    found = {prim.GetName(): prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.RevoluteJoint)}
    with Sdf.ChangeBlock():
        _switch_off(layer, stage.Traverse())
        for name in film.joints:
            if name in found:
                _turn(layer, stage, UsdPhysics.RevoluteJoint(found[name]), film.angles(name))
    write_atomically(target, layer.ExportToString())
    return tuple(name for name in film.joints if name not in found)


def _open(path: Path) -> Any:
    try:
        return Usd.Stage.Open(os.path.abspath(path).replace(os.sep, "/"))
    except Tf.ErrorException:
        raise LoadError(f"{path}: can't be opened as USD; 'cadgraph simulate' writes it") from None


def _restate(layer: Any, stage: Any, below: Path, target: Path, film: Film) -> None:
    """Puts the layer over the stage; what a stage takes from its root layer alone is said again."""
    relative = os.path.relpath(below, target.parent).replace(os.sep, "/")
    layer.subLayerPaths.append(relative if relative.startswith("../") else f"./{relative}")
    for key in _RESTATED:
        if stage.GetRootLayer().pseudoRoot.HasInfo(key):
            layer.pseudoRoot.SetInfo(key, stage.GetRootLayer().pseudoRoot.GetInfo(key))
    layer.startTimeCode, layer.endTimeCode = 0.0, float(len(film.states) - 1)
    layer.timeCodesPerSecond = layer.framesPerSecond = float(film.per_second)


def _switch_off(layer: Any, prims: Iterable[Any]) -> None:
    """Takes bodies, joints and articulations out of the hands of a simulator, which would move them otherwise."""
    for prim in prims:
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            _set(layer, prim.GetPath(), "physics:rigidBodyEnabled", Sdf.ValueTypeNames.Bool, False)
        if prim.IsA(UsdPhysics.Joint):
            # Not just disabled: a joint between two bodies that are switched off is an error to validators.
            Sdf.CreatePrimInLayer(layer, prim.GetPath()).SetInfo("active", False)
        applied = [name for name in _ARTICULATIONS if name in prim.GetPrimTypeInfo().GetAppliedAPISchemas()]
        if applied:
            gone = Sdf.TokenListOp()
            gone.deletedItems = applied
            Sdf.CreatePrimInLayer(layer, prim.GetPath()).SetInfo("apiSchemas", gone)


def _turn(layer: Any, stage: Any, joint: Any, angles: Floats) -> None:
    """Turns the second body of a joint about its axis: the innermost steps of the body's placement.

    A turn about a coordinate axis is sampled as a number, not a matrix, so that what lies between two samples is a
    turn as well; steps before and after it put the coordinate axis where the joint's is.
    """
    targets = joint.GetBody1Rel().GetTargets()
    prim = stage.GetPrimAtPath(targets[0]) if targets else None
    if not prim:
        return
    path, place, pose = prim.GetPath(), joint.GetLocalPos1Attr().Get(), joint.GetLocalRot1Attr().Get()
    around: list[str] = []
    if place != Gf.Vec3f(0):
        _set(layer, path, "xformOp:translate:joint", Sdf.ValueTypeNames.Double3, Gf.Vec3d(place))
        around.append("xformOp:translate:joint")
    if pose != Gf.Quatf(1):
        _set(layer, path, "xformOp:orient:joint", Sdf.ValueTypeNames.Quatf, pose)
        around.append("xformOp:orient:joint")
    turn = f"xformOp:rotate{joint.GetAxisAttr().Get()}:played"
    spec = _set(layer, path, turn, Sdf.ValueTypeNames.Double, None)
    for number, angle in _changes(angles):
        layer.SetTimeSample(spec.path, float(number), angle)
    order = prim.GetAttribute("xformOpOrder").Get() or []
    steps = [*order, *around, turn, *(f"!invert!{step}" for step in reversed(around))]
    _set(layer, path, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, steps, Sdf.VariabilityUniform)


def _changes(angles: Floats) -> list[tuple[int, float]]:
    """The samples that say all: those between two of the same value are left out."""
    rounded = np.round(angles, _DIGITS) + 0.0
    same = np.zeros(len(rounded), bool)
    same[1:-1] = (rounded[1:-1] == rounded[:-2]) & (rounded[1:-1] == rounded[2:])
    if len(rounded) > 1 and (rounded == rounded[0]).all():
        same[-1] = True
    return [(int(number), float(rounded[number])) for number in np.flatnonzero(~same)]


def _set(layer: Any, path: Any, name: str, kind: Any, value: Any, variability: Any = Sdf.VariabilityVarying) -> Any:
    prim = Sdf.CreatePrimInLayer(layer, path)
    spec = prim.attributes.get(name) or Sdf.AttributeSpec(prim, name, kind, variability)
    if value is not None:
        spec.default = value
    return spec
