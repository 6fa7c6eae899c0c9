"""`vexture/convert` in a page: its signals and time limits, and what a page's policy leads to."""

from collections.abc import Iterator
from typing import Any

import pytest
from convert_site import RED, Site, converted, open_folder, served_site, svg

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


@pytest.mark.parametrize("kind", READING)
def test_the_page_answers_while_a_drawing_is_read(page: Any, kind: str) -> None:
    value = page.evaluate(f"async () => watched(readSvg({READING[kind]}).then(() => ({{ roots: [] }})))")
    assert value["ms"] > 300
    assert value["ticks"] > value["ms"] / 200


@pytest.mark.parametrize("kind", READING)
def test_reading_stops_by_its_signal_and_its_time_limit(page: Any, kind: str) -> None:
    stopped, stages = page.evaluate(
        f"""async () => {{
          const text = {READING[kind]};
          const stop = new AbortController();
          const stages = [];
          const converting = convert(text, {{ signal: stop.signal, onProgress: ({{ stage }}) => stages.push(stage) }});
          setTimeout(() => stop.abort(new RangeError('no more')), 50);
          return [await outcome(converting), stages];
        }}"""
    )
    assert stopped["error"] == "RangeError: no more"
    assert stages == ["read"]
    value = page.evaluate(f"() => outcome(convert({READING[kind]}, {{ maxSeconds: 0.1, name: 'many' }}))")
    assert value["error"] == (
        "VextureError: many: reading takes longer than 0.1 s; give a larger `maxSeconds`, or a simpler drawing"
    )
    assert value["field"] == "maxSeconds"
    assert page.evaluate("document.querySelectorAll('iframe').length") == 0
    assert page.failures == []


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
