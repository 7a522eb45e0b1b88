"""The overview of a scene: what its rays meet, which no label changes.

So it can be worked out while the graph is still being made: the compiled kernels that do it leave the interpreter free.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from cadgraph.config import ReportConfig
from cadgraph.draw.render.camera import Camera, frame
from cadgraph.draw.render.picture import Look, Renderer, Sight
from cadgraph.draw.render.views import three_quarter_view
from cadgraph.model.scene import Ints, Scene

__all__ = ["MARGIN", "Overview", "can_be_drawn", "look_over"]

Bools = npt.NDArray[np.bool_]

MARGIN = 0.07
"""Of pictures: share of their size that stays free around what they are framed on."""


@dataclass(frozen=True)
class Overview:
    """What the pictures of a whole scene show.

    Args:
        renderer: of the scene.
        framed: meshes that the pictures are framed on.
        camera: that they are taken with.
        sight: what it sees.
    """

    renderer: Renderer
    framed: Ints
    camera: Camera
    sight: Sight

    def is_of(self, scene: Scene, ground: Bools, config: ReportConfig) -> bool:
        """Whether it is that of a scene, with these meshes as its ground, by these settings."""
        return (
            self.renderer.scene is scene
            and np.array_equal(self.framed, _framed(scene, ground))
            and (self.camera.width, self.camera.height) == (config.width, config.height)
            and self.sight.look == Look(samples=config.samples)
        )


def can_be_drawn(scene: Scene) -> bool:
    """Whether a scene has anything that a picture could show."""
    if not scene.n_triangles:
        return False
    shapes = scene.shapes
    if scene.placement is not None:
        shapes = shapes.select(np.unique(scene.placement.shape))
    return bool(np.isfinite(shapes.vertices).all(axis=1).any())


def look_over(
    scene: Scene, ground: Bools, config: ReportConfig, checkpoint: Callable[[], None] = lambda: None
) -> Overview:
    """Looks at a whole scene.

    Args:
        scene: with something that can be drawn.
        ground: ``(n_meshes,)`` its ground, on which no picture is framed unless there is nothing else.
        config: size and anti-aliasing.
        checkpoint: called between steps; it ends the work by raising.
    """
    renderer, framed, size = Renderer(scene), _framed(scene, ground), (config.width, config.height)
    checkpoint()
    renderer.caster()
    checkpoint()
    direction = three_quarter_view(renderer, framed, aspect=config.width / config.height)
    camera = frame(renderer.points(framed), direction, size, margin=MARGIN)
    checkpoint()
    return Overview(renderer, framed, camera, renderer.look(camera, Look(samples=config.samples)))


def _framed(scene: Scene, ground: Bools) -> Ints:
    filled = np.diff(scene.face_offsets) > 0
    shown = filled & ~ground
    return np.flatnonzero(shown if shown.any() else filled)
