"""The cubics of a drawing in one array."""

import numpy as np
from numpy.typing import NDArray

from vexture.drawing import Drawing

__all__ = ["gather"]


def gather(drawing: Drawing) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Cubics of a drawing (n, 4, 2), the path of each (n,), and the paths' fill rules (paths,).

    A path that repeats an earlier one bit for bit adds nothing to the silhouette and is left out.
    """
    different = {(path.fill_rule, *(contour.tobytes() for contour in path.contours)): path for path in drawing.paths}
    paths = list(different.values())
    contours = [contour for path in paths for contour in path.contours]
    cubics = np.concatenate(contours) if contours else np.empty((0, 4, 2))
    lengths = [sum(map(len, path.contours)) for path in paths]
    owner = np.repeat(np.arange(len(lengths), dtype=np.int64), lengths)
    return cubics, owner, np.array([int(path.fill_rule) for path in paths], dtype=np.int64)
