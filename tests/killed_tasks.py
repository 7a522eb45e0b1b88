"""Calls for processes of their own: some end them."""

import json
import os
import signal
import time
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph.distribute import tasks


def double(number):
    return 2 * number


def end_once(file, number):
    """Ends its process the first time it is called, as the system does for want of memory."""
    mark = Path(file)
    if not mark.exists():
        mark.write_text("")
        os._exit(9)
    return number


def end_always(number):
    os._exit(number)


def hears_ctrl_c():
    """Whether Ctrl-C reaches its process, as it would have before its first line."""
    return signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


def fail(number):
    raise ValueError(f"no {number}")


def double_slowly(seconds, number):
    time.sleep(seconds)
    return 2 * number


_FREE = "go-on"


def wait_then_call(name, folder, number, call):
    """Says who is at a call and where, waits until all may go on, then does it."""
    import ray

    node = ray.get_runtime_context().get_node_id()
    said = json.dumps({"pid": os.getpid(), "node": node})
    write_atomically(Path(folder) / f"at-{number}-{os.getpid()}.json", said)
    _until(lambda: (Path(folder) / _FREE).exists())
    return getattr(tasks, name)(*call)


def at_work(folder, node, n):
    """The first ``n`` that wait, on a node or on whichever."""

    def there():
        found = [json.loads(file.read_text()) for file in sorted(folder.glob("at-*.json"))]
        return [one for one in found if node in ("", one["node"])]

    _until(lambda: len(there()) >= n)
    return there()[:n]


def let_go(folder):
    """Lets all go on."""
    (folder / _FREE).write_text("")


def _until(true):
    for _ in range(1200):
        if true():
            return
        time.sleep(0.05)
    raise TimeoutError
