"""How long a server is waited for: what it asks for itself, what it can't mean, and when it is gone."""

from __future__ import annotations

import email.utils
import math
import random
import socket
import threading
import time
import urllib.request
from collections.abc import Mapping
from urllib.parse import urlsplit

__all__ = ["CONNECT", "Gone", "Patience", "resolves", "retry_after"]

CONNECT = 5.0
"""Time for a connection to come about [s]; what takes longer is not there."""

_UNREACHABLE = 4.0  # s that connections may fail, one after the other, before the server counts as down
_IN_A_ROW = 12  # questions that fail one after the other, none answered between them: the server is gone
_SILENT = 1.5  # timeouts that a server may say nothing from the first question on: the second try of the first is over
_FIRST, _LONGEST = 0.5, 8.0  # s between two tries where the server doesn't say


class Gone(Exception):
    """Nothing more is sent to this server in this run; its text says why.

    Attributes:
        lost: whether a question was sent that the server may have answered.
    """

    lost = False


class Patience:
    """What all questions to one server have in common: whether it still makes sense to ask. Safe for threads.

    Args:
        longest: that is waited where a server asks for it [s].
        timeout: of one try [s], for messages.
        where: the server's address, for messages.
        settings: what sets ``longest`` and ``timeout``, for messages.
    """

    def __init__(
        self, longest: float, timeout: float, where: str, settings: tuple[str, str] = ("lvlm.wait", "lvlm.timeout")
    ) -> None:
        self._longest, self._timeout, self._where, self._settings = longest, timeout, where, settings
        self._lock = threading.Lock()
        self._stop = threading.Event()
        self._over: str | None = None
        self._until = 0.0
        self._down_since: float | None = None
        self._silent_since: float | None = None
        self._answered = False
        self._failed = 0

    @property
    def over(self) -> str | None:
        """Why nothing more is sent, or None."""
        return self._over

    def hurry(self) -> None:
        """Ends every wait: somebody pressed Ctrl-C."""
        self._stop.set()

    def calm(self) -> None:
        """Allows waits again."""
        self._stop.clear()

    def ready(self) -> None:
        """Waits until the server may be asked.

        Raises:
            Gone: it makes no sense to.
        """
        while (left := self._until - time.monotonic()) > 0 and self._over is None:
            if self._stop.wait(min(left, 1.0)):
                raise Gone("stopped while waiting for the server")
        if self._over is not None:
            raise Gone(self._over)

    def rest(self, tried: int) -> None:
        """Waits between two tries where the server doesn't say how long, the longer the more there were.

        Raises:
            Gone: it makes no sense to ask again.
        """
        if self._stop.wait(min(_FIRST * 2.0**tried, _LONGEST) * random.uniform(0.75, 1.0)):
            raise Gone("stopped while waiting for the server")
        self.ready()

    def answered(self) -> None:
        """It gave an answer."""
        with self._lock:
            self._answered, self._down_since = True, None
            self._failed = 0

    def heard(self) -> None:
        """It said something, be it an error."""
        with self._lock:
            self._down_since = None

    def failed(self, why: str) -> None:
        """A question ended without an answer."""
        with self._lock:
            self._failed += 1
            if self._failed >= _IN_A_ROW and self._over is None:
                self._over = f"{_IN_A_ROW} questions failed one after the other, none was answered; the last: {why}"

    def asked_to_wait(self, seconds: float) -> None:
        """It asks everybody to wait.

        Raises:
            Gone: for longer than is waited.
        """
        with self._lock:
            if seconds <= self._longest:
                self._until = max(self._until, time.monotonic() + seconds)
                return
            self._over = self._over or (
                f"the server asks to wait {_span(seconds)} (Retry-After), longer than the {_span(self._longest)} of "
                f"{self._settings[0]}; run the same command again then"
            )
            raise Gone(self._over)

    def unreachable(self, since: float, why: str) -> None:
        """No connection came about.

        Args:
            since: when it was begun.
            why: in the system's words.

        Raises:
            Gone: it was tried long enough, by whichever question.
        """
        with self._lock:
            self._down_since = since if self._down_since is None else min(self._down_since, since)
            if time.monotonic() - self._down_since >= _UNREACHABLE:
                self.end(f"the server at {self._where} can't be reached ({why}); is it running?")

    def silent(self, since: float) -> None:
        """It took a question and did not answer in time: it may be loading its model, so a second try is fine.

        Args:
            since: when the question was sent.

        Raises:
            Gone: it never answered anything, for two tries.
        """
        with self._lock:
            self._silent_since = since if self._silent_since is None else min(self._silent_since, since)
            if not self._answered and time.monotonic() - self._silent_since >= _SILENT * self._timeout:
                self.end(
                    f"the server at {self._where} takes questions but answered none within {self._timeout:g} s "
                    f"({self._settings[1]}), twice"
                )

    def end(self, why: str) -> None:
        """Nothing more is sent.

        Raises:
            Gone: always.
        """
        self._over = self._over or why
        raise Gone(self._over)


def retry_after(headers: Mapping[str, str], now: float | None = None) -> float | None:
    """How long a server asks to wait [s]; None where it doesn't say. As RFC 9110, 10.2.3: seconds, or a date.

    Args:
        headers: of its reply, by names in small letters or of any case.
        now: seconds since 1970; the clock's if None.
    """
    for name, unit in (("retry-after-ms", 1e-3), ("retry-after", 1.0)):
        text = str(headers.get(name, "")).strip()
        try:
            seconds = float(text) * unit
        except ValueError:
            continue
        if math.isfinite(seconds) and seconds >= 0:
            return seconds
    moment = email.utils.parsedate_tz(str(headers.get("retry-after", "")))
    if moment is None:
        return None
    try:
        return max(0.0, email.utils.mktime_tz(moment) - (time.time() if now is None else now))
    except (OverflowError, ValueError):
        return None


def resolves(address: str, seconds: float = CONNECT) -> bool:
    """Whether the host of an address has one on the network; a name server that says nothing counts as no.

    The system's own look-up can't be ended and may take half a minute. Behind a proxy the names are the proxy's.

    Args:
        address: of a server.
        seconds: that are waited.
    """
    parts = urlsplit(address)
    host = parts.hostname or ""
    proxies = urllib.request.getproxies()
    if (parts.scheme in proxies or "all" in proxies) and not urllib.request.proxy_bypass(host):
        return True
    found: list[bool] = []

    def look() -> None:
        try:
            found.append(bool(socket.getaddrinfo(host, parts.port or 443, type=socket.SOCK_STREAM)))
        except (OSError, UnicodeError):
            found.append(False)

    thread = threading.Thread(target=look, daemon=True)
    thread.start()
    thread.join(seconds)
    return bool(found and found[0])


def _span(seconds: float) -> str:
    if seconds >= 5400:
        return f"{seconds / 3600:.3g} h"
    return f"{seconds / 60:.3g} min" if seconds >= 120 else f"{seconds:.3g} s"
