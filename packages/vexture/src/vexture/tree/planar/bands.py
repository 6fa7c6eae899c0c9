"""Bands of a gradient: the parts of its ramp between two jumps of colour, each a gradient without a jump.

A hard stop is an edge, and so is the place where a ramp repeats. A path with such a gradient is cut along these edges
when the map is built. They are stored like outlines, and are exact at every scale. Between them the ramp is smooth.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from vexture.base.kernels import kernel
from vexture.drawing.paint import Spread
from vexture.tree.growth import longer
from vexture.tree.planar.knots import Knots, differ, is_beside_ramp, jumps, knots_of, stops_of_period
from vexture.tree.planar.ramps import (
    CLOSE,
    FLAT,
    NESTED,
    TOUCHING,
    reach_of_ramp,
    scale_of_ramp,
    shape_of_ramp,
    turn_outwards,
)
from vexture.tree.planar.regions import region_of, swept_region
from vexture.tree.planar.shades import COUNT, FIRST, FOCUS, OFFSET, PICTURE, RADIUS, SPREAD

MOST_BANDS: Final = 1024
"""Most bands. More are finer than the pixels of most pictures, and a shader averages the ramp across its jumps
instead."""

STEEP: Final = 1 / 64
"""Unit-square units. A ramp that changes within a shorter length is cut at its stops, because a pixel may hold the
whole change, and only edges are exact there."""

PAD = int(Spread.PAD)

GRADIENTS, STOPS, BANDS, REGIONS, CUBICS = range(5)
"""Counts of a list of bands."""


class BandList(NamedTuple):
    """Bands of gradients, and the regions that separate them. Rows beyond the counts are free. A picture is one band.

    Band k of a gradient applies where k of its regions contain the point; each region contains the next one, or lies in
    it. Equal gradients are one.
    """

    rows: NDArray[np.float64]  # (room, 11): different gradients, as in `Shades`
    stops: NDArray[np.float64]  # (room, 5)
    slots: NDArray[np.int64]  # number of a gradient + 1 in each slot of a hash table, or 0
    hashes: NDArray[np.int64]  # (room,): of the gradients
    bands: NDArray[np.int64]  # (room,): numbers of gradients
    lengths: NDArray[np.int64]  # (room,): cubics of each region's contour
    cubics: NDArray[np.float64]  # (room, 4, 2): of all regions
    counts: NDArray[np.int64]  # (5,): `GRADIENTS` to `CUBICS`
    reach: NDArray[np.float64]  # (1,): largest coordinate of a region before it was clipped


@kernel
def new_bands(room: int) -> BandList:
    """Make an empty list; `room` must be a power of two."""
    return BandList(
        np.empty((room, 11)),
        np.empty((room, 5)),
        np.zeros(2 * room, np.int64),
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty(room, np.int64),
        np.empty((room, 4, 2)),
        np.zeros(5, np.int64),
        np.zeros(1),
    )


@kernel
def _with_room(found: BandList, stops: int, cubics: int) -> BandList:
    """Make room for another gradient with so many stops, another band and another region."""
    counts, slots, hashes = found.counts, found.slots, longer(found.hashes, found.counts[GRADIENTS] + 1)
    if 2 * counts[GRADIENTS] >= len(slots):
        slots = np.zeros(4 * len(slots), np.int64)
        for number in range(counts[GRADIENTS]):
            slot = hashes[number] & (len(slots) - 1)
            while slots[slot] != 0:
                slot = (slot + 1) & (len(slots) - 1)
            slots[slot] = number + 1
    return BandList(
        longer(found.rows, counts[GRADIENTS] + 1),
        longer(found.stops, counts[STOPS] + stops),
        slots,
        hashes,
        longer(found.bands, counts[BANDS] + 1),
        longer(found.lengths, counts[REGIONS] + 1),
        longer(found.cubics, counts[CUBICS] + cubics),
        counts,
        found.reach,
    )


@kernel(allocates=False)
def _hash_of(values: NDArray[np.float64], count: int, key: int) -> int:
    """Mix numbers into a hash; 0 and -0 are equal."""
    for k in range(count):
        part, low = values[k] * 0.7548776662466927, 0
        while abs(part) >= 9.0e15:
            part *= 2.0**-40
        low = int(np.floor(part))
        for word in (low, int((part - low) * 9.0e15)):
            key = (key ^ word) * 0x5851F42D4C957F2D
            key ^= key >> 29
    return key


@kernel(allocates=False)
def _is_equal(found: BandList, number: int, row: NDArray[np.float64], stops: NDArray[np.float64]) -> bool:
    """Whether a listed gradient equals another one."""
    known = found.rows[number]
    if known[COUNT] != len(stops):
        return False
    for c in range(FIRST):
        if known[c] != row[c]:
            return False
    if row[FOCUS] == PICTURE:
        return known[FIRST] == row[FIRST]
    first = int(known[FIRST])
    for k in range(len(stops)):
        for c in range(5):
            if found.stops[first + k, c] != stops[k, c]:
                return False
    return True


@kernel
def add_band(found: BandList, row: NDArray[np.float64], stops: NDArray[np.float64]) -> BandList:
    """Append a band; its gradient or picture is new, or one that is listed already."""
    found = _with_room(found, len(stops), 0)
    counts, slots = found.counts, found.slots
    key = _hash_of(row, FIRST, int(row[FIRST]) if row[FOCUS] == PICTURE else len(stops))
    for k in range(len(stops)):
        key = _hash_of(stops[k], 5, key)
    slot = key & (len(slots) - 1)
    while slots[slot] != 0 and not _is_equal(found, slots[slot] - 1, row, stops):
        slot = (slot + 1) & (len(slots) - 1)
    if slots[slot] == 0:
        number = counts[GRADIENTS]
        for c in range(FIRST):
            found.rows[number, c] = row[c]
        found.rows[number, FIRST] = row[FIRST] if row[FOCUS] == PICTURE else counts[STOPS]
        found.rows[number, COUNT] = len(stops)
        for k in range(len(stops)):
            for c in range(5):
                found.stops[counts[STOPS] + k, c] = stops[k, c]
        found.hashes[number], slots[slot] = key, number + 1
        counts[GRADIENTS], counts[STOPS] = number + 1, counts[STOPS] + len(stops)
    found.bands[counts[BANDS]] = slots[slot] - 1
    counts[BANDS] += 1
    return found


@kernel
def _add_region(found: BandList, contour: NDArray[np.float64]) -> BandList:
    """Append a region."""
    found = _with_room(found, 0, len(contour))
    counts = found.counts
    for k in range(len(contour)):
        for p in range(4):
            for axis in range(2):
                found.cubics[counts[CUBICS] + k, p, axis] = contour[k, p, axis]
    found.lengths[counts[REGIONS]] = len(contour)
    counts[REGIONS], counts[CUBICS] = counts[REGIONS] + 1, counts[CUBICS] + len(contour)
    return found


@kernel
def add_bands(
    found: BandList, row: NDArray[np.float64], stops: NDArray[np.float64], box: NDArray[np.float64], at_all_stops: int
) -> BandList:
    """Append the bands of a gradient in a box, and the regions that separate them.

    It is one band without regions if the ramp does not jump there, or jumps too often. If `at_all_stops` is 1, soft
    stops separate bands, too, because the blended ramp may jump there. `row` and `stops` may be written to.
    """
    if row[FOCUS] == PICTURE:
        return add_band(found, row, stops)
    shape = shape_of_ramp(row)
    if shape == FLAT or (row[FOCUS] == 0.0 and row[RADIUS] == 1.0):  # one circle for all places paints nothing
        return add_band(found, row, stops)
    if shape == NESTED:
        turn_outwards(row, stops)
    if shape >= TOUCHING:
        nothing, flat = row.copy(), np.zeros((1, 5))
        nothing[SPREAD], nothing[FOCUS], nothing[RADIUS] = PAD, -1.0, -1.0
        found = add_band(found, nothing, flat)
        found = _add_region(found, swept_region(row, box, found.reach))
    if row[FOCUS] >= 0.0 and row[RADIUS] >= 1.0:
        return add_band(found, row, stops)
    low, high = reach_of_ramp(row, shape, box)
    if row[SPREAD] != PAD and not high - low <= MOST_BANDS:
        return add_band(found, row, stops)
    ramp = stops_of_period(stops, int(row[SPREAD]))
    knots = knots_of(ramp, int(row[SPREAD]), low, high)
    parts = _parts_of(row, ramp, knots, shape, (low, high), at_all_stops)
    if len(parts) == 0:
        return add_band(found, row, stops)
    return _add_parts(found, row, ramp, knots, parts, (low, high), box, shape)


@kernel
def _parts_of(
    row: NDArray[np.float64],
    ramp: NDArray[np.float64],
    knots: Knots,
    shape: int,
    within: tuple[float, float],
    at_all_stops: int,
) -> NDArray[np.int64]:
    """First knot, the knots that separate bands, and the last knot; none if the ramp is one band."""
    low, high = within
    count = len(knots.place)
    grows = 1.0 if row[FOCUS] < 0.0 else 1.0 - row[RADIUS]
    steep = np.inf if at_all_stops == 1 else STEEP * scale_of_ramp(row)[0] / grows
    parts, n, is_cut = np.zeros(count + 2, np.int64), 1, False
    for k in range(count):
        place = knots.place[k]
        if low < place < high and (jumps(knots, ramp, k) or is_beside_ramp(knots, ramp, k, steep)):
            parts[n], is_cut = k, True
            n += 1
        if row[SPREAD] == PAD and 0.0 <= max(low - place, place - high) < CLOSE and jumps(knots, ramp, k):
            is_cut = True
    parts[n] = count - 1
    return parts[: n + 1 if is_cut and n <= MOST_BANDS else 0]


@kernel
def _add_parts(
    found: BandList,
    row: NDArray[np.float64],
    ramp: NDArray[np.float64],
    knots: Knots,
    parts: NDArray[np.int64],
    within: tuple[float, float],
    box: NDArray[np.float64],
    shape: int,
) -> BandList:
    """Append the bands between the knots that separate them; of circles, each region lies in the one before it."""
    count, is_linear = len(parts) - 1, row[FOCUS] < 0.0
    low, high = within
    for n in range(count):
        k = n if is_linear else count - 1 - n
        a, b = parts[k], parts[k + 1]
        is_begun = k > 0 or knots.place[a] <= low
        is_ended = k < count - 1 or knots.place[b] >= high
        found = _add_part(found, row, ramp, knots, (a, b), is_begun, is_ended)
        if n == count - 1:
            break
        contour = region_of(row, shape, knots.place[b if is_linear else a], box, found.reach)
        if not is_linear and len(contour) == 0:
            break
        found = _add_region(found, contour)
    return found


@kernel
def _add_part(
    found: BandList,
    row: NDArray[np.float64],
    ramp: NDArray[np.float64],
    knots: Knots,
    ends: tuple[int, int],
    is_begun: bool,
    is_ended: bool,
) -> BandList:
    """Append the gradient of the part of a ramp between two knots, padded, with places from 0 to 1.

    If `is_begun`, only the later side of the first knot belongs to the part; if `is_ended`, only the earlier side of
    the last knot does.
    """
    part = row.copy()
    part[SPREAD] = PAD
    places, stops = _placed_stops(ramp, knots, ends, is_begun, is_ended)
    count, is_flat = len(places), True
    for k in range(1, count):
        is_flat = is_flat and not differ(stops, 0, k)
    if is_flat:
        stops[0, OFFSET] = 0.0
        return add_band(found, part, stops[:1])
    count = _drop_repeated(places, stops)
    if row[SPREAD] == PAD and shape_of_ramp(row) == TOUCHING:  # float32 would part circles that touch
        return add_band(found, part, stops[:count])
    first = 0
    if row[FOCUS] >= 0.0:
        first = _cut_start(places, stops, count, -row[RADIUS] / (1.0 - row[RADIUS]))
    start, end = places[first], places[count - 1]
    _stretch(part, start, end)
    for k in range(first, count):
        stops[k, OFFSET] = min(max((places[k] - start) / (end - start), 0.0), 1.0)
    return add_band(found, part, stops[first:count])


@kernel
def _placed_stops(
    ramp: NDArray[np.float64], knots: Knots, ends: tuple[int, int], is_begun: bool, is_ended: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Stops of a part of a ramp, and the places of these stops."""
    first, last = 2 * ends[0] + (1 if is_begun else 0), 2 * ends[1] + (1 if is_ended else 2)
    places, stops = np.empty(last - first), np.empty((last - first, 5))
    for at in range(first, last):
        knot = at >> 1
        stop = knots.before[knot] if at & 1 == 0 else knots.after[knot]
        places[at - first] = knots.place[knot]
        for c in range(5):
            stops[at - first, c] = ramp[stop, c]
    return places, stops


@kernel(allocates=False)
def _drop_repeated(places: NDArray[np.float64], stops: NDArray[np.float64]) -> int:
    """Leave out stops that equal the one before at the same place; return the number of the others."""
    count = 1
    for k in range(1, len(places)):
        is_same = places[k] == places[count - 1]
        for c in range(5):
            is_same = is_same and stops[k, c] == stops[count - 1, c]
        if not is_same:
            places[count] = places[k]
            for c in range(5):
                stops[count, c] = stops[k, c]
            count += 1
    return count


@kernel(allocates=False)
def _cut_start(places: NDArray[np.float64], stops: NDArray[np.float64], count: int, start: float) -> int:
    """Begin a ramp at a place, at which the radius of the circle is 0; return the first of the stops that are left."""
    first = 0
    while first < count - 1 and places[first] <= start:
        first += 1
    if first == 0:
        return 0
    low = first - 1
    share = (start - places[low]) / (places[first] - places[low])
    for c in range(4):
        stops[low, c] = (1.0 - share) * stops[low, c] + share * stops[first, c]
    places[low] = start
    return low


@kernel(allocates=False)
def _stretch(row: NDArray[np.float64], start: float, end: float) -> None:
    """Let a gradient span the part of its ramp from `start` to `end`."""
    size = end - start
    if row[FOCUS] < 0.0:
        row[0], row[1], row[2] = row[0] / size, row[1] / size, (row[2] - start) / size
        return
    focus, radius = row[FOCUS], row[RADIUS]
    inner, outer = radius + (1.0 - radius) * start, radius + (1.0 - radius) * end
    move = focus * (1.0 - end)  # middle of the outer circle
    row[0], row[1], row[2] = row[0] / outer, row[1] / outer, (row[2] - move) / outer
    row[3], row[4], row[5] = row[3] / outer, row[4] / outer, row[5] / outer
    row[FOCUS], row[RADIUS] = focus * size / outer, max(inner / outer, 0.0)
