"""Whatever else there is to ask of a graph, in SQL."""

from __future__ import annotations

import re
from typing import Annotated

from cadgraph.agents.answer import Answer, AskError, cell, did_you_mean, page_of
from cadgraph.agents.plant import Plant
from cadgraph.agents.sql.guard import Found, Stopped
from cadgraph.agents.sql.schema import PLACED, TABLES, schema_line

__all__ = ["DESCRIPTION", "query"]

_MOST = 400  # characters of a cell
_TEXTS = re.compile(r"'(?:[^']|'')*'|--[^\n]*|/\*.*?\*/", re.DOTALL)
_QUOTED = re.compile(r'(\bas\s+)?"((?:[^"]|"")+)"', re.IGNORECASE)
_UNKNOWN = re.compile(r"no such (table|column|function): (?:\w+\.)?(\w+)")

DESCRIPTION = """Count, list, join by one SQLite SELECT; null: unknown.
Not for ways along pipes: trace, route, isolate, what_if.
unit(tag,type,kind,likely_kind,system,region,level,x,y,z,low,high,reach_height,reach,pipes)
point(name,what,system,x,y,z) units, junctions, ends
pipe(a,b,flow,length,size,line) both ways; flow along|against|unknown
line(tag,first,last,through,length,whole,sizes,flow,system)
part(id,label_group,label_name,confidence,likely,unit,cluster,mesh,x,y,z,dx,dy,dz)
contact(a,b,gap) both ways
cluster(id,kind,parts) system(id,units,ends,length) level(name,kind,height,area)
type: valve|gauge|pump|tank|equipment. Metres, DN; z up, y north."""
"""What a model is told of the tool."""


def query(plant: Plant, sql: Annotated[str, "one SELECT"], page: int = 1) -> Answer:
    """Runs a query over the tables of a graph.

    It can only read the tables, takes at most 3 s, and gives at most 500 rows. What each column means is told by
    :data:`~cadgraph.agents.sql.schema.TABLES`.

    Args:
        plant: that is asked about.
        sql: one SELECT in SQLite's SQL.
        page: counted from 1.

    Returns:
        The rows. Numbers are rounded to a millimetre in the text.

    Raises:
        AskError: it is no such query, which is told with the tables that there are, or took too much time or memory.
    """
    if not isinstance(sql, str):
        raise AskError("sql: give one SELECT as a text")
    try:
        found = plant.tables.ask(sql)
    except Stopped:
        raise
    except AskError as error:
        raise AskError(f"{error}{_meant(str(error))}; the tables are {schema_line()}") from None
    head = ["\t".join(found.columns)]
    rows = ["\t".join(_shown(value) for value in row) for row in found.rows]
    notes = [*_taken_for_texts(sql), *_notes(plant, found)]
    values = {
        "columns": list(found.columns),
        "rows": [list(row) for row in found.rows],
        "complete": found.complete,
        "notes": notes,
    }
    return Answer(page_of(head, rows or ["no rows"], notes, page), values)


def _shown(value: str | float | None) -> str:
    if value is None:
        return "null"
    if isinstance(value, float):
        whole = f"{value:.3f}".rstrip("0").rstrip(".")
        return whole if 1e-3 <= abs(value) < 1e9 else f"{value:.3g}"
    return cell(value, _MOST)


def _meant(error: str) -> str:
    """The nearest name where SQLite knows none such."""
    unknown = _UNKNOWN.search(error)
    if unknown is None or unknown[1] == "function":
        return ""
    columns = dict.fromkeys(column for table in TABLES.values() for column in table.columns)
    return f"; {did_you_mean(unknown[2], TABLES if unknown[1] == 'table' else columns)}"


def _taken_for_texts(sql: str) -> list[str]:
    """What stands in double quotes and names nothing, which SQLite takes for a text instead of refusing it."""
    quoted = [(bool(found[1]), found[2]) for found in _QUOTED.finditer(_TEXTS.sub("''", sql))]
    known = {*TABLES, *(column for table in TABLES.values() for column in table.columns)}
    known |= {name for given, name in quoted if given}
    unknown = dict.fromkeys(name for _, name in quoted if name.casefold() not in known and name not in known)
    return [
        f'"{cell(name, 60)}" names no column here: SQLite took it for a text, which belongs in single quotes'
        for name in unknown
    ]


def _notes(plant: Plant, found: Found) -> list[str]:
    notes = []
    if not found.complete:
        notes.append(f"NOT ALL: only the first {len(found.rows)} rows are here; count, filter, or use LIMIT and OFFSET")
    if not plant.has_places and found.read & PLACED:
        notes.append("levels and reach are UNKNOWN here: this graph was built without places; build it again")
    return notes
