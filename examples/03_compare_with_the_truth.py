"""A drawing made of coordinates, in the thesis's encoding with 8 and with 16 bits, and how far each is from the truth.

python examples/03_compare_with_the_truth.py
"""

import numpy as np

import vexture

angles = np.radians(90 + 144 * np.arange(5))  # a pentagram: its outline crosses itself
corners = [(0.5 + 0.45 * float(np.cos(angle)), 0.5 + 0.45 * float(np.sin(angle))) for angle in angles]

for rule in vexture.FillRule:
    star = vexture.Drawing.polygon(corners, fill_rule=rule)
    truth = vexture.coverage(star, size=(250, 250), renderer="exact")
    for bits in (8, 16):
        texture = vexture.convert(star, encoding="thesis", bits=bits)
        image = vexture.coverage(texture, size=(250, 250), renderer="cpu")
        touched = np.maximum(truth, image) > 0
        error = 255 * float(np.abs(image - truth)[touched].mean())
        curves = len(texture.curves) - 2  # the first two rows stand for full and empty
        print(f"{rule.name.lower():8} {bits:2} bits: {curves:3} curves, mean error {error:.2f}/255")
