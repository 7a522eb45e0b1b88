"""The process that draws the pictures of a server: to look at a whole scene keeps an interpreter busy for seconds."""

from __future__ import annotations

import os
import threading

from cadgraph._io.search_path import search_path
from cadgraph.agents.child_process import ChildProcess
from cadgraph.agents.drawing.messages import Refusal, Request, read_reply, write_request
from cadgraph.agents.drawing.order import Picture
from cadgraph.errors import AskError

__all__ = ["DrawingProcess"]

# -P: a file called numpy.py in the folder that one happens to be in must not be imported.
_COMMAND = ("-P", "-m", "cadgraph.agents.drawing.child")


class DrawingProcess:
    """Draws pictures in a process of its own, one at a time; any thread may ask.

    The process is started by the first picture, and by the next one after it was killed. It ends with this object, or
    with this process, however that ends.
    """

    def __init__(self) -> None:
        self._drawing = threading.Lock()
        self._changing = threading.Lock()  # of what follows; never held for long
        self._child: ChildProcess | None = None
        self._closed = False

    def draw(self, request: Request) -> Picture:
        """Draws a picture.

        Args:
            request: what of which scene.

        Raises:
            AskError: there is nothing of it to be drawn, or the process was ended.
            LoadError: the scene can't be read.
            OSError: the process can't be started, or the scene not be read now.
            MemoryError: there is too little memory.
        """
        line = write_request(request)
        with self._drawing:
            child = self._running()
            answer = child.talk(line)
            ended = not answer.endswith(b"\n")
            if ended:
                child.end()
        if ended:
            raise AskError("the process that draws pictures was ended, perhaps for want of memory; ask again")
        reply = read_reply(answer)
        if isinstance(reply, Refusal):
            raise reply.exception()
        return reply

    def close(self) -> None:
        """Ends the process, also while it draws; nothing is drawn any more."""
        with self._changing:
            self._closed = True
            if self._child is not None:
                self._child.end()

    def _running(self) -> ChildProcess:
        with self._changing:
            if self._closed:
                raise AskError("the server is ending; no picture is drawn any more")
            if self._child is not None and self._child.gone:
                self._child.end()
                self._child = None
            if self._child is None:
                self._child = ChildProcess(_COMMAND, os.environ | {"PYTHONPATH": search_path(), "PYTHONUTF8": "1"})
            return self._child
