"""A heart of pixels is traced; figures of its texture, of its cells by depth, of its outline by several methods.

python examples/06_figures.py [FOLDER]      needs vexture-evidence
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import vexture
from vexture_evidence.figures.cells import subdivision
from vexture_evidence.figures.edges import edges
from vexture_evidence.measures.renderings import at_edge
from vexture_evidence.measures.shape import ConvertedDrawing

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/06")
folder.mkdir(parents=True, exist_ok=True)

y, x = np.mgrid[1.5:-1.1:200j, -1.3:1.3:200j]
outside = x**2 + (1.2 * y - np.sqrt(np.abs(x))) ** 2 - 1
Image.fromarray(np.uint8(255 * np.clip(40 * outside + 0.5, 0, 1))).save(folder / "heart.png")  # with soft edges

texture = vexture.convert(folder / "heart.png")
figures = {
    "texture": texture.plot(),  # in a notebook this line alone shows it
    "depths": subdivision(texture, shades="depth"),
    "edges": edges(at_edge(ConvertedDrawing(folder / "heart.png"))),
}
for name, figure in figures.items():
    figure.savefig(folder / f"heart-{name}.png", dpi=150)
    print(f"heart-{name}.png: {len(figure.axes)} panels")
