"""Units of length as files write them: with a datum, in full or abbreviated, in any case."""

import re
from typing import Final

# fmt: off
LENGTHS: Final = {
    **dict.fromkeys(("m", "metre", "metres", "meter", "meters", "mtr", "mtrs"), 1.0),
    **dict.fromkeys(("km", "kilometre", "kilometres", "kilometer", "kilometers"), 1000.0),
    **dict.fromkeys(("dm", "decimetre", "decimetres", "decimeter", "decimeters"), 0.1),
    **dict.fromkeys(("cm", "centimetre", "centimetres", "centimeter", "centimeters"), 0.01),
    **dict.fromkeys(("mm", "millimetre", "millimetres", "millimeter", "millimeters"), 0.001),
    **dict.fromkeys(("ft", "feet", "foot", "international foot", "international feet"), 0.3048),
    **dict.fromkeys(("us survey foot", "us survey feet", "survey foot", "survey feet", "us foot", "us feet", "us ft",
                     "ftus", "foot us", "ft us"), 1200.0 / 3937.0),
    **dict.fromkeys(("in", "inch", "inches"), 0.0254),
    **dict.fromkeys(("yd", "yds", "yard", "yards"), 0.9144),
    **dict.fromkeys(("fathom", "fathoms", "ftm"), 1.8288),
}
"""Metres in each unit of length, by name in lower case."""
# fmt: on

BY_LENGTH: Final = sorted(LENGTHS, key=len, reverse=True)

TIMES: Final = r"s|sec|seconds?|h|hr|hours?|d|days?|weeks?|mo|months?|yr|years?"
OTHERS: Final = r"m|k|g|kg|pa|rad|psu|hg|fraction|sq|squared?|cubed?|cubic"
NO_DATUM: Final = re.compile(
    rf"/|\^|\*|\bper\b|-\d|(?<!\.)\b({TIMES})\b(?!\.)|^[\s.·]*({OTHERS})[\s\d]*$", re.IGNORECASE
)
LOGARITHM: Final = re.compile(r"\b(log|log10|ln|lg|db|decibels?)\b", re.IGNORECASE)
DATUM: Final = re.compile(r"[\s(+,;:.\-]*[^\d\s].*|")
"""Text that may follow a unit: the datum of heights, but nothing that makes it a speed or an area."""

NO_UNIT: Final = frozenset({"", "1", "-", "n/a", "na", "none", "unknown"})
"""Texts, in lower case, of files that state no unit."""

SCALED: Final = re.compile(r"(\d*\.?\d+(?:[eE][+-]?\d+)?) ?\*? ?([A-Za-z].*)")
"""A number times a unit, in the notation of UDUNITS."""


ENCLOSED: Final = re.compile(r"\[([^\[\]]*)\]|\(([^()]*)\)")
"""A unit in brackets."""

FIRST_POWER: Final = re.compile(r"([A-Za-z]+) ?\^?1")

TIMES_A_NUMBER: Final = re.compile(r"(?<![A-Za-z])[x×*] ?\.?\d")
"""Pattern of a factor, with which the numbers are not in the unit itself."""

MEGA: Final = re.compile(r"Mm\b")
"""Megametre, which must not be read as millimetre in lower case."""

RAISED: Final = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
"""Typeset exponents and minus signs."""


def metres_in(unit: str) -> float | None:
    """Metres in a unit of length, which may name a datum; 1 if there is no unit, and None if it is not a length.

    Examples
    --------
    >>> metres_in("cm"), metres_in("ft NAVD88"), metres_in("m+NAP"), metres_in(""), metres_in("1e-2 m")
    (0.01, 0.3048, 1.0, 1.0, 0.01)
    >>> metres_in("m s-1"), metres_in("m3"), metres_in("psu"), metres_in("minutes")
    (None, None, None, None)
    >>> metres_in("m²"), metres_in("m s⁻¹"), metres_in("m (log10)"), metres_in("mm Hg"), metres_in("m squared")
    (None, None, None, None, None)
    """
    plain = " ".join(re.sub(r"[_\-]+(?=[A-Za-z])", " ", unit.translate(RAISED)).split())
    if plain.lower() in NO_UNIT:
        return 1.0
    if LOGARITHM.search(plain) or TIMES_A_NUMBER.search(plain) or MEGA.match(plain):
        return None
    if enclosed := ENCLOSED.fullmatch(plain):
        return metres_in(enclosed[1] or enclosed[2] or "")
    if first := FIRST_POWER.fullmatch(plain):
        return metres_in(first[1])
    if scaled := SCALED.fullmatch(plain):
        inner = metres_in(scaled[2])
        return None if inner is None else float(scaled[1]) * inner
    lower = plain.lower().replace("u.s.", "us")
    name = next((name for name in BY_LENGTH if lower.startswith(name)), None)
    if name is None:
        return None
    rest = plain[len(plain) - len(lower) + len(name) :]
    joined = rest[:1].isalpha() and not (name in ("m", "ft") and rest.isupper() and plain[0].islower())
    said = re.sub(r"\([^)]*\)", "()", rest)
    return None if joined or NO_DATUM.search(said) or not DATUM.fullmatch(said) else LENGTHS[name]
