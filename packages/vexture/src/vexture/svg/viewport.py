"""Mapping of content into a viewport: `viewBox` and `preserveAspectRatio` (SVG 2, 8.2)."""

import re
from typing import Final, NamedTuple

from lxml import etree

from vexture.svg.transform import Transform
from vexture.svg.values import INITIAL_SIZE, Viewport, is_relative, numbers

Rectangle = tuple[float, float, float, float]
"""Least x, least y, width and height."""


class ViewBoxFit(NamedTuple):
    """Alignment of a view box in a viewport of another aspect ratio."""

    across: float  # fraction of the free space on the left, 0..1
    down: float  # fraction of the free space above, 0..1
    rule: str  # "meet" shows the whole box, "slice" fills the viewport, "none" stretches


THINNEST: Final = 1e-9
"""Least width and height of a drawing in user units; a thinner drawing has no size."""

ANONYMOUS: Final = (300.0, 150.0)
"""Size in pixels of an image without a size (CSS 2.1, 10.3.2)."""

CENTRED = ViewBoxFit(0.5, 0.5, "meet")
"""Default of the standard."""

PART = {"min": 0.0, "mid": 0.5, "max": 1.0}
ASPECT = re.compile(r"\s*(?:defer\s+)?(?:(none)|x(min|mid|max)y(min|mid|max))(?:\s+(meet|slice))?\s*", re.IGNORECASE)


def view_box(text: str) -> Rectangle | None:
    """Parse `viewBox`; None if it is not four numbers, or its width or height is negative.

    Examples
    --------
    >>> view_box("0 0, 8 4"), view_box("0 0 8"), view_box("0 0 8 -4")
    ((0.0, 0.0, 8.0, 4.0), None, None)
    """
    values = numbers(text)
    if values is None or len(values) != 4 or min(values[2:]) < 0.0:
        return None
    x, y, width, height = values
    return x, y, width, height


def parse_fit(text: str) -> ViewBoxFit | None:
    """Parse `preserveAspectRatio`; None if it is not valid.

    Examples
    --------
    >>> parse_fit("xMinYMax slice")
    ViewBoxFit(across=0.0, down=1.0, rule='slice')
    """
    match = ASPECT.fullmatch(text)
    if match is None:
        return None
    none, across, down, rule = match.groups()
    if none:
        return ViewBoxFit(0.5, 0.5, "none")
    return ViewBoxFit(PART[across.lower()], PART[down.lower()], (rule or "meet").lower())


def view_transform(box: Rectangle, fit: ViewBoxFit, width: float, height: float) -> Transform:
    """Return the map of a view box into a viewport whose least corner is the origin.

    Examples
    --------
    >>> tuple(view_transform((0, 0, 10, 10), ViewBoxFit(1.0, 0.0, "meet"), 40, 20))
    (2.0, 0, 0, 2.0, 20.0, 0.0)
    """
    x, y, box_width, box_height = box
    across, down = width / box_width, height / box_height
    if fit.rule != "none":
        across = down = min(across, down) if fit.rule == "meet" else max(across, down)
    left, top = (width - box_width * across) * fit.across, (height - box_height * down) * fit.down
    return Transform(across, 0, 0, down, left - x * across, top - y * down)


def own_size(root: etree._Element) -> tuple[float, float]:
    """Return the width and height of a drawing as an image, by the attributes of its outermost element.

    Examples
    --------
    >>> own_size(etree.fromstring('<svg viewBox="0 0 40 20" height="5"/>'))
    (10.0, 5.0)
    """
    box = view_box(root.get("viewBox", ""))
    texts = (root.get(name, "100%").strip() for name in ("width", "height"))
    absolute = Viewport(0.0, 0.0)
    width, height = (None if is_relative(text) else absolute.length(text, 0.0, INITIAL_SIZE) for text in texts)
    if width is not None and height is not None:
        return width, height
    if box is None or min(box[2:]) < THINNEST:
        return width or ANONYMOUS[0], height or ANONYMOUS[1]
    ratio = box[2] / box[3]
    return width or (height or box[3]) * ratio, height or (width or box[2]) / ratio
