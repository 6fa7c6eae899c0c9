"""The page of masked materials as its tests use it: textures, pictures, and what the exact renderer says of them."""

import base64
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

import vexture
from chromium import ROOT, bundle
from vexture.drawing.drawing import Drawing
from vexture.drawing.paint import Paint
from vexture.texture.encode import encode
from vexture.texture.root import Root
from vexture.texture.texture import Texture
from vexture.tree.build import build_tree
from vexture.tree.planar.build import build_map

SHAPES: Final = ROOT / "examples" / "shapes"
SHADES: Final = ROOT / "web" / "test" / "fixtures" / "shades.svg"

ATLAS: Final = ("holes", "flame", "cake", "thumb")

INKS: Final = {"ink": ("duck", 0x1858A8), "cake": ("cake", 0xB03020)}
"""Drawings of one colour: shape and colour."""

PAGE: Final = Path(__file__).parent / "pages" / "mask.js"

THREES: Final = ("three-floor", "three")

NEWEST: Final = (pytest.param("three-floor", marks=pytest.mark.slow), "three")
"""For most tests: the code that differs between versions shows its materials with both in any case."""

Picture = NDArray[np.float64]


@cache
def drawing(name: str) -> Drawing:
    """One of the example drawings; or one that fills the square, one that crosses its border, or four together."""
    if name == "full":
        return Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)])
    if name == "glass":
        names = ("flame", "holes", "duck", "cake")
        paints = (
            Paint((0.9, 0.3, 0.1)),
            Paint((0.1, 0.2, 0.8)),
            Paint((1.0, 0.8, 0.0), 0.5),
            Paint((0.0, 0.5, 0.3), 0.8),
        )
        pairs = zip(names, paints, strict=True)
        return Drawing(
            tuple(replace(path, paint=paint) for one, paint in pairs for path in drawing(one).paths), name=name
        )
    if name == "border":
        return Drawing.polygon([(0, 0.1), (0.35, 0), (0.8, 0.3), (1, 0.25), (1, 0.7), (0.6, 1), (0.2, 1), (0, 0.6)])
    return vexture.read_svg(SHAPES / f"{name}.svg")


def prepare(folder: Path) -> None:
    """Write the textures, and a page for each version of three.js."""
    for name in ("duck", "full", "border"):
        vexture.convert(drawing(name)).save(folder / f"{name}.ktx2")
    vexture.convert(drawing("glass"), split="paint").save(folder / "paint.ktx2")
    vexture.convert(drawing("glass"), split="faces").save(folder / "map.ktx2")
    vexture.convert(SHADES).save(folder / "shades.ktx2")
    elements().save(folder / "elements.ktx2")
    sheets().save(folder / "sheets.ktx2")
    vexture.atlas([SHAPES / f"{name}.svg" for name in ATLAS]).save(folder / "atlas.ktx2")
    inks = [_ink_shape(name, *ink) for name, ink in INKS.items()]
    vexture.convert(inks[0]).save(folder / "ink.ktx2")
    vexture.atlas(inks).save(folder / "inks.ktx2")
    vexture.convert(drawing("duck"), encoding="thesis").save(folder / "thesis")
    for three in THREES:
        bundle(PAGE, folder / f"{three}.js", three)
        icon = '<!doctype html><link rel="icon" href="data:,"><body style="margin:0">'
        (folder / f"{three}.html").write_text(
            f'{icon}<script type="module" src="{three}.js"></script>', encoding="utf-8"
        )


def _ink_shape(name: str, shape: str, color: int) -> Drawing:
    paint = Paint(((color >> 16) / 255, (color >> 8 & 255) / 255, (color & 255) / 255))
    return Drawing(tuple(replace(path, paint=paint) for path in drawing(shape).paths), name=name)


@cache
def elements() -> Texture:
    """A map of many rows of texels, whose polygons can get other colours."""
    cells = [(x, y) for x in range(40) for y in range(40)]
    corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 1.0)]
    paths = [
        replace(path, element=f"{x} {y}")
        for x, y in cells
        for path in Drawing.polygon([((x + a) / 40, (y + b) / 40) for a, b in corners]).paths
    ]
    return vexture.convert(Drawing(tuple(paths), name="elements"), split="faces", restyle=True)


def parts() -> list[Drawing]:
    """The drawing in colours, cut into two maps and the layer between them."""
    whole = drawing("glass")
    paints = list(dict.fromkeys(path.paint for path in whole.paths))
    wanted = (paints[:2], paints[2:3], paints[1:])
    return [replace(whole, paths=tuple(path for path in whole.paths if path.paint in some)) for some in wanted]


def sheets() -> Texture:
    """A drawing of several sheets, and another one beside it."""
    trees = [
        build_map(part, tolerance=0.0) if len({path.paint for path in part.paths}) > 1 else build_tree(part)
        for part in parts()
    ]
    roots = [Root("glass/1"), Root("glass/2", paint=parts()[1].paths[0].paint), Root("glass/3"), Root("duck")]
    return encode([tree for tree in [*trees, build_tree(drawing("duck"))] if tree is not None], roots, name="sheets")


def decode(text: str) -> Picture:
    """Picture of the page, RGB in 0..1, top row first."""
    data = np.frombuffer(base64.b64decode(text), np.uint8)
    size = round((len(data) / 4) ** 0.5)
    return data.reshape(size, size, 4)[::-1, :, :3] / 255.0


def draw(page: Any, **config: Any) -> Picture:
    """Draw one scene."""
    return decode(page.evaluate("config => page.draw(config)", config)["picture"])


@cache
def _exact(name: str, size: int, to_unit: tuple[float, ...] | None) -> Picture:
    matrix = None if to_unit is None else np.reshape(to_unit, (-1, 3))
    return vexture.coverage(drawing(name), (size, size), matrix, renderer="exact").astype(np.float64)[..., None]


def exact(name: str, size: int = 512, to_unit: ArrayLike | None = None) -> Picture:
    """Exact coverage of each pixel, (size, size, 1)."""
    return _exact(name, size, None if to_unit is None else tuple(np.ravel(to_unit).tolist()))


def tiled_coverage(name: str, size: int, to_unit: ArrayLike, tiles: range) -> Picture:
    """Exact coverage by a drawing that is repeated."""
    pictures = []
    for x in tiles:
        for y in tiles:
            shifted = np.array(to_unit, float)
            shifted[:, 2] -= (x, y)
            pictures.append(exact(name, size, shifted))
    return np.sum(pictures, axis=0)


def linear(encoded: ArrayLike) -> Picture:
    """From sRGB."""
    value = np.asarray(encoded, float)
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def encode_srgb(value: ArrayLike) -> Picture:
    """To sRGB."""
    value = np.asarray(value, float)
    return np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.maximum(value, 1e-9) ** (1 / 2.4) - 0.055)


def distance(one: Picture, other: Picture) -> float:
    """Mean absolute difference, in units of 1/255."""
    assert one.shape[:2] == other.shape[:2]
    return float(255.0 * np.abs(one - other).mean())
