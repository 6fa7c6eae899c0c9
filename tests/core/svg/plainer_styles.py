"""Fixtures of styles that PyPI's resvg does not know, in words that it and we understand alike."""


def squares(*colors: str) -> str:
    """Up to four squares in two rows, of colours."""
    corners = ((10, 10), (50, 10), (10, 50), (50, 50))
    pairs = zip(corners, colors, strict=False)
    return "".join(f'<rect x="{x}" y="{y}" width="30" height="30" fill="{color}"/>' for (x, y), color in pairs)


STYLES = {
    "style/variables": squares("#e4002b", "#e4002b", "blue", "green"),
    "style/variables-fallback": squares("red", "green", "blue", "orange"),
    "style/variables-in-parts": '<rect x="10" y="10" width="30" height="30" fill="rgb(200,80,0)"/><rect x="50"'
    ' y="10" width="30" height="30" fill="#0000c8" fill-opacity="0.5"/><path'
    ' d="M10 50h30v30" fill="none" stroke="red" stroke-width="4"'
    ' stroke-dasharray="4 4"/><rect x="90" y="40" width="10" height="20"/>',
    "style/variables-invalid-at-last": squares("green", "green", "black", "black"),
    "style/variables-cycle": squares("green", "blue"),
    "style/variables-cascade": squares("blue", "green", "teal", "orange"),
    "style/variables-of-shorthand": '<path d="M20 20H80" stroke="red"/><circle cx="20" cy="20" r="1.5"/><circle'
    ' cx="80" cy="20" r="1.5"/>',
    "style/media-of-the-drawing": squares("red", "black", "green", "blue"),
    "style/media-of-people": squares("red", "green", "blue", "orange"),
    "style/media-of-kinds": squares("red", "green", "blue", "orange"),
    "style/media-attribute": squares("red", "green", "black"),
    "style/supports": squares("red", "green", "blue", "orange"),
    "style/supports-nested": squares("red", "green", "blue", "orange"),
    "style/layers-rolled-back": squares("red", "green", "blue", "orange"),
    "style/selectors-forgiving": squares("red", "green", "blue", "orange"),
    "style/calc-one-argument": squares("red", "#008000", "blue"),
    "style/colors-hsl-without-percent": squares("red", "#008000", "blue"),
    "transform/css-origin-in-depth": '<path d="M10 37.3205h40v10h-40z"/><path d="M68.6603 60h10v20h-10z" fill="red"/>',
    "transform/units-in-attribute": squares("black", "red") + '<linearGradient id="g"><stop stop-color="green"/><stop'
    ' offset="1" stop-color="blue"/></linearGradient><rect x="10" y="50" width="70" height="30" fill="url(#g)"/>',
    "style/layers": squares("red", "green", "blue", "orange"),
    "style/layers-nested": squares("red", "green", "blue"),
    "style/nesting": squares("red", "green", "blue", "orange"),
    "style/nesting-parent-elsewhere": squares("red", "green", "blue", "orange"),
    "style/nesting-conditions": squares("red", "green", "blue", "orange"),
    "style/calc": '<rect x="10" y="10" width="30" height="30" rx="5" fill="red"/><circle cx="70"'
    ' cy="30" r="10" fill="green"/><path d="M10 70H90" stroke="blue"'
    ' stroke-width="6" stroke-dasharray="5 10 3"/><path d="M10 90H90"'
    ' stroke="orange" stroke-width="3" stroke-opacity="0.5"/>',
    "style/calc-functions": squares("red", "green", "blue", "orange"),
    "style/calc-invalid": '<g fill="green" stroke="red" stroke-width="4"><path d="M20 20h20v20"/><path'
    ' d="M50 20h20v20"/><path d="M20 50h20v20"/></g>',
    "style/view-units": '<rect x="10" y="10" width="10" height="15" fill="red"/><rect x="10" y="35"'
    ' width="10" height="25" fill="green"/><path d="M10 80H90" stroke="blue"'
    ' stroke-width="4" stroke-dasharray="5"/>',
    "transform/css-calc": '<rect x="20" y="30" width="40" height="20" transform="translate(10 10) rotate(45 40 40)"/>',
    "transform/css-in-space": '<rect x="10" y="20" width="20" height="20" fill="red"/><rect x="50" y="10"'
    ' width="30" height="30" fill="green"/><rect x="10" y="50" width="30"'
    ' height="30" fill="blue"/>',
    "transform/css-about-axes": '<rect x="20" y="35" width="40" height="20"/><rect x="70" y="20" width="10"'
    ' height="60" fill="red"/>',
    "transform/css-axes-together": '<rect x="20" y="10" width="40" height="10"/><rect x="20" y="60" width="40"'
    ' height="20" fill="red"/>',
    "transform/css-without-units": '<rect x="10" y="10" width="30" height="30"/><rect x="50" y="50" width="30"'
    ' height="30" fill="red"/><rect x="10" y="40" width="30" height="30"'
    ' fill="green"/>',
    "style/colors-lab": squares("#d43d49", "#408700", "#c3602e", "#a9a400"),
    "style/colors-spaces": squares("#ff7600", "#00e900", "#c65660", "#00e638"),
    "style/colors-beyond-srgb": squares("#00d600", "#ff0080", "#00ff00", "#7cbcff"),
    "style/colors-mixed": squares("#800080", "#ba00c2", "#ccff00", "#d1a900"),
    "style/colors-from-others": squares("#0000ff", "#000080", "#23dc96", "#0000ff"),
    "style/colors-of-the-system": squares("#0075ff", "#0000ee", "#efefef", "#1967d2"),
    "style/colors-light": '<rect width="100" height="100" fill="white"/><rect x="10" y="10" width="30"'
    ' height="30" fill="green"/><rect x="50" y="10" width="30" height="30"'
    ' fill="blue"/><rect x="10" y="50" width="30" height="30" fill="black"/>',
    "style/colors-calculated": '<rect x="10" y="10" width="30" height="30" fill="#cc3300"/><rect x="50"'
    ' y="10" width="30" height="30" fill="#008000"/><rect x="10" y="50" width="30"'
    ' height="30" fill="blue" fill-opacity="0.25"/><rect x="50" y="50" width="30"'
    ' height="30" fill="#338040"/>',
    "style/colors-of-the-own": '<rect x="10" y="10" width="30" height="30" fill="#8080ff"/><rect x="50"'
    ' y="10" width="30" height="30" fill="#ff8080"/><rect x="10" y="50" width="30"'
    ' height="30" fill="#402010"/><path d="M50 65h30" stroke="#208040"'
    ' stroke-width="10"/>',
    "style/lang": squares("red", "green", "blue", "red"),
    "style/display-contents": '<rect x="10" y="10" width="30" height="30" fill="red"/><rect x="10" y="50"'
    ' width="30" height="30" fill="green"/>',
    "style/all": '<rect x="10" y="10" width="30" height="30" fill="red"/><rect x="50" y="10"'
    ' width="30" height="30" fill="red"/><rect x="50" y="50" width="30"'
    ' height="30" fill="blue"/>',
    "masks/clip-by-css-calculated": '<circle cx="20" cy="25" r="6.5" fill="red"/><rect x="53" y="15" width="24"'
    ' height="20" rx="4" ry="4" fill="green"/><path d="M10 50L70 55L10 90z"'
    ' fill="blue"/>',
}
