"""SVG text (SVG 2, 11): from a text element to positioned outlines."""
