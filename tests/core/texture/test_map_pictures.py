"""Pictures of planar maps in textures: written, read back, looked up, and refused where they are damaged."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_maps import faces

import vexture
from degenerate import circle
from gradient_drawings import DRAWINGS, SQUARE, WARM, linear, painted_path
from picture_drawings import DISC, PICTURES, fitted, pictured_path, random_picture, random_pixels
from planar import colours_at
from vexture.base import layout
from vexture.base.errors import FormatError, SourceError
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import atlas, run
from vexture.drawing.drawing import Drawing
from vexture.drawing.group import Group, Mask
from vexture.drawing.paint import Paint
from vexture.drawing.picture import Picture, Sampling
from vexture.texture.load import texture_from
from vexture.texture.pick import paints_at
from vexture.texture.planar import decode_map, map_texels
from vexture.texture.texture import Texture
from vexture.tree.planar.programs import Keep, Mix, Solid

FOLLOWS = layout.KIND_FOLLOWS << layout.KIND_SHIFT


def level_of(pixels: np.ndarray, level: int) -> np.ndarray:
    """Means of blocks of pixels, rounded, by slices."""
    step = 1 << level
    rows, columns = (-(-side // step) for side in pixels.shape[:2])
    out = np.zeros((rows, columns, 4), np.uint8)
    for j in range(rows):
        for i in range(columns):
            block = pixels[j * step : (j + 1) * step, i * step : (i + 1) * step]
            out[j, i] = np.floor(block.mean(axis=(0, 1), dtype=np.float64) + 0.5)
    return out


def test_texels_of_a_picture_are_as_specified() -> None:
    rng = np.random.default_rng(3)
    pixels = random_pixels(rng, 5, 11)
    picture = Picture(((2.0, 0.5, -0.25), (0.125, -3.0, 4.0)), pixels, Sampling.LINEAR, 0.75)
    texture = vexture.convert(Drawing((pictured_path(SQUARE, picture),)))
    assert texture.version == "3"
    programs, operations, stops, count = texture.flat[texture.roots[0].quad - 2].tolist()
    texels = texture.flat[programs : programs + operations]
    assert (operations, stops) == (3, 0)
    assert texels[0].tolist() == [round(0.75 * 65535), 11 | 5 << 16, 3, 1]
    np.testing.assert_array_equal(texels[1:, :3].copy().view(np.float32), np.float32(picture.to_pixels))
    assert (texels[1:, 3] == FOLLOWS).all()
    at = programs + operations
    for level in range(5):
        wanted = level_of(pixels, level)
        across, down = (wanted.shape[1] + 1) // 2, (wanted.shape[0] + 1) // 2
        padded = np.zeros((2 * down, 2 * across, 4), np.uint8)
        padded[: wanted.shape[0], : wanted.shape[1]] = wanted
        for j, i in np.ndindex(down, across):
            tile = padded[2 * j : 2 * j + 2, 2 * i : 2 * i + 2].reshape(4, 4).copy()
            assert texture.flat[at + j * across + i].tolist() == tile.view("<u4").ravel().tolist()
        at += across * down
    assert at == programs + operations + count


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_read_back(name: str) -> None:
    texture = faces(PICTURES[name])
    data = texture.to_ktx2()
    again = texture_from(data, "again")
    assert again.version == texture.version == "3"
    np.testing.assert_array_equal(again.texels, texture.texels)
    planar = decode_map(again.flat, again.roots[0].quad)
    np.testing.assert_array_equal(map_texels(planar, 0), again.flat[: len(map_texels(planar, 0))])
    pictures = [one for program in planar.programs.values() for one in program if isinstance(one, Picture)]
    assert pictures
    for one in pictures:
        assert any(
            (one.pixels == path.paint.picture.pixels).all()
            for path in PICTURES[name].paths
            if path.paint.picture is not None and path.paint.picture.pixels.shape == one.pixels.shape
        )


def run_program(program: tuple, point: tuple[float, float]) -> np.ndarray:
    """Colour of a program without groups but masks."""
    colour, kept = np.zeros(4), []
    for one in program:
        if isinstance(one, Keep):
            kept.append(colour)
            colour = np.zeros(4)
        elif isinstance(one, Mix):
            share = colour[3] if one.how is Mask.OPACITY else colour[:3] @ (0.2125, 0.7154, 0.0721)
            assert isinstance(one.how, Mask)
            colour = kept.pop() * share * one.opacity / 65535
        else:
            above = np.array(one.rgba) / 65535 if isinstance(one, Solid) else np.array(one.color_at(*point))
            colour = above + (1 - above[3]) * colour
    return colour


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_random_pictures_have_their_colours(seed: int) -> None:
    """Small pictures under any map, over one another and a colour, and in masks."""
    rng = np.random.default_rng(seed)
    ways = (SQUARE, DISC, circle(tuple(rng.uniform(0.3, 0.7, 2)), 0.25))
    is_masked = bool(rng.integers(2))
    groups = (Group(), Group(0, mask=Mask(int(rng.integers(1, 3))))) if is_masked else ()
    paths = [painted_path(SQUARE, Paint(tuple(rng.random(3)), 0.7), 0 if is_masked else -1)]
    paths += [pictured_path(ways[k], random_picture(rng), 0 if is_masked else -1) for k in range(2)]
    if is_masked:
        paths.insert(int(rng.integers(2)) * len(paths), pictured_path(ways[2], random_picture(rng), 1))
    of = Drawing(tuple(paths), groups=groups)
    texture = texture_from(faces(of).to_ktx2(), "it")
    planar, points = decode_map(texture.flat, texture.roots[0].quad), rng.random((40, 2))
    wanted, distance = colours_at(of, points)
    paints = np.empty(len(points), np.int64)
    paints_at(texture.flat, texture.roots[0].quad, points, paints)
    for point, paint, colour, away in zip(points.tolist(), paints.tolist(), wanted, distance, strict=True):
        near_pixel = any(
            one.sampling is Sampling.PIXELS
            and min(abs(part - round(part)) for part in np.array(one.to_pixels) @ (*point, 1)) < 1e-4
            for path in of.paths
            if (one := path.paint.picture) is not None
        )
        if away > 1e-3 and paint >= 0 and not near_pixel:
            found = run_program(planar.programs[paint], tuple(point)) if paint in planar.programs else None
            found = planar.paints[paint] / 65535 if found is None else found
            np.testing.assert_allclose(found, colour, atol=2e-4)


def test_equal_pixels_are_stored_once() -> None:
    rng = np.random.default_rng(5)
    pixels = random_pixels(rng, 20, 20)
    copies = [fitted(pixels.copy(), Sampling(k % 2), 0.1 * k) for k in range(4)]
    paths = [pictured_path(circle((0.2 + 0.2 * k, 0.5), 0.08), one) for k, one in enumerate(copies)]
    texture = faces(Drawing(tuple(paths)))
    _, operations, _, count = texture.flat[0].tolist()
    assert (operations, count) == (12, 100 + 25 + 9 + 4 + 1 + 1)


def test_maps_with_and_without_pictures_share_a_file() -> None:
    both = atlas([replace(PICTURES["photo"], name="photo"), DRAWINGS["groups"]], split="faces")
    again = texture_from(both.to_ktx2(), "both")
    assert again.version == "3"
    np.testing.assert_array_equal(again.texels, both.texels)


def test_a_picture_is_a_map_with_or_without_a_choice() -> None:
    of = PICTURES["photo"]
    assert of.is_coloured
    assert vexture.convert(of).roots[0].is_map
    assert [layer.paths[0].paint.picture for layer in of.layers()] == [None]
    notes = [note.message for note in of.layers()[0].notes]
    assert notes == ["picture shown as its mean colour"]


def test_colours_that_can_be_changed_are_flat() -> None:
    conversion = run(PICTURES["photo"], Parameters("faces", restyle=True))
    assert conversion.texture.version == "2"
    messages = [note.message for note in conversion.notes]
    assert "picture, of its mean colour, as colours that can be changed are flat" in messages


def test_pictures_in_too_many_groups_are_flat_and_noted() -> None:
    groups = tuple(Group(k - 1, 0.9) for k in range(5))
    photo = PICTURES["photo"].paths[0].paint.picture
    ramp = painted_path(SQUARE, linear((0, 0), (1, 1), WARM))
    paths = tuple(pictured_path(DISC, photo.after(((1, 0, 0.1 * k), (0, 1, 0))), k - 1) for k in range(6))
    conversion = run(Drawing((ramp, *paths), groups=groups), Parameters("faces"))
    assert any("mean colours" in note.message for note in conversion.notes)


@pytest.mark.parametrize(
    ("part", "at", "word", "value", "message"),
    [
        ("head", 0, 3, 0, "pixels elsewhere|belongs to no root"),
        ("head", 0, 3, 1, "pixels elsewhere"),
        ("head", 0, 3, 1 << 31, "end at texel"),
        ("programs", 0, 0, 65536, "opacity or sampling"),
        ("programs", 0, 1, 0, "without pixels"),
        ("programs", 0, 1, 9, "without pixels"),
        ("programs", 0, 1, 7 << 16, "without pixels"),
        ("programs", 0, 1, 16385 | 1 << 16, "more than 16384"),
        ("programs", 0, 1, 9 | 9 << 16, "pixels elsewhere"),
        ("programs", 0, 2, 0, "pixels elsewhere"),
        ("programs", 0, 2, 2, "pixels elsewhere"),
        ("programs", 0, 2, (1 << 32) - 1, "pixels elsewhere"),
        ("programs", 0, 3, 5, "opacity or sampling"),
        ("programs", 1, 3, 0, "wrong length"),
        ("programs", 1, 0, 0x7F800000, "not finite"),
        ("programs", 2, 2, 0x7FC00000, "not finite"),
        ("programs", 2, 3, FOLLOWS | 1, "a word that is not 0"),
        ("pixels", 3, 1, 0x01020000, "a colour above its opacity"),
        ("pixels", -1, 0, 0x000000FF, "a colour above its opacity"),
    ],
)
def test_damaged_pictures_are_refused(part: str, at: int, word: int, value: int, message: str) -> None:
    texture = faces(PICTURES["photo"])
    texture.check()
    flat = texture.flat.copy()
    programs, operations, stops, count = flat[0].tolist()
    first = {"head": 0, "programs": programs, "pixels": programs + operations + stops}[part]
    flat[first + (at if at >= 0 else count + at), word] = value
    with pytest.raises(FormatError, match=message) as caught:
        Texture(flat.reshape(texture.texels.shape), texture.roots).check()
    assert "\n" not in str(caught.value)


def test_pictures_that_overlap_are_refused() -> None:
    texture = faces(PICTURES["tiles"])
    flat = texture.flat.copy()
    programs, operations, _, _ = flat[0].tolist()
    texels = flat[programs : programs + operations]
    first, second = np.flatnonzero((texels[:, 3] >> layout.KIND_SHIFT == 0) & (texels[:, 1] > 0))[:2]
    texels[second, 1], texels[second, 2] = texels[first, 1] - 1, texels[first, 2] + first - second
    with pytest.raises(FormatError, match="overlap"):
        Texture(flat.reshape(texture.texels.shape), texture.roots).check()


@pytest.mark.parametrize(("name", "version"), [("photo", b"2"), ("gradient", b"3")])
def test_a_file_of_the_other_version_is_refused(name: str, version: bytes) -> None:
    of = PICTURES["photo"] if name == "photo" else DRAWINGS["overlay"]
    data = faces(of).to_ktx2()
    key = b"vexture.version\0"
    at = data.index(key) + len(key)
    damaged = data[:at] + version + data[at + 1 :]
    with pytest.raises(FormatError, match=r"vexture\.version is") as caught:
        texture_from(damaged, "it")
    assert "\n" not in str(caught.value)


def test_a_picture_that_is_too_small_is_refused() -> None:
    picture = Picture(((1e30, 0, 0), (0, 1, 0)), random_pixels(np.random.default_rng(1), 2, 2))
    with pytest.raises(SourceError, match=r"has the number 1e\+30; the limit is 1\.64e\+13; make the picture larger"):
        vexture.convert(Drawing((pictured_path(SQUARE, picture),)))


@pytest.mark.parametrize("sampling", [Sampling.PIXELS, Sampling.LINEAR])
def test_a_texture_contains_what_its_pictures_paint(sampling: Sampling) -> None:
    rng = np.random.default_rng(7)
    pixels = random_pixels(rng, 12, 12)
    pixels[rng.random((12, 12)) < 0.7] = 0
    picture = fitted(pixels, sampling)
    texture, points = vexture.convert(Drawing((pictured_path(SQUARE, picture),))), rng.random((200, 2))
    ways = np.array([(0, 0), (0.003, 0), (-0.003, 0), (0, 0.003), (0, -0.003)])
    around = points[:, None] + ways
    painted = np.array([[picture.color_at(*place)[3] > 0.0 for place in places] for places in around.tolist()])
    clear = (painted == painted[:, :1]).all(axis=1)  # renderers see a tiny box about a point
    wanted = painted[clear, 0]
    assert 20 < wanted.sum() < len(wanted) - 20
    np.testing.assert_array_equal(texture.contains(points)[clear], wanted)
