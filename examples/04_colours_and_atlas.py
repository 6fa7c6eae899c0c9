"""A logo of three colours: as one picture, as one shape for each colour, and as one of many shapes in an atlas.

python examples/04_colours_and_atlas.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import vexture

LOGO = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><circle cx="50" cy="50" r="48" fill="#06c"/>
<path d="M20 70L50 15L80 70z" fill="white"/><circle id="sun" cx="50" cy="52" r="12" fill="#fc0" fill-opacity="0.8"/>
</svg>"""

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/04")
folder.mkdir(parents=True, exist_ok=True)
logo = folder / "logo.svg"
logo.write_text(LOGO)

whole = vexture.convert(logo)
image = vexture.render(whole, size=(300, 300), renderer="cpu")  # premultiplied RGBA
on_white = image[..., :3] + 1 - image[..., 3:]
Image.fromarray(np.uint8(np.rint(255 * on_white))).save(folder / "logo.png")

texture = vexture.convert(logo, split="paint")
print(*(f"{root.name}: opacity {root.paint.opacity:g}, quad {root.quad}" for root in texture.roots), sep="\n")
sun = vexture.read_svg(logo, select="#sun")  # a part, where it was in the whole
shapes = Path(__file__).parent / "shapes"
atlas = vexture.atlas([logo, shapes / "duck.svg", shapes / "cake.svg"])
image = vexture.coverage(atlas, size=(300, 300), renderer="cpu", root="duck")
Image.fromarray(np.uint8(np.rint(255 * (1 - image)))).save(folder / "duck.png")
print(f"{sun.segments} segments are the sun; open the pictures in {folder}")
