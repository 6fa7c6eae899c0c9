"""Assemble shader text: the numbers shared with Python, then the included files, then a file of ``shaders/``.

``#include "other.glsl"`` includes a file once. The numbers are those of the texture's layout (`vexture.base.layout`)
and of the shading method (`vexture.renderers.method`).

WGSL has no preprocessor: each program is made for one choice of numbers, and `chosen` keeps the lines of that choice.
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
from vexture.drawing.picture import Sampling
from vexture.renderers import method


class ShaderError(VextureError):
    """A text is outside the subset of GLSL that can be translated to WGSL.

    Parameters
    ----------
    line : int
        Number of the line, from 1.
    message : str
        The text found there, and what is allowed instead.
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
"""File of each part of the shader that an application can request."""

PICTURE_MAIN: Final = """
out float coverage_of_pixel;
void main() { coverage_of_pixel = view_coverage(gl_FragCoord.xy); }
"""
"""Main function that draws one shape in one colour channel; follows a file with ``view_coverage``."""

COLOR_MAIN: Final = """
out vec4 color_of_pixel;
void main() { color_of_pixel = view_color(gl_FragCoord.xy); }
"""
"""Main function that draws a planar map; follows the file ``view_color.glsl``."""

WRAPS: Final = {"none": method.WRAP_NONE, "clamp": method.WRAP_CLAMP, "repeat": method.WRAP_REPEAT}
"""Values of ``VEXTURE_WRAP``."""

CHOSEN: Final = {"FLAT", "GRADIENTS", "LINEAR", "WRAP"}
"""Numbers that each program defines itself."""

MODES: Final = SimpleNamespace(
    **{
        f"{kind.__name__.upper()}_{one.name}": int(one)
        for kind in (Blend, Mask, Sampling, Spread)
        for one in kind.__members__.values()
    }
)
"""Numbers of blend modes, of kinds of masks, of samplings of pictures, and of the spread methods of gradients."""

PREFIXED: Final = re.compile(r"\bVEXTURE_(\w+)")
"""A number in the shader's files; the prefix avoids clashes with an application's own names."""

INCLUDE: Final = re.compile(r'^#include "(.*)"$', re.MULTILINE)


@cache
def read_shader(name: str, package: str = "vexture") -> str:
    """Read a shader file; the files that it includes precede it, each once.

    The file is in the folder ``shaders/`` of a package; included files may also be in vexture's folder.
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
    pictures: bool | None = None,
    linear: bool = False,
) -> str:
    """Shader text with the functions of a part of vexture, to put before a fragment shader's own text.

    All its names begin with ``vexture``, ``Vexture`` or ``VEXTURE``.

    The GLSL contains neither ``#version`` nor a default precision, so that an engine can write them; in ``300 es`` the
    default precisions of float and int must be highp. It declares ``uniform highp usampler2D vextureTexels``, to which
    the texels of a `Texture` must be bound. In WGSL the texels are a function's first argument:
    ``vextureCoverage(texels, root, uv, dx, dy)``, where ``texels`` is a ``texture_2d<u32>``. Some functions have a
    second form, with a base in fixed point; in WGSL its name ends in ``From``.

    Parameters
    ----------
    version : str
        GLSL ``"300 es"`` or ``"330"``, whose texts are equal, or ``"wgsl"``.
    part : str
        ``"coverage"``: one shape, by ``vextureCoverage``, or by the faster ``vextureFlatCoverage`` if all pixels are
        equal upright rectangles. ``"color"``: a drawing in its own colours, by ``vextureColor`` and
        ``vextureFlatColor``. ``"sheets"``: both anywhere in the plane, by ``vextureWrapped``, ``vextureWrappedColor``
        and ``vextureSheets``. ``"feature"``: the element at a point, by ``vextureFeature``. ``"steps"``: derivatives
        of a position, by ``vextureStepX`` and ``vextureStepY``.
    wrap : str
        Wrapping outside the unit square, for ``"sheets"``: ``"none"``, ``"clamp"`` or ``"repeat"``.
    flat : bool
        True if the functions of ``"sheets"`` call the flat ones.
    gradients : bool
        True if a drawing may have gradients; without them the shader is faster.
    pictures : bool, optional
        True if a drawing may have pictures; without them the shader is faster. By default as `gradients`.
    linear : bool
        True to average colours in linear light; False to average in sRGB, as browsers do.

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
    programs = 2 if (gradients if pictures is None else pictures) else int(bool(gradients))
    numbers = {"FLAT": int(bool(flat)), "GRADIENTS": programs, "LINEAR": int(bool(linear))}
    numbers["WRAP"] = WRAPS[wrap]
    text = wgsl_text(part) if version == WGSL else shader_text(PARTS[part])
    used = {f"VEXTURE_{name}": value for name, value in numbers.items() if f"VEXTURE_{name}" in text}
    if version != WGSL:
        return "".join(f"#define {name} {value}\n" for name, value in used.items()) + text
    wraps = {f"VEXTURE_WRAP_{name.upper()}": value for name, value in WRAPS.items()}
    return chosen(text, {**used, **wraps})


@cache
def wgsl_text(part: str) -> str:
    """WGSL text of a part, with conditionals, as ``tools/make_web.py`` generated it from `shader_text`."""
    return (resources.files("vexture") / "shaders" / "wgsl" / f"{part}.wgsl").read_text(encoding="utf-8")


def shader_text(file: str, *owners: ModuleType) -> str:
    """Read a file of the shader, preceded by definitions of the numbers that it and its includes use.

    The numbers come from `vexture.renderers.method`, `vexture.base.layout` and further owners. The caller must define
    ``VEXTURE_WRAP`` (values in `WRAPS`) and ``VEXTURE_FLAT`` (0 or 1) if the file needs them.
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


def color_source(version: str, is_flat: bool, is_linear: bool, gradients: int) -> str:
    """Fragment shader that draws a planar map, averaged in linear light or in sRGB.

    `gradients` is 0 for a map without programs, 1 for one with gradients, and 2 for one with pictures.
    """
    numbers = {"FLAT": is_flat, "LINEAR": is_linear, "GRADIENTS": gradients}
    lines = "".join(f"#define VEXTURE_{name} {int(value)}\n" for name, value in numbers.items())
    return VERSIONS[version] + lines + shader_text("view_color.glsl") + COLOR_MAIN


WORDS: Final = ("#if ", "#elif ", "#else", "#endif")


def chosen(text: str, numbers: Mapping[str, float]) -> str:
    """Resolve the conditionals of a text for a choice of numbers.

    Parameters
    ----------
    text : str
        Its conditions are ``NAME``, true if nonzero, or ``NAME == NUMBER``, whose right side may be a name as well.
    numbers : mapping of str to float

    Raises
    ------
    ShaderError
        If a condition uses a name that is not among the numbers.
    """

    def value(word: str, line: int) -> float:
        try:
            return numbers[word] if word[0].isalpha() else float(word)
        except (KeyError, ValueError):
            raise ShaderError(line, f"{word} is not chosen; choose a number for it") from None

    lines: list[str] = []
    open_: list[tuple[bool, bool]] = []  # of each open conditional: was a branch taken, and is this one
    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith(WORDS):
            if all(is_here for _, is_here in open_):
                lines.append(line)
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
    return "\n".join(lines) + "\n"
