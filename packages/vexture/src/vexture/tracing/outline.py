"""Outlines of where a share is at least one half, by vtracer."""

import re
from io import BytesIO
from itertools import cycle
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import DeviceError, LimitError, SourceError

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

MOST_PIECES: Final = 2**16 - 2
"""Most pieces of one mask: vtracer numbers them with 16 bits."""

NUMBER: Final = re.compile(r"-?\d+(?:\.\d+)?")
TRACED_PATH: Final = re.compile(r'<path d="([^"]*)" fill="[^"]*" transform="translate\(([-\d.]+),([-\d.]+)\)"/>')


def outline(share: NDArray[np.float32], factor: int, speckle: int) -> str:
    """Paths of SVG around the area where a share is at least one half, in pixels of the picture enlarged by a factor.

    Areas of fewer pixels than the square of `speckle`, enlarged, are left out.
    """
    inside = np.argwhere(share > 0.0)
    if not len(inside):
        return ""
    top, left = np.maximum(inside.min(axis=0) - 2, 0)
    bottom, right = inside.max(axis=0) + 3
    text = _trace_mask(_enlarge(share[top:bottom, left:right], factor), speckle)
    x, y = factor * left, factor * top
    return "".join(
        f'<path d="{_move(data, x + float(across), y + float(down))}"/>'
        for data, across, down in TRACED_PATH.findall(text)
    )


def _move(data: str, x: float, y: float) -> str:
    """Path data of absolute points, moved. A `transform` would move gradients, too."""
    by = cycle((x, y))
    return NUMBER.sub(lambda found: str(float(found[0]) + next(by)), data)


def _enlarge(share: NDArray[np.float32], factor: int) -> NDArray[np.bool_]:
    """Enlarged mask of where a share is at least one half, `OUTWARD` smaller on all sides."""
    from PIL import Image

    size = (factor * share.shape[1], factor * share.shape[0])
    smooth = np.asarray(Image.fromarray(share).resize(size, Image.Resampling.BICUBIC))
    padded = np.pad(smooth, 1, mode="edge")
    right = padded[1:-1, 2:] - padded[1:-1, :-2]
    down = padded[2:, 1:-1] - padded[:-2, 1:-1]
    slope = 0.5 * np.sqrt(right * right + down * down)  # small at a blurred edge, whose middle stays the edge
    return np.asarray(smooth - 0.5 >= OUTWARD * slope, np.bool_)


def _trace_mask(mask: NDArray[np.bool_], speckle: int) -> str:
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
