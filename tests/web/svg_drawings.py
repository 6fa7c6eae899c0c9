"""Drawings that the page's reader of SVG makes, and their comparison with those of Python's."""

import http.server
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from chromium import bundle
from vexture.base.notes import Note
from vexture.base.tolerance import ROUND
from vexture.drawing.drawing import Drawing, FillRule
from vexture.drawing.drawing import Path as DrawnPath
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Gradient, Paint, Spread, Stop
from vexture.drawing.picture import Picture, Sampling
from vexture.renderers.exact import render_exact_colours
from vexture.svg.outline import ShapeOutline
from vexture.svg.strokes import Stroke, stroke_contours

ENTRY = Path(__file__).parent / "pages" / "svg-reader.js"
SIDE = 128
"""Pixels across the pictures that are compared."""

VISIBLE, MOST_OFF = 16 / 255, 0.005
"""Difference from which a pixel is off, and the share of pixels off below which a drawing is right."""

CLOSE, NEAR = 1e-5, 2.5 / 255
"""Distance of points in the unit square, and difference of colours, that no picture shows: browsers round to 8 bits."""

MOST_NUMBERS = 1024
"""Most numbers of a paint."""


def stroke(request: dict[str, Any]) -> list[list[float]]:
    """Outline of a stroke, for the page, whose own kernel is tested elsewhere."""
    style = request["style"]
    outline = ShapeOutline(np.array(request["cubics"], np.float64).reshape(-1, 4, 2), request["closed"])
    own = Stroke(
        style["width"], style["cap"], style["join"], style["miterLimit"], tuple(style["dashes"]), style["dashOffset"]
    )
    contours = stroke_contours([outline], own, style["tolerance"] / ROUND)
    return [contour.ravel().tolist() for contour in contours]


@contextmanager
def served_reader(folder: Path) -> Iterator[tuple[str, list[str]]]:
    """Serve the page with the reader, and outlines of strokes; yield its address and the list of paths asked for.

    The page "strict" has a policy that forbids styles in its markup.
    """
    bundle(ENTRY, folder / "reader.js")
    files = {"/": (b"<!doctype html><meta charset=utf-8><script type=module src=/reader.js></script>", "text/html")}
    files["/reader.js"] = ((folder / "reader.js").read_bytes(), "text/javascript")
    files["/strict"] = files["/"]
    asked: list[str] = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def log_message(self, *arguments: object) -> None:
            """Log nothing."""

        def do_GET(self) -> None:
            if self.path not in files:
                asked.append(self.path)
            self.answer(*files.get(self.path, (b"", "text/plain")))

        def do_POST(self) -> None:
            request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            self.answer(json.dumps(stroke(request)).encode(), "application/json")

        def answer(self, content: bytes, kind: str) -> None:
            self.send_response(200)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(content)))
            if self.path == "/strict":
                self.send_header("Content-Security-Policy", "default-src 'none'; script-src 'self'; connect-src 'self'")
            self.end_headers()
            self.wfile.write(content)

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}", asked
    finally:
        server.shutdown()
        server.server_close()


def to_drawing(value: dict[str, Any]) -> Drawing:
    """Make Python's drawing of the page's."""
    groups = tuple(
        Group(one["outer"], one["opacity"], Blend(one["blend"]), Mask(one["mask"]), one["pattern"])
        for one in value["groups"]
    )
    paths = tuple(
        DrawnPath(
            tuple(np.array(contour, np.float64).reshape(-1, 4, 2) for contour in one["contours"]),
            FillRule(one["fillRule"]),
            to_paint(one["paint"]),
            one["group"],
            one["element"],
        )
        for one in value["paths"]
    )
    a, b, c, d, e, f = value["toSource"]
    notes = tuple(Note(one["kind"], one["message"], one["count"]) for one in value["notes"])
    return Drawing(paths, np.array([[a, c, e], [b, d, f]]), value["name"], None, notes, groups, tuple(value["sides"]))


def to_paint(value: dict[str, Any]) -> Paint:
    """Make Python's paint of the page's."""
    gradient = value["gradient"]
    if gradient is not None:
        stops = tuple(Stop(one["offset"], tuple(one["color"]), one["opacity"]) for one in gradient["stops"])
        rows = tuple(tuple(row) for row in gradient["toRamp"])
        focus = None if gradient["focus"] is None else tuple(gradient["focus"])
        gradient = Gradient(rows, stops, Spread(gradient["spread"]), focus)  # type: ignore[arg-type]
    return Paint(tuple(value["color"]), value["opacity"], gradient, to_picture(value["picture"]))


def to_picture(value: dict[str, Any] | None) -> Picture | None:
    """Make Python's picture of the page's."""
    if value is None:
        return None
    pixels = np.array(value["pixels"]["rgba"], np.uint8).reshape(value["pixels"]["rows"], value["pixels"]["columns"], 4)
    first, second = value["toPixels"]
    return Picture((tuple(first), tuple(second)), pixels, Sampling(value["sampling"]), value["opacity"])


def share_off(ours: Drawing, theirs: Drawing) -> float:
    """Share of the pixels by which the pictures of two drawings differ; of parts that hardly differ, none is drawn."""
    is_alike = len(ours.paths) == len(theirs.paths) and len(ours.groups) == len(theirs.groups)
    pairs = [*zip(ours.paths, theirs.paths, strict=is_alike)]
    if is_alike and all(map(is_same_group, ours.groups, theirs.groups)) and all(has_same_role(*pair) for pair in pairs):
        pairs = [pair for pair in pairs if not is_same_path(*pair)]
        ours, theirs = (
            replace(ours, paths=tuple(replace(pair[k], group=-1) for pair in pairs), groups=()) for k in (0, 1)
        )
        if not pairs:
            return 0.0
    first, second = (render_exact_colours(drawing, SIDE) for drawing in (ours, theirs))
    return float((np.abs(first - second).max(axis=-1) > VISIBLE).mean())


def is_same_group(ours: Group, theirs: Group) -> bool:
    return abs(ours.opacity - theirs.opacity) < NEAR and replace(ours, opacity=1.0) == replace(theirs, opacity=1.0)


def has_same_role(ours: DrawnPath, theirs: DrawnPath) -> bool:
    return (ours.fill_rule, ours.group, ours.element) == (theirs.fill_rule, theirs.group, theirs.element)


def is_same_path(ours: DrawnPath, theirs: DrawnPath) -> bool:
    return (
        has_same_role(ours, theirs)
        and ours.paint.picture is theirs.paint.picture is None
        and [len(contour) for contour in ours.contours] == [len(contour) for contour in theirs.contours]
        and all(np.abs(a - b).max() < CLOSE for a, b in zip(ours.contours, theirs.contours, strict=True))
        and np.allclose(numbers_of(ours.paint), numbers_of(theirs.paint), rtol=1e-3, atol=NEAR)
    )


def numbers_of(paint: Paint) -> list[float]:
    """All numbers of a paint."""
    gradient = paint.gradient
    numbers = [*paint.color, paint.opacity]
    if gradient is not None:
        numbers += [gradient.spread, *gradient.to_ramp[0], *gradient.to_ramp[1], *(gradient.focus or (-1.0, -1.0))]
        numbers += [number for stop in gradient.stops for number in (stop.offset, *stop.color, stop.opacity)]
    return [*numbers, *[0.0] * (MOST_NUMBERS - len(numbers))]
