"""Shader text of the thesis's encoding: the files of ``glsl/`` beside this module, below their numbers.

In front stand, as constants, the layout of the textures, the numbers of the method and, since loops need constant
bounds (thesis 4.4.2), the sizes of the texture that is drawn. The lengths of its lists bound no loop; they are
uniforms, so that one program serves all textures of a depth: compiling takes longer than most pictures.
"""

from dataclasses import asdict, dataclass
from types import ModuleType
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from vexture.errors import FormatError
from vexture.renderers.shader import VERSIONS, included
from vexture.thesis import layout, method

__all__ = ["FOLD_HEIGHT", "Pair", "TextureSizes", "compose", "constants", "source", "thesis_text", "view_source"]

PACKAGE: Final = "vexture.thesis"
"""Whose ``glsl/`` holds the files."""

FOLD_HEIGHT: Final = 16384
"""Rows; a list longer than a texture is high goes on in the columns to its right."""


class Pair(Protocol):
    """The data that the shader is given: a `vexture.thesis.ThesisTexture`."""

    @property
    def quads(self) -> NDArray[Any]:
        """Rows of quads, (n, 4, 3) uint8 or uint16."""

    @property
    def curves(self) -> NDArray[Any]:
        """Rows of curves, (n, 2, 3) of the same type."""

    @property
    def name(self) -> str:
        """Names it in messages."""


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
    def of(cls, texture: Pair, fold_height: int = FOLD_HEIGHT) -> "TextureSizes":
        """Sizes of a texture.

        Raises
        ------
        FormatError
            If its quads do not form a tree.
        """
        return cls(count_levels(texture), fold_height)


def count_levels(texture: Pair) -> int:
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
    return VERSIONS[version] + constants(layout) + constants(method) + injected + thesis_text(file) + main


def thesis_text(file: str) -> str:
    """Text of one of the files after those that it includes.

    Examples
    --------
    >>> thesis_text("inside.glsl").count("Roots solve_cubic(")
    1
    """
    return included(file, PACKAGE)


def source(version: str, texture: Pair, fold_height: int = FOLD_HEIGHT) -> str:
    """Fragment shader that draws a texture in one colour channel (``glsl/view.glsl``).

    Parameters
    ----------
    version : str
        ``"330"`` or ``"300 es"``.
    texture : Pair
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
