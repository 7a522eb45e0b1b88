"""Compiles the kernels ahead of the first run: ``python -m cadgraph.cli.warm``.

Machine code is cached beside the installed package, so this is needed once after an installation, and only to have
the first run as quick as the next.
"""

from __future__ import annotations

import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np

from cadgraph.draw.render.annotation import Tag, annotate
from cadgraph.draw.render.camera import frame
from cadgraph.draw.render.coarse import coarsened
from cadgraph.draw.render.pair import PairRenderer
from cadgraph.draw.render.picture import Renderer
from cadgraph.draw.web.packing import pack_scene
from cadgraph.load import load
from cadgraph.pipeline import build
from cadgraph.session.demo import DEMO_SCENE

__all__ = ["warm_up"]


def warm_up() -> None:
    """Builds the graph of the demo scene and draws some of it, by which every kernel that a plant needs is compiled.

    The two run beside each other, as compiling takes one processor.
    """
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        for done in [pool.submit(_build_something), pool.submit(_draw_something)]:
            done.result()


def _build_something() -> None:
    build(load(DEMO_SCENE))


def _draw_something() -> None:
    scene = load(DEMO_SCENE)
    camera = frame(scene.mesh(0)[0], (1, -2, 1), (64, 64), margin=0.3)
    renderer = PairRenderer(scene)
    renderer.pair(0, camera, [1])
    renderer.alone(0, camera, np.array([0.0, -1.0, 0.0, 0.0]))
    picture = Renderer(scene).picture(camera)
    coarsened(scene, np.arange(scene.n_meshes), 0.01, 1.0)
    annotate(picture, camera, tags=[Tag((0.0, 0.0, 0.0), "")])
    pack_scene(scene)


if __name__ == "__main__":
    sys.stdout.write("compiling kernels (once, a minute or two)\n")
    sys.stdout.flush()
    warm_up()
