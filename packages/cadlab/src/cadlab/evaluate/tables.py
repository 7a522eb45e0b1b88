"""An evaluation as a Markdown page."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from cadlab.evaluate.evaluation import Evaluation, StructureScores
from cadlab.evaluate.labels import UNLABELLED, Confusion, LabelScores, TaskScores
from cadlab.evaluate.relations import EdgeVerdict, RelationScores
from cadlab.evaluate.scores import Score
from cadlab.evaluate.units import UnitScores, UnitTypeScores
from cadlab.markdown import table

__all__ = ["to_markdown"]

_MOST_ROWS = 40  # of a list of single cases; the JSON holds all

_NO_VALUE = "–"
_ABSENT = "not in this graph"


def to_markdown(evaluation: Evaluation, pictures: Sequence[str] = ()) -> str:
    """Writes an evaluation down for people.

    Args:
        evaluation: what was measured.
        pictures: paths of figures, relative to the page.

    Returns:
        GitHub-flavoured Markdown; all text from files is escaped.
    """
    total = evaluation.total
    sections = [
        _heading(evaluation),
        _overview(evaluation),
        _labels(total),
        _units(evaluation),
        _relations(total),
        _structures(total),
        _calibration(total),
        [f"![{_escaped(name.removesuffix('.svg').replace('-', ' '))}]({name})" for name in pictures],
    ]
    return "\n\n".join("\n".join(lines) for lines in sections if lines) + "\n"


def _heading(evaluation: Evaluation) -> list[str]:
    what = _escaped(evaluation.scene or "an unnamed scene")
    plant = f"; generated plant {_escaped(evaluation.preset)}" if evaluation.preset else ""
    seed = f", seed {evaluation.seed}" if evaluation.seed is not None else ""
    method = f"; method {_escaped(evaluation.method)}" if evaluation.method else ""
    return [
        "# Evaluation",
        "",
        f"Scene {what}{plant}{seed}{method}. {evaluation.n_meshes} meshes in the truth, held by {evaluation.n_parts} "
        f"parts; {evaluation.n_lost} lost; {evaluation.n_unknown} parts that the truth doesn't know.",
        "",
        "*Per mesh*: each mesh with the label of the part that holds it. *Per part*: a part's truth is that of its "
        f"largest labelled mesh. Unlabelled counts as wrong. {_NO_VALUE} stands for a share of nothing, or for what "
        "the truth doesn't annotate.",
    ]


def _overview(evaluation: Evaluation) -> list[str]:
    rows = [_summary(scores) for scores in (evaluation.total, *evaluation.structures)]
    head = (
        "structure", "kind", "parts", "group", "name", "unlabelled", "units fully / partially / missed",
        "exact / spurious", "connected F1", "related F1", "split / merged", "contacts F1",
    )  # fmt: skip
    return [
        "## In short",
        "",
        "Group and name are accuracies per part; *exact* units are those that one predicted unit holds exactly.",
        "",
        *table(head, rows),
    ]


def _summary(scores: StructureScores) -> tuple[str, ...]:
    units = scores.units.total if scores.units else None
    clusters = scores.clusters
    return (
        _escaped(scores.id),
        _escaped(scores.kind or _NO_VALUE),
        str(scores.parts.n),
        _percent(scores.parts.group.accuracy),
        _percent(scores.parts.name.accuracy),
        _percent(scores.parts.unlabelled),
        f"{units.fully} / {units.partially} / {units.missed}" if units else _NO_VALUE,
        (f"{units.exact} / {units.spurious}" if _present(scores.units) else _ABSENT) if units else _NO_VALUE,
        _f1(scores.connected),
        _f1(scores.related),
        f"{clusters.n_split} / {clusters.n_merged}" if clusters else _NO_VALUE,
        _number(scores.contacts.pairs.f1) if scores.contacts else _NO_VALUE,
    )


def _present(scores: UnitScores | RelationScores | None) -> bool:
    """Whether the graph has anything of this kind; without it a score of 0 would say more than is known."""
    return scores is not None and scores.present


def _f1(scores: RelationScores | None) -> str:
    if scores is None:
        return _NO_VALUE
    return _number(scores.edges.f1) if scores.present else _ABSENT


def _labels(scores: StructureScores) -> list[str]:
    levels: tuple[tuple[str, Callable[[LabelScores], TaskScores]], ...] = (
        ("group", lambda level: level.group),
        ("name", lambda level: level.name),
    )
    rows = [
        (
            f"{task}, per {level.level}",
            str(of(level).n),
            _percent(of(level).accuracy),
            _percent(of(level).accuracy_labelled),
            _number(of(level).macro_f1),
            _percent(level.unlabelled),
        )
        for task, of in levels
        for level in (scores.meshes, scores.parts)
    ]
    lines = ["## Labels", ""]
    lines += table(("what", "n", "accuracy", "of the labelled", "macro F1", "unlabelled"), rows)
    for task, of in levels:
        classes = of(scores.parts).classes
        lines += ["", f"### By {task}, per part", ""]
        lines += table(
            (task, "true", "predicted", "precision", "recall", "F1"),
            [(_escaped(c.label), str(c.n_true), str(c.n_predicted), *_score(c)) for c in classes],
        )
    lines += ["", "### Taken for another, per part", ""]
    mistakes = _mistakes(scores.parts.group.confusion) + _mistakes(scores.parts.name.confusion)
    return lines + _cases(("true", "taken for", "parts"), mistakes, "Nothing.")


def _mistakes(confusion: Confusion) -> list[tuple[str, ...]]:
    found = [
        (n, row, column)
        for row, counts in zip(confusion.labels, confusion.counts, strict=True)
        for column, n in zip(confusion.columns, counts, strict=True)
        if n and row != column
    ]
    found.sort(key=lambda case: (-case[0], case[1], case[2]))
    return [
        (_escaped(row), f"*{UNLABELLED}*" if column == UNLABELLED else _escaped(column), str(n))
        for n, row, column in found
    ]


def _units(evaluation: Evaluation) -> list[str]:
    units = evaluation.total.units
    if units is None:
        return []
    head = (
        "structure", "type", "true", "fully", "partially", "missed", "predicted", "exact", "spurious", "split",
        "merged", "kinds right",
    )  # fmt: skip
    rows = [
        _unit_row(scores.id, row)
        for scores in (evaluation.total, *evaluation.structures)
        if scores.units is not None
        for row in (scores.units.types if scores.id != "all" else (*scores.units.types, scores.units.total))
    ]
    wrong = [
        (
            _escaped(unit.tag),
            _escaped(unit.kind or unit.type),
            _escaped(unit.structure or _NO_VALUE),
            f"{unit.found} ({unit.n_labelled} of {unit.n_counted} parts)",
            _listed(unit.pieces),
        )
        for unit in units.units
        if not unit.exact or unit.found != "fully"
    ]
    wrong += [
        (_NO_VALUE, _escaped(unit.type), _escaped(unit.structure or _NO_VALUE), "spurious", _escaped(unit.tag))
        for unit in units.predicted
        if unit.spurious
    ]
    return [
        "## Units",
        "",
        "*Fully*, *partially*, *missed*: all, some or none of the true unit's parts carry a group of its type (the "
        "paper's Table I). *Exact*: one predicted unit holds exactly its parts. *Spurious*: a predicted unit shares no "
        "majority with any true one.",
        "",
        *table(head, rows),
        "",
        "### Not exact",
        "",
        *_cases(("unit", "kind", "structure", "found by its labels", "predicted as"), wrong, "None."),
    ]


def _unit_row(structure: str, row: UnitTypeScores) -> tuple[str, ...]:
    return (
        _escaped(structure),
        _escaped(row.type),
        *(str(n) for n in (row.n_true, row.fully, row.partially, row.missed, row.n_predicted, row.exact)),
        *(str(n) for n in (row.spurious, row.split, row.merged)),
        f"{row.kinds_right} of {row.kinds_decided}" if row.kinds_decided else _NO_VALUE,
    )


def _relations(scores: StructureScores) -> list[str]:
    found = [relations for relations in (scores.connected, scores.related) if relations is not None]
    if not found:
        return []
    rows = [row for relations in found for row in _relation_rows(relations)]
    lines = [
        "## Order and relations",
        "",
        "Pairs of units that follow each other along a run, with no unit between them; junctions are contracted. "
        "*connected*: our relations along centrelines. *related*: the paper's Algorithm 1.",
        "",
        *table(("edges", "true", "predicted", "correct", "precision", "recall", "F1"), rows),
    ]
    direction = scores.connected.direction if scores.connected and scores.connected.present else None
    if direction is not None and scores.connected is not None:
        lines += [
            "",
            f"Direction of flow: {direction.n_known} of the correct edges have a known one; "
            f"{_percent(direction.decided)} of them decided, {_percent(direction.wrong)} wrong; "
            f"{direction.n_invented} more decided where the truth knows none.",
        ]
        known = [
            (_escaped(r.reason), str(r.n_known), str(r.n_decided), str(r.n_right), _percent(r.accuracy))
            for r in scores.connected.reasons
        ]
        if known:
            lines += ["", *table(("what fixes the direction", "known", "decided", "right", "right of these"), known)]
    lines += _taps(scores)
    for relations in found:
        if not relations.present:
            continue
        for title, edges in (("Missing", relations.missing), ("Extra", relations.extra)):
            lines += ["", f"### {title} in {relations.kind}", ""]
            lines += _cases(("from", "to", "structure"), [_edge_row(edge) for edge in edges], "None.")
    return lines


def _taps(scores: StructureScores) -> list[str]:
    """The order of two taps on one mesh, where the truth has any."""
    pairs = ((scores.connected, scores.connected_taps), (scores.related, scores.related_taps))
    rows = [
        (relations.kind, str(taps.n_pairs), str(taps.n_right), str(taps.n_wrong), _percent(taps.accuracy))
        if relations.present
        else (relations.kind, str(taps.n_pairs), _ABSENT, _NO_VALUE, _NO_VALUE)
        for relations, taps in pairs
        if relations is not None and taps is not None and taps.n_pairs
    ]
    if not rows:
        return []
    return [
        "",
        "### Order of two taps on one mesh",
        "",
        "Of each two neighbours that tap into the same mesh (two gauges on one pipe): right where what lies beyond "
        "each of them in the truth is next to it in the graph, wrong where it is next to the other.",
        "",
        *table(("by", "pairs", "right", "the wrong way round", "right share"), rows),
    ]


def _relation_rows(relations: RelationScores) -> Iterable[tuple[str, ...]]:
    if not relations.present:
        yield relations.kind, str(relations.edges.n_true), _ABSENT, *(4 * (_NO_VALUE,))
        return
    named: list[tuple[str, Score | None]] = [
        (relations.kind, relations.edges),
        (f"{relations.kind}, of units found", relations.between_matched),
        ("ends", relations.terminals),
    ]
    for name, score in named:
        if score is not None:
            yield name, str(score.n_true), str(score.n_predicted), str(score.n_correct), *_score(score)


def _edge_row(edge: EdgeVerdict) -> tuple[str, ...]:
    return (
        _end(edge.source, edge.found_source),
        _end(edge.target, edge.found_target),
        _listed(edge.structures),
    )


def _end(true: str | None, found: str | None) -> str:
    if true is None:
        return f"spurious {_escaped(str(found))}"
    return f"{_escaped(true)} ({'not found' if found is None else _escaped(found)})"


def _structures(scores: StructureScores) -> list[str]:
    lines = []
    if scores.joins is not None and scores.joins.n_true + scores.joins.n_predicted:
        joins = scores.joins
        precision, recall, f1 = _score(joins)
        lines += [
            "## Grouping",
            "",
            f"{joins.n_true} small meshes join a larger one in the truth, {joins.n_predicted} in the graph, "
            f"{joins.n_correct} the same one: precision {precision}, recall {recall}, F1 {f1}.",
            "",
        ]
    clusters, contacts = scores.clusters, scores.contacts
    if clusters is not None:
        lines += [
            "## Clusters",
            "",
            f"{clusters.n_true} true, {clusters.n_predicted} predicted, {clusters.n_exact} exactly right; "
            f"{clusters.n_split} split, {clusters.n_merged} predicted ones merge several; adjusted Rand index "
            f"{_number(clusters.adjusted_rand)}.",
            "",
            *_cases(
                ("structure", "parts", "pieces", "joined with"),
                [
                    (
                        _escaped(c.id),
                        str(c.n_parts),
                        str(len(c.pieces)),
                        _listed(c.joined_with),
                    )
                    for c in clusters.clusters
                    if not c.exact
                ],
                "All are exactly right.",
            ),
        ]
    if contacts is not None:
        pairs = contacts.pairs
        precision, recall, f1 = _score(pairs)
        lines += [
            *([""] if clusters is not None else []),
            "## Contacts",
            "",
            f"{pairs.n_true} pairs of parts touch, {pairs.n_predicted} are adjacent in the graph, {pairs.n_correct} "
            f"are both: precision {precision}, recall {recall}, F1 {f1}. Of the extra ones {contacts.n_extra_apart} "
            "are near each other without touching, which adjacency allows.",
        ]
    return lines


def _calibration(scores: StructureScores) -> list[str]:
    rows = []
    for found in (scores.group_calibration, scores.name_calibration):
        for b in found.bins:
            if b.n:
                rows.append(
                    (found.task, f"{b.low:.1f} to {b.high:.1f}", str(b.n), _number(b.confidence), _number(b.accuracy))
                )
    group, name = scores.group_calibration, scores.name_calibration
    return [
        "## Calibration of confidence",
        "",
        f"Expected calibration error: groups {_number(group.ece)}, names {_number(name.ece)}; greatest gap of a bin: "
        f"groups {_number(group.mce)}, names {_number(name.mce)}.",
        "",
        *table(("what", "confidence", "parts", "mean confidence", "accuracy"), rows),
    ]


def _cases(head: Sequence[str], rows: Sequence[tuple[str, ...]], nothing: str) -> list[str]:
    """A table of single cases, cut where it gets long."""
    if not rows:
        return [nothing]
    more = len(rows) - _MOST_ROWS
    cut = [] if more <= 0 else ["", f"And {more} more; evaluation.json lists all."]
    return [*table(head, rows[:_MOST_ROWS]), *cut]


def _score(score: Score) -> tuple[str, str, str]:
    return _number(score.precision), _number(score.recall), _number(score.f1)


def _percent(value: float | None) -> str:
    return _NO_VALUE if value is None else f"{100 * value:.1f} %"


def _number(value: float | None) -> str:
    return _NO_VALUE if value is None else f"{value:.3f}"


def _listed(names: Sequence[str]) -> str:
    return _escaped(", ".join(names)) or _NO_VALUE


def _escaped(text: str) -> str:
    """Text that Markdown and HTML take as it is, on one line."""
    plain = " ".join(text.split()).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return "".join(f"\\{letter}" if letter in "\\`*_[]|#!~$" else letter for letter in plain)
