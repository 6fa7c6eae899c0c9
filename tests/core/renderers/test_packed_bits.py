"""Packed textures that no encoder would write: whatever the bits, drawing ends, with numbers from 0 to 1."""

import re
from functools import partial
from typing import Any

import numpy as np
import pytest
from hand import need_gpu
from hypothesis import example, given, settings
from hypothesis import strategies as st
from packed_views import TILTED, View, turned_view

from vexture.base.layout import MOST_CURVES, MOST_DEPTH, MOST_PROGRAM, MOST_STOPS
from vexture.renderers import cells, gpu
from vexture.renderers.cells import texel
from vexture.renderers.colour import render_cpu_colours
from vexture.renderers.cpu import render_cpu
from vexture.renderers.device import VERSION, compile_shader, context
from vexture.renderers.gpu import render_gpu, render_gpu_colours
from vexture.renderers.method import LONG, MOST_PARTS, MOST_RAMP_PARTS, STEPS
from vexture.renderers.shader import color_source, view_source
from vexture.renderers.view import fit, window
from vexture.texture.texture import Root, Texture

ALL_ONES = 0xFFFFFFFF
QUADS = 0x80808080
VIEWS: dict[str, View] = {
    "all": ((9, 7), fit((9, 7))),
    "one pixel": ((1, 1), fit((1, 1))),
    "turned and long": turned_view(12, 45, 8),
    "tilted": ((12, 8), TILTED * (8, 8, 1)),
    "deep": ((6, 6), window(0.5 - 2.0**-22, 0.25, 2.0**-21, 2.0**-21).matrix((6, 6))),
}

COLOURS: list[Any] = [
    partial(render, is_linear=is_linear)
    for render in (render_cpu_colours, render_gpu_colours)
    for is_linear in (False, True)
]

LOOP = re.compile(r"^( *(?:for|while) \(.*\) \{)$", re.MULTILINE)
MOST_CELLS = 4 * (2 + 4 / LONG**0.5) ** 2  # of half the least size for a long footprint, in the box around it
MOST_RAMP_TRIPS = MOST_RAMP_PARTS**2 * (10 * MOST_PROGRAM + 6 * (MOST_STOPS + 2 * MOST_PROGRAM))
MOST_PAINT_TRIPS = (1 + 3) * MOST_PROGRAM + MOST_RAMP_TRIPS
MOST_TRIPS = MOST_CELLS * (1 + MOST_DEPTH + MOST_CURVES * (2 + STEPS + int(MOST_PARTS)))
MOST_COLOUR_TRIPS = MOST_TRIPS + MOST_CELLS * (1 + 2 * MOST_CURVES) * (1 + MOST_PAINT_TRIPS)


@st.composite
def textures(draw: st.DrawFn) -> Texture:
    """Random words; in most, quads of quads that point anywhere, to themselves and in circles."""
    rng = np.random.default_rng(draw(st.integers(0, 10**9)))
    rows, width = draw(st.sampled_from([(1, 1), (1, 2), (1, 64), (2, 2048), (3, 2048)]))
    words = rng.integers(0, 1 << 32, (rows, width, 4), dtype=np.uint32)
    kind = draw(st.sampled_from(["noise", "all ones", "circles", "beyond", "crowded leaves"]))
    if kind == "all ones":
        words[:] = ALL_ONES
    if kind in ("circles", "beyond"):
        words[..., 2] |= QUADS
    if kind == "circles":
        words[..., 0] %= rows * width
    if kind == "crowded leaves":
        words[..., 2] = words[..., 2] & ~np.uint32(QUADS) | np.uint32(0x78787878)
    return Texture(words, (Root("noise", quad=draw(st.sampled_from([0, 1, rows * width, ALL_ONES]))),))


@settings(max_examples=60)
@given(textures(), st.sampled_from(sorted(VIEWS)))
@example(Texture(np.full((1, 1, 4), ALL_ONES, np.uint32), (Root("ones"),)), "all")
@example(Texture(np.zeros((1, 1, 4), np.uint32), (Root("zeros"),)), "all")
def test_any_bits_are_drawn_as_numbers(texture: Texture, view: str) -> None:
    need_gpu()
    size, matrix = VIEWS[view]
    for render in (render_cpu, render_gpu, *COLOURS):
        image = render(texture, size, matrix)
        assert np.isfinite(image).all()
        assert image.min() >= 0.0
        assert image.max() <= 1.0
        if image.ndim == 3:
            assert (image[..., :3] <= image[..., 3:]).all()


@pytest.mark.parametrize("shape", [(1, 1), (1, 8), (3, 2048)])
def test_no_index_leaves_the_texture(shape: tuple[int, int]) -> None:
    words = np.arange(4 * shape[0] * shape[1], dtype=np.uint32).reshape(*shape, 4)
    last = words[-1]
    for index in (0, shape[1] - 1, shape[1], 2048, 3 * 2048, 1 << 31, ALL_ONES, ALL_ONES + 1, ALL_ONES + 9, 1 << 40):
        kept = index % (1 << 32)
        expected = words[min(kept >> 11, shape[0] - 1), min(kept & 2047, shape[1] - 1)]
        assert texel(words, index) == tuple(expected)
    assert texel(words, 2047 | ALL_ONES << 11) == tuple(last[-1])


def test_nothing_else_reads_the_texture() -> None:
    with open(cells.__file__, encoding="utf-8") as module:
        assert module.read().count("texels[") == 1


def counting(source: str) -> Any:
    """The shader, drawing how often its loops go round instead of what they find."""
    text, loops = LOOP.subn(r"\1 trips++;", source)
    assert loops == len(re.findall(r"\b(?:for|while|do)\b *[({]", text)), "a loop that this test does not count"
    kept = r"\1 found = \3; \2 = \1(trips) + 0.0 * found; }"
    drawn = re.sub(r"out (\w+) (\w+);\nvoid main\(\) \{ \w+ = (.*); \}", r"out \1 \2;\nvoid main() { " + kept, text)
    return compile_shader(drawn.replace("\n", "\nint trips = 0;\n", 1))


@pytest.mark.parametrize("view", VIEWS)
def test_the_work_for_a_pixel_is_bounded(view: str, monkeypatch: pytest.MonkeyPatch) -> None:
    need_gpu()
    with context():
        kinds = (False, True)
        programs = {is_flat: counting(view_source(VERSION, is_flat)) for is_flat in kinds}
        colours = {is_flat: counting(color_source(VERSION, is_flat, False, True)) for is_flat in kinds}
    monkeypatch.setattr(gpu, "program", programs.get)
    monkeypatch.setattr(gpu, "color_program", lambda is_flat, *_: colours[is_flat])
    size, matrix = VIEWS[view]
    rng = np.random.default_rng(3)
    for mask in (0, QUADS, 0x78787878, ALL_ONES):
        words = rng.integers(0, 1 << 32, (3, 2048, 4), dtype=np.uint32)
        words[..., 2] |= np.uint32(mask)
        for render in (render_gpu, render_gpu_colours):
            trips = render(Texture(words, (Root("noise"),)), size, matrix)
            assert 0 < trips.max() <= (MOST_TRIPS if render is render_gpu else MOST_COLOUR_TRIPS)
