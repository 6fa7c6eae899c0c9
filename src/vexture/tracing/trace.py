"""Pictures of pixels as drawings (thesis 4.2): vtracer traces one flat colour after another."""

import os
import re
from dataclasses import replace
from io import BytesIO
from pathlib import Path as FilePath
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.content import about
from vexture.drawing import Drawing
from vexture.errors import DeviceError, LimitError, SourceError
from vexture.notes import Notes, warn_of
from vexture.paint import Paint
from vexture.svg.read import svg_drawing
from vexture.tracing.colours import background_of, flat_colours, mixture, widened
from vexture.tracing.images import MOST_PIXELS, pixels_of
from vexture.tracing.squares import cells_of, squares_document

__all__ = ["embedded_image", "image_drawing", "read_image", "trace"]

LONGEST: Final = 2048
"""Most pixels on the longer side; a larger picture is reduced first."""

SMALL: Final = 256
"""Pixels on the longer side. A picture up to this size is traced four times enlarged, a larger one twice."""

OUTWARD: Final = 0.4
"""Pixels of the enlarged mask. vtracer's outlines lie this far outside the middle of the steps, as measured on
drawings whose outline is known."""

SETTINGS: Final[dict[str, Any]] = {
    "colormode": "binary",
    "mode": "spline",
    "corner_threshold": 60,
    "splice_threshold": 15,
    "length_threshold": 10.0,
    "max_iterations": 10,
    "path_precision": 3,
}
"""Settings of vtracer, from measurements on 24 circles of 128 to 800 pixels. A splice threshold of 15 degrees instead
of 45 reduces the largest error from 1.05 to 0.63 pixels for a fifth more curves. A length threshold of 10 pixels of the
mask instead of 4 saves a third of the curves."""

MOST_CURVES: Final = 60_000
"""Most curves of a drawing; a page of dense text has 40,000."""

MOST_PIECES: Final = 2**16 - 2
"""Most pieces of one mask: vtracer numbers them with 16 bits."""

PHOTO_LONGEST: Final = 512
PHOTO_COLOURS: Final = 16
PHOTO_SPECKLE: Final = 4
"""A photograph is reduced to this many pixels on its longer side and to this many colours. Areas of fewer pixels than
the square of the last number are left out."""

TRANSLUCENT: Final = 250.0
"""Levels. Colours of at least this opacity count as opaque."""

TRACED_PATH: Final = re.compile(r'<path d="([^"]*)" fill="[^"]*" transform="translate\(([-\d.]+),([-\d.]+)\)"/>')


def read_image(source: str | os.PathLike[str] | bytes, file_name: str | None = None) -> Drawing:
    """Read a picture of pixels: PNG, JPEG, WebP, GIF (its first image) or BMP, by its content.

    `vexture.trace` describes how it is traced; its EXIF orientation is applied.

    Parameters
    ----------
    source : path or bytes
        The file, or its content.
    file_name : str, optional
        Name of the file, if `source` is its content: names the drawing, also in messages.

    Returns
    -------
    Drawing
        In the unit square, y up; `to_source` maps it to pixels of the picture, y down.

    Raises
    ------
    SourceError
        If it cannot be read, is no picture, or is an image of a texture.
    LimitError
        If it has too many pixels, or becomes too many curves.
    DeviceError
        If the package vtracer is missing.

    Warns
    -----
    SourceWarning
        If it has no background, or no flat colours.

    Examples
    --------
    >>> from PIL import Image
    >>> file = BytesIO()
    >>> picture = Image.new("L", (64, 64), 255)
    >>> picture.paste(0, (16, 16, 48, 32))
    >>> picture.save(file, "PNG")
    >>> bool(np.abs(read_image(file.getvalue(), "box.png").paths[0].box - [(0.25, 0.5), (0.75, 0.75)]).max() < 0.01)
    True
    """
    given = file_name or (None if isinstance(source, bytes) else os.fspath(source))
    shown = given or "the picture"
    with about(shown):
        drawing = image_drawing(source, FilePath(given).stem if given else "drawing")
    warn_of(shown, drawing.notes)
    return drawing


def image_drawing(source: str | os.PathLike[str] | bytes, name: str) -> Drawing:
    """Drawing of `read_image`, without a warning: the notes are in the drawing."""
    return _traced(pixels_of(source), name)


def embedded_image(content: bytes) -> Drawing:
    """Drawing of a picture in another drawing: as `image_drawing`, with its background, unless that is transparent."""
    return _traced(pixels_of(content), "image", whole=True)


def trace(image: ArrayLike, name: str = "drawing") -> Drawing:
    """Trace a picture of pixels.

    The outline lies where a pixel is half covered, to about a sixth of a pixel. The first of these that fits the
    picture decides what is painted:

    - a picture with transparent pixels: all others;
    - a border of one colour: all pixels but those of that colour;
    - two colours: the darker one;
    - any other picture: all of it.

    Flat colours become paths of that paint, each of which extends slightly under those painted after it. A picture of
    many colours, such as a photograph, is traced coarsely. Pixel art, which has up to 64 colours, none of them on
    smooth edges, and up to 64 pixels on its longer side, becomes the exact outlines of its pixels, also if it is
    enlarged.

    Parameters
    ----------
    image : array
        ``(height, width)`` gray, or ``(height, width, 3 or 4)`` sRGB and opacity, not premultiplied; uint8, or float
        in 0..1; top row first.
    name : str
        Names the drawing.

    Returns
    -------
    Drawing
        As of `vexture.read_image`, as are errors and warnings.

    Examples
    --------
    >>> image = np.ones((64, 64))
    >>> image[16:32, 16:48] = 0.0
    >>> drawing = trace(image)
    >>> [path.paint.hex for path in drawing.paths]
    ['#000000']
    """
    with about(name):
        drawing = _traced(_as_pixels(np.asarray(image)), name)
    warn_of(name, drawing.notes)
    return drawing


def _as_pixels(image: NDArray[Any]) -> NDArray[np.uint8]:
    """Array as 8-bit sRGB and opacity."""
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


def _traced(pixels: NDArray[np.uint8], name: str, *, whole: bool = False) -> Drawing:
    """Trace 8-bit sRGB and opacity, (height, width, 4); `whole` with an opaque background."""
    notes = Notes()
    cells = cells_of(pixels)
    if cells is None:
        document, size, has_background = _smooth_document(pixels, whole, notes)
    else:
        document, has_background = squares_document(cells, background_of(_reduced(cells, LONGEST)), whole)
        size = (cells.shape[1], cells.shape[0])
    drawing = svg_drawing(document, f"{name}.svg")
    if not drawing.paths:
        notes.remark("is all background, so that nothing of it is painted")
    elif not has_background:
        notes.remark("has no background, since its border has several colours: its silhouette is the whole picture")
    scale = np.array([[pixels.shape[1]], [pixels.shape[0]]]) / np.array([[size[0]], [size[1]]])
    return replace(drawing, to_source=drawing.to_source * scale, name=name, notes=notes.listed)


def _smooth_document(pixels: NDArray[np.uint8], whole: bool, notes: Notes) -> tuple[bytes, tuple[int, int], bool]:
    """SVG of a picture with smooth edges, its size, and whether it has a background."""
    image = _reduced(pixels, LONGEST)
    background = background_of(image)
    colours = flat_colours(image, background)
    if background is None and colours is not None and len(colours) == 2:
        background = colours[int(colours.sum(axis=1).argmax())]  # the lighter one, for ink that reaches the border
        colours = np.concatenate([background[None], colours[(colours != background).any(axis=1)]])
    first = 0 if background is None or (whole and background[3] > 0.0) else 1
    try:
        if colours is None:
            raise LimitError("it has too many colours")
        document, size = _document(image, colours, first, 1)
    except LimitError:
        image, colours = _posterised(_reduced(pixels, PHOTO_LONGEST), background)
        document, size = _document(image, colours, first, PHOTO_SPECKLE)
        notes.remark(f"is no drawing of a few flat colours, so it is traced coarsely, in {len(colours) - first}")
    return document, size, background is not None


def _reduced(pixels: NDArray[np.uint8], longest: int) -> NDArray[np.float32]:
    """Premultiplied levels of a picture, reduced to a longest side."""
    from PIL import Image

    height, width = pixels.shape[:2]
    picture = Image.fromarray(pixels).convert("RGBa")
    share = longest / max(height, width)
    if share < 1.0:
        size = (max(1, round(width * share)), max(1, round(height * share)))
        picture = picture.resize(size, Image.Resampling.BOX, reducing_gap=3.0)
    return np.asarray(picture, np.float32)


def _posterised(
    image: NDArray[np.float32], background: NDArray[np.float32] | None
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """A smoothed photograph, and a few colours for it, the background first."""
    from PIL import Image, ImageFilter

    smooth = Image.fromarray(image[..., :3].astype(np.uint8)).filter(ImageFilter.GaussianBlur(1.5))
    image = np.dstack([np.asarray(smooth, np.float32), image[..., 3]])
    few = smooth.quantize(PHOTO_COLOURS, Image.Quantize.MEDIANCUT, kmeans=2).convert("RGB")
    found = np.unique(np.asarray(few).reshape(-1, 3), axis=0).astype(np.float32)
    colours = np.column_stack([found, np.full(len(found), 255.0, np.float32)])
    if background is not None:
        colours = np.concatenate([background[None], colours[np.linalg.norm(colours - background, axis=1) > 1.0]])
    return image, colours


def _document(
    image: NDArray[np.float32], colours: NDArray[np.float32], first: int, speckle: int
) -> tuple[bytes, tuple[int, int]]:
    """SVG of all colours but the background, large areas first, and its size in pixels of the enlarged picture."""
    parts = mixture(image, colours)
    height, width = parts.first.shape
    factor = 4 if max(height, width) <= SMALL else 2
    area = [parts.of(number).sum() for number in range(len(colours))]
    order = sorted(range(first, len(colours)), key=lambda number: -area[number])
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {factor * width} {factor * height}">']
    curves = 0
    above = np.zeros((height, width), np.float32)
    for number in reversed(order):
        own = parts.of(number)
        mask = own
        if colours[number][3] >= TRANSLUCENT:
            mask = own + above * widened(own >= 0.5)
            above += own  # nothing extends under a translucent colour, which would show it
        group, count = _group(mask, _paint(colours[number]), factor, factor * speckle)
        curves += count
        if curves > MOST_CURVES:
            raise LimitError(f"becomes more than {MOST_CURVES:,} curves, the limit; smooth it, or scale it down")
        lines.insert(1, group)
    return "\n".join([*lines, "</svg>"]).encode(), (factor * width, factor * height)


def _paint(colour: NDArray[np.float32]) -> Paint:
    """Paint of a premultiplied colour."""
    opacity = 1.0 if colour[3] >= TRANSLUCENT else float(colour[3]) / 255.0
    plain = np.clip(colour[:3] / max(float(colour[3]), 1.0), 0.0, 1.0)
    red, green, blue = (float(channel) for channel in plain)
    return Paint((red, green, blue), opacity)


def _group(share: NDArray[np.float32], paint: Paint, factor: int, speckle: int) -> tuple[str, int]:
    """Outline of the area where a share is at least one half, as SVG, and the number of its curves."""
    inside = np.argwhere(share > 0.0)
    if not len(inside):
        return "", 0
    top, left = np.maximum(inside.min(axis=0) - 2, 0)
    bottom, right = inside.max(axis=0) + 3
    mask = _enlarged(share[top:bottom, left:right], factor)
    x, y = factor * left, factor * top
    text = _outline(mask, speckle)
    paths = [
        f'<path d="{data}" transform="translate({x + float(right)},{y + float(down)})"/>'
        for data, right, down in TRACED_PATH.findall(text)
    ]
    return f'<g fill="{paint.hex[:7]}" fill-opacity="{paint.opacity}">{"".join(paths)}</g>', text.count("C")


def _enlarged(share: NDArray[np.float32], factor: int) -> NDArray[np.bool_]:
    """Enlarged mask of where a share is at least one half, `OUTWARD` smaller on all sides."""
    from PIL import Image

    size = (factor * share.shape[1], factor * share.shape[0])
    smooth = np.asarray(Image.fromarray(share).resize(size, Image.Resampling.BICUBIC))
    padded = np.pad(smooth, 1, mode="edge")
    right = padded[1:-1, 2:] - padded[1:-1, :-2]
    down = padded[2:, 1:-1] - padded[:-2, 1:-1]
    slope = 0.5 * np.sqrt(right * right + down * down)  # small at a blurred edge, whose middle stays the edge
    return np.asarray(smooth - 0.5 >= OUTWARD * slope, np.bool_)


def _outline(mask: NDArray[np.bool_], speckle: int) -> str:
    """SVG of a mask by vtracer.

    vtracer scans the mask by rows, begins a piece at each pixel without one to the left or above, and panics at more
    than 65,535 pieces.
    """
    try:
        import vtracer
    except ModuleNotFoundError:
        raise DeviceError("tracing a picture needs the package vtracer: pip install 'vexture[trace]'") from None
    from PIL import Image

    begun = mask.copy()
    begun[1:] &= ~mask[:-1]
    begun[:, 1:] &= ~mask[:, :-1]
    if begun.sum() > MOST_PIECES:
        raise LimitError(
            f"falls apart into {begun.sum():,} pieces; the limit is {MOST_PIECES:,}; smooth it, or scale it down"
        )
    file = BytesIO()
    Image.fromarray(np.where(mask, np.uint8(0), np.uint8(255))).save(file, "BMP")
    try:
        text: str = vtracer.convert_raw_image_to_svg(
            file.getvalue(), img_format="bmp", filter_speckle=speckle, **SETTINGS
        )
    except BaseException as error:  # a panic of Rust is no Exception
        if type(error).__name__ != "PanicException":
            raise
        raise SourceError(f"vtracer cannot trace it ({str(error)[:100]}); smooth it") from None
    return text
