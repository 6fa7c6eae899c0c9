"""The picture of a fold."""

import numpy as np

from vexture.drawing.drawing import Drawing
from vexture.fold.fold import Fold
from vexture.fold.picture import fold_picture


def polygon(*corners: tuple[float, float]) -> Drawing:
    return Drawing.polygon(corners)


SLOPE = polygon((0, 0), (1, 0), (1, 0.3), (0, 0.7))


def test_the_picture_shows_directions_kinds_and_begins() -> None:
    rng = np.random.default_rng(1)
    shape = (8, 8)
    mixed = Fold(np.full((*shape, 2), 0.05), rng.integers(0, 5, shape), rng.uniform(0, 3, shape), 2.0, 4.0)  # type: ignore[arg-type]
    image = np.asarray(fold_picture(mixed, SLOPE, 512)).astype(int)
    assert image.shape == (512, 768, 3)
    assert len(np.unique(image[:, :512].reshape(-1, 3), axis=0)) > 20
    assert len(np.unique(image[60:120, 512:].reshape(-1, 3), axis=0)) >= 5
    still = np.asarray(fold_picture(Fold(np.zeros((4, 4, 2))), None, 256))
    assert still.shape == (256, 384, 3)
    opposite = np.asarray(fold_picture(Fold(np.full((8, 8, 2), -0.05)), SLOPE, 512)).astype(int)
    assert np.abs(opposite[200:400, 100:400] - image[200:400, 100:400]).mean() > 20
