"""Affine maps of the plane, as rows of numbers."""

Affine = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Rows of an affine map of (x, y, 1)."""


def compose_affine(outer: Affine, inner: Affine) -> Affine:
    """Return the map that applies `inner` first, then `outer`.

    Examples
    --------
    >>> compose_affine(((2, 0, 1), (0, 2, 0)), ((1, 0, 10), (0, 1, 20)))
    ((2, 0, 21), (0, 2, 40))
    """
    (a, b, c), (d, e, f) = inner
    first, second = ((p * a + q * d, p * b + q * e, p * c + q * f + r) for p, q, r in outer)
    return first, second
