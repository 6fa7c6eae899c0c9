"""SVG documents, read into drawings.

`read.py` begins; `scene.py` walks the document; `painter.py` makes paths of fills and strokes. `properties.py` lists
the CSS properties, and `style.py` computes their values. `shapes.py` and `path_data.py` read geometry. `animation.py`
and `keyframes.py` give animated elements the values of the first frame.
"""
