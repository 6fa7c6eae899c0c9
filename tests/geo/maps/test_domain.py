"""Domains of maps: the part of the world that a projection shows."""

import numpy as np
import pytest
import shapely
from projected import SOUTH, in_system

from vexture.base.errors import SourceError
from vexture_geo.maps.domain import domain_of


def test_domains():
    assert domain_of("EPSG:3035") is None
    assert domain_of(SOUTH).pole == -90.0
    assert np.allclose(domain_of("+proj=moll +lon_0=-90").box, (-270, -90, 90, 90), atol=1e-4)


def test_the_world_on_a_map_of_a_country_is_cut_to_where_that_is_used():
    features, said = in_system([shapely.box(-170, -80, 170, 80), shapely.box(4, 51, 5, 52)], "EPSG:28992")
    assert any("cut off at the area of use" in line for line in said)
    assert np.abs(features.rings.points).max() < 1e6
    with pytest.raises(SourceError, match="no place in EPSG:28992"):
        in_system([shapely.box(-100, -80, -90, -70)], "EPSG:28992")
