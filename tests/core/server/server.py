"""A real `vexture serve` on a free port, and requests to it that say nothing but what they are told to say."""

import http.client
import json
import socket
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import urlsplit

COMMAND = [sys.executable, "-c", "from vexture.cli.main import main; main()"]
TOKEN = "a-token-of-more-than-16"
SECONDS = 120

SQUARE = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><path d="M2 2h6v%dh-6z"/></svg>'


def square(height=5):
    """An SVG that differs from others by its height."""
    return SQUARE % height


class Server:
    """A running process."""

    def __init__(self, folder, *options, token=True):
        secret = folder.parent / "token"
        secret.write_text(f"{TOKEN}\n")
        given = ["--token-file", str(secret)] if token else []
        self.start([*COMMAND, "serve", str(folder), "--port", "0", *given, *map(str, options)])

    def start(self, arguments):
        """Run a program whose first line ends in ``at URL``."""
        self.process = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.said = self.process.stdout.readline()
        if not self.said:
            raise RuntimeError(self.process.communicate()[1])
        self.url = self.said.rpartition(" at ")[2].strip()
        self.port = urlsplit(self.url).port

    def connect(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=SECONDS)

    def ask(self, method, path, body=None, headers=None):
        """Status, headers and content of an answer."""
        connection = self.connect()
        try:
            connection.request(method, path, body, headers or {})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def peer(self, sent=b"", receives=None):
        """A connection that sends some bytes, and perhaps takes few."""
        peer = socket.socket()
        if receives:
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receives)
        peer.settimeout(SECONDS)
        peer.connect(("127.0.0.1", self.port))
        peer.sendall(sent)
        return peer

    @property
    def megabytes(self):
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) / 1000

    @property
    def descriptors(self):
        return len(list(Path(f"/proc/{self.process.pid}/fd").iterdir()))

    def put(self, name, body, token=TOKEN):
        """Status and JSON of an upload."""
        status, _, content = self.ask("PUT", f"/shapes/{name}", body, {"Authorization": f"Bearer {token}"})
        return status, json.loads(content)

    def manifest(self, name):
        return json.loads(self.ask("GET", f"/shapes/{name}")[2])

    def wait_for(self, name):
        """Manifest of a shape that the server converts at its start."""
        for _ in range(10 * SECONDS):
            status, _, content = self.ask("GET", f"/shapes/{name}")
            if status == 200:
                return json.loads(content)
            time.sleep(0.1)
        raise TimeoutError(name)

    def stop(self):
        """End it as SIGTERM does; what it has said and its exit code."""
        self.process.terminate()
        said, errors = self.process.communicate(timeout=SECONDS)
        return self.process.returncode, said, errors


@contextmanager
def serving(folder, *options, token=True, kind=None):
    server = (kind or Server)(folder, *options, token=token)
    try:
        yield server
    finally:
        if server.process.poll() is None:
            server.process.kill()
        server.process.communicate()


class Stream:
    """Events of a server, one by one."""

    def __init__(self, server):
        self.connection = server.connect()
        self.connection.request("GET", "/events")
        self.answer = self.connection.getresponse()

    def close(self):
        self.answer.close()
        self.connection.close()

    def next(self):
        """Kind and data of the next event; None at the end of the stream."""
        kind = None
        while line := self.answer.readline():
            field, _, value = line.decode().rstrip("\r\n").partition(": ")
            if field == "event":
                kind = value
            elif field == "data":
                return kind, json.loads(value)
        return None
