"""Building a `PlanarMap`: a whole drawing as one tree, whose pieces separate faces of different colours."""
