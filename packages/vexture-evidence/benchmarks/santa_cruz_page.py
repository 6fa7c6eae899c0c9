"""The exported page of Santa Cruz's flood in Chromium: pictures from its views, with our water or a raster's."""

import base64
import io
import json
import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from chromium import ROOT
from vexture.drawing.drawing import Drawing
from vexture.renderers.exact import render_exact

SIZE: Final = (960, 540)
PRESETS: Final = ("Plan", "Overview", "Coast", "Shore", "Beach")
MASK: Final = 1024
"""Pixels along each side of the raster that is compared."""

PATIENCE: Final = 60_000  # ms

LOOK: Final = """([preset, seconds]) => {
    const { water, stage, freeze, view } = window.vexture.flood;
    freeze(seconds);
    view(preset, { fly: false });
    const { camera } = window.vexture.flood;  // a plan has another one
    stage.render();
    const picture = stage.canvas.toDataURL('image/png');  // in the task of the render: later it is gone
    camera.updateMatrixWorld();
    water.updateWorldMatrix(true, false);
    const projection = [...camera.projectionMatrix.elements], seen = [...camera.matrixWorldInverse.elements];
    return { picture, projection, view: seen, level: water.matrixWorld.elements[13] };
}"""

RASTER: Final = """([mask, side, samples]) => {
    const { material } = window.vexture.flood.water;
    const Data = material.uniforms.normalSampler.value.constructor;
    const texels = Uint8Array.from(atob(mask), (letter) => letter.charCodeAt(0));
    const texture = new Data(texels, side, side, 1028);  // RedFormat
    Object.assign(texture, { magFilter: 1006, minFilter: 1008, generateMipmaps: true, anisotropy: samples });
    texture.needsUpdate = true;
    material.uniforms.rasterMask = { value: texture };
    const found = /vextureWrapped\\((vextureQuads\\[shape\\]),\\s*(.*?)\\)/;
    const before = /VextureWater\\s+vextureWater\\s*\\(/;
    const text = material.fragmentShader;
    if (!found.test(text) || !before.test(text)) return false;
    material.fragmentShader = text.replace(found, 'rasterCoverage($2)').replace(before, `uniform sampler2D rasterMask;
        float rasterCoverage(vec2 uv, vec2 dx, vec2 dy) {
            return textureGrad(rasterMask, uv, dx, dy).r;
        }
        $&`);
    material.needsUpdate = true;
    return true;
}"""
"""Puts a picture in place of our texture: one line of the same shader, trilinear, with anisotropic samples."""

TIMES: Final = """async ([preset, frames]) => {
    const { stage, view, freeze } = window.vexture.flood;
    const gl = stage.renderer.getContext();
    const pixel = new Uint8Array(4);
    view(preset, { fly: false });
    const taken = [];
    for (let frame = 0; frame < frames; frame++) {
        const start = performance.now();
        freeze(frame / 30);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        taken.push(performance.now() - start);
    }
    return taken;
}"""

PICTURED: Final = """
const look = () => {
  const flood = window.vexture?.flood;
  if (!flood?.ready) return void requestAnimationFrame(look);
  flood.ready.then(() => {
    const gl = flood.stage.renderer.getContext();
    flood.stage.render();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    requestAnimationFrame(() => { window.pictured = performance.now(); });
  });
};
look();
"""


class ExportedFlood(NamedTuple):
    """An exported page, and its data and drawings."""

    page: Path
    scene: dict[str, Any]
    drawings: list[Drawing]

    @property
    def box(self) -> list[float]:
        """Box of the frame in the unit square."""
        return list(self.scene["frame"]["box"])

    @property
    def fold(self) -> Any:
        """Motion of the shore; None if it does not move."""
        from vexture.fold.fold import fold_from

        address = self.scene["fold"]
        return None if address is None else fold_from(content(address), "the page's fold")

    @property
    def textures(self) -> list[bytes]:
        """Files of all steps."""
        return [content(step["texture"]) for step in self.scene["steps"]]

    @property
    def depths(self) -> list[bytes]:
        """Pictures of depths of the steps that have one."""
        return [content(step["views"]["depth"]) for step in self.scene["steps"] if "depth" in step["views"]]


def content(address: str) -> bytes:
    """Content of a ``data:`` address."""
    return base64.b64decode(address.partition(",")[2])


@cache
def example() -> Any:
    """The example's function that makes the flood."""
    sys.path.insert(0, str(ROOT / "examples"))
    from santa_cruz.make_flood import make_flood

    return make_flood


def export_page(folder: Path) -> ExportedFlood:
    """Export the example's page."""
    from vexture_geo.flood.options import FloodOptions
    from vexture_geo.flood.server import export
    from vexture_geo.readers import read_extent

    flood, ground = example()(folder)
    page = folder / "flood.html"
    export(FloodOptions(flood, time_dim="time", ground=ground, title="Santa Cruz"), page, None, lambda line: None, iter)
    extent = read_extent(flood, flood.name, time_dim="time")
    return ExportedFlood(page, scene_of(page), [step.drawing for step in extent.steps])


def scene_of(page: Path) -> dict[str, Any]:
    """Data of the flood in an exported page."""
    found = re.search(r'<script type="application/json" id="vexture-scene">(.*?)</script>', page.read_text(), re.S)
    assert found is not None
    scene: dict[str, Any] = json.loads(found[1])["flood"]
    return scene


@contextmanager
def open_page(browser: Any, flood: ExportedFlood, step: int, *, flat: bool) -> Iterator[Any]:
    """Open the page at one of its steps, bare; flat: relief 0, water white, all else black."""
    page = browser.new_page(viewport=dict(zip(("width", "height"), SIZE, strict=True)), color_scheme="light")
    page.set_default_timeout(PATIENCE)
    page.goto(f"{flood.page.as_uri()}?bare")
    page.evaluate("vexture.flood.ready")
    page.evaluate("vexture.flood.freeze(0)")  # else its waves take the processor from all others
    page.evaluate("(step) => vexture.flood.step(step)", step)
    if flat:
        page.evaluate("() => { vexture.flood.relief(0); vexture.flood.flat(true); }")
    try:
        yield page
    finally:
        page.close()


def capture_view(page: Any, preset: str, seconds: float) -> tuple[NDArray[np.uint8], dict[str, Any]]:
    """Capture a view at a time; return the picture and the camera's matrices."""
    camera = page.evaluate(LOOK, [preset, seconds])
    picture = np.asarray(Image.open(io.BytesIO(content(camera.pop("picture")))).convert("RGB"))
    assert picture.shape[1::-1] == SIZE
    return picture, camera


def mask_of(drawing: Drawing) -> tuple[NDArray[np.uint8], int]:
    """Raster of a drawing over the unit square, the top row first, and its bytes as PNG."""
    mask = np.uint8(np.rint(255 * render_exact(drawing, (MASK, MASK))))
    file = io.BytesIO()
    Image.fromarray(mask).save(file, "PNG", optimize=True)
    return mask, len(file.getvalue())


def show_raster(page: Any, mask: NDArray[np.uint8], samples: int) -> None:
    """Show water where a raster has it, filtered by `samples` samples along a footprint."""
    texels = base64.b64encode(np.ascontiguousarray(mask[::-1]).tobytes()).decode()
    if not page.evaluate(RASTER, [texels, MASK, samples]):
        raise SystemExit(
            "the water's shader has no lookup that a raster could replace; adapt benchmarks/santa_cruz_page.py"
        )


def frame_times(page: Any, preset: str, frames: int) -> list[float]:
    """Milliseconds of frames, until their pixels can be read."""
    return [float(ms) for ms in page.evaluate(TIMES, [preset, frames])]


def first_picture(browser: Any, path: Path, times: int) -> list[float]:
    """Milliseconds from opening a page to its first picture, each time in a fresh profile."""
    taken = []
    for _ in range(times + 1):
        context = browser.new_context(viewport=dict(zip(("width", "height"), SIZE, strict=True)))
        page = context.new_page()
        page.add_init_script(PICTURED)
        page.goto(path.as_uri())
        taken.append(float(page.wait_for_function("window.pictured", timeout=PATIENCE).json_value()))
        context.close()
    return taken[1:]  # the first starts the browser's GPU process
