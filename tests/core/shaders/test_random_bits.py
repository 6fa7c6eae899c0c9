"""WGSL on textures of random bits, which no loader has looked at: each pixel comes to an end, and the device stays."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from either_language import by_wgsl, device
from vexture import convert
from vexture.renderers.shader import shader_text
from vexture.renderers.uniforms import uniforms_of
from vexture.renderers.view import fit
from vexture.texture.texture import Texture

ROOT = Path(__file__).parents[3]
SIZE = (64, 64)
NUMBERS = (("VEXTURE_FLAT", 0), ("VEXTURE_WRAP", 0), ("VEXTURE_GRADIENTS", 2), ("VEXTURE_LINEAR", 0))
SHOWN = {
    "view_coverage.glsl": "\nvec4 shown(vec2 pixel) { return vec4(view_coverage(pixel)); }\n",
    "view_color.glsl": "\nvec4 shown(vec2 pixel) { return view_color(pixel); }\n",
}


@pytest.fixture(scope="module")
def colours() -> Texture:
    device()
    return convert(str(ROOT / "tests" / "core" / "svg" / "fixtures" / "groups" / "nested.svg"))


def random_bits(rng: np.random.Generator, texels: NDArray[np.uint32]) -> NDArray[np.uint32]:
    """Texels of random bits, all or some of them, or one bit of some of them."""
    found: NDArray[np.uint32] = np.array(texels)
    kind = rng.integers(4)
    if kind == 0:
        return rng.integers(0, 2**32, (*rng.integers(1, 40, 2), 4), np.uint32)
    if kind == 1:
        return np.full((64, 64, 4), rng.integers(0, 2**32, dtype=np.uint32))
    where = rng.random(found.shape) < rng.choice((0.001, 0.05, 0.5))
    bits = rng.integers(0, 2**32, found.shape, np.uint32) if kind == 2 else 1 << rng.integers(0, 32, found.shape)
    found[where] ^= bits[where].astype(np.uint32)
    return found


@pytest.mark.parametrize("seeds", [range(4), pytest.param(range(4, 150), marks=pytest.mark.slow)], ids=["few", "many"])
def test_every_pixel_comes_to_an_end(colours: Texture, seeds: range) -> None:
    """The limit of the test's time ends a loop without end."""
    uniforms = uniforms_of(colours, SIZE, fit(SIZE), 0)
    given = {"to_unit": uniforms.to_unit, "base": uniforms.base, "root": uniforms.quad}
    before = {name: drawn(name, shown, given, colours.texels) for name, shown in SHOWN.items()}
    for seed in seeds:
        texels = random_bits(np.random.default_rng(seed), colours.texels)
        for name, shown in SHOWN.items():
            assert drawn(name, shown, given, texels).shape == (64, 64, 4)
    for name, shown in SHOWN.items():
        np.testing.assert_array_equal(drawn(name, shown, given, colours.texels), before[name], "the device stays")


def drawn(name: str, shown: str, given: dict[str, object], texels: NDArray[np.uint32]) -> NDArray[np.float32]:
    """Picture of texels by the shader of a name."""
    return by_wgsl(shader_text(name) + shown, NUMBERS, given | {"vextureTexels": texels}, SIZE)
