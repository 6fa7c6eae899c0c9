"""Times that files write as text."""

from collections.abc import Iterable
from datetime import UTC, datetime
from itertools import pairwise


def rising_moments(texts: Iterable[str]) -> tuple[datetime, ...] | None:
    """Parse ISO 8601 times, in UTC if they name no zone; None if one is no time, or not later than the one before.

    Examples
    --------
    >>> rising_moments(["2026-01-02", "2026-01-02 06:00"])[1].isoformat()
    '2026-01-02T06:00:00+00:00'
    >>> rising_moments(["2026-01-02", "the day after"])
    """
    try:
        read = [datetime.fromisoformat(text.strip()) for text in texts]
    except ValueError:
        return None
    found = tuple(time if time.tzinfo else time.replace(tzinfo=UTC) for time in read)
    return found if all(a < b for a, b in pairwise(found)) else None
