"""From a file to a texture or a picture: reading, parameters and the pipeline."""
