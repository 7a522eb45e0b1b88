"""Labels as a PDMS attribute file, to be read beside the RVM file that the scene came from."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import natural_key, printable
from cadgraph.errors import OutputError
from cadgraph.export.labels import MeshLabel, mesh_labels
from cadgraph.model.graph import SceneGraph

__all__ = ["write_att"]

# The first line names the words that the rest is read by; these are the ones that PDMS itself writes.
_HEAD = "CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&"
_TOKENS = (":=", "&end&")
_MARK = b":CADGRAPH-"
_PRIMITIVE = re.compile(r"(?<=.)/primitive_\d+(?:_\d+)?$")
_DEEPEST = 40  # levels that are indented; deeper ones stand below each other, so that a file can't grow with its square


def write_att(graph: SceneGraph, path: str | Path, names: Mapping[str, str] | None = None) -> Path:
    """Writes the labels as attributes of the nodes that carry them, in the tree of the source paths.

    A node has ``:CADGRAPH-GROUP``, ``:CADGRAPH-NAME``, ``:CADGRAPH-CONFIDENCE``, ``:CADGRAPH-STATE``,
    ``:CADGRAPH-PART``, and ``:CADGRAPH-UNIT`` with the tag of its unit; what is unknown is left out. Primitives that
    hang on a node with others below it are no elements: such a node gets the label of the largest of them.

    The dialect is that of PDMS: a head line that names the tokens, then ``NEW name`` to ``END`` within each other.

    Args:
        graph: the finished graph.
        path: the file.
        names: what elements are called in the RVM file, by source path; others by the last step of their path.

    Returns:
        The file.

    Raises:
        OutputError: it can't be written, or holds attributes that don't come from here, as those that belong to the
            RVM file do.
    """
    target = Path(path)
    _refuse_foreign(target)
    write_atomically(target, "\n".join([_HEAD, *_lines(graph, names or {})]) + "\n")
    return target


def _refuse_foreign(target: Path) -> None:
    try:
        if target.is_file() and target.stat().st_size:
            with target.open("rb") as file:
                # An empty export has the head line alone.
                head = file.read(1 << 20)
                if _MARK not in head and head.strip() != _HEAD.encode():
                    raise OutputError(f"{target}: not written by cadgraph, so it is left alone; choose another name")
    except OSError as error:
        raise OutputError(f"{target}: can't be read ({error.strerror}); choose another output folder") from error


def _lines(graph: SceneGraph, names: Mapping[str, str]) -> Iterator[str]:
    labels = _by_element(graph)
    open_steps: list[str] = []
    for element in sorted(labels, key=natural_key):
        steps = [step for step in element.split("/") if step] or ["part"]
        same = 0
        while same < min(len(steps), len(open_steps)) and steps[same] == open_steps[same]:
            same += 1
        yield from (f"{_indent(depth)}END" for depth in range(len(open_steps) - 1, same - 1, -1))
        for depth in range(same, len(steps)):
            name = names.get("/" + "/".join(steps[: depth + 1]), steps[depth])
            yield f"{_indent(depth)}NEW {_field(name)}"
        yield from _attributes(labels[element], _indent(len(steps)))
        open_steps = steps
    yield from (f"{_indent(depth)}END" for depth in range(len(open_steps) - 1, -1, -1))


def _by_element(graph: SceneGraph) -> dict[str, MeshLabel]:
    """The label of each element by its path."""
    area = {part.id: part.area for part in graph.parts()}
    found: dict[str, MeshLabel] = {}
    own: set[str] = set()
    for label in mesh_labels(graph):
        element = _PRIMITIVE.sub("", label.mesh)
        if element == label.mesh:
            own.add(element)
            found[element] = label
        elif element not in own and (element not in found or area[label.part] > area[found[element].part]):
            found[element] = label
    return found


def _attributes(label: MeshLabel, indent: str) -> Iterator[str]:
    values = {
        "GROUP": label.group,
        "NAME": label.name,
        "CONFIDENCE": f"{label.confidence:.3f}",
        "STATE": label.state,
        "PART": label.part,
        "UNIT": label.tag,
    }
    yield from (f"{indent}:CADGRAPH-{key}:= {_field(value)}" for key, value in values.items() if value is not None)


def _field(text: str) -> str:
    """A text on one line, without what the dialect reads as the end of a name or value."""
    clean = printable(text)
    for token in _TOKENS:
        clean = clean.replace(token, " ")
    return " ".join(clean.split()) or "-"


def _indent(depth: int) -> str:
    return "  " * min(depth, _DEEPEST)
