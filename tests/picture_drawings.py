"""Drawings with pictures of all kinds, and random ones."""

import numpy as np

from degenerate import circle
from gradient_drawings import FADING, SQUARE, WARM, linear, painted_path
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling

DISC, OTHER = circle((0.5, 0.5), 0.45), circle((0.62, 0.58), 0.3)


def random_pixels(rng: np.random.Generator, rows: int, columns: int, is_opaque: bool = False) -> np.ndarray:
    """Premultiplied noise of every opacity, (rows, columns, 4)."""
    straight = rng.random((rows, columns, 4))
    straight[..., 3] = 1.0 if is_opaque else straight[..., 3]
    straight[..., :3] *= straight[..., 3:]
    return np.floor(255.0 * straight).astype(np.uint8)


def fitted(pixels: np.ndarray, sampling: Sampling = Sampling.LINEAR, angle: float = 0.0) -> Picture:
    """A picture over the unit square, turned about its middle."""
    rows, columns = pixels.shape[:2]
    cos, sin = np.cos(angle), np.sin(angle)
    u, v = (columns * cos, columns * sin), (rows * sin, -rows * cos)
    middle = [0.5 * columns - 0.5 * sum(u), 0.5 * rows - 0.5 * sum(v)]
    return Picture(((*u, middle[0]), (*v, middle[1])), pixels, sampling)


def pictured_path(contour: np.ndarray, picture: Picture, group: int = -1) -> Path:
    """A path of one contour, painted with a picture."""
    return painted_path(contour, Paint.from_picture(picture), group)


def random_picture(rng: np.random.Generator) -> Picture:
    """A small picture, anywhere, turned and slanted, of either sampling, or of one pixel."""
    pixels = random_pixels(rng, *rng.integers(1, 8, 2).tolist(), bool(rng.integers(2)))
    rows = rng.normal(0.0, 5.0, (2, 3)).tolist()
    to_pixels = (rows[0][0], rows[0][1], rows[0][2]), (rows[1][0], rows[1][1], rows[1][2])
    return Picture(to_pixels, pixels, Sampling(int(rng.integers(2))), float(rng.choice([1.0, rng.random()])))


def _drawings() -> dict[str, Drawing]:
    rng = np.random.default_rng(41)
    photo = fitted(random_pixels(rng, 7, 9))
    tiles = fitted(random_pixels(rng, 4, 5, True), Sampling.PIXELS, 0.4)
    ramp = painted_path(SQUARE, linear((0, 0), (1, 1), WARM))
    return {
        "photo": Drawing((pictured_path(DISC, photo),)),
        "tiles": Drawing((pictured_path(SQUARE, tiles), pictured_path(OTHER, photo))),
        "one pixel": Drawing((pictured_path(SQUARE, photo), pictured_path(OTHER, fitted(random_pixels(rng, 1, 1))))),
        "over a gradient": Drawing((ramp, pictured_path(DISC, photo))),
        "under a gradient": Drawing((pictured_path(DISC, tiles), painted_path(OTHER, linear((0, 0), (1, 0), FADING)))),
        "shared": Drawing((pictured_path(DISC, photo), pictured_path(OTHER, photo.after(((1, 0, 0.1), (0, 1, 0)))))),
        "groups": Drawing(
            (ramp, pictured_path(DISC, photo, 0), painted_path(OTHER, Paint((0.1, 0.8, 0.3)), 0)),
            groups=(Group(opacity=0.6, blend=Blend.MULTIPLY),),
        ),
        "mask": Drawing(
            (ramp, pictured_path(DISC, photo, 1), painted_path(SQUARE, Paint((0.1, 0.8, 0.3)), 0)),
            groups=(Group(opacity=0.9), Group(0, mask=Mask.LUMINANCE)),
        ),
    }


PICTURES = _drawings()
