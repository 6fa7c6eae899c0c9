"""Shapes within the limits of a server."""

import pytest

from vexture.server.limited_shapes import FullError, LimitedShapes
from vexture.server.limits import Limits
from vexture.server.published import TEXTURE_TYPE, PublishedFile, PublishedShape


def shape(name: str, content: bytes) -> PublishedShape:
    return PublishedShape(name, PublishedFile(content, TEXTURE_TYPE, ".ktx2"))


def test_a_shape_may_be_replaced_where_there_is_room_for_no_other():
    shapes = LimitedShapes(Limits(max_shapes=1))
    shapes.add(shape("a", b"1"))
    shapes.check_room(shape("a", b"2"))
    with pytest.raises(FullError, match="b: there are 1 shapes, the limit; replace one of them"):
        shapes.check_room(shape("b", b"1"))


def test_bytes_are_those_that_there_will_be_then():
    shapes = LimitedShapes(Limits(max_total=10))
    shapes.add(shape("a", b"12345678"))
    shapes.check_room(shape("b", b"12345678"))  # the same file
    shapes.add(shape("b", b"12345678"))
    shapes.check_room(shape("a", b"12"))  # the other still has the file
    for content, size in ((b"123", 11), (b"12345679", 16)):
        with pytest.raises(FullError, match=f"a: all shapes then have {size} bytes; the limit is 10"):
            shapes.check_room(shape("a", content))
    shapes.remove("b")
    shapes.check_room(shape("a", b"1234567890"))
