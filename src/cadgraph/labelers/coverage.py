"""What a labeler can't say: names of the vocabulary that it never learnt."""

from __future__ import annotations

from collections.abc import Collection

from cadgraph.model.diagnostic import Diagnostic
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary

__all__ = ["find_unlearnt"]

_MOST_TOLD = 30


def find_unlearnt(learnt: Collection[tuple[str, str]], vocabulary: Vocabulary) -> tuple[Diagnostic, ...]:
    """Names of a user's vocabulary that only a catalogue, corrections or a vision-language model can give.

    Args:
        learnt: group and name of each label that a trained labeler knows.
        vocabulary: a user's; about the built-in one nothing is reported.
    """
    if vocabulary.to_json() == default_vocabulary().to_json():
        return ()
    missing = [
        f"{group}/{name}"
        for group, content in vocabulary.groups.items()
        for name in content.names
        if (group, name) not in learnt
    ]
    if not missing:
        return ()
    shown = ", ".join(missing[:_MOST_TOLD]) + (f" and {len(missing) - _MOST_TOLD} more" * (len(missing) > _MOST_TOLD))
    message = (
        f"the embedded labeler has not learnt {len(missing)} names of the vocabulary, so only a catalogue (--catalog), "
        f"corrections (cadgraph relabel), given labels or a vision-language model can give them: {shown}"
    )
    return (Diagnostic("vocabulary-unknown-to-model", message),)
