"""Compile ahead of time what a plain `vexture convert` and the renderer on the CPU call, for the wheel of a platform.

`make dist` runs it; by hand: python tools/compile_kernels.py. What comes into the package's folder compiled/ runs on
every processor of this machine's kind that is not very old, and without Numba (`vexture.base.machine_code`). Each
kernel is compared with what Numba makes of it, bit by bit, on the example drawings: a Numba with another calling
convention is noticed here and not by users. With --platform it only says for which platform the wheel is.
"""

import os
import platform
import re
import shutil
import sys
import sysconfig
import tempfile
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import astuple
from pathlib import Path
from typing import Any, NamedTuple

import llvmlite.binding as llvm
import numpy as np

from vexture import Drawing, convert, read_svg
from vexture.base.kernels import Kernel, text_digest
from vexture.base.layout import MAP_HEAD
from vexture.base.machine_code import RELEASE, SHIPPED, Code, argument_type, host, load
from vexture.base.tolerance import ROUND
from vexture.bezier.arc_length import path_length
from vexture.bezier.cover import DIRECTIONS, cover_cells, cut_outlines, find_reach
from vexture.bezier.stroke import stroke_path
from vexture.renderers.colour import draw_colours
from vexture.renderers.cpu import draw
from vexture.texture.encode import texel_rows
from vexture.texture.planar import map_texels
from vexture.tree.bounds import Bounds
from vexture.tree.build import SLICE, grow, grow_on
from vexture.tree.cubics import gather
from vexture.tree.growth import WAITING, Growth, tree_of, with_needed_room
from vexture.tree.planar.build import build_map, grow_map, plant_map, row_cubics
from vexture.tree.planar.faces import add_faces, new_faces, operations_of, refill, trim_faces
from vexture.tree.planar.growth import growth_from_tuples, with_room
from vexture.tree.planar.layers import layers_of, rows_of
from vexture.tree.tree import MOST_QUADS

SHAPES = Path(__file__).parent.parent / "examples" / "shapes"


class Processor(NamedTuple):
    """A kind of processor: LLVM's name of the oldest one that is served, its features beyond the first one's."""

    name: str
    features: tuple[str, ...]

    @property
    def listed(self) -> str:
        """The features as LLVM wants them."""
        return ",".join(f"+{feature}" for feature in self.features)


PROCESSORS = {
    "x86_64": Processor("x86-64-v2", ("cx16", "popcnt", "sahf", "sse3", "sse4.1", "sse4.2", "ssse3")),
    "aarch64": Processor("generic", ()),
}
MACHINE = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())

ROOM = 2**14
"""Rows of each array of a tree that grows: enough for the example drawings."""

RUN_TIME = """
declare ptr @malloc(i64)
declare void @free(ptr)

define ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %alignment) {
  %align = zext i32 %alignment to i64
  %aligned = add i64 %size, %align
  %room = add i64 %aligned, 48
  %block = call ptr @malloc(i64 %room)
  %none = icmp eq ptr %block, null
  br i1 %none, label %failed, label %made
made:
  %after = getelementptr i8, ptr %block, i64 48
  %address = ptrtoint ptr %after to i64
  %over = urem i64 %address, %align
  %up = sub i64 %align, %over
  %data = getelementptr i8, ptr %after, i64 %up
  %dtor_at = getelementptr i8, ptr %block, i64 8
  %info_at = getelementptr i8, ptr %block, i64 16
  %data_at = getelementptr i8, ptr %block, i64 24
  %size_at = getelementptr i8, ptr %block, i64 32
  %allocator_at = getelementptr i8, ptr %block, i64 40
  store i64 1, ptr %block
  store ptr null, ptr %dtor_at
  store ptr null, ptr %info_at
  store ptr %data, ptr %data_at
  store i64 %size, ptr %size_at
  store ptr null, ptr %allocator_at
  ret ptr %block
failed:
  ret ptr null
}

define void @NRT_MemInfo_call_dtor(ptr %block) {
  call void @free(ptr %block)
  ret void
}

declare double @frexp(double, ptr)
declare double @llvm.fabs.f64(double)

define double @numba_frexp(double %value, ptr %exponent) {
  %size = call double @llvm.fabs.f64(double %value)
  %finite = fcmp olt double %size, 0x7FF0000000000000
  br i1 %finite, label %number, label %other
number:
  %fraction = call double @frexp(double %value, ptr %exponent)
  ret double %fraction
other:
  store i32 0, ptr %exponent
  ret double %value
}
"""
"""What kernels ask of Numba's run time. A block of memory starts with the words of Numba's `MemInfo`, of which the
first is the number of arrays that use it; it is given up when that is 0."""


def calls() -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """The kernels to compile, with arguments on which they are compared."""
    for file in sorted(SHAPES.glob("*.svg")):
        drawing = read_svg(file)
        for path in drawing.paths[:1]:
            for contour in path.contours:
                yield path_length, (contour,)
                one = (np.array([len(contour)]), np.array([True]), np.array([0.02, 1.0, 1.0, 4.0, ROUND, 0.0]))
                for dashes in ([], [0.05, 0.03]):
                    yield stroke_path, (contour, *one, np.array(dashes, np.float64))
        for tolerance in (0.0, 0.001):
            outlines, bounds = gather(drawing), Bounds(4, tolerance, 1e-5, 1, 16, MOST_QUADS)
            yield grow, (*outlines, bounds, SLICE, 0)
            tree = Growth(*grow.dispatcher(*outlines, bounds, 0, 0)[0])
            tree.needed[:] = ROOM
            yield grow_on, (with_needed_room(tree), outlines[2], bounds, SLICE, 0)
        texture = convert(drawing, split=None)
        for flat_view in (0, 1):
            to_unit = np.array([[0.02, 0.0, 0.0], [0.0, -0.02, 1.0], [0.0, 0.0, 1.0]])
            image = np.full((50, 50), np.nan, np.float32)
            yield draw, (texture.texels, flat_view, texture.roots[0].quad, (0, 0), to_unit, image)
        yield from map_calls(drawing)


def map_calls(drawing: Drawing) -> Iterator[tuple[Any, tuple[Any, ...]]]:
    """The kernels of planar maps."""
    rows = rows_of(drawing)
    outlines, layers = row_cubics(rows), layers_of(rows, drawing.groups)
    yield plant_map, (*outlines, 16)
    for tolerance in (0.0, 0.001):
        growth, faces = growth_from_tuples(*plant_map.dispatcher(*outlines, 16)[0]), new_faces()
        growth.tree.needed[:] = ROOM
        yield (
            grow_map,
            (with_room(growth), layers, faces, Bounds(4, tolerance, 1e-5, 1, 16, MOST_QUADS), SLICE, 0),
        )
    yield refill, (new_faces(),)
    yield add_faces, (new_faces(), trim_faces(new_faces()), 1, 1, np.zeros(1, np.int64))
    circles, top = np.zeros((1, 3)), np.zeros((1, 1), np.int32)
    reach, outlines = np.zeros((1, DIRECTIONS)), np.zeros((1, 1, 4, 2))
    yield cover_cells, (circles, top)
    yield find_reach, (circles, top, reach, np.zeros(1, np.bool_))
    yield cut_outlines, (outlines, circles, reach, np.zeros(1, np.int64))
    yield operations_of, (layers, np.arange(len(rows.paths), dtype=np.int32))
    planar = build_map(drawing)
    assert planar is not None
    texels = texel_rows(map_texels(planar, 0))
    for flat_view in (0, 1):
        to_unit = np.array([[0.02, 0.0, 0.0], [0.0, -0.02, 1.0], [0.0, 0.0, 1.0]])
        image = np.full((50, 50, 4), np.nan, np.float32)
        yield draw_colours, (texels, 0, flat_view, MAP_HEAD, (0, 0), to_unit, image)


def object_file(text: str, entry: str, processor: Processor) -> tuple[bytes, list[str]]:
    """The machine code of a kernel, and the C library's functions that it may call.

    Parameters
    ----------
    text : str
        What Numba's `inspect_llvm` says of the kernel.
    entry : str
        Its name in there; with `RELEASE` all that can be called from outside.
    processor : Processor
        That is to run it.
    """
    module = llvm.parse_assembly(text)
    module.link_in(llvm.parse_assembly(RUN_TIME))
    for function in module.functions:
        if not function.is_declaration:
            called = function.name in (entry, RELEASE)
            function.linkage = llvm.Linkage.external if called else llvm.Linkage.internal
    machine = llvm.Target.from_triple(host()[0]).create_target_machine(
        cpu=processor.name,
        features=processor.listed,
        opt=3,
        reloc="static" if processor.name.startswith("x86") else "default",
        codemodel="jitdefault",
        jit=True,
    )
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()  # the way in from Python goes, with all that only it calls
    passes.run(module, llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options()))
    own = {function.name for function in module.functions if not function.is_declaration}
    words = set(re.findall(r"[A-Za-z_]\w+", machine.emit_assembly(module))) - own
    symbols = sorted(word for word in words if llvm.address_of_symbol(word))
    return machine.emit_object(module), symbols


def write(
    kernel: Kernel, arguments: tuple[Any, ...], result: Any, processor: Processor, folder: Path, digest: str
) -> None:
    """Write the code file of a kernel that Numba has compiled for these arguments."""
    (overload,) = kernel.dispatcher.overloads.values()
    (text,) = kernel.dispatcher.inspect_llvm().values()
    entry = overload.fndesc.llvm_func_name
    machine_code, symbols = object_file(text, entry, processor)
    if any(symbol.startswith(("NRT", "Py", "_Py", "numba")) for symbol in symbols):
        sys.exit(f"{kernel.__name__} calls {', '.join(symbols)}; write what is not the C library's into RUN_TIME")
    features = list(processor.features)
    types = argument_type(arguments), argument_type(result)
    file = folder / f"{kernel.__module__}.{kernel.__name__}-{processor.name}.code"
    Code(host()[0], features, symbols, digest, *types, entry).write(file, machine_code)
    print(f"{file}: {file.stat().st_size} bytes, calls {', '.join(symbols)}")


def is_growth(values: tuple[Any, ...]) -> bool:
    """Whether a tuple, which may have lost its name in machine code, is a tree that grows."""
    fields = Growth._fields
    return len(values) == len(fields) and np.shape(values[fields.index("counts")]) == (WAITING + 1,)


def bits(values: Any) -> Any:
    """Part of arguments and results that is compared; of a growing tree, only what it has grown."""
    if isinstance(values, tuple) and is_growth(values):
        tree = Growth(*values)
        values = (tree.counts,) if tree.counts[WAITING] else astuple(tree_of(tree))
    return tuple(map(bits, values)) if isinstance(values, tuple) else (np.shape(values), np.asarray(values).tobytes())


def main() -> None:
    """Compile each kernel for its first arguments, write it, and compare it with Numba on all."""
    processor = PROCESSORS[MACHINE]
    shutil.rmtree(SHIPPED, ignore_errors=True)
    SHIPPED.mkdir()
    with tempfile.TemporaryDirectory() as cache:  # Numba shows no code that it finds in a cache
        os.environ |= {"NUMBA_CPU_NAME": processor.name, "NUMBA_CPU_FEATURES": processor.listed, "VEXTURE_CACHE": cache}
        made: dict[Any, Any] = {}
        for kernel, arguments in calls():
            again = deepcopy(arguments)
            result = kernel.dispatcher(*arguments)
            if kernel not in made:
                write(kernel, arguments, result, processor, SHIPPED, text_digest())
                made[kernel] = load(kernel, text_digest(), argument_type(arguments))
            if bits((made[kernel](*again), again)) != bits((result, arguments)):
                sys.exit(f"{kernel.__name__}: the code says something else than Numba")


def tag() -> str:
    """The platform in the wheel's name; nothing is linked, so that any version of Linux's C library will do."""
    name = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return name.replace("linux_", "manylinux_2_17_") if name.startswith("linux_") else name


if __name__ == "__main__":
    if sys.argv[1:] == ["--platform"]:
        print(tag())
    else:
        main()
