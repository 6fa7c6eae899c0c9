"""The interface of an encoding, and the registered encodings besides the default one.

An encoding is a package with the functions of `Encoding`. It is imported at its first use, and only from here.
"""

import os
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, NamedTuple, Protocol, TypeAlias, cast

from vexture.base.errors import ParameterError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from vexture.drawing.drawing import Drawing
    from vexture.renderers.view import Size, ViewLike

TextureRenderer: TypeAlias = Literal["cpu", "gpu"]
"""Renderer of a texture: "cpu" is the shader's mirror in Python, "gpu" the shader."""


DEFAULT: Final = "packed"
"""Encoding of `vexture.Texture`."""

REGISTERED: Final = {"thesis": "vexture.thesis"}
"""Packages of the other encodings, by name."""


class EncodedTexture(Protocol):
    """A texture in any encoding."""

    @property
    def name(self) -> str:
        """Name of the texture in messages and files."""

    @property
    def nbytes(self) -> int:
        """Size in bytes, in main memory or on a GPU."""

    def coverage(
        self,
        size: "Size",
        view: "ViewLike" = None,
        *,
        renderer: "TextureRenderer" = "cpu",
        root: str | int | None = None,
    ) -> "NDArray[np.float32]":
        """Covered part of each pixel, (height, width), 0..1; see `vexture.coverage`."""

    def render(
        self,
        size: "Size",
        view: "ViewLike" = None,
        *,
        renderer: "TextureRenderer" = "cpu",
        root: str | int | None = None,
    ) -> "NDArray[np.float32]":
        """Picture, (height, width, 4), premultiplied RGBA; see `vexture.render`."""

    def info(self) -> dict[str, Any]:
        """Describe the texture as JSON-ready data."""

    def files(self) -> dict[str, bytes]:
        """Contents of its file or files, keyed by the suffix after the texture's name."""

    def save(self, path: str | os.PathLike[str]) -> Path | tuple[Path, ...]:
        """Write its file or files, all or none; return their paths."""


class Encoded(NamedTuple):
    """A drawing in an encoding."""

    tree: Any  # has coverage, curves, deviation and unresolved, as vexture.tree.tree.Tree has
    texture: EncodedTexture
    rounding: float  # largest shift of the outline by rounding, in unit-square units


class Encoding(Protocol):
    """Functions of a registered package."""

    @property
    def SUFFIXES(self) -> tuple[str, ...]:  # noqa: N802  # a constant of the package
        """Suffixes of a texture's files."""

    def convert(self, drawing: "Drawing", **parameters: Any) -> Encoded:
        """Convert a drawing to a tree and a texture."""

    def owns(self, path: Path) -> bool:
        """Return whether a path from the user names a texture of this encoding."""

    def load(self, path: str | os.PathLike[str]) -> EncodedTexture:
        """Read a texture's file or files."""


def find_encoding(name: str) -> Encoding:
    """Return a registered encoding by its name.

    Examples
    --------
    >>> find_encoding("thesis").owns(Path("maps/delft.quads.png"))
    True
    >>> find_encoding("gif")
    Traceback (most recent call last):
    vexture.base.errors.ParameterError: `encoding` is 'gif'; it must be 'packed' or 'thesis'
    """
    if name not in REGISTERED:
        names = " or ".join(map(repr, (DEFAULT, *REGISTERED)))
        raise ParameterError(f"`encoding` is {name!r}; it must be {names}")
    return cast("Encoding", import_module(REGISTERED[name]))


def owner_of(path: Path) -> str | None:
    """Name of the registered encoding whose texture a path names, or None."""
    return next((name for name in REGISTERED if find_encoding(name).owns(path)), None)
