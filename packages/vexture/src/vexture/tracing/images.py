"""Pixels of untrusted picture files: PNG, JPEG, WebP, GIF, BMP."""

import os
import warnings
from io import BytesIO
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import PICTURE_FORMATS, FileKind, kind_of, read_bytes, start_of
from vexture.base.errors import LimitError, SourceError, reason_of

if TYPE_CHECKING:
    from PIL import Image

MOST_PIXELS: Final = 50_000_000
"""Most pixels of a picture: a file of a few kilobytes can declare a huge size."""

TEXTS: Final = "vexture."
"""Prefix of the PNG keywords in images of the encoding thesis (FORMAT.md)."""

TEXTURE: Final = (
    "is an image of a texture of the encoding thesis, not a picture; convert the drawing that it was made from"
)


def pixels_of(source: str | os.PathLike[str] | bytes) -> NDArray[np.uint8]:
    """Pixels of a picture, or of the first one of an animation, as (height, width, 4) of sRGB and opacity.

    The EXIF orientation is applied. An image of a texture is refused.
    """
    content = source if isinstance(source, bytes) else read_bytes(source)
    if kind_of(start_of(content)) is not FileKind.PICTURE:
        raise SourceError("is no picture; give a PNG, JPEG, WebP, GIF or BMP")
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about sizes, which are checked here, and about damaged metadata
            with Image.open(BytesIO(content), formats=PICTURE_FORMATS) as picture:
                if any(isinstance(key, str) and key.startswith(TEXTS) for key in picture.info):
                    raise SourceError(TEXTURE)
                if picture.width * picture.height > MOST_PIXELS:
                    raise LimitError(
                        f"has {picture.width} x {picture.height} pixels; the limit is {MOST_PIXELS:,}; scale it down"
                    )
                return _upright(picture)
    except Image.DecompressionBombError:
        raise LimitError(f"has far more than {MOST_PIXELS:,} pixels, which is the limit; scale it down") from None
    except (OSError, SyntaxError, ValueError, EOFError, IndexError, TypeError, KeyError) as error:
        why = reason_of(error)
        if isinstance(error, UnidentifiedImageError):  # its text names an object in memory
            why = "its first bytes are those of a picture, and no more"
        raise SourceError(f"is a damaged picture ({why}); save it again") from None


def _upright(picture: "Image.Image") -> NDArray[np.uint8]:
    from PIL import Image, ImageOps

    picture.load()
    if picture.mode.startswith("I"):  # gray of 16 bits, which Pillow would clip
        gray = np.asarray(picture, np.int64)
        gray = np.clip(gray >> 8 if gray.max() > 255 else gray, 0, 255)
        picture = Image.fromarray(gray.astype(np.uint8))
    return np.asarray(ImageOps.exif_transpose(picture).convert("RGBA"), np.uint8)
