"""Custom properties of CSS, `--x`, and references to them, `var(--x)` (CSS Variables 1)."""

from collections.abc import Callable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from typing import Any, Final

import tinycss2

from vexture.base.deadline import check_time

LONGEST: Final = 100_000
"""Longest value in characters. Longer results are not valid, so that references cannot multiply (a bomb)."""

APART = ("whitespace", "literal")
"""Tokens that separate the text next to them."""

BRACKETS: Final = {"() block": ("(", ")"), "[] block": ("[", "]"), "{} block": ("{", "}")}

Get = Callable[[str], str | None]
"""Function that returns the value of a custom property, or None."""


class UnknownError(Exception):
    """A reference has no value."""


def refers(value: str) -> bool:
    """Return whether a value may refer to a custom property."""
    return "(" in value and "var(" in value.lower()


def substitute(value: str, get: Get) -> str | None:
    """Replace the references in a value by their values or fallbacks; None if one has neither.

    Examples
    --------
    >>> substitute("1px solid var(--edge, var(--ink))", {"--ink": "#123"}.get)
    '1px solid #123'
    """
    try:
        return fill_references(parse_tokens(value), get).strip()
    except UnknownError:
        return None


def unknown(value: str, get: Get) -> list[str]:
    """Return the names of custom properties without value and fallback that make a value invalid.

    Examples
    --------
    >>> unknown("var(--edge, 1px) solid color-mix(in srgb, var(--ink), var(--paper, red))", {}.get)
    ['--ink']
    """
    try:
        return list(dict.fromkeys(unknown_in(parse_tokens(value), get)))
    except UnknownError:
        return []


def unknown_in(tokens: list[Any], get: Get) -> Iterator[str]:
    """Yield the names that `unknown` returns."""
    for token in tokens:
        if token.type == "function" and token.lower_name == "var":
            name, fallback = reference(token)
            if get(name) is None:
                yield from [name] if fallback is None else unknown_in(fallback, get)
        else:
            yield from unknown_in(getattr(token, "arguments", None) or getattr(token, "content", None) or [], get)


def parse_tokens(value: str) -> list[Any]:
    """Parse a value into tokens."""
    try:
        return list(tinycss2.parse_component_value_list(value, skip_comments=True))
    except ValueError:  # an integer of more than 4,300 digits
        raise UnknownError from None


def fill_references(tokens: list[Any], get: Get) -> str:
    """Return the text of tokens, with all references replaced."""
    found, length = list[str](), 0
    before = None
    for token in tokens:
        is_reference = token.type == "function" and token.lower_name == "var"
        text = replacement(token, get) if is_reference else inside(token, get)
        if before is not None and (is_reference or before[1]) and token.type not in APART and before[0] not in APART:
            found.append("/**/")
        before = token.type, is_reference
        found.append(text)
        length += len(text)
        if length > LONGEST:
            raise UnknownError
    return "".join(found)


def inside(token: Any, get: Get) -> str:
    """Return the text of a token that is not a reference itself."""
    if token.type == "function":
        return f"{tinycss2.serialize([token]).partition('(')[0]}({fill_references(token.arguments, get)})"
    if token.type in BRACKETS:
        opening, closing = BRACKETS[token.type]
        return f"{opening}{fill_references(token.content, get)}{closing}"
    return str(tinycss2.serialize([token]))


def replacement(token: Any, get: Get) -> str:
    """Return the text that replaces a reference."""
    name, fallback = reference(token)
    value = get(name)
    if value is not None:
        return value
    if fallback is None:
        raise UnknownError
    return fill_references(fallback, get).strip()


def reference(token: Any) -> tuple[str, list[Any] | None]:
    """Return the name and the fallback of a reference."""
    arguments = list(token.arguments)
    words = [part for part in arguments if part.type != "whitespace"]
    comma = next((at for at, part in enumerate(arguments) if part == ","), None)
    before = words if comma is None else [part for part in arguments[:comma] if part.type != "whitespace"]
    if len(before) != 1 or before[0].type != "ident" or not before[0].value.startswith("--"):
        raise UnknownError
    return before[0].value, None if comma is None else arguments[comma + 1 :]


def names_in(tokens: list[Any]) -> Iterator[str]:
    """Yield the names that tokens refer to, including those in fallbacks."""
    for token in tokens:
        if token.type == "function" and token.lower_name == "var":
            yield reference(token)[0]
        yield from names_in(getattr(token, "arguments", None) or getattr(token, "content", None) or [])


def compute_variables(values: Mapping[str, str], inherited: Mapping[str, str]) -> dict[str, str]:
    """Return the custom properties of an element: its own, unparsed, and those that it inherits.

    A property has no value if it refers to itself, even through others, or to a property without a value.

    Examples
    --------
    >>> compute_variables({"--a": "var(--b) 1px", "--c": "var(--d, 1)", "--d": "var(--c)"}, {"--b": "red"})
    {'--b': 'red', '--a': 'red 1px'}
    """
    found = {**inherited}
    declared = dict[str, str]()
    for name, value in values.items():
        keyword = value.lower()
        if keyword == "initial":
            found.pop(name, None)
        elif keyword not in ("inherit", "unset", "revert", "revert-layer"):
            found.pop(name, None)
            declared[name] = value
    edges = {name: edges_of(value) for name, value in declared.items()}
    for name in dependency_order({name: names & declared.keys() for name, names in edges.items() if names is not None}):
        text = substitute(declared[name], found.get) if refers(declared[name]) else declared[name]
        if text is not None:
            found[name] = text
    return found


def edges_of(value: str) -> set[str] | None:
    """Return the names that a value refers to; None if it is not valid."""
    try:
        return set(names_in(parse_tokens(value))) if refers(value) else set()
    except UnknownError:
        return None


def dependency_order(edges: dict[str, set[str]]) -> Iterator[str]:
    """Yield names after those that they refer to, without those that refer to themselves."""
    lost = set[str]()
    while True:
        check_time()
        try:
            order = list(TopologicalSorter(edges).static_order())
        except CycleError as error:
            cycle = error.args[1]  # each name is before the next; the last equals the first
            lost.update(cycle)
            edges[cycle[1]].discard(cycle[0])
            continue
        return iter([name for name in order if name not in lost])
