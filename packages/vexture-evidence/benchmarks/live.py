"""Costs of a live server: from an upload to a hundred clients, a thousand clients that wait, and the upload itself.

Everything is real: `vexture serve` in a process of its own, clients on sockets of this machine in another.
"""

import argparse
import asyncio
import json
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from report import write_figures

TOKEN = "token-of-the-benchmark"
SERVE = [sys.executable, "-c", "from vexture.cli.main import main; main()", "serve"]
DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M2 2h6v{}h-6z"/></svg>'

GOALS = {"event_ms_p95": 100.0, "idle_rss_mb": 200.0}


class EventClient:
    """One connection that listens to the stream of changes."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self.reader, self.writer = reader, writer

    @classmethod
    async def connect(cls, port: int) -> "EventClient":
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(b"GET /events HTTP/1.1\r\nHost: 127.0.0.1\r\nAccept: text/event-stream\r\n\r\n")
        client = cls(reader, writer)
        await client.until(b"event: hello")
        await client.until(b"data: ")
        return client

    async def until(self, start: bytes) -> bytes:
        """Return the next line that starts with `start`."""
        while line := await self.reader.readline():
            if line.startswith(start):
                return line
        raise ConnectionError("the server closed a stream")

    async def version(self) -> tuple[str, float]:
        """Version in the next event of a shape, and the time of its arrival."""
        await self.until(b"event: shape")
        line = await self.until(b"data: ")
        return json.loads(line[len(b"data: ") :])["version"], time.perf_counter()


async def upload(port: int, name: str, body: bytes) -> dict[str, Any]:
    """Upload a drawing; return the answer."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    head = f"PUT /shapes/{name} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\nContent-Length: {len(body)}\r\n"
    writer.write(f"{head}Authorization: Bearer {TOKEN}\r\n\r\n".encode() + body)
    answer = await reader.read()
    writer.close()
    status = answer.split(b" ", 2)[1]
    if status not in (b"200", b"201"):
        raise ConnectionError(answer[-500:].decode())
    return json.loads(answer.partition(b"\r\n\r\n")[2])


def memory(process: int, field: str = "VmRSS") -> float:
    """Megabytes of a process."""
    for line in Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith(f"{field}:"):
            return int(line.split()[1]) / 1000
    return float("nan")


def percentile(values: list[float], part: float) -> float:
    """Value below which a part of the values is."""
    return sorted(values)[min(int(part * len(values)), len(values) - 1)]


async def events(port: int, clients: int, uploads: int) -> tuple[list[float], list[float], list[float]]:
    """Milliseconds of uploads; from an upload to each client; from the first client to each."""
    listening = [await EventClient.connect(port) for _ in range(clients)]
    answered, delays, spread = [], [], []
    for number in range(uploads):
        waiting = [asyncio.create_task(client.version()) for client in listening]
        await asyncio.sleep(0.05)
        start = time.perf_counter()
        published = await upload(port, "moving", DRAWING.format(1 + number % 7).encode() + b"\n" * number)
        answered.append(1000 * (time.perf_counter() - start))
        heard = await asyncio.gather(*waiting)
        if {version for version, _ in heard} != {published["version"]}:
            raise ConnectionError("a client received another version")
        first = min(moment for _, moment in heard)
        delays += [1000 * (moment - start) for _, moment in heard]
        spread += [1000 * (moment - first) for _, moment in heard]
    for client in listening:
        client.writer.close()
    return answered, delays, spread


async def idle_memory(port: int, process: int, clients: int) -> tuple[float, float]:
    """Megabytes of the server before and with clients that wait."""
    before = memory(process)
    listening = [await EventClient.connect(port) for _ in range(clients)]
    await asyncio.sleep(2.0)
    after = memory(process)
    for client in listening:
        client.writer.close()
    return before, after


def measure(arguments: argparse.Namespace) -> dict[str, Any]:
    """Start a server and measure it."""
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    with tempfile.TemporaryDirectory() as folder:
        token = Path(folder) / "token"
        token.write_text(TOKEN)
        command = [*SERVE, f"{folder}/shapes", "--port", "0", "--token-file", str(token), "--rate", "10000"]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            assert server.stdout is not None
            port = urlsplit(server.stdout.readline().rpartition(" at ")[2].strip()).port or 0
            asyncio.run(upload(port, "moving", DRAWING.format(9).encode()))  # from here on the converter is warm
            before, after = asyncio.run(idle_memory(port, server.pid, arguments.idle))
            answered, delays, spread = asyncio.run(events(port, arguments.clients, arguments.uploads))
        finally:
            server.terminate()
            server.wait()
    return {
        "clients": arguments.clients,
        "uploads": arguments.uploads,
        "put_ms_median": statistics.median(answered),
        "put_ms_p95": percentile(answered, 0.95),
        "put_to_event_ms_p95": percentile(delays, 0.95),
        "event_ms_median": statistics.median(spread),
        "event_ms_p95": percentile(spread, 0.95),
        "idle_clients": arguments.idle,
        "rss_mb": before,
        "idle_rss_mb": after,
        "idle_delta_mb": after - before,
    }


def main() -> None:
    """Measure, print a table, write JSON."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=100)
    parser.add_argument("--uploads", type=int, default=50)
    parser.add_argument("--idle", type=int, default=1000)
    parser.add_argument("--quick", action="store_true", help="fewer uploads: whether it works, not how fast")
    arguments = parser.parse_args()
    if arguments.quick:
        arguments.uploads = 5
    found = measure(arguments)
    write_figures("live", found, GOALS)


if __name__ == "__main__":
    main()
