"""How often a model is right: ``python packages/cadlab/benchmarks/lvlm_accuracy.py --model M``.

Asks a model about every kind of part of generated plants, in styles that the embedded labeler has not learnt either,
and writes an entry for the table of accuracies by which its answers are joined with the labeler's:

    python packages/cadlab/benchmarks/lvlm_accuracy.py --model gpt-4o --max-questions 200 -o mine.yaml
    cadgraph build plant.usd -o out --labeler embedded+lvlm --set lvlm.accuracy=mine.yaml

Answers are kept in a cache beside the table, so that a run that was broken off goes on. Shares are those of right
answers plus one right and one wrong one, so that few answers don't make anybody certain; groups of fewer than
``--least`` answers have none of their own.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path

import yaml

from cadgraph._io.atomic import write_atomically
from cadgraph.config import Config
from cadgraph.labelers.lvlm.setup import FOLDER, Run, make_labeler
from cadgraph.model.vocabulary import default_vocabulary
from cadgraph.pipeline import analyse
from cadplants import make
from cadplants.truth.truth_writer import truth_of

Pair = tuple[str, str | None]
PLANTS = (("riser", "vendor"), ("tank", "bim"), ("skid", "mechanical"))


def entry_of(answers: Iterable[tuple[Pair, Pair]], least: int) -> dict[str, object]:
    """Shares of right names and groups, over all answers and by the group that they say.

    Args:
        answers: what was said, and what is true.
        least: answers that a group needs.
    """
    counts: dict[str, list[int]] = defaultdict(lambda: [0, 0, 0])
    for said, true in answers:
        for key in ("", said[0]):
            counts[key][0] += 1
            counts[key][1] += said == true
            counts[key][2] += said[0] == true[0]
    shares = {key: _shares(count) for key, count in sorted(counts.items()) if key == "" or count[0] >= least}
    whole = shares.pop("", {"name": 0.5, "group": 0.5})
    return {**whole, "groups": shares} if shares else dict(whole)


def _shares(count: list[int]) -> Mapping[str, float]:
    n, names, groups = count
    return {"name": round((names + 1) / (n + 2), 3), "group": round((groups + 1) / (n + 2), 3)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--model", required=True)
    parser.add_argument("--base-url", default="")
    parser.add_argument("--max-questions", type=int, help="for each plant")
    parser.add_argument("--least", type=int, default=8)
    parser.add_argument("-o", "--output", type=Path, default=Path("accuracy.yaml"))
    options = parser.parse_args()
    config = Config().replace({
        "lvlm.ask": "all", "lvlm.model": options.model, "lvlm.base_url": options.base_url, "lvlm.again_below": 0.0,
        "lvlm.repair": False, "lvlm.staged": False, "lvlm.max_questions": options.max_questions,
        "lvlm.cache": str(options.output.with_suffix(".sqlite")),
    })  # fmt: skip
    answers: list[tuple[Pair, Pair]] = []
    for preset, style in PLANTS:
        plant = make(preset, 5, style)
        analysis = analyse(plant.scene())
        labeler = make_labeler(config, options.output.parent / FOLDER, Run())
        labeling = labeler.label(analysis.parts, analysis.contacts, default_vocabulary())
        truth = {mesh["mesh"]: (str(mesh["group"]), str(mesh["name"])) for mesh in truth_of(plant)["meshes"]}
        seen: set[str] = set()
        for label, path in zip(labeling.answers, analysis.parts.scene.paths, strict=True):
            question = getattr(label.evidence, "question", None) if label is not None else None
            if label is not None and question and question not in seen:
                seen.add(question)
                answers.append((label.said, truth[path]))
        print(f"{preset}/{style}: {len(seen)} answers, ${labeler.tally.cost:.2f}")
    table = yaml.safe_load((Path(__file__).parents[3] / "src/cadgraph/labelers/lvlm/accuracy.yaml").read_text("utf-8"))
    table[options.model] = entry_of(answers, options.least)
    write_atomically(options.output, yaml.safe_dump(table, sort_keys=False))
    print(yaml.safe_dump({options.model: table[options.model]}, sort_keys=False) + f"in {options.output}")


if __name__ == "__main__":
    main()
