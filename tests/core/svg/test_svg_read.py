"""Reading an SVG file: its size, its encoding, and a drawing of nothing."""

import gzip
import re
from pathlib import Path

import numpy as np
import pytest

from vexture.base.errors import SourceWarning
from vexture.drawing.drawing import Drawing
from vexture.svg.read import read_svg

SPECK = ', of which it fills a small part (with viewBox="0 0 60 60" it fills all of it)'


def drawing_of(folder: Path, body: str, root: str = 'viewBox="0 0 100 100"') -> Drawing:
    file = folder / "drawing.svg"
    file.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>')
    return read_svg(file)


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


@pytest.mark.parametrize("body", ["", "<g/>", '<rect width="5"/>', '<path d=""/>', '<g display="none"><rect/></g>'])
def test_nothing_painted_is_a_drawing(tmp_path: Path, body: str) -> None:
    for size in ((), ("",)):
        with pytest.warns(SourceWarning, match="nothing in it is painted$"):
            assert drawing_of(tmp_path, body, *size).paths == ()


def test_gzipped_and_utf16_files(tmp_path: Path) -> None:
    text = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="5" height="5"/></svg>'
    packed, wide = tmp_path / "a.svgz", tmp_path / "b.svg"
    packed.write_bytes(gzip.compress(text.encode()))
    wide.write_bytes(text.encode("utf-16"))
    assert read_svg(packed).segments == read_svg(wide).segments == 4
    assert read_svg(packed).name == "a"
