"""The time from the push of a newer extent to the viewers' pixels: a real page, and raw clients beside it.

Everything is real: `vexture flood --serve` in a process of its own; one page in Chromium; 49 clients on sockets that
listen to the stream of changes and then fetch manifest and texture, as the page does. The clock runs from just before
the upload's connection is opened to the last byte of a client's texture, or to the page's frame after the one whose
middle pixel has changed.
"""

import asyncio
import json
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final
from urllib.parse import urljoin, urlsplit

import numpy as np

from flood_reading import CRS, PLACE, VERTICES, geojson, island
from vexture.base.errors import DeviceError

VIEWERS: Final = 50
SIZE: Final = {"width": 900, "height": 600}
VEXTURE: Final = [sys.executable, "-c", "from vexture.cli.main import main; main(prog_name='vexture')"]
TOKEN: Final = "token-of-the-benchmark"
PATIENCE: Final = 30.0  # s
PAUSE: Final = 2.5
"""Seconds between two pushes."""

WATCHED: Final = """
() => {
  const { stage } = window.vexture.flood;
  const gl = stage.renderer.getContext();
  const pixel = new Uint8Array(4);
  window.seen = [];
  let last = null;
  stage.addEventListener('frame', () => {
    gl.readPixels(gl.drawingBufferWidth / 2, gl.drawingBufferHeight / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    const wet = pixel[0] > 127;
    if (wet === last) return;
    last = wet;
    requestAnimationFrame(() => { window.seen.push([wet, performance.timeOrigin + performance.now()]); });
  });
  vexture.flood.relief(0);
  vexture.flood.flat(true);
  vexture.flood.view('Plan', { fly: false });
  vexture.flood.freeze(0);
}
"""
"""Notes when the middle of the picture, white where it is wet, changes. The waves stand: frames that only they ask for
would keep a renderer in software busy all the time."""


def extents(count: int, seed: int) -> list[tuple[bytes, bool]]:
    """Extents of 20,000 vertices, and whether their middle is wet: alternately without and with a hole there."""
    ring = island(VERTICES, seed, CRS["GeoJSON"])
    x, y, across, up = PLACE[CRS["GeoJSON"]]
    found = []
    for number in range(count):
        size = 0.1 + 0.001 * number
        angles = np.linspace(2 * np.pi, 0, 33)
        hole = np.stack([x + size * across * np.cos(angles), y + size * up * np.sin(angles)], axis=1)
        moved = ring + np.array([0.0, 1e-6 * number])
        found.append((geojson(moved) if number % 2 == 0 else geojson(moved, hole), number % 2 == 0))
    return found


@contextmanager
def serving(folder: Path, extent: bytes) -> Iterator[str]:
    """Start a server that shows an extent, and yield its address."""
    first, token = folder / "first.geojson", folder / "token"
    first.write_bytes(extent)
    token.write_text(TOKEN)
    x, y, across, up = PLACE[CRS["GeoJSON"]]
    bounds = ",".join(f"{value:.6f}" for value in (x - across, y - up, x + across, y + up))
    command = [*VEXTURE, "flood", "--extent", str(first), f"--bounds={bounds}", "--serve"]
    command += ["--port", "0", "--token-file", str(token)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        for line in process.stdout:
            if found := re.search(r"http://[^\s/]+/?", line):
                yield found[0].rstrip("/") + "/"
                return
        raise DeviceError("`vexture flood --serve` does not start; the lines above say why")
    finally:
        process.terminate()
        process.wait()


class FloodViewer:
    """A viewer without a picture: it listens, then fetches what is new."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.host, self.port = urlsplit(address).hostname, urlsplit(address).port

    async def listen(self) -> None:
        """Connect to the stream of changes."""
        self.reader, self.writer = await asyncio.open_connection(self.host, self.port)
        head = f"GET /events HTTP/1.1\r\nHost: {self.host}:{self.port}\r\nAccept: text/event-stream\r\n\r\n"
        self.writer.write(head.encode())
        await self.until(b"event: hello")

    async def until(self, start: bytes) -> None:
        while line := await self.reader.readline():
            if line.startswith(start):
                return
        raise ConnectionError("the server closed a stream")

    async def get(self, address: str) -> bytes:
        """Content at an address."""
        reader, writer = await asyncio.open_connection(self.host, self.port)
        head = f"GET {urlsplit(address).path} HTTP/1.1\r\nHost: {self.host}:{self.port}\r\nConnection: close\r\n\r\n"
        writer.write(head.encode())
        answer = await reader.read()
        writer.close()
        head, _, body = answer.partition(b"\r\n\r\n")
        if not head.startswith(b"HTTP/1.1 200"):
            raise ConnectionError(head.decode())
        return body

    async def wait_for_texture(self) -> float:
        """Wait for the next texture; return the time of its arrival."""
        await self.until(b"event: shape")
        manifest = urljoin(self.address, "shapes/flood")
        facts = json.loads(await self.get(manifest))
        texture = await self.get(urljoin(manifest, facts["texture"]))
        if len(texture) != facts["bytes"]:
            raise ConnectionError("a texture is not whole")
        return time.time()


async def publish_extent(address: str, body: bytes) -> None:
    """Publish an extent."""
    host, port = urlsplit(address).hostname, urlsplit(address).port
    reader, writer = await asyncio.open_connection(host, port)
    head = f"PUT /shapes/flood HTTP/1.1\r\nHost: {host}:{port}\r\nConnection: close\r\nContent-Length: {len(body)}\r\n"
    head += f"Content-Type: application/geo+json\r\nAuthorization: Bearer {TOKEN}\r\n\r\n"
    writer.write(head.encode() + body)
    answer = await reader.read()
    writer.close()
    if answer.split(b" ", 2)[1] not in (b"200", b"201"):
        raise ConnectionError(answer[-500:].decode())


async def push_rounds(address: str, bodies: list[bytes]) -> list[tuple[float, list[float]]]:
    """Push extents; return the start of each push, and the milliseconds of all raw clients."""
    clients = [FloodViewer(address) for _ in range(VIEWERS - 1)]
    await asyncio.gather(*(client.listen() for client in clients))
    found = []
    for body in bodies:
        waiting = [asyncio.create_task(client.wait_for_texture()) for client in clients]
        await asyncio.sleep(PAUSE)
        start = time.time()
        await publish_extent(address, body)
        ends = await asyncio.wait_for(asyncio.gather(*waiting), PATIENCE)
        found.append((start, [1000 * (end - start) for end in ends]))
    await asyncio.sleep(PAUSE)
    for client in clients:
        client.writer.close()
    return found


def time_pushes(browser: Any, folder: Path, pushes: int, seed: int) -> tuple[list[float], list[float]]:
    """Measure the milliseconds of the raw clients, and those of the page."""
    bodies = extents(pushes + 3, seed)
    with serving(folder, bodies[0][0]) as address:
        page = browser.new_page(viewport=SIZE)
        page.goto(f"{address}?bare")
        page.evaluate("vexture.flood.ready")
        page.evaluate(WATCHED)
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(1) as thread:
            running = thread.submit(asyncio.run, push_rounds(address, [body for body, _ in bodies[1:]]))
            while not running.done():
                page.wait_for_timeout(100)
            found = running.result()
        page.wait_for_timeout(2000)
        seen = page.evaluate("window.seen")
        page.close()
    raw, pixels = [], []
    for (start, times), (_, wet) in list(zip(found, bodies[1:], strict=True))[2:]:  # the first include compilation
        raw += times
        moments = [moment for is_wet, moment in seen if is_wet == wet and moment > 1000 * start]
        if not moments:
            raise DeviceError("a push has not changed the page's pixels")
        pixels.append(min(moments) - 1000 * start)
    return raw, pixels
