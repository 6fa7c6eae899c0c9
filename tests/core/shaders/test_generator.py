"""What the generator writes, and what it refuses."""

import re
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

import vexture
from either_language import by_glsl, by_wgsl, device
from vexture.base.errors import DeviceError, ParameterError
from vexture.fold import layout as fold_layout
from vexture.renderers.device import context
from vexture.renderers.shader import PARTS, WRAPS, ShaderError, chosen, shader_text
from wgsl_generator import to_wgsl, with_parameters

GLSL = Path(vexture.__file__).parent / "shaders"
NO_PICTURE = {"view", "view_color", "view_coverage"}  # mains of Python's renderers; those of tests

REFUSED = {
    "float f(float x) {\n    return x + 1;\n}": (2, "float + int"),
    "float f(vec2 v) { return 1.0; }\nfloat g(vec2 v) { float y = v; return y; }": (2, "y is float, and is given vec2"),
    "float f(int n) { float y = n; return y; }": (1, "y is float, and is given int"),
    "float f(out float x) { return x; }": (1, "'out'"),
    "vec3 f(vec3 v) { v.xz += v.xy; return v; }": (1, "only components that follow each other"),
    "float f(float x) { return sinh(x); }": (1, "sinh of float is not in the subset"),
    "bool f(vec2 v) { return v < v.yx; }": (1, "vec2 < vec2"),
    "float f(bool b) { return b ? 1.0 : 2; }": (1, "a choice between float and int"),
    "float f(float x) { return x; }\nfloat f(int x) { return 1.0; }": (2, "two forms of 1 parameters"),
    "int f() { return 1; } int f(int x) { return x; } int f(int x, int y) { return x; }": (1, "3 forms"),
    "#if A > 2\nfloat f(float x) { return x; }\n#endif": (1, "stand only #define NAME NUMBER and #if"),
    "uvec2 f(uvec2 v, ivec2 w) { return v + w; }": (1, "uvec2 + ivec2"),
    "float f(float x) { do { x += 1.0; } while (x < 3.0); return x; }": (1, "'do'"),
    "float f(float x) { return y; }": (1, "y is not known"),
    "float f(float x) { return f; }": (1, "f is not known"),
    "float f(uint x) { return -x; }": (1, "-uint"),
    "float f(float x) { x = x = 2.0; return x; }": (1, "';' was expected"),
    "float f(float x) { if (x > 0.0) return 1.0; return x; }": (1, "'{' was expected"),
    "void f(inout int n) { n++; } int g(bool b) { int n = 0; return b ? h(n) : n; }": (1, "h"),
    "int h(inout int n) { n++; return n; } int g(bool b) { int n = 0; return b ? h(n) : n; }": (
        1,
        "which changes what",
    ),
    "struct S { int a; }; void f(inout int n) { n++; } int g(S s) { f(s.a); return s.a; }": (
        1,
        "a whole local variable",
    ),
    "int f(int n) { switch (n) { case 1: n = 2; case 3: return 1; } return n; }": (1, "must end by return or break"),
    "float f(mat4 m) { return 1.0; }": (1, "is no type of the subset"),
    "float f(float x) { vec2 v = vec2(x, x, x); return v.x; }": (1, "vec2 of float, float, float"),
    "vec2 f(vec2 v) { return v.zz; }": (1, "vec2 has no zz"),
    "uniform sampler2D t; vec4 f(vec2 v) { return texelFetch(t.x, ivec2(0), 0); }": (1, "sampler2D has no x"),
    "float f(float x) { return x": (1, "ends within a statement"),
    "float f(float x) {\n\n    return x @ 2.0; }": (3, "'@ 2.0; }' is no sign of GLSL"),
    "#define A(x) x": (1, "#define NAME NUMBER"),
}

WRITTEN = {
    "int f(int x) { return (x & 3) == 0 ? 1 : x >> 2; }": "return select(x >> 2u, 1, (x & 3) == 0);",
    "ivec2 f(ivec2 x) { return x & ~1; }": "return x & vec2i(~1);",
    "vec2 f(vec2 v) { v.x = 1.0; return v; }": "var v = v_given;\n    v.x = 1.0;",
    "vec3 f(vec3 v) { v.yz *= 2.0; return v; }": "v = vec3f(v.x, v.yz * (2.0));",
    "bool f(vec2 v) { return v == v.yx || any(lessThan(v, v.yx)); }": "return all(v == v.yx) || any(v < v.yx);",
    "bool f(bool a, bool b, int c) { return a ^^ b ^^ c > 1; }": "return (a != b) != (c > 1);",
    "bool f(bool a, bool b, bool c) { return a && b || c; }": "return (a && b) || c;",
    "bool f(bool a, bool b) { return a ^^ b; }": "return a != b;",
    "float f(float from) { float final = from; return final; }": "let final_: f32 = from_;",
    "vec2 f(bool b, vec2 v) { return clamp(v, 0.0, 1.0); }": "return clamp(v, vec2f(0.0), vec2f(1.0));",
    "uint f(int n) { return uint(n) << (n + 1); }": "return u32(n) << u32(n + 1);",
    "float f(float x) { return x - (x - 1.0); }": "return x - (x - 1.0);",
    "uniform float t; float f() { return t; } float g() { return f(); }": "fn g(t: f32) -> f32 {\n    return f(t);",
    "float f(float x, int n) { return x; } float f(float x) { return f(x, 1); }": "return fFrom(x, 1);",
    "uniform sampler2D t; vec4 f(vec2 v) { return texture(t, v); }": "return textureSample(t, t_sampler, v);",
    "float f() { return gl_FragCoord.w; }": "return vexture_fragment.w;",
    "vec4 f(mat3 m, vec2 v) { return vec4(m * vec3(v, 1.0), m[0].z); }": "return vec4f(m * vec3f(v, 1.0), m[0].z);",
}


@pytest.mark.parametrize("text", REFUSED)
def test_what_it_does_not_know_is_refused_with_its_line(text: str) -> None:
    line, reason = REFUSED[text]
    with pytest.raises(ShaderError, match=f"line {line}: ") as caught:
        to_wgsl(text)
    assert reason in str(caught.value)
    assert caught.value.line == line


@pytest.mark.parametrize("text", WRITTEN)
def test_what_wgsl_asks_for_is_written_out(text: str) -> None:
    assert WRITTEN[text] in to_wgsl(text)


@pytest.mark.parametrize("path", sorted(GLSL.glob("*.glsl")), ids=lambda path: path.stem)
def test_every_file_is_taken_with_its_comments(path: Path) -> None:
    text = shader_text(path.name, fold_layout)
    found, handed = to_wgsl(text), with_parameters(text)
    own = [line.strip() for line in path.read_text().splitlines() if line.startswith("//")]
    assert own
    assert [line for line in own if line not in found] == []
    names = set(re.findall(r"^(?!const|uniform)\w+ (\w+)\(", path.read_text(), re.MULTILINE))
    assert names
    assert {name for name in names if not re.search(rf"^fn {name}(From)?\(", found, re.MULTILINE)} == set()
    assert "uniform" not in re.sub(r"//.*", "", handed)
    assert max(map(len, found.splitlines())) <= 130


def test_a_choice_of_numbers_leaves_no_conditional() -> None:
    text = to_wgsl(shader_text("sheets.glsl"))
    wraps = {f"VEXTURE_WRAP_{name.upper()}": value for name, value in WRAPS.items()}
    rest = {"VEXTURE_FLAT": 0, "VEXTURE_LINEAR": 1, "VEXTURE_GRADIENTS": 0, "VEXTURE_WRAP": 2}
    found = chosen(text, {**wraps, **rest})
    left = [line for line in found.splitlines() if line.startswith("#") or "vexture_program(" in line]
    assert left == []
    assert "vexture_tiles(" in found
    with pytest.raises(ShaderError, match="VEXTURE_LINEAR is not chosen"):
        chosen(text, {name: value for name, value in {**wraps, **rest}.items() if name != "VEXTURE_LINEAR"})


@pytest.mark.parametrize("part", PARTS)
def test_each_part_is_to_be_had_in_each_language(part: str) -> None:
    for version in ("300 es", "wgsl"):
        text = vexture.shader_source(version, part, wrap="repeat", gradients=False)
        assert ("fn " in text) == (version == "wgsl")
        assert version != "wgsl" or "#" not in text
    for wrap in ("tile", ["none"]):
        with pytest.raises(ParameterError, match=r"`wrap` is .*; there are"):
            vexture.shader_source("wgsl", part, wrap=wrap)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("text", "written"),
    [("a < b >> 1", "a < (b >> 1u)"), ("a + 1 < (b >> a) || d", "a + 1 < (b >> u32(a)) || d"), ("a < b", "a < b")],
)
def test_less_than_begins_no_template(text: str, written: str) -> None:
    """WGSL would take what is between ``<`` and ``>`` for the arguments of a type."""
    assert f"return {written};" in to_wgsl(f"bool f(int a, int b, bool d) {{ return {text}; }}")


def test_less_than_begins_no_template_between_commas() -> None:
    text = "bool both(bool a, bool b) { return a && b; }\nbool f(int a, int b) { return both(a < b, b > a); }"
    assert "both((a < b), b > a)" in to_wgsl(text)


# --- random expressions: both languages must compute the same of them

NAMES = {"int": ["a", "b"], "uint": ["c", "6u"], "bool": ["d", "e"], "float": ["x", "y"]}
SIGNS = {"int": "+ - * & | ^", "uint": "+ - * & | ^", "float": "+ - *", "bool": "&& || ^^"}
COMPARED = ["<", ">", "<=", ">=", "==", "!="]
GIVEN = "n - 4, 2 * n + 1, uint(n), (n & 1) == 0, (n & 2) == 0, float(n - 3), 0.5 * float(n)"
PARAMETERS = "int a, int b, uint c, bool d, bool e, float x, float y"


def expression(of: Random, type_: str, depth: int) -> str:
    """GLSL of a type, with brackets here and there; no division, and floats of few bits, so that all is exact."""
    if depth == 0:
        return of.choice(NAMES[type_])

    def part(one: str = type_) -> str:
        text = expression(of, one, depth - 1)
        return f"({text})" if of.random() < 0.6 or "?" in text else text

    kind = of.choice(["sign", "sign", "sign", "choice", "before", "other"])
    if kind == "choice":
        return f"{part('bool')} ? {part()} : {part()}"
    if kind == "before" and type_ != "uint":
        return f"{'!' if type_ == 'bool' else '-'}({part()})"
    if kind == "other" and type_ in ("int", "uint"):
        return f"(({part()}) {of.choice(['<<', '>>'])} ({of.choice(['a', 'b'])} & 3))"
    if kind == "other" and type_ == "bool":
        one = of.choice(["int", "uint", "float"])
        return f"(({part(one)}) {of.choice(COMPARED)} ({part(one)}))"
    return f"{part()} {of.choice(SIGNS[type_].split())} {part()}"


# no smaller example: each takes a program in two languages
@settings(max_examples=4, phases=[Phase.explicit, Phase.reuse, Phase.generate])
@given(st.integers(0, 2**32))
def test_random_expressions_mean_the_same(seed: int) -> None:
    device()
    try:
        context()
    except DeviceError as error:
        pytest.skip(str(error))
    of, count = Random(seed), 40
    types = [of.choice(list(NAMES)) for _ in range(count)]
    texts = [expression(of, type_, 3) for type_ in types]
    functions, cases = "", ""
    for k, (type_, text) in enumerate(zip(types, texts, strict=True)):
        returned = "found ? 1.0 : 0.0" if type_ == "bool" else "float(found)"
        functions += f"float one{k}({PARAMETERS}) {{\n    {type_} found = {text};\n    return {returned};\n}}\n"
        cases += f"    if (which == {k}) {{\n        return vec4(one{k}({GIVEN}));\n    }}\n"
    place = "    int which = int(pixel.x);\n    int n = int(pixel.y);\n"
    text = f"{functions}vec4 shown(vec2 pixel) {{\n{place}{cases}    return vec4(0.0);\n}}\n"
    one, other = by_glsl(text, (), {}, (count, 8)), by_wgsl(text, (), {}, (count, 8))
    wrong = [texts[k] for k in range(count) if not np.allclose(one[:, k], other[:, k], rtol=1e-6, atol=0.0)]
    assert wrong == []
