"""Shader text: files of ``glsl/`` after those that they include, preceded by the numbers that they share with Python.

``#include "other.glsl"`` includes a file once. The numbers are those of the texture's layout (`vexture.layout`) and of
the shading method (`vexture.renderers.method`).
"""

import re
from functools import cache
from importlib import resources
from types import ModuleType, SimpleNamespace
from typing import Final

from vexture import layout
from vexture.errors import ParameterError
from vexture.group import Blend, Mask
from vexture.paint import Spread
from vexture.renderers import method

__all__ = [
    "PICTURE_MAIN",
    "VERSIONS",
    "WRAPS",
    "color_source",
    "included",
    "shader_source",
    "shader_text",
    "vertex_source",
    "view_source",
]

VERSIONS: Final = {
    "330": "#version 330\n",
    "300 es": "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n",
}
"""First lines of a shader in each supported dialect."""

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
def included(name: str, package: str = "vexture") -> str:
    """Text of a shader file after the files that it includes, each once.

    The file is in the folder ``glsl/`` of a package; what it includes may also be in that of vexture.
    """
    folders = [resources.files(home) / "glsl" for home in dict.fromkeys((package, "vexture"))]
    found: dict[str, str] = {}

    def add(name: str, wanted_by: str) -> None:
        if name in found:
            return
        file = next((folder / name for folder in folders if (folder / name).is_file()), None)
        if file is None or not re.fullmatch(r"\w+\.glsl", name):
            raise FileNotFoundError(f"{wanted_by} includes {name!r}, which is not in glsl/")
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


def shader_source(version: str = "300 es") -> str:
    """Text that gives a fragment shader the functions ``vextureCoverage`` and ``vextureFlatCoverage``.

    It stands before the shader's own text. It has neither ``#version`` nor a default precision, so that an engine can
    write them; in ``300 es`` the default precisions of float and int must be highp. It declares ``uniform highp
    usampler2D vextureTexels``, which must be a `Texture`. All other names begin with ``vexture``, ``Vexture`` or
    ``VEXTURE``. Both functions integrate over the pixel's footprint: the first one whatever its shape, the second one,
    which costs less, over upright rectangles that are alike in the whole view.

    Parameters
    ----------
    version : str
        Dialect of the shader, ``"300 es"`` or ``"330"``. The text is the same for both.

    Raises
    ------
    ParameterError
        If there is no such version.

    Examples
    --------
    >>> "float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy)" in shader_source()
    True
    """
    if version not in VERSIONS:
        raise ParameterError(f"`version` is {version!r}; there are {', '.join(map(repr, VERSIONS))}")
    return shader_text("coverage.glsl")


def shader_text(file: str, *owners: ModuleType) -> str:
    """Text of one of the packed texture's files, preceded by the numbers that it and its includes name.

    The numbers are those of `vexture.renderers.method`, `vexture.layout` and further owners. The caller must define
    ``VEXTURE_WRAP`` (values in `WRAPS`) and ``VEXTURE_FLAT`` (0 or 1) where the file asks for them.
    """
    text = included(file)
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
    chosen = {"FLAT": is_flat, "LINEAR": is_linear, "GRADIENTS": has_gradients}
    lines = "".join(f"#define VEXTURE_{name} {int(value)}\n" for name, value in chosen.items())
    return VERSIONS[version] + lines + shader_text("view_color.glsl") + COLOR_MAIN
