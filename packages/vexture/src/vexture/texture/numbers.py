"""Read paint numbers of 8, 16 or 32 bits from a valid planar map (FORMAT.md, D.3, D.4), in kernels."""

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.base.layout import MOST_BYTE_PAINTS, MOST_HALF_PAINTS


@kernel
def packing_of(flat: NDArray[np.uint32], root: int) -> int:
    """Binary logarithm of the count of numbers in a word of a map: 2, 1 or 0."""
    used = int(flat[root - 1, 0])
    return (1 if used <= MOST_HALF_PAINTS else 0) + (1 if used <= MOST_BYTE_PAINTS else 0)


@kernel
def read_number(texel: NDArray[np.uint32], place: int, packing: int) -> int:
    """Read number `place` of a texel of packed numbers."""
    bits = 32 >> packing
    word = int(texel[(place >> packing) & 3])
    return (word >> bits * (place & ((1 << packing) - 1))) & ((1 << bits) - 1)


@kernel
def means_place(flat: NDArray[np.uint32], root: int, quad: int) -> int:
    """Offset of the texel with the means of a quad's cells from the first texel of a map's cells."""
    place = quad - root
    return 1 + place + (place >> packing_of(flat, root))


@kernel
def read_base(flat: NDArray[np.uint32], root: int, quad: int, k: int) -> int:
    """Read the base paint of cell k of a quad."""
    packing, place = packing_of(flat, root), quad - root
    block = place >> packing
    return read_number(flat[int(flat[root - 1, 1]) + (block << packing) + block], 4 * place + k, packing)


@kernel
def read_sides(flat: NDArray[np.uint32], root: int, number: int) -> tuple[int, int]:
    """Read the paints on the left and on the right of a curve."""
    packing = packing_of(flat, root)
    texel = flat[int(flat[root - 1, 2]) + (number >> (1 + packing))]
    return read_number(texel, 2 * number, packing), read_number(texel, 2 * number + 1, packing)
