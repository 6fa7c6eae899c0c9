"""A page of a flood with everything in it: a bay made of formulas, in three steps of rising water."""

import base64
import hashlib
import html
import io
import json
import subprocess
import tempfile
from dataclasses import replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from contourpy import FillType, contour_generator
from numpy.typing import NDArray
from PIL import Image

from chromium import WEB
from vexture import convert
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.pages.page import EXPORTED_POLICY
from vexture_geo.base.extent import Frame
from vexture_geo.flood.conversion import CODE, depth_png
from vexture_geo.flood.credits import Credits
from vexture_geo.flood.hazard import HAZARDS, UNIT
from vexture_geo.flood.open_water import open_water, openness_png
from vexture_geo.flood.surface import WaterSurface

FRAME = Frame((600_000.0, 4_080_000.0, 608_000.0, 4_086_000.0), "EPSG:32610", (8000.0, 6000.0))

LEVELS = (0.0, 4.0, 9.0)
RATING = 2.5
"""Hazard at the eastern side and the highest level; less to the west and below."""
"""Metres of the water above its mean, step by step."""

CLASSES = {0.0: "#fde725", 2.0: "#21918c", 20.0: "#440154"}
"""Colours of the classes of depth, in metres."""

CELLS = 513
COLUMNS, ROWS = 193, 145

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
{policy}
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{title}</title><link rel="icon" href="data:,">
<style>{css}</style>
</head>
<body>
<div id="app"></div>
<script type="application/json" id="vexture-scene">{scene}</script>
<script type="module">{script}</script>
</body>
</html>
"""


def height(u: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Metres above the mean level of the water at places of the unit square: land in the north, a bay in it."""
    coast = 0.53 + 0.05 * np.sin(2.3 * u + 0.4) + 0.016 * np.sin(13 * u + 2) + 0.006 * np.sin(37 * u)
    coast = coast + 0.13 * np.exp(-(((u - 0.6) / 0.13) ** 2)) - 0.05 * np.exp(-(((u - 0.33) / 0.07) ** 2))
    coast = coast + 0.004 * np.sin(90 * u + 30 * v)
    inland = v - coast
    hills = 1 + 0.35 * np.sin(11 * u + 3 * v) * np.sin(9 * v + 2) + 0.16 * np.sin(31 * u + 1) * np.sin(27 * v)
    land = 210 * (1 - np.exp(-(np.maximum(inland, 0) ** 1.45) * 7)) * hills + 18 * np.maximum(inland, 0)
    sea = -75 * (1 - np.exp(np.minimum(inland, 0) * 3.4))
    return np.where(inland > 0, land, sea)


def square(count: int) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Places over the unit square, and heights at them."""
    line = np.linspace(0, 1, count)
    u, v = np.meshgrid(line, line)
    return line, line, height(u, v)


@cache
def wet(level: float) -> Drawing:
    """Area below a level, in the unit square."""
    u, v, heights = square(CELLS)
    found = contour_generator(u, v, heights, fill_type=FillType.OuterOffset).filled(-1e6, level)
    contours = [
        points[start : end - 1].tolist()
        for points, offsets in zip(*found, strict=True)
        for start, end in pairwise(offsets)
    ]
    if not contours:
        return Drawing(())
    return Drawing.polygon(*contours)


def over_frame(columns: int, rows: int) -> NDArray[np.float64]:
    """Heights over the frame, from corner to corner, the northernmost row first."""
    u0, v0, u1, v1 = FRAME.box
    return height(*np.meshgrid(np.linspace(u0, u1, columns), np.linspace(v1, v0, rows)))


def views(u: float) -> list[dict[str, Any]]:
    """Views of a place on the shore."""
    column = np.linspace(0.3, 0.9, 6001)
    v = float(column[np.argmin(np.abs(height(np.full_like(column, u), column)))])
    step = 0.02
    east, west, north, south = (
        float(height(np.array(u + du), np.array(v + dv))) for du, dv in ((step, 0), (-step, 0), (0, step), (0, -step))
    )
    down = np.array([west - east, south - north])
    place = {"place": [u, v], "toward": (down / np.hypot(*down)).tolist(), "above": LEVELS[-1]}
    kinds = (("Coast", "far", 1600.0), ("Shore", "near", 500.0), ("Beach", "eye", 0.0))
    return [{"name": name, "kind": kind, "reach": reach, **place} for name, kind, reach in kinds]


def data_url(media_type: str, content: bytes) -> str:
    """Content as an address of its own."""
    return f"data:{media_type};base64,{base64.b64encode(content).decode()}"


def image_url(pixels: NDArray[np.uint8], kind: str) -> str:
    """Picture as an address of its own."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, kind, quality=82)
    return data_url(f"image/{kind.lower()}", file.getvalue())


@cache
def ground() -> str:
    """Sand, grass, rock, as the heights say, with a hillshade and some noise."""
    heights = over_frame(1024, 768)
    stops = (-80, -14, -2, 3, 7, 16, 60, 140, 260)
    colors = np.array(
        [
            (60, 84, 92),
            (128, 134, 112),
            (198, 182, 140),
            (230, 214, 174),
            (206, 194, 142),
            (132, 146, 86),
            (92, 118, 62),
            (112, 112, 74),
            (150, 140, 116),
        ]
    )
    noise = np.random.default_rng(5)
    rough = noise.normal(0, 1, heights.shape) + np.kron(noise.normal(0, 1, (96, 128)), np.ones((8, 8)))
    seen = heights + rough * np.clip(np.abs(heights) / 10, 0.15, 6)
    pixels = np.stack([np.interp(seen, stops, colors[:, channel]) for channel in range(3)], axis=-1)
    return image_url(np.clip(pixels + rough[..., None] * 3, 0, 255).astype(np.uint8), "JPEG")


def classes(level: float) -> bytes:
    """Planar map of the classes of depth."""
    paths = []
    for depth, color in CLASSES.items():
        red, green, blue = (int(color[k : k + 2], 16) / 255 for k in (1, 3, 5))
        paths += [replace(path, paint=Paint((red, green, blue))) for path in wet(level - depth).paths]
    return convert(Drawing(tuple(paths)), split="faces").to_ktx2()


def manifest(name: str, level: float, label: str, time: str | None) -> dict[str, Any]:
    """What the page is told of one step."""
    drawing = wet(level)
    content = convert(drawing).to_ktx2()
    depths = np.maximum(0.0, level - over_frame(COLUMNS, ROWS))
    deepest = float(depths.max())
    surface = WaterSurface(np.where(depths > 0.0, level, np.nan), depths > 0.0)
    levels, level_facts = surface.encode_png()
    rated = np.linspace(0.0, RATING, COLUMNS) * level / LEVELS[-1]
    hazards = np.where(depths > 0.0, 1.0 + np.round(rated / UNIT), 0.0)
    return {
        "name": name,
        "version": "1",
        "texture": data_url("image/ktx2", content),
        "bytes": len(content),
        "events": None,
        "facts": {
            "time": time,
            "label": label,
            "dry": not drawing.paths,
            "deepest": deepest or None,
            "depth": CODE,
            "level": level_facts,
            "hazard": {"unit": UNIT},
            "area": float((depths > 0.0).mean() * FRAME.metres[0] * FRAME.metres[1]),
        },
        "views": {
            "depth": data_url("image/png", depth_png(depths.astype(np.float32))),
            "level": data_url("image/png", levels),
            "classes": data_url("image/ktx2", classes(level)),
            "hazard": image_url(hazards.astype(np.uint8), "PNG"),
        },
        "note": None,
    }


@cache
def openness() -> str:
    """Picture of where the water is open to waves."""
    return openness_png(open_water(wet(LEVELS[0]), FRAME))


def scene(steps: int = 3, **more: Any) -> dict[str, Any]:
    """Scene of a flood in as many steps."""
    heights = over_frame(COLUMNS, ROWS)
    unit = 0.01
    hours = [f"{6 + hour:02}:00" for hour in range(steps)]
    one = steps == 1
    return {
        "flood": {
            "title": "A bay of formulas",
            "credits": Credits(title="A bay of formulas", source="formulas").as_json(),
            "depths": [{"from": depth, "color": color} for depth, color in CLASSES.items()],
            "arrivals": list(CLASSES.values()),
            "hazards": [{"from": least, "color": color, "text": text} for least, color, text in HAZARDS],
            "steps": [
                manifest(
                    f"flood/{k:02}" if not one else "flood",
                    LEVELS[k],
                    "" if one else hours[k],
                    None if one else f"2026-01-05T{hours[k]}:00Z",
                )
                for k in range(steps)
            ],
            "prefix": "flood",
            "frame": {
                "box": list(FRAME.box),
                "to_source": FRAME.to_source.ravel().tolist(),
                "metres": list(FRAME.metres),
                "crs": FRAME.crs,
                "bounds": list(FRAME.bounds),
                "geographic": False,
                "geodetic": None,
            },
            "ground": ground(),
            "relief": {
                "columns": COLUMNS,
                "rows": ROWS,
                "unit": unit,
                "invented": False,
                "still": 0.0,
                "heights": data_url("application/octet-stream", np.round(heights / unit).astype("<i2").tobytes()),
            },
            "fold": None,
            "openness": openness(),
            "views": views(0.52),
            "notes": ["The bay is made of formulas."],
        }
        | more
    }


@cache
def built() -> tuple[str, str]:
    """Script and style of the page, as they are now; the built ones may be those of an earlier day."""
    entries = ["flood/main.js", "flood/flood.css"]
    with tempfile.TemporaryDirectory() as folder:
        command = ["node_modules/.bin/esbuild", *entries, "--bundle", "--format=esm", "--minify", f"--outdir={folder}"]
        outcome = subprocess.run(command, cwd=WEB, capture_output=True, text=True, check=False)
        assert outcome.returncode == 0, outcome.stderr
        script, style = (Path(folder, name).read_text(encoding="utf-8") for name in ("main.js", "flood.css"))
    return script, style


def write_page(path: Path, scene: dict[str, Any], *, policy: bool = True) -> Path:
    """Write the page of a scene, with the policy that exported pages have."""
    script, css = built()
    script = script.replace("</script", "<\\/script").replace("<!--", "<\\x21--")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    rules = EXPORTED_POLICY.format(script=f"'sha256-{digest}'")
    meta = f'<meta http-equiv="Content-Security-Policy" content="{html.escape(rules)}">' if policy else ""
    text = json.dumps(scene).replace("<", "\\u003c")
    title = html.escape(scene["flood"]["title"])
    path.write_text(PAGE.format(policy=meta, css=css, scene=text, script=script, title=title), encoding="utf-8")
    return path
