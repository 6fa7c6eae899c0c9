"""The same fonts for vexture and resvg, so that their pictures of texts do not differ because of fonts."""

from functools import cache
from pathlib import Path
from typing import Final

import matplotlib
import resvg
from fontTools.ttLib import TTFont

from vexture.fonts.library import default_files

FONTS: Final = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
"""Fonts with Latin, Greek, Arabic and Hebrew letters; our fixtures ask for no others."""

FACES: Final = ("DejaVuSans", "DejaVuSans-Bold", "DejaVuSans-Oblique", "DejaVuSans-BoldOblique")

STOOD_FOR: Final = ("Times New Roman", "Arial", "Courier New", "Comic Sans MS", "Impact")
"""Families that resvg takes for the generic ones; the first also for each that is missing, as vexture takes the first
that it is given."""

NO_FONT: Final = "LastResort"
"""Begin of the name of a font whose characters are boxes, which resvg prefers to others."""

FAMILY_NAMES: Final = (1, 16)
"""Name records of a family (OpenType, name)."""


def gather(folder: Path) -> Path:
    """Fill a folder with the fonts for both: first copies of one for all generic families, then `FONTS`."""
    for rank, family in enumerate(STOOD_FOR):
        for face in FACES:
            with TTFont(FONTS / f"{face}.ttf", lazy=True, recalcTimestamp=False) as font:
                for record in font["name"].names:
                    if record.nameID in FAMILY_NAMES:
                        record.string = family
                font.save(folder / f"{rank}-{face}.ttf")
    for file in FONTS.glob("*.ttf"):
        if not file.name.startswith(NO_FONT):
            (folder / file.name).symlink_to(file)
    return folder


def only_these(folder: Path) -> Path:
    """A file for the environment variable FONTCONFIG_FILE, by which the system has the fonts of a folder only."""
    file = folder / "fonts.conf"
    file.write_text(f"<fontconfig><dir>{folder}</dir><cachedir>{folder}</cachedir></fontconfig>")
    return file


@cache
def options_of_resvg(folder: Path) -> resvg.usvg.Options:
    """Options of resvg with the fonts of a folder, and the default font of vexture."""
    options = resvg.usvg.Options.default()
    options.load_fonts_dir(str(folder))
    for file in default_files():
        options.load_font_file(str(file))
    return options
