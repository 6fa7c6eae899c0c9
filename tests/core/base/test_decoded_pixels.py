"""Pixels of a picture's file: depths, opacities, profiles and orientations as browsers read them."""

import io
import struct
from typing import Any

import numpy as np
import png
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageCms, ImageOps

from vexture.base.errors import SourceError
from vexture.base.pixels import ORIENTATION, decode_picture, pixels_of, premultiply

RNG = np.random.default_rng(0)


def file_of(picture: Image.Image, kind: str = "PNG", **options: Any) -> bytes:
    file = io.BytesIO()
    picture.save(file, kind, **options)
    return file.getvalue()


def png_of(values: NDArray[np.integer], **options: Any) -> bytes:
    """A PNG by a library that knows all depths; values are (rows, columns, channels)."""
    file = io.BytesIO()
    rows, columns, channels = values.shape
    writer = png.Writer(columns, rows, greyscale=channels < 3, alpha=channels in (2, 4), **options)
    writer.write(file, values.reshape(rows, -1).tolist())
    return file.getvalue()


@pytest.mark.parametrize("interlace", [False, True])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_sixteen_bits_are_rounded(channels: int, interlace: bool) -> None:
    values = RNG.integers(0, 65536, (7, 9, channels))
    values[0, 0], values[0, 1], values[0, 2] = 65535, 128, 129  # the last two are the ends of levels 0 and 1
    pixels = pixels_of(png_of(values, bitdepth=16, interlace=interlace))
    levels = np.rint(values / 257).astype(np.uint8)
    grays = [0, 0, 0] if channels < 3 else [0, 1, 2]
    assert (pixels[..., :3] == levels[..., grays]).all()
    assert (pixels[..., 3] == (levels[..., -1] if channels in (2, 4) else 255)).all()


def test_sixteen_bits_may_have_a_transparent_colour() -> None:
    """Only of all 16 bits: another colour has the same upper ones."""
    values = np.array([[(1000, 2000, 3000), (1000, 2000, 3001)]])
    assert pixels_of(png_of(values, bitdepth=16, transparent=(1000, 2000, 3000)))[0, :, 3].tolist() == [0, 255]
    assert pixels_of(png_of(values[..., :1], bitdepth=16, transparent=1000))[0, :, 3].tolist() == [0, 0]


@pytest.mark.parametrize("depth", [1, 2, 4, 8])
def test_grays_of_few_bits_may_have_a_transparent_one(depth: int) -> None:
    values = np.arange(min(2**depth, 16))[None, :, None]
    pixels = pixels_of(png_of(values, bitdepth=depth, transparent=1))
    assert pixels[0, :, 3].tolist() == [0 if value == 1 else 255 for value in values.ravel()]
    assert pixels[0, :, 0].tolist() == [value * 255 // (2**depth - 1) for value in values.ravel()]


def test_colours_of_a_palette_have_opacities() -> None:
    picture = Image.new("P", (3, 1))
    picture.putpalette([255, 0, 0, 0, 255, 0, 0, 0, 255])
    picture.putdata([0, 1, 2])
    pixels = pixels_of(file_of(picture, transparency=b"\x00\x80"))
    assert pixels[0].tolist() == [[255, 0, 0, 0], [0, 255, 0, 128], [0, 0, 255, 255]]


def test_a_transparent_colour_of_eight_bits() -> None:
    picture = Image.fromarray(np.array([[[1, 2, 3], [1, 2, 4]]], np.uint8))
    assert pixels_of(file_of(picture, transparency=(1, 2, 3)))[0, :, 3].tolist() == [0, 255]


@pytest.mark.parametrize("orientation", range(1, 9))
def test_pictures_stand_upright(orientation: int) -> None:
    picture = Image.fromarray(RNG.integers(0, 256, (3, 5, 3)).astype(np.uint8))
    exif = Image.Exif()
    exif[ORIENTATION] = orientation
    data = file_of(picture, exif=exif)
    with Image.open(io.BytesIO(data)) as again:
        expected = np.asarray(ImageOps.exif_transpose(again).convert("RGBA"))
    assert (pixels_of(data) == expected).all()


def test_inks_are_converted_to_colours() -> None:
    inks = Image.new("CMYK", (8, 8), (0, 255, 0, 51))
    assert pixels_of(file_of(inks, "JPEG", quality=100))[0, 0].tolist() == [204, 0, 204, 255]


# ---- colour profiles


P3_TO_XYZ = np.array([[0.51512, 0.29198, 0.15710], [0.24120, 0.69225, 0.06657], [-0.00105, 0.04189, 0.78407]])
SRGB_TO_XYZ = np.array([[0.43607, 0.38515, 0.14307], [0.22249, 0.71687, 0.06061], [0.01392, 0.09708, 0.71410]])
"""Adapted to D50, as profiles say it."""


def profile_of(gamma: float, matrix: NDArray[np.float64] | None = None) -> bytes:
    """A profile of ICC version 2: of colours with a matrix, or of grays."""

    def number(value: float) -> bytes:
        return struct.pack(">i", round(value * 65536))

    curve = b"curv" + bytes(4) + struct.pack(">IH", 1, round(gamma * 256)) + bytes(2)
    white = b"XYZ " + bytes(4) + b"".join(map(number, (0.9642, 1.0, 0.8249)))
    text = b"text" + bytes(4) + b"none\0\0\0\0"
    described = b"desc" + bytes(4) + struct.pack(">I", 5) + b"test\0" + bytes(78 + 1)
    tags = {b"wtpt": white, b"cprt": text, b"desc": described}
    if matrix is None:
        tags[b"kTRC"] = curve
    else:
        tags |= {name + b"TRC": curve for name in (b"r", b"g", b"b")}
        for name, column in zip((b"r", b"g", b"b"), matrix.T, strict=True):
            tags[name + b"XYZ"] = b"XYZ " + bytes(4) + b"".join(map(number, column))
    table, body, start = b"", b"", 128 + 4 + 12 * len(tags)
    for name, data in tags.items():
        table += name + struct.pack(">II", start + len(body), len(data))
        body += data + bytes(-len(data) % 4)
    head = struct.pack(
        ">I4sI4s4s4s",
        start + len(body),
        bytes(4),
        0x02100000,
        b"mntr",
        b"RGB " if matrix is not None else b"GRAY",
        b"XYZ ",
    )
    head += bytes(12) + b"acsp" + bytes(28) + b"".join(map(number, (0.9642, 1.0, 0.8249)))
    return head.ljust(128, b"\0") + struct.pack(">I", len(tags)) + table + body


def encoded(linear: NDArray[np.float64]) -> NDArray[np.float64]:
    linear = np.clip(linear, 0.0, 1.0)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


@pytest.mark.parametrize("mode", ["RGB", "RGBA"])
def test_colours_of_a_profile_become_srgb(mode: str) -> None:
    values = RNG.integers(40, 216, (6, 6, len(mode))).astype(np.uint8)
    decoded = decode_picture(file_of(Image.fromarray(values), icc_profile=profile_of(2.2, P3_TO_XYZ)))
    expected = encoded((values[..., :3] / 255) ** 2.2 @ P3_TO_XYZ.T @ np.linalg.inv(SRGB_TO_XYZ).T)
    assert decoded.remarks == ()
    assert np.abs(decoded.pixels[..., :3] - expected).max() <= 2.0
    assert np.abs(expected - values[..., :3]).max() > 10.0
    assert (decoded.pixels[..., 3] == (values[..., 3] if mode == "RGBA" else 255)).all()


def test_grays_of_a_profile_become_srgb() -> None:
    values = np.arange(0, 256, 5, np.uint8)[None]
    pixels = pixels_of(file_of(Image.fromarray(values), icc_profile=profile_of(1.0)))
    assert np.abs(pixels[..., 1] - encoded(values / 255)).max() <= 2.0


def test_the_profile_of_srgb_changes_nothing() -> None:
    values = RNG.integers(0, 256, (16, 16, 3)).astype(np.uint8)
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    assert (pixels_of(file_of(Image.fromarray(values), icc_profile=profile))[..., :3] == values).all()


@pytest.mark.parametrize("profile", [b"damaged", profile_of(2.2), profile_of(2.2, P3_TO_XYZ)[:200]])
def test_a_profile_that_cannot_be_applied_is_named(profile: bytes) -> None:
    values = RNG.integers(0, 256, (4, 4, 3)).astype(np.uint8)
    decoded = decode_picture(file_of(Image.fromarray(values), icc_profile=profile))
    assert decoded.remarks == ("its colour profile cannot be applied, and its colours are taken as sRGB",)
    assert (decoded.pixels[..., :3] == values).all()


def test_a_gamma_is_named() -> None:
    values = RNG.integers(0, 256, (4, 4, 3))
    assert decode_picture(png_of(values, gamma=1.0)).remarks == ("its gamma of 1 is ignored",)
    assert decode_picture(png_of(values, gamma=1 / 2.2)).remarks == ()


# ---- what else differs


def test_an_animation_is_named() -> None:
    frames = [Image.new("RGB", (4, 4), (shade, 0, 0)) for shade in (255, 0)]
    for kind in ("GIF", "WEBP", "PNG"):
        decoded = decode_picture(file_of(frames[0], kind, save_all=True, append_images=frames[1:]))
        assert decoded.remarks == ("only the first image of the animation is drawn",)
        assert decoded.pixels[0, 0, 0] > 250


def test_a_picture_that_breaks_off_is_damaged() -> None:
    data = file_of(Image.fromarray(RNG.integers(0, 256, (40, 40, 3)).astype(np.uint8)))
    with pytest.raises(SourceError, match="damaged picture"):
        decode_picture(data[: len(data) // 2])


def test_premultiplied_levels_are_the_nearest() -> None:
    colour, opacity = np.meshgrid(np.arange(256), np.arange(256))
    pixels = np.stack([colour, colour, colour, opacity], axis=2).astype(np.uint8)
    after = premultiply(pixels)
    assert (after[..., 0] == np.rint(colour * opacity / 255)).all()
    assert (after[..., 3] == opacity).all()
