"""Flood polygons of a vector file, in a frame of the world."""

import os
from dataclasses import replace
from pathlib import Path as FilePath

import numpy as np
from numpy.typing import NDArray

from vexture.bezier.convert import line_cubics
from vexture.drawing import Drawing, FillRule, Path, clipped, tidied
from vexture.errors import SourceError
from vexture.geo.extent import Extent, Step
from vexture.geo.frame import Frame
from vexture.geo.geojson import UNLOCATED
from vexture.geo.reference import (
    UNPLACED,
    Bounds,
    frame_around,
    gis_packages,
    period,
    reference,
    refuse_metres,
    same_system,
    shown_bounds,
    shown_system,
    system,
    transformed,
    transformed_bounds,
)
from vexture.geo.rings import Rings, cut, moved, oriented, refuse_far, repaired, unwrapped, within
from vexture.geo.vectors import read_areas
from vexture.notes import Notes, line_of
from vexture.tolerance import CLOSED

__all__ = ["read_polygons"]

BEYOND = 0.5
"""Widths of the unit square around it in which polygons are kept before they are transformed."""


@gis_packages()
def read_polygons(
    source: str | os.PathLike[str] | bytes,
    file_name: str,
    *,
    frame: Frame | None = None,
    bounds: Bounds | None = None,
    crs: str | None = None,
    layer: str | None = None,
) -> Extent:
    """Read the area under water from polygons: GeoJSON, GeoPackage, FlatGeobuf, shapefiles.

    Everything in the file counts as water, where polygons overlap too. Straight sides stay straight; rings across the
    antimeridian are taken as such; invalid polygons are repaired.

    Parameters
    ----------
    source : path or bytes
        A shapefile is a ``.shp`` beside its siblings, or all of them in a ``.zip``; as bytes only the latter.
    file_name : str
        Names the drawing.
    frame : Frame, optional
        Where the polygons are put; they are transformed into its reference system.
    bounds : tuple of float, optional
        West, south, east, north of a new frame, in the reference system of the file or `crs`; by default the box
        around the polygons.
    crs : str, optional
        Reference system of the coordinates, above what the file says.
    layer : str, optional
        Which layer, where there are several.

    Returns
    -------
    Extent
        Of one step, without time; its drawing has no paths where there is no water. Its notes say what was left out.

    Raises
    ------
    SourceError
        If it cannot be read, has no reference system, is outside of the bounds or cannot be repaired.
    LimitError
        If a parameter does not fit it.

    Examples
    --------
    >>> square = b'{"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 9]]]}'
    >>> extent = read_polygons(square, "lake.geojson", crs="EPSG:28992", bounds=(0, 0, 18, 9))
    >>> extent.frame.bounds, extent.steps[0].drawing.segments
    ((0.0, 0.0, 18.0, 9.0), 4)
    """
    notes = Notes()
    rings, named = read_areas(source, file_name, layer, notes)
    own = reference(crs, named)
    refuse_far(rings, "correct it")
    turn = period(own)
    if turn and len(rings.ends):
        refuse_metres(rings.points, own, f"the coordinates {shown_bounds(rings.box, own)}")
        rings = unwrapped(rings, turn)
    if len(rings.ends):
        rings = repaired(rings, notes)
    if not len(rings.ends) and any(note.message != UNLOCATED for note in notes.listed):  # that is no empty flood
        raise SourceError(f"it holds no polygon{_met(notes)}; give polygons of what is under water")
    if frame is None:
        if bounds is None and not len(rings.ends):
            raise SourceError("it holds no polygon; for an empty flood, give `bounds`")
        frame = frame_around(bounds or rings.box, own)
    drawing = _drawn(_placed(rings, own, frame), frame, FilePath(file_name).stem)
    return Extent(frame, (Step(replace(drawing, notes=notes.listed)),), notes=notes.listed)


def _met(notes: Notes) -> str:
    met = line_of("met", notes.listed).removeprefix("met: ")
    return f" ({met})" if met else ""


def _placed(rings: Rings, own: str, frame: Frame) -> Rings:
    """Rings in the reference system of a frame: those near it."""
    if not len(rings.ends):
        return rings
    before, turn = rings, period(frame.crs)
    (across, _, west), (_, up, south) = frame.to_source
    square = (west, south, west + across, south + up)
    if not same_system(own, frame.crs):
        far = (west - BEYOND * across, south - BEYOND * up, west + (1 + BEYOND) * across, south + (1 + BEYOND) * up)
        reach = transformed_bounds(far, frame.crs, own)
        if reach is not None:
            rings = within(rings, reach, period(own))
            rings = cut(rings, reach)
        rings = moved(rings, lambda points: transformed(points, own, frame.crs), square, np.array([across, up]))
        refuse_far(
            rings,
            f"it has no place in the reference system of the frame, {shown_system(frame.crs)}; choose other bounds",
        )
        if turn:
            rings = unwrapped(rings, turn)
    if not len(within(rings, frame.bounds, turn).ends):
        raise SourceError(_outside(before, own, frame))
    return within(rings, square, turn)


def _outside(rings: Rings, own: str, frame: Frame) -> str:
    """Say that no polygon is within the bounds, and why that may be."""
    extent, bounds = rings.box, frame.bounds
    text = f"its extent {shown_bounds(extent, own)} is outside of the bounds {shown_bounds(bounds, frame.crs)}"
    degrees, wanted = _like_degrees(extent), _like_degrees(bounds)
    if degrees and not system(own).is_geographic:
        return f"{text}; its coordinates look like degrees: give `crs` EPSG:4326"
    if wanted and not system(frame.crs).is_geographic:
        return f"{text}; the bounds look like degrees: give them in the units of {shown_system(frame.crs)}"
    return f"{text}; correct the bounds, or `crs`"


def _like_degrees(bounds: Bounds) -> bool:
    return max(abs(bounds[0]), abs(bounds[2])) <= 360.0 and max(abs(bounds[1]), abs(bounds[3])) <= 90.0


def _drawn(rings: Rings, frame: Frame, name: str) -> Drawing:
    """Rings as one path in the unit square of a frame."""
    crs = None if frame.crs == UNPLACED else frame.crs
    if not len(rings.ends):
        return Drawing((), frame.to_source, name, crs)
    turned = oriented(rings)
    start: NDArray[np.float64] = (turned.points - frame.to_source[:, 2]) / frame.to_source.diagonal()
    end = start[turned.following]
    sides = line_cubics(start, end)
    if start.min() >= 0.0 and start.max() <= 1.0 and (np.abs(end - start) > CLOSED).any(axis=1).all():
        contours = np.split(sides, turned.ends[:-1])  # in the normal form as they are
    else:
        contours = list(tidied(*clipped(sides, turned.ends, np.zeros(2), np.ones(2))).values())
    paths = (Path(tuple(contours), FillRule.NONZERO),) if contours else ()
    return Drawing(paths, frame.to_source, name, crs)
