"""Compile the kernels that JavaScript calls to WebAssembly: Numba's code for this machine, for another one.

`make viewer` and `make dist` run it; by hand: python tools/build_wasm.py [FOLDER]. There is a module for silhouettes,
one for planar maps and one for strokes, because pages load what they need. A section of a module describes what it
exports: names, types of arguments and results, constants, and the digest of the kernels' text, which is that of the
compiled kernels in wheels. `web/src/convert/kernels.js` reads it. A module that is up to date is left alone.

Numba's code addresses structures by byte offsets, with 8 bytes for each pointer. WebAssembly has 32-bit addresses, so
callers write each pointer into a place of 8 bytes. The rest of the calling convention is that of
`vexture.base.machine_code`. ziglang, a package of PyPI, brings the compiler of the run time in C, and the linker.
"""

import gzip
import hashlib
import inspect
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Final

import llvmlite.binding as llvm
import numpy as np

from kernel_calls import Entry, wasm_constants, wasm_modules
from kernel_code import RUN_TIME, join_modules, object_file
from vexture.base.kernels import text_digest
from vexture.base.machine_code import argument_type

ROOT: Final = Path(__file__).resolve().parents[1]
OUTPUT: Final = ROOT / "web" / "kernels"
TOOLS: Final = ROOT / "tools"
RUN_TIME_C: Final = TOOLS / "wasm" / "run_time.c"
SOURCES: Final = (Path(__file__), RUN_TIME_C, TOOLS / "kernel_calls.py", TOOLS / "kernel_code.py")
"""What decides the module beside the kernels' text."""

TRIPLE: Final = "wasm32-unknown-unknown"
FEATURES: Final = "+bulk-memory,+sign-ext,+nontrapping-fptoint,+mutable-globals"
"""Parts of WebAssembly that all engines of 2021 and later have."""

SECTION: Final = b"vexture"
"""Name of the section that describes the module."""

CALLED: Final = ("malloc", "reset")
"""Functions of the run time that JavaScript calls."""

COMPILER: Final = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "NUMBA_OPT": "1",
    "NUMBA_LOOP_VECTORIZE": "0",
    "NUMBA_SLP_VECTORIZE": "0",
}
"""Settings of Numba: what it makes for vectors of numbers is only longer here, and `object_of` optimises later."""

ERROR_TEXT: Final = re.compile(r"@\.const\.picklebuf\.[\w.]+")

SUBTRACT: Final = """
define i8 @subtract_and_test(ptr %place, i64 %value, i32 %condition) {
  %old = load i64, ptr %place
  %new = sub i64 %old, %value
  store i64 %new, ptr %place
  %none = icmp eq i64 %new, 0
  %word = zext i1 %none to i8
  ret i8 %word
}
"""
"""Stands for the instruction of x86 that counts references: without threads it need not be atomic."""


def retarget(text: str, layout: str) -> str:
    """LLVM's text of a kernel for WebAssembly.

    Beside the names of the target, four things differ. There are no common symbols. References are counted by
    `SUBTRACT`. Room on the stack for structures with pointers must be that of 8-byte pointers, because the code counts
    them so: with 4-byte pointers, neighbours on the stack would be overwritten. Errors, which only lack of memory
    raises, have no text: a caller sees the status.

    Examples
    --------
    >>> retarget("%x = alloca { ptr, i64, ptr }, align 8", "")
    '%x = alloca { i64, i64, i64 }, align 8'
    """
    text = re.sub(r'target datalayout = "[^"]*"', f'target datalayout = "{layout}"', text)
    text = re.sub(r'target triple = "[^"]*"', f'target triple = "{TRIPLE}"', text)
    text = re.sub(r'"target-cpu"="[^"]*"|"target-features"="[^"]*"', "", text)
    text = text.replace("= common ", "= internal ").replace("@llvm.x86.atomic.sub.cc.i64", "@subtract_and_test")
    for line in re.findall(r"(?m)^ *(?:store|%\S+ = load) \{[^@\n]*", text):
        if "ptr, i64" in line:
            sys.exit(
                f"a kernel copies a structure with addresses as one value, which WebAssembly places otherwise: {line}"
            )
    text = re.sub(r"(?m)^(?!@).*@\.const\.picklebuf\..*$", lambda found: ERROR_TEXT.sub("null", found[0]), text)
    return re.sub(r"= alloca .*", lambda found: re.sub(r"\bptr\b", "i64", found[0]), text)


def object_of(texts: dict[str, tuple[str, str]]) -> bytes:
    """One object file of several kernels, which share what they call.

    `texts` has, by the name to export, what Numba's `inspect_llvm` says of a kernel, and the kernel's name in there.
    """
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(
        cpu="generic", features=FEATURES, opt=2, reloc="static", codemodel="default"
    )
    layout = str(machine.target_data)
    head = f'target datalayout = "{layout}"\ntarget triple = "{TRIPLE}"\n'
    parts = [retarget(text, layout) for text, _ in texts.values()]
    module = join_modules([*parts, head + RUN_TIME + SUBTRACT], {entry: name for name, (_, entry) in texts.items()})
    settings = llvm.create_pipeline_tuning_options(speed_level=2)
    settings.loop_vectorization = settings.slp_vectorization = settings.loop_unrolling = False
    return object_file(module, machine, llvm.create_pass_builder(machine, settings))


def link(kernels: bytes, names: list[str], output: Path) -> None:
    """Link an object file with the run time; a function that neither has is an error."""
    zig = [sys.executable, "-m", "ziglang"]
    with tempfile.TemporaryDirectory() as scratch:
        objects = [Path(scratch) / name for name in ("kernels.o", "run_time.o")]
        objects[0].write_bytes(kernels)
        compiler = ["cc", "-target", "wasm32-freestanding", "-O2", "-mbulk-memory", "-fno-builtin", "-Wall", "-Werror"]
        _run([*zig, *compiler, "-c", str(RUN_TIME_C), "-o", str(objects[1])])
        options = ["--no-entry", "--export-memory", "--gc-sections", "--strip-all", "-O2", "-z", "stack-size=1048576"]
        exports = [f"--export={name}" for name in (*names, *CALLED)]
        _run([*zig, "wasm-ld", *options, *exports, *map(str, objects), "-o", str(output)])


def _run(command: list[str]) -> None:
    outcome = subprocess.run(command, capture_output=True, text=True, check=False)
    if outcome.returncode:
        hint = "; write what kernels ask of the C library into tools/wasm/run_time.c"
        missing = re.search(r"undefined symbol: \S+", outcome.stderr)
        sys.exit(f"{' '.join(command)} failed:\n{outcome.stderr}{missing[0] + hint if missing else ''}")


def describe_value(name: str, value: Any) -> dict[str, Any]:
    """Describe an argument or a part of a result: its name, and its type, or the parts of a tuple."""
    if isinstance(value, tuple):
        names = getattr(value, "_fields", map(str, range(len(value))))
        return {"name": name, "parts": [describe_value(*part) for part in zip(names, value, strict=True)]}
    described = {"name": name, "type": argument_type(value)}
    if described["type"] == "":
        sys.exit(f"{name} is {value!r}, which JavaScript cannot pass")
    return described | ({"shape": [None, *value.shape[1:]]} if isinstance(value, np.ndarray) else {})


def describe(entry: Any, result: Any) -> dict[str, Any]:
    """Describe an entry for JavaScript: its arguments, and the parts of its result."""
    names = inspect.signature(entry.kernel.py_func).parameters
    parts = result if isinstance(result, tuple) else (result,)
    listed = {"arguments": zip(names, entry.arguments, strict=True), "result": zip(entry.results, parts, strict=True)}
    return {kind: [describe_value(*value) for value in values] for kind, values in listed.items()}


def with_section(module: bytes, text: bytes) -> bytes:
    """Append a custom section to a module (WebAssembly Core Specification, 5.5.3)."""

    def number(value: int) -> bytes:
        return bytes([value & 0x7F | 0x80]) + number(value >> 7) if value > 0x7F else bytes([value])

    content = number(len(SECTION)) + SECTION + text
    return module + b"\0" + number(len(content)) + content


def digest_of_tools() -> str:
    """Digest of what decides the module beside the kernels' text."""
    return hashlib.sha256(b"".join(source.read_bytes() for source in SOURCES)).hexdigest()[:12]


def is_current(file: Path) -> bool:
    """Whether a module was made of the current text of the kernels and these tools."""
    stamp = f'{{"digest": "{text_digest()}", "tools": "{digest_of_tools()}", '
    return file.is_file() and SECTION + stamp.encode() in file.read_bytes()


def compiled(entry: Entry) -> tuple[str, str, dict[str, Any]]:
    """Compile an entry: LLVM's text, its name in there, and its description."""
    result = entry.kernel.dispatcher(*entry.arguments)
    (overload,) = entry.kernel.dispatcher.overloads.values()
    (text,) = entry.kernel.dispatcher.inspect_llvm().values()
    return text, overload.fndesc.llvm_func_name, describe(entry, result)


def build(output: Path, entries: list[Entry]) -> None:
    """Write the module of some entries."""
    output.unlink(missing_ok=True)
    found = {entry.kernel.__name__: compiled(entry) for entry in entries}
    described = {name: description for name, (_, _, description) in found.items()}
    stamp = {"digest": text_digest(), "tools": digest_of_tools()}
    section = json.dumps(stamp | {"constants": wasm_constants(), "entries": described})
    unfinished = output.with_suffix(".tmp")
    link(object_of({name: (text, own) for name, (text, own, _) in found.items()}), [*found], unfinished)
    unfinished.write_bytes(with_section(unfinished.read_bytes(), section.encode()))
    unfinished.replace(output)  # at once: tests in JavaScript may look for it meanwhile
    size, packed = output.stat().st_size, len(gzip.compress(output.read_bytes()))
    print(f"{output}: {size} bytes, {packed} with gzip", flush=True)


def main() -> None:
    """Build the modules that are not current."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else OUTPUT
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as cache:  # Numba shows no code that it finds in a cache
        os.environ |= COMPILER | {"VEXTURE_CACHE": cache}
        for name, entries in wasm_modules().items():
            output = folder / f"{name}.wasm"
            if not is_current(output):
                build(output, entries)


if __name__ == "__main__":
    main()
