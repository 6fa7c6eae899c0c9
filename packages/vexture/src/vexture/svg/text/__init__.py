"""Text of SVG (SVG 2, 11): from an element and the elements in it to outlines in their places."""
