"""A flood at Santa Cruz, California, to try `vexture flood` on: the coastline is real, the rest is synthetic.

python examples/05_santa_cruz_flood.py [FOLDER]
"""

import sys
from pathlib import Path

import netCDF4
from santa_cruz.make_flood import NOTE, make_flood
from santa_cruz.terrain import COASTLINE

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "demo/05")
folder.mkdir(parents=True, exist_ok=True)

flood, ground = make_flood(folder)
print(NOTE)
with netCDF4.Dataset(flood) as file:
    depth, level = file["depth"][:], file["water_level"][:]
for hour in range(0, len(depth), 4):
    print(f"{hour:02}:00, water at {level[hour]:+.2f} m: {(depth[hour] >= 0.05).mean():.1%} is under water")
for path in (flood, ground):
    print(f"{path}: {path.stat().st_size} bytes, synthetic")

print("now, for the flood and for the real coastline:")
print(f"vexture flood --extent {flood} --time-dim time --ground {ground} -o {folder / 'flood.html'}")
print(f"vexture flood --extent {COASTLINE} --bounds -122.083,36.928,-121.958,36.994", end=" ")
print(f"--ground {ground.with_suffix('.tif')} -o {folder / 'coast.html'}")
