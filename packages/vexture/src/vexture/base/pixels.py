"""Pixels of a picture's file: decoded, upright, in sRGB."""

import os
import warnings
from io import BytesIO
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import PICTURE_FAULTS, PICTURE_FORMATS, PNG, FileKind, kind_of, read_bytes, start_of
from vexture.base.errors import LimitError, SourceError, reason_of

if TYPE_CHECKING:  # imported at run time for pictures only
    from PIL import Image

MOST_PIXELS: Final = 50_000_000
"""Most pixels of a picture; a file of a few kilobytes can declare a huge size."""

TEXTS: Final = "vexture."
"""Prefix of PNG keywords in images of the thesis encoding (FORMAT.md)."""

TEXTURE: Final = (
    "is an image of a texture of the encoding thesis, not a picture; convert the drawing that it was made from"
)

ANIMATED: Final = frozenset({"GIF", "PNG", "WEBP"})
"""Formats whose further images are an animation; in a JPEG they are a thumbnail, a map of depths or the like."""

ORIENTATION: Final = 0x0112
"""EXIF tag of the orientation."""

IHDR_DEPTH: Final = 24
"""Place of the bit depth in a PNG file."""

SPACES: Final = {"RGB": "RGB", "GRAY": "L", "CMYK": "CMYK"}
"""Modes of Pillow for the colour spaces of profiles."""

SAME: Final = 2
"""Largest difference, in levels of 255, of a profile from sRGB that is ignored: the rounding of tables."""

BAND: Final = 256
"""Rows that are rounded at once."""

SRGB_GAMMA: Final = 0.45455
"""Value of the chunk gAMA that PNG defines as equivalent to sRGB."""


class DecodedPicture(NamedTuple):
    """Pixels of a picture, and what differs from what the file says."""

    pixels: NDArray[np.uint8]  # (height, width, 4): sRGB and opacity, not premultiplied
    remarks: tuple[str, ...] = ()
    is_turned: bool = False  # True if the orientation in the file changed it


def pixels_of(source: str | os.PathLike[str] | bytes) -> NDArray[np.uint8]:
    """Return the pixels of a picture as `decode_picture` does, without remarks."""
    return decode_picture(source).pixels


def decode_picture(source: str | os.PathLike[str] | bytes) -> DecodedPicture:
    """Decode a PNG, JPEG, WebP or BMP, or the first image of an animation or a GIF.

    The EXIF orientation is applied, and colours are converted from an embedded profile to sRGB. An image of a texture
    is refused.

    Examples
    --------
    >>> from PIL import Image
    >>> file = BytesIO()
    >>> Image.new("CMYK", (1, 1), (255, 0, 0, 0)).save(file, "JPEG", quality=100)
    >>> decode_picture(file.getvalue()).pixels.tolist()
    [[[0, 255, 255, 255]]]
    """
    content = source if isinstance(source, bytes) else read_bytes(source)
    if kind_of(start_of(content)) is not FileKind.PICTURE:
        raise SourceError("is no picture; give a PNG, JPEG, WebP, GIF or BMP")
    from PIL import Image, UnidentifiedImageError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # on sizes, which are checked here, and on damaged metadata
            with Image.open(BytesIO(content), formats=PICTURE_FORMATS) as picture:
                if any(isinstance(key, str) and key.startswith(TEXTS) for key in picture.info):
                    raise SourceError(TEXTURE)
                if picture.width * picture.height > MOST_PIXELS:
                    raise LimitError(
                        f"has {picture.width} x {picture.height} pixels; the limit is {MOST_PIXELS:,}; scale it down"
                    )
                return _decode(picture, content)
    except Image.DecompressionBombError:
        raise LimitError(f"has far more than {MOST_PIXELS:,} pixels, which is the limit; scale it down") from None
    except PICTURE_FAULTS as error:
        why = reason_of(error)
        if isinstance(error, UnidentifiedImageError):  # its text names an object in memory
            why = "its first bytes are those of a picture, and no more"
        raise SourceError(f"is a damaged picture ({why}); save it again") from None


def _decode(picture: "Image.Image", content: bytes) -> DecodedPicture:
    """Decode an open picture whose size has been checked."""
    from PIL import Image

    is_animated = picture.format in ANIMATED and bool(getattr(picture, "is_animated", False))
    picture.seek(0)
    picture.load()
    turns = {
        2: Image.Transpose.FLIP_LEFT_RIGHT,
        3: Image.Transpose.ROTATE_180,
        4: Image.Transpose.FLIP_TOP_BOTTOM,
        5: Image.Transpose.TRANSPOSE,
        6: Image.Transpose.ROTATE_270,
        7: Image.Transpose.TRANSVERSE,
        8: Image.Transpose.ROTATE_90,
    }
    turn = turns.get(picture.getexif().get(ORIENTATION, 1))
    profile = picture.info.get("icc_profile")
    remarks = ["only the first image of the animation is drawn"] if is_animated else []
    gamma = picture.info.get("gamma")
    if gamma and not profile and "srgb" not in picture.info and abs(gamma / SRGB_GAMMA - 1.0) > 0.02:
        remarks.append(f"its gamma of {gamma:g} is ignored")
    depth = content[IHDR_DEPTH] if content.startswith(PNG) else 8
    plain = _from_16_bits(picture, content) if depth == 16 else _plain(picture, depth)
    if profile:
        converted = _to_srgb(plain, profile)
        if converted is None:
            remarks.append("its colour profile cannot be applied, and its colours are taken as sRGB")
        else:
            plain = converted
    whole = plain.convert("RGBA") if turn is None else plain.convert("RGBA").transpose(turn)
    return DecodedPicture(np.asarray(whole, np.uint8), tuple(remarks), turn is not None)


def _plain(picture: "Image.Image", depth: int) -> "Image.Image":
    """Return a picture of up to 8 bits a channel in a mode that profiles know, or in RGBA if it has opacities."""
    key = picture.info.get("transparency")
    if isinstance(key, int) and picture.mode in ("1", "L"):
        gray, most = np.asarray(picture.convert("L")), 2**depth - 1
        opaque = gray != (key * 255 // most if key <= most else key)  # Pillow scales this one only of a single bit
        return _with_opacity(gray[..., None].repeat(3, axis=2), np.where(opaque, 255, 0))
    if key is not None or picture.mode in ("PA", "LA", "La", "RGBa"):
        return picture.convert("RGBA")
    return picture.convert("L") if picture.mode == "1" else picture.convert("RGB") if picture.mode == "P" else picture


def _from_16_bits(picture: "Image.Image", content: bytes) -> "Image.Image":
    """Return a PNG of 16 bits a channel, rounded to 8; Pillow alone drops the lower bits, and opacity by colour."""
    from PIL import Image

    key = picture.info.get("transparency")
    levels = _levels_of_16_bits(picture, content)
    pixels = np.empty((*levels.shape[:2], 4), np.uint8)
    for first in range(0, len(levels), BAND):  # in parts, for the memory
        part = levels[first : first + BAND].astype(np.uint32)
        channels = part.shape[2]
        rounded = (part * 255 + 32767) // 65535
        pixels[first : first + BAND, :, :3] = rounded[..., : 3 if channels > 2 else 1]
        opacity = rounded[..., -1] if channels in (2, 4) else np.full(part.shape[:2], 255, np.uint32)
        if key is not None:
            opacity = np.where((part[..., : 3 if channels > 2 else 1] == np.array(key)).all(axis=2), 0, opacity)
        pixels[first : first + BAND, :, 3] = opacity
    return Image.fromarray(pixels)


def _levels_of_16_bits(picture: "Image.Image", content: bytes) -> NDArray[np.uint16]:
    """Return the levels of a PNG of 16 bits a channel, (height, width, channels).

    Pillow reads the higher bytes of colours; the lower ones are what it reads if it takes numbers as little-endian.
    """
    from PIL import Image

    if picture.mode.startswith("I"):
        return np.asarray(picture).astype(np.uint16)[..., None]
    with Image.open(BytesIO(content), formats=("PNG",)) as again:
        tile = again.tile[0]
        kind = str(tile[3])
        has_gray = kind == "LA;16B"
        again.tile = [tile._replace(args="RGBA" if has_gray else kind.replace(";16B", ";16L"))]
        low = np.asarray(again)
    if has_gray:  # the bytes of both numbers, in order
        levels: NDArray[np.uint16] = low.view(">u2").astype(np.uint16)
    else:
        levels = (np.asarray(picture).astype(np.uint16) << 8) | low
    return levels


def _with_opacity(colours: NDArray[np.integer], opacity: NDArray[np.integer]) -> "Image.Image":
    from PIL import Image

    return Image.fromarray(np.concatenate([colours, opacity[..., None]], axis=2).astype(np.uint8))


def _to_srgb(picture: "Image.Image", profile: bytes) -> "Image.Image | None":
    """Convert a picture from its colour profile to sRGB; return None if the profile is damaged or of another kind."""
    from PIL import Image, ImageCms

    has_opacity = picture.mode == "RGBA"
    try:
        own = ImageCms.ImageCmsProfile(BytesIO(profile))
        mode = SPACES[own.profile.xcolor_space.strip()]
        if mode != ("RGB" if has_opacity else picture.mode) and not (has_opacity and mode == "L"):
            return None
        target, intent = ImageCms.createProfile("sRGB"), ImageCms.Intent(ImageCms.getDefaultIntent(own))
        flags = ImageCms.Flags.NOOPTIMIZE if mode == "L" else ImageCms.Flags.NONE
        change = ImageCms.buildTransform(own, target, mode, "RGB", intent, flags)
        if mode == "RGB" and _is_srgb(change):
            return picture
        if mode == "L":
            ramp = np.asarray(ImageCms.applyTransform(Image.fromarray(np.arange(256, dtype=np.uint8)[None]), change))
            colours = Image.fromarray(ramp[0][np.asarray(picture.convert("L"))])
        else:
            applied = ImageCms.applyTransform(picture.convert(mode) if has_opacity else picture, change)
            assert applied is not None  # it is, if the conversion is in place
            colours = applied
    except (ImageCms.PyCMSError, KeyError, OSError, ValueError, TypeError):
        return None
    if has_opacity:
        colours.putalpha(picture.getchannel("A"))
    return colours


def _is_srgb(change: object) -> bool:
    """Return whether a conversion to sRGB changes nothing that can be seen."""
    from PIL import Image, ImageCms

    levels = np.linspace(0, 255, 9).astype(np.uint8)
    cube = np.stack(np.meshgrid(levels, levels, levels), axis=-1).reshape(27, 27, 3)
    after = np.asarray(ImageCms.applyTransform(Image.fromarray(cube), change), np.int64)  # type: ignore[arg-type]
    return bool(np.abs(after - cube).max() <= SAME)


def premultiply(pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Multiply colours by their opacities, rounded to the nearest level.

    Examples
    --------
    >>> premultiply(np.array([[[255, 100, 3, 128]]], np.uint8)).tolist()
    [[[128, 50, 2, 128]]]
    """
    if (pixels[..., 3] == 255).all():
        return pixels
    colours = (pixels[..., :3].astype(np.uint32) * pixels[..., 3:] + 127) // 255
    return np.concatenate([colours.astype(np.uint8), pixels[..., 3:]], axis=2)
