"""Glyphs in colour, and their colours by the exact renderer."""

import numpy as np
from made import (
    PALETTE,
    made_font,
)

from vexture.drawing.drawing import Drawing, Path
from vexture.fonts.face import faces_in
from vexture.renderers.exact import render_exact_colours


def layers_of(paint, **options):
    face = faces_in(made_font({"A": "square"}, {"A": paint}))[0]
    return face.layers(face._font.get_nominal_glyph(ord("A")), **options)


def colour_at(layers, *points):
    """Premultiplied colours at points of the em, by the exact renderer: each the mean of a hundredth of the em."""
    found = Drawing.from_source(
        [
            Path(tuple(contour * [1, -1] for contour in path.contours), path.fill_rule, flipped(path), path.group)
            for path in layers.paths
        ],
        (0, -900, 1000, 1000),
        groups=layers.groups,
    )
    image = render_exact_colours(found, 100)
    return [image[int((900 - y) / 10), int(x / 10)] for x, y in points]


def flipped(path):
    return path.paint.after(((1, 0, 0), (0, -1, 0)))


def premultiplied(color, alpha=1.0):
    red, green, blue, own = PALETTE[color]
    return np.array([red, green, blue, 1.0]) * own * alpha


def close(found, expected):
    np.testing.assert_allclose(found, expected, atol=1.5 / 255)
