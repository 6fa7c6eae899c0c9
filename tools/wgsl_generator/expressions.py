"""Expressions, each with its type: WGSL converts nothing by itself, and asks for brackets where GLSL needs none."""

import re
from dataclasses import dataclass
from typing import Final

from vexture.renderers.shader import ShaderError
from wgsl_generator.facts import Assumed, Facts, Form, walk
from wgsl_generator.kinds import (
    COMPARISONS,
    COMPONENTWISE,
    RENAMED,
    SAMPLED,
    SAMPLER,
    TEXTURES,
    TO_FLOAT,
    array_of,
    component_of,
    join_values,
    size_of,
    vector_of,
    wgsl_name,
    wgsl_type,
)
from wgsl_generator.parser import LEVELS
from wgsl_generator.syntax import (
    FRAGMENT,
    Array,
    Binary,
    Call,
    Choice,
    Expression,
    Index,
    Member,
    Name,
    Number,
    Unary,
)

FRAGMENT_NAME: Final = "vexture_fragment"
"""The fragment's place, as a parameter."""

LEVEL: Final = {sign: level for level, signs in enumerate(LEVELS) for sign in signs}
PREFIX, CLOSED = len(LEVELS), len(LEVELS) + 1
BITWISE: Final = ("&", "|", "^")
SHIFTS: Final = ("<<", ">>")
RELATIONS: Final = ("==", "!=", "<", ">", "<=", ">=")
LOGICAL: Final = ("&&", "||", "^^")


@dataclass(frozen=True, slots=True)
class Typed:
    """An expression in WGSL.

    Parameters
    ----------
    text : str
    type : str
        GLSL's name of it.
    level : int
        How tightly its sign binds.
    sign : str
        That between or before its values; none of names and calls.
    is_literal : bool
    """

    text: str
    type: str
    level: int = CLOSED
    sign: str = ""
    is_literal: bool = False


class Expressions:
    """Writes expressions at a place in a text, of which it is told the local names and what holds there."""

    def __init__(self, facts: Facts) -> None:
        self.facts = facts
        self.scope: dict[str, str] = {}
        self.pointers: set[str] = set()
        self.assumed: Assumed = ()

    def of(self, node: Expression) -> Typed:
        """Return an expression in WGSL."""
        match node:
            case Number():
                return self.number(node)
            case Name():
                return self.name(node)
            case Call():
                return self.call(node)
            case Array():
                return self.array(node)
            case Unary():
                return self.unary(node)
            case Binary():
                return self.binary(node)
            case Choice():
                return self.choice(node)
            case Member():
                return self.member(node)
            case Index():
                return self.index(node)

    def as_type(self, node: Expression, type_: str, label: str) -> Typed:
        """Return an expression that must have a type."""
        found = self.of(node)
        if found.type != type_:
            raise ShaderError(node.line, f"{label} is {type_}, and is given {found.type}")
        return found

    # --- values

    def number(self, node: Number) -> Typed:
        """A literal."""
        if node.text in ("true", "false"):
            return Typed(node.text, "bool")
        if node.text.endswith("u"):
            return Typed(node.text, "uint", is_literal=True)
        is_float = not node.text.lower().startswith("0x") and re.search(r"[.eE]", node.text)
        return Typed(node.text, "float" if is_float else "int", is_literal=True)

    def name(self, node: Name) -> Typed:
        """A variable, a number or a uniform."""
        name = wgsl_name(node.text)
        if node.text in self.scope:
            return Typed(f"(*{name})" if node.text in self.pointers else name, self.scope[node.text])
        if node.text in self.facts.values:
            return Typed(name, self.facts.values[node.text])
        if node.text in self.facts.uniforms:
            return Typed(FRAGMENT_NAME if node.text == FRAGMENT else name, self.facts.uniforms[node.text])
        raise ShaderError(node.line, f"{node.text} is not known")

    def array(self, node: Array) -> Typed:
        """An array of values."""
        element, size = array_of(node.type) or ("", "")
        given = [self.as_type(one, element, "an element").text for one in node.given]
        if size != str(len(given)):
            raise ShaderError(node.line, f"{node.type} of {len(given)} elements")
        return Typed(f"{wgsl_type(node.type)}({join_values(given)})", node.type)

    def member(self, node: Member) -> Typed:
        """A field, or components."""
        value = self.of(node.value)
        text = f"{held_before_dot(value)}.{wgsl_name(node.name)}"
        for one, _ in self.facts.structures.get(value.type, ()):
            if one.name == node.name:
                return Typed(text, one.type)
        letters = "xyzw"[: size_of(value.type)], "rgba"[: size_of(value.type)]
        if size_of(value.type) > 1 and len(node.name) <= 4 and any(set(node.name) <= set(each) for each in letters):
            return Typed(text, vector_of(component_of(value.type), len(node.name)))
        raise ShaderError(node.line, f"{value.type} has no {node.name}")

    def index(self, node: Index) -> Typed:
        """An element."""
        value, at = self.of(node.value), self.of(node.at)
        if at.type not in ("int", "uint"):
            raise ShaderError(node.line, f"an index is {at.type}; it must be int or uint")
        text = f"{held_before_dot(value)}[{at.text}]"
        array = array_of(value.type)
        if array:
            return Typed(text, array[0])
        if value.type == "mat3":
            return Typed(text, "vec3")
        if size_of(value.type) > 1:
            return Typed(text, component_of(value.type))
        raise ShaderError(node.line, f"{value.type} has no elements")

    # --- signs

    def unary(self, node: Unary) -> Typed:
        """A sign before a value."""
        value = self.of(node.value)
        allowed = {"!": ("bool",), "~": ("int", "uint"), "-": ("int", "float")}[node.sign]
        if component_of(value.type) not in allowed:
            raise ShaderError(node.line, f"{node.sign}{value.type}")
        text = value.text if value.level >= PREFIX and value.sign != node.sign else f"({value.text})"
        return Typed(node.sign + text, value.type, PREFIX, node.sign)

    def choice(self, node: Choice) -> Typed:
        """``select`` computes both values: they may be of any cost, but not change anything."""
        for call in walk((node.yes, node.no)):
            form = self.facts.forms.get((call.name, len(call.given))) if isinstance(call, Call) else None
            if form and any(parameter.is_inout for parameter in form.parameters):
                raise ShaderError(
                    node.line, f"a choice with {form.name}, which changes what it is given; use if and else"
                )
        condition = self.as_type(node.condition, "bool", "a condition")
        yes, no = self.of(node.yes), self.of(node.no)
        if yes.type != no.type or not size_of(yes.type):
            raise ShaderError(
                node.line, f"a choice between {yes.type} and {no.type}; both must be one scalar or vector type"
            )
        return Typed(f"select({join_values([no.text, yes.text, condition.text])})", yes.type)

    def binary(self, node: Binary) -> Typed:
        """A sign between values."""
        sign, left, right = node.sign, self.of(node.left), self.of(node.right)
        type_ = self.result(node.line, left, sign, right)
        if sign in SHIFTS:
            right = shift_count(right, left.type)
        elif sign in BITWISE:
            left, right = spread(left, right.type), spread(right, left.type)
        written = "!=" if sign == "^^" else sign  # between truths they are the same
        text = f"{bracket(left, written, is_right=False)} {written} {bracket(right, written, is_right=True)}"
        if sign in ("==", "!=") and size_of(left.type) > 1:
            return Typed(f"{'all' if sign == '==' else 'any'}({text})", "bool")
        return Typed(text, type_, LEVEL[written], written)

    def result(self, line: int, left: Typed, sign: str, right: Typed) -> str:
        """Type of two values with a sign between them."""
        wrong = ShaderError(line, f"{left.type} {sign} {right.type}")
        if sign in LOGICAL or sign in RELATIONS:
            is_whole = sign in ("==", "!=") and size_of(left.type) > 0
            allowed = left.type == "bool" if sign in LOGICAL else is_whole or left.type in ("int", "uint", "float")
            if left.type != right.type or not allowed:
                raise wrong
            return "bool"
        if (left.type, sign, right.type) == ("mat3", "*", "vec3"):
            return "vec3"
        components = component_of(left.type), component_of(right.type)
        sizes = size_of(left.type), size_of(right.type)
        if 0 in sizes or "bool" in components:
            raise wrong
        if sign in SHIFTS:
            if "float" in components or sizes[1] not in (1, sizes[0]):
                raise wrong
            return left.type
        if components[0] != components[1] or (sizes[0] != sizes[1] and 1 not in sizes):
            raise wrong
        if sign in (*BITWISE, "%") and components[0] == "float":
            raise wrong
        return vector_of(components[0], max(sizes))

    # --- calls

    def call(self, node: Call) -> Typed:
        """A function of the text or of the language, or a constructor."""
        form = self.facts.forms.get((node.name, len(node.given)))
        if form:
            return self.own(node, form)
        if node.name in self.facts.structures:
            return self.structure(node)
        given = [self.of(one) for one in node.given]
        if size_of(node.name) or node.name == "mat3":
            return self.constructor(node, given)
        if node.name in ("texelFetch", "texture", "textureLod", "textureSize"):
            return self.texture(node, given)
        return self.builtin(node, given)

    def own(self, node: Call, form: Form) -> Typed:
        """A function of the text: what it reads, then what it is given."""
        texts = [text for name in form.reads for text in self.handed(name)]
        for one, parameter in zip(node.given, form.parameters, strict=True):
            value = self.as_type(one, parameter.type, f"{parameter.name} of {node.name}")
            if parameter.is_inout:
                if not isinstance(one, Name) or one.text not in self.scope:
                    raise ShaderError(
                        one.line, f"{parameter.name} of {node.name} is inout; give it a whole local variable"
                    )
                value = Typed(wgsl_name(one.text) if one.text in self.pointers else f"&{value.text}", value.type)
            texts.append(bare(value.text))
            if parameter.type == SAMPLED:
                texts.append(f"{value.text}{SAMPLER}")
        return Typed(f"{form.name}({join_values(texts)})", form.returns)

    def handed(self, uniform: str) -> tuple[str, ...]:
        """A uniform as what a function is given."""
        if uniform == FRAGMENT:
            return (FRAGMENT_NAME,)
        name = wgsl_name(uniform)
        return (name, f"{name}{SAMPLER}") if self.facts.uniforms[uniform] == SAMPLED else (name,)

    def structure(self, node: Call) -> Typed:
        """All fields that there are where this stands."""
        wanted = []
        for one, assumed in self.facts.structures[node.name]:
            here = [
                truth == dict(self.assumed)[condition]
                for condition, truth in assumed
                if condition in dict(self.assumed)
            ]
            if len(here) < len(assumed) and all(here):
                raise ShaderError(
                    node.line, f"{node.name}.{one.name} is there if {assumed[-1][0]}, which is not known here"
                )
            wanted += [one] if all(here) else []
        if len(wanted) != len(node.given):
            raise ShaderError(node.line, f"{node.name} has {len(wanted)} fields, and is given {len(node.given)}")
        texts = [
            self.as_type(one, to.type, f"{node.name}.{to.name}").text
            for one, to in zip(node.given, wanted, strict=True)
        ]
        return Typed(f"{node.name}({join_values(texts)})", node.name)

    def constructor(self, node: Call, values: list[Typed]) -> Typed:
        """Of a vector or scalar; WGSL's convert whole vectors, but no scalars among others."""
        part, size = component_of(node.name), max(size_of(node.name), 3 * (node.name == "mat3"))
        sizes = [size_of(one.type) for one in values]
        is_filled = sum(sizes) == size * (3 if node.name == "mat3" else 1) or sizes == [1]
        if 0 in sizes or not is_filled or (size == 1 and sizes != [1]):
            raise ShaderError(node.line, f"{node.name} of {', '.join(one.type for one in values)}")
        if size == 1 and node.name == values[0].type:
            return values[0]
        part = "float" if node.name == "mat3" else part
        texts = []
        for one in values:
            same = component_of(one.type) == part or size == 1 or size_of(one.type) == size
            texts.append(one.text if same else f"{wgsl_type(vector_of(part, size_of(one.type)))}({one.text})")
        return Typed(f"{wgsl_type(node.name)}({join_values(texts)})", node.name)

    def texture(self, node: Call, values: list[Typed]) -> Typed:
        """A texture's texel, or its size."""
        kind = values[0].type
        if kind not in TEXTURES or not isinstance(node.given[0], Name):
            raise ShaderError(node.line, f"{node.name} of {kind}; it must be a texture's name")
        texture, *others = (one.text for one in values)
        if node.name == "textureSize":
            return Typed(f"vec2i(textureDimensions({texture}, {others[0]}))", "ivec2")
        type_ = "uvec4" if kind == "usampler2D" else "vec4"
        if node.name == "texelFetch":
            return Typed(f"textureLoad({texture}, {', '.join(others)})", type_)
        if kind != SAMPLED:
            raise ShaderError(node.line, f"{node.name} of {kind}; whole numbers are not filtered")
        how = "textureSampleLevel" if node.name == "textureLod" else "textureSample"
        return Typed(f"{how}({texture}, {texture}{SAMPLER}, {', '.join(others)})", type_)

    def builtin(self, node: Call, values: list[Typed]) -> Typed:
        """A function of the language."""
        name, types = node.name, [one.type for one in values]
        if not values:
            raise ShaderError(node.line, f"{name} is not known")
        wrong = ShaderError(node.line, f"{name} of {', '.join(types)} is not in the subset")
        widest = max(types, key=size_of)
        if name in COMPARISONS and len(values) == 2 and types[0] == types[1] and size_of(widest) > 1:
            sides = (bracket(values[0], "<", is_right=False), bracket(values[1], "<", is_right=True))
            text = f"{sides[0]} {COMPARISONS[name]} {sides[1]}"
            return Typed(text, vector_of("bool", size_of(widest)), LEVEL["<"], "<")
        if name in ("any", "all") and component_of(widest) == "bool":
            return Typed(f"{name}({values[0].text})", "bool")
        if name == "mix" and len(values) == 3 and component_of(types[2]) == "bool" and types[0] == types[1]:
            return Typed(f"select({', '.join(one.text for one in values)})", types[0])
        if name in COMPONENTWISE and all(type_ in (widest, component_of(widest)) for type_ in types):
            texts = [spread(one, widest).text for one in values]
            return Typed(f"{RENAMED.get(name, name)}({', '.join(texts)})", widest)
        if name in TO_FLOAT and set(types) == {widest} and component_of(widest) == "float":
            return Typed(f"{name}({', '.join(one.text for one in values)})", "float")
        bits = {"floatBitsToInt": ("float", "int"), "floatBitsToUint": ("float", "uint")}
        bits |= {"uintBitsToFloat": ("uint", "float"), "intBitsToFloat": ("int", "float")}
        if name in bits and component_of(widest) == bits[name][0] and len(values) == 1:
            type_ = vector_of(bits[name][1], size_of(widest))
            return Typed(f"bitcast<{wgsl_type(type_)}>({values[0].text})", type_)
        if name == "unpackUnorm2x16" and types == ["uint"]:
            return Typed(f"{RENAMED[name]}({values[0].text})", "vec2")
        raise wrong


def bare(text: str) -> str:
    """A value between commas: what a pointer points at needs no brackets there."""
    return text[1:-1] if re.fullmatch(r"\(\*\w+\)", text) else text


def held_before_dot(value: Typed) -> str:
    """A value, in brackets unless what follows it binds to all of it."""
    return value.text if value.level == CLOSED else f"({value.text})"


def bracket(side: Typed, sign: str, *, is_right: bool) -> str:
    """A value beside a sign, in brackets where GLSL or WGSL ask for them."""
    level = LEVEL[sign]
    is_loose = side.level < level or (is_right and side.level == level)
    is_mixed = sign in LOGICAL and side.sign in ("&&", "||") and side.sign != sign
    is_chained = (sign in RELATIONS and side.sign in RELATIONS) or (sign == "<" and ">" in side.text)
    if sign in SHIFTS or sign in BITWISE:  # WGSL: these stand between values that are closed, or in a chain of one sign
        is_loose = side.level < PREFIX and not (sign in BITWISE and side.sign == sign and not is_right)
    return f"({side.text})" if is_loose or is_mixed or is_chained else side.text


def spread(value: Typed, like: str) -> Typed:
    """A scalar as a vector of this type; a vector as it is."""
    if size_of(like) > 1 and size_of(value.type) == 1:
        type_ = vector_of(component_of(value.type), size_of(like))
        return Typed(f"{wgsl_type(type_)}({value.text})", type_)
    return value


def shift_count(value: Typed, shifted: str) -> Typed:
    """WGSL shifts by unsigned numbers, and vectors by vectors."""
    if value.type == "int":
        value = (
            Typed(f"{value.text}u", "uint", is_literal=True)
            if value.is_literal
            else Typed(f"u32({value.text})", "uint")
        )
    return spread(value, shifted)
