"""What a labeler can't say: names of the vocabulary that it never learnt."""

from __future__ import annotations

from cadgraph.model.scene import Diagnostic
from cadgraph.model.vocabulary import Vocabulary, default_vocabulary

__all__ = ["tell_unknown"]

_MOST_TOLD = 30


def tell_unknown(labeler: object, vocabulary: Vocabulary) -> tuple[Diagnostic, ...]:
    """Tells the user which of their names only a catalogue, corrections or a vision-language model can give.

    Args:
        labeler: one with an attribute ``known``, the pairs ``(group, name)`` that it has learnt; others are taken to
            know all names.
        vocabulary: a user's; about the built-in one nothing is told.
    """
    known = getattr(labeler, "known", None)
    if known is None or vocabulary.to_json() == default_vocabulary().to_json():
        return ()
    missing = [
        f"{group}/{name}"
        for group, content in vocabulary.groups.items()
        for name in content.names
        if (group, name) not in known
    ]
    if not missing:
        return ()
    shown = ", ".join(missing[:_MOST_TOLD]) + (f" and {len(missing) - _MOST_TOLD} more" * (len(missing) > _MOST_TOLD))
    message = (
        f"the embedded labeler has not learnt {len(missing)} names of the vocabulary, so only a catalogue (--catalog), "
        f"corrections (cadgraph relabel), given labels or a vision-language model can give them: {shown}"
    )
    return (Diagnostic("vocabulary-unknown-to-model", message),)
