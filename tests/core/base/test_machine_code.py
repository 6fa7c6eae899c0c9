"""Kernels that run without Numba: the same results, and only where they can run."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from vexture import Drawing, convert
from vexture.base import machine_code
from vexture.base.kernels import Kernel
from vexture.texture.load import texture_from
from vexture.tree.bounds import bounds_of
from vexture.tree.build import SLICE, grow
from vexture.tree.cubics import outlines_of
from vexture.tree.planar.faces import new_faces

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tools"))

import compile_kernels  # noqa: E402

TEXT = "text"
"""Stands for the digest of the kernels."""


class Halves(NamedTuple):
    """Two new arrays."""

    whole: NDArray[np.int64]
    rest: NDArray[np.float64]


def halves_of(values: NDArray[np.float64], factor: float, shift: int) -> tuple[Halves, float, int]:
    """What kernels use: named tuples, new arrays of several types and dimensions, the C library."""
    out = Halves(np.empty((len(values), 2), np.int64), np.empty(len(values)))
    total = 0.0
    for k in range(len(values)):
        out.whole[k, 0], out.whole[k, 1] = int(values[k]) + shift, k
        out.rest[k] = np.hypot(values[k] * factor, 1.0)
        total += out.rest[k]
    return out, total, len(values)


ARGUMENTS: tuple[Any, ...] = (np.array([0.5, 1.25, -7.75]), 3.0, 2)


def longer_of(values: Halves, rows: int) -> tuple[Halves, NDArray[np.float64]]:
    """An argument if it has enough rows, else a new array; and the beginning of another argument."""
    whole = values.whole if len(values.whole) >= rows else np.ones((rows, 2), np.int64)
    return Halves(whole, values.rest), values.rest[:0]


def write(function: Any, arguments: tuple[Any, ...], folder: Path, *others: tuple[Any, ...]) -> Kernel:
    """Write the code of a function, compiled for this very machine; `others` are arguments of earlier calls."""
    kernel = Kernel(function, allocates=True, ahead=True)
    import numba

    kernel.dispatcher = numba.njit(error_model="numpy")(function)  # not from the cache
    processor = compile_kernels.PROCESSORS[compile_kernels.MACHINE]
    for other in others:
        kernel.dispatcher(*other)
    compile_kernels.write(kernel, arguments, kernel.dispatcher(*arguments), processor, folder, TEXT)
    return kernel


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[Kernel, Path]:
    """A kernel and the folder of its code; Numba has compiled it for a whole factor, too."""
    folder = tmp_path_factory.mktemp("code")
    return write(halves_of, ARGUMENTS, folder, (np.array([0.5]), 3, 2)), folder


def loaded(written: tuple[Kernel, Path], text: str = TEXT, arguments: Any = ARGUMENTS) -> Any:
    kernel, folder = written
    return machine_code.load(kernel, text, machine_code.argument_type(arguments), folder)


def test_code_computes_what_numba_computes(written: tuple[Kernel, Path]) -> None:
    code = loaded(written)
    assert compile_kernels.bits(code(*ARGUMENTS)) == compile_kernels.bits(written[0].dispatcher(*ARGUMENTS))
    empty = np.empty(0), 1.0, 0
    assert compile_kernels.bits(code(*empty)) == compile_kernels.bits(written[0].dispatcher(*empty))


def test_arrays_outlive_the_code_and_are_given_up(written: tuple[Kernel, Path]) -> None:
    code = loaded(written)
    given_up = []
    release = code._release
    code._release = lambda memory: (given_up.append(memory), release(memory))
    (whole, rest), _, _ = code(*ARGUMENTS)
    del code
    part = whole[1:, 0]
    del whole
    assert given_up == []
    np.testing.assert_array_equal(part, [3, -5])
    del part
    assert len(given_up) == 1
    del rest
    assert len(given_up) == 2


def test_an_argument_that_is_returned_is_the_array_itself(tmp_path: Path) -> None:
    values = Halves(np.arange(6).reshape(3, 2), np.arange(4.0))
    kernel = write(longer_of, (values, 2), tmp_path)
    code = machine_code.load(kernel, TEXT, machine_code.argument_type((values, 2)), tmp_path)
    assert code is not None
    (whole, rest), none = code(values, 3)
    assert whole is values.whole
    assert rest is values.rest
    assert none.shape == (0,)
    (whole, rest), _ = code(values, 5)
    np.testing.assert_array_equal(whole, np.ones((5, 2)))
    assert rest is values.rest


@pytest.mark.parametrize(
    "other",
    [
        (np.array([1, 2]), 3.0, 2),  # another number type
        (np.zeros((2, 2)), 3.0, 2),  # more dimensions
        (np.zeros(6)[::2], 3.0, 2),  # not contiguous
        (np.zeros(2), 3, 2),
        (np.zeros(2), 3.0, 2**63),
        (np.zeros(2), 3.0, None),
        (np.zeros(2), 3.0),
    ],
)
def test_other_arguments_are_left_to_numba(written: tuple[Kernel, Path], other: Any) -> None:
    assert loaded(written, arguments=(np.zeros(2), 3.0, 2)) is not None
    assert loaded(written, arguments=other) is None


def test_readonly_arrays_are_left_to_numba(written: tuple[Kernel, Path]) -> None:
    values = np.zeros(2)
    values.flags.writeable = False
    assert loaded(written, arguments=(values, 3.0, 2)) is None


def test_a_loaded_texture_is_drawn_by_the_code_of_a_converted_one() -> None:
    made = convert(Drawing.polygon([(0.2, 0.2), (0.8, 0.2), (0.5, 0.8)]))
    loaded = texture_from(made.to_ktx2(), "loaded")
    assert machine_code.argument_type(loaded.texels) == machine_code.argument_type(made.texels) == ["<u4", 3, True]


def test_code_of_another_text_is_not_taken(written: tuple[Kernel, Path]) -> None:
    assert loaded(written, text="another") is None


@pytest.mark.parametrize(
    ("field", "value"),
    [("platform", "m68k-unknown-linux"), ("features", ["magic"]), ("symbols", ["no_such_function"])],
)
def test_code_that_cannot_run_here_is_not_taken(
    written: tuple[Kernel, Path], tmp_path: Path, field: str, value: Any
) -> None:
    kernel, folder = written
    (file,) = folder.iterdir()
    head, _, rest = file.read_bytes().partition(b"\n")
    (tmp_path / file.name).write_bytes(json.dumps(json.loads(head) | {field: value}).encode() + b"\n" + rest)
    assert machine_code.load(kernel, TEXT, machine_code.argument_type(ARGUMENTS), tmp_path) is None


def test_code_runs_in_a_process_without_numba(written: tuple[Kernel, Path]) -> None:
    kernel, folder = written
    program = f"""
import sys
from pathlib import Path
from types import SimpleNamespace
import numpy as np
from vexture.base.machine_code import argument_type, load
arguments = np.array([0.5, 1.25, -7.75]), 3.0, 2
kernel = SimpleNamespace(__module__={kernel.__module__!r}, __name__={kernel.__name__!r}, shares=False)
code = load(kernel, {TEXT!r}, argument_type(arguments), Path({str(folder)!r}))
print(code(*arguments)[1:], 'numba' in sys.modules)
"""
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    _, total, count = written[0].dispatcher(*ARGUMENTS)
    assert told.stdout.strip() == f"{(total, count)} False"


def test_what_is_compared_of_code_tells_trees_that_grow_from_other_tables() -> None:
    """A table of faces has as many fields as a tree: it is compared as it is. Free rows of a tree are not compared."""
    square = outlines_of(Drawing.polygon([(0.1, 0.1), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)]))
    tree, _ = grow.dispatcher(*square, bounds_of(0.0, 16, 8, None, 99), SLICE, 0)
    other = tree._replace(curves=np.concatenate([tree.curves, tree.curves]))
    assert compile_kernels.bits(tuple(tree)) == compile_kernels.bits(tuple(other))
    faces = new_faces(8, 8)
    assert len(faces) == len(compile_kernels.Growth._fields)
    assert len(compile_kernels.bits(tuple(faces))) == len(faces)
    assert compile_kernels.bits((faces,)) != compile_kernels.bits((faces._replace(counts=faces.counts + 1),))
