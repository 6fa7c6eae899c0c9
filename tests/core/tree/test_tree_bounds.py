"""Limits of a tree, from the parameters of a conversion."""

import pytest

from vexture.base.deadline import within
from vexture.base.errors import LimitError, ParameterError
from vexture.tree.bounds import bounds_of, check_growth


@pytest.mark.parametrize(("precision", "depth"), [(2.0 / 32768, 1), (1.0 / 32768, 1), (2.0**-18, 4), (2.0**-18.5, 5)])
def test_leaves_are_as_deep_as_a_precision_asks(precision: float, depth: int) -> None:
    """A point of a leaf at depth d moves by 2 units of its lattice, of 2^-15 of the leaf."""
    found = bounds_of(0.0, 16, 8, precision, 1000)
    assert found.least_depth == depth
    assert 2.0 * 2.0 ** -(15 + depth) <= precision
    assert found.near == 0.25 * precision


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"capacity": 0}, "`capacity` 0 is no whole number in 1..15"),
        ({"capacity": True}, "`capacity` True is no whole number"),
        ({"max_depth": 2.0}, "`max_depth` 2.0 is no whole number"),
        ({"tolerance": 1.0}, "`tolerance` 1.0 is no number from 0 to below 1"),
        ({"tolerance": float("nan")}, "`tolerance` nan is no number"),
        ({"precision": 1e-12}, "`precision` 1e-12 is no number in 9.3e-10..1"),
        ({"precision": "x"}, "`precision` 'x' is no number"),
    ],
)
def test_what_is_out_of_range_is_named(changed: dict, message: str) -> None:
    given = {"tolerance": 0.0, "max_depth": 16, "capacity": 8, "precision": None, "most_quads": 10} | changed
    with pytest.raises(ParameterError) as refused:
        bounds_of(**given)
    assert str(refused.value).startswith(message)


def test_growth_ends_at_its_limits() -> None:
    check_growth(10, 10, "x")
    with pytest.raises(LimitError, match=r"^x: 11 quads at least; the limit is 10; use a smaller `max_depth`"):
        check_growth(11, 10, "x")
    with within(1e-9), pytest.raises(LimitError, match=r"^x: .*takes longer than"):
        check_growth(1, 10, "x")
