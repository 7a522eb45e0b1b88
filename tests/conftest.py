"""Machine code of kernels is cached beside the sources, keyed by each kernel's own file.

A kernel that calls one in another file would keep the old code of that one when only the other file changes, so the
whole cache goes when any kernel source has changed since the last test run.
"""

import hashlib
from pathlib import Path

import cadgraph

PACKAGE = Path(cadgraph.__file__).parent


def pytest_sessionstart():
    sources = sorted(path for path in PACKAGE.rglob("*.py") if "numba" in (text := path.read_text()) or "compiled" in text)
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()
    stamp = PACKAGE / "__pycache__" / "kernels.sha256"
    if stamp.is_file() and stamp.read_text() == digest:
        return
    for pattern in ("*.nbi", "*.nbc"):
        for cached in PACKAGE.rglob(pattern):
            cached.unlink(missing_ok=True)
    stamp.parent.mkdir(exist_ok=True)
    stamp.write_text(digest)
