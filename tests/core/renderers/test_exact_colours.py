"""The exact renderer's colours: by hand, by Skia and resvg, and by faces along very many scanlines."""

from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
import resvg
from exact_references import colours_of_row, convex_coverage
from exact_shapes import circle, circles, degenerate_drawings, scribble
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import vexture
from vexture.base.errors import ParameterError
from vexture.base.tolerance import FLATNESS
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact, render_exact_colours
from vexture.renderers.view import fit, window

LEVEL = 1 / 255
PROMISE = 0.03 * LEVEL
RED, GREEN, BLUE, WHITE = (Paint(colour) for colour in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0,) * 3))
PIXEL = (1, 1)


def box(x0, y0, x1, y1, paint, group=-1):
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return replace(Drawing.polygon(corners).paths[0], paint=paint, group=group)


def full(paint, group=-1):
    return box(0.0, 0.0, 1.0, 1.0, paint, group)


def glass(paint, opacity=0.5):
    return replace(paint, opacity=opacity)


def colour_of(*paths, groups=()):
    """Of a drawing that fills one pixel."""
    return render_exact_colours(Drawing(paths, groups=groups), PIXEL)[0, 0].tolist()


def max_difference(a, b):
    return float(np.abs(np.asarray(a, np.float64) - b).max())


def to_pixel(view):
    return np.linalg.inv(view)[:2]


# ---- by hand


def test_nothing_shines_through_where_two_paths_touch():
    halves = box(0.0, 0.0, 0.25, 1.0, RED), box(0.25, 0.0, 1.0, 1.0, BLUE)
    assert colour_of(*halves) == [0.25, 0.0, 0.75, 1.0]
    assert colour_of(full(GREEN), *halves) == [0.25, 0.0, 0.75, 1.0]
    turned = render_exact_colours(Drawing((full(GREEN), *halves)), (31, 31), window(0.3, 0.3, 0.1, 0.1, rotate=33))
    assert turned[..., 1].max() == 0.0
    assert turned[..., 3].min() > 1.0 - 1e-6
    picture = vexture.render(Drawing((full(GREEN), *halves)), 7, renderer="exact")
    assert picture[..., 1].max() == 0.0


def test_diagonal_of_a_pixel():
    lower = replace(Drawing.polygon([(0, 0), (1, 0), (0, 1)]).paths[0], paint=RED)
    upper = replace(Drawing.polygon([(1, 1), (0, 1), (1, 0)]).paths[0], paint=glass(BLUE))
    assert colour_of(lower, upper) == [0.5, 0.0, 0.25, 0.75]


def test_translucent_paints_are_laid_over_one_another():
    assert colour_of(full(glass(RED))) == [0.5, 0.0, 0.0, 0.5]
    assert colour_of(full(RED), full(glass(BLUE, 0.25))) == [0.75, 0.0, 0.25, 1.0]
    # a quarter of the pixel has both: red 1/2, blue 1/2 over it; the rest of it is of one or the other
    assert colour_of(box(0.0, 0.0, 0.5, 1.0, glass(RED)), box(0.0, 0.0, 1.0, 0.5, glass(BLUE))) == [
        0.25 * 0.5 + 0.25 * 0.25,
        0.0,
        0.25,
        0.25 * (0.5 + 0.75 + 0.5),
    ]
    assert colour_of(full(RED), full(Paint(opacity=0.0))) == [1.0, 0.0, 0.0, 1.0]


def test_a_group_is_composited_by_itself():
    both = full(RED, 0), full(BLUE, 0)
    assert colour_of(*both, groups=(Group(opacity=0.5),)) == [0.0, 0.0, 0.5, 0.5]
    assert colour_of(full(WHITE), *both, groups=(Group(opacity=0.5),)) == [0.5, 0.5, 1.0, 1.0]
    # multiplied with what is below in its own group, where nothing is
    assert colour_of(full(WHITE), full(RED, 1), groups=(Group(), Group(0, blend=Blend.MULTIPLY))) == [
        1.0,
        0.0,
        0.0,
        1.0,
    ]
    assert colour_of(full(GREEN), full(RED, 0), groups=(Group(blend=Blend.MULTIPLY),)) == [0.0, 0.0, 0.0, 1.0]


def test_groups_nest_end_and_begin():
    """Half green; on it half of (red under half of blue); on it a quarter of white."""
    groups = Group(opacity=0.5), Group(0, 0.5), Group(), Group(2, 0.25)
    paths = full(glass(GREEN)), full(RED, 0), full(BLUE, 1), full(WHITE, 3)
    under = np.array([0.0, 0.5, 0.0, 0.5])
    middle = 0.5 * np.array([0.5, 0.0, 0.5, 1.0])
    expected = 0.25 * np.ones(4) + 0.75 * (middle + 0.5 * under)
    assert colour_of(*paths, groups=groups) == pytest.approx(expected)
    assert colour_of(*paths[:2], full(BLUE, 0), full(WHITE), groups=groups) == [1.0, 1.0, 1.0, 1.0]


# ---- another library


def test_resvg_agrees_but_for_edges():
    """Nested groups, written as SVG; resvg has 8 bits and no `plus-lighter`, and composites the coverages of edges."""
    size, groups = 200, tuple(replace(g, blend=g.blend % Blend.PLUS_LIGHTER) for g in crowd().groups)
    drawing = replace(crowd(), groups=groups)
    tree = resvg.usvg.Tree.from_str(svg_of(drawing, size), resvg.usvg.Options.default())
    theirs = np.asarray(Image.open(BytesIO(bytes(resvg.render(tree, (1, 0, 0, 0, 1, 0))))).convert("RGBA")) / 255
    theirs[..., :3] *= theirs[..., 3:]
    off = np.abs(render_exact_colours(drawing, size) - theirs).max(axis=2)
    assert np.median(off) < 1.5 * LEVEL
    assert (off > 3 * LEVEL).mean() < 0.04


def svg_of(drawing, size):
    """The drawing as SVG, a `g` for each group."""
    lines, inside = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}">'], []
    for path in (*drawing.paths, Path(())):
        around = drawing.around(path.group)
        while inside != around[: len(inside)]:
            inside.pop()
            lines.append("</g>")
        for place in around[len(inside) :]:
            group = drawing.groups[place]
            mode = Blend(group.blend).name.lower().replace("_", "-")
            lines.append(f'<g style="isolation:isolate;opacity:{group.opacity};mix-blend-mode:{mode}">')
        inside = around
        curves = [contour * (size, -size) + (0, size) for contour in path.contours]
        parts = [
            "".join(["M{} {}".format(*c[0, 0]), *("C{} {} {} {} {} {}".format(*p[1:].ravel()) for p in c)])
            for c in curves
        ]
        rule, paint = path.fill_rule.name.lower(), path.paint
        fill = "rgb({}%,{}%,{}%)".format(*(100 * c for c in paint.color))
        lines.append(f'<path d="{"".join(parts)}" fill-rule="{rule}" fill="{fill}" fill-opacity="{paint.opacity}"/>')
    return "".join([*lines, "</svg>"])


# ---- faces along very many scanlines, and refinement


shares = st.one_of(st.sampled_from([0.0, 0.5, 1.0]), st.floats(0.0, 1.0))


@st.composite
def painted_drawings(draw):
    """Degenerate drawings in flat colours, in groups that nest."""
    groups, paths, inner = [], [], -1
    for path in draw(degenerate_drawings()).paths:
        while inner >= 0 and draw(st.booleans()):
            inner = groups[inner].outer
        while len(groups) < 4 and draw(st.booleans()):
            mask = draw(st.sampled_from(Mask)) if inner >= 0 else Mask.NONE
            groups.append(Group(inner, draw(shares), draw(st.sampled_from(Blend)), mask))
            inner = len(groups) - 1
        paint = Paint((draw(shares), draw(shares), draw(shares)), draw(shares))
        paths.append(replace(path, paint=paint, group=inner))
    return Drawing(tuple(paths), groups=tuple(groups))


@given(painted_drawings(), st.integers(0, 2**32))
@settings(deadline=None, max_examples=20)
def test_degenerate_drawings_agree_with_exact_scanlines(drawing, seed):
    rng = np.random.default_rng(seed)
    size = (7, 5)
    turned = window(*rng.uniform(0, 0.4, 2), *rng.uniform(0.3, 1, 2), rng.uniform(0, 360)).matrix(size)
    view = fit(size) if rng.random() < 0.5 else turned
    image = render_exact_colours(drawing, size, view)
    row = int(rng.integers(size[1]))
    assert max_difference(image[row], colours_of_row(drawing, to_pixel(view), size[0], row)) < PROMISE
    assert max_difference(image, render_exact_colours(drawing, size, view, flatness=FLATNESS / 2)) < PROMISE


def crowd(paths=12):
    """Scribbles and circles of both rules, in random paints, nested groups and all blend modes."""
    rng = np.random.default_rng(5)
    outlines = [(scribble(rng, 5),) if k % 4 == 0 else tuple(circles(rng, 2, 0.13)) for k in range(paths)]
    groups = [Group(k - 1 if k % 3 else -1, rng.uniform(0.3, 1.0), Blend(k % len(Blend))) for k in range(2 * paths)]
    places = [2 * k if k % 3 else -1 for k in range(paths)]
    return Drawing(
        tuple(
            Path(outline, FillRule(k % 2), Paint(tuple(rng.uniform(0, 1, 3)), rng.uniform(0.3, 1.0)), place)
            for k, (outline, place) in enumerate(zip(outlines, places, strict=True))
        ),
        groups=tuple(groups),
    )


def test_a_crowd_agrees_with_exact_scanlines():
    size = 23
    view = window(0.01, 0.02, 0.95, 0.96, rotate=17.0).matrix((size, size))
    image = render_exact_colours(crowd(), (size, size), view)
    row = size // 2
    assert max_difference(image[row], colours_of_row(crowd(), to_pixel(view), size, row)) < PROMISE


def test_flatness_is_what_limits_the_error():
    shape = Drawing((full(WHITE), Path((circle(),), paint=RED), Path((circle(0.4),), paint=glass(BLUE))))
    fine = render_exact_colours(shape, 100, flatness=FLATNESS / 100)
    errors = [max_difference(render_exact_colours(shape, 100, flatness=f), fine) for f in (1e-1, 1e-2, 1e-3, FLATNESS)]
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 0.03
    assert errors[3] < PROMISE / 4
    halved = render_exact_colours(crowd(), 40, flatness=FLATNESS / 2)
    assert max_difference(render_exact_colours(crowd(), 40), halved) < PROMISE / 3


def test_a_larger_image_averages_to_the_smaller_one():
    large = render_exact_colours(crowd(), 160).astype(np.float64)
    mean = large.reshape(40, 4, 40, 4, 4).mean(axis=(1, 3))
    assert max_difference(mean, render_exact_colours(crowd(), 40)) < PROMISE / 3


# ---- the silhouette


def test_alpha_of_opaque_paints_is_the_coverage_of_the_silhouette():
    paths = tuple(replace(path, paint=replace(path.paint, opacity=1.0), group=-1) for path in crowd().paths)
    image, covered = render_exact_colours(Drawing(paths), 50), render_exact(crowd(), 50)
    assert max_difference(image[..., 3], covered) < 1e-6
    black = Drawing(tuple(replace(path, paint=Paint()) for path in paths))
    assert max_difference(render_exact_colours(black, 50), covered[..., None] * (0, 0, 0, 1)) < 1e-6


@pytest.mark.parametrize(
    "nothing", [Drawing(()), Drawing((Path(()),)), Drawing((full(RED, 0),), groups=(Group(-1, 0),))]
)
def test_nothing_is_painted(nothing):
    image = render_exact_colours(nothing, (5, 4))
    assert (image.shape, image.dtype) == ((4, 5, 4), np.float32)
    assert not image.any()


# ---- views


def fan():
    """The unit square as triangles around a point, in the colours of a random map."""
    rng = np.random.default_rng(2)
    corners = np.array([(0, 0), (0.6, 0), (1, 0), (1, 0.7), (1, 1), (0.3, 1), (0, 1), (0, 0.4)], float)
    sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
    return [(np.array([(0.45, 0.55), *side]), Paint(tuple(rng.uniform(0, 1, 3)))) for side in sides]


def test_projective_view_of_a_map():
    view = np.array([[0.11, 0.01, 0.05], [0.005, -0.1, 0.95], [0.003, 0.05, 0.8]])
    expected = np.zeros((9, 12, 4))
    for corners, paint in fan():
        seen = np.column_stack([corners, np.ones(3)]) @ np.linalg.inv(view).T
        expected += convex_coverage(seen[:, :2] / seen[:, 2:], (12, 9))[..., None] * (*paint.color, 1.0)
    paths = tuple(replace(Drawing.polygon(corners).paths[0], paint=paint) for corners, paint in fan())
    assert 10 < expected[..., 3].sum() < 108
    assert max_difference(render_exact_colours(Drawing(paths), (12, 9), view), expected) < 1e-6


def test_from_far_away_a_drawing_is_its_mean_colour():
    mean = render_exact_colours(crowd(), 64).mean(axis=(0, 1), dtype=np.float64)
    for pixels in (1, 50, 1000):  # as wide as so many drawings
        low = 0.5 - 0.5 * pixels
        view = window(low, low, pixels, pixels)
        image = render_exact_colours(crowd(), PIXEL, view, flatness=FLATNESS / pixels)
        assert max_difference(image[0, 0] * pixels**2, mean) < PROMISE


def test_deep_zoom_sees_three_faces_that_meet():
    corners, paints = zip(*fan()[:3], strict=True)
    paths = tuple(replace(Drawing.polygon(c).paths[0], paint=p) for c, p in zip(corners, paints, strict=True))
    pixel = 1e-6
    view = window(0.45 - 3.2 * pixel, 0.55 - 2.9 * pixel, 6 * pixel, 6 * pixel).matrix((6, 6))
    expected = np.zeros((6, 6, 4))
    matrix = to_pixel(view)
    for triangle, paint in zip(corners, paints, strict=True):
        near = triangle[0] + (triangle - triangle[0]) * 1e-4
        expected += convex_coverage(near @ matrix[:, :2].T + matrix[:, 2], (6, 6))[..., None] * (*paint.color, 1.0)
    assert max_difference(render_exact_colours(Drawing(paths), (6, 6), view), expected) < 1e-6


def test_bad_flatness():
    with pytest.raises(ParameterError, match="flatness"):
        render_exact_colours(crowd(), 4, flatness=0)
