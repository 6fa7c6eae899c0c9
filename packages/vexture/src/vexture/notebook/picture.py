"""A widget's view as an array or a PNG: for pages without a kernel, for print, and for GitHub."""

from io import BytesIO
from typing import Final, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from vexture.drawing.colors import Color, parse_color
from vexture.renderers.view import Size, window
from vexture.texture.texture import Texture

Mode: TypeAlias = Literal["paint", "silhouette"]
MODES: Final = ("paint", "silhouette")

Rect: TypeAlias = tuple[float, float, float, float]
"""Left, bottom, width and height of the visible part of the unit square, as in `vexture.window`."""

WHOLE: Final = (0.0, 0.0, 1.0, 1.0)
FINEST: Final = 128
"""Width and height in pixels of the picture that locates a drawing's box."""

MARGIN: Final = 0.04
"""Margin around the box, as a fraction of its longer side."""


def home_of(texture: Texture, root: str | int | None) -> Rect:
    """Return the box of a drawing, with a margin.

    Examples
    --------
    >>> import vexture
    >>> half = vexture.convert(vexture.Drawing.polygon([(0, 0), (1, 0), (1, 0.5), (0, 0.5)]))
    >>> home_of(half, None)
    (-0.04, -0.04, 1.08, 0.58)
    """
    covered = texture.render(FINEST, root=root)[::-1, :, 3] > 0
    if not covered.any():
        return WHOLE
    columns, rows = (np.flatnonzero(covered.any(axis=axis)) for axis in (0, 1))
    left, bottom, right, top = (float(k) / FINEST for k in (columns[0], rows[0], columns[-1] + 1, rows[-1] + 1))
    margin = MARGIN * max(right - left, top - bottom)
    return left - margin, bottom - margin, right - left + 2 * margin, top - bottom + 2 * margin


def render_view(texture: Texture, size: Size, view: Rect, mode: Mode, root: str | int | None) -> NDArray[np.float32]:
    """Render a view as premultiplied sRGB and opacity, (height, width, 4), top row first."""
    picture = texture.render(size, window(*view), root=root)
    if mode == "silhouette":
        picture[..., :3] = 0.0
    return picture


def png_of(picture: NDArray[np.float32], background: str, *, fast: bool = False) -> bytes:
    """Encode a picture on a background as PNG; `fast` makes a larger file in less time."""
    from PIL import Image

    paper = parse_color(background)
    assert isinstance(paper, Color)  # checked when it was set
    below = np.array([*(paper.alpha * part for part in paper.rgb), paper.alpha])
    flat = picture + (1.0 - picture[..., 3:]) * below
    opacity = flat[..., 3:]
    flat[..., :3] = np.divide(flat[..., :3], opacity, out=np.zeros_like(flat[..., :3]), where=opacity > 0.0)
    image = Image.fromarray(np.uint8(np.rint(255.0 * np.clip(flat, 0.0, 1.0))))
    data = BytesIO()
    (image if paper.alpha < 1.0 else image.convert("RGB")).save(data, "PNG", compress_level=1 if fast else 6)
    return data.getvalue()
