"""Shader text: the files of ``glsl/``, joined, below the numbers that they share with Python.

A file names what it needs by ``#include "other.glsl"``; each is joined once. In front stand, as constants, the layout
of the textures (`vexture.encoding.layout`), the numbers of the method (`vexture.shading`) and, since loops need
constant bounds (thesis 4.4.2), the sizes of the texture that is to be drawn. The lengths of its lists bound no loop;
they are uniforms, so that one program serves all textures of a depth: compiling takes longer than most pictures.
"""

import re
from dataclasses import asdict, dataclass
from functools import cache
from importlib import resources
from types import ModuleType
from typing import Final

import numpy as np

from vexture import shading
from vexture.encoding import layout
from vexture.encoding.texture import ThesisTexture
from vexture.errors import FormatError, LimitError

__all__ = [
    "FOLD_HEIGHT",
    "QUALITIES",
    "VERSIONS",
    "WRAPS",
    "TextureSizes",
    "compose",
    "constants",
    "join",
    "packed_text",
    "packed_view_source",
    "shader_source",
    "source",
    "vertex_source",
]

VERSIONS: Final = {
    "330": "#version 330\n",
    "300 es": "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n",
}
"""How a shader begins in each dialect that the files are written in."""

FOLD_HEIGHT: Final = 16384
"""Rows; a list longer than a texture is high goes on in the columns to its right."""

QUALITIES: Final = {"fast": shading.FAST, "exact": shading.EXACT}
"""What the packed texture's shader can be compiled for."""

WRAPS: Final = {"none": shading.WRAP_NONE, "clamp": shading.WRAP_CLAMP, "repeat": shading.WRAP_REPEAT}
"""What ``glsl/packed_wrap.glsl`` can be compiled for."""

CHOSEN: Final = {"QUALITY", "WRAP"}
"""Names whose value is chosen for each program."""

PREFIXED: Final = re.compile(r"\bVEXTURE_(\w+)")
"""A number as the packed texture's files name it: other people's shaders have names of their own."""

INCLUDE: Final = re.compile(r'^#include "(.*)"$', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class TextureSizes:
    """What a shader must know of a texture when it is compiled.

    Parameters
    ----------
    levels : int
        Number of quads on the longest way from the root to a leaf.
    fold_height : int
        Rows of each list that fit below one another; the next ones start again at the top, further right.
    """

    levels: int
    fold_height: int

    @classmethod
    def of(cls, texture: ThesisTexture, fold_height: int = FOLD_HEIGHT) -> "TextureSizes":
        """Sizes of a texture.

        Raises
        ------
        FormatError
            If its quads do not form a tree.
        """
        return cls(count_levels(texture), fold_height)


def count_levels(texture: ThesisTexture) -> int:
    """Follow all references from the root, level by level."""
    cells = texture.quads.astype(np.float64) / np.iinfo(texture.quads.dtype).max
    last = len(cells) - 1
    below = np.rint(cells[:, :, 1] * last).astype(np.int64)
    is_quad = cells[:, :, 0] > layout.THRESHOLD_QUAD
    rows = np.zeros(1, np.int64)
    for level in range(last + 2):
        if not len(rows):
            return level
        rows = np.unique(below[rows][is_quad[rows]])
    raise FormatError(f"{texture.name}: a quad of the texture lies below itself; convert the drawing again")


def constants(module: ModuleType) -> str:
    """GLSL declarations of a module's public numbers.

    Examples
    --------
    >>> print(next(line for line in constants(layout).splitlines() if "CELL_ORDER" in line))
    const int CELL_ORDER[4] = int[4](2, 3, 0, 1);
    """
    lines = []
    for name in module.__all__:
        value = getattr(module, name)
        if isinstance(value, tuple):
            lines.append(f"const int {name}[{len(value)}] = int[{len(value)}]({', '.join(map(str, value))});")
        elif isinstance(value, int | float):
            lines.append(f"const {type(value).__name__} {name} = {value!r};")
    return "\n".join(lines) + "\n"


@cache
def join(name: str) -> str:
    """Text of a file of ``glsl/`` after the files that it includes, each once.

    Raises
    ------
    FileNotFoundError
        If a file includes one that does not exist.

    Examples
    --------
    >>> join("inside.glsl").count("Roots solve_cubic(")
    1
    """
    folder = resources.files("vexture") / "glsl"
    joined: dict[str, str] = {}

    def add(name: str, wanted_by: str) -> None:
        if name in joined:
            return
        if not re.fullmatch(r"\w+\.glsl", name) or not (folder / name).is_file():
            raise FileNotFoundError(f"{wanted_by} includes {name!r}, which is not in glsl/")
        text = (folder / name).read_text(encoding="utf-8")
        for other in INCLUDE.findall(text):
            add(other, name)
        joined[name] = INCLUDE.sub("", text)

    add(name, "a caller")
    return "\n".join(joined.values())


def compose(version: str, file: str, main: str, sizes: TextureSizes | None = None) -> str:
    """Whole shader: the version's first lines, the constants, a file with its includes, a main function.

    Parameters
    ----------
    version : str
        ``"330"`` or ``"300 es"``.
    file : str
        Name of the file in ``glsl/``.
    main : str
        What follows it: outputs and ``main``.
    sizes : TextureSizes, optional
        Of the texture that is read, if one is.
    """
    injected = "".join(f"const int {name.upper()} = {size};\n" for name, size in asdict(sizes).items()) if sizes else ""
    return VERSIONS[version] + constants(layout) + constants(shading) + injected + join(file) + main


def source(version: str, texture: ThesisTexture, fold_height: int = FOLD_HEIGHT) -> str:
    """Fragment shader that draws a texture in one colour channel (``glsl/view.glsl``).

    Parameters
    ----------
    version : str
        ``"330"`` or ``"300 es"``.
    texture : ThesisTexture
        Whose sizes are injected.
    fold_height : int
        Rows of the textures that it will be given.

    Raises
    ------
    FormatError
        If the texture's quads do not form a tree.
    """
    return view_source(version, TextureSizes.of(texture, fold_height))


def view_source(version: str, sizes: TextureSizes) -> str:
    """Like `source`, for all textures of the same sizes."""
    main = "out float coverage_of_pixel;\nvoid main() { coverage_of_pixel = view_coverage(gl_FragCoord.xy); }\n"
    return compose(version, "view.glsl", main, sizes)


def vertex_source(version: str) -> str:
    """Vertex shader for three vertices without attributes, whose triangle covers the image."""
    return compose(version, "triangle.glsl", "void main() { gl_Position = covering_triangle(gl_VertexID); }\n")


def shader_source(version: str = "300 es", quality: str = "exact") -> str:
    """Text that gives a fragment shader the function ``vextureCoverage``, to stand before its own.

    It holds neither ``#version`` nor a default precision, so that it can be handed to an engine that writes them; in
    ``300 es`` the defaults of float and int must be highp.
    The shader declares ``uniform highp usampler2D vextureTexels`` and reads a `PackedTexture` from it. All other names
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
    LimitError
        If there is no such version or quality.

    Examples
    --------
    >>> "float vextureCoverage(uint root, vec2 uv, vec2 dx, vec2 dy)" in shader_source()
    True
    """
    if version not in VERSIONS:
        raise LimitError(f"version is {version!r}; there are {', '.join(map(repr, VERSIONS))}")
    return packed_text("packed_coverage.glsl", quality)


def packed_text(file: str, quality: str | None, *owners: ModuleType) -> str:
    """Text of one of the packed texture's files, below the numbers that it and its includes name.

    The numbers are those of `vexture.shading`, of `vexture.encoding.layout` and of further owners.

    Without a quality ``VEXTURE_QUALITY`` is left to whoever compiles it, one of the values of `QUALITIES`; and so is
    ``VEXTURE_WRAP`` always, one of the values of `WRAPS`.
    """
    if quality is not None and quality not in QUALITIES:
        raise LimitError(f"quality is {quality!r}; there are {', '.join(map(repr, QUALITIES))}")
    text = join(file)
    lines = [] if quality is None else [f"#define VEXTURE_QUALITY {QUALITIES[quality]!r}\n"]
    for name in sorted(set(PREFIXED.findall(text)) - CHOSEN):
        value = next((getattr(owner, name) for owner in (shading, layout, *owners) if hasattr(owner, name)), None)
        if value is None:
            raise NameError(f"{file} names VEXTURE_{name}, which no owner of numbers defines")
        lines.append(f"#define VEXTURE_{name} {value!r}\n")
    return "".join(lines) + text


def packed_view_source(version: str, quality: str) -> str:
    """Fragment shader that draws one shape of a packed texture in one colour channel (``glsl/packed_view.glsl``)."""
    main = "out float coverage_of_pixel;\nvoid main() { coverage_of_pixel = packed_view_coverage(gl_FragCoord.xy); }\n"
    return VERSIONS[version] + packed_text("packed_view.glsl", quality) + main
