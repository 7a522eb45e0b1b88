"""docs/labeler.md: what the embedded labeler is, and how good."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from cadgraph.labelers.embedded.model import Model
from cadgraph.model.vocabulary import FASTENERS
from cadlab.markdown import table
from cadlab.training.course import ALONE, PRECISION, SURE, Trials
from cadlab.training.figure import Answers, Scores, answer, error_of_families, score
from cadlab.training.real import RealPart
from cadlab.training.samples import LEFT_OUT

__all__ = ["write_page"]

_CONFUSIONS = 20
_HELD_OUT = ("held-out systems", "held-out makers", "held-out modellers")
_WORDS = ("No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine", "Ten")
_SEEN_ALIKE: Mapping[str, tuple[str, ...]] = {
    "railing, fence, gate, ladder, stair": ("railing", "fence", "gate", "ladder", "stair tread"),
    "flange, bonnet, blind flange, base plate": ("flange", "valve bonnet", "blind flange", "base plate"),
    "gland, nut": ("gland", "nut"),
    "stem, stud": ("valve stem", "gauge stem", "stud"),
    "siphon, pipe, gauge stem": ("siphon", "pipe", "gauge stem"),
    "pump casing, valve body": ("pump casing", "valve body"),
    "bracket, plate, clamp": ("bracket", "plate", "clamp"),
    "nozzle, flange": ("nozzle", "flange"),
    "manway": ("manway",),
    "cable tray, conduit, cable": ("cable tray", "conduit", "cable"),
    "column, beam, brace, post": ("column", "beam", "brace", "post"),
}
"""Names that people see confused."""

_TEXT = """# The embedded labeler

It names parts by their geometry and by what they touch: offline, without a GPU, without looking at names or colours.
{members} networks of about {weights:,} weights together, trained on generated plants{and_parts}, ship with the
package ({size:.1f} MB of plain arrays, nothing that could run); numpy alone runs them.

1. **Each distinct shape once**: {forms} numbers that do not change with pose or size (profiles along the main axis,
   shares of normals, symmetry about the axis, round end faces, by how much the surface turns at its edges, wall
   thickness) and {sizes} absolute sizes. They are integrals over the surface, taken where a regular grid of lines in
   the shape's own box pierces it: the same for the same shape, whatever its triangles.
2. **Each part among its neighbours**: {sides} numbers for each contact (coaxial or not, end or side, what lies within
   what, relative sizes, above or below) and {places} on its place: eight alike on one flange, how it stands, and what
   the whole scene is like (are there fasteners, are its joints open, are its pipes hollow).
3. **{rounds} rounds of talk** between neighbours in the contact graph: a thin ring between flanges becomes a gasket.
4. **Repeats** of a shape agree among themselves, as far as they agree already.
5. **Confidence** is calibrated on whole plants of held-out systems, a quarter of whose families is new, too; the
   networks' logarithms of probabilities are averaged, so that what was found for one holds for all. A part whose name
   or group is likelier than {threshold:.2f} gets a label, one that touches nothing from {alone:.2f} on: most things
   that stand by themselves belong to no plant. A label below {sure:.2f} is marked as *likely* in the graph and the
   report, not sure. Others stay open. The five likeliest names of every part stand in the graph, with their
   probabilities, and the functional relations use all of them whatever the thresholds. `cadgraph explain FOLDER PART`
   says why.

The generated plants are drawn from {families} families of devices in the manners of {n_systems} authoring systems
({systems}), each with its own
granularity, level of detail, gaps, tessellation and omissions, drawn anew for each plant. The networks take turns at
{draws} draws of plants; all draws but the first are without {left_out}: networks that learnt from other plants
err in other places, so that their mean is better than that of as many from one draw. Things that belong to no plant,
in {others} scenes by themselves and among the parts of every sixth plant, teach the networks what they don't know.

## How good it is

`make train` makes the model and this page. *Group* and *name*: share of the parts put right, whatever the confidence.
*Macro F1*: mean over names, so that rare ones count as much as pipes. *ECE*: calibration error of the names.
*Labelled*: share that gets a label; *right of these*: share of them in the right group.

### Real plants

Drawn by others; nothing was learnt from them. But some families of the generator were drawn after mistakes on these
plants had been looked at (pumps, drums, cable ways and handrails in pieces): of plants that nobody here has seen, what
was held out below says more. Parts whose names the truth knows, fasteners left out; before the functional relations
give labels back.

{real}

{sheet}

### What was held out

{held_out}

*Held-out systems*: each of {folds} networks has never seen a quarter of the authoring systems, nor a quarter of the
families of devices, nor a quarter of the makers of real parts, nor a quarter of the modellers of plants; the answers
are about whole plants of these systems, then about the parts of these families in them, then about single real parts
of these makers, each alone in its file, then about the plants of these modellers, fasteners left out.
The thresholds come from here: a label is given from where {precision:.0%} of the groups of held-out families are right;
to parts that touch nothing from where {alone_precision:.0%} are of held-out makers' single parts, and nine of ten
strangers among them stay open; it is sure from where {sure_precision:.0%} are right of these families and makers
together, strangers counted as wrong. Families are right or wrong as a whole: had others been held out, or as many been
drawn again, the figures about them would be others by some {families_group:.1f} points (groups) and
{families_name:.1f} (names; standard errors).

By held-out system:

{by_system}

Published styles, of which nothing was seen in training, in layouts that were not seen either, and the same plants with
defects of modelling and what others leave out (these are the networks of the model, that have seen other plants of the
systems):

{styles}

Plants of other modellers, each in the manner of another program, modellers held out (in the folds alone: the networks
of the model have learnt from these):

{by_modeller}

Single real parts, makers held out:

{by_maker}

{strange}

### Names that people see confused

Share of the parts of these names that get the right one, in held-out systems and among the held-out families in them:

{alike}

Most frequent errors in held-out systems: {confusions}.

### What each idea was worth

The first fold's held-out systems, makers and modellers, with and without:

{ablations}

{not_kept}

### By name

Parts, share found and share right of what is called so, in the held-out systems:

{names}

## Speed

`python packages/cadlab/benchmarks/label.py --field` measures it beside the alternatives. Distinct shapes count more
than parts.

## Limits

- Plants are generated. Of shapes that nobody generated some parts are named wrongly, and a few of these with
  confidence: of the wrong groups on real plants {sure_wrong:.0%} are above 0.9.
- What is up matters: a scene that lies on its side is labelled a little worse.
- Absolute size is evidence: a scene whose unit is declared wrongly is labelled worse.
- Parts with few neighbours (a device drawn alone) are named less surely than in a plant.
- It knows the names of the built-in vocabulary only. Other names come from a catalogue, corrections or an LVLM.

## Model card

{card}
"""

_NOT_KEPT = """Not kept, since they change where only triangles do: numbers of pieces, holes and free edges (real
plants are full of faces that meet along a line without common corners), lengths of edges by angle, points sampled per
triangle, and the number of corners around a circle, which is somebody's setting.

With the model before this one, on the first fold: without what is up 0.5 points fewer groups and 1.1 fewer names of the
held-out systems were right, without what is known of the scene as a whole none, but 3 fewer of 90 names of held-out
makers.

Tried on the folds, with plants of an earlier generator, and left out (group / name; *new*: parts of held-out families,
*makers*: single real parts):

| tried | systems | new | makers |
|:---|:---|:---|:---|
| as it was, four folds | 96.0 / 92.3 | 86.5 / 69.6 | 71.6 / 55.0 |
| parts of like looks in one plant agree (kinship above 0.9, a third of the weight) | 96.0 / 92.2 | 86.2 / 69.5 | |
| the same, two thirds of the weight | 95.7 / 91.9 | 85.9 / 69.1 | |
| mean of the answers with and without absolute sizes | 95.9 / 92.3 | 86.0 / 69.3 | 72.0 / 55.0 |
| *two folds:* as it was | 96.7 / 91.9 | 89.4 / 70.2 | 73.0 / 58.1 |
| blocks of features left out at random (12 %) | 96.4 / 91.6 | 90.2 / 71.8 | 72.8 / 57.4 |
| half as much dropout again | 96.0 / 90.4 | 86.8 / 69.4 | 73.6 / 58.1 |
| first layer twice as wide, second by a third | 96.8 / 92.7 | 88.2 / 70.2 | 76.5 / 60.9 |

Wider layers help single parts alone and cost twice the time; they were not taken, since plants gain nothing. Not tried:
larger networks over point samples."""


def write_page(trials: Trials, parts: Sequence[RealPart], size: int, families: int, sheet: str) -> str:
    """The whole page.

    Args:
        trials: what a training run left.
        parts: single real parts, or none.
        size: of the model's file in bytes.
        families: how many the generator draws from.
        sheet: file name of the pictures of mistakes beside the page; empty if there are none.
    """
    from cadgraph.labelers.embedded.descriptor import FORMS, SIZES
    from cadgraph.labelers.embedded.surroundings import PLACE_FEATURES, SIDE_FEATURES

    model, least, alone = trials.model, trials.model.threshold, trials.model.alone
    told = {name: answer(model, plants) for name, plants in trials.plants.items()}
    real = {name: _without_fasteners(a) for name, a in trials.real.items()}
    of_group, of_name = error_of_families(trials.families)
    systems = sorted(set(trials.systems.style.tolist()))
    return _TEXT.format(
        members=_WORDS[len(model.members)], weights=sum(int(v.size) for m in model.members for v in m.weights.values()),
        and_parts=_and_parts(model, parts),
        size=size / 1e6, forms=len(FORMS), sizes=len(SIZES), sides=len(SIDE_FEATURES), places=len(PLACE_FEATURES),
        threshold=least, alone=alone, sure=model.sure, alone_precision=ALONE, precision=PRECISION,
        sure_precision=SURE, families=families,
        draws=model.card["draws"], left_out=", ".join(sorted(LEFT_OUT)),
        others=model.card["scenes of others"], n_systems=len(model.card["systems"]),
        systems=", ".join(model.card["systems"]), folds=model.card["folds"],
        rounds=_WORDS[model.members[0].rounds],
        real=_table((name, score(a, least)) for name, a in real.items()),
        sheet=_sheet(sheet),
        held_out=_table(
            (name, score(a, limit))
            for name, limit, a in (
                ("held-out systems, all parts", least, trials.systems),
                ("held-out systems, fasteners left out", least, _without_fasteners(trials.systems)),
                ("held-out systems and families", least, trials.families),
                ("single real parts of held-out makers", alone, trials.makers),
                ("plants of held-out modellers", least, _without_fasteners(trials.modellers)),
            )
        ),
        families_group=100 * of_group, families_name=100 * of_name,
        by_system=_table((s, score(_without_fasteners(trials.systems.where(trials.systems.style == s)), least))
                         for s in systems),
        styles=_table(
            (name, score(a, least))
            for name, a in told.items()
            if not name.startswith("system") and "stranger" not in name
        ),
        by_modeller=_by_maker(_without_fasteners(trials.modellers), least),
        by_maker=_by_maker(trials.makers, alone),
        strange=_strange(told, trials.makers, alone),
        alike=_alike(trials.systems, trials.families),
        confusions=_confusions(trials.systems),
        ablations=_table(
            (f"{name}, {what}", score(a, limit))
            for name, answers in trials.ablations.items()
            for what, limit, a in zip(_HELD_OUT, (least, alone, least), answers, strict=True)
        ),
        not_kept=_NOT_KEPT, names=_names(trials.systems), sure_wrong=_sure_though_wrong(real.values()),
        card="\n".join(f"- {key}: {value}" for key, value in model.card.items())
        + f"\n- temperature: {model.temperature:.3f}; threshold: {least:.3f}; alone: {alone:.3f}; "
        f"sure: {model.sure:.3f}",
    )  # fmt: skip


def _and_parts(model: Model, parts: Sequence[RealPart]) -> str:
    """What is learnt from beside generated plants."""
    plants, files = model.card["learnt plants of others"], model.card["learnt real parts"]
    text = f", {plants} plants by {model.card['their modellers']} other modellers" if plants else ""
    return text + (f" and {files} files of real parts" if parts else "")


def _sheet(name: str) -> str:
    return f"The mistakes that it is surest of:\n\n![mistakes on real plants]({name})" if name else ""


def _by_maker(makers: Answers, least: float) -> str:
    names = sorted(set(makers.style[~makers.strange].tolist()))
    return _table((name, score(makers.where(makers.style == name), least)) for name in names)


def _sure_though_wrong(answers: Iterable[Answers]) -> float:
    """The share of the wrong groups that are said with more than 0.9."""
    wrong = [confidence for a in answers for confidence in a.group_confidence[a.group != a.true_group].tolist()]
    return float(np.mean(np.array(wrong) > 0.9)) if wrong else 0.0


def _without_fasteners(a: Answers) -> Answers:
    return a.where(np.array([str(label).split("/")[1] not in FASTENERS for label in a.truth], np.bool_))


def _table(rows: Iterable[tuple[str, Scores]]) -> str:
    lines = []
    for name, s in rows:
        if s.parts:
            shares = f"{s.group:.1%}", f"{s.name:.1%}", f"{s.macro:.2f}", f"{s.ece:.3f}", f"{s.kept:.1%}"
            lines.append((name, f"{s.parts:,}", *shares, f"{s.precision:.1%}" if s.kept else ""))
    if not lines:
        return "(not measured)"
    return "\n".join(table(("", "parts", "group", "name", "macro F1", "ECE", "labelled", "right of these"), lines))


def _alike(*trials: Answers) -> str:
    lines = []
    for title, names in _SEEN_ALIKE.items():
        cells = [title]
        for a in trials:
            mine = a.where(np.array([str(label).split("/")[1] in names for label in a.truth], np.bool_))
            cells += [f"{len(mine.truth):,}", f"{(mine.name == mine.truth).mean():.0%}" if len(mine.truth) else ""]
        lines.append(cells)
    return "\n".join(table(("names", "parts", "right", "of new families", "right"), lines))


def _confusions(a: Answers) -> str:
    wrong = (a.name != a.truth) & ~a.strange
    pairs = Counter(zip(a.truth[wrong].tolist(), a.name[wrong].tolist(), strict=True))
    ranked = sorted(pairs.items(), key=lambda item: (-item[1], item[0]))[:_CONFUSIONS]
    return "; ".join(f"{said.split('/')[1]} for {true.split('/')[1]} ({n})" for (true, said), n in ranked)


def _names(*trials: Answers) -> str:
    """Recall and precision of each name in some trials."""
    lines = []
    for name in sorted({name for a in trials for name in a.truth[~a.strange].tolist()}):
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


def _strange(told: Mapping[str, Answers], makers: Answers, least: float) -> str:
    """How much of what belongs to no plant is left open."""
    trials = [("of kinds that were learnt", told["strangers"]), ("of kinds that were not", told["unseen strangers"])]
    trials.append(("real ones of held-out makers", makers.where(makers.strange)))
    shares = [f"{(a.sureness < least).mean():.0%} of {len(a.truth)} {name}" for name, a in trials if len(a.truth)]
    return "Things that belong to no plant stay open: " + ", ".join(shares) + "."
