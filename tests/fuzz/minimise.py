"""A smaller drawing that shows the same difference: elements, attributes, commands and digits are left out."""

import re
from collections.abc import Callable, Iterator
from time import process_time

from lxml import etree

COMMAND = re.compile(r"(?=[A-Za-z])")
NUMBER = re.compile(r"-?\d+\.\d+")
SECONDS = 60.0
"""Of the processor, for one drawing."""


def minimise_svg(svg: str, shows: Callable[[str], bool], seconds: float = SECONDS) -> str:
    """Leave out all that `shows` does without, as far as the time allows."""
    until, before = process_time() + seconds, ""
    while before != svg:
        before = svg
        for smaller in (without_elements, without_groups, without_attributes, with_shorter_values):
            svg = reduce_svg(svg, smaller, shows, until)
    return svg


def reduce_svg(
    svg: str, smaller: Callable[[etree._Element, int], bool | None], shows: Callable[[str], bool], until: float
) -> str:
    """Try one kind of change at place after place; where it shows, the next change starts from it."""
    place = 0
    while process_time() < until:
        root = etree.fromstring(svg)
        changed = smaller(root, place)
        if changed is None:
            break
        text = etree.tostring(root, encoding="unicode")
        if changed and shows(text):
            svg = text
        else:
            place += 1
    return svg


def without_elements(root: etree._Element, place: int) -> bool | None:
    """Leave out an element with all that is in it."""
    found = list(root.iter())[1:]
    if place >= len(found):
        return None
    parent = found[place].getparent()
    assert parent is not None
    parent.remove(found[place])
    return True


def without_groups(root: etree._Element, place: int) -> bool | None:
    """Put what is in a group in its place."""
    groups = [element for element in root.iter() if etree.QName(element).localname == "g"]
    if place >= len(groups):
        return None
    group = groups[place]
    parent = group.getparent()
    assert parent is not None
    at = parent.index(group)
    parent[at : at + 1] = list(group)
    return True


def without_attributes(root: etree._Element, place: int) -> bool | None:
    """Leave out an attribute."""
    found = [(element, name) for element in root.iter() for name in element.attrib if name not in ("id", "viewBox")]
    if place >= len(found):
        return None
    element, name = found[place]
    del element.attrib[name]
    return True


def with_shorter_values(root: etree._Element, place: int) -> bool | None:
    """Leave out a command of a path, or round the numbers of an attribute to fewer digits."""
    for k, (element, name, value) in enumerate(shorter(root)):
        if k == place:
            element.attrib[name] = value
            return True
    return None


def shorter(root: etree._Element) -> Iterator[tuple[etree._Element, str, str]]:
    """Attributes with shorter values that they could have."""
    for element in root.iter():
        for name, value in element.attrib.items():
            if name == "d":
                parts = COMMAND.split(value)[1:]
                for k in range(1, len(parts)):
                    yield element, name, "".join(parts[:k] + parts[k + 1 :])
            longest = max((len(number.partition(".")[2]) for number in NUMBER.findall(value)), default=0)
            for digits in range(longest):
                yield element, name, NUMBER.sub(lambda found, d=digits: f"{float(found[0]):.{d}f}", value)
