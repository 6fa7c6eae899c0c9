"""SVG documents, read into drawings.

`read.py` is the entry point; `scene.py` walks the document; `painter.py` makes paths of fills and strokes.
`properties.py` lists the CSS properties, and `style.py` computes their values. `shapes.py` and `path_data.py` read
geometry. `animations.py` finds content that is visible only during an animation.
"""
