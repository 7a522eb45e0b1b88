"""How much a scene may become, whatever its file promises: instances and references make much of a few bytes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from cadgraph._io.limits import size_text
from cadgraph.errors import LoadError
from cadgraph.load.sandbox.memory import hold_to_more, release

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["FREE", "Budget"]

FREE = 50_000
"""So many meshes or prims any file may have, however small it is; ours: they take about 100 MB."""

_FREE_TRIANGLES = 1_000_000  # that any file may have, each shape counted once
_FREE_BYTES, _UNPACKED = 300 << 20, 400  # a byte of a file unpacks to so many at most, beyond the first 300 MB; ours
_LARGE = 32 << 20  # bytes; a larger file may unpack to more than machines have, so that it isn't watched


class Budget:
    """What is left to a reader; each check raises before memory is taken.

    Args:
        path: of the file, for messages.
        config: the limits.
        size: of the file with all that belongs to it [bytes].
    """

    def __init__(self, path: Path, config: LoadConfig, size: int) -> None:
        self._path = path
        self._config = config
        self._size = size
        self._triangles = 0
        self._watched = False
        self._grown = FREE + int(config.max_growth * size)
        self.most_meshes = min(config.max_meshes, self._grown)
        self.most_prims = min(config.max_prims, self._grown)

    def check_meshes(self, n: int) -> None:
        """Checks a number of meshes with all instances, or of places in a tree that might hold one.

        Raises:
            LoadError: they are more than the settings allow.
        """
        if n > self._config.max_meshes:
            self._refuse(f"more than {self._config.max_meshes:,} meshes with all instances", "load.max_meshes")
        self._check_growth(n, "meshes with all instances")

    def check_prims(self, n: int) -> None:
        """Checks a number of prims with all that references bring.

        Raises:
            LoadError: they are more than the settings allow.
        """
        if n > self._config.max_prims:
            told = f"its references make up to {_shown(n)} prims of it, and at most {self._config.max_prims:,} are read"
            self._refuse(told, "load.max_prims")
        self._check_growth(n, "prims with all references")

    def take_triangles(self, n: int) -> None:
        """Counts triangles of another shape, or what may become so many: a few bytes may unpack to many.

        Raises:
            LoadError: with those of all shapes so far they are more than the settings allow.
        """
        self._triangles += n
        if self._triangles > self._config.max_shape_triangles:
            most = self._config.max_shape_triangles
            self._refuse(f"more than {most:,} triangles, each shape counted once", "load.max_shape_triangles")
        most = _FREE_TRIANGLES + int(self._config.max_growth * self._size)
        if self._triangles > most:
            told = f"{size_text(self._size)} unpack to more than {most:,} triangles, as in no real scene"
            self._refuse(told, "load.max_growth")

    def check_placed(self, n: int) -> None:
        """Checks a number of triangles, those of each shape counted for each of its places.

        Raises:
            LoadError: they are more than the settings allow.
        """
        most = self._config.max_placed_triangles
        if n > most:
            self._refuse(f"more than {most:,} triangles with all instances", "load.max_placed_triangles")

    def watch(self) -> None:
        """From here on this process may take only what arrays of such a file can need; to be repeated as it grows."""
        if self._size < _LARGE:
            self._watched = hold_to_more(_FREE_BYTES + _UNPACKED * self._size)

    def unwatch(self) -> None:
        """Ends what ``watch`` began."""
        release()

    def refuse_arrays(self) -> None:
        """Where there was no more memory, says that the file unpacks to too much; not where reading had too little.

        Raises:
            LoadError: ``watch`` was in force, and left less than the process may take.
        """
        if self._watched:
            self._refuse(f"{size_text(self._size)} unpack to more memory than any real scene", "load.max_growth")

    def _check_growth(self, n: int, what: str) -> None:
        if n > self._grown:
            self._refuse(
                f"{size_text(self._size)} grow to more than {self._grown:,} {what}, as in no real scene",
                "load.max_growth",
            )

    def _refuse(self, told: str, setting: str) -> None:
        raise LoadError(f"{self._path}: {told}; split the scene, or raise {setting} if it is sound")


def _shown(n: int) -> str:
    return f"{n:,}" if n < 10**12 else f"10^{len(str(n)) - 1}"
