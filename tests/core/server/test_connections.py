"""Servers under clients that are hostile, broken or too many: real processes, real sockets."""

import json
import sys
import time
from contextlib import ExitStack, closing, suppress
from functools import partial

import pytest
from attacks import NO_REQUESTS, refusal_status, rest
from server import SECONDS, Server, Stream, serving

PROGRAM = """
import json, resource, sys
from starlette.routing import Route
from vexture.server.limits import Limits
from vexture.server.listen import bind, listen, serve_until_stopped
from vexture.server.routes import application, routes
from vexture.server.published import TEXTURE_TYPE, PublishedFile, PublishedShape, PublishedShapes

given = json.loads(sys.argv[1])
files, shapes, size = (given.pop(key) for key in ("files", "shapes", "size"))
resource.setrlimit(resource.RLIMIT_NOFILE, (files, files))
shelf = PublishedShapes()
for number in range(shapes):
    shelf.add(PublishedShape(f"{number:0100}", PublishedFile(bytes(size), TEXTURE_TYPE, ".ktx2")))
taken = bind("127.0.0.1", 0)
print("serving at", listen(taken), flush=True)
limits = Limits(**given)
app = application(routes(shelf), limits)
app.routes.append(Route("/fault", lambda request: 1 / 0))
serve_until_stopped(app, taken, shelf.close, limits)
"""

SHORT = 1.0
PATIENT_LIMITS = {"head_seconds": 600.0, "stall_seconds": 600.0}
"""Limits in seconds: one for which a test waits, and those that no test reaches."""


class Shelf(Server):
    """A server of shapes that takes no uploads."""

    def __init__(self, _folder, token=False, files=2000, shapes=1, size=1, **limits):
        told = {"files": files, "shapes": shapes, "size": size, **PATIENT_LIMITS, **limits}
        self.start([sys.executable, "-c", PROGRAM, json.dumps(told)])

    @property
    def large(self):
        """Path of a file."""
        return self.manifest(f"{0:0100}")["texture"][2:]


def shelf(**given):
    return serving(None, kind=partial(Shelf, **given))


@pytest.fixture
def served():
    """Context of a server under limits that are given; `tests/geo` has the server of a flood in its place."""
    return shelf


def test_connections_never_use_up_the_descriptors(served):
    with served(files=200) as server, ExitStack() as opened:
        peers = [opened.enter_context(closing(server.peer())) for _ in range(260)]
        answers = []
        for peer in reversed(peers[130:]):
            try:
                answers.append(rest(peer))
            except ConnectionResetError:
                answers.append(b"")
        told = list(filter(None, answers))
        assert told
        assert {refusal_status(answer) for answer in told} == {503}
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


@pytest.mark.slow
def test_peers_that_do_not_ask_are_closed(served):
    whole = b"GET /shapes HTTP/1.1\r\nHost: a\r\n\r\n"
    with served(head_seconds=SHORT) as server, closing(Stream(server)) as stream:
        assert stream.next()[0] == "hello"
        with closing(server.peer()) as silent:
            assert rest(silent) == b""
        with closing(server.peer(whole[:20])) as half:
            assert refusal_status(rest(half)) == 408
        with closing(server.peer(whole + whole[:20])) as second:
            answers = rest(second)
            assert answers.startswith(b"HTTP/1.1 200")
            assert refusal_status(answers[answers.rindex(b"HTTP/1.1") :]) == 408
        stream.connection.sock.setblocking(False)
        with pytest.raises(BlockingIOError):  # nothing new, and no end
            stream.connection.sock.recv(1)
        assert server.stop()[2] == ""


@pytest.mark.parametrize("head", [b"", b"GET /shapes HTTP/1.1\r\nHost: a\r\nContent-Length: 10000\r\n\r\n"])
def test_bytes_that_trickle_keep_no_connection_open(served, head):
    with served(head_seconds=SHORT) as server, closing(server.peer(head)) as peer:
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
        path = server.large
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
    ask = f"GET {server.large} HTTP/1.1\r\nHost: a\r\n".encode()
    return server.peer((ask + b"\r\n") * (count - 1) + ask + b"Connection: close\r\n\r\n", receives=4096)


@pytest.mark.slow
def test_answers_that_wait_to_be_read_count_as_no_silence():
    """Whether the last one is still being made, is whole in the buffers of the server, or has left it."""
    with shelf(size=60_000, head_seconds=SHORT) as server, ExitStack() as opened:
        counts = range(1, 90, 2)  # somewhere on the way the buffers of the system are full
        peers = [opened.enter_context(closing(pipelined(server, count))) for count in counts]
        time.sleep(3 * SHORT)
        assert [rest(peer).count(bytes(60_000)) for peer in peers] == list(counts)


def test_requests_that_wait_for_a_reader_keep_no_connection_open(served):
    with served(size=60_000, stall_seconds=SHORT) as server, closing(pipelined(server, 100)) as peer:
        time.sleep(3 * SHORT)
        with suppress(ConnectionResetError):
            assert rest(peer).count(b"HTTP/1.1 200") < 100
        assert server.stop()[2] == ""


def test_a_slow_reader_is_served():
    with shelf(size=1_000_000, stall_seconds=2.0) as server:
        ask = f"GET {server.large} HTTP/1.1\r\nHost: a\r\n\r\n".encode()
        with closing(server.peer(ask, receives=4096)) as peer:
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


@pytest.mark.parametrize(("sent", "status"), NO_REQUESTS)
def test_what_is_no_request_is_told_so_though_more_is_sent(sent, status):
    with shelf() as server:
        for _ in range(5):
            with closing(server.peer(sent)) as peer:
                assert refusal_status(rest(peer)) == status
        assert server.stop()[2] == ""


def test_a_broken_body_breaks_only_its_own_request(served):
    head = b"PUT /shapes/a HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n"
    with served() as server:
        with closing(server.peer(head + b"\r\nxyz\r\n")) as peer:
            assert refusal_status(rest(peer)) in (400, 405)
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
