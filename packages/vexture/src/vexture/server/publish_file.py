"""Conversion of a file's content, of any kind, into a shape for publishing."""

import time
from dataclasses import replace
from functools import cache
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

from vexture.base.content import FileKind, about, decompress, kind_of, known_kind, start_of
from vexture.base.errors import SourceError
from vexture.base.notes import line_of
from vexture.conversion.parameters import Parameters, Split
from vexture.server.published import TEXTURE_TYPE, PublishedFile, PublishedShape

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from vexture.drawing.drawing import Drawing
    from vexture.svg.frames import Frame

VIEW_PRECISION = 1e-7
"""Precision in unit-square units: at 10,000x, 1000 pixels show 1e-4 of the square, so the error is below a pixel."""

VIEWER_PARAMETERS = Parameters(split="faces", precision=VIEW_PRECISION)
"""Parameters of the viewer: in colours, and precise enough for the deepest zoom."""

PUBLISHED_PARAMETERS = Parameters(split="faces")
"""Parameters of a server: in colours, and small, because pages fetch a shape again after each change."""

THESIS_BITS = {"thesis16": 16, "thesis8": 8}
"""Bits per channel of each view in the thesis encoding."""

CONVERTED = "converted"
"""View with the file that `vexture convert` writes by default, which is smaller than the viewer's own texture."""

ANONYMOUS_WINDOW = (300.0, 150.0)
"""Size in pixels at which browsers show an SVG without a size (CSS 2.1, 10.3.2)."""

SMALL = b"""<svg viewBox="0 0 9 9"><path d="M1 1L5 8 8 1 1 6 8 6z"/>
<path fill="red" d="M2 2C9 2 2 9 7 7S1 6 2 2zM-1 4A3 3 0 0 1 5 4z"/></svg>"""
"""Drawing that uses all kernels: corners, curves, crossings, two colours, parts outside the box."""


def shape_of(
    data: bytes, file_name: str, name: str, parameters: Parameters, folder: Path | None = None
) -> PublishedShape:
    """Convert the content of a file, or check that of a packed texture, into a shape for publishing.

    The file's name is for messages only; nothing is opened but images of an SVG in `folder`. The facts of the shape
    hold the notes as text. Its views are for comparison: the source of an SVG and, if a precision is set, the texture
    that `vexture convert` writes.

    Examples
    --------
    >>> shape = shape_of(b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/></svg>', "half.svg", "half", Parameters())
    >>> shape.facts["segments"], shape.facts["box"]
    (4, [0.0, 0.0, 1.0, 1.0])
    """
    from vexture.conversion.reading import images_of, read_drawing
    from vexture.svg.read import framed_drawing

    with about(file_name):
        plain = decompress(data)
    if kind_of(start_of(plain), file_name) is FileKind.TEXTURE:
        return texture_shape(data, file_name, name)
    with about(file_name):
        kind = known_kind(start_of(plain), file_name)
    load_kernels()
    start = time.perf_counter()
    framed = None
    if kind is FileKind.SVG:
        images = images_of(folder, parameters.images)
        fonts = parameters.fonts or ()
        given: dict[str, Any] = {"fonts": fonts, "images": images, "page_colors": parameters.page_colors}
        drawing, framed = framed_drawing(plain, file_name, parameters.select, **given)
    else:
        reading: dict[str, Any] = {"select": parameters.select, "images": parameters.images}
        drawing = read_drawing(plain, name=file_name, for_outlines=parameters.split is None, **reading)
    named = replace(drawing, name=name)
    shape = shape_of_drawing(named, file_name, parameters, start)
    if parameters.precision is not None:
        shape = replace(shape, views={CONVERTED: _as_written(named, file_name, parameters)})
    if kind is not FileKind.SVG:
        return shape
    facts = {**shape.facts, "box": _box_in_browsers(framed, drawing.to_source)}
    return replace(shape, facts=facts, views={**shape.views, "svg": PublishedFile(plain, "image/svg+xml", ".svg")})


def thesis_pair(shape: PublishedShape, bits: int) -> tuple[bytes, ...]:
    """Convert a shape's source, ``views["svg"]``, into the thesis encoding of 8 or 16 bits; return the files."""
    from vexture.conversion.pipeline import convert
    from vexture.conversion.reading import read_drawing

    source = shape.views.get("svg")
    if source is None:
        raise SourceError(f"{shape.name}: a texture without its drawing cannot be compared; publish the drawing")
    drawing = replace(read_drawing(source.data, name=f"{shape.name}.svg"), name=shape.name)
    texture = convert(drawing, encoding="thesis", bits=bits)
    return tuple(texture.files().values())


@cache
def load_thesis() -> None:
    """Load the kernels of the thesis encoding; `load_kernels` loads the others."""
    from vexture.conversion.pipeline import convert
    from vexture.svg.read import svg_drawing

    convert(svg_drawing(SMALL, "small.svg"), encoding="thesis")


@cache
def load_kernels() -> None:
    """Load the kernels once per process, so that no conversion's time includes it."""
    from vexture.conversion.pipeline import convert
    from vexture.svg.read import svg_drawing

    convert(svg_drawing(SMALL, "small.svg"), split="faces", precision=VIEW_PRECISION)


def shape_of_drawing(drawing: "Drawing", file_name: str, parameters: Parameters, start: float) -> PublishedShape:
    """Convert a drawing into a shape, with the facts of its conversion; the notes, if any, form one line."""
    from vexture.conversion.pipeline import combine, trees_of

    reading = replace(parameters, select=None, fonts=None, images="draw", page_colors=None)  # already read
    part = trees_of(drawing, reading)
    texture = combine([part], drawing.name, PurePath(file_name).name)
    milliseconds = 1000.0 * (time.perf_counter() - start)
    data = texture.to_ktx2()
    line = line_of(file_name, part.notes)
    facts = {
        "segments": drawing.segments,
        "layers": len(part.trees),
        "quads": sum(len(tree.count) for tree in part.trees),
        "curves": sum(len(tree.curves) for tree in part.trees),
        "bytes": len(data),
        "milliseconds": round(milliseconds, 2),
        "distance": max(tree.deviation for tree in part.trees) + part.rounding,
        "to_source": drawing.to_source.ravel().tolist(),
        "box": None,
        "select": parameters.select,
        "warnings": [line] if line else [],
        "notes": [note.facts() for note in part.notes],
    }
    return PublishedShape(drawing.name, PublishedFile(data, TEXTURE_TYPE, ".ktx2"), facts)


def _as_written(drawing: "Drawing", file_name: str, parameters: Parameters) -> PublishedFile:
    """Return the file that `vexture convert` writes for a drawing, at the default accuracy."""
    split: Split = "auto" if parameters.split == VIEWER_PARAMETERS.split else parameters.split
    return shape_of_drawing(
        drawing, file_name, Parameters(split=split, max_seconds=parameters.max_seconds), 0.0
    ).texture


def texture_shape(data: bytes, file_name: str, name: str) -> PublishedShape:
    """Make the shape of a texture; facts that the texture does not store are None."""
    from vexture.texture.load import texture_from

    texture = texture_from(data, file_name)
    roots: list[dict[str, Any]] = texture.info()["roots"]
    facts = {
        "segments": None,
        "layers": len(roots),
        "quads": sum(root["quads"] for root in roots),
        "curves": sum(root["curves"] for root in roots),
        "bytes": len(data),
        "milliseconds": None,
        "distance": max(root["tolerance"] for root in roots),
        "to_source": texture.roots[0].to_source.ravel().tolist(),
        "box": None,
        "select": None,
        "warnings": [],
        "notes": [],
    }
    return PublishedShape(name, PublishedFile(data, TEXTURE_TYPE, ".ktx2"), facts)


def _box_in_browsers(framed: "Frame | None", to_source: "NDArray[np.float64]") -> list[float]:
    """Return the part of the unit square that browsers show of an SVG: x0, y0, x1, y1."""
    import numpy as np

    size, matrix = ANONYMOUS_WINDOW, np.eye(2, 3)
    if framed is not None:
        size, _, (a, b, c, d, e, f) = framed
        matrix = np.array([[a, c, e], [b, d, f]])
    to_pixels = matrix[:, :2] @ to_source + np.array([[0.0, 0.0, matrix[0, 2]], [0.0, 0.0, matrix[1, 2]]])
    corners = np.array([(0.0, size[1]), (size[0], 0.0)])
    places = np.linalg.solve(to_pixels[:, :2], (corners - to_pixels[:, 2]).T).T
    return [float(number) + 0.0 for number in places.ravel()]  # no -0.0
