"""The texels of textures, shown as images."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.layout import COORDINATE_BITS
from vexture.texture.texture import Texture
from vexture.thesis.layout import CONSTANT_ROWS, CURVE_WIDTH, QUAD_WIDTH
from vexture.thesis.texture import ThesisTexture
from vexture_evidence.figures.style import GRID, MUTED, SMALL, panels
from vexture_evidence.measures.leaves import quads

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BETWEEN: Final = 1.6
"""Height of the text above an image, in texels."""

KIND_OF_QUAD: Final = 0.5
"""Blue value of a quad's words; the blue value of a curve's words is 0."""


class Strip(NamedTuple):
    """An image of texels, turned on its side as the thesis prints them: one column for each quad or curve."""

    title: str
    pixels: NDArray[np.float64]


def texture_images(texture: ThesisTexture | Texture) -> list[Strip]:
    """Images of a texture's texels, sRGB 0..1.

    A thesis pair is two images whose pixels are shown in their own colours, turned by 90 degrees counter-clockwise. A
    texel of a packed texture is a column of four words, the first on top. The low half of a word is shown as red, the
    high half as green; blue is half for quads and 0 for curves.

    Parameters
    ----------
    texture : ThesisTexture or Texture

    Examples
    --------
    >>> import vexture
    >>> from vexture.drawing.drawing import Drawing
    >>> triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    >>> [strip.title for strip in texture_images(vexture.convert(triangle, encoding="thesis"))]
    ['1 quad of 4 pixels', '2 constants and 4 curves of 2 pixels']
    >>> texture_images(vexture.convert(triangle))[0].pixels.shape
    (4, 6, 3)
    """
    if isinstance(texture, ThesisTexture):
        constants = len(texture.curves) - CONSTANT_ROWS
        return [
            Strip(f"{count_text(len(texture.quads), 'quad')} of {QUAD_WIDTH} pixels", _turn_rows(texture.quads)),
            Strip(
                f"{CONSTANT_ROWS} constants and {count_text(constants, 'curve')} of {CURVE_WIDTH} pixels",
                _turn_rows(texture.curves),
            ),
        ]
    used = int(np.flatnonzero(texture.flat.any(axis=1))[-1:].sum()) + 1
    words = texture.flat[:used].T
    mask = (1 << COORDINATE_BITS) - 1
    is_quad = np.zeros(used, np.bool_)
    for root in texture.roots:
        is_quad[root.quad : root.quad + len(quads(texture, root.name).x)] = True
    blue = np.broadcast_to(np.where(is_quad, KIND_OF_QUAD, 0.0), words.shape)
    pixels = np.stack([(words & mask) / mask, (words >> COORDINATE_BITS) / mask, blue], axis=2)
    many, curves = int(is_quad.sum()), used - int(is_quad.sum())
    return [Strip(f"{count_text(many, 'quad')} and {count_text(curves, 'curve')} of 4 words", pixels)]


def draw_texture(axes: "Axes", texture: ThesisTexture | Texture, *, columns: int | None = None) -> None:
    """Draw a texture's images into axes, one above the other, each with a title.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    texture : ThesisTexture or Texture
    columns : int, optional
        Width of the axes in texels, so that several textures share one scale; by default that of the widest image.
    """
    strips = texture_images(texture)
    width = columns or max(strip.pixels.shape[1] for strip in strips)
    y = 0.0
    for strip in strips:
        rows, own, _ = strip.pixels.shape
        axes.text(0.0, y - 0.25, strip.title, fontsize=SMALL, color=MUTED, va="bottom")
        how = "nearest" if own <= 200 else "auto"
        axes.imshow(strip.pixels, extent=(0.0, own, y + rows, y), interpolation=how, aspect="auto")
        axes.plot([0, own, own, 0, 0], [y, y, y + rows, y + rows, y], color=GRID, linewidth=0.5)
        y += rows + BETWEEN
    axes.set(xlim=(0.0, width), ylim=(y - BETWEEN + 0.1, -BETWEEN))
    axes.set_axis_off()


def textures(by_title: Mapping[str, ThesisTexture | Texture]) -> "Figure":
    """Show textures as images, one below the other and at one scale.

    Parameters
    ----------
    by_title : mapping
        From titles to textures.

    Returns
    -------
    matplotlib.figure.Figure

    Examples
    --------
    >>> import vexture
    >>> from vexture_evidence.measures.shape import example
    >>> pair = vexture.convert(example("duck"), encoding="thesis", bits=8)
    >>> [axes.get_title(loc="left") for axes in textures({"a pair": pair}).axes]
    ['a pair']
    """
    strips = [texture_images(texture) for texture in by_title.values()]
    columns = max(strip.pixels.shape[1] for each in strips for strip in each)
    rows = [sum(BETWEEN + len(strip.pixels) for strip in each) for each in strips]
    height = 0.3 + 0.145 * sum(rows) / len(rows)
    figure, axes = panels(len(by_title), 1, side=11.2, height=height, titles=list(by_title))
    axes[0, 0].get_gridspec().set_height_ratios(rows)
    for panel, texture in zip(axes.flat, by_title.values(), strict=True):
        draw_texture(panel, texture, columns=columns)
    return figure


def _turn_rows(rows: NDArray[Any]) -> NDArray[np.float64]:
    """Pixels as numbers in 0..1, turned by 90 degrees counter-clockwise, so that each row becomes a column."""
    return np.rot90(rows / np.iinfo(rows.dtype).max)


def count_text(count: int, noun: str) -> str:
    """Write a count with its noun, in the plural unless the count is 1.

    Examples
    --------
    >>> count_text(1, "quad"), count_text(1200, "curve")
    ('1 quad', '1,200 curves')
    """
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
