"""What a simulation supposes where the graph says nothing, as records: every value with the reason for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

__all__ = [
    "ATMOSPHERE",
    "GRAVITY",
    "SCENARIO",
    "UNITS",
    "Characteristic",
    "EndRole",
    "EndSetting",
    "Fluid",
    "GaugeSetting",
    "Move",
    "Pipes",
    "PumpSetting",
    "Scenario",
    "Setting",
    "TankSetting",
    "ValveDuty",
    "ValveSetting",
]

SCENARIO = "scenario.yaml"
"""The name of the file that holds them, beside a graph."""
GRAVITY = 9.80665
"""Standard acceleration of free fall [m/s2]."""
ATMOSPHERE = 1.01325
"""Standard atmosphere [bar]."""

Characteristic = Literal["linear", "equal percentage", "ball"]
"""How the flow coefficient of a valve follows its opening."""
ValveDuty = Literal["hand", "check", "relief"]
"""``hand``: moved by somebody or by an actuator; ``check`` and ``relief`` move by themselves."""

EndRole = Literal["source", "sink", "blind"]
"""What an end of a pipe does: feeds at a pressure, lets out, or neither."""


class Setting(BaseModel):
    """A frozen record of values; ``why`` says of each, by its name, where it comes from."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, strict=False)

    why: Mapping[str, str] = Field(default_factory=dict, exclude=True)

    def values(self) -> dict[str, object]:
        """What is set, by name, without the reasons and without what doesn't apply."""
        return {name: value for name, value in self.model_dump().items() if value is not None}


class Fluid(Setting):
    """What flows."""

    density: float = Field(default=998.2, gt=0, le=20_000, description="kg/m3")
    viscosity: float = Field(default=1.004e-6, gt=0, le=1, description="kinematic, m2/s")
    vapour: float = Field(default=-0.98, ge=-ATMOSPHERE, le=100, description="pressure at which it boils, bar(g)")


class Pipes(Setting):
    """What holds for all pipes."""

    roughness: float = Field(default=4.5e-5, ge=0, le=0.01, description="m")
    bend: float = Field(default=0.3, ge=0, le=100, description="loss coefficient of 90 degrees of turning")
    loop_pressure: float = Field(
        default=1.0, ge=-1, le=1000, description="at the suction of a pump in a loop that nothing else feeds, bar(g)"
    )


class ValveSetting(Setting):
    """A valve."""

    duty: ValveDuty = "hand"
    opening: float | None = Field(default=None, ge=0, le=1, description="0 is shut, 1 is open")
    turns: float | None = Field(
        default=None, gt=0, le=1000, description="of the wheel, from open to shut; a lever's is 0.25"
    )
    travel: float | None = Field(default=None, ge=0, le=86_400, description="from open to shut, s")
    k: float = Field(default=1.0, ge=0, le=1e6, description="loss coefficient when open")
    characteristic: Characteristic | None = None
    pressure: float | None = Field(default=None, ge=0, le=1000, description="that a relief valve opens at, bar")
    towards: str | None = Field(
        default=None, description="port that check and relief valves let out of; 'outside' for none"
    )


class PumpSetting(Setting):
    """A pump: the head falls from 4/3 of the given one, at no flow, as a parabola through the given point."""

    head: float = Field(default=30.0, gt=0, le=10_000, description="at the given flow, m")
    flow: float = Field(gt=0, le=1e6, description="m3/h")
    running: float = Field(default=1.0, ge=0, le=1, description="speed as a share of the full one; 0 stands still")
    suction: tuple[str, ...] = Field(default=(), description="ports that it draws from")


class EndSetting(Setting):
    """An end of a pipe."""

    role: EndRole
    pressure: float | None = Field(default=None, ge=-1, le=1000, description="of a source, bar(g)")
    flow: float | None = Field(default=None, gt=0, le=1e6, description="of a sink at 3 bar, m3/h")

    @model_validator(mode="after")
    def _fits(self) -> EndSetting:
        if (self.pressure is not None) != (self.role == "source"):
            raise ValueError(
                f"a source has a pressure, a {self.role} {'needs one' if self.role == 'source' else 'none'}"
            )
        if (self.flow is not None) != (self.role == "sink"):
            raise ValueError(f"a sink has a flow, a {self.role} {'needs one' if self.role == 'sink' else 'none'}")
        return self


class TankSetting(Setting):
    """A tank."""

    level: float = Field(ge=0, le=1000, description="above its bottom, m")
    height: float = Field(gt=0, le=1000, description="at which it overflows, m")
    area: float = Field(gt=0, le=1e6, description="of the surface, m2")
    bottom: float = Field(ge=-1e5, le=1e5, description="height in the plant, m")
    pressure: float = Field(default=0.0, ge=-1, le=1000, description="above the surface, bar(g)")


UNITS: Mapping[str, str | None] = {"pressure": "bar", "flow": "m3/h", "level": "m", "nothing": None}
"""The unit of what a gauge measures."""


class GaugeSetting(Setting):
    """A gauge."""

    measures: Literal["pressure", "flow", "level", "nothing"] = "pressure"
    unit: Literal["bar", "m3/h", "m"] | None = None
    span: float | None = Field(
        default=None, gt=0, le=1e6, description="reading at the end of the scale; it begins at 0"
    )
    lag: float = Field(default=0.3, ge=0, le=3600, description="time constant, s")


class Move(Setting):
    """A step of a timetable."""

    at: float = Field(ge=0, le=1e7, description="when it begins, s")
    over: float = Field(default=0.0, ge=0, le=1e7, description="how long it takes, s")
    set: dict[str, float] = Field(description="openings of valves and speeds of pumps that it ends with, by tag")


class Scenario(Setting):
    """All that a simulation supposes.

    Valves, pumps, tanks and gauges are there by tag, ends of pipes by id. ``names`` says which mesh of the source each
    of these names stands for: a correction may give a tag to another unit.
    """

    fluid: Fluid = Fluid()
    pipes: Pipes = Pipes()
    valves: dict[str, ValveSetting] = Field(default_factory=dict)
    pumps: dict[str, PumpSetting] = Field(default_factory=dict)
    ends: dict[str, EndSetting] = Field(default_factory=dict)
    tanks: dict[str, TankSetting] = Field(default_factory=dict)
    gauges: dict[str, GaugeSetting] = Field(default_factory=dict)
    play: tuple[Move, ...] = ()
    names: dict[str, str] = Field(default_factory=dict)

    def head(self, pressure: float) -> float:
        """The height of a column that weighs as much as a pressure [m].

        Args:
            pressure: bar.
        """
        return pressure * 1e5 / (self.fluid.density * GRAVITY)

    def pressure(self, head: float) -> float:
        """The pressure below a column [bar].

        Args:
            head: m.
        """
        return head * self.fluid.density * GRAVITY / 1e5

    def sections(self) -> Iterator[tuple[str, str, Setting]]:
        """All records: the section that each stands in, its name there (``""`` for sections of one), and itself."""
        yield "fluid", "", self.fluid
        yield "pipes", "", self.pipes
        several: tuple[tuple[str, Mapping[str, Setting]], ...] = (
            ("valves", self.valves),
            ("pumps", self.pumps),
            ("ends", self.ends),
            ("tanks", self.tanks),
            ("gauges", self.gauges),
        )
        for name, section in several:
            for tag, setting in section.items():
                yield name, tag, setting
