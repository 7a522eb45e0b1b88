"""Rounds through a plant: what to read, close and open, in which order, by which ways, and what each step changes."""

from __future__ import annotations

from cadgraph.plans.goals import Goal, parse_goals
from cadgraph.plans.round import Round, Step, make_round
from cadgraph.plans.rules import Fault, check_round

__all__ = ["Fault", "Goal", "Round", "Step", "check_round", "make_round", "parse_goals"]
