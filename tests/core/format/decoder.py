"""A decoder of vexture textures, parts A and B, written from FORMAT.md alone."""

import json
import struct
import zlib
from collections import namedtuple
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np
import png

TIMES = np.linspace(0, 1, 65)  # curves are drawn as 64 lines
BERNSTEIN = np.stack([n * (1 - TIMES) ** (3 - i) * TIMES**i for i, n in enumerate((1, 3, 3, 1))], axis=1)
HATS = np.maximum(0, 1 - abs(2 * TIMES[:, None] - [0, 1, 2]))  # the same for corners
# Either encoding: arrays [quad, cell k] that say which quad the cell is, or -1; the coverage of a leaf without curves;
# the leaf's first curve; how many it has; the winding number at its bottom left (A: modulo 2). Then for each curve the
# points [time, axis] in sides of the leaf, and whether P0 and P3 lie on the leaf's left edge.
Texture = namedtuple("Texture", "child coverage first count corner lines on_left even_odd roots")


def need(condition: object, fault: str) -> None:
    """Refuse the file if the condition does not hold."""
    if not condition:
        raise ValueError(f"not a valid texture: {fault}")


@contextmanager
def refusing() -> Iterator[None]:
    """Report whatever a broken file leads to as a ValueError."""
    try:
        yield
    except Exception as error:
        raise ValueError(f"not a valid texture: {error!r}") from error


def read_png(data: bytes, width: int) -> tuple[np.ndarray, int, dict[bytes, str]]:
    """Return the channels, their largest value and the texts of one image of a pair (A.1)."""
    chunks = list(png.Reader(bytes=data).chunks())
    columns, height, bits, *kind = struct.unpack(">2I5B", chunks[0][1])
    need(columns == width and kind == [2, 0, 0, 0] and height <= {8: 256, 16: 65000}[bits], "kind of PNG")
    texts: dict[bytes, str] = {}
    for name, body in chunks[: [name for name, _ in chunks].index(b"IDAT")]:
        keyword, _, text = body.partition(b"\0")
        if keyword.startswith(b"vexture.") and (name == b"tEXt" or (name == b"iTXt" and text[0] == 0)):
            texts[keyword] = text.decode("latin-1") if name == b"tEXt" else text[2:].split(b"\0", 2)[2].decode()
    return np.array([list(row) for row in png.Reader(bytes=data).read()[2]]).reshape(-1, width, 3), 2**bits - 1, texts


@refusing()
def read_thesis(quads: bytes, curves: bytes) -> Texture:
    """Read a pair of PNG files (A)."""
    (cells, largest, texts), (rows, *same) = read_png(quads, 4), read_png(curves, 2)
    need([largest, texts] == same and len(rows) >= 2, "files of different textures, or no rows")
    need((texts[b"vexture.version"], texts[b"vexture.encoding"]) == ("1", "thesis"), "version or encoding")
    transform = [float(number) for number in texts[b"vexture.transform"].split(" ")]
    need(len(transform) == 6 and np.isfinite(transform).all(), "transform")
    kind, index, coverage = np.moveaxis(cells[:, [2, 3, 0, 1]], -1, 0)  # by k
    is_quad, bent = 4 * kind > 3 * largest, (4 * kind > largest) & (4 * kind <= 3 * largest)
    index = (2 * index * (np.where(is_quad, len(cells), len(rows)) - 1) + largest) // (2 * largest)
    is_leaf = ~is_quad & (index > 1)
    need((coverage == coverage[:, :1]).all() and not (bent & ~is_leaf).any(), "cells")
    met = [index[is_quad].tolist(), index[is_leaf].tolist()]
    need(met == [[*range(1, len(cells))], [*range(2, len(rows))]], "order of the rows")
    need((index > np.arange(len(cells))[:, None])[is_quad].all(), "order of the rows")
    steps = rows[:, :, 0] % largest
    need((steps[2:, 0] != steps[2:, 1]).all(), "a curve that ends where it starts")
    side, f = 4 * steps // largest, 4 * steps % largest / largest
    ends = np.stack([np.choose(side, [f, 1, 1 - f, 0]), np.choose(side, [1, 1 - f, 0, f])], axis=-1)
    inner = np.moveaxis(rows[:, :, 1:], 2, 1) / largest  # [row, P1 or P2, axis]
    lines = BERNSTEIN @ np.concatenate([ends[:, :1], 3.5 * inner - 1.25, ends[:, 1:]], axis=1)
    lines[index[bent]] = (HATS @ np.stack([ends[:, 0], inner[:, 0], ends[:, 1]], axis=1))[index[bent]]
    corner = (steps[:, 1] > steps[:, 0]) + (side != 3).sum(axis=1)  # of the line closed along the edge
    first = np.where(is_leaf, index, 0)
    arrays = np.where(is_quad, index, -1), 1.0 * (index == 0), first, 1 * is_leaf, corner[first], lines
    return Texture(*arrays, side == 3, True, [{"name": "", "quad": 0, "transform": transform}])


def read_ktx2(data: bytes) -> tuple[str, list[dict], np.ndarray]:
    """Return the version, the roots and the texels' words of a KTX2 file (B.1, B.2, B.5)."""
    *kind, width, height, depth, layers, faces, levels, scheme = struct.unpack_from("<12s9I", data)
    need([*kind, depth, layers, faces] == [bytes.fromhex("ab4b5458203230bb0d0a1a0a"), 107, 4, 0, 0, 1], "fields")
    *spans, length = struct.unpack_from("<4I5Q", data, 48)
    _, values, _, image = (data[i : i + n] for i, n in zip(spans[::2], spans[1::2], strict=True))
    need(levels < 2 and scheme in (0, 3) and spans[5] == 0 and len(values) == spans[3] <= 1 << 24, "fields")
    need(1 <= height <= 16384 and (width == 2048 or (height == 1 and width in 2 ** np.arange(11))), "size")
    image = zlib.decompress(image) if scheme else image
    need(length == len(image) == 16 * width * height, "length of the image")
    texts: dict[bytes, bytes] = {}
    while values:
        end = 4 + int.from_bytes(values[:4], "little")
        key, _, text = values[4:end].partition(b"\0")
        need(end <= len(values) and key > max(texts, default=b""), "key/value data")
        texts[key], values = text.removesuffix(b"\0"), values[end + -end % 4 :]
    need(texts[b"vexture.encoding"] == b"packed", "encoding")
    roots = json.loads(texts[b"vexture.roots"].decode())
    if styles := texts.get(b"vexture.styles"):
        listed = json.loads(zlib.decompress(styles[4:])[: int.from_bytes(styles[:4], "little")])
        need(len(listed) == len(roots), "styles")
        roots = [root | {"style": style} for root, style in zip(roots, listed, strict=True)]
    need(all(isinstance(r["name"], str) and np.isfinite([*r["transform"]]).sum() == 6 for r in roots), "roots")
    return texts[b"vexture.version"].decode(), roots, np.frombuffer(image, "<u4").reshape(-1, 4).astype(int)


def read_cells(words: np.ndarray) -> tuple[np.ndarray, ...]:
    """Read every texel as a quad: what its cells are, the quad and the first curve of each, its curves (B.3)."""
    cells = words[:, 2, None] >> np.array([0, 8, 16, 24]) & 255
    is_quad, count = cells == 128, np.where(cells == 128, 0, cells >> 3)
    child, first = (words[:, [i]] + np.cumsum(n, axis=1) - n for i, n in enumerate((is_quad, count)))
    return cells, np.where(is_quad, child, -1), first, count


def read_points(words: np.ndarray) -> np.ndarray:
    """Read every texel as a curve: its points [curve, point, axis] in units of the lattice (B.4)."""
    return np.stack([words & 65535, words >> 16], axis=-1) - np.array([0, 16384, 16384, 0])[:, None]


def trace(words: np.ndarray, roots: list[int], kinds: list[int], read: Callable) -> tuple[np.ndarray, np.ndarray]:
    """Return the indices of the quads and curves' texels below the roots, whose cells are of these kinds (B.3)."""
    (cells, child, first, count), level = read(words), np.unique(np.array(roots, int))
    quads, curves = [level[:0]], [level[:0]]
    while len(level) and len(quads) <= 20:
        need(np.isin(cells[level], kinds).all(), "a kind of cell")
        is_quad, n = child[level] >= 0, count[level]
        below = np.where(is_quad, child[level], np.where(n > 0, first[level], len(words)))
        need((below > level[:, None]).all() and len(level) <= len(words), "a cell above its quad")
        curves += [np.arange(i, i + m) for i, m in zip(first[level].flat, n.flat, strict=True)]
        quads, level = [*quads, level], child[level][is_quad]
    need(not len(level), "too deep")
    return np.concatenate(quads), np.concatenate(curves)


def read_shapes(words: np.ndarray, roots: list[dict]) -> tuple[Texture, np.ndarray]:
    """Return the shapes, and the indices of their texels, each as often as it is reached."""
    cells, child, first, count = read_cells(words)
    kinds = [0, 128, *(8 * n + w for n in range(1, 16) for w in range(1, 8))]
    quads, curves = trace(words, [root["quad"] for root in roots], kinds, read_cells)
    coverage, points = (words[:, 3, None] >> np.array([0, 8, 16, 24]) & 255) / 255, read_points(words)
    need((points[curves][:, [0, 3]] <= 32768).all(), "an end of a curve")
    arrays = child, coverage, first, count, cells % 8 - 4, BERNSTEIN @ (points / 32768)
    return Texture(*arrays, points[:, [0, 3], 0] == 0, False, roots), np.append(quads, curves)


def check_used(words: np.ndarray, used: np.ndarray) -> None:
    """Refuse texels that belong to two things, and such as belong to nothing and are not 0 (B.2, B.3)."""
    times = np.bincount(used, minlength=len(words))
    need((times < 2).all() and not words[times == 0].any(), "no tree, or texels beside it")


@refusing()
def read_packed(data: bytes) -> Texture:
    """Read a KTX2 file (B)."""
    version, roots, words = read_ktx2(data)
    need(version == "1" and roots and not any(root.get("map") for root in roots), "version")
    texture, used = read_shapes(words, roots)
    check_used(words, used)
    return texture


def locate(child: np.ndarray, root: int, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return which points are in the unit square; the quads and cells of their leaves; x and y there (A.6, B.6)."""
    x, y = 1.0 * np.atleast_1d(x), 1.0 * np.atleast_1d(y)
    square = (x >= 0) & (x < 1) & (y >= 0) & (y < 1)
    quad, k, todo = np.full(len(x), root), np.zeros(len(x), int), np.flatnonzero(square)
    while len(todo):
        right, up = x[todo] >= 0.5, y[todo] >= 0.5
        x[todo], y[todo], k[todo] = 2 * x[todo] - right, 2 * y[todo] - up, right + 2 * up
        todo = todo[child[quad[todo], k[todo]] >= 0]
        quad[todo] = child[quad[todo], k[todo]]
    return square, quad, k, x, y


def inside(texture: Texture, x: np.ndarray, y: np.ndarray, root: int | str = 0) -> np.ndarray:
    """Say which points of the unit square are filled (A.6, B.6)."""
    place = root if isinstance(root, int) else [shape["name"] for shape in texture.roots].index(root)
    square, quad, k, x, y = locate(texture.child, texture.roots[place]["quad"], x, y)
    winding, count = texture.corner[quad, k], np.where(square, texture.count[quad, k], 0)
    for i in range(count.max(initial=0)):
        at = np.flatnonzero(count > i)
        curve = texture.first[quad[at], k[at]] + i
        below = 1 * (texture.lines[curve, :, 1] <= y[at, None])
        winding[at] += (below[:, [0, -1]] * texture.on_left[curve]) @ [1, -1]
        point, piece = np.nonzero(np.diff(below))
        (x0, y0), (x1, y1) = texture.lines[curve[point], piece].T, texture.lines[curve[point], piece + 1].T
        left = x0 + (x1 - x0) * (y[at[point]] - y0) / (y1 - y0) <= x[at[point]]
        np.add.at(winding, at[point], np.where(left, np.diff(below)[point, piece], 0))
    filled = winding % 2 == 1 if texture.even_odd else winding > 0
    return square & np.where(count > 0, filled, texture.coverage[quad, k] > 0.5)


def sample_points(size: int, samples: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points of size x size pixels, the top row first, samples x samples in each."""
    row, column = np.mgrid[: size * samples, : size * samples].reshape(2, -1)
    x, y = (a + (b % samples + 0.5) / samples for a, b in ((column, row), (row, column)))  # no two in line in a pixel
    return x / (size * samples), 1 - y / (size * samples)


def picture(texture: Texture, size: int, root: int | str = 0, samples: int = 4) -> np.ndarray:
    """Return the coverage of size x size pixels, the top row first, by samples x samples points in each."""
    x, y = sample_points(size, samples)
    filled = inside(texture, x, y, root)
    return filled.reshape(size, samples, size, samples).mean(axis=(1, 3))
