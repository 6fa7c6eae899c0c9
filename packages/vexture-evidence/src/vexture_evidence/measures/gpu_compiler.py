"""Compiles fragment shaders for AMD's GPUs without having one: by RADV, Mesa's Vulkan driver."""

import os
import re
import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from vexture.renderers.shader import vertex_source

PACKAGES: Final = {"cc": "gcc", "glslangValidator": "glslang-tools"}
DRIVERS: Final = [Path(root) / "vulkan/icd.d" for root in ("/usr/share", "/usr/local/share", "/etc")]
PRINTER: Final = Path(__file__).with_name("compile_for_gpu.c")
GLSLANG: Final = ("glslangValidator", "-V", "-R", "--aml", "--amb", "--sbs", "gl_DefaultUniformBlock", "push_constant")
KEYWORDS: Final = ("-Dshared=shared_",)
"""Names in the shaders that are keywords in Vulkan's dialect only."""


class ToolchainError(Exception):
    """A tool or driver is not installed; the message names it in one line."""


@dataclass(frozen=True, slots=True)
class CompiledShader:
    """A compiled fragment shader, with the driver's statistics.

    Parameters
    ----------
    driver : str
        Its version, and the GPU that it compiled for.
    statistics : mapping
        Numbers by the driver's names, such as ``Instructions`` and ``VGPRs``.
    assembly : str
        The program.
    """

    driver: str
    statistics: Mapping[str, int]
    assembly: str


@dataclass(frozen=True, slots=True)
class Toolchain:
    """The compilers, in a folder of their own."""

    folder: Path
    driver: str

    def compile_shader(self, name: str, fragment: str, gpu: str) -> CompiledShader:
        """Compile a fragment shader of OpenGL for a GPU, which has RADV's name."""
        stages = [self.spirv(f"{name}.vert", vertex_source("330")), self.spirv(f"{name}.frag", fragment)]
        settings = {"VK_ICD_FILENAMES": self.driver, "RADV_FORCE_FAMILY": gpu, "MESA_SHADER_CACHE_DISABLE": "true"}
        printed = run_command([str(self.folder / "printer"), *stages], settings)
        parts = re.split(r"^=== (.*)\n", printed, flags=re.MULTILINE)
        texts = dict(zip(parts[1::2], parts[2::2], strict=True))
        statistics = {key: int(value) for key, value in re.findall(r"^(.+)\t(\d+)$", texts["statistics"], re.MULTILINE)}
        return CompiledShader(texts["driver"].strip(), statistics, texts["Assembly"])

    def spirv(self, file: str, text: str) -> str:
        """Translate a shader, and return the result's path; the suffix of `file` is its stage."""
        path = self.folder / file
        path.write_text(text)
        run_command([*GLSLANG, *KEYWORDS, str(path), "-o", f"{path}.spv"])
        return f"{path}.spv"


def run_command(command: Sequence[str], settings: Mapping[str, str] | None = None) -> str:
    """Run a command; return its output. Raises `RuntimeError` with all of its output if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **(settings or {})})
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)} ended with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


@contextmanager
def toolchain() -> Iterator[Toolchain]:
    """Prepare the compilers, and remove them afterwards.

    Raises
    ------
    ToolchainError
        If the driver, glslangValidator, a C compiler or Vulkan's headers are not installed.
    """
    for program, package in PACKAGES.items():
        if not shutil.which(program):
            raise ToolchainError(f"there is no {program} (Debian's package {package})")
    found = [str(file) for folder in DRIVERS for file in sorted(folder.glob("radeon_icd*.json"))]
    if not found:
        raise ToolchainError("there is no Vulkan driver radeon_icd*.json (Debian's package mesa-vulkan-drivers)")
    with TemporaryDirectory() as folder:
        try:
            run_command(["cc", str(PRINTER), "-lvulkan", "-o", f"{folder}/printer"])
        except RuntimeError as error:
            why = str(error).splitlines()[0]
            raise ToolchainError(
                f"no program for Vulkan can be made (Debian's package libvulkan-dev): {why}"
            ) from error
        yield Toolchain(Path(folder), found[0])
