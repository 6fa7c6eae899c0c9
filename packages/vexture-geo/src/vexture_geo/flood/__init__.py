"""`vexture flood`: a flood, its ground and its sea as one page, or on a server."""
