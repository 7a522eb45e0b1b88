"""Functional units: found, missed and spurious (paper, Table I), and which predicted unit stands for which true one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cadgraph._io.text import natural_key
from cadgraph.model.records import Unit
from cadgraph.model.truth import TruthUnit
from cadlab.evaluate.pairing import Pairing
from cadlab.evaluate.scores import Score, share

__all__ = ["PredictedUnit", "TrueUnit", "UnitMatch", "UnitScores", "UnitTypeScores", "match_units", "score_units"]


@dataclass(frozen=True)
class TrueUnit:
    """What became of one true unit.

    Args:
        id: in the truth.
        tag: as people call it.
        type: of unit.
        kind: or None.
        structure: the true cluster, or None.
        n_parts: parts that hold it.
        n_labelled: of its parts that count, those that carry a group of its type.
        n_counted: its parts that count for ``found``.
        found: by labels alone, as in the paper: ``"fully"``, ``"partially"`` or ``"missed"``.
        exact: one predicted unit of its type holds exactly its parts.
        pieces: tags of the predicted units of its type that hold a part of it.
        match: tag of the predicted unit that stands for it, or None.
        overlap: of both: common parts over all parts of the two, 0..1.
        predicted_kind: kind of the matched unit, or None.
    """

    id: str
    tag: str
    type: str
    kind: str | None
    structure: str | None
    n_parts: int
    n_labelled: int
    n_counted: int
    found: str
    exact: bool
    pieces: tuple[str, ...]
    match: str | None
    overlap: float
    predicted_kind: str | None


@dataclass(frozen=True)
class PredictedUnit:
    """What one predicted unit is.

    Args:
        tag: in the graph.
        type: of unit.
        structure: the true cluster that most of its meshes are in, or None.
        match: id of the true unit that it stands for, or None.
        holds: ids of the true units of its type of which it holds a part.
        spurious: it shares no majority with any true unit of its type: it holds no more than half of the parts of
            each, and no more than half of its own parts lie in any one.
    """

    tag: str
    type: str
    structure: str | None
    match: str | None
    holds: tuple[str, ...]
    spurious: bool


@dataclass(frozen=True)
class UnitMatch:
    """All units of both sides.

    Args:
        true: by their paths.
        predicted: by their paths; units that hold no mesh of the truth are left out.
        true_of: id of the true unit that a predicted unit (by its id in the graph) stands for.
    """

    true: tuple[TrueUnit, ...]
    predicted: tuple[PredictedUnit, ...]
    true_of: dict[str, str]

    @cached_property
    def tag_of_true(self) -> dict[str, str]:
        """The tag of each true unit."""
        return {unit.id: unit.tag for unit in self.true}


@dataclass(frozen=True)
class UnitTypeScores:
    """Units of one type (paper, Table I).

    Args:
        type: of unit; ``"all"`` for the sum.
        n_true: true units.
        n_predicted: predicted units.
        fully: true units of which all parts carry a group of the type (the paper's looser reading).
        partially: of which some do.
        missed: of which none does.
        exact: for which one predicted unit holds exactly their parts (the strict reading).
        split: true units that lie in several predicted ones.
        merged: predicted units that hold parts of several true ones.
        spurious: predicted units that share no majority with a true one.
        matched: one-to-one matches by overlap.
        kinds_decided: matches of which both kinds are known.
        kinds_right: of which they agree.
    """

    type: str
    n_true: int
    n_predicted: int
    fully: int
    partially: int
    missed: int
    exact: int
    split: int
    merged: int
    spurious: int
    matched: int
    kinds_decided: int
    kinds_right: int

    @property
    def strict(self) -> Score:
        """Units that are exactly right."""
        return Score(self.n_true, self.n_predicted, self.exact)

    @property
    def detection(self) -> Score:
        """Units that are there at all: one-to-one matches with any overlap."""
        return Score(self.n_true, self.n_predicted, self.matched)

    @property
    def fully_share(self) -> float | None:
        """The fully found share of the true units."""
        return share(self.fully, self.n_true)

    @property
    def kind_accuracy(self) -> float | None:
        """The right share of the decided kinds."""
        return share(self.kinds_right, self.kinds_decided)


@dataclass(frozen=True)
class UnitScores:
    """All units of a structure.

    Args:
        types: ascending by name.
        total: their sum.
        units: each true unit.
        predicted: each predicted unit.
        present: whether the graph has any unit at all.
    """

    types: tuple[UnitTypeScores, ...]
    total: UnitTypeScores
    units: tuple[TrueUnit, ...]
    predicted: tuple[PredictedUnit, ...]
    present: bool = True


def match_units(pairing: Pairing) -> UnitMatch:
    """Finds for each true unit what became of it.

    Predicted and true units of one type are matched one to one so that the sum of their overlaps (common parts over
    all parts of the two) is greatest; without a common part there is no match.
    """
    true = sorted(pairing.truth.units or (), key=lambda unit: _place(unit.meshes))
    meshes = {unit.id: [m for p in unit.parts for m in pairing.graph.part(p).meshes] for unit in pairing.graph.units()}
    predicted = [unit for unit in pairing.graph.units() if any(mesh in pairing.rows for mesh in meshes[unit.id])]
    # Ids may differ from run to run; with paths the same of several equally good matches is always taken.
    predicted.sort(key=lambda unit: _place(meshes[unit.id]))
    found = {unit.id: frozenset(unit.parts) & set(pairing.head) for unit in predicted}
    overlap = _overlaps(true, predicted, pairing.true_parts, found)
    chosen = _assign(overlap)
    match_of_true = {true[i].id: (predicted[j], float(overlap[i, j])) for i, j in chosen}
    true_of = {predicted[j].id: true[i].id for i, j in chosen}
    return UnitMatch(
        tuple(_true_unit(pairing, unit, predicted, found, match_of_true.get(unit.id)) for unit in true),
        tuple(
            _predicted_unit(pairing, unit, found[unit.id], true, true_of.get(unit.id), meshes[unit.id])
            for unit in predicted
        ),
        true_of,
    )


def score_units(true: Sequence[TrueUnit], predicted: Sequence[PredictedUnit], *, present: bool = True) -> UnitScores:
    """Counts units by type."""
    types = sorted({unit.type for unit in true} | {unit.type for unit in predicted})
    return UnitScores(
        tuple(
            _score_type(name, [u for u in true if u.type == name], [u for u in predicted if u.type == name])
            for name in types
        ),
        _score_type("all", true, predicted),
        tuple(true),
        tuple(predicted),
        present,
    )


def _place(meshes: Sequence[str]) -> tuple[tuple[tuple[str | int, ...], str], ...]:
    return tuple(sorted(natural_key(mesh) for mesh in meshes))


def _overlaps(
    true: Sequence[TruthUnit],
    predicted: Sequence[Unit],
    true_parts: dict[str, frozenset[str]],
    found: dict[str, frozenset[str]],
) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """``(n_true, n_predicted)`` common parts over all parts; 0 between types."""
    overlap = np.zeros((len(true), len(predicted)))
    units_of_part: dict[str, list[int]] = {}
    for j, unit in enumerate(predicted):
        for part in found[unit.id]:
            units_of_part.setdefault(part, []).append(j)
    for i, truth in enumerate(true):
        here = true_parts[truth.id]
        for j in {j for part in here for j in units_of_part.get(part, ())}:
            there = found[predicted[j].id]
            if predicted[j].unit_type == truth.type:
                overlap[i, j] = len(here & there) / len(here | there)
    return overlap


def _assign(overlap: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> list[tuple[int, int]]:
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(overlap, maximize=True)
    return [(int(i), int(j)) for i, j in zip(rows, columns, strict=True) if overlap[i, j] > 0]


def _true_unit(
    pairing: Pairing,
    unit: TruthUnit,
    predicted: Sequence[Unit],
    found: dict[str, frozenset[str]],
    match: tuple[Unit, float] | None,
) -> TrueUnit:
    parts = pairing.true_parts[unit.id]
    counted, labelled = _labelled_parts(pairing, unit, parts)
    same_type = [other for other in predicted if other.unit_type == unit.type]
    matched, overlap = match if match is not None else (None, 0.0)
    return TrueUnit(
        id=unit.id,
        tag=unit.tag or unit.id,
        type=unit.type,
        kind=unit.kind,
        structure=pairing.structure_of_meshes(unit.meshes),
        n_parts=len(parts),
        n_labelled=len(labelled),
        n_counted=len(counted),
        found=_verdict(len(labelled), len(counted)),
        exact=_owns(pairing, unit, parts) and any(found[other.id] == parts for other in same_type),
        pieces=tuple(other.tag for other in same_type if found[other.id] & parts),
        match=matched.tag if matched is not None else None,
        overlap=overlap,
        predicted_kind=matched.kind if matched is not None else None,
    )


def _labelled_parts(pairing: Pairing, unit: TruthUnit, parts: frozenset[str]) -> tuple[frozenset[str], list[str]]:
    """The parts of a true unit that count, and those of them whose label is of its type.

    A unit may hold parts of another group (its bolts): only those of its own must carry the group.
    """
    groups = {group for group, type_ in pairing.vocabulary.unit_of_group.items() if type_ == unit.type}
    own = frozenset(part for part in parts if pairing.rows[pairing.head[part]].group in groups)
    counted = own or parts
    return counted, [part for part in counted if (label := pairing.label(part)) is not None and label[0] in groups]


def _verdict(n_labelled: int, n_counted: int) -> str:
    """What the paper's looser reading says of a unit."""
    if not n_labelled:
        return "missed"
    return "fully" if n_labelled == n_counted else "partially"


def _owns(pairing: Pairing, unit: TruthUnit, parts: frozenset[str]) -> bool:
    """Whether a true unit has parts, and all are its own: one that only shares parts can't be held by one unit."""
    return bool(parts) and all(pairing.unit_of_mesh.get(pairing.head[part]) == unit.id for part in parts)


def _predicted_unit(
    pairing: Pairing,
    unit: Unit,
    parts: frozenset[str],
    true: Sequence[TruthUnit],
    match: str | None,
    meshes: Sequence[str],
) -> PredictedUnit:
    holds, majority = [], False
    for truth in true:
        theirs = pairing.true_parts[truth.id]
        common = len(parts & theirs)
        if common and truth.type == unit.unit_type:
            holds.append(truth.id)
            majority = majority or 2 * common > len(theirs) or 2 * common > len(parts)
    return PredictedUnit(
        unit.tag, unit.unit_type, pairing.structure_of_meshes(meshes), match, tuple(holds), not majority
    )


def _score_type(name: str, true: Sequence[TrueUnit], predicted: Sequence[PredictedUnit]) -> UnitTypeScores:
    kinds = [(u.kind, u.predicted_kind) for u in true if u.kind is not None and u.predicted_kind is not None]
    return UnitTypeScores(
        type=name,
        n_true=len(true),
        n_predicted=len(predicted),
        fully=sum(unit.found == "fully" for unit in true),
        partially=sum(unit.found == "partially" for unit in true),
        missed=sum(unit.found == "missed" for unit in true),
        exact=sum(unit.exact for unit in true),
        split=sum(len(unit.pieces) > 1 for unit in true),
        merged=sum(len(unit.holds) > 1 for unit in predicted),
        spurious=sum(unit.spurious for unit in predicted),
        matched=sum(unit.match is not None for unit in true),
        kinds_decided=len(kinds),
        kinds_right=sum(a == b for a, b in kinds),
    )
