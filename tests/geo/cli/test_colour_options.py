"""Options of colours in the commands map and tiles."""

import geopandas
import pytest
import shapely
from click.testing import CliRunner

from vexture.base.errors import ParameterError
from vexture.cli.main import main
from vexture_geo.maps import MapLayer, convert_map

METRES = "EPSG:28992"


def squares(**columns):
    count = len(next(iter(columns.values())))
    shapes = [shapely.box(100 * k, 0, 100 * k + 100, 100) for k in range(count)]
    return geopandas.GeoDataFrame(columns, geometry=shapes, crs=METRES)


@pytest.fixture
def command(tmp_path):
    """Runs a command on a source of two squares; the exit code and what is printed."""
    squares(name=["a", "b"], v=[1.0, 2.0]).to_file(tmp_path / "land.gpkg")

    def run(name, *arguments):
        target = tmp_path / ("o.ktx2" if name == "map" else "o.pmtiles")
        given = [name, str(tmp_path / "land.gpkg"), "-o", str(target), *arguments]
        if name == "tiles":
            given += ["--max-zoom", "4", "--processes", "1"]
        done = CliRunner().invoke(main, given)
        assert target.exists() == (done.exit_code == 0)
        return done.exit_code, done.output

    return run


@pytest.mark.parametrize("name", ["map", "tiles"])
@pytest.mark.parametrize(
    ("option", "value"), [("scale", "equal"), ("classes", "3"), ("palette", "magma"), ("no-data", "red")]
)
def test_options_of_colours_without_a_column_are_refused(command, name, option, value):
    code, output = command(name, f"--{option}", value)
    assert code == 1
    assert f"--{option} {value} is of colours by an attribute; name its column by --color" in output
    assert command(name, f"--{option}", value, "--color", "v")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--outline-width", "2px"), "--outline-width 2px, but no outlines; give their colour by --outline"),
        (("--fill", "red", "--color", "v"), "--fill and colours by an attribute exclude each other; give '' for one"),
        (("--fill", "red", "--time", "v"), "--fill and colours by an attribute exclude each other; give '' for one"),
        (("--symbol", ""), "the name of a file of --symbol is empty"),
        (("--scale", "", "--color", "v"), "--scale is ''; give quantiles"),
        (("--color", "id"), "its features have numbers rather than ids; there are: name, v"),
        (("--color", "id", "--columns", "name"), "its features have numbers rather than ids; there are: name"),
    ],
)
def test_options_without_effect_are_refused_in_a_line(command, arguments, words):
    code, output = command("map", *arguments)
    assert (code, output.count("\n")) == (1, 1)
    assert words in output


def test_colours_by_ids_need_ids(command):
    source = squares(id=["a", "b"])
    with pytest.raises(ParameterError, match="give `id` id as well"):
        convert_map([MapLayer(source, color="id")], crs=METRES)
    done = convert_map([MapLayer(source, id="id", color="id")], crs=METRES)
    assert [entry["label"] for entry in done.legends[0]["entries"]] == ["a", "b"]
    assert "its features have numbers rather than ids" in command("tiles", "--color", "id")[1]
