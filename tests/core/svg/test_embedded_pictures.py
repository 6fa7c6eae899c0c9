"""Pictures in an SVG, drawn pixel by pixel: place, treatment and budget, beside resvg, which knows none of our code.

Squares of pixels are compared where `image-rendering` says so, because resvg interpolates by cubics, and browsers do
not; colours between centres are compared on pictures of one slope, where both are the same.
"""

import re
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image
from svg_pictures import BLOCKS, IMAGE, PLACED, SVG, blocks, file_of, link_of, read, slope
from svg_reference import render_file

import vexture
from vexture.base.errors import SourceWarning
from vexture.base.pixels import ORIENTATION
from vexture.cli.main import main
from vexture.drawing.drawing import Drawing
from vexture.drawing.picture import Sampling
from vexture.drawing.picture_size import texel_count
from vexture.renderers.exact import render_exact_colours
from vexture.svg.images import Images
from vexture.svg.pictures import MOST_TEXELS

RNG = np.random.default_rng(0)


def gap(text: str, drawing: Drawing | None = None) -> tuple[float, float]:
    """Mean over the touched pixels and 99th hundredth of the difference between resvg and the exact renderer."""
    theirs = render_file(text)
    ours = render_exact_colours(drawing or read(text), theirs.shape[:2][::-1])
    difference = np.abs(theirs - ours).max(axis=2)
    touched = (theirs[..., 3] > 0) | (ours[..., 3] > 0)
    assert touched.sum() > 500
    return float(difference[touched].mean()), float(np.quantile(difference[touched], 0.99))


def notes(drawing: Drawing) -> list[str]:
    return [str(note) for note in drawing.notes if note.kind != "remark"]


@pytest.mark.parametrize("case", PLACED)
def test_a_picture_stands_where_browsers_put_it(case: str) -> None:
    text = SVG.format(PLACED[case])
    drawing = read(text)
    assert notes(drawing) == []
    assert any(path.paint.picture is not None for path in drawing.paths)
    mean, most = gap(text, drawing)
    assert (mean < 0.012, most < 0.3) == (True, True), (mean, most)


@pytest.mark.parametrize("place", ['width="100" height="100"', 'width="80" height="100" transform="rotate(9)"'])
def test_colours_between_centres_are_interpolated(place: str) -> None:
    text = SVG.format(
        f'<clipPath id="c"><rect x="20" y="20" width="50" height="50"/></clipPath><g clip-path="url(#c)">'
        f'<image href="{link_of(file_of(slope(20, 20)))}" {place}/></g>'
    )
    mean, most = gap(text)
    assert (mean < 0.006, most < 0.05) == (True, True), (mean, most)


def test_a_reduced_picture_is_the_mean_of_its_pixels() -> None:
    noise = RNG.integers(0, 256, (300, 300, 3)).astype(np.uint8)
    pixels = noise.reshape(100, 3, 100, 3, 3).mean(axis=(1, 3)) / 255
    squares = read(SVG.format(f'<image {IMAGE.format(link_of(file_of(noise)))} width="100" height="100"/>'))
    assert np.abs(render_exact_colours(squares, 100)[..., :3] - pixels).max() < 1e-4


RENDERINGS = {
    "auto": Sampling.LINEAR,
    "smooth": Sampling.LINEAR,
    "optimizeQuality": Sampling.LINEAR,
    "optimizeSpeed": Sampling.PIXELS,
    "pixelated": Sampling.PIXELS,
    "crisp-edges": Sampling.PIXELS,
    "-moz-crisp-edges": Sampling.PIXELS,
    "nonsense": Sampling.LINEAR,
}


@pytest.mark.parametrize("value", RENDERINGS)
def test_rendering_of_images(value: str) -> None:
    """As an attribute, in a style, and inherited."""
    image = f'<image href="{link_of(file_of(blocks()))}" width="9" height="6" '
    for text in (f'{image}image-rendering="{value}"/>', f'<g style="image-rendering: {value}">{image}/></g>'):
        (path,) = read(SVG.format(text)).paths
        assert path.paint.picture is not None
        assert path.paint.picture.sampling is RENDERINGS[value]


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP", "GIF", "BMP"])
def test_pictures_of_each_kind_are_drawn(kind: str) -> None:
    large = Image.fromarray(slope(30, 30))
    options = {"JPEG": {"quality": 95}, "WEBP": {"lossless": True}}.get(kind, {})
    link = link_of(file_of(large, kind, **options), f"image/{kind.lower()}")
    drawing = read(SVG.format(f'<image href="{link}" width="100" height="100"/>'))
    assert notes(drawing) == []
    middle = render_exact_colours(drawing, 100)[50, 50, :3] * 255
    assert np.abs(middle - slope(30, 30)[15, 15]).max() < (14 if kind == "GIF" else 6)


def test_files_beside_a_drawing_are_drawn(tmp_path: Path) -> None:
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "a.png").write_bytes(file_of(blocks()))
    drawing = read(SVG.format('<image href="below/a.png" width="9" height="6"/>'), tmp_path)
    assert (len(drawing.paths), notes(drawing)) == (1, [])
    assert vexture.read_svg(tmp_path / "drawing.svg").paths[0].paint.picture is not None


def test_a_picture_in_an_embedded_drawing_is_drawn() -> None:
    inner = SVG.format(BLOCKS + 'width="100" height="100"/>')
    text = SVG.format(f'<image href="{link_of(inner.encode(), "image/svg+xml")}" width="50" height="50"/>')
    mean, most = gap(text)
    assert (mean < 0.012, most < 0.3) == (True, True)


def test_hidden_pictures_are_not_read() -> None:
    for hidden in ('visibility="hidden"', 'display="none"', 'width="0"', 'transform="scale(0)"', 'opacity="0"'):
        drawing = read(SVG.format(f'<path d="M0 0h9v9z"/>{BLOCKS}{hidden}/>'))
        assert (len(drawing.paths), notes(drawing)) == (1, [])


def test_what_a_file_says_and_is_not_drawn_is_named() -> None:
    frames = [Image.new("RGB", (4, 4), (shade, 0, 0)) for shade in (255, 0)]
    moving = file_of(frames[0], "GIF", save_all=True, append_images=frames[1:])
    drawing = read(SVG.format(f'<image href="{link_of(moving)}" width="9" height="6"/>'))
    assert notes(drawing) == ["an embedded GIF of 4 x 4 (only the first image of the animation is drawn)"]
    assert len(drawing.paths) == 1


def test_an_orientation_that_is_not_wanted_is_named() -> None:
    exif = Image.Exif()
    exif[ORIENTATION] = 6
    link = link_of(file_of(blocks(), exif=exif))
    turned = read(SVG.format(f'<image href="{link}" width="60"/>'))
    assert turned.paths[0].box.ravel() == pytest.approx([0.0, 0.1, 0.6, 1.0])
    assert notes(turned) == []
    drawing = read(SVG.format(f'<image href="{link}" width="60" style="image-orientation: none"/>'))
    expected = "an embedded PNG of 3 x 2 (it is turned upright, although image-orientation is none)"
    assert notes(drawing) == [expected]


def test_a_picture_that_breaks_off_is_left_out() -> None:
    content = file_of(RNG.integers(0, 256, (40, 40, 3)).astype(np.uint8))
    (note,) = notes(read(SVG.format(f'<path d="M0 0h9v9z"/><image href="{link_of(content[:900])}" width="9"/>')))
    assert re.fullmatch(r"an embedded PNG of 40 x 40 \(is a damaged picture \(.*\); save it again\)", note)


# ---- the budget


def test_pictures_beyond_the_budget_are_halved_largest_first(tmp_path: Path) -> None:
    large, small = RNG.integers(0, 256, (901, 900, 3)).astype(np.uint8), blocks()
    (tmp_path / "large.png").write_bytes(file_of(large, compress_level=1))
    (tmp_path / "small.png").write_bytes(file_of(small))
    text = SVG.format('<image href="large.png" width="90" height="90"/><image href="small.png" width="9" height="6"/>')
    drawing = read(text, tmp_path)
    (note,) = notes(drawing)
    limit = f"pictures of a drawing take at most {MOST_TEXELS:,} texels"
    assert note == f"image 'large.png': 450 x 451 of its 900 x 901 pixels ({limit})"
    first, second = (path.paint.picture for path in drawing.paths)
    assert first is not None
    assert second is not None
    assert (first.pixels.shape, second.pixels.shape) == ((451, 450, 4), (2, 3, 4))
    assert first.pixels[7, 5, 0] == np.floor(large[14:16, 10:12, 0].mean() + 0.5)
    assert first.pixels[450, 5, 0] == np.floor(large[900, 10:12, 0].mean() + 0.5)
    column, row = (a * 0.45 + b * 0.55 + c for a, b, c in first.to_pixels)  # at 45, 45 of the drawing
    assert (column, row) == pytest.approx((450 * 0.5, 451 / 2 - (901 - 900) / 4), abs=0.5)


def test_pictures_that_fit_alone_may_not_fit_together(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"{name}.png").write_bytes(file_of(RNG.integers(0, 256, (700, 700, 3)).astype(np.uint8)))
    images = '<image href="a.png" width="9"/><image href="b.png" width="9"/><image href="a.png" x="9" width="9"/>'
    drawing = read(SVG.format(images), tmp_path)
    sizes = {path.paint.picture.pixels.shape[0] for path in drawing.paths if path.paint.picture is not None}
    assert sizes == {700, 350}
    assert len(notes(drawing)) == 1
    shared = {id(path.paint.picture.pixels) for path in drawing.paths if path.paint.picture is not None}
    assert len(shared) == 2
    for path in drawing.paths:
        picture = path.paint.picture
        assert picture is not None
        ends = [[a * x + b * y + c for a, b, c in picture.to_pixels] for x, y in path.box.tolist()]
        side = picture.pixels.shape[0]
        assert sorted(np.ravel(ends).tolist()) == pytest.approx([0.0, 0.0, side, side], abs=1e-9)
    assert 2 * texel_count(700, 700) > MOST_TEXELS >= texel_count(700, 700) + texel_count(350, 350)


def test_very_many_pixels_are_refused_before_they_are_decoded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vexture.svg.images.MOST_PIXELS", 40)
    links = [link_of(file_of(RNG.integers(0, 256, (5, 5, 3)).astype(np.uint8))) for _ in range(2)]
    drawing = read(SVG.format("".join(f'<image href="{link}" width="9"/>' for link in links)))
    assert notes(drawing) == ["an embedded PNG of 5 x 5 (the pictures of the drawing have more than 40 pixels)"]
    assert len(drawing.paths) == 1


# ---- a picture by itself


def test_a_picture_itself_is_drawn(tmp_path: Path) -> None:
    noise = RNG.integers(0, 256, (40, 60, 3)).astype(np.uint8)
    file = tmp_path / "photo.jpg"
    file.write_bytes(file_of(noise))
    drawing = vexture.read(file)
    (path,) = drawing.paths
    assert (drawing.name, drawing.notes) == ("photo", ())
    assert path.box.ravel() == pytest.approx([0.0, 1 / 6, 1.0, 5 / 6])
    assert drawing.to_source @ (0.0, 5 / 6, 1.0) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert path.paint.picture is not None
    assert path.paint.picture.sampling is Sampling.LINEAR
    assert (path.paint.picture.pixels[..., :3] == noise).all()
    red = path.paint.picture.color_at(10.5 / 60, 5 / 6 - 3.5 / 60)[0]
    assert red == pytest.approx(noise[3, 10, 0] / 255)


def test_pixel_art_itself_has_squares() -> None:
    large = blocks().repeat(16, axis=0).repeat(16, axis=1)
    (path,) = vexture.read(file_of(large)).paths
    assert path.paint.picture is not None
    assert path.paint.picture.pixels.shape == (2, 3, 4)
    assert path.paint.picture.sampling is Sampling.PIXELS
    assert path.paint.picture.color_at(0.4, 0.7)[:3] == pytest.approx([30 / 255, 140 / 255, 70 / 255])


def test_a_picture_with_too_long_a_side_is_halved() -> None:
    strip = Image.fromarray(RNG.integers(0, 256, (2, 20_000, 3)).astype(np.uint8))
    with pytest.warns(SourceWarning, match=r"10,000 x 1 of its 20,000 x 2 pixels \(a picture takes at most"):
        (path,) = vexture.read(file_of(strip)).paths
    assert path.paint.picture is not None
    assert path.paint.picture.pixels.shape == (1, 10_000, 4)


def test_outlines_of_a_picture_are_traced(tmp_path: Path) -> None:
    """A silhouette has no use for a rectangle."""
    file = tmp_path / "box.png"
    pixels = np.full((64, 64), 255, np.uint8)
    pixels[16:32, 16:48] = 0
    file.write_bytes(file_of(pixels))
    for treated in ({"split": None}, {"encoding": "thesis"}, {"images": "trace"}):
        texture = vexture.convert(file, **treated)
        assert texture.coverage(32)[[12, 28], [16, 3]].round().tolist() == [1.0, 0.0]
    out = tmp_path / "out.png"
    for flags, corner in (([], 255), (["--trace-images"], 255)):
        result = CliRunner().invoke(main, ["render", str(file), "-o", str(out), "--renderer", "exact", *flags])
        assert result.exit_code == 0, result.output
        with Image.open(out) as picture:
            assert picture.convert("L").getpixel((1, 1)) == corner
    result = CliRunner().invoke(main, ["render", str(file), "-o", str(out), "--no-images"])
    assert result.output == f"vexture: {file}: --no-images leaves nothing of a picture; leave it out\n"


def test_images_have_a_treatment_that_is_known() -> None:
    assert Images().has_pictures
    with pytest.raises(vexture.ParameterError, match="`images` is 'drawn'; it must be 'draw', 'trace', 'none'"):
        vexture.read(b"<svg/>", images="drawn")  # type: ignore[arg-type]
