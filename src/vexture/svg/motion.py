"""Where motion along a path brings an element when its document begins (SVG Animations 2, 4.3)."""

from math import degrees, pi

from lxml import etree

from vexture.svg.course import along, said
from vexture.svg.document import local_name
from vexture.svg.links import Links, reference
from vexture.svg.path_data import path_outlines
from vexture.svg.text.track import MOST_CUBICS, Point, track_of
from vexture.svg.timing import Progress
from vexture.svg.values import number, numbers

__all__ = ["motion", "place_on_path"]

SMOOTH = 1e-3
"""User units: the largest distance of a cubic from an arc of a path along which things move."""

TURNS = {"auto": 0.0, "auto-reverse": pi}


def motion(element: etree._Element, how: Progress, links: Links) -> str | None:
    """The transform, as an attribute says it, by an `animateMotion`; None if its place is not known."""
    data = path_of(element, links)
    part = how.part
    if element.get("keyPoints") is not None:
        values = [point.strip() for point in element.get("keyPoints", "").rstrip("; \t\n").split(";")]
        part = number(along(element, [*values], how) or "") or 0.0
    elif 0.0 < part < 1.0 and element.get("calcMode", "paced") != "paced" and said(element) != {"from", "to"}:
        return None
    place = None if data is None else place_on_path(data, part)
    if place is None:
        return None
    rotate = element.get("rotate", "0").strip()
    turn = place.turn + TURNS[rotate] if rotate in TURNS else (number(rotate) or 0.0) * pi / 180.0
    return f"translate({place.x!r} {place.y!r}) rotate({degrees(turn)!r})"


def path_of(element: etree._Element, links: Links) -> str | None:
    """Path data along which an `animateMotion` moves."""
    for child in element:
        if local_name(child) == "mpath":
            path = links.target(reference(child) or "")
            return None if path is None else path.get("d")
    if element.get("path") is not None:
        return element.get("path")
    given = said(element)
    if given == {"values"}:
        texts = element.get("values", "").rstrip("; \t\n").split(";")
    else:
        first = element.get("from", "0 0")
        last = element.get("to")
        if last is None:
            start, step = numbers(first), numbers(element.get("by", "x"))
            if start is None or step is None or len(start) != 2 or len(step) != 2:
                return None
            last = f"{start[0] + step[0]!r} {start[1] + step[1]!r}"
        texts = [first, last]
    points = [numbers(text) for text in texts]
    pairs = [f"{point[0]!r} {point[1]!r}" for point in points if point is not None and len(point) == 2]
    return f"M{' L'.join(pairs)}" if len(pairs) == len(points) else None


def place_on_path(data: str, part: float) -> Point | None:
    """The place at a part of the length of path data; None if that has no path.

    Examples
    --------
    >>> place_on_path("M0 0H30V10", 0.5)
    Point(x=20.0, y=0.0, turn=0.0)
    """
    outlines, _ = path_outlines(data, SMOOTH)
    if not outlines or sum(len(outline.cubics) for outline in outlines) > MOST_CUBICS:
        return None
    track = track_of(outlines)
    if track is None:
        x, y = outlines[0].cubics[0, 0].tolist()
        return Point(x, y, 0.0)
    return track.at(min(max(part, 0.0), 1.0) * track.length)
