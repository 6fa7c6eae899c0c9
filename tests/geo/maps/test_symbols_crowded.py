"""Maps of many points: what later symbols hide of earlier ones is left out, and nothing else changes."""

import json
from dataclasses import replace

import numpy as np
import pytest

from vexture import convert, render
from vexture.base.errors import ParameterError
from vexture.conversion.reading import read_drawing
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.tree.planar.build import build_map
from vexture_geo.maps import MapLayer, convert_map
from vexture_geo.maps.paths import MapFit
from vexture_geo.maps.symbols import CROWD, Symbols

DOT = read_drawing(b'<svg viewBox="0 0 2 2"><circle cx="1" cy="1" r="1"/></svg>')
COUNT = CROWD + 176
FIT = MapFit((0.0, 0.0, 100.0, 100.0))
COLOURS = [Paint((part / 4, 0.2, 1.0 - part / 4)) for part in range(5)]


def crowd(symbol=DOT, size=10.0, paints=COLOURS, count=COUNT):
    """Symbols that overlap about ten times."""
    random = np.random.default_rng(7)
    points, sizes = random.uniform(size, 100.0 - size, (count, 2)), random.uniform(0.7, 1.0, count) * size
    names = [str(k) for k in range(count)]
    return Symbols(symbol, points, sizes, names, [paints[k % len(paints)] for k in range(count)])


def drawing(paths):
    return Drawing(tuple(paths), name="crowd")


@pytest.mark.slow
@pytest.mark.parametrize("paints", [COLOURS, [*COLOURS, Paint((1.0, 1.0, 0.0), 0.4)]])
def test_the_picture_without_what_is_hidden_is_that_of_the_whole(paints):
    symbols = crowd(paints=paints)
    whole, seen = drawing(symbols.paths(FIT)), drawing(symbols.seen_paths(FIT))
    assert sum(not path.contours for path in seen.paths) > COUNT / 3
    assert [(path.element, path.paint) for path in seen.paths] == [(path.element, path.paint) for path in whole.paths]
    pictures = [render(one, size=150, renderer="exact") for one in (whole, seen)]
    assert np.abs(pictures[0] - pictures[1]).max() < 1e-5  # curves are flattened in other places


def test_the_same_symbol_is_picked_where_others_are_hidden():
    symbols = crowd()
    paths = drawing(symbols.seen_paths(FIT))
    whole, seen = (build_map(one, restyle=True) for one in (drawing(symbols.paths(FIT)), paths))
    assert len(seen.count) < 0.8 * len(whole.count)
    found = [{stack[-1] for stack in one.stacks if len(stack)} for one in (whole, seen)]
    assert found[0] == found[1]


@pytest.mark.slow
def test_what_hides_nothing_can_become_translucent():
    symbols = crowd()
    texture = convert(drawing(symbols.seen_paths(FIT)), split="faces", restyle=True)
    style = texture.roots[0].style
    free = [name for name, hides in zip(style.names, style.hides, strict=True) if not hides]
    assert len({int(top) for top in style.top} & {int(name) for name in free}) > 10
    faded = Paint((1.0, 1.0, 0.0), 0.4)
    painted = replace(
        symbols, paints=[faded if k in set(map(int, free)) else one for k, one in enumerate(symbols.paints)]
    )
    expected = render(drawing(painted.paths(FIT)), size=150, renderer="exact")
    found = texture.with_paints(dict.fromkeys(free, "#ffff0066")).render(size=150, renderer="cpu")
    assert np.abs(found - expected).max() < 0.01


@pytest.mark.parametrize(
    "symbols",
    [
        crowd(paints=[Paint((1.0, 0.0, 0.0), 0.5)]),
        crowd(count=CROWD - 1),
        crowd(size=0.01),
        crowd(read_drawing(b'<svg viewBox="0 0 4 4"><path d="M0 0h4v4h-1v-3h-2v3h-1z"/></svg>')),
        crowd(read_drawing(b'<svg viewBox="0 0 4 4"><circle cx="2" cy="2" r="2"/><path d="M1 1h1v1h-1z"/></svg>')),
    ],
    ids=["translucent", "few", "apart", "not convex", "two paths"],
)
def test_other_symbols_are_whole(symbols):
    for path, seen in zip(symbols.paths(FIT), symbols.seen_paths(FIT), strict=True):
        assert (path.element, path.paint, seen.hides) == (seen.element, seen.paint, False)
        for one, other in zip(path.contours, seen.contours, strict=True):
            np.testing.assert_array_equal(one, other)


def test_a_map_of_crowded_points_has_all_ids_and_keeps_opaque_what_hides(tmp_path):
    random = np.random.default_rng(3)
    points = [
        {
            "type": "Feature",
            "properties": {},
            "geometry": {"type": "Point", "coordinates": random.uniform(0, 1, 2).tolist()},
        }
        for _ in range(COUNT)
    ]
    points[0]["geometry"]["coordinates"] = points[-1]["geometry"]["coordinates"]  # one dot wholly below another
    file = tmp_path / "points.geojson"
    file.write_text(json.dumps({"type": "FeatureCollection", "features": points}))
    found = convert_map([MapLayer(file, symbol_size="100px")])
    (root,) = found.conversion.texture.roots
    assert sorted(map(int, root.style.names)) == list(range(COUNT)) == sorted(map(int, found.table["id"].to_pylist()))
    with pytest.raises(ParameterError, match=f"'{COUNT - 1}' gets the opacity 0.501961, but the texture does not have"):
        found.conversion.texture.with_paints({str(COUNT - 1): "#ff000080"})
