"""Options of tiles."""

import pytest

from vexture import ParameterError
from vexture_geo.tiles.options import TileOptions


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"max_zoom": 21}, "`max_zoom` is 21; it must be in 0..20"),
        ({"min_zoom": 13}, "`min_zoom` is 13; it must be in 0..10"),
        ({"step": 4}, "`step` is 4; it must be 2 or 3"),
        ({"processes": 0}, "`processes` is 0"),
    ],
)
def test_wrong_options_are_named(given, says):
    with pytest.raises(ParameterError, match=says.replace("..", r"\.\.")):
        TileOptions(**given)
