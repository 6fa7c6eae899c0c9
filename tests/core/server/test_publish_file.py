"""Files of any kind as shapes that can be published."""

import numpy as np
import pytest

from vexture.base.errors import SourceError
from vexture.conversion.parameters import Parameters
from vexture.server.publish_file import PUBLISHED_PARAMETERS, _box_in_browsers, shape_of, thesis_pair
from vexture.texture.load import texture_from

HALF = b'<svg viewBox="0 0 2 2"><path d="M0 0h2v1h-2z"/><foreignObject/></svg>'


def test_a_drawing_has_its_source_beside_its_texture():
    shape = shape_of(HALF, "half.svg", "half", PUBLISHED_PARAMETERS)
    assert (shape.name, shape.views.keys(), shape.views["svg"].data) == ("half", {"svg"}, HALF)
    assert (shape.facts["segments"], shape.facts["bytes"]) == (4, len(shape.texture.data))
    assert shape.facts["warnings"] == ["half.svg: left out: <foreignObject>"]
    texture = texture_from(shape.texture.data, "half")
    assert texture.contains([(0.5, 0.75), (0.5, 0.25)], 0).tolist() == [True, False]
    again = shape_of(shape.texture.data, "half.ktx2", "other", PUBLISHED_PARAMETERS)
    assert (again.name, again.texture, again.views) == ("other", shape.texture, {})
    assert again.facts["curves"] == shape.facts["curves"]
    with pytest.raises(SourceError, match="other: a texture without its drawing cannot be compared"):
        thesis_pair(again, 8)


@pytest.mark.parametrize(("data", "line"), [(b"", "is empty"), (b"hello", "holds nothing that can be read")])
def test_what_is_no_drawing_is_refused_by_its_name(data, line):
    with pytest.raises(SourceError, match=f"^a.svg: {line}"):
        shape_of(data, "a.svg", "a", Parameters())


def test_browsers_show_a_drawing_without_a_size_in_300_times_150_pixels():
    to_source = np.array([[300.0, 0.0, 0.0], [0.0, -300.0, 300.0]])
    assert _box_in_browsers(None, to_source) == pytest.approx([0.0, 0.5, 1.0, 1.0])
