"""The kernels that are compiled ahead of time, and arguments for each: for wheels, and for WebAssembly."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from vexture import Drawing, convert, read_svg
from vexture.base.layout import MAP_HEAD
from vexture.base.tolerance import CLOSED, ROUND, UNSEEN
from vexture.bezier.arc_length import path_length
from vexture.bezier.cover import DIRECTIONS, cover_cells, cut_outlines, find_reach
from vexture.bezier.stroke import stroke_path
from vexture.renderers.colour import draw_colours
from vexture.renderers.cpu import draw
from vexture.texture.encode import texel_rows, tree_texels
from vexture.texture.map_entry import coloured_texels
from vexture.texture.map_texels import encode_map
from vexture.texture.planar import map_texels
from vexture.texture.silhouette import silhouette_texels
from vexture.tree.bounds import COINCIDENT, DEFAULT_CAPACITY, DEFAULT_DEPTH, Bounds, bounds_of, largest_shift
from vexture.tree.build import SLICE, grow, grow_on
from vexture.tree.cubics import outlines_of
from vexture.tree.growth import arrange_tree
from vexture.tree.planar.build import DEFAULT_MAP_CAPACITY, build_map, grow_map, plant_map
from vexture.tree.planar.faces import add_faces, new_faces, refill, trim_faces
from vexture.tree.planar.growth import with_map_room
from vexture.tree.planar.map import arrange_map, texels_of
from vexture.tree.planar.raster import raster_of
from vexture.tree.planar.source import source_of
from vexture.tree.planar.splines import BlurAxis, blurred_words
from vexture.tree.tree import MOST_QUADS

SHAPES: Final = Path(__file__).parent.parent / "examples" / "shapes"

ENDLESS: Final = 2**62
"""Work that no tree takes."""

ROOM: Final = 2**14
"""Rows of each array of a map that grows: enough for the example drawings."""


def ahead_calls() -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """Kernels of a plain `vexture convert` and of the renderer on the CPU, with arguments to compare them on."""
    for file in sorted(SHAPES.glob("*.svg")):
        drawing = read_svg(file)
        for path in drawing.paths[:1]:
            for contour in path.contours:
                yield path_length, (contour,)
                one = (np.array([len(contour)]), np.array([True]), np.array([0.02, 1.0, 1.0, 4.0, ROUND, 0.0]))
                for dashes in ([], [0.05, 0.03]):
                    yield stroke_path, (contour, *one, np.array(dashes, np.float64))
        for tolerance in (0.0, 0.001):
            outlines, bounds = outlines_of(drawing), Bounds(4, tolerance, 1e-5, 1, 16, MOST_QUADS)
            yield grow, (*outlines, bounds, SLICE, 0)
            started, _ = grow.dispatcher(*outlines, bounds, 0, 0)
            yield grow_on, (started, outlines.rules, bounds, SLICE, 0)
            done, _ = grow.dispatcher(*outlines, bounds, ENDLESS, 0)
            yield arrange_tree, (done.cells, done.first, done.curves, done.counts)
            yield tree_texels, (*arrange_tree.dispatcher(done.cells, done.first, done.curves, done.counts), 7)
        texture = convert(drawing, split=None)
        for flat_view in (0, 1):
            to_unit = np.array([[0.02, 0.0, 0.0], [0.0, -0.02, 1.0], [0.0, 0.0, 1.0]])
            image = np.full((50, 50), np.nan, np.float32)
            yield draw, (texture.texels, flat_view, texture.roots[0].quad, (0, 0), to_unit, image)
        yield from map_calls(drawing)


def map_calls(drawing: Drawing) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """The kernels of planar maps."""
    source = source_of(drawing)
    yield plant_map, (source, 16, 0)
    for tolerance in (0.0, 0.001):
        growth, layers, faces, *_ = plant_map.dispatcher(source, 16, 0)
        growth.tree.needed[:] = ROOM
        growth, bounds = with_map_room(growth), Bounds(4, tolerance, 1e-5, 1, 16, MOST_QUADS)
        yield grow_map, (growth, layers, faces, bounds, ENDLESS, SLICE, 0)
        done = grow_map.dispatcher(*plant_map.dispatcher(source, 16, 0)[:3], bounds, ENDLESS, ENDLESS, 0)
        state = done[0], layers, done[1]
        yield arrange_map, state
        for components in (1, 4):
            raster = raster_of.dispatcher(*state, 4, components)
            yield raster_of, (*state, 4, components)
            axis = BlurAxis(-1.0, 1.5, 12, 2.0)
            yield blurred_words, (raster, axis, axis, int(components == 4))
        yield encode_map, (arrange_map.dispatcher(*state)[0], 7)
    yield texels_of, (1, 2)
    table = 1024, 1024
    yield new_faces, table
    yield refill, (new_faces(*table),)
    yield add_faces, (new_faces(*table), trim_faces(new_faces(*table)), 1, 1, np.zeros(1, np.int64))
    circles, top = np.zeros((1, 3)), np.zeros((1, 1), np.int32)
    reach, outlines = np.zeros((1, DIRECTIONS)), np.zeros((1, 1, 4, 2))
    yield cover_cells, (circles, top)
    yield find_reach, (circles, top, reach, np.zeros(1, np.bool_))
    yield cut_outlines, (outlines, circles, reach, np.zeros(1, np.int64))
    planar = build_map(drawing)
    assert planar is not None
    texels = texel_rows(map_texels(planar, 0))
    for flat_view in (0, 1):
        to_unit = np.array([[0.02, 0.0, 0.0], [0.0, -0.02, 1.0], [0.0, 0.0, 1.0]])
        image = np.full((50, 50, 4), np.nan, np.float32)
        yield draw_colours, (texels, 0, flat_view, MAP_HEAD, (0, 0), to_unit, image)


class Entry(NamedTuple):
    """A function that a module of WebAssembly exports under the name of its kernel."""

    kernel: Any
    arguments: tuple[Any, ...]  # a sample, for whose types it is compiled
    results: tuple[str, ...]  # names of the parts of its result


def wasm_modules() -> dict[str, list[Entry]]:
    """The kernels that JavaScript calls, by the module that holds them."""
    triangle = Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.5, 0.9)])
    outlines = outlines_of(triangle)
    bounds = bounds_of(UNSEEN, DEFAULT_DEPTH, DEFAULT_CAPACITY, None, MOST_QUADS)
    ends, closed, style = np.array([3]), np.array([True]), np.array([0.05, 0.0, 0.0, 4.0, ROUND, 0.0])
    numbers = ("outside", "reach", "deviation", "unresolved", "quads", "curves", "paints", "flattened")
    return {
        "silhouettes": [
            Entry(
                silhouette_texels,
                (*outlines, bounds, 0, ENDLESS),
                ("texels", "outside", "deviation", "unresolved", "quads"),
            )
        ],
        "maps": [
            Entry(
                coloured_texels,
                (source_of(triangle), bounds._replace(capacity=DEFAULT_MAP_CAPACITY), 0, 0, ENDLESS, ENDLESS),
                ("texels", "starts", "members", "hides", *numbers),
            ),
        ],
        "strokes": [
            Entry(stroke_path, (outlines.cubics, ends, closed, style, np.zeros(0)), ("contours", "lengths")),
        ],
    }


def wasm_constants() -> dict[str, float]:
    """Numbers that JavaScript needs to call the kernels: defaults of a conversion, and limits."""
    return {
        "CLOSED": CLOSED,
        "TOLERANCE": UNSEEN,
        "CAPACITY": DEFAULT_CAPACITY,
        "MAP_CAPACITY": DEFAULT_MAP_CAPACITY,
        "MAX_DEPTH": DEFAULT_DEPTH,
        "MOST_QUADS": MOST_QUADS,
        "NEAR": COINCIDENT * largest_shift(None),
        "ROUND": ROUND,
        "ENDLESS": ENDLESS,
    }
