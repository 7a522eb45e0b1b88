"""Rounds that somebody else wrote, as JSON."""

from __future__ import annotations

from collections.abc import Callable

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from cadgraph.errors import AskError, CadGraphError
from cadgraph.model.records import Node, Place, Unit
from cadgraph.plans.goals import shown
from cadgraph.plans.round import Doing
from cadgraph.plans.rules import Move

__all__ = ["WrittenRound", "read_written"]


class _Written(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False, frozen=True)


class _WrittenStep(_Written):
    do: Doing
    at: str = Field(max_length=1000)
    name: str | None = Field(default=None, max_length=1000)
    level: str | None = Field(default=None, max_length=1000)
    length_m: float | None = Field(default=None, ge=0)


class WrittenRound(_Written):
    """A round as a file holds it: what ``cadgraph plan --json`` prints, or at least its steps.

    Args:
        goals: in words; ``""`` where they are given apart.
        start: tag or id of the unit where it begins and ends.
        steps: each with ``do`` and ``at`` (tag or id); ``level`` of a climb (id), ``length_m`` and ``name``, the tag in
            words, may be left out.
        length_m: of the whole.
    """

    goals: str = Field(default="", max_length=1_000_000)
    start: str | None = Field(default=None, max_length=1000)
    steps: tuple[_WrittenStep, ...] = Field(max_length=100_000)
    length_m: float | None = Field(default=None, ge=0)

    def moves(self, find: Callable[[str], Node]) -> tuple[Move, ...]:
        """Its steps with the ids of a graph; a name that nothing has stays as it is, which breaks a rule.

        Args:
            find: the node with a tag or id; raises where there is none.
        """
        known: dict[str, Node | None] = {}

        def found(name: str) -> Node | None:
            if name not in known:
                try:
                    known[name] = find(name)
                except CadGraphError:
                    known[name] = None
            return known[name]

        def move_of(step: _WrittenStep) -> Move:
            node = found(step.at)
            target = node.id if isinstance(node, Unit | Place) else shown(step.at)
            # Ways have no tags: what they are called in words holds their kind as well.
            others = isinstance(node, Unit) and step.name is not None and found(step.name) is not node
            named = shown(step.name) if others and step.name is not None else None
            return Move(step.do, target, step.level, step.length_m, named)

        return tuple(map(move_of, self.steps))


def read_written(text: str, where: str) -> WrittenRound:
    """Reads a round.

    Args:
        text: of the file.
        where: its name, for messages.

    Raises:
        AskError: it is no round as JSON; the message says what is wrong with it first.
    """
    try:
        return WrittenRound.model_validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        at = ".".join(str(step) for step in first["loc"]) or "the file"
        raise AskError(
            f"{where}: no round: {shown(at)}: {shown(first['msg'], 200)}; 'cadgraph plan --json' prints what is one"
        ) from None
