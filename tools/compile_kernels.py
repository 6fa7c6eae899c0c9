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
from copy import deepcopy
from dataclasses import astuple
from pathlib import Path
from typing import Any, NamedTuple

import llvmlite.binding as llvm
import numpy as np

from kernel_calls import ahead_calls
from kernel_code import RUN_TIME, join_modules, object_file
from vexture.base.kernels import Kernel, text_digest
from vexture.base.machine_code import RELEASE, SHIPPED, Code, argument_type, host, load
from vexture.tree.growth import WAITING, WHOLE, Growth, tree_of


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


def code_of(text: str, entry: str, processor: Processor) -> tuple[bytes, list[str]]:
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
    machine = llvm.Target.from_triple(host()[0]).create_target_machine(
        cpu=processor.name,
        features=processor.listed,
        opt=3,
        reloc="static" if processor.name.startswith("x86") else "default",
        codemodel="jitdefault",
        jit=True,
    )
    module = join_modules([text, RUN_TIME], {entry: entry, RELEASE: RELEASE})
    machine_code = object_file(module, machine)
    own = {function.name for function in module.functions if not function.is_declaration}
    words = set(re.findall(r"[A-Za-z_]\w+", machine.emit_assembly(module))) - own
    return machine_code, sorted(word for word in words if llvm.address_of_symbol(word))


def write(
    kernel: Kernel, arguments: tuple[Any, ...], result: Any, processor: Processor, folder: Path, digest: str
) -> None:
    """Write the code file of a kernel that Numba has compiled for these arguments."""
    types = tuple(map(kernel.dispatcher.typeof_pyval, arguments))  # its callers may need others
    overload, text = kernel.dispatcher.overloads[types], kernel.dispatcher.inspect_llvm(types)
    entry = overload.fndesc.llvm_func_name
    machine_code, symbols = code_of(text, entry, processor)
    if any(symbol.startswith(("NRT", "Py", "_Py", "numba")) for symbol in symbols):
        sys.exit(f"{kernel.__name__} calls {', '.join(symbols)}; write what is not the C library's into RUN_TIME")
    features = list(processor.features)
    described = argument_type(arguments), argument_type(result)
    file = folder / f"{kernel.__module__}.{kernel.__name__}-{processor.name}.code"
    Code(host()[0], features, symbols, digest, *described, entry).write(file, machine_code)
    print(f"{file}: {file.stat().st_size} bytes, calls {', '.join(symbols)}")


def is_growth(values: tuple[Any, ...]) -> bool:
    """Whether a tuple, which may have lost its name in machine code, is a tree that grows."""
    fields = Growth._fields
    return len(values) == len(fields) and np.shape(values[fields.index("counts")]) == (WHOLE + 1,)


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
        for kernel, arguments in ahead_calls():
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
