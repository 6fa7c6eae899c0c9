"""The viewer's server, as its page and as strangers meet it."""

import asyncio
import base64
import json
import re
import unicodedata
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import suppress

import httpx
import pytest
from described import check_description
from loops import run
from server import SECONDS

from needed import NEEDS_GEO
from vexture.conversion.parameters import Parameters
from vexture.pages import page_routes
from vexture.pages.page_routes import DROPPED
from vexture.server import published as shelves
from vexture.server.limits import Limits
from vexture.server.routes import application
from vexture.texture.load import texture_from
from vexture.thesis.png import read_png
from viewing import PATIENCE, SHAPES, viewing

DUCK = (SHAPES / "duck.svg").read_bytes()


@pytest.fixture(scope="module")
def view(tmp_path_factory):
    folder = tmp_path_factory.mktemp("view")
    (folder / "more").mkdir()
    (folder / "more" / "duck.svg").write_bytes((SHAPES / "cake.svg").read_bytes())
    files = [SHAPES / "duck.svg", folder / "more" / "duck.svg", SHAPES / "hairline.svg"]
    with viewing(folder, *files) as running:
        yield running


def test_page_is_made_of_files_of_the_server_alone(view):
    page = view.get("")
    assert page.headers["content-type"].startswith("text/html")
    assert "default-src 'none'" in page.headers["content-security-policy"]
    assert json.loads(re.search(r'id="vexture-scene">(.*?)<', page.text)[1]) == {"server": "./"}
    for name in re.findall(r'(?:href|src)="(viewer[^"]*)"', page.text):
        file = view.get(name)
        assert file.status_code == 200
        assert len(file.content) > 1000
        again = view.get(name, headers={"If-None-Match": file.headers["etag"]})
        assert (again.status_code, again.content) == (304, b"")


def test_it_describes_itself(view):
    check_description(view.url, "view", DROPPED)


def test_files_of_one_name_are_told_apart(view):
    assert view.get("shapes").json()["shapes"] == ["duck", "duck-2", "hairline"]
    names = [root.name for name in ("duck", "duck-2") for root in packed_of(view, view.manifest(name)).roots]
    assert names[0].startswith("duck/1-#")
    assert names[-1].startswith("duck-2/")


def packed_of(view, manifest):
    return texture_from(view.get(manifest["texture"].removeprefix("../")).content, "answer")


def test_manifest_says_what_people_ask(view):
    manifest = view.manifest("duck")
    facts = manifest["facts"]
    assert facts["segments"] == 21
    assert facts["bytes"] == manifest["bytes"] == len(view.get(manifest["texture"].removeprefix("../")).content)
    assert 1e-7 <= facts["distance"] < 1.1e-7  # the precision of the deepest zoom
    assert facts["to_source"] == [240, 0, 0, 0, -240, 240]
    assert facts["milliseconds"] > 0
    assert view.get(manifest["views"]["svg"].removeprefix("../")).content == DUCK


@pytest.mark.parametrize("bits", [8, 16])
def test_thesis_encodings_are_made_when_they_are_asked_for(view, bits):
    quads, curves = (view.get(path.removeprefix("../")) for path in view.manifest("duck")["views"][f"thesis{bits}"])
    assert "immutable" in quads.headers["cache-control"]
    for file, width in ((quads, 4), (curves, 2)):
        pixels, texts = read_png(file.content, width, "answer")
        assert 8 * pixels.dtype.itemsize == bits
        assert texts["vexture.encoding"] == "thesis"


def test_thesis_encoding_that_does_not_fit_is_one_line(view):
    for path in view.manifest("hairline")["views"]["thesis8"]:
        answer = view.get(path.removeprefix("../"))
        assert answer.status_code == 422
        assert "the limit is 256" in answer.json()["error"]


@pytest.mark.parametrize("path", ["views/0/thesis8.quads.png", "views/{version}/thesis9.quads.png"])
def test_view_that_is_none_is_not_found(view, path):
    answer = view.get(path.format(version=view.manifest("duck")["version"]))
    assert answer.status_code == 404
    assert "no view" in answer.json()["error"]


def test_dropped_drawing_is_published_and_takes_no_name_of_others(view):
    before = view.manifest("duck")
    with view.events() as events:
        assert next(events)[0] == "hello"
        answer = view.post("duck.svg", (SHAPES / "thumb.svg").read_bytes())
        assert answer.status_code == 201
        kind, data = next(events)
    manifest = answer.json()
    assert (kind, data["name"]) == ("shape", manifest["name"])
    assert manifest["name"] not in ("duck", "duck-2", "hairline")
    assert httpx.get(httpx.URL(view.url).join(answer.headers["location"])).json() == manifest
    assert packed_of(view, manifest).roots[0].name.startswith(manifest["name"] + "/")
    assert view.manifest("duck") == before


def test_names_of_files_in_any_normal_form_are_found(view):
    """macOS writes the letters of names apart from their accents."""
    answer = view.post(unicodedata.normalize("NFD", "café.svg"), DUCK)
    assert answer.json()["name"] == "café"
    assert view.get(answer.headers["location"]).json() == answer.json()


@pytest.mark.parametrize(
    ("name", "content", "error"),
    [
        ("notes.txt", b"no drawing", "notes.txt: holds nothing that can be read"),
        ("empty.svg", b"", "empty.svg: is empty"),
        ("broken.ktx2", b"no texture", "broken.ktx2: begins with"),
        ("photo.png", b"\x89PNG", "photo.png"),
        pytest.param("map.geojson", b"{", "map.geojson", marks=NEEDS_GEO),
        ("", DUCK, "the name of the file must have"),
        ("a\nb.svg", DUCK, "the name of the file must have"),
    ],
)
def test_dropped_file_that_is_no_drawing_changes_nothing(view, name, content, error):
    before = view.get("shapes").json()
    answer = view.post(name, content)
    assert answer.status_code == 422
    line = answer.json()["error"]
    assert error in line
    assert "\n" not in line
    assert view.get("shapes").json() == before


@pytest.mark.parametrize(
    "headers", [{"Origin": "http://evil.example"}, {"Sec-Fetch-Site": "cross-site"}, {"Origin": "null"}]
)
def test_page_of_a_stranger_can_publish_nothing(view, headers):
    before = view.get("shapes").json()
    assert view.post("own.svg", DUCK, **headers).status_code == 403
    assert view.get("shapes").json() == before


def test_own_page_may_publish(view):
    origin = view.url.rstrip("/")
    answer = view.post("own.svg", DUCK, **{"Origin": origin, "Sec-Fetch-Site": "same-origin"})
    assert answer.status_code == 201


def test_name_of_a_stranger_reads_nothing(view):
    """A page can let its name stand for this machine; it is then of one origin with what answers to that name."""
    for path in ("", "shapes", "shapes/duck", "events"):
        answer = view.get(path, headers={"Host": "evil.example"})
        assert answer.status_code == 421
        assert "evil.example" in answer.json()["error"]
    assert "access-control-allow-origin" not in view.get("shapes", headers={"Origin": "http://evil.example"}).headers


def test_body_that_is_too_long_is_refused(view):
    def endless():
        for _ in range(DROPPED.max_bytes // 2**20 + 1):
            yield bytes(2**20)

    answer = view.post("long.svg", endless())
    assert answer.status_code == 413
    assert f"{DROPPED.max_bytes:,}" in answer.json()["error"]


@pytest.mark.slow
def test_dropped_files_have_a_queue(tmp_path):
    """Each took a thread of the server's, and any number at once its memory."""
    lines = "".join(f"M{997 * line // 1500} 0L{7919 * line % 997} 999" for line in range(1500))
    slow = f'<svg viewBox="0 0 999 999"><path stroke="red" d="{lines}"/></svg>'
    with viewing(tmp_path, SHAPES / "duck.svg") as running, ThreadPoolExecutor(DROPPED.conversions + 1) as pool:
        sent = [pool.submit(running.post, f"{name}.svg", slow) for name in range(DROPPED.conversions + 1)]
        done, _ = wait(sent, PATIENCE, FIRST_COMPLETED)
        answer = next(iter(done)).result()
        assert (answer.status_code, answer.headers["retry-after"]) == (503, "5")
        running.process.kill()
        for each in sent:
            with suppress(httpx.HTTPError):
                each.result()


def test_picture_of_the_browser_is_placed(tmp_path):
    """A wide drawing is centred in the unit square; the page puts the browser's own picture where it stands."""
    (tmp_path / "wide.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="400" height="100" viewBox="10 20 40 10">'
        '<path d="M10 20h9v9z"/></svg>'
    )
    (tmp_path / "unsized.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M30 30h60v60h-60z"/></svg>')
    with viewing(tmp_path, tmp_path / "wide.svg", tmp_path / "unsized.svg") as running:
        assert running.manifest("wide")["facts"]["box"] == pytest.approx([0, 0.375, 1, 0.625])
        assert running.manifest("unsized")["facts"]["box"] == pytest.approx([0, 0.25, 1, 0.75])  # 300 x 150


def test_data_addresses_hold_what_was_served():
    from vexture.pages.page import data_address
    from vexture.server.published import PublishedFile

    assert base64.b64decode(data_address(PublishedFile(DUCK, "image/svg+xml", ".svg")).partition(",")[2]) == DUCK


def test_a_dropped_file_that_does_not_arrive_is_refused(monkeypatch):
    monkeypatch.setattr(page_routes, "DROPPED", Limits(upload_seconds=0.01))
    app = application(page_routes.dropping_routes(shelves.PublishedShapes(), Parameters(), ()), page_routes.DROPPED)
    scope = {"type": "http", "method": "POST", "path": "/convert", "query_string": b"name=a.svg", "headers": []}
    answer = []

    async def nothing():
        await asyncio.Event().wait()

    async def told(message):
        answer.append(message)

    run(asyncio.wait_for(app(scope, nothing, told), SECONDS))
    assert answer[0]["status"] == 408
    assert "longer than 0.01 s" in json.loads(answer[1]["body"])["error"]
