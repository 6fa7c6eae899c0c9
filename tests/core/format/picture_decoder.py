"""A decoder of pictures in planar maps, written from D.6 of FORMAT.md alone."""

import numpy as np
from decoder import need


def level_sizes(columns: int, rows: int) -> list[tuple[int, int]]:
    """Return columns and rows of a picture and its levels."""
    sizes = [(columns, rows)]
    while sizes[-1] != (1, 1):
        k = len(sizes)
        sizes.append(((columns + 2**k - 1) // 2**k, (rows + 2**k - 1) // 2**k))
    return sizes


def read_levels(texels: np.ndarray, size: tuple[int, int]) -> list[np.ndarray]:
    """Return the pixels of a picture and its levels, [row, column, channel] each, from its texels on."""
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
    return levels


def check_picture(texels: np.ndarray, place: int, pixels: np.ndarray) -> tuple[int, int, int]:
    """Refuse what D.6 does not allow; return the first of `pixels`, and the columns and rows.

    `place` is the distance from the operation to `pixels`, the texels of pixels of the map.
    """
    opacity, size, distance = texels[0, :3].tolist()
    columns, rows = size & 65535, size >> 16
    need(opacity <= 65535 and int(texels[0, 3]) <= 1, "opacity or sampling")
    need(1 <= columns <= 16384 and 1 <= rows <= 16384, "size of a picture")
    need(np.isfinite(texels[1:, :3].copy().view(np.float32)).all(), "map of a picture")
    first = distance - place
    read_levels(pixels[first:] if distance > 0 and first >= 0 else pixels[:0], (columns, rows))
    return first, columns, rows


def check_pixels(pixels: np.ndarray, pictures: set[tuple[int, int, int]]) -> None:
    """Refuse colours above their opacity, and pictures that overlap."""
    channels = pixels[..., None] >> np.array([0, 8, 16, 24]) & 255
    need((channels[..., :3] <= channels[..., 3:]).all(), "a colour above its opacity")
    end = 0
    for first, columns, rows in sorted(pictures):
        need(first >= end, "pictures overlap")
        end = first + sum((c + 1) // 2 * ((r + 1) // 2) for c, r in level_sizes(columns, rows))


def picture_color(texels: np.ndarray, pixels: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the premultiplied colour of a picture, whose texels are the first of `pixels`, at each point."""
    columns, rows = int(texels[0, 1]) & 65535, int(texels[0, 1]) >> 16
    picture = read_levels(pixels, (columns, rows))[0] / 255
    (a, b, c), (d, e, f) = texels[1:, :3].copy().view(np.float32).astype(float)
    u, v = a * x + b * y + c, d * x + e * y + f

    def pixel(i: np.ndarray, j: np.ndarray) -> np.ndarray:
        return picture[np.clip(j, 0, rows - 1).astype(int), np.clip(i, 0, columns - 1).astype(int)]

    if texels[0, 3] == 0:
        color = pixel(np.floor(u), np.floor(v))
    else:
        i, j = np.floor(u - 0.5), np.floor(v - 0.5)
        right, down = (u - 0.5 - i)[:, None], (v - 0.5 - j)[:, None]
        above = (1 - right) * pixel(i, j) + right * pixel(i + 1, j)
        below = (1 - right) * pixel(i, j + 1) + right * pixel(i + 1, j + 1)
        color = (1 - down) * above + down * below
    return color * int(texels[0, 0]) / 65535
