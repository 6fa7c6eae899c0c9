"""Models of glTF: vector textures on their materials."""
