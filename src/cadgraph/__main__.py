"""The command line: ``cadgraph``, and ``python -m cadgraph``."""

from __future__ import annotations

import signal

__all__ = ["main"]


def main() -> None:
    """Runs the command line.

    Importing it takes half a second, in which nothing is begun yet: Ctrl-C then ends the process without a word.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from cadgraph.cli import main as run

    run()


if __name__ == "__main__":
    main()
