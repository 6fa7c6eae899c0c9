"""What a server of shapes bears: many streams of events and an update a second, beside peers that only cost.

    python evidence/benchmarks/load.py [--streams 1000] [--idle 500] [--stuck 100] [--seconds 300] [--quick]

Everything is real, as in `live.py`. Idle peers connect and never ask; stuck ones ask for a file of 9 MB and never read.
Whoever the server cuts off comes again.
"""

import argparse
import asyncio
import resource
import socket
import subprocess
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from live import DRAWING, SERVE, TOKEN, Client, memory, percentile, put
from report import write_figures
from vexture.live.limits import Limits

__all__ = ["main"]

LARGE = 9_000_000
SETTLING = 5.0
"""Seconds from the first connections to the first update, and from the last update to the end."""

GOALS = {"events_lost": 0.0, "put_to_event_ms_p99": 250.0, "growth_mb": 10.0}

Heard = dict[str, float]
"""When a stream has told of each version."""


async def listener(port: int, heard: Heard) -> None:
    """One stream of events, until it is cancelled; if the server ends it, what follows is lost."""
    client = await Client.connect(port)
    with suppress(ConnectionError):
        while True:
            version, moment = await client.version()
            heard[version] = moment


async def idle(port: int) -> None:
    """A peer that never asks."""
    while True:
        with suppress(OSError):
            reader, writer = await asyncio.open_connection("127.0.0.1", port)
            await reader.read()
            writer.close()
        await asyncio.sleep(0.1)


async def stuck(port: int, path: str) -> None:
    """A peer that never reads what it asks for, and asks again when it has been cut off."""
    loop = asyncio.get_running_loop()
    while True:
        with socket.socket() as peer, suppress(OSError):
            peer.setblocking(False)
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            await loop.sock_connect(peer, ("127.0.0.1", port))
            await loop.sock_sendall(peer, f"GET {path} HTTP/1.1\r\nHost: a\r\n\r\n".encode())
            await asyncio.sleep(Limits().stall_seconds + SETTLING)


async def strained(port: int, process: int, arguments: argparse.Namespace) -> dict[str, Any]:
    """Figures of a server under load."""
    large = await put(port, "large", DRAWING.format(9).encode() + b"<!--" + b" " * LARGE + b"-->")
    before = memory(process)
    heard: list[Heard] = [{} for _ in range(arguments.streams)]
    path = large["views"]["svg"].removeprefix("..")
    tasks = [asyncio.create_task(stuck(port, path)) for _ in range(arguments.stuck)]
    tasks += [asyncio.create_task(idle(port)) for _ in range(arguments.idle)]
    tasks += [asyncio.create_task(listener(port, one)) for one in heard]
    await asyncio.sleep(SETTLING)
    loaded, sent = memory(process), {}
    for second in range(arguments.seconds):
        start = time.perf_counter()
        body = DRAWING.format(1 + second % 7).encode() + b"\n" * second
        sent[(await put(port, "moving", body))["version"]] = start
        await asyncio.sleep(max(0.0, start + 1.0 - time.perf_counter()))
    await asyncio.sleep(SETTLING)
    after = memory(process)
    failed = [task for task in tasks if task.done()]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    firsts = {version: min((one[version] for one in heard if version in one), default=0.0) for version in sent}
    told = [1000 * (one[version] - sent[version]) for one in heard for version in sent if version in one]
    spread = [1000 * (one[version] - firsts[version]) for one in heard for version in sent if version in one]
    return {
        "streams_ended": len(failed),
        "updates": len(sent),
        "events": len(sent) * len(heard),
        "events_lost": len(sent) * len(heard) - len(told),
        "event_ms_p50": percentile(spread, 0.5),
        "event_ms_p99": percentile(spread, 0.99),
        "put_to_event_ms_p50": percentile(told, 0.5),
        "put_to_event_ms_p99": percentile(told, 0.99),
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
        command = [*SERVE, f"{folder}/shapes", "--port", "0", "--token-file", str(token)]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            assert server.stdout is not None
            port = urlsplit(server.stdout.readline().rpartition(" at ")[2].strip()).port or 0
            asyncio.run(put(port, "moving", DRAWING.format(8).encode()))  # from here on the converter is warm
            found = asyncio.run(strained(port, server.pid, arguments))
        finally:
            server.terminate()
            _, errors = server.communicate()
    return {"log_bytes": len(errors), **found}


def main() -> None:
    """Measure, print a table, write JSON."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--streams", type=int, default=1000)
    parser.add_argument("--idle", type=int, default=500, help="peers that never ask")
    parser.add_argument("--stuck", type=int, default=100, help="peers that never read")
    parser.add_argument("--seconds", type=int, default=300, help="updates, one a second")
    parser.add_argument("--quick", action="store_true", help="a tenth of all: whether it works, not how well")
    arguments = parser.parse_args()
    loads = {name: value for name, value in vars(arguments).items() if name != "quick"}
    if arguments.quick:
        loads = {name: max(value // 10, 1) for name, value in loads.items()}
    found = {**loads, **measure(argparse.Namespace(**loads))}
    write_figures("load", found, GOALS)


if __name__ == "__main__":
    main()
