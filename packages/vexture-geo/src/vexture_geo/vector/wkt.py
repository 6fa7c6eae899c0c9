"""Geometries in text columns of Parquet and CSV: WKT, or WKB in hexadecimal digits."""

import re
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from vexture_geo.vector.curves import BROKEN

SRID: Final = re.compile(r"^\s*SRID=\d+;\s*", re.IGNORECASE)
"""Start of extended WKT, which names a reference system."""

ALIKE: Final = {"TIN": "MULTIPOLYGON", "POLYHEDRALSURFACE": "MULTIPOLYGON", "TRIANGLE": "POLYGON"}
"""Surfaces that GEOS does not support, and the types with the same notation."""

SURFACE: Final = re.compile(rf"\b({'|'.join(ALIKE)})\b", re.IGNORECASE)
CURVE: Final = re.compile(r"\b(CIRCULARSTRING|COMPOUNDCURVE|CURVEPOLYGON|MULTICURVE|MULTISURFACE)\b", re.IGNORECASE)

HEADER: Final = 9
"""Bytes of a WKB collection before its first geometry: the byte order, the kind, and the count."""


def wkb_of_texts(texts: NDArray[Any]) -> NDArray[Any]:
    r"""Convert texts to WKB, keeping curves: None where there is no text, `BROKEN` where one is broken.

    Examples
    --------
    >>> wkb_of_texts(np.array(["SRID=4326;0102000000", "LINESTRING EMPTY", "LINE", None], object)).tolist()
    [b'\x01\x02\x00\x00\x00', b'\x01\x02\x00\x00\x00\x00\x00\x00\x00', b'\x01', None]
    """
    import shapely

    plain = [None if text is None else SRID.sub("", str(text)).strip() for text in texts]
    found = np.array([None if text is None else BROKEN for text in plain], object)
    straight, others = list[int](), list[int]()
    for place, text in enumerate(plain):
        if text is None:
            continue
        if text[:2] in ("00", "01"):
            found[place] = _bytes_of(text)
        else:
            (others if CURVE.search(text) or SURFACE.search(text) else straight).append(place)
    with np.errstate(all="ignore"):  # geometries that are not finite are refused later
        shapes = shapely.from_wkt([plain[place] for place in straight], on_invalid="ignore")
        for place, shape, content in zip(straight, shapes, shapely.to_wkb(shapes), strict=True):
            found[place] = BROKEN if shape is None else content
        for place in others:
            found[place] = _curved_wkb(str(plain[place]))
    return found


def _curved_wkb(text: str) -> bytes:
    """Convert a text with curves or surfaces to WKB, within a collection, because shapely has no type for them."""
    import shapely

    inner = SURFACE.sub(lambda word: ALIKE[word[1].upper()], text)
    try:
        whole = shapely.from_wkt(f"GEOMETRYCOLLECTION ({inner})", on_invalid="ignore")
        if whole is None or shapely.get_num_geometries(whole) != 1:
            return BROKEN
        return bytes(shapely.to_wkb(whole)[HEADER:])
    except (NotImplementedError, shapely.errors.GEOSException):
        return BROKEN


def _bytes_of(digits: str) -> bytes:
    try:
        return bytes.fromhex(digits)
    except ValueError:
        return BROKEN
