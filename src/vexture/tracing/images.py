"""Pictures of pixels from files that a stranger may have written: PNG, JPEG, WebP, GIF, BMP."""

import os
import warnings
from io import BytesIO
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture.content import PNG, FileKind, kind_of, read_bytes, start_of
from vexture.errors import LimitError, SourceError

if TYPE_CHECKING:
    from PIL import Image

__all__ = ["MOST_PIXELS", "is_texture_image", "pixels_of"]

MOST_PIXELS: Final = 50_000_000
"""Of a picture; a file of a few kilobytes can say that it is endless."""

FORMATS: Final = ("PNG", "JPEG", "WEBP", "GIF", "BMP")

TEXTS: Final = "vexture."
"""How keywords begin of the texts that the program writes into the images of the encoding thesis (FORMAT.md)."""

TEXTURE: Final = (
    "is an image of a texture of the encoding thesis, not a picture; convert the drawing that it was made from"
)


def is_texture_image(path: str | os.PathLike[str]) -> bool:
    """Whether a file is an image of a texture of the encoding thesis, by the texts in it.

    Examples
    --------
    >>> is_texture_image("nothing.png")
    False
    """
    if not start_of(path).startswith(PNG):
        return False
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of its size, which does not matter here
            with Image.open(path, formats=("PNG",)) as picture:
                return _is_texture(picture)
    except (Image.DecompressionBombError, OSError, SyntaxError, ValueError):
        return False


def _is_texture(picture: "Image.Image") -> bool:
    return any(isinstance(key, str) and key.startswith(TEXTS) for key in picture.info)


def pixels_of(source: str | os.PathLike[str] | bytes) -> NDArray[np.uint8]:
    """Pixels of a picture, upright, of an animation its first; sRGB and opacity.

    Parameters
    ----------
    source : path or bytes
        The file, or its content.

    Returns
    -------
    (height, width, 4) uint8 array

    Raises
    ------
    SourceError
        If it is no picture, damaged, or an image of a texture.
    LimitError
        If it has more than `MOST_PIXELS` pixels.
    """
    content = source if isinstance(source, bytes) else read_bytes(source)
    if kind_of(start_of(content)) is not FileKind.PICTURE:
        raise SourceError("is no picture; give a PNG, JPEG, WebP, GIF or BMP")
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of sizes, which are checked here, and of damage beside the pixels
            with Image.open(BytesIO(content), formats=FORMATS) as picture:
                if _is_texture(picture):
                    raise SourceError(TEXTURE)
                if picture.width * picture.height > MOST_PIXELS:
                    raise LimitError(
                        f"has {picture.width} x {picture.height} pixels; the limit is {MOST_PIXELS:,}; scale it down"
                    )
                return _upright(picture)
    except Image.DecompressionBombError:
        raise LimitError(f"has far more than {MOST_PIXELS:,} pixels, which is the limit; scale it down") from None
    except (OSError, SyntaxError, ValueError, EOFError, IndexError, TypeError, KeyError) as error:
        why = " ".join(str(error).split())[:100] or type(error).__name__
        if isinstance(error, UnidentifiedImageError):  # which names an object in memory
            why = "its first bytes are those of a picture, and no more"
        raise SourceError(f"is a damaged picture ({why}); save it again") from None


def _upright(picture: "Image.Image") -> NDArray[np.uint8]:
    from PIL import ImageOps

    picture.load()
    if picture.mode.startswith("I"):  # gray of 16 bits, which Pillow would clip
        gray = np.asarray(picture, np.int64)
        picture = _gray(np.clip(gray >> 8 if gray.max() > 255 else gray, 0, 255))
    upright = ImageOps.exif_transpose(picture)
    return np.asarray(upright.convert("RGBA"), np.uint8)


def _gray(values: NDArray[Any]) -> "Image.Image":
    from PIL import Image

    return Image.fromarray(values.astype(np.uint8))
