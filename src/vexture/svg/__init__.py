"""SVG documents, read into drawings."""
