"""The ground: pictures of strangers, and pictures with a place."""

import struct
import zlib
from io import BytesIO

import numpy as np
import pytest
from floods import BOUNDS, CRS, FRAME, geotiff
from PIL import Image

from vexture.base.errors import LimitError, SourceError
from vexture_geo.flood.ground import LARGEST_GROUND, encode_webp, ground_of

GREEN = Image.new("RGB", (64, 32), (0, 200, 0))


def red(path, bounds, crs=CRS, **profile):
    bands = np.zeros((3, 50, 100), np.uint8)
    bands[0] = 250
    return geotiff(path, bands, crs=crs, bounds=bounds, **profile)


def test_picture_with_a_place_comes_to_it(tmp_path):
    left, south, right, north = BOUNDS
    half = red(tmp_path / "half.tif", (left, south, (left + right) / 2, north))
    picture, notes = ground_of(half, FRAME, GREEN, bounds_given=True)
    pixels = np.asarray(picture).astype(int)
    width = pixels.shape[1]
    assert pixels[10, width // 4].tolist() == [250, 0, 0]
    assert pixels[10, 3 * width // 4].tolist() == [0, 200, 0]
    assert [note.text for note in notes] == ["half.tif shows 50% of the frame; the rest of the ground is drawn."]


def test_picture_of_floats_shows_no_more_than_it_has(tmp_path):
    left, south, right, north = BOUNDS
    gray = np.tile(np.linspace(0.2, 0.8, 100, dtype=np.float32), (50, 1))
    half = geotiff(tmp_path / "half.tif", gray, bounds=(left, south, (left + right) / 2, north))
    picture, notes = ground_of(half, FRAME, GREEN, bounds_given=True)
    pixels = np.asarray(picture).astype(int)
    assert pixels[10, 3 * pixels.shape[1] // 4].tolist() == [0, 200, 0]
    assert notes[0].text.startswith("half.tif shows 50% of the frame")
    far = geotiff(tmp_path / "far.tif", gray, bounds=(0.0, 0.0, 10.0, 10.0))
    with pytest.raises(SourceError, match="shows nothing of the frame"):
        ground_of(far, FRAME, GREEN, bounds_given=True)


def test_picture_of_another_reference_system_is_warped(tmp_path):
    from rasterio.warp import transform_bounds

    wide = transform_bounds(CRS, "EPSG:4326", *BOUNDS)
    picture, _ = ground_of(red(tmp_path / "d.tif", wide, "EPSG:4326"), FRAME, GREEN, bounds_given=True)
    assert np.asarray(picture)[picture.height // 2, picture.width // 2].tolist() == [250, 0, 0]
    assert picture.width == pytest.approx(2 * picture.height, abs=2)


def test_picture_elsewhere_or_nowhere_is_refused(tmp_path):
    far = red(tmp_path / "far.tif", (0.0, 0.0, 10.0, 10.0))
    with pytest.raises(SourceError, match="shows nothing of the frame"):
        ground_of(far, FRAME, GREEN, bounds_given=True)
    with pytest.raises(SourceError, match="says no reference system"):
        ground_of(red(tmp_path / "no.tif", BOUNDS, None), FRAME, GREEN, bounds_given=True)


def test_bright_bands_of_16_bits_are_stretched(tmp_path):
    bands = np.tile(np.linspace(1000, 5000, 100).astype(np.uint16), (50, 1))
    picture, notes = ground_of(geotiff(tmp_path / "g.tif", bands), FRAME, GREEN, bounds_given=True)
    pixels = np.asarray(picture).astype(int)
    assert pixels[20, 0, 0] < 10 < 240 < pixels[20, -1, 0]
    assert "more than 8 bits" in notes[-1].text


def test_plain_picture_covers_the_frame(tmp_path):
    path = tmp_path / "g.png"
    Image.new("RGBA", (200, 100), (255, 0, 0, 0)).save(path)
    picture, notes = ground_of(path, FRAME, GREEN, bounds_given=True)
    assert (picture.size, notes) == ((200, 100), [])
    assert np.asarray(picture)[50, 50].tolist() == [0, 200, 0]
    _, notes = ground_of(path, FRAME, GREEN, bounds_given=False)
    assert notes[0].remedy.startswith("`bounds`")


def test_picture_that_says_it_is_endless_is_refused(tmp_path):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", 60000, 60000, 8, 2, 0, 0, 0))
    path = tmp_path / "bomb.png"
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", zlib.compress(bytes(1000))) + chunk(b"IEND", b""))
    with pytest.raises(LimitError, match="scale it down"):
        ground_of(path, FRAME, GREEN, bounds_given=True)


def test_damaged_picture_is_refused(tmp_path):
    out = BytesIO()
    Image.effect_noise((200, 100), 50).save(out, format="PNG")
    path = tmp_path / "half.png"
    path.write_bytes(out.getvalue()[:3000])
    with pytest.raises(SourceError, match="is a damaged picture"):
        ground_of(path, FRAME, GREEN, bounds_given=True)


def test_encoded_picture_is_small_enough():
    noise = np.random.default_rng(1).integers(0, 256, (1500, 1500, 3), dtype=np.uint8)
    data = encode_webp(Image.fromarray(noise))
    assert len(data) <= LARGEST_GROUND
    assert Image.open(BytesIO(data)).format == "WEBP"
