"""What it costs to simulate many plants: ``python packages/cadlab/benchmarks/simulation.py [--count 1000]``.

Prints a Markdown table: for each plant processor milliseconds of one step of all of them, in one batched solution and
in a loop over ``Process`` (a part of it, scaled up), and how far the two are apart. Every step tells each valve, with a
chance of 30 %, to go anywhere or fully open or shut, and each pump, with 10 %, to stop or run.
"""

from __future__ import annotations

import argparse
import math
import statistics
import time
from typing import Any

import numpy as np
import numpy.typing as npt
from _timing import machine

import cadgraph
from cadgraph.hydraulics.batch import ProcessBatch
from cadgraph.model.given_labels import GivenLabel
from cadgraph.query.network import Network
from cadlab.markdown import table
from cadplants import make

Floats = npt.NDArray[np.float64]

_DT = 0.5  # s
_WARM, _STEPS = 2, 8
_ALONE = 25  # plants in the loop


def network_of(preset: str) -> Network:
    """The functional network of a preset, with true labels."""
    plant = make(preset, 7)
    named = zip(plant.paths(), plant.components, strict=True)
    labels = [GivenLabel(path, part.group, part.name) for path, part in named if part.group]
    return Network(cadgraph.build(plant.scene(), labels=labels))


def told(lot: np.random.Generator, shape: tuple[int, int], chance: float, between: bool) -> Floats:
    """What is commanded, NaN where nothing is."""
    ends = lot.integers(0, 2, shape).astype(float)
    values = np.where(lot.random(shape) < 0.3, ends, lot.random(shape)) if between else ends
    return np.where(lot.random(shape) < chance, values, np.nan)


def row(preset: str, count: int) -> list[str]:
    """One line of the table."""
    network = network_of(preset)
    plants = ProcessBatch(network, count=count)
    alone = [cadgraph.Process(network, plants.process.scenario) for _ in range(min(_ALONE, count))]
    lot = np.random.default_rng(7)
    together: list[float] = []
    by_one: list[float] = []
    apart = 0.0
    for number in range(_WARM + _STEPS):
        opening = told(lot, (count, len(plants.valves)), 0.3, between=True)
        speed = told(lot, (count, len(plants.pumps)), 0.1, between=False)
        start = time.process_time()
        plants.step(opening, speed, _DT)
        middle = time.process_time()
        for k, process in enumerate(alone):
            process.step(commands(plants, opening[k], speed[k]), _DT)
        if number >= _WARM:
            together.append((middle - start) * 1e3)
            by_one.append((time.process_time() - middle) * 1e3 * count / len(alone))
        apart = max(apart, difference(plants, alone))
    batch, loop = statistics.median(together), statistics.median(by_one)
    circuit = plants.process.balance.circuit
    size = f"{len(circuit.nodes)} / {len(circuit.kind)}"
    return [preset, size, f"{count:,}", f"{batch:.0f}", f"{loop:,.0f}", f"{loop / batch:.0f}", f"{apart:.0e}"]


def commands(plants: ProcessBatch, opening: Floats, speed: Floats) -> dict[str, float]:
    """What one plant is told."""
    values = (*zip(plants.valves, opening.tolist(), strict=True), *zip(plants.pumps, speed.tolist(), strict=True))
    return {tag: value for tag, value in values if not math.isnan(value)}


def difference(plants: ProcessBatch, alone: list[Any]) -> float:
    """The greatest of all differences in readings [bar, m3/h, m] and flows [m3/s]."""
    reading, flow = plants.reading, plants.flow
    found = 0.0
    for k, process in enumerate(alone):
        state = process.state
        shown = np.array([math.nan if value is None else value for value in state.reading.values()])
        if (np.isnan(shown) != np.isnan(reading[k])).any():
            return math.inf
        found = max(found, float(np.nan_to_num(np.abs(shown - reading[k])).max(initial=0.0)))
        found = max(found, *(abs(value - float(flow[k, number])) for number, value in state.flow.items()))
    return found


def main() -> None:
    """Runs the benchmark."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--presets", nargs="+", default=["pumps", "skid", "tank", "rack"])
    asked = parser.parse_args()
    titles = ["plant", "nodes / links", "plants", "batched [ms]", "loop [ms]", "times quicker", "apart"]
    print(machine() + "\n")
    print(*table(titles, [row(preset, asked.count) for preset in asked.presets], numbers=True), sep="\n")


if __name__ == "__main__":
    main()
