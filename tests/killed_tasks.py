"""Calls for processes of their own: some end them."""

import os
from pathlib import Path


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


def fail(number):
    raise ValueError(f"no {number}")
