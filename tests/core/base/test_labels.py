"""Values as texts by which features, times and categories are known."""

from datetime import datetime

import numpy as np

from vexture.base.labels import texts_of


def test_days_have_no_time_unless_one_of_them_has():
    days = [datetime(2024, 1, 31), datetime(2024, 2, 1)]
    assert texts_of([*days, None]) == ["2024-01-31", "2024-02-01", None]
    assert texts_of([*days, datetime(2024, 2, 1, 6)])[0] == "2024-01-31 00:00:00"


def test_whole_numbers_of_any_type_are_one_text():
    assert texts_of([11, 11.0, np.float32(11), np.int64(11), "11"]) == ["11"] * 5
    assert texts_of([0.1, float("inf"), np.nan, True]) == ["0.1", "inf", None, "True"]
