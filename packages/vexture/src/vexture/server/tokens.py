"""The token that authorizes uploads, and the rate limit of wrong tokens."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from vexture.base.errors import DeviceError, LimitError
from vexture.server.limits import Pace

SHORTEST_TOKEN: Final = 16
LONGEST_TOKEN: Final = 4096

WRONG_FROM_ONE: Final = (0.1, 5)
WRONG_FROM_ALL: Final = (1.0, 100)
"""Limits on wrong tokens, as a rate per second and a burst: from one address, and from all addresses together."""


def read_token(path: Path) -> str:
    """Read the token from a file, without surrounding white space."""
    try:
        with path.open("rb") as file:
            content = file.read(LONGEST_TOKEN + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise DeviceError(f"{path}: cannot be read ({reason}); name the file that holds the token") from None
    token = content.strip().decode("latin-1")
    if not SHORTEST_TOKEN <= len(token) <= LONGEST_TOKEN or not all("!" <= letter <= "~" for letter in token):
        raise LimitError(
            f"{path}: the token has {len(token)} characters; it must be {SHORTEST_TOKEN} to {LONGEST_TOKEN} of ASCII "
            "without spaces; make one with: openssl rand -hex 32"
        )
    return token


class WrongTokens:
    """Rate limit of wrong tokens; a client with the right one never waits, even if it shares its address.

    Examples
    --------
    >>> wrong = WrongTokens(clock=lambda: 0.0)
    >>> [wrong.wait("a") > 0.0 for _ in range(6)], wrong.wait("b")
    ([False, False, False, False, False, True], 0.0)
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._each, self._all = Pace(*WRONG_FROM_ONE, clock), Pace(*WRONG_FROM_ALL, clock)

    def wait(self, address: str) -> float:
        """Count a wrong token from an address; return the seconds until the next one may be answered as usual, or 0."""
        return max(self._each.wait(address), self._all.wait(""))
