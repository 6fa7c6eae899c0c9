"""Limits on the input of a server: sizes, times and rates."""

import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from vexture.base.errors import ParameterError

MOST_KNOWN: Final = 10_000
"""Number of addresses whose rate is stored; the one that was silent longest is dropped first."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of a server; refusals name the limit."""

    max_bytes: int = 16 * 2**20  # for one upload
    max_total: int = 2**30  # bytes of all files of all shapes
    max_shapes: int = 10_000
    rate: float = 10.0  # uploads a second from one address
    burst: int = 20  # uploads at once from one address after a pause
    texture_bytes: int = 64 * 2**20  # for one texture in memory
    upload_seconds: float = 60.0
    conversion_seconds: float = 60.0
    conversions: int = 16  # running or waiting
    connections: int = 2000  # fewer if the system allows fewer open files
    head_seconds: float = 15.0  # from the connection or the previous answer to the complete head of a request
    stall_seconds: float = 60.0  # for a client to read the buffered part of an answer, about 128 kB

    def __post_init__(self) -> None:
        for name in self.__slots__:
            value = getattr(self, name)
            if not value > 0:
                raise ParameterError(f"`{name}` is {value:g}; it must be above 0")


class Pace:
    """Limits the rate of each address by a bucket of `burst` tokens, which is refilled at `rate` tokens a second.

    Examples
    --------
    >>> pace = Pace(rate=2.0, burst=1, clock=lambda: 0.0)
    >>> pace.wait("a"), pace.wait("a"), pace.wait("b")
    (0.0, 0.5, 0.0)
    """

    def __init__(self, rate: float, burst: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate, self._burst, self._clock = rate, burst, clock
        self._buckets: OrderedDict[str, tuple[float, float]] = OrderedDict()

    def wait(self, address: str) -> float:
        """Take a token and return 0, or return the seconds until there is one."""
        now = self._clock()
        tokens, before = self._buckets.pop(address, (float(self._burst), now))
        tokens = min(tokens + (now - before) * self._rate, self._burst)
        taken = tokens >= 1.0
        self._buckets[address] = (tokens - taken, now)
        if len(self._buckets) > MOST_KNOWN:
            self._buckets.popitem(last=False)
        return 0.0 if taken else (1.0 - tokens) / self._rate
