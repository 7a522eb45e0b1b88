"""The solver against EPANET, and the file that EPANET reads."""

import contextlib
import os
import random
import warnings

import numpy as np
import pytest

from cadgraph.export import write_export
from cadgraph.export.epanet import InputFile, write_epanet
from cadgraph.hydraulics.process import Process
from cadgraph.hydraulics.scenario_file import write_scenario
from networks import chain, network, pumping, terminal, unit
from waterworks import WITHOUT_FIELD, line, random_commands


@pytest.fixture(scope="module")
def epanet():
    """What EPANET makes of a file: flows of links [m3/s] and heads of nodes [m], by name."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        wntr = pytest.importorskip("wntr")

    def solved(file, folder):
        with warnings.catch_warnings(), contextlib.chdir(folder):
            warnings.simplefilter("ignore")
            model = wntr.network.WaterNetworkModel(os.fspath(file))
            results = wntr.sim.EpanetSimulator(model).run_sim(file_prefix=os.fspath(folder / "run"))
        return results.link["flowrate"].iloc[0], results.node["head"].iloc[0]

    return solved


def differences(plant, epanet, folder):
    """To EPANET, of a plant as it stands: of flows [m3/h], and of heads [m] where a known one reaches."""
    written = InputFile(plant.network, plant.balance)
    file = folder / "plant.inp"
    file.write_text("\n".join(written.lines()) + "\n", encoding="utf-8")
    flows, heads = epanet(file, folder)
    circuit, solution = plant.balance.circuit, plant.solution
    known = ~circuit.fixed & ~solution.shut_in & ~np.isnan(solution.head)
    flow = np.abs(flows[written.links].to_numpy()) - np.abs(solution.flow)
    head = heads[written.nodes].to_numpy() - solution.head
    return np.abs(flow).max() * 3600, np.abs(head[known]).max(initial=0.0)


def test_states_of_a_plant_by_hand_are_those_of_epanet(epanet, tmp_path):
    plant, rng = Process(pumping()), random.Random(3)
    for number in range(8):
        plant.steady(random_commands(plant, rng) if number else {})
        if not any(plant.balance.through(tag) > 1e-6 for tag in plant.state.cavitating):
            flow, head = differences(plant, epanet, tmp_path)
            assert flow < 0.05
            assert head < 0.05


@pytest.mark.slow
@pytest.mark.parametrize("preset", WITHOUT_FIELD)
def test_states_of_a_generated_plant_are_those_of_epanet(plants, epanet, tmp_path, preset):
    plant = plants(preset)
    valves = list(plant.balance.hand)
    part = dict.fromkeys(valves[::3], 0.3)
    for commands in ({}, {valves[0]: 0.0}, {tag: 0.0 for tag in ("V-002", "V-005") if tag in valves}, part):
        plant.steady(dict.fromkeys(valves, 1.0) | commands)
        flow, head = differences(plant, epanet, tmp_path)
        assert flow < 0.05
        assert head < 0.05


def test_an_export_goes_by_the_scenario_beside_it_and_says_so(tmp_path):
    graph = pumping()
    plant = Process(graph)
    pumps = {tag: pump.model_copy(update={"running": 0.0}) for tag, pump in plant.scenario.pumps.items()}
    anew = write_export(graph, "epanet", tmp_path)
    assert [file.name for file in anew.files] == ["plant.inp"]
    running = anew.files[0].read_text(encoding="utf-8")
    assert anew.notes[0].message.endswith("all of it supposed anew")
    write_scenario(plant.scenario.model_copy(update={"pumps": pumps}), tmp_path)
    stopped = write_export(graph, "epanet", tmp_path)
    assert "HEAD curve-P-001" in running
    still = stopped.files[0].read_text(encoding="utf-8")
    assert "HEAD curve-P-001" not in still
    assert any(line.startswith(" P-001\t") and "\tTCV\t" in line for line in still.splitlines())
    assert "pump-open" in [note.code for note in stopped.notes]
    assert "scenario.yaml says" in stopped.notes[0].message


def test_the_same_plant_gives_the_same_bytes(tmp_path):
    first, _ = write_epanet(pumping(), tmp_path / "a.inp")
    second, _ = write_epanet(pumping(), tmp_path / "b.inp")
    assert first.read_bytes() == second.read_bytes()


def test_what_epanet_can_not_hold_is_noted(tmp_path):
    nodes = [terminal(1, "blind"), unit("V-001", "relief valve", ports=("N1", "N2")), terminal(2, "blind")]
    _, notes = write_epanet(network(nodes, chain("X1 V-001 X2")), tmp_path / "plant.inp")
    assert [note.code for note in notes] == ["scenario", "relief-shut", "no-source"]


def test_no_name_opens_a_section(tmp_path, epanet):
    graph = line("ball valve")
    tag = '[PIPES]\n; x "' + "y" * 50
    nodes = [
        node.model_copy(update={"tag": tag}) if getattr(node, "tag", "") == "V-001" else node
        for node in graph.document.nodes
    ]
    document = graph.document.model_copy(update={"nodes": tuple(nodes)})
    plant = Process(type(graph)(document))
    flow, head = differences(plant, epanet, tmp_path)
    assert (flow, head) < (0.05, 0.05)
    assert (tmp_path / "plant.inp").read_text(encoding="utf-8").count("[PIPES]") == 1
