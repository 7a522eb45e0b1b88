"""What the event loop of a server says of faults that met a task at work."""

import asyncio

import pytest

pytest.importorskip("mcp")

from cadgraph.agents.mcp.stdio import _tell_faults
from cadgraph.cli.signals import Stopped


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (Stopped(15), False),
        (BaseExceptionGroup("in a task", [Stopped(15)]), False),
        (BaseExceptionGroup("in a task", [BaseExceptionGroup("in another", [Stopped(15)])]), False),
        (ValueError("a fault"), True),
        (BaseExceptionGroup("in a task", [Stopped(15), ValueError("a fault")]), True),
        (None, True),
    ],
)
def test_the_wish_to_end_is_no_fault(error, told):
    said = []
    loop = asyncio.new_event_loop()
    try:
        loop.default_exception_handler = said.append
        _tell_faults(loop, {"message": "unhandled", "exception": error} if error else {"message": "unhandled"})
    finally:
        loop.close()
    assert bool(said) == told
