"""Offsets of clusters from the line by `dominant-baseline`, `alignment-baseline` and `baseline-shift`.

See SVG 2, 11.10.2, and CSS Inline Layout 3. Lengths are in user units, and negative above the alphabetic baseline.
"""

from typing import Final

from vexture.svg.document import local_name
from vexture.svg.text.runs import GlyphCluster
from vexture.svg.text.tree import Span

HANGING, MATHEMATICAL = 0.8, 0.5
"""Heights of baselines as fractions of the ascent, for fonts that do not define them (XSL 1.1, 7.14)."""

OVER: Final = frozenset({"before-edge", "text-before-edge", "text-top"})
UNDER: Final = frozenset({"after-edge", "text-after-edge", "text-bottom", "ideographic"})


def baseline(cluster: GlyphCluster, vertical: bool) -> float:
    """Return the downward shift of a cluster; in vertical text, sideways clusters are centred on the line."""
    shift = sum(baseline_shift(span, cluster) for span in cluster.span.around)
    if vertical:
        return (0.0 if cluster.upright else height("central", cluster)) - shift
    name = cluster.span.place.style["alignment-baseline"].lower()
    if name in ("auto", "baseline"):
        name = dominant(cluster.span)
    return height(name, cluster) - shift


def dominant(span: Span) -> str:
    """Return the baseline that a span's characters align with the line."""
    for around in span.around:
        name = around.place.style["dominant-baseline"].lower()
        if name != "no-change":
            return name
    return "auto"


def height(name: str, cluster: GlyphCluster) -> float:
    """Return the height of a baseline of a cluster's face above the alphabetic one."""
    over, under = extent(cluster)
    if name in OVER:
        return over
    if name in UNDER:
        return -under
    if name == "middle":
        return cluster.face.x_height * cluster.scale / 2.0
    if name == "central":
        return (over - under) / 2.0
    return over * {"hanging": HANGING, "mathematical": MATHEMATICAL}.get(name, 0.0)


def extent(cluster: GlyphCluster) -> tuple[float, float]:
    """Return the ascent and descent of a cluster's face."""
    return cluster.face.ascender * cluster.scale, -cluster.face.descender * cluster.scale


def baseline_shift(span: Span, cluster: GlyphCluster) -> float:
    """Return the upward shift of a span by `baseline-shift`."""
    text = span.place.style["baseline-shift"].lower()
    if text in ("baseline", "top", "center", "bottom") or local_name(span.element) == "text":
        return 0.0
    if text in ("sub", "super"):  # relative to the size of the surrounding text (CSS Inline 3, 4.2.2)
        around = span.place.style if span.outer is None else span.outer.place.style
        part = around.font_size / cluster.face.units_per_em
        return cluster.face.shifts[0 if text == "sub" else 1] * part
    size = span.place.style.font_size
    return span.place.viewport.length(text, size, size) or 0.0
