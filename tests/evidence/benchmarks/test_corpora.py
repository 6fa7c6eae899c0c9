"""The corpora are what the benchmarks say they are."""

import runpy
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from fontTools.svgLib.path import parse_path
from lxml import etree

from vexture.base.errors import LimitError, SourceError, VextureError

ROOT = Path(__file__).parents[3]
corpora = SimpleNamespace(**runpy.run_path(str(ROOT / "packages" / "vexture-evidence" / "benchmarks" / "corpora.py")))


@pytest.fixture
def dejavu():
    try:
        return corpora.dejavu_sans()
    except SourceError as error:
        pytest.skip(str(error))


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """Lay out a corpora folder as npm leaves it, with ten small icons."""
    monkeypatch.setenv("VEXTURE_CORPORA", str(tmp_path))
    folder = tmp_path / "@mdi-svg-7.4.47" / "node_modules" / "@mdi" / "svg" / "svg"
    folder.mkdir(parents=True)
    for name in "abcdefghij":
        (folder / f"{name}.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
    (folder / "licence.txt").write_text("not an icon")
    return folder


def test_choice_depends_on_the_seed_only(installed):
    first = corpora.mdi(5, seed=1)
    assert first == corpora.mdi(5, seed=1)
    assert first != corpora.mdi(5, seed=2)
    assert len(set(first)) == 5
    assert {path.parent for path in first} == {installed}


def test_all_files_can_be_asked_for_but_not_more(installed):
    assert {path.stem for path in corpora.mdi(10, seed=0)} == set("abcdefghij")
    with pytest.raises(LimitError, match=r"^11 files asked of @mdi/svg, which has 10; ask for fewer$"):
        corpora.mdi(11, seed=0)


@pytest.mark.parametrize("corpus", ["mdi", "simple_icons", "flags"])
def test_missing_npm_is_one_clear_line(corpus, tmp_path, monkeypatch):
    monkeypatch.setenv("VEXTURE_CORPORA", str(tmp_path / "corpora"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(VextureError, match=r"^npm is missing, .*; install Node.js with npm$"):
        getattr(corpora, corpus)(1, seed=0)
    assert not (tmp_path / "corpora").exists()


def test_failing_npm_leaves_nothing_behind(tmp_path, monkeypatch):
    npm = tmp_path / "npm"
    npm.write_text("#!/bin/sh\necho 'npm error code ENETUNREACH' >&2\nexit 1\n")
    npm.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")
    monkeypatch.setenv("VEXTURE_CORPORA", str(tmp_path / "corpora"))
    with pytest.raises(VextureError, match=r"cannot install flag-icons@7\.5\.0 \(npm error code ENETUNREACH\)"):
        corpora.flags(1, seed=0)
    assert list((tmp_path / "corpora").iterdir()) == []


def test_debian_packages_say_why_they_are_missing_and_leave_nothing_behind(tmp_path, monkeypatch):
    monkeypatch.setenv("VEXTURE_CORPORA", str(tmp_path / "corpora"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(VextureError, match=r"^apt-get is missing, which fetches openclipart-svg; run this on Debian"):
        corpora.OPENCLIPART.files("*.svg")
    apt = tmp_path / "apt-get"
    apt.write_text("#!/bin/sh\necho 'W: old lists' >&2\necho 'E: Unable to locate package' >&2\nexit 100\n")
    apt.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/bin:/usr/bin")
    with pytest.raises(VextureError, match=r"cannot download openclipart-svg \(E: Unable to locate package\); run apt"):
        corpora.OPENCLIPART.files("*.svg")
    assert list((tmp_path / "corpora").iterdir()) == []


def test_glyphs_are_the_outlines_of_the_example(dejavu):
    """examples/shapes/font.svg sets TI above DE in units of the bold font, y down, from these points to the right."""
    (path,) = etree.parse(ROOT / "examples" / "shapes" / "font.svg").getroot().iter("{*}path")
    pen = corpora.ContourPen(None)
    parse_path(path.get("d"), pen)
    drawn = []
    for text, x, y in (("TI", 880, 1811), ("DE", 410, 3602)):
        for drawing in corpora.glyphs(dejavu.with_name("DejaVuSans-Bold.ttf"), text):
            em = drawing.to_source * 2048
            drawn += [(contour @ em[:, :2].T + em[:, 2]) * (1, -1) + (x, y) for contour in drawing.paths[0].contours]
            x += em[0] @ (1, 0, 1) + em[0, 2]  # centred: the two sides of the square add up to the advance
    assert sum(map(len, drawn)) == 42
    for one, other in zip(drawn, pen.contours, strict=True):
        assert np.abs(one - other).max() < 1e-9


def test_every_ascii_glyph_fits_its_line(dejavu):
    text = "".join(map(chr, range(33, 127)))
    drawings = corpora.glyphs(dejavu, text)
    assert "".join(drawing.name for drawing in drawings) == text
    assert all(drawing.segments for drawing in drawings)


def test_quadratics_are_raised_exactly(dejavu):
    """The third difference of a raised quadratic vanishes."""
    (o,) = corpora.glyphs(dejavu, "o")
    cubics = np.concatenate(o.paths[0].contours)
    assert len(o.paths[0].contours) == 2
    assert np.abs(np.diff(cubics, n=3, axis=1)).max() < 1e-15


def test_space_is_an_empty_drawing(dejavu):
    (space,) = corpora.glyphs(dejavu, " ")
    assert space.segments == 0


def test_missing_glyph_is_one_clear_line(dejavu):
    with pytest.raises(SourceError, match=r"has no glyph for '\U0001f9ff'; choose another font or text$"):
        corpora.glyphs(dejavu, "\U0001f9ff")


@pytest.mark.parametrize("edges", [6, 768, 12_288, 98_304])
def test_coastline_has_its_edges(edges):
    drawing = corpora.fractal_coastline(edges, seed=1)
    assert drawing.segments == edges
    assert drawing.name == f"coastline-{edges}"


def test_coastline_starts_as_a_hexagon():
    (contour,) = corpora.fractal_coastline(6, seed=1).paths[0].contours
    assert np.linalg.norm(contour[:, 0] - 0.5, axis=1) == pytest.approx(0.4)
    assert np.linalg.norm(contour[:, 3] - contour[:, 0], axis=1) == pytest.approx(0.4)


def test_coastline_refines_the_coarser_one():
    """Every other point of a coastline is the coarser coastline, and midpoints move along the normal only."""
    (fine,), (coarse,) = (corpora.fractal_coastline(edges, seed=3).paths[0].contours for edges in (12_288, 6_144))
    assert np.array_equal(fine[::2, 0], coarse[:, 0])
    step = coarse[:, 3] - coarse[:, 0]
    moved = fine[1::2, 0] - (coarse[:, 0] + coarse[:, 3]) / 2
    length = np.linalg.norm(step, axis=1)
    along = (moved * step).sum(axis=1) / length**2
    across = (moved[:, 1] * step[:, 0] - moved[:, 0] * step[:, 1]) / length**2
    assert np.abs(along).max() < 1e-9
    assert across.mean() == pytest.approx(0.0, abs=0.01)
    assert across.std() == pytest.approx(0.18, rel=0.03)


def test_coastline_depends_on_its_seed():
    one, same, other = (corpora.fractal_coastline(768, seed).paths[0].contours[0] for seed in (1, 1, 2))
    assert np.array_equal(one, same)
    assert not np.array_equal(one, other)


def test_no_seed_leaves_the_unit_square():
    for seed in range(40):
        assert corpora.fractal_coastline(768, seed).segments == 768


@pytest.mark.parametrize("edges", [0, -6, 5, 18, 100])
def test_other_numbers_of_edges_are_refused(edges):
    with pytest.raises(LimitError, match=rf"^a coastline of {edges} edges cannot be made; ask for six times"):
        corpora.fractal_coastline(edges, seed=0)


def test_round_shapes_come_in_both_directions():
    shapes = corpora.round_shapes()
    areas = [sum(area_beside(cubic) for cubic in shape.paths[0].contours[0]) for shape in shapes]
    assert areas[0] == pytest.approx(np.pi * 0.16, rel=1e-3)
    assert areas[1] == pytest.approx(-areas[0])
    assert areas[3] == pytest.approx(-areas[2])
    assert areas[2] > 0.1


def area_beside(cubic):
    """Integral of x dy by a fine polyline."""
    t = np.linspace(0, 1, 401)[:, None]
    x, y = (
        (1 - t) ** 3 * cubic[0] + 3 * t * (1 - t) ** 2 * cubic[1] + 3 * t**2 * (1 - t) * cubic[2] + t**3 * cubic[3]
    ).T
    return float((0.5 * (x[1:] + x[:-1]) * np.diff(y)).sum())


def test_stix_has_cubics():
    try:
        font = corpora.stix()
    except SourceError as error:
        pytest.skip(str(error))
    (o,) = corpora.glyphs(font, "o")
    assert np.abs(np.diff(np.concatenate(o.paths[0].contours), n=3, axis=1)).max() > 1e-4
