"""One texture seen from far and near: whole, turned, a hundred times larger, and lying on a floor.

A view is a matrix from pixels (x right, y down) to the unit square (x right, y up); its third row makes perspective.

python examples/02_views.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import vexture

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/02")
folder.mkdir(parents=True, exist_ok=True)
texture = vexture.convert(Path(__file__).parent / "shapes" / "cake.svg")

size = 400
pixel = 1 / size
turn = np.radians(30)
cosine, sine = pixel * np.cos(turn), pixel * np.sin(turn)
half = 0.5 * size
views = {
    "whole": None,
    "turned": [[cosine, -sine, 0.5 - half * (cosine - sine)], [-sine, -cosine, 0.5 + half * (sine + cosine)]],
    "near": [[pixel / 100, 0, 0.5], [0, -pixel / 100, 0.5]],
    "floor": [[1.25 * pixel, 0.5 * pixel, -0.5], [0, -0.5 * pixel, 0.5], [0, pixel, 0.25]],
}
for name, to_unit in views.items():
    image = vexture.coverage(texture, size=(size, size), view=to_unit, renderer="cpu")
    Image.fromarray(np.uint8(np.rint(255 * (1 - image)))).save(folder / f"cake-{name}.png")
print(f"open the pictures in {folder}")
