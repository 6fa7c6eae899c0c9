"""A texture: one array of texels, any number of shapes, one file."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base import layout
from vexture.base.errors import FormatError, LimitError, ParameterError
from vexture.drawing.paint import Paint
from vexture.renderers.picture import composite_pictures, paint_layer
from vexture.renderers.view import Size, ViewLike, size_of
from vexture.texture.check import check_styles, check_texels
from vexture.texture.describe import facts_of
from vexture.texture.files import target_of, write_together
from vexture.texture.ktx2 import check_size, write_ktx2
from vexture.texture.pictures import colours_of, coverage_of
from vexture.texture.planar import holds_pictures, read_map
from vexture.texture.registry import TextureRenderer
from vexture.texture.root import Root, deflated_texts, roots_text
from vexture.texture.select_root import layers_of, place_of
from vexture.texture.walk import walk

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from vexture.texture.pick import Elements
    from vexture.texture.restyle import Colour

WRITER: Final = "vexture"


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Texture:
    """A texture of packed quads and curves (FORMAT.md, parts B and D).

    Parameters
    ----------
    texels : (rows, width, 4) uint32 array
        Texel i lies in row i >> `layout.ROW_BITS`; the width is a power of two.
    roots : tuple of Root
        Its shapes; the layers of one drawing in painting order.
    name : str
        Names the texture in messages and files.
    source : str or None
        Its source, for people to read.

    Raises
    ------
    FormatError
        If the texels have another shape or type, or there is no root.

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
        check_size(self.texels.shape[1], self.texels.shape[0])
        if not self.roots:
            raise FormatError("a texture has at least one root; give one for each shape")

    def __repr__(self) -> str:
        """Show name, size and number of shapes."""
        height, width, _ = self.texels.shape
        return f"<Texture {self.name!r}: {width} x {height} texels, shapes: {len(self.roots)}>"

    @property
    def flat(self) -> NDArray[np.uint32]:
        """Texels by their index, (n, 4)."""
        return self.texels.reshape(-1, 4)

    @property
    def quads(self) -> NDArray[np.int64]:
        """Index of each root's quad."""
        return np.array([root.quad for root in self.roots], np.int64)

    @property
    def version(self) -> str:
        """Version of the format: the lowest that supports all kinds of its shapes."""
        quads = [root.quad for root in self.roots if root.is_map]
        if any(holds_pictures(self.flat, quad) for quad in quads):
            return layout.PICTURE_VERSION
        return layout.MAP_VERSION if quads else layout.PACKED_VERSION

    @property
    def depth(self) -> int:
        """Depth of the deepest quad; a root has depth 0. A shader descends at most this many times."""
        plain, maps = self._trees()
        depths = [len(walk(self.flat, plain)), *(len(read_map(self.flat, quad).levels) for quad in maps)]
        return max(depths) - 1

    @property
    def nbytes(self) -> int:
        """Size in bytes, in main memory or on a GPU."""
        return self.texels.nbytes

    def _trees(self) -> tuple[NDArray[np.int64], list[int]]:
        """Root quads of the silhouettes and layers, and the distinct root quads of the planar maps."""
        plain = np.array([root.quad for root in self.roots if not root.is_map], np.int64)
        return plain, sorted({root.quad for root in self.roots if root.is_map})

    def root(self, root: str | int | None = None) -> Root:
        """Return a shape by its name or number, or the only shape if `root` is None.

        Raises a `ParameterError` if there is no such shape, or if `root` is None and there are several.
        """
        return self.roots[place_of(self.roots, root, self.name)]

    def check(self) -> None:
        """Raise a `FormatError` where the texels contradict FORMAT.md; the time is proportional to their number."""
        check_texels(self.flat, *self._trees())
        check_styles(self.flat, self.roots)

    def contains(self, points: ArrayLike, root: str | int | None = None) -> NDArray[np.bool_]:
        """Test whether points are inside a shape's stored outline or, for a planar map, where it paints anything.

        Parameters
        ----------
        points : (n, 2) array
            In unit-square units, y up. Points outside 0 <= x < 1, 0 <= y < 1 are not inside.
        root : str, int or None
            Name or number of the shape; not needed if there is only one.

        Returns
        -------
        (n,) bool array
            True for each point that is inside.

        Raises
        ------
        ParameterError
            If the points are not numbers or not (n, 2), there is no such shape, or `root` is None and there are
            several.

        Examples
        --------
        >>> import vexture
        >>> texture = vexture.convert(vexture.Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8)]))
        >>> texture.contains([(0.5, 0.5), (0.1, 0.5)])
        array([ True, False])
        """
        from vexture.texture.contains import checked_points, points_inside  # late: compiled code, not needed to read

        locations, shape = checked_points(points), self.root(root)
        if shape.is_map:
            from vexture.texture.pick import painted_at

            return painted_at(self.texels, shape, locations)
        inside = np.empty(len(locations), np.bool_)
        points_inside(self.flat, shape.quad, locations, inside)
        return inside

    def element_at(self, points: ArrayLike, *, root: str | int | None = None) -> "Elements":
        """Find the topmost element at points of a drawing that was converted with `restyle`.

        Parameters
        ----------
        points : (n, 2) array
            In unit-square units, y up.
        root : str, int or None
            As in `render`.

        Returns
        -------
        Elements
            The elements' names and indices, and the indices of their shapes.

        Raises
        ------
        ParameterError
            As in `contains`; or if the shape has no elements.

        Examples
        --------
        >>> import vexture
        >>> svg = b'<svg viewBox="0 0 2 2"><path id="low" d="M0 0h2v2h-2z"/><path id="up" d="M0 0h2v1h-2z"/></svg>'
        >>> texture = vexture.convert(vexture.read(svg), split="faces", restyle=True)
        >>> texture.element_at([(0.5, 0.2), (0.5, 0.8), (0.5, 1.2)]).name.tolist()
        ['low', 'up', '']
        """
        from vexture.texture.pick import elements_at  # late: compiled code, not needed to read

        return elements_at(self.flat, self.roots, layers_of(self.roots, root, self.name), points)

    def with_paints(self, paints: "Mapping[str, Colour]", *, root: str | int | None = None) -> "Texture":
        """Recolour elements of a drawing that was converted with `restyle`; return a new texture.

        Parameters
        ----------
        paints : mapping of str to colour
            By the element's name: a CSS colour, its components in 0..1 (three, or four with the opacity), a flat
            `Paint`, or None for full transparency. It replaces the element's colour and opacity.
        root : str, int or None
            As in `render`.

        Raises
        ------
        ParameterError
            If there is no such shape, element or colour, or if an opaque element that hides others becomes
            translucent: the texture does not contain the hidden ones.

        Examples
        --------
        >>> import vexture
        >>> svg = b'<svg viewBox="0 0 1 1"><path id="a" d="M0 0h1v1h-1z"/></svg>'
        >>> texture = vexture.convert(vexture.read(svg), split="faces", restyle=True)
        >>> texture.with_paints({"a": "red"}).render(1)[0, 0].tolist()
        [1.0, 0.0, 0.0, 1.0]
        """
        from vexture.texture.restyle import restyle_texels  # late: compiled code, not needed to read

        places = layers_of(self.roots, root, self.name)
        texels, roots = restyle_texels(self.flat, self.roots, places, paints, self.name)
        return Texture(texels.reshape(self.texels.shape), roots, self.name, self.source)

    def _silhouette(self, root: str | int | None) -> Root:
        """Return a shape with outlines; raise a `ParameterError` for a planar map."""
        found = self.root(root)
        if found.is_map:
            raise ParameterError(
                f"`root` {found.name!r} is a planar map, without outlines; convert it with `split` None or 'paint'"
            )
        return found

    def coverage(
        self, size: Size, view: ViewLike = None, *, renderer: TextureRenderer = "cpu", root: str | int | None = None
    ) -> NDArray[np.float32]:
        """Part of each pixel that a shape covers. Parameters, result and errors as in `vexture.coverage`.

        Examples
        --------
        >>> full_cells = np.array([[[0, 0, 0, 0xFFFFFFFF]]], np.uint32)
        >>> Texture(full_cells, (Root("full"),)).coverage((2, 1))
        array([[0.5, 0.5]], dtype=float32)
        """
        place = place_of(self.roots, root, self.name)
        return coverage_of(self, place, self.roots[place].is_map, size, view, renderer)

    def render(
        self, size: Size, view: ViewLike = None, *, renderer: TextureRenderer = "cpu", root: str | int | None = None
    ) -> NDArray[np.float32]:
        """Picture of a drawing in its colours. Parameters, result and errors as in `vexture.render`."""
        pictures = (
            colours_of(self, place, size, view, renderer)
            if self.roots[place].is_map
            else paint_layer(
                self.roots[place].paint or Paint(), self.coverage(size, view, renderer=renderer, root=place)
            )
            for place in layers_of(self.roots, root, self.name)
        )
        return composite_pictures(size_of(size), pictures)

    def plot(self, root: str | int | None = None) -> "Figure":
        """Figure with the depths of a shape's cells, their coverage, and its picture. `root` as in `contains`.

        Returns
        -------
        matplotlib.figure.Figure
            A notebook shows it as the last value of a cell.

        Raises
        ------
        DeviceError
            If matplotlib is not installed.

        Examples
        --------
        >>> import vexture
        >>> kite = vexture.convert(vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)]))
        >>> [axes.get_title(loc="left") for axes in kite.plot().axes[:3]]
        ['cells', 'coverage', 'picture']
        """
        from vexture.texture.plot import PICTURE, plot_shape

        shape = self._silhouette(root)
        title = "picture" if len(self.roots) == 1 else f"picture of {shape.name}"
        return plot_shape(self.flat, shape.quad, self.coverage(PICTURE, root=root), title)

    def to_svg(self, root: str | int | None = None) -> str:
        """SVG document in the units of the source, with one path for each shape, in its colour or else black.

        Parameters
        ----------
        root : str, int or None
            Name or number of a shape; None draws all of them, one above the other.

        Raises
        ------
        ParameterError
            If there is no such shape.

        Examples
        --------
        >>> import vexture
        >>> texture = vexture.convert(vexture.Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.5, 0.8)]))
        >>> texture.to_svg().count("<path")
        1
        """
        from vexture.texture.outlines import outlines, svg_document

        roots = [self._silhouette(place) for place in (range(len(self.roots)) if root is None else [root])]
        return svg_document(((one, outlines(self.flat, one.quad)) for one in roots), self.name)

    def info(self) -> dict[str, Any]:
        """Describe the texture and its shapes as JSON-ready data.

        Examples
        --------
        >>> texels = np.array([[[0, 0, 0, 0xFF]]], np.uint32)
        >>> Texture(texels, (Root("a quarter"),)).info()["roots"][0]["coverage"]
        0.25
        """
        return {
            "encoding": layout.ENCODING_PACKED,
            "version": self.version,
            "name": self.name,
            "source": self.source,
            "width": self.texels.shape[1],
            "height": self.texels.shape[0],
            **facts_of(self.flat, self.roots),
            "bytes": self.nbytes,
        }

    def texts(self) -> dict[str, str]:
        """Key/value data of the file (FORMAT.md, B.5)."""
        return {**self._texts(), layout.TEXT_ROOTS: roots_text(self.roots)}

    def _texts(self) -> dict[str, str]:
        texts = {
            layout.TEXT_WRITER: WRITER,
            layout.TEXT_VERSION: self.version,
            layout.TEXT_ENCODING: layout.ENCODING_PACKED,
            layout.TEXT_NAME: self.name,
            layout.TEXT_SOURCE: self.source,
        }
        return {key: text.encode(errors="replace").decode() for key, text in texts.items() if text is not None}

    def to_ktx2(self, *, deflate: bool = True) -> bytes:
        """Content of the file; raises a `LimitError` if the description of the roots is too long."""
        texts: dict[str, str | bytes] = {**self._texts()}
        texts |= deflated_texts(self.roots) if deflate else {layout.TEXT_ROOTS: roots_text(self.roots)}
        length = sum(
            len(key) + len(text if isinstance(text, bytes) else text.encode()) + 16 for key, text in texts.items()
        )
        if length > layout.MOST_TEXT_BYTES:
            raise LimitError(
                f"{self.name}: {length} bytes say what its {len(self.roots)} roots are; the limit is "
                f"{layout.MOST_TEXT_BYTES}; use several textures"
            )
        return write_ktx2(self.texels, texts, deflate)

    def files(self, *, deflate: bool = True) -> dict[str, bytes]:
        """Content of the file, keyed by its suffix."""
        return {layout.PACKED_SUFFIX: self.to_ktx2(deflate=deflate)}

    def save(self, path: str | os.PathLike[str], *, deflate: bool = True) -> Path:
        """Write the file.

        Parameters
        ----------
        path : path
            A folder (existing, or with a separator at its end): the file gets the texture's name and ``.ktx2``.
            Otherwise the file itself, whose suffix must not be that of a drawing or a picture.
        deflate : bool
            False stores the words uncompressed, for a server that compresses its responses: Brotli or Zstandard
            then sends a third less than with deflated words.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        DeviceError
            If the file cannot be written.
        ParameterError
            If the path ends in the suffix of another kind of file, such as ``.png``.
        """
        target = target_of(path, self.name)
        write_together({target: self.to_ktx2(deflate=deflate)})
        return target
