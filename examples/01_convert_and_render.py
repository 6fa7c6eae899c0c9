"""From an SVG to a texture file, and from that to pictures of any size.

python examples/01_convert_and_render.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import vexture

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/01")
folder.mkdir(parents=True, exist_ok=True)

drawing = vexture.read_svg(Path(__file__).parent / "shapes" / "duck.svg")
texture = vexture.convert(drawing)
file = texture.save(folder / "duck.ktx2")
print(f"{drawing.segments} segments became {file.name}: {file.stat().st_size} bytes")

texture = vexture.load(file)
for size in (32, 128, 512):
    image = vexture.coverage(texture, size=(size, size), renderer="cpu")  # "gpu" if this machine has OpenGL
    Image.fromarray(np.uint8(np.rint(255 * (1 - image)))).save(folder / f"duck-{size}.png")
print(f"open the pictures in {folder}")
