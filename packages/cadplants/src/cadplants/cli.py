"""Generated plants and truth: environment make, device, devices, check, match, truth-from-usd."""

from __future__ import annotations

import importlib
import importlib.util
import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer
from rich.markup import escape
from rich.table import Column, Table

from cadgraph.cli.screen import out
from cadgraph.errors import FormatError

if TYPE_CHECKING:
    from cadgraph.config import LoadConfig
    from cadgraph.model.scene import Scene
    from cadgraph.model.truth import Truth
    from cadplants.builder.device import Device
    from cadplants.faults.defects import Defects
    from cadplants.model.family import Family
    from cadplants.writers.plant_file import FileStyle
    from cadplants.writers.usd_style import UsdStyle

__all__ = ["main", "plants"]

plants = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Generate test plants with their ground truth, and check them.",
)


def main(arguments: Sequence[str] | None = None) -> None:
    """The command ``cadplants``: what ``cadgraph environment`` is, by itself."""
    from cadgraph.cli.application import run

    run(plants, arguments)


_With = Annotated[
    list[str] | None,
    typer.Option(
        "--with", metavar="MODULE", help="With the families of devices in a module or a .py file; as often as needed."
    ),
]


@plants.command("make")
def make_plant(
    output: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="FILE", help="The scene, e.g. field.usdc; its suffix is its format."),
    ],
    preset: Annotated[
        str,
        typer.Option(
            help="One of skid, riser, tank, pumps, loop, manifold, station, rack, gallery, field or assortment."
        ),
    ] = "skid",
    seed: Annotated[int, typer.Option(min=0, help="Of everything that varies.")] = 0,
    style: Annotated[
        str | None, typer.Option(help="In whose style it is modelled; the preset's own by default.")
    ] = None,
    defective: Annotated[
        float,
        typer.Option(min=0, max=1, help="Share of meshes with each modelling defect: twice, hidden, inside out..."),
    ] = 0.0,
    defects: Annotated[
        bool,
        typer.Option(
            "--defects",
            help="Draw all defects by the seed: those of --defective, unit, up axis, instances, frames, polygons.",
        ),
    ] = False,
    drawn: Annotated[
        str | None,
        typer.Option(help="Draw it as others do: gaps, setback, gaskets, insulation, primitives... or all."),
    ] = None,
    unit: Annotated[
        str | None,
        typer.Option(help="Authored unit: mm, cm, m, in... or metres in it; mm by default, of GLB m."),
    ] = None,
    up: Annotated[str | None, typer.Option(help="Authored up axis, Y or Z; Z by default, of GLB and OBJ Y.")] = None,
    instances: Annotated[
        str | None,
        typer.Option(help="Of USD, repeated shapes: none, native, nested, point or mixed; none by default."),
    ] = None,
    polygons: Annotated[
        float | None,
        typer.Option(min=0, max=1, help="Of USD, share of meshes with polygons of more than three corners."),
    ] = None,
    form: Annotated[
        str | None,
        typer.Option(
            "--format", help="One of usd, rvm, ifc, glb, obj, stl or step; by the suffix of --output by default."
        ),
    ] = None,
    layout: Annotated[
        str | None,
        typer.Option(help="Of GLB: nodes (one for each mesh) or merged (one mesh for each colour); nodes by default."),
    ] = None,
    wrong_classes: Annotated[
        float | None, typer.Option(min=0, max=1, help="Of RVM and IFC, share of elements with the class of others.")
    ] = None,
    missing_names: Annotated[
        float | None, typer.Option(min=0, max=1, help="Of RVM and IFC, share of elements without class and name.")
    ] = None,
    own: _With = None,
) -> None:
    """Generate a plant as an authoring system would write it, and its ground truth beside it."""
    from cadplants import draw_defects, make
    from cadplants.writers import format_of, write_plant

    given = {"meters_per_unit": _metres_in(unit), "up_axis": up, "instances": instances, "polygons": polygons}
    told = {"layout": layout, "wrong_classes": wrong_classes, "missing_names": missing_names}
    authoring = _authoring(format_of(output, form).name, given, told, seed if defects else None)
    _refuse_shared_truth(output)
    _register(own)
    plant = make(preset, seed, style, draw_defects(seed) if defects else _asked_for(drawn, defective))
    truth = write_plant(plant, output, authoring, form)
    out.print(f"wrote {escape(str(output))} and {escape(str(truth))}")


def _register(modules: list[str] | None) -> None:
    """Makes the families that somebody's own modules define as all others."""
    if not modules:
        return
    from cadplants.builder.device import Device
    from cadplants.presets.taste import register

    for name in modules:
        module = _imported(name)
        defined = [one for one in vars(module).values() if isinstance(one, type) and one.__module__ == module.__name__]
        devices = [one for one in defined if issubclass(one, Device) and one.name]
        if not devices:
            raise ValueError(f"--with {name}: it defines no class of Device with a name")
        register(*devices)


def _imported(name: str) -> ModuleType:
    """A module by its name, or by its file."""
    try:
        if not name.endswith(".py"):
            return importlib.import_module(name)
        spec = importlib.util.spec_from_file_location(Path(name).stem, name)
        if spec is None or spec.loader is None:
            raise ImportError("no file of Python")
        module = importlib.util.module_from_spec(spec)
        # Annotations are looked up in the module that a class names.
        sys.modules[module.__name__] = module
        spec.loader.exec_module(module)
    except (ImportError, OSError, SyntaxError) as error:
        raise ValueError(f"--with {name}: can't be imported ({error})") from None
    return module


def _authoring(form: str, given: dict[str, Any], told: dict[str, Any], seed: int | None) -> UsdStyle | FileStyle:
    """How a file is written: what is given of it, the rest as usual or, of USD, drawn by a seed."""
    import cadplants

    for name, value, choices in (
        ("--up", given["up_axis"], ("Y", "Z")),
        ("--instances", given["instances"], ("none", "native", "nested", "point", "mixed")),
        ("--layout", told["layout"], ("nodes", "merged")),
    ):
        if value is not None and value not in choices:
            raise ValueError(f"{name} {value}: give {', '.join(choices[:-1])} or {choices[-1]}")
    if form == "usd":
        _refuse(told, form)
        usual = cadplants.UsdStyle() if seed is None else cadplants.draw_style(seed)
        return replace(usual, **{name: value for name, value in given.items() if value is not None})
    _refuse({"instances": given.pop("instances"), "polygons": given.pop("polygons")}, form)
    return _file_style(given, told)


def _metres_in(unit: str | None) -> float | None:
    """The length of a unit, given by name or in metres."""
    from cadgraph.load.units import METRES

    if unit is None or unit in METRES:
        return METRES[unit] if unit else None
    try:
        metres = float(unit)
    except ValueError:
        metres = float("nan")
    # Written so that NaN fails it too.
    if not 1e-6 <= metres <= 1e3:
        raise ValueError(f"--unit {unit}: give {', '.join(METRES)}, or the length of it in metres, from 1e-06 to 1000")
    return metres


def _refuse_shared_truth(output: Path) -> None:
    """Refuses a file whose truth would take the place of that of another file, or of one that was made by hand."""
    from cadplants import truth_path
    from cadplants.writers import FORMATS

    truth = truth_path(output)
    for suffix in (suffix for form in FORMATS for suffix in form.suffixes):
        other = output.with_suffix(suffix)
        if suffix != output.suffix.lower() and truth.exists() and other.exists():
            raise ValueError(f"{truth} is the truth of {other}; give {output.name} another name or folder")
    if truth.exists() and not _was_generated(truth):
        raise ValueError(
            f"{truth} was not generated and would be lost; move it away, or give {output.name} another name or folder"
        )


def _was_generated(truth: Path) -> bool:
    """Whether a truth is that of a generated plant, which can be had again."""
    try:
        said = json.loads(truth.read_bytes())
    except ValueError:
        return False
    return isinstance(said, dict) and {"format", "preset", "seed"} <= said.keys()


def _refuse(settings: dict[str, Any], form: str) -> None:
    """Refuses the settings that a format has nothing to do with."""
    for name, value in settings.items():
        if value is not None:
            raise ValueError(f"--{name.replace('_', '-')} is no setting of {form}; leave it out")


def _file_style(given: dict[str, Any], told: dict[str, Any]) -> FileStyle:
    from cadplants.writers.metadata import Metadata
    from cadplants.writers.plant_file import FileStyle

    metadata = Metadata(told["wrong_classes"] or 0.0, told["missing_names"] or 0.0)
    return FileStyle(**given, layout=told["layout"] or "nodes", metadata=metadata)


def _asked_for(drawn: str | None, defective: float) -> Defects | None:
    """The defects of a name and of a share of all meshes; None where neither is given."""
    from cadplants.faults.defects import DEFECTS, Defects

    if drawn is not None and drawn not in DEFECTS:
        raise ValueError(f"--drawn {drawn}: give one of {', '.join(DEFECTS)}")
    if not defective:
        return DEFECTS[drawn] if drawn else None
    spoilt = ("duplicates", "hidden", "flipped", "soup", "degenerate", "gaps")
    shares: dict[str, Any] = dict.fromkeys(spoilt, defective)
    return replace(DEFECTS[drawn] if drawn else Defects(), **shares)


@plants.command("device")
def make_device_file(
    name: Annotated[str, typer.Argument(metavar="FAMILY", help='Kind and construction, e.g. "ball valve/trunnion".')],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="FILE", help="The scene, e.g. valve.usdc; its suffix is its format."),
    ] = None,
    given: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="NAME=VALUE", help="A parameter, e.g. dn=80, drive.length=1.2; as often as needed."
        ),
    ] = None,
    params: Annotated[
        Path | None,
        typer.Option(
            "--params",
            metavar="FILE",
            help="What it was built from (JSON): the truth of a plant, a row of its devices, or the row's params.",
        ),
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of what is not given.")] = 0,
    style: Annotated[
        str | None, typer.Option(help="In whose style it is modelled; that of --params, else plant-design.")
    ] = None,
    own: _With = None,
) -> None:
    """Generate one device, or without --output say which parameters it has and what they can be."""
    from cadplants.presets.single_device import draw_parameters, family_called, make_device, rebuild
    from cadplants.writers import write_plant

    _register(own)
    told = {}
    for one in given or ():
        key, equals, value = one.partition("=")
        if not equals or not key.strip():
            raise ValueError(f"--set {one}: give a parameter and its value as NAME=VALUE")
        told[key.strip()] = value.strip()
    if params is not None and (told or output is None):
        raise ValueError(f"--params {params}: give --output with it, and no --set")
    if output is None:
        _tell_parameters(family_called(name), draw_parameters(name, seed, told, style or "plant-design"))
        return
    _refuse_shared_truth(output)
    if params is not None:
        record, styles = _record_in(params, family_called(name).name)
        plant = rebuild(record, styles, style)
    else:
        plant = make_device(name, seed, style or "plant-design", given=told)
    truth = write_plant(plant, output)
    out.print(f"wrote {escape(str(output))} and {escape(str(truth))}")


def _record_in(file: Path, name: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """What a file has of a device of a family, as a row of ``devices``, and the styles that it tells of."""
    try:
        said = json.loads(file.read_bytes())
    except (OSError, ValueError) as error:
        raise ValueError(f"{file}: can't be read as JSON ({error})") from None
    if not isinstance(said, dict):
        raise ValueError(f"{file}: give an object of parameters, a row of devices, or a truth")
    family, _, build = name.partition("/")
    if said.get("format") == "cadgraph-truth":
        rows = [row for row in said.get("devices", ()) if (row["family"], row["build"]) == (family, build)]
        if len(rows) != 1:
            raise ValueError(f"{file}: has {len(rows)} devices of {name}; give a file with the row of one of them")
        return rows[0], said.get("styles", {})
    if "params" not in said:
        return {"family": family, "build": build, "params": said}, {}
    if (said.get("family"), said.get("build")) != (family, build):
        raise ValueError(f"{file}: is of {said.get('family')}/{said.get('build')}, not of {name}")
    return said, {}


def _tell_parameters(family: Family, drawn: Device) -> None:
    """A line for each parameter: its value in this draw, what it can be, what it means."""
    sizes = ", ".join(map(str, family.sizes)) if family.place in ("inline", "end", "carrier") else ""
    out.print(escape(f"{family.name}: {family.group}, {family.place}" + (f", DN {sizes}" if sizes else "")))
    table = Table(Column("parameter", no_wrap=True), "here", "can be", "what it is", box=None, pad_edge=False)
    for row in drawn.rows(here=True):
        table.add_row(*map(escape, row))
    out.print(table)


@plants.command("devices")
def list_devices(
    kind: Annotated[str, typer.Argument(metavar="[KIND]", help="Only those of a kind, e.g. valve, pump.")] = "",
    own: _With = None,
) -> None:
    """List the families of devices, with their places and sizes."""
    _register(own)
    from cadplants.presets.taste import ALL_FAMILIES

    some = [family for name, family in sorted(ALL_FAMILIES.items()) if kind.lower() in name]
    if not some:
        raise ValueError(f"{kind!r}: no family has this in its name; without it all are listed")
    for family in some:
        out.print(escape(f"{family.name}  {family.place}  {family.group}"), soft_wrap=True)
    out.print(f"{len(some)} families")


@plants.command("check")
def check_plant(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A scene, e.g. field.usdc.")],
    truth: Annotated[
        Path | None, typer.Argument(metavar="TRUTH", help="Its truth (JSON); beside the scene by default.")
    ] = None,
) -> None:
    """Prove a truth against the exact geometry of its scene."""
    from cadgraph.load import load
    from cadgraph.model.truth import Truth
    from cadplants import truth_path
    from cadplants.truth.truth_check import prove

    file = truth or truth_path(scene)
    known = Truth.load(file)
    read = load(scene, _as_written(scene, known))
    proof = prove(read, known)
    if any(finding.code == "mesh" for finding in proof.findings):
        raise FormatError(f"{file}: {_why_other_paths(scene, read, known)}")
    out.print(f"checked {', '.join(f'{n:,} {code}' for code, n in proof.n_checked.items())}")
    for what in proof.open:
        out.print(f"not checked: {escape(what)}")
    if not proof.holds:
        for line in proof.lines():
            out.print(escape(line))
        count = len(proof.findings)
        raise FormatError(f"{file}: the geometry contradicts it in {count} {'place' if count == 1 else 'places'}")
    if not any(proof.n_checked.values()):
        raise FormatError(f"{file}: it says nothing that the geometry could prove or contradict")
    out.print("what was checked of the truth holds" if proof.open else "the truth holds")


def _why_other_paths(file: Path, scene: Scene, truth: Truth) -> str:
    """Why a scene lacks meshes of a truth, and what to do: names are read in more than one way, or it is another's."""
    from cadplants.writers.matching import match

    absent = {row.mesh for row in truth.meshes} - set(scene.paths)
    said = f"{len(absent)} of its {len(truth.meshes)} meshes are not in {file}"
    if all("bounds" in (row.model_extra or {}) for row in truth.meshes):
        found = match(scene, truth)
        if 2 * (len(found.same) + len(found.split)) > len(truth.meshes):
            command = f"cadgraph environment match {file} -o matched.json"
            return f"{said} by these names, but lie there: run '{command}' first, then check against matched.json"
    return f"{said}: it is the truth of another scene"


@plants.command("match")
def match_truth(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A scene, e.g. field.ifc.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The truth file (JSON) for it.")],
    truth: Annotated[
        Path | None, typer.Argument(metavar="TRUTH", help="What was generated with it; beside the scene by default.")
    ] = None,
) -> None:
    """Put a generated plant's truth in terms of the scene as it is read, by where its meshes lie."""
    from cadgraph.load import load
    from cadgraph.model.truth import Truth
    from cadplants import truth_path
    from cadplants.writers.matching import match, truth_for

    known = Truth.load(truth or truth_path(scene))
    read = load(scene, _as_written(scene, known))
    for line in match(read, known).lines():
        out.print(line)
    now = truth_for(read, known)
    now.save(output)
    out.print(f"wrote {escape(str(output))}: {read.n_meshes:,} meshes")
    if now.contacts is None and known.contacts is not None:
        out.print("left out what touches: it is not known for pieces of meshes")


def _as_written(scene: Path, truth: Truth) -> LoadConfig:
    """How to read a scene whose format has no place for its unit and up axis: as the truth has them."""
    from cadgraph.config import LoadConfig

    suffix, extra = scene.suffix.lower(), truth.model_extra or {}
    # The truth of the same plant in another format tells of that file.
    other = extra.get("file_format", suffix[1:]) != suffix[1:] or "instances" in extra
    if suffix not in (".glb", ".obj", ".stl") or other:
        return LoadConfig()
    units: dict[float | None, Any] = {1.0: "m", 0.1: "dm", 0.01: "cm", 0.001: "mm", 0.0254: "in", 0.3048: "ft"}
    unit, up = units.get(truth.meters_per_unit), cast(Any, truth.up_axis)
    if unit is None and suffix != ".glb":
        raise FormatError(f"{scene} doesn't say its unit; say it in the truth as 'meters_per_unit', 0.001 for mm")
    return LoadConfig(unit=unit, up=up)


@plants.command("truth-from-usd")
def truth_of(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A USD file that carries labels.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The truth file (JSON).")],
    vocabulary: Annotated[Path | None, typer.Option("--vocabulary", metavar="FILE", help="Another label tree.")] = None,
) -> None:
    """Read the labels of a USD file into a truth file."""
    from cadgraph.model.vocabulary import read_vocabulary
    from cadplants.writers.labelled_usd import truth_from_usd

    truth = truth_from_usd(scene, read_vocabulary(vocabulary) if vocabulary else None)
    truth.save(output)
    out.print(f"wrote {escape(str(output))}: {len(truth.meshes or ()):,} labelled meshes")
