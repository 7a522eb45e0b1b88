"""The tables of models beside these modules (prices, profiles, accuracies), or a user's own in their place."""

from __future__ import annotations

from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError

from cadgraph._io.limits import Limit, read_text_within
from cadgraph.errors import LabelError

__all__ = ["checked", "read_table", "where_of"]

_Model = TypeVar("_Model", bound=BaseModel)


def where_of(file: str | Path, limit: Limit) -> str:
    """What a table is called in messages."""
    return str(file) or f"{limit.what}, the built-in one"


def read_table(file: str | Path, builtin: str, limit: Limit) -> Any:
    """The content of a table, whatever it is.

    Args:
        file: the user's own; the built-in one if empty.
        builtin: file name of that.
        limit: of a file of this kind.

    Raises:
        LabelError: it can't be read, or is no YAML.
    """
    if str(file):
        text = read_text_within(file, limit, LabelError, "give a YAML file like the built-in one")
    else:
        text = resources.files("cadgraph.labelers.lvlm").joinpath(builtin).read_text(encoding="utf-8")
    try:
        return yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        raise LabelError(f"{where_of(file, limit)}: not YAML ({str(error).splitlines()[0]})") from error


def checked(kind: type[_Model], content: Any, where: str, *place: str) -> _Model:
    """A piece of a table as a record.

    Args:
        kind: of record.
        content: of the piece.
        where: what the table is called.
        place: where in it the piece stands.

    Raises:
        LabelError: it is malformed; the message names the place.
    """
    try:
        return kind.model_validate(content)
    except ValidationError as error:
        wrong = error.errors(include_url=False)[0]
        raise LabelError(f"{where}: {'.'.join(map(str, (*place, *wrong['loc'])))}: {wrong['msg']}") from None
