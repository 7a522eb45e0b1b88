"""Secrets taken out of what a server says: it may give the key back that it was sent."""

from __future__ import annotations

import base64
import os
import re
from collections.abc import Callable
from urllib.parse import quote

__all__ = ["SHORTEST", "scrubber"]

SHORTEST = 8
"""Characters of the shortest key that is taken out: shorter ones ('none', 'EMPTY') are placeholders that servers of
one's own take, and could be words of an answer. Keys of providers have 30 and more."""

_SHOWN = "[key]"


def scrubber(*variables: str) -> Callable[[str], str]:
    """What takes keys out of a text: as they are, in percent encoding, in base64, in any case of letters.

    Args:
        variables: environment variables that may hold keys.
    """
    keys = {key for name in variables if len(key := os.environ.get(name, "").strip()) >= SHORTEST}
    if not keys:
        return lambda text: text
    forms = {form for key in keys for form in _forms(key)}
    pattern = re.compile("|".join(re.escape(form) for form in sorted(forms, key=lambda f: (-len(f), f))), re.IGNORECASE)
    return lambda text: pattern.sub(_SHOWN, text)


def _forms(key: str) -> set[str]:
    found = {key, quote(key, safe=""), key.encode().hex()}
    for before in ("", "Bearer "):
        plain = base64.b64encode((before + key).encode()).decode("ascii")
        # The last letters depend on what follows the key.
        found |= {plain.rstrip("=")[:-1], base64.urlsafe_b64encode((before + key).encode()).decode().rstrip("=")[:-1]}
    return found
