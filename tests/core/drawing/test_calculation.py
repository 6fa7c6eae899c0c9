"""Calculations of CSS: against Python's arithmetic, and those that are not valid."""

import math
import random

import pytest

from vexture.drawing.calculation import (
    ANGLE,
    LENGTH,
    NUMBER,
    PERCENT,
    Quantity,
    calculate,
    reduce_calculations,
    sample_calculations,
)


def pixels(value: float, unit: str) -> Quantity | None:
    """Pixels and inches are lengths; percentages are of 200 pixels."""
    factor = {"px": 1.0, "in": 96.0, "%": 2.0}.get(unit)
    return None if factor is None else Quantity(value * factor, LENGTH)


def random_sum(source: random.Random, depth: int) -> str:
    """Numbers, sums, products and brackets, as both CSS and Python write them."""
    if depth == 0:
        return str(source.randint(1, 9))
    left, right = random_sum(source, depth - 1), random_sum(source, depth - 1)
    quotient = f"({left} / {source.randint(2, 9)})"
    return source.choice([f"({left} + {right})", f"({left} - {right})", f"{left} * {right}", quotient])


@pytest.mark.parametrize("seed", range(20))
def test_arithmetic_is_that_of_python(seed: int) -> None:
    text = random_sum(random.Random(seed), 4)
    expected = eval(text)  # of digits and operators that are made here
    found = calculate(f"calc({text})", pixels)
    assert found is not None
    assert found.kind == NUMBER
    assert found.value == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "value", "kind"),
    [
        ("calc(1in + 50%)", 196.0, LENGTH),
        ("calc(2 * 3px - 1px / 2)", 5.5, LENGTH),
        ("calc(6px / 2px)", 3.0, NUMBER),
        ("calc(1 - -2)", 3.0, NUMBER),
        ("calc(0.25turn + 10deg)", 100.0, ANGLE),
        ("clamp(10px, 5%, 30px)", 10.0, LENGTH),
        ("clamp(none, 90px, 30px)", 30.0, LENGTH),
        ("clamp(9, 5, 3)", 9.0, NUMBER),  # the lower bound wins
        ("mod(-7, 3)", 2.0, NUMBER),
        ("rem(-7, 3)", -1.0, NUMBER),
        ("round(2.5)", 3.0, NUMBER),
        ("round(-2.5)", -2.0, NUMBER),
        ("round(to-zero, -17px, 5px)", -15.0, LENGTH),
        ("round(up, 11, 5)", 15.0, NUMBER),
        ("hypot(3px, 4px)", 5.0, LENGTH),
        ("sin(30deg)", 0.5, NUMBER),
        ("cos(pi)", -1.0, NUMBER),
        ("atan2(1px, 1px)", 45.0, ANGLE),
        ("log(8, 2)", 3.0, NUMBER),
        ("sign(-3px)", -1.0, NUMBER),
        ("calc(1 / 0)", math.inf, NUMBER),
    ],
)
def test_functions_of_the_standard(text: str, value: float, kind: str) -> None:
    found = calculate(text, pixels)
    assert found is not None
    assert found.kind == kind
    assert found.value == pytest.approx(value)


@pytest.mark.parametrize(
    "text",
    [
        *("3px", "calc()", "calc(1 +2)", "calc(1+ 2)", "calc(1px + 1)", "calc(2px * 3px)", "calc(1 / 2px)"),
        *("calc(1deg + 1px)", "calc(1 2)", "calc(1 * )", "calc(3kg)", "sqrt(4px)", "pow(2)", "clamp(1, 2)", "nope(1)"),
        *("min()", "calc(1) calc(2)", f"calc({'9' * 5000})", f"calc(1{' + 1' * 400})"),
    ],
)
def test_what_is_not_valid_has_no_value(text: str) -> None:
    assert calculate(text, pixels) is None


def test_values_keep_all_but_their_calculations() -> None:
    assert reduce_calculations("rgb(calc(1 + 2) 0 0 / min(40%, 30%))") == "rgb(3.0 0 0 / 30.0%)"
    assert reduce_calculations("calc(1px + 2) solid") == "calc(1px + 2) solid"
    assert reduce_calculations("calc(1 / 0) calc(0 / 0)") == "1000000000.0 0.0"
    assert sample_calculations("scale(calc(1 + 2)) skew(calc(1rad * 2))") == "scale(1) skew(1deg)"
    assert sample_calculations("calc(20% + 1%) min(1px, 2%)") == "1% 1px"


def test_percentages_are_what_the_caller_says() -> None:
    assert calculate("calc(10% * 2)", lambda value, unit: Quantity(value, PERCENT)) == (20.0, PERCENT)
    assert calculate("calc(10% * 2)", pixels) == (40.0, LENGTH)
    assert calculate("calc(10% * 2)", lambda value, unit: None) is None
