"""Fonts that tests make: small ones with all that a test needs, in colour too."""

import io

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont
from fontTools.ttLib.tables._g_l_y_f import ROUND_XY_TO_GRID, Glyph, GlyphComponent
from fontTools.ttLib.tables.otTables import CompositeMode, PaintFormat

UNITS = 1000
RED, GREEN, BLUE, HALF, CLEAR_RED = range(5)
PALETTE = [(1.0, 0.0, 0.0, 1.0), (0.0, 0.7, 0.2, 1.0), (0.1, 0.2, 0.9, 1.0), (1.0, 0.8, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0)]
OWN = 0xFFFF  # of the palette: the text's own colour


def polygon(*points):
    pen = TTGlyphPen(None)
    pen.moveTo(points[0])
    for point in points[1:]:
        pen.lineTo(point)
    pen.closePath()
    return pen.glyph()


def box(left, bottom, right, top):
    return polygon((left, bottom), (left, top), (right, top), (right, bottom))


def disc(x, y, radius):
    """Four quadratics, and so no true circle."""
    pen = TTGlyphPen(None)
    pen.moveTo((x + radius, y))
    for a, b in (((1, -1), (0, -1)), ((-1, -1), (-1, 0)), ((-1, 1), (0, 1)), ((1, 1), (1, 0))):
        pen.qCurveTo((x + a[0] * radius, y + a[1] * radius), (x + b[0] * radius, y + b[1] * radius))
    pen.closePath()
    return pen.glyph()


def composite_glyph(*names):
    """Make a glyph of others, each where it is in its own."""
    glyph = Glyph()
    glyph.numberOfContours = -1
    glyph.xMin, glyph.yMin, glyph.xMax, glyph.yMax = 0, 0, 700, 700
    glyph.components = []
    for name in names:
        part = GlyphComponent()
        part.glyphName, part.x, part.y, part.flags = name, 0, 0, ROUND_XY_TO_GRID
        glyph.components.append(part)
    return glyph


def replace_glyphs(content, glyphs):
    """Replace the glyphs of some characters, by damaged ones too; return the font's bytes."""
    font = TTFont(io.BytesIO(content), recalcBBoxes=False)
    for character, glyph in glyphs.items():
        font["glyf"].glyphs[f"u{ord(character):04X}"] = glyph
    file = io.BytesIO()
    font.save(file)
    return file.getvalue()


SHAPES = {
    "square": box(100, 0, 800, 700),
    "disc": disc(550, 450, 350),
    "left": box(100, 0, 500, 700),
    "tall": box(350, -100, 600, 800),
}
"""Glyphs that those in colour are painted of."""


def compress_font(content, flavor="woff2"):
    """Compress a font for the web; return its bytes."""
    font, file = TTFont(io.BytesIO(content)), io.BytesIO()
    font.flavor = flavor
    font.save(file)
    return file.getvalue()


def made_font(
    characters,
    paints=None,
    family="Made",
    weight=400,
    advance=900,
    kerning=None,
    alike=(),
    style="Regular",
    **info,
):
    """Bytes of a font: glyphs of characters, by the name of a shape or as a glyph, some of them with a COLR paint.

    `alike` are further characters, and those whose glyphs they have; `style` is in its own names, and `info` goes into
    the table OS/2.
    """
    glyphs = {".notdef": box(50, 0, 450, 700), "space": TTGlyphPen(None).glyph(), **SHAPES}
    names = {char: f"u{ord(char):04X}" for char in characters}
    for char, shape in characters.items():
        glyphs[names[char]] = SHAPES[shape] if isinstance(shape, str) else shape
    builder = FontBuilder(UNITS, isTTF=True)
    builder.setupGlyphOrder(list(glyphs))
    others = {ord(char): names[other] for char, other in dict(alike).items()}
    builder.setupCharacterMap({ord(char): name for char, name in names.items()} | others | {32: "space"})
    builder.setupGlyf(glyphs)
    builder.setupHorizontalMetrics({name: (advance, getattr(glyph, "xMin", 0)) for name, glyph in glyphs.items()})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    own = {"fullName": f"{family} {style}", "psName": f"{family}-{style}"}
    builder.setupNameTable({"familyName": family, "styleName": "Regular", **own})
    builder.setupOS2(usWeightClass=weight, sxHeight=500, sCapHeight=700, **info)
    builder.setupPost(underlinePosition=-100, underlineThickness=50)
    if kerning:
        builder.addOpenTypeFeatures(
            "\n".join(["feature kern {", *(f"pos {a} {b} {v};" for a, b, v in kerning), "} kern;"])
        )
    if paints is not None:
        builder.setupCOLR({names[char]: paint for char, paint in paints.items()})
        builder.setupCPAL([PALETTE])
    file = io.BytesIO()
    builder.save(file)
    return file.getvalue()


def solid(color, alpha=1.0):
    return {"Format": PaintFormat.PaintSolid, "PaletteIndex": color, "Alpha": alpha}


def fill_shape(shape, paint):
    return {"Format": PaintFormat.PaintGlyph, "Glyph": shape, "Paint": paint}


def line(*stops, extend="pad"):
    stops = [{"StopOffset": at, "PaletteIndex": color, "Alpha": alpha} for at, color, alpha in stops]
    return {"ColorStop": stops, "Extend": extend}


def linear(colors, *points):
    numbers = dict(zip(("x0", "y0", "x1", "y1", "x2", "y2"), points, strict=True))
    return {"Format": PaintFormat.PaintLinearGradient, "ColorLine": colors, **numbers}


def radial(colors, *circles):
    numbers = dict(zip(("x0", "y0", "r0", "x1", "y1", "r1"), circles, strict=True))
    return {"Format": PaintFormat.PaintRadialGradient, "ColorLine": colors, **numbers}


def sweep(colors, x, y, start, end):
    angles = {"centerX": x, "centerY": y, "startAngle": start, "endAngle": end}
    return {"Format": PaintFormat.PaintSweepGradient, "ColorLine": colors, **angles}


def transform_paint(paint, *matrix):
    numbers = dict(zip(("xx", "yx", "xy", "yy", "dx", "dy"), matrix, strict=True))
    return {"Format": PaintFormat.PaintTransform, "Paint": paint, "Transform": numbers}


def composite(mode, source, backdrop):
    mode = getattr(CompositeMode, mode)
    return {
        "Format": PaintFormat.PaintComposite,
        "SourcePaint": source,
        "CompositeMode": mode,
        "BackdropPaint": backdrop,
    }


def stack_paints(*paints):
    return {"Format": PaintFormat.PaintColrLayers, "Layers": list(paints)}
