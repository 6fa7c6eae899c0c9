"""Names of the thesis's pair of files."""

import os
from pathlib import Path

from vexture.texture.files import file_name, is_folder
from vexture.thesis.layout import CURVES_SUFFIX, QUADS_SUFFIX

__all__ = ["pair_of", "target_of"]


def pair_of(path: str | os.PathLike[str]) -> tuple[Path, Path]:
    """Both files of a pair, from either of them, their common stem, or that stem with ``.png``.

    Examples
    --------
    >>> [str(file) for file in pair_of("maps/delft.curves.png")]
    ['maps/delft.quads.png', 'maps/delft.curves.png']
    """
    given = Path(path)
    stem = given.name
    for suffix in (QUADS_SUFFIX, CURVES_SUFFIX, ".png"):
        if stem != suffix and stem.endswith(suffix):
            stem = stem.removesuffix(suffix)
            break
    return given.parent / (stem + QUADS_SUFFIX), given.parent / (stem + CURVES_SUFFIX)


def target_of(path: str | os.PathLike[str], name: str) -> tuple[Path, Path]:
    """Return the pair to write: named `name` in a folder, or as a stem says.

    A path is a folder if it exists as one or ends with a separator.

    Examples
    --------
    >>> [str(file) for file in target_of("maps/", "delft")]
    ['maps/delft.quads.png', 'maps/delft.curves.png']
    """
    if is_folder(path):
        stem = Path(path) / file_name(name)
        return stem.with_name(stem.name + QUADS_SUFFIX), stem.with_name(stem.name + CURVES_SUFFIX)
    return pair_of(path)
