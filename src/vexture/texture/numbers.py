"""Numbers of paints in a planar map, of 8 or 16 bits (FORMAT.md, D.3, D.4), for kernels; the map is sound."""

import numpy as np
from numpy.typing import NDArray

from vexture.kernels import kernel
from vexture.layout import COORDINATE_BITS, MOST_BYTE_PAINTS

__all__ = ["means_place", "read_base", "read_sides"]


@kernel
def is_narrow(flat: NDArray[np.uint32], root: int) -> int:
    """1 where numbers have 8 bits in the map with a root quad, else 0."""
    return 0 if int(flat[root - 1, 0]) > MOST_BYTE_PAINTS else 1


@kernel
def read_number(texel: NDArray[np.uint32], place: int, narrow: int) -> int:
    """A number in a texel full of them."""
    bits = COORDINATE_BITS >> narrow
    word = int(texel[(place >> (1 + narrow)) & 3])
    return (word >> bits * (place & (1 + 2 * narrow))) & ((1 << bits) - 1)


@kernel
def means_place(flat: NDArray[np.uint32], root: int, quad: int) -> int:
    """Texels between the first of a map's cells and that of the means of a quad's cells."""
    place = quad - root
    return 1 + place + (place >> (1 + is_narrow(flat, root)))


@kernel
def read_base(flat: NDArray[np.uint32], root: int, quad: int, k: int) -> int:
    """Base paint of cell k of a quad."""
    narrow, place = is_narrow(flat, root), quad - root
    block = place >> (1 + narrow)
    return read_number(flat[int(flat[root - 1, 1]) + (block << (1 + narrow)) + block], 4 * place + k, narrow)


@kernel
def read_sides(flat: NDArray[np.uint32], root: int, number: int) -> tuple[int, int]:
    """Paints on the left and on the right of the curve with a number."""
    narrow = is_narrow(flat, root)
    texel = flat[int(flat[root - 1, 2]) + (number >> (2 + narrow))]
    return read_number(texel, 2 * number, narrow), read_number(texel, 2 * number + 1, narrow)
