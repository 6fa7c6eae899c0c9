"""The compiler of shaders for GPUs of AMD, where it is installed."""

import shutil

import pytest

import gpu_cost
from vexture_evidence.measures import gpu_compiler
from vexture_evidence.measures.gpu_model import FAMILIES, read_program


@pytest.mark.parametrize("family", FAMILIES)
def test_the_driver_compiles_the_loops_that_are_counted(family):
    try:
        with gpu_compiler.toolchain() as tools:
            made = {
                name: tools.compile_shader(name, gpu_cost.SOURCES[name], FAMILIES[family].name)
                for name in gpu_cost.SHAPES
            }
    except gpu_compiler.ToolchainError as error:
        pytest.skip(str(error))
    for name, shape in gpu_cost.SHAPES.items():
        found = read_program(name, made[name].assembly, shape)
        assert sum(len(block.lines) for block in found.blocks) == made[name].statistics["Instructions"]


@pytest.mark.parametrize("lacking", ["cc", "radeon_icd"])
def test_what_is_missing_is_named_in_one_line(lacking, monkeypatch, capsys):
    if lacking == "cc":
        monkeypatch.setenv("PATH", "")
    elif not all(map(shutil.which, gpu_compiler.PACKAGES)):
        pytest.skip("the compilers are missing, and that is named first")
    monkeypatch.setattr(gpu_compiler, "DRIVERS", [])
    monkeypatch.setattr("sys.argv", ["gpu_cost.py"])
    gpu_cost.main()
    printed = capsys.readouterr().out
    assert printed.startswith("skipped: there is no ")
    assert lacking in printed
    assert printed.count("\n") == 1
