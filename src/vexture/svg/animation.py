"""Animations by elements of a document (SVG Animations 2): their values at its start become those of what they animate.

So the first frame is drawn. Those by style sheets are in `keyframes.py`.
"""

from collections import Counter
from enum import Enum
from typing import Final

from lxml import etree

from vexture.deadline import check_time
from vexture.svg.between import added
from vexture.svg.course import UnclearError, along, known, said, values_of
from vexture.svg.declarations import read_style
from vexture.svg.document import applies, local_name
from vexture.svg.links import Links, reference
from vexture.svg.motion import motion
from vexture.svg.properties import CSS_ONLY, PROPERTIES
from vexture.svg.style import LISTING
from vexture.svg.timing import END, Progress, progress
from vexture.svg.values import TooLargeError

__all__ = ["ANIMATIONS", "Moment", "show_moment"]

ANIMATIONS: Final = frozenset({"animate", "animateColor", "animateMotion", "animateTransform", "discard", "set"})

SIZES: Final = frozenset({"cx", "cy", "height", "r", "rx", "ry", "width", "x", "y"})
"""Attributes that are properties of some elements only."""

STYLED: Final = PROPERTIES.keys() - CSS_ONLY - {"d", "transform", *SIZES}
"""Attributes that are properties: their animated values override style sheets."""

MOST: Final = 1_000
"""Animations of one element, whose values add up."""

TRANSFORMS: Final = frozenset({"translate", "scale", "rotate", "skewX", "skewY"})


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


def show_moment(root: etree._Element, moment: Moment = Moment.START) -> list[etree._Element]:
    """Give the elements of a document the values that its animations have at a moment.

    Return the animations whose values are not known: of these nothing is changed.
    """
    for sheet in root.iter("{*}style"):
        if moment is not Moment.START and sheet.text:
            sheet.text = moment.value + sheet.text
    if moment is Moment.REST:
        return []
    links, unclear = Links(root), list[etree._Element]()
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
            animate(target, element, how, links)
        except (TooLargeError, UnclearError):
            unclear.append(element)
    return unclear


def animate(target: etree._Element, element: etree._Element, how: Progress, links: Links) -> None:
    """Give an element what one animation says of it; raises an `UnclearError` if that is not known."""
    kind = local_name(element)
    name = element.get("attributeName", "").strip().removeprefix("xlink:")
    if kind == "animateMotion":
        moved = motion(element, how, links)
        if moved is None:
            raise UnclearError
        target.set("transform", f"{moved} {target.get('transform', '')}")
    elif kind == "animateTransform":
        turn(target, element, name, how)
    elif kind == "set":
        if name and element.get("to") is not None:
            put(target, name, element.get("to", ""))
    elif name and kind != "discard":  # which no browser follows
        base = based(target, name)
        values = values_of(element, base)
        value = along(element, values, how) if values else None
        if value is not None and element.get("additive") == "sum" and said(element) not in ({"by"}, {"to"}):
            value = known(added(known(base), value))
        if value is not None:
            put(target, name, value)


def put(target: etree._Element, name: str, value: str) -> None:
    """Give an element a value of an attribute, which as a property stands above style sheets."""
    if name not in STYLED:
        target.set(name, value)
    if name in STYLED or (name in SIZES and local_name(target) not in LISTING):
        target.set("style", f"{target.get('style', '')};{name}:{value}")


def based(target: etree._Element, name: str) -> str | None:
    """Value that an element has without an animation; None if it does not say one itself."""
    own = [value for key, value, _ in read_style(target.get("style", "")) if key == name]
    return own[-1] if own and name in STYLED | SIZES else target.get(name)


def turn(target: etree._Element, element: etree._Element, name: str, how: Progress) -> None:
    """Give an element the transform that an animation says."""
    kind = element.get("type", "translate")
    given = said(element)
    if kind not in TRANSFORMS or not name:
        return
    plain = "1" if kind == "scale" else "0"
    base = target.get(name, "")
    if given == {"by"} and kind == "scale":  # to which browsers give no meaning
        raise UnclearError
    value = along(element, values_of(element, plain), how) if given else None
    if value is not None:
        before = f"{base} " if element.get("additive") == "sum" or given == {"by"} else ""
        target.set(name, f"{before}{kind}({value})")
