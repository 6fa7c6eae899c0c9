"""The package's reading of planar maps, in JavaScript, against Python's and the decoder written from FORMAT.md."""

import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from walk_node import by_node, found_at, points

import vexture
from chromium import ROOT
from degenerate import drawing
from planar import colour_paths, widen_paints
from vexture.base.errors import FormatError
from vexture.drawing.drawing import Drawing
from vexture.texture.texture import Texture

sys.path.append(str(ROOT / "tests" / "format"))
import map_decoder

FLIPS = 400


def samples() -> Iterator[Drawing]:
    """Drawings in colours: an example, and outlines that coincide, touch and cross."""
    yield vexture.read_svg(ROOT / "web" / "test" / "fixtures" / "badge.svg")
    for seed in (3, 8):
        yield colour_paths(Drawing(drawing(seed).paths + drawing(seed + 100).paths), np.random.default_rng(seed))


def named(part: int, of: Drawing) -> Drawing:
    return replace(of, name=f"sample {part}")


@pytest.mark.parametrize("is_wide", [False, True])
def test_the_same_paints_are_found(tmp_path: Path, is_wide: bool) -> None:
    """Of three drawings; or of the last one, with numbers of 32 bits."""
    texture = vexture.atlas([named(*one) for one in enumerate(samples())][2 * is_wide :], split="faces")
    texture = widen_paints(texture) if is_wide else texture
    path, at = texture.save(tmp_path / "maps.ktx2"), points()
    _, _, maps = map_decoder.read_maps(path.read_bytes())
    for planar, found in zip(maps, found_at(path, at, tmp_path), strict=True):
        paint = map_decoder.paint_at(planar, *at.T)
        same = np.array([-1 if one["paint"] is None else one["paint"] for one in found["painted"]]) == paint
        assert same.mean() > 0.999  # points at a curve to the last bit are left of it in one, and right in the other
        assert (paint >= 0).mean() > 0.95
        colors = np.array([one["color"] for one in found["painted"]])
        expected = map_decoder.color_at(planar, *at.T)
        np.testing.assert_allclose(colors[same], expected[same].clip(0, 1), rtol=0, atol=1e-9)
        assert (np.array(found["inside"]) == (colors[:, 3] > 0)).all()
        x0, y0, x1, y1 = found["bounds"]
        inside = at[found["inside"]]
        assert (inside >= (x0, y0)).all()
        assert (inside <= (x1, y1)).all()


def test_the_same_files_are_refused(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    texture = vexture.atlas([named(*one) for one in enumerate([*samples()][:2])], split="faces")
    used = np.flatnonzero(texture.flat.any(axis=1))
    heads = np.array([root.quad - 1 for root in texture.roots])
    verdicts: dict[str, Any] = {}
    folder = tmp_path / "broken"
    folder.mkdir()
    for number in range(FLIPS):
        texels = texture.texels.copy()
        at = random.choice(heads if number % 4 == 0 else used)
        texels.reshape(-1, 4)[at, random.integers(4)] ^= np.uint32(1 << random.integers(32))
        broken = Texture(texels, texture.roots)
        path = broken.save(folder / f"{number}.ktx2")
        try:
            broken.check()
        except FormatError as error:
            verdicts[path.name] = str(error)
        else:
            verdicts[path.name] = None
    found = by_node("reading.mjs", folder)
    different = {
        name: (verdicts[name], found[name]) for name in found if (found[name] is None) != (verdicts[name] is None)
    }
    assert different == {}
    assert 0.2 < np.mean([verdict is None for verdict in verdicts.values()]) < 0.9
    assert not any(said and (said.startswith("broken") or "\n" in said) for said in found.values())
    own = [name for name, said in found.items() if said and " map " in said]
    assert len(own) > FLIPS // 20
    assert [found[name].split(": ", 1)[1] for name in own] == [verdicts[name] for name in own]
