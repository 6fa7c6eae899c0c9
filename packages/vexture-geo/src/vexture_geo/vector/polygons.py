"""Read polygons of water in a vector file as an `Extent`."""

import os
from dataclasses import replace
from pathlib import Path as FilePath

import numpy as np
from numpy.typing import NDArray

from vexture.base.content import VECTOR_FILES, FileKind, is_geodatabase, kind_of, start_of, unpack_source
from vexture.base.errors import SourceError
from vexture.base.notes import Notes
from vexture.base.tolerance import CLOSED
from vexture.bezier.convert import line_cubics
from vexture.drawing.contours import ring_contours
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.drawing.unit_square import clip_contours, tidy_contours
from vexture_geo.base.coordinate_units import refuse_other_units
from vexture_geo.base.crs import (
    UNPLACED,
    choose_crs,
    format_bounds,
    format_system,
    frame_of,
    gis_packages,
    like_degrees,
    period,
    refuse_metres,
    same_system,
    system,
    transform_bounds,
    transform_points,
)
from vexture_geo.base.extent import Bounds, Extent, Frame, Step, bounds_of_square
from vexture_geo.base.longitudes import note_short_ways, unwrap_rings
from vexture_geo.base.rings import Rings, cut, map_rings, orient_rings, refuse_far, repair_rings, snap_rings, within
from vexture_geo.vector.archives import unzip
from vexture_geo.vector.arrow_files import is_table
from vexture_geo.vector.feature_tables import FeatureQuery, chunks_of
from vexture_geo.vector.geojson import UNLOCATED, WORLD, omissions
from vexture_geo.vector.vectors import areas_of_wkb, read_areas

BEYOND = 0.5
"""Distance in unit squares beyond which polygons are dropped before they are transformed."""


@gis_packages()
def read_polygons(
    source: str | os.PathLike[str] | bytes,
    file_name: str,
    *,
    frame: Frame | None = None,
    bounds: Bounds | None = None,
    crs: str | None = None,
    layer: str | None = None,
    snap: float | None = None,
) -> Extent:
    """Read the area under water from a file of features of any format (`content.VECTOR_FILES`), or GeoJSON.

    All polygons in the file are water, even where they overlap. Straight sides stay straight; rings that cross the
    antimeridian are unwrapped; invalid polygons are repaired, and borders that differ by at most `snap` become one. See
    `vexture.read_extent` for parameters and errors.
    """
    notes = Notes()
    rings, named = _areas(source, file_name, layer, notes)
    own = choose_crs(crs, named)
    refuse_far(rings, "correct it")
    turn = period(own)
    if turn and len(rings.ends):
        refuse_metres(rings.points, own, f"the coordinates {format_bounds(rings.box, own)}")
        note_short_ways(rings.steps, turn, notes)
        rings = unwrap_rings(rings, turn)
    if len(rings.ends):
        said = None if named == WORLD else named  # GeoJSON that names no system may use a local plane
        refuse_other_units(own, said, "", rings.box, is_given=crs is not None)
        rings = repair_rings(rings, notes)
    # features without geometry are an empty flood; other files without polygons are a mistake
    if not len(rings.ends) and any(note.message != UNLOCATED for note in notes.in_order):
        raise SourceError(f"it holds no polygon{omissions(notes)}; give polygons of what is under water")
    if frame is None:
        if bounds is None and not len(rings.ends):
            raise SourceError("it holds no polygon; for an empty flood, give `bounds`")
        frame = frame_of(bounds, bounds or rings.box, own)
    rings = snap_rings(_place_rings(rings, own, frame), float(np.abs(frame.to_source[:, :2]).max()), snap, notes)
    drawing = _draw_rings(rings, frame, FilePath(file_name).stem)
    return Extent(frame, (Step(replace(drawing, notes=notes.in_order)),), notes=notes.in_order)


def _areas(
    source: str | os.PathLike[str] | bytes, file_name: str, layer: str | None, notes: Notes
) -> tuple[Rings, str | None]:
    """Read the polygons of any file in its own coordinates, and the reference system that it names."""
    source = unzip(unpack_source(source))
    if not is_table(source):
        if not is_geodatabase(source) and kind_of(start_of(source), file_name) is FileKind.SVG:  # by no other sign
            raise SourceError(
                f"it is none of GeoJSON, {VECTOR_FILES}, GeoTIFF, NetCDF, GRIB and Esri's .asc and .flt; "
                "convert it to one of them"
            )
        return read_areas(source, file_name, layer, notes)
    (chunk,) = chunks_of(source, FeatureQuery(layer, columns=()), None)
    rings = areas_of_wkb(chunk.shapes, notes)
    return rings, chunk.crs(rings.points)


def _place_rings(rings: Rings, crs: str, frame: Frame) -> Rings:
    """Transform rings near a frame to its reference system."""
    if not len(rings.ends):
        return rings
    before, turn, square = rings, period(frame.crs), bounds_of_square(frame)
    if not same_system(crs, frame.crs):
        reach = transform_bounds(bounds_of_square(frame, BEYOND), frame.crs, crs)
        if reach is not None:
            rings = cut(within(rings, reach, period(crs)), reach)
        sides = frame.to_source[:, :2].diagonal()
        rings = map_rings(rings, lambda points: transform_points(points, crs, frame.crs), square, sides)
        refuse_far(
            rings,
            f"it has no place in the reference system of the frame, {format_system(frame.crs)}; choose other bounds",
        )
        if turn:
            rings = unwrap_rings(rings, turn)
    if not len(within(rings, frame.bounds, turn).ends):
        raise SourceError(_outside(before, crs, frame))
    return within(rings, square, turn)


def _outside(rings: Rings, crs: str, frame: Frame) -> str:
    """Compose the message that no polygon lies within the bounds, with the likely reason."""
    extent, bounds = rings.box, frame.bounds
    text = f"its extent {format_bounds(extent, crs)} is outside of the bounds {format_bounds(bounds, frame.crs)}"
    degrees, wanted = like_degrees(extent), like_degrees(bounds)
    if degrees and not system(crs).is_geographic:
        return f"{text}; its coordinates look like degrees: give `crs` EPSG:4326"
    if wanted and not system(frame.crs).is_geographic:
        return f"{text}; the bounds look like degrees: give them in the units of {format_system(frame.crs)}"
    return f"{text}; correct the bounds, or `crs`"


def _draw_rings(rings: Rings, frame: Frame, name: str) -> Drawing:
    """Draw rings as one path in the unit square of a frame."""
    crs = None if frame.crs == UNPLACED else frame.crs
    if not len(rings.ends):
        return Drawing((), frame.to_source, name, crs)
    turned = orient_rings(rings)
    start: NDArray[np.float64] = (turned.points - frame.to_source[:, 2]) / frame.to_source.diagonal()
    end = start[turned.following]
    if start.min() >= 0.0 and start.max() <= 1.0 and (np.abs(end - start) > CLOSED).any(axis=1).all():
        contours = ring_contours(start, turned.ends)  # already clipped and without tiny sides
    else:
        sides = line_cubics(start, end)
        contours = tuple(tidy_contours(*clip_contours(sides, turned.ends, np.zeros(2), np.ones(2))).values())
    paths = (Path(contours, FillRule.NONZERO),) if contours else ()
    return Drawing(paths, frame.to_source, name, crs)
