"""Pictures of the tree and its lists show every quad and every curve, at its depth, up to a number that is said."""

import numpy as np
import pytest
from fitting import assert_legible, written
from matplotlib.collections import PolyCollection

import vexture
from vexture.drawing.drawing import Drawing
from vexture_evidence.figures.lists import counts, hierarchy, lists
from vexture_evidence.measures.leaves import leaves, quads
from vexture_evidence.measures.shape import example

pytestmark = pytest.mark.slow  # test_report_is_whole draws these figures too

ENCODINGS = ("packed", "thesis")


def comb(teeth):
    """A shape of many cells."""
    return Drawing.polygon([*((k / teeth, 0.4 if k % 2 else 0.6) for k in range(teeth + 1)), (1.0, 0.0), (0.0, 0.0)])


def squares(axes):
    return sum(len(each.get_paths()) for each in axes.collections if isinstance(each, PolyCollection))


def words(axes, figure):
    return [text.get_text() for text, _ in written(figure) if text.axes is axes]


def test_counts_are_those_of_section_3_4():
    square = Drawing.polygon([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])
    found = counts(vexture.convert(square, encoding="thesis"))
    assert found.cells == 4 * found.quads + found.curves
    assert found.grid == round(leaves(vexture.convert(square, encoding="thesis")).side.min() ** -2)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_lists_hold_every_quad_and_curve_with_its_coverage(encoding):
    texture = vexture.convert(example("duck"), encoding=encoding)
    found, above = leaves(texture), quads(texture)
    figure = lists(texture)
    assert [squares(axes) for axes in figure.axes] == [
        4 * len(above.x), len(found.curves), len(above.x), len(found.curves),
    ]  # fmt: skip
    shown = words(figure.axes[2], figure)
    order = np.argsort(above.depth, kind="stable")
    assert [word for word in shown if word.isdigit()] == [f"{100 * value:.0f}" for value in above.coverage[order]]
    assert {f"depth {depth}" for depth in above.depth} <= set(words(figure.axes[0], figure))
    assert_legible(figure)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_what_does_not_fit_is_counted(encoding):
    texture = vexture.convert(comb(150), encoding=encoding)
    figure = lists(texture)
    assert_legible(figure)
    more = [word for word in words(figure.axes[1], figure) if word.startswith("+")]
    assert squares(figure.axes[1]) + sum(int(word.replace(",", "")) for word in more) == len(leaves(texture).curves)
    figure = hierarchy(texture)
    assert_legible(figure)
    more = [word for word in words(figure.axes[1], figure) if word.startswith("+")]
    assert squares(figure.axes[1]) / 4 + sum(int(word.replace(",", "")) for word in more) == len(quads(texture).x)


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("name", ["duck", "empty"])
def test_hierarchy_hangs_every_quad_below_its_cell(encoding, name):
    texture = vexture.convert(Drawing(()) if name == "empty" else example(name), encoding=encoding)
    figure = hierarchy(texture)
    tree = figure.axes[1]
    assert squares(tree) == 4 * len(quads(texture).x)
    links = [line for line in tree.lines if len(line.get_xdata()) == 2]
    assert len(links) == len(quads(texture).x) - 1
    assert all(line.get_ydata()[1] > line.get_ydata()[0] for line in links)
    for level in {line.get_ydata()[1] for line in links}:  # lines cross within one quad at most
        ends = sorted(tuple(line.get_xdata()[::-1]) for line in links if line.get_ydata()[1] == level)
        starts = [start for _, start in ends]
        assert (np.diff(starts) >= -0.5).all()
    assert_legible(figure)
