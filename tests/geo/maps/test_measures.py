"""Legends: thousands are marked, years are not, and dates and times have classes of their own."""

import datetime as dt
import json

import numpy as np
import pyarrow as pa
import pytest

from vexture.base.errors import ParameterError
from vexture.base.notes import Notes
from vexture_geo.maps import Scale
from vexture_geo.maps.colours import check_scale, colours_of

DAYS = [dt.date(2020, 1, 1) + dt.timedelta(days=10 * day) for day in range(20)]
TIMES = [dt.datetime(2020, 3, 28, 12, 30) + dt.timedelta(hours=7 * hour) for hour in range(20)]


def legend(values, kind="auto", **options):
    """The legend of a column; whatever it has is JSON."""
    column = values if isinstance(values, pa.Array) else pa.array(values)
    _, found = colours_of(pa.table({"v": column}), Scale("v", kind, **options), Notes())
    return json.loads(json.dumps(found))


def labels(values, kind="auto", **options):
    return [entry["label"] for entry in legend(values, kind, **options)["entries"]]


@pytest.mark.parametrize(
    ("values", "kind", "wanted"),
    [
        ([10, 39056177, 1397715000], "39056177", ["10 – 39,056,177", "39,056,177 – 1,397,715,000"]),
        ([39056176, 39056177, 1397715000, 1397715000], "quantiles", ["39,056,176", "39,056,177 – 1,397,714,999"]),
        ([1990, 2000, 2024], "2000", ["1990 – 2000", "2000 – 2024"]),
        ([1500.5, 20000.25], "2000", ["1,500.5 – 2,000", "2,000 – 20,000.2"]),
        ([-20000, -1500, 0], "-1500", ["-20,000 – -1,500", "-1,500 – 0"]),
        ([9999, 10000], "continuous", ["9,999", "10,000"]),
        ([36061, 36005], "categories", ["36005", "36061"]),
    ],
)
def test_thousands_are_marked_where_a_number_has_five_digits(values, kind, wanted):
    found = labels(values, kind, classes=2) if kind != "quantiles" else labels(values, kind, classes=3)[: len(wanted)]
    assert found == wanted


@pytest.mark.parametrize("kind", [pa.date32(), pa.timestamp("us"), pa.timestamp("ns", "UTC")])
def test_dates_have_classes_of_days(kind):
    days = pa.array([*DAYS, None], pa.date32()).cast(pa.timestamp("us") if kind != pa.date32() else kind).cast(kind)
    found = legend(days, classes=2)
    assert found["scale"] == "quantiles"
    assert [entry["label"] for entry in found["entries"]] == ["2020-01-01 – 2020-04-04", "2020-04-05 – 2020-07-09"]
    assert [entry["count"] for entry in found["entries"]] == [10, 10]
    assert (found["entries"][1]["from"], found["no_data"]["count"]) == ("2020-04-05", 1)
    assert labels(days, "2020-02-01,2020-06-15T12:00") == [
        *("2020-01-01 – 2020-02-01", "2020-02-01 – 2020-06-16", "2020-06-16 – 2020-07-09"),
    ]
    ramp = labels(days, "continuous")
    assert (ramp[0], ramp[-1], len(ramp)) == ("2020-01-01", "2020-07-09", 9)


def test_times_are_told_to_the_minute_or_the_second():
    halves = ["2020-03-28 12:30 – 2020-03-31 06:59", "2020-03-31 07:00 – 2020-04-03 01:30"]
    assert labels(TIMES, "equal", classes=2) == halves
    assert labels(TIMES, "2020-04-01") == ["2020-03-28 12:30 – 2020-04-01 00:00", "2020-04-01 00:00 – 2020-04-03 01:30"]
    later = [time + dt.timedelta(seconds=7.5) for time in TIMES]
    assert labels(later, "equal", classes=2)[1] == "2020-03-31 07:00:07 – 2020-04-03 01:30:07"


def test_times_of_a_zone_are_those_of_its_clocks():
    times = pa.array(TIMES, pa.timestamp("us", "Europe/Amsterdam"))
    assert labels(times, "2020-04-01")[0] == "2020-03-28 13:30 – 2020-04-01 00:00"


def test_few_dates_are_categories():
    assert legend([DAYS[0], DAYS[1], DAYS[0]])["scale"] == "categories"
    assert labels([DAYS[0], DAYS[1], DAYS[0]]) == ["2020-01-01", "2020-01-11"]
    assert legend(DAYS[:6])["scale"] == "quantiles"


def test_no_dates_and_dates_of_long_ago():
    assert legend(pa.nulls(3, pa.date32()))["no_data"]["count"] == 3
    old = [dt.date(1066, 10, 14), dt.date(1815, 6, 18)]
    assert labels(old, "1500-01-01") == ["1066-10-14 – 1500-01-01", "1500-01-01 – 1815-06-18"]


@pytest.mark.parametrize(
    ("values", "kind"), [([1.0, 2.0], "2001-01-01,2011-01-01"), (DAYS, "10,20"), (DAYS, "2020-02-01,2020-01-01")]
)
def test_breaks_are_of_what_the_column_holds(values, kind):
    with pytest.raises(ParameterError, match=r"`scale` is .* rising breaks such as 10,20,50 or 2001-01-01,2011-01-01"):
        labels(values, kind)


def test_breaks_of_dates_may_be_asked_for_before_there_is_a_column():
    check_scale(Scale("v", "2001-01-01,2011-01-01"))
    check_scale(Scale("v", "-5,10"))
    for wrong in ("2001-01-01,1999-01-01", "tens", "3,1"):
        with pytest.raises(ParameterError, match="`scale` is"):
            check_scale(Scale("v", wrong))


def test_features_keep_the_colour_of_their_class():
    table = pa.table({"v": pa.array(DAYS)})
    rgba, found = colours_of(table, Scale("v", "2020-04-01"), Notes())
    first = np.array([day < dt.date(2020, 4, 1) for day in DAYS])
    assert (rgba[first] == rgba[0]).all()
    assert (rgba[~first] == rgba[-1]).all()
    assert [entry["count"] for entry in found["entries"]] == [first.sum(), (~first).sum()]
