"""glTF models with vector textures on their materials."""
