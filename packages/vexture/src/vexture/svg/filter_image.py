"""Images in filters: pictures, drawings and other elements (Filter Effects 1, 9.15)."""

from dataclasses import replace

from vexture.svg.filter_content import FilterContent
from vexture.svg.filter_graph import FilterStep
from vexture.svg.images import paint_image
from vexture.svg.links import reference
from vexture.svg.painter import Painter
from vexture.svg.report import describe_element
from vexture.svg.space import ElementPlace, PlacedElement
from vexture.svg.transform import Identity

SIDES = ("x", "y", "width", "height")


def make_image(step: FilterStep) -> FilterContent:
    """Show a picture in the region of a step, or an element at its corner, as browsers do."""
    link = (reference(step.element) or "").strip()
    left, top, right, bottom = step.region
    scene = step.subject.scene
    if not link.startswith("#"):
        sides = {name: f"{side!r}px" for name, side in zip(SIDES, (left, top, right - left, bottom - top), strict=True)}
        style = replace(step.style, own={**sides, "overflow": "hidden"})

        def paint(place: ElementPlace, painter: Painter) -> list[PlacedElement]:
            paint_image(scene, step.element, replace(place, style=style), painter)
            return []

        return step.subject.content(paint)
    target, outer = scene.servers.target(link), step.subject.place
    if target is None:
        scene.report.left_out(f"feImage of '{link[:40]}', which is not in the drawing", step.subject.element)
        return FilterContent()
    if outer.inside(target):
        scene.report.left_out(f"feImage of {describe_element(target)} that shows itself", step.subject.element)
        return FilterContent()
    used = step.subject.content(lambda place, painter: [(target, replace(place, used=True, use=place.style))])
    return used.move(Identity.translate(left, top))
