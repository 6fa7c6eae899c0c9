"""A server that speaks the protocol of live shapes, in the hands of a test: a page, one shape, a stream of events."""

import http.server
import json
import queue
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class LiveServer(http.server.ThreadingHTTPServer):
    """One shape, named ``shape``; what it answers can be changed while it runs."""

    daemon_threads = True

    def __init__(self, files: dict[str, bytes], port: int = 0) -> None:
        self.files = files
        self.version = ""
        self.has_events = True
        self.requests: list[tuple[str, int]] = []
        self.streams: list[queue.Queue[str | None]] = []
        self.streams_closed = 0
        super().__init__(("127.0.0.1", port), _Handler)

    @property
    def url(self) -> str:
        """Its address, without a slash at its end."""
        return f"http://127.0.0.1:{self.server_port}"

    def publish(self, version: str, texture: bytes) -> None:
        """Put another texture in place and tell who listens."""
        self.files[f"/files/{version}.ktx2"] = texture
        self.version = version
        self.tell("shape", {"name": "shape", "version": version})

    def tell(self, kind: str, data: dict[str, Any]) -> None:
        """Send an event."""
        for stream in self.streams:
            stream.put(f"event: {kind}\ndata: {json.dumps(data)}\n\n")

    def stop(self) -> None:
        """Break all connections off."""
        for stream in self.streams:
            stream.put(None)
        self.shutdown()
        self.server_close()


class _Handler(http.server.BaseHTTPRequestHandler):
    server: LiveServer

    def do_GET(self) -> None:
        path = self.path.partition("?")[0]
        if path == "/events" and self.server.has_events:
            self._stream()
        elif path == "/shapes/shape":
            self._manifest()
        else:
            body = self.server.files.get(path)
            self._answer(404 if body is None else 200, body or b"", "text/html" if path == "/" else "text/javascript")

    def _answer(self, status: int, body: bytes, media_type: str, **headers: str) -> None:
        self.server.requests.append((self.path, status))
        self.send_response(status)
        for name, value in {"Content-Type": media_type, "Content-Length": str(len(body)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def _manifest(self) -> None:
        version = self.server.version
        if self.headers["If-None-Match"] == f'"{version}"':
            self._answer(304, b"", "application/json", ETag=f'"{version}"')
            return
        manifest = {"name": "shape", "version": version, "texture": f"../files/{version}.ktx2", "events": "../events"}
        body = json.dumps(manifest).encode()
        self._answer(200, body, "application/json", ETag=f'"{version}"')

    def _stream(self) -> None:
        stream: queue.Queue[str | None] = queue.Queue()
        stream.put(f"event: hello\ndata: {json.dumps({'versions': {'shape': self.server.version}})}\n\n")
        self.server.streams.append(stream)
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.end_headers()
        while True:
            try:
                text = stream.get(timeout=0.1)
            except queue.Empty:
                text = ": ping\n\n"
            if text is None:
                break
            try:
                self.wfile.write(text.encode())
            except OSError:
                break
        self.server.streams_closed += 1

    def log_message(self, *arguments: object) -> None:
        """Say nothing."""


@contextmanager
def running(server: LiveServer) -> Iterator[LiveServer]:
    """Serve in a thread; stopped at the end if the test has not done so."""
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05}, daemon=True)
    thread.start()
    try:
        yield server
    finally:
        if thread.is_alive():
            server.stop()
        thread.join()
