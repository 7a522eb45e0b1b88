"""``python -m cadlab.fuzz``: spoils files of every kind, reads them, and says what came of it."""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from cadlab.fuzz.judge import FAULTS, Verdict
from cadlab.fuzz.kinds import KINDS
from cadlab.fuzz.seeds import write_seeds
from cadlab.fuzz.workers import Case, Judged, judge_all

__all__ = ["main"]

_STEP = 10_000_000  # between the numbers of two seeds: so many cases of a kind have numbers of their own
_COLUMNS = ("read", "refused", "stopped-crash", "stopped-hang", "stopped-memory")


def main(given: Sequence[str] | None = None) -> int:
    """Runs the command; 1 where a reader has a fault, else 0."""
    args = _parser().parse_args(given)
    with tempfile.TemporaryDirectory(prefix="fuzz-", ignore_cleanup_errors=True) as name:
        seeds = Path(name)
        write_seeds(seeds)
        if args.case:
            cases: Iterator[Case] = iter([_parsed(case) for case in args.case])
        else:
            print(f"seed {args.seed}", flush=True)  # noqa: T201
            cases = _cases(args.only or list(KINDS), args.seed, args.mutations, args.seconds, seeds)
        counts: dict[str, Counter[str]] = {}
        found: dict[str, Case] = {}
        for judged in judge_all(cases, seeds, args.workers):
            case, verdict = judged.case, judged.verdict
            counts.setdefault(case[0], Counter())[verdict.outcome] += 1
            if args.case or (verdict.is_fault and _signature(case, verdict) not in found):
                _tell(judged, args.keep)
            if verdict.is_fault:
                found.setdefault(_signature(case, verdict), case)
        print(_table(counts))  # noqa: T201
        return int(bool(found))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m cadlab.fuzz", description=__doc__)
    parser.add_argument("--mutations", type=int, default=1000, help="cases in all, evenly over the kinds")
    parser.add_argument("--seconds", type=float, default=0, help="end after this long, whatever is left; 0: never")
    parser.add_argument("--seed", type=int, default=random.randrange(1000), help="of the cases; drawn if not given")
    parser.add_argument("--only", action="append", choices=list(KINDS), metavar="KIND", help=", ".join(KINDS))
    parser.add_argument("--case", action="append", metavar="KIND:NUMBER", help="one case again, as it was printed")
    parser.add_argument("--workers", type=int, default=2, help="processes that read")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="where files that show a fault are put")
    return parser


def _cases(kinds: Sequence[str], seed: int, most: int, seconds: float, seeds: Path) -> Iterator[Case]:
    """Kind by kind in turn, those without a sound file left out, as long as there is time."""
    end = time.monotonic() + seconds if seconds else float("inf")
    ready = [kind for kind in kinds if (seeds / kind).is_dir()]
    for number in range(most):
        if time.monotonic() > end:
            return
        yield ready[number % len(ready)], seed * _STEP + number // len(ready)


def _parsed(text: str) -> Case:
    kind, _, what = text.partition(":")
    if kind not in KINDS or not what:
        raise SystemExit(f"--case {text}: give KIND:NUMBER or KIND:FILE, the kind one of {', '.join(KINDS)}")
    return kind, int(what) if what.isdigit() else Path(what).absolute()


def _signature(case: Case, verdict: Verdict) -> str:
    place = verdict.detail.partition(": ")[0] if verdict.outcome == "traceback" else verdict.detail[:30]
    return f"{case[0]} {verdict.outcome} {place}"


def _tell(judged: Judged, keep: Path | None) -> None:
    kind, what = judged.case
    outcome = judged.verdict.outcome
    print(f"{kind}:{what}  {outcome}  {judged.verdict.detail}", flush=True)  # noqa: T201
    if keep is not None and judged.content is not None and not isinstance(what, Path):
        keep.mkdir(parents=True, exist_ok=True)
        (keep / f"{kind}-{what}-{outcome}{KINDS[kind].suffix}").write_bytes(judged.content)


def _table(counts: dict[str, Counter[str]]) -> str:
    """A row for each kind and one for all, in Markdown."""
    faults = [fault for fault in FAULTS if any(fault in row for row in counts.values())]
    columns = [*_COLUMNS, *faults]
    lines = ["| kind | mutations | " + " | ".join(columns) + " |", "|---|" + "--:|" * (len(columns) + 1)]
    whole: Counter[str] = sum((counts[kind] for kind in counts), Counter())
    for name, row in [*((kind, counts[kind]) for kind in KINDS if kind in counts), ("all", whole)]:
        lines.append(f"| {name} | {row.total():,} | " + " | ".join(f"{row[column]:,}" for column in columns) + " |")
    if not faults:
        lines.append("\nno faults")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
