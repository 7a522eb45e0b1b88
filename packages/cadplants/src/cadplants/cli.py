"""Generated plants and truth: environment make, environment check, environment truth-from-usd."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape

from cadgraph.cli.screen import err, out
from cadgraph.errors import FormatError

if TYPE_CHECKING:
    from cadplants.defects import Defects

__all__ = ["plants"]

plants = typer.Typer(no_args_is_help=True, help="Generated test plants with their ground truth.")


@plants.command("make")
def make_plant(
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The scene, e.g. field.usdc.")],
    preset: Annotated[
        str, typer.Option(help="skid, riser, tank, pumps, loop, manifold, station, rack or field.")
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
    unit: Annotated[float | None, typer.Option(help="Metres in one authored unit; 0.001 by default.")] = None,
    up: Annotated[str | None, typer.Option(help="Authored up axis, Y or Z; Z by default.")] = None,
    instances: Annotated[
        str | None, typer.Option(help="Repeated shapes: none, native, nested, point or mixed; none by default.")
    ] = None,
    polygons: Annotated[
        float | None, typer.Option(min=0, max=1, help="Share of meshes with polygons of more than three corners.")
    ] = None,
    hand: Annotated[str | None, typer.Option(hidden=True)] = None,
    spoilt: Annotated[float, typer.Option(min=0, max=1, hidden=True)] = 0.0,
    sins: Annotated[bool, typer.Option("--sins", hidden=True)] = False,
) -> None:
    """Generate a plant as USD with meaningless names, and its ground truth beside it."""
    from cadplants import UsdStyle, draw_defects, draw_style, make, write_usd

    renamed = {"--hand": ("--style", hand), "--spoilt": ("--defective", spoilt), "--sins": ("--defects", sins)}
    for old, (new, given_so) in renamed.items():
        if given_so:
            err.print(f"[dim]{old} is deprecated; use {new}[/]")
    style, defective, defects = style or hand, defective or spoilt, defects or sins
    authoring = draw_style(seed) if defects else UsdStyle()
    given: dict[str, Any] = {"meters_per_unit": unit, "up_axis": up, "instances": instances, "polygons": polygons}
    for name, value, choices in (
        ("--up", up, ("Y", "Z")),
        ("--instances", instances, ("none", "native", "nested", "point", "mixed")),
    ):
        if value is not None and value not in choices:
            raise ValueError(f"{name} {value}: give {', '.join(choices[:-1])} or {choices[-1]}")
    # Written so that NaN fails it too.
    if unit is not None and not 1e-6 <= unit <= 1e3:
        raise ValueError(f"--unit {unit:g}: give the length of one authored unit in metres, from 1e-06 to 1000")
    authoring = replace(authoring, **{key: value for key, value in given.items() if value is not None})
    plant = make(preset, seed, style, draw_defects(seed) if defects else _asked_for(drawn, defective))
    truth = write_usd(plant, output, authoring)
    out.print(f"wrote {escape(str(output))} and {escape(str(truth))}")


def _asked_for(drawn: str | None, defective: float) -> Defects | None:
    """The defects of a name and of a share of all meshes; None where neither is given."""
    from cadplants.defects import DEFECTS, Defects

    if drawn is not None and drawn not in DEFECTS:
        raise ValueError(f"--drawn {drawn}: give one of {', '.join(DEFECTS)}")
    if not defective:
        return DEFECTS[drawn] if drawn else None
    spoilt = ("duplicates", "hidden", "flipped", "soup", "degenerate", "gaps")
    shares: dict[str, Any] = dict.fromkeys(spoilt, defective)
    return replace(DEFECTS[drawn] if drawn else Defects(), **shares)


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
    from cadplants.truth_check import prove

    proof = prove(load(scene), Truth.load(truth or truth_path(scene)))
    out.print(f"checked {', '.join(f'{n:,} {code}' for code, n in proof.n_checked.items())}")
    if not proof.holds:
        for line in proof.lines():
            out.print(escape(line))
        raise FormatError(f"{truth or truth_path(scene)}: the geometry contradicts it in {len(proof.findings)} places")
    out.print("the truth holds")


@plants.command("truth-from-usd")
def truth_of(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A USD file that carries labels.")],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The truth file (JSON).")],
    vocabulary: Annotated[Path | None, typer.Option("--vocabulary", metavar="FILE", help="Another label tree.")] = None,
) -> None:
    """Read the labels of a USD file into a truth file."""
    from cadgraph.model.vocabulary import read_vocabulary
    from cadplants.labelled_usd import truth_from_usd

    truth = truth_from_usd(scene, read_vocabulary(vocabulary) if vocabulary else None)
    truth.save(output)
    out.print(f"wrote {escape(str(output))}: {len(truth.meshes or ()):,} labelled meshes")
