"""The scene that comes with the package: a tank, two pumps and a drum with their pipes, valves and gauges."""

from __future__ import annotations

from pathlib import Path

from cadgraph._io.atomic import ensure_writable, write_atomically
from cadgraph.errors import OutputError

__all__ = ["DEMO_SCENE", "copy_demo_scene"]

# Made by the package cadplants, which the product doesn't need; names and paths in it mean nothing.
DEMO_SCENE = Path(__file__).with_name("demo_plant.usdc")
"""The file of the scene: a plant of 24 units on one connected network of pipes."""


def copy_demo_scene(folder: str | Path) -> Path:
    """Copies the demo scene into a folder as ``plant.usdc``, so that what is made of it finds its source there.

    Args:
        folder: where results go; made if missing.

    Returns:
        The path of the copy.

    Raises:
        OutputError: the folder can't be written, or holds another file of that name.
    """
    target = ensure_writable(folder) / "plant.usdc"
    content = DEMO_SCENE.read_bytes()
    try:
        if target.exists() and target.read_bytes() != content:
            raise OutputError(f"{target}: not the demo scene, so it is left alone; choose another output folder")
    except OSError as error:
        raise OutputError(f"{target}: can't be read ({error.strerror}); choose another output folder") from error
    write_atomically(target, content)
    return target
