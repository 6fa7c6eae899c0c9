"""Pure mathematics of cubic Bézier curves, one noun to a module."""
