"""Maps: the feature at any point is shapely's answer; strokes, symbols, colours; and bad input in one line."""

import json

import numpy as np
import pyarrow.parquet
import pytest
import shapely
from click.testing import CliRunner
from map_sources import METRES, cells, frame, mapped, messages, names_at, overlapping
from PIL import Image, ImageDraw

import vexture
from vexture.base.errors import LimitError, ParameterError, SourceError
from vexture.base.notes import Notes
from vexture.cli.main import main
from vexture_geo.maps import MapLayer, Scale, Times, convert_map
from vexture_geo.maps.colours import colours_of
from vexture_geo.maps.place import MOST_LATITUDE, RADIUS
from vexture_geo.maps.times import with_steps
from vexture_geo.vector.features import read_features


@pytest.mark.parametrize("seed", [1, 2])
def test_the_feature_at_a_point_is_that_of_shapely(seed):
    source = cells(seed=seed)
    points = np.random.default_rng(seed).uniform(0, 1000, (4000, 2))
    inside = shapely.STRtree(source.geometry.values)
    at, cell = inside.query(shapely.points(points), predicate="within")
    far = shapely.distance(shapely.points(points[at]), shapely.boundary(source.geometry.values[cell])) > 0.1
    done = mapped(source, id="code", color=Scale("value", "continuous"))
    found = names_at(done, points[at[far]])
    assert far.sum() > 3500
    assert (found == source.code.values[cell[far]]).all()


def test_colours_of_features_change_by_their_ids_and_the_table_knows_them():
    done = mapped(cells(20), id="code", columns=("value",))
    texture = done.conversion.texture.with_paints({"c3": "red"})
    assert texture.roots[0].style.names.count("c3") == 1
    assert done.table.column_names == ["id", "code", "value"]
    assert set(done.table["id"].to_pylist()) == set(texture.roots[0].style.names)


def test_strokes_in_metres_have_their_width_on_the_ground_at_every_latitude():
    lines = [shapely.LineString([(0, 0), (2, 0)]), shapely.LineString([(0, 60), (2, 60)])]
    done = mapped(frame(lines, code=["low", "high"]), "EPSG:3857", id="code", stroke="20km")
    north = RADIUS * np.arcsinh(np.tan(np.radians(60)))
    rows = np.array([[100e3, 9.7e3], [100e3, 10.3e3], [100e3, north + 19.5e3], [100e3, north + 20.5e3]])
    assert names_at(done, rows).tolist() == ["low", "", "high", ""]


def test_strokes_and_symbols_in_pixels():
    shapes = [shapely.LineString([(0, 0), (100, 0)]), shapely.Point(50, 50), shapely.Point(100, 100)]
    source = frame(shapes, METRES, code=["line", "one", "two"])
    done = mapped(source, id="code", stroke="2px", symbol_size="6px", size=100)
    at = np.array([[30.0, 0.9], [30.0, 1.1], [52.8, 50.0], [53.2, 50.0], [97.2, 100.0]])
    assert names_at(done, at).tolist() == ["line", "", "one", "", "two"]


def test_a_symbol_is_drawn_from_an_svg():
    square = vexture.read(b'<svg viewBox="0 0 1 1"><path fill="red" d="M0 0h1v1h-1z"/></svg>')
    source = frame([shapely.Point(0, 0), shapely.Point(100, 100)], METRES, code=["a", "b"])
    done = mapped(source, id="code", symbol=square, symbol_size="10m")
    assert names_at(done, np.array([[4.9, 4.9], [5.1, 0.0]])).tolist() == ["a", ""]
    assert done.conversion.drawing.paths[0].paint.hex == "#ff0000"


def test_a_picture_of_pixels_is_traced_as_a_symbol(tmp_path):
    picture = Image.new("RGBA", (64, 64))
    ImageDraw.Draw(picture).rectangle((0, 0, 63, 31), fill="red")
    picture.save(tmp_path / "half.png")
    frame([shapely.Point(0, 0), shapely.Point(100, 100)], METRES, code=["a", "b"]).to_file(tmp_path / "p.gpkg")
    arguments = ["map", str(tmp_path / "p.gpkg"), "-o", str(tmp_path / "m.ktx2"), "--id", "code", "--crs", METRES]
    result = CliRunner().invoke(main, [*arguments, "--symbol", str(tmp_path / "half.png"), "--symbol-size", "20m"])
    assert result.exit_code == 0, result.output
    (root,) = (texture := vexture.load(tmp_path / "m.ktx2")).roots
    places = np.array([[5.0, 5.0], [5.0, -5.0], [95.0, 105.0]])
    assert texture.element_at((places - root.to_source[:, 2]) / root.to_source[0, 0]).name.tolist() == ["a", "", "b"]


def classes(values, *scale):
    source = frame([shapely.Point(k, 0) for k in range(len(values))], METRES, v=values)
    return colours_of(read_features(source, notes=Notes()).table, Scale("v", *scale), Notes())


def test_classes_by_breaks_quantiles_and_equal_steps():
    rgba, legend = classes([1.0, 10.0, 11.0, None, 99.0], "10,50")
    assert [entry["count"] for entry in legend["entries"]] == [1, 2, 1]
    assert legend["no_data"]["count"] == 1
    assert (rgba[1] == rgba[2]).all()
    assert [e["count"] for e in classes(list(range(100)), "quantiles")[1]["entries"]] == [20] * 5
    assert [e["from"] for e in classes([0.0, 1.0, 100.0], "equal")[1]["entries"]] == pytest.approx([0, 20, 40, 60, 80])
    assert classes(["x", "y", "x"])[1]["entries"][0] == {"color": "#e69f00", "label": "x", "count": 2}


def test_web_mercator_ends_at_its_latitude():
    south = frame([shapely.box(-180, -90, 180, -60), shapely.box(0, 0, 10, 10)], code=["antarctica", "land"])
    done = mapped(south, "EPSG:3857", id="code")
    edge = RADIUS * np.pi
    drawing = done.conversion.drawing
    assert drawing.to_source @ (0, 0.5 - drawing.sides[1] / 2, 1) == pytest.approx((-edge, -edge))
    assert names_at(done, np.array([[edge - 1e5, 1e5 - edge], [5e5, 5e5]])).tolist() == ["antarctica", "land"]
    assert any(f"{MOST_LATITUDE:.2f}" in message for message in messages(done))


def test_a_polygon_across_the_antimeridian_stays_whole_or_is_on_both_sides():
    fiji = shapely.Polygon([(177, -18), (-178, -18), (-178, -16), (177, -16)])
    alone = mapped(frame([fiji]), "EPSG:3857")
    assert alone.conversion.drawing.sides[0] == 1.0
    assert alone.conversion.drawing.to_source[0, 0] == pytest.approx(RADIUS * np.radians(5))
    band = shapely.segmentize(shapely.box(-179.9, 20, 179, 30), 10)
    both = mapped(frame([fiji, band], code=["fiji", "band"]), "EPSG:3857", id="code")
    y = -RADIUS * np.arcsinh(np.tan(np.radians(17)))
    x = RADIUS * np.radians([-179.0, 178.5, 0.0])
    assert names_at(both, np.stack([x, np.full(3, y)], axis=1)).tolist() == ["fiji", "fiji", ""]


def test_a_large_polygon_and_one_in_many_parts():
    angle = np.linspace(0, 2 * np.pi, 100_000, endpoint=False)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1) * (500 + 20 * np.sin(40 * angle))[:, None]
    parts = shapely.MultiPolygon([shapely.box(k, 600, k + 1, 601) for k in range(0, 600, 3)])
    done = mapped(frame([shapely.Polygon(ring), parts], METRES, code=["large", "parts"]), id="code")
    assert names_at(done, np.array([[0.0, 0.0], [300.5, 600.5], [302.0, 600.5]])).tolist() == ["large", "parts", ""]


def test_sources_that_hold_nothing_or_too_much_say_so(monkeypatch):
    with pytest.raises(SourceError, match="none of its features has a geometry"):
        mapped(frame([shapely.Polygon(), None], METRES))
    monkeypatch.setattr("vexture_geo.maps.convert.MOST_PAINTS", 5)
    with pytest.raises(LimitError, match=r"`restyle` off.*vexture tiles"):
        mapped(cells(5))
    assert len(mapped(cells(5), restyle=False).table) == 5


def test_the_command_writes_texture_and_table(tmp_path):
    cells(12).to_file(tmp_path / "cells.gpkg")
    lines = frame([shapely.LineString([(0, 0), (900, 900)])], METRES, code=["road"])
    lines.to_file(tmp_path / "roads.fgb")
    arguments = ["map", str(tmp_path / "cells.gpkg"), str(tmp_path / "roads.fgb"), "-o", str(tmp_path / "m.ktx2")]
    arguments += ["--id", "code", "--color", "value", "--color", "", "--crs", METRES, "--stroke", "20m", "--json"]
    arguments += ["--outline", "white", "--outline", ""]
    result = CliRunner().invoke(main, arguments)
    assert result.exit_code == 0, result.output
    assert '"label"' in result.output
    assert vexture.load(tmp_path / "m.ktx2").roots[0].style.names[-2:] == ("cells:outline", "road")
    assert (tmp_path / "m.parquet").exists()
    wrong = CliRunner().invoke(main, [*arguments, "--order", "a", "--order", "b", "--order", "c"])
    assert wrong.exit_code == 1
    assert "--order is given 3 times for 2 sources" in wrong.output


def test_notes_name_the_features(tmp_path):
    bows = [shapely.Polygon([(x, 0), (x + 90, 90), (x + 90, 0), (x, 90)]) for x in range(2000, 2600, 100)]
    source = tmp_path / "land.parquet"
    shapes = [
        *overlapping(),
        *bows[:-1],
        shapely.MultiPolygon([bows[-1], shapely.transform(bows[-1], lambda xy: xy + 200)]),
    ]
    frame(shapes, METRES, code=[f"c{k}" for k in range(len(shapes))]).to_parquet(source)
    arguments = ["map", str(source), "--id", "code", "--crs", METRES, "-o", str(tmp_path / "out.ktx2")]
    told = CliRunner().invoke(main, arguments).stderr
    assert "overlap it: --order says which is above (1: c0)" in told
    assert "is repaired (6: c3, c4, c5, c6, c7, ...)" in told
    repaired, below = json.loads(CliRunner().invoke(main, [*arguments, "--json"]).stdout)["notes"]
    assert [element["name"] for element in repaired["elements"]] == [f"c{k}" for k in range(3, 9)]
    assert (below["count"], below["elements"]) == (1, [{"name": "c0", "box": None}])
    assert below["message"].endswith("--order says which is above")


def test_outlines_are_drawn_once_above_their_polygons_and_not_within_a_feature():
    halves = shapely.MultiPolygon([shapely.box(200, 0, 250, 100), shapely.box(250, 0, 300, 100)])
    source = frame([shapely.box(0, 0, 100, 100), shapely.box(100, 0, 200, 100), halves], METRES, code=["a", "b", "c"])
    done = mapped(source, id="code", outline="#ffffff80", outline_width="10m")
    at = np.array([[95.5, 50], [94.5, 50], [104.5, 50], [205.5, 50], [250, 50], [300, 104.5], [100, 100], [-4.5, 50]])
    expected = ["outline", "a", "outline", "c", "c", "outline", "outline", "outline"]
    assert names_at(done, at).tolist() == expected
    (path,) = (path for path in done.conversion.drawing.paths if path.element == "outline")
    assert path.paint.opacity == pytest.approx(128 / 255)
    assert done.table["id"].to_pylist() == ["a", "b", "c"]
    again = mapped(frame([shapely.box(0, 0, 9, 9)], METRES, code=["outline"]), id="code", outline="red")
    assert {path.element for path in again.conversion.drawing.paths} == {"outline", "outline_"}
    with pytest.raises(ParameterError, match="`outline_width` is '1'"):
        mapped(source, outline="red", outline_width="1")


def test_the_command_writes_the_colours_of_steps(tmp_path):
    source = cells(12)
    for year in (9, 10, 11):
        source[f"y{year}"] = source["value"] + year
    source.to_file(tmp_path / "cells.gpkg")
    arguments = ["map", str(tmp_path / "cells.gpkg"), "-o", str(tmp_path / "m.ktx2"), "--id", "code", "--crs", METRES]
    result = CliRunner().invoke(main, [*arguments, "--time", "y*", "--columns", "value", "--json"])
    assert result.exit_code == 0, result.output
    made = json.loads((tmp_path / "m.times.json").read_text())
    assert made["times"] == ["y9", "y10", "y11"]
    texture = vexture.load(tmp_path / "m.ktx2")
    assert made["ids"] == sorted(texture.roots[0].style.names, key=lambda name: int(name[1:]))
    own = {
        path.element: path.paint.hex for path in mapped(source, id="code", times=Times("y*")).conversion.drawing.paths
    }
    assert made["colors"][0] == [own[name] for name in made["ids"]]
    assert made["colors"][2] != made["colors"][0]
    table = pyarrow.parquet.read_table(tmp_path / "m.parquet")
    assert table.column_names == ["id", "code", "value", "y9", "y10", "y11"]
    (legend,) = json.loads(table.schema.metadata[b"vexture.legend"])
    assert (legend["column"], legend["times"]) == ("y", ["y9", "y10", "y11"])
    both = CliRunner().invoke(main, [*arguments, "--time", "y*", "--color", "value"])
    assert (both.exit_code, "--color or its --time" in both.output) == (1, True)
    none = CliRunner().invoke(main, [*arguments, "--time", "y9,y8"])
    assert (none.exit_code, "it has no column 'y8' for --time; there are" in none.output) == (1, True)
    fixed = CliRunner().invoke(main, [*arguments, "--time", "y*", "--no-restyle"])
    assert (fixed.exit_code, "leave --restyle on" in fixed.output) == (1, True)


def stepped(source, times, **options):
    return mapped(source, id="code", times=times, **options)


def test_a_table_of_times_is_joined_by_ids_and_what_does_not_fit_is_said(tmp_path):
    source = frame([shapely.box(k, 0, k + 1, 1) for k in range(3)], METRES, code=["01", "02", "03"])
    rows = ["id,time,people", "01,2001-02,5", "02,2001-01,7", "02,2001-02,8", "02,2001-02,9", "99,2001-01,1"]
    (tmp_path / "t.csv").write_text("\n".join(rows))
    done = stepped(source, Times(tmp_path / "t.csv"))
    assert done.table["2001-01"].to_pylist() == [None, 7, None]
    assert done.table["2001-02"].to_pylist() == [5, 9, None]
    assert done.times["colors"][0][0] == done.times["colors"][1][2] == "#d9d9d9"
    said = " ".join(messages(done))
    assert "no feature has 1 id of the table of times, such as " in said
    assert "the table of times has 1 row with the id and the time of a later one" in said
    numbers = pyarrow.table({"id": [1, 2], "time": [10.0, 9.0], "kind": ["a", "b"]})
    done = stepped(source.assign(code=[1, 2, 3]), Times(numbers))
    assert done.times["times"] == ["9", "10"]
    assert [entry["label"] for entry in done.legends[0]["entries"]] == ["a", "b"]


def test_rows_without_a_time_and_infinite_values_are_counted():
    for times in (["a", "", None], [1.0, np.nan, None]):
        notes, features = Notes(), read_features(cells(3), id="code", notes=Notes())
        table = pyarrow.table({"id": ["c0", "c1", "c2"], "time": times, "v": [np.inf, 1.0, 2.0]})
        assert len(with_steps(features, Times(table), notes)[1]) == 1
        said = [str(note) for note in notes.in_order]
        assert "a row of the table of times has no time, and does not count (2)" in said
    said = messages(stepped(cells(3), Times(table)))
    assert "a value of 'v' is infinite, and has the colour of no data" in said


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"id": ["x"], "time": [1], "v": [1]}, "no id of the table of `times` is that of a feature"),
        ({"id": ["c1"], "v": [1]}, "has the columns id, v; it needs id, time and one of values"),
    ],
)
def test_tables_of_times_that_do_not_fit_are_refused(table, words):
    with pytest.raises((SourceError, ParameterError), match=words):
        stepped(cells(3), Times(pyarrow.table(table)))


def test_one_layer_changes_with_time_and_the_others_stay():
    points = frame([shapely.Point(500, 500)], METRES, code=["p"])
    layers = [MapLayer(cells(5), id="code", times=Times(["value", "value2"])), MapLayer(points, id="code")]
    layers[0].source["value2"] = 1.0
    done = convert_map(layers, crs=METRES)
    assert done.times["ids"] == [f"c{k}" for k in range(5)]
    with pytest.raises(ParameterError, match="`times` is given for several sources"):
        convert_map([layers[0], layers[0]], crs=METRES)
