"""`vexture/convert` in a page: every source, and what a bad source leads to."""

import base64
import gzip
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bad_sources import BAD
from convert_site import RED, Site, converted, open_folder, served_site, svg
from svg_pictures import SVG as PICTURED
from svg_pictures import file_of, link_of

import vexture
from chromium import ROOT, WEB

DUCK = ROOT / "examples" / "shapes" / "duck.svg"
BADGE = WEB / "test" / "fixtures" / "badge.svg"

TOWNS = '{"type": "Polygon", "coordinates": [[[8, 47], [9, 47], [9, 48], [8, 47]]]}'
TOPOLOGY = (
    '{"type": "Topology", "arcs": [[[8, 47], [9, 47], [9, 48], [8, 47]]],'
    ' "objects": {"towns": {"type": "Polygon", "arcs": [[0]]}}}'
)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    with served_site(tmp_path_factory.mktemp("convert")) as one:
        yield one


@pytest.fixture(scope="module")
def page(chromium: Any, site: Site) -> Iterator[Any]:
    """The usual page."""
    context = chromium.new_context()
    yield open_folder(context, site, "usual")
    context.close()


def test_every_source_is_a_texture(page: Any, site: Site) -> None:
    packed = base64.b64encode(gzip.compress(RED.encode())).decode()
    (site.folder / "usual" / "red.svgz").write_bytes(gzip.compress(RED.encode()))
    bytes_of = f"Uint8Array.from(atob('{packed}'), (c) => c.charCodeAt(0))"
    sources = {
        "text": ("drawing", RED),
        "'red.svg'": ("red", None),
        "new URL('red.svg?1#a', document.baseURI)": ("red", None),
        "'red.svgz'": ("red", None),
        "new URL('data:image/svg+xml,' + encodeURIComponent(text))": ("drawing", RED),
        "URL.createObjectURL(new Blob([text]))": ("drawing", RED),
        "new File([text], 'my.logo.svg')": ("my.logo", RED),
        "new File([text], 'a b.svg')": ("a b", RED),
        "new Blob([text])": ("drawing", RED),
        "new TextEncoder().encode(text)": ("drawing", RED),
        bytes_of: ("drawing", None),
        f"new File([{bytes_of}], 'red.svg.gz')": ("red", None),
        f"{bytes_of}.buffer": ("drawing", None),
        "fetch('red.svg').then((answer) => answer)": ("drawing", None),
        "readSvg(text, { name: 'own' })": ("own", RED),
    }
    for source, (name, text) in sources.items():
        value = converted(page, f"await {source}", value=text)
        assert value == {
            "isTexture": True,
            "roots": [{"name": name, "isMap": False}],
            "colors": [[1, 0, 0]],
            "notes": [],
            "ms": value.get("ms"),
        }, source
    assert converted(page, "document.querySelector('#logo')")["colors"] == [[0, 0, 1]]
    assert page.failures == []


def test_maps_are_textures(page: Any) -> None:
    sources = ("text", "JSON.parse(text)", "new File([text], 'towns.geojson')", "readGeojson(text)")
    for text in (TOWNS, TOPOLOGY):
        for source in sources:
            value = converted(page, f"await {source}", value=text)
            assert value.get("isTexture"), (source, value)
            assert len(value["roots"]) == 1
    named = converted(page, "new File([text], 'towns.geojson')", value=TOWNS)
    assert named["roots"][0]["name"] == "towns"
    assert converted(page, "text", "{ name: 'other' }", TOWNS)["roots"][0]["name"] == "other"


@pytest.mark.parametrize("file", [DUCK, BADGE], ids=["silhouette", "faces"])
def test_the_file_of_a_page_holds_the_texture_of_python(page: Any, tmp_path: Path, file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    content = page.evaluate("([text, name]) => fileOf(text, { name })", [text, file.stem])
    (tmp_path / f"{file.stem}.ktx2").write_bytes(base64.b64decode(content))
    ours, theirs = vexture.convert(file), vexture.load(tmp_path / f"{file.stem}.ktx2")
    theirs.check()
    assert [(root.name, root.is_map) for root in theirs.roots] == [(root.name, root.is_map) for root in ours.roots]
    assert np.array_equal(ours.flat, theirs.flat)
    for one, other in zip(ours.roots, theirs.roots, strict=True):
        assert (one.quad, one.tolerance, one.paint) == (other.quad, other.tolerance, other.paint)
        assert np.array_equal(one.to_source, other.to_source)


def test_pictures_are_in_the_texture_as_python_has_them(page: Any, tmp_path: Path) -> None:
    noise = file_of(np.random.default_rng(5).integers(0, 256, (45, 61, 3)).astype(np.uint8))
    text = PICTURED.format(f'<image href="{link_of(noise)}" x="10" y="20" width="61" height="45"/>')
    bytes_of = f"Uint8Array.from(atob('{base64.b64encode(noise).decode()}'), (c) => c.charCodeAt(0))"
    for source, ours in (("text", text.encode()), (f"new File([{bytes_of}], 'noise.png')", noise)):
        content = page.evaluate(f"async (text) => fileOf({source}, {{}})", text)
        (tmp_path / "pictures.ktx2").write_bytes(base64.b64decode(content))
        theirs = vexture.load(tmp_path / "pictures.ktx2")
        theirs.check()
        assert np.array_equal(vexture.convert(vexture.read(ours)).flat, theirs.flat), source


def test_what_is_left_out_is_noted(page: Any) -> None:
    blurred = svg('<rect width="4" height="4" filter="blur(1px)"/><path d="M5 5h2v2z" fill="red"/>')
    value = converted(page, "text", value=blurred)
    assert [(note["kind"], note["count"]) for note in value["notes"]] == [("left out", 1)]
    assert "blur" in value["notes"][0]["message"]


def test_progress_is_told(page: Any) -> None:
    stages = page.evaluate(
        "async (text) => { const found = [];"
        " await convert(text, { onProgress: ({ stage }) => found.push(stage) }); return found; }",
        RED,
    )
    assert stages == ["read", "convert", "done"]


def test_a_bad_source_is_one_error_and_the_page_goes_on(page: Any) -> None:
    wrong = {}
    for source, message in BAD.items():
        value = converted(page, source)
        error = value.get("error", "")
        if not re.search(message, error) or not error.startswith("VextureError: ") or "\n" in error or len(error) > 400:
            wrong[source] = value
    assert wrong == {}
    assert page.failures == []
    assert converted(page, "text", value=RED)["isTexture"]


def test_a_wrong_option_is_one_error(page: Any) -> None:
    for options, message in {
        "{ presision: 1 }": "`presision` is no option of a conversion; there are name, split",
        "{ precision: 'much' }": '`precision` "much" is no number in ',
        "{ precision: '0.01' }": '`precision` "0.01" is no number in ',
        "{ tolerance: '0.01' }": '`tolerance` "0.01" is no number from 0',
        "{ names: 'class' }": '`names` "class" of an SVG needs the Python program',
        "{ maxSeconds: '9' }": '`maxSeconds` "9" is no number above 0',
        "{ split: 'colour' }": "colour",
        "{ maxDepth: 1.5 }": "`maxDepth` 1.5 is no whole number in 1..20",
        "{ split: () => 1 }": "cannot be sent to the worker",
    }.items():
        value = converted(page, "text", options, RED)
        assert value["error"].startswith("VextureError: "), options
        assert message in value["error"], (options, value)
    assert converted(page, "text", value=RED)["isTexture"]


def test_hostile_drawings_fetch_nothing_and_run_nothing(page: Any, site: Site) -> None:
    url = f"{site.address}/hostile/"
    body = (
        f'<style>@import "{url}1"; path {{ cursor: url({url}2), auto }}</style>'
        f'<image href="{url}3" width="9" height="9"/>'
        f'<use href="{url}4#a"/><script>top.ran = 1</script><script href="{url}5"/><path d="M1 1h5v5z" onclick="x()"/>'
        f'<foreignObject width="9" height="9"><h:img xmlns:h="http://www.w3.org/1999/xhtml" src="{url}6"'
        ' onerror="top.ran = 1"/></foreignObject>'
    )
    site.paths.clear()
    page.urls.clear()
    value = converted(page, "text", value=svg(body, 'viewBox="0 0 9 9" onload="top.ran = 1"'))
    assert value["isTexture"]
    messages = " ".join(note["message"] for note in value["notes"])
    for word in ("script", "image", "foreignObject", "use"):
        assert word in messages, (word, messages)
    page.wait_for_timeout(200)
    assert [path for path in site.paths if "hostile" in path] == []
    assert page.evaluate("window.ran") is None


def test_a_page_requests_only_its_own_files(page: Any, site: Site) -> None:
    """After all that the tests before have converted."""
    page.reload()
    page.wait_for_function("window.outcome")
    site.paths.clear()
    page.urls.clear()
    assert converted(page, "text", value=svg('<path stroke="red" d="M1 1h5v5z"/><path fill="blue" d="M3 3h4v4z"/>'))[
        "isTexture"
    ]
    assert {*site.paths} == {"/usual/worker.js", "/kernels/strokes.wasm", "/kernels/maps.wasm"}
    assert all(url.startswith((site.address, "data:", "blob:", "about:")) for url in page.urls)
