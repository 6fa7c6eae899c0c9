import inspect
import re
from importlib import resources
from types import SimpleNamespace

import pytest
from hand import TREE, need_gpu, texture_of

from vexture.fold import blend as folding
from vexture.renderers import (
    blend,
    cells,
    colour,
    cpu,
    feature,
    flat,
    gradient,
    leaf,
    moment,
    paints,
    piece,
    pixels,
    splines,
)
from vexture.renderers.device import context
from vexture.renderers.shader import VERSIONS, read_shader, vertex_source
from vexture.thesis import cpu as thesis_cpu
from vexture.thesis import cubic
from vexture.thesis.shader_text import PACKAGE, TextureSizes, view_source


def _files(package):
    return {file.name: file.read_text() for file in (resources.files(package) / "shaders").glob("*.glsl")}


FILES = {
    **_files("vexture"),
    **{f"thesis/{name}": text for name, text in _files("vexture.thesis").items()},
}
DEFINITION = re.compile(r"^\w+ (\w+)\(\s*([^()]*?)\s*\) \{$", re.MULTILINE)
STRUCT = re.compile(r"^struct (\w+) \{(.*?)^\};", re.MULTILINE | re.DOTALL)
MIRROR = dict.fromkeys(FILES, cpu) | {
    **{name: thesis_cpu for name in FILES if name.startswith("thesis/")},
    "thesis/cubic.glsl": cubic,
    "tree.glsl": cells,
    "flat.glsl": flat,
    "pixel.glsl": piece,
    "piece.glsl": piece,
    "view.glsl": piece,
    "blend.glsl": SimpleNamespace(**{**vars(blend), **vars(gradient)}),
    "colour.glsl": colour,
    "gradient.glsl": gradient,
    "picture.glsl": pixels,
    "spline.glsl": splines,
    "srgb.glsl": paints,
    "paints.glsl": paints,
    "moment.glsl": moment,
    "feature.glsl": feature,
    "leaf.glsl": leaf,
    "view_color.glsl": colour,
    "fold.glsl": folding,
}
# only the web's, judged by its pixels (tests/web) and by decoded trees (test_packed_overlay.py)
WITHOUT_MIRROR = {
    "around.glsl",
    "depths.glsl",
    "layers.glsl",
    "overlay.glsl",
    "sheets.glsl",
    "wrap.glsl",
    "shore.glsl",
    "steps.glsl",
    "water.glsl",
}
MIRRORED = {name: text for name, text in FILES.items() if name not in WITHOUT_MIRROR}
ALONE = {
    "fetch",
    "vexture_add_pieces",
    "vexture_add_flat_pieces",
    "vexture_mod",
}  # functions of the shader for which the mirror has no use
UNIFORMS = [
    "texels",
    "flat_view",
    "is_linear",
    "root",
    "base",
    "quads",
    "curves",
    "to_unit",
    "time",
    "cycle",
    "now",
    "wrap",
]  # which the mirror passes on
PLAIN = {
    "vextureCoverage": "coverage",
    "vextureColor": "color",
    "vextureFlat": "flat",
    "vextureFlatCoverage": "flat_coverage",
    "vextureFlatColor": "flat_color",
    "vextureFold": "fold",
    "vextureFeature": "feature",
    "from": "start",
    "Cell": "ThesisCell",
    "VextureFolded": "Folded",
}  # which Python would name otherwise, or not at all


@pytest.mark.parametrize("version", VERSIONS)
def test_the_shader_compiles_in_both_dialects(version: str) -> None:
    need_gpu()
    fragment = view_source(version, TextureSizes.of_texture(texture_of(TREE)))
    assert fragment.startswith(f"#version {version}\n")
    with context() as gl:
        gl.program(vertex_shader=vertex_source(version), fragment_shader=fragment).release()


@pytest.mark.parametrize("name", FILES)
def test_a_file_defines_what_it_says_and_nothing_that_its_user_must(name: str) -> None:
    text = FILES[name]
    exports = re.search(r"^// Exports: (.*)\.$", text, re.MULTILINE)
    assert exports, "the header lists the exports"
    defined = {match[0] for match in DEFINITION.findall(text)} | {match[0] for match in STRUCT.findall(text)}
    assert set(exports[1].split(", ")) <= defined
    assert "#version" not in text
    assert "void main" not in text


def test_every_file_is_joined_once() -> None:
    joined = read_shader("view.glsl", PACKAGE)
    names = [match[0] for match in DEFINITION.findall(joined)]
    assert len(names) == len(set(names))
    assert "#include" not in joined
    assert (
        joined.index("Roots solve_cubic(") < joined.index("bool inside_curve(") < joined.index("float view_coverage(")
    )


@pytest.mark.parametrize("name", ["nowhere.glsl", "../shaders.py"])
def test_an_unknown_include_is_refused(name: str) -> None:
    with pytest.raises(FileNotFoundError, match=re.escape(name)):
        read_shader(name)


def plain(name: str) -> str:
    """What the mirror calls it: it needs no prefix to keep its names apart from other people's."""
    return PLAIN.get(name, re.sub("^(vexture_|Vexture)", "", name))


def test_the_mirror_has_the_same_functions_with_the_same_arguments() -> None:
    for file, text in MIRRORED.items():
        for name, arguments in DEFINITION.findall(text):
            shader = [PLAIN.get(argument, argument) for argument in re.findall(r"(\w+)(?:,|$)", arguments)]
            if name not in ALONE and "uv" not in shader:  # the short forms
                mirror = list(inspect.signature(getattr(MIRROR[file], plain(name))).parameters)
                while mirror != shader and mirror[0] in UNIFORMS:
                    del mirror[0]
                assert mirror == shader, name


def test_the_mirror_has_the_same_structures() -> None:
    for file, text in MIRRORED.items():
        for name, body in STRUCT.findall(text):
            fields = tuple(re.findall(r"^ +\w+ (\w+);", body, re.MULTILINE))
            assert fields == getattr(MIRROR[file], PLAIN.get(name, name))._fields


def test_a_shader_file_is_included_once() -> None:
    assert read_shader("coverage.glsl").count("VexturePlace vexture_place(") == 1
