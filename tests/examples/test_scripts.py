"""The examples and the README's Python do what they say."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).parents[2]


def run(*arguments, folder):
    """Output of a Python process in a folder."""
    command = [sys.executable, "-W", "error", *map(str, arguments)]
    outcome = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert outcome.returncode == 0, outcome.stderr
    return outcome.stdout


def dark_share(path):
    """Share of a picture that is dark, 0..1."""
    with Image.open(path) as image:
        return 1 - np.asarray(image.convert("L")).mean() / 255


def test_convert_and_render(tmp_path):
    run(ROOT / "examples" / "01_convert_and_render.py", tmp_path, folder=tmp_path)
    assert (tmp_path / "duck.ktx2").is_file()
    shares = [dark_share(tmp_path / f"duck-{size}.png") for size in (32, 128, 512)]
    assert min(shares) > 0.1
    assert max(shares) - min(shares) < 0.01


@pytest.mark.slow
def test_pygfx(tmp_path):
    pytest.importorskip("pygfx")
    if not pytest.importorskip("wgpu").gpu.request_adapter_sync():
        pytest.skip("no Vulkan driver (Debian: mesa-vulkan-drivers)")
    said = run(ROOT / "examples" / "11_pygfx.py", tmp_path, folder=tmp_path)
    assert float(re.search(r"mean error (\S+) of 255", said)[1]) < 0.1
    assert 0.7 < dark_share(tmp_path / "pygfx.png") < 0.98


def test_views(tmp_path):
    run(ROOT / "examples" / "02_views.py", tmp_path, folder=tmp_path)
    shares = {path.stem.removeprefix("cake-"): dark_share(path) for path in tmp_path.glob("*.png")}
    assert set(shares) == {"whole", "turned", "near", "floor"}
    assert shares["turned"] == pytest.approx(shares["whole"], abs=0.05)
    assert shares["floor"] > 0.02


def test_compare_with_the_truth(tmp_path):
    lines = run(ROOT / "examples" / "03_compare_with_the_truth.py", folder=tmp_path).splitlines()
    errors = [float(re.search(r"error ([\d.]+)/255", line).group(1)) for line in lines]
    assert len(errors) == 4
    assert max(errors) < 6


def test_colours_and_atlas(tmp_path):
    lines = run(ROOT / "examples" / "04_colours_and_atlas.py", tmp_path, folder=tmp_path).splitlines()
    assert [line.split(":")[0] for line in lines[:3]] == ["logo/1-#0066cc", "logo/2-#ffffff", "logo/3-#ffcc00cc"]
    with Image.open(tmp_path / "logo.png") as image:
        assert image.getpixel((30, 150)) == (0, 102, 204)
        assert image.getpixel((150, 80)) == (255, 255, 255)
        assert image.getpixel((150, 150)) == (255, 214, 51)
    assert 0.1 < dark_share(tmp_path / "duck.png") < 0.9


@pytest.mark.slow
def test_santa_cruz_flood(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    lines = run(ROOT / "examples" / "05_santa_cruz_flood.py", tmp_path, folder=tmp_path).splitlines()
    assert "synthetic" in lines[0].lower()
    with netcdf.Dataset(tmp_path / "flood.nc") as file:
        assert "synthetic" in file.comment.lower()
        depth, bed, level = (np.asarray(file[name][:]) for name in ("depth", "bed_level", "water_level"))
    assert depth.shape == (24, *bed.shape)
    wet = (depth >= 0.05).mean(axis=(1, 2))
    assert wet.argmax() == level.argmax()
    assert 0.4 < wet.min() < wet.max() - 0.02 < 0.6
    assert np.abs(depth + bed - level[:, None, None])[depth > 0].max() < 2e-3
    with Image.open(tmp_path / "ground.jpg") as image:
        assert "synthetic" in image.info["comment"].decode().lower()
        assert image.width / image.height == pytest.approx(bed.shape[1] / bed.shape[0])
    assert (tmp_path / "ground.jpg").stat().st_size < 500_000


@pytest.mark.slow
def test_zeeland_flood(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    lines = run(ROOT / "examples" / "09_zeeland_flood.py", tmp_path, "100", folder=tmp_path).splitlines()
    assert "synthetic" in lines[0].lower()
    with netcdf.Dataset(tmp_path / "flood.nc") as file:
        assert "synthetic" in file.comment.lower()
        depth, bed, sea = (np.asarray(file[name][:]) for name in ("depth", "bed_level", "water_level"))
    wet = depth >= 0.05
    assert 0.4 < wet[0].mean() < 0.6 < 0.8 < wet.mean(axis=(1, 2)).max() < 0.95
    level = np.where(wet, depth + bed, np.nan)
    assert np.nanmax(np.abs(level[0] - sea[0])) < 2e-3
    assert np.nanmax(level[-1]) > sea[-1] + 1  # behind the dikes it stays
    assert (bed[wet[-1] & ~wet[0]] < sea[0]).mean() > 0.5  # which kept the sea out of land below it
    with Image.open(tmp_path / "ground.jpg") as image:
        assert "synthetic" in image.info["comment"].decode().lower()
        assert image.width / image.height == pytest.approx(bed.shape[1] / bed.shape[0])
    assert (tmp_path / "ground.jpg").stat().st_size < 500_000


@pytest.mark.slow
def test_clinch_flood(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    pytest.importorskip("matplotlib")
    lines = run(ROOT / "examples" / "10_clinch_flood.py", tmp_path, "90", folder=tmp_path).splitlines()
    assert "synthetic flood" in lines[0].lower()
    with netcdf.Dataset(tmp_path / "flood.nc") as file:
        assert "synthetic" in file.comment.lower()
        depth, bed = (np.asarray(file[name][:]) for name in ("depth", "bed_level"))
    wet = depth >= 0.05
    share = wet.mean(axis=(1, 2))
    assert 0.02 < share[0] < share.max() - 0.02 < 0.2
    assert 4 < share.argmax() < 18
    level = bed + depth
    for here, there in ((np.s_[:, :, :-1], np.s_[:, :, 1:]), (np.s_[:, :-1], np.s_[:, 1:])):
        both = (depth[here] > 0.5) & (depth[there] > 0.5)
        assert np.abs(level[here] - level[there])[both].max() < 3  # it slopes, and does not rock
    assert np.median(np.abs(np.diff(level[12], axis=1))[(depth[12][:, 1:] > 1) & (depth[12][:, :-1] > 1)]) < 0.3
    with Image.open(tmp_path / "ground.jpg") as image:
        assert "synthetic" in image.info["comment"].decode().lower()
        assert image.width / image.height == pytest.approx(bed.shape[1] / bed.shape[0])


@pytest.mark.slow
def test_figures(tmp_path):
    pytest.importorskip("vtracer")
    lines = run(ROOT / "examples" / "06_figures.py", tmp_path, folder=tmp_path).splitlines()
    assert [line.split(":")[0] for line in lines] == ["heart-texture.png", "heart-depths.png", "heart-edges.png"]
    assert 0.3 < dark_share(tmp_path / "heart.png") < 0.8
    assert all(dark_share(tmp_path / f"heart-{name}.png") > 0.02 for name in ("texture", "depths", "edges"))


@pytest.mark.slow
def test_choropleth(tmp_path):
    lines = run(ROOT / "examples" / "07_choropleth.py", tmp_path, folder=tmp_path).splitlines()
    assert re.fullmatch(r"in the middle: county \d+", lines[0])
    pictures = [np.asarray(Image.open(tmp_path / f"{year}.png")) for year in (2000, 2010, 2020)]
    assert all((picture[0, 0] == 255).all() and 0.7 < (picture[..., 1] < 100).mean() < 0.85 for picture in pictures)
    assert np.abs(np.diff([picture[200, 200].astype(int) for picture in pictures], axis=0)).max(axis=1).min() > 20


@pytest.mark.slow
def test_four_floods(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    lines = run(ROOT / "examples" / "08_four_floods.py", tmp_path, folder=tmp_path).splitlines()
    assert "synthetic" in lines[0].lower()
    for name in ("coast", "river", "polder", "streets"):
        with netcdf.Dataset(tmp_path / f"{name}.nc") as file:
            assert "synthetic" in file.comment.lower()
            wet = (np.asarray(file["depth"][:]) >= 0.05).mean(axis=(1, 2))
        assert 0.01 < wet[0] < wet.max() - 0.1 < 0.9, name
    assert sum("under water" in line for line in lines) == 4


def test_every_example_is_tested():
    names = {path.name for path in (ROOT / "examples").glob("*.py")}
    assert names == set(re.findall(r"\d\d_\w+\.py", Path(__file__).read_text(encoding="utf-8")))


def test_python_of_the_readme(tmp_path):
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (code,) = re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.M | re.S)
    assert len(code.splitlines()) <= 8
    run("-c", code, folder=tmp_path)
    assert {path.name for path in tmp_path.glob("duck.*")} == {"duck.ktx2", "duck.png"}
    assert 0.1 < dark_share(tmp_path / "duck.png") < 0.9
