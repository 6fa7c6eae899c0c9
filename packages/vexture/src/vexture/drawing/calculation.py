"""CSS math functions: `calc()`, `min()`, `clamp()` and the others (CSS Values 4, 10)."""

import math
from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any, Final, NamedTuple

import tinycss2

NUMBER, PERCENT, LENGTH, ANGLE = "number", "percentage", "length", "angle"

LONGEST: Final = 1_000
"""Longest calculation that is evaluated, in characters."""

CONSTANTS: Final = {"e": math.e, "pi": math.pi, "infinity": math.inf, "-infinity": -math.inf, "nan": math.nan}

INFINITE: Final = 1e9
"""Number written for infinity, which has no notation outside calculations."""

ANGLES: Final = {"deg": 1.0, "grad": 0.9, "rad": 180.0 / math.pi, "turn": 360.0}
"""Degrees of each unit."""


class Quantity(NamedTuple):
    """A number with its kind."""

    value: float
    kind: str  # NUMBER, PERCENT, LENGTH (in user units) or ANGLE (in degrees)


Resolve = Callable[[float, str], Quantity | None]
"""Function that resolves a number and its unit, or "%"; it returns None if the unit is not allowed."""

Function = Callable[[list[Quantity]], Quantity]
"""Function that computes one value from its arguments."""

UNITS: Final = {NUMBER: "", PERCENT: "%", LENGTH: "px", ANGLE: "deg"}

SAMPLES: Final = {kind: f"1{unit}" for kind, unit in UNITS.items()}
"""An example text of each kind."""


class InvalidCalculationError(Exception):
    """The calculation is not valid."""


def calculate(text: str, resolve: Resolve) -> Quantity | None:
    """Evaluate a text that is one math function; return None if it is something else or is not valid.

    Examples
    --------
    >>> calculate("max(3, 2 * (1 + 4))", lambda value, unit: None)
    Quantity(value=10.0, kind='number')
    """
    if "(" not in text or len(text) > LONGEST:
        return None
    tokens = parse_tokens(text.strip())
    if len(tokens) != 1 or tokens[0].type != "function" or tokens[0].lower_name not in MATH:
        return None
    return attempt(tokens[0], resolve)


@lru_cache(maxsize=512)
def parse_tokens(text: str) -> tuple[Any, ...]:
    """Parse a text into tokens; return none if it holds a number that is too long."""
    try:
        return tuple(tinycss2.parse_component_value_list(text, skip_comments=True))
    except ValueError:  # an integer of more than 4,300 digits
        return ()


def sample_calculations(text: str) -> str:
    """Replace each calculation by a constant of the same kind, so that the syntax of the value can be checked.

    Examples
    --------
    >>> sample_calculations("translate(calc(1px + 5%), min(1px, 2px)) rotate(calc(1turn / 3))")
    'translate(1px, 1px) rotate(1deg)'
    """
    return replace_calculations(text, sample)


def reduce_calculations(text: str) -> str:
    """Replace each calculation of numbers, percentages or angles by its result.

    Examples
    --------
    >>> reduce_calculations("rgb(calc(2 * 50) min(7, 8) 0 / calc(50% / 2))")
    'rgb(100.0 7.0 0 / 25.0%)'
    """
    return replace_calculations(text, result)


def replace_calculations(text: str, instead: Callable[[Any], str | None]) -> str:
    """Replace each calculation in a value by the text that `instead` returns, if it returns one."""
    if "(" not in text or len(text) > LONGEST:
        return text
    return "".join(written(token, instead) for token in parse_tokens(text))


def written(token: Any, instead: Callable[[Any], str | None]) -> str:
    """Serialize a token with the replacements of `replace_calculations`."""
    if token.type != "function":
        return str(tinycss2.serialize([token]))
    if token.lower_name not in MATH:
        return f"{token.name}({''.join(written(part, instead) for part in token.arguments)})"
    text = instead(token)
    return str(tinycss2.serialize([token])) if text is None else text


def sample(token: Any) -> str | None:
    """Return the text that `sample_calculations` inserts for a calculation; None if it is not valid."""
    for kind in (PERCENT, LENGTH):
        found = attempt(token, partial(of_kind, percentages=kind))
        if found is not None:
            return SAMPLES[found.kind]
    return None


def result(token: Any) -> str | None:
    """Return the text that `reduce_calculations` inserts for a calculation; None if it is not valid."""
    found = attempt(token, lambda value, unit: Quantity(value, PERCENT) if unit == "%" else None)
    if found is None:
        return None
    value = 0.0 if math.isnan(found.value) else min(max(found.value, -INFINITE), INFINITE)
    return f"{value!r}{UNITS[found.kind]}"


def attempt(token: Any, resolve: Resolve) -> Quantity | None:
    """Evaluate a function; return None if it is not valid."""
    try:
        return evaluate_function(token, resolve)
    except (InvalidCalculationError, OverflowError):
        return None


def of_kind(value: float, unit: str, percentages: str) -> Quantity:
    """Return a quantity whose kind follows from its unit; `percentages` is the kind of percentages."""
    if unit in ANGLES:
        return Quantity(value, ANGLE)
    return Quantity(value, percentages if unit == "%" else LENGTH)


def evaluate_function(token: Any, resolve: Resolve) -> Quantity:
    """Evaluate a math function."""
    name, arguments = token.lower_name, split_arguments(token.arguments)
    if name == "round" and len(arguments) > 1 and (word := keyword(arguments[0])) in ROUNDINGS:
        return round_to(ROUNDINGS[word], [total(part, resolve) for part in arguments[1:]])
    if name == "clamp" and len(arguments) == 3:
        ends = zip(arguments, ("-infinity", "", "infinity"), strict=True)
        parts = [None if keyword(part) == "none" and end else total(part, resolve) for part, end in ends]
        low, middle, high = parts
        assert middle is not None
        bounds = [end for end in (low, high) if end is not None]
        alike([middle, *bounds])
        value = middle.value if high is None else min(middle.value, high.value)
        return Quantity(value if low is None else max(value, low.value), middle.kind)
    found = MATH[name]
    if found is None:
        raise InvalidCalculationError
    return found([total(part, resolve) for part in arguments])


def split_arguments(tokens: list[Any]) -> list[list[Any]]:
    """Split the arguments of a function at the commas."""
    found: list[list[Any]] = [[]]
    for token in tokens:
        if token == ",":
            found.append([])
        else:
            found[-1].append(token)
    return found


def keyword(tokens: list[Any]) -> str:
    """Return the word if the tokens are a single word, or else an empty text."""
    words = [token for token in tokens if token.type != "whitespace"]
    return str(words[0].lower_value) if len(words) == 1 and words[0].type == "ident" else ""


def total(tokens: list[Any], resolve: Resolve) -> Quantity:
    """Evaluate a sum of products. Plus and minus must have spaces around them, or they would be signs."""
    terms: list[list[Any]] = [[]]
    signs = [1.0]
    for at, token in enumerate(tokens):
        if token in ("+", "-"):  # tokens have no hash
            if not (0 < at < len(tokens) - 1 and tokens[at - 1].type == tokens[at + 1].type == "whitespace"):
                raise InvalidCalculationError
            signs.append(1.0 if token == "+" else -1.0)
            terms.append([])
        elif token.type != "whitespace":
            terms[-1].append(token)
    values = [product(term, resolve) for term in terms]
    alike(values)
    return Quantity(sum(sign * one.value for sign, one in zip(signs, values, strict=True)), values[0].kind)


def product(tokens: list[Any], resolve: Resolve) -> Quantity:
    """Evaluate a product of factors and divisors."""
    if len(tokens) % 2 == 0:
        raise InvalidCalculationError
    value, kind = single(tokens[0], resolve)
    for sign, token in zip(tokens[1::2], tokens[2::2], strict=True):
        other = single(token, resolve)
        if sign == "*" and NUMBER in (kind, other.kind):
            value, kind = value * other.value, other.kind if kind == NUMBER else kind
        elif sign == "/" and other.kind in (NUMBER, kind):
            value, kind = divide(value, other.value), kind if other.kind == NUMBER else NUMBER
        else:
            raise InvalidCalculationError
    return Quantity(value, kind)


def divide(a: float, b: float) -> float:
    """Return the quotient, infinite if the divisor is zero."""
    if b == 0.0:
        return math.nan if a == 0.0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1.0, b)
    return a / b


def single(token: Any, resolve: Resolve) -> Quantity:
    """Evaluate one token."""
    found: Quantity | None = None
    if token.type == "number":
        found = Quantity(token.value, NUMBER)
    elif token.type == "percentage":
        found = resolve(token.value, "%")
    elif token.type == "dimension":
        unit = token.lower_unit
        found = resolve(token.value, unit) if unit not in ANGLES else Quantity(token.value * ANGLES[unit], ANGLE)
    elif token.type == "ident" and token.lower_value in CONSTANTS:
        found = Quantity(CONSTANTS[token.lower_value], NUMBER)
    elif token.type == "() block":
        found = total(token.content, resolve)
    elif token.type == "function" and token.lower_name in MATH:
        found = evaluate_function(token, resolve)
    if found is None:
        raise InvalidCalculationError
    return found


def alike(values: list[Quantity]) -> str:
    """Return the kind that all values share; raise an error if they differ."""
    kinds = {one.kind for one in values}
    if len(kinds) != 1:
        raise InvalidCalculationError
    return kinds.pop()


def same(function: Callable[..., float], least: int = 1, most: int | None = None) -> Function:
    """Make a math function whose arguments and result are of one kind."""

    def evaluate(values: list[Quantity]) -> Quantity:
        if not least <= len(values) <= (most or len(values)):
            raise InvalidCalculationError
        return Quantity(finite(function, *(one.value for one in values)), alike(values))

    return evaluate


def plain(function: Callable[..., float], least: int = 1, most: int = 1) -> Function:
    """Make a math function of numbers that returns a number."""

    def evaluate(values: list[Quantity]) -> Quantity:
        found = same(function, least, most)(values)
        if found.kind != NUMBER:
            raise InvalidCalculationError
        return found

    return evaluate


def function_of_angle(function: Callable[[float], float]) -> Function:
    """Make a math function of one angle; a number counts as radians."""

    def evaluate(values: list[Quantity]) -> Quantity:
        if len(values) != 1 or values[0].kind not in (NUMBER, ANGLE):
            raise InvalidCalculationError
        value, kind = values[0]
        return Quantity(finite(function, math.radians(value) if kind == ANGLE else value), NUMBER)

    return evaluate


def to_angle(function: Callable[..., float], count: int = 1) -> Function:
    """Make a math function that returns an angle."""

    def evaluate(values: list[Quantity]) -> Quantity:
        if count == 1 and values[0].kind != NUMBER:
            raise InvalidCalculationError
        return Quantity(math.degrees(same(function, count, count)(values).value), ANGLE)

    return evaluate


def finite(function: Callable[..., float], *values: float) -> float:
    """Evaluate a function; return NaN where it is undefined."""
    try:
        return float(function(*values))
    except (ValueError, ZeroDivisionError):
        return math.nan


ROUNDINGS: Final[dict[str, Callable[[float], float]]] = {
    "nearest": lambda value: math.floor(value + 0.5),
    "up": math.ceil,
    "down": math.floor,
    "to-zero": math.trunc,
}


def round_to(rule: Callable[[float], float], values: list[Quantity]) -> Quantity:
    """Round a value to a multiple of another value, by default of 1."""
    if len(values) == 1 and values[0].kind == NUMBER:
        values = [*values, Quantity(1.0, NUMBER)]
    return same(lambda value, step: rule(value / step) * step, 2, 2)(values)


MATH: Final[dict[str, Function | None]] = {
    "calc": same(lambda value: value, 1, 1),
    "-webkit-calc": same(lambda value: value, 1, 1),
    "min": same(lambda *values: min(values)),
    "max": same(lambda *values: max(values)),
    "clamp": None,
    "round": lambda values: round_to(ROUNDINGS["nearest"], values),
    "mod": same(lambda a, b: a % b, 2, 2),
    "rem": same(math.fmod, 2, 2),
    "abs": same(abs, 1, 1),
    "sign": lambda values: Quantity(math.copysign(1.0, values[0].value) if values[0].value else 0.0, NUMBER),
    "hypot": same(math.hypot),
    "sqrt": plain(math.sqrt),
    "exp": plain(math.exp),
    "log": plain(math.log, 1, 2),
    "pow": plain(math.pow, 2, 2),
    "sin": function_of_angle(math.sin),
    "cos": function_of_angle(math.cos),
    "tan": function_of_angle(math.tan),
    "asin": to_angle(math.asin),
    "acos": to_angle(math.acos),
    "atan": to_angle(math.atan),
    "atan2": to_angle(math.atan2, 2),
}
"""Math functions of a list of arguments; `evaluate_function` itself handles `clamp`."""
