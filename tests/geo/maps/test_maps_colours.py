"""Choices of a map that would have no effect, colours of ids, of nothing and of many categories."""

from dataclasses import replace

import geopandas
import numpy as np
import pyarrow as pa
import pytest
import shapely

from vexture.base.errors import ParameterError, SourceError
from vexture.base.notes import Notes
from vexture_geo.maps import MapLayer, Scale, Times, convert_map
from vexture_geo.maps.colours import FURTHER, QUALITATIVE, colours_of, rgba_of
from vexture_geo.maps.coverage import ranks
from vexture_geo.vector.features import read_features

METRES = "EPSG:28992"


def squares(**columns):
    count = len(next(iter(columns.values())))
    shapes = [shapely.box(100 * k, 0, 100 * k + 100, 100) for k in range(count)]
    return geopandas.GeoDataFrame(columns, geometry=shapes, crs=METRES)


def test_a_fill_and_colours_exclude_each_other_in_a_layer():
    for colours in ({"color": "v"}, {"times": Times("v,w")}):
        with pytest.raises(ParameterError, match="`fill` exclude each other"):
            MapLayer("land.gpkg", fill="red", **colours)


@pytest.mark.parametrize("kind", ["auto", "quantiles", "continuous", "categories", "1,2"])
@pytest.mark.parametrize(
    "values", [pa.array([None, None], pa.float64()), pa.array([np.nan, np.nan]), pa.nulls(2), pa.nulls(2, pa.string())]
)
def test_a_column_without_a_value_has_the_colour_of_no_data(values, kind):
    notes = Notes()
    rgba, legend = colours_of(pa.table({"v": values}), Scale("v", kind, no_data="red"), notes)
    assert rgba.tolist() == [[1.0, 0.0, 0.0, 1.0]] * 2
    assert (legend["entries"], legend["no_data"]["count"]) == ([], 2)
    assert str(notes.in_order[0]) == "no feature has a value in 'v', so all have the colour of no data"


def test_what_is_no_number_is_no_category_and_lies_below():
    table = pa.table({"v": pa.array([2.0, np.nan, None, 1.0])})
    _, legend = colours_of(table, Scale("v", "categories"), Notes())
    assert [entry["label"] for entry in legend["entries"]] == ["1", "2"]
    assert legend["no_data"]["count"] == 2
    features = read_features(squares(v=[2.0, 5.0, 1.0]), notes=Notes())
    with_nan = replace(features, table=features.table.set_column(1, "v", pa.array([2.0, np.nan, 1.0])))
    assert ranks(with_nan, "v").tolist() == [2, 0, 1]


# How the three kinds of dichromats see linear light (Machado, Oliveira and Fernandes, 2009, severity 1).
SIGHTS = (
    np.eye(3),
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
)
# Oklab (Ottosson, 2020).
CONES = [
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
]
LAB = [
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
]


def least_difference(rgb):
    """Of two of some colours, as whoever tells them apart worst sees them."""
    light = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    found = []
    for sight in SIGHTS:
        seen = np.clip(light @ np.transpose(sight), 0, 1)
        lab = np.cbrt(seen @ np.transpose(CONES)) @ np.transpose(LAB)
        apart = np.linalg.norm(lab[:, None] - lab[None], axis=2)
        found.append(apart[np.triu_indices(len(rgb), 1)].min())
    return min(found)


def test_sixteen_categories_are_told_apart_with_any_colour_vision_as_well_as_seven():
    import cmap

    seven = np.array([tuple(colour.rgba)[:3] for colour in cmap.Colormap(QUALITATIVE).iter_colors()])[1:]
    many = np.array([rgba_of(colour, "colour")[:3] for colour in FURTHER])
    assert least_difference(np.concatenate([seven, many])) >= least_difference(seven)
    notes = Notes()
    values = pa.table({"v": [f"c{k:02}" for k in range(16)]})
    rgba, legend = colours_of(values, Scale("v"), notes)
    assert len(np.unique(rgba, axis=0)) == len(legend["entries"]) == 16
    assert np.allclose(rgba[:7, :3], seven, atol=1e-3), "fewer categories look as before"
    assert notes.in_order == ()
    colours_of(pa.table({"v": [f"c{k:02}" for k in range(18)]}), Scale("v"), notes)
    assert "18 categories of 'v', but 16 colours: the 2 least common ones share a grey" in str(notes.in_order[0])


@pytest.mark.parametrize(
    ("values", "labels"), [([1, 2, 10, 9, 9], "1 2 9 10"), ([2003, 2001, 2003, 2002], "2001 2002 2003")]
)
def test_categories_of_numbers_rise(values, labels):
    _, legend = colours_of(pa.table({"v": values}), Scale("v", "categories"), Notes())
    assert [entry["label"] for entry in legend["entries"]] == labels.split()


def test_common_categories_have_colours_in_their_order_and_the_others_a_grey_that_is_not_that_of_no_data():
    for palette in (None, "tab10"):
        names = [f"c{k:02}" for k in range(20)]
        own = 16 if palette is None else 10
        table = pa.table({"v": [*reversed(names), *names[2 : 2 + own], None]})
        _, legend = colours_of(table, Scale("v", palette=palette), Notes())
        *entries, other = legend["entries"]
        assert [entry["label"] for entry in entries] == names[2 : 2 + own]
        assert (other["label"], other["count"]) == ("other", 20 - own)
        colours = [rgba_of(entry["color"], "color")[:3] for entry in [*entries, legend["no_data"]]]
        assert np.linalg.norm(colours - rgba_of(other["color"], "color")[:3], axis=1).min() > 0.2
    table = pa.table({"v": [*names, "other", "other"]})
    labels = [entry["label"] for entry in colours_of(table, Scale("v"), Notes())[1]["entries"]]
    assert (labels.count("other"), labels[-1]) == (1, "5 more")


def test_an_infinite_value_and_a_palette_of_several_names(caplog):
    notes = Notes()
    colours_of(pa.table({"v": [1.0, np.inf, -np.inf]}), Scale("v", palette="coolwarm_r"), notes)
    assert [str(note) for note in notes.in_order] == ["a value of 'v' is infinite, and has the colour of no data (2)"]
    assert not caplog.records


def test_numbers_that_are_no_texts_work_or_are_told_in_a_line():
    assert Scale("v", [10, 20.5]).kind == "10,20.5"
    assert Scale("v", classes="5").classes == 5
    for wrong in ({"classes": "many"}, {"classes": 1}, {"kind": 3}, {"kind": ""}):
        with pytest.raises(ParameterError, match=r"`(classes|scale)` is"):
            Scale("v", **wrong)
    source = squares(v=[1.0, 2.0])
    for wrong in ({"outline": "red", "outline_width": 2}, {"stroke": 3}, {"outline": 3}, {"fill": 3}):
        name = [*wrong][-1]
        with pytest.raises(ParameterError, match=f"`{name}` is {wrong[name]}; give a"):
            convert_map([MapLayer(source if name != "stroke" else roads(), **wrong)], crs=METRES)


def roads():
    return geopandas.GeoDataFrame(geometry=[shapely.LineString([(0, 0), (100, 100)])], crs=METRES)


def test_an_outline_beside_a_feature_of_its_name_says_what_it_is_called():
    notes = convert_map([MapLayer(squares(code=["outline"]), id="code", outline="red")], crs=METRES).conversion.notes
    assert [str(note) for note in notes] == [
        "a feature is named 'outline' already, so the element of outlines is 'outline_'"
    ]


def test_frames_without_a_reference_system_are_drawn_as_a_plane():
    plain = squares(v=[1.0, 2.0]).set_crs(None, allow_override=True)
    plain.geometry = plain.translate(500.0, 1000.0)
    road = geopandas.GeoSeries([shapely.LineString([(500, 1000), (503, 1002)])])
    done = convert_map([MapLayer(plain, color="v", outline="white"), MapLayer(road, stroke="0.1m")])
    (root,) = done.conversion.texture.roots
    places = (shapely.get_coordinates(plain.centroid) - root.to_source[:, 2]) / root.to_source[0, 0]
    assert done.conversion.texture.element_at(places).name.tolist() == ["map:0", "map:1"]
    assert [str(note) for note in done.conversion.drawing.notes] == [
        "it names no reference system, so it is drawn as a plane; name it by `source_crs`, or set it by set_crs",
        "layers share ids, so elements are named LAYER:ID",
    ]


def test_a_frame_without_a_reference_system_is_not_put_on_a_map_that_has_one():
    placed = squares(v=[1.0])
    plain = placed.set_crs(None, allow_override=True)
    for layers, options in (([plain, placed], {}), ([plain], {"crs": "EPSG:28992"})):
        with pytest.raises(SourceError, match=r"give `source_crs` EPSG:\.\.\., or set it by set_crs"):
            convert_map([MapLayer(layer) for layer in layers], **options)
    done = convert_map([MapLayer(plain, source_crs="EPSG:28992")])
    assert done.conversion.drawing.crs == "EPSG:3857"
