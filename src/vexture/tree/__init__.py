"""From a drawing to a quad-tree whose leaves a shader can evaluate alone."""
