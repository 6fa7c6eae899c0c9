"""Which renderer draws what: shapes of a texture by name, flat colours stacked, and one line for what does not fit."""

from dataclasses import replace

import numpy as np
import pytest
from hand import need_gpu

import vexture
from vexture.base.errors import ParameterError
from vexture.conversion.images import coverage, render
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.paint import Paint
from vexture.texture.select_root import layers_of, place_of

RED, GLASS = Paint((1.0, 0.0, 0.0)), Paint((0.0, 0.5, 1.0), 0.5)
SIZE = (40, 30)


def square(x: float, y: float, side: float, paint: Paint) -> Path:
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    return replace(Drawing.polygon(corners).paths[0], paint=paint)


def flag(name: str = "flag") -> Drawing:
    """Two panes of glass, which overlap, on red."""
    paths = square(0.0, 0.0, 1.0, RED), square(0.13, 0.1, 0.55, GLASS), square(0.4, 0.37, 0.5, GLASS)
    return Drawing(paths, name=name)


def stacked(drawing: Drawing) -> np.ndarray:
    """Flat colours of a drawing of which each path is a layer, on white."""
    picture = np.ones((*SIZE[::-1], 3))
    for path in drawing.paths:
        alpha = coverage(Drawing((path,)), SIZE, renderer="exact")[..., None] * path.paint.opacity
        picture = alpha * path.paint.color + (1.0 - alpha) * picture
    return picture


def on_white(*arguments: object, **options: object) -> np.ndarray:
    """A picture without its transparency."""
    image = render(*arguments, **options)  # type: ignore[arg-type]
    return image[..., :3] + 1.0 - image[..., 3:]


def test_layers_are_stacked() -> None:
    image = render(flag(), SIZE, renderer="exact")
    assert (image.shape, image.dtype) == ((30, 40, 4), np.float32)
    np.testing.assert_allclose(image[..., :3] + 1.0 - image[..., 3:], stacked(flag()), atol=1e-6)
    np.testing.assert_allclose(on_white(flag(), SIZE, renderer="exact"), stacked(flag()), atol=1e-6)
    assert not render(Drawing(()), SIZE).any()


def test_opacity_is_kept_where_nothing_is_below() -> None:
    image = render(Drawing((square(0.0, 0.0, 1.0, GLASS),)), (2, 2), renderer="exact")
    np.testing.assert_allclose(image, np.broadcast_to((0.0, 0.25, 0.5, 0.5), (2, 2, 4)))


@pytest.mark.parametrize("renderer", ["cpu", "gpu"])
def test_layers_of_a_texture_are_those_of_the_drawing(renderer: str) -> None:
    if renderer == "gpu":
        need_gpu()
    texture = vexture.atlas([flag(), flag("other"), replace(flag(), paths=flag().paths[:1], name="red")], split="paint")
    image = on_white(texture, SIZE, None, renderer, root="other")
    np.testing.assert_allclose(image, stacked(flag()), atol=0.01)
    exact = render(flag(), SIZE, renderer="exact")
    np.testing.assert_allclose(render(flag(), SIZE, None, renderer), exact, atol=0.002)
    one = render(texture, SIZE, None, renderer, root="other/3-#0080ff80")
    alone = Drawing(flag().paths[2:])
    covered = coverage(texture, SIZE, None, renderer, root="other/3-#0080ff80")
    np.testing.assert_allclose(covered, coverage(alone, SIZE, renderer="exact"), atol=0.01)
    np.testing.assert_allclose(one, covered[..., None] * (0.0, 0.25, 0.5, 0.5), atol=1e-6)
    np.testing.assert_array_equal(render(texture, SIZE, None, renderer, root=5), one)
    np.testing.assert_array_equal(coverage(texture, SIZE, None, renderer, root=5), covered)


@pytest.mark.parametrize("renderer", ["cpu", "gpu"])
def test_a_texture_of_one_shape_needs_no_root(renderer: str) -> None:
    if renderer == "gpu":
        need_gpu()
    image = coverage(flag(), SIZE, None, renderer)
    np.testing.assert_allclose(image, coverage(flag(), SIZE, renderer="exact"), atol=0.01)
    texture = vexture.convert(flag(), split=None)
    np.testing.assert_array_equal(coverage(texture, SIZE, None, renderer), image)
    np.testing.assert_array_equal(coverage(texture, SIZE, None, renderer, root="flag"), image)
    np.testing.assert_allclose(on_white(texture, SIZE, None, renderer)[..., 0], 1.0 - image, atol=1e-6)
    np.testing.assert_array_equal(texture.coverage(SIZE, renderer=renderer), image)
    black = render(texture, SIZE, None, renderer)
    np.testing.assert_array_equal(black[..., 3], image)
    assert not black[..., :3].any()
    colours = vexture.convert(Drawing(flag().paths[:1]), split="paint")
    np.testing.assert_allclose(
        on_white(colours, (4, 4), None, renderer), np.broadcast_to((1.0, 0.0, 0.0), (4, 4, 3)), atol=0.01
    )


def test_shapes_are_found_by_name_or_place() -> None:
    texture = vexture.atlas([flag("1"), flag("0")], split=None)
    assert [place_of(texture.roots, root) for root in ("1", "0", 0, 1)] == [0, 1, 0, 1]
    for root, says in (("2", "no shape '2'"), (2, "no shape 2"), (-1, "no shape -1"), ("", "no shape ''")):
        for draw in (coverage, render):
            with pytest.raises(ParameterError, match=says):
                draw(texture, SIZE, root=root)


def test_a_missing_root_means_the_whole_or_the_only_shape() -> None:
    texture = vexture.atlas([flag("1"), flag("0")], split=None)
    for draw in (texture.coverage, texture.plot, texture.root, texture.contains):
        with pytest.raises(ParameterError, match=r"atlas holds 2 shapes \(1, 0\); choose one by `root`"):
            draw(*{texture.coverage: (SIZE,), texture.contains: ([(0.5, 0.5)],)}.get(draw, ()))
    many = vexture.atlas([flag(str(number)) for number in range(20)], split=None)
    with pytest.raises(ParameterError, match=r"20 drawings \(0, 1, 2, 3, 4, 5 and 14 more\); choose one"):
        render(many, SIZE)
    assert many.to_svg().count("<path") == 20
    assert many.info()["roots"][19]["name"] == "19"


def test_layers_are_found_by_their_drawing() -> None:
    texture = vexture.atlas([flag("a/b"), Drawing((), name="none"), flag("c")], split="paint")
    assert layers_of(texture.roots, "a/b") == [0, 1, 2]
    assert layers_of(texture.roots, "none") == [3]
    assert layers_of(texture.roots, "c") == [4, 5, 6]
    with pytest.raises(ParameterError, match=r"3 drawings \(a/b, none, c\); choose one"):
        render(texture, SIZE)
    with pytest.raises(ParameterError, match="no shape 'a'; the first of 7 are 'a/b/1-"):
        render(texture, SIZE, root="a")
    assert layers_of(vexture.convert(flag(), split="paint").roots, None) == [0, 1, 2]


@pytest.mark.parametrize(
    ("encoding", "options", "says"),
    [
        (None, {"renderer": "raytracer"}, "must be one of 'exact', 'cpu', 'gpu'"),
        (None, {"root": "flag"}, "leave it out for a drawing"),
        ("packed", {"renderer": "exact"}, "which renders drawings"),
        ("thesis", {"renderer": "exact"}, "which renders drawings"),
        ("thesis", {"root": 1}, "is a texture of one shape"),
        ("thesis", {"root": "other"}, "is a texture of one shape"),
        ("packed", {"renderer": "vulkan"}, "must be one of 'exact', 'cpu', 'gpu'"),
    ],
)
@pytest.mark.parametrize("draw", [coverage, render])
def test_options_that_do_not_fit_get_one_line(draw: object, encoding: str | None, options: dict, says: str) -> None:
    shown = flag() if encoding is None else vexture.convert(flag(), encoding=encoding)
    with pytest.raises(ParameterError, match=says) as caught:
        draw(shown, SIZE, **options)  # type: ignore[operator]
    assert "\n" not in str(caught.value)


def test_a_thesis_texture_goes_by_its_name() -> None:
    texture = vexture.convert(flag(), encoding="thesis")
    expected = coverage(texture, SIZE, renderer="cpu")
    for root in ("flag", 0):
        np.testing.assert_array_equal(coverage(texture, SIZE, renderer="cpu", root=root), expected)
    np.testing.assert_array_equal(render(texture, SIZE, renderer="cpu")[..., 3], expected)


def test_what_is_neither_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="ndarray is neither a drawing nor a texture"):
        coverage(np.zeros((2, 2)), 4)  # type: ignore[arg-type]


def test_a_square_image_has_one_size() -> None:
    np.testing.assert_array_equal(coverage(flag(), 20), coverage(flag(), (20, 20)))
    view = vexture.window(0.25, 0.25, 0.5, 0.5, rotate=30)
    np.testing.assert_array_equal(coverage(flag(), 20, view), coverage(flag(), 20, view.matrix((20, 20))))
