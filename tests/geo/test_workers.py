"""Work that is shared: the same results in the same order, whoever does it, and whoever dies over it."""

import hashlib
import os
from contextlib import ExitStack

import netCDF4
import numpy as np
import pytest
from floods import flood, series

from clusters import cluster_of, scheduler_alone, workers_of
from shared_work import fail_late, forget_once, kill_worker, slow_power
from vexture import DeviceError
from vexture.base import workers
from vexture.base.workers import Cluster, InProcess, Processes
from vexture_geo.flood.options import FloodOptions
from vexture_geo.flood.server import make_flood


def test_results_are_in_order_from_several_processes():
    found = list(Processes(2).map(slow_power, (os.getpid(), 3), iter(range(12)), 12))
    assert [value for _, value in found] == [3**k for k in range(12)]
    workers = {number for number, _ in found}
    assert os.getpid() in workers
    assert 1 < len(workers) <= 3


def test_short_work_is_done_here():
    found = list(Processes(2).map(slow_power, (0, 3), range(12), 12))
    assert found == [(os.getpid(), 3**k) for k in range(12)]


def test_few_items_are_taken_before_their_results():
    taken = []
    items = (taken.append(k) or k for k in range(1000))
    found = Processes(2).map(slow_power, (os.getpid(), 1), items, 1000)
    for _ in range(10):
        next(found)
    assert len(taken) < 20
    found.close()


def test_what_a_process_had_in_hand_when_it_died_is_done_again(tmp_path):
    assert list(Processes(2).map(kill_worker, (tmp_path / "died", False), range(12), 12)) == [k * k for k in range(12)]
    assert (tmp_path / "died").exists()


def test_work_that_kills_every_process_ends(tmp_path):
    with pytest.raises(DeviceError, match="3 processes died at the same work"):
        list(Processes(2).map(kill_worker, (tmp_path / "died", True), range(12), 12))


@pytest.mark.slow
def test_steps_of_a_flood_are_the_same_from_several_processes(tmp_path, monkeypatch):
    """Also those of many curves, which processes hand over in another way, and several of them in a class of depth."""
    monkeypatch.setattr(workers, "WORTH", 0.0)
    run = series(tmp_path / "run.nc", [0.2, 0.4])
    with netCDF4.Dataset(run, "a") as file:
        rows, columns = file["depth"].shape[1:]
        x, y = np.meshgrid(np.arange(columns), np.arange(rows))
        ponds = np.sin(x * np.pi / 10) * np.sin(y * np.pi / 10)  # of a radius of five cells
        file["depth"][:] = [np.maximum(ponds + level, 0.0) for level in (0.0, 0.2)]
    here, there = (make_flood(FloodOptions(run, variable="depth", workers=count), print).shapes for count in (1, 2))
    assert [list(shape.views) for shape in here] == 2 * [["depth", "classes", "level"]]
    assert [shape.version for shape in here] == [shape.version for shape in there]


def test_errors_of_the_work_arrive():
    with pytest.raises(ZeroDivisionError):
        list(Processes(2).map(divmod, 3, iter([1, 0]), 2))


@pytest.fixture(scope="module")
def cluster():
    """Address of a scheduler with two workers."""
    with cluster_of(2) as (address, _):
        yield address


@pytest.mark.slow
def test_a_cluster_makes_the_same_page(cluster, tmp_path):
    run = series(tmp_path / "run.nc", [0.2, 0.4, 0.6])
    pages = {}
    for name, more in {"here": ("--workers", "1"), "there": ("--scheduler", cluster)}.items():
        outcome = flood("--extent", run, "--variable", "depth", *more, "-o", tmp_path / f"{name}.html")
        assert outcome.returncode == 0, outcome.stderr
        pages[name] = (tmp_path / f"{name}.html").read_bytes()
    assert hashlib.sha256(pages["here"]).digest() == hashlib.sha256(pages["there"]).digest()


def test_what_a_scheduler_forgot_is_done_again(cluster, tmp_path):
    """As it does when a worker dies while its result is fetched."""
    assert list(Cluster(cluster).map(forget_once, tmp_path / "once", range(6), 6)) == [k * k for k in range(6)]
    assert (tmp_path / "once").exists()


def test_an_error_of_the_work_is_not_one_of_the_scheduler(cluster):
    with pytest.raises(FileNotFoundError, match="lost"):
        list(Cluster(cluster).map(fail_late, 2, range(4), 4))


def test_what_a_worker_of_a_cluster_had_in_hand_when_it_died_is_done_again(cluster, tmp_path):
    """The last test with these workers: one of them dies."""
    assert list(Cluster(cluster).map(kill_worker, (tmp_path / "died", False), range(12), 12)) == [
        k * k for k in range(12)
    ]
    assert (tmp_path / "died").exists()


@pytest.mark.slow
@pytest.mark.parametrize(("dead", "state"), [("scheduler", "no longer answers"), ("workers", "has no workers left")])
def test_a_cluster_that_dies_at_work_is_named_and_dask_is_silent(dead, state, monkeypatch, capfd):
    monkeypatch.setattr(workers, "PATIENCE", "1s")
    with ExitStack() as opened:
        scheduler, address = opened.enter_context(scheduler_alone())
        found = opened.enter_context(workers_of(address, 1))
        results = Cluster(address).map(fail_late, None, range(12), 12)
        assert [next(results), next(results)] == [0, 1]
        for process in [scheduler] if dead == "scheduler" else found:
            process.kill()
        with pytest.raises(DeviceError) as error:
            list(results)
    remedy = "start it again, with workers, then type the command again"
    assert str(error.value) == f"`scheduler` {address}: it {state}; {remedy}"
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", pytest.param("nonsense", marks=pytest.mark.slow)])
def test_a_scheduler_that_is_not_there_is_named(tmp_path, address, monkeypatch):
    monkeypatch.setattr(workers, "PATIENCE", "1s")
    run = series(tmp_path / "run.nc", [0.2])
    outcome = flood("--extent", run, "--variable", "depth", "--scheduler", address, "-o", tmp_path / "page.html")
    assert outcome.returncode == 1
    assert f"--scheduler {address}: no Dask scheduler answers there" in outcome.stderr
    assert len(outcome.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "page.html").exists()


def test_who_does_the_work_is_as_asked(tmp_path):
    path = tmp_path / "run.nc"
    assert isinstance(FloodOptions(path).executor(), InProcess)
    assert isinstance(FloodOptions(path, workers=2).executor(), Processes)
    assert isinstance(FloodOptions(path, scheduler="tcp://x:1").executor(), Cluster)
