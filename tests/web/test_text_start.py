"""How the worker of `vexture/text` starts in a page: with HarfBuzz from elsewhere, and once only if it cannot."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from text_site import HARFBUZZ, fill_text_site

from chromium import serve_folder
from guides import blocks_of


@pytest.fixture(scope="module")
def address(chromium: Any, made_once: Callable[..., Path]) -> Iterator[str]:
    def fill(folder: Path) -> None:
        fill_text_site(folder)
        (folder / "elsewhere").mkdir()
        (folder / "typeset").mkdir()
        shutil.copy(folder / "worker.js", folder / "typeset")
        shutil.move(folder / HARFBUZZ.name, folder / "elsewhere")
        for module in folder.glob("*s.wasm"):
            shutil.copy(module, folder / "elsewhere")

    with serve_folder(made_once("text_start", fill)) as url:
        yield url


@pytest.fixture
def page(address: str, open_page: Callable[..., Any]) -> Any:
    page = open_page(f"{address}/text.html", errors=True)
    page.wait_for_function("globalThis.drawn")
    return page


def test_harfbuzz_may_be_elsewhere_or_given_and_the_glyphs_of_the_page_are_set_once(page: Any) -> None:
    counts = page.evaluate("""async () => {
        const bytes = await (await fetch('elsewhere/harfbuzz.wasm')).arrayBuffer();
        const url = 'elsewhere/harfbuzz.wasm', counts = [];
        for (const harfbuzz of [url, new URL(url, document.baseURI), bytes]) {
            Glyphs.shared = makeGlyphs({ harfbuzz });
            const text = new Text({ font: 'font.ttf', text: 'four' });
            await text.sync();
            counts.push(text.geometry.instanceCount, text.glyphs === Glyphs.shared);
        }
        return counts;
    }""")
    assert counts == [4, True] * 3
    message = page.evaluate("() => { try { Glyphs.shared = {}; } catch (error) { return error.message; } }")
    assert message == 'the glyphs is of the class "Object"; give new Glyphs({ ... })'


def test_the_guide_s_addresses_are_taken(page: Any) -> None:
    (block,) = (block.text for block in blocks_of("text") if block.title == "addresses.js")
    program = block.partition("\n\n")[2].replace("https://cdn.example/", "elsewhere/")
    requests: list[str] = []
    page.on("request", lambda request: requests.append(request.url.rpartition("/elsewhere/")[2]))
    count = page.evaluate(
        f"""async () => {{
        {program}
        const text = new Text({{ font: 'font.ttf', text: 'four', strokeWidth: 0.1 }});
        await text.sync();
        return text.geometry.instanceCount;
    }}"""
    )
    assert count == 4
    assert {"harfbuzz.wasm", "silhouettes.wasm", "strokes.wasm"} <= set(requests)


BROKEN = {
    "no script": ("nothing.js", "the worker of texts does not run"),
    "no HarfBuzz": ("worker.js", "check that the page may load the module harfbuzzjs"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_worker_that_does_not_start_is_tried_once_and_named_once(page: Any, name: str) -> None:
    script, words = BROKEN[name]
    errors: list[str] = []
    page.on("console", lambda said: errors.append(said.text) if said.text.startswith("vexture:") else None)
    requests: list[str] = []
    page.on("request", lambda request: requests.append(request.url))
    found = page.evaluate(
        """async (script) => {
        let started = 0;
        const worker = () => (started++, new Worker(script, { type: 'module' }));
        const own = new Glyphs({ worker }), other = new Text({ glyphs: own, font: 'font.ttf', text: 'other' });
        const text = new Text({ glyphs: own, font: 'font.ttf' }), messages = new Set();
        for (let k = 0; k < 20; k++) {
            text.text = `${k}`;
            await text.sync().then(() => messages.add('shown'), (error) => messages.add(error.message));
        }
        await other.sync().catch((error) => messages.add(error.message));
        return { started, messages: [...messages] };
    }""",
        script,
    )
    assert found["started"] == 1
    (message,) = found["messages"]
    assert words in message
    assert len(errors) == 1
    tries = sum(url.endswith("harfbuzz.wasm") for url in requests)
    assert tries <= 3, "one start tries several ways of fetching, and there is one start"
