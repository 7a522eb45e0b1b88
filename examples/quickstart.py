"""Build the scene graph of a CAD file and ask it a few things.

python examples/quickstart.py [SCENE]

Without a scene, a small plant skid is generated.
"""

import sys
import tempfile
from pathlib import Path

import cadgraph
from cadplants import make_skid, write_usd


def main(path: Path | None = None) -> cadgraph.SceneGraph:
    if path is None:
        path = Path(tempfile.mkdtemp()) / "skid.usdc"
        write_usd(make_skid(), path)
    graph = cadgraph.build(cadgraph.load(path))

    for system in graph.clusters("pipe system"):
        print(f"{system.id}: {system.n_parts} parts")
    for valve in graph.units("valve"):
        print(valve.tag, "is related to", [unit.tag for unit in graph.neighbors(valve)])
    flanges = graph.parts(group="Pipe assembly", name="flange")
    print(f"{len(flanges)} flanges, of {len({part.shape for part in flanges})} shapes")
    return graph


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
