"""A run that is followed: what a model writes is on the page a moment later, and is there again if it is kept."""

import resource
from contextlib import closing

import pytest
from floods import depths, flood, flooding, geotiff, scene_of, sea, series
from runs import following, writing
from server import Stream

from vexture.server.folder import STATE
from vexture.server.names import manifest_name

pytestmark = pytest.mark.usefixtures("page_is_built")

HOURS = "14 Feb 2026 {:02}:00 UTC"


@pytest.fixture(scope="module")
def followed(tmp_path_factory):
    """A server that was started before the file, the model that writes it, and the server's events."""
    path = tmp_path_factory.mktemp("run") / "run_map.nc"
    with following(path) as server, writing(path) as writer:
        line = server.process.stderr.readline()
        assert (line.count("run_map.nc: waiting for its first step"), line.count("there is no such file")) == (1, 1)
        writer.does("open 6", "step 0.3")
        assert "shows 1 step" in server.shows()
        yield server, writer


def told(stream, count):
    """Kind and name of the next events."""
    return [(kind, data["name"]) for kind, data in (stream.next() for _ in range(count))]


@pytest.mark.slow
@pytest.mark.long
def test_steps_come_while_the_model_has_the_file_open_and_a_new_run_starts_over(followed):
    server, writer = followed
    with closing(Stream(server)) as stream:
        assert set(stream.next()[1]["versions"]) == {"flood/000"}
        first = server.manifest("flood/000")
        writer.does("step 0.4")
        assert told(stream, 1) == [("shape", "flood/001")]
        writer.does("step 0.5", "step 0.6")
        assert told(stream, 2) == [("shape", "flood/002"), ("shape", "flood/003")]
        assert server.labels() == [HOURS.format(hour) for hour in (6, 7, 8, 9)]
        assert server.manifest("flood/000") == first
        areas = [server.manifest(name)["facts"]["area"] for name in server.steps]
        assert areas == sorted(areas)
        assert areas[3] == pytest.approx(2.0 * areas[0], rel=0.1)
        assert scene_of(server.ask("GET", "/")[2])["flood"]["steps"] == server.steps

        writer.does("time")  # half of a step: it comes once it has depths
        writer.does("depth 0.7")
        assert told(stream, 1) == [("shape", "flood/004")]
        writer.does("depth 0.3")  # the last step is written again
        assert told(stream, 1) == [("shape", "flood/004")]
        assert server.manifest("flood/004")["facts"]["area"] == pytest.approx(areas[0], rel=0.1)

        writer.does("close", "open 12", "step 0.3", "step 0.4")
        assert told(stream, 1) == [("shape", "flood/000")]
        assert sorted(told(stream, 4)) == [
            ("gone", "flood/002"),
            ("gone", "flood/003"),
            ("gone", "flood/004"),
            ("shape", "flood/001"),
        ]
        assert server.labels() == [HOURS.format(hour) for hour in (12, 13)]


@pytest.mark.slow
def test_a_file_that_is_replaced_as_a_whole(tmp_path):
    path, newer = tmp_path / "run.nc", tmp_path / "newer.nc"
    series(path, [0.3, 0.4])
    with following(path) as server:
        assert "shows 2 steps" in server.shows()
        with closing(Stream(server)) as stream:
            assert len(stream.next()[1]["versions"]) == 2
            before = server.manifest("flood/000")["version"]
            series(newer, [0.3, 0.4, 0.5]).replace(path)
            assert told(stream, 1) == [("shape", "flood/002")]
            assert server.manifest("flood/000")["version"] == before
            series(newer, [0.3, 0.6, 0.5]).replace(path)
            assert told(stream, 1) == [("shape", "flood/001")]
            path.unlink()
            series(path, [0.7])
            assert sorted(told(stream, 3)) == [("gone", "flood/001"), ("gone", "flood/002"), ("shape", "flood/000")]
        code, _, errors = server.stop()
    assert code == 0
    assert errors.count("the run has started over") == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--follow", "a.nc", "--extent", "b.nc", "--serve"], "give either --extent FILE or --follow FILE"),
        (["--serve"], "give either --extent FILE or --follow FILE"),
        (["--follow", "a.nc", "-o", "a.html"], "--follow a.nc: one page shows one state of a run"),
        (["--extent", "sea.geojson", "--keep", "water", "-o", "a.html"], "--keep water: one page"),
        (["--extent", "sea.geojson", "--keep", "water", "--serve"], "give --token-file or --follow"),
        (["--follow", "sea.geojson", "--serve", "--port", "0"], "sea.geojson: holds GeoJSON, and only NetCDF"),
        (["--follow", "now.tif", "--serve", "--port", "0"], "now.tif: holds depths, and only NetCDF"),
    ],
)
def test_what_cannot_be_followed_is_one_line(tmp_path, monkeypatch, options, said):
    monkeypatch.chdir(tmp_path)
    sea(tmp_path / "sea.geojson")
    geotiff(tmp_path / "now.tif", depths())
    outcome = flood(*options)
    assert (outcome.returncode, len(outcome.stderr.splitlines())) == (1, 1), outcome.stderr
    assert said in outcome.stderr


@pytest.mark.slow
def test_what_was_pushed_and_followed_survives_a_kill(tmp_path):
    path, keep = series(tmp_path / "run.nc", [0.3, 0.4]), tmp_path / "water"
    (tmp_path / "token").write_text("a-token-of-more-than-16\n")
    with following(path, "--keep", keep, token=True) as server:
        server.shows()
        with closing(Stream(server)) as stream:
            assert len(stream.next()[1]["versions"]) == 2
            series(path, [0.3, 0.4, 0.5])
            while stream.next()[1]["name"] != "flood/002":
                pass
        for name in ("flood/observed", "flood/spoilt"):
            assert server.put(name, sea(tmp_path / "sea.geojson", 0.7).read_bytes())[0] == 201
        before = {name: server.manifest(name) for name in server.steps}
        limits = resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (100, resource.RLIM_INFINITY))
        status, refused = server.put("flood/observed", sea(tmp_path / "sea.geojson", 0.3).read_bytes())
        resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, limits)
        assert (status, refused["error"]) == (
            507,
            "flood/observed: cannot be kept (File too large); make room on the disk",
        )
        assert {name: server.manifest(name) for name in server.steps} == before
        server.process.kill()
        server.process.wait()
    assert len(before) == 5
    del before["flood/spoilt"]
    (keep / STATE / "shapes" / manifest_name("flood/spoilt")).write_text("{")
    with following(path, "--keep", keep, token=True) as server:
        server.shows()
        assert {name: server.manifest(name) for name in server.steps} == before  # with the time that it took, once
        code, _, errors = server.stop()
    assert (code, errors.count("4 steps from before"), errors.count("damaged")) == (0, 1, 1)

    other = ["--bounds", "500000,4000000,503000,4002000"]
    outcome = flood("--follow", path, "--serve", "--port", "0", "--keep", keep, *other)
    assert outcome.returncode == 1
    assert "its box is 500000,4000000,504000,4002000, here it is 500000,4000000,503000,4002000" in outcome.stderr
    assert outcome.stderr.endswith("; choose another folder\n")


@pytest.mark.slow
def test_pushed_water_comes_before_the_extent_after_a_start(tmp_path):
    extent, keep = sea(tmp_path / "sea.geojson", 0.5), tmp_path / "water"
    options = ["--extent", extent, "--bounds", "500000,4000000,504000,4002000", "--keep", keep]
    with flooding(tmp_path, *options) as server:
        assert server.put("flood", sea(tmp_path / "newer.geojson", 0.7).read_bytes())[0] == 200
        pushed = server.manifest("flood")
        server.process.kill()
        server.process.wait()
    with flooding(tmp_path, *options) as server:
        assert server.manifest("flood") == pushed
