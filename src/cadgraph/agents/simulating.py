"""What the simulation adds to an answer of the graph, where a scenario lies beside it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from cadgraph.agents.answer import cell, row
from cadgraph.agents.plant import Plant
from cadgraph.errors import CadGraphError
from cadgraph.hydraulics.settings import SCENARIO
from cadgraph.query.what_if import WhatIf

if TYPE_CHECKING:
    from cadgraph.hydraulics.closing import Simulated

__all__ = ["simulated_rows", "simulated_values", "simulation_of"]

_TEXT = 400  # characters of a text that is more than a name


def simulation_of(plant: Plant, close: Sequence[str], found: WhatIf, asked: bool = True) -> Simulated | str | None:
    """What the simulation says of closing valves; why it says nothing; None where there is no scenario.

    Args:
        plant: that holds them.
        close: ids of the valves.
        found: what the graph alone says.
        asked: False where sources were given, for a scenario has its own.
    """
    if plant.folder is None or not (plant.folder / SCENARIO).exists():
        return None
    if not asked:
        return "the scenario says what feeds, not the sources"
    from cadgraph.hydraulics.closing import simulate_closing

    try:
        return simulate_closing(plant.graph, plant.folder / SCENARIO, close, found)
    except (CadGraphError, ValueError) as error:
        return str(error)


def simulated_rows(found: Simulated | str | None) -> Iterator[str]:
    """The rows that follow those of the graph: where both disagree first, then what changes.

    Args:
        found: what the simulation says, or why it says nothing.
    """
    if found is None:
        return
    if isinstance(found, str):
        yield f"not simulated\t{cell(found, _TEXT)}"
        return
    yield (
        f"SIMULATED under {SCENARIO} ({found.n_assumed} of its values are assumed, so figures are no measurements): "
        f"{len(found.changed)} figures change"
    )
    yield from (f"DISAGREE\t{cell(text, _TEXT)}" for text in found.disagreements)
    yield from (f"simulated, mind\t{cell(text, _TEXT)}" for text in found.remarks)
    for old, new in found.changed:
        yield row("simulated", new.what, new.tag, f"{old.text} -> {new.text}", new.note)


def simulated_values(found: Simulated | str | None) -> dict[str, Any]:
    """The same as plain values.

    Args:
        found: what the simulation says, or why it says nothing.
    """
    if found is None:
        return {}
    if isinstance(found, str):
        return {"simulated": {"failed": found}}
    return {
        "simulated": {
            "scenario": SCENARIO,
            "n_assumed": found.n_assumed,
            "changed": [
                {"tag": new.tag, "what": new.what, "before": old.value, "after": new.value, "unit": new.unit,
                 "note": new.note or None}
                for old, new in found.changed
            ],
            "remarks": list(found.remarks),
            "disagreements": list(found.disagreements),
        }
    }  # fmt: skip
