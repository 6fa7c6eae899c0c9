"""Glyphs in colours that the worker of web/src/typeset makes planar maps of, next to the same drawings as SVG."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fontTools.colorLib.builder import buildCOLR, buildCPAL
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib.tables import otTables
from test_kernels import built
from test_typesetting import DEJAVU, set_texts, typeset

import vexture
from vexture.base.layout import ROW_BITS

PALETTE = [(1.0, 0.0, 0.0, 1.0), (0.0, 0.5, 0.0, 1.0), (0.0, 0.0, 1.0, 1.0), (1.0, 1.0, 0.0, 0.5)]
RED, GREEN, BLUE, YELLOW = range(4)
EM = 1000

FRAME = "M0 0H1000V1000H0Z"
"""A square in the palette's blue below each drawing, so that both have the same box."""


def polygon(*points: tuple[int, int]) -> Any:
    """A glyph of straight lines."""
    pen = TTGlyphPen(None)
    pen.moveTo(points[0])
    for point in points[1:]:
        pen.lineTo(point)
    pen.closePath()
    return pen.glyph()


GLYPHS = {
    ".notdef": TTGlyphPen(None).glyph,
    "A": lambda: polygon((0, 0), (1000, 0), (1000, 1000), (0, 1000)),
    "frame": lambda: polygon((0, 0), (0, 1000), (1000, 1000), (1000, 0)),
    "left": lambda: polygon((100, 100), (100, 900), (600, 900), (600, 100)),
    "right": lambda: polygon((400, 200), (400, 800), (900, 800), (900, 200)),
    "strip": lambda: polygon((0, 400), (0, 600), (1000, 600), (1000, 400)),
}


def color_font(path: Path, paint: Any, character: str = "A") -> Path:
    """A font whose only character has a paint or layers."""
    builder = FontBuilder(EM, isTTF=True)
    builder.setupGlyphOrder([*GLYPHS])
    builder.setupCharacterMap({ord(character): "A"})
    builder.setupGlyf({name: make() for name, make in GLYPHS.items()})
    outlines = builder.font["glyf"]
    builder.setupHorizontalMetrics({name: (EM, getattr(outlines[name], "xMin", 0)) for name in GLYPHS})
    builder.setupHorizontalHeader(ascent=EM, descent=0)
    builder.setupPost()
    builder.font["COLR"] = buildCOLR({"A": paint})
    builder.font["CPAL"] = buildCPAL([PALETTE])
    builder.save(path)
    return path


def solid(index: int, alpha: float = 1.0) -> dict[str, Any]:
    return {"Format": otTables.PaintFormat.PaintSolid, "PaletteIndex": index, "Alpha": alpha}


def glyph(name: str, paint: dict[str, Any]) -> dict[str, Any]:
    return {"Format": otTables.PaintFormat.PaintGlyph, "Glyph": name, "Paint": paint}


def layers(*paints: dict[str, Any]) -> dict[str, Any]:
    return {"Format": otTables.PaintFormat.PaintColrLayers, "Layers": [glyph("frame", solid(BLUE)), *paints]}


def stops(*offsets: tuple[float, int], extend: str = "pad") -> dict[str, Any]:
    return {
        "Extend": extend,
        "ColorStop": [{"StopOffset": at, "PaletteIndex": index, "Alpha": 1.0} for at, index in offsets],
    }


def composite(mode: str, source: dict[str, Any], backdrop: dict[str, Any]) -> dict[str, Any]:
    kind = otTables.PaintFormat.PaintComposite
    return {"Format": kind, "CompositeMode": mode, "SourcePaint": source, "BackdropPaint": backdrop}


def linear(x0: int, y0: int, x1: int, y1: int, x2: int, y2: int, line: dict[str, Any]) -> dict[str, Any]:
    points = {"x0": x0, "y0": y0, "x1": x1, "y1": y1, "x2": x2, "y2": y2}
    return {"Format": otTables.PaintFormat.PaintLinearGradient, "ColorLine": line} | points


def radial(x0: int, y0: int, r0: int, x1: int, y1: int, r1: int, line: dict[str, Any]) -> dict[str, Any]:
    circles = {"x0": x0, "y0": y0, "r0": r0, "x1": x1, "y1": y1, "r1": r1}
    return {"Format": otTables.PaintFormat.PaintRadialGradient, "ColorLine": line} | circles


def drawn(content: str, below: bool = True) -> bytes:
    """An SVG with the y axis of fonts."""
    frame = f'<path d="{FRAME}" fill="#00f"/>' if below else ""
    turned = f'<g transform="matrix(1 0 0 -1 0 1000)">{frame}{content}</g>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 1000">{turned}</svg>'.encode()


LEFT, RIGHT, STRIP = "M100 100V900H600V100Z", "M400 200V800H900V200Z", "M0 400V600H1000V400Z"
RED_GLYPH, GREEN_GLYPH = glyph("left", solid(RED)), glyph("right", solid(GREEN))


def gradient(kind: str, attributes: str, *offsets: tuple[float, str]) -> str:
    inner = "".join(f'<stop offset="{at}" stop-color="{color}"/>' for at, color in offsets)
    return (
        f'<{kind} id="g" gradientUnits="userSpaceOnUse" {attributes}>{inner}</{kind}><path d="{LEFT}" fill="url(#g)"/>'
    )


def masked(path: str, color: str, by: str, inverse: bool = False) -> str:
    ground = '<path d="M0 0H1000V1000H0Z" fill="#fff"/>' if inverse else ""
    ink = "#000" if inverse else "#fff"
    return f'<mask id="m">{ground}<path d="{by}" fill="{ink}"/></mask><path d="{path}" fill="{color}" mask="url(#m)"/>'


def shifted(paint: dict[str, Any], dx: int, dy: int) -> dict[str, Any]:
    return {"Format": otTables.PaintFormat.PaintTranslate, "Paint": paint, "dx": dx, "dy": dy}


CASES: dict[str, tuple[Any, bytes]] = {
    "layers of version 0": (
        [("frame", BLUE), ("left", RED), ("right", YELLOW)],
        drawn(f'<path d="{LEFT}" fill="#f00"/><path d="{RIGHT}" fill="#ff0" opacity="0.5"/>'),
    ),
    "solid with alpha": (
        layers(glyph("left", solid(RED, 0.25)), GREEN_GLYPH),
        drawn(f'<path d="{LEFT}" fill="#f00" opacity="0.25"/><path d="{RIGHT}" fill="#008000"/>'),
    ),
    "linear gradient": (
        layers(glyph("left", linear(100, 100, 600, 100, 100, 600, stops((0, RED), (1, GREEN))))),
        drawn(gradient("linearGradient", 'x1="100" x2="600"', (0, "#f00"), (1, "#008000"))),
    ),
    "linear gradient askew, reflected": (
        layers(
            glyph("left", linear(100, 100, 300, 100, 300, 300, stops((0.25, RED), (0.75, GREEN), extend="reflect")))
        ),
        drawn(
            gradient(
                "linearGradient",
                'x1="125" y1="75" x2="175" y2="25" spreadMethod="reflect"',
                (0, "#f00"),
                (1, "#008000"),
            )
        ),
    ),
    "radial gradient": (
        layers(glyph("left", radial(300, 450, 50, 350, 500, 400, stops((0, RED), (1, GREEN))))),
        drawn(
            gradient(
                "radialGradient", 'cx="350" cy="500" r="400" fx="300" fy="450" fr="50"', (0, "#f00"), (1, "#008000")
            )
        ),
    ),
    "radial gradient inward, moved": (
        layers(glyph("left", shifted(radial(300, 450, 300, 300, 450, 0, stops((0, RED), (1, GREEN))), 50, 50))),
        drawn(gradient("radialGradient", 'cx="350" cy="500" r="300"', (0, "#008000"), (1, "#f00"))),
    ),
    "moved glyph": (
        layers(shifted(RED_GLYPH, 200, -50)),
        drawn(f'<path d="{LEFT}" fill="#f00" transform="translate(200 -50)"/>'),
    ),
    "glyph in a glyph": (layers(glyph("strip", RED_GLYPH)), drawn(masked(LEFT, "#f00", STRIP))),
    "source in": (layers(composite("src_in", RED_GLYPH, GREEN_GLYPH)), drawn(masked(LEFT, "#f00", RIGHT))),
    "destination out": (
        layers(composite("dest_out", RED_GLYPH, GREEN_GLYPH)),
        drawn(masked(RIGHT, "#008000", LEFT, inverse=True)),
    ),
    "source atop": (
        layers(composite("src_atop", RED_GLYPH, GREEN_GLYPH)),
        drawn(f'<path d="{RIGHT}" fill="#008000"/>' + masked(LEFT, "#f00", RIGHT)),
    ),
    "multiplied": (
        layers(composite("multiply", RED_GLYPH, glyph("right", solid(YELLOW, 1.0)))),
        drawn(
            f'<g style="isolation:isolate"><path d="{RIGHT}" fill="#ff0" opacity="0.5"/>'
            f'<path d="{LEFT}" fill="#f00" style="mix-blend-mode:multiply"/></g>'
        ),
    ),
}


def pictures(found: dict[str, Any], svg: bytes) -> tuple[np.ndarray, np.ndarray]:
    """A glyph's map, and the drawing that it should be."""
    words = np.array(found["words"], dtype=np.uint32)
    (shape,) = found["shapes"]
    assert shape["isMap"]
    texels = np.zeros((1, 1 << ROW_BITS, 4), dtype=np.uint32)
    texels[0, : len(words) // 4] = words.reshape(-1, 4)
    texture = vexture.Texture(texels, (vexture.Root("glyph", quad=shape["quad"], is_map=True),))
    return vexture.render(texture, 40), vexture.render(vexture.convert(vexture.read(svg), split="faces"), 40)


@pytest.mark.parametrize("name", [*CASES])
def test_glyphs_in_colours_are_the_same_drawing(name: str, tmp_path: Path) -> None:
    built("maps")
    paint, svg = CASES[name]
    font = color_font(tmp_path / "color.ttf", paint)
    (reply,) = typeset(tmp_path, [font], [{"id": 1, "texts": [{"text": "A", "fonts": [0]}]}])
    assert reply["results"][0]["notes"] == []
    glyph_picture, drawing_picture = pictures(reply["added"], svg)
    assert np.abs(glyph_picture - drawing_picture).max() < 0.02
    assert drawing_picture.reshape(-1, 4).std(axis=0)[:3].max() > 0.05


def test_a_sweep_is_its_mean_and_a_glyph_of_the_text_s_colour_no_map(tmp_path: Path) -> None:
    sweep = {
        "Format": otTables.PaintFormat.PaintSweepGradient,
        "ColorLine": stops((0, RED), (1, BLUE)),
        "centerX": 0,
        "centerY": 0,
    }
    font = color_font(tmp_path / "sweep.ttf", layers(glyph("left", sweep | {"startAngle": 0, "endAngle": 360})))
    plain = color_font(tmp_path / "plain.ttf", [("left", 0xFFFF), ("right", 0xFFFF)])
    mixed = color_font(tmp_path / "mixed.ttf", [("left", 0xFFFF), ("right", RED)])
    (first, second, third, *_), keys = set_texts(
        tmp_path, [font, plain, mixed], *({"text": "A", "fonts": [place]} for place in range(3))
    )
    assert first["notes"] == ["sweep gradients of glyphs are shown in their mean colours"]
    assert second["notes"] == []
    assert third["notes"] == ["parts in the text's colour, of glyphs that have others, are black here"]
    assert [result["hasInk"] for result in (first, second, third)] == [False, False, True]
    assert keys == ["0::1", "1::1", "2::1"]


def test_parts_in_the_text_s_colour_have_it(tmp_path: Path) -> None:
    """Each colour is another shape, which a restart makes again."""
    built("maps")
    fading = glyph("right", linear(400, 200, 900, 200, 400, 700, stops((0, 0xFFFF), (1, GREEN))))
    font = color_font(tmp_path / "ink.ttf", layers(glyph("left", solid(0xFFFF, 0.5)), fading))
    inks = [[0, "ff8000"], [1, "800080"]]
    texts = [{"text": "AAA", "fonts": [0], "inks": inks}, {"text": "A", "fonts": [0], "inks": [[0, "800080"]]}]
    first, again = typeset(
        tmp_path, [font], [{"id": 1, "texts": texts}, {"id": 2, "restart": {"keys": ["0::1:#800080"]}}]
    )
    assert [shape["key"] for shape in first["added"]["shapes"]] == ["0::1:#ff8000", "0::1:#800080"]
    assert [result["shapes"] for result in first["results"]] == [[0, 1, 1], [1]]
    assert [result["notes"] for result in first["results"]] == [[], []]
    gradient_of_ink = gradient("linearGradient", 'x1="400" x2="900"', (0, "#800080"), (1, "#008000"))
    right = gradient_of_ink.replace(LEFT, RIGHT)
    svg = drawn(f'<path d="{LEFT}" fill="#800080" opacity="0.5"/>{right}')
    glyph_picture, drawing_picture = pictures(again["added"], svg)
    assert np.abs(glyph_picture - drawing_picture).max() < 0.02


def test_emoji_take_a_font_with_colours_unless_they_are_text(tmp_path: Path) -> None:
    font = color_font(tmp_path / "heart.ttf", layers(RED_GLYPH), "\u2764")
    hearts = ("\u2764", "\u2764\ufe0f", "\u2764\ufe0e", "a\u2764\ufe0f\u200db")
    results, keys = set_texts(tmp_path, [DEJAVU, font], *({"text": text} for text in hearts))
    fonts = [[keys[shape].split(":")[0] for shape in result["shapes"]] for result in results]
    assert fonts == [["0"], ["1"], ["0"], ["0", "1", "0"]]
    assert all(result["missing"] == [] for result in results)
