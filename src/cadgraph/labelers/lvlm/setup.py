"""From settings to a labeler or an asking: who is asked, what is kept where."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from cadgraph.config import Config, LvlmConfig
from cadgraph.errors import LabelError
from cadgraph.labelers.lvlm.address import check_address, is_local
from cadgraph.labelers.lvlm.asking import Asking, Budget, Tally
from cadgraph.labelers.lvlm.batch import BatchWriter, read_results
from cadgraph.labelers.lvlm.cache import Cache
from cadgraph.labelers.lvlm.client import Client
from cadgraph.labelers.lvlm.folder import (
    INDEX_FILE,
    DryRun,
    FolderAnswers,
    read_index,
    read_settings,
    some,
    write_settings,
)
from cadgraph.labelers.lvlm.joining import read_accuracy
from cadgraph.labelers.lvlm.labeler import LvlmLabeler, Way
from cadgraph.labelers.lvlm.price import Estimate, read_price
from cadgraph.labelers.lvlm.profile import Profile, read_profile
from cadgraph.labelers.lvlm.reply import Answerer, Question, key_of
from cadgraph.labelers.lvlm.secret import scrubber
from cadgraph.labelers.registry import labeler_of

__all__ = ["FOLDER", "QUESTIONS", "Run", "make_asking", "make_labeler", "profile_of", "settings_of_questions"]

FOLDER = "lvlm"
"""What a run keeps, within the output folder: cache, proposals, questions."""

QUESTIONS = "questions"
"""Where a dry run writes its questions, within that."""

_SHAPING = ("ask", "per", "votes", "hints", "below", "paper_views", "size")  # settings that questions follow from


@dataclass(frozen=True)
class Run:
    """How one run asks, beside the settings.

    Args:
        mode: ``ask`` a server; ``dry`` writes the questions; ``batch`` writes them for the provider's batch
            interface; ``folder`` reads answers from files.
        answers: the folder to read answers from, for ``folder``.
        questions: where ``dry`` writes them; beside the results if None.
        results: files of the provider's batch results to read first.
        keep_renders: whether questions and replies are kept as files.
        confirm: shown the estimate before the first question.
        note: called after each answer.
    """

    mode: Literal["ask", "dry", "batch", "folder"] = "ask"
    answers: Path | None = None
    questions: Path | None = None
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
        staged=settings.staged,
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
        confirm=run.confirm if run.mode != "folder" else _free,
        accuracy=read_accuracy(settings.model, settings.accuracy, paper=settings.paper_views),
        only_asks=run.mode == "dry" or (run.mode == "batch" and not run.results),
        only=_asked_in(run.answers) if run.mode == "folder" and run.answers is not None else None,
    )


def _asked_in(folder: Path) -> frozenset[str] | None:
    """The questions that the index of a folder names; None where it has no index."""
    return frozenset(read_index(folder)) if (folder / INDEX_FILE).is_file() else None


def make_asking(settings: LvlmConfig, folder: Path, run: Run) -> Asking:
    """Who is asked, with cache, price and budget.

    Raises:
        LabelError: a setting can't be used, or a cost limit is set for a model without a price.
        MissingExtra: the client library isn't installed.
    """
    address = _address(settings)
    check_address(address)
    profile = profile_of(settings)
    price = read_price(settings.model, settings.prices, local=is_local(address))
    if price is None and settings.max_cost is not None:
        raise LabelError(
            f"model {settings.model!r} has no price, so max_cost can't be kept; "
            "add it to a copy of the price table and name that with --set lvlm.prices=FILE"
        )
    cache = Cache(settings.cache or folder / "answers.sqlite")
    for path in run.results:
        read_results(path, cache, settings.model, scrubber(settings.key_variable, "OPENAI_API_KEY"))
    return Asking(
        answerer=_answerer(settings, folder, run, profile),
        cache=cache,
        price=price,
        budget=Budget(settings.max_questions, settings.max_cost),
        concurrency=settings.concurrency,
        detail=settings.detail,
        size=settings.size,
        keep=folder / "renders" if run.keep_renders else None,
        note=run.note,
        model=settings.model,
        profile=profile,
        answer=settings.max_answer_tokens,
    )


def settings_of_questions(folder: Path) -> dict[str, Any]:
    """The settings that the questions in a folder were made with, for ``Config.replace``.

    Raises:
        LabelError: the file beside them can't be read, or holds other settings.
    """
    found = read_settings(folder)
    unknown = sorted(set(found) - {f"lvlm.{name}" for name in _SHAPING})
    if unknown:
        raise LabelError(f"{folder}: {some(unknown)} are no settings of questions; write the questions anew")
    return found


def profile_of(settings: LvlmConfig) -> Profile:
    """What is known of the model and the server that the settings name.

    Raises:
        LabelError: the table of profiles can't be used.
    """
    return read_profile(
        settings.model,
        _address(settings),
        settings.profiles,
        context=settings.context,
        pictures=settings.pictures,
        schema=settings.structured,
    )


def _address(settings: LvlmConfig) -> str:
    """Of the server; empty for OpenAI's own."""
    return settings.base_url or os.environ.get("OPENAI_BASE_URL", "")


def _answerer(settings: LvlmConfig, folder: Path, run: Run, profile: Profile) -> Answerer:
    if run.mode == "dry":
        questions = run.questions or folder / QUESTIONS
        write_settings(questions, {f"lvlm.{name}": getattr(settings, name) for name in _SHAPING})
        return DryRun(questions)
    if run.mode == "folder":
        if run.answers is None:
            raise LabelError("no folder of answers: give --from-folder")
        return FolderAnswers(run.answers)
    if run.mode == "batch":

        def key(question: Question) -> str:
            return key_of(question, settings.model, settings.detail)

        return BatchWriter(
            folder, settings.model, key, detail=settings.detail, max_tokens=settings.max_answer_tokens,
            temperature=settings.temperature, manner=profile.manner,
        )  # fmt: skip
    return Client(
        settings.model,
        base_url=settings.base_url,
        key_variable=settings.key_variable,
        timeout=settings.timeout,
        retries=settings.retries,
        wait=settings.wait,
        detail=settings.detail,
        max_tokens=settings.max_answer_tokens,
        temperature=settings.temperature,
        profile=profile,
        fixed=settings.structured != "auto",
    )


def _free(_: Estimate) -> bool:
    return True
