"""Growing the label tree: new labels merged in, spellings normalized, nothing lost."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import yaml

from cadgraph._io.limits import PROPOSALS, read_text_within
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.normalize import clean_label, fold_group, fold_name, normalized
from cadgraph.model.vocabulary import Group, Vocabulary, read_vocabulary

__all__ = ["Merged", "Wish", "findings", "merge", "merge_vocabularies", "read_wishes", "to_yaml"]


@dataclass(frozen=True)
class Wish:
    """A label that somebody would like in the tree.

    Args:
        group: its group.
        name: the label; None where only the group is meant.
        reason: why.
        source: who says so, or the picture that shows it.
    """

    group: str
    name: str | None
    reason: str = ""
    source: str = ""


@dataclass(frozen=True)
class Merged:
    """What became of a wish.

    Args:
        wish: as it was.
        group: where it is now.
        name: what it is called now; None for a mere group.
        outcome: ``added``, ``folded`` (it was there under this or another spelling) or ``refused`` (no usable label).
    """

    wish: Wish
    group: str | None
    name: str | None
    outcome: str

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {**asdict(self.wish), "now": {"group": self.group, "name": self.name}, "outcome": self.outcome}


def merge(base: Vocabulary, wishes: Iterable[Wish]) -> tuple[Vocabulary, tuple[Merged, ...]]:
    """Adds labels to a tree, one after the other; what is there keeps its place.

    Args:
        base: the tree; not changed.
        wishes: in order.

    Returns:
        The new tree, and what became of each wish.
    """
    tree, results = base, []
    for wish in wishes:
        tree, result = _merged(tree, wish)
        results.append(result)
    return tree, tuple(results)


def merge_vocabularies(base: Vocabulary, other: Vocabulary, source: str = "") -> tuple[Vocabulary, tuple[Merged, ...]]:
    """Adds all labels of another tree; new groups bring their unit and connector along, known ones keep theirs."""
    wishes = [
        Wish(group, name, source=source)
        for group, content in other.groups.items()
        for name in (*content.names, *([None] if not content.names else []))
    ]
    tree, results = merge(base, wishes)
    groups = dict(tree.groups)
    for group, content in other.groups.items():
        place = fold_group(group, tree)
        if place is not None and place not in base.groups:
            groups[place] = replace(groups[place], unit=content.unit, connector=content.connector)
    return Vocabulary(groups), results


def _merged(tree: Vocabulary, wish: Wish) -> tuple[Vocabulary, Merged]:
    wanted = clean_label(wish.group, lower=False)
    name = clean_label(wish.name) if wish.name else None
    if wanted is None or (wish.name and name is None):
        return tree, Merged(wish, None, None, "refused")
    group = fold_group(wanted, tree)
    known = fold_name(name, tree, group) if name and group else None
    if known is None and name:
        known = fold_name(name, tree)
    if known is not None:
        return tree, Merged(wish, known[0], known[1], "folded")
    place = group or wanted
    if group is not None and name is None:
        return tree, Merged(wish, group, None, "folded")
    content = tree.groups.get(place, Group(()))
    names = content.names if name is None else (*content.names, _one(name))
    groups = {**tree.groups, place: replace(content, names=names)}
    return Vocabulary(groups), Merged(wish, place, names[-1] if name else None, "added")


def _one(name: str) -> str:
    """The last word in the singular, the rest as written."""
    *first, last = name.split(" ")
    return " ".join([*first, normalized(last)]) if "-" not in last else name


def read_wishes(path: str | Path) -> tuple[Wish, ...]:
    """Reads proposals of a run (``proposals.json``), or all labels of another vocabulary.

    Raises:
        LabelError: it is neither.
    """
    source = Path(path)
    if source.suffix.lower() != ".json":
        other = read_vocabulary(source)
        return tuple(Wish(g, name, source=str(path)) for g, content in other.groups.items() for name in content.names)
    text = read_text_within(source, PROPOSALS, LabelError, "give a run's proposals.json")
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise LabelError(f"{path}: not JSON ({type(error).__name__}); give a run's proposals.json") from error
    if isinstance(content, Mapping) and isinstance(content.get("groups"), Mapping):
        other = Vocabulary.from_json(content["groups"], str(path))
        return tuple(Wish(g, name, source=str(path)) for g, each in other.groups.items() for name in each.names)
    rows = content.get("labels") if isinstance(content, Mapping) else None
    if not isinstance(rows, list):
        raise LabelError(f"{path}: no list 'labels'; give a run's proposals.json or a vocabulary")
    wishes = []
    for i, row in enumerate(rows):
        group, name = (row.get("group"), row.get("name")) if isinstance(row, Mapping) else (None, None)
        if not isinstance(group, str) or not isinstance(name, str | None):
            raise LabelError(f"{path}: entry {i} needs text under 'group' and 'name'")
        wishes.append(Wish(group, name, str(row.get("reason") or "")[:300], str(row.get("source") or "")[:300]))
    return tuple(wishes)


def findings(tree: Vocabulary) -> list[str]:
    """What a person should look at: one label under two spellings or in two groups, groups without names."""
    found = []
    places: dict[str, list[str]] = {}
    for group, content in tree.groups.items():
        if not content.names:
            found.append(f"group {group!r} has no names")
        for name in content.names:
            places.setdefault(normalized(name).replace(" ", ""), []).append(f"{group}: {name}")
    found += [f"one label in several places: {', '.join(each)}" for each in places.values() if len(each) > 1]
    for group, content in tree.groups.items():
        for name in content.names:
            other = next((p for p in [fold_name(name, _without(tree, group, name))] if p is not None), None)
            if other is not None and normalized(other[1]) != normalized(name):
                found.append(f"{group}: {name} is also called {other[1]!r}, which is in {other[0]!r}")
    if not any(content.connector for content in tree.groups.values()):
        found.append("no group is a connector: no relations will be found along pipes")
    if not any(content.unit for content in tree.groups.values()):
        found.append("no group has a unit: no functional units will be found")
    return found


def _without(tree: Vocabulary, group: str, name: str) -> Vocabulary:
    names = tuple(n for n in tree.groups[group].names if n != name)
    return Vocabulary({**tree.groups, group: replace(tree.groups[group], names=names)})


def to_yaml(tree: Vocabulary, comments: Sequence[str] = ()) -> str:
    """A tree as a file that ``read_vocabulary`` takes."""
    head = "".join("# " + " ".join(line.split()) + "\n" for line in comments)
    content = {"version": 1, "groups": tree.to_json()}
    return head + yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=110, default_flow_style=None)
