"""WGSL from the shader's GLSL, which stays the one source.

A parser reads a strict subset of GLSL: functions, structures, numbers, loops, ``switch`` without fall-through, arrays
of a fixed size, uniforms and ``#if``. Every expression gets a type, from which follows what WGSL wants written out:
conversions, brackets, ``select``, ``let`` and ``var``, copies of parameters that are changed. What is outside of the
subset is refused with the number of its line, never guessed at. Names, order and comments stay.

All uniforms become parameters, in the order of their declarations, as ``vextureCoverage(vextureTexels, root, ...)``.
`with_parameters` writes GLSL in the same form, for engines that name textures themselves. Where a function has two
forms, the one that is given more ends in ``From`` in WGSL.
"""

from wgsl_generator.parameters import with_parameters
from wgsl_generator.parser import parse
from wgsl_generator.writer import written

__all__ = ["to_wgsl", "with_parameters"]


def to_wgsl(text: str) -> str:
    """Return a shader's text in WGSL; its ``#if`` are left for `chosen`.

    Parameters
    ----------
    text : str
        GLSL, as `vexture.renderers.shader.shader_text` returns it.

    Raises
    ------
    ShaderError
        With the line of what has no meaning in WGSL.

    Examples
    --------
    >>> print(to_wgsl("float half_of(float x) { return 0.5 * x; }"), end="")
    fn half_of(x: f32) -> f32 {
        return 0.5 * x;
    }
    """
    return written(parse(text))
