"""Fixtures of styles that PyPI's resvg does not know, in words that it and we understand alike."""

__all__ = ["STYLES"]


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
    "style/layers": squares("red", "green", "blue", "orange"),
    "style/layers-nested": squares("red", "green", "blue"),
    "style/nesting": squares("red", "green", "blue", "orange"),
    "style/nesting-parent-elsewhere": squares("red", "green", "blue", "orange"),
    "style/nesting-conditions": squares("red", "green", "blue", "orange"),
}
