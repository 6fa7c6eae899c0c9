"""Conversion of a file into a texture or a picture: reading, parameters and the pipeline."""
