"""Drawings of texts, in the same fonts everywhere."""

import warnings
from pathlib import Path
from typing import Any

from plainer_texts import ROOT

from same_fonts import FONTS
from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg


def read(path: Path, **options: Any) -> Drawing:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return read_svg(path, **{"fonts": [FONTS], **options})


def drawn(folder: Path, body: str, head: str = "", **options: Any) -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f"<svg {ROOT}>{head}{body}</svg>", encoding="utf-8")
    return read(file, **options)
