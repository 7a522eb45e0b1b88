"""Where modules are looked for, for Python processes that this one starts."""

from __future__ import annotations

import os
import sys
from pathlib import Path

__all__ = ["search_path"]


def search_path() -> str:
    """The module search path of this process as a value of ``PYTHONPATH``, this package first."""
    package_root = str(Path(__file__).parents[2])
    return os.pathsep.join([package_root, *(entry for entry in sys.path if entry and entry != package_root)])
