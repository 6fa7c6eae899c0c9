"""A decoder of pictures in planar maps, written from D.6 of FORMAT.md alone."""

from collections import namedtuple

import numpy as np
from decoder import need

# Columns and rows; whether it is of blocks, samplings 3 and 4; the first of the map's texels of pixels, and how many.
Picture = namedtuple("Picture", "columns rows is_of_blocks first count")


def level_sizes(columns: int, rows: int) -> list[tuple[int, int]]:
    """Return columns and rows of a picture and its levels."""
    sizes = [(columns, rows)]
    while sizes[-1] != (1, 1):
        k = len(sizes)
        sizes.append(((columns + 2**k - 1) // 2**k, (rows + 2**k - 1) // 2**k))
    return sizes


def read_levels(texels: np.ndarray, size: tuple[int, int]) -> tuple[list[np.ndarray], int]:
    """Return the pixels of a picture and its levels, [row, column, channel] each, and the number of its texels."""
    levels, at = [], 0
    for columns, rows in level_sizes(*size):
        across, down = (columns + 1) // 2, (rows + 1) // 2
        need(at + across * down <= len(texels), "pixels elsewhere")
        part = texels[at : at + across * down].reshape(down, across, 4)
        at += across * down
        words = np.zeros((2 * down, 2 * across), np.int64)
        for k in range(4):
            words[k >> 1 :: 2, k & 1 :: 2] = part[:, :, k]
        levels.append(words[:rows, :columns, None] >> np.array([0, 8, 16, 24]) & 255)
    return levels, at


def read_blocks(texels: np.ndarray, size: tuple[int, int]) -> tuple[list[np.ndarray], int]:
    """Do the same for a picture of blocks, of one channel."""
    sizes = level_sizes(*size)
    blocks = sum((columns + 3) // 4 * ((rows + 3) // 4) for columns, rows in sizes)
    length = (blocks + 7) // 8
    need(length <= len(texels), "an index elsewhere")
    index = (texels[:length].reshape(-1, 1) >> np.array([0, 16]) & 65535).ravel()
    need(not index[blocks:].any(), "entries of no block")
    index = index[:blocks]
    count = length + max(0, int(index.max()) - 255)
    need(count <= len(texels), "blocks elsewhere")
    values = np.tile(index[:, None, None], (4, 4))  # [block, row, column]
    stored = index >= 256
    values[stored] = texels[length + index[stored] - 256][:, :, None] >> np.array([0, 8, 16, 24]) & 255
    levels, at = [], 0
    for columns, rows in sizes:
        across, down = (columns + 3) // 4, (rows + 3) // 4
        part = values[at : at + across * down].reshape(down, across, 4, 4).swapaxes(1, 2)
        at += across * down
        levels.append(part.reshape(4 * down, 4 * across)[:rows, :columns, None])
    return levels, count


def read_picture(texels: np.ndarray, pixels: np.ndarray) -> tuple[list[np.ndarray], int]:
    """Read the picture with these texels of its operation, whose own texels are the first of `pixels`."""
    size, sampling = int(texels[0, 1]), int(texels[0, 3])
    return (read_blocks if sampling > 2 else read_levels)(pixels, (size & 65535, size >> 16))


def check_picture(texels: np.ndarray, place: int, pixels: np.ndarray) -> Picture:
    """Refuse what D.6 does not allow.

    `place` is the distance from the operation to `pixels`, the texels of pixels of the map.
    """
    opacity, size, distance, sampling = texels[0].tolist()
    columns, rows = size & 65535, size >> 16
    need(opacity <= 65535 and sampling <= 4, "opacity or sampling")
    need(1 <= columns <= 16384 and 1 <= rows <= 16384, "size of a picture")
    need(np.isfinite(texels[1:, :3].copy().view(np.float32)).all(), "map of a picture")
    bits = 24 if sampling > 2 else 0
    need(int(texels[1, 3]) >> bits == 7 << 29 - bits and texels[2, 3] == 7 << 29, "texels after the first of a picture")
    first = distance - place
    _, count = read_picture(texels, pixels[first:] if distance > 0 and first >= 0 else pixels[:0])
    return Picture(columns, rows, sampling > 2, first, count)


def check_pixels(pixels: np.ndarray, pictures: set[Picture]) -> None:
    """Refuse colours above their opacity, and pictures that overlap."""
    end = 0
    for picture in sorted(pictures, key=lambda one: one.first):
        need(picture.first >= end, "pictures overlap")
        end = picture.first + picture.count
        channels = pixels[picture.first : end, :, None] >> np.array([0, 8, 16, 24]) & 255
        need(picture.is_of_blocks or (channels[..., :3] <= channels[..., 3:]).all(), "a colour above its opacity")


def weights(s: np.ndarray, sampling: int) -> np.ndarray:
    """Return the weights of the samples whose centres are s to the right of, or above, a point."""
    s = abs(s)
    if sampling == 0:
        return np.where(s <= 0.5, 1.0, 0.0)
    if sampling == 1:
        return np.maximum(0, 1 - s)
    return np.where(s < 1, 2 / 3 - s**2 + s**3 / 2, np.maximum(0, 2 - s) ** 3 / 6)


def picture_color(texels: np.ndarray, pixels: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the premultiplied colour of a picture, whose texels are the first of `pixels`, at each point."""
    picture, sampling = read_picture(texels, pixels)[0][0] / 255, int(texels[0, 3])
    (a, b, c), (d, e, f) = texels[1:, :3].copy().view(np.float32).astype(float)
    u, v = a * x + b * y + c, d * x + e * y + f
    offset, around = (0.0, range(1)) if sampling == 0 else (0.5, range(-1, 3))
    i, j = (np.floor(at - offset).astype(int) for at in (u, v))
    color = np.zeros((len(x), picture.shape[2]))
    for row in around:
        for column in around:
            values = picture[np.clip(j + row, 0, len(picture) - 1), np.clip(i + column, 0, picture.shape[1] - 1)]
            weight = weights(u - i - column - 0.5, sampling) * weights(v - j - row - 0.5, sampling)
            color += weight[:, None] * values
    if sampling > 2:
        solid = [*(int(texels[1, 3]) >> np.array([0, 8, 16]) & 255) / 255, 1]
        color = (1 - color if sampling == 4 else color) * solid
    return color * int(texels[0, 0]) / 65535
