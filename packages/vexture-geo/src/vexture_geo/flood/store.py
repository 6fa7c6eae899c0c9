"""Stored water of a flood's server, with the ground on which it stands."""

import hashlib
import json
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any, Final

import numpy as np

from vexture.base.errors import DeviceError, ParameterError, reason_of, shorten_text
from vexture.server.folder import STATE, Folder
from vexture.server.limits import Limits
from vexture.texture.files import replace_files
from vexture_geo.base.extent import Extent
from vexture_geo.flood.options import FloodOptions
from vexture_geo.flood.relief import Relief

RECORD, GROUND = "flood.json", "ground.npz"

NAMED: Final = {
    "bounds": "box",
    "crs": "reference system",
    "metres": "size on the ground",
    "hmin": "depth from which it is wet",
    "depths": "classes of depth",
    "ground": "ground",
}
"""Facts that identify the flood of stored water, as people name them."""

MOST_SHOWN: Final = 60

REMEDY: Final = "choose another folder"


class FloodStore(Folder):
    """Pushed and followed steps of one flood.

    The folder also stores what the steps depend on: the frame, and the relief on which their levels stand. An invented
    relief depends on the steps at the first start of the server, so later starts use the stored one.
    """

    def __init__(self, path: Path, limits: Limits, report: Callable[[str], None]) -> None:
        super().__init__(path, limits, report)
        self._place = path / STATE

    def relief(self, options: FloodOptions, extent: Extent, make_relief: Callable[[], Relief]) -> Relief:
        """Return the stored ground or, in a new folder, store what `make_relief` returns.

        Raises
        ------
        ParameterError
            If the folder holds the water of another flood.
        DeviceError
            If it cannot be read or written.
        """
        facts = json.loads(json.dumps(_facts(options, extent)))  # numbers as JSON returns them
        try:
            before = json.loads((self._place / RECORD).read_bytes())
            if not isinstance(before, dict):
                raise ValueError("it is no object")
        except FileNotFoundError:
            if self.names:
                raise ParameterError(f"`keep` {self._path}: holds shapes of another server; {REMEDY}") from None
            return self._write_relief(facts, make_relief())
        except (OSError, ValueError) as error:
            raise self._damage_error(RECORD, error) from None
        for what, name in NAMED.items():
            if before.get(what) != facts[what]:
                there, here = (shorten_text(_format_fact(one), MOST_SHOWN) for one in (before.get(what), facts[what]))
                line = f"holds water of another flood: its {name} is {there}, here it is {here}; {REMEDY}"
                raise ParameterError(f"`keep` {self._path}: {line}")
        return self._read_relief()

    def _read_relief(self) -> Relief:
        try:
            with np.load(self._place / GROUND, allow_pickle=False) as kept:
                invented, known, still = kept["numbers"].tolist()
                return Relief(kept["heights"], bool(invented), known, still)
        except Exception as error:  # NumPy and zipfile raise any type of exception for a damaged file
            raise self._damage_error(GROUND, error) from None

    def _write_relief(self, facts: dict[str, Any], relief: Relief) -> Relief:
        out = BytesIO()
        np.savez(out, heights=relief.heights, numbers=np.array([relief.invented, relief.known, relief.still]))
        files = {self._place / GROUND: out.getvalue(), self._place / RECORD: json.dumps(facts).encode()}
        try:
            replace_files(files, durable=True)
        except OSError as error:
            raise DeviceError(f"`keep` {self._path}: cannot be written ({error.strerror}); {REMEDY}") from None
        return relief

    def _damage_error(self, name: str, error: Exception) -> DeviceError:
        return DeviceError(f"`keep` {self._place / name}: is damaged ({reason_of(error)}); {REMEDY}")


def _facts(options: FloodOptions, extent: Extent) -> dict[str, Any]:
    """Facts that distinguish the flood of a server from others."""
    frame = extent.frame
    if options.relief is not None:
        digest = hashlib.sha256(options.relief.read_bytes()).hexdigest()
        ground = f"the heights of {options.relief.name} ({digest[:8]})"
    elif extent.bed is not None and np.isfinite(extent.bed).any():
        ground = f"the bed of the data ({hashlib.sha256(extent.bed.tobytes()).hexdigest()[:8]})"
    else:
        ground = "invented"
    place = {"bounds": frame.bounds, "crs": frame.crs, "metres": frame.metres}
    return {**place, "hmin": options.hmin, "depths": options.depths, "ground": ground}


def _format_fact(value: Any) -> str:
    """Format a fact for a message."""
    return ",".join(f"{one:.10g}" for one in value) if isinstance(value, list) else str(value)
