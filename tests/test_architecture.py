"""Imports point one way; the table below is the architecture, and a new folder or module must find its place in it."""

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import networkx
import pytest
from radon.complexity import cc_visit

import cadgraph
import cadlab
import cadplants

PACKAGES = {package.__name__: Path(package.__file__).parent for package in (cadgraph, cadlab, cadplants)}

# What each room of the product may import from the others; 'draw.render' is the room 'render' within 'draw'.
MAY_IMPORT = {
    "errors": set(),
    "_io": {"errors"},
    "config": {"_io"},
    "model": {"_io", "errors"},
    "facts": {"_io", "errors", "model"},
    "geometry": {"_io", "errors", "model"},
    "load": {"_io", "config", "errors", "geometry", "model"},
    "stages": {"_io", "config", "errors", "facts", "geometry", "model"},
    "draw.render": {"_io", "errors", "geometry", "model"},
    "labelers": {"_io", "config", "draw.render", "errors", "facts", "geometry", "model"},
    "distribute": {"_io", "errors", "geometry", "model"},
    "pipeline": {"_io", "config", "errors", "facts", "geometry", "labelers", "model", "stages"},
    "query": {"_io", "errors", "model"},
    "plans": {"_io", "errors", "model", "query"},
    "hydraulics": {"_io", "errors", "model", "query"},
    "agents": {
        *("_io", "config", "errors", "hydraulics", "labelers", "load", "model", "plans", "query", "serve", "session"),
        *("draw.colors", "draw.render", "stages"),
    },
    "draw.svg": {"_io"},
    "draw.schematic": {"_io", "draw.svg", "errors", "model", "query"},
    "draw.colors": {"draw.render", "model"},
    "draw.report": {
        *("_io", "config", "errors", "model", "query"),
        *("draw.colors", "draw.render", "draw.schematic", "draw.svg"),
    },
    "draw.web": {"_io", "draw.colors", "draw.render", "geometry", "model", "query"},
    "draw.isometric": {"_io", "draw.svg", "errors", "model", "query"},
    "export": {
        *("_io", "config", "errors", "hydraulics", "load", "model", "query"),
        *("draw.isometric", "draw.schematic", "draw.web", "simulate.mjcf"),
    },
    "simulate": set(),
    "simulate.dynamics": {"geometry", "model", "query"},
    "simulate.devices": {"_io", "model", "simulate.dynamics"},
    "simulate.mjcf": {"_io", "draw.render", "model", "simulate.dynamics"},
    "simulate.stage": {
        *("_io", "config", "errors", "export", "load", "model", "query", "simulate.devices", "simulate.dynamics"),
    },
    "simulate.play": {"_io", "errors", "geometry", "hydraulics", "model", "query", *("draw.colors", "draw.render")},
    "simulate.tasks": {"_io", "errors", "geometry", "hydraulics", "model", "query"},
    "session": {
        *(
            "_io",
            "config",
            "distribute",
            "errors",
            "geometry",
            "labelers",
            "load",
            "model",
            "pipeline",
            "query",
            "stages",
        ),
        *("draw.report", "export"),
    },
    "serve": {
        *("_io", "config", "errors", "load", "model", "query", "session", "stages"),
        *("draw.colors", "draw.report", "draw.schematic", "draw.web"),
    },
    "cli": {
        *("_io", "agents", "config", "errors", "facts", "hydraulics", "labelers", "load", "model", "pipeline"),
        *("plans", "query"),
        "serve",
        "session",
        *("draw.render", "draw.report", "draw.schematic", "draw.web", "export"),
        *("simulate.play", "simulate.stage", "simulate.tasks"),
    },
    "gym": {"errors", "hydraulics", "model", "query"},
    "draw": set(),
    "__main__": {"cli"},
    "__init__": {"_io", "config", "errors", "hydraulics", "labelers", "load", "model", "pipeline", "session"},
}
# The same of the generator of plants.
PLANTS_MAY_IMPORT = {
    "solids": set(),
    "styles": set(),
    "model": {"solids", "styles"},
    "builder": {"model", "solids", "styles"},
    "parts": {"model", "solids", "styles"},
    "families": {"builder", "model", "parts", "solids", "styles"},
    "lines": {"builder", "families", "model", "parts", "solids", "styles"},
    "faults": {"model", "parts", "solids", "styles"},
    "presets": {"builder", "families", "faults", "lines", "model", "parts", "solids", "styles"},
    "truth": {"model"},
    "writers": {"model", "solids", "truth"},
    "cli": {"builder", "faults", "model", "presets", "truth", "writers", "__init__"},
    "__main__": {"cli"},
    "__init__": {"faults", "model", "presets", "styles", "writers"},
}
TABLES = {"cadgraph": MAY_IMPORT, "cadplants": PLANTS_MAY_IMPORT}
SPLIT = ("draw", "simulate")  # rooms whose folders are rooms of their own

# No stage and no labeler may ever see the truth.
MAY_SEE_THE_TRUTH = {"cli", "model", "session"}
MAY_USE_USD = {"load", "export", "simulate.play", "simulate.stage"}
HEAVY = {
    "PIL",
    "cascadio",
    "embreex",
    "graphlay",
    "gymnasium",
    "ifcopenshell",
    "jinja2",
    "mcp",
    "networkx",
    "numba",
    "openai",
    "pxr",
    "ray",
    "scipy",
    "starlette",
    "trimesh",
    "uvicorn",
}
MOST_COMPLEX = 20  # cyclomatic complexity of a function ...
MOST_COMPLEX_IN = {
    "packages/cadplants": 15,
    "src/cadgraph/geometry/line": 10,
    "src/cadgraph/stages/relate": 10,
}  # ... in these
LONGEST_IN = {"packages/cadplants": 80}  # lines of a function
VAGUE = {"manager", "managers", "helper", "helpers", "util", "utils", "common", "misc"}


@cache
def modules():
    """Of each module: its package, its place in it, and what it imports, wherever in the file that stands."""
    return [
        (name, path.relative_to(folder), imports_of(name, path, folder))
        for name, folder in PACKAGES.items()
        for path in sorted(folder.rglob("*.py"))
    ]


def imports_of(package, path, folder):
    """Every imported module as a dotted tuple."""
    parts = (package, *path.relative_to(folder).parts[:-1])
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found.update(tuple(alias.name.split(".")) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = parts[: len(parts) - node.level + 1] if node.level else ()
            base = (*above, *(node.module or "").split(".")) if node.module else above
            found.update((*base, alias.name) for alias in node.names)
    return found


def room_of(steps):
    """The room that a dotted name or a path within the product belongs to."""
    steps = [step.removesuffix(".py") for step in steps]
    inner = len(steps) > 1 and steps[0] in SPLIT and steps[1] != "__init__"
    return ".".join(steps[: 2 if inner else 1])


def product():
    return modules_of("cadgraph")


def modules_of(name):
    return [(path, imports) for package, path, imports in modules() if package == name]


@pytest.mark.parametrize("package", TABLES)
def test_every_room_has_its_place(package):
    present, table = {room_of(path.parts) for path, _ in modules_of(package)}, TABLES[package]
    assert present - set(table) == set(), "say in the table what the new ones may import"
    assert set(table) - present == set(), "these are gone"


@pytest.mark.parametrize("package", TABLES)
def test_imports_point_one_way(package):
    table = TABLES[package]
    wrong = [
        f"{path} imports {'.'.join(steps)}"
        for path, imports in modules_of(package)
        for steps in imports
        if steps[0] == package and len(steps) > 1 and steps[1] != "__version__"
        for here, there in [(room_of(path.parts), room_of(steps[1:]))]
        # What is no room is a name that the package itself has.
        if (there if there in table else "__init__") not in table[here] | {here}
    ]
    assert wrong == []


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_the_table_has_no_circles(table):
    seen = set()

    def visit(name, above):
        assert name not in above, f"circle: {' -> '.join((*above, name))}"
        if name not in seen:
            for below in table[name]:
                visit(below, (*above, name))
            seen.add(name)

    for name in table:
        visit(name, ())


def test_no_modules_import_each_other_in_a_circle():
    graph = networkx.DiGraph()
    names = {".".join((package, *place_of(path))) for package, path, _ in modules()}
    for package, path, imports in modules():
        here = ".".join((package, *place_of(path)))
        for steps in imports:
            there = next((name for n in (len(steps), len(steps) - 1) if (name := ".".join(steps[:n])) in names), here)
            # A package as a whole is asked for its version, or where it lies.
            if there not in (here, package):
                graph.add_edge(here, there)
    assert [sorted(circle) for circle in networkx.strongly_connected_components(graph) if len(circle) > 1] == []


def place_of(path):
    """The steps of a module below its package; those of a folder for its ``__init__``."""
    return path.parts[:-1] if path.name == "__init__.py" else path.with_suffix("").parts


@pytest.mark.slow
def test_no_function_is_too_complex():
    assert too_complex("src", MOST_COMPLEX) | too_complex("packages", MOST_COMPLEX) == {}


@pytest.mark.parametrize("folder", MOST_COMPLEX_IN)
def test_functions_of_some_folders_are_simpler(folder):
    assert too_complex(folder, MOST_COMPLEX_IN[folder]) == {}


@pytest.mark.parametrize("folder", LONGEST_IN)
def test_functions_of_some_folders_are_short(folder):
    long = {
        f"{path.name}: {node.name}": node.end_lineno - node.lineno + 1
        for path in (Path(__file__).parents[1] / folder).rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.FunctionDef) and node.end_lineno - node.lineno >= LONGEST_IN[folder]
    }
    assert long == {}


def too_complex(folder, limit):
    """The functions and methods of a folder whose cyclomatic complexity is above a limit."""
    root = Path(__file__).parents[1]
    found = {
        f"{path.relative_to(root)}: {block.fullname}": block.complexity
        for path in sorted((root / folder).rglob("*.py"))
        for block in cc_visit(path.read_text(encoding="utf-8"))
        if block.letter in "FM"
    }
    return {name: n for name, n in found.items() if n > limit}


def test_the_product_knows_nothing_of_the_other_packages():
    allowed = {"cadgraph": {"cadgraph"}, "cadplants": {"cadgraph", "cadplants"}, "cadlab": set(PACKAGES)}
    wrong = [
        f"{package}/{path} imports {'.'.join(steps)}"
        for package, path, imports in modules()
        for steps in imports
        if steps[0] in PACKAGES and steps[0] not in allowed[package]
    ]
    assert wrong == []


def test_no_stage_imports_another():
    wrong = [
        f"{path} imports {'.'.join(steps)}"
        for path, imports in product()
        if path.parts[0] == "stages"
        for steps in imports
        if steps[:2] == ("cadgraph", "stages") and steps[2:3] not in ((), (path.parts[1].removesuffix(".py"),))
    ]
    assert wrong == []


def test_nobody_who_judges_sees_the_truth():
    wrong = [
        str(path)
        for path, imports in product()
        if path.parts[0] not in MAY_SEE_THE_TRUTH
        for steps in imports
        if steps[:3] == ("cadgraph", "model", "truth")
    ]
    assert wrong == []


def test_usd_stays_at_the_borders():
    wrong = [
        str(path)
        for path, imports in product()
        if room_of(path.parts) not in MAY_USE_USD and "pxr" in {steps[0] for steps in imports}
    ]
    assert wrong == []


def test_one_folder_alone_knows_the_library_of_the_server_for_agents():
    knowing = {path.parts[:2] for path, imports in product() if {"mcp", "mcp_types"} & {steps[0] for steps in imports}}
    assert knowing == {("agents", "mcp")}


def test_geometry_stands_on_arrays_alone():
    outside = {steps[0] for path, imports in product() if path.parts[0] == "geometry" for steps in imports}
    assert outside - set(sys.stdlib_module_names) <= {"cadgraph", "numba", "numpy", "scipy", "embreex", "llvmlite"}


def test_packages_import_nothing_heavy_at_once():
    wrong = [
        f"{package}/{path} imports {node_name}"
        for package, path, _ in modules()
        if path.name == "__init__.py"
        for node_name in at_once(PACKAGES[package] / path) & HEAVY
    ]
    assert wrong == []


def at_once(path):
    return {
        alias.name.split(".")[0] if isinstance(node, ast.Import) else (node.module or "").split(".")[0]
        for node in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(node, ast.Import | ast.ImportFrom)
        for alias in node.names
    }


def test_modules_are_named_by_what_they_are():
    words = {
        word: str(path) for _, path, _ in modules() for part in path.with_suffix("").parts for word in part.split("_")
    }
    assert {path for word, path in words.items() if word in VAGUE} == set()


def brought_by(module, among):
    code = f"import sys, {module}; print(*sorted(set({sorted(among)}) & set(sys.modules)))"
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()


def test_importing_cadgraph_brings_nothing_heavy():
    assert brought_by("cadgraph", HEAVY | {"numpy", "pydantic"}) == []


def test_the_command_line_brings_nothing_heavy():
    assert brought_by("cadgraph.cli", HEAVY) == []


def test_the_public_names_are_sorted_and_all_there():
    assert cadgraph.__all__ == sorted(cadgraph.__all__)
    assert all(getattr(cadgraph, name) is not None for name in cadgraph.__all__)
    with pytest.raises(AttributeError, match="no_such_name"):
        _ = cadgraph.no_such_name
