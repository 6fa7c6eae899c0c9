"""Drawings as pixels, and how far a traced outline is from the true one."""

import io
from pathlib import Path

import numpy as np
from PIL import Image

import vexture
from vexture.renderers.exact import render_exact

SHAPES = Path(__file__).parents[3] / "examples" / "shapes"

LOGO = b"""<svg viewBox="0 0 120 80"><rect x="10" y="10" width="100" height="60" rx="10" fill="#0a4d8c"/>
<circle cx="40" cy="40" r="22" fill="#f2b632"/><path fill="#c8321e" d="M60 20h20v40H60z"/>
<path fill="#2e8b57" d="M80 20h20v40H80z"/><circle cx="90" cy="40" r="6" fill="#0a4d8c"/></svg>"""

COLOURS = ["#0a4d8c", "#f2b632", "#c8321e", "#2e8b57"]


def gray(drawing, size):
    """A black drawing on white, 8 bits."""
    return np.rint(255.0 * (1.0 - render_exact(drawing, (size, size)))).astype(np.uint8)


def coloured(drawing, width, height):
    """A drawing in its colours, not premultiplied, 8 bits; it is wider than high."""
    to_unit = [[1 / width, 0.0, 0.0], [0.0, -1 / width, 0.5 + 0.5 * height / width]]
    image = vexture.render(drawing, (width, height), to_unit, "exact")
    image[..., :3] /= np.maximum(image[..., 3:], 1e-6)
    return np.rint(255.0 * np.clip(image, 0.0, 1.0)).astype(np.uint8)


def on_white(pixels):
    return np.asarray(
        Image.alpha_composite(Image.new("RGBA", pixels.shape[1::-1], "white"), Image.fromarray(pixels)).convert("RGB")
    )


def distances(drawing, traced, size):
    """Mean distance of the outlines, and by how much the traced one is outside, in pixels of a picture of that size."""
    true, found = (render_exact(each, (1024, 1024)).astype(float) for each in (drawing, traced))
    length = np.hypot(*np.gradient(true)).sum() / 1024
    area = (found - true) / 1024**2
    return np.abs(area).sum() / length * size, area.sum() / length * size


def file_of(pixels, kind="PNG", **options):
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, kind, **options)
    return file.getvalue()


def area(drawing):
    return float(render_exact(drawing, (256, 256)).mean())


def hexes(drawing):
    return [layer.paths[0].paint.hex for layer in drawing.layers()]
