"""The element at a point of a planar map."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from test_restyle import faces, sample

from degenerate import path_windings, points_near
from vexture.drawing.drawing import Drawing, FillRule
from vexture.texture.planar import decode_map

CLEAR = 3e-5  # unit-square units; beyond them rounding moves no outline


@settings(max_examples=40)
@given(st.integers(0, 10_000))
def test_the_topmost_element_at_a_point(seed: int) -> None:
    of, rng = sample(seed), np.random.default_rng(seed)
    texture = faces(of)
    points = points_near(of, rng, 60)
    windings, distance = path_windings(of, points)
    rules = np.array([path.fill_rule == FillRule.EVENODD for path in of.paths])
    inside = np.where(rules[:, None], np.array(windings) & 1, np.array(windings)) != 0
    top = np.array([topmost(of, np.flatnonzero(here).tolist()) for here in inside.T])
    found = texture.element_at(points)
    planar, known = decode_map(texture.flat, texture.roots[0].quad), distance > CLEAR
    known &= (found.element >= 0) | (top < 0) | (not planar.is_mean.any())
    wanted = np.array([*(path.element for path in of.paths), ""])[top]
    assert (found.name[known] == wanted[known]).all()
    assert ((found.element < 0) == (top < 0))[known].all()
    assert (found.root[found.element >= 0] == 0).all()


def topmost(of: Drawing, inside: list[int]) -> int:
    """The highest of the paths inside that is no mask, and that no mask hides of which nothing is there; or -1."""
    met = {place for path in inside for place in of.around(of.paths[path].group)}
    for path in reversed(inside):
        around = of.around(of.paths[path].group)
        masks = [k for k, mask in enumerate(of.groups) if mask.mask and mask.outer in around]
        if met.issuperset(masks) and not any(of.groups[place].mask for place in around):
            return path
    return -1
