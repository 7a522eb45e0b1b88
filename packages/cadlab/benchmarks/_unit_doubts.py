"""How well lengths tell their unit: files of one, declared in another, and files that name none."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from cadgraph.config import LoadConfig
from cadgraph.errors import LoadError
from cadgraph.load import load
from cadgraph.load.finish import finish
from cadgraph.load.units import METRES, weigh_units
from cadgraph.model.scene import MeshArrays, Scene, Source
from cadplants import PRESETS, make

TITLES = (
    "scenes", "number", "with pipes", "declared right: false alarm", "declared wrong", "right unit told",
    "wrong unit told", "silent", "no unit, parts kept (OBJ): right", "wrong", "refused",
    "no unit, one bag (STL): right", "wrong", "refused",
)  # fmt: skip
_SUFFIXES = (".usd", ".usda", ".usdc", ".step", ".stp")
_MOST_TRIANGLES = 1_500_000  # of a scene that is tried as one bag: splitting it takes memory and time


@dataclass
class Tally:
    """What came of some scenes.

    Args:
        title: of them.
        scenes: how many.
        piped: how many with two diameters of pipes or more.
        alarms: rightly declared, yet doubted: names of the scenes.
        told: wrong declarations by what was said: the right unit, another wrong one, nothing.
        kept: files without a unit, each part a mesh: right, wrong, refused.
        bag: likewise with all in one mesh.
        misled: names of scenes that a wrong unit was told or taken of.
    """

    title: str
    scenes: int = 0
    piped: int = 0
    alarms: list[str] = field(default_factory=list)
    told: list[int] = field(default_factory=lambda: [0, 0, 0])
    kept: list[int] = field(default_factory=lambda: [0, 0, 0])
    bag: list[int] = field(default_factory=lambda: [0, 0, 0])
    misled: list[str] = field(default_factory=list)

    def cells(self) -> tuple[object, ...]:
        """Its row under ``TITLES``."""
        return (
            self.title,
            self.scenes,
            self.piped,
            len(self.alarms),
            sum(self.told),
            *self.told,
            *self.kept,
            *self.bag,
        )

    def add(self, scene: Scene, name: str) -> None:
        """Tries a scene: its evidence, which is the same whatever the file calls its unit, and both kinds of file.

        Args:
            scene: as loaded, its unit taken for right.
            name: of it.
        """
        metres = scene.source.meters_per_unit
        true = next((unit for unit, length in METRES.items() if abs(length / metres - 1) < 1e-3), "")
        if not true:
            return
        evidence = weigh_units(scene, metres)
        self.scenes += 1
        self.piped += evidence.n_diameters >= 2

        def told_of(declared: str) -> str:
            return evidence.best if evidence.certain or evidence.odd(METRES[declared], scene.n_meshes) else ""

        if told_of(true) not in ("", true):
            self.alarms.append(f"{name} ({told_of(true)} for {true})")
        for declared in METRES:
            if declared != true:
                told = told_of(declared)
                outcome = 2 if told in ("", declared) else 0 if told == true else 1
                self.told[outcome] += 1
        for made, counts in ((scene, self.kept), (_bag(scene), self.bag)):
            if made is not None:
                outcome = _taken(made, metres)
                counts[outcome] += 1
                if outcome == 1:
                    self.misled.append(f"{name}{' as one bag' if made is not scene else ''}")


def _bag(scene: Scene) -> Scene | None:
    """All triangles of a scene in one mesh, without welding; None where they are too many."""
    if scene.n_triangles > _MOST_TRIANGLES:
        return None
    corners = scene.triangles().reshape(-1, 3)
    mesh = corners, np.arange(len(corners)).reshape(-1, 3)
    return Scene(MeshArrays.of([mesh]), ("/mesh",), np.full((1, 3), np.nan, np.float32), scene.source)


def _taken(scene: Scene, metres: float) -> int:
    """What becomes of a scene whose file names no unit: 0 the right one is taken, 1 a wrong one, 2 none."""
    one = scene.n_meshes == 1
    source = Source(meters_per_unit=1.0, format="stl" if one else "obj", unit_stated=False)
    # As the file has it: in its own unit, taken for metres until it is settled.
    shapes = replace(scene.shapes, vertices=scene.shapes.vertices / metres)
    placed = scene.placement and replace(scene.placement, shift=scene.placement.shift / metres)
    file = replace(scene, shapes=shapes, placement=placed, source=source, origin=np.zeros(3), diagnostics=())
    try:
        found = finish(file, LoadConfig(up="Z"), Path("scene"))
    except LoadError:
        return 2
    return int(abs(found.source.meters_per_unit / metres - 1) > 1e-3)


def files_in(folder: Path) -> list[Path]:
    """The USD and STEP files below a folder, in order."""
    return sorted(path for path in folder.rglob("*") if path.suffix.lower() in _SUFFIXES)


def tally_files(title: str, files: Iterable[Path]) -> Tally:
    """Of the files that hold any mesh."""
    tally = Tally(title)
    for path in files:
        try:
            scene = load(path, LoadConfig(isolate=False))
        except LoadError:
            continue
        tally.add(scene, f"{path.parent.name}/{path.name}")
    return tally


def tally_plants(seeds: Sequence[int]) -> Tally:
    """Of a plant of each preset and seed."""
    tally = Tally(f"generated plants ({len(PRESETS)} presets, seeds {', '.join(map(str, seeds))})")
    for name, scene in _plants(seeds):
        tally.add(scene, name)
    return tally


def _plants(seeds: Sequence[int]) -> Iterator[tuple[str, Scene]]:
    for preset in PRESETS:
        for seed in seeds:
            scene = make(preset, seed).scene()
            yield f"{preset} {seed}", replace(scene, source=replace(scene.source, meters_per_unit=0.001))
