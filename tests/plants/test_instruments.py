"""Instruments: what is read on them says from where, and the chambers of level gauges are as hollow as pipes."""

from dataclasses import replace

import pytest

from cadplants.families.instruments.measuring import MEASURING
from cadplants.presets.single_device import draw_parameters
from cadplants.styles.modeling_style import STYLES
from plants.solids import shell_volumes

STYLE = replace(STYLES["mechanical"], sides=(12, 16))


def parts(name, style=STYLE, **given):
    return draw_parameters(name, 0, given, style).model(style).parts


def test_every_face_says_where_it_is_read():
    assert [
        (family.name, part.name)
        for family in MEASURING
        for part in parts(family.name)
        if part.name == "gauge face" and part.front is None
    ] == []


@pytest.mark.parametrize("name", ["level gauge/magnetic", "level gauge/reflex", "level gauge/displacer"])
def test_chambers_beside_vessels_are_hollow_where_pipes_are(name):
    metal = {
        hollow: sum(
            shell_volumes(part.solid).sum()
            for part in parts(name, replace(STYLE, hollow=hollow))
            if part.name == "level gauge"
        )
        for hollow in (True, False)
    }
    assert metal[True] < 0.9 * metal[False]


def test_a_magnetic_gauge_is_flanged_at_both_ends():
    chamber = next(p for p in parts("level gauge/magnetic", flanged=True) if p.name == "level gauge").solid.vertices
    aside = draw_parameters("level gauge/magnetic", 0, {"flanged": True}, STYLE).aside
    wide = chamber[abs(chamber[:, 1]) > 0.06]
    assert {bool(z > chamber[:, 2].mean()) for z in wide[abs(wide[:, 0] - aside) < 0.03][:, 2]} == {True, False}


def test_pieces_heed_what_is_given_of_them():
    one = draw_parameters("level gauge/fork", 0, {"shape": "single", "housing.both": True}, STYLE)
    assert one.housing.both
    assert one.housing.other is not None
    assert one.model(STYLE).parts
