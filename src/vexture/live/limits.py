"""What a server takes from those who publish, and how often."""

import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from vexture.errors import LimitError

__all__ = ["Limits", "Pace"]

MOST_KNOWN: Final = 10_000
"""Publishers whose pace is remembered; the one that was silent for longest is forgotten first."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of a server, each of which it names when it refuses.

    Parameters
    ----------
    body_bytes : int
        Of one upload.
    texture_bytes : int
        Of the texture that a drawing becomes, in memory.
    body_seconds : float
        For an upload to arrive.
    conversion_seconds : float
        For a drawing to become a texture.
    conversions : int
        How many may run or wait.
    rate : float
        Uploads a second, for each address.
    burst : int
        Uploads at once after a pause.
    shapes : int
        How many may be published.
    total_bytes : int
        Of all files of all shapes.

    Raises
    ------
    LimitError
        If one of them is not above 0.
    """

    body_bytes: int = 16 * 2**20
    texture_bytes: int = 64 * 2**20
    body_seconds: float = 60.0
    conversion_seconds: float = 60.0
    conversions: int = 16
    rate: float = 10.0
    burst: int = 20
    shapes: int = 10_000
    total_bytes: int = 2**30

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if not value > 0:
                raise LimitError(f"the limit {name.replace('_', ' ')} is {value:g}; it must be above 0")


class Pace:
    """How often each publisher may do a thing: a bucket of tokens that fills at a rate.

    Parameters
    ----------
    rate : float
        Tokens a second.
    burst : int
        Tokens in a full bucket.
    clock : callable
        Seconds.

    Examples
    --------
    >>> pace = Pace(rate=2.0, burst=1, clock=lambda: 0.0)
    >>> pace.wait("a"), pace.wait("a"), pace.wait("b")
    (0.0, 0.5, 0.0)
    """

    def __init__(self, rate: float, burst: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._buckets: OrderedDict[str, tuple[float, float]] = OrderedDict()

    def wait(self, who: str) -> float:
        """Take a token; 0 if there was one, else the seconds until there is."""
        now = self._clock()
        tokens, before = self._buckets.pop(who, (float(self._burst), now))
        tokens = min(tokens + (now - before) * self._rate, self._burst)
        taken = tokens >= 1.0
        self._buckets[who] = (tokens - taken, now)
        if len(self._buckets) > MOST_KNOWN:
            self._buckets.popitem(last=False)
        return 0.0 if taken else (1.0 - tokens) / self._rate
