"""Pictures in an SVG, and files of pictures, as pages read and convert them, beside Python's."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from PIL import Image
from svg_drawings import MOST_OFF, served_reader, share_off, to_drawing
from svg_pictures import PLACED, SVG, blocks, file_of, link_of, read, slope

NOISE = np.random.default_rng(3).integers(0, 256, (9, 12, 4)).astype(np.uint8)
IMAGE = '<image href="{}" x="10" y="20" width="80" height="60"/>'
FORMATS = {
    "PNG": file_of(NOISE),
    "GIF": file_of(Image.fromarray(blocks()).convert("P"), "GIF"),
    "BMP": file_of(slope(30, 20), "BMP"),
    "WebP": file_of(NOISE[..., :3].copy(), "WEBP", lossless=True),
    "JPEG": file_of(slope(30, 20), "JPEG", quality=95, subsampling=0),
}
NESTED = f'<svg xmlns="http://www.w3.org/2000/svg" width="60" height="40">{IMAGE.format(link_of(file_of(NOISE)))}</svg>'

Read = Callable[[str], dict[str, Any]]


@pytest.fixture(scope="module")
def read_in_page(chromium: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Read]:
    """Read a text in a page."""
    with served_reader(tmp_path_factory.mktemp("pictures")) as (url, _):
        page = chromium.new_page()
        page.goto(url)
        page.wait_for_function("window.readText")
        yield lambda text: page.evaluate("text => readText(text, 'drawing')", text)
        page.close()


def test_pictures_are_placed_as_in_python(read_in_page: Read) -> None:
    cases = {**PLACED, **{kind: IMAGE.format(link_of(content)) for kind, content in FORMATS.items()}}
    cases["in a drawing"] = f'<image href="{link_of(NESTED.encode(), "image/svg+xml")}" width="90" height="60"/>'
    found = {}
    for case, body in cases.items():
        # browsers that do not know optimizeSpeed compute no value for it
        text = SVG.format(body.replace("optimizeSpeed", "pixelated"))
        value = read_in_page(text)
        off = 1.0 if "error" in value else share_off(read(text), to_drawing(value))
        if off >= MOST_OFF or value["notes"]:
            found[case] = (off, value.get("error"), value.get("notes"))
    assert found == {}


def test_large_pictures_are_halved_as_in_python(read_in_page: Read) -> None:
    content = file_of(Image.effect_noise((1500, 1001), 40).convert("RGB"))
    text = SVG.format(IMAGE.format(link_of(content)))
    ours, value = read(text), read_in_page(text)
    picture = ours.paths[0].paint.picture
    theirs = to_drawing(value).paths[0].paint.picture
    assert picture is not None
    assert theirs is not None
    assert picture.pixels.shape == theirs.pixels.shape == (501, 750, 4)
    assert np.abs(picture.pixels.astype(int) - theirs.pixels).max() <= 1
    np.testing.assert_allclose(theirs.to_pixels, picture.to_pixels, rtol=1e-9, atol=1e-9)
    assert [note["message"] for note in value["notes"]] == [note.message for note in ours.notes]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (file_of(NOISE)[:60], "an embedded PNG of 12 x 9 (it is damaged)"),
        (b"GIF89a", "an embedded image (it is no SVG, PNG, JPEG, WebP, GIF or BMP)"),
        (file_of(NOISE).replace(b"\0\0\0\x0c\0\0\0\x09", b"\0\0\xff\xff\0\0\xff\xff"), "more than 100,000,000 pixels"),
        (b"", "an embedded image (it is empty)"),
    ],
    ids=["damaged", "half of a head", "bomb", "empty"],
)
def test_what_cannot_be_decoded_is_noted(read_in_page: Read, content: bytes, message: str) -> None:
    value = read_in_page(SVG.format(IMAGE.format(link_of(content))))
    assert [note["kind"] for note in value["notes"]][:1] == ["left out"]
    assert message in value["notes"][0]["message"]
