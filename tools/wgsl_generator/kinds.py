"""Types: GLSL's names of them, what they consist of, and WGSL's names; and the functions that both languages have."""

import re
from typing import Final


def words_of(text: str) -> frozenset[str]:
    """Words between spaces."""
    return frozenset(text.split())


SCALARS: Final = {"bool": "bool", "int": "i32", "uint": "u32", "float": "f32"}
SHORT: Final = {"bool": "<bool>", "int": "i", "uint": "u", "float": "f"}
PREFIXES: Final = {"": "float", "i": "int", "u": "uint", "b": "bool"}
TEXTURES: Final = {"usampler2D": "texture_2d<u32>", "sampler2D": "texture_2d<f32>"}

SAMPLED: Final = "sampler2D"
"""The type that WGSL has two of: a texture, and how it is sampled."""

SAMPLER: Final = "_sampler"
"""Ends the name of the second."""

COMPARISONS: Final = {
    "lessThan": "<",
    "greaterThan": ">",
    "lessThanEqual": "<=",
    "greaterThanEqual": ">=",
    "equal": "==",
    "notEqual": "!=",
}
"""Functions of vectors that WGSL writes as signs."""

COMPONENTWISE: Final = words_of("""
    abs acos asin atan ceil clamp cos dFdx dFdy exp exp2 floor fract fwidth inversesqrt log log2 max min mix
    normalize pow reflect round sign sin smoothstep sqrt step tan
""")
"""Functions of values of one type, which is the result's; WGSL has no scalars beside vectors there."""

TO_FLOAT: Final = frozenset({"dot", "length", "distance"})

RENAMED: Final = {
    "dFdx": "dpdxFine",  # a pixel's own pair, as GPUs of OpenGL take it: shaders/steps.glsl reckons with that
    "dFdy": "dpdyFine",
    "inversesqrt": "inverseSqrt",
    "floatBitsToInt": "bitcast<i32>",
    "floatBitsToUint": "bitcast<u32>",
    "uintBitsToFloat": "bitcast<f32>",
    "intBitsToFloat": "bitcast<f32>",
    "unpackUnorm2x16": "unpack2x16unorm",
}

RESERVED: Final = words_of("""
    NULL Self abstract active alias alignas alignof as asm asm_fragment async attribute auto await become break case
    cast catch class co_await co_return co_yield coherent column_major common compile compile_fragment concept const
    const_assert const_cast consteval constexpr constinit continue continuing crate debugger decltype default delete
    demote demote_to_helper diagnostic discard do dynamic_cast else enable enum explicit export extends extern
    external fallthrough false filter final finally fn for friend from fxgroup get goto groupshared highp if impl
    implements import inline instanceof interface layout let loop lowp macro macro_rules match mediump meta mod
    module move mut mutable namespace new nil noexcept noinline nointerpolation non_coherent noncoherent
    noperspective null nullptr of operator override package packoffset partial pass patch pixelfragment precise
    precision premerge priv protected pub public readonly ref regardless register reinterpret_cast require requires
    resource restrict return self set shared sizeof smooth snorm static static_assert static_cast std struct
    subroutine super switch target template this thread_local throw trait true try type typedef typeid typename
    typeof union unless unorm unsafe unsized use using var varying virtual volatile wgsl where while with writeonly
    yield
""")
"""Words that WGSL keeps (its section 16.2, Reserved Words), and its keywords."""


def type_of(text: str) -> tuple[str, int]:
    """Component and size of a scalar or vector type; size 0 of others."""
    match = re.fullmatch(r"([iub]?)vec([234])", text)
    if match:
        return PREFIXES[match[1]], int(match[2])
    return text, int(text in SCALARS)


def component_of(text: str) -> str:
    """The type of a vector's components; of other types, the type."""
    return type_of(text)[0]


def size_of(text: str) -> int:
    """The number of a type's components: 1 of scalars, 0 of what has none."""
    return type_of(text)[1]


def vector_of(component: str, size: int) -> str:
    """The type of so many components."""
    prefix = next(short for short, long in PREFIXES.items() if long == component)
    return component if size == 1 else f"{prefix}vec{size}"


def array_of(text: str) -> tuple[str, str] | None:
    """Element and size of an array type; None of others."""
    match = re.fullmatch(r"(\w+)\[(.+)\]", text)
    return (match[1], match[2]) if match else None


def wgsl_name(name: str) -> str:
    """A name, or one beside it that WGSL does not keep for itself."""
    return f"{name}_" if name in RESERVED else name


def wgsl_type(text: str) -> str:
    """WGSL's name of a type."""
    array = array_of(text)
    if array:
        return f"array<{wgsl_type(array[0])}, {array[1]}>"
    component, size = type_of(text)
    if size > 1:
        return f"vec{size}{SHORT[component]}"
    return SCALARS.get(text) or TEXTURES.get(text) or {"mat3": "mat3x3f"}.get(text) or text


def join_values(texts: list[str]) -> str:
    """Values between commas; WGSL would read ``a < b, c > d`` as a template's arguments.

    >>> join_values(["a < b", "c > d"])
    '(a < b), c > d'
    """
    later = [any(">" in text for text in texts[k + 1 :]) for k in range(len(texts))]
    return ", ".join(f"({text})" if " < " in text and held else text for text, held in zip(texts, later, strict=True))
