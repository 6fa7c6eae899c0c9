"""Traced pictures: of drawings whose outline is known, and of files that should not be."""

import io
import struct
import zlib
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image
from traced_drawings import COLOURS, LOGO, SHAPES, area, coloured, distances, file_of, gray, hexes, on_white

import vexture
from vexture.base.errors import LimitError, SourceError, SourceWarning, VextureError
from vexture.base.pixels import MOST_PIXELS
from vexture.cli.main import main
from vexture.server.publish_file import VIEWER_PARAMETERS, shape_of
from vexture.svg.read import svg_drawing
from vexture.texture.load import texture_from

RING = b"""<svg viewBox="0 0 10 10"><path fill-rule="evenodd" d="M1 5a4 4 0 0 0 8 0a4 4 0 0 0 -8 0zM3 5a2 2 0 0 0 4 0
a2 2 0 0 0 -4 0z"/></svg>"""


@pytest.mark.parametrize("name", ["duck", "cake", "font", "thumb", "holes"])
@pytest.mark.parametrize("size", [64, 200, 512])
def test_traced_outline_is_the_true_one_to_a_fraction_of_a_pixel(name, size):
    drawing = vexture.read_svg(SHAPES / f"{name}.svg")
    mean, outward = distances(drawing, vexture.trace(gray(drawing, size)), size)
    assert mean < 0.25
    assert abs(outward) < 0.15


@pytest.mark.slow
def test_large_pictures_are_traced_finer_than_their_reduction(tmp_path):
    disc = svg_drawing(b'<svg viewBox="0 0 1 1"><circle cx=".5" cy=".5" r=".4"/></svg>', "disc.svg")
    image = gray(disc, 2100)
    traced = vexture.trace(image)
    mean, outward = distances(disc, traced, 2100)
    assert mean < 0.5
    assert abs(outward) < 0.3
    np.testing.assert_allclose(traced.to_source, [[2100, 0, 0], [0, -2100, 2100]])


def test_scan_in_black_on_white_is_its_black_shape_with_its_holes():
    ring = svg_drawing(RING, "ring.svg")
    noisy = gray(ring, 300).astype(float) * 0.85 + 20 + np.random.default_rng(1).normal(0, 4, (300, 300))
    traced = vexture.trace(np.clip(noisy, 0, 255).astype(np.uint8))
    assert len(traced.layers()) == 1
    assert area(traced) == pytest.approx(area(ring), rel=0.01)


@pytest.mark.parametrize("width", [120, 480])
@pytest.mark.parametrize("background", ["transparent", "white"])
def test_logo_is_its_layers_without_its_background(width, background):
    logo = svg_drawing(LOGO, "logo.svg")
    pixels = coloured(logo, width, 2 * width // 3)
    traced = vexture.trace(pixels if background == "transparent" else on_white(pixels), "logo")
    assert hexes(traced) == COLOURS
    assert distances(logo, traced, width)[0] < 0.25
    back = on_white(coloured(traced, width, 2 * width // 3)).astype(float)
    assert np.abs(back - on_white(pixels)).mean() < 1.0  # of 255: no seams, no slivers
    np.testing.assert_allclose(traced.to_source, [[width, 0, 0], [0, -width, 5 * width / 6]])


def test_photograph_is_traced_coarsely_and_said_so():
    y, x = np.mgrid[:300, :400]
    waves = np.stack([np.sin(x / 40), np.cos(y / 33), np.sin((x + y) / 50)], axis=2)
    photo = np.clip(128 + 90 * waves + np.random.default_rng(0).normal(0, 12, (300, 400, 3)), 0, 255).astype(np.uint8)
    with pytest.warns(SourceWarning, match="no drawing of a few colours.*no background"):
        traced = vexture.trace(photo, "photo")
    assert len(traced.layers()) <= 16
    assert area(traced) == pytest.approx(0.75, abs=0.01)  # all of it, and no cracks between the colours


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP", "GIF", "BMP"])
def test_format_is_told_by_the_content(tmp_path, kind):
    image = np.full((64, 96, 3), 255, np.uint8)
    image[16:48, 16:64] = 0
    file = tmp_path / "picture.of.something"
    file.write_bytes(file_of(image, kind))
    drawing = vexture.read_image(file)
    assert drawing.name == "picture.of"
    corners = drawing.to_source @ np.vstack([drawing.paths[0].box.T, [1, 1]])
    np.testing.assert_allclose(corners, [[16, 64], [48, 16]], atol=0.3)


def test_orientation_is_honoured():
    image = np.full((40, 80), 255, np.uint8)
    image[8:32, 8:24] = 0
    exif = Image.Exif()
    exif[0x0112] = 6  # to be turned clockwise by a quarter
    drawing = vexture.read_image(file_of(image, "JPEG", exif=exif, quality=95))
    corners = drawing.to_source @ np.vstack([drawing.paths[0].box.T, [1, 1]])
    np.testing.assert_allclose(corners, [[8, 32], [24, 8]], atol=0.5)


def test_first_picture_of_an_animation_is_read():
    frames = [Image.new("L", (40, 40), 255) for _ in range(2)]
    frames[0].paste(0, (10, 10, 30, 30))
    file = io.BytesIO()
    frames[0].save(file, "GIF", save_all=True, append_images=frames[1:])
    assert area(vexture.read_image(file.getvalue())) == pytest.approx(0.25, abs=0.02)


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "RGB", "RGBA", "I;16"])
def test_pixels_of_all_kinds_are_read(mode):
    picture = Image.new("L", (40, 40), 255)
    picture.paste(0, (10, 10, 30, 30))
    if mode == "I;16":
        picture = Image.fromarray(np.asarray(picture).astype(np.uint16) * 257)
    file = io.BytesIO()
    (picture if mode == "I;16" else picture.convert(mode)).save(file, "PNG")
    assert area(vexture.read_image(file.getvalue())) == pytest.approx(0.25, abs=0.02)


def chunk(tag, body):
    return struct.pack(">I", len(body)) + tag + body + struct.pack(">I", zlib.crc32(tag + body))


def png(width, height, *chunks):
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 0, 0, 0, 0)) + b"".join(chunks)


WHOLE = file_of(np.full((30, 30), 255, np.uint8))


@pytest.mark.parametrize(
    ("data", "error"),
    [
        (b"", "no picture"),
        (b"<svg/>", "no picture"),
        (b"\x89PNG", "damaged"),
        (WHOLE[:40], "damaged"),
        (WHOLE[:-30], "damaged"),
        (WHOLE[:20] + b"\xff\xff" + WHOLE[22:], "damaged"),
        (b"\xff\xd8\xff" + bytes(50), "damaged"),
        (b"GIF89a" + bytes(50), "damaged"),
        (b"BM" + bytes(60), "damaged"),
        (b"RIFF\x40\0\0\0WEBPVP8L" + bytes(60), "damaged"),
        (png(30, 30, chunk(b"IDAT", zlib.compress(bytes(10)))), "damaged"),
    ],
)
def test_damaged_files_are_one_line(data, error):
    with pytest.raises(SourceError, match=error) as caught:
        vexture.read_image(data, "x.png")
    assert str(caught.value).startswith("x.png: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("size", [(8_000, 8_000), (2**31 - 1, 2**31 - 1), (MOST_PIXELS + 1, 1)])
def test_bombs_are_refused_before_they_are_decoded(size):
    bomb = png(*size, chunk(b"IDAT", zlib.compress(bytes(10**6))))
    with pytest.raises(LimitError, match=f"{MOST_PIXELS:,}"):
        vexture.read_image(bomb, "bomb.png")


@pytest.mark.parametrize("shape", [(1, 1), (1, 2000), (3, 3), (2, 2, 3), (1, 1, 4)])
@pytest.mark.filterwarnings("ignore::vexture.SourceWarning")
def test_the_smallest_pictures_are_drawings(shape):
    rng = np.random.default_rng(0)
    for _ in range(20):
        drawing = vexture.trace(rng.integers(0, 256, shape, np.uint8))
        np.testing.assert_allclose(drawing.to_source @ (0.5, 0.5, 1.0), (shape[1] / 2, shape[0] / 2))


NO_PICTURES = [np.zeros((0, 5)), np.zeros(5), np.zeros((2, 2, 2)), np.full((2, 2), np.nan), np.zeros((2, 2), int)]


@pytest.mark.parametrize("image", [*NO_PICTURES, np.full((2, 2), 2.0)])
def test_array_that_is_no_picture_is_refused(image):
    with pytest.raises(SourceError, match="must be"):
        vexture.trace(image)


@pytest.fixture
def logo(tmp_path):
    file = tmp_path / "logo.png"
    Image.fromarray(on_white(coloured(svg_drawing(LOGO, "logo.svg"), 240, 160))).save(file)
    return file


def run(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments])


def test_command_line_converts_and_draws_pictures(logo, tmp_path):
    result = run("convert", logo, "-o", tmp_path, "--split", "paint", "--trace-images")
    assert result.exit_code == 0, result.output
    assert ", 4 layers, " in result.output
    texture = vexture.load(tmp_path / "logo.ktx2")
    assert [root.paint.hex for root in texture.roots] == COLOURS
    assert texture.contains([(0.5, 0.5), (0.02, 0.5)], root=texture.roots[0].name).tolist() == [False, False]
    picture = tmp_path / "drawn.png"
    drawing, encoded = (logo, "--renderer", "exact", "--trace-images"), (tmp_path / "logo.ktx2", "--renderer", "cpu")
    for shown in (drawing, encoded):
        result = run("render", *shown, "-o", picture)
        assert result.exit_code == 0, result.output
        with Image.open(picture) as drawn:
            assert drawn.convert("RGB").resize((240, 240)).getpixel((80, 120)) == (0xF2, 0xB6, 0x32)


def test_textures_of_the_encoding_thesis_are_textures(logo, tmp_path):
    assert run("convert", SHAPES / "duck.svg", "-o", tmp_path, "--encoding", "thesis").exit_code == 0
    for name in ("duck.quads.png", "duck.curves.png"):
        result = run("convert", tmp_path / name, "-o", tmp_path / "out")
        assert (result.exit_code, result.output.count("\n")) == (1, 1)
        assert "is an image of a texture of the encoding thesis, not a picture" in result.output
        renamed = tmp_path / "renamed.png"
        renamed.write_bytes((tmp_path / name).read_bytes())
        with pytest.raises(SourceError, match="encoding thesis"):
            vexture.read_image(renamed)
        assert (
            run("render", tmp_path / name, "-o", tmp_path / "x.png", "--renderer", "cpu", "--size", 32).exit_code == 0
        )
    (tmp_path / "duck.quads.png").write_bytes(b"damaged")
    result = run("render", tmp_path / "duck.quads.png", "-o", tmp_path / "x.png", "--renderer", "cpu")
    assert "damaged PNG" in result.output


def test_a_start_without_a_picture_names_no_object_in_memory(logo):
    with pytest.raises(SourceError) as refused:
        vexture.read_image(logo.read_bytes()[:8], "start.png")
    assert str(refused.value).startswith("start.png: is a damaged picture (")
    assert " at 0x" not in str(refused.value)


def test_selectors_choose_nothing_of_a_picture(logo, tmp_path):
    result = run("convert", logo, "-o", tmp_path, "--select", "#a")
    assert (result.exit_code, "chooses elements of an SVG" in result.output) == (1, True)


def test_pictures_are_published_and_shown(logo):
    shape = shape_of(logo.read_bytes(), "logo.png", "logo", replace(VIEWER_PARAMETERS, images="trace"))
    texture = texture_from(shape.texture.data, "logo")
    assert [root.is_map for root in texture.roots] == [True]
    shown = {tuple(np.rint(255 * color).astype(int)) for color in texture.render(64).reshape(-1, 4)}
    assert {(*bytes.fromhex(color[1:]), 255) for color in COLOURS} <= shown
    assert list(shape.views) == ["converted"]
    with pytest.raises(VextureError, match=r"^broken\.png: is a damaged picture"):
        shape_of(logo.read_bytes()[:100], "broken.png", "broken", VIEWER_PARAMETERS)


def test_missing_file_is_one_line(tmp_path):
    with pytest.raises(SourceError, match=r"none\.png: cannot be read: No such file"):
        vexture.read_image(tmp_path / "none.png")
