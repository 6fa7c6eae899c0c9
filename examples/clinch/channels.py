"""Channels that heights lead to: where water flows, and how deep its bed is."""

import heapq
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scenery.grid import Array

Cells = NDArray[np.int64]

LEAST = 2.5  # square kilometres from which water flows in a channel
FALL = 2e-4  # least slope of a channel
CALM = 3  # points to either side over which a channel and its slope are smoothed
SIDE = 0.25  # slope of a channel's banks, which get steeper by as much in each
STEEPER = 80.0  # metres
BESIDE = 160.0  # metres from a bank in which the ground may be cut
NARROWEST = 0.9  # half the width of a channel, in cells


class Flow(NamedTuple):
    """Ways of the water over a grid, whose cells are numbered row by row."""

    onward: Cells  # the next cell on the way out, -1 where that ends
    order: Cells  # all cells, each after the one that it flows to


class Channel(NamedTuple):
    """A channel from its spring to where it ends or joins another; the first row of places is the spring."""

    cells: Cells
    places: Array  # row and column, smoothed
    area: Array  # square kilometres from which water comes to each


def flow(height: Array, outlets: NDArray[np.bool_]) -> Flow:
    """Ways out over a surface. Pits drain over their lowest sills.

    Priority-Flood of Barnes, Lehman and Mulla (Computers & Geosciences 62, 2014).
    """
    rows, columns = height.shape
    level, onward = height.ravel().tolist(), np.full(height.size, -1)
    heap = [(level[cell], cell) for cell in np.flatnonzero(outlets).tolist()]
    heapq.heapify(heap)
    seen, order = outlets.ravel().tolist(), []
    while heap:
        here, cell = heapq.heappop(heap)
        order.append(cell)
        row, column = divmod(cell, columns)
        for r in range(max(row - 1, 0), min(row + 2, rows)):
            for c in range(max(column - 1, 0), min(column + 2, columns)):
                other = r * columns + c
                if not seen[other]:
                    seen[other] = True
                    onward[other] = cell
                    heapq.heappush(heap, (max(here, level[other]), other))
    return Flow(onward, np.array(order))


def accumulated(own: Array, ways: Flow) -> Array:
    """Sums of what is each cell's own, along the ways out."""
    total, onward = own.ravel().tolist(), ways.onward.tolist()
    for cell in reversed(ways.order.tolist()):
        if onward[cell] >= 0:
            total[onward[cell]] += total[cell]
    return np.array(total).reshape(own.shape)


def lateral(own: Array, area: Array, ways: Flow) -> Array:
    """What comes to each cell of a channel, but down the channel: sums of what is each cell's own."""
    is_channel = area.ravel() >= LEAST
    beside = Flow(np.where(is_channel, -1, ways.onward), ways.order)
    return np.where(is_channel.reshape(own.shape), accumulated(own, beside), 0.0)


def channels(area: Array, ways: Flow) -> list[Channel]:
    """All channels, the largest first; each ends in a cell of the one that it joins."""
    found, taken = [], np.zeros(area.size, bool)
    flat = area.ravel()
    is_spring = flat >= LEAST
    is_spring[ways.onward[is_spring & (ways.onward >= 0)]] = False
    down = [_way_from(spring, ways.onward) for spring in np.flatnonzero(is_spring)]
    for way in sorted(down, key=lambda cells: (-float(flat[cells[0]]), -len(cells))):
        ends = np.flatnonzero(taken[way])
        cells = way[: ends[0] + 1] if len(ends) else way
        taken[cells] = True
        if len(cells) > 2:
            places = np.stack(np.unravel_index(cells, area.shape), axis=1).astype(np.float64)
            found.append(Channel(cells, np.stack([calmed(line) for line in places.T], axis=1), flat[cells]))
    return found


def _way_from(cell: int, onward: Cells) -> Cells:
    way = [cell]
    while onward[way[-1]] >= 0:
        way.append(int(onward[way[-1]]))
    return np.array(way)


def calmed(values: Array) -> Array:
    """Means of some neighbours, fewer near the ends, which stay."""
    sums = np.concatenate([[0.0], np.cumsum(values)])
    at = np.arange(len(values))
    reach = np.minimum(CALM, np.minimum(at, len(values) - 1 - at))
    return np.asarray((sums[at + reach + 1] - sums[at - reach]) / (2 * reach + 1))


def carved(height: Array, found: list[Channel], cell: float) -> tuple[Array, Array]:
    """The surface with channels in it; and the metres of each place from the bank of the nearest one, `BESIDE` at most.

    A channel of A square kilometres is 0.4 A^0.25 m deep and 5.8 A^0.32 m wide, but never narrower than its cells.
    """
    rows, columns = height.shape
    bed, bank = height.copy(), np.full(height.shape, BESIDE)
    banks = height.ravel().copy()
    for channel in found:
        along = banks[channel.cells]
        for at in range(1, len(along)):
            along[at] = min(along[at], along[at - 1] - FALL * cell)
        banks[channel.cells] = along
        bottoms = calmed(along) - 0.4 * channel.area**0.25
        halves = np.maximum(2.9 * channel.area**0.32, NARROWEST * cell)
        reach = int(np.ceil((halves.max() + BESIDE) / cell)) + 1
        for (row, column), bottom, half in zip(_denser(channel.places), _denser(bottoms), _denser(halves), strict=True):
            r0, c0 = max(round(row) - reach, 0), max(round(column) - reach, 0)
            window = np.s_[r0 : min(round(row) + reach + 1, rows), c0 : min(round(column) + reach + 1, columns)]
            r, c = np.ogrid[window]
            away = np.hypot(r - row, c - column) * cell - half
            beyond = np.maximum(away, 0)
            bed[window] = np.minimum(bed[window], bottom + SIDE * beyond * (1 + beyond / STEEPER))
            bank[window] = np.minimum(bank[window], away)
    return bed, bank


def _denser(values: Array) -> Array:
    """With the middles between neighbours."""
    out = np.repeat(values, 2, axis=0)[:-1]
    out[1::2] = (values[1:] + values[:-1]) / 2
    return out
