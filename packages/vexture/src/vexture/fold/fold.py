"""`Fold`: time-dependent displacements of a shape (thesis 4.6.2), as an array, a file and a function."""

import json
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from vexture.base.errors import FormatError, ParameterError
from vexture.base.layout import ROW_BITS, TEXT_ENCODING, TEXT_VERSION, TEXT_WRITER
from vexture.base.notes import Note
from vexture.fold import layout
from vexture.fold.blend import fold, progress
from vexture.texture.encode import texel_rows
from vexture.texture.ktx2 import read_ktx2, write_ktx2

REMEDY: Final = "make the fold again"
WRAPS: Final = ("none", "clamp", "repeat")


class Kind(IntEnum):
    """Movement of a texel from its position to its end position.

    With x = (time - begin) / duration clamped to 0..1, the progress is x (linear), x^2 (smooth start), 1 - (1 - x)^2
    (smooth end) or x^2 (3 - 2 x) (smooth both). The periodic kind has the progress 0 before its begin, and then
    sin(2 pi (time - begin) / duration) without end: its duration is its period.
    """

    LINEAR = layout.FOLD_LINEAR
    SMOOTH_START = layout.FOLD_SMOOTH_START
    SMOOTH_END = layout.FOLD_SMOOTH_END
    SMOOTH_BOTH = layout.FOLD_SMOOTH_BOTH
    PERIODIC = layout.FOLD_PERIODIC


@dataclass(frozen=True, slots=True, eq=False)
class Fold:
    """A field of displacements that change with time.

    A fragment at p shows the texture at p + d(p, time). The displacement d is a quadratic B-spline, so its gradient is
    continuous. Its control points, at the centres of the texels, are the end positions times the progress (`Kind`).
    Beyond the unit square the border texels continue; if the shape repeats, the fold repeats.

    With a cycle, time - begin is taken modulo the cycle, so that each texel restarts at its own begin. The periodic
    kind then continues without a jump if the cycle is a whole number of durations; the other kinds jump back to 0. With
    a cycle of 0, each texel moves once and stays there.

    Parameters
    ----------
    displacement : (rows, columns, 2) array
        End positions relative to the texels' positions, x right, y up, in unit-square units; the top row first. Stored
        as float32.
    kind : (rows, columns) array of `Kind`, or one
    begin, duration : (rows, columns) array, or one number
        Seconds, stored in steps of 1/65536. With a cycle, begin is below it, and duration is not above it.
    cycle : float
        Seconds, in the same steps.
    notes : tuple of Note
        Remarks of the function that made the fold; a file does not contain them.

    Raises
    ------
    ParameterError
        If sizes, kinds, displacements or times are out of range.

    Examples
    --------
    >>> swing = Fold(np.full((2, 2, 2), (0.25, 0.0)), kind=Kind.PERIODIC, duration=4.0, cycle=4.0)
    >>> [swing.at([(0.5, 0.5)], seconds)[0].tolist() for seconds in (0, 1, 3)]
    [[[0.5, 0.5]], [[0.75, 0.5]], [[0.25, 0.5]]]
    """

    displacement: NDArray[np.float32]
    kind: NDArray[np.uint8] = Kind.LINEAR  # type: ignore[assignment]
    begin: NDArray[np.float64] = 0.0  # type: ignore[assignment]
    duration: NDArray[np.float64] = 1.0  # type: ignore[assignment]
    cycle: float = 0.0
    notes: tuple[Note, ...] = ()

    def __post_init__(self) -> None:
        with np.errstate(over="ignore", invalid="ignore"):
            displacement = np.array(self.displacement, np.float64).astype(np.float32)
        if displacement.ndim != 3 or displacement.shape[2] != 2:
            raise ParameterError(f"`displacement` has the shape {displacement.shape}; it must be (rows, columns, 2)")
        rows, columns, _ = displacement.shape
        if not (1 <= rows <= layout.FOLD_MOST_SIDE and 1 <= columns <= layout.FOLD_MOST_SIDE):
            raise ParameterError(f"{columns} x {rows} texels; a fold has 1 to {layout.FOLD_MOST_SIDE} each way")
        try:
            kind, begin, duration = (
                np.broadcast_to(np.array(values, np.float64), (rows, columns)).copy()
                for values in (self.kind, self.begin, self.duration)
            )
        except (TypeError, ValueError):
            raise ParameterError(
                f"`kind`, `begin` and `duration` must be one number each or ({rows}, {columns})"
            ) from None
        begin, duration, cycle = (
            np.rint(seconds * layout.FOLD_TICKS) / layout.FOLD_TICKS
            for seconds in (begin, duration, np.float64(self.cycle))
        )
        _check(displacement, kind, begin, duration, float(cycle))
        object.__setattr__(self, "displacement", displacement)
        object.__setattr__(self, "kind", kind.astype(np.uint8))
        object.__setattr__(self, "begin", begin)
        object.__setattr__(self, "duration", duration)
        object.__setattr__(self, "cycle", float(cycle))

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        return self.displacement.shape[1], self.displacement.shape[0]

    @property
    def texels(self) -> NDArray[np.uint32]:
        """Words of FORMAT.md, C.2, (rows, columns, 4)."""
        words = np.empty((*self.kind.shape, 4), np.uint32)
        words[..., :2] = self.displacement.view(np.uint32)
        begin = np.rint(self.begin * layout.FOLD_TICKS).astype(np.uint32)
        words[..., 2] = begin | (self.kind.astype(np.uint32) << np.uint32(layout.FOLD_KIND_SHIFT))
        words[..., 3] = np.rint(self.duration * layout.FOLD_TICKS)
        return words

    def progress(self, seconds: float) -> NDArray[np.float64]:
        """Return the fraction of its displacement that each texel has at a time, (rows, columns)."""
        return progress(self.clock(seconds), self.cycle, self.texels)

    def clock(self, seconds: float) -> float:
        """Return the time for the shader, reduced to the cycle because float32 has few digits."""
        return seconds % self.cycle if self.cycle > 0.0 else seconds

    def at(
        self, points: ArrayLike, seconds: float, *, wrap: str = "none"
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the points of the texture that points show at a time: the shader's function in float64.

        Parameters
        ----------
        points : (n, 2) array
            In unit-square units, y up.
        seconds : float
            The time.
        wrap : str
                ``"repeat"`` if the shape repeats, otherwise ``"none"`` or ``"clamp"``, which are equivalent here.

        Returns
        -------
        places : (n, 2) array
            In unit-square units.
        jacobians : (n, 2, 2) array
                Derivatives of the places; [k, i, j] is that of coordinate i with respect to coordinate j.

        Raises
        ------
        ParameterError
            If there is no such wrap.
        """
        if wrap not in WRAPS:
            raise ParameterError(f"`wrap` is {wrap!r}; it must be one of {', '.join(WRAPS)}")
        places = np.asarray(points, np.float64).reshape(-1, 2)
        base = np.zeros(places.shape, np.uint32)
        right, up = np.broadcast_to((1.0, 0.0), places.shape), np.broadcast_to((0.0, 1.0), places.shape)
        now = self.displacement * self.progress(seconds)[..., None]
        folded = fold(now, wrap, base, places, right, up)
        return folded.uv, np.stack([folded.dx, folded.dy], axis=2)

    def to_ktx2(self) -> bytes:
        """Return the contents of the file (FORMAT.md, part C)."""
        columns, rows = self.size
        cycle = int(self.cycle) if self.cycle.is_integer() else self.cycle
        facts = json.dumps({"columns": columns, "rows": rows, "cycle": cycle}, separators=(",", ":"))
        texts = {
            TEXT_WRITER: "vexture",
            TEXT_ENCODING: layout.ENCODING_FOLD,
            TEXT_VERSION: layout.FOLD_VERSION,
            layout.TEXT_FOLD: facts,
        }
        return write_ktx2(texel_rows(self.texels.reshape(-1, 4)), texts)


def _check(
    displacement: NDArray[np.float32],
    kind: NDArray[np.float64],
    begin: NDArray[np.float64],
    duration: NDArray[np.float64],
    cycle: float,
) -> None:
    """Raise an error for values that FORMAT.md, C.3 does not allow."""
    most, tick = layout.FOLD_MOST_SECONDS, 1.0 / layout.FOLD_TICKS
    if not (np.abs(displacement) <= layout.FOLD_MOST_DISPLACEMENT).all():
        raise ParameterError(f"a displacement is not a number within {layout.FOLD_MOST_DISPLACEMENT:g} of 0")
    if not np.isin(kind, list(Kind)).all():
        raise ParameterError(f"a kind is {kind[~np.isin(kind, list(Kind))][0]:g}; there are 0 to {max(Kind):d}")
    if not 0.0 <= cycle <= most:
        raise ParameterError(f"`cycle` is {cycle:g} seconds; it must be 0 to {most}")
    for name, values, least in (("begin", begin, 0.0), ("duration", duration, tick)):
        if not ((values >= least) & (values <= most)).all():
            raise ParameterError(f"a {name} is not a number of seconds from {least:g} to {most}")
    if cycle > 0.0 and (begin.max() >= cycle or duration.max() > cycle):
        raise ParameterError(
            f"begin is up to {begin.max():g}, duration up to {duration.max():g}; in a cycle of {cycle:g} seconds "
            "begin must be less and duration no more"
        )


def fold_from(data: bytes, source: str = "fold") -> Fold:
    """Read the content of a fold's file, which may be untrusted.

    Parameters
    ----------
    data : bytes
        Result of `Fold.to_ktx2`, or the content of a file written by `vexture fold`.
    source : str
        Name of the file in messages.

    Returns
    -------
    Fold

    Raises
    ------
    FormatError
        If it is damaged or not a fold.

    Examples
    --------
    >>> fold_from(Fold(np.zeros((3, 2, 2))).to_ktx2()).size
    (2, 3)
    """
    if len(data) > layout.FOLD_FILE_LIMIT:
        raise FormatError(f"{source}: longer than {layout.FOLD_FILE_LIMIT} bytes, so not a fold; {REMEDY}")
    texels, texts = read_ktx2(data, source)
    try:
        for key, known in ((TEXT_ENCODING, layout.ENCODING_FOLD), (TEXT_VERSION, layout.FOLD_VERSION)):
            if texts.get(key) != known:
                found = repr(texts.get(key))[:80]
                raise FormatError(f"{key} is {found}; a fold has {known!r}; {REMEDY}")
        columns, rows, cycle = _read_facts(texts.get(layout.TEXT_FOLD, ""))
        return _fold_of_texels(texels, columns, rows, cycle)
    except ParameterError as error:
        raise FormatError(f"{source}: {error}; {REMEDY}") from None
    except FormatError as error:
        raise FormatError(f"{source}: {error}") from None


def _read_facts(text: str) -> tuple[int, int, float]:
    """Parse columns, rows and cycle from their JSON text."""
    try:
        facts: Any = json.loads(text)
    except (ValueError, RecursionError):
        raise FormatError(f"{layout.TEXT_FOLD} is {text[:60]!r}, which is not JSON; {REMEDY}") from None
    if not isinstance(facts, dict):
        raise FormatError(f"{layout.TEXT_FOLD} is {text[:60]!r}; it must be an object; {REMEDY}")
    for name in ("columns", "rows"):
        if type(facts.get(name)) is not int or not 1 <= facts[name] <= layout.FOLD_MOST_SIDE:
            found = repr(facts.get(name))[:60]
            raise FormatError(f"{name} is {found}; it must be 1 to {layout.FOLD_MOST_SIDE}; {REMEDY}")
    cycle: Any = facts.get("cycle")
    if type(cycle) not in (int, float) or not 0 <= cycle <= layout.FOLD_MOST_SECONDS:
        raise FormatError(f"cycle is {repr(cycle)[:60]}; it must be 0 to {layout.FOLD_MOST_SECONDS}; {REMEDY}")
    return facts["columns"], facts["rows"], float(cycle)


def _fold_of_texels(texels: NDArray[np.uint32], columns: int, rows: int, cycle: float) -> Fold:
    """Return the fold with the texels of a file."""
    flat, count = texels.reshape(-1, 4), rows * columns
    width = min(1 << (count - 1).bit_length(), 1 << ROW_BITS)
    if len(flat) != -(-count // width) * width:
        raise FormatError(f"{len(flat)} texels for {columns} x {rows} of a fold; {REMEDY}")
    if flat[count:].any():
        raise FormatError(
            f"texel {count + int(flat[count:].any(axis=1).argmax())} is beyond the fold and not 0; {REMEDY}"
        )
    words = flat[:count].reshape(rows, columns, 4)
    displacement = np.ascontiguousarray(words[..., :2]).view(np.float32)
    kind = words[..., 2] >> np.uint32(layout.FOLD_KIND_SHIFT)
    begin = (words[..., 2] & np.uint32((1 << layout.FOLD_KIND_SHIFT) - 1)) / layout.FOLD_TICKS
    return Fold(displacement, kind, begin, words[..., 3] / layout.FOLD_TICKS, cycle)
