"""Numbers of the thesis's shading method, for the shader and for its mirror.

The solution paths are those of thesis Figure 3.5; QUADRATIC stands for two of its nine, one root or both on the curve.
"""

from typing import Final

SAMPLES: Final = 4
"""A pixel is the mean of SAMPLES x SAMPLES points (thesis 4.4.3)."""

CONSTANT: Final = 0
CURVE: Final = 1
CORNER: Final = 2
"""Kinds of cell, after reading."""

STRAIGHT: Final = 0
QUADRATIC: Final = 1
TRIPLE: Final = 2
CUBE_ROOT: Final = 3
DOUBLE: Final = 4
HYPERBOLIC_SINE: Final = 5
HYPERBOLIC_COSINE: Final = 6
THREE: Final = 7
"""Solution paths of the cubic; all from TRIPLE on divide by its leading coefficient."""

NEARLY_ZERO: Final = 2.0**-14
"""A coefficient below this share of the others is left to the polishing of the roots."""

NEARLY_EQUAL: Final = 2.0**-19
"""Two float32 expressions of one value differ by no more than this share of their terms."""

SHORTEST_CHORD: Final = 2.0**-18
"""Perimeters of a cell; a quarter of the smallest step that 16 bits can express."""
