"""Closed triangle meshes: outlines, bodies turned and extruded from them, and how they are moved."""
