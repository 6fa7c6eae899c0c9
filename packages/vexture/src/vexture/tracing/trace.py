"""Raster images as drawings (thesis 4.2), traced as one flat colour or gradient after another."""

import os
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base.content import about
from vexture.base.errors import LimitError, SourceError
from vexture.base.notes import Notes, warn_of
from vexture.base.pixels import MOST_PIXELS, pixels_of
from vexture.drawing.drawing import Drawing
from vexture.svg.read import svg_drawing
from vexture.tracing.colours import LEVEL, background_of, flat_colours
from vexture.tracing.document import document_of
from vexture.tracing.mixture import Mixture, mixture
from vexture.tracing.shading import NONE_HERE, Tone, nearest, shading_of, steps_of
from vexture.tracing.squares import cells_of, squares_document

LONGEST: Final = 2048
"""Longest side in pixels; a larger picture is reduced first."""

PHOTO_LONGEST: Final = 512
PHOTO_COLOURS: Final = 16
PHOTO_BLUR: Final = 1.5
PHOTO_SPECKLE: Final = 4
"""Treatment of a photograph: longer side in pixels after reduction, radius of blur, number of colours, and side of the
smallest areas: those with fewer pixels than its square are left out."""


def read_image(source: str | os.PathLike[str] | bytes, file_name: str | None = None) -> Drawing:
    """Read a raster image, recognized by its content: PNG, JPEG, WebP, GIF (first image) or BMP.

    `vexture.trace` describes the tracing. The EXIF orientation is applied.

    Parameters
    ----------
    source : path or bytes
        The file, or its content.
    file_name : str, optional
        Name of the file if `source` is its content, for the drawing and for messages.

    Returns
    -------
    Drawing
        In the unit square, y up; `to_source` maps it to pixels of the picture, y down.

    Raises
    ------
    SourceError
        If it cannot be read, is not a picture, or is an image of a texture.
    LimitError
        If it has too many pixels, or its drawing would have too many curves.
    DeviceError
        If the package vtracer is missing.

    Warns
    -----
    SourceWarning
        If it has no background or no flat colours.

    Examples
    --------
    >>> from io import BytesIO
    >>> from PIL import Image
    >>> file = BytesIO()
    >>> picture = Image.new("L", (64, 64), 255)
    >>> picture.paste(0, (16, 16, 48, 32))
    >>> picture.save(file, "PNG")
    >>> bool(np.abs(read_image(file.getvalue(), "box.png").paths[0].box - [(0.25, 0.5), (0.75, 0.75)]).max() < 0.01)
    True
    """
    name = file_name or (None if isinstance(source, bytes) else os.fspath(source))
    label = name or "the picture"
    with about(label):
        drawing = image_drawing(source, FilePath(name).stem if name else "drawing")
    warn_of(label, drawing.notes)
    return drawing


def image_drawing(source: str | os.PathLike[str] | bytes, name: str) -> Drawing:
    """Read a picture as `read_image` does, without a warning: the drawing contains the notes."""
    return _trace_pixels(pixels_of(source), name)


def embedded_image(content: bytes) -> Drawing:
    """Read a picture inside another drawing as `image_drawing` does, but keep an opaque background."""
    return _trace_pixels(pixels_of(content), "image", whole=True)


def trace(image: ArrayLike, name: str = "drawing") -> Drawing:
    """Trace a raster image.

    The outline is where a pixel is half covered, to about a sixth of a pixel. The first case that fits decides which
    pixels are painted:

    - a picture with transparent pixels: all others;
    - a border of one colour: all pixels except those of that colour;
    - two colours: the darker one;
    - any other picture: all of it.

    Flat colours become paths with that paint, each of which extends slightly under those painted after it. Linear and
    radial gradients, including elliptic ones, become paths with such a gradient. Other smoothly shaded areas are drawn
    in up to 64 steps, or translucent ones in up to 24, each painted over the less opaque one next to it. A picture of
    many colours, such as a photograph, is traced coarsely. Pixel art becomes the exact outlines of its pixels, even if
    it is enlarged. It has up to 64 colours, no smooth edges, and up to 64 pixels on its longer side.

    Parameters
    ----------
    image : array
        ``(height, width)`` gray, or ``(height, width, 3 or 4)`` sRGB and opacity, not premultiplied; uint8, or float
        in 0..1; top row first.
    name : str
        Name of the drawing.

    Returns
    -------
    Drawing
        As from `vexture.read_image`; errors and warnings are also the same.

    Examples
    --------
    >>> image = np.ones((64, 64))
    >>> image[16:32, 16:48] = 0.0
    >>> drawing = trace(image)
    >>> [path.paint.hex for path in drawing.paths]
    ['#000000']
    """
    with about(name):
        drawing = _trace_pixels(_as_pixels(np.asarray(image)), name)
    warn_of(name, drawing.notes)
    return drawing


def _as_pixels(image: NDArray[Any]) -> NDArray[np.uint8]:
    """Convert an array to 8-bit sRGB and opacity."""
    if image.ndim == 2:
        image = image[..., None].repeat(3, axis=2)
    if image.ndim != 3 or image.shape[2] not in (3, 4) or not image.size:
        raise SourceError(f"an image is {image.shape}; it must be (height, width), also times 3 or 4")
    if image.shape[0] * image.shape[1] > MOST_PIXELS:
        raise LimitError(f"has {image.shape[0] * image.shape[1]:,} pixels; the limit is {MOST_PIXELS:,}; scale it down")
    if image.dtype != np.uint8:
        if not np.issubdtype(image.dtype, np.floating) or not (image.min() >= 0.0 and image.max() <= 1.0):
            raise SourceError(f"an image of {image.dtype}; it must be uint8, or float in 0..1")
        image = np.rint(255.0 * image).astype(np.uint8)
    opaque = np.full((*image.shape[:2], 1), 255, np.uint8)
    return np.concatenate([image, opaque], axis=2) if image.shape[2] == 3 else image


def _trace_pixels(pixels: NDArray[np.uint8], name: str, *, whole: bool = False) -> Drawing:
    """Trace 8-bit sRGB and opacity, (height, width, 4); with `whole`, keep an opaque background."""
    notes = Notes()
    cells = cells_of(pixels)
    if cells is None:
        document, size, has_background = _smooth_document(pixels, whole, notes)
    else:
        document, has_background = squares_document(cells, background_of(_reduce(cells, LONGEST)), whole)
        size = (cells.shape[1], cells.shape[0])
    drawing = svg_drawing(document, f"{name}.svg")
    if not drawing.paths:
        notes.remark("is all background, so that nothing of it is painted")
    elif not has_background:
        notes.remark("has no background, since its border has several colours: its silhouette is the whole picture")
    scale = np.array([[pixels.shape[1]], [pixels.shape[0]]]) / np.array([[size[0]], [size[1]]])
    return replace(drawing, to_source=drawing.to_source * scale, name=name, notes=notes.in_order)


def _smooth_document(pixels: NDArray[np.uint8], whole: bool, notes: Notes) -> tuple[bytes, tuple[int, int], bool]:
    """Return the SVG of a picture with smooth edges, its size, and whether it has a background."""
    image = _reduce(pixels, LONGEST)
    background = background_of(image)
    shading = shading_of(image, background)
    flat = flat_colours(image, background, shading.number != NONE_HERE, shading.samples)
    if background is None and flat is not None and len(flat) == 2 and not shading.tones:
        background = flat[int(flat.sum(axis=1).argmax())]  # the lighter one, since ink may reach the border
        flat = np.concatenate([background[None], flat[(flat != background).any(axis=1)]])
    first = 0 if background is None or (whole and background[3] > 0.0) else 1
    try:
        if flat is None:
            raise LimitError("it has too many colours")
        tones = [*map(Tone, flat), *shading.tones]
        document, size = document_of(tones, mixture(image, flat, shading), first, 1)
    except LimitError:
        tones, parts = _posterise(_reduce(pixels, PHOTO_LONGEST), background)
        document, size = document_of(tones, parts, first, PHOTO_SPECKLE)
        notes.remark(f"is no drawing of a few colours and gradients, so it is traced coarsely, in {len(tones) - first}")
    return document, size, background is not None


def _reduce(pixels: NDArray[np.uint8], longest: int) -> NDArray[np.float32]:
    """Reduce a picture to a longest side; return premultiplied levels."""
    from PIL import Image

    height, width = pixels.shape[:2]
    picture = Image.fromarray(pixels).convert("RGBa")
    share = longest / max(height, width)
    if share < 1.0:
        size = (max(1, round(width * share)), max(1, round(height * share)))
        picture = picture.resize(size, Image.Resampling.BOX, reducing_gap=3.0)
    return np.asarray(picture, np.float32)


def _posterise(image: NDArray[np.float32], background: NDArray[np.float32] | None) -> tuple[list[Tone], Mixture]:
    """Return a few colours for a photograph, the background first, and the colour of each pixel after smoothing."""
    from PIL import Image, ImageFilter

    smooth = Image.fromarray(np.rint(image).astype(np.uint8)).filter(ImageFilter.GaussianBlur(PHOTO_BLUR))
    pixels = np.asarray(smooth, np.float32).reshape(-1, 4)
    colours = steps_of(pixels, PHOTO_COLOURS)
    if background is not None:
        colours = np.concatenate([background[None], colours[np.linalg.norm(colours - background, axis=1) > LEVEL]])
    number = nearest(pixels, colours).reshape(image.shape[:2]).astype(np.int16)
    parts = Mixture(number, number, np.ones(number.shape, np.float32), np.ones(number.shape, np.bool_))
    return [Tone(colour) for colour in colours], parts
