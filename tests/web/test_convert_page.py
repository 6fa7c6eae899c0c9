"""`vexture/convert` in a page: every source, the worker, limits, and what a page's policy or a bad source leads to."""

import base64
import functools
import gzip
import http.server
import re
import shutil
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bad_sources import BAD

import vexture
from build_wasm import OUTPUT
from chromium import ROOT, WEB, bundle

PAGES = Path(__file__).parent / "pages"
DUCK = ROOT / "examples" / "shapes" / "duck.svg"
BADGE = WEB / "test" / "fixtures" / "badge.svg"
TRUSTED = "require-trusted-types-for 'script'"

POLICY = "default-src 'self'; style-src 'unsafe-inline'"
"""A policy without 'wasm-unsafe-eval'."""

POLICIES = {"strict": POLICY, "trusted": TRUSTED, "distrusted": f"{TRUSTED}; trusted-types other"}
"""Policies of the folders of the site."""

HEAD = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">'
SCRIPT = '<script type="module" src="page.js"></script>'
LOGO = '<div style="color: #00f"><svg id="logo" viewBox="0 0 9 9"><path fill="currentColor" d="M1 1h5v5z"/></svg></div>'

TOWNS = '{"type": "Polygon", "coordinates": [[[8, 47], [9, 47], [9, 48], [8, 47]]]}'
TOPOLOGY = (
    '{"type": "Topology", "arcs": [[[8, 47], [9, 47], [9, 48], [8, 47]]],'
    ' "objects": {"towns": {"type": "Polygon", "arcs": [[0]]}}}'
)


def svg(body: str, root: str = 'viewBox="0 0 9 9"') -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>'


RED = svg('<path fill="#f00" d="M1 1h5v5z"/>')


class Site:
    """Folder of a page, its address, and the paths that were requested of its server."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.address = folder, ""
        self.paths: list[str] = []

    def handler(self) -> Any:
        site = self

        class Handler(http.server.SimpleHTTPRequestHandler):
            extensions_map = {".js": "text/javascript", ".wasm": "application/wasm", "": "text/html"}  # noqa: RUF012

            def do_GET(self) -> None:
                site.paths.append(self.path)
                super().do_GET()

            def end_headers(self) -> None:
                self.send_header("Cache-Control", "no-store")
                folder = self.path.split("/")[1]
                if folder in POLICIES:
                    self.send_header("Content-Security-Policy", POLICIES[folder])
                super().end_headers()

            def log_message(self, *arguments: object) -> None:
                """Log nothing."""

        return functools.partial(Handler, directory=str(self.folder))


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    """A site whose bundles lie in folders: `strict` has a policy, `lost` has no worker, `bare` no WebAssembly."""
    if not all((OUTPUT / f"{name}.wasm").is_file() for name in ("silhouettes", "maps", "strokes")):
        pytest.skip("no kernels (make wasm)")
    folder = tmp_path_factory.mktemp("convert")
    shutil.copytree(OUTPUT, folder / "kernels")
    usual = folder / "usual"
    bundle(PAGES / "convert.js", usual / "page.js")
    bundle(WEB / "src" / "convert" / "worker.js", usual / "worker.js")
    (usual / "index.html").write_text(HEAD + LOGO + SCRIPT, encoding="utf-8")
    (usual / "red.svg").write_text(RED, encoding="utf-8")
    for name in ("strict", "trusted", "distrusted", "lost", "bare"):
        shutil.copytree(usual, folder / name)
    (folder / "lost" / "worker.js").unlink()
    (folder / "bare" / "index.html").write_text(f"{HEAD}<script>delete WebAssembly</script>{SCRIPT}", encoding="utf-8")
    one = Site(folder)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), one.handler())
    threading.Thread(target=server.serve_forever, daemon=True).start()
    one.address = f"http://127.0.0.1:{server.server_port}"
    yield one
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def page(chromium: Any, site: Site) -> Iterator[Any]:
    """The usual page, and in `urls` all that it requests."""
    with_context = chromium.new_context()
    opened = open_folder(with_context, site, "usual")
    yield opened
    with_context.close()


def open_folder(context: Any, site: Site, name: str) -> Any:
    opened = context.new_page()
    opened.urls, opened.failures = [], []
    opened.on("request", lambda request: opened.urls.append(request.url))
    opened.on("pageerror", lambda error: opened.failures.append(str(error)))
    opened.goto(f"{site.address}/{name}/")
    opened.wait_for_function("window.outcome")
    return opened


def converted(page: Any, source: str, options: str = "{}", value: Any = None) -> dict[str, Any]:
    """Outcome of converting a source, which is an expression; `value` is there as `text`."""
    found: dict[str, Any] = page.evaluate(f"async (text) => outcome(convert({source}, {options}))", value)
    return found


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


def test_what_is_left_out_is_noted(page: Any) -> None:
    blurred = svg('<rect width="4" height="4" filter="blur(1px)"/><path d="M5 5h2v2z" fill="red"/>')
    value = converted(page, "text", value=blurred)
    assert [(note["kind"], note["count"]) for note in value["notes"]] == [("left out", 1)]
    assert "blur" in value["notes"][0]["message"]


def test_the_page_answers_while_the_worker_converts(page: Any) -> None:
    value = page.evaluate("async () => { const d = await readSvg(heavy(60)); return watched(convert(d)); }")
    assert value["isTexture"]
    assert value["ms"] > 100
    assert value["ticks"] > value["ms"] / 40
    assert len(page.workers) == 1
    here = "convert(d, { converter: new Converter({ worker: false }) })"
    value = page.evaluate(f"async () => {{ const d = await readSvg(heavy(60)); return watched({here}); }}")
    assert value["isTexture"]
    assert value["ticks"] < value["ms"] / 40
    assert len(page.workers) == 1


def test_progress_is_told(page: Any) -> None:
    stages = page.evaluate(
        "async (text) => { const found = [];"
        " await convert(text, { onProgress: ({ stage }) => found.push(stage) }); return found; }",
        RED,
    )
    assert stages == ["read", "convert", "done"]


def test_a_signal_stops_a_conversion_with_its_reason(page: Any) -> None:
    before = converted(page, "text", "{ signal: AbortSignal.abort(new RangeError('no more')) }", RED)
    assert before["error"] == "RangeError: no more"
    loading = converted(page, "'red.svg'", "{ signal: AbortSignal.abort() }")
    assert loading["error"].startswith("AbortError: ")
    during = page.evaluate(
        """async () => {
          const drawing = await readSvg(heavy());
          const stop = new AbortController();
          setTimeout(() => stop.abort(new RangeError('no more')), 100);
          const other = new AbortController();
          const waiting = outcome(convert(drawing, { signal: other.signal }));
          const all = [outcome(convert(drawing, { signal: stop.signal })), outcome(convert('red.svg'))];
          other.abort('other');
          return Promise.all([waiting, ...all]);
        }"""
    )
    assert [one.get("error") for one in during] == ["undefined: other", "RangeError: no more", None]
    assert during[1]["ms"] < 1500
    assert during[2]["isTexture"]
    queued = page.evaluate(
        """async () => {
          const drawing = await readSvg(heavy());
          const [first, second] = [new AbortController(), new AbortController()];
          const running = outcome(convert(drawing, { signal: first.signal }));
          const waiting = outcome(convert(drawing, { signal: second.signal }));
          setTimeout(() => second.abort('second'), 50);
          const early = await waiting;
          first.abort('first');
          return [early, await running];
        }"""
    )
    assert [one["error"] for one in queued] == ["undefined: second", "undefined: first"]
    assert page.failures == []


def test_an_abort_while_a_body_is_read_has_its_reason(page: Any) -> None:
    value = page.evaluate(
        """async () => {
          const usual = window.fetch;
          const stop = new AbortController();
          window.fetch = async (url, { signal }) => new Response(new ReadableStream({
            start(controller) {
              controller.enqueue(new TextEncoder().encode('<svg'));
              signal.addEventListener('abort', () => controller.error(signal.reason));
            },
          }));
          setTimeout(() => stop.abort(new RangeError('no more')), 20);
          try {
            return await outcome(convert('slow.svg', { signal: stop.signal }));
          } finally {
            window.fetch = usual;
          }
        }"""
    )
    assert value["error"] == "RangeError: no more"


def test_what_takes_too_long_is_one_error(page: Any) -> None:
    for converter in ("undefined", "new Converter({ worker: false })"):
        value = page.evaluate(
            f"async () => outcome(convert(await readSvg(heavy(), {{ name: 'knot' }}), {{ maxSeconds: 0.05,"
            f" converter: {converter} }}))"
        )
        assert value["error"] == (
            "VextureError: knot: converting takes longer than 0.05 s; give a larger `maxSeconds`, or a simpler drawing"
        )
        assert value["field"] == "maxSeconds"
        assert value["ms"] < 4000
    assert converted(page, "text", value=RED)["isTexture"]
    for limit in ("Infinity", "1e9"):
        assert converted(page, "text", f"{{ maxSeconds: {limit} }}", RED).get("isTexture"), limit
    for limit in ("NaN", "-1", "'much'"):
        value = converted(page, "text", f"{{ maxSeconds: {limit} }}", RED)
        assert "is no number above 0; leave it out" in value["error"], limit


MANY = (
    '\'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{0}\' +'
    " '<path fill=\"#f00\" d=\"M1 1h5v5z\"/>'.repeat({2}) + '{1}</svg>'"
)
"""A drawing of many elements, as an expression of JavaScript: start, end, number."""

READING = {
    "paths": MANY.format("", "", 30_000),
    "pattern": MANY.format('<pattern id="p" width="3" height="3" patternUnits="userSpaceOnUse">', "</pattern>", 20_000)[
        :-7
    ]
    + '<rect width="9" height="9" fill="url(#p)"/></svg>\'',
    "measured": MANY.format(
        '<clipPath id="c"><path d="M0 0h4v4z"/></clipPath><g style="clip-path: inset(1px)">', "</g>", 20_000
    ),
    "image": '\'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><image width="9" height="9"'
    " href=\"data:image/svg+xml;base64,' + btoa(" + MANY.format("", "", 20_000) + ") + '\"/></svg>'",
}
"""Drawings that take a second or more to read, by where their elements are."""


@pytest.mark.parametrize("kind", READING)
def test_the_page_answers_while_a_drawing_is_read(page: Any, kind: str) -> None:
    value = page.evaluate(f"async () => watched(readSvg({READING[kind]}).then(() => ({{ roots: [] }})))")
    assert value["ms"] > 300
    assert value["ticks"] > value["ms"] / 200


@pytest.mark.parametrize("kind", READING)
def test_reading_stops_by_its_signal_and_its_time_limit(page: Any, kind: str) -> None:
    stopped = page.evaluate(
        f"""async () => {{
          const text = {READING[kind]};
          const stop = new AbortController();
          let asked;
          setTimeout(() => {{ asked = performance.now(); stop.abort(new RangeError('no more')); }}, 0);
          const found = await outcome(convert(text, {{ signal: stop.signal }}));
          return {{ ...found, late: performance.now() - asked }};
        }}"""
    )
    assert stopped["error"] == "RangeError: no more"
    assert stopped["late"] < 1000
    value = page.evaluate(f"() => outcome(convert({READING[kind]}, {{ maxSeconds: 0.1, name: 'many' }}))")
    assert value["error"] == (
        "VextureError: many: reading takes longer than 0.1 s; give a larger `maxSeconds`, or a simpler drawing"
    )
    assert value["field"] == "maxSeconds"
    assert page.evaluate("document.querySelectorAll('iframe').length") == 0
    assert page.failures == []


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


def test_a_page_that_requires_trusted_types_converts(chromium: Any, site: Site) -> None:
    context = chromium.new_context()
    try:
        opened = open_folder(context, site, "trusted")
        drawing = svg('<style>.a { fill: #0f0 }</style><path class="a" d="M1 1h5v5z"/>')
        for worker in (
            "false",
            "() => new Worker(trustedTypes.createPolicy('own', { createScriptURL: (url) => url })"
            ".createScriptURL('worker.js'), { type: 'module' })",
        ):
            value = converted(opened, "text", f"{{ converter: new Converter({{ worker: {worker} }}) }}", drawing)
            assert value.get("colors") == [[0, 1, 0]], value
        assert opened.failures == []
    finally:
        context.close()


@pytest.mark.parametrize(
    ("folder", "converter", "message"),
    [
        ("strict", "undefined", "allow it by the policy script-src 'wasm-unsafe-eval'"),
        ("strict", "new Converter({ worker: false })", "allow it by the policy script-src 'wasm-unsafe-eval'"),
        (
            "strict",
            "new Converter({ worker: () => new Worker(URL.createObjectURL(new Blob(['']))) })",
            "(worker-src), or convert with `worker: false`",
        ),
        ("lost", "undefined", "the worker of conversions does not run (it cannot be loaded); check the site's files"),
        (
            "lost",
            "new Converter({ worker: () => { throw new Error('no\\nworkers') } })",
            "the worker of conversions does not run (no workers); check the site's files",
        ),
        (
            "lost",
            "new Converter({ worker: false, kernels: { silhouettes: 'none.wasm' } })",
            "none.wasm: HTTP 404",
        ),
        ("lost", "new Converter({ worker: false, kernels: { silhouettes: 'red.svg' } })", "cannot be compiled"),
        (
            "trusted",
            "undefined",
            "the page requires Trusted Types: give a `worker` that starts it by a policy of the page",
        ),
        (
            "distrusted",
            "undefined",
            "allow the policy 'vexture' in its Content-Security-Policy (trusted-types vexture)",
        ),
        ("bare", "new Converter({ worker: false })", "this browser has no WebAssembly; convert the drawing with the"),
    ],
)
def test_what_a_page_lacks_is_one_error(chromium: Any, site: Site, folder: str, converter: str, message: str) -> None:
    context = chromium.new_context()
    try:
        opened = open_folder(context, site, folder)
        value = converted(opened, "text", f"{{ converter: {converter} }}", RED)
        assert value.get("error", "").startswith("VextureError: "), value
        assert message in value["error"]
        assert "\n" not in value["error"]
        assert opened.failures == []
    finally:
        context.close()
