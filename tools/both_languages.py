"""One text that holds a shader in two languages: what they share stands once, and a page picks a side of the rest.

Where they differ stands ``@GLSL$WGSL``` ``, signs that neither language has. Both are generated from the same
functions, so they differ by types, declarations and a few names only.
"""

import re
from collections.abc import Callable
from difflib import SequenceMatcher
from typing import Final

WORDS: Final = re.compile(r"\w+|[^\w]")
DEFINITIONS: Final = re.compile(r"(?<=\n\}\n)|(?<=\n\};\n)")
"""Between functions and structures, which end by a brace at the line's begin."""

PAIR: Final = re.compile(r"@([^$]*)\$([^`]*)`")


def both(glsl: str, wgsl: str, bare: Callable[[str], str]) -> str:
    """Return both texts as one, each definition after it is made `bare`."""
    assert not re.search(r"[@$`]", bare(glsl + wgsl)), "signs that neither language has"
    parts = [[bare(part) for part in DEFINITIONS.split(text)] for text in (glsl, wgsl)]
    text = "".join(merge_definition(one, other) for one, other in zip(*parts, strict=True))
    assert [pick_language(text, 1), pick_language(text, 2)] == ["".join(each) for each in parts]
    return text


def merge_definition(one: str, other: str) -> str:
    """Both of a definition."""
    left, right = WORDS.findall(one), WORDS.findall(other)
    text = ""
    for kind, a, b, c, d in SequenceMatcher(None, left, right, autojunk=False).get_opcodes():
        same = "".join(left[a:b])
        text += same if kind == "equal" else f"@{same}${''.join(right[c:d])}`"
    return text


def pick_language(text: str, side: int) -> str:
    """Return the first language of a text, or the second."""
    return PAIR.sub(lambda pair: pair[side], text)
