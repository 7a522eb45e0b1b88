"""IFC to a scene, through IfcOpenShell: geometry, what the file says of its elements, and how their ports connect.

Paths lead through the building: ``/Project/Site/Building/Storey/IfcValve_2XQ$n5SLP5MBLyL442paFx``, the last step being
class and GlobalId. Elements of an assembly stand below it. Two elements of one GlobalId, or one whose GlobalId is none,
are told by the number of their line instead (``IfcValve_id123``).

Notes in ``Scene.diagnostics``: ``schema-guessed``, ``damaged-entity``, ``bad-guid``, ``bad-structure``,
``listed-twice``, ``no-geometry``, ``no-surface``, ``not-built``, ``unreadable``, ``empty-mesh``, ``open-link``, and
those of ``pack``.
"""

from cadgraph.load.ifc.reader import read

__all__ = ["read"]
