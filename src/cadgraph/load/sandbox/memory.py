"""How much memory a reading process may take, where the system can hold it to that."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path

__all__ = ["allowed_bytes", "hold_to", "hold_to_more", "release"]

_SHARE = 0.9  # of what the machine has: the rest is for the system and the process that asked
_LEAST = 1 << 30  # libraries alone take a fifth of it
_CONTAINER = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")
_held = False  # whether this is a reading process


def allowed_bytes(gigabytes: float | None) -> int | None:
    """What a reading process may take.

    Args:
        gigabytes: as set; None: nine tenths of what this machine has.

    Returns:
        Bytes, or None where nobody knows what the machine has.
    """
    if gigabytes is not None:
        return int(gigabytes * 1e9)
    has = _of_machine()
    return None if has is None else max(_LEAST, int(_SHARE * has))


def _of_machine() -> int | None:
    """Bytes of memory of this machine, or of the container that this process runs in if that has less."""
    sizes = []
    with suppress(AttributeError, OSError, ValueError):
        sizes.append(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    for name in _CONTAINER:
        with suppress(OSError, ValueError):
            sizes.append(int(Path(name).read_text(encoding="ascii")))
    sizes = [size for size in sizes if size > 0]
    return min(sizes) if sizes else None


def hold_to(most: int | None) -> None:
    """Makes the system refuse this process more memory than this; does nothing where a system can't.

    Files that are mapped to be read don't count on Linux, since a scene may be larger than the memory.

    Args:
        most: bytes; None: no limit.
    """
    if most is None:
        return
    with suppress(ImportError, OSError, ValueError, AttributeError):
        import resource

        kind = resource.RLIMIT_DATA if sys.platform == "linux" else resource.RLIMIT_AS
        _, hard = resource.getrlimit(kind)
        least = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(kind, (least, least))
        global _held
        _held = True


def hold_to_more(more: int) -> bool:
    """Until ``release``, lets this process take only so much more than it has; only where ``hold_to`` was called.

    Args:
        more: bytes.

    Returns:
        Whether that is less than it may take by ``hold_to``.
    """
    if not _held or sys.platform != "linux":
        return False
    with suppress(ImportError, OSError, ValueError, IndexError):
        import resource

        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[5])
        hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
        most = pages * os.sysconf("SC_PAGE_SIZE") + more
        is_less = hard == resource.RLIM_INFINITY or most < hard
        resource.setrlimit(resource.RLIMIT_DATA, (most if is_less else hard, hard))
        return is_less
    return False


def release() -> None:
    """Ends what ``hold_to_more`` began."""
    if not _held or sys.platform != "linux":
        return
    with suppress(ImportError, OSError, ValueError):
        import resource

        hard = resource.getrlimit(resource.RLIMIT_DATA)[1]
        resource.setrlimit(resource.RLIMIT_DATA, (hard, hard))
