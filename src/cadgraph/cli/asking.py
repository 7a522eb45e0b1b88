"""The options of commands that may ask a vision-language model, as one object."""

from __future__ import annotations

import functools
import inspect
import shlex
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import MISSING, Field, dataclass, fields
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_type_hints

import typer
from rich.markup import escape

from cadgraph.cli.screen import err, out
from cadgraph.config import Config, LvlmConfig
from cadgraph.model.graph import SceneGraph

__all__ = ["AskingOptions", "asks"]

_PANEL = "Vision-language model"
_EVERY = 5.0  # s between two lines on how far it is
_SET = LvlmConfig()  # what counts where an option isn't given

_F = TypeVar("_F", bound=Callable[..., Any])


def _option(*names: str, **more: Any) -> Any:
    return typer.Option(*names, rich_help_panel=_PANEL, **more)


@dataclass(frozen=True)
class AskingOptions:
    """What is asked of whom; see ``docs/lvlm.md``."""

    labeler_: Annotated[
        str | None,
        _option(
            "--labeler",
            metavar="embedded|lvlm|embedded+lvlm|none",
            show_default="embedded, or as set",
            help="Who labels; embedded+lvlm asks the model where the embedded one is unsure.",
        ),
    ] = None
    model: Annotated[
        str | None,
        _option("--model", metavar="NAME", show_default=_SET.model, help="Of the model, as the server knows it."),
    ] = None
    base_url: Annotated[
        str | None,
        _option(
            "--base-url",
            metavar="URL",
            show_default="OpenAI's own",
            help="A compatible server: vLLM, Ollama, LM Studio, Azure...",
        ),
    ] = None
    votes: Annotated[
        int | None,
        _option("--votes", min=1, show_default=str(_SET.votes), help="Ask about so many of equal parts; most count."),
    ] = None
    hints: Annotated[bool, _option("--hints", help="Tell it what geometry knows: form, repeats, neighbours.")] = False
    max_questions: Annotated[
        int | None, _option("--max-questions", min=0, show_default="no limit", help="At most so many questions.")
    ] = None
    max_cost: Annotated[
        float | None, _option("--max-cost", min=0.0, show_default="no limit", help="At most so many US dollars.")
    ] = None
    yes: Annotated[bool, _option("--yes", "-y", help="Don't ask whether the estimate is fine.")] = False
    dry_run: Annotated[bool, _option("--dry-run", help="Write prompts and pictures, and ask nobody.")] = False
    batch: Annotated[bool, _option("--batch", help="Write requests for the provider's batch interface.")] = False
    keep_renders: Annotated[bool, _option("--keep-renders", help="Keep each prompt, picture and reply.")] = False
    paper_views: Annotated[bool, _option("--paper-views", help="Plain pictures, as in the paper.")] = False

    def settings(self, config: Config) -> Config:
        """The settings with what the options say.

        Raises:
            ValueError: an option is unknown, or two don't go together.
        """
        changes: dict[str, Any] = {}
        who = {"embedded": "never", "lvlm": "all", "embedded+lvlm": "unsure", "none": "never"}
        if self.labeler_ is not None:
            if self.labeler_ not in who:
                raise ValueError(f"--labeler {self.labeler_}: give {', '.join(who)}")
            changes["lvlm.ask"] = who[self.labeler_]
            changes["label.labeler"] = "none" if self.labeler_ == "none" else "embedded"
        if self.dry_run and self.batch:
            raise ValueError("--dry-run asks nobody and --batch prepares asking; give one of them")
        given = {
            "model": self.model,
            "base_url": self.base_url,
            "votes": self.votes,
            "hints": self.hints or None,
            "max_questions": self.max_questions,
            "max_cost": self.max_cost,
            "paper_views": self.paper_views or None,
        }
        changes |= {f"lvlm.{name}": value for name, value in given.items() if value is not None}
        return config.replace(changes) if changes else config

    def stored(self, config: Config, before: Config) -> Config:
        """The settings that go into the results: the limits of a run that asks nobody are none of the next one's.

        Args:
            config: all settings.
            before: what they were without the options.
        """
        if not (self.dry_run or self.batch):
            return config
        limits = {"lvlm.max_questions": before.lvlm.max_questions, "lvlm.max_cost": before.lvlm.max_cost}
        return config.replace(limits)

    def labeler(self, config: Config, output: Path, progress: Any, **more: Any) -> Any:
        """The labeler that the settings ask for; None where no model is asked.

        Args:
            config: all settings.
            output: folder of the results.
            progress: the bars, taken away while the estimate is confirmed.
            more: of ``lvlm.setup.Run``, over what the options say.
        """
        if config.lvlm.ask == "never":
            if self.dry_run or self.batch or more:
                raise ValueError("nobody to ask: give --labeler lvlm or --labeler embedded+lvlm as well")
            return None
        from cadgraph.labelers.lvlm.setup import make_labeler

        return make_labeler(config, output, self.run(progress, **more))

    def run(self, progress: Any, **more: Any) -> Any:
        """How this run asks."""
        from cadgraph.labelers.lvlm.setup import Run

        mode = "dry" if self.dry_run else "batch" if self.batch else "ask"
        values = {"mode": mode, "keep_renders": self.keep_renders, **more}
        values.setdefault("note", _Note(values["mode"]))
        if values["mode"] == "ask":
            confirm: Callable[[Any], bool] = functools.partial(_confirmed, progress, self.yes)
        else:
            # Whoever answers files in place is no model with a price.
            confirm = (lambda _: True) if "questions" in more else _estimated
        return Run(confirm=confirm, **values)

    def tell(self, labeler: Any, graph: SceneGraph) -> None:
        """Says what asking came to.

        Args:
            labeler: that asked; None where nobody was asked.
            graph: that came of it.
        """
        if labeler is None:
            return
        tally = labeler.tally
        cost = f", ${tally.cost:.2f} in all, ${tally.spent:.2f} now" if labeler.asking.price else ""
        counts = f"{tally.asked:,} sent, {tally.known:,} from the cache, {tally.failed:,} without a usable answer"
        err.print(f"[dim]questions      [/]{counts}{cost}")
        for finding in (one for one in graph.diagnostics if one.code.startswith("lvlm-")):
            err.print(f"[dim]{'':<15}[/]{escape(finding.message)}")

    def tell_written(self, labeler: Any, folder: Path) -> None:
        """Says what a run that asks nobody wrote, and the command that takes the answers.

        Args:
            labeler: that asked.
            folder: of the results.
        """
        answerer = labeler.asking.answerer
        files = [str(path) for path in getattr(answerer, "files", ())]
        where = ", ".join(files) if self.batch else str(answerer.folder)
        way = "--batch-results FILE" if self.batch else f"--from-folder {shlex.quote(where)}"
        out.print(f"wrote {labeler.estimate.questions:,} questions: {escape(where)}; no result was touched")
        out.print(f"[dim]with answers:[/] cadgraph label {escape(f'{shlex.quote(str(folder))} {way}')}")


def asks(*without: str) -> Callable[[_F], _F]:
    """Gives a command the options of :class:`AskingOptions` in place of its parameter of that type.

    Args:
        without: fields whose options mean nothing to it.
    """
    return functools.partial(_with_options, [field for field in fields(AskingOptions) if field.name not in without])


def _with_options(options: Sequence[Field[Any]], command: _F) -> _F:
    hints = get_type_hints(command, include_extras=True)
    signature = inspect.signature(command)
    name = next(key for key, kind in hints.items() if kind is AskingOptions)
    own = [p.replace(annotation=hints[p.name]) for p in signature.parameters.values() if p.name != name]
    types = get_type_hints(AskingOptions, include_extras=True)
    added = [
        inspect.Parameter(
            field.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=inspect.Parameter.empty if field.default is MISSING else field.default,
            annotation=types[field.name],
        )
        for field in options
    ]

    @functools.wraps(command)
    def wrapped(**values: Any) -> Any:
        mine = {field.name: values.pop(field.name) for field in options}
        return command(**values, **{name: AskingOptions(**mine)})

    parameters = [*(p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in own), *added]
    replaced: Any = wrapped
    replaced.__signature__ = signature.replace(parameters=parameters)
    replaced.__annotations__ = {p.name: p.annotation for p in parameters}
    # What it wraps has other parameters; nobody must look there.
    del replaced.__wrapped__
    result: _F = replaced
    return result


class _Note:
    """A line every few seconds on how far asking is, and what it has cost; none where nobody is asked now."""

    def __init__(self, mode: str) -> None:
        self._last = time.monotonic()
        self._silent = mode != "ask"

    def __call__(self, tally: Any) -> None:
        if self._silent or time.monotonic() - self._last < _EVERY:
            return
        self._last = time.monotonic()
        # One that is asked again is the same question.
        done = tally.asked + tally.known - tally.again
        cost = f", ${tally.cost:.2f} so far" if tally.cost else ""
        err.print(f"asked {done:,} of {tally.total:,}, {tally.failed:,} failed{cost}")


def _confirmed(progress: Any, yes: bool, estimate: Any) -> bool:
    _tell_estimate(estimate)
    err.print("answers that can't be used or are unsure are asked again once, within the budget")
    if yes or not estimate.questions:
        return True
    if not sys.stdin.isatty():
        err.print("nobody is there to confirm this; give --yes")
        return False
    with progress.paused():
        return typer.confirm("Ask them?", err=True)


def _estimated(estimate: Any) -> bool:
    _tell_estimate(estimate)
    err.print("nobody is asked now")
    return True


def _tell_estimate(estimate: Any) -> None:
    cost = "no price is known for this model" if estimate.cost is None else f"about ${estimate.cost:.2f}"
    err.print(
        f"[bold]{estimate.questions:,} questions[/] to {escape(estimate.model)}: about {estimate.prompt_tokens:,} + "
        f"{estimate.answer_tokens:,} tokens, {cost}"
    )
    if estimate.profile:
        err.print(escape(estimate.profile))
    if estimate.resumed:
        err.print(
            f"{estimate.resumed:,} of them were sent before, and run or connection ended before an answer came; "
            "they are sent again with the same ids, and may be paid twice"
        )
    if estimate.known:
        err.print(f"{estimate.known:,} more are answered by the cache")
    if estimate.left_out:
        err.print(f"{estimate.left_out:,} are left out: the budget ends there")
