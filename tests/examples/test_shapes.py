"""The example drawings keep what their table promises, measured without any reader of vexture."""

import re
import runpy
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import skia
from fontTools.pens.recordingPen import RecordingPen
from fontTools.svgLib.path import parse_path
from lxml import etree

from vexture_evidence.measures import thesis_numbers

ROOT = Path(__file__).parents[2]
SHAPES = ROOT / "examples" / "shapes"

TABLE_5_1 = {name: row.segments for name, row in thesis_numbers.TABLE_5_1.items()}
HARD = {"crossings": 10, "holes": 32, "cusp": 4, "loop": 4, "hairline": 4}
SEGMENTS = TABLE_5_1 | HARD
LICENCES = {  # of those that are not wholly ours
    "font": "https://dejavu-fonts.github.io/License.html",
    "ocean": "https://www.gnu.org/licenses/lgpl-3.0.html",
}
HALF_A_DIGIT = 0.005  # coordinates have two decimals
METRES = 250 * 89.03  # width of ocean.svg: a quarter of a degree at 36.99 degrees north


def root(name):
    return etree.fromstring((SHAPES / f"{name}.svg").read_bytes())


def style(element):
    return dict(declaration.split(":") for declaration in element.get("style").split(";"))


def contours(name):
    """Every subpath as (n, 4, 2) cubics in units of the drawing."""
    found = []
    for element in root(name).iter("{*}path"):
        pen = RecordingPen()
        parse_path(element.get("d"), pen)
        for operator, points in pen.value:
            points = [np.array(point) for point in points]
            if operator == "moveTo":
                found.append([])
                start = at = points[0]
                continue
            if operator == "closePath":
                if np.abs(at - start).max() < 1e-9:
                    continue
                operator, points = "lineTo", [start]
            if operator == "lineTo":
                points = [at + (points[0] - at) / 3, at + (points[0] - at) * 2 / 3, points[0]]
            elif operator == "qCurveTo":
                points = [at + (points[0] - at) * 2 / 3, points[1] + (points[0] - points[1]) * 2 / 3, points[1]]
            if operator != "endPath":
                found[-1].append([at, *points])
                at = points[-1]
    return [np.array(cubics) for cubics in found]


def chords(cubics, count=48):
    """(n * count, 2, 2) chords of the cubics, consecutive ones sharing their ends bit for bit."""
    t = np.linspace(0, 1, count + 1)[:, None]
    s = 1 - t
    curves = [s**3 * P[0] + 3 * s * s * t * P[1] + 3 * s * t * t * P[2] + t**3 * P[3] for P in cubics]
    for one, other in pairwise(curves):
        other[0] = one[-1]
    curves[0][0] = curves[-1][-1] if np.allclose(curves[0][0], curves[-1][-1]) else curves[0][0]
    return np.concatenate([np.stack([curve[:-1], curve[1:]], axis=1) for curve in curves])


def crossings(lines):
    """Number of pairs of chords that cross in their interiors."""

    def side(a, b, p):
        return np.sign(
            (b[..., 0] - a[..., 0]) * (p[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (p[..., 0] - a[..., 0])
        )

    a, b = lines[:, 0], lines[:, 1]
    i, j = np.triu_indices(len(lines), 1)
    near = (np.maximum(a, b)[i] >= np.minimum(a, b)[j]).all(axis=1) & (np.maximum(a, b)[j] >= np.minimum(a, b)[i]).all(
        axis=1
    )
    i, j = i[near], j[near]
    apart = (side(a[i], b[i], a[j]) * side(a[i], b[i], b[j]) < 0) & (
        side(a[j], b[j], a[i]) * side(a[j], b[j], b[i]) < 0
    )
    return int(apart.sum())


def picture(name, size=256):
    """Skia's rendering, float (size, size, 3) from 0 to 1, y down, on white."""
    data = (SHAPES / f"{name}.svg").read_bytes()
    extent = float(root(name).get("width"))
    surface = skia.Surface(size, size)
    canvas = surface.getCanvas()
    canvas.clear(skia.ColorWHITE)
    canvas.scale(size / extent, size / extent)
    document = skia.SVGDOM.MakeFromStream(skia.MemoryStream(data))
    document.setContainerSize(skia.Size(extent, extent))
    document.render(canvas)
    return surface.toarray(colorType=skia.kRGBA_8888_ColorType)[:, :, :3] / 255


def inked(name, x, y):
    """Whether the picture is painted at (x, y) in units of 1/256 of the drawing."""
    return picture(name)[int(y), int(x)].min() < 0.9


def test_every_drawing_is_in_the_table():
    assert {path.stem for path in SHAPES.glob("*.svg")} == set(SEGMENTS)


@pytest.mark.parametrize("name", SEGMENTS)
def test_is_a_tidy_svg(name):
    text = (SHAPES / f"{name}.svg").read_text(encoding="utf-8")
    element = root(name)
    assert text.startswith('<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg"')
    assert element.get("viewBox") == f"0 0 {element.get('width')} {element.get('height')}"
    assert element.get("width") == element.get("height")
    assert [etree.QName(child).localname for child in element] == ["title", "desc", "metadata", "g"]
    assert element[1].text.endswith(".")
    assert element[3].get("id") == name
    assert not re.search(r"\d\.\d{3}", "".join(path.get("d") for path in element.iter("{*}path")))


@pytest.mark.parametrize("name", SEGMENTS)
def test_names_its_licence(name):
    element = root(name)
    (licence,), (title,) = element.iter("{*}license"), element.findall("{*}metadata//{*}Work/{*}title")
    resource = licence.get("{http://www.w3.org/1999/02/22-rdf-syntax-ns#}resource")
    assert resource == LICENCES.get(name, "https://opensource.org/license/mit")
    assert title.text == element[0].text


@pytest.mark.parametrize("name", SEGMENTS)
def test_segments(name):
    assert sum(map(len, contours(name))) == SEGMENTS[name]


def test_table_of_the_readme():
    rows = re.findall(r"^\| `([a-z-]+)` \| (\d+) \| (\d+) \|", (SHAPES / "README.md").read_text(), re.MULTILINE)
    sizes = {name: len((SHAPES / f"{name}.svg").read_bytes()) for name in SEGMENTS}
    print("\n".join(f"{name:15} {size:5} bytes" for name, size in sizes.items()))
    assert rows == [(name, str(SEGMENTS[name]), str(sizes[name])) for name in SEGMENTS]


@pytest.mark.parametrize("name", TABLE_5_1)
def test_nothing_crosses(name):
    assert crossings(np.concatenate([chords(cubics) for cubics in contours(name)])) == 0


@pytest.mark.parametrize(("name", "count"), [("crossings", 10), ("loop", 4)])
def test_crossings_are_where_they_belong(name, count):
    """Also proves that the check above sees crossings."""
    assert crossings(np.concatenate([chords(cubics) for cubics in contours(name)])) == count


@pytest.mark.parametrize("name", SEGMENTS)
def test_stays_inside_with_a_margin(name):
    size = float(root(name).get("width"))
    lines = np.concatenate([chords(cubics) for cubics in contours(name)])
    margin = 0.0 if name == "ocean" else 0.02 * size
    assert lines.min() >= margin - 1e-9
    assert lines.max() <= size - margin + 1e-9


@pytest.mark.parametrize("name", SEGMENTS)
def test_covers_a_sensible_share(name):
    share = (1 - picture(name)).max(axis=2)
    share = share.sum() / share.max() / share.size
    if name == "hairline":
        assert 0.002 < share < 0.02
    else:
        assert 0.05 < share < 0.9


@pytest.mark.parametrize(("name", "axis"), [("simple-small", 120), ("simple-big", 120), ("simple-offset", 69)])
def test_simple_shapes_are_symmetric(name, axis):
    (cubics,) = contours(name)
    mirrored = (cubics * (-1, 1) + (2 * axis, 0))[::-1, ::-1]
    assert np.abs(np.roll(mirrored, 1, axis=0) - cubics).max() <= 2 * HALF_A_DIGIT


@pytest.mark.parametrize("name", ["simple-big", "simple-offset"])
def test_simple_shapes_are_one_shape(name):
    (small,), (other,) = contours("simple-small"), contours(name)
    scale = np.ptp(other[..., 0]) / np.ptp(small[..., 0])
    assert np.abs((small - small[0, 0]) * scale + other[0, 0] - other).max() <= 4 * HALF_A_DIGIT


def test_simple_shape_has_smooth_and_sharp_corners():
    (cubics,) = contours("simple-small")
    arriving, leaving = cubics[:, 3] - cubics[:, 2], np.roll(cubics[:, 1] - cubics[:, 0], -1, axis=0)
    cosine = (arriving * leaving).sum(axis=1) / np.linalg.norm(arriving, axis=1) / np.linalg.norm(leaving, axis=1)
    assert (cosine > 0.9999).sum() == 2
    assert (cosine < 0.5).sum() == 3


@pytest.mark.parametrize(
    ("name", "painted", "empty"),
    [
        ("duck", [(165, 43), (139, 181), (229, 69), (219, 98), (32, 112)], [(165, 65), (237, 90), (64, 64)]),
        ("thumb", [(158, 32), (32, 171), (237, 112), (237, 163)], [(65, 181), (237, 140), (203, 64)]),
        (
            "flame",
            [(135, 53), (127, 235), (55, 101), (205, 96), (219, 43)],
            [(130, 192), (78, 96), (187, 91)],
        ),
        (
            "cake",
            [(128, 32), (128, 75), (128, 115), (128, 192), (19, 228)],
            [(128, 52), (81, 144), (128, 164)],
        ),
        (
            "font",
            [(106, 81), (178, 67), (54, 192), (125, 192), (168, 192)],
            [(155, 67), (87, 192), (202, 171)],
        ),
        ("ocean", [(2, 250), (128, 250), (253, 250), (2, 80)], [(253, 2), (2, 2), (128, 100)]),
        ("crossings", [(86, 72), (86, 30), (170, 140)], [(170, 184), (20, 20)]),
        ("holes", [(17, 72), (45, 72), (70, 72), (133, 184), (161, 184)], [(31, 72), (147, 184), (186, 184)]),
        ("cusp", [(128, 30), (128, 128), (226, 128)], [(90, 70), (200, 60)]),
        ("loop", [(128, 25), (128, 128), (228, 128)], [(60, 60), (110, 45)]),
    ],
)
def test_looks_as_described(name, painted, empty):
    assert [point for point in painted if not inked(name, *point)] == []
    assert [point for point in empty if inked(name, *point)] == []


def test_cusps_stop_at_the_middle():
    (cubics,) = contours("cusp")
    speed_at_half = cubics[:, 3] + cubics[:, 2] - cubics[:, 1] - cubics[:, 0]
    assert np.abs(speed_at_half).max() == 0


def test_each_loop_crosses_itself():
    (cubics,) = contours("loop")
    assert [crossings(chords(cubic[None])) for cubic in cubics] == [1, 1, 1, 1]


def test_holes_by_direction_and_by_rule():
    by_direction, by_rule = (style(element)["fill-rule"] for element in root("holes").iter("{*}path"))
    assert (by_direction, by_rule) == ("nonzero", "evenodd")


def test_hairline_is_a_fifth_of_a_percent_wide():
    (element,) = root("hairline").iter("{*}path")
    assert float(style(element)["stroke-width"]) / float(root("hairline").get("width")) == 0.002


@pytest.fixture(scope="module")
def make_ocean():
    return SimpleNamespace(**runpy.run_path(str(ROOT / "tools" / "make_ocean.py")))


@pytest.fixture(scope="module")
def chain(make_ocean):
    return make_ocean.fit_coastline(make_ocean.read_coastline())


@pytest.mark.slow
def test_ocean_is_up_to_date(make_ocean, chain):
    assert make_ocean.svg(chain) == (SHAPES / "ocean.svg").read_text()


def test_ocean_follows_the_real_coastline(make_ocean):
    coastline = make_ocean.read_coastline()
    (cubics,) = contours("ocean")
    drawn = chords(cubics[:28], 200)[:, 0]
    distance = np.array([np.linalg.norm(drawn - point, axis=1).min() for point in coastline])
    assert distance.max() * METRES / 256 < 90
    assert distance.mean() * METRES / 256 < 25
