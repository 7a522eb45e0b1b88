"""Opening a model, and reading its entities though some of them may be damaged."""

from __future__ import annotations

import mmap
import re
import tempfile
from pathlib import Path
from typing import Any

import ifcopenshell

from cadgraph._io.spf import HEAD, renamed_schema, schema_of
from cadgraph._io.text import printable
from cadgraph.errors import LoadError
from cadgraph.load.packing import Notes

__all__ = ["Entity", "Model", "attribute", "clean", "entities", "of_type", "open_model", "text"]

Model = Any
"""An open file of IfcOpenShell, which has no types."""
Entity = Any
"""An entity of one."""

_LONGEST = 500  # [characters] of a text of the file that is kept; ours
_ENTITY = re.compile(rb"^[ \t]*#\d+[ \t]*=", re.MULTILINE)


def open_model(path: Path, given: str, notes: Notes) -> Model:
    """Opens an IFC file in the schema that it names, or else in the nearest one that the library knows.

    Args:
        path: a STEP physical file.
        given: its path for messages.
        notes: gets ``schema-guessed`` where another schema was taken, ``damaged-entity`` where lines are lost.

    Raises:
        LoadError: it can't be parsed, or no schema is near.
    """
    try:
        model = _open(path)
    except ifcopenshell.SchemaError:
        model = _open_as_nearest(path, given, notes)
    except (ifcopenshell.Error, OSError, RuntimeError, ValueError) as error:
        raise LoadError(f"{given}: not readable as IFC ({_reason(error)}); export it again") from None
    _note_lost(path, model, notes)
    return model


def _open(path: Path) -> Model:
    return ifcopenshell.open(str(path), format=".ifc")


def _open_as_nearest(path: Path, given: str, notes: Notes) -> Model:
    with path.open("rb") as file:
        schema = schema_of(file.read(HEAD)) or "none"
    known = sorted(name for name in ifcopenshell.ifcopenshell_wrapper.schema_names() if name.startswith("IFC"))
    nearest = max(known, key=lambda name: (_shared(name, schema), -len(name)), default="")
    # Drafts and addenda of one version begin alike: IFC4X3_RC3 and IFC4X3_ADD2, IFC2X2_FINAL and IFC2X3.
    if _shared(nearest, schema) < len("IFC4"):
        raise LoadError(f"{given}: its schema {schema} is not known; export it as one of {', '.join(known)}")
    with tempfile.TemporaryDirectory(prefix="cadgraph-ifc-", ignore_cleanup_errors=True) as folder:
        copy = Path(folder) / "model.ifc"
        renamed_schema(path, nearest, copy)
        try:
            model = _open(copy)
        except (ifcopenshell.Error, OSError, RuntimeError, ValueError) as error:
            raise LoadError(
                f"{given}: its schema {schema} is not known, and as {nearest} it can't be read ({_reason(error)}); "
                f"export it as {nearest}"
            ) from None
    notes.add("schema-guessed", f"the reader does not know the file's schema {schema}; it was read as {nearest}")
    return model


def _shared(name: str, schema: str) -> int:
    """How many letters two names have in common at their start."""
    pairs = zip(name, schema, strict=False)
    return next((i for i, (a, b) in enumerate(pairs) if a != b), min(len(name), len(schema)))


def _note_lost(path: Path, model: Model, notes: Notes) -> None:
    # The library leaves out lines that it can't parse and goes on without a word.
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        written = sum(1 for _ in _ENTITY.finditer(content))
    # Since version 0.9 the file itself has its entities.
    holder: Any = getattr(model, "wrapped_data", model)
    lost = written - len(holder.entity_names())
    if lost > 0:
        lines = "1 line of the file holds" if lost == 1 else f"{lost} lines of the file hold"
        notes.add("damaged-entity", f"{lines} no readable entity, or one numbered twice; copy or export it again")


def _reason(error: Exception) -> str:
    return printable(str(error).strip())[:200] or type(error).__name__


def of_type(model: Model, name: str) -> list[Entity]:
    """All entities of a class and of those below it, in the order of their numbers; none if the schema lacks it."""
    try:
        found = model.by_type(name)
    except RuntimeError:
        return []
    return sorted(found, key=lambda entity: int(entity.id()))


def attribute(entity: Entity, name: str) -> Any:
    """The value of an attribute, or None where its class has no such one or it can't be read."""
    try:
        return getattr(entity, name, None)
    except (RuntimeError, TypeError, ValueError):
        return None


def entities(entity: Entity, name: str) -> list[Entity]:
    """The entities that an attribute refers to; empty where there are none."""
    value = attribute(entity, name)
    if value is None:
        return []
    values = value if isinstance(value, list | tuple) else (value,)
    return [each for each in values if isinstance(each, ifcopenshell.entity_instance)]


def text(entity: Entity, name: str) -> str:
    """An attribute as one line of text, at most 500 characters; empty where there is none."""
    value = attribute(entity, name)
    return clean(value) if isinstance(value, str) else ""


def clean(value: str) -> str:
    """A text of the file on one line, without control characters, at most 500 characters."""
    return " ".join(printable(value[: 4 * _LONGEST]).split())[:_LONGEST]
