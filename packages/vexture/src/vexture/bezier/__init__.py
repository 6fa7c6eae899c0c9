"""Mathematics of cubic Bézier curves."""
