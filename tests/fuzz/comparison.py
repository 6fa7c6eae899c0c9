"""A drawing and a view of it: the picture of its texture against that of the exact renderer.

An outline of a texture may lie beside the drawing's: by the tolerance of its conversion (2e-5 of the unit square by
default) and by rounding. Of s pixels, a pixel with one outline shows 255 s of 255 parts, and sqrt(2) times as many if
the outline runs diagonally. So the default is right where 2e-5 is at most 1/200 of a pixel, which is in views of the
whole drawing. A view from nearer gets what the guide advises for it: a `precision`, of 1/1000 of a pixel, at which
nothing of what is allowed is seen. At 2,000 times a texture of the whole drawing has millions of texels, so most such
textures hold what the view shows only, as those of `vexture.render` do.
"""

import warnings
from dataclasses import dataclass, field
from random import Random
from time import process_time

import numpy as np
from drawings import drawing_of
from numpy.typing import NDArray
from sights import Sight, sight_of

import vexture
from same_fonts import FONTS
from vexture.base.tolerance import UNSEEN
from vexture.conversion.images import close_up
from vexture.conversion.reading import read_drawing
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact_colours

MOST = 2.0
"""Of 255: a larger difference of a component is a finding."""

SHARP = 5e-3
"""Pixels: the default tolerance where it is usual."""

SHARE = 1e-3
"""Pixels: the precision of a texture that is prepared for a view."""

FINEST_PRECISION = 2.0**-30
"""Unit-square units: the converter takes no smaller one."""

SLOWEST = 6.0
"""Seconds of the processor for a picture by the exact renderer, some of which have gradients with very many periods."""

BAND = 4
"""Rows that are drawn at once; the time is looked at between them."""

VIEW = "\n<!-- view "
END = " -->\n"


class SlowError(Exception):
    """The exact renderer takes too long for a view."""


@dataclass(frozen=True, slots=True)
class Case:
    """What is compared; as a file, an SVG with the view in a comment."""

    svg: str
    sight: Sight

    def file(self) -> bytes:
        """Content of the file."""
        return f"{self.svg.rstrip()}{VIEW}{self.sight.text()}{END}".encode()

    @classmethod
    def parsed(cls, data: bytes) -> "Case":
        """The case of a file."""
        svg, _, rest = data.decode().rpartition(VIEW)
        return cls(svg, Sight.parsed(rest.removesuffix(END)))


@dataclass(slots=True)
class Compared:
    """The worst pixel of a picture."""

    gap: float = 0.0  # of premultiplied components, of 255
    place: tuple[int, int] = (0, 0)  # column and row
    ours: tuple[float, ...] = ()  # colour there, of 255
    exact: tuple[float, ...] = ()
    beyond: int = 0  # pixels whose difference is a finding
    seconds: dict[str, float] = field(default_factory=dict)


def drawn(svg: str) -> Drawing:
    """Read a drawing with the fonts that all machines have."""
    return read_drawing(svg.encode(), name="drawing.svg", fonts=[FONTS])


def case_of(seed: str, has_gradients: bool) -> Case | None:
    """Make the case of a seed; None where its drawing shows nothing."""
    svg = drawing_of(seed, has_gradients)
    drawing = drawn(svg)
    if not drawing.segments:
        return None
    return Case(svg, sight_of(Random(f"view {seed} {has_gradients}"), drawing))


def compare(case: Case, renderer: str = "cpu", share: float | None = None) -> Compared:
    """Draw a case twice. A `share` of a pixel is the precision even where the default would do."""
    drawing, found, sight = drawn(case.svg), Compared(), case.sight
    if not drawing.segments:
        return found
    start = process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ours = picture(drawing, sight, renderer, share, found.seconds)
    start = process_time()
    exact = exact_picture(drawing, sight)
    found.seconds["exact"] = process_time() - start
    gaps = np.nan_to_num(255.0 * np.abs(ours.astype(float) - exact), nan=np.inf).max(axis=2)
    row, column = map(int, np.unravel_index(gaps.argmax(), gaps.shape))
    found.gap, found.place, found.beyond = float(gaps[row, column]), (column, row), int((gaps > MOST).sum())
    found.ours, found.exact = (
        tuple((255.0 * each[row, column].astype(float)).round(2).tolist()) for each in (ours, exact)
    )
    return found


def exact_picture(drawing: Drawing, sight: Sight) -> NDArray[np.float32]:
    """The picture by the exact renderer, in bands; raises a `SlowError`."""
    until, bands = process_time() + SLOWEST, []
    for top in range(0, sight.size, BAND):
        matrix = np.array(sight.matrix)
        matrix[:, 2] += top * matrix[:, 1]
        bands.append(render_exact_colours(drawing, (sight.size, min(BAND, sight.size - top)), matrix))
        if process_time() > until:
            raise SlowError
    return np.concatenate(bands)


def picture(
    drawing: Drawing, sight: Sight, renderer: str, share: float | None, seconds: dict[str, float]
) -> NDArray[np.float32]:
    """Convert, and draw the texture."""
    start, view = process_time(), np.array(sight.matrix)
    pixel = sight.pixel
    if sight.is_part:
        drawing, view, _ = close_up(drawing, sight.size, view)
        pixel = float(np.linalg.svd(view[:2, :2], compute_uv=False)[-1])
        if not drawing.segments:
            return np.zeros((sight.size, sight.size, 4), np.float32)
    precise = share is not None or pixel * SHARP < UNSEEN
    options = {"precision": max((share or SHARE) * pixel, FINEST_PRECISION)} if precise else {}
    texture = vexture.convert(drawing, split="faces", **options)
    seconds["convert"] = process_time() - start
    start = process_time()
    found = texture.render(sight.size, view, renderer=renderer)
    seconds[renderer] = process_time() - start
    return found
