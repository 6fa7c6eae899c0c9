"""The guide to words and fonts, read to its end."""

from pathlib import Path

import pytest

import vexture
from guides import Reader, blocks_of
from vexture.fonts.library import default_files


@pytest.mark.slow
def test_the_guide_to_fonts_does_what_it_says(tmp_path: Path) -> None:
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
