"""Straight runs of pipe and what joins them, for tests of joints: lines without any mesh."""

from __future__ import annotations

import numpy as np

from cadgraph.geometry.line.centreline import Branch, Centreline, End
from cadgraph.model.facts import StatedLink
from cadgraph.model.parts import Contacts
from cadgraph.model.stated import StatedJoin
from cadgraph.stages.relate.decide import decide_joints, settle_faces
from cadgraph.stages.relate.joint import gather_ends
from cadgraph.stages.relate.offer import Surroundings, offer_faces, offer_taps
from cadgraph.stages.relate.stated import Stated

NAN = float("nan")
BRIDGE = 0.012


def touching(*pairs):
    """Contacts between pairs of parts, at no distance."""
    n = len(pairs)
    return Contacts(np.array(pairs, np.int64).reshape(n, 2), np.zeros(n), np.zeros((n, 2, 3)))


def run(start, stop, radius=0.05, only=None):
    """A straight line between two points (or places along x) with both ends, or only the first or last of them."""
    start, stop = (np.array([p, 0, 0], float) if np.isscalar(p) else np.asarray(p, float) for p in (start, stop))
    points = np.stack([start, stop])
    way = (stop - start) / np.linalg.norm(stop - start)
    ends = (End(start, -way, radius, NAN, 0), End(stop, way, radius, NAN, 0))
    ends = ends if only is None else (ends[only],)
    return Centreline((Branch(points, np.full(2, radius), np.full(2, NAN)),), ends, (), 1.0)


def stated(*pairs):
    """What a file says that joins pairs of parts."""
    links = (StatedLink(f"/{a}", f"/{b}", "unknown", "IfcRelConnectsPorts") for a, b in pairs)
    return Stated(tuple(StatedJoin((a,), (b,), link) for (a, b), link in zip(pairs, links, strict=True)))


def offers(lines, blocked=(), bolted=(), bridge=BRIDGE, contacts=None, stated=None):
    """The offers between ends of lines, numbered as they are given; and the ends."""
    ends = gather_ends(dict(enumerate(lines)))
    around = Surroundings(contacts or touching(), bridge, set(blocked), set(bolted), stated or Stated())
    return offer_faces(ends, around), ends


def decided(lines, singles=None, **around):
    """What each end joins: (part, other part) of each face or corner, and the kind and part of each other offer."""
    faces, ends = offers(lines, **around)
    decision = decide_joints(faces, singles or {}, settle_faces(faces))
    return {
        (int(ends.part[offer.row]), int(ends.part[offer.other]))
        if offer.kind in ("face", "corner")
        else (offer.kind, offer.other)
        for offer in decision.joined.values()
    }


def taps(lines, end, side, bridge=BRIDGE):
    """The offers of the last end of one line at the side of another one."""
    ends = gather_ends(dict(enumerate(lines)))
    return offer_taps(ends, ends.of_part[end][-1], dict(enumerate(lines)), [(side, 0.0)], bridge)
