"""Geographic data: files to drawings, extents and depths, and their reference systems."""
