"""Fonts of a drawing: `@font-face` rules with embedded data, or with names of other fonts (CSS Fonts 4, 11)."""

import re
from base64 import b64decode
from collections.abc import Iterator, Sequence
from typing import Final
from urllib.parse import unquote_to_bytes

from vexture.base.errors import DeviceError, SourceError
from vexture.fonts.face import Face, faces_in
from vexture.fonts.library import EmbeddedFont, Fonts
from vexture.svg.font_values import font_weight
from vexture.svg.report import Report
from vexture.svg.stylesheets import FontFace
from vexture.svg.text.font_query import families, stretch

SOURCE = re.compile(r"(url|local)\(\s*(['\"]?)(.*?)\2\s*\)", re.DOTALL | re.IGNORECASE)
IN_FILE = re.compile(r"url\(\s*['\"]?#", re.IGNORECASE)  # the SVG 1.1 element <font>
DATA = re.compile(r"data:([^,]*),(.*)", re.DOTALL)
RANGE = re.compile(r"U\+([0-9A-F]{0,6})(\?{0,6})(?:-([0-9A-F]{1,6}))?", re.IGNORECASE)

MOST_FONTS: Final = 100

MOST_RANGES: Final = 1_000
"""Most ranges of a font; the fonts of a script have some hundreds."""

LAST: Final = 0x10FFFF
"""Last character code."""


def embedded_fonts(rules: Sequence[FontFace], fonts: Fonts, report: Report) -> Iterator[EmbeddedFont]:
    """Yield the fonts of rules; note those that are neither in the drawing nor in `fonts`."""
    for rule, sheet in rules[:MOST_FONTS]:
        names = families(rule.get("font-family", ""))
        found = (content_of(kind.lower(), text, fonts) for kind, _, text in SOURCE.findall(rule.get("src", "")))
        content = next((content for content in found if content is not None), None)
        if not names or content is None:
            if source := rule.get("src", "").strip():
                why = "an SVG font, which is not supported" if IN_FILE.search(source) else "which is not in the file"
                report.left_out(f"font {''.join(names[:1])[:40]!r}, {why}; give it by `fonts`", sheet)
            continue
        try:
            if isinstance(content, bytes):
                faces_in(content)
        except (DeviceError, SourceError) as error:
            report.left_out(f"font {names[0][:40]!r}: {error}", sheet)
            continue
        ranges = ranges_of(rule.get("unicode-range", ""))
        if ranges is None:
            report.simplification(f"unicode-range of font {names[0][:40]!r}, which is used for all characters", sheet)
        yield EmbeddedFont(
            names[0],
            content,
            span([font_weight(word) for word in rule["font-weight"].split()]) if "font-weight" in rule else None,
            span([stretch(word) for word in rule["font-stretch"].split()]) if "font-stretch" in rule else None,
            rule["font-style"].split()[0].lower() if "font-style" in rule else None,
            ranges or (),
        )


def ranges_of(text: str) -> tuple[tuple[int, int], ...] | None:
    """Parse a list of ranges into their first and last characters; None if it is not valid.

    Examples
    --------
    >>> ranges_of("U+41, u+30-39, U+4??")
    ((65, 65), (48, 57), (1024, 1279))
    """
    found = []
    for part in text.split(",", MOST_RANGES) if text.strip() else ():
        match = RANGE.fullmatch(part.strip())
        if match is None or not 0 < len(match[1] + match[2]) <= 6 or (match[2] and match[3]):
            return None
        first = int(match[1] + "0" * len(match[2]), 16)
        last = int(match[3] or match[1] + "F" * len(match[2]), 16)
        if not first <= last <= LAST:
            return None
        found.append((first, last))
    return tuple(found)


def span(values: list[float]) -> tuple[float, float]:
    """Return the least and greatest of one or two values."""
    return min(values), max(values)


def content_of(kind: str, text: str, fonts: Fonts) -> bytes | Face | None:
    """Return the bytes in a data URL, or the font of a name, or None; nothing is fetched."""
    if kind == "local":
        return fonts.local(" ".join(text.split()))
    match = DATA.fullmatch(text.strip())
    if match is None:
        return None
    try:
        plain = unquote_to_bytes(match[2])
        return b64decode(plain) if match[1].strip().lower().endswith(";base64") else plain
    except ValueError:
        return None
