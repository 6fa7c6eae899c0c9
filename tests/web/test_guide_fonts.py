"""The guide to words and fonts, read to its end: text laid out in a browser is the text that Python draws."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import vexture
from chromium import bundle, serve_folder
from guides import Reader, blocks_of
from vexture.fonts.library import default_files

SIZE = (480, 120)
"""Of the guide's canvas in pixels, which shows eight ems, and half an em below the baseline."""

PAGE = '<link rel="icon" href="data:,"><body style="margin: 0"><script type="module" src="bundle.js"></script></body>'


LACKING = """
const warned = [];
console.warn = (line) => warned.push(line);
window.lacking = ['Zoë', '李\\n😀–', '李Z'].map((text) => textMesh(text, 0).count);
window.warned = warned;
"""
"""Characters that the guide's atlas lacks, in its last program."""


@pytest.mark.slow
def test_the_guide_to_fonts_does_what_it_says(tmp_path: Path, open_page: Callable[..., Any]) -> None:
    if not default_files():
        pytest.skip("the default font is not installed: pip install 'vexture[text]'")
    folder = tmp_path / "run"
    folder.mkdir()
    with Reader(folder) as reader:
        for block in blocks_of("fonts"):
            if "pip install" not in block.text:
                reader.take(block)
    (root,) = vexture.load(folder / "lines.ktx2").roots
    assert root.paint is not None
    assert root.paint.hex == "#0066cc"
    assert {file.name for file in folder.glob("*.ktx2")} == {
        f"{name}.ktx2" for name in ("word", "lines", "italic", "atlas")
    }
    with (folder / "text.js").open("a", encoding="utf-8") as program:
        program.write(LACKING)
    bundle(folder / "text.js", folder / "bundle.js")
    (folder / "index.html").write_text(PAGE, encoding="utf-8")
    with serve_folder(folder) as address:
        page = open_page(f"{address}/index.html", SIZE)
        page.wait_for_selector("canvas")
        shown = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("L")) / 255.0
        assert page.evaluate("lacking") == [3, 3, 2], "each is drawn as a box"
        assert [line.split()[3][0] for line in page.evaluate("warned")] == [*"Zë李😀–"], "each is named once"
    word = vexture.text("AVE WAVE, Bob", font=default_files()[-1])
    em = 1.0 / word.to_source[0, 0]
    left, baseline = -word.to_source[0, 2] * em, word.to_source[1, 2] * em
    view = vexture.window(left, baseline - 0.5 * em, 8.0 * em, 2.0 * em)
    expected = 1.0 - vexture.coverage(word, size=SIZE, view=view, renderer="exact")
    assert np.abs(shown - expected).mean() < 0.002
    assert np.mean(np.abs(shown - expected) > 40 / 255) < 0.005
