"""Shapes on disk: at any moment at which the machine may stop, each file is complete or absent."""

import asyncio
import fcntl
import json
from collections.abc import Callable
from contextlib import suppress
from glob import escape
from pathlib import Path
from typing import IO, Final

from vexture.base.content import SHAPEFILE
from vexture.base.errors import EXPECTED, DeviceError, LimitError
from vexture.conversion.reading import content_of
from vexture.server.converter import BusyError, Converter
from vexture.server.limited_shapes import LimitedShapes
from vexture.server.limits import Limits
from vexture.server.names import checked_name, manifest_name
from vexture.server.published import PublishedFile, PublishedShape
from vexture.texture.files import TEMPORARY, make_folder, replace_files

STATE: Final = ".vexture"
DRAWINGS: Final = (".svg", ".svgz", ".geojson", ".ktx2")
GEOGRAPHIC: Final = (".gpkg", ".fgb", ".shp", ".zip", ".tif", ".tiff", ".nc", ".nc4", ".cdf")
PICTURES: Final = (".png", ".jpg", ".jpeg", ".webp", ".gif", ".bmp")
TAKEN: Final = (DRAWINGS, GEOGRAPHIC, PICTURES)
"""Suffixes of files that are served; their content decides the reader. Of files with the same name, drawings win over
data, and data over pictures, which often show the drawing next to them."""

Report = Callable[[str], None]


class Folder(LimitedShapes):
    """The shapes of a folder.

    Published shapes are kept in ``.vexture`` inside it: ``files/DIGEST.ext``, named after their content, and a manifest
    ``shapes/DIGEST.json`` for each shape, named after its name. A manifest is written after the files that it names.
    Each file is written under a temporary name, flushed to the disk and then renamed. So the folder always holds the
    last complete state, and a shape that `publish` has returned from survives a crash.

    Drawings and textures that users put next to ``.vexture`` (all files that `vexture.read` accepts, and ``.ktx2``) are
    converted at each start (`take_drawings`) and served under their names, unless a shape of that name is published.
    These files are never changed. `report` gets a line for the user about each file that is damaged or not served.
    """

    def __init__(self, path: Path, limits: Limits, report: Report) -> None:
        super().__init__(limits)
        self._path, self._report = path, report
        self._shapes_folder, self._files_folder = path / STATE / "shapes", path / STATE / "files"
        self._kept: set[str] = set()  # names of files on disk whose content has been checked
        self._turn = asyncio.Lock()
        try:
            for folder in (self._shapes_folder, self._files_folder):
                make_folder(folder, durable=True)
            self._lock = _lock_file(path / STATE / "lock")
            self._load()
        except OSError as error:
            raise DeviceError(f"{path}: cannot be used ({error.strerror}); choose another folder") from None

    def release(self) -> None:
        """Release the folder for another server."""
        self._lock.close()

    async def publish(self, shape: PublishedShape) -> None:
        """Store a shape and notify all clients; on a disk error, raise a `DeviceError` and keep the previous shape."""
        async with self._turn:
            self.check_room(shape)
            fresh = [file for file in shape.files if file.name not in self._kept]
            before = self.shape(shape.name)
            try:
                await asyncio.to_thread(self._write, shape, fresh)
            except OSError as error:
                raise DeviceError(f"{shape.name}: cannot be kept ({error.strerror}); make room on the disk") from None
            self.add(shape)
            stale = [file.name for file in (before.files if before else ()) if not self.owners(file.name)]
            self._kept.update(file.name for file in fresh)
            self._kept.difference_update(stale)
            await asyncio.to_thread(self._remove, stale)

    async def withdraw(self, name: str) -> None:
        """Remove a shape from the disk and notify all clients; raise a `DeviceError` on a disk error."""
        async with self._turn:
            before = self.shape(name)
            if before is None:
                return
            try:
                await asyncio.to_thread((self._shapes_folder / manifest_name(name)).unlink, missing_ok=True)
            except OSError as error:
                raise DeviceError(f"{name}: cannot be removed ({error.strerror}); correct its permissions") from None
            self.remove(name)
            stale = [file.name for file in before.files if not self.owners(file.name)]
            self._kept.difference_update(stale)
            await asyncio.to_thread(self._remove, stale)

    @property
    def drawings(self) -> list[Path]:
        """Files that users have put into the folder, in reading order."""
        found = [path for path in sorted(self._path.iterdir()) if not path.name.startswith(".") and path.is_file()]
        return [path for suffixes in TAKEN for path in found if path.suffix.lower() in suffixes]

    async def take_drawings(self, converter: Converter) -> None:
        """Serve the files that users have put into the folder; raise a `BusyError` if the server stops."""
        for path in self.drawings:
            try:
                await self._take(path, converter)
            except BusyError:  # the server is stopping; the unread files are no errors
                raise
            except EXPECTED as error:
                self._report(f"{path.name} is not served: {error}")
            except OSError as error:
                self._report(f"{path.name} is not served: it cannot be read ({error.strerror}); check its permissions")

    async def _take(self, path: Path, converter: Converter) -> None:
        name = checked_name(path.stem)
        taken = f"{path.name} is not served: another shape {name!r} is; remove one of the two"
        if self.shape(name) is not None:
            self._report(taken)
            return
        self._check_links(path)
        with path.open("rb") as file:
            data = file.read(self._limits.max_bytes + 1)
        if len(data) > self._limits.max_bytes:
            raise LimitError(f"it is larger than {self._limits.max_bytes} bytes; raise `max_bytes`")
        if data.startswith(SHAPEFILE):
            data = content_of(path)
        shape = await converter.shape_of(data, name)
        async with self._turn:
            if self.shape(name) is not None:  # it was published during the conversion
                self._report(taken)
                return
            self.check_room(shape)
            self.add(shape)

    def _check_links(self, path: Path) -> None:
        """Refuse a path that is a symbolic link out of the folder, or has such a part."""
        root = self._path.resolve()
        for part in (path, *path.parent.glob(f"{escape(path.stem)}.*")):
            if part.is_symlink() and not part.resolve().is_relative_to(root):
                what = "it" if part == path else part.name
                raise LimitError(f"{what} is a link that leads out of the folder; put the file itself there")

    def _write(self, shape: PublishedShape, fresh: list[PublishedFile]) -> None:
        """Write the files of a shape, then the manifest that names them."""
        record = {
            "name": shape.name,
            "texture": _entry(shape.texture),
            "views": {what: _entry(file) for what, file in shape.views.items()},
            "facts": dict(shape.facts),
        }
        files = {self._files_folder / file.name: file.data for file in fresh}
        manifest = self._shapes_folder / manifest_name(shape.name)
        replace_files({**files, manifest: json.dumps(record).encode()}, durable=True)

    def _remove(self, names: list[str]) -> None:
        for name in names:
            with suppress(OSError):
                (self._files_folder / name).unlink()

    def _load(self) -> None:
        """Read all shapes, and remove leftover files of a crash."""
        whole = True
        for path in sorted(self._shapes_folder.iterdir()):
            if path.name.endswith(TEMPORARY):
                path.unlink()
                continue
            try:
                self.add(self._read(path))
            except (OSError, ValueError, KeyError, TypeError, AttributeError, LimitError, RecursionError) as error:
                whole = False
                self._report(f"{path}: damaged ({_reason(error)}); the others are served; publish its shape again")
        self._kept.update(file.name for name in self.names for file in self._shapes[name].files)
        for path in self._files_folder.iterdir():
            # a damaged manifest may be repaired by hand, and needs the files that it names
            if path.name.endswith(TEMPORARY) or (whole and not self.owners(path.name)):
                path.unlink()

    def _read(self, path: Path) -> PublishedShape:
        record = json.loads(path.read_bytes())
        name = checked_name(record["name"])
        if path.name != manifest_name(name):
            raise ValueError(f"it names the shape {name!r}, which is kept elsewhere")
        views = {str(what): self._file(entry) for what, entry in record["views"].items()}
        return PublishedShape(name, self._file(record["texture"]), dict(record["facts"]), views)

    def _file(self, entry: dict[str, str]) -> PublishedFile:
        name, media_type = entry["file"], entry["type"]
        if Path(name).name != name:
            raise ValueError(f"{name!r} is no name of a file")
        file = PublishedFile((self._files_folder / name).read_bytes(), media_type, "".join(Path(name).suffixes))
        if file.name != name:
            raise ValueError(f"{name} is not what was written")
        return file


def _entry(file: PublishedFile) -> dict[str, str]:
    return {"file": file.name, "type": file.media_type}


def _reason(error: Exception) -> str:
    """Describe in a few words why a manifest cannot be read."""
    if isinstance(error, OSError):
        return f"{Path(error.filename or '').name}: {error.strerror}"
    return f"it has no {error}" if isinstance(error, KeyError) else " ".join(str(error).split())[:200]


def _lock_file(path: Path) -> IO[bytes]:
    """Open a file that only one process can lock at a time."""
    file = path.open("ab")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        file.close()
        raise DeviceError(f"{path.parent.parent}: another server has this folder; stop it or choose another") from None
    return file
