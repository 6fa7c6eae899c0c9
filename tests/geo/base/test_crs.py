"""Reference systems: the order of axes, the size of units, and one line for every text that is none."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vexture.base.errors import ParameterError, SourceError
from vexture_geo.base.crs import (
    UNPLACED,
    MissingReferenceError,
    choose_crs,
    frame_around,
    period,
    same_system,
    transform_bounds,
    transform_points,
)


def test_the_users_word_stands_above_that_of_the_file():
    assert choose_crs("EPSG:28992", "EPSG:32610") == "EPSG:28992"
    assert choose_crs(None, "epsg:32610") == "EPSG:32610"
    assert choose_crs("28992", None) == "EPSG:28992"
    with pytest.raises(MissingReferenceError, match="give `crs` EPSG"):
        choose_crs(None, None)
    assert issubclass(MissingReferenceError, SourceError)


def test_a_system_that_no_authority_knows_is_kept_as_wkt():
    own = choose_crs("+proj=tmerc +lat_0=12 +lon_0=34 +x_0=1000 +ellps=bessel +units=m", None)
    assert own.startswith("PROJCRS[")
    assert choose_crs(own, None) == own
    np.testing.assert_allclose(transform_points(np.array([[1000.0, 0.0]]), own, own), [[1000, 0]])


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("nonsense", "'nonsense' is unknown"),
        ("EPSG:1", "'EPSG:1' is unknown"),
        ("EPSG:4978", "no plane"),  # geocentric
        ("EPSG:5709", "no plane"),  # heights only
        ("x" * 500, r"'x+\.\.\.' is unknown"),
        ("a\nb", "'a b' is unknown"),
    ],
)
def test_a_text_that_is_no_system_of_a_plane_is_refused(text, line):
    with pytest.raises(ParameterError, match=line) as raised:
        choose_crs(text, None)
    assert "\n" not in str(raised.value)
    with pytest.raises(SourceError, match=line):
        choose_crs(None, text)


def test_a_compound_system_is_its_plane():
    assert choose_crs("EPSG:7415", None) == "EPSG:28992"


def test_coordinates_are_x_and_y_whatever_the_systems_axes_say():
    delft = np.array([[4.3571, 52.0116]])
    expected = transform_points(delft, "OGC:CRS84", "EPSG:28992")
    np.testing.assert_allclose(expected, [[84500, 447500]], atol=1500)
    np.testing.assert_allclose(transform_points(delft, "EPSG:4326", "EPSG:28992"), expected)
    np.testing.assert_allclose(transform_points(expected, "EPSG:28992", "EPSG:4326"), delft, atol=1e-8)
    assert same_system("OGC:CRS84", "EPSG:4326")
    assert not same_system("EPSG:32610", "EPSG:32611")


def test_feet_are_measured_in_metres():
    frame = frame_around((0, 0, 100, 200), "EPSG:2227")
    np.testing.assert_allclose(frame.metres, [100 * 1200 / 3937, 200 * 1200 / 3937])
    assert frame.bounds == (0, 0, 100, 200)


@given(st.floats(-170, 170), st.floats(-80, 80))
def test_a_frame_in_degrees_is_as_large_as_the_same_one_in_metres(longitude, latitude):
    frame = frame_around((longitude, latitude, longitude + 0.01, latitude + 0.01), "EPSG:4326")
    own = f"+proj=aeqd +lon_0={longitude + 0.005} +lat_0={latitude + 0.005} +ellps=WGS84"
    sides = np.array([[0, 0.005], [0.01, 0.005], [0.005, 0], [0.005, 0.01]])
    corners = sides + np.array([longitude, latitude])
    west, east, south, north = transform_points(corners, "EPSG:4326", own)
    np.testing.assert_allclose(frame.metres, [np.hypot(*(east - west)), np.hypot(*(north - south))], rtol=1e-6)


def test_bounds_may_cross_the_antimeridian_and_stand_at_a_pole():
    frame = frame_around((179, -19, -178, -16), "EPSG:4326")
    assert frame.bounds == (179, -19, 182, -16)
    assert min(frame_around((-180, 89, 180, 90), "EPSG:4326").metres) > 0
    grads = frame_around((199, 50, -199, 51), "EPSG:4807")
    assert period("EPSG:4807") == 400
    assert grads.bounds == (199, 50, 201, 51)


@pytest.mark.parametrize(
    ("bounds", "crs", "line"),
    [
        ((3, 2, 1, 5), "EPSG:28992", "west,south,east,north"),
        ((1, 5, 3, 2), "EPSG:4326", "west,south,east,north"),
        ((1, 2, 1, 5), "EPSG:4326", "west,south,east,north"),
        ((1, 2, np.nan, 5), "EPSG:4326", "not finite"),
        ((1, 2, np.inf, 5), "EPSG:28992", "not finite"),
        ((5e5, 4e6, 6e5, 5e6), "EPSG:4326", "`crs`"),
        ((0, 80, 1, 95), "EPSG:4326", "`crs`"),
        ((0, 0, 1e-9, 5), "EPSG:28992", "less narrow"),
        ((-1e308, 0, 1e308, 5), "EPSG:28992", "less narrow"),
    ],
)
def test_bounds_that_hold_nothing_are_refused(bounds, crs, line):
    with pytest.raises(ParameterError, match=line):
        frame_around(bounds, crs)


def test_points_without_an_image_are_infinite_and_bounds_without_one_are_none():
    assert np.isinf(transform_points(np.array([[0.0, 95.0]]), "EPSG:4326", "EPSG:32610")).all()
    west, south, east, north = transform_bounds((4e5, 6e6, 9e5, 6.5e6), "EPSG:32601", "EPSG:4326")
    assert -180 <= west < east < -160
    west, south, east, north = transform_bounds((1e5, 6e6, 9e5, 6.5e6), "EPSG:32660", "EPSG:4326")
    assert 170 < west < 180 < east < 190
    assert 53 < south < north < 60
    with pytest.raises(SourceError, match="`crs`"):
        transform_points(np.zeros((1, 2)), UNPLACED, "EPSG:4326")
