"""Animations by elements of a document (SVG Animations 2): their values at its start become those of what they animate.

So the first frame is drawn. Those by style sheets are in `keyframes.py`.
"""

import re
from collections import Counter
from enum import Enum
from typing import Final

from lxml import etree

from vexture.deadline import check_time
from vexture.svg.animation_bases import SIZES, STYLED, Bases
from vexture.svg.between import UnclearError, added
from vexture.svg.course import along, known, said, values_of
from vexture.svg.document import applies, local_name
from vexture.svg.links import Links, reference
from vexture.svg.motion import motion
from vexture.svg.page import Page
from vexture.svg.properties import KEYWORDS, PROPERTIES
from vexture.svg.style import LISTING
from vexture.svg.timing import END, Progress, progress
from vexture.svg.values import TooLargeError, numbers
from vexture.svg.variables import refers

__all__ = ["ANIMATIONS", "Moment", "show_moment"]

ANIMATIONS: Final = frozenset({"animate", "animateColor", "animateMotion", "animateTransform", "discard", "set"})

MOST: Final = 1_000
"""Animations of one element, whose values add up."""

TRANSFORMS: Final = {"translate": "0", "scale": "1", "rotate": "0", "skewX": "0", "skewY": "0"}
"""Kinds of transforms, and the number that changes nothing."""

TRANSFORMED: Final = frozenset({"gradientTransform", "patternTransform", "transform"})
"""Attributes that are transforms, which no other element animates."""

OWN: Final = re.compile(r"\s*([a-zA-Z]+)\s*\(([^()]*)\)")
"""The first transform of a list."""

NAME: Final = re.compile(r"[A-Za-z_][\w.-]*", re.ASCII)
"""Of an attribute that can be animated; one with a prefix cannot."""


class Moment(Enum):
    """What is shown of a document that is animated, and what a note says of it; the value is a rule for its sheets."""

    START = ""
    REST = "*{animation-delay:1s!important;animation-fill-mode:none!important}"
    END = "*{animation-direction:reverse!important;animation-delay:0s!important}"

    @property
    def remark(self) -> str:
        """What is drawn instead of the first frame."""
        told = {
            Moment.REST: "its first frame shows nothing; it is drawn as it is without its animation",
            Moment.END: "its first frame shows nothing; it is drawn as its animation ends",
        }
        return told.get(self, "")


def show_moment(root: etree._Element, page: Page, moment: Moment = Moment.START) -> list[etree._Element]:
    """Give the elements of a document in a page the values that its animations have at a moment.

    Return the animations whose values are not known: of these nothing is changed.
    """
    for sheet in root.iter("{*}style"):
        if moment is not Moment.START and sheet.text:
            sheet.text = moment.value + sheet.text
    if moment is Moment.REST:
        return []
    links, bases, unclear = Links(root), Bases(root, page), list[etree._Element]()
    found, counts = list[tuple[Progress, etree._Element]](), Counter[etree._Element]()
    for element in root.iter("*"):
        if local_name(element) in ANIMATIONS and applies(element):
            try:
                how = progress(element) if moment is Moment.START else END
            except TooLargeError:
                how = None
            if how is not None:
                found.append((how, element))
    for how, element in sorted(found, key=lambda one: one[0].begin):  # stable; the one that began last wins
        link = reference(element)
        target = element.getparent() if link is None else links.target(link)
        if target is None:
            continue
        check_time()
        counts[target] += 1
        try:
            if counts[target] > MOST:
                raise UnclearError
            animate(target, element, how, links, bases)
        except (TooLargeError, UnclearError):
            unclear.append(element)
    return unclear


def animate(target: etree._Element, element: etree._Element, how: Progress, links: Links, bases: Bases) -> None:
    """Give an element what one animation says of it; raises an `UnclearError` if that is not known."""
    kind = local_name(element)
    name = element.get("attributeName", "").strip().removeprefix("xlink:")
    if kind == "animateMotion":
        moved = motion(element, how, links)
        if moved is None:
            raise UnclearError
        target.set("transform", f"{moved} {target.get('transform', '')}")
    elif kind == "animateTransform":
        if name in TRANSFORMED:
            turn(target, element, name, how)
    elif not NAME.fullmatch(name) or name in TRANSFORMED:
        return
    elif kind == "set":
        if element.get("to") is not None:
            put(target, name, element.get("to", ""))
    elif kind != "discard":  # which no browser follows
        value = value_of(target, element, name, how, bases)
        if value is not None:
            put(target, name, value)


def value_of(target: etree._Element, element: etree._Element, name: str, how: Progress, bases: Bases) -> str | None:
    """The value that an animation gives an attribute; None for the base."""
    given = said(element)
    sums = element.get("additive") == "sum" and given not in ({"by"}, {"to"})
    base = bases.value(target, name) if sums or (how.part and "from" not in given) or given == {"by"} else None
    values = values_of(element, base)
    if how.part:
        values = [bases.inherited(target, name) if value == "inherit" else value for value in values]
    value = along(element, values, how) if values else None
    return known(added(known(base), value)) if sums and value is not None else value


def put(target: etree._Element, name: str, value: str) -> None:
    """Give an element a value of an attribute, which as a property stands above style sheets."""
    is_size = name in SIZES and local_name(target) not in LISTING
    if name in STYLED or is_size:
        plain = value.strip()
        if not (plain.lower() in KEYWORDS or refers(plain) or PROPERTIES[name].allows(plain)):
            raise UnclearError
        target.set("style", f"{target.get('style', '')};{name}:{value}")
    if name not in STYLED:
        target.set(name, value)


def turn(target: etree._Element, element: etree._Element, name: str, how: Progress) -> None:
    """Give an element the transform that an animation says."""
    kind = element.get("type", "translate")
    given, base = said(element), target.get(name, "")
    if kind not in TRANSFORMS:
        return
    if given == {"by"} and kind == "scale":  # to which browsers give no meaning
        raise UnclearError
    own = OWN.match(base) if given == {"to"} else None
    values = values_of(element, own[2] if own and own[1] == kind else TRANSFORMS[kind])
    value = along(element, values, how, lambda *pair: arguments_between(kind, *pair)) if values else None
    if value is not None:
        before = f"{base} " if element.get("additive") == "sum" or given == {"by"} else ""
        target.set(name, f"{before}{kind}({value})")


def arguments_between(kind: str, first: str, second: str, part: float) -> str:
    """Arguments of a transform at a part of the way from one to another, in which those that are not said count."""
    ends = numbers(first), numbers(second)
    if not (ends[0] and ends[1]):
        raise UnclearError
    count = max(map(len, filter(None, ends)))
    pairs = zip(*((end + (end if kind == "scale" else [0.0] * count))[:count] for end in ends if end), strict=True)
    return " ".join(repr(a + part * (b - a)) for a, b in pairs)
