"""The command `render`."""

import numpy as np
import pytest
from PIL import Image
from test_cli import SQUARE, run


@pytest.fixture
def square(tmp_path):
    file = tmp_path / "square.svg"
    file.write_text(SQUARE)
    return file


@pytest.mark.parametrize("stem", ["square", "square.quads.png", "square.curves.png"])
def test_render_takes_either_file_or_the_stem(square, tmp_path, stem):
    run("convert", square, "-o", tmp_path, "--encoding", "thesis")
    picture = tmp_path / "picture.png"
    result = run("render", tmp_path / stem, "-o", picture, "--size", 20, "--renderer", "cpu")
    assert (result.exit_code, result.output) == (0, "")
    image = np.asarray(Image.open(picture))
    assert image.shape == (20, 20, 3)
    assert (image[8:10, 8:10] == 0).all()  # black inside
    assert (image[0] == 255).all()  # white outside


def test_view_and_rotation(square, tmp_path):
    picture = tmp_path / "picture.png"
    # the square spans x 0.2..0.8 and, y up, 0.3..0.8; this view shows its lower left corner in its middle
    arguments = ("--size", 40, "--renderer", "exact", "--view", "0.1,0.2,0.2,0.2")
    assert run("render", square, "-o", picture, *arguments).exit_code == 0
    image = np.asarray(Image.open(picture))
    assert (image[10, 30] == 0).all()
    assert (image[[10, 30, 30], [10, 10, 30]] == 255).all()
    run("render", square, "-o", picture, *arguments, "--rotate", 90)
    turned = np.asarray(Image.open(picture))
    assert (turned == np.rot90(image)).all()  # counter-clockwise, as NumPy turns
    run("render", square, "-o", picture, "--size", 40, "--renderer", "exact", "--view", "0,0,1,0.5")
    assert np.asarray(Image.open(picture)).shape == (20, 40, 3)


def test_exact_renderer_needs_the_drawing(square, tmp_path):
    run("convert", square, "-o", tmp_path)
    result = run("render", tmp_path / "square.ktx2", "-o", tmp_path / "x.png", "--renderer", "exact")
    assert result.exit_code == 1
    assert "drawing" in result.output
