"""From a model's output to the page on the left. The command line does it in one step.

    python examples/05_santa_cruz_flood.py .
    vexture flood --extent flood.nc --time-dim time --ground ground.jpg -o flood.html

And so does Python, from what xarray holds.
"""

import xarray

import vexture

flood = xarray.open_dataset("flood.nc")  # depth(time, y, x) and bed_level(y, x), EPSG:32610
page = vexture.flood_page(flood, ground="ground.jpg", time_dim="time")
page.save("flood.html")  # one file, which needs no server
