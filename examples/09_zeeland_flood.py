"""A flood at Zierikzee, Zeeland, to try `vexture flood` on: the coastline is real, the rest is synthetic.

python examples/09_zeeland_flood.py [FOLDER [METRES OF A CELL]]
"""

import sys
from pathlib import Path

import netCDF4
from zeeland.make_flood import NOTE, make_flood
from zeeland.terrain import CELL

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/09")
folder.mkdir(parents=True, exist_ok=True)

flood, ground = make_flood(folder, float(sys.argv[2]) if len(sys.argv) > 2 else CELL)
print(NOTE)
with netCDF4.Dataset(flood) as file:
    depth, level = file["depth"][:], file["water_level"][:]
for hour in range(0, len(depth), 4):
    print(f"hour {hour}, the sea at {level[hour]:+.2f} m: {(depth[hour] >= 0.05).mean():.1%} is under water")
print(f"vexture flood --extent {flood} --time-dim time --ground {ground} -o {folder / 'flood.html'}")
