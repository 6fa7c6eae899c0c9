"""One-issue fixtures that PyPI's resvg does not know, in words that it and we understand alike."""

import numpy as np
from plainer_styles import STYLES

ARROW = '<path d="M0 0L10 5L0 10z" fill="red"/>'
ROOF = '<path d="M20 80L50 20L80 80" fill="none" stroke="blue" stroke-width="4"/>'
ROOF_UPRIGHT = ((20, 80, 0), (50, 20, 0), (80, 80, 0))
ROOF_TURNED = ((20, 80, -63.4349), (50, 20, 0), (80, 80, 63.4349))
TRIANGLE = '<path d="M20 25L80 25L50 80z" fill="none" stroke="blue" stroke-width="3"/>'
TRIANGULAR = ((20, 25, -59.3052), (80, 25, 59.3052), (50, 80, 180))
DOT = '<circle cx="8" cy="8" r="7" fill="#208040"/><path d="M0 0h9v9z" fill="#e0c020"/>'
LAST = '<rect x="60" y="60" width="30" height="30" fill="green"/>'
FIELD = '<rect x="10" y="20" width="80" height="60" fill="url(#{})"/>'
BALL = '<circle cx="50" cy="50" r="30" fill="#204080"/>'
RAMP = '<stop stop-color="#e02020"/><stop offset="0.4" stop-color="#f0d020"/><stop offset="1" stop-color="#2040e0"/>'
PAGE = '<clipPath id="page"><path d="M0 0h100v100h-100z"/></clipPath>'
PARTS = (
    '<g clip-path="url(#page)"><circle cx="90" cy="40" r="30" fill="#208040"/>'
    '<path d="M10 10h40v20h-40z" fill="#2040e0"/></g>'
)


EDGED = '<rect x="20" y="30" width="60" height="40" fill="#fc8" stroke="#2040e0" stroke-width="10"/>'


def clip_content(clip: str, content: str) -> str:
    """Clip content by shapes."""
    return f'<clipPath id="c">{clip}</clipPath><g clip-path="url(#c)">{content}</g>'


def add_markers(under: str, *places: tuple[float, float, float], scale: float = 0.9, arrow: str = ARROW) -> str:
    """Add the content of markers over a shape, at places of x, y and degrees."""
    turned = (f"translate({x} {y}) rotate({turn}) scale({scale}) translate(-5 -5)" for x, y, turn in places)
    return under + "".join(f'<g transform="{transform}">{arrow}</g>' for transform in turned)


def gradient_page(line: str, *stops: tuple[float, str], kind: str = "linear") -> str:
    """Page that a gradient fills, and a disc on it."""
    ramp = "".join(f'<stop offset="{offset}" stop-color="{color}"/>' for offset, color in stops)
    return (
        f'<{kind}Gradient id="g" gradientUnits="userSpaceOnUse" {line}>{ramp}</{kind}Gradient>'
        '<path fill="url(#g)" d="M0 0h100v100h-100z"/><circle cx="50" cy="50" r="20" fill="#204080"/>'
    )


def light_stops(
    first: str, last: str, low: float = 0.0, high: float = 1.0, opacity: tuple[float, float] = (1, 1)
) -> str:
    """Very many stops of a gradient in linear light (IEC 61966-2-1) between two colours in hexadecimal notation."""
    ends = np.array([[int(color[k : k + 2], 16) for k in (1, 3, 5)] for color in (first, last)]) / 255
    light = np.where(ends <= 0.04045, ends / 12.92, ((ends + 0.055) / 1.055) ** 2.4)
    t = np.linspace(0.0, 1.0, 200)
    colors = (1.0 - t)[:, None] * light[0] + t[:, None] * light[1]
    colors = 100 * np.where(colors <= 0.0031308, 12.92 * colors, 1.055 * colors ** (1 / 2.4) - 0.055)
    return "".join(
        f'<stop offset="{low + at * (high - low)}" stop-opacity="{opacity[0] + at * (opacity[1] - opacity[0])}"'
        f' stop-color="rgb({red}% {green}% {blue}%)"/>'
        for at, (red, green, blue) in zip(t.tolist(), colors.tolist(), strict=True)
    )


def box() -> str:
    """The rectangle of the animated fixtures."""
    return '<rect x="20" y="30" width="40" height="30" fill="#208040"/>'


CORNER = '<path d="M80 80h15v15z" fill="#fc8"/>'

PLAINER = {
    # gradients in linear light, which resvg does not know, as ones of very many stops
    "gradients/linear-light": f"""<linearGradient id="g">{light_stops("#000000", "#ffa040", 0.0, 0.6)}{
        light_stops("#ffa040", "#004080", 0.6, 1.0, (1.0, 0.5))
    }</linearGradient><rect width="100" height="100" fill="url(#g)"/>""",
    "gradients/linear-light-inherited": f"""<radialGradient id="b">{light_stops("#ffffff", "#400000")}</radialGradient>
    <radialGradient id="c"><stop stop-color="white"/><stop offset="1" stop-color="#400000"/></radialGradient>
    <rect width="50" height="100" fill="url(#b)"/><rect x="50" width="50" height="100" fill="url(#c)"/>""",
    # drawings without their animations, which PyPI's resvg runs neither; what only an animation shows is seen
    "animation/at-rest": box() + CORNER,
    "animation/fades-in": f'<g opacity="0.5">{box()}</g>',
    "animation/css-fades-in": f'<g opacity="0.5">{box()}</g>',
    "animation/shown-later": box() + CORNER,
    "animation/css-shown-later": box() + CORNER,
    "animation/line-is-drawn": '<path d="M10 30H90M10 70H90" stroke="#208040" stroke-width="20"/>',
    "animation/dashes-that-move": '<path d="M10 30H90" stroke="#208040" stroke-width="20" stroke-dasharray="20 10"'
    ' stroke-dashoffset="5"/>',
    "animation/grows": box() + '<circle cx="80" cy="80" r="9" fill="#fc8"/>',
    "animation/filled-later": box() + CORNER,
    "animation/on-click": box(),
    "animation/important": box(),
    "animation/custom-property": f'<g opacity="0.5">{box()}</g>',
    "animation/in-an-image": box(),
    "structure/no-namespace-in-svg": '<rect x="30" y="30" width="50" height="40" fill="#208040"/>',
    "style/percent-encoded-links": '<path d="M10 10h30v30h-30zM10 50h30v30h-30z" fill="#208040"/>'
    '<path d="M50 10h30v30h-30z" fill="#fc8"/>',
    **STYLES,
    # "A value of zero disables rendering of the element" (SVG 2, 8.6), which is nothing where it fills a shape
    "errors/view-box-nested-zero": LAST,
    "errors/view-box-of-pattern": LAST,
    # "transform" is a property of gradients and patterns, too, over their attributes (CSS Transforms 1, 8)
    "transform/css-of-gradient": '<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="20" x2="80"'
    f' gradientTransform="rotate(30)">{RAMP}</linearGradient>{FIELD.format("g")}',
    "transform/css-of-pattern": '<pattern id="p" width="20" height="20" patternUnits="userSpaceOnUse"'
    f' patternTransform="rotate(30)">{DOT}</pattern>{FIELD.format("p")}',
    # as browsers have it: the clips and masks of a viewport are in the units of its content
    "masks/clip-of-svg-in-its-units": '<clipPath id="c"><circle cx="60" cy="36.6667" r="26.6667"/></clipPath>'
    '<path clip-path="url(#c)" d="M20 10H100V90H20z"/>',
    # basic shapes of CSS, in the box around the stroke unless another is named (CSS Masking 1, 5; CSS Shapes 1, 3)
    "masks/clip-by-css-circle": clip_content(
        '<circle cx="50" cy="50" r="25"/>', EDGED.replace("/>", ' stroke-dasharray="9"/>')
    ),
    "masks/clip-by-css-circle-in-box": clip_content('<circle cx="70" cy="40" r="25.4951"/>', EDGED),
    "masks/clip-by-css-ellipse": clip_content(
        '<ellipse cx="10" cy="44" rx="60" ry="20"/>', '<rect x="10" y="20" width="60" height="60" fill="#208040"/>'
    ),
    # radii that overlap become less in one proportion (CSS Backgrounds 3, 4.5)
    "masks/clip-by-css-inset": '<path fill="#208040" d="M62.3636 18H66.7273A7.2727 7.2727 0 0 1 74 25.2727V66H37.6364'
    'A11.6364 11.6364 0 0 1 26 54.3636A36.3636 36.3636 0 0 1 62.3636 18Z"/>',
    "masks/clip-by-css-rect": '<g fill="#208040"><rect x="18" y="15" width="52" height="35" rx="8"/>'
    '<rect x="20" y="65" width="40" height="15"/></g>',
    "masks/clip-by-css-polygon": clip_content(
        '<path clip-rule="evenodd" d="M50 0L80 100L0 35L100 35L20 100z"/>',
        '<path fill="#208040" d="M10 10H90V90H10z"/>',
    ),
    "masks/clip-by-css-path": clip_content(
        '<path d="M35 10H85V70z"/>', '<circle cx="55" cy="40" r="30" fill="#208040"/>'
    ),
    "masks/clip-by-css-box": clip_content('<path d="M20 30h60v40h-60z"/>', EDGED),
    "masks/clip-by-css-of-line": '<path d="M30 46h40v8h-40z" fill="#208040"/>',
    "masks/clip-by-css-under-rules": '<circle cx="50" cy="45" r="30" fill="#208040"/>',
    "masks/mask-shorthand": '<circle cx="50" cy="50" r="30"/>',
    "masks/mask-mode": '<circle cx="50" cy="50" r="30"/>',
    "masks/mask-mode-in-shorthand": '<circle cx="90" cy="90" r="9"/>',
    "masks/with-prefixes": '<path d="M50 20a30 30 0 0 0 0 60z"/>',
    "style/escaped-link": '<path d="M10 10h30v30h-30z" fill="#208040"/><path d="M50 10h30v30h-30z" fill="#fc8"/>',
    "masks/mask-image": '<circle cx="50" cy="50" r="30"/>',
    "background/gradient": gradient_page('y1="0" x2="0" y2="100"', (0, "#fc8"), (1, "#8cf")),
    "background/gradient-to-side": gradient_page(
        'x2="100"', (0.2, "#fc8"), (0.6, "#8cf"), (0.6, "#404"), (0.8, "#404"), (1, "#484")
    ),
    "background/gradient-repeats": gradient_page(
        'y1="100" x2="14.142136" y2="85.857864" spreadMethod="repeat"',
        *((0, "#fc8"), (0.5, "#fc8"), (0.5, "#8cf"), (1, "#8cf")),
    ),
    "background/gradient-radial": gradient_page(
        'cx="40" cy="30" r="30"', (0, "#fc8"), (0.5, "#8cf"), (1, "#404"), kind="radial"
    ),
    "background/gradient-of-rings": gradient_page(
        'cx="0" cy="0" r="36" fr="4" spreadMethod="repeat" gradientTransform="translate(50 50) scale(1 0.5)"',
        *((0, "#fc8"), (0.625, "#8cf"), (1, "#fc8")),
        kind="radial",
    ),
    "background/shorthand": f'<path fill="#fc8" d="M0 0h100v100h-100z"/>{BALL}',
    "background/is-no-attribute": BALL,
    "background/fades": f'<g opacity="0.5"><path fill="#fc8" d="M0 0h100v100h-100z"/>{BALL}</g>',
    "background/of-current-color": f'<path fill="#8cf" d="M0 0h100v100h-100z"/>{BALL}',
    "images/background": '<path fill="#fc8" d="M10 35h60v30h-60z"/><circle cx="37" cy="50" r="12" fill="#208040"/>',
    # "A reference to a non-existent object is considered ... the whole filter chain is ignored" (Filter Effects 1, 5)
    "filters/missing": '<rect x="10" y="10" width="30" height="30"/><rect x="50" y="50" width="30" height="30"/>',
    "gradients/attributes-by-reference": '<linearGradient id="g" x1="0.1" x2="0.3" gradientTransform="rotate(20)"'
    f' spreadMethod="reflect">{RAMP}</linearGradient><rect x="10" y="20" width="80" height="60" fill="url(#g)"/>',
    # a template gives only attributes that it knows itself (SVG 2, 14.1.1); browsers look further, in its own template
    "gradients/lengths-of-the-other-kind": f'<radialGradient id="g" cx="0.3" spreadMethod="reflect">{RAMP}'
    f"</radialGradient>{FIELD.format('g')}",
    "gradients/stroke-not-scaling": f'<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="20" x2="80">{RAMP}'
    '</linearGradient><path d="M20 15H80V60" fill="none" stroke="url(#g)" stroke-width="10"/>',
    "groups/blend-upper-case": '<path fill="#c08040" d="M0 20h100v40h-100z"/>'
    '<path style="mix-blend-mode: multiply" fill="#8f8" d="M30 0h20v100h-20z"/>',
    "groups/opacity-of-nested-svg": '<g opacity="0.5"><path fill="red" d="M10 10h50v50h-50z"/>'
    '<circle fill="blue" cx="60" cy="60" r="25"/></g>',
    # opacity, clips and masks apply to container elements, of which a marker is one (CSS Masking 1, 1.2)
    "markers/clip-of-marker": '<clipPath id="c"><circle cx="5" cy="5" r="3"/></clipPath>'
    + add_markers(ROOF, *ROOF_TURNED, scale=2.4, arrow=f'<g clip-path="url(#c)">{ARROW}</g>'),
    "markers/opacity-of-marker": add_markers(ROOF, *ROOF_UPRIGHT, scale=2.4, arrow=f'<g opacity="0.5">{ARROW}</g>'),
    # "bisecting the angle between the direction at the end of the incoming segment and the direction at the start of
    # the outgoing one", at the ends of a closed subpath, too (SVG 2, 13.7.4)
    "markers/closed": add_markers(TRIANGLE, *TRIANGULAR, TRIANGULAR[0]),
    "markers/closed-by-hand": add_markers(TRIANGLE, *TRIANGULAR, (20, 25, -118.6105), TRIANGULAR[0]),
    "markers/on-polygon": add_markers(TRIANGLE.replace('"3"', '"4"'), *TRIANGULAR, TRIANGULAR[0], scale=1.2),
    "markers/several-parts": add_markers(
        '<path d="M10 20L40 20L40 40M60 20L90 20L75 45zM10 70L40 80L80 70" fill="none" stroke="blue"'
        ' stroke-width="3"/>',
        *((10, 20, 0), (40, 20, 45), (40, 40, 90)),
        *((60, 20, -60.482), (90, 20, 60.482), (75, 45, 180), (60, 20, -60.482)),
        *((10, 70, 18.435), (40, 80, 2.1995), (80, 70, -14.036)),
    ),
    "markers/move-after-close": add_markers(
        '<path d="M20 20L60 20L60 50zL80 80" fill="none" stroke="blue" stroke-width="3"/>',
        *((20, 20, -71.565), (60, 20, 45), (60, 50, 153.435), (20, 20, -71.565), (80, 80, 45)),
    ),
    # "zero length and ... any preceding non-zero length segments: the same as the direction at the end of the closest"
    # one, and at its end as at the start of the closest one that follows (SVG 2, 9.4)
    "markers/orient-zero-length": add_markers(
        '<path d="M20 70L50 30L80 70" fill="none" stroke="blue" stroke-width="3"/>',
        *((20, 70, -53.1301), (50, 30, -53.1301), (50, 30, 53.1301), (80, 70, 53.1301)),
    ),
    "markers/orient-curve-without-arm": add_markers(
        '<path d="M15 50C15 50 30 10 50 40C60 80 85 60 85 60" fill="none" stroke="blue" stroke-width="3"/>',
        *((15, 50, -69.444), (50, 40, 66.137), (85, 60, -38.66)),
    ),
    # resvg marks the curves of which it makes an arc
    "markers/orient-arcs": add_markers(
        '<path d="M10 50A20 20 0 0 1 50 50A30 30 0 0 1 80 80" fill="none" stroke="blue" stroke-width="3"/>',
        *((10, 50, -90), (50, 50, 45), (80, 80, 90)),
    ),
    # resvg knows no keywords: "0%, 50% and 100% of the viewBox width" (SVG 2, 13.7.1)
    "markers/reference-keywords": add_markers(ROOF, *((x - 6, y, turn) for x, y, turn in ROOF_UPRIGHT), scale=1.2),
    # "the marker content is clipped to the marker's viewport" unless its overflow is visible
    "markers/view-box-sliced": add_markers(
        ROOF, *ROOF_UPRIGHT, scale=2.4, arrow='<path d="M0 5H10L0 10z" fill="red"/>'
    ),
    # as browsers do, and SVG 1.1: "drawn at the vertices of path, line, polyline or polygon elements"
    "markers/not-on-other-shapes": '<g fill="blue"><rect x="10" y="10" width="30" height="30"/>'
    '<circle cx="70" cy="30" r="15"/><ellipse cx="50" cy="70" rx="30" ry="10"/></g>',
    "paths/data-in-css": '<path d="M10 10H90V90z"/>',
    "strokes/dashes-path-length": '<path d="M10 44h8v12h-8zm16 0h8v12h-8zm16 0h8v12h-8zm16 0h8v12h-8zm16 0h8v12h-8z"/>',
    # the outer circle has the radius 40 + 6, and meets the line at x = 30 - 6 (SVG 2, 13.5.6)
    "strokes/join-arcs": '<path d="M24 90V34.393A46 46 0 0 1 76 80H64A34 34 0 0 0 36 46.534V90z"/>',
    # clipped 1.2 * 12 / 2 above the corner (SVG 2, 13.5.5)
    "strokes/join-miter-clip": '<path d="M14.6334 77.3167L46.8918 12.8H53.1082L85.3666 77.3167L74.6334 82.6833'
    'L50 33.4164L25.3666 82.6833z"/>',
    "strokes/not-scaling": '<path fill="none" stroke="black" stroke-width="10" d="M20 15L50 75L80 15"/>',
    "style/geometry-in-css": '<circle cx="50" cy="50" r="30"/>',
    "style/important": '<g fill="red"><path d="M10 10h30v30h-30z"/><path fill="blue" d="M50 50h30v30h-30z"/></g>',
    "style/invalid-color-inherits": '<rect x="10" y="10" width="30" height="30" fill="red"/>',
    "style/invalid-style-falls-back": '<rect x="10" y="10" width="30" height="30" fill="red"/>',
    "style/media": '<rect x="10" y="10" width="30" height="30" fill="red"/>',
    "style/selectors": '<path fill="red" d="M10 10h30v30h-30z"/><rect x="50" y="50" width="30" height="30" fill="green"'
    ' fill-opacity="0.5" stroke="blue" stroke-width="4"/>',
    "transform/css-fill-box": '<rect x="20" y="30" width="40" height="20" transform="rotate(45 40 40)"/>',
    "transform/css-origin": '<rect x="10" y="10" width="30" height="30" transform="rotate(45 50 50)"/>',
    "transform/css-origin-keywords": '<rect x="20" y="30" width="40" height="20" transform="rotate(30 50 50)"/>',
    "transform/css-over-attribute": '<rect x="20" y="40" width="30" height="30"/>',
    "transform/css-percent": '<rect x="30" y="50" width="40" height="20"/>',
    "transform/css-all-four": '<rect x="20" y="30" width="40" height="20"'
    ' transform="translate(50 45) rotate(30) scale(1.5) skewX(20) translate(-40 -40)"/>',
    "transform/css-rotate": '<rect x="20" y="5" width="40" height="20" transform="rotate(20)"/>',
    "transform/css-rotate-axis": '<rect x="30" y="20" width="20" height="40"/>',
    "transform/css-rotate-invalid": '<rect x="20" y="30" width="40" height="20"/>',
    "transform/css-rotate-x": '<rect x="20" y="35" width="40" height="20"/>',
    "transform/css-scale": '<rect x="40" y="7.5" width="40" height="15"/>',
    "transform/css-scale-group": '<rect x="50" y="50" width="30" height="20"/>',
    "transform/css-translate": '<rect x="30" y="25" width="40" height="20"/>',
    "transform/css-units": '<rect x="10" y="10" width="30" height="30" transform="translate(20 10) rotate(36)"/>',
    # the outermost element is a box of CSS, of which the initial origin is the middle (CSS Transforms 1, 5)
    "transform/of-outermost": f'{PAGE}<g transform="translate(35 25) scale(0.5)">{PARTS}</g>',
    "transform/of-outermost-about-its-origin": f'{PAGE}<g transform="rotate(30 30 70)">{PARTS}</g>',
    "transform/of-outermost-under-background": '<path fill="#fc8" d="M0 0h100v100h-100z"/>'
    f'<g transform="translate(50 10)">{BALL}</g>',
    "images/turned-by-itself": '<clipPath id="c"><path d="M10 10h60v60h-60z"/></clipPath><g clip-path="url(#c)">'
    '<g transform="rotate(30 40 40)"><path fill="#fc8" d="M10 10h60v60h-60z"/>'
    '<path fill="#208040" d="M22 16h36v18h-36z"/></g></g>',
    "viewport/height-only": '<circle cx="50" cy="50" r="45"/>',
    "viewport/width-only": '<circle cx="50" cy="50" r="45"/>',
}


def plainer(name: str) -> str | None:
    """The file that says the same as a fixture, TOPIC/NAME; None if resvg knows the fixture itself."""
    box = "0 0 200 100" if name.endswith("/height-only") else "0 0 100 100"
    body = PLAINER.get(name)
    return body and f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">{body}</svg>'
