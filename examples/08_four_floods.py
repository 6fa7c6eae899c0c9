"""Four synthetic floods, to try `vexture flood` on: a coast, a river valley, a polder, the streets of a town.

python examples/08_four_floods.py [FOLDER]
"""

import sys
from pathlib import Path

from four_floods.make_floods import NOTE, SCENES, hours_of, write

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/08")
folder.mkdir(parents=True, exist_ok=True)

print(NOTE)
for make in SCENES:
    scene = make()
    path = write(scene, folder)
    wet = [float((level > scene.bed + 0.05).mean()) for level in scene.levels]
    print(f"{path}: {scene.title}, {hours_of(scene)}; {wet[0]:.0%} under water at first, {max(wet):.0%} at most")
    print(f"vexture flood --extent {path} --time-dim time -o {path.with_suffix('.html')}")
