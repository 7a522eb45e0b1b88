"""Labels as a PDMS attribute file, to be read beside the RVM file that the scene came from."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

from cadgraph._io.atomic import write_atomically
from cadgraph._io.text import natural_key, printable
from cadgraph.errors import OutputError
from cadgraph.export.labels import MeshLabel, mesh_labels
from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.graph import SceneGraph

__all__ = ["write_att"]

# The first line names the words that the rest is read by; these are the ones that PDMS itself writes.
_HEAD = "CADC_Attributes_File v1.0 , start: NEW , end: END , name_end: := , sep: &end&"
_TOKENS = (":=", "&end&")
_MARK = b":CADGRAPH-"
_PRIMITIVE = re.compile(r"(?<=.)/primitive_\d+(?:_\d+)?$")
_CONTROL = re.compile("[\x00-\x1f\x7f-\x9f\ud800-\udfff]")  # line breaks among them, and what UTF-8 can't hold
_LONGEST_NAME = 10_000  # characters; ours: readers take lines up to some length
_DEEPEST = 40  # levels that are indented; deeper ones stand below each other, so that a file can't grow with its square


def write_att(
    graph: SceneGraph, path: str | Path, names: Mapping[str, str] | None = None
) -> tuple[Path, tuple[Diagnostic, ...]]:
    """Writes the labels as attributes of the elements that carry them, in the tree of the source paths.

    An element has ``:CADGRAPH-GROUP``, ``:CADGRAPH-NAME``, ``:CADGRAPH-CONFIDENCE``, ``:CADGRAPH-STATE``,
    ``:CADGRAPH-PART``, and ``:CADGRAPH-UNIT`` with the tag of its unit; what is unknown is left out. Primitives that
    hang on an element with others below it are none themselves: such an element gets the label of the largest of them.

    The dialect is that of PDMS: a head line that names the tokens, then ``NEW name`` to ``END`` within each other.

    Args:
        graph: the finished graph.
        path: the file.
        names: what all elements of the RVM file are called in it, by source path, as ``load.rvm.element_names`` tells
            it; None: each by the last step of its path, which has other characters where a name has a blank or slash.

    Returns:
        The file, and notes. Without names, ``names-from-paths``. With them, ``unmatched-mesh`` has the labelled meshes
        that hang on no element, ``repeated-name`` those whose element shares its name with another one, so that
        readers can't tell them apart, and ``changed-name`` those whose element's name can't stand on a line.

    Raises:
        OutputError: it can't be written, or holds attributes that don't come from here, as those that belong to the
            RVM file do.
    """
    target = Path(path)
    _refuse_foreign(target)
    labels, lost = _by_element(graph, names)
    write_atomically(target, "\n".join([_HEAD, *_lines(labels, names or {})]) + "\n")
    if names is None:
        message = "elements go by the steps of their paths, which may differ from their names in the RVM file"
        return target, (Diagnostic("names-from-paths", message),)
    used = Counter(names.values())
    found = {
        ("unmatched-mesh", "labelled meshes that hang on no element of the RVM file"): lost,
        ("repeated-name", "elements that share their name with another one; readers take them for one"): [
            label.mesh for element, label in labels.items() if used[names[element]] > 1
        ],
        ("changed-name", "elements whose name can't stand on a line, so that it won't be found"): [
            label.mesh for element, label in labels.items() if not _stands(names[element])
        ],
    }
    return target, tuple(
        Diagnostic(code, message, tuple(sorted(meshes, key=natural_key)))
        for (code, message), meshes in found.items()
        if meshes
    )


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


def _lines(labels: Mapping[str, MeshLabel], names: Mapping[str, str]) -> Iterator[str]:
    open_steps: list[str] = []
    for element in sorted(labels, key=natural_key):
        steps = [step for step in element.split("/") if step] or ["part"]
        same = 0
        while same < min(len(steps), len(open_steps)) and steps[same] == open_steps[same]:
            same += 1
        yield from (f"{_indent(depth)}END" for depth in range(len(open_steps) - 1, same - 1, -1))
        above = "".join(f"/{step}" for step in steps[:same])
        for depth in range(same, len(steps)):
            above = f"{above}/{steps[depth]}"
            known = names.get(above)
            yield f"{_indent(depth)}NEW {_field(steps[depth]) if known is None else _element_name(known)}"
        yield from _attributes(labels[element], _indent(len(steps)))
        open_steps = steps
    yield from (f"{_indent(depth)}END" for depth in range(len(open_steps) - 1, -1, -1))


def _by_element(graph: SceneGraph, names: Mapping[str, str] | None) -> tuple[dict[str, MeshLabel], list[str]]:
    """The label of each element by its path, and the meshes that hang on none."""
    area = {part.id: part.area for part in graph.parts()}
    found: dict[str, MeshLabel] = {}
    own: set[str] = set()
    lost = []
    for label in mesh_labels(graph):
        element = _PRIMITIVE.sub("", label.mesh) if names is None else _element_of(label.mesh, names)
        if element is None:
            lost.append(label.mesh)
        elif element == label.mesh:
            own.add(element)
            found[element] = label
        elif element not in own and (element not in found or area[label.part] > area[found[element].part]):
            found[element] = label
    return found, lost


def _element_of(mesh: str, names: Mapping[str, str]) -> str | None:
    """The longest of the paths that a mesh's path is or lies below."""
    while mesh:
        if mesh in names:
            return mesh
        mesh = mesh.rpartition("/")[0]
    return None


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


def _element_name(name: str) -> str:
    """The name as it is in the RVM file, whatever its characters mean elsewhere: it ends with its line."""
    if not _stands(name):
        return _field(name[:_LONGEST_NAME])
    # Readers take a pair of quotes around a value away.
    return f'"{name}"' if len(name) > 1 and name[0] == name[-1] and name[0] in "'\"" else name


def _stands(name: str) -> bool:
    """Whether a name can stand on a line so that it is read as the same again."""
    bare = name[1:-1] if len(name) > 1 and name[0] == name[-1] and name[0] in "'\"" else name
    return bool(bare) and bare == bare.strip() and len(name) <= _LONGEST_NAME and not _CONTROL.search(name)


def _field(text: str) -> str:
    """A text on one line, without what the dialect reads as the end of a name or value."""
    clean = printable(text)
    for token in _TOKENS:
        clean = clean.replace(token, " ")
    return " ".join(clean.split()) or "-"


def _indent(depth: int) -> str:
    return "  " * min(depth, _DEEPEST)
