"""Code of kernels for another machine, from the text that Numba compiles them to."""

from collections.abc import Mapping, Sequence

import llvmlite.binding as llvm

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


def join_modules(texts: Sequence[str], exported: Mapping[str, str]) -> llvm.ModuleRef:
    """One module of several texts of LLVM; only functions that are exported can be called from outside.

    Parameters
    ----------
    texts : sequence of str
        What Numba's `inspect_llvm` says of kernels, and a run time for them.
    exported : mapping of str to str
        New names of functions in there, by their names.
    """
    module = llvm.parse_assembly(texts[0])
    for text in texts[1:]:
        module.link_in(llvm.parse_assembly(text))
    for function in module.functions:
        if not function.is_declaration:
            function.linkage = llvm.Linkage.external if function.name in exported else llvm.Linkage.internal
            function.name = exported.get(function.name, function.name)
    return module


def object_file(
    module: llvm.ModuleRef, machine: llvm.TargetMachine, optimiser: llvm.PassBuilder | None = None
) -> bytes:
    """Machine code of a module, without what no entry of it calls: the way in from Python is left out so.

    Numba has optimised the code for its own machine; an `optimiser` does so once more.
    """
    builder = optimiser or llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options())
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, builder)
    if optimiser:
        optimiser.getModulePassManager().run(module, optimiser)
    code: bytes = machine.emit_object(module)
    return code
