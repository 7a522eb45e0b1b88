"""The command line: ``cadplants``, and ``python -m cadplants``."""

from __future__ import annotations

import signal

__all__ = ["main"]


def main() -> None:
    """Runs the command line; Ctrl-C while it is imported ends the process without a word."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from cadplants.cli import main as run

    run()


if __name__ == "__main__":
    main()
