"""Read a texture's file."""

import os
from pathlib import Path
from typing import Final, Literal, overload

from vexture.base import layout
from vexture.base.errors import FormatError
from vexture.texture.files import read_file
from vexture.texture.ktx2 import MAGIC, read_ktx2, read_value
from vexture.texture.registry import DEFAULT, REGISTERED, EncodedTexture, find_encoding, owner_of
from vexture.texture.root import read_roots
from vexture.texture.texture import Texture
from vexture.texture.walk import REMEDY

FOLD: Final = "fold"
"""Encoding of a file from `vexture fold`, which is not a texture of shapes."""

NOT_FOUND: Final = f"a texture is a file NAME{layout.PACKED_SUFFIX}; convert a drawing to make one"


@overload
def load(path: str | os.PathLike[str], *, encoding: Literal["packed"] = ...) -> Texture: ...


@overload
def load(path: str | os.PathLike[str], *, encoding: str) -> EncodedTexture: ...


def load(path: str | os.PathLike[str], *, encoding: str = DEFAULT) -> EncodedTexture:
    """Read a texture's file.

    Parameters
    ----------
    path : path
        The file; its suffix ``.ktx2`` may be left out.
    encoding : str
        ``"packed"``, or the name of a registered encoding; see `vexture.convert`.

    Returns
    -------
    Texture
        Validated: all its indices lie within it. Or the texture of another encoding.

    Raises
    ------
    FormatError
        If the file is missing, damaged or not a texture.
    DeviceError
        If the file cannot be read.
    ParameterError
        If there is no such encoding.
    TypeError
        If `path` is not a path.

    Examples
    --------
    >>> import tempfile
    >>> import vexture
    >>> kite = vexture.convert(vexture.Drawing.polygon([(0.5, 0.1), (0.8, 0.6), (0.5, 0.9), (0.2, 0.6)]))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     again = load(kite.save(Path(folder) / "kite.ktx2"))
    >>> bool((again.texels == kite.texels).all())
    True
    """
    if not isinstance(path, str | os.PathLike):
        raise TypeError(f"`path` is of the type {type(path).__name__}; give the path of a texture's file")
    if encoding != DEFAULT:
        return find_encoding(encoding).load(path)
    file = Path(path)
    if not file.is_file():
        named = file.with_name(file.name + layout.PACKED_SUFFIX) if file.name else file
        if named.is_file():
            file = named
        elif (other := owner_of(file)) is not None:
            raise FormatError(f"{path}: a texture in the encoding {other}; load it with `encoding`='{other}'")
    return texture_from(read_file(file, layout.PACKED_FILE_LIMIT, NOT_FOUND), str(file))


def load_any(path: str | os.PathLike[str]) -> EncodedTexture:
    """Read a texture in the encoding that its path implies. Errors as in `load`.

    A path that could name textures in two encodings is an error, too.
    """
    file = Path(path)
    other = None if _is_ktx2(file) else owner_of(file)
    packed = file.with_name(file.name + layout.PACKED_SUFFIX) if file.name else file
    if other is not None and packed.is_file() and not file.is_file():
        first = file.with_name(file.name + find_encoding(other).SUFFIXES[0])
        raise FormatError(f"{path} means {packed} as well as {first}; name one of them")
    if other is None and not file.is_file() and not packed.is_file():
        if file.is_dir():
            raise FormatError(f"{path}: is a folder; name a file in it")
        if file.suffix.lower() not in ("", layout.PACKED_SUFFIX):
            raise FormatError(f"{path}: not found; check the file's name")
        names = (", ".join(f"NAME{suffix}" for suffix in find_encoding(name).SUFFIXES) for name in REGISTERED)
        raise FormatError(f"{path}: not found; a texture is NAME{layout.PACKED_SUFFIX}, or {'; or '.join(names)}")
    return load(file, encoding=other or DEFAULT)


def _is_ktx2(path: Path) -> bool:
    """Return whether the file exists and begins with the KTX 2.0 identifier."""
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) == MAGIC
    except OSError:
        return False


def texture_from(data: bytes, source: str) -> Texture:
    """Read and validate the content of a texture's file.

    `source` is the name of the file, for messages and for a texture that has no name of its own.
    """
    if len(data) > layout.PACKED_FILE_LIMIT:
        raise FormatError(f"{source}: longer than {layout.PACKED_FILE_LIMIT} bytes, so not a texture; {REMEDY}")
    texels, texts = read_ktx2(data, source)
    try:
        if texts.get(layout.TEXT_ENCODING) == FOLD:
            raise FormatError("it is a fold, which three.js applies to the texture of a shape; give that texture here")
        for key, known in (
            (layout.TEXT_ENCODING, (layout.ENCODING_PACKED,)),
            (layout.TEXT_VERSION, (layout.PACKED_VERSION, layout.MAP_VERSION, layout.PICTURE_VERSION)),
        ):
            if texts.get(key) not in known:
                found, read = repr(texts.get(key))[:80], ", ".join(map(repr, known))
                raise FormatError(f"{key} is {found}; this program reads {read}; update it or {REMEDY}")
        name = texts.get(layout.TEXT_NAME) or Path(source).name.removesuffix(layout.PACKED_SUFFIX)
        roots = read_roots(texts.get(layout.TEXT_ROOTS, ""), read_value(data, layout.TEXT_STYLES))
        texture = Texture(texels, roots, name, texts.get(layout.TEXT_SOURCE))
        if texture.version != texts[layout.TEXT_VERSION]:
            raise FormatError(
                f"{layout.TEXT_VERSION} is {texts[layout.TEXT_VERSION]!r}, but with pictures it is "
                f"{layout.PICTURE_VERSION!r}, with maps {layout.MAP_VERSION!r} and without "
                f"{layout.PACKED_VERSION!r}; {REMEDY}"
            )
        texture.check()
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None
    return texture
