"""Small hydraulic networks for tests, and what every solution of one must satisfy."""

from __future__ import annotations

import numpy as np
import pytest

from cadgraph.hydraulics.network import LinkKind
from networks import chain, network, terminal, unit

PRESETS = ("pumps", "skid", "tank", "riser", "rack", "field")
WITHOUT_FIELD = [pytest.param(name, marks=[pytest.mark.long] if name == "field" else []) for name in PRESETS]
"""The largest left to the long run: its states are as many valves of the same kinds."""


def line(*kinds, size=80, length=1.0, levels=(0.0, 0.0)):
    """An end that feeds, valves of these kinds with a gauge behind each, and an end that lets out."""
    nodes, names = [terminal(1, at=(0.0, 0.0, levels[0]))], ["X1"]
    for i, kind in enumerate(kinds, 1):
        at = (float(i), 0.0, 0.0)
        nodes += [unit(f"V-{i:03d}", kind, at, ("N1", "N2")), unit(f"G-{i:03d}", "pressure gauge", at)]
        names += [f"V-{i:03d}", f"G-{i:03d}"]
    nodes.append(terminal(2, at=(9.0, 0.0, levels[1])))
    return network(nodes, chain(" ".join([*names, "X2"]), size, length))


def imbalance(process):
    """The greatest difference between what flows into a node and out of it [m3/s]."""
    circuit, flow = process.balance.circuit, process.solution.flow
    net = np.zeros(len(circuit.nodes))
    np.add.at(net, circuit.end, flow)
    np.add.at(net, circuit.start, -flow)
    return np.abs(net[~circuit.fixed]).max(initial=0.0)


def head_gained(process):
    """How much a head rises along the flow in a pipe, at most [m]."""
    circuit, solution = process.balance.circuit, process.solution
    flows = (circuit.kind == LinkKind.PIPE) & (np.abs(solution.flow) > 1e-8)
    drop = (solution.head[circuit.start] - solution.head[circuit.end]) * np.sign(solution.flow)
    return -drop[flows].min(initial=0.0)


def random_commands(process, rng):
    """Openings and speeds at random, shut and open more often than between."""
    valves = {tag: rng.choice([0, 0, 1, 1, rng.random()]) for tag in process.balance.hand}
    return valves | {tag: rng.choice([0, 1, 1, rng.random()]) for tag in process.balance.speed}
