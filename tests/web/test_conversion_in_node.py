"""Conversions in JavaScript make the textures that Python makes of the same drawings, byte by byte."""

import base64
import json
import warnings
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_kernels import built
from walk_node import by_node

import corpora
import vexture
from chromium import ROOT
from vexture.base.errors import SourceWarning, VextureError
from vexture.drawing.drawing import Drawing
from vexture.drawing.drawing import Path as DrawnPath
from vexture.drawing.paint import Paint
from vexture.texture.root import Root

FIXTURES = ROOT / "tests" / "core" / "svg" / "fixtures"
FOLDERS = ("gradients", "groups", "masks", "patterns")

Case = dict[str, Any]


def encoded(array: np.ndarray) -> str:
    """An array's bytes in base64."""
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def paint_value(paint: Paint) -> dict[str, Any]:
    """A paint as JavaScript has it."""
    gradient = paint.gradient and {
        "toRamp": paint.gradient.to_ramp,
        "stops": [{"offset": one.offset, "color": one.color, "opacity": one.opacity} for one in paint.gradient.stops],
        "spread": int(paint.gradient.spread),
        "focus": paint.gradient.focus,
    }
    return {"color": paint.color, "opacity": paint.opacity, "gradient": gradient}


def drawing_value(drawing: Drawing) -> dict[str, Any]:
    """A drawing as JavaScript has it."""
    paths = [
        {
            "contours": [encoded(contour) for contour in path.contours],
            "fillRule": int(path.fill_rule),
            "paint": paint_value(path.paint),
            "group": path.group,
            "element": path.element,
        }
        for path in drawing.paths
    ]
    groups = [
        {
            "outer": one.outer,
            "opacity": one.opacity,
            "blend": int(one.blend),
            "mask": int(one.mask),
            "pattern": one.pattern,
        }
        for one in drawing.groups
    ]
    a, c, e, b, d, f = drawing.to_source.ravel().tolist()
    return {"name": drawing.name, "paths": paths, "groups": groups, "toSource": [a, b, c, d, e, f], "notes": []}


def root_value(root: Root) -> dict[str, Any]:
    """What is compared of a root."""
    paint = root.paint and {"color": root.paint.color, "opacity": root.paint.opacity}
    style = None
    if root.style is not None:
        from vexture.texture.root import style_as_json

        told = style_as_json(root.style)
        elements = [
            {
                "name": one["name"],
                "color": one["color"],
                "opacity": one.get("opacity", 1),
                "group": one.get("group", -1),
                "hides": one.get("hides", False),
            }
            for one in told["elements"]
        ]
        groups = [
            {
                "outer": one.outer,
                "opacity": shortest(one.opacity),
                "blend": int(one.blend),
                "mask": one.mask.name.lower(),
            }
            for one in root.style.groups
        ]
        style = {"elements": elements, "groups": groups, "stacks": told["stacks"]}
    return {"name": root.name, "quad": int(root.quad), "isMap": root.is_map, "paint": paint, "style": style}


def shortest(number: float) -> float:
    """A number as JSON of JavaScript has it: whole ones without a point."""
    return int(number) if float(number).is_integer() else number


def plain(value: Any) -> Any:
    """A value whose numbers are as in JavaScript."""
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [plain(part) for part in value]
    return shortest(value) if isinstance(value, float) else value


def case(drawing: Drawing, **options: Any) -> Case:
    """A conversion, with Python's texture."""
    names = {"max_depth": "maxDepth"}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        texture = vexture.convert(drawing, **options)
    return {
        "drawing": drawing_value(drawing),
        "options": {names.get(name, name): value for name, value in options.items()},
        "texels": encoded(texture.texels),
        "roots": [plain(root_value(root)) for root in texture.roots],
    }


def compare(cases: Iterable[Case], folder: Path) -> int:
    """Compare textures; return the number of cases."""
    for name in ("silhouettes", "maps"):
        built(name)
    listed = folder / "drawings.jsonl"
    with listed.open("w", encoding="utf-8") as file:
        file.writelines(json.dumps(each) + "\n" for each in cases)
    found = by_node("conversions.mjs", listed)
    assert found["different"] == []
    count: int = found["cases"]
    return count


def readable(files: Iterable[Path]) -> Iterator[Drawing]:
    """Drawings of files that can be read, and in which something is painted."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        for file in files:
            try:
                drawing = vexture.read(file)
            except VextureError:
                continue
            if drawing.paths and not any(path.hides for path in drawing.paths):
                yield drawing


def discs(count: int) -> Drawing:
    """Translucent discs about one centre, whose map needs too many texels."""
    circle = vexture.read(b'<svg viewBox="0 0 2 2"><circle cx="1" cy="1" r="1"/></svg>').paths[0].contours[0]
    sizes = np.linspace(1.0, 0.05, count)
    paths = (DrawnPath((((circle - 0.5) * size + 0.5),), paint=Paint((size, 0.0, 0.5), 0.2)) for size in sizes)
    return Drawing(tuple(paths), name="discs")


def test_drawings_in_their_colours(tmp_path: Path) -> None:
    files = [file for folder in FOLDERS for file in sorted((FIXTURES / folder).glob("*.svg"))]
    drawings = list(readable(files[::4]))
    assert len(drawings) > 40
    assert compare((case(drawing) for drawing in drawings), tmp_path) == len(drawings)


def test_options(tmp_path: Path) -> None:
    drawing = vexture.read(ROOT / "gallery" / "drawings" / "logo.svg")
    varied: list[dict[str, Any]] = [
        {"split": None},
        {"split": "paint"},
        {"restyle": True},
        {"precision": 1e-6},
        {"tolerance": 1e-3, "capacity": 5, "max_depth": 7},
    ]
    assert compare((case(drawing, **options) for options in varied), tmp_path) == len(varied)


@pytest.mark.slow
def test_sheets(tmp_path: Path) -> None:
    drawing = discs(800)
    assert compare([case(drawing), case(drawing, precision=1e-5)], tmp_path) == 2


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize(
    ("package", "count"),
    [(corpora.FLAG_ICONS, 260), (corpora.CIRCLE_FLAGS, 300), (corpora.SUPER_TINY_ICONS, 300), (corpora.DEVICON, 300)],
    ids=["flags", "circles", "tiny", "devicon"],
)
def test_published_drawings(package: corpora.Package, count: int, tmp_path: Path) -> None:
    files = package.all()
    drawings = list(readable(files[:: max(len(files) // count, 1)]))
    assert len(drawings) >= 0.9 * count
    cases = (case(drawing, restyle=place % 4 == 3) for place, drawing in enumerate(drawings))
    assert compare(cases, tmp_path) == len(drawings)
