"""Convert flood data of any kind into shapes of water in the frame of a page, and pictures of their depths.

The page reads the depth at the pointer from these pictures, which hold depths or classes of depth.
"""

import json
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from io import BytesIO
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import VECTOR_FILES, FileKind, kind_of, start_of, unpack_source
from vexture.base.errors import LimitError, ParameterError, SourceError, VextureError
from vexture.conversion.parameters import Parameters
from vexture.server.publish_file import load_kernels, shape_of_drawing, texture_shape
from vexture.server.published import PublishedFile, PublishedShape
from vexture_geo.base.extent import DepthClasses, Extent, Frame, Step
from vexture_geo.flood.relief import Relief
from vexture_geo.flood.scene import PREFIX, labels
from vexture_geo.flood.surface import WaterSurface

WATER_PARAMETERS: Final = Parameters(split=None, precision=2e-6)
"""Seen from the beach, a pixel is about 1e-5 of the frame, so outlines shift by a fifth of a pixel."""

CLASS_PARAMETERS: Final = Parameters(split="faces")
"""The map of depths is seen from above, where the default precision suffices."""

SAME_PLACE: Final = 1e-6
"""Largest difference of a texture's place from the frame, as a fraction of it, by rounding when it was written."""

AREA_CELLS: Final = 64
"""Cells on the longer side of the grid over which the area under water is summed; each cell is exact."""

OPTIONS: Final[dict[FileKind, tuple[str, ...]]] = {
    FileKind.DEPTHS: ("time_dim", "variable", "depths"),
    FileKind.AREAS: ("layer",),
    FileKind.GEOJSON: ("layer",),
}
"""Parameters of the reader by kind of data; data of other kinds are not georeferenced."""

KINDS: Final = f"GeoJSON, {VECTOR_FILES} (a shapefile or FileGDB zipped), GeoTIFF, NetCDF, GRIB or a packed texture"

PIXELS: Final = 256
"""Most pixels on the longer side: the picture is read at the pointer, not drawn."""

SCALE: Final = 50.0
"""Metres. Steps of depth are even in much shallower water, and a fraction of the depth in much deeper water."""

STEP: Final = 1e-4
"""Step of the numbers in a picture: 5 mm in shallow water, a ten-thousandth of the depth in deep water.

A depth of 12 km is 61,738, so that all depths fit 16 bits.
"""

CODE: Final = {"scale": SCALE, "step": STEP}
"""How to read a picture of depths: a depth is `scale` times the hyperbolic sine of its number times `step`."""


@dataclass(frozen=True, slots=True)
class FloodConversion:
    """Converts the steps of one flood into shapes."""

    frame: Frame  # of all steps
    hmin: float  # metres: depth from which a place is wet
    options: Mapping[str, Any]  # further parameters of vexture.read_extent
    relief: Relief  # the ground
    depths: tuple[float, ...]  # metres from which the classes of depth begin
    bed: NDArray[np.float32] | None = None  # over the frame, if the data have it

    def step(self, step: Step, surface: WaterSurface, name: str, label: str) -> PublishedShape:
        """Make the shape of a step in this frame, with its surface; `label` is its time for people."""
        from vexture_geo.flood.depth_classes import class_drawing
        from vexture_geo.flood.hazard import UNIT, hazard_png

        load_kernels()
        shape = shape_of_drawing(replace(step.drawing, name=name), name, WATER_PARAMETERS, time.perf_counter())
        most = None if step.depth is None else deepest(step.depth)
        views = {}
        if step.depth is not None and most:
            views["depth"] = PublishedFile(depth_png(step.depth), "image/png", ".png")
        if step.classes is not None:
            views["ranks"] = PublishedFile(ranks_png(step.classes), "image/png", ".png")
        classes = class_drawing(step, self.depths, self.hmin, name)
        if classes is not None:
            views["classes"] = shape_of_drawing(classes, name, CLASS_PARAMETERS, time.perf_counter()).texture
        hazard = hazard_png(step, self.relief.heights.shape[::-1], self.hmin)
        if hazard is not None:
            views["hazard"] = PublishedFile(hazard, "image/png", ".png")
        level, level_facts = surface.encode_png()
        views["level"] = PublishedFile(level, "image/png", ".png")
        facts = {
            **shape.facts,
            "milliseconds": None,  # a duration would make two pages of one flood differ
            "level": level_facts,
            "hazard": None if hazard is None else {"unit": UNIT},
            "depth": None if step.depth is None else CODE,
            "ranges": None if step.classes is None else ranges_as_json(step.classes),
            "time": None if step.time is None else step.time.isoformat(),
            "label": label,
            "dry": self._is_dry(step),
            "deepest": None if most is None else round(most, 3),
            "area": self._area(step),
        }
        return replace(shape, facts=facts, views=views)

    def convert_one(self, arguments: tuple[Step, WaterSurface, str, str]) -> PublishedShape:
        """Make the shape of one step; see `step`."""
        return self.step(*arguments)

    def shape_of(self, data: bytes, name: str) -> PublishedShape:
        """Make the shape of an upload: a step in any format, or a texture that was made in this frame."""
        if name != PREFIX and not name.startswith(f"{PREFIX}/"):
            raise LimitError(f"{name}: this server shows {PREFIX} and {PREFIX}/NAME only; publish under such a name")
        if not data.strip():
            raise LimitError(f"{name}: the upload is empty; send {KINDS}")
        kind = kind_of(start_of(unpack_source(data)), name)
        if kind is FileKind.TEXTURE:
            return self._texture(data, name)
        if kind not in OPTIONS:
            raise SourceError(f"{name}: has no place in the world; send {KINDS}")
        extent = self._read(data, name, OPTIONS[kind])
        if len(extent.steps) != 1:
            raise LimitError(f"{name}: holds {len(extent.steps)} times; send one at a time, each under its name")
        step = extent.steps[0]
        return self.later(step, extent.bed, name, labels([step.time])[0])

    def later(self, step: Step, bed: NDArray[np.float32] | None, name: str, label: str) -> PublishedShape:
        """Make the shape of a later step in this frame; `bed` is its own bed over the frame, if it has one."""
        from vexture_geo.flood.surface import surface_of

        surface = surface_of(step, self.frame, self.relief, self.bed if bed is None else bed, self.hmin)
        return self.step(step, surface, name, label)

    def _read(self, data: bytes, name: str, possible: tuple[str, ...]) -> Extent:
        from vexture_geo.base.crs import MissingReferenceError
        from vexture_geo.readers import extent_of

        options = {option: value for option, value in self.options.items() if option in possible}
        try:
            return extent_of(data, name, frame=self.frame, hmin=self.hmin, **options)
        except MissingReferenceError:
            raise SourceError(
                f"{name}: says no reference system, so its place is unknown; write it into the file"
            ) from None
        except (SourceError, LimitError) as error:
            raise type(error)(f"{name}: {_for_senders(str(error).removeprefix(f'{name}: '))}") from None
        except ParameterError as error:  # the server's options do not fit the uploaded file
            raise SourceError(f"{name}: {_for_senders(str(error))}") from None

    def warm(self) -> None:
        """Load packages, kernels and the frame's reference system before the first upload."""
        west, south, east, north = self.frame.bounds
        ring = [[west, south], [east, south], [(west + east) / 2, north], [west, south]]
        crs = {"type": "name", "properties": {"name": self.frame.crs}}
        shape = {"type": "Polygon", "coordinates": [ring], "crs": crs}
        with suppress(VextureError):
            self.shape_of(json.dumps(shape).encode(), PREFIX)
        with suppress(VextureError):
            self.shape_of(_small_tiff(self.frame), PREFIX)
        import h5py, xarray  # noqa: E401, F401, I001  # the rest of what NetCDF needs

    def _texture(self, data: bytes, name: str) -> PublishedShape:
        """Make the shape of a texture that was made in this frame."""
        from vexture.texture.load import texture_from

        roots = texture_from(data, name).roots
        to_source = self.frame.to_source
        if len(roots) != 1:
            raise LimitError(f"{name}: the texture holds {len(roots)} shapes; send one with one, or the data it is of")
        if roots[0].is_map:
            raise LimitError(
                f"{name}: the texture is a planar map, and water needs a silhouette; send the data it is of"
            )
        apart = np.abs(roots[0].to_source - to_source) / np.abs(np.diag(to_source[:, :2]))[:, None]
        if not apart.max() <= SAME_PLACE:
            raise LimitError(
                f"{name}: the texture was not made in the frame of this page; send the data that it was made of"
            )
        shape = texture_shape(data, name, name)
        facts = {**shape.facts, "time": None, "label": "", "dry": shape.facts["curves"] == 0, "deepest": None}
        return replace(shape, facts=facts)

    def _area(self, step: Step) -> float:
        """Square metres under water within the frame."""
        from vexture_geo.flood.grids import coverage_over, size_for

        covered = coverage_over(step.drawing, self.frame.box, size_for(self.frame, AREA_CELLS))
        return round(float(covered.mean(dtype=np.float64)) * self.frame.metres[0] * self.frame.metres[1], 1)

    def _is_dry(self, step: Step) -> bool:
        """Return whether a step has no water in the frame."""
        x0, y0, x1, y1 = self.frame.box
        boxes = (path.box.ravel() for path in step.drawing.paths)
        return not any(left < x1 and right > x0 and low < y1 and high > y0 for left, low, right, high in boxes)


def _for_senders(line: str) -> str:
    """Adapt the remedy of an error to the sender of a file, who sets no parameters.

    Examples
    --------
    >>> _for_senders("it is outside of the frame; correct the bounds, or `crs`")
    'it is outside of the frame; correct the file'
    """
    what, _, remedy = line.rpartition("; ")
    return f"{what}; correct the file" if what and "`" in remedy else line


def _small_tiff(frame: Frame) -> bytes:
    """Make a raster of depths over a frame, half of it wet."""
    from rasterio.io import MemoryFile

    from vexture_geo.flood.grids import pixels_to

    with MemoryFile() as file:
        with file.open(
            driver="GTiff", width=4, height=4, count=1, dtype="float32", crs=frame.crs,
            transform=pixels_to(frame.bounds, (4, 4)),
        ) as raster:  # fmt: skip
            raster.write(np.tile(np.array([0, 0, 2, 2], np.float32), (4, 1)), 1)
        return bytes(file.read())


def deepest(depth: NDArray[np.float32]) -> float:
    """Greatest depth in metres, 0 if all is dry or unknown."""
    known = depth[np.isfinite(depth)]
    return max(0.0, float(known.max())) if known.size else 0.0


def depth_png(depth: NDArray[np.float32]) -> bytes:
    """Encode depths in metres as a 16-bit gray PNG for `CODE`: 0 is dry or unknown, and wet pixels are at least 1."""
    metres = _thin_grid(np.where(np.isfinite(depth), np.maximum(depth, 0.0), 0.0).astype(np.float64))
    numbers = np.rint(np.arcsinh(metres / SCALE) / STEP)
    return _png(np.where(metres > 0.0, np.clip(numbers, 1.0, 65535.0), 0.0).astype(np.uint16))


def ranks_png(classes: DepthClasses) -> bytes:
    """Encode ranks of classes of depth as an 8-bit gray PNG; 0 is dry or unknown."""
    return _png(_thin_grid(classes.ranks))


def ranges_as_json(classes: DepthClasses) -> list[list[float | None]]:
    """Lower and upper limits of classes in metres; the upper limit of an unbounded class is null."""
    return [[low, high if np.isfinite(high) else None] for low, high in classes.ranges]


def _thin_grid(grid: NDArray[Any]) -> NDArray[Any]:
    """Thin a grid that is too large to every second, third or further sample."""
    stride = -(-max(grid.shape) // PIXELS)
    return np.ascontiguousarray(grid[stride // 2 :: stride, stride // 2 :: stride])


def _png(pixels: NDArray[Any]) -> bytes:
    from PIL import Image

    out = BytesIO()
    Image.fromarray(pixels).save(out, format="PNG", optimize=True)
    return out.getvalue()
