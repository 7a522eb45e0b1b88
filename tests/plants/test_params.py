import json

import numpy as np
import pytest

from cadplants.builder.device import Device, Maker, families_of
from cadplants.builder.params import (
    Apart,
    Params,
    among,
    between,
    chance,
    given,
    nested,
    several,
    styled,
    weighted,
    whole,
)
from cadplants.solids.primitives import box
from cadplants.styles.modeling_style import STYLES


class Knob(Params):
    kind = "knob"
    radius: float = between(0.02, 0.04, "of the knob", "m")
    lobes: int = whole(3, 6, "lobes")


class Coil(Device, name="siphon/coil", place="tap", group="Pipe assembly", label="pipe", sizes=(15, 20)):
    loops: int = whole(1, 3, "turns of the coil")
    bends: tuple[float, ...] = several(lambda rng, _: float(rng.uniform(0.1, 0.2)), lambda p: p.loops, "of each", "m")
    end: str = among(("plain", "threaded", "threaded"), "its end")
    form: str = weighted("how it is bent", round=0.7, pig_tail=0.3)
    valve: bool = chance(0.5, "a valve sits on it")
    knob: Knob = nested(Knob, "of the valve", when=lambda p: p.valve)
    size: float = between(1.0, 3.0, "of the valve", when=lambda p: p.valve)

    def build(self, t):
        t.add("pipe", box((0.1, 0.1, 0.1 * self.loops)))
        return t.model()


def test_the_same_source_draws_the_same():
    assert Coil.draw(Apart(3)) == Coil.draw(Apart(3)) == Coil.draw(Apart(3), **{})
    assert Coil.draw(np.random.default_rng(3)) == Coil.draw(np.random.default_rng(3))


def test_what_is_drawn_lies_within_what_it_can_be():
    drawn = [Coil.draw(Apart(seed)) for seed in range(200)]
    assert {one.loops for one in drawn} == {1, 2, 3}
    assert {one.end for one in drawn} == {"plain", "threaded"}
    assert {one.form for one in drawn} == {"round", "pig tail"}
    assert all(0.1 <= bend <= 0.2 for one in drawn for bend in one.bends)
    assert all((one.knob is not None) == one.valve for one in drawn)
    assert all(0.02 <= one.knob.radius <= 0.04 for one in drawn if one.valve)


def test_a_parameter_that_is_given_changes_no_other_but_those_that_follow_from_it():
    usual = Coil.draw(Apart(5))
    for end in ("plain", "threaded"):
        other = Coil.draw(Apart(5), end=end)
        assert other.end == end
        assert (other.loops, other.bends, other.form, other.valve) == (
            usual.loops,
            usual.bends,
            usual.form,
            usual.valve,
        )


def test_a_new_parameter_changes_no_other():
    class Longer(Params):
        before: float = between(0, 1, "new")
        radius: float = between(0.02, 0.04, "of the knob", "m")
        lobes: int = whole(3, 6, "lobes")

    longer, knob = Longer.draw(Apart(9)), Knob.draw(Apart(9))
    assert (longer.radius, longer.lobes) == (knob.radius, knob.lobes)


def test_text_is_understood_and_pieces_have_names_of_their_own():
    one = Coil.draw(Apart(1), loops="2", valve="yes", **{"knob.radius": "0.03"})
    assert (one.loops, one.valve, one.knob.radius) == (2, True, 0.03)
    assert one.knob.lobes == Coil.draw(Apart(1), valve=True).knob.lobes


class Handle(Params):
    size: float = given(0.1, "reach", "m")
    make: str = among(("lever", "wheel"), "how it is made")
    spokes: int = whole(3, 6, "spokes", when=lambda p: p.make == "wheel")
    wide: float = between(0.1, 0.2, "width / reach")


class Handled(Params):
    handle: Handle = nested(lambda source, before: Handle, "handle", fixed=lambda _: {"size": 0.3})


def test_what_is_set_of_a_piece_brings_with_it_what_follows_from_that():
    for seed in range(8):
        plain = Handled.draw(Apart(seed)).handle
        lever, wheel = (Handled.draw(Apart(seed), **{"handle.make": make}).handle for make in ("lever", "wheel"))
        assert (lever.spokes, wheel.spokes in range(3, 7)) == (0, True)
        assert plain == (lever if plain.make == "lever" else wheel)
        assert {(one.size, one.wide) for one in (plain, lever, wheel)} == {(0.3, plain.wide)}


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ({"loops": 7}, "loops=7: give 1 to 3"),
        ({"loops": "many"}, "loops=many: give 1 to 3"),
        ({"end": "welded"}, "end=welded: give plain, threaded"),
        ({"valve": "perhaps"}, "valve=perhaps: give yes or no"),
        ({"form": "square"}, "form=square: give round, pig tail"),
        ({"lops": 1}, "lops: no parameter; there are dn, loops"),
        ({"valve": True, "knob.radius": 1}, "knob.radius=1: give 0.02 to 0.04"),
        ({"valve": False, "knob.radius": 0.03}, "knob.radius: the device has no knob"),
        ({"valve": False, "size": 2.0}, "size=2.0: it is 0, as other parameters rule it out"),
    ],
)
def test_what_can_not_be_is_refused_by_name(told, message):
    with pytest.raises(ValueError, match=message):
        Coil.draw(Apart(1), **told)


def test_parameters_are_plain_json_that_makes_the_same_device_again():
    one = Coil.draw(Apart(4), valve=True)
    said = json.loads(json.dumps(one.to_json()))
    again = {f"knob.{k}": v for k, v in said.pop("knob").items() if k != "kind"}
    made = Coil.draw(Apart(99), **said, **again)
    assert made.to_json() == one.to_json()


def test_what_a_device_does_not_have_may_be_repeated_as_it_was_said():
    one = Coil.draw(Apart(4), valve=False)
    assert one.size == 0.0
    assert Coil.draw(Apart(4), valve=False, size=0.0, knob=None) == one


def test_people_read_every_parameter_with_its_unit_and_what_it_can_be():
    rows = {name: rest for name, *rest in Coil.draw(Apart(4), valve=True).rows()}
    assert rows["knob.radius"][1:] == ["0.02 to 0.04", "of the knob [m]"]
    assert set(rows) == {"dn", *Coil.fields(), "knob.radius", "knob.lobes"}
    assert rows["knob"][0] == "knob"


def test_a_class_is_a_family_whose_models_say_what_they_were_built_from():
    (family,) = families_of(Coil)
    assert (family.name, family.place, family.whole, family.sizes) == ("siphon/coil", "tap", "pipe", (15, 20))
    assert isinstance(family.build, Maker)
    model = family.build(20, STYLES["bim"], np.random.default_rng(2))
    assert model.params == Coil.draw(np.random.default_rng(2), dn=20).to_json()
    assert model.params["dn"] == 20


class Housing(Device, name="filter/housing", place="floor", group="Equipment", label="filter", sizes=(15,)):
    hollow: bool = styled(True, "whether insides are modelled")
    cartridge: Knob = nested(Knob, "what is inside", when=lambda p: p.hollow)
    count: int = whole(1, 3, "feet")
    feet: tuple[Knob, ...] = several(lambda rng, _: Knob.draw(rng), lambda p: p.count, "its feet")

    def build(self, t):
        t.add("filter", box((0.1, 0.1, 0.1)))
        return t.model()


def test_what_a_style_leaves_out_has_no_parameters():
    (family,) = families_of(Housing)
    for name, hollow in (("mechanical", True), ("bim", False)):
        drawn = family.build.draw(15, STYLES[name], 3)
        assert drawn.hollow is hollow
        assert (drawn.cartridge is not None) is hollow
        assert family.build(15, STYLES[name], Apart(3)).params == drawn.to_json()


def test_what_the_style_says_is_not_given():
    (family,) = families_of(Housing)
    assert family.build.draw(15, STYLES["bim"], 3, hollow="no").hollow is False
    with pytest.raises(ValueError, match="hollow=yes: it is no, as the style or the rest of the device has it"):
        family.build.draw(15, STYLES["bim"], 3, hollow="yes")


def test_pieces_of_which_there_are_several_are_read_one_by_one():
    drawn = Housing.draw(Apart(3), count=2)
    assert {"feet.0.radius", "feet.1.lobes"} <= {row[0] for row in drawn.rows()}
    assert json.loads(json.dumps(drawn.to_json()))["feet"][1]["lobes"] == drawn.feet[1].lobes


def test_of_several_pieces_one_is_given_by_its_number_and_the_rest_stays_as_drawn():
    drawn = Housing.draw(Apart(3), count=2)
    told = Housing.draw(Apart(3), count=2, **{"feet.1.lobes": "5", "feet.1.radius": 0.025})
    assert (told.feet[0], told.count) == (drawn.feet[0], 2)
    assert (told.feet[1].lobes, told.feet[1].radius) == (5, 0.025)


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ({"feet.2.lobes": 4}, "feet.2: give one of 0 to 1 and a parameter of it, as 0.name"),
        ({"feet.one.lobes": 4}, "feet.one: give one of 0 to 1"),
        ({"feet.0": 4}, "feet.0: give one of 0 to 1"),
        ({"feet.0.loves": 4}, "feet.0.loves: no parameter; there are radius, lobes"),
        ({"feet.0.lobes": 9}, "feet.0.lobes=9: give 3 to 6"),
        ({"feet.0.lobes.more": 9}, "feet.0.lobes.more: no parameter; there are none"),
    ],
)
def test_what_one_of_several_pieces_can_not_be_is_refused_by_name(told, message):
    with pytest.raises(ValueError, match=message):
        Housing.draw(Apart(3), count=2, **told)


def test_what_is_given_is_one_of_its_choices():
    class Sign(Params):
        on: str = given("top", "where", choices=("top", "side"))

    assert Sign.draw(Apart(1)).on == "top"
    assert Sign.draw(Apart(1), on="side").on == "side"
    with pytest.raises(ValueError, match="on=under: give top, side"):
        Sign.draw(Apart(1), on="under")


def test_a_parameter_takes_no_name_that_a_device_has():
    with pytest.raises(TypeError, match="a device has that already"):

        class Clash(Device, name="filter/clash"):
            label: str = among(("one", "two"), "what stands on it")
