"""One name each for what both encodings can do: `load`, `encode`, `decode`, `info`."""

import os
from pathlib import Path

from vexture.encoding import layout
from vexture.encoding.files import pair_of
from vexture.encoding.ktx2 import MAGIC
from vexture.encoding.packed_texture import PackedTexture, load_packed
from vexture.encoding.texture import ThesisTexture, load_thesis
from vexture.errors import FormatError

__all__ = ["load"]


def load(path: str | os.PathLike[str]) -> ThesisTexture | PackedTexture:
    """Read a texture's file or pair of files.

    Parameters
    ----------
    path : path
        A packed texture's file, either file of a pair, or what their names have in common.

    Raises
    ------
    FormatError
        If a file is missing, damaged or not a texture, if the two of a pair do not belong together, or if the path
        means a packed texture as well as a pair.
    DeviceError
        If a file may not be read.
    """
    given = Path(path)
    if given.suffix.lower() == layout.PACKED_SUFFIX or _is_ktx2(given):
        return load_packed(given)
    packed_file = given.with_name(given.name + layout.PACKED_SUFFIX) if given.name else given
    if given.suffix.lower() != ".png" and packed_file.is_file():
        pair = pair_of(given)
        if pair[0].is_file() or pair[1].is_file():
            raise FormatError(f"{path} means {packed_file} as well as {pair[0]}; name one of them")
        return load_packed(packed_file)
    return load_thesis(given)


def _is_ktx2(path: Path) -> bool:
    """Whether there is such a file and it begins as KTX 2.0 does."""
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False
