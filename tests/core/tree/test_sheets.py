"""The sheets of a drawing of many layers: about as many layers to a sheet as fit, found by few tries."""

from collections import namedtuple

import numpy as np
import pytest

from degenerate import polygon
from vexture.conversion.parameters import Parameters
from vexture.conversion.pipeline import run
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group
from vexture.drawing.paint import Paint
from vexture.renderers.exact import render_exact_colours
from vexture.tree.planar.sheets import Sheet, _greedy

Grown = namedtuple("Grown", "texels")


def sheets(count, share, texels):
    """Numbers of items of the sheets, and how many were tried, where so many items need `texels` of their number."""
    tries = []

    def tried(first, last):
        size = last - first
        tries.append(size)
        fits = size == 1 or texels(size) <= share * size
        return Sheet(Drawing((), name=str(size)), Grown(texels(size))) if fits else None

    return [int(sheet.drawing.name) for sheet in _greedy(count, share, tried)], len(tries)


@pytest.mark.parametrize("largest", [1, 5, 8, 57, 100, 900])
def test_sheets_hold_all_items_and_nearly_as_many_as_fit(largest):
    found, _ = sheets(1000, largest, lambda size: size * size)
    assert sum(found) == 1000
    assert max(found) <= largest
    assert min(found[:-1]) >= 0.79 * largest


def test_the_search_begins_at_the_sheet_below():
    found, tries = sheets(5000, 50, lambda size: size * size)
    assert tries <= 3 * len(found), "each sheet was searched for from one item on"


def test_items_that_do_not_fit_are_sheets_by_themselves():
    assert sheets(7, 1, lambda size: 9 * size)[0] == [1] * 7


def test_many_layers_are_cut_into_sheets(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vexture.tree.planar.sheets.LEAST_BUDGET", 10_000)
    rng = np.random.default_rng(0)
    bars = []
    for k in range(30):
        x, y = 0.02 + 0.031 * k, 0.96 * rng.random()
        bars += [polygon([(x, 0), (x + 0.004, 0), (x + 0.02, 1), (x + 0.016, 1)])]
        bars += [polygon([(0, y), (1, 0.98 - y), (1, 0.985 - y), (0, y + 0.005)])]
    of = Drawing(tuple(Path((bar,), paint=Paint(tuple(rng.random(3).tolist()), 0.6)) for bar in bars))
    conversion = run(of, Parameters("faces"))
    roots = conversion.texture.roots
    assert 1 < len(roots) < 8
    assert [root.name for root in roots] == [f"drawing/{k}-faces" for k in range(1, len(roots) + 1)]
    wanted = render_exact_colours(of, 40)
    in_layers = run(of, Parameters("paint")).texture.render(40)
    assert abs(conversion.texture.render(40) - wanted).mean() < abs(in_layers - wanted).mean()


def test_precision_alone_cuts_no_drawing(monkeypatch: pytest.MonkeyPatch) -> None:
    """A cut between two that touch is a seam, which would show from nearby."""
    monkeypatch.setattr("vexture.tree.planar.sheets.LEAST_BUDGET", 200)
    halves = [polygon([(0.1, 0.1), (0.6, 0.1), (0.4, 0.9), (0.1, 0.9)]), polygon([(0.6, 0.1), (0.9, 0.5), (0.4, 0.9)])]
    of = Drawing(tuple(Path((half,), paint=Paint((0.2, 0.4, k / 2))) for k, half in enumerate(halves)))
    near = run(of, Parameters("faces", precision=1e-6))
    assert len(near.texture.roots) == 1
    assert len(near.tree.count) > 200
    assert near.rounding == 1e-6


def test_what_blends_is_not_cut_from_what_is_below() -> None:
    from vexture.tree.planar.sheets import _items

    square = polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    paths = [Path((square,), group=group) for group in (-1, -1, 0, 0, -1, 1, 2, -1)]
    groups = (Group(-1, 0.5), Group(-1, 1.0, Blend.MULTIPLY), Group(1))
    assert [len(item) for item in _items(Drawing(tuple(paths), groups=groups))] == [7, 1]
    assert [len(item) for item in _items(Drawing(tuple(paths[:5]), groups=groups))] == [1, 1, 2, 1]
