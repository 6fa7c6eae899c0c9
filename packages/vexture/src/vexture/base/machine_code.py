"""Kernels compiled ahead of time, which save the time of importing Numba and of compiling.

A code file holds one kernel, specialised for the types of its arguments, as an object file of one platform. It lists
its requirements: the platform, processor features and functions of the C library. If a requirement is missing, or the
source text of the kernels has changed since, Numba compiles the kernel instead.

The code follows Numba's calling convention: ``int f(result*, exception**, arguments...)``. A tuple is passed as its
elements, an array as the seven or more words of `_words`. `tools/compile_kernels.py` writes the files, and checks that
each kernel returns the same as Numba's.
"""

import ctypes
import json
import sys
import weakref
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

SHIPPED = Path(__file__).parents[1] / "compiled"
"""Folder of the code files in a wheel."""

LARGEST = 2**63 - 1

MEMORY, OWNER, COUNT, ITEM_SIZE, DATA, SHAPE = range(6)
"""Order of an array's words; the strides follow the shape. MEMORY and OWNER are 0 for an array that NumPy made."""

RELEASE = "NRT_decref"
"""Name of the function that releases an array of a kernel."""

TypeDescription = Any
"""Type of a value: "int", "float", "bool", [dtype, dimensions, writable] for an array, ["tuple", ...] for a tuple, or
None."""


class Code(NamedTuple):
    """Header of a code file."""

    platform: str  # LLVM's target triple
    features: list[str]  # required of the processor
    symbols: list[str]  # required of the C library
    text: str  # digest of the kernels' text
    arguments: TypeDescription
    result: TypeDescription
    entry: str  # name of the function in the object file

    def write(self, file: Path, machine_code: bytes) -> None:
        """Write a file: a line of JSON, then the object file."""
        file.write_bytes(json.dumps(self._asdict()).encode() + b"\n" + machine_code)


def argument_type(value: Any) -> TypeDescription:
    """Type of an argument or a result, for which a kernel is specialised; "" if code files do not support the value."""
    if value is None:
        return None
    if type(value) is int:
        return "int" if -LARGEST <= value <= LARGEST else ""
    if type(value) in (float, bool):
        return type(value).__name__
    if isinstance(value, tuple):
        parts = [argument_type(part) for part in value]
        return "" if "" in parts else ["tuple", *parts]
    if isinstance(value, np.ndarray) and value.flags.c_contiguous and value.flags.aligned:
        return [value.dtype.str, value.ndim, value.flags.writeable]
    return ""


def _words(value: Any) -> list[Any]:
    """Machine words that pass an argument."""
    if isinstance(value, tuple):
        return [word for part in value for word in _words(part)]
    if isinstance(value, np.ndarray):
        numbers = [0, 0, value.size, value.itemsize, value.ctypes.data, *value.shape, *value.strides]
        return [ctypes.c_int64(number) for number in numbers]
    if isinstance(value, bool):
        return [ctypes.c_uint8(value)]
    return [ctypes.c_double(value) if isinstance(value, float) else ctypes.c_int64(value)]


def _layout(result: TypeDescription) -> Any:
    """Structure of ctypes that holds a result."""
    if result is None:
        return ctypes.c_void_p
    if isinstance(result, str):
        return {"int": ctypes.c_int64, "float": ctypes.c_double, "bool": ctypes.c_bool}[result]
    if result[0] == "tuple":
        fields = [(f"part_{k}", _layout(part)) for k, part in enumerate(result[1:])]
        return type("Parts", (ctypes.Structure,), {"_fields_": fields})
    return ctypes.c_int64 * (SHAPE + 2 * result[1])


class _Memory:
    """The memory of an array of a kernel, for NumPy; it is released with its last reference."""

    def __init__(
        self, dtype: str, shape: tuple[int, ...], words: Sequence[int], release: Callable[[int], None]
    ) -> None:
        self.__array_interface__ = {"version": 3, "typestr": dtype, "shape": shape, "data": (words[DATA], False)}
        weakref.finalize(self, release, words[MEMORY]).atexit = False


def _value(result: TypeDescription, storage: Any, release: Callable[[int], None], arguments: tuple[Any, ...]) -> Any:
    """Python value of a result; arrays are not copied, and are released with their last reference."""
    if result is None:
        return None
    if isinstance(result, str):
        return storage
    if result[0] == "tuple":
        parts = enumerate(result[1:])
        return tuple(_value(part, getattr(storage, f"part_{k}"), release, arguments) for k, part in parts)
    dtype, dimensions, _ = result
    shape = tuple(storage[SHAPE : SHAPE + dimensions])
    if storage[MEMORY] == 0:
        return _argument(dtype, shape, storage, arguments)
    return np.asarray(_Memory(dtype, shape, storage, release))


def _argument(dtype: str, shape: tuple[int, ...], words: Sequence[int], arguments: tuple[Any, ...]) -> NDArray[Any]:
    """Array of the arguments that a kernel returned, or the beginning of one, which it did not allocate."""
    for array in _arrays(arguments):
        if array.ctypes.data == words[DATA] and array.dtype.str == dtype and array.shape[1:] == shape[1:]:
            return array if array.shape == shape else array[: shape[0]]
    raise SystemError("a kernel returned a part of an argument that is not its beginning; let it copy the part")


def _arrays(value: Any) -> Iterator[NDArray[Any]]:
    """All arrays in nested tuples."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple):
        for part in value:
            yield from _arrays(part)


class Compiled:
    """A kernel from the object file `machine_code` of a code file; if it `shares`, other threads run meanwhile."""

    def __init__(self, code: Code, machine_code: bytes, shares: bool = False) -> None:
        import llvmlite.binding as llvm

        self.code = code
        machine = llvm.Target.from_triple(code.platform).create_target_machine()
        self.engine: Any = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
        self.engine.add_object_file(llvm.ObjectFileRef.from_data(machine_code))
        self.engine.finalize_object()
        # PYFUNCTYPE holds the interpreter's lock, as Numba does
        prototype = ctypes.CFUNCTYPE if shares else ctypes.PYFUNCTYPE
        self._function = prototype(ctypes.c_int)(self.engine.get_function_address(code.entry))
        self._layout = _layout(code.result)
        address = 0 if code.result is None else self.engine.get_function_address(RELEASE)
        self._give_up = ctypes.PYFUNCTYPE(None, ctypes.c_void_p)(address)

    def _release(self, memory: int) -> None:
        """Release an array; as a bound method it keeps the code in memory as long as its arrays exist."""
        self._give_up(memory)

    def __call__(self, *arguments: Any) -> Any:
        """Run the kernel; the arguments must have the types that it was compiled for."""
        held, exception = self._layout(), ctypes.c_void_p()
        status = self._function(ctypes.byref(held), ctypes.byref(exception), *_words(arguments))
        if status != 0:
            raise MemoryError("a kernel failed: it found no memory for its arrays")
        value = held.value if isinstance(held, ctypes._SimpleCData) else held
        return _value(self.code.result, value, self._release, arguments)


@cache
def host() -> tuple[str, frozenset[str]]:
    """Initialise LLVM for this machine; return the machine's platform and processor features."""
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    features = llvm.get_host_cpu_features()
    return llvm.get_process_triple(), frozenset(name for name, has in features.items() if has)


def _add_symbols(symbols: list[str]) -> bool:
    """Tell LLVM the addresses of C functions; False if one is missing, which would make LLVM end the process."""
    import llvmlite.binding as llvm

    library = ctypes.cdll.ucrtbase if sys.platform == "win32" else ctypes.CDLL(None)
    for symbol in symbols:
        function = getattr(library, symbol, None)
        if function is None:
            return False
        llvm.add_symbol(symbol, ctypes.cast(function, ctypes.c_void_p).value)
    return True


def load(kernel: Any, text: str, arguments: TypeDescription, folder: Path = SHIPPED) -> Compiled | None:
    """Load a kernel's code for arguments of these types (from `argument_type`); None if this machine cannot run it.

    A code file is named after the kernel's module and function; `text` is the digest of the kernels' source text.
    """
    for file in sorted(folder.glob(f"{kernel.__module__}.{kernel.__name__}-*.code")):
        head, _, machine_code = file.read_bytes().partition(b"\n")
        code = Code(**json.loads(head))
        if code.text != text or code.arguments != arguments:
            continue
        platform, features = host()
        if code.platform == platform and features.issuperset(code.features) and _add_symbols(code.symbols):
            return Compiled(code, machine_code, kernel.shares)
    return None
