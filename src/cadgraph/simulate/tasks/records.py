"""What a task is: what to do, from which start, to which goal, and how one gets at what has to be moved or read."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from cadgraph._io.atomic import write_atomically
from cadgraph._io.limits import TASKS, read_text_within
from cadgraph._io.validation_messages import expectation
from cadgraph.errors import FormatError
from cadgraph.model.records import Point

__all__ = ["Goal", "Hand", "LeftOut", "Ring", "Solution", "Start", "Stop", "Task", "TaskKind", "TaskList"]

TaskKind = Literal["read", "close", "open", "isolate"]
"""``read`` a gauge; ``close`` or ``open`` a valve and see which gauges fall or rise; ``isolate`` a unit."""


class _Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Ring(_Record):
    """Where a hand can grip: the rim of a wheel, the circle on which a lever's end moves."""

    kind: Literal["handwheel", "lever", "gear operator"]
    center: Point = Field(description="on the axis, in the plane of what is gripped [m]")
    axis: Point = Field(description="unit vector, out of the unit; angles count anticlockwise as seen from there")
    radius: float = Field(description="from the axis to what is gripped [m]")
    thickness: float | None = Field(description="half the width of what is gripped [m]; null where unknown")


class Hand(_Record):
    """A way for a hand that meets nothing."""

    grasp: Point = Field(description="on the ring [m]")
    direction: Point = Field(description="unit vector that the hand moves along, towards the grasp")
    tilt: float = Field(description="between that and straight along the axis [deg]; 0 is straight")
    free: float = Field(description="length of the free way before the grasp [m]")


class Stop(_Record):
    """Where one works at a unit or reads it."""

    unit: str = Field(description="id")
    tag: str
    does: Literal["read", "turn", "pull"]
    place: str | None = Field(description="id of the level to stand on")
    stand: Point | None = Field(description="on the floor [m]")
    viewpoint: Point | None = Field(default=None, description="of an eye that sees the face of a gauge [m]")
    ring: Ring | None = None
    hand: Hand | None = None
    remarks: tuple[str, ...] = Field(default=(), description="what isn't sure, a sentence each")


class Start(_Record):
    """How the plant stands when a task begins; tanks are as the scenario has them."""

    opening: dict[str, float] = Field(description="of each valve that is moved by hand, by tag; 0 shut, 1 open")
    speed: dict[str, float] = Field(description="of each pump as a share of its full speed, by tag")


class Goal(_Record):
    """What makes a task done; all that is set has to hold in the last state."""

    reading: str | None = Field(default=None, description="tag of the gauge whose reading is to be told")
    tolerance: float = Field(default=0.0, description="of the reading that is told, in the unit of the gauge")
    opening: dict[str, float] = Field(default_factory=dict, description="openings to be reached, by tag")
    gauges: Literal["fall", "rise"] | None = Field(
        default=None, description="the gauges to be told: those that fell or rose from the first state to the last"
    )
    least: dict[str, float] = Field(
        default_factory=dict, description="change from which a gauge counts, by tag, in its unit; a fifth may count"
    )
    still: tuple[int, ...] = Field(default=(), description="numbers of the connections that nothing may flow in")
    shut_in: tuple[str, ...] = Field(default=(), description="nodes that nothing of known pressure may reach")
    stopped: tuple[str, ...] = Field(default=(), description="tags of pumps that have to stand still")
    untouched: bool = Field(default=True, description="whether all other valves and pumps have to be as at the start")


class Solution(_Record):
    """One way to do a task, played through by the process before the task was written; not for who is tested."""

    set: dict[str, float] = Field(description="openings and speeds, by tag")
    answer: float | tuple[str, ...] | None = Field(default=None, description="a reading, or tags of gauges")


class Task(_Record):
    """One task."""

    id: str
    kind: TaskKind
    text: str = Field(description="what is asked for")
    unit: str = Field(description="id of what it is about")
    tag: str
    start: Start
    goal: Goal
    stops: tuple[Stop, ...] = Field(description="what has to be moved or read by hand or eye, the nearest first")
    remarks: tuple[str, ...] = ()
    solution: Solution


class LeftOut(_Record):
    """What would be a task, but for these reasons."""

    text: str
    reasons: tuple[str, ...]


class TaskList(_Record):
    """A file of tasks."""

    format: Literal["cadgraph tasks"] = "cadgraph tasks"
    version: Literal[1] = 1
    seed: int
    source_sha256: str = Field(description="of the file that the plant comes from")
    assumptions: int = Field(description="values that the scenario assumes and nobody has confirmed")
    tasks: tuple[Task, ...]
    left_out: tuple[LeftOut, ...] = ()

    def write(self, path: str | Path) -> Path:
        """Writes the file, whole or not at all; the same tasks give the same bytes.

        Raises:
            OutputError: it can't be written.
        """
        write_atomically(path, self.model_dump_json(indent=1) + "\n")
        return Path(path)

    @classmethod
    def read(cls, path: str | Path) -> TaskList:
        """Reads such a file.

        Raises:
            FormatError: it is missing, too large, or no list of tasks.
        """
        text = read_text_within(Path(path), TASKS, FormatError, "'cadgraph tasks' writes one")
        try:
            return cls.model_validate_json(text)
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(str(step) for step in first["loc"]) or "the file"
            raise FormatError(f"{path}: {where} {expectation(first)}; 'cadgraph tasks' writes one") from None
