"""The SVG of tones and their shares: their outlines by vtracer, in which order they are painted, and over what."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import cycle
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import DeviceError, LimitError, SourceError
from vexture.tracing.colours import dilate
from vexture.tracing.mixture import Mixture
from vexture.tracing.shading import Tone

MOST_CURVES: Final = 60_000
"""Most curves of a drawing; a page of dense text has 40,000."""

SMALL: Final = 256
"""Pixels on the longer side. A picture up to this size is traced four times enlarged, a larger one twice."""

TOP: Final = 1_000
"""Depth of what is opaque, above everything translucent."""

MEETING: Final = 0.2
"""Share from which a tone extends under others where tones pass into one another: of several, none may have a half."""

LEAST_OPACITY: Final = 2.0
BEYOND: Final = 3.0
"""Levels. A colour is painted over another one if what makes one of the other has at least this opacity, and would need
channels out of their range by no more than this."""


MOSTLY: Final = 0.6
"""Share of the borders with less opaque colours that is with the one that a colour is painted over. Where colours meet
in all directions, outlines that almost coincide would cross one another."""

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


@dataclass(frozen=True, slots=True)
class PaintedTone:
    """A tone as it is painted: over `depth` others, and below those in `above`, under which it extends."""

    number: int
    tone: Tone
    depth: int
    above: frozenset[int] = frozenset()


def document_of(tones: Sequence[Tone], parts: Mixture, first: int, speckle: int) -> tuple[bytes, tuple[int, int]]:
    """SVG of all tones but the background, and its size in pixels of the enlarged picture.

    Those that are translucent are painted first, and extend under the others; of those that are alike, large areas are.
    """
    height, width = parts.first.shape
    factor = 4 if max(height, width) <= SMALL else 2
    area = [parts.of(number).sum() for number in range(len(tones))]
    painted = over_one_another(tones, parts, first)
    order = sorted(painted, key=lambda one: (one.depth, -area[one.number]))
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {factor * width} {factor * height}">']
    curves = 0
    above = np.zeros((height, width), np.float32)
    for one in reversed(order):
        own = parts.of(one.number)
        mask = parts.of(one.number, *one.above) + above * dilate(own >= np.where(parts.soft, MEETING, 0.5))
        if tones[one.number].is_opaque:
            above += own  # nothing extends under a translucent colour, which would show it
        paths = outline(mask, factor, factor * speckle)
        curves += paths.count("C")
        if curves > MOST_CURVES:
            raise LimitError(f"becomes more than {MOST_CURVES:,} curves, the limit; smooth it, or scale it down")
        lines.insert(1, f"{_group(one.tone, one.number, factor)}{paths}</g>")
    return "\n".join([*lines, "</svg>"]).encode(), (factor * width, factor * height)


def _group(tone: Tone, number: int, factor: int) -> str:
    """Begin of a group with the paint of a tone."""
    if tone.fade is not None:
        return f'{tone.fade.svg(f"fade{number}", factor)}<g fill="url(#fade{number})">'
    opacity = 1.0 if tone.is_opaque else float(tone.colour[3]) / 255.0
    plain = np.clip(255.0 * tone.colour[:3] / max(float(tone.colour[3]), 1.0), 0.0, 255.0)
    red, green, blue = np.rint(plain).astype(int).tolist()
    return f'<g fill="#{red:02x}{green:02x}{blue:02x}" fill-opacity="{opacity}">'


def over_one_another(tones: Sequence[Tone], parts: Mixture, first: int) -> list[PaintedTone]:
    """Tones with what they are painted over.

    Translucent colours beside one another leave a light or dark line between them, since no two outlines are quite the
    same. Where one is more opaque, such as towards the middle of a shadow, the other extends under all of it, and is
    painted over by what makes one of the other.
    """
    kinds = range(first, len(tones))
    soft = sorted((n for n in kinds if _is_soft(tones[n])), key=lambda n: float(tones[n].colour[3]))
    contact = _contacts(parts.first, len(tones))
    lower: dict[int, int] = {}
    paint = {n: tones[n] for n in kinds}
    for place, number in enumerate(soft):
        beside = [n for n in soft[:place] if contact[n, number]]
        below = max(beside, key=lambda n: contact[n, number], default=number)
        over = _over(tones[number].colour, tones[below].colour)
        if over is not None and contact[below, number] > MOSTLY * contact[beside, number].sum():
            lower[number], paint[number] = below, Tone(over)
    above: dict[int, set[int]] = {n: set() for n in kinds}
    depth = {n: TOP if tones[n].is_opaque else 0 for n in kinds}
    for number in soft:
        below = number
        while below in lower:
            below = lower[below]
            above[below].add(number)
            depth[number] += 1
    return [PaintedTone(n, paint[n], depth[n], frozenset(above[n])) for n in kinds]


def _is_soft(tone: Tone) -> bool:
    """Whether a tone is a translucent colour."""
    return tone.fade is None and not tone.is_opaque


def _over(colour: NDArray[np.float32], below: NDArray[np.float32]) -> NDArray[np.float32] | None:
    """Premultiplied colour that, painted over one colour, makes another one of it; None if there is none."""
    opacity = float(colour[3] - below[3]) / max(1.0 - float(below[3]) / 255.0, 1e-9)
    if opacity < LEAST_OPACITY:
        return None
    over = colour - (1.0 - opacity / 255.0) * below
    if over[:3].min() < -BEYOND or over[:3].max() > opacity + BEYOND:
        return None
    return np.asarray([*np.clip(over[:3], 0.0, opacity), opacity], np.float32)


def _contacts(number: NDArray[np.int16], count: int) -> NDArray[np.intp]:
    """Number of places where a pixel of one number is beside one of another, (count, count)."""
    found = np.zeros(count * count, np.intp)
    for a, b in ((number[1:], number[:-1]), (number[:, 1:], number[:, :-1])):
        found += np.bincount((a.astype(np.intp) * count + b).ravel(), minlength=count * count)
    square = found.reshape(count, count)
    return square + square.T


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
