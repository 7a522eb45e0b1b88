import numpy as np
import pytest

import playing
from cadgraph.hydraulics.settings import Move
from cadgraph.simulate.play.film import key_times, play
from cadgraph.simulate.play.timetable import Timetable

CLOSING = Timetable((Move(at=1, over=2, set={"V-001": 0.0}),))


def test_the_first_picture_is_taken_before_anything_is_done_and_the_last_at_the_end():
    film = play(playing.Told(), CLOSING, 4.0)
    assert len(film.states) == 97
    assert film.seconds == 4.0
    assert film.states[0].joints == {"V_001": 0.0, "G_001": -30.0}
    assert film.angles("V_001")[[24, 48, 72, 96]] == pytest.approx([0, -45, -90, -90])
    assert film.tags == ("V-001",)
    assert film.number(2.0) == 48


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), 601])
def test_nobody_waits_for_a_film_that_is_too_long(seconds):
    with pytest.raises(ValueError, match="can't play"):
        play(playing.Told(), CLOSING, seconds)


def test_one_looks_before_amid_and_after_each_move():
    moves = [Move(at=2, over=10, set={"V-003": 0}), Move(at=20, over=0, set={"P-001": 0})]
    assert key_times(moves, 30) == (0, 7, 14, 22, 30)


@pytest.mark.parametrize(
    "moves",
    [
        [],
        [Move(at=0, over=0, set={"V": 0})],
        [Move(at=40, over=0, set={"V": 0})],
        [Move(at=k, over=2, set={"V": 0}) for k in range(20)],
    ],
)
def test_there_are_always_five_looks_apart_from_each_other(moves):
    times = key_times(moves, 30)
    assert len(times) == 5
    assert times[0] == 0
    assert times[-1] == 30
    assert np.diff(times).min() >= 30 / 40
