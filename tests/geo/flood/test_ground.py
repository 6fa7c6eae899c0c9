"""The ground: pictures of strangers, pictures with a place, and what is drawn or invented where there is none."""

import struct
import zlib
from io import BytesIO

import numpy as np
import pytest
import rasterio
from floods import BOUNDS, CRS, geotiff
from PIL import Image

from vexture.base.errors import LimitError, SourceError
from vexture.drawing.drawing import Drawing
from vexture_geo.base.extent import Extent, Frame, Step
from vexture_geo.flood.drawn_ground import DRAWN, drawn_ground
from vexture_geo.flood.grids import shore_distance
from vexture_geo.flood.ground import LARGEST_GROUND, encode_webp, ground_of
from vexture_geo.flood.relief import relief_of
from vexture_geo.flood.views import viewpoint

FRAME = Frame(BOUNDS, CRS, (4000.0, 2000.0))
GREEN = Image.new("RGB", (64, 32), (0, 200, 0))


def west(share):
    """Water up to a share of the frame's width."""
    x0, _, x1, _ = FRAME.box
    edge = x0 + share * (x1 - x0)
    return Drawing.polygon([(0, 0), (edge, 0), (edge, 1), (0, 1)])


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


def test_drawn_ground_tells_land_from_sea():
    extent = Extent(FRAME, (Step(west(0.5)),))
    relief = relief_of(extent)
    picture = drawn_ground(extent, relief)
    assert picture.size == (DRAWN, DRAWN // 2)
    red_, _, blue = np.asarray(picture).astype(float).mean(axis=0).T
    assert (blue[: DRAWN // 3] > red_[: DRAWN // 3]).all()
    assert (red_[DRAWN // 2 + 8 :] > blue[DRAWN // 2 + 8 :]).all()
    assert relief.invented
    assert relief.heights[:, 0].max() < 0.0 < relief.heights[:, -1].min()


def test_bed_gives_the_relief_and_the_still_water_is_its_zero():
    bed = np.tile(np.linspace(5.0, 15.0, 40, dtype=np.float32), (20, 1))
    relief = relief_of(Extent(FRAME, (Step(Drawing(())), Step(west(0.5))), bed))
    assert not relief.invented
    np.testing.assert_allclose(relief.heights[:, [0, 128, 256]], np.tile([-5.0, 0.0, 5.0], (128, 1)), atol=0.15)


def test_relief_says_how_much_of_the_ground_it_knows(tmp_path):
    left, south, right, north = BOUNDS
    bed = np.tile(np.linspace(5.0, 15.0, 40, dtype=np.float32), (20, 1))
    half = geotiff(tmp_path / "half.tif", bed, bounds=((left + right) / 2, south, right, north))
    relief = relief_of(Extent(FRAME, (Step(west(0.25)),)), half)
    assert relief.known == pytest.approx(0.75, abs=0.02)


def test_viewpoint_is_none_where_there_is_no_shore():
    assert viewpoint(Drawing(()), FRAME) is None
    assert viewpoint(Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), FRAME) is None


def test_viewpoint_avoids_ponds():
    x0, y0, x1, y1 = FRAME.box
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    pond = [(middle[0] - 0.01, middle[1] - 0.01), (middle[0] + 0.01, middle[1] - 0.01), (middle[0], middle[1] + 0.01)]
    sea = west(0.3).paths[0].contours[0][:, 0].tolist()
    shore = viewpoint(Drawing.polygon(sea, pond), FRAME)
    assert shore.place[0] == pytest.approx(x0 + 0.3 * (x1 - x0), abs=1e-5)
    assert shore.seaward == pytest.approx((-1.0, 0.0), abs=1e-3)


def test_distance_to_the_shore_is_exact():
    wet = np.random.default_rng(2).random((13, 17)) < 0.3
    found = shore_distance(wet, (2.0, 3.0))
    rows, columns = np.mgrid[:13, :17]
    for row, column in np.ndindex(13, 17):
        other = wet != wet[row, column]
        apart = np.hypot(3.0 * (rows[other] - row), 2.0 * (columns[other] - column)).min()
        assert abs(found[row, column]) == pytest.approx(apart)
        assert (found[row, column] < 0.0) == wet[row, column]


def test_heights_are_metres_whatever_their_unit_and_packing(tmp_path):
    metres = np.tile(np.linspace(8.0, 16.0, 80), (40, 1))
    dry = Extent(FRAME, (Step(Drawing(())),))
    in_feet = geotiff(tmp_path / "feet.tif", (metres / 0.3048).astype("f4"))
    packed = geotiff(tmp_path / "packed.tif", np.rint(100.0 * (metres - 5.0)).astype("i2"))
    other = geotiff(tmp_path / "other.tif", metres.astype("f4"))
    for path, facts in ((in_feet, ("ft", 1.0, 0.0)), (packed, ("m", 0.01, 5.0)), (other, ("psu", 1.0, 0.0))):
        with rasterio.open(path, "r+") as file:
            (file.units, file.scales, file.offsets) = ((fact,) for fact in facts)
    for path in (in_feet, packed):
        relief = relief_of(dry, path)
        assert relief.still == pytest.approx(8.0, abs=0.02)
        assert np.ptp(relief.heights) == pytest.approx(8.0, abs=0.02)
    with pytest.raises(SourceError, match="its values are in 'psu', no unit of length that is known"):
        relief_of(dry, other)
