"""Planar maps in textures: files, validation, pictures."""

import numpy as np
import pytest

import vexture
from degenerate import circle, drawing, polygon
from gradient_drawings import DRAWINGS, painted_path
from planar import colour_paths, colours_at, widen_paints
from vexture.base import layout
from vexture.base.errors import FormatError, ParameterError
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import atlas, run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.texture.encode import encode
from vexture.texture.load import texture_from
from vexture.texture.planar import decode_map, map_texels
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.planar.build import build_map

RED, BLUE = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.0, 1.0), 0.5)


def sample(seed: int) -> Drawing:
    return colour_paths(Drawing(drawing(seed).paths + drawing(seed + 100).paths), np.random.default_rng(seed))


def faces(of: Drawing) -> Texture:
    return run(of, Parameters("faces")).texture


def turned(size: int) -> list[list[float]]:
    """Pixels that are six times as long as wide, turned by 45 degrees."""
    long, short = 2.5 / size / 2**0.5, 0.4 / size / 2**0.5
    return [[long, -short, 0.5 - size * (long - short) / 2], [long, short, 0.5 - size * (long + short) / 2]]


@pytest.mark.parametrize("seed", range(12))
def test_pixels_are_exact(seed: int) -> None:
    of = sample(seed)
    texture = faces(of)
    for size, view in (
        (16, None),
        (20, None),
        (61, None),
        (100, None),
        (24, vexture.window(0, 0, 1, 1, 30)),
        (24, turned(24)),
    ):
        error = 255 * abs(texture.render(size, view) - render_exact_colours(of, size, view))
        assert error.max() < 1.5, (size, view)
        assert error.mean() < 0.03


@pytest.mark.parametrize("side", [15, 17])
def test_numbers_of_paints_take_one_byte_or_two(side: int) -> None:
    """Squares in so many colours, and nothing around them: 226 and 290 paints."""
    places = [(x, y) for x in range(side) for y in range(side)]
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    squares = [polygon((corners + place) / (side + 1)) for place in places]
    colours = np.random.default_rng(side).random((len(places), 3)).tolist()
    of = Drawing(tuple(Path((square,), paint=Paint(tuple(c))) for square, c in zip(squares, colours, strict=True)))
    planar, texture = build_map(of, tolerance=0.0), faces(of)
    again = decode_map(map_texels(planar, 0), layout.MAP_HEAD)
    assert len(again.paints) == side * side + 1
    assert (np.sort(again.sides, axis=0) == np.sort(planar.sides, axis=0)).all()
    truth = render_exact_colours(of, 61)
    for renderer in ("cpu", "gpu"):
        assert abs(texture.render(61, renderer=renderer) - truth).max() < 1.5 / 255
    points = (np.array(places) + 0.5) / (side + 1)
    assert texture.contains(points).all()
    assert not texture.contains([(0.999, 0.5)]).any()


def test_a_file_reads_back() -> None:
    texture = faces(sample(3))
    again = texture_from(texture.to_ktx2(), "again")
    assert (again.texels == texture.texels).all()
    assert again.version == layout.MAP_VERSION
    assert again.roots[0].is_map
    planar = decode_map(again.flat, again.roots[0].quad)
    np.testing.assert_array_equal(map_texels(planar, 0), again.flat[: len(map_texels(planar, 0))])


def test_silhouettes_and_maps_share_an_atlas() -> None:
    both = Drawing(
        (Path((circle((0.5, 0.5), 0.4),), paint=RED), Path((circle((0.6, 0.5), 0.2),), paint=BLUE)), name="both"
    )
    plain = Drawing((Path((circle((0.5, 0.5), 0.3),), paint=RED),), name="plain")
    texture = texture_from(atlas([both, plain, both.layers()[0]], split="faces").to_ktx2(), "atlas")
    assert [(root.name, root.is_map) for root in texture.roots] == [
        ("both", True),
        ("plain/1-#ff0000", False),
        ("both/1-#ff0000/1-#ff0000", False),
    ]
    for of in (both, plain):
        np.testing.assert_allclose(texture.render(20, root=of.name), render_exact_colours(of, 20), atol=0.003)
    assert texture.info()["roots"][0]["map"]
    np.testing.assert_array_equal(texture.coverage(9, root=0), texture.render(9, root=0)[..., 3])


def test_a_silhouette_keeps_version_1() -> None:
    texture = vexture.convert(sample(3), split=None)
    assert texture.version == layout.PACKED_VERSION
    assert "map" not in texture.texts()[layout.TEXT_ROOTS]


@pytest.mark.parametrize("name", DRAWINGS)
def test_a_map_contains_what_it_paints(name: str) -> None:
    points = np.random.default_rng(3).uniform(-0.1, 1.1, (400, 2))
    colours, distance = colours_at(DRAWINGS[name], points)
    within = ((points >= 0.0) & (points < 1.0)).all(axis=1)
    sure = (distance > 1e-3) & ((colours[:, 3] == 0) | (colours[:, 3] > 1e-4))
    np.testing.assert_array_equal(faces(DRAWINGS[name]).contains(points)[sure], (within & (colours[:, 3] > 0))[sure])


def test_a_cell_of_which_the_mean_is_known_contains_what_it_paints() -> None:
    lines = [polygon([(0.01, y), (0.45, 0.5 - y), (0.45, 0.502 - y)]) for y in np.linspace(0.05, 0.4, 90)]
    planar = build_map(
        Drawing(tuple(painted_path(line, Paint((k % 2, 0, 0), 0.5)) for k, line in enumerate(lines))), max_depth=2
    )
    assert planar.is_mean.any()
    texture = encode([planar], [Root("lines")], name="lines")
    np.testing.assert_array_equal(texture.contains([(0.2, 0.2), (0.7, 0.7)]), [True, False])


def test_numbers_of_paints_take_four_bytes() -> None:
    """Those of more paints than 16 bits can tell apart: all pictures are as those of few."""
    of = sample(5)
    few = faces(of)
    many = widen_paints(few)
    for renderer in ("cpu", "gpu"):
        assert (few.render(61, turned(61), renderer=renderer) == many.render(61, turned(61), renderer=renderer)).all()
    points = np.random.default_rng(0).random((500, 2))
    assert (few.contains(points) == many.contains(points)).all()
    one, other = (decode_map(texture.flat, texture.roots[0].quad) for texture in (few, many))
    assert len(other.paints) == len(one.paints) + layout.MOST_HALF_PAINTS
    assert ((other.sides > 0) == (one.sides > 0)).all()


@pytest.mark.parametrize("ask", [lambda t: t.to_svg(), lambda t: t.plot()])
def test_a_map_has_no_outlines(ask) -> None:
    with pytest.raises(ParameterError, match="is a planar map, without outlines; convert it with `split` None"):
        ask(faces(sample(3)))


def test_a_drawing_without_paths_is_empty() -> None:
    texture = faces(Drawing(()))
    assert not texture.render(4).any()


@pytest.mark.parametrize(
    ("part", "word", "value", "message"),
    [
        ("programs", 3, 1, "a head that is not 0"),
        ("programs", 0, 1, "a head that is not 0"),
        ("head", 0, 0, "has 0 paints; the limit is 16777216"),
        ("head", 0, 1 << 25, "has 33554432 paints; the limit is 16777216"),
        ("head", 0, 1 << 16, "end at texel"),
        ("head", 0, 2, "has paint . of 2"),
        ("head", 1, 1 << 31, "end at texel"),
        ("head", 1, 1, "two things|opacity|paint"),
        ("head", 2, 1 << 31, "end at texel"),
        ("head", 2, 1, "two things|paint"),
        ("head", 3, 1 << 31, "end at texel"),
        ("head", 3, 1, "two things|opacity|gaps"),
        ("quad", 2, 0x01, "no valid cell"),
        ("quad", 3, 1, "curves out of number"),
        ("quad", 2, 0x03, "no valid cell"),
        ("means", 0, 0x00FF0000, "above its opacity"),
        ("bases", 0, 0xFFFFFFFF, "has paint|base paint"),
        ("sides", 0, 0xFF000000, "has paint"),
        ("paints", 1, 0x0000FFFF, "above its opacity"),
        ("paints", 0, 0x0000FFFF, "gaps"),
    ],
)
def test_damaged_maps_are_refused(part: str, word: int, value: int, message: str) -> None:
    texture = faces(sample(3))
    flat = texture.flat.copy()
    head = flat[1].tolist()
    at = {
        "programs": 0,
        "head": 1,
        "quad": 2,
        "bases": head[1],
        "means": head[1] + 1,
        "sides": head[2],
        "paints": head[3],
    }[part]
    flat[at, word] = value
    damaged = Texture(flat.reshape(texture.texels.shape), texture.roots)
    with pytest.raises(FormatError, match=message):
        damaged.check()


@pytest.mark.parametrize("seed", range(80))
def test_random_damage_is_refused_or_drawn(seed: int) -> None:
    """No picture of a texture that passes the check, or of one that was never checked, leaves 0..1 or hangs."""
    rng = np.random.default_rng(seed)
    texture = faces(sample(seed % 5) if seed < 40 else [*DRAWINGS.values()][seed % len(DRAWINGS)])
    flat = texture.flat.copy()
    for _ in range(rng.integers(1, 4)):
        flat[rng.integers(len(flat)), rng.integers(4)] ^= np.uint32(1 << rng.integers(32))
    damaged = Texture(flat.reshape(texture.texels.shape), texture.roots)
    picture = damaged.render(8)
    assert ((picture >= 0.0) & (picture <= 1.0)).all()
    assert (picture[..., :3] <= picture[..., 3:]).all()
