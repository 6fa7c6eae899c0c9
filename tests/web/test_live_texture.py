"""`LiveVectorTexture` in a real browser, which has the events that Node lacks."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from live_server import LiveServer, running

from chromium import WEB, bundle
from viewing import until

DUCK = (WEB / "test" / "fixtures" / "duck.ktx2").read_bytes()
BADGE = (WEB / "test" / "fixtures" / "badge.ktx2").read_bytes()

NEVER = 10_000_000
"""Milliseconds between two looks at the manifest: what changes before has come by an event."""

OFTEN = 50


@pytest.fixture(scope="module", params=["three", "three-floor"])
def files(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The page, with the newest and with the oldest three.js."""
    if not (WEB / "node_modules" / request.param).is_dir():
        pytest.skip("the packages of web/ are not installed (npm ci --prefix web)")
    script = tmp_path_factory.mktemp("live") / "page.js"
    bundle(Path(__file__).with_name("pages") / "live.js", script, request.param)
    page = b'<!doctype html><link rel="icon" href="data:,"><script type="module" src="page.js"></script>'
    return {"/": page, "/page.js": script.read_bytes()}


@pytest.fixture
def server(files: dict[str, bytes]) -> Iterator[LiveServer]:
    """A server with a duck."""
    with running(LiveServer(dict(files))) as started:
        started.publish("1", DUCK)
        yield started


def _opened(open_page: Callable[..., Any], server: LiveServer, interval: int, *, errors: bool = False) -> Any:
    """Page that follows the shape."""
    page = open_page(f"{server.url}/?manifest=/shapes/shape&interval={interval}", errors=errors)
    assert page.evaluate("live") == "duck"
    return page


def _await_stream(server: LiveServer) -> None:
    """Wait until the page listens."""
    until(lambda: len(server.streams) >= 1)


def _closed(server: LiveServer) -> bool:
    """Whether nobody listens any more: a server learns it when it writes."""
    server.tell("ping", {})
    return server.streams_closed > 0


def _events(page: Any) -> list[str]:
    return page.evaluate("events.map((text) => text.replace(/ http.*/, ''))")


def test_events_bring_updates_at_once(open_page: Callable[..., Any], server: LiveServer) -> None:
    page = _opened(open_page, server, NEVER)
    _await_stream(server)
    page.evaluate(
        "texture.addEventListener('change', () => { window.seen = texture.textures.texels.image.data.length })"
    )
    server.publish("2", BADGE)
    page.wait_for_function("texture.name === 'badge'")
    assert _events(page) == ["change"]
    assert page.evaluate("seen === texture.data.texels.length")
    server.tell("note", {"name": "shape", "message": "shape.svg: no drawing"})
    server.tell("note", {"name": "another", "message": "not for us"})
    server.tell("shape", {"name": "another", "version": "9"})
    page.wait_for_function("events.length === 2")
    assert _events(page)[1] == "note: shape.svg: no drawing"
    asked = [path for path, _ in server.requests if path.startswith("/shapes")]
    assert len(asked) == 2


def test_many_textures_share_one_stream(open_page: Callable[..., Any], server: LiveServer) -> None:
    page = _opened(open_page, server, NEVER)  # browsers open six connections to one server
    page.evaluate("(async () => { window.more = []; for (let i = 0; i < 9; i++) more.push(await follow()); })()")
    _await_stream(server)
    server.publish("2", BADGE)
    page.wait_for_function("[texture, ...more].every(({ name }) => name === 'badge')")
    assert len(server.streams) == 1
    page.evaluate("[texture, ...more.slice(0, 5)].forEach((one) => one.close())")
    server.publish("3", DUCK)
    page.wait_for_function("more.slice(5).every(({ name }) => name === 'duck')")
    assert page.evaluate("texture.name") == "badge"
    page.evaluate("more.forEach((one) => one.close())")
    until(lambda: _closed(server))


SEEN = """(seen) => {
  Object.defineProperty(document, 'hidden', { value: !seen, configurable: true });
  document.dispatchEvent(new Event('visibilitychange'));
}"""


def test_a_page_that_nobody_sees_takes_no_connection(open_page: Callable[..., Any], server: LiveServer) -> None:
    page = _opened(open_page, server, NEVER)
    _await_stream(server)
    page.evaluate(SEEN, False)  # Playwright shows all of its pages, so that this one has to be told
    until(lambda: _closed(server))
    server.publish("2", BADGE)
    page.wait_for_timeout(300)  # in which an event would have come
    assert page.evaluate("texture.name") == "duck"
    page.evaluate(SEEN, True)
    page.wait_for_function("texture.name === 'badge'")


def test_an_update_between_manifest_and_stream_is_not_missed(open_page: Callable[..., Any], server: LiveServer) -> None:
    server.has_events = False  # until the page has looked
    page = _opened(open_page, server, OFTEN, errors=True)
    server.version, server.files["/files/2.ktx2"] = "2", BADGE  # nobody is told
    server.has_events = True
    page.wait_for_function("texture.name === 'badge'")
    _await_stream(server)
    assert page.evaluate("texture.online")


def test_a_broken_update_leaves_the_last_good_one(open_page: Callable[..., Any], server: LiveServer) -> None:
    page = _opened(open_page, server, NEVER)
    _await_stream(server)
    server.publish("2", DUCK[:500])
    page.wait_for_function("events.length === 1")
    assert page.evaluate("events[0]").startswith(f"note: {server.url}/files/2.ktx2: bytes ")
    assert page.evaluate("[texture.name, texture.online, texture.manifest.version]") == ["duck", True, "1"]
    server.publish("3", BADGE)
    page.wait_for_function("texture.name === 'badge'")


def test_without_events_it_is_polled(open_page: Callable[..., Any], server: LiveServer) -> None:
    server.has_events = False
    page = _opened(open_page, server, OFTEN, errors=True)  # the browser reports the 404 of the stream
    server.publish("2", BADGE)
    page.wait_for_function("texture.name === 'badge'")
    assert _events(page) == ["change"]
    assert ("/events", 404) in server.requests
    until(lambda: ("/shapes/shape", 304) in server.requests)


def test_a_server_that_goes_and_comes_back(open_page: Callable[..., Any], files: dict[str, bytes]) -> None:
    with running(LiveServer(dict(files))) as first:
        first.publish("1", DUCK)
        page = _opened(open_page, first, NEVER, errors=True)
        _await_stream(first)
        port = first.server_port
        first.stop()
    page.wait_for_function("events.length === 1")
    assert _events(page) == ["offline:"]
    assert page.evaluate("[texture.name, texture.online]") == ["duck", False]
    with running(LiveServer(dict(files), port)) as second:
        second.publish("2", BADGE)
        page.wait_for_function("texture.online && texture.name === 'badge'")
        assert sorted(_events(page)) == ["change", "offline:", "online"]
        _await_stream(second)  # events come again
        second.publish("3", DUCK)
        page.wait_for_function("texture.name === 'duck'")


def test_close_ends_the_stream(open_page: Callable[..., Any], server: LiveServer) -> None:
    page = _opened(open_page, server, OFTEN)
    _await_stream(server)
    page.evaluate("texture.close()")
    until(lambda: server.streams_closed)
    before = len(server.requests)
    server.publish("2", BADGE)
    page.wait_for_timeout(10 * OFTEN)  # in which it would have asked
    assert (len(server.requests), len(server.streams)) == (before, 1)
    assert page.evaluate("[texture.name, events.length, texture.closed]") == ["duck", 0, True]
