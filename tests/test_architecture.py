"""Imports point one way; the table below is the architecture, and a new folder or module must find its place in it."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import cadgraph

PACKAGE = Path(cadgraph.__file__).parent

VALUES = {
    "atomic",
    "catalog",
    "config",
    "corrections",
    "errors",
    "graph",
    "labels",
    "parts",
    "progress",
    "records",
    "scene",
    "vocabulary",
}

# What each module or folder right under cadgraph may import from the others.
MAY_IMPORT = {
    "errors": set(),
    "progress": set(),
    "config": {"expectation"},
    "scene": set(),
    "records": set(),
    "atomic": {"errors"},
    "parts": {"scene"},
    "vocabulary": {"errors"},
    "labels": {"errors", "vocabulary"},
    "catalog": {"atomic", "errors", "scene", "vocabulary"},
    "corrections": {"atomic", "errors", "vocabulary"},
    "consistency": {"errors", "records"},
    "expectation": set(),
    "folder": {"atomic", "errors"},
    "graph": {"atomic", "consistency", "errors", "expectation", "records"},
    "summary": {"graph", "records"},
    "load": {"config", "errors", "scene"},
    "geometry": {"errors", "parts", "progress", "scene"},
    "stages": VALUES | {"geometry"},
    "render": VALUES | {"geometry"},
    "lvlm": VALUES | {"geometry", "render", "stages"},
    "pipeline": VALUES | {"geometry", "stages"},
    "functional": VALUES,
    "diagram": VALUES | {"functional"},
    "export": VALUES | {"diagram", "functional", "render"},
    "report": VALUES | {"diagram", "functional", "render", "summary"},
    # Not among the values: no stage may ever see the truth.
    "truth": {"atomic", "errors", "vocabulary"},
    "environment": VALUES | {"geometry", "truth"},
    "evaluate": VALUES | {"load", "truth"},
    "job": VALUES | {"stages"} | {"environment", "export", "folder", "load", "pipeline", "render", "report", "summary"},
    "intake": VALUES | {"geometry", "load", "relabel", "stages"},
    "amendment": VALUES | {"relabel"},
    "explanation": VALUES,
    "relabel": VALUES | {"job", "stages"},
    "reproduce": VALUES | {"environment", "evaluate", "load", "pipeline", "render", "report", "summary", "truth"},
    "cli": VALUES
    | {"diagram", "functional"}
    | {"amendment", "explanation", "intake", "lvlm", "relabel", "truth"}
    | {"environment", "evaluate", "export", "load", "pipeline", "render", "report", "reproduce", "job", "summary"},
    "training": VALUES | {"environment", "evaluate", "geometry", "load", "pipeline", "stages", "truth"},
    "warm": {"environment", "pipeline", "render"},
    "__main__": {"cli"},
    "__init__": VALUES | {"job", "load", "pipeline"},
}

MAY_USE_USD = {"load", "export", "environment", "evaluate"}
HEAVY = {"PIL", "cascadio", "embreex", "graphlay", "jinja2", "networkx", "numba", "openai", "pxr", "scipy", "trimesh"}
VAGUE = {"manager", "managers", "helper", "helpers", "util", "utils", "common", "misc"}

MODULES = sorted(PACKAGE.rglob("*.py"))


def place_of(path):
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def dotted(path):
    parts = ("cadgraph", *path.relative_to(PACKAGE).with_suffix("").parts)
    return parts[:-1] if parts[-1] == "__init__" else parts


def imports_of(path):
    """Every imported module as a dotted tuple, wherever in the file the import stands."""
    found = set()
    package = dotted(path) if path.name == "__init__.py" else dotted(path)[:-1]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found.update(tuple(alias.name.split(".")) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else ()
            base = (*above, *(node.module or "").split(".")) if node.module else above
            found.update((*base, alias.name) for alias in node.names)
    return found


def ours(path):
    return {steps[1:] for steps in imports_of(path) if steps[0] == "cadgraph" and len(steps) > 1}


def names(paths):
    return [str(path.relative_to(PACKAGE)) for path in paths]


def test_every_module_and_folder_has_its_place():
    present = {place_of(path) for path in MODULES}
    assert present - set(MAY_IMPORT) == set(), "say in MAY_IMPORT what the new ones may import"
    assert set(MAY_IMPORT) - present == set(), "these are gone"


@pytest.mark.parametrize("path", MODULES, ids=names(MODULES))
def test_imports_point_one_way(path):
    here = place_of(path)
    imported = {steps[0] for steps in ours(path)} - {here, "__version__"}
    assert imported - MAY_IMPORT.get(here, set()) == set()


def test_the_table_has_no_circles():
    seen = set()

    def visit(name, above):
        assert name not in above, f"circle: {' -> '.join((*above, name))}"
        if name not in seen:
            for below in MAY_IMPORT[name]:
                visit(below, (*above, name))
            seen.add(name)

    for name in MAY_IMPORT:
        visit(name, ())


STAGES = [path for path in MODULES if place_of(path) == "stages"]


@pytest.mark.parametrize("path", STAGES, ids=names(STAGES))
def test_no_stage_imports_another(path):
    own = path.relative_to(PACKAGE / "stages").parts[0].removesuffix(".py")
    others = {steps[1] for steps in ours(path) if steps[0] == "stages" and len(steps) > 1}
    assert others - {own} == set()


@pytest.mark.parametrize("path", MODULES, ids=names(MODULES))
def test_usd_stays_at_the_borders(path):
    if place_of(path) not in MAY_USE_USD:
        assert "pxr" not in {steps[0] for steps in imports_of(path)}


def test_geometry_stands_on_arrays_alone():
    paths = [path for path in MODULES if place_of(path) == "geometry"]
    outside = {steps[0] for path in paths for steps in imports_of(path)} - set(sys.stdlib_module_names)
    assert outside <= {"cadgraph", "numba", "numpy", "scipy", "embreex"}


PACKAGES = [path for path in MODULES if path.name == "__init__.py"]


@pytest.mark.parametrize("path", PACKAGES, ids=names(PACKAGES))
def test_packages_import_nothing_heavy_at_once(path):
    top = {
        alias.name.split(".")[0] if isinstance(node, ast.Import) else (node.module or "").split(".")[0]
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.Import | ast.ImportFrom)
        for alias in node.names
    }
    assert top & HEAVY == set()


@pytest.mark.parametrize("path", MODULES, ids=names(MODULES))
def test_modules_are_named_by_what_they_are(path):
    words = {word for part in path.relative_to(PACKAGE).with_suffix("").parts for word in part.split("_")}
    assert words & VAGUE == set()


def test_importing_cadgraph_brings_nothing_heavy():
    code = f"import sys, cadgraph; print(*sorted(set({sorted(HEAVY)}) & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_the_public_names_are_sorted_and_all_there():
    assert cadgraph.__all__ == sorted(cadgraph.__all__)
    assert all(getattr(cadgraph, name) is not None for name in cadgraph.__all__)
    with pytest.raises(AttributeError, match="no_such_name"):
        _ = cadgraph.no_such_name
