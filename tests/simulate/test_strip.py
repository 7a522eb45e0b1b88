from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

import playing
from cadgraph.hydraulics.settings import Move
from cadgraph.simulate.play.chart import fitted, font
from cadgraph.simulate.play.film import play
from cadgraph.simulate.play.scenery import OPERATED
from cadgraph.simulate.play.strip import Gauge, Strip
from cadgraph.simulate.play.timetable import Timetable


def drawn(*moves, seconds=4.0):
    film = play(playing.Told(), Timetable(moves), seconds, 12)
    return Strip(playing.graph(), playing.scene(), film, [Gauge("G-001", 4.0, "bar")])


@pytest.fixture(scope="module")
def strip():
    return drawn(Move(at=1, over=2, set={"V-001": 0.0}))


def count(image, color):
    wanted = [int(color[k : k + 2], 16) for k in (1, 3, 5)]
    return int((np.abs(np.asarray(image.convert("RGB"), int) - wanted).max(axis=2) <= 12).sum())


def test_the_strip_shows_five_pictures_and_is_the_same_each_time(strip, tmp_path):
    times = strip.write_png(tmp_path / "animation.png")
    assert len(times) == 5
    first = (tmp_path / "animation.png").read_bytes()
    drawn(Move(at=1, over=2, set={"V-001": 0.0})).write_png(tmp_path / "animation.png")
    assert (tmp_path / "animation.png").read_bytes() == first
    with Image.open(tmp_path / "animation.png") as image:
        assert image.width <= 1600
        assert count(image, OPERATED) > 1000


def test_the_gif_plays_for_some_seconds_and_is_the_same_each_time(strip, tmp_path):
    strip.write_gif(tmp_path / "animation.gif")
    first = (tmp_path / "animation.gif").read_bytes()
    strip.write_gif(tmp_path / "animation.gif")
    assert (tmp_path / "animation.gif").read_bytes() == first
    with Image.open(tmp_path / "animation.gif") as film:
        assert 30 <= film.n_frames <= 49
        seen = []
        for number in (0, film.n_frames - 1):
            film.seek(number)
            seen.append(np.asarray(film.convert("RGB"), int))
    assert (np.abs(seen[0] - seen[1]).max(axis=2) > 40).mean() > 0.01


def test_what_no_fluid_flows_through_any_more_is_drawn_so(strip):
    before, after = (strip._scenery._paint(number).colors for number in (0, 48))
    row = {path: number for number, path in enumerate(strip._scenery.scene.paths)}
    assert {path for path in row if (before[row[path]] != after[row[path]]).any()} == {"/body", "/pipe"}


def test_captions_say_what_is_read_and_what_it_was(strip):
    gauge, valve = strip.graph.unit("G-001"), strip.graph.unit("V-001")
    assert [strip._said(gauge, number) for number in (0, 24, 48)] == ["1.00 bar", "2.50 bar", "4.00 bar"]
    assert [strip._said(valve, number) for number in (0, 24, 48)] == ["open", "50% open", "shut"]
    assert [strip._event(number) for number in (0, 24, 48)] == [
        "before anything is done",
        "V-001 is being closed",
        "V-001 shut",
    ]


def test_a_valve_is_shut_only_once_it_has_got_there(strip):
    told_at_once = replace(strip.film, moves=(Move(at=1, over=0, set={"V-001": 0.0}),))
    slow = Strip(strip.graph, playing.scene(), told_at_once, [Gauge("G-001", 4.0, "bar")])
    assert [slow._event(number) for number in (24, 48)] == ["V-001 is being closed", "V-001 shut"]


def test_a_move_that_another_takes_over_is_told_as_broken_off(strip):
    moves = Move(at=1, over=2, set={"V-001": 0.0}), Move(at=2, over=1, set={"V-001": 1.0})
    both = Strip(strip.graph, playing.scene(), replace(strip.film, moves=moves), [Gauge("G-001", 4.0, "bar")])
    assert both._deeds() == [("1.0 to 3.0 s", "V-001 shut, broken off at 2.0 s"), ("2.0 to 3.0 s", "V-001 open")]


def test_a_film_in_which_nothing_is_done_is_drawn_too(tmp_path):
    drawn().write_png(tmp_path / "animation.png")


def test_texts_are_written_as_large_as_they_fit():
    assert fitted("short", 200, 20) is font(20)
    assert fitted("a text that is too long for its place", 200, 20).size < 20
    assert fitted("x" * 500, 10) is font(9)
