"""Shaded drawings as pixels, traced and drawn again."""

import numpy as np
from PIL import Image

import vexture
from vexture.svg.read import svg_drawing
from vexture.tracing.trace import _trace_pixels


def drawn(drawing, size):
    """Premultiplied colours of a drawing, 0..255, in a picture over which its own coordinates are spread."""
    width, height = size
    side = max(size)
    place = [[1 / side, 0.0, 0.5 - 0.5 * width / side], [0.0, -1 / side, 0.5 + 0.5 * height / side]]
    return 255.0 * vexture.render(drawing, size, place, "exact").astype(float)


def pixels_of(body, size):
    """8-bit pixels of a drawing, not premultiplied."""
    text = f'<svg viewBox="0 0 {size[0]} {size[1]}">{body}</svg>'
    levels = drawn(svg_drawing(text.encode(), "picture.svg"), size)
    levels[..., :3] *= 255.0 / np.maximum(levels[..., 3:], 1e-6)
    return np.rint(np.clip(levels, 0.0, 255.0)).astype(np.uint8)


def premultiplied(pixels):
    return np.concatenate([pixels[..., :3] * (pixels[..., 3:] / 255.0), pixels[..., 3:]], axis=2)


def traced(pixels):
    """The drawing with its background, and the differences of its picture."""
    drawing = _trace_pixels(pixels, "picture", whole=True)
    return drawing, np.abs(drawn(drawing, pixels.shape[1::-1]) - premultiplied(pixels))


def opaque(pixels):
    return np.asarray(Image.alpha_composite(Image.new("RGBA", pixels.shape[1::-1], "white"), Image.fromarray(pixels)))
