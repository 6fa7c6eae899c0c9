"""Make web/fonts/noto-sans.woff: the font of texts in pages to which none is given.

It is Noto Sans (SIL Open Font License) in its regular face, with Latin, Greek and Cyrillic letters, and its licence is
beside it. Releases hold both files; the repository holds neither.
"""

import shutil
from importlib.util import find_spec
from pathlib import Path
from typing import Final

from fontTools.subset import Options, Subsetter
from fontTools.ttLib import TTFont
from fontTools.varLib.instancer import instantiateVariableFont

OUTPUT: Final = Path(__file__).parents[1] / "web" / "fonts"

RANGES: Final = (
    (0x20, 0x7E),  # Latin: basic, Latin-1 and Extended-A
    (0xA0, 0x17F),
    (0x218, 0x21B),
    (0x300, 0x304),  # accents
    (0x306, 0x308),
    (0x30A, 0x30C),
    (0x327, 0x328),
    (0x384, 0x3CE),  # Greek
    (0x400, 0x45F),  # Cyrillic
    (0x490, 0x491),
    (0x1E80, 0x1E85),
    (0x2010, 0x2026),  # punctuation and signs
    (0x2030, 0x203A),
    (0x20AC, 0x20BF),
    (0x2116, 0x2122),
    (0x2190, 0x2193),
    (0x2212, 0x2212),
    (0x2248, 0x2265),
)


def source() -> Path:
    """Return the folder of the package with Noto Sans."""
    found = find_spec("fontpkg_noto_sans")
    if found is None or found.origin is None:
        raise SystemExit("fontpkg-noto-sans is not installed; install vexture-evidence[wasm]")
    return Path(found.origin).parent


def main() -> None:
    """Write the font unless it is there and younger than this script and its source."""
    package = source()
    original, output = package / "files" / "NotoSans[wdth,wght].ttf", OUTPUT / "noto-sans.woff"
    if output.is_file() and output.stat().st_mtime > max(Path(__file__).stat().st_mtime, original.stat().st_mtime):
        return
    font = instantiateVariableFont(TTFont(original), {"wght": 400, "wdth": 100})
    features = ["ccmp", "kern", "liga", "locl", "mark", "mkmk"]
    options = Options(layout_features=features, hinting=False, notdef_outline=True, name_IDs=[0, 1, 2, 13, 14])
    subsetter = Subsetter(options)
    subsetter.populate(unicodes=[code for first, last in RANGES for code in range(first, last + 1)])
    subsetter.subset(font)
    font.flavor = "woff"
    OUTPUT.mkdir(parents=True, exist_ok=True)
    part = output.with_suffix(".part")
    font.save(part)
    part.replace(output)
    shutil.copy(package / "LICENSE", OUTPUT / "LICENSE")
    print(f"{output}: {output.stat().st_size} bytes", flush=True)


if __name__ == "__main__":
    main()
