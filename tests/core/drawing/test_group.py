"""Groups of a drawing: how they nest, and the layers without them."""

import pytest

from vexture.base.errors import SourceError
from vexture.drawing.drawing import Drawing, Path
from vexture.drawing.group import Blend, Group, Mask
from vexture.drawing.paint import Paint

SQUARE = Drawing.polygon([(0, 0), (1, 0), (1, 1), (0, 1)]).paths[0].contours


def drawing(groups: tuple[Group, ...], *places: int) -> Drawing:
    """A drawing with a translucent square in each of some groups."""
    return Drawing(tuple(Path(SQUARE, paint=Paint(opacity=0.5), group=place) for place in places), groups=groups)


def test_layers_have_the_opacities_of_the_groups_around_them() -> None:
    nested = drawing((Group(opacity=0.5, blend=Blend.MULTIPLY), Group(0, 0.25)), -1, 0, 1, 0)
    layers = nested.layers()
    assert [layer.paths[0].paint.opacity for layer in layers] == [0.5, 0.25, 0.0625, 0.25]
    assert all(layer.groups == () and layer.paths[0].group == -1 for layer in layers)


@pytest.mark.parametrize(
    ("groups", "places", "message"),
    [
        ((Group(0),), (), "group 0 lies in group 0"),
        ((Group(-2),), (), "group 0 lies in group -2"),
        ((), (0,), "in group 0, of 0"),
        ((Group(),), (-2,), "in group -2, of 1"),
        ((Group(),), (0, -1, 0), "paths of group 0 do not follow"),
        ((Group(), Group(0)), (1, 0, 1), "paths of group 1 do not follow"),
        ((Group(), Group(0), Group()), (1, 2, 0), "paths of group 0 do not follow"),
    ],
)
def test_a_group_that_is_not_nested_is_refused(
    groups: tuple[Group, ...], places: tuple[int, ...], message: str
) -> None:
    with pytest.raises(SourceError, match=message):
        drawing(groups, *places)


@pytest.mark.parametrize("opacity", [-0.1, 1.1, float("nan")])
def test_an_opacity_beyond_its_range_is_refused(opacity: float) -> None:
    with pytest.raises(SourceError, match="opacity"):
        Group(opacity=opacity)


def test_a_mask_without_a_group_around_it_is_refused() -> None:
    with pytest.raises(SourceError, match="no group around it"):
        Group(mask=Mask.OPACITY)


def test_masks_are_no_layers_and_no_part_of_a_silhouette() -> None:
    masked = drawing((Group(), Group(0, mask=Mask.LUMINANCE), Group(1)), -1, 0, 1, 2, 0)
    assert [len(layer.paths) for layer in masked.layers()] == [1, 1, 1]
    assert [str(note) for note in masked.layers()[0].notes] == ["clip-path or mask"]
    plain = masked.without_masks()
    assert (len(plain.paths), plain.groups, [str(note) for note in plain.notes]) == (3, (), ["clip-path or mask"])


def test_a_pattern_gives_way_to_its_mask_where_masks_are_unknown() -> None:
    """Of patterns in each other that is the outer one's."""
    groups = (Group(opacity=0.5, pattern=True), Group(0, 0.5, mask=Mask.OPACITY), Group(0, pattern=True))
    nested = drawing((*groups, Group(2, mask=Mask.OPACITY)), 1, 0, 2, 3)
    (layer,) = nested.layers()
    assert [path.paint.opacity for path in layer.paths] == [0.125]
    assert [str(note) for note in layer.notes] == ["pattern shown as solid (2)"]
    assert len(nested.without_masks().paths) == 1


def test_a_drawing_without_masks_stays_as_it_is() -> None:
    kept = drawing((Group(),), 0)
    assert kept.without_masks() is kept
