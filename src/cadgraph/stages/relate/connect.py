"""Units and the network of lines between them, from labels and geometry."""

from __future__ import annotations

from collections.abc import Sequence

from cadgraph.config import Config
from cadgraph.parts import Contacts, Label, Network, Parts
from cadgraph.scene import Diagnostic, Ints
from cadgraph.stages.relate.algorithm import find_units
from cadgraph.stages.relate.attach import attach_lines
from cadgraph.stages.relate.contract import simplify
from cadgraph.stages.relate.line import find_lines
from cadgraph.stages.relate.network import draw_network
from cadgraph.stages.relate.run import make_network
from cadgraph.vocabulary import Vocabulary

__all__ = ["connect_units"]


def connect_units(
    parts: Parts,
    labels: Sequence[Label | None],
    guessed: Sequence[Label | None],
    contacts: Contacts,
    cluster: Ints,
    vocabulary: Vocabulary,
    config: Config,
) -> tuple[Network, tuple[Diagnostic, ...]]:
    """Finds the units and what follows what along the lines between them.

    Args:
        parts: of the scene.
        labels: of each part.
        guessed: what the embedded labeler alone says of each part: a second opinion.
        contacts: pairs of parts that are near.
        cluster: ``(n_parts,)``; -1 takes no part.
        vocabulary: says which groups are connectors and which form units.
        config: settings; with ``method = "paper"`` units are the paper's and there is no network of lines.

    Returns:
        The network, and what is to be told.
    """
    units = find_units(labels, contacts, cluster, vocabulary)
    if config.method == "paper":
        return Network(units), ()
    owner = {part for unit in units for part in unit.parts}
    connectors = [
        part
        for part, label in enumerate(labels)
        if label is not None and label.group in vocabulary.connector_groups and part not in owner
    ]
    lines = find_lines(parts, connectors)
    blobs = [part for part in connectors if part not in lines]
    found = attach_lines(parts, contacts, lines, [*owner, *blobs], config.relate.bridge)
    drawing = draw_network(lines, blobs, units, found, {}, lambda part: 1.0)
    gauges = {number for number, unit in enumerate(units) if unit.unit_type == "gauge"}
    net = simplify(drawing, gauges, len(units), config.relate.leg)
    network = make_network(net, drawing, units, lines, found, lambda part: None, lambda part: True)
    return network, ()
