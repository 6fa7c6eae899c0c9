"""The thesis's pair of textures, as arrays and as files."""

import os
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import FormatError, LimitError, ParameterError
from vexture.base.layout import TEXT_ENCODING, TEXT_VERSION
from vexture.drawing.drawing import IDENTITY
from vexture.drawing.paint import Paint
from vexture.renderers.device import ONE_AT_A_TIME, VERSION, compile_shader, context, draw, upload
from vexture.renderers.picture import composite_pictures, paint_layer
from vexture.renderers.view import Size, ViewLike, size_of, view_matrix
from vexture.texture.files import file_name, is_folder, read_file, write_together
from vexture.texture.registry import TextureRenderer
from vexture.thesis import layout
from vexture.thesis.png import read_png, write_png
from vexture.thesis.shader_text import TextureSizes, ThesisPair, view_source
from vexture.thesis.tree import CellKind

REMEDY: Final = "convert the drawing again"

NOT_FOUND: Final = (
    f"a texture in the encoding thesis is the pair NAME{layout.QUADS_SUFFIX} and NAME{layout.CURVES_SUFFIX}; "
    "name either of the two"
)


@dataclass(frozen=True, slots=True, eq=False)
class ThesisTexture:
    """The thesis's pair of textures (FORMAT.md, part A).

    Parameters
    ----------
    quads : (quads, 4, 3) uint8 or uint16 array
        A row for each quad, a pixel for each cell: the cell's kind, its index, and the quad's coverage.
    curves : (2 + curves, 2, 3) array of the same type
        A row for each curve; the first two rows represent *full* and *empty*.
    to_source : (2, 3) float64 array
        Affine map from the unit square to the units of the source.
    name : str
        Name of the shape in messages and files.
    crs : str or None
        Coordinate reference system of the source units, if any.

    Raises
    ------
    FormatError
        If the arrays have another shape or type, or are longer than `layout.LIST_LIMIT`.

    Examples
    --------
    >>> import vexture
    >>> half = vexture.Drawing.polygon([(0, 0), (1, 0), (0, 1)])
    >>> texture = vexture.convert(half, encoding="thesis", bits=8)
    >>> texture.quads.shape, texture.curves.shape, texture.bits
    ((1, 4, 3), (4, 2, 3), 8)
    """

    quads: NDArray[Any]
    curves: NDArray[Any]
    to_source: NDArray[np.float64] = field(default_factory=IDENTITY.copy)
    name: str = "texture"
    crs: str | None = None

    def __post_init__(self) -> None:
        for what, pixels, width, least in (
            ("quads", self.quads, layout.QUAD_WIDTH, 1),
            ("curves", self.curves, layout.CURVE_WIDTH, layout.CONSTANT_ROWS),
        ):
            if pixels.ndim != 3 or pixels.shape[1:] != (width, 3) or pixels.dtype not in (np.uint8, np.uint16):
                raise FormatError(
                    f"{what} are {pixels.dtype}{pixels.shape}; they must be uint8 or uint16 (n, {width}, 3)"
                )
            most = layout.LIST_LIMIT[8 * pixels.dtype.itemsize]
            if not least <= len(pixels) <= most:
                raise FormatError(f"{len(pixels)} rows of {what}; there must be {least} to {most}; {REMEDY}")
        if self.quads.dtype != self.curves.dtype:
            other = 8 * self.curves.dtype.itemsize
            raise FormatError(f"quads of {self.bits} bits with curves of {other}; a pair has one depth; {REMEDY}")

    @property
    def bits(self) -> int:
        """Bits per channel, 8 or 16."""
        return 8 * int(self.quads.dtype.itemsize)

    @property
    def maximum(self) -> int:
        """Channel value that represents 1."""
        return (1 << self.bits) - 1

    def cells(self) -> tuple[NDArray[np.uint8], NDArray[np.int32]]:
        """Read the kind and index of each cell; check that the quads form a tree.

        Both results are (quads, 4), in the order of `vexture.thesis.tree.CellTree`: a `CellKind` as uint8, and the
        index of the quad or curve (not counting the constants) as int32, -1 for constant cells. Raises a `FormatError`
        unless there is exactly one reference to each row, in order.
        """
        red, green, _ = np.moveaxis(self.quads[:, np.argsort(layout.CELL_ORDER)] / self.maximum, 2, 0)
        is_quad = red > layout.THRESHOLD_QUAD
        is_corner = (red > layout.THRESHOLD_CORNER) & ~is_quad
        last = np.where(is_quad, len(self.quads) - 1, len(self.curves) - 1)
        row = np.rint(green * last).astype(np.int32)
        constant = ~is_quad & (row < layout.CONSTANT_ROWS)
        _check_rising(row[is_quad], 1, len(self.quads), "quad")
        _check_rising(row[~is_quad & ~constant], layout.CONSTANT_ROWS, len(self.curves), "curve")
        for bad, fault in (
            (is_quad & (row <= np.arange(len(row))[:, None]), "refers to itself or backwards"),
            (is_corner & constant, "calls a constant a corner"),
        ):
            if bad.any():
                quad, cell = np.argwhere(bad)[0]
                raise FormatError(f"quad {quad}, cell {cell} {fault} (row {row[quad, cell]}); {REMEDY}")
        kind = np.select(
            [is_quad, is_corner, ~constant, row == layout.FULL_ROW],
            [CellKind.QUAD, CellKind.CORNER, CellKind.CURVE, CellKind.FULL],
            CellKind.EMPTY,
        )
        row = np.where(constant, -1, np.where(is_quad, row, row - layout.CONSTANT_ROWS))
        return kind.astype(np.uint8), row.astype(np.int32)

    def check(self) -> None:
        """Raise a `FormatError` where the pixels contradict FORMAT.md."""
        self.cells()
        uneven = (self.quads[:, :, 2] != self.quads[:, :1, 2]).any(axis=1)
        if uneven.any():
            quad = uneven.argmax()
            raise FormatError(
                f"quad {quad} has coverages {self.quads[quad, :, 2].tolist()}; all must be equal; {REMEDY}"
            )
        ends = self.curves[layout.CONSTANT_ROWS :, :, 0] % self.maximum
        same = ends[:, 0] == ends[:, 1]
        if same.any():
            row = same.argmax() + layout.CONSTANT_ROWS
            raise FormatError(f"curve row {row}: P0 and P3 are both at edge step {ends[same][0, 0]}; {REMEDY}")

    @property
    def depth(self) -> int:
        """Depth of the deepest quad; the unit square has depth 0. A shader descends at most this many times."""
        kind, ref = self.cells()
        is_quad = kind == CellKind.QUAD
        level = np.zeros(1, np.int32)
        depth = -1
        while level.size:
            depth += 1
            level = ref[level][is_quad[level]]
        return depth

    @property
    def nbytes(self) -> int:
        """Size in bytes, in main memory or on a GPU."""
        return int(self.quads.nbytes + self.curves.nbytes)

    def coverage(
        self,
        size: Size,
        view: ViewLike = None,
        *,
        renderer: TextureRenderer = "cpu",
        root: str | int | None = None,
    ) -> NDArray[np.float32]:
        """Part of each pixel that the shape covers; parameters as in `vexture.coverage`."""
        if root not in (None, 0, self.name):
            raise ParameterError(f"`root` is {root!r}; {self.name} is a texture of one shape, leave it out")
        if renderer == "cpu":
            from vexture.thesis.cpu import render_thesis_cpu  # late: compiled code

            return render_thesis_cpu(self, size, view)
        if renderer != "gpu":
            raise ParameterError(f"`renderer` is {renderer!r}; a texture is rendered by 'cpu' or 'gpu'")

        return render_thesis_gpu(self, size, view)

    def render(
        self,
        size: Size,
        view: ViewLike = None,
        *,
        renderer: TextureRenderer = "cpu",
        root: str | int | None = None,
    ) -> NDArray[np.float32]:
        """Picture of the shape in black; parameters as in `vexture.render`."""
        covered = self.coverage(size, view, renderer=renderer, root=root)
        return composite_pictures(size_of(size), [paint_layer(Paint(), covered)])

    def info(self) -> dict[str, Any]:
        """Describe the texture as JSON-ready data.

        Examples
        --------
        >>> full = ThesisTexture(np.zeros((1, 4, 3), np.uint8), np.zeros((2, 2, 3), np.uint8))
        >>> full.info()["cells"]
        {'curve': 0, 'quad': 0, 'corner': 0, 'full': 4, 'empty': 0}
        """
        kind, _ = self.cells()
        counts = np.bincount(kind.ravel(), minlength=len(CellKind)).tolist()
        return {
            "encoding": layout.ENCODING_THESIS,
            "version": layout.FORMAT_VERSION,
            "bits": self.bits,
            "name": self.name,
            "quads": len(self.quads),
            "curves": len(self.curves) - layout.CONSTANT_ROWS,
            "depth": self.depth,
            "coverage": int(self.quads[0, 0, 2]) / self.maximum,
            "transform": self.to_source.tolist(),
            "crs": self.crs,
            "cells": {cell_kind.name.lower(): counts[cell_kind] for cell_kind in CellKind},
            "bytes": self.nbytes,
        }

    def texts(self) -> dict[str, str]:
        """Text chunks of both files."""
        texts = {
            TEXT_VERSION: layout.FORMAT_VERSION,
            TEXT_ENCODING: layout.ENCODING_THESIS,
            layout.TEXT_TRANSFORM: " ".join(repr(float(v)).removesuffix(".0") for v in self.to_source.flat),
        }
        return texts if self.crs is None else {**texts, layout.TEXT_CRS: self.crs}

    def to_png(self) -> tuple[bytes, bytes]:
        """Return the contents of the two files, quads and curves."""
        texts = self.texts()
        files = write_png(self.quads, texts), write_png(self.curves, texts)
        longest = max(map(len, files))
        if longest > layout.FILE_LIMIT:
            raise LimitError(f"{self.name}: a file of {longest} bytes exceeds {layout.FILE_LIMIT}; shorten its crs")
        return files

    def files(self) -> dict[str, bytes]:
        """Contents of the two files, keyed by their suffixes."""
        return dict(zip((layout.QUADS_SUFFIX, layout.CURVES_SUFFIX), self.to_png(), strict=True))

    def save(self, path: str | os.PathLike[str]) -> tuple[Path, Path]:
        """Write the pair of files, both or none; return their paths, the quads' first.

        Parameters
        ----------
        path : path
            A folder (existing, or with a separator at its end): the files get the texture's name. Otherwise either file
            or their common stem, with or without ``.png``.

        Raises
        ------
        DeviceError
            If a file cannot be written.
        """
        targets = pair_of(Path(path) / (file_name(self.name) + layout.QUADS_SUFFIX) if is_folder(path) else path)
        write_together(dict(zip(targets, self.to_png(), strict=True)))
        return targets


def _check_rising(rows: NDArray[np.int32], first: int, count: int, noun: str) -> None:
    """Raise a `FormatError` unless there is one reference to each row of a list, from `first` on, in order."""
    if len(rows) != count - first:
        raise FormatError(f"{len(rows)} references to {count - first} {noun} rows; each must have one; {REMEDY}")
    wrong = rows != np.arange(first, count)
    if wrong.any():
        place = wrong.argmax()
        raise FormatError(
            f"reference {place} to {noun} rows is to row {rows[place]}; in order it must be {first + place}; {REMEDY}"
        )


def pair_of(path: str | os.PathLike[str]) -> tuple[Path, Path]:
    """Paths of both files of a pair, from either of them, their common stem, or the stem with ``.png``.

    Examples
    --------
    >>> [str(file) for file in pair_of("maps/delft.curves.png")]
    ['maps/delft.quads.png', 'maps/delft.curves.png']
    """
    file = Path(path)
    suffixes = (layout.QUADS_SUFFIX, layout.CURVES_SUFFIX, ".png")
    suffix = next((suffix for suffix in suffixes if file.name.endswith(suffix) and file.name != suffix), "")
    stem = file.name.removesuffix(suffix)
    return file.parent / (stem + layout.QUADS_SUFFIX), file.parent / (stem + layout.CURVES_SUFFIX)


def load(path: str | os.PathLike[str]) -> ThesisTexture:
    """Read a pair of texture files.

    Parameters
    ----------
    path : path
        Either file of the pair, or their common stem, with or without ``.png``.

    Raises
    ------
    FormatError
        If a file is missing, damaged or not a texture, or if the two do not belong together.
    DeviceError
        If a file cannot be read.
    """
    quads_path, curves_path = pair_of(path)
    (quads, texts), (curves, other_texts) = (
        read_png(read_file(file, layout.FILE_LIMIT, NOT_FOUND), width, str(file))
        for file, width in ((quads_path, layout.QUAD_WIDTH), (curves_path, layout.CURVE_WIDTH))
    )
    try:
        for key in (TEXT_VERSION, TEXT_ENCODING, layout.TEXT_TRANSFORM, layout.TEXT_CRS):
            if texts.get(key) != other_texts.get(key):
                raise FormatError(f"{key} differs from that of {curves_path.name}; {REMEDY}")
        texture = ThesisTexture(
            quads,
            curves,
            _read_transform(texts),
            quads_path.name.removesuffix(layout.QUADS_SUFFIX),
            texts.get(layout.TEXT_CRS),
        )
        texture.check()
    except FormatError as error:
        raise FormatError(f"{quads_path}: {error}") from None
    return texture


def _read_transform(texts: dict[str, str]) -> NDArray[np.float64]:
    """Check version and encoding; return the affine map to the source, (2, 3)."""
    for key, known in ((TEXT_VERSION, layout.FORMAT_VERSION), (TEXT_ENCODING, layout.ENCODING_THESIS)):
        if texts.get(key) != known:
            raise FormatError(f"{key} is {texts.get(key)!r}; this program reads {known!r}; update it or {REMEDY}")
    text = texts.get(layout.TEXT_TRANSFORM, "")
    try:
        transform = np.array([float(number) for number in text.split()])
    except ValueError:
        transform = np.empty(0)
    if transform.shape != (6,) or not np.isfinite(transform).all():
        raise FormatError(f"{layout.TEXT_TRANSFORM} is {text[:80]!r}; it must be six finite numbers; {REMEDY}")
    return transform.reshape(2, 3)


@lru_cache(maxsize=64)
def program(sizes: TextureSizes) -> Any:
    """Compiled shader, with its triangle, for all textures with the same sizes."""
    return compile_shader(view_source(VERSION, sizes))


def fold(rows: NDArray[Any], height: int) -> NDArray[np.float32]:
    """Arrange a list as a texture of at most `height` rows; row r goes to row r % height in block r // height.

    `rows` is a (rows, width, 3) array, uint8 or uint16. The result is (min(rows, height), blocks * width, 4), float32
    in 0..1; unused values are 0.
    """
    count, width, channels = rows.shape
    blocks = -(-count // height)
    height = min(count, height)
    padded = np.zeros((blocks * height, width, 4), np.float32)
    padded[:count, :, :channels] = rows / np.float32(np.iinfo(rows.dtype).max)
    return padded.reshape(blocks, height, width, 4).swapaxes(0, 1).reshape(height, -1, 4)


def render_thesis_gpu(
    texture: ThesisPair, size: Size, view: ViewLike = None, fold_height: int | None = None
) -> NDArray[np.float32]:
    """Render a texture with the thesis's shader; parameters as in `vexture.coverage`.

    The lists are folded at `fold_height` rows; None folds them at the device's limit. Raises a `FormatError` if the
    texture's quads do not form a tree, a `DeviceError` without OpenGL, and a `LimitError` if the device cannot draw
    such a large image.
    """
    width, height = size_of(size)
    matrix = view_matrix(view, (width, height))
    with ONE_AT_A_TIME, context() as gl:
        sizes = TextureSizes.of_texture(texture, fold_height or gl.info["GL_MAX_TEXTURE_SIZE"])
        triangle = program(sizes)
        lists = []
        for unit, (name, rows) in enumerate((("quads", texture.quads), ("curves", texture.curves))):
            lists.append(upload(gl, fold(rows, sizes.fold_height), unit, "f4"))
            triangle.program[name] = unit
        triangle.program["list_lengths"] = (len(texture.quads), len(texture.curves))
        triangle.program["to_unit"].write(matrix.T.astype(np.float32).tobytes())
        pixels = draw(gl, triangle, (width, height))[..., 0]
        for uploaded in lists:
            uploaded.release()
    return pixels
