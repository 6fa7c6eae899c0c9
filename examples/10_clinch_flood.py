"""A river flood below Norris Dam, Tennessee, to try `vexture flood` on: real heights, a synthetic flood.

python examples/10_clinch_flood.py [FOLDER [METRES OF A CELL]]
"""

import sys
from pathlib import Path

import netCDF4
from clinch.make_flood import NOTE, make_flood
from clinch.terrain import CELL

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/10")
folder.mkdir(parents=True, exist_ok=True)

flood, ground = make_flood(folder, float(sys.argv[2]) if len(sys.argv) > 2 else CELL)
print(NOTE)
with netCDF4.Dataset(flood) as file:
    depth = file["depth"][:]
for hour in range(0, len(depth), 4):
    wet = depth[hour] >= 0.05
    print(f"hour {hour}: {wet.mean():.1%} is under water, {depth[hour].max():.1f} m at most")
print(f"vexture flood --extent {flood} --time-dim time --ground {ground} -o {folder / 'flood.html'}")
