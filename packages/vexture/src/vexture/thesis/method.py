"""Numbers of the thesis's shading method, for the shader and for its mirror.

The solution paths are those of thesis Figure 3.5. QUADRATIC stands for two of its nine paths: one root or both roots
on the curve.
"""

from typing import Final

SAMPLES: Final = 4
"""Samples per side of a pixel, which is the mean of SAMPLES x SAMPLES points (thesis 4.4.3)."""

CONSTANT: Final = 0
CURVE: Final = 1
CORNER: Final = 2
"""Kinds of cells after reading."""

STRAIGHT: Final = 0
QUADRATIC: Final = 1
TRIPLE: Final = 2
CUBE_ROOT: Final = 3
DOUBLE: Final = 4
HYPERBOLIC_SINE: Final = 5
HYPERBOLIC_COSINE: Final = 6
THREE: Final = 7
"""Solution paths of the cubic; TRIPLE and all later ones divide by the leading coefficient."""

NEARLY_ZERO: Final = 2.0**-14
"""Share of the other coefficients below which a coefficient is ignored; polishing the roots corrects for it."""

NEARLY_EQUAL: Final = 2.0**-19
"""Largest difference of two float32 expressions of one value, as a share of their terms."""

SHORTEST_CHORD: Final = 2.0**-18
"""Length in perimeters of a cell: a quarter of the smallest step in 16 bits."""
