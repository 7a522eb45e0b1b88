"""Which way gauges face: how often the stage of places is right, on families and on styles it was not fitted to.

Every family of the generator with a dial or a screen, in every style, modelled in a few meshes or in pieces, each with
all its parts named and with none. The weights of ``cadgraph.stages.places.face`` come from ``--fit``.

python packages/cadlab/benchmarks/facings.py [--fit]
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize

from cadgraph.geometry.visibility.front import FEATURES, sides_of
from cadgraph.model.scene import Floats
from cadgraph.stages.places.face import kind_of_name, scores_of
from cadplants import STYLES
from cadplants.families import FAMILIES
from cadplants.model.family import as_assembly
from cadplants.solids.transforms import spun

_RIGHT = 0.9  # cosine of the angle to the true direction: 26 degrees
_FOLDS = 4
_STIFF = 0.01  # weight of the squares of the weights against the likelihood


@dataclass(frozen=True, eq=False)
class _Gauge:
    """A gauge with its sides: a table of what they show, and how well each agrees with the truth."""

    family: str
    style: str
    named: bool
    table: Floats
    cosines: Floats

    @property
    def both(self) -> Floats:
        """What each side shows, and how that differs from the opposite side."""
        other = self.table[np.arange(len(self.table)) ^ 1]
        return np.hstack([self.table, self.table - other])


def gauges() -> Iterator[_Gauge]:
    """All gauges, each turned about z by another angle."""
    for name, family in FAMILIES.items():
        if family.unit != "gauge":
            continue
        for k, (style_name, style) in enumerate(STYLES.items()):
            for grain in ("few", "pieces"):
                seed = (len(name) + k) % 3
                rng = np.random.default_rng([seed, k, 7])
                own, dn = replace(style, gauge=grain), family.sizes[seed % len(family.sizes)]
                built = family.build(dn, own, rng, 1.1) if family.place == "carrier" else family.build(dn, own, rng)
                unit = as_assembly(family, built, own, "G").placed(spun("z", float(rng.uniform(0, 6.28))))
                parts = [c for c in unit.components if c.unit == "G"]
                fronts = [c.pose[:3, :3] @ c.front for c in parts if c.front is not None]
                if not fronts:
                    continue
                starts = np.cumsum([0, *(len(c.vertices) for c in parts)])
                vertices = np.concatenate([c.vertices for c in parts])
                faces = np.concatenate([c.faces + start for c, start in zip(parts, starts, strict=False)])
                for named in (True, False):
                    kinds = [np.full(len(c.faces), kind_of_name(c.name) if named else 1) for c in parts]
                    sides = sides_of(vertices, faces.astype(np.int32), np.concatenate(kinds).astype(np.int64))
                    table = np.array([side.features for side in sides])
                    cosines = np.array([side.direction @ fronts[0] for side in sides])
                    yield _Gauge(name, style_name, named, table, cosines)


def fitted(some: Sequence[_Gauge]) -> Floats:
    """Weights of what a side shows, then of how it differs from the opposite side: most likely, and not too large."""
    known = [(gauge.both, gauge.cosines > _RIGHT) for gauge in some if (gauge.cosines > _RIGHT).any()]
    scale = np.vstack([table for table, _ in known]).std(axis=0) + 1e-9

    def loss(weights: Floats) -> tuple[float, Floats]:
        total, slope = 0.0, np.zeros_like(weights)
        for table, right in known:
            rows = table / scale
            odds = np.exp(rows @ weights - (rows @ weights).max())
            share = odds / odds.sum()
            total -= np.log(share[right].sum() + 1e-12)
            wanted = np.where(right, share, 0.0)
            slope -= rows.T @ (wanted / wanted.sum() - share)
        return float(total / len(known) + _STIFF * weights @ weights), slope / len(known) + 2 * _STIFF * weights

    start = np.zeros(2 * len(FEATURES))
    weights: Floats = minimize(loss, start, jac=True, method="L-BFGS-B").x / scale
    return weights


def _held_out(all_of_them: Sequence[_Gauge], key: str, folds: Sequence[set[str]]) -> None:
    right: dict[bool, list[bool]] = defaultdict(list)
    for fold in folds:
        weights = fitted([gauge for gauge in all_of_them if getattr(gauge, key) not in fold])
        for gauge in all_of_them:
            if getattr(gauge, key) in fold:
                right[gauge.named].append(bool(gauge.cosines[int(np.argmax(gauge.both @ weights))] > _RIGHT))
    noun = {"family": "families", "style": "styles"}[key]
    print(f"| {noun} not fitted to | {np.mean(right[True]):.1%} | {np.mean(right[False]):.1%} |")


def main() -> None:
    """Measures, or fits."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fit", action="store_true", help="print weights fitted to all gauges")
    wanted = parser.parse_args()
    found = list(gauges())
    if wanted.fit:
        own, against = np.split(fitted(found), 2)
        for name, a, b in zip(FEATURES, own, against, strict=True):
            print(f'    ("{name}", {a:.3f}, {b:.3f}),')
        return
    families, styles = sorted({g.family for g in found}), sorted({g.style for g in found})
    print(f"{len(found) // 2} gauges of {len(families)} families in {len(styles)} styles")
    print("| right | parts named | not named |\n|---|---:|---:|")
    _held_out(found, "family", [set(families[k::_FOLDS]) for k in range(_FOLDS)])
    _held_out(found, "style", [{style} for style in styles])
    shipped = [
        [bool(g.cosines[int(np.argmax(scores_of(g.table)))] > _RIGHT) for g in found if g.named == n]
        for n in (True, False)
    ]
    print(f"| as shipped | {np.mean(shipped[0]):.1%} | {np.mean(shipped[1]):.1%} |")


if __name__ == "__main__":
    main()
