"""Steps of time of a map's widget: their colours, which a page gets once, and their values in tips."""

import zlib
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.tree.planar.style import round_colours
from vexture_geo.maps.prepare import Prepared
from vexture_geo.maps.times import STEP_COLUMNS

if TYPE_CHECKING:
    import pyarrow

COLOUR_ONE: Final = 10_000
"""Integer that encodes 1 in the colours that are sent: colours of elements have four digits."""


def encode_colours(rgba: NDArray[np.float64]) -> dict[str, bytes]:
    """Encode colours, (..., 4): each distinct one once, and the index of each among them."""
    whole = np.uint16(np.rint(COLOUR_ONE * rgba))
    unique, places = np.unique(whole.view(np.uint64).ravel(), return_inverse=True)
    kind = np.uint8 if len(unique) <= 1 << 8 else np.uint16 if len(unique) <= 1 << 16 else np.uint32
    return {"colors": unique.tobytes(), "places": places.astype(kind).tobytes()}


class MapSteps:
    """Steps of the layer that changes with time; the other layers keep their colours."""

    def __init__(self, ready: Prepared, still: NDArray[np.float64]) -> None:
        assert ready.steps is not None
        layer, self._steps = ready.steps
        counts = [len(one.features) for one in ready.layers]
        first = int(np.cumsum([0, *counts])[ready.layers.index(layer)])
        self._rows, self._still = slice(first, first + len(layer.features)), still
        self.labels, self.columns = self._steps.labels, self._steps.columns
        self.legend = next(legend for legend in ready.legends if STEP_COLUMNS in legend)

    def at(self, time: float) -> NDArray[np.float64]:
        """Colours of the rows of the map's table at a time in steps."""
        rgba = self._still.copy()
        rgba[self._rows] = self._steps.at(time)
        return round_colours(rgba)

    def encode_steps(self, rows: NDArray[np.intp]) -> dict[str, Any]:
        """Encode the colours of some rows of the table at all steps, one step after another; indices are deflated."""
        every = np.stack([self.at(step)[rows] for step in range(len(self.labels))])
        parts = encode_colours(every)
        return {"colors": parts["colors"], "places": zlib.compress(parts["places"])}

    def value(self, table: "pyarrow.Table", row: int, time: float) -> tuple[str, Any]:
        """Return the name of the nearest step, and a feature's value there."""
        step = min(max(round(time), 0), len(self.columns) - 1)
        return self.labels[step], table.column(self.columns[step])[row].as_py()


def steps_of(ready: Prepared, still: NDArray[np.float64]) -> MapSteps | None:
    """Make the steps of a map that changes with time; None for other maps."""
    return None if ready.steps is None else MapSteps(ready, still)
