"""Font parameters: files, and folders of font files."""

import os
from pathlib import Path

from vexture.base.errors import ParameterError, SourceError

NO_FILE = "it is no file; give a font file or a folder of fonts"


def font_places(value: object, name: str) -> tuple[Path, ...]:
    """Return the paths of the parameter `name`, which is one path or several.

    Raise a `ParameterError` if they are not paths, and a `SourceError` if one does not exist, even if it is not needed.

    Examples
    --------
    >>> font_places("nowhere.ttf", "fonts")
    Traceback (most recent call last):
    vexture.base.errors.SourceError: nowhere.ttf: it is no file; give a font file or a folder of fonts
    """
    several = [value] if isinstance(value, str | os.PathLike) else value
    places = [*several] if isinstance(several, list | tuple | set | frozenset) else [several]
    found = list[Path]()
    for place in places:
        if not isinstance(place, str | os.PathLike) or not isinstance(os.fspath(place), str):
            raise ParameterError(f"`{name}` is {value!r:.80}; it must be paths of font files or folders of fonts")
        found.append(Path(place))
    for path in found:
        if not path.exists():
            raise SourceError(f"{path}: {NO_FILE}")
    return tuple(found)
