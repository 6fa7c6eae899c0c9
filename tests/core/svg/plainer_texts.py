"""One-issue fixtures of texts that PyPI's resvg does not know, or draws otherwise than the specification says, in words
that it and we know alike."""

from functools import cache

from fontTools.ttLib import TTFont

from same_fonts import FONTS

ROOT = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" font-family="DejaVu Sans" font-size="16"'
SIZE = 16.0
HEBREW = "\u05e1\u05e4\u05d9\u05e0\u05d4"
SHIPS = '<text x="5" y="60" font-size="30">Ships</text>'


@cache
def font() -> TTFont:
    return TTFont(FONTS / "DejaVuSans.ttf")


def advance(text: str, size: float = SIZE) -> float:
    glyphs = [font().getBestCmap()[ord(character)] for character in text]
    return sum(font()["hmtx"][glyph][0] for glyph in glyphs) * size / font()["head"].unitsPerEm


def top_and_bottom(character: str) -> tuple[float, float]:
    glyph = font()["glyf"][font().getBestCmap()[ord(character)]]
    return glyph.yMax / font()["head"].unitsPerEm, glyph.yMin / font()["head"].unitsPerEm


def letters(text: str, x: float, y: float, size: float = SIZE, gap: float = 0.0) -> str:
    """Letters in places of their own, so that nothing but their advances matters."""
    places = []
    for character in text:
        places.append(f"{x:.6f}")
        x += advance(character, size) + gap
    return f'<text x="{" ".join(places)}" y="{y}" font-size="{size}">{text}</text>'


def bolder(size: float) -> float:
    """Width of the stroke by which Skia makes letters bolder."""
    return size * (1 / 24 + (1 / 32 - 1 / 24) * (size - 9) / (36 - 9))


def upright(text: str, lying: str = "") -> str:
    """Characters below one another, on the baselines of lines as high as the font's; some of them lie on their side."""
    over, under = (getattr(font()["hhea"], name) * SIZE / 2048 for name in ("ascent", "descent"))
    down, drawn = 10.0, ""
    for character in text:
        if character in lying:
            turned = f"translate({50 - (over + under) / 2} {down}) rotate(90)"
            drawn += f'<text transform="{turned}">{character}</text>'
            down += advance(character)
            continue
        drawn += f'<text x="{50 - advance(character) / 2}" y="{down + over}">{character}</text>'
        down += over - under
    return drawn


def bar(x: float, y: float, width: float, height: float, paint: str = "") -> str:
    return f'<path d="M{x} {y}h{width}v{height}h{-width}z" {paint}/>'


def heights() -> tuple[float, float, float, float]:
    """Ascent, descent, and position and thickness of the middle of an underline; user units."""
    over, under = (getattr(font()["hhea"], name) * SIZE / 2048 for name in ("ascent", "descent"))
    post = font()["post"]
    return over, -under, post.underlinePosition * SIZE / 2048, post.underlineThickness * SIZE / 2048


def strike() -> float:
    """Height of the middle of a line through letters."""
    return font()["OS/2"].yStrikeoutPosition * SIZE / 2048


def beside(offset: float, drawn: str, lying: str = "", symbols: int = 2) -> str:
    """Vertical text that begins at (50, 10), with a line at a distance to the right of its middle."""
    over, under, _, thickness = heights()
    length = advance(lying) + symbols * (over + under)
    return drawn + bar(50 + offset - thickness / 2, 10, thickness, length)


def underline_text(line: str) -> str:
    """A text with a line in the place of its underline, which a path draws in a middle at (0, 0)."""
    return f'<text x="10" y="50">ship</text><g transform="translate(10 {50 - heights()[2]})">{line}</g>'


def double(y: float, first: float) -> str:
    """A text, and two lines of which the middle of the first is at a height over its baseline."""
    thickness = heights()[3]
    lines = (bar(10, y - first + k * 2 * thickness - thickness / 2, advance("ship"), thickness) for k in range(2))
    return f'<text x="10" y="{y}">ship</text>' + "".join(lines)


def waves(count: int, width: float) -> str:
    half = width / count
    return "M0 0" + "".join(f"c{half / 2} {down} {half / 2} {down} {half} 0" for down in ((4, -4) * count)[:count])


def subscript_drop() -> float:
    """Distance of subscripts below the baseline, in ems."""
    return font()["OS/2"].ySubscriptYOffset / 2048


def superscript_rise() -> float:
    return font()["OS/2"].ySuperscriptYOffset / 2048


def spread(text: str, shift: float, length: float) -> str:
    """Letters in a length that begins at (5, 30), with a shift before the third one."""
    gap = (length - shift - advance(text)) / (len(text) - 1)
    return letters(text[:2], 5, 30, gap=gap) + letters(text[2:], 5 + shift + advance(text[:2]) + 2 * gap, 30, gap=gap)


SIDEWAYS = '<text x="50" y="10" writing-mode="tb">ship</text>'

PLAINER = {
    "text-transform-dotted": '<text y="20" x="5">DİII</text><text y="45" x="5">dıii</text><text y="70" x="5">İn It'
    '</text><text y="95" x="5">İI</text>',
    # shifts within a chunk are of its length (SVG 2, 11.5, "Resolve text length" and "Adjust positions: anchoring")
    "anchor-with-dx": f'<text x="{40 - advance("ship") / 2}" y="30" dx="0 10 10">ship</text>'
    f'<text x="{80 - advance("ship")}" y="60" dx="0 5">ship</text>',
    "text-length-with-dx": spread("ship", 10, 80)
    + f'<g transform="translate(10 60) scale({80 / (advance("ship") + 10)} 1)">'
    '<text>sh<tspan dx="10">ip</tspan></text></g>',
    "tspan-blend-mode": '<rect width="100" height="100" fill="yellow"/><text x="10" y="50" font-size="30">a</text>'
    f'<text x="{10 + advance("a", 30)}" y="50" font-size="30" fill="red" style="mix-blend-mode: difference">bc</text>',
    # by the size of what is around (CSS Inline 3, 4.2.2)
    "baseline-shift-sub": '<text x="10" y="50">one</text>'
    + letters("two", 10 + advance("one"), 50 + SIZE * subscript_drop(), 10),
    "baseline-shift-super": '<text x="10" y="50">one</text>'
    + letters("two", 10 + advance("one"), 50 - SIZE * superscript_rise(), 10),
    "baseline-shift-smaller": '<text x="10" y="50">a</text>'
    + letters("b", 10 + advance("a"), 50 + SIZE * subscript_drop(), 10)
    + letters("c", 10 + advance("a") + advance("b", 10), 50 + SIZE * subscript_drop() - 10 * superscript_rise(), 20),
    # "a collapsible space following another collapsible space is collapsed", also of another element, and no other
    "between-spaces": '<text x="5" y="50">a b c</text>',
    "spaces-default-in-preserved": '<text x="5" y="50" xml:space="preserve">a  b c d  e</text>',
    "tspan-not-displayed": '<text x="10" y="50">one six</text>',
    "white-space-pre": '<text x="10" y="50" xml:space="preserve">  a  b </text>',
    "bidi-override": '<text x="10" y="50">a pihs one</text>',
    "direction-rtl-latin": '<text x="90" y="50" text-anchor="end">!ship</text>',
    "direction-rtl": f'<text x="90" y="50" text-anchor="end">ship {HEBREW}</text>',
    "dominant-middle": f'<text x="10" y="{50 + top_and_bottom("x")[0] * SIZE / 2}">Harbour</text>',
    "alignment-middle": '<text x="10" y="50">one</text>'
    f'<text x="{10 + advance("one")}" y="{50 + top_and_bottom("x")[0] * SIZE / 2}">two</text>',
    "feature-settings": letters("office", 10, 50, 24),
    "font-shorthand": '<text x="5" y="50" font-style="italic" font-weight="bold" font-size="20">Harbour</text>',
    "font-size-adjust": f'<text x="5" y="50" font-size="{SIZE * 0.4 / top_and_bottom("x")[0]}">Ship</text>',
    "font-size-words": '<text x="5" y="30" font-size="13">small</text>'
    '<text x="5" y="60" font-size="19.2">larger</text>',
    "font-weight-bolder": '<text x="5" y="50"><tspan font-weight="bold">a</tspan>b<tspan font-weight="bold">c</tspan>'
    "</text>",
    # "user agents should not apply optional ligatures when letter-spacing is not zero" (CSS Text 3, 8.2)
    # shifts add up in logical order
    "hebrew-dx": "".join(
        f'<text x="{92 - advance(HEBREW[: k + 1]) + shift}" y="{50 + 5 * (k > 0)}">{letter}</text>'
        for k, (letter, shift) in enumerate(zip(HEBREW, (0, -5, -10, -7, -7), strict=True))
    ),
    # a ligature has the shift of its first character, and what follows that of the others
    "ligature-dx": '<text x="5" y="50" text-decoration="underline">offi<tspan dx="5" dy="3">ce</tspan></text>',
    "letter-spacing-no-ligature": letters("office", 5, 50, 20, 1.0),
    "path-data": '<path id="p" d="M10 50H90" fill="none"/><text><textPath href="#p">ship</textPath></text>',
    # "effectively reverses the path direction" (SVG 2, 11.8.2)
    "path-side": '<path id="p" d="M90 50H10" fill="none"/><text><textPath href="#p">ship</textPath></text>',
    # what follows goes on from the end of the path (SVG 2, 11.5, "Position on path")
    "path-text-after": '<path id="p" d="M10 70C10 10 90 10 90 70" fill="none"/>'
    '<text><textPath href="#p">path</textPath></text>'
    f'<text x="{90 + advance(" ")}" y="70">b</text>',
    "pattern-fill": f'<clipPath id="c">{SHIPS}</clipPath><g clip-path="url(#c)" fill="red">'
    + "".join(f'<rect x="{x}" width="3" height="100"/>' for x in range(0, 100, 6))
    + "</g>",
    "small-caps": f'<text x="5" y="50">H<tspan font-size="{0.7 * SIZE}">ARBOUR</tspan></text>',
    "synthetic-bold": '<text x="5" y="50" font-family="cmr10" font-size="24" stroke="black" '
    f'stroke-width="{bolder(24)}">Ship</text>',
    "synthetic-oblique": '<text transform="translate(5 50) skewX(-14)" font-family="cmr10" font-size="24">Ship</text>',
    # the last gap does not count for the anchor, as in browsers
    "text-length-middle": letters("ship", 10, 50, SIZE, (80 - advance("ship")) / 3),
    "text-length-with-tspans": f'<text x="10" y="50" letter-spacing="{(80 - advance("abcdef")) / 5}">'
    'ab<tspan fill="red">cd</tspan>ef</text>',
    # lists of positions are for the characters of the document
    "text-transform-longer": '<text y="30" x="5">ASSB</text><text y="60" x="5 32" rotate="0 20 20">ASS</text>'
    '<text y="60" x="60 80">BC</text><text y="90" x="5">\u01c5ep A\u00df</text>'
    '<text y="14" x="5">Don\'t O\u0308f A_b</text>'
    '<text y="76" x="5">\u03c3\u03b1\u03c2 \u03c3\u03b1 \u03c3</text>',
    "text-transform": '<text x="5" y="50">SHIPS</text>',
    "vertical-upright-symbols": upright("a\u2605b\u2660", "ab"),
    "vertical-upright-letters": upright("Ship"),
    # beside the letters, as in browsers, and as thick as the font says
    "vertical-underline": beside(
        -sum(heights()[:2]) / 2, '<text x="50" y="10" writing-mode="tb">ship</text>', "ship", 0
    ),
    "vertical-overline": beside(sum(heights()[:2]) / 2, SIDEWAYS, "ship", 0),
    "vertical-lines": "".join(
        beside(where, '<text x="50" y="10" writing-mode="tb">abc</text>', "abc", 0)
        for where in (sum(heights()[:2]) / 2, -sum(heights()[:2]) / 2, strike() - (heights()[0] - heights()[1]) / 2)
    ),
    "vertical-upright-underline": beside(-sum(heights()[:2]) / 2, upright("\u2605\u2660")),
    "vertical-line-through": beside(strike() - (heights()[0] - heights()[1]) / 2, upright("a\u2605b", "ab"), "ab", 1),
    # a colour is that of the whole line, which has no stroke; `currentcolor` is the text's paint, as in browsers
    "decoration-color": '<text x="10" y="50" stroke="blue">ship</text>'.join(
        [bar(10, 50 - heights()[2] - heights()[3] / 2, advance("ship"), heights()[3], 'fill="red"'), ""]
    ),
    "decoration-current-color": '<text x="10" y="50" fill="blue" text-decoration="underline">ship</text>',
    "decoration-thickness": underline_text(bar(0, -0.8, advance("ship"), 1.6)),
    "decoration-dashed": underline_text(
        f'<path d="M0 0h{advance("ship")}" stroke="black" stroke-width="2" stroke-dasharray="6 4"/>'
    ),
    "decoration-dotted": underline_text(
        "".join(f'<circle cx="{2 + 8 * k}" r="2"/>' for k in range(int((advance("ship") + 2) / 8)))
    ),
    "decoration-double": double(30, heights()[2])
    + double(60, heights()[0] + 2 * heights()[3])
    + double(90, strike() + heights()[3]),
    "decoration-wavy": underline_text(
        f'<path d="{waves(round(advance("ship") / 6), advance("ship"))}" fill="none" stroke="black" stroke-width="2"/>'
    ),
    "text-length-zero": '<text x="10" y="50">ship</text>',
    # browsers composite a part of a text that has an opacity by itself
    "tspan-opacity": '<text x="10" y="50">one</text><g opacity="0.3" fill="red" stroke="blue" stroke-width="2">'
    f'<text x="{10 + advance("one ")}" y="50">two</text>'
    f'<text x="{10 + advance("one two ")}" y="50" opacity="0.5">six</text></g>',
    "tspan-opacity-zero": '<text x="10" y="50" text-decoration="underline">one '
    '<tspan visibility="hidden">two</tspan> six</text>',
    "tspan-opacity-in-clip": '<text x="10" y="50">one two</text>',
}


def plainer_text(name: str) -> str | None:
    """The file that says the same as a fixture of a text; None if resvg knows the fixture itself."""
    body = PLAINER.get(name)
    return body and f"<svg {ROOT}>{body}</svg>"
