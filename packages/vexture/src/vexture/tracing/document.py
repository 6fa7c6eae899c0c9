"""The SVG of tones and their shares: outlines by vtracer, painting order, and overlaps."""

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
"""Longer side, in pixels, up to which a picture is traced four times enlarged; a larger one is enlarged twice."""

TOP: Final = 1_000
"""Depth of opaque tones, above all translucent ones."""

MEETING: Final = 0.2
"""Least share of a tone in pixels where tones blend, for it to extend under others; none may reach one half."""

LEAST_OPACITY: Final = 2.0
BEYOND: Final = 3.0
"""Tolerance in levels for painting one colour over another: the colour that does so must have at least this opacity,
and channels that are out of range by at most this."""


MOSTLY: Final = 0.6
"""Fraction of a colour's borders with less opaque colours that it must share with the colour below it. Where colours
meet in all directions, outlines that almost coincide would cross one another."""

OUTWARD: Final = 0.4
"""Offset of vtracer's outlines outside the middle of the steps, in pixels of the enlarged mask, as measured on
drawings with known outlines."""

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
of 45 reduces the largest error from 1.05 to 0.63 pixels, with a fifth more curves. A length threshold of 10 pixels of
the mask instead of 4 saves a third of the curves."""

MOST_PIECES: Final = 2**16 - 2
"""Most pieces of one mask: vtracer numbers them with 16 bits."""

NUMBER: Final = re.compile(r"-?\d+(?:\.\d+)?")
TRACED_PATH: Final = re.compile(r'<path d="([^"]*)" fill="[^"]*" transform="translate\(([-\d.]+),([-\d.]+)\)"/>')


@dataclass(frozen=True, slots=True)
class PaintedTone:
    """A tone in painting order: over `depth` others, and below those in `above`, under which it extends."""

    number: int
    tone: Tone
    depth: int
    above: frozenset[int] = frozenset()


def document_of(tones: Sequence[Tone], parts: Mixture, first: int, speckle: int) -> tuple[bytes, tuple[int, int]]:
    """Return the SVG of all tones but the background, and its size in pixels of the enlarged picture.

    Translucent tones are painted first, and extend under the others; among equals, large areas come first.
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
            above += own  # nothing extends under a translucent colour, through which it would show
        paths = outline(mask, factor, factor * speckle)
        curves += paths.count("C")
        if curves > MOST_CURVES:
            raise LimitError(f"becomes more than {MOST_CURVES:,} curves, the limit; smooth it, or scale it down")
        lines.insert(1, f"{_group(one.tone, one.number, factor)}{paths}</g>")
    return "\n".join([*lines, "</svg>"]).encode(), (factor * width, factor * height)


def _group(tone: Tone, number: int, factor: int) -> str:
    """Return the start tag of a group with the paint of a tone."""
    if tone.fade is not None:
        return f'{tone.fade.svg(f"fade{number}", factor)}<g fill="url(#fade{number})">'
    opacity = 1.0 if tone.is_opaque else float(tone.colour[3]) / 255.0
    plain = np.clip(255.0 * tone.colour[:3] / max(float(tone.colour[3]), 1.0), 0.0, 255.0)
    red, green, blue = np.rint(plain).astype(int).tolist()
    return f'<g fill="#{red:02x}{green:02x}{blue:02x}" fill-opacity="{opacity}">'


def over_one_another(tones: Sequence[Tone], parts: Mixture, first: int) -> list[PaintedTone]:
    """Return the tones with those below them.

    Adjacent translucent colours leave a light or dark line between them, because no two outlines coincide exactly. If
    one is more opaque, such as the middle of a shadow, the other extends under all of it, and an additional colour over
    it gives the result.
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
    """Return whether a tone is a translucent colour."""
    return tone.fade is None and not tone.is_opaque


def _over(colour: NDArray[np.float32], below: NDArray[np.float32]) -> NDArray[np.float32] | None:
    """Return the premultiplied colour that turns the colour `below` into `colour`; None if there is none."""
    opacity = float(colour[3] - below[3]) / max(1.0 - float(below[3]) / 255.0, 1e-9)
    if opacity < LEAST_OPACITY:
        return None
    over = colour - (1.0 - opacity / 255.0) * below
    if over[:3].min() < -BEYOND or over[:3].max() > opacity + BEYOND:
        return None
    return np.asarray([*np.clip(over[:3], 0.0, opacity), opacity], np.float32)


def _contacts(number: NDArray[np.int16], count: int) -> NDArray[np.intp]:
    """Return the number of places where pixels of two numbers are adjacent, (count, count)."""
    found = np.zeros(count * count, np.intp)
    for a, b in ((number[1:], number[:-1]), (number[:, 1:], number[:, :-1])):
        found += np.bincount((a.astype(np.intp) * count + b).ravel(), minlength=count * count)
    square = found.reshape(count, count)
    return square + square.T


def outline(share: NDArray[np.float32], factor: int, speckle: int) -> str:
    """Return SVG paths around the area where a share is at least one half, in pixels of the enlarged picture.

    Areas with fewer pixels than the square of `speckle`, after enlargement, are left out.
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
    """Move path data of absolute points. A `transform` would move gradients, too."""
    by = cycle((x, y))
    return NUMBER.sub(lambda found: str(float(found[0]) + next(by)), data)


def _enlarge(share: NDArray[np.float32], factor: int) -> NDArray[np.bool_]:
    """Return the enlarged mask of a share of at least one half, reduced by `OUTWARD` on all sides."""
    from PIL import Image

    size = (factor * share.shape[1], factor * share.shape[0])
    smooth = np.asarray(Image.fromarray(share).resize(size, Image.Resampling.BICUBIC))
    padded = np.pad(smooth, 1, mode="edge")
    right = padded[1:-1, 2:] - padded[1:-1, :-2]
    down = padded[2:, 1:-1] - padded[:-2, 1:-1]
    slope = 0.5 * np.sqrt(right * right + down * down)  # small at a blurred edge, whose middle remains the edge
    return np.asarray(smooth - 0.5 >= OUTWARD * slope, np.bool_)


def _trace_mask(mask: NDArray[np.bool_], speckle: int) -> str:
    """Trace a mask with vtracer, as SVG.

    vtracer scans the mask by rows, starts a piece at each pixel without a neighbour to the left or above, and panics at
    more than 65,535 pieces.
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
    except BaseException as error:  # a Rust panic is not an Exception
        if type(error).__name__ != "PanicException":
            raise
        raise SourceError(f"vtracer cannot trace it ({str(error)[:100]}); smooth it") from None
    return text
