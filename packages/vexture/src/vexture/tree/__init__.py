"""From a drawing to a quad-tree whose leaves a shader can evaluate alone.

`build.py` divides the unit square: `divide.py` cuts a cell's pieces for its children, `winding.py` gives the children
their corner windings, and `leaf.py` decides whether a cell becomes a leaf.

All modules use these names. `points` (n, 4, 2) are monotone pieces in unit-square units; `curves` (n, 4, 2) are pieces
on the lattice of one cell. `path` (n,) is the path of each piece. `present` (m, 2) lists the paths in a cell, each with
its corner winding. `rules` (paths,) holds the `FillRule` of each path of the drawing. `x0`, `y0` and `size` are a
cell's bottom-left corner and its width.
"""
