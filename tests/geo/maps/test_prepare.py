"""Layers of a map before their conversion."""

import pytest
from map_sources import METRES, cells, mapped

from vexture.base.errors import ParameterError, SourceError
from vexture_geo.maps import MapLayer, Scale, convert_map


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"where": "value > 1e9"}, SourceError, "no feature meets"),
        ({"color": Scale("size")}, ParameterError, "no column 'size' for `color`; there are: id, code, value"),
        ({"color": Scale("code", "continuous")}, ParameterError, "give `scale` categories"),
        ({"color": Scale("value", "5,1")}, ParameterError, "rising breaks"),
        ({"color": Scale("value", palette="nix")}, ParameterError, "`palette` 'nix' is unknown"),
        ({"order": "size"}, ParameterError, "no column 'size' for `order`"),
        ({"id": "size"}, ParameterError, "no column 'size' for `id`"),
        ({"stroke": "wide"}, ParameterError, "500m, 2km or 1.5px"),
        ({"fill": "reddish"}, ParameterError, "`fill` is 'reddish'"),
        ({"layer": "roads"}, ParameterError, "no layers, so none 'roads'"),
    ],
)
def test_wrong_choices_say_what_to_do(options, error, words):
    with pytest.raises(error) as caught:
        mapped(cells(5), **options)
    assert words in str(caught.value)


def test_layers_of_one_name_are_told_apart():
    done = convert_map(
        [MapLayer(cells(5), id="code", color=Scale("value")), MapLayer(cells(5, 4), id="code")], crs=METRES
    )
    ids = done.table.column("id").to_pylist()
    assert ids == [f"{layer}:c{k}" for layer in ("map", "map#2") for k in range(5)]
    assert set(done.conversion.texture.roots[0].style.names) <= set(ids)
    assert done.table.column("layer").unique().to_pylist() == ["map", "map#2"]
