"""The shorthand `mask` (CSS Masking 1, 7).

Of a mask that is an element, only the mode has an effect, not its place, size and repetition.
"""

import re
from collections.abc import Iterator
from typing import Final

MODES: Final = ("alpha", "luminance", "match-source")

LAYER: Final = re.compile(r"(.*?)(url\(\s*(?:\"[^\"]*\"|'[^']*'|[^\"')]*)\s*\))(.*)", re.IGNORECASE | re.DOTALL)
PLACED: Final = re.compile(
    r"(?:no-repeat|repeat(?:-[xy])?|space|round|center|left|right|top|bottom|auto|cover|contain|no-clip|[-+.\d]+[a-z%]*"
    r"|(?:content|padding|border|fill|stroke|view)-box|add|subtract|intersect|exclude|alpha|luminance|match-source)"
)
"""Words beside the reference."""


def mask_longhands(value: str) -> Iterator[tuple[str, str]]:
    """Yield what the shorthand says: the reference and its mode; a value that is no reference stays whole.

    Examples
    --------
    >>> dict(mask_longhands("url(#m) no-repeat alpha")), dict(mask_longhands("url(#m) bright"))
    ({'mask': 'url(#m)', 'mask-mode': 'alpha'}, {'mask': 'url(#m) bright', 'mask-mode': 'match-source'})
    """
    match = LAYER.fullmatch(value)
    words = f"{match[1]} {match[3]}".lower().replace("/", " ").split() if match else []
    mode = next((word for word in words if word in MODES), MODES[-1])
    known = match is not None and all(map(PLACED.fullmatch, words))
    yield "mask", match[2] if match and known else value
    yield "mask-mode", mode if known else MODES[-1]
