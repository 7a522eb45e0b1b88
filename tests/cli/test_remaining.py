import io

import pytest
from rich.console import Console

from cadgraph.cli import remaining as of_stages
from cadgraph.cli import screen
from cadgraph.cli.remaining import Remaining, told

SHARES = {"read": 20, "measure": 10, "label": 30, "write labels": 10, "draw report": 30}


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture(autouse=True)
def shares(monkeypatch):
    """Shares that a new measurement of builds doesn't change."""
    monkeypatch.setattr(of_stages, "_SHARES", SHARES)


def test_nothing_is_said_before_enough_is_over(clock):
    remaining = Remaining(clock=clock)
    remaining("read", 0)
    clock.now += 8
    assert remaining.seconds is None


def test_the_rest_goes_by_the_pace_of_what_is_over(clock):
    remaining = Remaining(clock=clock)
    remaining("read", 0)
    clock.now += 8
    remaining("measure", 0)
    assert remaining.seconds == pytest.approx(32)
    assert remaining.share == pytest.approx(0.2)


def test_it_counts_down_within_a_stage_and_stops_at_what_follows_it(clock):
    remaining = Remaining(clock=clock)
    clock.now += 8
    remaining("measure", 0)
    clock.now += 3
    assert remaining.seconds == pytest.approx(29)
    clock.now += 60
    assert remaining.seconds == pytest.approx(28)


def test_a_stage_that_says_how_far_it_is_counts_by_that(clock):
    remaining = Remaining(("draw report",), clock=clock)
    clock.now += 60
    remaining("write labels", 0.5)
    assert remaining.share == pytest.approx(65 / 70)
    assert remaining.seconds == pytest.approx(60 * 5 / 65)


def test_stages_of_other_runs_say_nothing(clock):
    remaining = Remaining(clock=clock)
    remaining("look", 0.5)
    clock.now += 9
    assert remaining.seconds is None
    assert remaining.share == 0


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (None, ""), (1.0, "nearly done"), (4.0, "about 5 s left"), (33.0, "about 35 s left"), (59.0, "about 60 s left"),
        (150.0, "about 2 min left"),
    ],
)  # fmt: skip
def test_words_are_as_coarse_as_what_is_known(seconds, words):
    assert told(seconds) == words


def test_the_bars_say_what_is_left(monkeypatch):
    shown = io.StringIO()
    monkeypatch.setattr(screen, "err", Console(file=shown, force_terminal=True, width=120))
    monkeypatch.setattr(Remaining, "seconds", 42.0)
    with screen.bars() as progress:
        progress("read", 1)
        progress("label", 0)
    assert "30% of all, about 40 s left" in shown.getvalue()
