"""A competitor: text on the GPU by bands of quadratic curves, implemented here from its publication.

E. Lengyel, "GPU-Centered Font Rendering Directly from Glyph Outlines", Journal of Computer Graphics Techniques 6(2),
2017. The curves of an outline are listed for each horizontal and each vertical band. A pixel casts two rays, and
intersects each with the curves of one of its two bands. The shader is `shaders/bands.glsl`.

Choices of this implementation: a line is a quadratic whose second point is its middle; cubics become quadratics within
`CUBIC_TOLERANCE`; equal lists are stored once. A curve of no height is in no horizontal band, and a curve of no width
is in no vertical band. Lists are sorted by descending largest x (or y), so that a pixel stops at the first curve behind
it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from fontTools.cu2qu import curve_to_quadratic
from numpy.typing import NDArray

from vexture.base.errors import LimitError
from vexture.drawing.drawing import Drawing, FillRule
from vexture.renderers.shader import read_shader

BANDS: Final = 16
"""Bands in each direction, as published for glyphs."""

COASTLINE_BANDS: Final = 255
"""The most bands in each direction that one byte can count."""

CUBIC_TOLERANCE: Final = 1e-4
"""Unit-square units: a tenth of a pixel at 1000 pixels, the larger of the tolerances in use for TrueType outlines."""

QUADRATIC: Final = 1e-12
"""Unit-square units; a cubic whose third difference is at most this is a quadratic of raised degree."""

OVERLAP: Final = 1e-6
"""Unit-square units by which bands overlap, because float32 may round a pixel into the neighbouring band."""

ROW_BITS: Final = 12
COUNT_BITS: Final = 12
STRAIGHT: Final = 2.0**-16
"""Second differences below this count as 0."""

TEXEL_BYTES: Final = 8
ENTRY_BYTES: Final = 4
"""As published: four 16-bit coordinates in a texel of the outlines; two 16-bit numbers in a head or entry of a list."""


@dataclass(frozen=True, slots=True, eq=False)
class BandTexture:
    """The arrays that the shader reads.

    Parameters
    ----------
    bands : int
        Number of bands in each direction.
    outlines : (n, 4) float32 array
        First and second point of each curve; a contour's last curve is followed by the contour's end point.
    lists : (m,) uint32 array
        A head (start << COUNT_BITS | count) for each horizontal band, then for each vertical band, then the lists:
        texel indices in `outlines`.
    box : (4,) float64 array
        Lower left corner of the outline's bounding box, and bands per unit in x and in y.
    """

    bands: int
    outlines: NDArray[np.float32]
    lists: NDArray[np.uint32]
    box: NDArray[np.float64]

    @property
    def published_bytes(self) -> int:
        """Size in the published format, not that of the arrays here."""
        return TEXEL_BYTES * len(self.outlines) + ENTRY_BYTES * len(self.lists)

    @property
    def unshared_bytes(self) -> int:
        """Size in the published format if equal lists are not shared."""
        heads = self.lists[: 2 * self.bands]
        entries = int((heads & (1 << COUNT_BITS) - 1).sum())
        return TEXEL_BYTES * len(self.outlines) + ENTRY_BYTES * (len(heads) + entries)


def eligible_roots() -> int:
    """Table of the roots that count: two bits for each of the eight sign patterns of a quadratic's three heights.

    Bit k of the pattern says that point k is above 0. Bit 0 of an entry stands for the root at which the curve falls
    from above 0 to 0 or below, bit 1 for the root at which it rises. If the ends are on different sides, exactly the
    root between them counts. If the ends are on one side and the middle point on the other, both roots count; where
    neither is real, their contributions cancel.

    Examples
    --------
    >>> hex(eligible_roots())
    '0x2e74'
    """
    table = 0
    for pattern in range(8):
        first, middle, last = (pattern >> k & 1 for k in range(3))
        falls = first > last or first == last != middle
        rises = first < last or first == last != middle
        table |= (falls | rises << 1) << 2 * pattern
    return table


def quadratic_contours(drawing: Drawing, tolerance: float = CUBIC_TOLERANCE) -> list[NDArray[np.float64]]:
    """Each contour as quadratics, (n, 3, 2); cubics that are not quadratics of raised degree are approximated.

    Raises
    ------
    LimitError
        If a path is filled by the even-odd rule, which a method that counts windings does not draw.
    """
    if any(path.fill_rule == FillRule.EVENODD for path in drawing.paths):
        raise LimitError(f"{drawing.name} is filled by the even-odd rule; our bands draw the non-zero rule only")
    return [as_quadratics(contour, tolerance) for path in drawing.paths for contour in path.contours]


def as_quadratics(cubics: NDArray[np.float64], tolerance: float) -> NDArray[np.float64]:
    """Convert a chain of cubics to a chain of quadratics."""
    p0, p1, p2, p3 = np.moveaxis(cubics, 1, 0)
    direct = np.stack([p0, (3.0 * (p1 + p2) - p0 - p3) / 4.0, p3], axis=1)
    bent = np.abs(p3 - 3.0 * p2 + 3.0 * p1 - p0).max(axis=1) > QUADRATIC
    chains: list[NDArray[np.float64]] = []
    at = 0
    for k in np.flatnonzero(bent):
        chains += [direct[at:k], spline(cubics[k], tolerance)]
        at = int(k) + 1
    return np.concatenate([*chains, direct[at:]])


def spline(cubic: NDArray[np.float64], tolerance: float) -> NDArray[np.float64]:
    """Approximate one cubic by quadratics."""
    points = np.array(curve_to_quadratic([tuple(point) for point in cubic], tolerance))
    middles = points[1:-1]
    joints = np.concatenate([points[:1], 0.5 * (middles[:-1] + middles[1:]), points[-1:]])
    return np.stack([joints[:-1], middles, joints[1:]], axis=1)


def band_texture(drawing: Drawing, bands: int = BANDS) -> BandTexture:
    """Sort a drawing's curves into bands.

    Raises
    ------
    LimitError
        If the drawing is empty, too large for the lists' heads, or filled by the even-odd rule.
    """
    contours = quadratic_contours(drawing)
    if not contours:
        raise LimitError(f"{drawing.name} is empty; the bands need a box to divide")
    texels = [np.concatenate([c[:, :2].reshape(-1, 4), np.tile(c[-1, 2], (1, 2))]) for c in contours]
    outlines = np.concatenate(texels).astype(np.float32)
    ends = np.cumsum([len(part) for part in texels]) - 1
    index = np.delete(np.arange(len(outlines)), ends)
    curves = np.stack([outlines[index, :2], outlines[index, 2:], outlines[index + 1, :2]], axis=1).astype(np.float64)
    low, high = curves.min(axis=(0, 1)), curves.max(axis=(0, 1))
    density = bands / np.maximum(high - low, np.finfo(np.float32).tiny)
    groups = [
        members
        for across, along in ((1, 0), (0, 1))
        for members in members_of_bands(curves, across, along, (float(low[across]), float(density[across])), bands)
    ]
    return BandTexture(bands, outlines, list_bands(groups, index, drawing.name), np.array([*low, *density]))


def members_of_bands(
    curves: NDArray[np.float64], across: int, along: int, place: tuple[float, float], bands: int
) -> list[NDArray[np.int64]]:
    """Indices of the curves in each band, those that reach farthest along the ray first."""
    low, high = curves[:, :, across].min(axis=1), curves[:, :, across].max(axis=1)
    first, last = (
        np.clip(np.floor((edge - place[0]) * place[1]), 0, bands - 1).astype(np.int64)
        for edge in (low - OVERLAP, high + OVERLAP)
    )
    farthest = np.argsort(-curves[:, :, along].max(axis=1), kind="stable")
    farthest = farthest[low[farthest] < high[farthest]]
    span = (last - first + 1)[farthest]
    member = np.repeat(farthest, span)
    band = np.repeat(first[farthest], span) + np.arange(len(member)) - np.repeat(np.cumsum(span) - span, span)
    by_band = np.argsort(band, kind="stable")
    return np.split(member[by_band], np.searchsorted(band[by_band], np.arange(1, bands)))


def list_bands(groups: Sequence[NDArray[np.int64]], index: NDArray[np.int64], name: str) -> NDArray[np.uint32]:
    """Heads and lists; equal lists are written once."""
    heads, lists, at = [], [], len(groups)
    written: dict[bytes, int] = {}
    for members in groups:
        key = members.tobytes()
        if key not in written:
            written[key] = at
            lists.append(index[members])
            at += len(members)
        heads.append(written[key] << COUNT_BITS | len(members))
    if at >> (32 - COUNT_BITS) or max(map(len, groups)) >> COUNT_BITS:
        most = max(map(len, groups))
        raise LimitError(f"{name} has up to {most} curves in a band, {at} in all; use more bands or less detail")
    return np.concatenate([heads, *lists]).astype(np.uint32)


def band_constants(bands: int) -> dict[str, int | float]:
    """The shader's constants."""
    return {
        "BANDS": bands,
        "ROW_BITS": ROW_BITS,
        "COUNT_BITS": COUNT_BITS,
        "ELIGIBLE": eligible_roots(),
        "STRAIGHT": STRAIGHT,
    }


def band_shader(bands: int) -> str:
    """Declarations of the constants, followed by the text of `bands.glsl`."""
    constants = band_constants(bands)
    head = "".join(f"const {type(value).__name__} {name} = {value!r};\n" for name, value in constants.items())
    return head + read_shader("bands.glsl", "vexture_evidence")
