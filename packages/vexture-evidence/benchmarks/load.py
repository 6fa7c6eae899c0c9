"""A server under load: many streams of events and an update a second, beside peers that only cost.

    python packages/vexture-evidence/benchmarks/load.py [--flood] [--streams 1000] [--idle 500] [--stuck 100]
        [--seconds 300] [--quick]

Everything is real, as in `live.py`: `vexture serve`, or `vexture flood --serve`, whose updates are newer water. Idle
peers connect and send no request; stuck ones request 9 MB and never read. A peer that is cut off connects again.
"""

import argparse
import asyncio
import re
import resource
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from flood_reading import geojson
from live import DRAWING, SERVE, TOKEN, EventClient, memory, percentile, upload
from report import write_figures
from vexture.server.limits import Limits
from vexture_geo.flood.bundle import FLOOD

LARGE, TIMES = 9_000_000, 20
"""Bytes of a drawing that is not read, and how often it is requested: the script of a page is a tenth of it."""

SETTLING = 5.0
"""Seconds from the first connections to the first update, and from the last update to the end."""

GOALS = {"events_lost": 0.0, "put_to_event_ms_p99": 250.0, "growth_mb": 10.0}

Heard = dict[str, float]
"""Time at which a stream announced each version."""


async def listener(port: int, heard: Heard) -> None:
    """One stream of events, until it is cancelled; if the server ends it, what follows is lost."""
    client = await EventClient.connect(port)
    with suppress(ConnectionError):
        while True:
            version, moment = await client.version()
            heard[version] = moment


async def idle_peer(port: int) -> None:
    """A peer that sends no request."""
    while True:
        with suppress(OSError):
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            await reader.read()
            writer.close()
        await asyncio.sleep(0.1)


class LoadSetup(NamedTuple):
    """A server: its command, the shape that changes, its content each time, and a file that is not read."""

    command: list[str]
    name: str
    content: Callable[[int], bytes]
    path: str | None  # None: a drawing that is uploaded


def drawing(number: int) -> bytes:
    """A drawing unlike those of other numbers."""
    return DRAWING.format(1 + number % 7).encode() + b"\n" * number


def water(number: int) -> bytes:
    """A sea whose shore is elsewhere each time."""
    east = 0.02 + 1e-5 * number
    return geojson(np.array([(0, 0), (east, 0), (east, 0.04), (0, 0.04), (0, 0)]))


def load_setup(folder: Path, *, flood: bool) -> LoadSetup:
    """The server of drawings, or of a flood."""
    if not flood:
        return LoadSetup([*SERVE, f"{folder}/shapes"], "moving", drawing, None)
    extent = folder / "sea.geojson"
    extent.write_bytes(water(0))
    command = [*SERVE[:-1], "flood", "--serve", "--extent", str(extent), "--bounds", "0,0,0.06,0.04"]
    return LoadSetup(command, "flood", water, f"/{FLOOD.script}")


async def stuck_peer(port: int, path: str) -> None:
    """A peer that requests a path `TIMES` times, never reads, and connects again when it has been cut off."""
    loop = asyncio.get_running_loop()
    while True:
        with socket.socket() as peer, suppress(OSError):
            peer.setblocking(False)
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            await loop.sock_connect(peer, ("127.0.0.1", port))
            await loop.sock_sendall(peer, f"GET {path} HTTP/1.1\r\nHost: a\r\n\r\n".encode() * TIMES)
            await asyncio.sleep(Limits().stall_seconds + SETTLING)


async def upload_large_drawing(port: int) -> str:
    """Upload a large drawing; return its path."""
    large = await upload(port, "large", DRAWING.format(9).encode() + b"<!--" + b" " * LARGE + b"-->")
    return str(large["views"]["svg"].removeprefix(".."))


async def measure_load(port: int, process: int, setup: LoadSetup, arguments: argparse.Namespace) -> dict[str, Any]:
    """Measure a server under load."""
    path = setup.path or await upload_large_drawing(port)
    before = memory(process)
    heard: list[Heard] = [{} for _ in range(arguments.streams)]
    tasks = [asyncio.create_task(stuck_peer(port, path)) for _ in range(arguments.stuck)]
    tasks += [asyncio.create_task(idle_peer(port)) for _ in range(arguments.idle)]
    tasks += [asyncio.create_task(listener(port, one)) for one in heard]
    await asyncio.sleep(SETTLING)
    loaded, sent = memory(process), {}
    for second in range(arguments.seconds):
        start = time.perf_counter()
        sent[(await upload(port, setup.name, setup.content(1 + second)))["version"]] = start
        await asyncio.sleep(max(0.0, start + 1.0 - time.perf_counter()))
    await asyncio.sleep(SETTLING)
    after = memory(process)
    failed = [task for task in tasks if task.done()]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    firsts = {version: min((one[version] for one in heard if version in one), default=0.0) for version in sent}
    delays = [1000 * (one[version] - sent[version]) for one in heard for version in sent if version in one]
    spread = [1000 * (one[version] - firsts[version]) for one in heard for version in sent if version in one]
    return {
        "streams_ended": len(failed),
        "updates": len(sent),
        "events": len(sent) * len(heard),
        "events_lost": len(sent) * len(heard) - len(delays),
        "event_ms_p50": percentile(spread, 0.5),
        "event_ms_p99": percentile(spread, 0.99),
        "put_to_event_ms_p50": percentile(delays, 0.5),
        "put_to_event_ms_p99": percentile(delays, 0.99),
        "rss_mb": before,
        "loaded_rss_mb": loaded,
        "growth_mb": after - loaded,
    }


def measure(arguments: argparse.Namespace) -> dict[str, Any]:
    """Start a server and measure it."""
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    with tempfile.TemporaryDirectory() as folder:
        token = Path(folder) / "token"
        token.write_text(TOKEN)
        what = load_setup(Path(folder), flood=arguments.flood)
        command = [*what.command, "--port", "0", "--token-file", str(token)]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            assert server.stdout is not None
            port = int(re.search(r"http://[^/]*:(\d+)/", server.stdout.readline())[1])
            asyncio.run(upload(port, what.name, what.content(0)))  # from here on the converter is warm
            found = asyncio.run(measure_load(port, server.pid, what, arguments))
        finally:
            server.terminate()
            _, errors = server.communicate()
    log = [line for line in errors.splitlines() if "note: " not in line]  # notes are about what a flood shows
    return {"log_bytes": sum(map(len, log)), **found}


def main() -> None:
    """Measure, print a table, write JSON."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--streams", type=int, default=1000)
    parser.add_argument("--idle", type=int, default=500, help="peers that send no request")
    parser.add_argument("--stuck", type=int, default=100, help="peers that never read")
    parser.add_argument("--seconds", type=int, default=300, help="updates, one a second")
    parser.add_argument("--quick", action="store_true", help="a tenth of all: whether it works, not how well")
    parser.add_argument("--flood", action="store_true", help="load a flood's server instead of one of drawings")
    arguments = parser.parse_args()
    loads = {name: getattr(arguments, name) for name in ("streams", "idle", "stuck", "seconds")}
    if arguments.quick:
        loads = {name: max(value // 10, 1) for name, value in loads.items()}
    found = {**loads, **measure(argparse.Namespace(flood=arguments.flood, **loads))}
    write_figures("load_flood" if arguments.flood else "load", found, GOALS)


if __name__ == "__main__":
    main()
