"""A plant with a platform, worked out by hand, for tests of rounds."""

from __future__ import annotations

from cadgraph.model.records import Access, Contains, Place, ReachedFrom
from graphs import part
from networks import chain, network, unit

SLAB = part(99, "/slab", ground=True)
FLOOR = ((0.0, 0.0, 0.0), (20.0, 10.0, 0.0))


def place(number, kind, height, low=None, aabb=FLOOR, name=None, landings=(), parts=()):
    return Place(
        id=f"place-{number:03d}", kind=kind, name=name or kind, height=height, low=low, area=0.0, aabb=aabb,
        parts=parts, landings=landings,
    )  # fmt: skip


def standing(tag, at, level="place-001", reach="floor", kind=None, height=1.2):
    """A unit beside which one stands, 0.5 m from it towards least y; where it is out of reach nobody stands."""
    stand = None if reach == "out of reach" else (at[0], at[1] - 0.5, at[2] - height)
    eye = (at[0], at[1] - 1.0, at[2]) if tag[0] == "G" else None
    found = unit(tag, kind, at)
    access = Access(place=level, stand=stand, height=height, reach=reach, viewpoint=eye)
    return found.model_copy(update={"access": access})


def gallery(more=(), ground=True):
    """Stairs at x = 8 lead from the ground to a platform at 3 m.

    ::

        T-001 - V-001 - G-001 - V-002 - G-002 - X1    V-001, G-001 on the ground, V-002, G-002 on the platform
        V-003 is 3.5 m above the ground, G-003 has no access that is known, V-004 is on a platform without a way up
    """
    up = "place-002"
    nodes = [
        SLAB,
        place(1, "ground", 0.0, parts=(SLAB.id,) if ground else ()),
        place(2, "platform", 3.0, aabb=((8.0, 0.0, 2.9), (14.0, 4.0, 3.0)), name="platform +3.00 m (south east)"),
        place(3, "stairs", 3.0, 0.0, ((5.0, 1.0, 0.0), (8.0, 2.0, 3.0)), landings=((5.0, 1.5, 0.0), (8.0, 1.5, 3.0))),
        place(4, "platform", 5.0, aabb=((0.0, 8.0, 4.9), (2.0, 10.0, 5.0)), name="platform +5.00 m (north west)"),
        unit("T-001", at=(0.0, 0.0, 2.0), ports=("N1",)),
        standing("V-001", (2.0, 2.0, 1.2), kind="gate valve"),
        standing("G-001", (4.0, 2.0, 1.2), kind="pressure gauge"),
        standing("V-002", (9.0, 2.0, 4.2), up, "platform", "ball valve"),
        standing("G-002", (13.0, 2.0, 4.2), up, "platform", "pressure gauge"),
        standing("V-003", (18.0, 8.0, 3.5), reach="out of reach", kind="gate valve", height=3.5),
        unit("G-003", "pressure gauge", (18.0, 2.0, 1.0)),
        standing("V-004", (1.0, 9.0, 6.2), "place-004", "platform", "ball valve"),
        *more,
    ]
    edges = [
        ReachedFrom(source=up, target="place-003"),
        ReachedFrom(source="place-003", target="place-001"),
        *(Contains(source=n.access.place, target=n.id) for n in nodes if getattr(n, "access", None) is not None),
        *chain("T-001.N1 V-001 G-001 V-002 G-002", length=2.0),
    ]
    return network(nodes, edges, "gallery.usd")
