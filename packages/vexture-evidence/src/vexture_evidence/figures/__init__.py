"""Pictures of drawings, trees, textures and renderings, each made from the library's own data by one function."""
