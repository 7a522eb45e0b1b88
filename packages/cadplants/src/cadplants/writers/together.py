"""Files that belong together: all of them are written beside their targets first, then renamed over these."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from cadgraph._io.atomic import replacing

__all__ = ["together"]


@contextmanager
def together(*targets: str | Path) -> Iterator[tuple[Path, ...]]:
    """Paths beside some targets to write to; they take the targets' places when the block ends well, the first last.

    So whoever finds the first finds what belongs to it. Where the block is broken off, nothing is left of it.

    Args:
        targets: the main file, then those without which it is of no use.

    Raises:
        OutputError: a folder can't be made or written to.
    """
    with ExitStack() as stack:
        yield tuple(stack.enter_context(replacing(target)) for target in targets)
