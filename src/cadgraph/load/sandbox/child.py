"""The reading process: ``python -m cadgraph.load.sandbox.child FOLDER`` reads what ``FOLDER/request.json`` asks for.

It leaves the scene in the folder, or ``error.json`` with one line. Only ``isolation.py`` starts it, and holds the other
end of its standard input: when that end is gone, so is the caller, and this process ends and clears the folder.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import shutil
import signal
import sys
import threading
from contextlib import suppress
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, cast

from cadgraph._io.limits import NOTE, read_text_within
from cadgraph.errors import LoadError, MissingExtra
from cadgraph.load.finish import finish
from cadgraph.load.sandbox.exchange import write_scene
from cadgraph.load.sandbox.memory import hold_to
from cadgraph.load.sandbox.trouble import trouble_of

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig

__all__ = ["main"]

_READS_BY_TRIMESH = "cadgraph.load.ply"


def main(folder: Path) -> None:
    """Serves the request in a folder."""
    _leave_no_core()
    # This process ends before garbage matters; to look for it among tens of thousands of meshes takes a fifth longer.
    gc.disable()
    request = json.loads(read_text_within(folder / "request.json", NOTE, LoadError, "read the file again"))
    if request["module"] != _READS_BY_TRIMESH:
        # cascadio imports it, where it is installed, for a bridge that nothing here crosses: most of a second.
        sys.modules["trimesh"] = cast("ModuleType", None)
    # The caller has checked these settings; importing pydantic only to check them again would cost a fifth of a start.
    config = cast("LoadConfig", SimpleNamespace(**request["config"]))
    path = Path(request["path"])
    hold_to(request["memory"])
    try:
        scene = finish(importlib.import_module(request["module"]).read(path, config), config, path)
    except (LoadError, MissingExtra) as error:
        told = [error.purpose, error.extra] if isinstance(error, MissingExtra) else str(error)
        (folder / "error.json").write_text(json.dumps(told), encoding="utf-8")
        return
    write_scene(scene, folder)


def _end_with_caller(folder: Path) -> None:
    def wait() -> None:
        with suppress(OSError, ValueError):
            # Unbuffered: the lock of a buffered reader would be held for ever.
            while os.read(0, 1024):
                pass
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


def _leave_no_core() -> None:
    # A crash on a damaged file is expected here and must not leave gigabytes in the user's folder.
    with suppress(ImportError, OSError, ValueError):
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


if __name__ == "__main__":
    # Ctrl-C reaches both processes; the caller decides, and ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _end_with_caller(Path(sys.argv[1]))
    try:
        main(Path(sys.argv[1]))
    except (OSError, MemoryError) as failure:
        trouble = trouble_of(failure)
        if trouble is None:
            raise
        os._exit(trouble)
    # All is written. To take the scene and the libraries down piece by piece takes time, and some of them crash at it.
    os._exit(0)
