"""The packed texture itself: one array of texels, any number of shapes, one file."""

import difflib
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.encoding import layout
from vexture.encoding.files import packed_target, read_file, write_together
from vexture.encoding.ktx2 import read_ktx2, write_ktx2
from vexture.encoding.packed_walk import walk
from vexture.encoding.root import Root, read_roots, roots_text
from vexture.errors import FormatError, LimitError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["PackedTexture", "Root", "load_packed", "packed_from"]

REMEDY = "convert the drawing again"
WRITER = "vexture"


@dataclass(frozen=True, slots=True, eq=False)
class PackedTexture:
    """A texture of packed quads and curves (FORMAT.md, part B).

    Parameters
    ----------
    texels : (rows, width, 4) uint32 array
        Texel i lies in row i >> `layout.ROW_BITS`; the width is a power of two.
    roots : tuple of Root
        Its shapes; the layers of one drawing in painting order.
    name : str
        Names the texture in messages and files.
    source : str or None
        Where it was made from, for people.

    Raises
    ------
    FormatError
        If the texels are of another shape or type, or there is no root.

    Examples
    --------
    >>> import vexture
    >>> texture = vexture.convert(vexture.Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.5, 0.8)]))
    >>> texture.roots[0].name, texture.depth, texture.texels.dtype
    ('drawing', 0, dtype('uint32'))
    """

    texels: NDArray[np.uint32]
    roots: tuple[Root, ...]
    name: str = "texture"
    source: str | None = None

    def __post_init__(self) -> None:
        if self.texels.ndim != 3 or self.texels.shape[2] != 4 or self.texels.dtype != np.uint32:
            raise FormatError(
                f"texels are {self.texels.dtype}{self.texels.shape}; they must be uint32 (rows, width, 4)"
            )
        rows, width, _ = self.texels.shape
        full = width == 1 << layout.ROW_BITS
        if width.bit_count() != 1 or width > 1 << layout.ROW_BITS or not 1 <= rows <= (layout.MOST_ROWS if full else 1):
            raise FormatError(
                f"{width} x {rows} texels; a texture is {1 << layout.ROW_BITS} wide and 1 to {layout.MOST_ROWS} high, "
                "or one row of a smaller power of two"
            )
        if not self.roots:
            raise FormatError("a texture has at least one root; give one for each shape")

    @property
    def flat(self) -> NDArray[np.uint32]:
        """The texels by their index, (n, 4)."""
        return self.texels.reshape(-1, 4)

    @property
    def quads(self) -> NDArray[np.int64]:
        """Index of each root's quad."""
        return np.array([root.quad for root in self.roots], np.int64)

    @property
    def depth(self) -> int:
        """Depth of the deepest quad; a root has depth 0. A shader descends at most this often."""
        return len(walk(self.flat, self.quads)) - 1

    @property
    def nbytes(self) -> int:
        """Size in memory, of a GPU too."""
        return self.texels.nbytes

    def root(self, which: str | int = 0) -> Root:
        """One of the shapes, by its name or its place.

        Parameters
        ----------
        which : str or int
            Name, or place from 0.

        Returns
        -------
        Root

        Raises
        ------
        FormatError
            If there is none of that name or place.

        Examples
        --------
        >>> texture = PackedTexture(np.zeros((1, 1, 4), np.uint32), (Root("anchor"), Root("apple")))
        >>> texture.root("anchor").quad
        0
        >>> texture.root("anker")
        Traceback (most recent call last):
        vexture.errors.FormatError: texture: no root 'anker'; near names are 'anchor', 'apple'; there are 2
        """
        if isinstance(which, str):
            for root in self.roots:
                if root.name == which:
                    return root
            names = [root.name for root in self.roots]
            near = difflib.get_close_matches(which, names, n=5) or names[:5]
            listed = ", ".join(map(repr, near))
            raise FormatError(f"{self.name}: no root {which!r}; near names are {listed}; there are {len(names)}")
        if not 0 <= which < len(self.roots):
            raise FormatError(f"{self.name}: no root {which}; they are numbered 0 to {len(self.roots) - 1}")
        return self.roots[which]

    def check(self) -> None:
        """Raise a `FormatError` where the texels contradict FORMAT.md; takes time in proportion to their number."""
        flat = self.flat
        levels = walk(flat, self.quads)
        met = np.zeros(len(flat), np.bool_)
        for level in levels:
            met[level.quads], met[level.curves] = True, True
        unmet = flat.any(axis=1) & ~met
        if unmet.any():
            raise FormatError(f"texel {unmet.argmax()} belongs to no root and is not 0; {REMEDY}")
        curves = np.concatenate([level.curves for level in levels])
        ends = flat[curves][:, [0, 3]]
        most = np.maximum(ends & ((1 << layout.COORDINATE_BITS) - 1), ends >> layout.COORDINATE_BITS).max(
            axis=1, initial=0
        )
        if len(most) and most.max() > layout.LATTICE:
            raise FormatError(
                f"curve {curves[most.argmax()]} has an end at {most.max()}; the limit is {layout.LATTICE:.0f}; {REMEDY}"
            )

    def contains(self, points: ArrayLike, root: str | int | None = None) -> NDArray[np.bool_]:
        """Which points are inside a shape, by the outlines as they are stored.

        Parameters
        ----------
        points : (n, 2) array
            In unit-square units, y up. Nothing is inside beyond 0 <= x < 1, 0 <= y < 1.
        root : str, int or None
            Name or place of the shape; not needed if there is only one.

        Returns
        -------
        (n,) bool array
            For each point whether it is inside.

        Raises
        ------
        LimitError
            If the points are of another shape, or no shape is named where there are several.
        FormatError
            If there is no such shape.

        Examples
        --------
        >>> from vexture.drawing import Drawing
        >>> import vexture.encoding
        >>> from vexture.quadtree.build_packed import build_packed
        >>> square = Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)])
        >>> texture = vexture.encoding.encode_packed([build_packed(square)], [Root("square")], name="square")
        >>> texture.contains([(0.5, 0.5), (0.1, 0.5)])
        array([ True, False])
        """
        from vexture.encoding.contains import points_inside  # late: compiled code, which readers need not wait for

        wanted = np.asarray(points, np.float64)
        if wanted.ndim != 2 or wanted.shape[1] != 2:
            raise LimitError(f"points have the shape {wanted.shape}; it must be (n, 2)")
        if root is None and len(self.roots) > 1:
            raise LimitError(f"{self.name} holds {len(self.roots)} shapes; choose one by root")
        inside = np.empty(len(wanted), np.bool_)
        points_inside(self.flat, self.root(root or 0).quad, wanted, inside)
        return inside

    def plot(self, root: str | int = 0) -> "Figure":
        """Show a shape's cells, coverage and picture side by side, in a notebook too.

        Parameters
        ----------
        root : str or int
            Name or place of the shape.

        Returns
        -------
        matplotlib.figure.Figure
            See `vexture.figures.overview.summary`.

        Raises
        ------
        DeviceError
            If matplotlib is not installed.
        FormatError
            If there is no such shape.

        Examples
        --------
        >>> import vexture
        >>> from vexture.evaluation.shape import example
        >>> vexture.convert(example("duck")).plot().axes[0].get_title(loc="left")
        'cells'
        """
        from vexture.figures.overview import summary  # late: figures stand above textures

        return summary(self, root=root)

    def to_svg(self, root: str | int | None = None) -> str:
        """Return the outlines as an SVG document in the units of the source.

        Parameters
        ----------
        root : str, int or None
            Name or place of a shape; None draws all of them, one above the other.

        Returns
        -------
        str
            A document, of which each shape is a path in its colour, else black.

        Raises
        ------
        FormatError
            If there is no such shape.

        Examples
        --------
        >>> import vexture
        >>> texture = vexture.convert(vexture.Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.5, 0.8)]))
        >>> texture.to_svg().count("<path")
        1
        """
        from vexture.encoding.outlines import outlines
        from vexture.encoding.svg_text import svg_document

        roots = self.roots if root is None else (self.root(root),)
        return svg_document(((one, outlines(self.flat, one.quad)) for one in roots), self.name)

    def texts(self) -> dict[str, str]:
        """Key/value data of the file (FORMAT.md, B.5), by their keys."""
        texts = {
            layout.TEXT_WRITER: WRITER,
            layout.TEXT_VERSION: layout.PACKED_VERSION,
            layout.TEXT_ENCODING: layout.ENCODING_PACKED,
            layout.TEXT_NAME: self.name,
            layout.TEXT_SOURCE: self.source,
            layout.TEXT_ROOTS: roots_text(self.roots),
        }
        return {key: text.encode(errors="replace").decode() for key, text in texts.items() if text is not None}

    def to_ktx2(self) -> bytes:
        """Return the contents of the file.

        Raises
        ------
        LimitError
            If the names and transforms of the roots are too long.
        """
        texts = self.texts()
        length = sum(len(key.encode()) + len(text.encode()) + 16 for key, text in texts.items())
        if length > layout.MOST_TEXT_BYTES:
            raise LimitError(
                f"{self.name}: {length} bytes say what its {len(self.roots)} roots are; the limit is "
                f"{layout.MOST_TEXT_BYTES}; use several textures"
            )
        return write_ktx2(self.texels, texts)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the file.

        Parameters
        ----------
        path : path
            A folder (that exists or ends with a separator): the file gets the texture's name and ``.ktx2``. Else
            the file itself.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        DeviceError
            If the disk refuses.
        """
        target = packed_target(path, self.name)
        write_together({target: self.to_ktx2()})
        return target


def load_packed(path: Path) -> PackedTexture:
    """Read a packed texture's file.

    Raises
    ------
    FormatError
        If it is missing, damaged or not a packed texture.
    DeviceError
        If it may not be read.
    """
    return packed_from(read_file(path, layout.PACKED_FILE_LIMIT), str(path))


def packed_from(data: bytes, source: str) -> PackedTexture:
    """Read the content of a packed texture's file, and check it.

    Parameters
    ----------
    data : bytes
    source : str
        Name of the file, for messages, and for a texture that says no name.

    Raises
    ------
    FormatError
        If it is damaged or not a packed texture.
    """
    if len(data) > layout.PACKED_FILE_LIMIT:
        raise FormatError(f"{source}: longer than {layout.PACKED_FILE_LIMIT} bytes, so not a texture; {REMEDY}")
    texels, texts = read_ktx2(data, source)
    try:
        for key, known in (
            (layout.TEXT_ENCODING, layout.ENCODING_PACKED),
            (layout.TEXT_VERSION, layout.PACKED_VERSION),
        ):
            if texts.get(key) != known:
                found = repr(texts.get(key))[:80]
                raise FormatError(f"{key} is {found}; this program reads {known!r}; update it or {REMEDY}")
        name = texts.get(layout.TEXT_NAME) or Path(source).name.removesuffix(layout.PACKED_SUFFIX)
        roots = read_roots(texts.get(layout.TEXT_ROOTS, ""))
        texture = PackedTexture(texels, roots, name, texts.get(layout.TEXT_SOURCE))
        texture.check()
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None
    return texture
