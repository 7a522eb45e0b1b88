"""Build the scene graph of a CAD file and ask it a few things.

python examples/quickstart.py [SCENE]

Without a scene, that of the demo is taken.
"""

import sys
from pathlib import Path

import cadgraph
from cadgraph.session.demo import DEMO_SCENE


def main(path: Path = DEMO_SCENE) -> cadgraph.SceneGraph:
    graph = cadgraph.build(cadgraph.load(path))

    for system in graph.systems():
        print(f"{system.id}: {len(system.units)} units on {system.length:.1f} m of pipe")
    for valve in graph.units("valve"):
        print(valve.tag, "is connected to", [unit.tag for unit in graph.neighbors(valve)])
    flanges = graph.parts(group="Pipe assembly", name="flange")
    print(f"{len(flanges)} flanges, of {len({part.shape for part in flanges})} shapes")
    return graph


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:2]))
