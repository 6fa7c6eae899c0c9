"""Images in an SVG: pictures traced where they stand, files only from beside the drawing, everything else named.

Pictures that are drawn are in `test_embedded_pictures.py`.
"""

import base64
import gzip
import io
import os
import struct
import warnings
import zlib
from pathlib import Path

import pytest
from click.testing import CliRunner
from PIL import Image, ImageDraw
from svg_reference import difference

import vexture
from vexture.base.errors import ParameterError, SourceWarning
from vexture.cli.main import main
from vexture.conversion.parameters import ImageTreatment
from vexture.drawing.drawing import Drawing
from vexture.svg.images import DEEPEST, MOST_IMAGES

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'
TRACED = "<image> traced"


def picture(kind: str = "PNG", mode: str = "RGB", **options: object) -> bytes:
    """Three flat colours on a white or transparent ground, 300 x 200 pixels."""
    image = Image.new(mode, (300, 200), (255, 255, 255, 0) if mode == "RGBA" else (255, 255, 255))
    draw = ImageDraw.Draw(image)
    draw.rectangle((40, 50, 139, 149), fill=(200, 30, 40))
    draw.ellipse((170, 20, 269, 119), fill=(20, 60, 200))
    draw.rectangle((180, 150, 279, 179), fill=(30, 140, 70))
    file = io.BytesIO()
    image.save(file, kind, **options)
    return file.getvalue()


def data_url(content: bytes, media_type: str = "image/png") -> str:
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def read(text: str, folder: Path | None = None, images: ImageTreatment = "trace") -> Drawing:
    """Read a text, as a file in a folder if one is given."""
    source: Path | bytes = text.encode()
    if folder is not None:
        source = folder / "drawing.svg"
        source.write_text(text)
    with warnings.catch_warnings(action="ignore", category=SourceWarning):
        return vexture.read(source, images=images)


def notes(drawing: Drawing) -> list[str]:
    return [str(note) for note in drawing.notes if note.kind != "remark"]


PLACED = {
    "fitted": '<image x="5" y="10" width="80" height="80" href="{}"/>',
    "sliced": '<image x="5" y="10" width="50" height="80" preserveAspectRatio="xMaxYMid slice" href="{}"/>',
    "stretched": '<image x="5" y="10" width="50" height="80" preserveAspectRatio="none" href="{}"/>',
    "one side": '<image x="5" y="10" width="60" href="{}"/>',
    "turned": '<image width="60" height="40" transform="translate(30 10) rotate(20)" href="{}"/>',
    "translucent": '<image x="5" y="10" width="80" height="80" opacity="0.5" href="{}"/>',
    "clipped": '<clipPath id="c"><circle cx="40" cy="50" r="25"/></clipPath>'
    '<image x="5" y="10" width="80" height="80" clip-path="url(#c)" href="{}"/>',
}


@pytest.mark.parametrize("case", PLACED)
def test_a_picture_is_traced_where_it_stands(case: str, tmp_path: Path) -> None:
    text = SVG.format('<path fill="#fe8" d="M0 0h100v100z"/>' + PLACED[case].format(data_url(picture())))
    drawing = read(text)
    assert notes(drawing) == [TRACED]
    mean, _ = difference(tmp_path / "unread.svg", drawing, text)
    assert mean < 0.01


@pytest.mark.parametrize(
    ("kind", "mode", "options"),
    [
        ("JPEG", "RGB", {"quality": 95}),
        ("GIF", "P", {}),
        ("WEBP", "RGB", {"lossless": True}),
        ("PNG", "RGBA", {}),
        ("PNG", "L", {}),
    ],
)
def test_pictures_of_each_kind(kind: str, mode: str, options: dict[str, object], tmp_path: Path) -> None:
    image = Image.open(io.BytesIO(picture(mode="RGBA" if mode == "RGBA" else "RGB")))
    image = image.quantize(8) if mode == "P" else image.convert(mode)
    file = io.BytesIO()
    image.save(file, kind, **options)
    text = SVG.format(f'<image width="100" height="100" href="{data_url(file.getvalue(), "text/plain")}"/>')
    drawing = read(text)
    assert notes(drawing) == [TRACED]
    mean, _ = difference(tmp_path / "unread.svg", drawing, text.replace("text/plain", f"image/{kind.lower()}"))
    assert mean < 0.03


@pytest.mark.parametrize("case", PLACED)
def test_gradients_of_a_picture_stay_where_they_are(case: str, tmp_path: Path) -> None:
    image = Image.new("RGB", (300, 200), (240, 240, 240))
    ramp = Image.linear_gradient("L")  # from black above to white below
    image.paste(
        Image.merge("RGB", (ramp, ramp.rotate(180), Image.new("L", ramp.size, 90))).resize((200, 160)), (20, 20)
    )
    file = io.BytesIO()
    image.save(file, "PNG")
    text = SVG.format(PLACED[case].format(data_url(file.getvalue())))
    drawing = read(text)
    assert sum(path.paint.gradient is not None for path in drawing.paths) == 1
    mean, _ = difference(tmp_path / "unread.svg", drawing, text)
    assert mean < 0.02


def test_a_picture_that_is_left_out_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(picture())
    images = {"a.png": "image 'a.png'", data_url(picture()): "an embedded PNG of 300 x 200"}
    for link, called in images.items():
        drawing = read(SVG.format(f'<image width="9" height="9" href="{link}"/>'), tmp_path, "none")
        assert (notes(drawing), drawing.paths) == ([f"{called} (pictures are left out)"], ())


def test_a_drawing_beside_a_drawing_needs_no_option(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(SVG.format('<path d="M0 0h50v100h-50z"/>'))
    (tmp_path / "b.svgz").write_bytes(gzip.compress((tmp_path / "a.svg").read_bytes()))
    for link in ("a.svg", "b.svgz"):
        text = SVG.format(f'<image width="100" height="100" href="{link}"/>')
        (path,) = read(text, tmp_path, "none").paths
        assert path.box.tolist() == [[0.0, 0.0], [0.5, 1.0]]
        assert len(vexture.read_svg(tmp_path / "drawing.svg").paths) == 1


@pytest.mark.parametrize("treatment", ["draw", "trace"])
@pytest.mark.parametrize("content", [b"", b"II*\0 of a TIFF", b"%PDF-1.7", b"<html/>", b'{"type": "Point"}'])
def test_a_file_that_is_no_picture_is_named_with_what_is_read(
    content: bytes, treatment: ImageTreatment, tmp_path: Path
) -> None:
    (tmp_path / "a.tif").write_bytes(content)
    (note,) = notes(read(SVG.format('<image width="9" href="a.tif"/>'), tmp_path, treatment))
    why = {b"": "it is empty", b"<html/>": "the root element is <html>, not <svg>; this is not an SVG file"}
    assert note == f"image 'a.tif' ({why.get(content, 'it is no SVG, PNG, JPEG, WebP, GIF or BMP')})"


def test_files_beside_a_drawing_and_below(tmp_path: Path) -> None:
    (tmp_path / "in it").mkdir()
    for name in ("a.png", "in it/b.png"):
        (tmp_path / name).write_bytes(picture())
    (tmp_path / "c.svg").write_text(SVG.format('<image id="inner" href="a.png" width="9"/><path d="M0 0h9v9z"/>'))
    for link in ("a.png", "./a.png", "in%20it/b.png"):
        assert notes(read(SVG.format(f'<image width="9" href="{link}"/>'), tmp_path)) == [TRACED]
    drawing = read(SVG.format('<image width="9" href="c.svg#top"/>'), tmp_path)
    assert len(drawing.paths) == 1
    assert notes(drawing) == ["image 'a.png' (an image of another drawing shows no files)"]


OUTSIDE = "only files beside the drawing and in folders below are read"
FETCHED = "nothing is fetched from an address"


@pytest.mark.parametrize(
    ("link", "called", "why"),
    [
        ("../secret.png", "image 'secret.png'", OUTSIDE),
        ("%2e%2e/secret.png", "image 'secret.png'", OUTSIDE),
        ("sub/../../secret.png", "image 'secret.png'", OUTSIDE),
        ("sub/../a.png", "image 'a.png'", OUTSIDE),
        ("out.png", "image 'out.png'", OUTSIDE),
        ("outside/secret.png", "image 'secret.png'", OUTSIDE),
        ("{}/secret.png", "image 'secret.png'", OUTSIDE),
        ("C:\\pictures\\a.png", "image 'a.png'", OUTSIDE),
        ("file://{}/secret.png", "image 'secret.png'", OUTSIDE),
        ("file:a.png", "image 'a.png'", OUTSIDE),
        ("http://localhost/b/a.png?c=/d.png#e", "image 'a.png'", FETCHED),
        ("//localhost/a.png", "image 'a.png'", FETCHED),
        ("a%00.png", "image 'a\ufffd.png'", OUTSIDE),
        ("none.png", "image 'none.png'", "there is no such file beside the drawing"),
        ("pipe", "image 'pipe'", "there is no such file beside the drawing"),
        ("sub", "image 'sub'", "there is no such file beside the drawing"),
        ("a" * 5000, f"image '{'a' * 37}...'", "its name is too long for a file"),
        ("data:image/png;base64,A", "an embedded image", "its data is no base64"),
        ("data:image/png", "an embedded image", "its data: URL has no data"),
        ("data:image/png,", "an embedded image", "it is empty"),
    ],
)
@pytest.mark.parametrize("treatment", ["draw", "trace"])
def test_what_is_not_read_is_named(link: str, called: str, why: str, treatment: ImageTreatment, tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    (folder / "sub").mkdir(parents=True)
    for name in ("secret.png", "folder/a.png"):
        (tmp_path / name).write_bytes(picture())
    (folder / "out.png").symlink_to(tmp_path / "secret.png")
    (folder / "outside").symlink_to(tmp_path)
    os.mkfifo(folder / "pipe")
    link = link.format(tmp_path)
    drawing = read(SVG.format(f'<image width="9" href="{link}"/>'), folder, treatment)
    assert (notes(drawing), drawing.paths) == ([f"{called} ({why})"], ())


def test_a_drawing_that_is_no_file_reads_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.png").write_bytes(picture())
    monkeypatch.chdir(tmp_path)
    treatments: tuple[ImageTreatment, ...] = ("draw", "trace")
    for treatment in treatments:
        drawing = read(SVG.format('<image width="9" href="a.png"/>'), images=treatment)
        assert notes(drawing) == ["image 'a.png' (a drawing that is no file itself shows no files)"]


def bomb(side: int) -> bytes:
    """PNG of a few bytes that declares many pixels."""
    chunks = (
        (b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(b"")),
        (b"IEND", b""),
    )
    packed = (
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(packed)


@pytest.mark.parametrize(("side", "why"), [(30_000, "limit"), (8_000, "50,000,000"), (9, "damaged")])
def test_a_picture_that_is_too_large_or_damaged_is_named(side: int, why: str) -> None:
    treatments: tuple[ImageTreatment, ...] = ("draw", "trace")
    for treatment in treatments:
        text = SVG.format(f'<image width="9" href="{data_url(bomb(side))}"/><path d="M0 0h9v9z"/>')
        drawing = read(text, images=treatment)
        (note,) = notes(drawing)
        assert (why in note, len(drawing.paths)) == (True, 1)


def test_drawings_in_one_another_end(tmp_path: Path) -> None:
    text = SVG.format('<path d="M0 0h9v9z"/>')
    for _ in range(DEEPEST + 2):
        text = SVG.format(f'<path d="M0 0h9v9z"/><image width="9" href="{data_url(text.encode())}"/>')
    drawing = read(text, images="none")
    assert len(drawing.paths) == DEEPEST + 1
    assert notes(drawing)[0] == f"an embedded image (drawings in it are nested more than {DEEPEST} deep)"
    (tmp_path / "drawing.svg").write_text("")
    itself = read(SVG.format('<image width="9" href="drawing.svg"/><path d="M0 0h9v9z"/>'), tmp_path)
    assert len(itself.paths) == 2
    assert notes(itself) == ["image 'drawing.svg' (an image of another drawing shows no files)"]


def test_very_many_images_are_named() -> None:
    links = (data_url(SVG.format(f'<path d="M0 0h{k}v9z"/>').encode()) for k in range(1, MOST_IMAGES + 2))
    drawing = read(SVG.format("".join(f'<image width="9" href="{link}"/>' for link in links)))
    assert len(drawing.paths) == MOST_IMAGES
    assert notes(drawing)[0] == f"an embedded image (the drawing has more than {MOST_IMAGES} images)"


def test_pictures_have_a_treatment_and_maps_have_none() -> None:
    with pytest.raises(ParameterError, match="`images` 'none' leaves nothing of a picture; leave it out"):
        vexture.read(picture(), images="none")
    with pytest.raises(ParameterError, match="`images` 'trace' is for pictures, and for those in an SVG; leave it out"):
        vexture.read(b'{"type": "Point", "coordinates": [0, 0]}', images="trace")


@pytest.mark.parametrize("command", ["convert", "render", "export"])
def test_commands_leave_pictures_out(command: str, tmp_path: Path) -> None:
    file = tmp_path / "drawing.svg"
    file.write_text(SVG.format(f'<path d="M0 0h9v9z"/><image width="90" href="{data_url(picture())}"/>'))
    out = tmp_path / {"convert": "out.ktx2", "render": "out.png", "export": "out.html"}[command]
    result = CliRunner().invoke(main, [command, str(file), "-o", str(out), "--no-images"])
    assert f"{file}: left out: an embedded PNG of 300 x 200 (pictures are left out)\n" in result.output


@pytest.mark.parametrize("command", ["convert", "render", "export"])
def test_commands_trace_images(command: str, tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(picture())
    file = tmp_path / "drawing.svg"
    file.write_text(SVG.format('<image width="90" href="a.png"/>'))
    out = tmp_path / {"convert": "out.ktx2", "render": "out.png", "export": "out.html"}[command]
    result = CliRunner().invoke(main, [command, str(file), "-o", str(out), "--trace-images"])
    assert result.exit_code == 0, result.output
    assert f"{file}: simplified: <image> traced\n" in result.output
    assert out.exists()
