"""Parsing of bytes into an XML tree; nothing outside the file is read or fetched."""

import re
from typing import Final

from lxml import etree

from vexture.base.errors import SourceError

SVG = "http://www.w3.org/2000/svg"
XML = "http://www.w3.org/XML/1998/namespace"
HTML = "{http://www.w3.org/1999/xhtml}"
"""Start of the tags of HTML elements."""

NOWHERE = "about:blank"
"""Namespace for elements without one if the outermost element has that of SVG: like browsers, they are not SVG."""

MOST_ATTRIBUTES = 1000
"""Most attributes of an element, as lxml searches through all for each access."""

WIDE: Final = re.compile(
    rb"""(?:\xef\xbb\xbf)?<\?xml\s[^>]*encoding\s*=\s*["'](?:utf-?(?:16|32)|(?:iso-10646-)?ucs-?[24])""", re.IGNORECASE
)
"""Declaration of a multi-byte encoding in single-byte characters. It is wrong, and browsers read UTF-8."""

LANGUAGE = "en"
"""Language for `systemLanguage`: fixed, so that a drawing looks the same on every machine."""


def parse_svg(content: bytes) -> etree._Element:
    """Return the root element of an SVG document.

    Entities defined in the document are expanded within libxml2's limits; external ones are errors. Raise a
    `SourceError` if the content is not well-formed, exceeds a limit of libxml2, or is not SVG.
    """
    encoding = "utf-8" if WIDE.match(content) else None
    parser = parser_of(encoding)
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        others = [entry for entry in parser.error_log if entry.domain_name != "NAMESPACE"]
        if others or not parser.error_log:
            known = len(others) == len(parser.error_log)
            message = error.msg or "it is empty" if known else f"{others[0].message}, line {others[0].line}"
            raise SourceError(explain_error(" ".join(message.split()))) from None
        root = etree.fromstring(content, parser_of(encoding, recover=True))
    if local_name(root) != "svg":
        space, _, name = str(root.tag).rpartition("}")
        if name == "svg":
            raise SourceError(f"the root element has the namespace {space[1:][:80]!r}; the one of SVG is {SVG!r}")
        raise SourceError(f"the root element is <{name[:40]}>, not <svg>; this is not an SVG file")
    for element in root.iter("*"):
        if len(element.attrib) > MOST_ATTRIBUTES:
            raise SourceError(
                f"<{etree.QName(element).localname[:40]}> has {len(element.attrib):,} attributes; "
                f"the limit is {MOST_ATTRIBUTES:,}; remove those that draw nothing"
            )
    if str(root.tag).startswith(f"{{{SVG}}}"):
        for element in root.iter("{}*"):
            if ":" not in str(element.tag):  # its prefix is not declared
                element.tag = f"{{{NOWHERE}}}{element.tag}"
    return root


def parser_of(encoding: str | None = None, *, recover: bool = False) -> etree.XMLParser:
    """Return a parser with all limits; with `recover`, an undeclared prefix becomes part of the name.

    `encoding` overrides the encoding that the document declares.
    """
    return etree.XMLParser(
        encoding=encoding,
        resolve_entities="internal",  # type: ignore[arg-type]  # lxml-stubs knows only True and False
        no_network=True,
        huge_tree=False,
        remove_comments=True,
        recover=recover,
    )


def explain_error(message: str) -> str:
    """Return a message of libxml2, with the limit and a remedy if a limit was exceeded."""
    if "amplification" in message:
        return "its entities expand to too much text (an entity bomb?); write the drawing without entities"
    if "xcessive depth" in message:
        return "its elements are nested more than 256 deep; flatten its groups"
    if "XML_PARSE_HUGE" in message or "too long" in message or "too large" in message.lower():
        return "an attribute or text is longer than 10,000,000 characters; split a path, or link to a picture in a file"
    if message.startswith("Entity"):
        return f"{message[:120]}; only entities that the file itself defines are read, external ones never"
    return f"not well-formed XML: {message[:160]}"


def local_name(element: etree._Element) -> str | None:
    """Return the name of an SVG element, with or without the namespace; None for comments and other namespaces.

    Examples
    --------
    >>> local_name(etree.fromstring("<g/>")), local_name(etree.fromstring('<g xmlns="urn:other"/>'))
    ('g', None)
    """
    tag = element.tag
    if not isinstance(tag, str):
        return None
    namespace, _, name = tag[1:].rpartition("}") if tag[0] == "{" else ("", "", tag)
    return name if namespace in (SVG, "") else None


def applies(element: etree._Element) -> bool:
    """Return whether the conditions on an element hold (SVG 2, 5.9)."""
    if element.get("requiredExtensions") is not None:
        return False
    languages = element.get("systemLanguage")
    if languages is None:
        return True
    return any(tag.strip().lower().split("-")[0] == LANGUAGE for tag in languages.split(","))


def language(element: etree._Element) -> str | None:
    """Return the language of an element, from `xml:lang` or `lang` of it or the nearest element around it.

    Examples
    --------
    >>> language(etree.fromstring('<g lang="tr"><text xml:lang="de-AT"/></g>')[0])
    'de-AT'
    """
    for around in (element, *element.iterancestors()):
        named = around.get(f"{{{XML}}}lang", around.get("lang"))
        if named is not None:
            tag = str(named).strip()
            return tag if tag.replace("-", "").isalnum() and tag.isascii() and len(tag) < 40 else None
    return None
