"""`vexture.map`: the widget of a map in a notebook."""
