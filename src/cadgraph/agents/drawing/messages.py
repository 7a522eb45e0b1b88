"""What is said between a server and the process that draws its pictures: a line of JSON each way."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import Base64Bytes, TypeAdapter

from cadgraph.agents.drawing.order import Order, Picture
from cadgraph.errors import AskError, CadGraphError, LoadError
from cadgraph.model.records import SourceRecord

__all__ = ["Refusal", "Request", "read_reply", "read_request", "write_reply", "write_request"]

_ERRORS = {error.__name__: error for error in (AskError, LoadError, CadGraphError, ValueError, MemoryError)}


@dataclass(frozen=True)
class Request:
    """What is to be drawn, and of which scene.

    Args:
        key: the same for all requests of one scene, as long as nothing was built anew.
        folder: that holds the graph.
        source: of the graph.
        config: of the graph.
        order: what is to be drawn.
    """

    key: str
    folder: str
    source: SourceRecord
    config: Mapping[str, Any]
    order: Order


@dataclass(frozen=True)
class Refusal:
    """Why there is no picture.

    Args:
        error: name of the exception.
        text: what it says.
    """

    error: str
    text: str

    @classmethod
    def of(cls, error: Exception) -> Refusal:
        """An exception in words."""
        if isinstance(error, OSError):
            return cls("OSError", error.strerror or "")
        kind = next(name for name, each in _ERRORS.items() if isinstance(error, each))
        return cls(kind, str(error))

    def exception(self) -> Exception:
        """The exception again; of errors without a name of their own here, the one that they are a kind of."""
        return OSError(0, self.text) if self.error == "OSError" else _ERRORS[self.error](self.text)


@dataclass(frozen=True)
class _Drawn:
    """A picture, its bytes as JSON can hold them."""

    text: str
    values: dict[str, Any]
    png: Base64Bytes


_REQUEST = TypeAdapter(Request)
_REPLY: TypeAdapter[_Drawn | Refusal] = TypeAdapter(_Drawn | Refusal)


def write_request(request: Request) -> bytes:
    """A request as a line."""
    return _REQUEST.dump_json(request) + b"\n"


def read_request(line: bytes) -> Request:
    """The request that a line holds."""
    return _REQUEST.validate_json(line)


def write_reply(reply: Picture | Refusal) -> bytes:
    """A reply as a line."""
    if isinstance(reply, Picture):
        return _REPLY.dump_json(_Drawn(reply.text, dict(reply.values), reply.png)) + b"\n"
    return _REPLY.dump_json(reply) + b"\n"


def read_reply(line: bytes) -> Picture | Refusal:
    """The reply that a line holds."""
    reply = _REPLY.validate_json(line)
    return reply if isinstance(reply, Refusal) else Picture(reply.text, reply.values, reply.png)
