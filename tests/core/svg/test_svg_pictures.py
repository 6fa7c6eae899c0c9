"""Every one-issue fixture looks like what resvg draws, or like a plainer file that says the same."""

import gzip
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from plainer import PLAINER, plainer
from svg_reference import difference

from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

FIXTURES = Path(__file__).parent / "fixtures"
SPECK = ', of which it fills a small part (with viewBox="0 0 60 60" it fills all of it)'
TOPICS = (
    "animation",
    "background",
    "filters",
    "gradients",
    "groups",
    "images",
    "markers",
    "masks",
    "paths",
    "patterns",
    "shapes",
    "strokes",
    "structure",
    "style",
    "transform",
    "viewport",
)


def read_quietly(path: Path) -> Drawing:
    """Read a file some of whose values are invalid on purpose."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SourceWarning)
        return read_svg(path)


def fixture_names() -> list[str]:
    return [f"{topic}/{path.stem}" for topic in TOPICS for path in sorted((FIXTURES / topic).glob("*.svg"))]


@pytest.mark.parametrize("name", fixture_names())
def test_looks_like_the_reference(name: str) -> None:
    path = FIXTURES / f"{name}.svg"
    mean, most = difference(path, read_quietly(path), plainer(name))
    assert mean < 0.04
    assert most < 0.5


def test_fixtures_are_all_there() -> None:
    assert len(fixture_names()) > 380
    assert [name for name in PLAINER if not (FIXTURES / f"{name}.svg").is_file()] == []


def drawing_of(folder: Path, body: str, root: str = 'viewBox="0 0 100 100"') -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    return read_svg(file)


def test_segments_are_counted_honestly(tmp_path: Path) -> None:
    """A closing line counts if it draws something; a step without length never does."""
    assert drawing_of(tmp_path, '<path d="M10 10h50v50z"/>').segments == 3
    assert drawing_of(tmp_path, '<path d="M10 10h50v50L10 10z"/>').segments == 3
    assert drawing_of(tmp_path, '<path d="M10 10h50l0 0v50c0 0 0 0 0 0z"/>').segments == 3
    assert drawing_of(tmp_path, '<path d="M.1 .1l.2 0 0 .2 -.2 0 0 -.2z"/>').segments == 4
    with pytest.warns(SourceWarning, match="nothing in it is painted"):
        assert drawing_of(tmp_path, '<path d="M10 10L50 50"/><line x1="9" x2="50"/>').segments == 0


def test_the_whole_viewport_fills_the_square(tmp_path: Path) -> None:
    drawing = drawing_of(tmp_path, '<rect width="200" height="100"/>', 'viewBox="0 0 200 100"')
    corners = drawing.paths[0].contours[0][:, 0]
    assert corners.tolist() == [[0, 0.75], [1, 0.75], [1, 0.25], [0, 0.25]]


@pytest.mark.parametrize(
    "root",
    [
        'viewBox="-5 7 30 20"',
        'viewBox="-5 7 30 20" width="300"',
        'viewBox="-5 7 30 20" width="90" height="90" preserveAspectRatio="xMinYMax"',
        'viewBox="-5 7 30 20" width="90" height="50" preserveAspectRatio="none"',
        'width="40" height="60"',
    ],
)
def test_to_source_gives_user_units(tmp_path: Path, root: str) -> None:
    drawing = drawing_of(tmp_path, '<path d="M3 9h8v4z"/>', root)
    start = drawing.paths[0].contours[0][:, 0]
    user = start @ drawing.to_source[:, :2].T + drawing.to_source[:, 2]
    np.testing.assert_allclose(user, [[3, 9], [11, 9], [11, 13]], atol=1e-12)


@pytest.mark.parametrize(
    ("root", "size", "note"),
    [
        ("", (300, 150), f"it has no viewBox and no size, and is 300 x 150, as in browsers{SPECK}"),
        (
            'width="100%" height="100%"',
            (300, 150),
            f"it has no viewBox and no size, and is 300 x 150, as in browsers{SPECK}",
        ),
        ('width="60"', (60, 150), "it has no viewBox and no height, and is 60 x 150, as in browsers"),
        ('height="60"', (300, 60), "it has no viewBox and no width, and is 300 x 60, as in browsers"),
    ],
)
def test_a_file_without_size_is_as_large_as_in_browsers(
    tmp_path: Path, root: str, size: tuple[float, float], note: str
) -> None:
    with pytest.warns(SourceWarning, match=f"drawing.svg: {re.escape(note)}$"):
        drawing = drawing_of(tmp_path, '<path d="M0 0h60v60h-60z"/>', root)
    assert [str(each) for each in drawing.notes] == [note]
    np.testing.assert_allclose(max(size) * np.array(drawing.sides), size)
    np.testing.assert_allclose(drawing.to_source @ (0.5, 0.5, 1), [size[0] / 2, size[1] / 2])


@pytest.mark.parametrize("select", [None, "#inside"])
def test_what_a_file_without_size_cuts_is_named_with_the_remedy(tmp_path: Path, select: str | None) -> None:
    body = '<path id="inside" d="M20 -7.5h60v60z"/><path d="M250 90h90v80.2z"/>'
    file = tmp_path / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{body}</svg>')
    with pytest.warns(SourceWarning, match=r'which cuts it \(with viewBox="20 -8 320 179" it shows all\)$'):
        cut = read_svg(file, select)
    ends = np.concatenate([contour[:, 0] for path in cut.paths for contour in path.contours])
    assert ends[:, 1].max() == 0.75  # at the upper side
    whole = drawing_of(tmp_path, body, 'viewBox="20 -8 320 179"')
    ends = np.concatenate([contour[:, 0] for path in whole.paths for contour in path.contours])
    user = ends @ whole.to_source[:, :2].T + whole.to_source[:, 2]
    np.testing.assert_allclose([user.min(axis=0), user.max(axis=0)], [[20, -7.5], [340, 170.2]], atol=1e-9)


def test_size_of_a_unitless_side_follows_the_view_box(tmp_path: Path) -> None:
    drawing = drawing_of(tmp_path, '<rect width="20" height="10"/>', 'viewBox="0 0 20 10" height="30mm"')
    assert np.ptp(drawing.paths[0].contours[0][:, 0], axis=0).tolist() == [1, 0.5]


@pytest.mark.parametrize("body", ["", "<g/>", '<rect width="5"/>', '<path d=""/>', '<g display="none"><rect/></g>'])
def test_nothing_painted_is_a_drawing(tmp_path: Path, body: str) -> None:
    for size in ((), ("",)):
        with pytest.warns(SourceWarning, match="nothing in it is painted$"):
            assert drawing_of(tmp_path, body, *size).paths == ()


def test_colors_and_opacity(tmp_path: Path) -> None:
    drawing = drawing_of(
        tmp_path, '<g opacity="0.5"><rect width="9" height="9" fill="#f80" fill-opacity="50%" opacity="0.4"/></g>'
    )
    paint = drawing.paths[0].paint
    assert paint.color == pytest.approx((1, 136 / 255, 0))
    assert paint.opacity == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("keyword", "fills", "opacities"),
    [
        ("inherit", [(1, 0, 0)], [0.25]),
        ("unset", [(1, 0, 0)], [0.5]),
        ("initial", [(0, 0, 0)], [0.5]),
        ("revert", [(1, 0, 0)], [0.5]),
    ],
)
def test_keywords_of_the_cascade(tmp_path: Path, keyword: str, fills: list[object], opacities: list[float]) -> None:
    rect = f'<rect width="9" height="9" style="fill: {keyword}; opacity: {keyword}" fill="blue" opacity="0.1"/>'
    drawing = drawing_of(tmp_path, f'<g fill="red" opacity="0.5">{rect}</g>')
    assert [path.paint.color for path in drawing.paths] == fills
    assert [path.paint.opacity for path in drawing.paths] == opacities


def test_a_stroke_is_a_path_of_its_own(tmp_path: Path) -> None:
    body = '<path d="M10 10H90V90z" fill="red" fill-rule="evenodd" stroke="blue" stroke-width="5"/>'
    fill, stroke = drawing_of(tmp_path, body).paths
    assert (fill.paint.color, stroke.paint.color) == ((1, 0, 0), (0, 0, 1))
    assert (fill.fill_rule.name, stroke.fill_rule.name) == ("EVENODD", "NONZERO")


def test_gzipped_and_utf16_files(tmp_path: Path) -> None:
    text = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="5" height="5"/></svg>'
    packed, wide = tmp_path / "a.svgz", tmp_path / "b.svg"
    packed.write_bytes(gzip.compress(text.encode()))
    wide.write_bytes(text.encode("utf-16"))
    assert read_svg(packed).segments == read_svg(wide).segments == 4
    assert read_svg(packed).name == "a"
