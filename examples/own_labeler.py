"""Bring your own labeler: anything with a `label` method can name the parts.

python examples/own_labeler.py
"""

import numpy as np

import cadgraph
from cadgraph.session.demo import DEMO_SCENE


class LongAndRound:
    """Calls every part a pipe that is much longer than thick and as wide as deep."""

    def label(self, parts, contacts, vocabulary):
        length, width, depth = parts.properties.obb_extents.T
        is_pipe = (length > 3 * width) & (np.abs(width - depth) < 0.05 * width)
        pipe = cadgraph.Label("Pipe assembly", "pipe", 0.6, "geometry", {"why": "long and round"})
        return cadgraph.Labeling.judge([pipe if p else None for p in is_pipe])


def main() -> cadgraph.SceneGraph:
    graph = cadgraph.build(cadgraph.load(DEMO_SCENE), labeler=LongAndRound())
    print(f"{len(graph.parts(name='pipe'))} of {len(graph.parts())} parts called pipe")
    return graph


if __name__ == "__main__":
    main()
