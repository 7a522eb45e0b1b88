"""What geometry alone says of a scene: all that a graph is made of but the labels and what follows from them."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.parts import Bools, Contacts, Parts, Properties
from cadgraph.model.scene import Ints, Scene

__all__ = ["Analysis"]


@dataclass(frozen=True, eq=False)
class Analysis:
    """The parts of a scene, what touches what, and which structures that makes; free of labels.

    Args:
        scene: the source meshes, in the natural order of their paths, without those that are left out.
        properties: of the source meshes.
        parts: made from them.
        contacts: pairs of parts that are adjacent.
        cluster: ``(n_parts,)`` number of each part's structure; -1 for the ground and for noise.
        diagnostics: what was found on the way.
        settings: those that it depends on, as plain values.
        near: pairs of meshes that are near, which parts and their contacts follow from.
        found_ground: ``(n_meshes,)`` the meshes that are the ground by themselves, whatever a user says.
        ground: ``(n_meshes,)`` those that are, as a user has it.
        notes: the diagnostics that don't depend on what the ground is.
    """

    scene: Scene
    properties: Properties
    parts: Parts
    contacts: Contacts
    cluster: Ints
    diagnostics: tuple[Diagnostic, ...] = ()
    settings: Mapping[str, Any] | None = None
    near: Contacts | None = None
    found_ground: Bools | None = None
    ground: Bools | None = None
    notes: tuple[Diagnostic, ...] = ()

    @cached_property
    def digest(self) -> str:
        """Sixteen digits, the same for the same scene and settings: what follows from both can be kept under them."""
        digest = hashlib.sha256(json.dumps(self.settings, sort_keys=True).encode())
        digest.update("\n".join(self.scene.paths).encode("utf-8", "backslashreplace"))
        for array in (
            *(self.scene.vertices, self.scene.faces, self.scene.vertex_offsets, self.scene.face_offsets),
            *(self.scene.colors, self.scene.origin),
        ):
            digest.update(array.tobytes())
        if (
            self.ground is not None
            and self.found_ground is not None
            and not np.array_equal(self.ground, self.found_ground)
        ):
            digest.update(self.ground.tobytes())
        return digest.hexdigest()[:16]
