"""Fonts in a drawing: `@font-face` rules with data in them (CSS Fonts 4, 11)."""

import re
from base64 import b64decode
from collections.abc import Iterator, Sequence
from typing import Final
from urllib.parse import unquote_to_bytes

from vexture.errors import DeviceError, SourceError
from vexture.fonts.face import faces_in
from vexture.fonts.library import EmbeddedFont
from vexture.svg.font_values import font_weight
from vexture.svg.report import Report
from vexture.svg.text.wanted import families, stretch

__all__ = ["embedded_fonts"]

URL = re.compile(r"url\(\s*(['\"]?)(.*?)\1\s*\)", re.DOTALL)
DATA = re.compile(r"data:([^,]*),(.*)", re.DOTALL)

MOST_FONTS: Final = 100


def embedded_fonts(rules: Sequence[dict[str, str]], report: Report) -> Iterator[EmbeddedFont]:
    """Fonts of rules, each with its descriptors by name; a note tells what is not in the drawing itself."""
    for rule in rules[:MOST_FONTS]:
        names = families(rule.get("font-family", ""))
        content = next(filter(None, map(content_of, URL.findall(rule.get("src", "")))), None)
        if not names or content is None:
            if rule.get("src", "").strip():
                report.left_out(f"font {''.join(names[:1])[:40]!r}, which is not in the file; give it by `fonts`")
            continue
        try:
            faces_in(content)
        except (DeviceError, SourceError) as error:
            report.left_out(f"font {names[0][:40]!r}: {error}")
            continue
        if "unicode-range" in rule:
            report.simplified(f"unicode-range of font {names[0][:40]!r}, which is used for all characters")
        yield EmbeddedFont(
            names[0],
            content,
            span([font_weight(word) for word in rule["font-weight"].split()]) if "font-weight" in rule else None,
            span([stretch(word) for word in rule["font-stretch"].split()]) if "font-stretch" in rule else None,
            rule["font-style"].split()[0].lower() if "font-style" in rule else None,
        )


def span(values: list[float]) -> tuple[float, float]:
    """Least and greatest of one or two values."""
    return min(values), max(values)


def content_of(found: tuple[str, str]) -> bytes | None:
    """Bytes of a URL that holds them itself, or None; nothing is fetched."""
    match = DATA.fullmatch(found[1].strip())
    if match is None:
        return None
    try:
        plain = unquote_to_bytes(match[2])
        return b64decode(plain) if match[1].strip().lower().endswith(";base64") else plain
    except ValueError:
        return None
