"""docs/labeler.md: what the embedded labeler is, and how good."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cadgraph.labelers.embedded.model import Model
from cadlab.markdown import table
from cadlab.training.course import NEW_PRECISION, PRECISION, Trials
from cadlab.training.example import Example
from cadlab.training.figure import Answers, Scores, answer, score
from cadlab.training.real import RealPart

__all__ = ["write_page"]

_SCALE = 1.3
_CONFUSIONS = 15
_WORDS = ("No", "One", "Two", "Three", "Four")

_TEXT = """# The embedded labeler

It names parts by their geometry and by what they touch: offline, without a GPU, without looking at names or colours.
A network of about {weights:,} weights, trained on generated plants, ships with the package ({size:.1f} MB of plain
arrays, nothing that could run); numpy alone runs it.

1. **Each distinct shape once**: {forms} numbers that do not change with pose or size (profiles along the main axis,
   shares of normals, symmetry about the axis, round end faces, angles of edges, wall thickness by rays, holes) and
   {sizes} absolute sizes. They are taken from points spread evenly over the surface, so triangles matter little.
2. **Each part among its neighbours**: {sides} numbers for each contact (coaxial or not, end or side, what lies within
   what, relative sizes, the same shape or not) and {places} on its place (eight alike on one flange).
3. **{rounds} rounds of talk** between neighbours in the contact graph: a thin ring between flanges becomes a gasket.
4. **Repeats** of a shape agree among themselves, as far as they agree already.
5. **Confidence** is calibrated; below {threshold:.2f} a part stays unlabelled, with its best guesses listed. Where only
   the name is in doubt, the group is given. `cadgraph explain FOLDER PART` says why.

The generated plants are drawn from {families} families of devices in randomly drawn modelling styles. Things that
belong to no plant, in {distractors} scenes by themselves and among the parts of every sixth plant, teach it what it
doesn't know.

## How good it is

`make train` makes the model and this page. *Name* and *group*: share of the parts named right, whatever the confidence.
*Macro F1*: mean over names, so that rare ones count as much as pipes. *ECE*: calibration error. *Kept*, *precision*:
with the threshold: the least one above which {precision:.0%} of the names are right on whole plants of which one family
in {folds} is new, and {new_precision:.0%} on the parts of the new families alone.

{main}

*New seeds* are of the same styles and families as the training plants and say little. *One family in {folds} new*:
networks trained without some families (`ball valve/compact`: one build of a device with all its pieces; each family is
left out once), asked about whole plants with these in them; then about the parts of these alone. *Held-out kinds*:
likewise without half of all kinds: no ball valve at all, no strainer; about their parts alone. {unlearnable}
The trial networks have not seen the {bolted} plants whose flanges hold their bolts in one mesh; half of those in the
package have. *New styles*: the six published modelling styles, of which nothing was seen in training, building layouts
that were not seen either.

{strange}

By style:

{styles}

Defects of modelling, each on plants in the new styles (every mesh has it, but for duplicates and hidden bodies, which
are 30 % more):

{defects}

What the figures rest on (new styles):

{ablations}

{real}
For comparison, the paper's gpt-4o, on the paper's own plant: 38.5 / 30.5 / 42.0 % of the names and 79.9 / 73.2 / 84.0 %
of the groups of its structures S1 / S2 / S3. `cadgraph reproduce` puts ours beside it on a generated plant.

By group (new styles):

{groups}

Where it errs most (new styles): {confusions}; on the held-out families alone: {family_confusions}.

By name: parts, share found and share right of what is called so, in the new styles and in the held-out families alone:

{names}

## Speed

`python packages/cadlab/benchmarks/label.py --field`,
processor seconds with everything warm, features included: the skid (197 parts,
51 shapes) 0.5 s; sixteen skids side by side (3,152 parts, the same 51 shapes) 1.4 s; the `field` plant (8,243 meshes,
2,203 parts, 382 shapes) 3.9 s. Distinct shapes count more than parts.

## Limits

- Plants are generated. Of a device family that nobody generated some parts are named wrongly, and a few of these with
  confidence: see *the held-out families alone*.
- Nothing is known of up and down, so that a scene may lie on its side: beams, columns, posts and braces that stand in
  unusual company are taken for each other, and so are U-shaped pipes and railings.
- Absolute size is evidence: a scene whose unit is declared wrongly is labelled worse. See *wrong scale* above.
- Parts with few neighbours (a device drawn alone) are named less surely than in a plant.
- It knows the names of the built-in vocabulary only. Other names come from a catalogue, corrections or an LVLM.

## Model card

{card}
"""


def write_page(trials: Trials, real: Sequence[RealPart], size: int, families: int) -> str:
    """The whole page.

    Args:
        trials: what a training run left.
        real: real parts, or none.
        size: of the model's file in bytes.
        families: how many the generator draws from.
    """
    from cadgraph.labelers.embedded.descriptor import FORMS, SIZES
    from cadgraph.labelers.embedded.surroundings import PLACE_FEATURES, SIDE_FEATURES

    model, least = trials.model, trials.model.threshold
    told = {name: answer(model, plants) for name, plants in trials.plants.items()}
    styles = told["new styles"]
    main = [
        ("new seeds", told["new seeds"]),
        (f"one family in {model.card['folds']} new", trials.mixed),
        ("the held-out families alone", trials.families),
        ("held-out kinds", trials.kinds),
        ("new styles", styles),
    ]
    open_share = float((trials.unlearnable.confidence < least).mean()) if len(trials.unlearnable.truth) else 1.0
    return _TEXT.format(
        weights=sum(int(values.size) for values in model.members[0].weights.values()) * len(model.members),
        size=size / 1e6, forms=len(FORMS), sizes=len(SIZES), sides=len(SIDE_FEATURES), places=len(PLACE_FEATURES),
        threshold=least, precision=PRECISION, new_precision=NEW_PRECISION,
        families=families, distractors=model.card["strangers"], bolted=model.card["bolted"],
        folds=model.card["folds"], main=_table((name, score(a, least)) for name, a in main),
        unlearnable=f"Of {len(trials.unlearnable.truth):,} parts in these trials whose name nothing else has, "
        f"so that no answer can be right, {open_share:.0%} are left unlabelled.",
        styles=_table(
            (style, score(styles.where(styles.style == style), least)) for style in sorted(set(styles.style.tolist()))
        ),
        defects=_table(
            (name, score(a, least)) for name, a in told.items() if name.startswith("sin") or "sides" in name
        ),
        ablations=_table(_ablations(model, trials.plants["new styles"])),
        real=_real(model, real), groups=_groups(styles, least), confusions=_confusions(styles),
        family_confusions=_confusions(trials.families), names=_names(styles, trials.families),
        strange=_strange(told, least), rounds=_WORDS[model.members[0].rounds],
        card="\n".join(f"- {key}: {value}" for key, value in model.card.items())
        + f"\n- temperature: {model.temperature:.3f}; threshold: {least:.3f}",
    )  # fmt: skip


def _table(rows: Iterable[tuple[str, Scores]]) -> str:
    lines = []
    for name, s in rows:
        shares = f"{s.group:.1%}", f"{s.name:.1%}", f"{s.macro:.2f}", f"{s.ece:.3f}", f"{s.kept:.1%}"
        lines.append((name, f"{s.parts:,}", *shares, f"{s.precision:.1%}"))
    return "\n".join(table(("", "parts", "group", "name", "macro F1", "ECE", "kept", "precision"), lines))


def _ablations(model: Model, plants: Sequence[Example]) -> list[tuple[str, Scores]]:
    """The same plants with something left out."""
    mean = model.members[0].weights["mean"]
    n_forms, n_sizes = plants[0].forms.shape[1], plants[0].sizes.shape[1]
    usual_sizes = mean[n_forms : n_forms + n_sizes]

    def alone(e: Example) -> Example:
        nobody = np.zeros(0, np.int64)
        places = np.zeros_like(e.places)
        places[:, 4] = e.places[:, 4]
        return replace(e, here=nobody, there=nobody, sides=e.sides[:0], places=places)

    def sizeless(e: Example) -> Example:
        return replace(e, sizes=np.tile(usual_sizes.astype(e.sizes.dtype), (len(e.sizes), 1)))

    changes: tuple[tuple[str, bool, Callable[[Example], Example]], ...] = (
        ("as it is", True, lambda e: e),
        ("repeats by themselves", False, lambda e: e),
        ("every part by itself, no neighbours", True, alone),
        ("no absolute sizes", True, sizeless),
        (f"wrong scale: {_SCALE} x", True, lambda e: replace(e, sizes=e.sizes + np.float32(np.log(_SCALE)))),
    )
    return [(name, score(answer(model, plants, repeats, change), model.threshold)) for name, repeats, change in changes]


def _groups(a: Answers, least: float) -> str:
    groups = sorted(set(a.true_group.tolist()))
    lines = []
    for row in groups:
        mine = a.where(a.true_group == row)
        counts = Counter(mine.group.tolist())
        lines.append([f"**{row}**", *(f"{counts[g]:,}" if counts[g] else "" for g in groups)])
    return "\n".join(table(["is \\ said", *groups], lines))


def _confusions(a: Answers) -> str:
    wrong = a.name != a.truth
    pairs = Counter(zip(a.truth[wrong].tolist(), a.name[wrong].tolist(), strict=True))
    ranked = sorted(pairs.items(), key=lambda item: (-item[1], item[0]))[:_CONFUSIONS]
    return "; ".join(f"{true.split('/')[1]} for {said.split('/')[1]} ({n})" for (true, said), n in ranked)


def _names(*trials: Answers) -> str:
    """Recall and precision of each name in some trials."""
    lines = []
    for name in sorted({name for a in trials for name in a.truth.tolist()}):
        cells = [name.replace("/", ": ")]
        for a in trials:
            true, said = a.truth == name, a.name == name
            both = int((true & said).sum())
            cells += [
                f"{true.sum():,}" if true.any() else "",
                f"{both / true.sum():.0%}" if true.any() else "",
                f"{both / said.sum():.0%}" if said.any() and true.any() else "",
            ]
        lines.append(cells)
    return "\n".join(table(["name", *("parts", "found", "right") * len(trials)], lines))


def _strange(told: Mapping[str, Answers], least: float) -> str:
    """How much of what belongs to no plant is left open."""
    shares = {
        name: float((np.maximum(told[name].confidence, told[name].group_confidence) < least).mean())
        for name in ("strangers", "unseen strangers")
    }
    return (
        f"*Strangers*: of things that belong to no plant (furniture, toys, gears, blobs), {shares['strangers']:.0%} "
        "are left open where the network has learnt from others of their kind, and "
        f"{shares['unseen strangers']:.0%} where it has not (teapots and jugs, but for a few twisted ones, boats and "
        "aeroplanes, linkages)."
    )


def _real(model: Model, parts: Sequence[RealPart]) -> str:
    if not parts:
        return ""
    kinds: dict[str, list[tuple[bool, bool, bool]]] = {}
    strange = []
    for part in parts:
        told = answer(model, [part.example])
        sure = max(float(told.confidence[part.index]), float(told.group_confidence[part.index])) >= model.threshold
        if not part.group:
            strange.append(not sure)
            continue
        group_right = bool(told.group[part.index] == part.group)
        said = str(told.name[part.index]).split("/")[1]
        name_right = group_right and (not part.names or said in part.names)
        kinds.setdefault(f"{part.group}: {', '.join(part.names) or 'any'}", []).append((group_right, name_right, sure))
    shares = {kind: np.array(rows, np.float64).mean(axis=0) for kind, rows in kinds.items()}
    lines = [
        "Real parts by other hands (STEP files from public libraries, each alone in its file; never learnt from):",
        "",
        *table(
            ("kind", "parts", "group right", "name right", "above the threshold"),
            ([kind, len(rows), *(f"{share:.0%}" for share in shares[kind])] for kind, rows in kinds.items()),
        ),
    ]
    if strange:
        lines += ["", f"Of {len(strange)} real parts of ball bearings and pulleys, for which there is no name, "
                      f"{sum(strange)} are left open."]  # fmt: skip
    return "\n".join(lines) + "\n"
