"""The shader in WGSL beside the same in GLSL, every pixel of all fixtures and example drawings, in wgpu and in OpenGL.

python packages/vexture-evidence/benchmarks/wgsl.py [--quick]
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np

ROOT: Final = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tests"))

import either_language as languages  # noqa: E402
import vexture  # noqa: E402
from vexture.base.errors import EXPECTED  # noqa: E402
from vexture.renderers.shader import shader_text  # noqa: E402
from vexture.renderers.uniforms import uniforms_of  # noqa: E402
from vexture.renderers.view import fit, window  # noqa: E402

SIZE: Final = (64, 64)
SHAPE: Final = shader_text("view_coverage.glsl") + "\nvec4 shown(vec2 pixel) { return vec4(view_coverage(pixel)); }\n"
MAP: Final = shader_text("view_color.glsl") + "\nvec4 shown(vec2 pixel) { return view_color(pixel); }\n"


def views() -> dict[str, Any]:
    """Upright, turned, near and tilted."""
    tilted = fit(SIZE)
    tilted[2] = [0.0, 2e-2, 0.1]
    turned, near = window(0.1, 0.0, 0.9, 0.9, 30.0), window(0.4, 0.4, 0.02, 0.02)
    return {"whole": fit(SIZE), "turned": turned.matrix(SIZE), "50 times": near.matrix(SIZE), "tilted": tilted}


def pictures(source: Path) -> Iterator[tuple[str, Any, Any]]:
    """Each root of a drawing in each view, in WGSL and in GLSL."""
    texture = vexture.convert(vexture.read(source))
    for place, root in enumerate(texture.roots):
        for name, view in views().items():
            found = uniforms_of(texture, SIZE, view, place)
            given = {"vextureTexels": texture.texels, "to_unit": found.to_unit, "base": found.base, "root": found.quad}
            chosen = {"FLAT": int(found.is_flat), "WRAP": 0, "GRADIENTS": 1, "LINEAR": 0}
            numbers = tuple((f"VEXTURE_{key}", value) for key, value in chosen.items())
            text = MAP if root.is_map else SHAPE
            yield name, *(draw(text, numbers, given, SIZE) for draw in (languages.by_wgsl, languages.by_glsl))


def main() -> None:
    """Print the largest difference of each view, in 255ths."""
    folders = (ROOT / "examples" / "shapes", ROOT / "tests" / "core" / "svg" / "fixtures")
    files = [path for folder in folders for path in sorted(folder.rglob("*.svg"))][
        :: 20 if "--quick" in sys.argv else 1
    ]
    worst: dict[str, list[float]] = {name: [] for name in views()}
    read = 0
    for path in files:
        try:
            found = [(name, float(np.abs(one - other).max())) for name, one, other in pictures(path)]
        except EXPECTED:
            continue  # fixtures of errors
        read += 1
        for name, most in found:
            worst[name].append(255 * most)
    print(f"{read} of {len(files)} drawings, {sum(map(len, worst.values()))} pictures of {SIZE[0]} x {SIZE[1]}")
    for name, each in worst.items():
        print(f"{name:10} largest {max(each):.4f} of 255, median of the largest {np.median(each):.5f}")


if __name__ == "__main__":
    main()
