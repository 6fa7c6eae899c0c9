"""Write web/generated/, the shaders' text and the textures' layout as JavaScript, and the shader's parts in WGSL.

Their owners are the folders shaders/ and the modules layout.py of vexture; nothing in web/ types any of it again.
`make_web.py --check` writes nothing and fails when a file is not what it would write.
"""

import json
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Final

from both_languages import both
from vexture.base import layout, pixels
from vexture.base.tolerance import CLOSED, ROUND
from vexture.drawing.unit_square import FARTHEST
from vexture.fold import layout as fold_layout
from vexture.renderers.shader import PARTS, WRAPS, read_shader, shader_text
from vexture.svg import images, paint_servers, pattern_tiles, scene, values
from vexture.svg.animations import ANIMATIONS
from vexture.svg.document import LANGUAGE, MOST_ATTRIBUTES
from vexture.svg.filters import STEP
from vexture.svg.painter import MOST_SEGMENTS
from vexture.svg.pictures import MOST_TEXELS, PIXELATED
from vexture.svg.properties import BLENDS
from vexture.svg.space import MOST_MASKS
from vexture.svg.strokes import MOST_DASHES
from vexture.thesis import layout as thesis_layout
from vexture.thesis import method as thesis_method
from vexture.thesis.shader_text import FOLD_HEIGHT, PACKAGE, constants
from wgsl_generator import to_wgsl, with_parameters

ROOT: Final = Path(__file__).resolve().parents[1]
FOLDER: Final = ROOT / "web" / "generated"
WGSL: Final = ROOT / "packages" / "vexture" / "src" / "vexture" / "shaders" / "wgsl"
HEADER: Final = "// Made by tools/make_web.py; change {owner} and run it again.\n"

PACKED: Final = "layers.glsl"
"""The file whose functions read packed textures without planar maps."""

PLANAR: Final = "sheets.glsl"
"""The file whose functions read all of them."""

OVERLAY: Final = "overlay.glsl"
"""Stands after either of them."""

NUMBERED: Final = "{}; the numbers that it asks for by #ifndef may be defined before it."

COMMENT: Final = re.compile(r"[ \t]*//.*$", re.MULTILINE)

BOTH: Final = ", in GLSL and WGSL: of @GLSL$WGSL` one side is to be picked."
"""Ends the comments of texts in two languages."""

GLOBAL: Final = re.compile(
    r"^(?:const |uniform |struct )?(?:\w+ )?(\w+)(?=\(.*[,{]$|\[\d+\] = | = .*;$|;| \{$)", re.MULTILINE
)
"""The name that a line defines outside of functions, where nothing stands before it."""

THESIS_PREFIX: Final = "thesis_"

NUMBERS: Final = re.compile(r"(?:#define .*\n)*")
"""Named numbers, at the top of a text."""

SPACES: Final = re.compile(r"(?<![+-]) +(?=[^\w\s])|(?<=[^\w\s]) +(?![+-])")
"""Those between two words, and between two signs, stay."""


WORDS: Final = re.compile(r"\w\w|\+\+|--")
"""An end and a beginning that must not meet."""

ENDS: Final = re.compile(r"\};?$|\S.*;$")
"""What ends something outside of functions: nothing stands before it."""


def apart(text: str) -> str:
    """Shader text whose global names begin with a prefix, to stand in one program with other people's."""
    names = set(GLOBAL.findall(COMMENT.sub("", text))) | {"LEVELS", "FOLD_HEIGHT"}
    return re.sub(rf"\b({'|'.join(sorted(names))})\b", rf"{THESIS_PREFIX}\1", text)


def bare(text: str) -> str:
    """Shader text without comments, and without breaks and spaces that separate nothing: nobody reads it in a bundle.

    A function is one line, since compilers name the line of an error.
    """
    bared = ""
    for line in COMMENT.sub("", text).splitlines():
        stripped = line.strip()
        if stripped.startswith("#"):
            bared += ("" if bared.endswith("\n") else "\n") + f"{stripped}\n"
        elif stripped:
            bared += (" " if WORDS.search(f"{bared[-1:]}{stripped[0]}") else "") + SPACES.sub("", stripped)
            bared += "\n" if ENDS.match(line) else ""
    return bared.lstrip("\n") + ("" if bared.endswith("\n") else "\n")


def inline_numbers(text: str) -> str:
    """Shader text with the values of its defined numbers in place of their names."""
    numbers = NUMBERS.match(text)
    assert numbers
    values = dict(line.split()[1:] for line in numbers[0].splitlines())
    values |= {name: f"({value})" for name, value in values.items() if value.startswith("-")}
    return re.sub(r"\bVEXTURE_\w+", lambda name: values.get(name[0], name[0]), text[numbers.end() :])


def used(declarations: str, text: str) -> str:
    """Those declarations of constants that a text names."""
    names = set(re.findall(r"\w+", text))
    return "".join(f"{line}\n" for line in declarations.splitlines() if names & set(re.findall(r"\w+(?= =|\[)", line)))


def module_text(name: str, text: str, comment: str, before: str = "") -> str:
    """Return an export of shader text; its type keeps the text out of the package's declarations."""
    return f"/**\n * {comment}\n *\n * @type {{string}}\n */\nexport const {name} = {before}{json.dumps(text)};\n"


def packed_text(file: str) -> str:
    """Text of a file that reads a packed texture, and of all that it includes."""
    return bare(inline_numbers(shader_text(file)))


def shaders() -> str:
    """Text of the module with the shaders, but for those of planar maps."""
    parts = [HEADER.format(owner="packages/vexture/src/vexture/shaders/")]
    packed = packed_text(PACKED)
    parts.append(module_text("packed", packed, NUMBERED.format(PACKED)))
    alone = packed_text(OVERLAY).removeprefix(packed)
    parts.append(module_text("overlay", alone, f"{OVERLAY}, to stand after that or after {PLANAR}."))
    comment = "steps.glsl: what the derivatives of a position are, for pixels."
    parts.append(module_text("steps", bare(read_shader("steps.glsl")), comment))
    return "".join(parts)


def planar_module() -> str:
    """Text of the module with what planar maps add: apart, since a page without one has no use for it."""
    packed, planar = packed_text(PACKED), packed_text(PLANAR)
    assert planar.startswith(packed), f"{PLANAR} must include {PACKED} first: a bundle has its text once"
    comment = f"{PLANAR}, to stand after {PACKED}; the numbers that it asks for by #ifndef may be defined before both."
    return HEADER.format(owner="packages/vexture/src/vexture/shaders/") + module_text(
        "planar", planar.removeprefix(packed), comment
    )


def thesis_module() -> str:
    """Text of the module with the thesis's shader: apart, since most pages have no use for it."""
    coverage = read_shader("coverage.glsl", PACKAGE)
    text = bare(apart(used(constants(thesis_layout) + constants(thesis_method), coverage) + coverage))
    comment = (
        "coverage.glsl; its names begin with thesis_, and const int thesis_LEVELS and thesis_FOLD_HEIGHT must\n"
        " * stand before it."
    )
    return (
        HEADER.format(owner="packages/vexture/src/vexture/thesis/shaders/")
        + module_text("thesis", text, comment)
        + (
            "/** Rows of a texture on the GPU: a longer list goes on in the columns to its right. */\n"
            f"export const FOLD_HEIGHT = {FOLD_HEIGHT};\n"
        )
    )


def water_module() -> str:
    """Text of the module with the water's shaders: apart, since most pages have no use for them."""
    parts = [HEADER.format(owner="packages/vexture/src/vexture/shaders/")]
    for name in ("water", "shore", "depths"):
        comment = f"{name}.glsl; VEXTURE_WRAP and VEXTURE_FLAT may be defined before it."
        parts.append(module_text(name, bare(inline_numbers(shader_text(f"{name}.glsl"))), comment))
    return "".join(parts)


def fold_module() -> str:
    """Text of the module with the shader of folds: apart, since a page without one has no use for it."""
    text = bare(inline_numbers(shader_text("fold.glsl", fold_layout)))
    comment = "fold.glsl; VEXTURE_WRAP may be defined before it."
    return HEADER.format(owner="packages/vexture/src/vexture/shaders/fold.glsl") + module_text("fold", text, comment)


def nodes_module(name: str, comment: str, text: str, before: str = "") -> str:
    """Text of a module with the shader in both languages, for three.js's nodes: what a text has beyond another."""
    glsl, wgsl = (
        translated(text).removeprefix(translated(before)) if before else translated(text)
        for translated in (with_parameters, to_wgsl)
    )
    return HEADER.format(owner="packages/vexture/src/vexture/shaders/") + module_text(
        name, both(glsl, wgsl, bare), comment
    )


def wraps_module() -> str:
    """Text of the module with the values of ``VEXTURE_WRAP``: apart, since not all that choose one bring the shader."""
    text = f"/** Values of VEXTURE_WRAP. */\nexport const WRAPS = Object.freeze({json.dumps(WRAPS)});\n"
    return HEADER.format(owner="packages/vexture/src/vexture/renderers/method.py") + text


def layout_module(owner: ModuleType, file: str) -> str:
    """Text of the module with a layout."""
    parts = [HEADER.format(owner=f"packages/vexture/src/vexture/{file}")]
    for name in filter(str.isupper, sorted(vars(owner))):
        value = getattr(owner, name)
        text = json.dumps(value)
        frozen = f"Object.freeze({text})" if isinstance(value, tuple | dict) else text
        parts.append(f"export const {name} = {frozen};\n")
    return "".join(parts)


def reader_module() -> str:
    """Text of the module with the words and limits that the reader of SVG in Python shares with the one in a page."""
    named = {
        "ANIMATIONS": sorted(ANIMATIONS),
        "BLENDS": list(BLENDS),
        "CLOSED": CLOSED,
        "CONTAINERS": sorted(scene.CONTAINERS),
        "DEEPEST": scene.DEEPEST,
        "FARTHEST": FARTHEST,
        "FILTER_STEPS": [f"fe{name}" for name in STEP.pattern[3:-1].split("|")],
        "LANGUAGE": LANGUAGE,
        "LARGEST": values.LARGEST,
        "MOST_ATTRIBUTES": MOST_ATTRIBUTES,
        "MOST_DASHES": MOST_DASHES,
        "MOST_MASKS": MOST_MASKS,
        "MOST_FILE_PIXELS": pixels.MOST_PIXELS,
        "MOST_PICTURE_PIXELS": images.MOST_PIXELS,
        "MOST_PICTURE_TEXELS": MOST_TEXELS,
        "MOST_SEGMENTS": MOST_SEGMENTS,
        "MOST_STOPS": paint_servers.MOST_STOPS,
        "MOST_TILED": pattern_tiles.MOST,
        "MOST_USED": scene.MOST_USED,
        "PIXELATED": sorted(PIXELATED),
        "PIXELS": values.PIXELS,
        "ROUND": ROUND,
        "UNKNOWN_SERVERS": paint_servers.UNKNOWN,
        "UNPAINTED": sorted(scene.UNPAINTED),
    }
    types = {"MOST_TILED": "number", "PIXELS": "number", "UNKNOWN_SERVERS": "string"}
    parts = [HEADER.format(owner="packages/vexture/src/vexture/svg/")]
    for name, value in named.items():
        if isinstance(value, dict):
            parts.append(f"/** @type {{Readonly<Record<string, {types[name]}>>}} */\n")
        parts.append(f"export const {name} = {json.dumps(value)};\n")
    return "".join(parts)


def main() -> int:
    """Write the files, or with --check compare them; the exit code."""
    stale = []
    layers, sheets = (inline_numbers(shader_text(file)) for file in (PACKED, PLANAR))
    folded = inline_numbers(shader_text("fold.glsl", fold_layout))
    steps = read_shader("steps.glsl")
    modules = {
        "svg-reader.js": reader_module(),
        "coverage-nodes.js": nodes_module("coverage", f"layers.glsl and steps.glsl{BOTH}", steps + layers),
        "colour-nodes.js": nodes_module(
            "colour", f"sheets.glsl, to stand after these{BOTH}", steps + sheets, steps + layers
        ),
        "fold-nodes.js": nodes_module("fold", f"fold.glsl{BOTH}", folded),
        "layout.js": layout_module(layout, "base/layout.py"),
        "thesis-layout.js": layout_module(thesis_layout, "thesis/layout.py"),
        "fold-layout.js": layout_module(fold_layout, "fold/layout.py"),
        "shaders.js": shaders(),
        "planar-shader.js": planar_module(),
        "thesis-shader.js": thesis_module(),
        "fold-shader.js": fold_module(),
        "wraps.js": wraps_module(),
        "water-shader.js": water_module(),
    }
    files = {FOLDER / name: text for name, text in modules.items()}
    files |= {WGSL / f"{part}.wgsl": to_wgsl(shader_text(file)) for part, file in PARTS.items()}
    for path, text in files.items():
        if path.is_file() and path.read_text(encoding="utf-8") == text:
            continue
        if sys.argv[1:] == ["--check"]:
            stale.append(str(path.relative_to(ROOT)))
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
    if stale:
        print(f"stale: {', '.join(stale)}; run python tools/make_web.py", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
