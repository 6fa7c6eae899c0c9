"""Times in texts rise, or are none."""

from datetime import UTC, datetime, timedelta

import pytest

from vexture_geo.base.time_texts import rising_moments


def test_times_without_a_zone_are_in_utc_and_others_keep_theirs():
    first, second = rising_moments([" 2026-01-02T00:30 ", "2026-01-02T02:00+01:00"])
    assert first == datetime(2026, 1, 2, 0, 30, tzinfo=UTC)
    assert second == datetime(2026, 1, 2, 1, tzinfo=UTC)
    assert second.utcoffset() == timedelta(hours=1)


@pytest.mark.parametrize(
    "texts",
    [
        ["2026-01-02", "2026-01-02"],
        ["2026-01-03", "2026-01-02"],
        ["2026-01-02T02:00+02:00", "2026-01-02T00:00Z"],
        ["2026-01-02", "noon"],
    ],
)
def test_times_that_do_not_rise_are_none(texts):
    assert rising_moments(texts) is None
