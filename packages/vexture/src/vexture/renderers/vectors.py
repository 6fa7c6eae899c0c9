"""Arithmetic of GLSL that the mirror needs: vectors of three and four numbers, and the bits of float32."""

import math

from vexture.base.kernels import kernel
from vexture.renderers.cells import Texel

Vec3 = tuple[float, float, float]
Vec4 = tuple[float, float, float, float]


@kernel(allocates=False)
def plus(a: Vec4, b: Vec4, share: float) -> Vec4:
    """Return ``a + share * b`` of GLSL."""
    return a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2], a[3] + share * b[3]


@kernel(allocates=False)
def times(a: Vec4, share: float) -> Vec4:
    """Return ``share * a`` of GLSL."""
    return a[0] * share, a[1] * share, a[2] * share, a[3] * share


@kernel(allocates=False)
def as_float(bits: int) -> float:
    """Mirror GLSL's ``uintBitsToFloat`` (IEEE 754); float64 represents every float32 exactly."""
    size, part = (bits >> 23) & 255, bits & 0x7FFFFF
    if size == 255:
        value = math.nan if part else math.inf
    else:
        value = (part + 0x800000) * 2.0 ** (size - 150) if size else part * 2.0**-149
    return -value if bits >> 31 else value


@kernel(allocates=False)
def as_floats(bits: Texel) -> Vec3:
    """Read the first three words of a texel as float32."""
    return as_float(bits[0]), as_float(bits[1]), as_float(bits[2])
