"""Servers under clients that are hostile, broken or too many: real processes, real sockets."""

import asyncio
import json
import socket
import sys
import time
from contextlib import ExitStack, closing, suppress
from functools import partial
from pathlib import Path

import pytest
from loops import run
from server import SECONDS, TOKEN, Server, Stream, serving, square

from vexture.errors import DeviceError
from vexture.live import page_routes
from vexture.live import shelf as shelves
from vexture.live.converter import Converter
from vexture.live.limits import Limits
from vexture.live.listen import bind, listen
from vexture.live.routes import application
from vexture.pipeline import Parameters

PROGRAM = """
import json, resource, sys
from starlette.routing import Route
from vexture.live.limits import Limits
from vexture.live.listen import bind, listen, serve_until_stopped
from vexture.live.routes import application, routes
from vexture.live.shelf import TEXTURE_TYPE, File, Shape, Shelf

given = json.loads(sys.argv[1])
files, shapes, size = (given.pop(key) for key in ("files", "shapes", "size"))
resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))
shelf = Shelf()
for number in range(shapes):
    shelf.put(Shape(f"{number:0100}", File(bytes(size), TEXTURE_TYPE, ".ktx2")))
taken = bind("127.0.0.1", 0)
print("serving at", listen(taken), flush=True)
limits = Limits(**given)
app = application(routes(shelf), limits)
app.routes.append(Route("/fault", lambda request: 1 / 0))
serve_until_stopped(app, taken, shelf.close, limits)
"""

PATIENT = 600.0
SHORT = 1.0
"""Limits in seconds: one that no test reaches, and one for which a test waits."""


class Shelf(Server):
    """A server of shapes that takes no uploads."""

    def __init__(self, _folder, token=False, files=2000, shapes=1, size=1, **limits):
        patient = {"head_seconds": PATIENT, "stall_seconds": PATIENT}
        told = {"files": files, "shapes": shapes, "size": size, **patient, **limits}
        self.start([sys.executable, "-c", PROGRAM, json.dumps(told)])

    @property
    def megabytes(self):
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) / 1000

    @property
    def descriptors(self):
        return len(list(Path(f"/proc/{self.process.pid}/fd").iterdir()))

    def peer(self, sent=b"", receives=None):
        """A connection that sends some bytes, and perhaps takes few."""
        peer = socket.socket()
        if receives:
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receives)
        peer.settimeout(SECONDS)
        peer.connect(("127.0.0.1", self.port))
        peer.sendall(sent)
        return peer


def shelf(**given):
    return serving(None, kind=partial(Shelf, **given))


def rest(peer):
    """All that comes until the server closes."""
    parts = []
    while part := peer.recv(2**16):
        parts.append(part)
    return b"".join(parts)


def refused(answer):
    """Status of an answer that says in JSON and in one line why not."""
    head, _, body = answer.partition(b"\r\n\r\n")
    line = json.loads(body)["error"]
    assert "\n" not in line
    assert b"connection: close" in head.lower()
    return int(head.split()[1])


def test_connections_never_use_up_the_descriptors():
    with shelf(files=200) as server, ExitStack() as opened:
        peers = [opened.enter_context(closing(server.peer())) for _ in range(260)]
        answers = []
        for peer in reversed(peers[130:]):
            try:
                answers.append(rest(peer))
            except ConnectionResetError:
                answers.append(b"")
        told = list(filter(None, answers))
        assert told
        assert {refused(answer) for answer in told} == {503}
        peers[0].sendall(b"GET /shapes HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n")
        assert rest(peers[0]).startswith(b"HTTP/1.1 200")
        assert server.stop()[2] == ""


def test_a_free_place_is_taken_again():
    with shelf(connections=1) as server:
        with closing(server.peer()):
            status, _, content = server.ask("GET", "/shapes")
            assert (status, json.loads(content)["error"].split(",")[0]) == (503, "1 connections are open")
        for _ in range(10 * SECONDS):
            if server.ask("GET", "/shapes")[0] == 200:
                break
            time.sleep(0.1)
        else:
            pytest.fail("the place of a client that left stays taken")


def test_peers_that_do_not_ask_are_closed():
    whole = b"GET /shapes HTTP/1.1\r\nHost: a\r\n\r\n"
    with shelf(head_seconds=SHORT) as server, closing(Stream(server)) as stream:
        assert stream.next()[0] == "hello"
        with closing(server.peer()) as silent:
            assert rest(silent) == b""
        with closing(server.peer(whole[:20])) as half:
            assert refused(rest(half)) == 408
        with closing(server.peer(whole + whole[:20])) as second:
            answers = rest(second)
            assert answers.startswith(b"HTTP/1.1 200")
            assert refused(answers[answers.rindex(b"HTTP/1.1") :]) == 408
        stream.connection.sock.setblocking(False)
        with pytest.raises(BlockingIOError):  # nothing new, and no end
            stream.connection.sock.recv(1)


@pytest.mark.parametrize("head", [b"", b"GET /shapes HTTP/1.1\r\nHost: a\r\nContent-Length: 10000\r\n\r\n"])
def test_bytes_that_trickle_keep_no_connection_open(head):
    with shelf(head_seconds=SHORT) as server, closing(server.peer(head)) as peer:
        try:
            for _ in range(20 * SECONDS):
                peer.sendall(b"a")
                time.sleep(0.05)
        except OSError:
            return
        pytest.fail("the connection stays open")


def test_readers_that_never_read_cost_little_and_are_cut_off():
    size, readers = 9_000_000, 30
    with shelf(size=size, stall_seconds=SHORT) as server, ExitStack() as opened:
        path = server.manifest(f"{0:0100}")["texture"][2:]
        before, free = server.megabytes, server.descriptors
        ask = f"GET {path} HTTP/1.1\r\nHost: a\r\n\r\n".encode()
        peers = [opened.enter_context(closing(server.peer(ask, receives=4096))) for _ in range(readers)]
        most, came = 0.0, False
        for _ in range(100 * SECONDS):
            most = max(most, server.megabytes)
            held = server.descriptors
            came = came or held > free
            if came and held <= free:
                break
            time.sleep(0.01)
        else:
            pytest.fail("readers that do not read stay connected")
        assert most - before < readers * size / 10e6
        with suppress(ConnectionResetError):
            assert len(rest(peers[0])) < size
        assert server.ask("HEAD", path)[1]["Content-Length"] == str(size)
        assert len(server.ask("GET", path)[2]) == size
        assert server.stop()[2] == ""


def pipelined(server, count):
    """A peer with a small buffer that asks for a file many times, and then for no more."""
    path = server.manifest(f"{0:0100}")["texture"][2:]
    ask = f"GET {path} HTTP/1.1\r\nHost: a\r\n".encode()
    return server.peer((ask + b"\r\n") * (count - 1) + ask + b"Connection: close\r\n\r\n", receives=4096)


def test_answers_that_wait_to_be_read_count_as_no_silence():
    """Whether the last one is still being made, is whole in the buffers of the server, or has left it."""
    with shelf(size=60_000, head_seconds=SHORT) as server, ExitStack() as opened:
        counts = range(1, 90, 2)  # somewhere on the way the buffers of the system are full
        peers = [opened.enter_context(closing(pipelined(server, count))) for count in counts]
        time.sleep(3 * SHORT)
        assert [rest(peer).count(bytes(60_000)) for peer in peers] == list(counts)


def test_requests_that_wait_for_a_reader_keep_no_connection_open():
    with shelf(size=60_000, stall_seconds=SHORT) as server, closing(pipelined(server, 100)) as peer:
        time.sleep(3 * SHORT)
        with suppress(ConnectionResetError):
            assert rest(peer).count(b"HTTP/1.1 200") < 100


def test_a_slow_reader_is_served():
    with shelf(size=1_000_000, stall_seconds=2.0) as server:
        path = server.manifest(f"{0:0100}")["texture"][2:]
        with closing(server.peer(f"GET {path} HTTP/1.1\r\nHost: a\r\n\r\n".encode(), receives=4096)) as peer:
            received = 0
            while received < 1_000_000:
                part = peer.recv(2**14)
                assert part
                received += len(part)
                time.sleep(0.005)


def test_clients_that_do_not_read_the_first_event_hold_no_copy_of_it():
    clients = 60
    with shelf(shapes=3000) as server, ExitStack() as opened:
        with closing(Stream(server)) as stream:
            kind, told = stream.next()
            assert (kind, len(told["versions"])) == ("hello", 3000)
        before = server.megabytes
        ask = b"GET /events HTTP/1.1\r\nHost: a\r\n\r\n"
        peers = [opened.enter_context(closing(server.peer(ask, receives=4096))) for _ in range(clients)]
        assert {peer.recv(8) for peer in peers} == {b"HTTP/1.1"}
        assert server.megabytes - before < clients * len(json.dumps(told)) / 2e6


def test_a_length_that_is_said_twice_is_refused():
    request = (
        b"PUT /shapes/a HTTP/1.1\r\nHost: a\r\nContent-Length: 4\r\nTransfer-Encoding: chunked\r\n\r\n"
        b"0\r\n\r\nGET /shapes HTTP/1.1\r\nHost: a\r\n\r\n"
    )
    with shelf() as server, closing(server.peer(request)) as peer:
        assert refused(rest(peer)) == 400
        assert server.stop()[2] == ""


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"GET /shapes HTTP/1.1\r\nHost: a\r\n" + b"X: %s\r\n" % (b"y" * 1000) * 200 + b"\r\n", 431),
        (b"GET /shapes HTTP/1.1\r\nHost: a\r\nX: " + b"y" * 30_000 + b"\r\n\r\n", 431),
        (b"GET /" + b"y" * 200_000, 431),
        (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(500_000), 400),
        (b"GET /shapes HTTP/1.1\r\n\r\n" + b"y" * 500_000, 400),
    ],
)
def test_what_is_no_request_is_told_so_though_more_is_sent(sent, status):
    with shelf() as server:
        for _ in range(5):
            with closing(server.peer(sent)) as peer:
                assert refused(rest(peer)) == status
        assert server.stop()[2] == ""


def test_a_broken_body_breaks_only_its_own_request():
    head = b"PUT /shapes/a HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n"
    with serving(None, kind=Shelf) as server:
        with closing(server.peer(head + b"\r\nxyz\r\n")) as peer:
            assert refused(rest(peer)) in (400, 405)
        with closing(server.peer(head.replace(b"PUT /shapes/a", b"GET /events") + b"\r\n")) as peer:
            assert peer.recv(20).startswith(b"HTTP/1.1 200")
            peer.sendall(b"xyz\r\n")
            with suppress(ConnectionResetError):
                assert b"HTTP/1.1" not in rest(peer)
        assert server.ask("GET", "/shapes")[0] == 200
        assert server.stop()[2] == ""


def test_a_fault_fills_no_log():
    with shelf() as server:
        for _ in range(50):
            assert server.ask("GET", "/fault")[0] == 500
        errors = server.stop()[2]
        assert errors.count("Traceback") == errors.count("Exception in ASGI application") == 3


def test_clients_are_refused_until_all_is_ready():
    with bind("127.0.0.1", 0) as taken, socket.socket() as client, socket.socket() as other:
        where = taken.getsockname()
        with pytest.raises(ConnectionRefusedError):
            client.connect(where)
        with bind(*where) as second:
            listen(taken)
            other.connect(where)
            with pytest.raises(DeviceError, match=f"port {where[1]} on 127.0.0.1 cannot be used") as refusal:
                listen(second)
        assert "\n" not in str(refusal.value)


def test_a_dropped_file_that_does_not_arrive_is_refused(monkeypatch):
    monkeypatch.setattr(page_routes, "DROPPED", Limits(upload_seconds=0.01))
    app = application(page_routes.dropping_routes(shelves.Shelf(), Parameters(), ()), page_routes.DROPPED)
    scope = {"type": "http", "method": "POST", "path": "/convert", "query_string": b"name=a.svg", "headers": []}
    answer = []

    async def nothing():
        await asyncio.Event().wait()

    async def told(message):
        answer.append(message)

    run(asyncio.wait_for(app(scope, nothing, told), SECONDS))
    assert answer[0]["status"] == 408
    assert "longer than 0.01 s" in json.loads(answer[1]["body"])["error"]


def fan(lines):
    """A drawing of crossing strokes: 100 take half a second to convert, 1500 minutes."""
    path = "".join(f"M{997 * line // lines} 0L{7919 * line % 997} 999" for line in range(lines))
    return f'<svg viewBox="0 0 999 999"><path stroke="red" d="{path}"/></svg>'.encode()


def uploading(server, name, body):
    """Connection whose upload is on its way."""
    connection = server.connect()
    connection.request("PUT", f"/shapes/{name}", body, {"Authorization": f"Bearer {TOKEN}"})
    return connection


def test_a_slow_conversion_keeps_no_other_waiting(tmp_path):
    with serving(tmp_path / "shapes") as server:
        assert server.put("quick", square(1))[0] == 201  # it converts now
        with closing(uploading(server, "slow", fan(1500))) as slow:
            assert [server.put("quick", square(height))[0] for height in (2, 3)] == [200, 200]
            slow.sock.setblocking(False)
            with pytest.raises(BlockingIOError):  # no answer yet
                slow.sock.recv(1)
        assert server.stop()[0] == 0  # and with it the conversion


def test_of_uploads_of_one_name_the_last_stays(tmp_path):
    with serving(tmp_path / "shapes") as server:
        for connection in [uploading(server, name, fan(50)) for name in "xy"]:  # both processes start
            assert connection.getresponse().status == 201
            connection.close()
        with closing(uploading(server, "a", fan(100))) as first:
            last = server.put("a", square())[1]
            assert first.getresponse().status == 201
        assert server.manifest("a")["version"] == last["version"]


def test_a_conversion_that_is_ended_harms_no_other():
    async def both():
        converter = Converter(Limits())
        try:
            ended, other = (asyncio.create_task(converter.shape_of(fan(100), name)) for name in "ab")
            await asyncio.sleep(0)  # both are under way
            ended.cancel()
            return (await other).name
        finally:
            converter.close()

    assert run(both()) == "b"
