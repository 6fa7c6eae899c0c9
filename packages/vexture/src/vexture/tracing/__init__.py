"""Pictures of pixels, traced into drawings."""
