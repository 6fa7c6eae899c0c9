"""GIF that declares more than it has: screens, frames, codes."""

import struct

import pytest
from PIL import Image

import vexture
from vexture.base.errors import VextureError


def gif(size, *frames):
    """A GIF of a size and frames of sizes, none of which has the pixels that it declares."""
    nothing = b"\x02\x02\x44\x01\0"
    parts = (b"\x2c" + struct.pack("<HHHHB", 0, 0, *frame, 0) + nothing for frame in frames)
    return b"GIF89a" + struct.pack("<HHBBB", *size, 0x80, 0, 0) + b"\0\0\0\xff\0\0" + b"".join(parts) + b";"


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (gif((65535, 65535), (1, 1)), "more than 50,000,000 pixels"),
        (gif((4, 4), (65535, 65535)), "more than 50,000,000 pixels"),
        (gif((7000, 7000), (7000, 7000)), "damaged picture"),
        (gif((9, 9), *[(9, 9)] * 50_000), "damaged picture"),
        (gif((9, 9), (9, 9)).replace(b"\x02\x02\x44", b"\x02\xff" + bytes(range(255))), "damaged picture"),
        (gif((0, 0), (0, 0)), "damaged picture"),
    ],
    ids=["screen", "frame", "promised", "frames", "codes", "nothing"],
)
def test_bombs_of_gif_are_one_line(content, says):
    with pytest.raises(VextureError, match=rf"^a\.gif: .*{says}.*$"):
        vexture.read_image(content, "a.gif")


def test_frames_of_a_gif_after_the_first_cost_nothing(tmp_path):
    """A thousand of 49 million pixels each."""
    picture = Image.new("RGB", (9, 9), "red")
    picture.putpixel((4, 4), (0, 0, 255))
    picture.save(tmp_path / "a.gif")
    content = (tmp_path / "a.gif").read_bytes()[:-1] + gif((9, 9), *[(7000, 7000)] * 1000)[19:]
    assert vexture.read_image(content, "a.gif").name == "a"
