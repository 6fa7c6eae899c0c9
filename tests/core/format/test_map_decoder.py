"""Part D of FORMAT.md says all that a decoder needs: one that was written from it alone draws every map."""

import re
from dataclasses import replace
from pathlib import Path

import map_decoder
import numpy as np
import picture_decoder
import pytest

import vexture
from degenerate import drawing, points_near
from gradient_drawings import DRAWINGS, SQUARE, blend_drawing, painted_path
from picture_drawings import PICTURES
from planar import colour_paths, colours_at
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import atlas, run
from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Blend
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture
from vexture.renderers.exact import render_exact_colours
from vexture.texture.load import texture_from

REPOSITORY = Path(__file__).parents[3]
SIZE = 32
PIXELS = np.array([[(255, 0, 0, 255), (0, 0, 128, 128)]], np.uint8)


def sample(seed: int) -> Drawing:
    return colour_paths(Drawing(drawing(seed).paths + drawing(seed + 100).paths), np.random.default_rng(seed))


@pytest.mark.parametrize("seed", [3, 7, 8, 12])
def test_it_draws_random_drawings(seed: int) -> None:
    of = sample(seed)
    _, _, (planar,) = map_decoder.read_maps(run(of, Parameters("faces")).texture.to_ktx2())
    error = abs(map_decoder.map_picture(planar, SIZE, 8) - render_exact_colours(of, SIZE))
    assert error.mean() < 0.004  # 64 points of a pixel through which an outline goes are off by 0.02 at random
    assert error.max() < 0.15


@pytest.mark.parametrize("of", [*DRAWINGS.values(), *map(blend_drawing, Blend)])
def test_it_runs_programs(of: Drawing) -> None:
    data = run(of, Parameters("faces")).texture.to_ktx2()
    _, _, (planar,) = map_decoder.read_maps(data)
    pixels = texture_from(data, "it").render(8, vexture.window(0.3, 0.3, 1e-3, 1e-3))
    middles = (np.arange(8) + 0.5) / 8000 + 0.3
    wanted = map_decoder.color_at(planar, *(axis.ravel() for axis in np.meshgrid(middles, middles[::-1])))
    np.testing.assert_allclose(pixels.reshape(-1, 4), wanted, atol=0.01)


@pytest.mark.parametrize("name", PICTURES)
def test_it_shows_pictures(name: str) -> None:
    of, points = PICTURES[name], np.random.default_rng(1).random((200, 2))
    _, _, (planar,) = map_decoder.read_maps(run(of, Parameters("faces")).texture.to_ktx2())
    wanted, distance = colours_at(of, points)
    found = map_decoder.color_at(planar, *points.T)
    is_close = (abs(found - wanted) < 2e-4).all(axis=1)
    assert is_close[distance > 1e-3].mean() > 0.98  # the others are beside a border of pixels


def test_levels_are_means() -> None:
    _, _, (planar,) = map_decoder.read_maps(run(PICTURES["photo"], Parameters("faces")).texture.to_ktx2())
    pixels = PICTURES["photo"].paths[0].paint.picture.pixels
    levels, _ = picture_decoder.read_levels(planar.pixels, (pixels.shape[1], pixels.shape[0]))
    assert [level.shape[:2] for level in levels] == [(7, 9), (4, 5), (2, 3), (1, 2), (1, 1)]
    np.testing.assert_array_equal(levels[0], pixels)
    for k, level in enumerate(levels):
        for j, i in np.ndindex(level.shape[:2]):
            block = pixels[j << k : j + 1 << k, i << k : i + 1 << k].reshape(-1, 4)
            assert level[j, i].tolist() == np.floor(block.mean(axis=0) + 0.5).tolist()


@pytest.mark.parametrize("seed", [3, 7])
def test_every_point_has_one_paint(seed: int) -> None:
    of = sample(seed)
    _, _, (planar,) = map_decoder.read_maps(run(of, Parameters("faces")).texture.to_ktx2())
    x, y = points_near(of, np.random.default_rng(1), 2000).T
    assert (map_decoder.paint_at(planar, x, y) >= 0).mean() > 0.995  # the others lie in slivers


def test_it_reads_maps_beside_shapes() -> None:
    plain = vexture.Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    roots, shapes, maps = map_decoder.read_maps(atlas([sample(3), plain], split="faces", name="both").to_ktx2())
    assert [one is None for one in maps] == [False, True]
    assert [root["name"] for root in roots] == ["drawing", "drawing/1-#000000"]
    assert len(shapes.roots) == 1


def test_stacks_say_what_paints_are_made_of() -> None:
    of = sample(3)
    paths = (replace(path, group=-1, element=f"p{k}") for k, path in enumerate(of.paths))
    texture = run(Drawing(tuple(paths)), Parameters("faces", restyle=True)).texture
    (root,), _, (planar,) = map_decoder.read_maps(texture.to_ktx2())
    elements, stacks = map_decoder.read_style(root, planar)
    colors = [map_decoder.composite(elements, stack) for stack in stacks]
    np.testing.assert_allclose(colors, planar.paints, atol=2e-5)
    points = points_near(of, np.random.default_rng(1), 500)
    paints = map_decoder.paint_at(planar, *points.T)
    names = np.array([*(elements[stack[-1]]["name"] if stack else "" for stack in stacks), ""])
    assert (names[paints] == texture.element_at(points).name)[paints >= 0].all()


def test_the_example_is_what_it_says() -> None:
    part = (REPOSITORY / "FORMAT.md").read_text(encoding="utf-8").split("### D.9 Example")[1].split("### D.10")[0]
    rows = re.findall(r"^\| \d+ \|((?: [0-9a-f]{8} \|){4})", part, re.M)
    words = np.array([[int(word, 16) for word in row.split("|")[:4]] for row in rows])
    planar, used = map_decoder.read_map(words, 2)
    assert sorted(used.tolist()) == list(range(13))
    assert planar.curves[1, 1].tolist() == [16384, 16384]
    assert planar.curves[7, 2].tolist() == [1, 24576]
    assert map_decoder.paint_at(planar, np.array([0.7, 0.3, 0.05]), np.array([0.7, 0.3, 0.5])).tolist() == [2, 1, 0]


def test_the_example_of_a_picture_is_what_it_says() -> None:
    part = (REPOSITORY / "FORMAT.md").read_text(encoding="utf-8").split("### D.6 Programs")[1].split("### D.7")[0]
    part = part.split("a picture of two pixels")[1].split("another example")[0]
    rows = re.findall(r"^\| (\d+) \|((?: [0-9a-f]{8} \|){4})", part, re.M)
    assert [number for number, _ in rows] == ["20", "21", "22", "23", "24"]
    words = np.array([[int(word, 16) for word in row.split("|")[:4]] for _, row in rows])
    program = map_decoder.read_programs(words, 0, [3, 0, 2], {1: [0, 3]})
    ((kind, texels, first),) = program[1]
    assert (kind, first) == (0, 0)
    x, y = np.array([0.1, 0.5, 0.9]), np.array([0.5, 0.2, 0.7])
    found = picture_decoder.picture_color(texels, words[3 + first :], x, y)
    half = 128 / 255
    wanted = [(1, 0, 0, 1), (0.5, 0, half / 2, (1 + half) / 2), (0, 0, half, half)]
    np.testing.assert_allclose(found, wanted)
    levels, _ = picture_decoder.read_levels(words[3:], (2, 1))
    assert levels[1].tolist() == [[[128, 0, 64, 192]]]
    drawing = Drawing((painted_path(SQUARE, Paint.from_picture(Picture(((2, 0, 0), (0, -1, 1)), PIXELS))),))
    flat = run(drawing, Parameters("faces")).texture.flat
    programs, operations, _, count = flat[0].tolist()
    np.testing.assert_array_equal(flat[programs : programs + operations + count], words)
