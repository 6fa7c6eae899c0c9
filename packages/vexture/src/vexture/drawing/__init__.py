"""The normal form of a drawing: contours of cubics in the unit square, with paints. Also parses CSS colours."""
