"""Coverage of a folded shape by brute force: many points of each pixel, each folded exactly and looked up."""

import numpy as np
from numpy.typing import NDArray

from vexture.fold.fold import Fold
from vexture.texture.texture import Texture

SAMPLES = 256
LATTICE = (0.5 + np.arange(SAMPLES)[:, None] * (0.7548776662466927, 0.5698402909980532)) % 1.0
"""A pixel's points: a lattice that meets straight edges one point at a time, whatever their direction."""

Numbers = NDArray[np.float64]


def positions(to_unit: Numbers, pixels: Numbers) -> Numbers:
    """Places of the unit square at points of a picture."""
    found = pixels @ to_unit[:, :2].T + to_unit[:, 2]
    return found[:, :2] / found[:, 2:]


def near_edges(picture: Numbers) -> NDArray[np.bool_]:
    """Pixels that are partly covered, and those around them."""
    step = 1.0 / 255.0
    partly = (picture > step) & (picture < 1.0 - step)
    wide = np.pad(partly, 1)
    rows, columns = picture.shape
    return np.any([wide[i : i + rows, j : j + columns] for i in range(3) for j in range(3)], axis=0)


def errors(
    picture: Numbers, texture: Texture, fold: Fold, to_unit: Numbers, seconds: float, *, wrap: str = "none"
) -> Numbers:
    """Differences of a picture's edge pixels, in 1/255, from the folded shape's coverage of them."""
    row, column = np.nonzero(near_edges(picture))
    points = (np.stack([column, row], axis=1)[:, None] + LATTICE).reshape(-1, 2)
    places, _ = fold.at(positions(to_unit, points), seconds, wrap=wrap)
    if wrap == "repeat":
        places -= np.floor(places)
    covered = texture.contains(places).reshape(-1, SAMPLES).mean(axis=1)
    shown = picture[row, column]
    edge = ((covered > 0.0) & (covered < 1.0)) | ((shown > 0.02) & (shown < 0.98))
    return 255.0 * np.abs(shown - covered)[edge]
