"""The picture of conversions has a mark for every value, at that value."""

import pytest
from fitting import assert_legible

from vexture_evidence.figures.conversions import conversions


def test_every_value_has_its_mark():
    quantities = {
        "bytes": {"printed": [1462, 2496, 10], "packed": [1092, None, 12]},
        "milliseconds": {"packed": [0.1, 20.0, None]},
    }
    figure = conversions(["duck", "cake", "a long name of a drawing"], quantities)
    assert_legible(figure)
    for axes, methods in zip(figure.axes, quantities.values(), strict=True):
        marks = {line.get_label(): list(zip(*line.get_data(), strict=True)) for line in axes.lines}
        assert marks == {
            method: [(value, row) for row, value in enumerate(values) if value is not None]
            for method, values in methods.items()
        }
        low, high = axes.get_xlim()
        assert all(low < x < high for points in marks.values() for x, _ in points)


@pytest.mark.parametrize("values", [[], [None, None]])
def test_nothing_to_show_is_shown(values):
    assert_legible(conversions([str(k) for k in range(len(values))], {"curves": {"packed": values}}))
