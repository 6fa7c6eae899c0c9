"""Large trees grow in parts, in several threads: the same tree with any number of them."""

import re
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace
from hashlib import sha256
from multiprocessing import get_context

import numpy as np
import pytest

from vexture.base import deadline
from vexture.base.deadline import within
from vexture.base.errors import LimitError
from vexture.drawing.contours import ring_contours
from vexture.drawing.drawing import Drawing, FillRule, Path
from vexture.tree import bounds, parts
from vexture.tree.bounds import DEFAULT_DEPTH, bounds_of
from vexture.tree.build import SLICE, build_tree, grow_on, new_growth
from vexture.tree.cubics import gather
from vexture.tree.growth import WAITING, Growth, growth_from, tree_of
from vexture.tree.tree import MOST_QUADS

TOLERANCE = 1e-4


def rough(random, size, middle, scale):
    angle = np.sort(random.random(size)) * 2 * np.pi
    far = scale * (1.0 + 0.3 * np.cumsum(random.normal(size=size)) / size**0.5)
    return np.clip(middle + far[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1), 0.0, 1.0)


@pytest.fixture(scope="module")
def coast():
    """One path of a long ring that meets the sides, many short ones, and one of curves that turn."""
    random = np.random.default_rng(20)
    rings = [rough(random, parts.LARGE, (0.5, 0.45), 0.4)]
    rings += [rough(random, size, random.random(2), 0.03) for size in random.integers(3, 90, 300)]
    corners = np.concatenate(rings)
    curved = ring_contours(rough(random, 700, (0.3, 0.6), 0.2), np.array([700]))[0].copy()
    curved[:, 1:3] += 0.002 * random.normal(size=(700, 2, 2))
    contours = (*ring_contours(corners, np.cumsum([len(ring) for ring in rings])), curved)
    return Drawing((Path(contours, FillRule.EVENODD),), name="coast")


def digests(tree):
    values = ((field.name, getattr(tree, field.name)) for field in fields(tree))
    return {name: sha256(np.ascontiguousarray(value).tobytes()).hexdigest()[:8] for name, value in values}


@pytest.fixture(scope="module")
def whole(coast):
    """Digests of the tree that has grown in one piece, without runs."""
    cubics, owner, rules = gather(coast)
    tree = Growth(*new_growth(cubics, owner, DEFAULT_DEPTH, False)[0])
    while tree.counts[WAITING] > 0:
        tree = growth_from(grow_on(tree, rules, bounds_of(TOLERANCE, DEFAULT_DEPTH, 8, None, MOST_QUADS), SLICE, 0))
    return digests(tree_of(tree))


@pytest.mark.slow
@pytest.mark.parametrize("threads", [1, 2, 5])
def test_a_tree_of_parts_is_that_of_one_piece(coast, whole, threads, monkeypatch):
    grown = []
    monkeypatch.setattr(parts, "_grown", lambda *given, grow=parts._grown: grown.append(1) or grow(*given))
    assert digests(build_tree(coast, tolerance=TOLERANCE, threads=threads)) == whole
    assert len(grown) > 10


def test_small_drawings_start_no_thread(coast, monkeypatch):
    monkeypatch.setattr(parts.ThreadPoolExecutor, "__init__", None)
    with pytest.raises(TypeError):
        build_tree(coast, tolerance=TOLERANCE)
    (path,) = coast.paths
    small = Drawing((replace(path, contours=path.contours[1:]),))
    assert len(build_tree(small, tolerance=TOLERANCE).curves) > 0


def test_a_process_that_shares_work_has_one_thread():
    context = get_context("spawn")
    with context.Pool(1) as pool:
        assert pool.apply(parts.usual_threads) == 1
    assert parts.usual_threads() >= 1


@pytest.mark.slow
def test_limits_hold_in_parts_and_end_their_threads(coast):
    before, quads = threading.active_count(), len(build_tree(coast, tolerance=TOLERANCE).count)
    limit, found = quads // 2, set()
    for threads in (1, 2, 4):
        with pytest.raises(LimitError, match=f"; the limit is {limit}; use a smaller `max_depth`") as error:
            build_tree(coast, tolerance=TOLERANCE, most_quads=limit, threads=threads)
        found.add(str(error.value))
    (told,) = found
    assert limit < int(re.fullmatch(r"coast: (\d+) quads at least; .*", told)[1]) < 0.9 * quads  # it ends at once
    with within(0.05), pytest.raises(LimitError, match=r"^coast: converting takes longer than 0\.05 s"):
        build_tree(coast, threads=2)
    assert threading.active_count() == before


def test_threads_know_when_a_conversion_must_end(coast, monkeypatch):
    known = []
    monkeypatch.setattr(bounds, "check_time", lambda name: known.append(deadline._LIMIT.get() is not None))
    with within(1000.0):
        build_tree(coast, tolerance=TOLERANCE, threads=2)
    assert len(known) > 10
    assert all(known)


@pytest.mark.slow
def test_other_threads_run_while_a_tree_grows(coast):
    """Or parts would wait for one another."""
    cubics, owner, rules = gather(coast)
    tree, _ = new_growth(cubics, owner, DEFAULT_DEPTH, True)
    limits = bounds_of(TOLERANCE, DEFAULT_DEPTH, 8, None, MOST_QUADS)
    grow_on(Growth(*tree), rules, limits, 0, 0)  # compiled now, if it was not
    with ThreadPoolExecutor(1) as executor:
        growing, looks = executor.submit(grow_on, Growth(*tree), rules, limits, 10**9, 0), 0
        while not growing.done():
            time.sleep(0.001)
            looks += 1
    assert looks > 20  # a thread that keeps the interpreter allows one or two
