"""Contours as parts of one array: joined without a copy where they follow one another, and checked in blocks."""

from multiprocessing.reduction import ForkingPickler

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from vexture.base.errors import SourceError
from vexture.bezier.convert import line_cubics
from vexture.drawing import contours
from vexture.drawing.contours import check_contours, join_contours, ring_contours


@given(st.lists(st.integers(1, 5), min_size=1, max_size=8), st.integers(0, 3), st.randoms())
def test_joined_holds_all_cubics_in_order(lengths, before, random):
    whole = np.arange(8.0 * (sum(lengths) + before + 2)).reshape(-1, 4, 2)
    ends = before + np.cumsum(lengths)
    parts = [whole[end - length : end] for end, length in zip(ends, lengths, strict=True)]
    assert np.shares_memory(join_contours(parts), whole)
    assert (join_contours(parts) == np.concatenate(parts)).all()
    random.shuffle(parts)
    assert (join_contours(parts) == np.concatenate(parts)).all()
    strange = [part[::-1] for part in parts]
    assert (join_contours(strange) == np.concatenate(strange)).all()


@pytest.mark.parametrize("flags", ["strided", "read-only", "other type", "turned", "of another process"])
def test_joined_is_what_kernels_read(flags):
    whole = np.arange(48.0).reshape(-1, 4, 2)
    long = np.resize(whole, (20, 4, 2))  # numpy keeps the bytes of arrays over 1,000 bytes as their base
    parts = {
        "strided": [whole[::2]],
        "read-only": [whole[:1], whole[1:3]],
        "other type": [whole.view(np.int64)[:1], whole.view(np.int64)[1:]],
        "turned": [whole.transpose(0, 2, 1).reshape(-1, 4, 2, order="F")[:2]],
        "of another process": ForkingPickler.loads(ForkingPickler.dumps([long, long[:1]])),
    }[flags]
    if flags == "read-only":
        whole.flags.writeable = False
    found = join_contours(parts)
    assert found.flags.c_contiguous
    assert found.flags.writeable
    assert (found == np.concatenate(parts)).all()


def test_rings_become_contours_that_close():
    random = np.random.default_rng(4)
    points, ends = random.random((12, 2)), np.array([3, 7, 12])
    for contour, ring in zip(ring_contours(points, ends), np.split(points, ends[:-1]), strict=True):
        assert (contour == line_cubics(ring, np.roll(ring, -1, axis=0))).all()
    check_contours(ring_contours(points, ends))
    assert ring_contours(points[:0], ends[:0]) == ()


@pytest.mark.parametrize(("place", "value", "message"), [(0, np.nan, "not finite"), (3, 0.5, "is open")])
@pytest.mark.parametrize("which", [0, 6, 13])
def test_a_fault_is_found_in_each_block(place, value, message, which, monkeypatch):
    monkeypatch.setattr(contours, "BLOCK", 8)
    parts = [contour.copy() for contour in ring_contours(np.random.default_rng(5).random((42, 2)), np.arange(3, 43, 3))]
    check_contours(parts)
    parts[which][1, place] = value
    with pytest.raises(SourceError, match=message):
        check_contours(parts)
