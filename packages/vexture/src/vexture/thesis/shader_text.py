"""Shader text of the thesis's encoding: the files of this package's folder ``shaders/``, preceded by constants.

The constants are the layout of the textures, the numbers of the method and the sizes of the texture to draw, because
loops need constant bounds (thesis 4.4.2). The lengths of the texture's lists bound no loop, so they are uniforms. Thus
one program serves all textures of a depth: compiling takes longer than drawing most pictures.
"""

from dataclasses import asdict, dataclass
from types import ModuleType
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import FormatError
from vexture.renderers.shader import PICTURE_MAIN, VERSIONS, read_shader
from vexture.thesis import layout, method

PACKAGE: Final = "vexture.thesis"
"""Package whose folder ``shaders/`` holds the files."""

FOLD_HEIGHT: Final = 16384
"""Most rows of a texture; a longer list continues in the columns to the right."""


class ThesisPair(Protocol):
    """Part of a `vexture.thesis.ThesisTexture` that a renderer reads."""

    @property
    def quads(self) -> NDArray[Any]:
        """Rows of quads, (n, 4, 3), uint8 or uint16."""

    @property
    def curves(self) -> NDArray[Any]:
        """Rows of curves, (n, 2, 3), of the same type."""

    @property
    def name(self) -> str:
        """Name of the texture in messages."""


@dataclass(frozen=True, slots=True)
class TextureSizes:
    """Sizes of a texture that a shader for it is compiled with."""

    levels: int  # quads on the longest path from the root to a leaf
    fold_height: int  # rows of a list; further rows start at the top again, in the columns to the right

    @classmethod
    def of_texture(cls, texture: ThesisPair, fold_height: int = FOLD_HEIGHT) -> "TextureSizes":
        """Measure a texture by all references from its root; raise a `FormatError` if its quads do not form a tree."""
        cells = texture.quads.astype(np.float64) / np.iinfo(texture.quads.dtype).max
        last = len(cells) - 1
        below = np.rint(cells[:, :, 1] * last).astype(np.int64)
        is_quad = cells[:, :, 0] > layout.THRESHOLD_QUAD
        rows = np.zeros(1, np.int64)
        for level in range(last + 2):
            if not len(rows):
                return cls(level, fold_height)
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
    for name in filter(str.isupper, sorted(vars(module))):
        value = getattr(module, name)
        if isinstance(value, tuple):
            lines.append(f"const int {name}[{len(value)}] = int[{len(value)}]({', '.join(map(str, value))});")
        elif isinstance(value, int | float):
            lines.append(f"const {type(value).__name__} {name} = {value!r};")
    return "\n".join(lines) + "\n"


def compose(version: str, file: str, main: str, sizes: TextureSizes | None = None) -> str:
    """Compose a shader: the version's first lines, the constants, a file with its includes, and `main`.

    `main` declares the outputs and defines the function ``main``. `sizes` belong to the texture that is read, if any.
    """
    injected = "".join(f"const int {name.upper()} = {size};\n" for name, size in asdict(sizes).items()) if sizes else ""
    return VERSIONS[version] + constants(layout) + constants(method) + injected + read_shader(file, PACKAGE) + main


def view_source(version: str, sizes: TextureSizes) -> str:
    """Fragment shader that draws textures with given sizes in one colour channel."""
    return compose(version, "view.glsl", PICTURE_MAIN, sizes)
