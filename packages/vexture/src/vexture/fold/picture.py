"""Picture of a fold for people: its end positions, kinds and begins."""

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError
from vexture.fold.fold import Fold, Kind
from vexture.renderers.exact import render_exact

if TYPE_CHECKING:
    from PIL.Image import Image

    from vexture.drawing.drawing import Drawing

LEAST, MOST = 256, 4096
STILL: Final = 0.02
"""Fraction of the largest displacement below which texels are not coloured by kind and begin."""

ARROWS: Final = 24
"""Most arrows along a side."""

KIND_COLORS: Final = {
    Kind.LINEAR: (228, 135, 40),
    Kind.SMOOTH_START: (200, 70, 150),
    Kind.SMOOTH_END: (110, 90, 200),
    Kind.SMOOTH_BOTH: (60, 150, 90),
    Kind.PERIODIC: (40, 130, 200),
}
WATER: Final = (196, 214, 228)
LAND: Final = (250, 247, 240)
INK: Final = (40, 44, 52)

Pixels = NDArray[np.float64]


def fold_picture(fold: Fold, drawing: "Drawing | None" = None, size: int = 768) -> "Image":
    """Draw a fold: end positions as colours and arrows, and smaller pictures of the kinds and the begins.

    Parameters
    ----------
    fold : Fold
    drawing : Drawing, optional
        The moving shape, drawn below the arrows.
    size : int
        Height in pixels, 256 to 4096; the picture is 3/2 as wide.

    Returns
    -------
    PIL.Image.Image

    Raises
    ------
    ParameterError
        If the size is out of range.

    Examples
    --------
    >>> fold_picture(Fold(np.full((4, 4, 2), 0.1))).size
    (1152, 768)
    """
    if not LEAST <= size <= MOST:
        raise ParameterError(f"`size` is {size}; it must be {LEAST} to {MOST} pixels")
    from PIL import Image, ImageDraw

    half = size // 2
    ground = _ground(drawing, size)
    largest = float(np.hypot(*np.moveaxis(fold.displacement.astype(np.float64), 2, 0)).max())
    picture = Image.new("RGB", (size + half, size), "white")
    picture.paste(_image(_wheel_over(fold, ground, largest)), (0, 0))
    draw = ImageDraw.Draw(picture)
    _draw_arrows(draw, fold, size, largest)
    _caption(draw, (0, 0), f"end positions, largest {largest:.3g}", size)
    moves = np.hypot(fold.displacement[..., 0], fold.displacement[..., 1]) > STILL * largest
    for place, title, colors in (
        (0, "kinds", np.array([KIND_COLORS[kind] for kind in Kind], np.float64)[fold.kind]),
        (half, f"begin, as part of {_span(fold):.3g} s", _begins(fold)),
    ):
        small = _grown(colors, half)
        shown = np.where(_grown(moves[..., None], half), small, ground[:: size // half, :: size // half][:half, :half])
        picture.paste(_image(shown), (size, place))
        _caption(draw, (size, place), title, size)
    _legend(draw, fold, (size, half), size)
    return picture


def _image(pixels: Pixels) -> "Image":
    from PIL import Image

    return Image.fromarray(np.rint(pixels).astype(np.uint8))


def _ground(drawing: "Drawing | None", size: int) -> Pixels:
    """Return land and water, (size, size, 3)."""
    covered = np.zeros((size, size)) if drawing is None else render_exact(drawing, (size, size)).astype(np.float64)
    return np.array(LAND) + covered[..., None] * (np.array(WATER, np.float64) - LAND)


def _grown(values: NDArray[Any], size: int) -> NDArray[Any]:
    """Enlarge texels to squares of a picture."""
    rows, columns = values.shape[:2]
    at = np.arange(size)
    grown: NDArray[Any] = values[(at * rows // size)[:, None], at * columns // size]
    return grown


def _hue(turn: Pixels) -> Pixels:
    """Return colours around a wheel, red at 0, of about equal lightness."""
    angles = 2.0 * np.pi * (turn[..., None] - np.arange(3) / 3.0)
    return 128.0 + 105.0 * np.cos(angles)


def _wheel_over(fold: Fold, ground: Pixels, largest: float) -> Pixels:
    """Colour the ground by displacements: hue is their direction, strength their length."""
    x, y = np.moveaxis(fold.displacement.astype(np.float64), 2, 0)
    strength = np.hypot(x, y)[..., None] / max(largest, 1e-30)
    size = len(ground)
    hue, strength = (_grown(values, size) for values in (_hue(np.arctan2(y, x) / (2.0 * np.pi)), strength))
    return ground + 0.75 * strength * (hue - ground)


def _span(fold: Fold) -> float:
    """Return the time in seconds that corresponds to the whole wheel of hues."""
    return fold.cycle or float(fold.begin.max()) or 1.0


def _begins(fold: Fold) -> Pixels:
    part = fold.begin / _span(fold)
    return _hue(part if fold.cycle else 0.8 * part)  # without a cycle, the first and last hue must differ


def _draw_arrows(draw: Any, fold: Fold, size: int, largest: float) -> None:
    """Draw arrows from positions to end positions, all enlarged by one factor if the longest would be too short."""
    if largest == 0.0:
        return
    columns, rows = fold.size
    longest = 0.9 * size / ARROWS
    scale = max(float(size), longest / largest)
    for row in np.unique(np.linspace(0, rows - 1, min(rows, ARROWS)).astype(int)):
        for column in np.unique(np.linspace(0, columns - 1, min(columns, ARROWS)).astype(int)):
            x, y = fold.displacement[row, column] * (scale, -scale)
            length = float(np.hypot(x, y))
            if length < 2.0:
                continue
            tail = np.array([(column + 0.5) / columns, (row + 0.5) / rows]) * size
            tip = tail + np.array([x, y])
            along, across = np.array([x, y]) / length, np.array([-y, x]) / length
            head = min(6.0, 0.5 * length)
            barbs = [tuple(tip - head * along + side * 0.5 * head * across) for side in (-1.0, 1.0)]
            draw.line([tuple(tail), tuple(tip)], fill=INK, width=max(1, size // 500))
            draw.polygon([tuple(tip), *barbs], fill=INK)


def _font(size: int) -> Any:
    from PIL import ImageFont

    return ImageFont.load_default(max(10, size // 48))


def _caption(draw: Any, place: tuple[int, int], text: str, size: int) -> None:
    """Draw text on a white rectangle, so that it is legible on any background."""
    font = _font(size)
    at = (place[0] + size // 96, place[1] + size // 96)
    left, top, right, bottom = draw.textbbox(at, text, font=font)
    draw.rectangle((left - 4, top - 3, right + 4, bottom + 3), fill=(255, 255, 255))
    draw.text(at, text, fill=INK, font=font)


def _legend(draw: Any, fold: Fold, place: tuple[int, int], size: int) -> None:
    """Draw the legend of kinds, durations and cycle at the bottom of the picture of kinds."""
    font, step = _font(size), max(14, size // 32)
    present = [kind for kind in Kind if (fold.kind == kind).any()]
    least, most = float(fold.duration.min()), float(fold.duration.max())
    lasts = f"{least:.3g}" if least == most else f"{least:.3g} to {most:.3g}"
    lines = [f"duration {lasts} s, {f'cycle {fold.cycle:.3g} s' if fold.cycle else 'once'}"]
    x, y = place[0] + size // 96, place[1] - step * (len(present) + len(lines)) - size // 96
    widest = max(draw.textlength(text, font=font) for text in [*lines, *(kind.name for kind in present)])
    draw.rectangle((x - 4, y - 4, x + step + widest + 8, place[1] - size // 128), fill=(255, 255, 255))
    for kind in present:
        draw.rectangle((x, y, x + step - 6, y + step - 6), fill=KIND_COLORS[kind])
        draw.text((x + step, y - 2), kind.name.lower().replace("_", " "), fill=INK, font=font)
        y += step
    for text in lines:
        draw.text((x, y - 2), text, fill=INK, font=font)
        y += step
