"""Units of depths: known lengths, with or without a datum; what is none is refused and never taken for metres."""

import numpy as np
import pytest
import rasterio
import xarray

import vexture
from vexture.base.errors import SourceError
from vexture_geo.base.lengths import metres_in

UNSAID = ["", "1", "-", "n/a", "unknown"]
METRES = [
    "m",
    "M",
    "metres",
    "m+NAP",
    "m NAP",
    "mNAP",
    "m (NAVD88)",
    "m (MSL/NAP)",
    "m.a.s.l.",
    "m, to NAP",
    "m-NAP",
]
ENCLOSED = ["[m]", "(m)", "m1"]
US_FEET = ["US survey foot", "us_survey_feet", "U.S. survey foot", "ftUS", "ft-us", "foot_us"]
SPEEDS = ["m2/s", "m s-1", "m/s", "mm/h", "m per day", "m s"]
TYPESET = ["m²", "m³", "m³ s⁻¹", "m·s⁻¹", "mm hr⁻¹", "m−1"]
OTHERS = [
    "m (log10)",
    "ln(re 1 m)",
    "dB re 1 m",
    "%",
    "m K",
    "m psu",
    "m kg",
    "mm Hg",
    "m squared",
    "m cubed",
    "m year",
    "m x 100",
    "feet (x10)",
    "m (×0.01)",
    "Mm",
    "Mm NAP",
]
NONE = [
    *SPEEDS,
    *TYPESET,
    *OTHERS,
    "m3",
    "m2",
    "m^2",
    "psu",
    "K",
    "dB",
    "days",
    "minutes",
    "inHg",
    "kg",
    "Pa",
    "mbar",
    "month",
    "ms",
]


@pytest.mark.parametrize(
    ("units", "metres"),
    [
        ([*UNSAID, *METRES, *ENCLOSED], 1.0),
        (["ft", "feet", "ft NAVD88", "Feet (NGVD29)"], 0.3048),
        (US_FEET, 1200 / 3937),
        (["yards", "yd"], 0.9144),
        (["fathom", "fathoms below MLLW"], 1.8288),
        (["cm", "centimeters", "1e-2 m", "0.01 metres"], 0.01),
        (NONE, None),
    ],
)
def test_units_are_known_by_their_names(units: list[str], metres: float | None) -> None:
    assert {unit: metres_in(unit) for unit in units} == dict.fromkeys(units, metres)


PLACE = rasterio.Affine(10, 0, 5e5, 0, -10, 4e6)


def lake(unit: str) -> xarray.Dataset:
    depth = np.zeros((20, 30), np.float32)
    depth[5:15, 5:25] = np.linspace(0.1, 2.1, 20)
    places = {"y": 4_090_000.0 + 10 * np.arange(20), "x": 500_000.0 + 10 * np.arange(30)}
    data = {"depth": (("y", "x"), depth, {"units": unit})}
    return xarray.Dataset(data, places, {"epsg_code": "EPSG:32610"})


@pytest.mark.parametrize(("unit", "metres"), [("yards", 0.9144), ("fathoms", 1.8288), ("ft NAVD88", 0.3048)])
def test_depths_are_read_in_metres(tmp_path, unit: str, metres: float) -> None:
    named, plain = lake(unit), lake("m")
    plain["depth"] = plain["depth"] * metres
    for name, one in (("named", named), ("plain", plain)):
        one.to_netcdf(tmp_path / f"{name}.nc")
    found, expected = (vexture.read(tmp_path / f"{name}.nc") for name in ("named", "plain"))
    assert vexture.coverage(found, 64).mean() == pytest.approx(vexture.coverage(expected, 64).mean(), rel=1e-4)


@pytest.mark.parametrize("unit", ["psu", "K", "days", "m3"])
def test_what_is_no_length_is_no_depth(tmp_path, unit: str) -> None:
    lake(unit).to_netcdf(tmp_path / "lake.nc")
    with pytest.raises(SourceError, match=f"'depth' is in '{unit}', no unit of length that is known"):
        vexture.read(tmp_path / "lake.nc")


def test_bands_of_a_geotiff_have_units(tmp_path) -> None:
    depth = lake("").depth.values
    shape = {"driver": "GTiff", "width": 30, "height": 20, "count": 1, "dtype": "float32", "crs": "EPSG:32610"}
    covered = {}
    for unit, values in (("ft", depth / 0.3048), ("", depth), ("cm", 100 * depth), ("psu", depth)):
        with rasterio.open(
            tmp_path / "a.tif", "w", transform=rasterio.Affine(10, 0, 5e5, 0, -10, 4e6), **shape
        ) as file:
            file.write(values, 1)
            file.units = (unit,)
        if unit == "psu":
            with pytest.raises(SourceError, match="its values are in 'psu', no unit of length that is known"):
                vexture.read(tmp_path / "a.tif")
        else:
            covered[unit] = float(vexture.coverage(vexture.read(tmp_path / "a.tif"), 64).mean())
    assert covered["ft"] == pytest.approx(covered[""], rel=1e-4)
    assert covered["cm"] == pytest.approx(covered[""], rel=1e-4)


@pytest.mark.parametrize(
    ("unit", "metres", "system"),
    [("km", 1000.0, 32610), ("ft", 0.3048, 32610), ("US_survey_foot", 1.0, 2227), ("1", 1.0, 2227)],
)
def test_places_are_in_the_units_of_the_system(tmp_path, unit: str, metres: float, system: int) -> None:
    plain = lake("m")
    plain.attrs["epsg_code"] = f"EPSG:{system}"
    other = plain.assign_coords({name: (name, plain[name].values / metres, {"units": unit}) for name in ("x", "y")})
    plain.to_netcdf(tmp_path / "plain.nc")
    other.to_netcdf(tmp_path / "other.nc")
    found, expected = (vexture.read(tmp_path / f"{name}.nc") for name in ("other", "plain"))
    np.testing.assert_allclose(found.to_source, expected.to_source, rtol=1e-6)
