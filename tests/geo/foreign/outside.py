"""What no reader may touch: files in a folder where each opening is seen, and an address that counts who comes."""

import ctypes
import json
import os
import socket
import struct
import threading
import warnings
from pathlib import Path

import h5py
import numpy as np
import pyogrio
import rasterio
import shapely
from PIL import Image

from vexture.base.errors import EXPECTED

IN_OPEN = 0x20
EVENT = struct.Struct("iIII")

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect id="secret" width="9" height="9"/></svg>'
KML = """<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Style id="s"/><Placemark><name>secret</name><Point>
<coordinates>5,52</coordinates></Point></Placemark></Document></kml>"""
WKT = 'GEOGCS["secret",DATUM["a",SPHEROID["b",6378137,298]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]'
BOX = shapely.box(4.0, 52.0, 6.0, 53.0)


class Outside:
    """A folder of secrets, and a port of this machine; both tell what touches them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir()
        _fill(folder)
        self._system = ctypes.CDLL(None, use_errno=True)
        self._events = self._system.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        assert self._events >= 0
        assert self._system.inotify_add_watch(self._events, os.fsencode(folder), IN_OPEN) >= 0
        self._server = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self._server.getsockname()[1]}/secret"
        self._came: list[str] = []
        threading.Thread(target=self._listen, daemon=True).start()

    def __getitem__(self, name: str) -> str:
        return str(self.folder / name)

    def _listen(self) -> None:
        while True:
            try:
                peer, _ = self._server.accept()
            except OSError:  # closed
                return
            with peer:
                peer.settimeout(5.0)
                self._came.append(peer.recv(200).decode(errors="replace").partition("\r")[0])
                peer.sendall(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n")

    def take_accesses(self) -> list[str]:
        """Return what was opened or requested since the last call."""
        try:
            events = os.read(self._events, 1 << 20)
        except BlockingIOError:
            events = b""
        found, at = [], 0
        while at < len(events):
            *_, length = EVENT.unpack_from(events, at)
            found.append(events[at + EVENT.size : at + EVENT.size + length].rstrip(b"\0").decode())
            at += EVENT.size + length
        found += self._came
        self._came.clear()
        return found

    def close(self) -> None:
        self._server.close()
        os.close(self._events)


def message_of(work, *given, **options):
    """Message of a reader about a source: its error, or its notes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = work(*given, **options)
        except EXPECTED as error:
            return str(error)
    return "READ " + "; ".join(note.message for note in getattr(found, "notes", ()))


def one_line(text):
    assert text
    assert "\n" not in text
    return text


def _fill(folder: Path) -> None:
    """Files that readers would take, were they led to them."""
    (folder / "secret.bin").write_bytes(bytes([0] * 2000 + [9] * 2000))
    with h5py.File(folder / "secret.h5", "w") as file:
        file["d"] = np.repeat(np.arange(40)[:, None] > 20, 100, 1).astype("u1") * 9
    raster(folder / "secret.tif", np.ones((SIDE // 2, SIDE // 2), "float32"))
    pyogrio.raw.write(
        folder / "secret.geojson", shapely.to_wkb(np.array([BOX], object)), [np.array(["secret"], object)], ["name"],
        geometry_type="Polygon", crs="EPSG:4326", driver="GeoJSON",
    )  # fmt: skip
    (folder / "secret.csv").write_text("a,b\n1,2\n")
    (folder / "secret.init").write_text("<1> +proj=longlat +ellps=WGS84 <>\n")
    (folder / "secret.gsb").write_bytes(bytes(1000))
    (folder / "secret.wkt").write_text(WKT)
    (folder / "secret.svg").write_text(SVG)
    (folder / "secret.kml").write_text(KML)
    (folder / "secret.xsd").write_text('<schema xmlns="http://www.w3.org/2001/XMLSchema"/>')
    (folder / "secret.css").write_text("rect { fill: red }")
    (folder / "secret.dtd").write_text('<!ENTITY secret "secret">')
    (folder / "secret.json").write_text(json.dumps({"asset": {"version": "2.0"}}))
    Image.new("RGB", (8, 8), "red").save(folder / "secret.png")


SIDE = 2200
"""Cells of a side: above the limit, so that a reader takes an overview where there is one."""


def raster(
    path: Path, values: np.ndarray, *, placed: bool = True, tags: dict[str, dict[str, str]] | None = None
) -> Path:
    """A GeoTIFF, with metadata of several domains."""
    place = {"crs": "EPSG:28992", "transform": rasterio.Affine(10.0, 0.0, 0.0, 0.0, -10.0, 10.0 * SIDE)}
    with warnings.catch_warnings(action="ignore"), rasterio.open(
        path, "w", driver="GTiff", width=values.shape[1], height=values.shape[0], count=1, dtype=values.dtype,
        compress="deflate", tiled=True, **(place if placed else {"crs": "EPSG:28992"}),
    ) as file:  # fmt: skip
        file.write(values, 1)
        for domain, texts in (tags or {}).items():
            file.update_tags(ns=domain, **texts)
    return path
