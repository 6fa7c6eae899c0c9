"""The page of texts that several tests open: its script, its worker, a font, HarfBuzz and the kernels."""

import shutil
from importlib.util import find_spec
from pathlib import Path

from build_wasm import OUTPUT
from chromium import WEB, bundle

HARFBUZZ = WEB / "node_modules" / "harfbuzzjs" / "dist" / "harfbuzz.wasm"


def font() -> Path:
    """Noto Sans, a variable font, which `vexture.text` takes by default."""
    found = find_spec("fontpkg_noto_sans")
    assert found is not None, "the extra text is installed for tests"
    return Path(str(found.origin)).parent / "files" / "NotoSans[wdth,wght].ttf"


def fill_text_site(folder: Path) -> None:
    """Write the files of the page `text.html` into a folder."""
    bundle(Path(__file__).parent / "pages" / "text.js", folder / "text.js")
    bundle(WEB / "src" / "typeset" / "worker.js", folder / "worker.js")
    shutil.copy(HARFBUZZ, folder)
    shutil.copy(font(), folder / "font.ttf")
    for name in ("silhouettes", "maps", "strokes"):
        shutil.copy(OUTPUT / f"{name}.wasm", folder)
    icon = '<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><body>'
    (folder / "text.html").write_text(f'{icon}<script type="module" src="text.js"></script>', encoding="utf-8")
