"""A drawing on a mesh in pygfx, by the shader in WGSL. Needs pygfx and rendercanvas, and a GPU or a Vulkan driver."""

import sys
from pathlib import Path

import numpy as np
import pygfx as gfx
from for_pygfx.material import VectorMaterial
from PIL import Image
from rendercanvas.offscreen import OffscreenRenderCanvas

import vexture

folder = Path(sys.argv[1] if sys.argv[1:] else ".")
folder.mkdir(parents=True, exist_ok=True)
drawing = vexture.read(Path(__file__).parent / "shapes" / "duck.svg")
canvas = OffscreenRenderCanvas(size=(512, 512), pixel_ratio=1)
renderer = gfx.WgpuRenderer(canvas, pixel_ratio=1, ppaa="none")
plane = gfx.Mesh(gfx.plane_geometry(1, 1), VectorMaterial(vexture.convert(drawing), color="#fff"))
scene = gfx.Scene().add(gfx.Background.from_color("#000"), plane)

flat = gfx.OrthographicCamera(1, 1, maintain_aspect=True)
canvas.request_draw(lambda: renderer.render(scene, flat))
shown = np.asarray(canvas.draw())[..., 0] / 255.0
light = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
exact = vexture.coverage(drawing, 512, renderer="exact")
print(f"pygfx {gfx.__version__}: mean error {255 * np.abs(light - exact).mean():.3f} of 255")

plane.local.euler = (-1.0, 0.4, 0.0)
tilted = gfx.PerspectiveCamera(40, 1)
tilted.local.position = (0, 0, 1.6)
canvas.request_draw(lambda: renderer.render(scene, tilted))
Image.fromarray(np.asarray(canvas.draw())).save(folder / "pygfx.png")
