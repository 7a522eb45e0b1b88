from dataclasses import replace
from itertools import cycle

import numpy as np
import pytest

from cadgraph.model.vocabulary import default_vocabulary
from cadplants.model.family import UNIT, Family, Model, Part, as_assembly, as_device
from cadplants.model.plant import Device
from cadplants.presets.taste import ALL_FAMILIES
from cadplants.solids.primitives import box
from cadplants.styles.drawn_styles import draw_modeling_style
from cadplants.styles.modeling_style import STYLES
from plants.solids import is_closed, shell_volumes

# Every style, but none finer than 16 sides, so that hundreds of builds stay quick.
IN_STYLES = [
    replace(style, sides=(min(style.sides[0], 12), min(style.sides[1], 16)))
    for style in (*STYLES.values(), *(draw_modeling_style(np.random.default_rng(seed)) for seed in range(2)))
]


def built(family, dn, style, seed):
    rng = np.random.default_rng(seed)
    return family.build(dn, style, rng, 1.1) if family.place == "carrier" else family.build(dn, style, rng)


def sizes(family):
    return sorted({family.sizes[0], family.sizes[len(family.sizes) // 2], family.sizes[-1]})


def flaws(family, style, dn, seed):
    """What is wrong with a family as one hand builds it."""
    where = f"{family.name}, {style.name}, DN {dn}"
    assembly = as_assembly(family, built(family, dn, style, seed), style, "X-1")
    if not assembly.components:
        yield f"{where}: nothing was built"
    for component in assembly.components:
        if not default_vocabulary().holds(component.group, component.name):
            yield f"{where}: {component.group}/{component.name} is no name"
        if component.family != family.name or component.granularity not in ("one", "few", "pieces"):
            yield f"{where}: {component.name} doesn't say what it was built as"
        if not is_closed(component.solid) or not (shell_volumes(component.solid) > 0).all():
            yield f"{where}: {component.name} is not closed, or inside out"


def test_one_family_of_each_kind_is_closed_and_labelled():
    kinds = {family.name.split("/")[0]: family for family in ALL_FAMILIES.values()}
    turns = zip(kinds.values(), cycle(IN_STYLES), strict=False)
    assert [flaw for family, style in turns for flaw in flaws(family, style, sizes(family)[0], 0)] == []


@pytest.mark.slow
def test_every_family_is_closed_and_labelled():
    turns = zip(ALL_FAMILIES.values(), cycle(IN_STYLES), strict=False)
    assert [flaw for family, style in turns for flaw in flaws(family, style, sizes(family)[-1], 1)] == []


@pytest.mark.slow
@pytest.mark.long
def test_every_family_is_closed_and_labelled_in_every_hand():
    assert [
        flaw
        for family in ALL_FAMILIES.values()
        for seed, (style, dn) in enumerate(zip(IN_STYLES, cycle(sizes(family)), strict=False))
        for flaw in flaws(family, style, dn, seed)
    ] == []


def reaches_from_end_to_end(family):
    """Whether the device has a face at either end of its length, about as wide as the line."""
    dn, style = sizes(family)[1 if len(sizes(family)) > 1 else 0], STYLES["plant-design"]
    device = as_device(family, built(family, dn, style, 3), style, "X-1")
    vertices = np.concatenate([c.vertices for c in device.assembly.components])
    near = vertices[np.hypot(vertices[:, 1], vertices[:, 2]) < 0.5 * dn / 1000 + 0.02][:, 0]
    ends = np.isclose(near, 0.0, atol=1e-9).any() and np.isclose(near, device.length, atol=2e-6).any()
    return device.length > 0 and bool(ends)


@pytest.mark.slow
def test_what_sits_in_a_line_reaches_from_one_end_to_the_other():
    inline = [family for family in ALL_FAMILIES.values() if family.place == "inline"]
    assert inline
    assert [family.name for family in inline if not reaches_from_end_to_end(family)] == []


def test_units_belong_to_the_group_of_their_type():
    of_group = default_vocabulary().unit_of_group
    for family in ALL_FAMILIES.values():
        assert (family.unit or None) == of_group.get(family.group)


def test_names_say_kind_and_build():
    assert all(name.count("/") == 1 and name == family.name for name, family in ALL_FAMILIES.items())


PARTS = (
    Part(box((1, 1, 1)), "valve body", "valve", "valve body"),
    Part(box((1, 1, 1), (0, 0, 1)), "valve stem", "trim", "valve body"),
    Part(box((1, 1, 1), (0, 0, 2)), "handwheel", "handle"),
    Part(box((1, 1, 1), (0, 0, 3)), "bolt", "fastener", "valve body", "Connection assembly", True),
)
FAMILY = Family("gate valve/test", "inline", "Valve assembly", "valve", lambda *_: Model(PARTS))


@pytest.mark.parametrize(
    ("grain", "fasteners", "names"),
    [
        ("one", "bolt", ["valve"]),
        ("one", "none", ["valve"]),
        ("few", "bolt", ["valve body", "handwheel", "bolt"]),
        ("few", "none", ["valve body", "handwheel"]),
        ("pieces", "bolt", ["valve body", "valve stem", "handwheel", "bolt"]),
    ],
)
def test_a_hand_joins_parts_as_finely_as_it_models(grain, fasteners, names):
    style = replace(STYLES["plant-design"], valve=grain, fasteners=fasteners)
    assembly = as_assembly(FAMILY, Model(PARTS), style, "V-1")
    assert [c.name for c in assembly.components] == names
    owners = {c.group: c.unit for c in assembly.components}
    assert owners["Valve assembly"] == "V-1"
    assert owners.get("Connection assembly", "") == ""


def test_finished_devices_take_the_id_of_their_unit():
    family = ALL_FAMILIES["check valve/swing"]
    device = as_device(family, built(family, 50, STYLES["bim"], 0), STYLES["bim"], "V-7")
    assert isinstance(device, Device)
    assert {c.unit for c in device.assembly.components} == {"V-7"}
    assert [u.id for u in device.assembly.units] == ["V-7"]
    assert UNIT not in {c.unit for c in device.assembly.components}


def test_what_stands_on_the_floor_does_not_fit_a_line():
    family = ALL_FAMILIES["tank/dished on legs"]
    with pytest.raises(ValueError, match="no device for a line"):
        as_device(family, built(family, 15, STYLES["bim"], 0), STYLES["bim"])
