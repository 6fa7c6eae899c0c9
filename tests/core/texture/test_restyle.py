"""Planar maps to be restyled: new colours without a new tree, and the element at a point."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

import vexture
from degenerate import circle, drawing, heap, path_windings, polygon
from planar import colour_paths
from vexture.base.errors import ParameterError
from vexture.base.layout import COVERAGE_ONE
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import atlas, run
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.group import Blend, Group
from vexture.drawing.paint import Gradient, Paint, Stop
from vexture.renderers.exact import render_exact_colours
from vexture.texture.load import texture_from
from vexture.texture.planar import decode_map
from vexture.texture.restyle import renew_means, restyle_texels
from vexture.tree.planar import sheets

CLEAR = 3e-5  # unit-square units; beyond them rounding moves no outline
RED, GREEN = Paint((1.0, 0.0, 0.0)), Paint((0.0, 1.0, 0.0), 0.5)
SQUARE = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])


def named(of: Drawing, rng) -> Drawing:
    """A drawing whose paths have names, some of them shared, some none."""
    names = rng.choice(["", *"abcdefgh"], len(of.paths)).tolist()
    paths = zip(of.paths, names, strict=True)
    return replace(of, paths=tuple(replace(path, element=name) for path, name in paths))


def sample(seed: int) -> Drawing:
    rng = np.random.default_rng(seed)
    paths = drawing(seed).paths + drawing(seed + 100).paths
    if seed % 2:
        paths += heap(seed, [1, 2, 1], 1e-9, FillRule(seed // 2 % 2)).paths
    return named(colour_paths(Drawing(paths), rng), rng)


def faces(of: Drawing, restyle: bool = True) -> vexture.Texture:
    return run(of, Parameters("faces", restyle=restyle)).texture


def recoloured(of: Drawing, paints) -> Drawing:
    return replace(of, paths=tuple(replace(p, paint=paints.get(p.element, p.paint)) for p in of.paths))


def new_paints(texture: vexture.Texture, rng) -> dict[str, Paint]:
    """Random paints for about half of the names, opaque where something is hidden."""
    style = texture.roots[0].style
    hiding = {name for name, hides in zip(style.names, style.hides, strict=True) if hides}
    opacity = {name: 1.0 if name in hiding else float(rng.choice([0.0, 0.4, 1.0])) for name in style.names}
    return {name: Paint(tuple(rng.random(3).round(3).tolist()), a) for name, a in opacity.items() if name}


@pytest.mark.parametrize("seed", range(10))
def test_new_colours_are_those_of_the_drawing_in_new_colours(seed: int) -> None:
    of, rng = sample(seed), np.random.default_rng(seed)
    texture = faces(of)
    paints = new_paints(texture, rng)
    changed, wanted = texture.with_paints(paints), recoloured(of, paints)
    changed.check()
    fresh = faces(wanted)
    for size in (16, 61):
        assert 255 * abs(changed.render(size) - render_exact_colours(wanted, size)).max() < 1.5
        assert 255 * abs(changed.render(size) - fresh.render(size)).max() < 1.5
    means = [decode_map(each.flat, each.roots[0].quad).mean[0] for each in (changed, fresh)]
    np.testing.assert_allclose(*means, atol=1.01 / COVERAGE_ONE)


@pytest.mark.parametrize("seed", range(6))
def test_the_same_colours_are_the_same_bytes(seed: int) -> None:
    of = sample(seed)
    unique = replace(of, paths=tuple(replace(path, element=f"p{k}") for k, path in enumerate(of.paths)))
    texture = faces(unique)
    again = texture.with_paints({path.element: path.paint for path in unique.paths})
    assert again.to_ktx2() == texture.to_ktx2()


@pytest.mark.parametrize("seed", range(4))
def test_means_are_renewed_as_they_were_built(seed: int) -> None:
    texture = faces(sample(seed))
    quad = texture.roots[0].quad
    planar, flat = decode_map(texture.flat, quad), texture.flat.copy()
    used, cells, _, _ = flat[quad - 1].tolist()
    assert used == len(planar.paints)
    means = cells + 1 + np.arange(len(planar.count)) + np.arange(len(planar.count)) // 4
    flat[means] = np.where(planar.is_mean, flat[means], 0)
    renew_means(flat, quad, cells, planar.paints / 65535.0)
    np.testing.assert_allclose(decode_map(flat, quad).mean, planar.mean, atol=1.01 / COVERAGE_ONE)


def checkerboard(n: int, colours) -> Drawing:
    lines = np.linspace(0, 1, n + 1)
    return Drawing(
        tuple(
            Path((polygon([(x, y), (u, y), (u, v), (x, v)]),), paint=colours(i, j), element=f"{i}-{j}")
            for j, (y, v) in enumerate(pairwise(lines))
            for i, (x, u) in enumerate(pairwise(lines))
        )
    )


def test_a_map_costs_what_it_costs_in_different_colours_and_neighbours_keep_their_border() -> None:
    different, alike = checkerboard(7, lambda i, j: Paint((i / 6, j / 6, 0.0))), checkerboard(7, lambda i, j: RED)
    static, same = faces(different, restyle=False), faces(alike)
    assert len(faces(different).flat) == len(static.flat)
    assert same.info()["roots"][0]["curves"] == static.info()["roots"][0]["curves"]
    painted = same.with_paints({path.element: path.paint for path in different.paths})
    np.testing.assert_allclose(painted.render(20), static.render(20), atol=2e-5)


def test_what_an_opaque_element_hides_is_not_there() -> None:
    lid = Path((polygon([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]),), paint=RED, element="lid")
    beside = Path((polygon([(0.5, 0), (1, 0), (1, 1), (0.5, 1)]),), paint=RED, element="beside")
    low = Path((circle((0.25, 0.5), 0.2),), element="low")
    texture = faces(Drawing((low, lid, beside)))
    with pytest.raises(ParameterError, match=r"'lid' gets the opacity 0\.5, but the texture does not have"):
        texture.with_paints({"lid": (1, 0, 0, 0.5)})
    assert texture.with_paints({"beside": None, "lid": "blue"}).render(2)[0].tolist() == [[0, 0, 1, 1], [0, 0, 0, 0]]


def test_groups_are_composited_again() -> None:
    groups = (Group(opacity=0.5), Group(0, 0.8, Blend.MULTIPLY))
    of = Drawing(
        tuple(
            Path((circle((0.3 + 0.1 * k, 0.5), 0.25),), paint=RED, group=group, element=f"{k}")
            for k, group in enumerate((-1, 0, 1, 0))
        ),
        groups=groups,
    )
    paints = {"0": GREEN, "2": Paint((0.2, 0.4, 1.0)), "3": Paint((0.0, 1.0, 1.0), 0.3)}
    texture = texture_from(faces(of).to_ktx2(), "again")
    assert texture.roots[0].style.groups == groups
    wanted = render_exact_colours(recoloured(of, paints), 32)
    np.testing.assert_allclose(texture.with_paints(paints).render(32), wanted, atol=1.5 / 255)


def test_sheets_of_one_drawing_are_restyled_together(monkeypatch) -> None:
    monkeypatch.setattr(sheets, "LEAST_BUDGET", 0)
    rng = np.random.default_rng(1)
    centres = rng.random((12, 2)) * 0.6 + 0.2
    discs = [Path((circle(centre, 0.2),), paint=GREEN, element=f"d{k}") for k, centre in enumerate(centres)]
    of = Drawing(tuple(discs), name="discs")
    conversion = run(of, Parameters("faces", restyle=True))
    texture = conversion.texture
    assert len(texture.roots) > 1
    assert str(conversion.notes[0]).startswith(f"so many crossing shapes are {len(texture.roots)} maps on one another")
    assert all(root.is_map for root in texture.roots)
    paints = {f"d{k}": Paint((k / 12, 0.5, 0.0), 0.5) for k in range(0, 12, 2)}
    wanted = recoloured(of, paints)
    np.testing.assert_allclose(  # the two may be cut into sheets at other places
        texture.with_paints(paints).render(20), faces(wanted, restyle=False).render(20), atol=5e-3
    )
    points = rng.random((200, 2))
    windings, distance = path_windings(of, points)
    top = [max(np.flatnonzero(inside), default=-1) for inside in (np.array(windings) != 0).T]
    clear = distance > CLEAR
    assert (texture.element_at(points).name == np.array([*(p.element for p in discs), ""])[top])[clear].all()


def test_a_gradient_becomes_its_mean_and_a_note_says_so() -> None:
    shade = Paint.from_gradient(Gradient(((1, 0, 0), (0, 1, 0)), (Stop(0, (1, 0, 0)), Stop(1, (0, 0, 1)))))
    of = Drawing((Path((SQUARE,), paint=shade, element="a"), Path((circle((0.5, 0.5), 0.2),), element="b")))
    with pytest.warns(vexture.base.errors.SourceWarning, match="gradient, of its mean colour"):
        texture = vexture.convert(of, split="faces", restyle=True)
    np.testing.assert_allclose(texture.render(8)[0, 0], [0.5, 0, 0.5, 1], atol=1e-4)


def two() -> vexture.Texture:
    paths = (Path((SQUARE,), paint=RED, element="alpha"), Path((circle((0.5, 0.5), 0.2),), element="beta"))
    return faces(Drawing(paths, name="two"))


@pytest.mark.parametrize(
    ("paints", "message"),
    [
        ({"alpa": "red"}, "two: no element 'alpa'; near names are 'alpha'; there are 2"),
        ({"": "red"}, "two: no element ''; near names are 'alpha', 'beta'; there are 2"),
        ({"beta": "reddish"}, "the colour of 'beta' is 'reddish'; give a CSS colour of sRGB, three or four numbers in"),
        ({"beta": "device-cmyk(0 1 1 0)"}, "the colour of 'beta' is 'device-cmyk(0 1 1 0)'; give a CSS colour of sRGB"),
        ({"beta": (1, 2, 0)}, "the colour of 'beta' is "),
        ({"beta": (1, float("nan"), 0)}, "the colour of 'beta' is "),
        ({"beta": (1, "a", 0)}, "the colour of 'beta' is "),
        ({"beta": 7}, "the colour of 'beta' is '7'"),
    ],
)
def test_wrong_names_and_colours_are_refused_in_a_line(paints, message: str) -> None:
    with pytest.raises(ParameterError) as error:
        two().with_paints(paints)
    assert str(error.value).startswith(message)
    assert "\n" not in str(error.value)


COLOURS = ["#00ff00", "lime", (0, 1, 0), [0.0, 1.0, 0.0, 1.0], np.array([0, 1, 0]), Paint((0.0, 1.0, 0.0))]


@pytest.mark.parametrize("colour", COLOURS)
def test_a_colour_is_given_in_several_ways(colour) -> None:
    assert two().with_paints({"alpha": colour}).render(8)[0, 0].tolist() == [0, 1, 0, 1]


def test_only_maps_to_be_restyled_have_elements() -> None:
    of = Drawing((Path((SQUARE,), paint=RED), Path((circle((0.5, 0.5), 0.2),))), name="plain")
    for texture in (faces(of, restyle=False), vexture.convert(of)):
        with pytest.raises(ParameterError, match="`root` 'plain' has no elements; convert the drawing with `restyle`"):
            texture.with_paints({})
        with pytest.raises(ParameterError, match="has no elements"):
            texture.element_at([(0.5, 0.5)])
    with pytest.raises(ParameterError, match="`split` is 'paint', but `restyle` is for a whole drawing in its colours"):
        vexture.convert(of, split="paint", restyle=True)
    with pytest.warns(
        vexture.base.errors.SourceWarning, match="plain: no element has a name, so none can get another colour"
    ):
        assert vexture.convert(of, restyle=True).roots[0].style is not None
    with pytest.raises(ParameterError, match=r"`points` has the shape \(2,\)"):
        two().element_at((0.5, 0.5))


def test_shapes_of_an_atlas_are_restyled_by_name() -> None:
    one = Drawing((Path((SQUARE,), paint=RED, element="a"),), name="one")
    texture = atlas([one, replace(one, name="other")], split="faces", restyle=True)
    changed = texture.with_paints({"a": "blue"}, root="other")
    assert changed.render(1, root="one")[0, 0].tolist() == [1, 0, 0, 1]
    assert changed.render(1, root="other")[0, 0].tolist() == [0, 0, 1, 1]
    assert changed.element_at([(0.5, 0.5)], root="other").root.tolist() == [1]
    assert changed.info()["roots"][1]["elements"] == ["a"]
    with pytest.raises(ParameterError, match="choose one by `root`"):
        texture.with_paints({"a": "blue"})


def test_two_roots_of_one_map_are_restyled_together() -> None:
    texture = faces(Drawing((Path((SQUARE,), paint=RED, element="a"),), name="one"))
    twin = replace(texture.roots[0], name="two")
    _, roots = restyle_texels(texture.flat, (*texture.roots, twin), [0], {"a": "blue"}, "both")
    assert [root.style.rgba.tolist() for root in roots] == [[[0, 0, 1, 1]]] * 2


@pytest.mark.parametrize("colours", ["red", {0: "red"}, None])
def test_colours_that_are_no_mapping_of_names_get_one_line(colours) -> None:
    with pytest.raises(ParameterError, match="no mapping of elements' names"):
        two().with_paints(colours)
