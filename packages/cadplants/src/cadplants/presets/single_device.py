"""One device of a family as a plant of its own: at random, or with parameters that are given."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from cadplants.builder.device import Device, Maker
from cadplants.model.contacts import measured, met
from cadplants.model.family import Family
from cadplants.model.plant import Plant
from cadplants.presets.taste import ALL_FAMILIES
from cadplants.styles.modeling_style import STYLES, ModelingStyle

__all__ = ["CARRIED", "draw_parameters", "family_called", "make_device", "rebuild", "usual_size"]

CARRIED = 1.1
"""Height of the line's axis over the floor where a carrier is asked for and nobody says [m]."""


def family_called(name: str) -> Family:
    """A family by its name.

    Raises:
        ValueError: there is none; the message has names that are near.
    """
    if name in ALL_FAMILIES:
        return ALL_FAMILIES[name]
    near = difflib.get_close_matches(name, ALL_FAMILIES, 3, 0.4)
    kinds = [other for other in ALL_FAMILIES if other.startswith(f"{name}/")][:5]
    said = ", ".join(dict.fromkeys(kinds + near))
    meant = f"did you mean {said}? " if said else ""
    raise ValueError(
        f"{name!r} is no family of devices; {meant}'cadgraph environment devices' lists all {len(ALL_FAMILIES)}"
    )


def usual_size(family: Family) -> int:
    """The nominal size in the middle of those that a family is made in."""
    return family.sizes[len(family.sizes) // 2] if family.sizes else 0


def draw_parameters(
    name: str, seed: int = 0, given: Mapping[str, Any] | None = None, style: str | ModelingStyle = "plant-design"
) -> Device:
    """The parameters of one device of a family.

    Args:
        name: of the family.
        seed: of what is not given; each parameter has a stream of random numbers of its own.
        given: parameters by name, ``dn`` among them.
        style: that will model it, or the name of a published one; what a style leaves out has no parameters.

    Raises:
        ValueError: no such family, style, size or parameter, or a value can't be.
    """
    family, told = family_called(name), dict(given or {})
    size = _size(family, told)
    told.pop("dn", None)
    height = (CARRIED,) if family.place == "carrier" else ()
    # All families that have a name here are classes of parameters.
    return cast(Maker, family.build).draw(size, _style_called(style), seed, *height, **told)


def _style_called(style: str | ModelingStyle) -> ModelingStyle:
    if isinstance(style, ModelingStyle):
        return style
    if style not in STYLES:
        raise ValueError(f"style {style!r}: give one of {', '.join(STYLES)}")
    return STYLES[style]


def _size(family: Family, given: Mapping[str, Any]) -> int:
    try:
        size = int(given.get("dn", usual_size(family)))
    except ValueError:
        size = -1
    if size not in family.sizes:
        raise ValueError(f"dn={given['dn']}: {family.name} is made in {', '.join(map(str, family.sizes))}")
    return size


def make_device(
    name: str,
    seed: int = 0,
    style: str | ModelingStyle = "plant-design",
    dn: int | None = None,
    given: Mapping[str, Any] | None = None,
) -> Plant:
    """One device of a family.

    Args:
        name: of the family, ``"ball valve/trunnion"``.
        seed: of what is not given.
        style: a modelling style, or the name of a published one.
        dn: nominal size [mm]; one in the middle of its range if None.
        given: parameters by name, of pieces as ``"drive.length"``.

    Raises:
        ValueError: no such family, style, size or parameter, or a value can't be.
    """
    style = _style_called(style)
    told = {**({"dn": dn} if dn is not None else {}), **(given or {})}
    return _alone(family_called(name), draw_parameters(name, seed, told, style), style, seed)


def rebuild(
    record: Mapping[str, Any],
    styles: Mapping[str, Mapping[str, Any]] | None = None,
    style: str | ModelingStyle | None = None,
) -> Plant:
    """The device of a record, a row of ``devices`` in the truth of a plant: clean, and in coordinates of its own.

    Args:
        record: with ``family``, ``build``, ``params`` and maybe ``style``.
        styles: what the same truth says of styles that have no name of their own.
        style: that it is to be modelled in; that of the record, or plant-design CAD, if None.

    Raises:
        ValueError: no such family or style, or the parameters are not those of the family.
    """
    name = str(record.get("style", "plant-design"))
    if style is None and name in (styles or {}):
        style = ModelingStyle.from_json((styles or {})[name])
    style = _style_called(name if style is None else style)
    family = family_called("/".join(str(record.get(key, "")) for key in ("family", "build")))
    params = record.get("params")
    if not isinstance(params, Mapping):
        raise ValueError(f"{family.name}: the record has no params")
    return _alone(family, cast(Maker, family.build).device.from_json(params), style, 0)


def _alone(family: Family, device: Device, style: ModelingStyle, seed: int) -> Plant:
    """A device as a plant of its own."""
    unit = "X-1" if family.unit else ""
    try:
        whole = device.as_device(style, unit).assembly if family.place == "inline" else device.as_assembly(style, unit)
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        raise ValueError(f"{family.name}: these parameters do not fit each other ({error})") from error
    if not all(np.isfinite(component.vertices).all() for component in whole.components):
        raise ValueError(f"{family.name}: these parameters do not fit each other: they make no solid")
    assembly = met(whole).marked(cluster="device", style=style.name)
    return measured(Plant.of(assembly, family.name, seed, [style]))
