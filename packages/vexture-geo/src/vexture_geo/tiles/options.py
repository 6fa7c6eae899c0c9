"""Options of a pyramid."""

import hashlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from vexture.base.errors import ParameterError, SourceError
from vexture.base.workers import Cluster, InProcess, Processes, Workers
from vexture_geo.tiles.attributes import TileStyle
from vexture_geo.tiles.grid import check_zooms, coarse, zooms_of
from vexture_geo.tiles.subtree import Pyramid


@dataclass(frozen=True)
class TileOptions:
    """Options of a pyramid.

    Parameters
    ----------
    max_zoom : int
        The largest zoom of views in which no border is off by more than a quarter of a pixel. Because tiles are sharp
        far beyond their own zoom, the zoom of the last tiles is up to `step` lower
        (`vexture_geo.tiles.grid.last_zoom`).
    min_zoom : int
        The smallest zoom that has tiles.
    step : int
        Zooms between levels of the pyramid: 2 or 3.
    layer, where, id, source_crs : str or None
        See `vexture_geo.vector.features.feature_batches`; `source_crs` is its `crs`.
    name, attribution : str
        Written to the metadata.
    style : TileStyle
        Colours and order of features, and the table of attributes.
    processes : int
        Worker processes on this machine.
    scheduler : str or None
        Address of a Dask scheduler whose workers do the work.
    """

    max_zoom: int = 12
    min_zoom: int = 0
    step: int = 2
    layer: str | None = None
    where: str | None = None
    id: str | None = None
    source_crs: str | None = None
    name: str = ""
    attribution: str = ""
    style: TileStyle = field(default_factory=TileStyle)
    processes: int = 1
    scheduler: str | None = None

    def __post_init__(self) -> None:
        check_zooms(self.min_zoom, self.max_zoom, self.step)
        if self.processes < 1:
            raise ParameterError(f"`processes` is {self.processes}; it must be at least 1")
        self.style.check()

    def pyramid(self, paints: NDArray[np.uint32], ranks: NDArray[np.uint32]) -> Pyramid:
        """Make the data that all work shares from features' colours and ranks."""
        return Pyramid(self.coarse, self.zooms, self.step, self.max_zoom, paints, ranks)

    @property
    def zooms(self) -> tuple[int, ...]:
        """Zooms that have tiles."""
        return tuple(zooms_of(self.min_zoom, self.max_zoom, self.step))

    @property
    def coarse(self) -> tuple[int, ...]:
        """Generalised zooms."""
        return tuple(coarse(self.max_zoom, self.step))

    @property
    def reading(self) -> dict[str, Any]:
        """Options of the source's reader."""
        return {
            "layer": self.layer,
            "where": self.where,
            "crs": self.source_crs,
            "id": self.id,
            "columns": self.style.read,
        }

    @property
    def key(self) -> dict[str, Any]:
        """Everything that finished work depends on, besides the source."""
        return {"zooms": [self.min_zoom, self.max_zoom, self.step], **self.reading, "look": self.style.key}

    def check_workers(self) -> None:
        """Raise a `DeviceError` if the executor cannot be reached."""
        if self.scheduler is not None:
            Cluster(self.scheduler).check()

    def executor(self) -> Workers:
        """Executor of the work."""
        if self.scheduler is not None:
            return Cluster(self.scheduler)
        return Processes(self.processes) if self.processes > 1 else InProcess()


def digest_of(source: Path) -> str:
    """Digest a source's content, including the files beside it that belong to it."""
    try:
        if source.is_dir():
            files = sorted(path for path in source.rglob("*") if path.is_file())
        elif source.suffix.lower() == ".shp":
            files = sorted(path for path in source.parent.iterdir() if path.stem == source.stem and path.is_file())
        else:
            files = [source]
        whole = hashlib.sha256()
        for path in files:
            with path.open("rb") as file:
                whole.update(f"{path.name} {hashlib.file_digest(file, 'sha256').hexdigest()}\n".encode())
    except OSError as error:
        raise SourceError(f"{source}: cannot be read ({error.strerror}); correct its name") from None
    return whole.hexdigest()
