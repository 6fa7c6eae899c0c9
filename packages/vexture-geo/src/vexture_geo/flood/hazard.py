"""Hazard to people, where the speed of the water is known as well as its depth.

The rating is depth times (speed + 0.5), with the thresholds of Defra and the Environment Agency, *Flood Risks to
People*, FD2320 and FD2321 (2005, 2006). Their debris term is omitted, because it depends on what lies on the ground,
which no file states.
"""

from io import BytesIO
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture_geo.base.extent import Step
from vexture_geo.flood.grids import coarser, sample_grid


class HazardClass(NamedTuple):
    """Class of the rating: its lowest value, its colour and its description."""

    least: float
    color: str
    text: str


HAZARDS: Final = (
    HazardClass(0.0, "#ffffb2", "below 0.75: low"),
    HazardClass(0.75, "#fecc5c", "to 1.25: danger for some"),
    HazardClass(1.25, "#fd8d3c", "to 2: danger for most"),
    HazardClass(2.0, "#bd0026", "above: danger for all"),
)
"""Classes of the rating in ColorBrewer's YlOrRd (C. Brewer, 2002), darker from class to class."""

OFFSET: Final = 0.5
"""Metres a second, added to the speed because still deep water is dangerous, too."""

UNIT: Final = 0.01
"""Step of the ratings in a picture, which ends at 2.54: higher ratings are all in the last class."""


def rating(depth: NDArray[Any], speed: NDArray[Any]) -> NDArray[np.float64]:
    """Rating of depths in metres and speeds in metres a second.

    Examples
    --------
    >>> rating(np.array([0.5, 1.0, 2.0]), np.array([0.5, 1.5, 0.0]))
    array([0.5, 2. , 1. ])
    """
    return np.asarray(depth * (speed + OFFSET), np.float64)


def hazard_png(step: Step, size: tuple[int, int], hmin: float) -> bytes | None:
    """Encode the ratings of a step at columns and rows of samples as an 8-bit gray PNG; None if speeds are unknown.

    1 is a rating of 0, and each further number adds `UNIT`; 0 is dry or unknown.
    """
    from PIL import Image

    if step.depth is None or step.speed is None:
        return None
    found = np.where(step.depth >= hmin, rating(step.depth, step.speed), np.nan)
    if not np.isfinite(found).any():
        return None
    numbers = np.clip(np.rint(sample_grid(coarser(found, size), size) / UNIT) + 1.0, 1.0, 255.0)
    out = BytesIO()
    Image.fromarray(np.nan_to_num(numbers, nan=0.0).astype(np.uint8)).save(out, format="PNG", optimize=True)
    return out.getvalue()
