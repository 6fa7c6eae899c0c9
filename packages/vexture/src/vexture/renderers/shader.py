"""Shader text: files of ``shaders/`` after those that they include, and before them the numbers shared with Python.

``#include "other.glsl"`` includes a file once. The numbers are those of the texture's layout (`vexture.base.layout`)
and of the shading method (`vexture.renderers.method`).

WGSL has no conditionals: a program is made for one choice of numbers, and `chosen` leaves the lines of that choice.
"""

import re
from collections.abc import Mapping
from functools import cache
from importlib import resources
from types import ModuleType, SimpleNamespace
from typing import Final

from vexture.base import layout
from vexture.base.errors import ParameterError, VextureError
from vexture.drawing.group import Blend, Mask
from vexture.drawing.paint import Spread
from vexture.renderers import method


class ShaderError(VextureError):
    """A text is outside of the subset of GLSL that has a meaning in WGSL.

    Parameters
    ----------
    line : int
        Its number in the text, from 1.
    message : str
        What is there, and what may be.
    """

    def __init__(self, line: int, message: str) -> None:
        super().__init__(f"line {line}: {message}")
        self.line = line


VERSIONS: Final = {
    "330": "#version 330\n",
    "300 es": "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n",
}
"""First lines of a shader in each supported dialect of GLSL."""

WGSL: Final = "wgsl"

PARTS: Final = {
    "coverage": "coverage.glsl",
    "color": "colour.glsl",
    "sheets": "sheets.glsl",
    "feature": "feature.glsl",
    "steps": "steps.glsl",
}
"""The file of each part of the shader that an application can ask for."""

PICTURE_MAIN: Final = """
out float coverage_of_pixel;
void main() { coverage_of_pixel = view_coverage(gl_FragCoord.xy); }
"""
"""Draws one shape in one colour channel, after a file with ``view_coverage``."""

COLOR_MAIN: Final = """
out vec4 color_of_pixel;
void main() { color_of_pixel = view_color(gl_FragCoord.xy); }
"""
"""Draws a planar map, after the file ``view_color.glsl``."""

WRAPS: Final = {"none": method.WRAP_NONE, "clamp": method.WRAP_CLAMP, "repeat": method.WRAP_REPEAT}
"""Values of ``VEXTURE_WRAP``."""

CHOSEN: Final = {"FLAT", "GRADIENTS", "LINEAR", "WRAP"}
"""Numbers that each program sets itself."""

MODES: Final = SimpleNamespace(
    **{
        f"{kind.__name__.upper()}_{one.name}": int(one)
        for kind in (Blend, Mask, Spread)
        for one in kind.__members__.values()
    }
)
"""Numbers of blend modes and kinds of masks, and of what gradients do beyond their ends."""

PREFIXED: Final = re.compile(r"\bVEXTURE_(\w+)")
"""A number in the packed texture's files; the prefix avoids clashes with an application's own names."""

INCLUDE: Final = re.compile(r'^#include "(.*)"$', re.MULTILINE)


@cache
def read_shader(name: str, package: str = "vexture") -> str:
    """Text of a shader file after the files that it includes, each once.

    The file is in the folder ``shaders/`` of a package; what it includes may also be in that of vexture.
    """
    folders = [resources.files(home) / "shaders" for home in dict.fromkeys((package, "vexture"))]
    found: dict[str, str] = {}

    def add(name: str, wanted_by: str) -> None:
        if name in found:
            return
        file = next((folder / name for folder in folders if (folder / name).is_file()), None)
        if file is None or not re.fullmatch(r"\w+\.glsl", name):
            raise FileNotFoundError(f"{wanted_by} includes {name!r}, which is not in shaders/")
        text = file.read_text(encoding="utf-8")
        for other in INCLUDE.findall(text):
            add(other, name)
        found[name] = INCLUDE.sub("", text)

    add(name, "a caller")
    return "\n".join(found.values())


def vertex_source(version: str) -> str:
    """Vertex shader for three vertices without attributes: a triangle that covers the image."""
    corner = "vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0)"
    return f"{VERSIONS[version]}void main() {{ gl_Position = {corner}; }}\n"


def shader_source(
    version: str = "300 es",
    part: str = "coverage",
    *,
    wrap: str = "none",
    flat: bool = False,
    gradients: bool = True,
    linear: bool = False,
) -> str:
    """Text that gives a fragment shader the functions of a part of vexture.

    It stands before the shader's own text. All its names begin with ``vexture``, ``Vexture`` or ``VEXTURE``.

    GLSL has neither ``#version`` nor a default precision, so that an engine can write them; in ``300 es`` the default
    precisions of float and int must be highp. It declares ``uniform highp usampler2D vextureTexels``, which must be a
    `Texture`. In WGSL a function is given what it reads before all else: ``vextureCoverage(texels, root, uv, dx, dy)``,
    with ``texels`` a ``texture_2d<u32>``. Of a function's two forms, that with a base in fixed point ends in ``From``.

    Parameters
    ----------
    version : str
        ``"300 es"`` or ``"330"``, of GLSL, whose text is the same for both, or ``"wgsl"``.
    part : str
        ``"coverage"``: one shape, by ``vextureCoverage``, or ``vextureFlatCoverage``, which costs less, where all
        pixels are upright rectangles and alike. ``"color"``: a drawing in its own colours, by ``vextureColor`` and
        ``vextureFlatColor``. ``"sheets"``: both anywhere in the plane, by ``vextureWrapped``, ``vextureWrappedColor``
        and ``vextureSheets``. ``"feature"``: the element at a point, by ``vextureFeature``. ``"steps"``: derivatives
        of a position, by ``vextureStepX`` and ``vextureStepY``.
    wrap : str
        Beyond the unit square, for ``"sheets"``: ``"none"``, ``"clamp"`` or ``"repeat"``.
    flat : bool
        Whether the functions of ``"sheets"`` call the flat ones.
    gradients : bool
        Whether a drawing may have gradients; without their text it costs less.
    linear : bool
        Whether colours are averaged in linear light, or in sRGB as browsers do.

    Raises
    ------
    ParameterError
        If there is no such version, part or wrap.

    Examples
    --------
    >>> "float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy)" in shader_source()
    True
    >>> "fn vextureCoverage(vextureTexels: texture_2d<u32>, root: u32, uv: vec2f" in shader_source("wgsl")
    True
    """
    for name, value, allowed in (
        ("version", version, (*VERSIONS, WGSL)),
        ("part", part, (*PARTS,)),
        ("wrap", wrap, (*WRAPS,)),
    ):
        if value not in allowed:
            raise ParameterError(f"`{name}` is {value!r}; there are {', '.join(map(repr, allowed))}")
    numbers = {"FLAT": int(bool(flat)), "GRADIENTS": int(bool(gradients)), "LINEAR": int(bool(linear))}
    numbers["WRAP"] = WRAPS[wrap]
    text = wgsl_text(part) if version == WGSL else shader_text(PARTS[part])
    asked = {f"VEXTURE_{name}": value for name, value in numbers.items() if f"VEXTURE_{name}" in text}
    if version != WGSL:
        return "".join(f"#define {name} {value}\n" for name, value in asked.items()) + text
    wraps = {f"VEXTURE_WRAP_{name.upper()}": value for name, value in WRAPS.items()}
    return chosen(text, {**asked, **wraps})


@cache
def wgsl_text(part: str) -> str:
    """Text of a part in WGSL, with its conditionals, as ``tools/make_web.py`` generated it from `shader_text`."""
    return (resources.files("vexture") / "shaders" / "wgsl" / f"{part}.wgsl").read_text(encoding="utf-8")


def shader_text(file: str, *owners: ModuleType) -> str:
    """Text of one of the packed texture's files, preceded by the numbers that it and its includes name.

    The numbers are those of `vexture.renderers.method`, `vexture.base.layout` and further owners. The caller must
    define ``VEXTURE_WRAP`` (values in `WRAPS`) and ``VEXTURE_FLAT`` (0 or 1) where the file asks for them.
    """
    text = read_shader(file)
    lines = []
    for name in sorted(set(PREFIXED.findall(text)) - CHOSEN):
        value = next((getattr(owner, name) for owner in (method, layout, MODES, *owners) if hasattr(owner, name)), None)
        if value is None:
            raise NameError(f"{file} names VEXTURE_{name}, which no owner of numbers defines")
        lines.append(f"#define VEXTURE_{name} {value!r}\n")
    return "".join(lines) + text


def view_source(version: str, is_flat: bool) -> str:
    """Fragment shader that draws one shape of a packed texture in one colour channel."""
    return (
        f"{VERSIONS[version]}#define VEXTURE_FLAT {int(is_flat)}\n" + shader_text("view_coverage.glsl") + PICTURE_MAIN
    )


def color_source(version: str, is_flat: bool, is_linear: bool, has_gradients: bool) -> str:
    """Fragment shader that draws a planar map, with or without gradients, averaged in linear light or in sRGB."""
    numbers = {"FLAT": is_flat, "LINEAR": is_linear, "GRADIENTS": has_gradients}
    lines = "".join(f"#define VEXTURE_{name} {int(value)}\n" for name, value in numbers.items())
    return VERSIONS[version] + lines + shader_text("view_color.glsl") + COLOR_MAIN


WORDS: Final = ("#if ", "#elif ", "#else", "#endif")


def chosen(text: str, numbers: Mapping[str, float]) -> str:
    """Return a text without its conditionals: the lines that a choice of numbers leaves.

    Parameters
    ----------
    text : str
        Its conditions are ``NAME``, which is nonzero, or ``NAME == NUMBER``, whose right side may be a name as well.
    numbers : mapping of str to float

    Raises
    ------
    ShaderError
        If a condition names what is not among the numbers.
    """

    def value(word: str, line: int) -> float:
        try:
            return numbers[word] if word[0].isalpha() else float(word)
        except (KeyError, ValueError):
            raise ShaderError(line, f"{word} is not chosen; choose a number for it") from None

    kept: list[str] = []
    open_: list[tuple[bool, bool]] = []  # of each conditional: whether a branch was taken, and whether this one is
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith(WORDS):
            if all(is_here for _, is_here in open_):
                kept.append(line)
            continue
        word, *condition = line.split()
        if word == "#endif":
            open_.pop()
            continue
        was_taken = open_.pop()[0] if word != "#if" else False
        if word == "#else":
            holds = True
        else:
            found = value(condition[0], number)
            holds = found == value(condition[2], number) if condition[1:] else found != 0
        open_.append((was_taken or holds, holds and not was_taken))
    return "\n".join(kept) + "\n"
