"""One name each for what both encodings can do: `load`, `encode`, `decode`, `info`."""

import os
from pathlib import Path
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from vexture.encoding import layout, thesis
from vexture.encoding.files import pair_of
from vexture.encoding.ktx2 import MAGIC
from vexture.encoding.packed import decode_packed, encode_packed, info_packed
from vexture.encoding.packed_texture import PackedTexture, Root, load_packed
from vexture.encoding.texture import ThesisTexture, load_thesis
from vexture.errors import FormatError
from vexture.quadtree.tree import CellTree, PackedTree

__all__ = ["decode", "encode", "info", "load"]


def load(path: str | os.PathLike[str]) -> ThesisTexture | PackedTexture:
    """Read a texture's file or pair of files.

    Parameters
    ----------
    path : path
        A packed texture's file, either file of a pair, or what their names have in common.

    Returns
    -------
    PackedTexture or ThesisTexture
        Checked: none of its indices leads astray.

    Raises
    ------
    FormatError
        If a file is missing, damaged or not a texture, if the two of a pair do not belong together, or if the path
        means a packed texture as well as a pair.
    DeviceError
        If a file may not be read.

    Examples
    --------
    >>> import tempfile
    >>> import vexture
    >>> kite = vexture.convert(vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)]))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     again = load(kite.save(Path(folder) / "kite.ktx2"))
    >>> bool((again.texels == kite.texels).all())
    True
    """
    given = Path(path)
    if given.suffix.lower() == layout.PACKED_SUFFIX or _is_ktx2(given):
        return load_packed(given)
    packed_file = given.with_name(given.name + layout.PACKED_SUFFIX) if given.name else given
    if given.suffix.lower() != ".png" and packed_file.is_file():
        pair = pair_of(given)
        if pair[0].is_file() or pair[1].is_file():
            raise FormatError(f"{path} means {packed_file} as well as {pair[0]}; name one of them")
        return load_packed(packed_file)
    return load_thesis(given)


def _is_ktx2(path: Path) -> bool:
    """Whether there is such a file and it begins as KTX 2.0 does."""
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


@overload
def encode(
    tree: CellTree, bits: int = 16, *, to_source: NDArray[np.float64], name: str, crs: str | None = None
) -> ThesisTexture: ...


@overload
def encode(tree: PackedTree, *, to_source: NDArray[np.float64], name: str, crs: str | None = None) -> PackedTexture: ...


def encode(
    tree: CellTree | PackedTree,
    bits: int = 16,
    *,
    to_source: NDArray[np.float64],
    name: str,
    crs: str | None = None,
) -> ThesisTexture | PackedTexture:
    """Texture of a tree: a thesis pair, or a packed texture of one shape.

    See `vexture.encoding.thesis.encode` and, for several shapes in one texture, `encode_packed`.

    Parameters
    ----------
    tree : CellTree or PackedTree
    bits : int
        Bits per channel of a pair, 8 or 16; a packed texture knows no such choice.
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    name : str
        Names the shape in messages and files.
    crs : str or None
        Coordinate reference system of the source units.

    Raises
    ------
    LimitError
        If the tree is too large, or a point lies where the format cannot say it.
    """
    if isinstance(tree, CellTree):
        return thesis.encode(tree, bits, to_source=to_source, name=name, crs=crs)
    return encode_packed([tree], [Root(name, 0, to_source, tree.deviation, crs)], name=name)


@overload
def decode(texture: ThesisTexture) -> CellTree: ...


@overload
def decode(texture: PackedTexture, root: str | int = 0) -> PackedTree: ...


def decode(texture: ThesisTexture | PackedTexture, root: str | int = 0) -> CellTree | PackedTree:
    """Tree of a texture; of a packed texture, that of one of its roots, by name or place.

    See `vexture.encoding.thesis.decode` and `decode_packed`.

    Raises
    ------
    FormatError
        If the texture contradicts FORMAT.md, or has no such root.
    """
    return thesis.decode(texture) if isinstance(texture, ThesisTexture) else decode_packed(texture, root)


def info(texture: ThesisTexture | PackedTexture) -> dict[str, Any]:
    """Describe a texture, ready for JSON."""
    return thesis.info(texture) if isinstance(texture, ThesisTexture) else info_packed(texture)
