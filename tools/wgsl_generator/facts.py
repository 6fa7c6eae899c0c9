"""What a text says of its names: types of globals, forms of functions, and what each of these reads and changes."""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any, Final, TypeAlias

from vexture.renderers.shader import ShaderError
from wgsl_generator.kinds import TEXTURES
from wgsl_generator.syntax import (
    FRAGMENT,
    Assign,
    Call,
    Conditional,
    Constant,
    Declare,
    Default,
    Define,
    Field,
    Function,
    Name,
    Parameter,
    Step,
    Struct,
    Top,
    Uniform,
)

LONGER: Final = "From"
"""Ends the name of that of a function's two forms that is given more, since WGSL has one function of a name."""

Assumed: TypeAlias = tuple[tuple[str, bool], ...]
"""Conditions above a place in the text, and whether they hold there."""


@dataclass(frozen=True, slots=True)
class Form:
    """A function: its name in WGSL, what it returns and is given, and the uniforms that it and those it calls read."""

    name: str
    returns: str
    parameters: tuple[Parameter, ...]
    reads: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Facts:
    """Types by name; functions by name and number of parameters; structures as fields, each with where it is there."""

    uniforms: dict[str, str] = field(default_factory=lambda: {FRAGMENT: "vec4"})
    values: dict[str, str] = field(default_factory=dict)
    structures: dict[str, tuple[tuple[Field, Assumed], ...]] = field(default_factory=dict)
    forms: dict[tuple[str, int], Form] = field(default_factory=dict)


def walk(node: Any) -> Iterator[Any]:
    """A node and all below it."""
    if isinstance(node, tuple):
        for one in node:
            yield from walk(one)
    elif is_dataclass(node):
        yield node
        for one in fields(node):
            value = getattr(node, one.name)
            if isinstance(value, tuple) or is_dataclass(value):
                yield from walk(value)


def assumed_in(conditional: Conditional, above: Assumed = ()) -> Iterator[tuple[Any, Assumed]]:
    """Yield each item of the branches, and the conditions that hold there."""
    for branch in conditional.branches:
        here = (*above, (branch.condition, True)) if branch.condition else above
        for one in branch.body:
            yield one, here
        above = (*above, (branch.condition or "", False))


def flatten(tree: Iterable[Any], above: Assumed = ()) -> Iterator[tuple[Any, Assumed]]:
    """Yield all items of a list, in branches or not, and the conditions that hold there."""
    for one in tree:
        if isinstance(one, Conditional):
            for inner, here in assumed_in(one, above):
                yield from flatten((inner,), here)
        else:
            yield one, above


def root_of(target: Any) -> str:
    """The variable of which a target is a part."""
    while not isinstance(target, Name):
        if not hasattr(target, "value"):
            raise ShaderError(target.line, "only a variable, or a part of one, can be changed")
        target = target.value
    return target.text


def changed_in(function: Function, forms: dict[tuple[str, int], Form]) -> set[str]:
    """Variables that a function changes after they are declared."""
    found = set()
    for node in walk(function.body):
        if isinstance(node, Assign | Step):
            found.add(root_of(node.target))
        elif isinstance(node, Call) and (node.name, len(node.given)) in forms:
            parameters = forms[node.name, len(node.given)].parameters
            found |= {root_of(one) for one, to in zip(node.given, parameters, strict=True) if to.is_inout}
    return found


def read_in(function: Function, facts: Facts) -> tuple[str, ...]:
    """Uniforms that a function reads, itself or by those that it calls, in the order of their declarations."""
    own = {parameter.name for parameter in function.parameters}
    found = set()
    for node in walk(function.body):
        if isinstance(node, Declare):
            own.add(node.name)
        elif isinstance(node, Name):
            found.add(node.text)
        elif isinstance(node, Call) and (node.name, len(node.given)) in facts.forms:
            found |= {f"{name} " for name in facts.forms[node.name, len(node.given)].reads}  # whatever is local here
    return tuple(name for name in facts.uniforms if (name in found and name not in own) or f"{name} " in found)


def facts_of(tree: tuple[Top | Conditional, ...]) -> Facts:
    """Return what a text says.

    Raises
    ------
    ShaderError
        If two forms of a function are given equally much.
    """
    facts = Facts()
    everything = list(flatten(tree))
    functions = {(one.name, len(one.parameters)) for one, _ in everything if isinstance(one, Function)}
    count = Counter(name for name, _ in functions)
    longest = {name: max(size for other, size in functions if other == name) for name in count}
    for one, _ in everything:
        match one:
            case Uniform():
                facts.uniforms[one.name] = one.type
            case Define() | Default():
                facts.values[one.name] = "float" if any(sign in one.value for sign in ".e") else "int"
            case Constant():
                facts.values[one.name] = one.type
            case Struct():
                facts.structures[one.name] = tuple(flatten(one.fields))
            case Function():
                size = len(one.parameters)
                if count[one.name] > 2:
                    raise ShaderError(
                        one.line, f"{one.name} has {count[one.name]} forms; two at most have names in WGSL"
                    )
                name = one.name + (LONGER if count[one.name] > 1 and size == longest[one.name] else "")
                before = facts.forms.get((one.name, size))
                reads = read_in(one, facts)
                if before and before.parameters != one.parameters:
                    raise ShaderError(one.line, f"{one.name} has two forms of {size} parameters; give one another name")
                reads = tuple(name for name in facts.uniforms if name in reads or (before and name in before.reads))
                facts.forms[one.name, size] = Form(name, one.returns, one.parameters, reads)
    for name, type_ in facts.uniforms.items():
        if type_ in TEXTURES and name in facts.values:
            raise ShaderError(1, f"{name} is a texture and a number")
    return facts
