"""Shader text: the files of ``glsl/``, each after those that it includes, below the numbers they share with Python.

A file names what it needs by ``#include "other.glsl"``; each is included once. The numbers are those of the texture's
layout (`vexture.layout`) and of the method (`vexture.renderers.method`).
"""

import re
from functools import cache
from importlib import resources
from types import ModuleType
from typing import Final

from vexture import layout
from vexture.errors import ParameterError
from vexture.renderers import method

__all__ = ["QUALITIES", "VERSIONS", "WRAPS", "included", "shader_source", "shader_text", "vertex_source", "view_source"]

VERSIONS: Final = {
    "330": "#version 330\n",
    "300 es": "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n",
}
"""How a shader begins in each dialect that the files are written in."""


QUALITIES: Final = {"fast": method.FAST, "exact": method.EXACT}
"""What the packed texture's shader can be compiled for."""

WRAPS: Final = {"none": method.WRAP_NONE, "clamp": method.WRAP_CLAMP, "repeat": method.WRAP_REPEAT}
"""What ``glsl/wrap.glsl`` can be compiled for."""

CHOSEN: Final = {"QUALITY", "WRAP"}
"""Names whose value is chosen for each program."""

PREFIXED: Final = re.compile(r"\bVEXTURE_(\w+)")
"""A number as the packed texture's files name it: other people's shaders have names of their own."""

INCLUDE: Final = re.compile(r'^#include "(.*)"$', re.MULTILINE)


@cache
def included(name: str, package: str = "vexture") -> str:
    """Text of a shader file after the files that it includes, each once.

    Parameters
    ----------
    name : str
        Name of the file.
    package : str
        Package whose folder ``glsl/`` holds it; what it includes may also be in that of vexture.

    Raises
    ------
    FileNotFoundError
        If a file includes one that does not exist.

    Examples
    --------
    >>> included("coverage.glsl").count("VexturePlace vexture_place(")
    1
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
    """Vertex shader for three vertices without attributes, whose triangle covers the image."""
    main = "void main() { gl_Position = covering_triangle(gl_VertexID); }\n"
    return VERSIONS[version] + included("triangle.glsl") + main


def shader_source(version: str = "300 es", quality: str = "exact") -> str:
    """Text that gives a fragment shader the function ``vextureCoverage``, to stand before its own.

    It holds neither ``#version`` nor a default precision, so that it can be handed to an engine that writes them; in
    ``300 es`` the defaults of float and int must be highp.
    The shader declares ``uniform highp usampler2D vextureTexels`` and reads a `Texture` from it. All other names
    begin with ``vexture``, ``Vexture`` or ``VEXTURE``.

    Parameters
    ----------
    version : str
        ``"300 es"`` or ``"330"``; the dialect of the shader. The text is the same for both.
    quality : str
        Both integrate over the pixel's footprint, whatever its shape. ``"exact"`` cuts pieces that bend within it into
        parts and goes a level deeper into a shape that is finer than the pixels.

    Raises
    ------
    ParameterError
        If there is no such version or quality.

    Examples
    --------
    >>> "float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy)" in shader_source()
    True
    """
    if version not in VERSIONS:
        raise ParameterError(f"`version` is {version!r}; there are {', '.join(map(repr, VERSIONS))}")
    return shader_text("coverage.glsl", quality)


def shader_text(file: str, quality: str | None, *owners: ModuleType) -> str:
    """Text of one of the packed texture's files, below the numbers that it and its includes name.

    The numbers are those of `vexture.renderers.method`, of `vexture.layout` and of further owners.

    Without a quality ``VEXTURE_QUALITY`` is left to whoever compiles it, one of the values of `QUALITIES`; and so is
    ``VEXTURE_WRAP`` always, one of the values of `WRAPS`.
    """
    if quality is not None and quality not in QUALITIES:
        raise ParameterError(f"`quality` is {quality!r}; there are {', '.join(map(repr, QUALITIES))}")
    text = included(file)
    lines = [] if quality is None else [f"#define VEXTURE_QUALITY {QUALITIES[quality]!r}\n"]
    for name in sorted(set(PREFIXED.findall(text)) - CHOSEN):
        value = next((getattr(owner, name) for owner in (method, layout, *owners) if hasattr(owner, name)), None)
        if value is None:
            raise NameError(f"{file} names VEXTURE_{name}, which no owner of numbers defines")
        lines.append(f"#define VEXTURE_{name} {value!r}\n")
    return "".join(lines) + text


def view_source(version: str, quality: str) -> str:
    """Fragment shader that draws one shape of a packed texture in one colour channel (``glsl/view.glsl``)."""
    main = "out float coverage_of_pixel;\nvoid main() { coverage_of_pixel = view_coverage(gl_FragCoord.xy); }\n"
    return VERSIONS[version] + shader_text("view.glsl", quality) + main
