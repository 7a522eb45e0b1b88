"""From settings to a labeler or an asking: who is asked, what is kept where."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from cadgraph.config import Config, LvlmConfig
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.address import check_address, is_local
from cadgraph.labelers.lvlm.asking import Asking, Budget, Tally, key_of
from cadgraph.labelers.lvlm.batch import BatchWriter, read_results
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.folder import DryRun, FolderAnswers
from cadgraph.labelers.lvlm.joining import read_accuracy
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.price import Estimate, read_price
from cadgraph.labelers.lvlm.reply import Answerer, Question
from cadgraph.labelers.registry import labeler_of

__all__ = ["Run", "make_asking", "make_labeler"]

FOLDER = "lvlm"
"""What a run keeps, within the output folder: cache, proposals, questions."""


@dataclass(frozen=True)
class Run:
    """How one run asks, beside the settings.

    Args:
        mode: ``ask`` a server; ``dry`` writes the questions; ``batch`` writes them for the provider's batch
            interface; ``folder`` reads answers from files.
        answers: the folder to read answers from, for ``folder``.
        results: files of the provider's batch results to read first.
        keep_renders: whether questions and replies are kept as files.
        confirm: shown the estimate before the first question.
        note: called after each answer.
    """

    mode: Literal["ask", "dry", "batch", "folder"] = "ask"
    answers: Path | None = None
    results: tuple[Path, ...] = ()
    keep_renders: bool = False
    confirm: Callable[[Estimate], bool] = lambda _: True
    note: Callable[[Tally], None] | None = None


def make_labeler(config: Config, output: Path, run: Run | None = None) -> LvlmLabeler:
    """The labeler that the settings ask for.

    Args:
        config: all settings; ``lvlm.ask`` says which parts.
        output: folder of the results.
        run: how this run asks.

    Raises:
        LabelError: a setting can't be used, or a cost limit is set for a model without a price.
        MissingExtra: the client library isn't installed.
    """
    run = run or Run()
    settings = config.lvlm
    way = Way(
        ask="unsure" if settings.ask == "unsure" else "all",
        per=settings.per,
        votes=settings.votes,
        hints=settings.hints,
        context=settings.context,
        below=settings.below,
        again_below=settings.again_below,
        repair=settings.repair,
        paper=settings.paper_views,
    )
    embedded = labeler_of(config.label) if settings.ask == "unsure" or settings.hints else None
    asking = make_asking(settings, output / FOLDER, run)
    return LvlmLabeler(
        asking,
        way,
        embedded=embedded,
        folder=output / FOLDER,
        confirm=_no_cost if run.mode != "ask" else run.confirm,
        accuracy=read_accuracy(settings.model, settings.accuracy, paper=settings.paper_views),
        only_asks=run.mode == "dry" or (run.mode == "batch" and not run.results),
    )


def make_asking(settings: LvlmConfig, folder: Path, run: Run) -> Asking:
    """Who is asked, with cache, price and budget.

    Raises:
        LabelError: a setting can't be used, or a cost limit is set for a model without a price.
        MissingExtra: the client library isn't installed.
    """
    address = settings.base_url or os.environ.get("OPENAI_BASE_URL", "")
    check_address(address)
    price = read_price(settings.model, settings.prices, local=is_local(address))
    if price is None and settings.max_cost is not None:
        raise LabelError(
            f"model {settings.model!r} has no price, so max_cost can't be kept; "
            "add it to a copy of the price table and name that with --set lvlm.prices=FILE"
        )
    cache = Cache(settings.cache or folder / "answers.sqlite")
    for path in run.results:
        read_results(path, cache, settings.model)
    return Asking(
        answerer=_answerer(settings, folder, run),
        cache=cache,
        price=price,
        budget=Budget(settings.max_questions, settings.max_cost),
        concurrency=settings.concurrency,
        detail=settings.detail,
        size=settings.size,
        keep=folder / "renders" if run.keep_renders else None,
        note=run.note,
    )


def _answerer(settings: LvlmConfig, folder: Path, run: Run) -> Answerer:
    if run.mode == "dry":
        return DryRun(folder / "questions")
    if run.mode == "folder":
        if run.answers is None:
            raise LabelError("no folder of answers: give --from-folder")
        return FolderAnswers(run.answers)
    if run.mode == "batch":
        schema = "json_schema" if settings.structured == "auto" else settings.structured

        def key(question: Question) -> str:
            return key_of(question, settings.model, settings.detail)

        return BatchWriter(
            folder, settings.model, key, detail=settings.detail, max_tokens=settings.max_answer_tokens,
            temperature=settings.temperature, schema=schema,
        )  # fmt: skip
    return Client(
        settings.model,
        base_url=settings.base_url,
        key_variable=settings.key_variable,
        timeout=settings.timeout,
        retries=settings.retries,
        detail=settings.detail,
        max_tokens=settings.max_answer_tokens,
        temperature=settings.temperature,
        structured=settings.structured,
    )


def _no_cost(_: Estimate) -> bool:
    return True
