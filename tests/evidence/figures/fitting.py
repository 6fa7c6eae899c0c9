"""Whether a figure can be read: what is written in it is large enough, whole, and not in the way of other writing."""

from matplotlib.axis import Axis
from matplotlib.text import Text

LEAST_POINTS = 8.0
TOUCHING = 0.5  # pixels of overlap that do not count


def written(figure):
    """All texts that are drawn, with the boxes that they take in pixels."""
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    hidden = set()
    for axes in figure.axes:
        if not axes.get_visible():
            hidden |= set(axes.findobj(Text))
        for axis in axes.findobj(Axis):
            shown = axes.axison and axis.get_visible()
            ticks = set(axis._update_ticks()) if shown else set()  # the ticks within the limits, which alone are drawn
            for tick in {*axis.get_major_ticks(), *axis.get_minor_ticks()} - ticks:
                hidden |= {tick.label1, tick.label2}
            if not shown:
                hidden |= set(axis.findobj(Text))
    found = []
    for text in figure.findobj(Text):
        if text in hidden or not text.get_visible() or not text.get_text().strip():
            continue
        box = text.get_window_extent(renderer)
        if box.width > 0.0 and box.height > 0.0:
            found.append((text, box))
    return found


def assert_legible(figure):
    """Fail where a text is small, cut off by the figure's edge, or overlaps another."""
    texts = written(figure)
    edge = figure.bbox
    for text, box in texts:
        assert text.get_fontsize() >= LEAST_POINTS, f"{text.get_text()!r} has {text.get_fontsize()} points"
        inside = box.x0 >= edge.x0 - TOUCHING and box.x1 <= edge.x1 + TOUCHING
        inside &= box.y0 >= edge.y0 - TOUCHING and box.y1 <= edge.y1 + TOUCHING
        assert inside, f"{text.get_text()!r} is cut off: {box} in {edge}"
    for place, (text, box) in enumerate(texts):
        for other, rival in texts[:place]:
            wide = min(box.x1, rival.x1) - max(box.x0, rival.x0)
            high = min(box.y1, rival.y1) - max(box.y0, rival.y0)
            apart = wide <= TOUCHING or high <= TOUCHING
            assert apart, f"{text.get_text()!r} overlaps {other.get_text()!r}"
