"""The drawing process: ``python -m cadgraph.agents.drawing.child`` draws what lines on its standard input ask for.

Only ``process.py`` starts it, and holds the other end of its standard input: when that end is gone, so is the caller,
and this process ends.
"""

from __future__ import annotations

import os
import queue
import threading
from collections import OrderedDict
from pathlib import Path
from typing import BinaryIO

from cadgraph.agents.drawing.drawer import Drawer, read_scene
from cadgraph.agents.drawing.messages import Refusal, Request, read_request, write_reply
from cadgraph.agents.drawing.order import Picture
from cadgraph.errors import CadGraphError

__all__ = ["main"]

_KEPT = 2  # scenes, as each takes memory; what is worked out of it takes several times as much
_AT_ONCE = 1 << 20  # bytes


def main(replies: BinaryIO) -> None:
    """Answers each line of standard input, a request, with a picture or a refusal; its end ends the process.

    Args:
        replies: where to, a line each.
    """
    lines: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def receive() -> None:
        rest = b""
        # Unbuffered: the lock of a buffered reader would be held for ever.
        while received := os.read(0, _AT_ONCE):
            *whole, rest = (rest + received).split(b"\n")
            for line in whole:
                lines.put(line)
        # Whatever is being drawn, nobody waits for it any more.
        os._exit(0)

    threading.Thread(target=receive, daemon=True).start()
    kept: OrderedDict[str, Drawer] = OrderedDict()
    while True:
        replies.write(write_reply(_reply(kept, read_request(lines.get()))))
        replies.flush()


def _reply(kept: OrderedDict[str, Drawer], request: Request) -> Picture | Refusal:
    try:
        if request.key not in kept:
            # Before the next one is read, as all take the most memory then.
            while len(kept) >= _KEPT:
                kept.popitem(last=False)
            kept[request.key] = Drawer(read_scene(request.source, request.config, Path(request.folder)))
        kept.move_to_end(request.key)
        return kept[request.key].draw(request.order)
    except (CadGraphError, ValueError, OSError, MemoryError) as error:
        return Refusal.of(error)


if __name__ == "__main__":
    # What libraries print must not come between the replies.
    stream = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    try:
        main(stream)
    except BrokenPipeError:
        # The caller went just now.
        os._exit(0)
